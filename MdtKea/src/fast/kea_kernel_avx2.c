/* The fast solver's kernel for AVX2; its results have the same bits as those of kea_kernel.c. */
#define KEA_KERNEL kea_kernelAvx2
#include "fast/kea_kernel_i.h"
