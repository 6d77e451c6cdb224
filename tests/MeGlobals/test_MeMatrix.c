/* Matrices of 3 x 3 and 4 x 4 numbers, and rotations as 3 x 3 matrices. */
#include "math_test.h"

static const MeMatrix3 B = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, C = {{2, 0, 1}, {0, 1, -1}, {3, 1, 0}};

/* ---- MeMatrix3 ---- */

typedef struct {
    void (*function)(MeMatrix3, const MeMatrix3, const MeMatrix3);
    MeMatrix3 expected;
} Operation;

TEST(matrix3_operations_may_alias) {
    static const Operation operations[] = {
        {MeMatrix3Add, {{3, 2, 4}, {4, 6, 5}, {10, 9, 10}}},
        {MeMatrix3Subtract, {{-1, 2, 2}, {4, 4, 7}, {4, 7, 10}}},
        {MeMatrix3MultiplyMatrix, {{11, 5, -1}, {26, 11, -1}, {44, 18, -1}}},
    };
    for (size_t i = 0; i < sizeof operations / sizeof operations[0]; i++) {
        const Operation *const o = &operations[i];
        MeMatrix3 fresh, overB, overC;
        MeMatrix3Copy(overB, B);
        MeMatrix3Copy(overC, C);
        o->function(fresh, B, C);
        o->function(overB, overB, C);
        o->function(overC, B, overC);
        assert_same_bits(fresh, o->expected);
        assert_same_bits(overB, o->expected);
        assert_same_bits(overC, o->expected);
    }
}

TEST(matrix3_multiplies_columns) {
    MeVector3 v = {1, 0, 2};
    MeMatrix3MultiplyVector(v, B, v);
    assert_vec3_near(v, 7, 16, 27, 0);
}

TEST(matrix3_is_made_scaled_and_transposed) {
    MeMatrix3 a;
    const MeMatrix3 identity = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const MeMatrix3 transposed = {{1, 4, 7}, {2, 5, 8}, {3, 6, 10}};
    const MeMatrix3 doubled = {{2, 8, 14}, {4, 10, 16}, {6, 12, 20}};
    const MeMatrix3 turned = {{4, 10, 16}, {6, 12, 20}, {2, 8, 14}};
    MeMatrix3MakeIdentity(a);
    assert_same_bits(a, identity);
    MeMatrix3Copy(a, B);
    MeMatrix3Transpose(a);
    assert_same_bits(a, transposed);
    MeMatrix3Scale(a, 2);
    assert_same_bits(a, doubled);
    ck_assert(MeMatrix3Trace(a) == 32);
    MeMatrix3CopyVec(a, a[1], a[2], a[0]);
    assert_same_bits(a, turned);
}

TEST(columns_are_swapped) {
    MeMatrix3 a;
    const MeMatrix3 expected = {{3, 2, 1}, {6, 5, 4}, {10, 8, 7}};
    MeMatrix3Copy(a, B);
    MeMatrix3SwapColumns(a, 0, 2);
    assert_same_bits(a, expected);
    MeMatrix3SwapColumns(a, 1, 1);
    assert_same_bits(a, expected);
    assert_silent();
    assert_refused(MeMatrix3SwapColumns, a, 1, 3);
    assert_refused(MeMatrix3SwapColumns, a, 3, 1);
    assert_same_bits(a, expected);
}

TEST(cross_product_matrix) {
    const MeVector3 a = {1, 2, 3}, v = {-2, 5, 4};
    MeMatrix3 m;
    MeVector3 expected, actual;
    MeVector3Cross(expected, a, v);
    MeVector3Scale(expected, -2);
    MeMatrix3CrossFromVector(a, -2, m[0], m[1], m[2]);
    MeMatrix3MultiplyVector(actual, m, v);
    assert_array_near(actual, expected, 3, 0);
    MeVector3Copy(m[1], a);
    MeMatrix3CrossFromVector(m[1], -2, m[0], m[1], m[2]);
    MeMatrix3MultiplyVector(actual, m, v);
    assert_array_near(actual, expected, 3, 0);
}

TEST(inverse_of_a_known_matrix) {
    MeMatrix3 a;
    const MeMatrix3 expected = {
        {(MeReal)(-2. / 3), (MeReal)(-4. / 3), 1}, {(MeReal)(-2. / 3), (MeReal)(11. / 3), -2}, {1, -2, 1}};
    MeMatrix3Copy(a, B);
    ck_assert(MeMatrix3Invert(a) == METRUE);
    assert_array_near(a[0], expected[0], 9, TOL(2e-5, 4e-14)); /* condition 90 */
}

/* Whatever the units of the rows. */
TEST(inverse_undoes_a_matrix) {
    static const MeReal units[3] = {TOL((MeReal)1e-20, (MeReal)1e-200), 1, TOL((MeReal)1e15, (MeReal)1e150)};
    int inverted = 0;
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix3 a, inverse, product;
        random_matrix3(a);
        if (MeFabs(MeVector3ScalarTripleProduct(a[0], a[1], a[2])) < (MeReal)0.1)
            continue;
        for (int j = 0; j < 3; j++)
            MeVector3Scale(a[j], units[(i + j) % 3]);
        MeMatrix3Copy(inverse, a);
        ck_assert(MeMatrix3Invert(inverse) == METRUE);
        for (int j = 0; j < 3; j++)
            MeVector3Scale(a[j], 1 / units[(i + j) % 3]);
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++)
                inverse[k][j] *= units[(i + j) % 3];
        }
        MeMatrix3MultiplyMatrix(product, a, inverse);
        ck_assert(MeMatrix3IsIdentity(product, TOL((MeReal)1e-5, (MeReal)2e-14)));
        inverted++;
    }
    ck_assert_int_gt(inverted, RANDOM_TRIES / 2);
}

TEST(singular_matrices_stay) {
    static const MeMatrix3 singular[] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
        {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}},
        {{1, 2, 3}, {(MeReal)1e-10, (MeReal)2e-10, (MeReal)3e-10}, {1, 0, 0}},
        {{1, 2, 3}, {0, 0, 0}, {1, 0, 0}},
        {{0, 2, 3}, {0, 1, 7}, {0, 0, 1}},
        {{1, 0, 0}, {0, 1, 0}, {1, 1, ME_EPSILON}},
        {{1, 0, 0}, {0, (MeReal)NAN, 0}, {0, 0, 1}},
        {{1, 0, 0}, {0, 1, 0}, {(MeReal)INFINITY, 0, 1}},
        {{1, 0, 0}, {0, TOL((MeReal)1e-45, (MeReal)5e-324), 0}, {0, 0, 1}}, /* its inverse is not to be had */
        {{0, TOL((MeReal)1e-45, (MeReal)5e-324), 0}, {1, 0, 0}, {0, 0, 1}},
    };
    for (size_t i = 0; i < sizeof singular / sizeof singular[0]; i++) {
        MeMatrix3 a;
        MeMatrix3Copy(a, singular[i]);
        ck_assert(MeMatrix3Invert(a) == MEFALSE);
        assert_same_bits(a, singular[i]);
    }
}

/* Small, but far from singular: the inertia of a grain in kilogram square metres. */
TEST(small_inertia_is_inverted) {
    MeMatrix3 a = {{2e-30, 0, 0}, {0, 4e-30, 0}, {0, 0, 5e-30}};
    ck_assert(MeMatrix3SymmetricInvert(a) == METRUE);
    assert_near_rel(a[0][0], 5e29, few);
    assert_near_rel(a[1][1], 2.5e29, few);
    assert_near_rel(a[2][2], 2e29, few);
    ck_assert(a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0);
}

TEST(symmetric_inverse_reads_one_triangle) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix3 a, inverse, product;
        random_matrix3(a);
        for (int j = 0; j < 3; j++) {
            a[j][j] = 3 + a[j][j];
            for (int k = 0; k < j; k++)
                a[j][k] = a[k][j];
        }
        MeMatrix3Copy(inverse, a);
        inverse[1][0] = inverse[2][0] = inverse[2][1] = (MeReal)NAN;
        ck_assert(MeMatrix3SymmetricInvert(inverse) == METRUE);
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < j; k++)
                ck_assert(inverse[j][k] == inverse[k][j]);
        }
        MeMatrix3MultiplyMatrix(product, a, inverse);
        ck_assert(MeMatrix3IsIdentity(product, TOL((MeReal)2e-6, (MeReal)4e-15)));
    }
}

TEST(singular_symmetric_matrices_stay) {
    const MeMatrix3 before = {{1, 2, 3}, {9, 4, 6}, {9, 9, 9}}; /* the upper triangle of an outer product */
    MeMatrix3 a;
    MeMatrix3Copy(a, before);
    ck_assert(MeMatrix3SymmetricInvert(a) == MEFALSE);
    assert_same_bits(a, before);
}

static void assertDecomposition(MeMatrix3 l, MeMatrix3 u, const MeMatrix3 a, const unsigned int *swapped) {
    MeMatrix3 pa, product;
    MeMatrix3Copy(pa, a);
    for (unsigned int k = 0; k < 3; k++) {
        ck_assert_uint_ge(swapped[k], k);
        ck_assert_uint_lt(swapped[k], 3);
        MeVector3Swap(pa[k], pa[swapped[k]]);
        ck_assert(l[k][k] == 1);
        for (unsigned int j = k + 1; j < 3; j++)
            ck_assert(l[k][j] == 0 && u[j][k] == 0);
    }
    MeMatrix3MultiplyMatrix(product, l, u);
    assert_array_near(product[0], pa[0], 9, few);
}

TEST(matrices_are_factored) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix3 a, l, u, overL, overU;
        MeVector3 scale;
        unsigned int swapped[3];
        random_matrix3(a);
        if (i % 4 == 0)
            MeVector3Copy(a[2], a[0]);
        if (i % 8 == 0)
            MeVectorSetZero(a[1], 3);
        MeMatrix3LUDecompose(l, u, a, swapped, scale);
        assertDecomposition(l, u, a, swapped);
        for (int j = 0; j < 3; j++) {
            const MeReal largest = MeMAX3(MeFabs(a[j][0]), MeFabs(a[j][1]), MeFabs(a[j][2]));
            ck_assert(scale[j] == MeSafeRecip(largest));
        }
        MeMatrix3Copy(overL, a);
        MeMatrix3LUDecompose(overL, u, overL, swapped, scale);
        assertDecomposition(overL, u, a, swapped);
        MeMatrix3Copy(overU, a);
        MeMatrix3LUDecompose(l, overU, overU, swapped, scale);
        assertDecomposition(l, overU, a, swapped);
    }
}

TEST(pivots_do_not_depend_on_units) {
    MeMatrix3 a = {{10, 1e6, 0}, {1, 1, 1}, {0, 1, 2}}, l, u;
    MeVector3 scale;
    unsigned int swapped[3];
    MeMatrix3LUDecompose(l, u, a, swapped, scale);
    ck_assert_uint_eq(swapped[0], 1);
}

TEST(identity_is_recognized) {
    MeMatrix3 a;
    MeMatrix4 b;
    MeMatrix3MakeIdentity(a);
    MeMatrix4TMMakeIdentity(b);
    ck_assert(MeMatrix3IsIdentity(a, 0) && MeMatrix4IsIdentity(b, 0));
    a[1][2] = b[3][0] = (MeReal)-0.01;
    ck_assert(MeMatrix3IsIdentity(a, 0.011) && MeMatrix4IsIdentity(b, 0.011));
    ck_assert(!MeMatrix3IsIdentity(a, 0.009) && !MeMatrix4IsIdentity(b, 0.009));
    a[1][2] = b[3][0] = (MeReal)NAN;
    ck_assert(!MeMatrix3IsIdentity(a, 1) && !MeMatrix4IsIdentity(b, 1));
}

TEST(isotropic_inertia_is_recognized) {
    MeMatrix3 a;
    MeMatrix3MakeIdentity(a);
    MeMatrix3Scale(a, 1e-20);
    ck_assert(MeMatrix3IsIsotropic(a));
    a[1][1] *= 1 + ME_SMALL_EPSILON / 2;
    ck_assert(MeMatrix3IsIsotropic(a));
    a[1][1] *= 1 + 2 * ME_SMALL_EPSILON;
    ck_assert(!MeMatrix3IsIsotropic(a));
    for (int i = 0; i < 3; i++) { /* the tolerance is relative to the largest, and one must differ much to be it */
        MeMatrix3MakeIdentity(a);
        a[i][i] = 1000;
        ck_assert(!MeMatrix3IsIsotropic(a));
    }
    MeMatrix3MakeIdentity(a);
    MeMatrix3Scale(a, 1e-20);
    a[0][2] = (MeReal)1e-22;
    ck_assert(!MeMatrix3IsIsotropic(a));
    a[0][2] = (MeReal)NAN;
    ck_assert(!MeMatrix3IsIsotropic(a));
}

/* ---- rotations ---- */

static const MeReal quarter = ME_PI / 2;

TEST(quarter_turns_are_positive) {
    static void (*const make[3])(MeMatrix3, const MeReal) = {MeMatrix3MakeRotationX, MeMatrix3MakeRotationY,
                                                             MeMatrix3MakeRotationZ};
    for (int axis = 0; axis < 3; axis++) {
        MeMatrix3 m;
        MeVector3 from = {0, 0, 0}, to = {0, 0, 0}, along = {0, 0, 0}, v;
        from[NextMod3(axis)] = to[PrevMod3(axis)] = along[axis] = 1; /* y to z, z to x, x to y */
        make[axis](m, quarter);
        MeMatrix3MultiplyVector(v, m, from);
        assert_array_near(v, to, 3, few);
        MeMatrix3MultiplyVector(v, m, along);
        assert_array_near(v, along, 3, 0);
    }
}

/* As they are written with ME_PI, in single precision; what is off by more than its rounding stays so. */
TEST(quarter_turns_are_exact) {
    const double rounding = TOL(0, 4e-15);
    static const MeReal cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
    for (int turns = -9; turns <= 9; turns++) {
        const MeReal angle = (MeReal)turns * ME_PI / 2, c = cosine[(turns + 12) % 4], s = sine[(turns + 12) % 4];
        const MeReal off = angle * (1 + 3 * ME_EPSILON);
        const MeMatrix3 expected = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
        MeMatrix3 m;
        MeVector4 q;
        MeMatrix3MakeRotationZ(m, angle);
        assert_array_near(m[0], expected[0], 9, rounding);
        MeMatrix3FromEulerAngles(m, 0, 0, angle);
        assert_array_near(m[0], expected[0], 9, rounding);
        MeQuaternionMake(q, expected[2], 2 * angle);
        assert_near(q[0], c, rounding);
        assert_near(q[3], s, rounding);
        MeMatrix3MakeRotationZ(m, off);
        ck_assert(m[0][0] == MeCos(off) && m[1][0] == MeSin(off));
        ck_assert(turns == 0 || (m[0][0] != 0 && m[1][0] != 0));
    }
}

TEST(rotation_about_z_by_hand) {
    MeMatrix3 m;
    const MeReal c = MeCos(0.3), s = MeSin(0.3);
    const MeMatrix3 expected = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    MeMatrix3MakeRotationZ(m, 0.3);
    assert_array_near(m[0], expected[0], 9, 0);
}

TEST(euler_angles_turn_about_x_then_y_then_z) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 angles;
        MeMatrix3 x, y, z, expected, actual;
        random_vector(angles);
        MeVector3Scale(angles, 4);
        MeMatrix3MakeRotationX(x, angles[0]);
        MeMatrix3MakeRotationY(y, angles[1]);
        MeMatrix3MakeRotationZ(z, angles[2]);
        MeMatrix3MultiplyMatrix(expected, y, x);
        MeMatrix3MultiplyMatrix(expected, z, expected);
        MeMatrix3FromEulerAngles(actual, angles[0], angles[1], angles[2]);
        assert_array_near(actual[0], expected[0], 9, few);
    }
}

TEST(orientation_matrices_are_recognized) {
    MeMatrix3 good, bad;
    MeMatrix3FromEulerAngles(good, 1, 2, 3);
    ck_assert(MeMatrix3IsValidOrientationMatrix(good, few));
    MeMatrix3Copy(bad, good);
    MeMatrix3Scale(bad, 1.01);
    ck_assert(!MeMatrix3IsValidOrientationMatrix(bad, 0.015));
    ck_assert(MeMatrix3IsValidOrientationMatrix(bad, 0.025));
    MeMatrix3Copy(bad, good);
    MeVector3MultiplyAdd(bad[0], 0.01, bad[1]);
    ck_assert(!MeMatrix3IsValidOrientationMatrix(bad, 0.005));
    MeMatrix3Copy(bad, good);
    MeVector3Scale(bad[2], -1);
    ck_assert(!MeMatrix3IsValidOrientationMatrix(bad, 0.1));
    MeMatrix3Copy(bad, good);
    bad[1][1] = (MeReal)NAN;
    ck_assert(!MeMatrix3IsValidOrientationMatrix(bad, 0.1));
}

/* ---- MeMatrix4 ---- */

static const MeMatrix4 D = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
static const MeMatrix4 E = {{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {2, 0, 0, 0}};

TEST(matrix4_is_added_and_multiplied) {
    const MeMatrix4 product = {{8, 1, 2, 3}, {16, 5, 6, 7}, {24, 9, 10, 11}, {32, 13, 14, 15}};
    const MeMatrix4 sum = {{1, 3, 3, 4}, {5, 6, 8, 8}, {9, 10, 11, 13}, {15, 14, 15, 16}};
    MeMatrix4 a;
    MeMatrix4MultiplyMatrix(a, D, E);
    assert_same_bits(a, product);
    MeMatrix4Copy(a, D);
    MeMatrix4MultiplyMatrix(a, a, E);
    assert_same_bits(a, product);
    MeMatrix4Copy(a, E);
    MeMatrix4MultiplyMatrix(a, D, a);
    assert_same_bits(a, product);
    MeMatrix4Copy(a, E);
    MeMatrix4Add(a, D, a);
    assert_same_bits(a, sum);
}

TEST(matrix4_multiplies_columns) {
    MeVector4 v = {1, 0, 0, 2};
    const MeVector4 expected = {9, 21, 33, 45};
    MeMatrix4MultiplyVector(v, D, v);
    assert_same_bits(v, expected);
}

TEST(matrix4_is_copied_zeroed_and_transposed) {
    MeALIGNDATA(MeMatrix4, a, 16);
    const MeMatrix4 transposed = {{1, 5, 9, 13}, {2, 6, 10, 14}, {3, 7, 11, 15}, {4, 8, 12, 16}};
    MeMatrix4CopyAligned(a, D);
    assert_same_bits(a, D);
    MeMatrix4Transpose(a);
    assert_same_bits(a, transposed);
    ck_assert(!MeMatrix4IsZero(a));
    MeMatrix4SetZero(a);
    ck_assert(MeMatrix4IsZero(a));
    a[3][3] = (MeReal)NAN;
    ck_assert(!MeMatrix4IsZero(a));
}

TEST(transforms_are_recognized) {
    MeMatrix4 good, bad;
    MeMatrix4TMFromEulerAnglesAndPosition(good, 1, 2, 3, 100, -200, 300);
    ck_assert(MeMatrix4IsTM(good, few));
    for (int i = 0; i < 4; i++) {
        MeMatrix4Copy(bad, good);
        bad[i][3] += (MeReal)0.01;
        ck_assert(!MeMatrix4IsTM(bad, 0.005));
        ck_assert(MeMatrix4IsTM(bad, 0.02));
    }
    for (int i = 0; i < 3; i++) {
        MeMatrix4Copy(bad, good);
        bad[3][i] = (MeReal)INFINITY;
        ck_assert(!MeMatrix4IsTM(bad, 1));
        bad[3][i] = (MeReal)NAN;
        ck_assert(!MeMatrix4IsTM(bad, 1));
        MeMatrix4Copy(bad, good);
        MeVector3Scale(bad[i], -1);
        ck_assert(!MeMatrix4IsTM(bad, 0.1));
    }
}
