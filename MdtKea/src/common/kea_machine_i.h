/* Inside Kea: which kernels the machine can run. */
#ifndef KEA_MACHINE_I_H
#define KEA_MACHINE_I_H

#include "MePrecision.h"

#ifdef KEA_HAS_AVX2
static inline MeBool kea_machineHasAvx2(void) {
    return __builtin_cpu_supports("avx2") != 0;
}
#endif

#endif
