/* Documented behaviours: bodies.
 *
 * Already proved elsewhere:
 *   defaults of a new body                                    test_Body: a_new_body_has_the_guide_s_defaults
 *   a disabled body tied to an enabled one is enabled         test_Rest: an_enabled_body_wakes_what_is_tied_to_it
 *   a disabled body hit by an enabled one is enabled          test_Rest: a_contact_with_a_moving_body_wakes_a_sleeper
 *   quaternions are (w, x, y, z), the identity 1, 0, 0, 0     test_Body: a_new_body_has_the_guide_s_defaults
 *                                                             test_Body: rotations_turn_by_the_right_hand_rule
 *   transforms as OpenGL stores them, y = X + R x             test_Body: the_four_forms_of_a_pose_agree
 *   right-handed coordinates                                  test_Body: rotations_turn_by_the_right_hand_rule
 *   the transform's pointer follows the body                  test_Body: the_transform_pointer_follows_every_step
 *   forces add up, act for one step, and are gone             test_FreeBody: forces_last_a_step_and_impulses_do_not_...
 *   forces on a body that is not simulated wait               test_Body: forces_wait_for_a_disabled_body
 *   a force at a position adds the torque (P - x) × F         test_FreeBody: force_at_a_position_adds_its_torque
 *   impulses do not depend on the step                        test_FreeBody: forces_last_a_step_and_impulses_do_not_...
 *   forces and a resting body: the Dynamics guide wakes it from a threshold on, the User Guide never; the former wins
 *                                                             test_Rest: setters_forces_and_enabling_wake_a_sleeper
 *                                                             test_Rest: a_slight_force_does_not_wake_a_sleeper
 *   the centre of mass may be moved                           test_Body: the_centre_of_mass_may_lie_beside_the_frame
 *   fast spin is off by default; orientation is exact         test_Body: a_new_body_has_the_guide_s_defaults
 *                                                             test_FreeBody: fast_spin_is_exact
 */
#include "behaviour.h"

/* Dynamics guide ch. 4, "Adding Forces": the force acts at the centre of mass, in the world's axes, and turns nothing:
 * however the body is turned, and wherever its centre of mass is. */
TEST(a_force_acts_at_the_centre_of_mass_in_the_world_s_axes) {
    MdtWorldID w = scene_world(1, 0, 0);
    MdtBodyID b = scene_body(w, 1, 3, 4, 5);
    const MeVector3 offset = {1, -2, .5};
    MeVector3 torque;
    MdtBodySetCenterOfMassRelativePosition(b, offset);
    MdtBodySetQuaternion(b, 1, 2, -1, .5);
    for (int i = 0; i < 30; i++) {
        MdtBodyAddForce(b, 1, -2, 3);
        MdtBodyGetTorque(b, torque);
        assert_vec3_near(torque, 0, 0, 0, 0);
        MdtWorldStep(w, FRAME);
    }
    const double t = 30 * (double)FRAME;
    assert_velocity(b, t, -2 * t, 3 * t, TOL(1e-6, 2e-13));
    assert_spin(b, 0, 0, 0, 0);
}

/* Dynamics guide ch. 5, "Inertia Problems": Karma 1.x puts a multiple of the unit matrix in place of the tensor. Later
 * versions, as the User Guide ch. 6 says, let programs choose, and here the full tensor is the default, since it is
 * what a program that sets one means; with MdtBodyDisableNonSphericalInertia a body is as in 1.x. */
TEST(the_tensor_can_be_made_a_multiple_of_the_unit_matrix) {
    const MeMatrix3 tensor = {{1, 0, 0}, {0, 2, 0}, {0, 0, 6}};
    for (int spherical = 0; spherical < 2; spherical++) {
        MdtWorldID w = scene_world(1, 0, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtBodySetInertiaTensor(b, tensor);
        if (spherical)
            MdtBodyDisableNonSphericalInertia(b);
        ck_assert_int_eq(MdtBodyNonSphericalInertiaIsEnabled(b), !spherical);
        MdtBodyAddTorque(b, 0, 0, 6);
        MdtWorldStep(w, FRAME);
        assert_spin(b, 0, 0, (spherical ? 2 : 1) * (double)FRAME, 9e-14); /* a third of the trace is 3 */
    }
}

/* A minute of rolling with 2 m/s; the contact may know that the ball is round. Where rounding has left a gap, the step
 * is divided when the ball has fallen onto the floor, after t = sqrt(2 gap / g); what is no ball has turned by w t
 * meanwhile, and its weight gets an arm: it gains at most g h w t. */
static void rollForAMinute(MeBool isRound) {
    const double radius = 1, g = 10, v = 2, rounding = TOL(1e-4, 1e-9);
    double gain = 0;
    MdtReport report;
    MdtWorldID w = scene_world(1, 1, g);
    MdtWorldSetEpsilon(w, 0);
    MdtWorldEnableReport(w);
    MdtBodyID ball = scene_body(w, 1, 0, radius, 0);
    MdtContactID under = scene_contact(w, ball, 0, 0, 0, 0);
    MdtContactParamsSetType(MdtContactGetParams(under), MdtContactTypeFriction2D);
    MdtContactSetRadius(under, 0, isRound ? (MeReal)radius : 0);
    MdtBodySetLinearVelocity(ball, v, 0, 0);
    MdtBodySetAngularVelocity(ball, 0, 0, -v / radius);
    for (int i = 0; i < 3600; i++) {
        const double gap = coordinate(ball, 1) - radius;
        MdtContactSetPosition(under, coordinate(ball, 0), 0, 0);
        MdtContactSetPenetration(under, -gap);
        MdtWorldStep(w, FRAME);
        ck_assert(MdtWorldGetReport(w, &report));
        if (report.parts > 1 && !isRound)
            gain += g * (double)FRAME * v / radius * sqrt(2 * fabs(gap) / g);
    }
    assert_below(gain, TOL(2e-3, 1e-7));
    assert_near(velocity(ball, 0), v, rounding + gain);
    assert_near(spin(ball, 2), -v / radius, rounding + gain);
}

/* User Guide ch. 3: with friction and without damping a ball rolls for ever. */
TEST(with_friction_and_without_damping_a_round_ball_rolls_for_ever) {
    rollForAMinute(METRUE);
}

/* A contact that was not told that the ball is round takes its place of contact for a corner, in steps that are
 * divided: MdtContactSetRadius. */
TEST(with_friction_and_without_damping_a_ball_rolls_for_ever) {
    rollForAMinute(MEFALSE);
}
