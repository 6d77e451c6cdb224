/* Rigid transforms: the layout, the three forms of a rotation, inverses, compounds, motion. */
#include "math_test.h"

TEST(layout_is_that_of_opengl) {
    const MeMatrix3 R = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}; /* x to y */
    const MeMatrix4 expected = {{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {5, 6, 7, 1}};
    const MeMatrix4 identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const MeVector3 point = {1, 2, 3};
    MeMatrix4 tm;
    MeVector3 out;
    MeMatrix4TMMakeFromRotationAndPosition(tm, R, 5, 6, 7);
    assert_same_bits(tm, expected);
    MeMatrix4TMTransform(out, tm, point);
    assert_vec3_near(out, 3, 7, 10, 0);
    MeMatrix4TMRotate(out, tm, point);
    assert_vec3_near(out, -2, 1, 3, 0);
    MeMatrix4TMMakeIdentity(tm);
    assert_same_bits(tm, identity);
}

/* Quaternion, MeMatrix3 and MeMatrix4 turn a vector alike, wherever they come from. */
TEST(three_forms_of_a_rotation_agree) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeVector4 q, back;
        MeMatrix3 R, fromTM;
        MeMatrix4 tm, set;
        MeVector3 v, byQ, byR, byTM;
        random_quaternion(q);
        random_vector(v);
        MeQuaternionToR(R, q);
        MeQuaternionToTM(tm, q);
        MeQuaternionRotateVector3(byQ, q, v);
        MeMatrix3MultiplyVector(byR, R, v);
        MeMatrix4TMRotate(byTM, tm, v);
        assert_array_near(byR, byQ, 3, few);
        assert_array_near(byTM, byQ, 3, few);
        ck_assert(MeMatrix3IsValidOrientationMatrix(R, 2 * few));
        ck_assert(MeMatrix4IsTM(tm, 2 * few));

        MeMatrix4TMGetRotation(fromTM, tm);
        assert_same_bits(fromTM, R);
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++)
                ck_assert(tm[j][k] == R[k][j]);
        }
        MeMatrix4TMMakeFromRotationAndPosition(set, R, 0, 0, 0);
        assert_same_bits(set, tm);

        MeQuaternionFromTM(back, tm);
        ck_assert(back[0] >= 0);
        if (q[0] < 0)
            MeVector4Scale(q, -1);
        assert_array_near(back, q, 4, TOL(1e-6, 2e-15));
    }
}

TEST(parts_are_set_apart) {
    const MeMatrix4 before = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
    const MeMatrix4 moved = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {20, 21, 22, 16}};
    const MeMatrix4 turned = {{30, 33, 36, 4}, {31, 34, 37, 8}, {32, 35, 38, 12}, {23, 24, 25, 16}};
    const MeMatrix3 R = {{30, 31, 32}, {33, 34, 35}, {36, 37, 38}};
    const MeVector3 position = {23, 24, 25};
    const MeVector4 quarterAboutZ = {1, 0, 0, 1};
    MeMatrix4 tm;
    MeMatrix3 read;
    MeMatrix4Copy(tm, before);
    MeMatrix4TMSetPosition(tm, 20, 21, 22);
    assert_same_bits(tm, moved);
    MeMatrix4TMSetPositionVector(tm, position);
    MeMatrix4TMSetRotation(tm, R);
    assert_same_bits(tm, turned);
    MeMatrix4TMGetRotation(read, tm);
    assert_same_bits(read, R);
    MeMatrix4TMSetRotationFromQuaternion(tm, quarterAboutZ);
    assert_vec3_near(tm[0], 0, 1, 0, few);
    assert_vec3_near(tm[3], 23, 24, 25, 0);
    ck_assert(tm[0][3] == 4 && tm[1][3] == 8 && tm[2][3] == 12 && tm[3][3] == 16);
}

TEST(euler_angles_and_position) {
    MeMatrix3 R;
    MeMatrix4 expected, tm;
    MeMatrix3FromEulerAngles(R, 1, 2, 3);
    MeMatrix4TMMakeFromRotationAndPosition(expected, R, 4, 5, 6);
    MeMatrix4TMFromEulerAnglesAndPosition(tm, 1, 2, 3, 4, 5, 6);
    assert_same_bits(tm, expected);
}

TEST(inverses_lead_back) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix4 tm, inverse;
        MeVector3 v, w;
        random_tm(tm);
        random_vector(v);
        MeMatrix4Copy(inverse, tm);
        MeMatrix4TMInvert(inverse);
        ck_assert(MeMatrix4IsTM(inverse, 2 * few));

        MeMatrix4TMTransform(w, tm, v);
        MeMatrix4TMInverseTransform(w, tm, w);
        assert_array_near(w, v, 3, 2 * few);
        MeMatrix4TMTransform(w, tm, v);
        MeMatrix4TMTransform(w, inverse, w);
        assert_array_near(w, v, 3, 2 * few);
        MeMatrix4TMRotate(w, tm, v);
        MeMatrix4TMInverseRotate(w, tm, w);
        assert_array_near(w, v, 3, 2 * few);
    }
}

typedef void (*Use)(MeVector3, const MeMatrix4, const MeVector3);

TEST(transformed_vectors_may_alias) {
    static const Use uses[] = {MeMatrix4TMTransform, MeMatrix4TMInverseTransform, MeMatrix4TMRotate,
                               MeMatrix4TMInverseRotate};
    MeMatrix4 tm;
    random_tm(tm);
    for (int i = 0; i < 4; i++) {
        const MeVector3 v = {1, 2, 3};
        MeVector3 expected, overV;
        uses[i](expected, tm, v);
        MeVector3Copy(overV, v);
        uses[i](overV, tm, overV);
        assert_same_bits(overV, expected);
        for (int row = 0; row < 4; row++) {
            MeMatrix4 overTM;
            MeMatrix4Copy(overTM, tm);
            uses[i](overTM[row], overTM, v);
            assert_array_near(overTM[row], expected, 3, 0);
        }
    }
}

TEST(compound_does_the_first_first) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix4 part, body, whole, product, overPart, overBody;
        MeVector3 v, expected, actual;
        random_tm(part);
        random_tm(body);
        random_vector(v);
        MeMatrix4TMCompound(whole, part, body);
        MeMatrix4TMTransform(expected, part, v);
        MeMatrix4TMTransform(expected, body, expected);
        MeMatrix4TMTransform(actual, whole, v);
        assert_array_near(actual, expected, 3, 2 * few);

        MeMatrix4MultiplyMatrix(product, part, body);
        assert_array_near(whole[0], product[0], 16, few);
        MeMatrix4Copy(overPart, part);
        MeMatrix4TMCompound(overPart, overPart, body);
        assert_same_bits(overPart, whole);
        MeMatrix4Copy(overBody, body);
        MeMatrix4TMCompound(overBody, part, overBody);
        assert_same_bits(overBody, whole);
    }
}

TEST(rounding_errors_are_mended) {
    for (int i = 0; i < RANDOM_TRIES; i++) {
        MeMatrix4 tm, mended;
        MeVector3 x;
        random_tm(tm);
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++)
                tm[j][k] += MeRealRandomInRange(-0.01, 0.01);
        }
        MeMatrix4Copy(mended, tm);
        MeMatrix4TMOrthoNormalize(mended);
        ck_assert(MeMatrix4IsTM(mended, few));
        assert_array_near(mended[0], tm[0], 12, 0.04);
        assert_array_near(mended[3], tm[3], 4, 0);
        MeVector3Cross(x, mended[0], tm[0]);
        assert_vec3_near(x, 0, 0, 0, few);
    }
}

/* Nearly parallel axes still span a plane. */
TEST(large_errors_are_mended) {
    MeMatrix4 tm = {{1, 0, 0, 0}, {1000, 0.1, 0, 0}, {0, 0, -7, 0}, {1, 2, 3, 1}};
    const MeMatrix4 expected = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1}};
    MeMatrix4TMOrthoNormalize(tm);
    assert_array_near(tm[0], expected[0], 16, few);
}

TEST(axes_without_a_plane_warn) {
    static const MeVector3 axes[][2] = {
        {{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 0}}, {{1, 2, 3}, {-2, -4, -6}}, {{1, 0, (MeReal)NAN}, {0, 1, 0}}};
    for (int i = 0; i < 4; i++) {
        MeMatrix4 tm, before;
        MeMatrix4TMMakeIdentity(tm);
        MeVector3Copy(tm[0], axes[i][0]);
        MeVector3Copy(tm[1], axes[i][1]);
        memcpy(before, tm, sizeof tm);
        assert_refused(MeMatrix4TMOrthoNormalize, tm);
        assert_same_bits(tm, before);
    }
}

/* ---- motion ---- */

TEST(velocities_move_and_turn_in_the_world) {
    const MeVector3 v = {1, 2, 3}, w = {0, 0, ME_PI / 4};
    MeMatrix4 tm, next;
    MeMatrix4TMFromEulerAnglesAndPosition(tm, ME_PI / 2, 0, 0, 10, 20, 30); /* its y axis is the world's z */
    MeMatrix4TMUpdateFromVelocities(next, 0, 2, v, w, tm);
    assert_vec3_near(next[0], 0, 1, 0, few);
    assert_vec3_near(next[1], 0, 0, 1, few);
    assert_vec3_near(next[2], 1, 0, 0, few);
    assert_vec3_near(next[3], 12, 24, 36, 0);
    MeMatrix4TMUpdateFromVelocities(tm, 0, 2, v, w, tm);
    assert_same_bits(tm, next);
}

TEST(small_turns_are_left_out) {
    const MeVector3 v = {1, 0, 0}, w = {0.3, 0.4, 0}; /* 0.5 rad/s */
    MeMatrix4 tm, next;
    random_tm(tm);
    MeMatrix4TMUpdateFromVelocities(next, 0.051, 0.1, v, w, tm);
    ck_assert(memcmp(next, tm, 3 * sizeof(MeVector4)) == 0);
    assert_near(next[3][0], tm[3][0] + (MeReal)0.1, few);
    MeMatrix4TMUpdateFromVelocities(next, 0.049, 0.1, v, w, tm);
    ck_assert(memcmp(next, tm, 3 * sizeof(MeVector4)) != 0);
}

TEST(many_small_turns_are_a_large_one) {
    const MeVector3 v = {0, 0, 0}, w = {0.5, -1, 2};
    MeMatrix4 large, small;
    random_tm(large);
    MeMatrix4Copy(small, large);
    MeMatrix4TMUpdateFromVelocities(large, 0, 1, v, w, large);
    for (int i = 0; i < 64; i++)
        MeMatrix4TMUpdateFromVelocities(small, 0, (MeReal)1 / 64, v, w, small);
    assert_array_near(small[0], large[0], 16, TOL(6e-6, 1e-14));
}

TEST(accelerations_are_constant) {
    const MeVector3 v = {1, 0, 0}, a = {0, 4, 0}, w = {0, 0, 0.25}, alpha = {0, 0, 0.5};
    const MeVector3 none = {0, 0, 0}, turn = {0, 0, 1.5};
    MeMatrix4 tm, next, expected;
    random_tm(tm);
    MeMatrix4TMUpdateFromVelocitiesAndAcceler(next, 0, 2, v, a, w, alpha, tm);
    MeMatrix4TMUpdateFromVelocities(expected, 0, 1, none, turn, tm);
    MeVector3Set(expected[3], tm[3][0] + 2, tm[3][1] + 8, tm[3][2]);
    assert_array_near(next[0], expected[0], 16, few);
    MeMatrix4TMUpdateFromVelocitiesAndAcceler(tm, 0, 2, v, a, w, alpha, tm);
    assert_same_bits(tm, next);
}
