/* The fast solver's kernel for what every machine of this kind has: SSE2 where there is one. */
#define KEA_KERNEL kea_kernel
#include "fast/kea_kernel_i.h"
