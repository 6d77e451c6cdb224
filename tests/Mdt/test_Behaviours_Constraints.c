/* Documented behaviours: what all constraints share (Dynamics guide ch. 3, "Common Constraint Functions",
 * "Base Constraint Functions").
 *
 * Already proved elsewhere:
 *   a created constraint acts only after Enable             test_Constraint: a_constraint_acts_only_when_enabled
 *   a second body of null is the world                      test_BSJoint: sag_is_epsilon_force_step_squared_over_gamma
 *   it has to be disabled before its bodies change; a warning  test_Constraint: changing_the_bodies_of_an_enabled_...
 *   MdtConstraintSetAxes normalizes and makes orthogonal    test_Constraint: frames_are_given_in_the_world_...
 *   reset brings the defaults of each type back             test_JointLife: reset_restores_the_defaults_and_...
 *   positions and axes are the world's and move with bodies  test_Constraint: frames_are_given_in_the_world_...
 *   forces and torques are opposite on the two bodies       test_Joints: forces_are_opposite
 */
#include "behaviour.h"

/* Ch. 3: bodies are placed, then attached, then the position is set: it is then one point of both, and moves with
 * each. */
TEST(bodies_are_placed_attached_and_then_the_position_is_set) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 4, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtConstraintID c = MdtBSJointQuaConstraint(j);
    MeVector3 p;
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, 1, 2, 3);
    assert_near(gapOf(c), 0, TOL(1e-6, 9e-14));
    MdtBSJointGetPosition(j, p);
    assert_vec3_near(p, 1, 2, 3, TOL(1e-6, 3e-13));
    MdtConstraintBodyGetPositionRel(c, 1, p);
    assert_vec3_near(p, -3, 2, 3, TOL(1e-6, 3e-13));
    MdtBodySetPosition(b, 5, 0, 0); /* moved after that: an error that the joint has to work off */
    assert_near(gapOf(c), 1, TOL(1e-6, 9e-14));
    MdtBSJointEnable(j);
    steps(w, 120, FRAME);
    assert_near(gapOf(c), 0, TOL(1e-6, 3e-11));
    MdtWorldDestroy(w);
}

/* Ch. 3, MdtConstraintSetAxes: the third axis is the cross product of the two, so the pair is a full orientation. */
TEST(two_axes_make_a_right_handed_frame) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0);
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtConstraintID c = MdtRPROJointQuaConstraint(j);
    MeVector4 q;
    MdtRPROJointSetBodies(j, a, 0);
    MdtConstraintBodySetAxes(c, 0, 0, 7, 0, 0, 0, 2); /* x to y, y to z, so the third is x: a third of a turn */
    MdtRPROJointGetAttachmentQuaternion(j, 0, q);
    const double sign = q[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        assert_near(sign * (double)q[i], .5, TOL(5e-7, 5e-14));
    MdtWorldDestroy(w);
}

static int rowsOf(MdtConstraintID c) {
    MdtWorldID w = MdtConstraintGetWorld(c);
    MdtConstraintEnable(c);
    MdtWorldStep(w, FRAME);
    const int rows = MdtConstraintGetRowCount(c);
    MdtConstraintDisable(c);
    return rows;
}

/* The car wheel removes 3 to 6: what is free, the steering (a motor without force, no lock), the rolling and the
 * springing; a lock, a motor and the spring take one each. */
TEST(a_car_wheel_removes_3_to_6) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID chassis = scene_body(w, 10, 0, 0, 0), wheel = scene_body(w, 1, 1, 0, 0);
    MdtCarWheelID j = MdtCarWheelCreate(w);
    MdtConstraintID c = MdtCarWheelQuaConstraint(j);
    MdtCarWheelSetBodies(j, chassis, wheel);
    MdtCarWheelSetPosition(j, 1, 0, 0);
    MdtCarWheelSetSteeringAndHingeAxes(j, 0, 1, 0, 0, 0, 1);
    MdtCarWheelSetSteeringLimitedForceMotor(j, 0, 0);
    ck_assert_int_eq(rowsOf(c), 3);
    MdtCarWheelSetSteeringLock(j, 1);
    ck_assert_int_eq(rowsOf(c), 4);
    MdtCarWheelSetSuspension(j, 100, 10, 0, -1, 1, 0);
    ck_assert_int_eq(rowsOf(c), 5);
    MdtCarWheelSetHingeLimitedForceMotor(j, 0, 5);
    ck_assert_int_eq(rowsOf(c), 6);
    MdtWorldDestroy(w);
}
