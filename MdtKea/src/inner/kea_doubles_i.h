/* Inside Kea: two doubles at a time, by vector extensions of GCC and Clang: a register of SSE2, or two scalars. */
#ifndef KEA_DOUBLES_I_H
#define KEA_DOUBLES_I_H

#include <string.h>

typedef double KeaTwo __attribute__((vector_size(2 * 8)));

#define KEA_INLINE static inline __attribute__((always_inline))

KEA_INLINE KeaTwo twoAt(const double *p) {
    KeaTwo v;
    memcpy(&v, p, sizeof v);
    return v;
}
KEA_INLINE void putTwo(double *p, KeaTwo v) {
    memcpy(p, &v, sizeof v);
}

#endif
