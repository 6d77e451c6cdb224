/* Rotations as quaternions. */
#include "math_test.h"

static const MeVector4 identity = {1, 0, 0, 0};

/* Do p and q stand for the same rotation? */
static void assertSameRotation(const MeVector4 p, const MeVector4 q, double tolerance) {
    MeVector4 near;
    MeVector4Copy(near, p);
    if (MeVector4Dot(p, q) < 0)
        MeVector4Scale(near, -1);
    assert_array_near(near, q, 4, tolerance);
}

static void assertUnit(const MeVector4 q) {
    assert_near(MeVector4MagnitudeSqr(q), 1, few);
}

/* ---- making ---- */

TEST(quaternions_are_set) {
    const MeVector4 expected = {1, 2, 3, 4};
    MeVector4 q;
    MeQuaternionSet(q, 1, 2, 3, 4);
    assert_same_bits(q, expected);
}

TEST(quarter_turn_about_z_takes_x_to_y) {
    const MeVector3 axis = {0, 0, 7}, x = {1, 0, 0};
    MeVector4 q;
    MeVector3 v;
    MeQuaternionMake(q, axis, ME_PI / 2);
    MeQuaternionRotateVector3(v, q, x);
    assert_vec3_near(v, 0, 1, 0, few);
}

TEST(axis_and_angle_make_the_matrix_of_that_axis) {
    static void (*const make[3])(MeMatrix3, const MeReal) = {MeMatrix3MakeRotationX, MeMatrix3MakeRotationY,
                                                             MeMatrix3MakeRotationZ};
    for (int axis = 0; axis < 3; axis++) {
        for (int i = -10; i <= 10; i++) {
            const MeReal angle = (MeReal)i * (MeReal)0.7;
            MeVector3 n = {0, 0, 0};
            MeVector4 q;
            MeMatrix3 expected, actual;
            n[axis] = (MeReal)1e-20;
            MeQuaternionMake(q, n, angle);
            MeQuaternionToR(actual, q);
            make[axis](expected, angle);
            assert_array_near(actual[0], expected[0], 9, TOL(6e-7, 1e-15));
        }
    }
}

TEST(axes_without_direction_warn) {
    const MeVector3 zero = {0, 0, 0}, notANumber = {1, NAN, 0}, good = {1, 0, 0};
    MeVector4 q = {0, 1, 0, 0};
    assert_refused(MeQuaternionMake, q, zero, 1);
    assert_same_bits(q, identity);
    assert_refused(MeQuaternionMake, q, notANumber, 1);
    assert_refused(MeQuaternionForRotation, q, zero, good);
    assert_same_bits(q, identity);
    assert_refused(MeQuaternionForRotation, q, good, notANumber);
    assert_same_bits(q, identity);
}

/* It takes the one direction to the other, and turns by no more than it must: its axis is at right angles to
 * both. */
static void assertRotates(const MeVector3 v1, const MeVector3 v2) {
    MeVector4 q;
    MeVector3 from, to, turned;
    MeVector3Copy(from, v1);
    MeVector3Copy(to, v2);
    MeVector3Normalize(from);
    MeVector3Normalize(to);
    MeQuaternionForRotation(q, v1, v2);
    assertUnit(q);
    MeQuaternionRotateVector3(turned, q, from);
    assert_array_near(turned, to, 3, TOL(1e-6, 2e-15));
    assert_near(MeVector3Dot(q + 1, from), 0, few);
    assert_near(MeVector3Dot(q + 1, to), 0, few);
    ck_assert(q[0] >= 0);
}

TEST(one_direction_is_turned_into_another) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 a, b;
        random_vector(a);
        random_vector(b);
        MeVector3Scale(b, 100);
        assertRotates(a, b);
    }
}

/* At all angles near 0 and near 180 degrees, down to less than rounding. */
TEST(nearly_equal_and_nearly_opposite_directions) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector3 a, b, opposite;
        random_vector(a);
        random_vector(b);
        MeVector3ScaleAndAdd(b, b, pow(10, -i / 40.), a);
        MeVector3MultiplyScalar(opposite, b, -1);
        assertRotates(a, b);
        assertRotates(a, opposite);
    }
    const MeVector3 x = {1, 0, 0}, minusX = {-1, 0, 0};
    assertRotates(x, minusX);
    MeVector4 q;
    MeQuaternionForRotation(q, x, x);
    assert_same_bits(q, identity);
}

TEST(small_rotations_keep_their_digits) {
    const MeReal angle = 1e-6;
    const MeVector3 x = {1, 0, 0}, y = {1, angle, 0};
    MeVector4 q;
    MeQuaternionForRotation(q, x, y);
    assert_near_rel(q[3], sin(atan(angle) / 2), few);
}

/* Half turns and near half turns about all axes, where w is small and each of x, y, z is the largest in its
 * turn. */
TEST(quaternions_come_from_any_transform) {
    for (int i = 0; i < 3 * RANDOM_TRIES; i++) {
        MeVector3 axis;
        MeVector4 q, back;
        MeMatrix4 tm;
        random_vector(axis);
        MeVector3Scale(axis, (MeReal)(i % 2));
        axis[i % 3] = 1;
        MeQuaternionMake(q, axis, ME_PI + MeRealRandomInRange(-1, 1) * (MeReal)pow(10, -i % 7));
        MeQuaternionToTM(tm, q);
        MeQuaternionFromTM(back, tm);
        assertUnit(back);
        ck_assert(back[0] >= 0);
        assertSameRotation(back, q, TOL(6e-7, 1e-15));
    }
}

/* ---- using ---- */

TEST(products_do_the_second_first) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector4 p, q, product, over;
        MeVector3 v, expected, actual;
        random_quaternion(p);
        random_quaternion(q);
        random_vector(v);
        MeQuaternionProduct(product, p, q);
        MeQuaternionRotateVector3(expected, q, v);
        MeQuaternionRotateVector3(expected, p, expected);
        MeQuaternionRotateVector3(actual, product, v);
        assert_array_near(actual, expected, 3, 2 * few);

        MeVector4Copy(over, p);
        MeQuaternionProduct(over, over, q);
        assert_same_bits(over, product);
        MeVector4Copy(over, q);
        MeQuaternionProduct(over, p, over);
        assert_same_bits(over, product);
    }
    const MeVector4 i = {0, 1, 0, 0}, j = {0, 0, 1, 0}, k = {0, 0, 0, 1};
    MeVector4 ij;
    MeQuaternionProduct(ij, i, j);
    assert_array_near(ij, k, 4, 0);
}

TEST(drifted_quaternions_still_rotate) {
    MeVector4 q, drifted;
    MeMatrix3 expected, actual;
    MeVector3 v = {1, 2, 3}, turned;
    random_quaternion(q);
    MeVector4Copy(drifted, q);
    MeVector4Scale(drifted, 1.5);
    MeQuaternionToR(expected, q);
    MeQuaternionToR(actual, drifted);
    assert_array_near(actual[0], expected[0], 9, few);
    MeMatrix3MultiplyVector(turned, expected, v);
    MeQuaternionRotateVector3(v, drifted, v);
    assert_array_near(v, turned, 3, 4 * few);

    const MeVector4 zero = {0, 0, 0, 0};
    MeQuaternionToR(actual, zero);
    ck_assert(MeMatrix3IsIdentity(actual, 0));
    MeQuaternionRotateVector3(turned, zero, v);
    assert_same_bits(turned, v);
}

TEST(slerp_turns_evenly) {
    const MeVector3 axis = {1, 2, -2};
    for (int i = -20; i <= 40; i++) {
        const MeReal howFar = (MeReal)i / 20;
        MeVector4 start, from, to, expected, actual;
        random_quaternion(start);
        MeQuaternionMake(to, axis, 2);
        MeQuaternionMake(expected, axis, 2 * howFar);
        MeVector4Copy(from, start);
        MeQuaternionProduct(to, to, start);
        MeQuaternionProduct(expected, expected, start);
        MeQuaternionSlerp(actual, from, to, howFar);
        assertUnit(actual);
        assertSameRotation(actual, expected, TOL(1e-6, 2e-15));
        MeQuaternionSlerp(from, from, to, howFar);
        assert_same_bits(from, actual);
        MeQuaternionSlerp(to, start, to, howFar);
        assert_same_bits(to, actual);
    }
}

TEST(slerp_goes_the_short_way) {
    const MeVector3 axis = {0, 0, 1};
    MeVector4 to, expected, actual;
    MeQuaternionMake(to, axis, 2);
    MeVector4Scale(to, -1);
    MeQuaternionMake(expected, axis, 1);
    MeQuaternionSlerp(actual, identity, to, 0.5);
    assertSameRotation(actual, expected, few);
}

/* However small the angle, also none at all. */
TEST(slerp_between_near_rotations) {
    const MeVector3 axis = {0, 1, 0};
    for (int i = 0; i < 30; i++) {
        const MeReal angle = pow(10, -i);
        MeVector4 to, actual;
        MeQuaternionMake(to, axis, angle);
        MeQuaternionSlerp(actual, identity, to, 0.25);
        assert_near_rel(actual[2], sin((double)angle / 8), few);
    }
    MeVector4 q, actual;
    random_quaternion(q);
    MeQuaternionSlerp(actual, q, q, 0.3);
    assert_array_near(actual, q, 4, few);
}

/* ---- in motion ---- */

TEST(finite_rotation_is_about_the_world_axis) {
    const MeVector3 w = {0, 0, ME_PI / 4}, x = {1, 0, 0};
    MeVector4 q;
    MeVector3 v;
    MeQuaternionSet(q, MeSqrt(0.5), MeSqrt(0.5), 0, 0); /* y to z */
    MeQuaternionFiniteRotation(q, w, 2);
    MeQuaternionRotateVector3(v, q, x);
    assert_vec3_near(v, 0, 1, 0, few);
}

TEST(finite_rotation_is_exact_for_any_angle) {
    const MeVector3 w = {2, -3, 6}; /* 7 rad/s */
    for (int i = -30; i <= 1; i++) {
        const MeReal h = pow(10, i);
        const double half = 3.5 * (double)h;
        MeVector4 q = {1, 0, 0, 0};
        MeQuaternionFiniteRotation(q, w, h);
        assertUnit(q);
        assert_near(q[0], cos(half), TOL(6e-7, 2e-15));
        for (int j = 0; j < 3; j++)
            assert_near(q[1 + j], (double)w[j] / 7 * sin(half), half < 1 ? few * half : TOL(1e-5, 1e-14));
    }
}

TEST(no_rotation_and_tiny_ones) {
    const MeReal tiny = TOL((MeReal)1e-44, (MeReal)1e-320);
    const MeVector3 none = {0, 0, 0}, w = {tiny, 0, 0};
    MeVector4 q, before;
    random_quaternion(before);
    MeVector4Copy(q, before);
    MeQuaternionFiniteRotation(q, none, 1);
    assert_array_near(q, before, 4, few);
    MeQuaternionFiniteRotation(q, w, 1);
    assert_array_near(q, before, 4, few);
}

TEST(many_rotations_do_not_drift) {
    const MeVector3 w = {1, 2, 3};
    MeVector4 q = {1, 0, 0, 0};
    for (int i = 0; i < 100000; i++)
        MeQuaternionFiniteRotation(q, w, 0.01);
    assertUnit(q);
}

/* dq against the difference quotient of the exact rotation, in double precision of h. */
TEST(rate_of_change_is_the_derivative) {
    const MeReal h = TOL((MeReal)1e-2, (MeReal)1e-5);
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector4 q, dq, before, after, over;
        MeVector3 w;
        random_quaternion(q);
        random_vector(w);
        MeQuaternionWtoDQ(dq, q, w);
        MeVector4Copy(before, q);
        MeVector4Copy(after, q);
        MeQuaternionFiniteRotation(before, w, -h);
        MeQuaternionFiniteRotation(after, w, h);
        MeVector4Subtract(after, after, before);
        MeVector4Scale(after, 1 / (2 * h));
        assert_array_near(after, dq, 4, TOL(6e-5, 1e-10));
        MeVector4Copy(over, q);
        MeQuaternionWtoDQ(over, over, w);
        assert_same_bits(over, dq);
    }
}

TEST(matrix_d_and_its_transpose) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector4 q, dq, byD;
        MeVector3 w, back;
        MeReal D[12];
        random_quaternion(q);
        random_vector(w);
        MeQuaternionWtoDQ(dq, q, w);
        MeQuaternionToD(D, q);
        MeMatrixMultiplyT1(byD, 4, 3, 1, D, w);
        MeVector4Scale(byD, 0.5);
        assert_array_near(byD, dq, 4, few);
        MeMatrixMultiply(back, 3, 4, 1, D, dq);
        MeVector3Scale(back, 2);
        assert_array_near(back, w, 3, few);
    }
}
