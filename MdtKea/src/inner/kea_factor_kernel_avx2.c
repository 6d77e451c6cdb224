/* The kernel of sparse factors for AVX2; its results have the same bits as those of kea_factor_kernel.c. */
#define KEA_FACTOR_KERNEL kea_factorKernelAvx2
#include "inner/kea_factor_kernel_i.h"
