/* The ball-and-socket joint: the force it reads back. */
#include "scene.h"

/* The force that holds a swinging mass at the lowest point is m g + m v²/l = 3 m g. */
TEST(the_force_read_back_is_the_pendulum_s_tension) {
    MdtWorldID w = scene_world(1, 1, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 1, 0, 0);
    MdtBodySetSphericalInertiaTensor(b, 1e-6);
    MdtBSJointID j = scene_ball(w, b, 0, 0, 0, 0);
    double max = 0;
    for (int i = 0; i < 300; i++) {
        MeVector3 f;
        MdtWorldStep(w, .005);
        MdtBSJointGetForce(j, 0, f);
        max = fmax(max, sqrt((double)f[0] * f[0] + (double)f[1] * f[1] + (double)f[2] * f[2]));
    }
    assert_near(max, 30, .02);
}

/* Two joints where one would do: the load is shared, nothing explodes, at ε = 0. */
TEST(redundant_joints_share_the_load) {
    MdtWorldID w = scene_world(1, 3, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    MdtBSJointID j[3];
    for (int i = 0; i < 3; i++) {
        j[i] = scene_ball(w, b, 0, i - 1, 0, 0);
    }
    steps(w, 600, FRAME);
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        MeVector3 f;
        MdtBSJointGetForce(j[i], 0, f);
        assert_near(f[1], 10, TOL(1e-5, 3e-8));
        sum += f[1];
    }
    assert_near(sum, 30, TOL(3e-5, 9e-8));
    MeVector3 p;
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 0, 0, 0, 9e-14);
}

/* Joints that contradict each other end in a compromise, finite and bounded. */
TEST(contradictory_joints_end_in_a_compromise) {
    MdtWorldID w = scene_world(1, 2, 10);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    for (int i = 0; i < 2; i++) {
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b, 0);
        MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 0, 0, 0, 0);
        MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 1, i == 0 ? -1 : 1, 0, 0);
        MdtBSJointEnable(j);
    }
    for (int i = 0; i < 300; i++) {
        MeVector3 p;
        MdtWorldStep(w, FRAME);
        MdtBodyGetPosition(b, p);
        assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 4e-10));
    }
}
