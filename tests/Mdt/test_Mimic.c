/* Mimics: joints whose coordinates follow each other. */
#include "measure.h"

typedef struct {
    MdtWorldID world;
    MdtBodyID body[3]; /* two fingers and their hand; null: the world */
    MdtConstraintID joint[2];
    MdtLimitID limit[2];
    MdtMimicID mimic;
} Hand;

typedef enum { FIXED, FREE, MOVED } HandKind;

static void addJoint(Hand *s, int i, int turns) {
    if (turns) {
        MdtHingeID j = MdtHingeCreate(s->world);
        MdtHingeSetBodies(j, s->body[i], s->body[2]);
        MdtHingeSetPosition(j, (MeReal)(i ? .5 : -.5), 0, 0);
        MdtHingeSetAxis(j, 0, (MeReal)(i ? 1 : -1), (MeReal)(i ? .5 : .2));
        s->limit[i] = MdtHingeGetLimit(j);
        s->joint[i] = MdtHingeQuaConstraint(j);
    } else {
        MdtPrismaticID j = MdtPrismaticCreate(s->world);
        MdtPrismaticSetBodies(j, s->body[i], s->body[2]);
        MdtPrismaticSetAxis(j, (MeReal)(i ? -1 : 1), 0, 0);
        s->limit[i] = MdtPrismaticGetLimit(j);
        s->joint[i] = MdtPrismaticQuaConstraint(j);
    }
    MdtConstraintEnable(s->joint[i]);
    MdtLimitCalculatePosition(s->limit[i], 1);
}

/* turns: set of the fingers that turn; the others slide towards each other. */
static Hand makeHand(HandKind kind, int turns, double ratio, double mass) {
    const double edge[3] = {.2, .4, .3};
    Hand s;
    s.world = scene_world(6, 8, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.body[0] = scene_box(s.world, 1, edge, -1, 0, 0);
    s.body[1] = scene_box(s.world, 2, edge, 1, 0, 0);
    s.body[2] = kind == FIXED ? NULL : scene_box(s.world, mass, edge, 0, -.3, .1);
    if (kind == MOVED)
        MdtBodySetKinematic(s.body[2], METRUE);
    for (int i = 0; i < 2; i++)
        addJoint(&s, i, turns >> i & 1);
    s.mimic = MdtMimicCreate(s.world);
    MdtMimicSetRatio(s.mimic, (MeReal)ratio);
    MdtMimicSetJoints(s.mimic, s.joint[0], s.joint[1]);
    MdtMimicEnable(s.mimic);
    return s;
}

static double errorOf(Hand s) {
    return (double)MdtLimitGetPosition(s.limit[1]) -
           (double)MdtMimicGetRatio(s.mimic) * (double)MdtLimitGetPosition(s.limit[0]) -
           (double)MdtMimicGetOffset(s.mimic);
}

/* ---- motion ---- */

/* A force F on the first finger of the mass 1: a = F / (1 + r² 2); of the second: F r / (...). */
TEST(the_second_joint_adds_its_mass_times_the_ratio_squared) {
    static const double ratio[] = {1, -1, .5, 3};
    for (int i = 0; i < 4; i++)
        for (int part = 1; part <= 8; part *= 2) {
            const double r = ratio[i], a = 5 / (1 + 2 * r * r), time = 8 / 30.;
            Hand s = makeHand(FIXED, 0, r, 0);
            for (int n = 0; n < 8 * part; n++) {
                MdtBodyAddForce(s.body[0], 5, 0, 0);
                MdtWorldStep(s.world, (MeReal)(1. / (30 * part)));
            }
            double v[2][3];
            for (int k = 0; k < 2; k++)
                measure_velocity(s.body[k], v[k]);
            assert_near(v[0][0], a * time, TOL(1e-6, 1e-7));
            assert_near(v[1][0], -r * a * time, TOL(1e-6, 1e-7));
            assert_near(errorOf(s), 0, TOL(2e-7, 1e-9));
        }
}

static void momenta(Hand s, double sum[6], double *energy) {
    memset(sum, 0, 6 * sizeof *sum);
    *energy = 0;
    for (int k = 0; k < 3; k++) {
        double linear[3], angular[3], v[3], w[3], spin[3], p[3], orbital[3];
        measure_momentum(s.body[k], linear, angular);
        measure_velocity(s.body[k], v);
        measure_rate(s.body[k], w);
        measure_position(s.body[k], p);
        keaCross(orbital, p, linear);
        keaSubtract(spin, angular, orbital);
        *energy += .5 * (keaDot(linear, v) + keaDot(spin, w));
        keaAddScaled(sum, 1, linear);
        keaAddScaled(sum + 3, 1, angular);
    }
}

/* Nothing fixed acts on a free hand: with three bodies in a row, as light as a finger or a hundredth of it, momentum
 * and angular momentum stay, and energy. */
TEST(a_free_hand_keeps_its_momenta_and_energy) {
    static const double mass[] = {5, .02, 1e3};
    for (int m = 0; m < 3; m++)
        for (int turns = 0; turns < 4; turns++) {
            Hand s = makeHand(FREE, turns, 2, mass[m]);
            double before[6], after[6], energy[2];
            MdtBodySetLinearVelocity(s.body[0], (MeReal).3, (MeReal).1, 0);
            MdtBodySetAngularVelocity(s.body[0], (MeReal).3, (MeReal).5, 1);
            MdtBodySetAngularVelocity(s.body[1], 0, (MeReal)-.5, (MeReal).5);
            steps(s.world, 1, FRAME); /* an impulse makes the velocities those of the joints */
            ck_assert_int_eq(MdtConstraintGetRowCount(MdtMimicQuaConstraint(s.mimic)), 2);
            momenta(s, before, &energy[0]);
            steps(s.world, 120, FRAME);
            momenta(s, after, &energy[1]);
            for (int i = 0; i < 6; i++)
                assert_near(after[i], before[i], TOL(2e-5, 1e-6) * (m == 2 ? 10 : 1));
            assert_near_rel(energy[1], energy[0], 2e-3);
            assert_near(errorOf(s), 0, TOL(1e-6, 1e-8));
            ck_assert(fabs((double)MdtLimitGetPosition(s.limit[0])) > 1e-4);
        }
}

/* The hand is carried about by the program: the fingers stay together, and follow. */
TEST(a_hand_that_the_program_moves) {
    for (int turns = 0; turns < 4; turns++) {
        Hand s = makeHand(MOVED, turns, 1, 1);
        MdtLimitSetLimitedForceMotor(s.limit[0], (MeReal).2, 50);
        for (int i = 0; i < 120; i++) {
            const double t = pow((i + 1) / 60., 2) / 2; /* without a jerk */
            const MeVector3 p = {(MeReal)sin(t), (MeReal)(-.3 + .5 * t), (MeReal).1};
            const MeVector4 q = {(MeReal)cos(t), 0, 0, (MeReal)sin(t)};
            MdtBodyMoveTo(s.body[2], p, q);
            MdtWorldStep(s.world, FRAME);
            assert_near(errorOf(s), 0, TOL(2e-6, 1e-7));
        }
        ck_assert((double)MdtLimitGetPosition(s.limit[0]) > .3);
    }
}

/* Both fingers close on a box that is not in the middle, alike, by either solver. */
TEST(a_gripper_closes_alike) {
    for (int run = 0; run < 3; run++) {
        const HandKind kind = run == 1 ? FREE : FIXED;
        Hand s = makeHand(kind, 0, 1, 3);
        MdtReport report;
        int fastSteps = 0;
        MdtWorldSetSolver(s.world, run == 2 ? MdtSolverFast : MdtSolverAuto);
        MdtWorldEnableReport(s.world);
        const double edge[3] = {.3, .3, .3};
        MdtBodyID box = scene_box(s.world, 1, edge, .07, 0, 0);
        MdtLimitSetLimitedForceMotor(s.limit[0], (MeReal).5, 100);
        MdtBodyID fingers[2] = {s.body[0], s.body[1]};
        MdtContactID contact[2];
        for (int k = 0; k < 2; k++) {
            contact[k] = MdtContactCreateBetween(s.world, box, fingers[k]);
            MdtContactSetNormal(contact[k], k ? -1 : 1, 0, 0);
            MdtContactEnable(contact[k]);
        }
        for (int i = 0; i < 240; i++) {
            double b[3], f[3];
            measure_position(box, b);
            for (int k = 0; k < 2; k++) {
                measure_position(fingers[k], f);
                const double gap = (k ? f[0] - b[0] : b[0] - f[0]) - .25;
                MdtContactSetPosition(contact[k], (MeReal)(b[0] + (k ? .15 : -.15)), (MeReal)b[1], (MeReal)b[2]);
                MdtContactSetPenetration(contact[k], (MeReal)-gap);
            }
            MdtWorldStep(s.world, FRAME);
            MdtWorldGetReport(s.world, &report);
            fastSteps += report.way == MdtReportWayFast;
            assert_near(errorOf(s), 0, 1e-6);
        }
        ck_assert_int_eq(fastSteps > 60, run == 2);                                     /* then it is at rest */
        assert_near(MdtLimitGetPosition(s.limit[0]), .75, kind == FIXED ? 1e-6 : 2e-3); /* a free hand pitches */
        MeVector3 squeeze;
        MdtContactGetForce(contact[0], 0, squeeze);
        assert_near(squeeze[0], 50, kind == FIXED ? .01 : .5); /* half of the 100 N at each finger */
    }
}

/* A limit of the second joint stops the first. */
TEST(limits_act_on_both) {
    Hand s = makeHand(FIXED, 0, 2, 0);
    MdtLimitActivateLimits(s.limit[1], 1);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(s.limit[1]), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(s.limit[1]), (MeReal).3);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(s.limit[1]), 0);
    MdtLimitSetLimitedForceMotor(s.limit[0], 1, 100);
    steps(s.world, 120, FRAME);
    assert_near(MdtLimitGetPosition(s.limit[1]), .3, TOL(1e-6, 1e-8));
    assert_near(MdtLimitGetPosition(s.limit[0]), .15, TOL(1e-6, 1e-8));
}

/* Full turns, an offset, and a joint that turns while the other one slides. */
TEST(a_turning_joint_moves_a_sliding_one) {
    Hand s = makeHand(FIXED, 1, .01, 0);
    MdtMimicSetOffset(s.mimic, (MeReal).001);
    MdtLimitSetLimitedForceMotor(s.limit[0], 10, 1000);
    steps(s.world, 600, FRAME);
    assert_near(MdtLimitGetPosition(s.limit[0]), 599.5 * 2 * atan(10 / 120.), 1e-3); /* the midpoint rule's turns */
    assert_near(errorOf(s), 0, TOL(1e-6, 1e-8));
}

/* Two joints in a row of links: the second body is the first one's ground. */
TEST(joints_in_a_row) {
    const double edge[3] = {1, .1, .1};
    MdtWorldID w = scene_world(2, 3, 0);
    MdtBodyID upper = scene_box(w, 1, edge, .5, 0, 0), lower = scene_box(w, 1, edge, 1.5, 0, 0);
    MdtHingeID shoulder = scene_hinge(w, upper, 0, 0, 0, 0, 0, 0, 1),
               elbow = scene_hinge(w, lower, upper, 1, 0, 0, 0, 0, 1);
    MdtMimicID mimic = MdtMimicCreate(w);
    MdtMimicSetRatio(mimic, -1);
    MdtMimicSetJoints(mimic, MdtHingeQuaConstraint(shoulder), MdtHingeQuaConstraint(elbow));
    MdtMimicEnable(mimic);
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(shoulder), 1, 1000);
    steps(w, 90, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtMimicQuaConstraint(mimic)), 1);
    double R[3][3], rate[3];
    measure_rotation(lower, R); /* it keeps its direction: a parallelogram */
    assert_near(R[1][0], 0, 1e-4);
    measure_rate(lower, rate);
    assert_near(rate[2], 0, 1e-4);
}

/* A locked differential: the motor at one wheel drives both, steered or not, against a brake at the other one. */
TEST(wheels_of_a_car) {
    const double edge[3] = {3, .5, 1.5}, disc[3] = {.5, .5, .1};
    MdtWorldID w = scene_world(3, 3, 0);
    MdtBodyID chassis = scene_box(w, 500, edge, 0, 0, 0), wheel[2];
    MdtCarWheelID joint[2];
    for (int i = 0; i < 2; i++) {
        wheel[i] = scene_box(w, 10, disc, 1, 0, i ? .8 : -.8);
        joint[i] = MdtCarWheelCreate(w);
        MdtCarWheelSetBodies(joint[i], chassis, wheel[i]);
        MdtCarWheelSetPosition(joint[i], 1, 0, (MeReal)(i ? .8 : -.8));
        MdtCarWheelSetSteeringAndHingeAxes(joint[i], 0, 1, 0, 0, 0, 1);
        MdtCarWheelSetSuspension(joint[i], 1e5, 1e3, 0, -1, 1, 0);
        MdtCarWheelSetSteeringPositionMotor(joint[i], (MeReal).4, 5, 1, 1e5);
        MdtCarWheelEnable(joint[i]);
    }
    MdtMimicID mimic = MdtMimicCreate(w);
    MdtMimicSetJoints(mimic, MdtCarWheelQuaConstraint(joint[0]), MdtCarWheelQuaConstraint(joint[1]));
    MdtMimicEnable(mimic);
    MdtCarWheelSetHingeLimitedForceMotor(joint[0], 5, 20);
    MdtCarWheelSetHingeLimitedForceMotor(joint[1], 0, 5);
    double turned = 0, R[2][3][3];
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < 2; k++)
            measure_rotation(wheel[k], R[k]);
        for (int k = 0; k < 9; k++)
            assert_near(R[1][k / 3][k % 3], R[0][k / 3][k % 3], 1e-5);
        turned += (double)MdtCarWheelGetHingeAngleRate(joint[1]) / 60;
    }
    assert_near(MdtCarWheelGetSteeringAngle(joint[1]), .4, .02);
    ck_assert(turned > 10);
}

/* ---- life ---- */

TEST(a_joint_that_is_gone_ends_it) {
    Hand s = makeHand(FIXED, 0, 1, 0);
    MdtConstraintDisable(s.joint[1]);
    steps(s.world, 1, FRAME);
    assert_warned("Mimic");
    steps(s.world, 10, FRAME);
    assert_silent(); /* once */
    MdtBodySetLinearVelocity(s.body[0], 1, 0, 0);
    steps(s.world, 1, FRAME);
    double v[3];
    measure_velocity(s.body[0], v);
    assert_near(v[0], 1, TOL(1e-6, 1e-12)); /* nothing couples */
    MdtConstraintEnable(s.joint[1]);
    steps(s.world, 2, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtMimicQuaConstraint(s.mimic)), 1);
    assert_silent();
    MdtConstraintDestroy(s.joint[0]);
    ck_assert(!MdtMimicGetJoint(s.mimic, 0) && MdtMimicGetJoint(s.mimic, 1) == s.joint[1]);
    steps(s.world, 1, FRAME);
    assert_warned("destroyed");
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtMimicQuaConstraint(s.mimic)), 0);
}

TEST(other_bodies_end_it) {
    Hand s = makeHand(FREE, 0, 1, 1);
    MdtBodyID other = scene_body(s.world, 1, 5, 5, 5);
    steps(s.world, 2, FRAME);
    MdtConstraintDisable(s.joint[1]);
    MdtConstraintSetBodies(s.joint[1], other, s.body[2]);
    MdtConstraintEnable(s.joint[1]);
    steps(s.world, 1, FRAME);
    assert_warned("other bodies");
    MdtMimicDisable(s.mimic);
    MdtMimicSetJoints(s.mimic, s.joint[0], s.joint[1]);
    MdtMimicEnable(s.mimic);
    steps(s.world, 2, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtMimicQuaConstraint(s.mimic)), 2);
    MdtBodyDestroy(s.body[2]); /* takes the joints' bodies */
    steps(s.world, 2, FRAME);
    messages_forget();
}

TEST(what_cannot_be_mimicked) {
    Hand s = makeHand(FIXED, 0, 1, 0);
    MdtBSJointID ball = scene_ball(s.world, s.body[0], s.body[1], 0, 0, 0);
    MdtHingeID bare = MdtHingeCreate(s.world);
    assert_refused(MdtMimicSetJoints, s.mimic, s.joint[0], MdtBSJointQuaConstraint(ball));
    assert_refused(MdtMimicSetJoints, s.mimic, s.joint[0], s.joint[0]);
    assert_refused(MdtMimicSetJoints, s.mimic, MdtHingeQuaConstraint(bare), s.joint[0]);
    assert_refused(MdtMimicSetJoints, s.mimic, NULL, s.joint[0]);
    ck_assert(MdtMimicGetJoint(s.mimic, 0) == s.joint[0] && MdtMimicGetJoint(s.mimic, 1) == s.joint[1]);
}

/* Two hinged pairs: the program may begin to move any of the four bodies while the mimic acts. */
TEST(a_body_of_two_pairs_that_the_program_begins_to_move) {
    static const double edge[3] = {.2, .2, .2};
    for (int moved = 0; moved < 4; moved++) {
        MdtWorldID w = scene_world(4, 6, 0);
        MdtBodyID body[4];
        MdtConstraintID hinge[2];
        for (int i = 0; i < 4; i++)
            body[i] = scene_box(w, 1, edge, i, 0, 0);
        for (int i = 0; i < 2; i++) {
            const MdtHingeID j = MdtHingeCreate(w);
            MdtHingeSetBodies(j, body[2 * i], body[2 * i + 1]);
            MdtHingeSetPosition(j, (MeReal)(2 * i + .5), 0, 0);
            MdtHingeSetAxis(j, 0, 1, 0);
            MdtHingeEnable(j);
            MdtLimitCalculatePosition(MdtHingeGetLimit(j), 1);
            hinge[i] = MdtHingeQuaConstraint(j);
        }
        const MdtMimicID mimic = MdtMimicCreate(w);
        MdtMimicSetJoints(mimic, hinge[0], hinge[1]);
        MdtMimicEnable(mimic);
        MdtBodySetKinematic(body[moved], METRUE);
        MdtBodySetAngularVelocity(body[moved < 2 ? 3 : 0], 0, 10, 0);
        for (int i = 0; i < 30; i++)
            MdtWorldStep(w, FRAME);
        const double first = (double)MdtLimitGetPosition(MdtHingeGetLimit((MdtHingeID)hinge[0]));
        const double second = (double)MdtLimitGetPosition(MdtHingeGetLimit((MdtHingeID)hinge[1]));
        assert_near(second, first, TOL(1e-4, 1e-6));
        assert_below(.03, fabs(first));
    }
}
