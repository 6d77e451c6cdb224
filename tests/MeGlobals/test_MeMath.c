/* Numbers, vectors, matrices of any size, packed triangles. */
#include "math_test.h"

static const MeReal huge = TOL((MeReal)1e30, (MeReal)1e300), tiny = TOL((MeReal)1e-30, (MeReal)1e-300);

/* ---- numbers ---- */

TEST(random_numbers_fill_their_range) {
    double min = 9, max = -9, sum = 0;
    int low = 0;
    for (int i = 0; i < 100000; i++) {
        const MeReal x = MeRealRandomInRange(-3, 5);
        min = fmin(min, x);
        max = fmax(max, x);
        sum += (double)x;
        low += x < -1;
    }
    ck_assert(min >= -3 && max <= 5);
    assert_near(min, -3, 1e-3);
    assert_near(max, 5, 1e-3);
    assert_near(sum / 100000, 1, 0.05); /* 7 standard errors */
    assert_near(low / 100000., 0.25, 0.01);
}

TEST(random_numbers_of_odd_ranges) {
    for (int i = 0; i < 100; i++) {
        const MeReal x = MeRealRandomInRange(5, -3);
        ck_assert(x >= -3 && x <= 5);
    }
    ck_assert(MeRealRandomInRange(2, 2) == 2);
    ck_assert(isnan(MeRealRandomInRange(NAN, 1)));
    ck_assert(isfinite(MeRealRandomInRange(-MEINFINITY, MEINFINITY)));
}

TEST(macros_choose_and_round) {
    ck_assert_int_eq(MeMIN(2, 3), 2);
    ck_assert_int_eq(MeMAX(2, 3), 3);
    ck_assert_int_eq(MeMIN3(2, 1, 3), 1);
    ck_assert_int_eq(MeMAX3(2, 1, 3), 3);
    ck_assert_int_eq(MeCLAMP(0, 1, 3), 1);
    ck_assert_int_eq(MeCLAMP(2, 1, 3), 2);
    ck_assert_int_eq(MeCLAMP(4, 1, 3), 3);
    for (int n = 0; n < 200; n++) {
        ck_assert_int_eq(MeMathCEIL4(n), 4 * ((n + 3) / 4));
        ck_assert_int_eq(MeMathCEIL12(n), 12 * ((n + 11) / 12));
        ck_assert_int_eq(MeMathCEIL16(n), 16 * ((n + 15) / 16));
        ck_assert_int_eq(MeMathCEIL64(n), 64 * ((n + 63) / 64));
        ck_assert_int_eq(MeMathFLOOR4(n), n - n % 4);
    }
    ck_assert_int_eq(MeMathCEILN(10, 21), 30);
    assert_near(ME_PI, 3.14159265358979, TOL(1e-7, 1e-14));
}

TEST(indices_go_round) {
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(NextMod4(i), (i + 1) % 4);
        ck_assert_int_eq(PrevMod4(i), (i + 3) % 4);
        ck_assert_int_eq(NextMod3(i % 3), (i % 3 + 1) % 3);
        ck_assert_int_eq(PrevMod3(i % 3), (i % 3 + 2) % 3);
        ck_assert_int_eq(NextMod2(i % 2), (i + 1) % 2);
        ck_assert_int_eq(PrevMod2(i % 2), (i + 1) % 2);
        ck_assert_int_eq(NextModN(i, 7), i + 1);
        ck_assert_int_eq(PrevModN(i, 7), (i + 6) % 7);
    }
    ck_assert_int_eq(NextModN(6, 7), 0);
}

/* All 27 ways for three numbers to be smaller, equal or larger. */
TEST(three_numbers_are_sorted) {
    for (int n = 0; n < 27; n++) {
        const MeReal a[3] = {(MeReal)(n % 3), (MeReal)(n / 3 % 3), (MeReal)(n / 9)};
        MeI32 index[3];
        Sort3(index, a);
        ck_assert_int_eq((1 << index[0]) | (1 << index[1]) | (1 << index[2]), 7);
        for (int i = 0; i < 2; i++) {
            ck_assert(a[index[i]] <= a[index[i + 1]]);
            ck_assert(a[index[i]] < a[index[i + 1]] || index[i] < index[i + 1]);
        }
        ck_assert_int_eq(MinIndex(a), index[0]);
    }
}

TEST(reciprocals_are_finite) {
    ck_assert(MeSafeRecip(4) == (MeReal)0.25);
    ck_assert(MeSafeRecip(-4) == (MeReal)-0.25);
    ck_assert(MeSafeRecip(0) == MEINFINITY);
    ck_assert(MeSafeRecip(-0.0) == MEINFINITY);
    const MeReal smallest = TOL((MeReal)1e-45, (MeReal)5e-324);
    ck_assert(MeSafeRecip(smallest) == MEINFINITY);
    ck_assert(MeSafeRecip(-smallest) == -MEINFINITY);
    ck_assert(MeSafeRecip(INFINITY) == 0);
    ck_assert(isnan(MeSafeRecip(NAN)));
}

TEST(numbers_are_swapped_and_zeroed) {
    MeReal v[4] = {1, 2, 3, 4};
    MeRealSwap(&v[0], &v[3]);
    ck_assert(v[0] == 4 && v[3] == 1);
    MeRealSwap(&v[1], &v[1]);
    ck_assert(v[1] == 2);
    ck_assert(!MeRealArrayIsZero(v, 4));
    MeVectorSetZero(v, 3);
    ck_assert(MeRealArrayIsZero(v, 3));
    ck_assert(!MeRealArrayIsZero(v, 4));
    ck_assert(MeRealArrayIsZero(v + 3, 0));
    v[0] = (MeReal)-0.0;
    ck_assert(MeRealArrayIsZero(v, 3));
    v[0] = (MeReal)NAN;
    ck_assert(!MeRealArrayIsZero(v, 3));
}

/* ---- MeVector3 ---- */

typedef struct {
    void (*function)(MeVector3, const MeVector3, const MeVector3);
    MeVector3 expected;
} Operation3;

/* The result for (1, 2, 3) and (5, 7, -4), and the same when it overwrites either operand. */
TEST(vector_operations_may_alias) {
    static const Operation3 operations[] = {{MeVector3Add, {6, 9, -1}},      {MeVector3Subtract, {-4, -5, 7}},
                                            {MeVector3Cross, {-29, 19, -3}}, {MeVector3MultiplyElements, {5, 14, -12}},
                                            {MeVector3Min, {1, 2, -4}},      {MeVector3Max, {5, 7, 3}}};
    const MeVector3 b = {1, 2, 3}, c = {5, 7, -4};
    for (size_t i = 0; i < sizeof operations / sizeof operations[0]; i++) {
        const Operation3 *const o = &operations[i];
        MeVector3 fresh, overB = {1, 2, 3}, overC = {5, 7, -4};
        o->function(fresh, b, c);
        o->function(overB, overB, c);
        o->function(overC, b, overC);
        assert_same_bits(fresh, o->expected);
        assert_same_bits(overB, o->expected);
        assert_same_bits(overC, o->expected);
    }
}

/* Each component for itself, whichever operand has the larger one, and whatever the others are. */
TEST(smaller_and_larger_components) {
    for (int i = 0; i < 8; i++) {
        MeVector3 b = {1, 10, 100}, c = {2, 20, 200}, min, max;
        for (int j = 0; j < 3; j++) {
            if (i >> j & 1)
                MeRealSwap(&b[j], &c[j]);
        }
        MeVector3Min(min, b, c);
        assert_vec3_near(min, 1, 10, 100, 0);
        MeVector3Max(max, b, c);
        assert_vec3_near(max, 2, 20, 200, 0);
    }
}

TEST(vectors_are_scaled_and_added) {
    const MeVector3 b = {1, 2, 3}, d = {10, 20, 30};
    MeVector3 v;
    MeVector3Set(v, 4, 5, 6);
    assert_vec3_near(v, 4, 5, 6, 0);
    MeVector3Copy(v, b);
    MeVector3Scale(v, 2);
    assert_vec3_near(v, 2, 4, 6, 0);
    MeVector3MultiplyScalar(v, v, 3);
    assert_vec3_near(v, 6, 12, 18, 0);
    MeVector3MultiplyAdd(v, 2, b);
    assert_vec3_near(v, 8, 16, 24, 0);
    MeVector3MultiplySubtract(v, 2, v);
    assert_vec3_near(v, -8, -16, -24, 0);
    MeVector3ScaleAndAdd(v, b, 2, d);
    assert_vec3_near(v, 12, 24, 36, 0);
    MeVector3ScaleAndAdd(v, d, 3, v);
    assert_vec3_near(v, 42, 84, 126, 0);
    MeVector3Clamp(v, 50, 100);
    assert_vec3_near(v, 50, 84, 100, 0);
}

TEST(vectors_are_swapped) {
    MeVector3 a = {1, 2, 3}, b = {4, 5, 6};
    MeVector3Swap(a, b);
    assert_vec3_near(a, 4, 5, 6, 0);
    assert_vec3_near(b, 1, 2, 3, 0);
    MeVector3Swap(a, a);
    assert_vec3_near(a, 4, 5, 6, 0);
}

TEST(lerp_meets_its_ends) {
    const MeVector3 from = {0.1, 0.7, -3}, to = {1e6, 0.3, 5};
    MeVector3 v;
    MeVector3Lerp(v, from, to, 0);
    assert_same_bits(v, from);
    MeVector3Lerp(v, from, to, 1);
    assert_same_bits(v, to);
    MeVector3Lerp(v, from, to, 0.25);
    assert_near(v[2], -1, 0);
    MeVector3Lerp(v, v, to, 2);
    assert_near(v[2], 11, 0);
}

TEST(products_of_vectors) {
    const MeVector3 x = {2, 0, 0}, y = {0, 3, 0}, z = {0, 0, 4}, v = {1, 2, 3};
    MeMatrix3 m;
    ck_assert(MeVector3Dot(v, v) == 14);
    ck_assert(MeVector3MagnitudeSqr(v) == 14);
    ck_assert(MeVector3ScalarTripleProduct(x, y, z) == 24);
    ck_assert(MeVector3ScalarTripleProduct(y, x, z) == -24);
    ck_assert(MeVector3AreaOfTriangle(x, y) == 3);
    ck_assert(MeVector3AreaOfTriangle(x, x) == 0);
    MeVector3OuterProduct(m, v, z);
    for (int i = 0; i < 3; i++)
        assert_vec3_near(m[i], 0, 0, 4 * v[i], 0);
    MeVector3Set(m[1], 1, 2, 3);
    MeVector3OuterProduct(m, m[1], m[1]);
    for (int i = 0; i < 3; i++)
        assert_vec3_near(m[i], v[i], 2 * v[i], 3 * v[i], 0);
}

TEST(cross_products_with_axes) {
    for (int axis = 0; axis < 3; axis++) {
        const MeVector3 v = {1, 2, 3};
        MeVector3 e = {0, 0, 0}, expected, actual = {1, 2, 3};
        e[axis] = 1;
        MeVector3Cross(expected, v, e);
        MeVector3CrossAxis(actual, actual, axis);
        assert_array_near(actual, expected, 3, 0);
    }
}

TEST(lengths_do_not_overflow) {
    static const MeReal scales[] = {1, TOL((MeReal)1e30, (MeReal)1e300), TOL((MeReal)1e-30, (MeReal)1e-300), 1000};
    for (int i = 0; i < 4; i++) {
        const MeReal s = scales[i];
        const MeVector3 v = {3 * s, -4 * s, 12 * s}, w = {6 * s, -8 * s, 24 * s};
        assert_near_rel(MeVector3Magnitude(v), 13 * s, TOL(2e-7, 4e-16));
        assert_near_rel(MeVector3Distance(v, w), 13 * s, TOL(2e-7, 4e-16));
    }
    const MeVector3 v = {3, -4, 12}, w = {1, 2, 3}, zero = {0, 0, 0};
    ck_assert(MeVector3DistanceSqr(v, w) == 4 + 36 + 81);
    ck_assert(MeVector3Magnitude(zero) == 0);
}

TEST(lengths_of_what_is_not_finite) {
    const MeVector3 notANumber = {0, NAN, 1}, infinite = {0, -INFINITY, 1};
    ck_assert(isnan(MeVector3Magnitude(notANumber)));
    ck_assert(isinf(MeVector3Magnitude(infinite)));
}

TEST(normalized_vectors_are_unit) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 v, unit;
        random_vector(v);
        MeVector3Copy(unit, v);
        const MeReal length = MeVector3Normalize(unit);
        assert_near_rel(length, MeVector3Magnitude(v), 0);
        assert_near(MeVector3MagnitudeSqr(unit), 1, few);
        for (int j = 0; j < 3; j++)
            assert_near(unit[j] * length, v[j], TOL(1e-7, 3e-16));
    }
}

TEST(vectors_of_extreme_length_are_normalized) {
    MeVector3 large = {3 * huge, 0, -4 * huge}, small = {3 * tiny, 0, -4 * tiny};
    assert_near_rel(MeVector3Normalize(large), 5 * huge, TOL(2e-7, 4e-16));
    assert_vec3_near(large, 0.6, 0, -0.8, few);
    assert_near_rel(MeVector3Normalize(small), 5 * tiny, TOL(2e-7, 4e-16));
    assert_vec3_near(small, 0.6, 0, -0.8, few);

    MeVector3 largest = {MEINFINITY, MEINFINITY, -MEINFINITY}, smallest = {0, TOL((MeReal)1e-45, (MeReal)5e-324), 0};
    ck_assert(MeVector3Normalize(largest) == MEINFINITY);
    assert_vec3_near(largest, sqrt(1. / 3), sqrt(1. / 3), -sqrt(1. / 3), few);
    ck_assert(MeVector3Normalize(smallest) > 0);
    assert_vec3_near(smallest, 0, 1, 0, 0);
}

TEST(vectors_without_direction_stay) {
    static const MeVector3 vectors[] = {
        {0, 0, 0}, {1, NAN, 2}, {NAN, INFINITY, 0}, {1, 2, INFINITY}, {-INFINITY, 0, 0}};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        MeVector3 v;
        MeVector3Copy(v, vectors[i]);
        ck_assert(MeVector3Normalize(v) == 0);
        assert_same_bits(v, vectors[i]);
    }
}

TEST(vectors_are_made_orthogonal) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 v, v1, n, along;
        random_vector(v);
        random_vector(v1);
        MeVector3Copy(n, v1);
        MeVector3Normalize(n);
        MeVector3MultiplyScalar(along, n, MeVector3Dot(v, n));
        MeVector3Subtract(along, v, along);
        MeVector3MakeOrthogonal(v, v1);
        assert_near(MeVector3Dot(v, n), 0, TOL(2e-7, 4e-16) * (double)MeVector3Magnitude(v));
        assert_array_near(v, along, 3, few);
    }
}

/* What is left is small, but still at right angles for its size. */
TEST(nearly_parallel_vectors_are_made_orthogonal) {
    const MeVector3 v1 = {1 * huge, 2 * huge, 3 * huge};
    MeVector3 v = {100.01, 200, 300}, n = {1, 2, 3};
    MeVector3MakeOrthogonal(v, v1);
    MeVector3Normalize(n);
    assert_near(MeVector3Dot(v, n), 0, TOL(2e-7, 4e-16) * (double)MeVector3Magnitude(v));
    assert_near(MeVector3Magnitude(v), 0.01 * sqrt(13. / 14), TOL(5e-5, 5e-14));
}

TEST(orthogonal_to_nothing_changes_nothing) {
    const MeVector3 zero = {0, 0, 0}, before = {1, 2, 3};
    MeVector3 v = {1, 2, 3};
    MeVector3MakeOrthogonal(v, zero);
    assert_same_bits(v, before);
    MeVector3MakeOrthogonal(v, v);
    assert_vec3_near(v, 0, 0, 0, few);
}

static void assertPlaneSpace(const MeVector3 n) {
    MeVector3 a, b, cross;
    MeVector3PlaneSpace(n, a, b);
    assert_near(MeVector3MagnitudeSqr(a), 1, few);
    assert_near(MeVector3MagnitudeSqr(b), 1, few);
    assert_near(MeVector3Dot(a, b), 0, few);
    assert_near(MeVector3Dot(a, n), 0, few);
    assert_near(MeVector3Dot(b, n), 0, few);
    MeVector3Cross(cross, n, a);
    assert_array_near(cross, b, 3, few);

    MeVector3 other, overA, overB;
    MeVector3Copy(overA, n);
    MeVector3PlaneSpace(overA, overA, other);
    assert_same_bits(overA, a);
    MeVector3Copy(overB, n);
    MeVector3PlaneSpace(overB, other, overB);
    assert_same_bits(overB, b);
}

TEST(plane_spaces_are_right_handed_frames) {
    for (int axis = 0; axis < 3; axis++) {
        MeVector3 n = {0, 0, 0};
        n[axis] = 1;
        assertPlaneSpace(n);
        n[axis] = -1;
        assertPlaneSpace(n);
        n[2] = axis == 2 ? n[2] : -tiny;
        assertPlaneSpace(n);
    }
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 n;
        random_vector(n);
        n[2] *= i % 2 ? 1 : (MeReal)1e-4;
        if (MeVector3Normalize(n) > 0)
            assertPlaneSpace(n);
    }
    const MeVector3 z = {0, 0, 1};
    MeVector3 a, b;
    MeVector3PlaneSpace(z, a, b);
    assert_vec3_near(a, 1, 0, 0, 0);
    assert_vec3_near(b, 0, 1, 0, 0);
}

/* A small turn of n, on one side of the equator, turns a and b little. */
TEST(plane_spaces_turn_smoothly) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 n, m, step, a, b, c, d;
        random_vector(n);
        random_vector(step);
        if (MeVector3Normalize(n) == 0 || MeFabs(n[2]) < (MeReal)0.01)
            continue;
        MeVector3ScaleAndAdd(m, step, 1e-3, n);
        MeVector3Normalize(m);
        MeVector3PlaneSpace(n, a, b);
        MeVector3PlaneSpace(m, c, d);
        assert_below(MeVector3Distance(a, c), 6e-3);
        assert_below(MeVector3Distance(b, d), 6e-3);
    }
}

/* ---- MeVector4 ---- */

TEST(four_components_count_alike) {
    const MeVector4 b = {1, 2, 3, 4}, c = {10, 20, 30, 40};
    const MeVector4 sum = {11, 22, 33, 44}, difference = {-9, -18, -27, -36}, product = {10, 40, 90, 160};
    const MeVector4 clamped = {20, 40, 50, 50};
    MeVector4 v;
    MeVector4Copy(v, b);
    MeVector4Add(v, v, c);
    assert_same_bits(v, sum);
    MeVector4Copy(v, c);
    MeVector4Subtract(v, b, v);
    assert_same_bits(v, difference);
    MeVector4Copy(v, b);
    MeVector4MultiplyElements(v, v, c);
    assert_same_bits(v, product);
    ck_assert(MeVector4Dot(b, c) == 300);
    ck_assert(MeVector4MagnitudeSqr(b) == 30);
    MeVector4Copy(v, c);
    MeVector4Scale(v, 2);
    MeVector4Clamp(v, 20, 50);
    assert_same_bits(v, clamped);
}

/* ---- matrices of any size ---- */

static const MeReal twoByThree[6] = {1, 2, 3, 4, 5, 6}, threeByTwo[6] = {1, 4, 2, 5, 3, 6};

TEST(matrices_of_any_size_are_multiplied) {
    const MeReal threeByFour[12] = {1, 0, 2, -1, 0, 1, 3, 2, 5, 0, 1, 1};
    const MeReal expected[8] = {16, 2, 11, 6, 34, 5, 29, 12};
    MeReal a[8];
    MeMatrixMultiply(a, 2, 3, 4, twoByThree, threeByFour);
    assert_same_bits(a, expected);
    MeVectorSetZero(a, 8);
    MeMatrixMultiplyT1(a, 2, 3, 4, threeByTwo, threeByFour);
    assert_same_bits(a, expected);
}

TEST(matrices_of_any_size_are_transposed) {
    MeReal a[6];
    MeMatrixTranspose(a, 2, 3, twoByThree);
    assert_same_bits(a, threeByTwo);
    MeMatrixTranspose(a, 3, 2, threeByTwo);
    assert_same_bits(a, twoByThree);
}

TEST(matrices_are_printed) {
    char text[64] = "";
    FILE *const file = tmpfile();
    ck_assert_ptr_nonnull(file);
    MeMatrixFPrint(file, twoByThree, 2, 3, "%.1f;");
    MeMatrixFPrint(file, twoByThree, 1, 2, NULL);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    ck_assert_str_eq(text, "1.0;2.0;3.0;\n4.0;5.0;6.0;\n1 2 \n");
    MeMatrixPrint(twoByThree, 0, 3, NULL);
}

/* ---- packed triangles ---- */

TEST(triangles_are_packed_row_by_row) {
    for (int n = 0; n < 6; n++) {
        int upper = 0, super = 0;
        for (int i = 0; i < n; i++) {
            for (int j = i; j < n; j++) {
                ck_assert_int_eq(MeUpperDiagonalIndex(i, j, n), upper);
                ck_assert_int_eq(MeSymUpperDiagonalIndex(i, j, n), upper);
                ck_assert_int_eq(MeSymUpperDiagonalIndex(j, i, n), upper++);
                if (i == j)
                    continue;
                ck_assert_int_eq(MeSuperDiagonalIndex(i, j, n), super);
                ck_assert_int_eq(MeSymSuperDiagonalIndex(i, j, n), super);
                ck_assert_int_eq(MeSymSuperDiagonalIndex(j, i, n), super++);
            }
        }
        ck_assert_int_eq(MeUpperDiagonalSize(n), upper);
        ck_assert_int_eq(MeSuperDiagonalSize(n), super);
    }
}

TEST(places_outside_a_triangle_warn) {
    ck_assert_int_eq(MeUpperDiagonalIndex(2, 1, 4), -1);
    assert_warned("MeUpperDiagonalIndex");
    ck_assert_int_eq(MeUpperDiagonalIndex(-1, 1, 4), -1);
    assert_warned("MeUpperDiagonalIndex");
    ck_assert_int_eq(MeSymUpperDiagonalIndex(4, 1, 4), -1);
    assert_warned("MeSymUpperDiagonalIndex");
    ck_assert_int_eq(MeSuperDiagonalIndex(1, 1, 4), -1);
    assert_warned("MeSuperDiagonalIndex");
    ck_assert_int_eq(MeSymSuperDiagonalIndex(2, 2, 4), -1);
    assert_warned("MeSymSuperDiagonalIndex");
}
