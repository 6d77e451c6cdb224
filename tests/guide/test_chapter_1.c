/* Dynamics guide, Preface and chapter 1, "Introduction to Karma Dynamics", as a reader would try it out. Bodies,
 * contacts and partitions are in tests/Mdt. */
#include "Mdt/behaviour.h"

/* Preface, "Coordinate Systems and Reference Frames", "Type Conventions": y = X + R x; a transform is an affine 4 × 4
 * matrix, as in OpenGL; a vector's fourth number is 1 for a place and 0 for a direction. */
TEST(conventions) {
    MdtWorldID world = MdtWorldCreate(1, 0);
    MdtBodyID body = MdtBodyCreate(world);
    const MeReal quarter = MeSqrt(.5);
    MeMatrix3 R;
    MeVector3 x = {1, 0, 0}, X, y;
    MdtBodySetPosition(body, 10, 20, 30);
    MdtBodySetQuaternion(body, quarter, 0, 0, quarter); /* a quarter turn about z, right-handed */
    MdtBodyGetPosition(body, X);
    MdtBodyGetOrientation(body, R);
    for (int i = 0; i < 3; i++)
        y[i] = X[i] + R[i][0] * x[0] + R[i][1] * x[1] + R[i][2] * x[2];
    assert_vec3_near(y, 10, 21, 30, TOL(1e-5, 3e-12));
    MdtConvertPositionVector(body, x, 0, y); /* "utility functions are provided" */
    assert_vec3_near(y, 10, 21, 30, TOL(1e-5, 3e-12));
    MdtConvertVector(body, x, 0, y);
    assert_vec3_near(y, 0, 1, 0, TOL(1e-6, 9e-14));

    MeMatrix4 tm;
    MdtBodyGetTransform(body, tm);
    for (int isPlace = 0; isPlace < 2; isPlace++) {
        const MeVector4 v = {1, 0, 0, (MeReal)isPlace};
        MeReal to[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 4; k++)
                to[i] += v[k] * tm[k][i];
        assert_vec3_near(to, isPlace * 10, 1 + isPlace * 20, isPlace * 30, TOL(1e-5, 3e-12));
    }
    MdtWorldDestroy(world);
}

/* "The Mdt Library": different worlds are totally disconnected from each other. */
TEST(different_worlds_are_disconnected) {
    MdtWorldID earth = MdtWorldCreate(1, 1), moon = MdtWorldCreate(1, 1);
    MdtBodyID apple = MdtBodyCreate(earth), stone = MdtBodyCreate(moon);
    MdtWorldSetGravity(earth, 0, -(MeReal)9.8, 0);
    MdtWorldSetGravity(moon, 0, -(MeReal)1.6, 0);
    MdtBodyEnable(apple);
    MdtBodyEnable(stone);
    MdtWorldStep(earth, 1);
    assert_velocity(stone, 0, 0, 0, 0);
    MdtWorldStep(moon, 1);
    assert_velocity(apple, 0, -9.8, 0, TOL(1e-6, 9e-13));
    assert_velocity(stone, 0, -1.6, 0, TOL(1e-6, 2e-13));
    MdtBSJointID between = MdtBSJointCreate(earth);
    MdtBSJointSetBodies(between, apple, stone); /* "may never interact" */
    ck_assert_int_gt(caught.warnings, 0);
    MdtWorldDestroy(earth);
    MdtWorldDestroy(moon);
    messages_forget();
}
