/* The kernel of sparse factors for the baseline instructions of the target: SSE2 on x86. */
#define KEA_FACTOR_KERNEL kea_factorKernel
#include "inner/kea_factor_kernel_i.h"
