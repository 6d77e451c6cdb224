/* The fast solver's kernel for the baseline instructions of the target: SSE2 on x86. */
#define KEA_KERNEL kea_kernel
#include "fast/kea_kernel_i.h"
