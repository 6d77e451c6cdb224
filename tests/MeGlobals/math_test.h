/* Random inputs and comparisons for the tests of MeMath.h. */
#ifndef MATH_TEST_H
#define MATH_TEST_H

#include "karma_test.h"

#include "MeMath.h"

/* C11 has no conversion from MeMatrix4 to const MeMatrix4; every compiler and C23 do. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpedantic"
#endif

#define RANDOM_TRIES 1000

/* Rounding of a few operations with numbers near 1. */
static const double few = TOL(4e-7, 8e-16);

static inline void random_vector(MeVector3 v) {
    for (int i = 0; i < 3; i++)
        v[i] = MeRealRandomInRange(-1, 1);
}

static inline void random_quaternion(MeVector4 q) {
    do {
        for (int i = 0; i < 4; i++)
            q[i] = MeRealRandomInRange(-1, 1);
    } while (MeVector4MagnitudeSqr(q) < (MeReal)0.1);
    MeVector4Scale(q, MeRecipSqrt(MeVector4MagnitudeSqr(q)));
}

static inline void random_matrix3(MeMatrix3 m) {
    for (int i = 0; i < 3; i++)
        random_vector(m[i]);
}

static inline void random_tm(MeMatrix4 tm) {
    MeVector4 q;
    random_quaternion(q);
    MeQuaternionToTM(tm, q);
    random_vector(tm[3]);
}

/* Every one of n numbers within the tolerance. */
static inline void assert_array_near(const MeReal *actual, const MeReal *expected, int n, double tolerance) {
    for (int i = 0; i < n; i++)
        ck_assert_msg(fabs(actual[i] - expected[i]) <= tolerance, "number %d is %.17g, expected %.17g within %.3g", i,
                      actual[i], expected[i], tolerance);
}

/* The same bits (so that -0 is not 0, and NaN is NaN). */
#define assert_same_bits(actual, expected)                                                                             \
    ck_assert_msg(memcmp(actual, expected, sizeof(expected)) == 0, "%s is not %s", #actual, #expected)

#endif
