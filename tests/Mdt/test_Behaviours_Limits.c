/* Documented behaviours: limits and motors (Dynamics guide ch. 3, "Joint Limit", "The Single Joint Limit"; ch. 5,
 * "Modeling Using Force-Limited Motors").
 *
 * Already proved elsewhere:
 *   a lower stop above the upper one takes it along; the reverse  test_Hinge: limits_follow_the_guide_s_rules
 *   at or below it spring and damper count, not restitution   test_Hinge: a_soft_stop_is_a_damped_spring
 *   threshold, stiffness, damping do not become negative      test_Hinge: limits_follow_the_guide_s_rules
 *   restitution is clamped to 0..1                            test_Hinge: limits_follow_the_guide_s_rules
 *   a stop without stiffness and damping does nothing         test_Hinge: a_stop_without_stiffness_and_damping_...
 *   MdtSingleLimitReset: stop 0, restitution 1, hard, damping 0  test_Hinge: limits_follow_the_guide_s_rules
 *   MdtLimitSetPosition shifts the reading                    test_Hinge: position_is_only_an_offset
 *   the position flag cannot be cleared while powered         test_Hinge: limits_follow_the_guide_s_rules
 *   the motor's speed tends to the desired one, with fmax at most test_Hinge: the_motor_reaches_its_speed_with_...
 *   ... or never arrives; velocity 0 is a brake               test_Hinge: the_motor_stalls_at_its_force_limit
 *   a hard stop reverses the speed, times restitution, in a step test_Hinge: a_hard_stop_returns_its_restitution_...
 *   a motor rests beyond a soft stop by fmax / stiffness      test_Hinge: a_motor_rests_on_a_soft_stop_at_fmax_over_...
 */
#include "behaviour.h"

/* A mass on a rail along x. */
typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtPrismaticID joint;
    MdtLimitID limit;
    MdtSingleLimitID lower, upper;
} Rail;

static Rail makeRail(void) {
    Rail s;
    s.world = scene_world(2, 2, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_body(s.world, 1, 0, 0, 0);
    s.joint = MdtPrismaticCreate(s.world);
    MdtPrismaticSetBodies(s.joint, s.body, 0);
    MdtPrismaticSetAxis(s.joint, 1, 0, 0);
    MdtPrismaticEnable(s.joint);
    s.limit = MdtPrismaticGetLimit(s.joint);
    s.lower = MdtLimitGetLowerLimit(s.limit);
    s.upper = MdtLimitGetUpperLimit(s.limit);
    MdtLimitCalculatePosition(s.limit, 1);
    return s;
}

/* "MdtLimitSetLimitedForceMotor": a negative force limit counts as 0; 0 switches the motor off, others on; and bodies
 * that are disabled stay so. */
TEST(setting_the_motor_switches_it_and_wakes_nothing) {
    Rail s = makeRail();
    MdtBodyDisable(s.body);
    ck_assert(!MdtLimitIsMotorized(s.limit));
    MdtLimitSetLimitedForceMotor(s.limit, 3, 5);
    ck_assert(MdtLimitIsMotorized(s.limit));
    assert_near(MdtLimitGetMotorDesiredVelocity(s.limit), 3, 0);
    assert_near(MdtLimitGetMotorMaxForce(s.limit), 5, 0);
    ck_assert(!MdtBodyIsEnabled(s.body));
    steps(s.world, 10, FRAME);
    ck_assert(!MdtBodyIsEnabled(s.body));
    assert_velocity(s.body, 0, 0, 0, 0);
    MdtLimitSetLimitedForceMotor(s.limit, 3, 0);
    ck_assert(!MdtLimitIsMotorized(s.limit));
    MdtLimitSetLimitedForceMotor(s.limit, 3, -5);
    ck_assert(!MdtLimitIsMotorized(s.limit));
    assert_near(MdtLimitGetMotorMaxForce(s.limit), 0, 0);
    messages_forget();
}

/* "MdtLimitActivateMotor", "MdtLimitActivateLimits": on and off, without changing any other property. */
TEST(the_switches_change_nothing_else) {
    Rail s = makeRail();
    MdtLimitSetLimitedForceMotor(s.limit, 3, 5);
    MdtSingleLimitSetStop(s.upper, 2);
    MdtSingleLimitSetStop(s.lower, -2);
    MdtSingleLimitSetStiffness(s.upper, 70);
    const MdtBclLimit before = *s.limit;
    for (int i = 0; i < 2; i++) {
        MdtLimitActivateMotor(s.limit, i);
        MdtLimitActivateLimits(s.limit, !i);
        ck_assert_int_eq(MdtLimitIsMotorized(s.limit), i);
        ck_assert_int_eq(MdtLimitIsActive(s.limit), !i);
        MdtBclLimit now = *s.limit;
        now.bPowered = before.bPowered;
        now.bActive = before.bActive;
        ck_assert(memcmp(&now, &before, sizeof now) == 0);
    }
}

/* "Restitution ... is used only if the limit hardness exceeds the threshold": a damped soft stop with restitution 1
 * and one with 0 do the same. */
TEST(a_soft_stop_ignores_restitution_and_a_hard_one_damping) {
    for (int hard = 0; hard < 2; hard++) {
        double after[2];
        for (int k = 0; k < 2; k++) {
            Rail s = makeRail();
            MdtSingleLimitSetStop(s.lower, -10);
            MdtSingleLimitSetStop(s.upper, .25);
            MdtSingleLimitSetStiffness(s.upper, 100);
            MdtLimitSetStiffnessThreshold(s.limit, hard ? 99 : 100);
            MdtSingleLimitSetRestitution(s.upper, hard ? (MeReal).5 : (MeReal)k);
            MdtSingleLimitSetDamping(s.upper, hard ? (MeReal)(10 * k) : 5);
            MdtLimitActivateLimits(s.limit, 1);
            MdtBodySetLinearVelocity(s.body, 1, 0, 0);
            steps(s.world, 120, FRAME);
            after[k] = velocity(s.body, 0);
        }
        assert_near(after[0], after[1], 0);
        if (hard)
            assert_near(after[0], -.5, TOL(5e-7, 5e-12));
        else
            ck_assert_msg(after[0] < -.1 && after[0] > -.9, "%g", after[0]);
    }
}

/* "MdtHingeSetLimit", "...Prismatic...", "...Spring...": the joint's limit is reset, then given the public values. */
TEST(set_limit_resets_and_copies_the_public_values) {
    MdtWorldID w = scene_world(1, 3, 0);
    MdtHingeID hinge = MdtHingeCreate(w);
    MdtPrismaticID slider = MdtPrismaticCreate(w);
    MdtSpringID spring = MdtSpringCreate(w);
    MdtLimitID of[3] = {MdtHingeGetLimit(hinge), MdtPrismaticGetLimit(slider), MdtSpringGetLimit(spring)};
    MdtBclLimit own;
    MdtLimitReset(&own);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(&own), -3);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(&own), 4);
    MdtSingleLimitSetStiffness(MdtLimitGetUpperLimit(&own), 5);
    MdtSingleLimitSetDamping(MdtLimitGetLowerLimit(&own), 6);
    MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(&own), .5);
    MdtLimitSetStiffnessThreshold(&own, 7);
    MdtLimitSetLimitedForceMotor(&own, 8, 9);
    MdtLimitActivateLimits(&own, 1);
    for (int i = 0; i < 3; i++)
        of[i]->position = 99; /* a value of another time */
    MdtHingeSetLimit(hinge, &own);
    MdtPrismaticSetLimit(slider, &own);
    MdtSpringSetLimit(spring, &own);
    for (int i = 0; i < 3; i++) {
        const MdtSingleLimitID lower = MdtLimitGetLowerLimit(of[i]), upper = MdtLimitGetUpperLimit(of[i]);
        ck_assert(MdtSingleLimitGetStop(lower) == -3 && MdtSingleLimitGetStop(upper) == 4);
        ck_assert(MdtSingleLimitGetStiffness(lower) == MEINFINITY && MdtSingleLimitGetStiffness(upper) == 5);
        ck_assert(MdtSingleLimitGetDamping(lower) == 6 && MdtSingleLimitGetRestitution(lower) == (MeReal).5);
        ck_assert(MdtLimitGetStiffnessThreshold(of[i]) == 7 && MdtLimitIsActive(of[i]) && MdtLimitIsMotorized(of[i]));
        ck_assert(MdtLimitGetMotorDesiredVelocity(of[i]) == 8 && MdtLimitGetMotorMaxForce(of[i]) == 9);
        assert_near(MdtLimitGetPosition(of[i]), 0, 0);
    }
}
