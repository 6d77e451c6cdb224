/* The number type and its macros, and the version. */
#include "karma_test.h"

#include "MeVersion.h"

TEST(types_have_their_sizes) {
    ck_assert_uint_eq(sizeof(MeReal), TOL(4, 8));
    ck_assert_uint_eq(sizeof(MeVector3), 3 * sizeof(MeReal));
    ck_assert_uint_eq(sizeof(MeVector4), 4 * sizeof(MeReal));
    ck_assert_uint_eq(sizeof(MeMatrix3), 9 * sizeof(MeReal));
    ck_assert_uint_eq(sizeof(MeMatrix4), 16 * sizeof(MeReal));
    ck_assert_uint_eq(sizeof(MeI8), 1);
    ck_assert_uint_eq(sizeof(MeU16), 2);
    ck_assert_uint_eq(sizeof(MeI32), 4);
    ck_assert_uint_eq(sizeof(MeU64), 8);
    ck_assert_uint_eq(sizeof(AcmeReal), 4);
}

TEST(functions_are_of_the_right_precision) {
    ck_assert_uint_eq(sizeof(MeSqrt((MeReal)2)), sizeof(MeReal));
    assert_near(MeSqrt((MeReal)2), sqrt(2), TOL(1e-7, 2e-16));
    assert_near(MeAtan2(1, -1), 0.75 * acos(-1), TOL(2e-7, 5e-16));
    assert_near(MeTan(MeAtan(0.5)), 0.5, TOL(1e-7, 2e-16));
    assert_near(MeSin(MeAsin(0.5)), 0.5, TOL(1e-7, 2e-16));
    assert_near(MeCos(MeAcos(0.5)), 0.5, TOL(2e-7, 3e-16));
    assert_near(MeFabs((MeReal)-3), 3, 0);
    assert_near(MeRecip(4), 0.25, 0);
    assert_near(MeRecipSqrt(4), 0.5, 0);
    assert_near(MeSqr(3), 9, 0);
}

TEST(epsilon_is_the_distance_to_the_next_number) {
    const volatile MeReal next = 1 + ME_EPSILON, same = 1 + ME_EPSILON / 2;
    ck_assert(next > 1);
    ck_assert(same == 1);
    ck_assert(MeRealIsValid(MEINFINITY));
    ck_assert(!MeRealIsValid(2 * MEINFINITY));
    ck_assert(!MeRealIsValid(NAN));
    ck_assert(ME_EPSILON < ME_MIN_EPSILON && ME_MIN_EPSILON < ME_SMALL_EPSILON);
    ck_assert(ME_SMALL_EPSILON < ME_MEDIUM_EPSILON);
}

TEST(comparisons_with_a_tolerance) {
    MeVector4 v = {0, 0, 0, 0};
    const MeReal below = ME_SMALL_EPSILON / 2, above = 2 * ME_SMALL_EPSILON;
    for (int i = 0; i < 4; i++) {
        v[i] = below;
        ck_assert(ME_IS_ZERO(v[i]) && ME_IS_ZERO_3VEC(v) && ME_IS_ZERO_4VEC(v));
        v[i] = -above;
        ck_assert(!ME_IS_ZERO(v[i]));
        ck_assert(ME_IS_ZERO_3VEC(v) == (i == 3) && !ME_IS_ZERO_4VEC(v));
        v[i] = 0;
    }
    MeVector4 a = {1, 2, 3, 4}, b = {1, 2, 3, 4};
    for (int i = 0; i < 4; i++) {
        b[i] += (MeReal)0.1;
        ck_assert(!ME_ARE_EQUAL(a[i], b[i]) && ME_ARE_EQUAL_TOL(a[i], b[i], (MeReal)0.2));
        ck_assert(ME_ARE_EQUAL_3VEC(a, b) == (i == 3) && !ME_ARE_EQUAL_4VEC(a, b));
        ck_assert(ME_ARE_EQUAL_3VEC_TOL(a, b, (MeReal)0.2) && ME_ARE_EQUAL_4VEC_TOL(a, b, (MeReal)0.2));
        b[i] = a[i];
    }
    a[0] = (MeReal)NAN;
    ck_assert(!ME_IS_ZERO(a[0]) && !ME_ARE_EQUAL_3VEC(a, a));
}

TEST(aligned_data) {
    static MeALIGNDATA(MeMatrix4, tm, 16) = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    ck_assert_uint_eq((size_t)tm % 16, 0);
    ck_assert(tm[2][2] == 1);
}

TEST(version_names_product_and_precision) {
    char expected[64];
    snprintf(expected, sizeof expected, "%s %d.%d.%d%s (%s precision)", ME_PRODUCT_NAME, ME_PRODUCTVERSION_MAJOR,
             ME_PRODUCTVERSION_MINOR, ME_PRODUCTVERSION_REV, ME_PRODUCTVERSION_QUALIFIER,
             sizeof(MeReal) == 4 ? "single" : "double");
    ck_assert_str_eq(MeToolkitVersionString(), expected);
}
