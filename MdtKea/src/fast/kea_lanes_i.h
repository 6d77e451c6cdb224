/* Inside Kea: eight floats at a time, one for each of eight manifolds.
 *
 * They are vector extensions of GCC and Clang, so that one source serves registers of any width: a vector is one
 * register with AVX, two with SSE2, eight floats elsewhere. All operations are correctly rounded, their order is fixed,
 * and products are not contracted with sums: the bits do not depend on the width.
 */
#ifndef KEA_LANES_I_H
#define KEA_LANES_I_H

#include "fast/kea_fast_i.h"
#include "inner/kea_doubles_i.h" /* KEA_INLINE */

#include <math.h>
#include <string.h>
#if defined(__AVX__) || defined(__SSE2__)
#include <immintrin.h>
#endif

typedef float KeaQuad __attribute__((vector_size(4 * 4)));

/* a in all lanes. */
KEA_INLINE KeaLanes lanesOf(float a) {
    return (KeaLanes){a, a, a, a, a, a, a, a};
}
/* a where the mask is true, else b. */
KEA_INLINE KeaLanes lanesSelect(KeaMask m, KeaLanes a, KeaLanes b) {
    return (KeaLanes)(((KeaMask)a & m) | ((KeaMask)b & ~m));
}
/* a > b ? a : b, as the machine's instruction defines it, also for zeros and NaN. */
KEA_INLINE KeaLanes lanesMax(KeaLanes a, KeaLanes b) {
#if defined(__AVX__)
    return (KeaLanes)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return lanesSelect(a > b, a, b);
#endif
}
KEA_INLINE KeaLanes lanesMin(KeaLanes a, KeaLanes b) {
#if defined(__AVX__)
    return (KeaLanes)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return lanesSelect(a < b, a, b);
#endif
}
KEA_INLINE KeaLanes lanesAbs(KeaLanes a) {
    return (KeaLanes)((KeaMask)a & 0x7fffffff);
}
/* a, clamped to -bound .. bound. */
KEA_INLINE KeaLanes lanesClamp(KeaLanes a, KeaLanes bound) {
    return lanesMax(lanesMin(a, bound), -bound);
}
/* Square roots. */
KEA_INLINE KeaLanes lanesRoot(KeaLanes a) {
    KeaLanes r;
    for (int i = 0; i < KEA_LANES; i++)
        r[i] = sqrtf(a[i]);
    return r;
}
/* Whether the mask is true in all lanes. */
KEA_INLINE MeBool lanesAreAll(KeaMask m) {
#if defined(__AVX__)
    return _mm256_movemask_ps((__m256)m) == 0xff;
#else
    int all = -1;
    for (int i = 0; i < KEA_LANES; i++)
        all &= m[i];
    return all != 0;
#endif
}

KEA_INLINE KeaLanes lanesDot(KeaLanes3 a, KeaLanes3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
KEA_INLINE KeaLanes3 lanesCross(KeaLanes3 a, KeaLanes3 b) {
    return (KeaLanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
KEA_INLINE KeaLanes3 lanesScale(KeaLanes s, KeaLanes3 a) {
    return (KeaLanes3){s * a.x, s * a.y, s * a.z};
}
KEA_INLINE KeaLanes3 lanesSum(KeaLanes3 a, KeaLanes3 b) {
    return (KeaLanes3){a.x + b.x, a.y + b.y, a.z + b.z};
}
KEA_INLINE KeaLanes3 lanesDifference(KeaLanes3 a, KeaLanes3 b) {
    return (KeaLanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}
/* M a, with a symmetric matrix M: xx xy xz yy yz zz. */
KEA_INLINE KeaLanes3 lanesApply(const KeaLanes M[6], KeaLanes3 a) {
    return (KeaLanes3){M[0] * a.x + M[1] * a.y + M[2] * a.z, M[1] * a.x + M[3] * a.y + M[4] * a.z,
                       M[2] * a.x + M[4] * a.y + M[5] * a.z};
}

/* ---- gather and scatter ---- */

/* Transposes the two 4x4 blocks of the lower and of the upper lanes. */
KEA_INLINE void lanesTranspose(KeaLanes r[4]) {
    const KeaLanes a = __builtin_shufflevector(r[0], r[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const KeaLanes b = __builtin_shufflevector(r[0], r[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const KeaLanes c = __builtin_shufflevector(r[2], r[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const KeaLanes d = __builtin_shufflevector(r[2], r[3], 2, 10, 3, 11, 6, 14, 7, 15);
    r[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
    r[1] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
    r[2] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
    r[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

/* Loads four floats from each of eight addresses, 16-byte aligned, and returns the first three of each. */
KEA_INLINE KeaLanes3 lanesGather(const float *const at[KEA_LANES]) {
    KeaLanes r[4];
    for (int i = 0; i < 4; i++)
        r[i] = __builtin_shufflevector(*(const KeaQuad *)(const void *)at[i], *(const KeaQuad *)(const void *)at[i + 4],
                                       0, 1, 2, 3, 4, 5, 6, 7);
    lanesTranspose(r);
    return (KeaLanes3){r[0], r[1], r[2]};
}

/* Stores three floats and a 0 to each of eight addresses, 16-byte aligned. */
KEA_INLINE void lanesScatter(float *const at[KEA_LANES], KeaLanes3 a) {
    KeaLanes r[4] = {a.x, a.y, a.z, {0}};
    lanesTranspose(r);
    for (int i = 0; i < 4; i++) {
        *(KeaQuad *)(void *)at[i] = __builtin_shufflevector(r[i], r[i], 0, 1, 2, 3);
        *(KeaQuad *)(void *)at[i + 4] = __builtin_shufflevector(r[i], r[i], 4, 5, 6, 7);
    }
}

#endif
