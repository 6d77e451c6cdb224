/* The kernel of sparse factors for what every machine of this kind has: SSE2 where there is one. */
#define KEA_FACTOR_KERNEL kea_factorKernel
#include "inner/kea_factor_kernel_i.h"
