/* The report of a step: each figure against what is known, or measured from what programs see. */
#include "MeProfile.h"
#include "measure.h"

static MdtWorldID reportedWorld(unsigned int bodies, unsigned int constraints, double gravity) {
    MdtWorldID w = scene_world(bodies, constraints, gravity);
    MdtWorldEnableReport(w);
    return w;
}

static MdtReport reportOf(MdtWorldID w) {
    MdtReport r;
    ck_assert(MdtWorldGetReport(w, &r));
    return r;
}

/* A contact with the floor at y = 0 under one point of a body. */
static MdtContactID touch(MdtBodyID b, double x, double z, double depth) {
    MdtContactID c = MdtContactCreate(MdtBodyGetWorld(b), b, 0);
    MdtContactSetPosition(c, x, 0, z);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactSetPenetration(c, depth);
    MdtContactEnable(c);
    return c;
}

/* ---- energy ---- */

TEST(a_falling_body_has_the_energies_of_the_closed_form) {
    MdtWorldID w = reportedWorld(1, 0, 10);
    MdtBodyID b = scene_body(w, 3, 1, 7, 2);
    MdtBodySetLinearVelocity(b, 2, 0, 0);
    for (int i = 1; i <= 30; i++) {
        MdtWorldStep(w, FRAME);
        const double t = i * (double)FRAME;
        const MdtReport r = reportOf(w);
        assert_near_rel(r.kineticEnergy, 1.5 * (4 + 100 * t * t), TOL(1e-6, 1e-13));
        assert_near_rel(r.potentialEnergy, 30 * (7 - 5 * t * t), TOL(1e-6, 1e-13));
    }
}

TEST(turning_is_kinetic_energy_and_gravity_may_point_anywhere) {
    MdtWorldID w = reportedWorld(2, 0, 0);
    const double edge[3] = {1, 2, 3};
    MdtBodyID a = scene_box(w, 2, edge, 1, 2, 3), b = scene_body(w, 5, -4, 0, 0);
    MdtWorldSetGravity(w, 3, -2, 1);
    MdtBodySetAngularVelocity(a, 1, 2, -1);
    MdtBodySetAngularVelocity(b, 3, 0, 0);
    MdtWorldStep(w, FRAME);
    MeVector3 p, q;
    MdtBodyGetCenterOfMassPosition(a, p);
    MdtBodyGetCenterOfMassPosition(b, q);
    const double kinetic = (double)MdtBodyGetKineticEnergy(a) + (double)MdtBodyGetKineticEnergy(b);
    const double potential = -2 * (3 * (double)p[0] - 2 * (double)p[1] + (double)p[2]) -
                             5 * (3 * (double)q[0] - 2 * (double)q[1] + (double)q[2]);
    const MdtReport r = reportOf(w);
    ck_assert_double_gt(kinetic, 5);
    assert_near_rel(r.kineticEnergy, kinetic, TOL(1e-6, 1e-13));
    assert_near_rel(r.potentialEnergy, potential, TOL(1e-6, 1e-13));
}

/* ---- errors ---- */

/* With gamma = 0 a joint keeps its error; with a fraction it keeps the rest, however the gap lies. */
TEST(a_joint_that_is_apart_tells_its_gap) {
    const double gammas[] = {0, .25, 1};
    for (int i = 0; i < 3; i++) {
        MdtWorldID w = reportedWorld(1, 1, 0);
        MdtBodyID b = scene_body(w, 2, 0, 0, 0);
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtWorldSetGamma(w, gammas[i]);
        MdtWorldSetEpsilon(w, 0);
        MdtBSJointSetBodies(j, b, 0);
        MdtBSJointSetPosition(j, 0, 0, 0);
        MdtBSJointEnable(j);
        MdtBodySetPosition(b, .03, .04, .12);
        MdtWorldStep(w, FRAME);
        const MdtReport r = reportOf(w);
        assert_near(r.jointGap, .13 * (1 - gammas[i]), TOL(1e-7, 1e-9));
        assert_near(r.jointError, 0, TOL(2e-12, 1e-8));
        assert_near(r.jointTurn, 0, 0);
        ck_assert_int_eq(r.rows, 3);
        ck_assert_int_eq(r.fallbacks, 0);
    }
}

/* A slider with stops at -1 and 1 m that starts at `x`, with speed v along its axis. */
static MdtReport slide(double x, double v, double gamma) {
    MdtWorldID w = reportedWorld(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtPrismaticID j = MdtPrismaticCreate(w);
    MdtWorldSetGamma(w, gamma);
    MdtWorldSetEpsilon(w, 0);
    MdtPrismaticSetBodies(j, b, 0);
    MdtPrismaticSetAxis(j, 1, 0, 0);
    MdtPrismaticEnable(j);
    const MdtLimitID limit = MdtPrismaticGetLimit(j);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), 1);
    MdtLimitActivateLimits(limit, METRUE);
    MdtBodySetPosition(b, x, 0, 0);
    MdtBodySetLinearVelocity(b, v, 0, 0);
    MdtWorldStep(w, FRAME);
    return reportOf(w);
}

/* Such a row is there before the stop is reached: how far it is away is no gap, how far it is passed is. */
TEST(a_stop_that_is_not_reached_is_no_gap) {
    for (int side = -1; side <= 1; side += 2) {
        const MdtReport open = slide(side * (1 - 1.5 * (double)FRAME), side, .2), passed = slide(side * 1.02, 0, 0);
        ck_assert_int_eq(open.rows, 6);
        assert_near(open.jointGap, 0, TOL(1e-7, 1e-9));
        ck_assert_int_eq(passed.rows, 6);
        assert_near(passed.jointGap, .02, TOL(1e-6, 1e-9));
    }
}

TEST(an_axis_that_is_off_tells_its_angle) {
    HingedBar s = scene_hingedBar(0);
    MeReal half = .05; /* the bar is turned by 0.1 rad about x: its axis leaves z */
    MdtWorldEnableReport(s.world);
    MdtWorldSetGamma(s.world, 0);
    MdtBodySetQuaternion(s.bar, MeCos(half), MeSin(half), 0, 0);
    MdtWorldStep(s.world, FRAME);
    const MdtReport r = reportOf(s.world);
    assert_near(r.jointTurn, .1, 2e-4); /* its sine */
    assert_near(r.jointGap, 0, TOL(1e-7, 1e-9));
}

/* Attachments and worlds that move are followed: that is no gap. */
TEST(a_joint_that_is_led_along_has_no_gap) {
    MdtWorldID w = reportedWorld(1, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtFixedPathID j = MdtFixedPathCreate(w);
    MeVector3 p;
    MdtWorldSetEpsilon(w, 0);
    MdtFixedPathSetBodies(j, b, 0);
    MdtFixedPathSetPosition(j, 0, 0, 0, 0);
    MdtFixedPathSetPosition(j, 1, 0, 0, 0);
    MdtFixedPathSetVelocity(j, 1, 3, 0, 0);
    MdtFixedPathEnable(j);
    MdtWorldStep(w, FRAME);
    MdtBodyGetPosition(b, p);
    assert_near(fabs(p[0]), 3 * (double)FRAME, TOL(1e-6, 5e-10));
    const MdtReport r = reportOf(w);
    assert_near(r.jointGap, 0, TOL(1e-7, 1e-8));
}

TEST(the_deepest_contact_is_told_as_it_was_when_the_step_began) {
    MdtWorldID w = reportedWorld(2, 4, 10);
    MdtBodyID a = scene_body(w, 1, 0, 1, 0), b = scene_body(w, 1, 5, 1, 0);
    touch(a, 0, 0, .01);
    touch(b, 5, 0, .03);
    MdtContactSetPenetration(touch(b, 5.5, 0, 0), -.5);
    MdtWorldStep(w, FRAME);
    assert_near(reportOf(w).penetration, .03, TOL(1e-8, 1e-15));
    MdtReport r;
    ck_assert(MdtWorldGetPartitionReport(w, MdtBodyGetPartition(a), &r));
    assert_near(r.penetration, .01, TOL(1e-8, 1e-15));
}

/* Two joints hold a body to places 2 m apart: a compromise, with half of it left in each. */
static MdtWorldID contradiction(void) {
    MdtWorldID w = reportedWorld(1, 2, 0);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtWorldSetGamma(w, 1);
    for (int i = 0; i < 2; i++) {
        MdtBSJointID j = MdtBSJointCreate(w);
        MdtBSJointSetBodies(j, b, 0);
        MdtBodySetPosition(b, i ? 1 : -1, 0, 0);
        MdtBSJointSetPosition(j, 0, 0, 0);
        MdtBSJointEnable(j);
    }
    MdtBodySetPosition(b, 0, 0, 0);
    return w;
}

TEST(joints_that_contradict_each_other_are_told) {
    MdtWorldID w = contradiction();
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    ck_assert_int_gt(r.conflicts, 0);
    assert_near(r.jointGap, 1, TOL(2e-6, 9e-9));
    assert_near(r.jointError, 1, TOL(2e-6, 9e-9));
}

/* Boxes of 1 kg and 100 kg by turns, which slide over each other and press on each other. */
static MdtWorldID pileOf(unsigned int bodies) {
    MdtWorldID w = reportedWorld(bodies, 4 * bodies, 10);
    const double edge[3] = {1, 1, 1};
    MdtWorldSetSolver(w, MdtSolverExact);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID below = 0;
    for (unsigned int i = 0; i < bodies; i++) {
        MdtBodyID b = scene_box(w, i % 2 ? 100 : 1, edge, .1 * (i % 3), i + .5, 0);
        MdtBodySetLinearVelocity(b, i % 2 ? 3 : -2, -1, 0);
        for (int k = 0; k < 4; k++) {
            MdtContactID c = MdtContactCreate(w, b, below);
            MdtContactSetPosition(c, k & 1 ? .5 : -.4, (MeReal)i, k & 2 ? .5 : -.5);
            MdtContactSetNormal(c, 0, 1, 0);
            MdtBclContactParams *params = MdtContactGetParams(c);
            MdtContactParamsSetType(params, MdtContactTypeFriction2D);
            MdtContactParamsSetFriction(params, .5);
            MdtContactEnable(c);
        }
        below = b;
    }
    return w;
}

/* A solve that is stopped short says by how much it fails, in velocity and in force. */
TEST(a_solve_that_is_stopped_short_tells_its_residual) {
    MdtReport r = {0};
    for (int cap = 0; cap <= 1; cap++) {
        MdtWorldID w = pileOf(12);
        MdtWorldSetMaxLCPIterations(w, cap);
        MdtWorldStep(w, FRAME);
        r = reportOf(w);
        ck_assert_int_eq(r.fallbacks > 0, caught.warnings > 0);
        ck_assert_int_eq(r.fallbacks > 0, cap);
        ck_assert_int_eq(r.excess > 0, cap);
        if (!cap) {
            assert_below(r.residualVelocity, 1e-5);
            assert_below(r.residualForce, 1e-1); /* of weights of 7 kN */
        }
    }
    ck_assert_double_gt(r.residualVelocity, 1e-4);
    /* A row between bodies of 1 kg and of 100 kg weighs 0.2 kg at least, 1 kg at most. */
    ck_assert_double_gt(r.residualForce * FRAME, .1 * (double)r.residualVelocity);
    messages_forget();
}

/* Of one step by the fast solver; no budget: 0. */
static MdtReport fastStep(unsigned int bodies, double accuracy, double budget) {
    MdtWorldID w = pileOf(bodies);
    MdtWorldSetSolver(w, MdtSolverFast);
    MdtWorldSetAccuracy(w, accuracy);
    MdtWorldSetWorkBudget(w, budget);
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    return r;
}

/* The fast solver takes passes until its answer meets the accuracy, as it does of one box, and tells where it does not,
 * as of many with different masses, the less where its work is bounded. */
TEST(an_excess_up_to_one_meets_the_accuracy) {
    const MdtReport lax = fastStep(1, 1e-2, 0), strict = fastStep(1, 1e-6, 0);
    assert_below(lax.excess, 1);
    assert_below(strict.excess, 1);
    ck_assert_double_ge(strict.work, lax.work);
    const MdtReport whole = fastStep(12, 1e-4, 0), limited = fastStep(12, 1e-4, 1e-3);
    ck_assert_double_gt(whole.excess, 1);
    ck_assert_double_gt(limited.excess, whole.excess);
    ck_assert_double_gt(whole.work, 2 * (double)limited.work);
}

/* A hanging chain of two: calm it needs no velocity stage; whose joint is jerked, it needs one, in this step. */
TEST(velocity_stages_are_counted) {
    MdtWorldID w = reportedWorld(2, 2, 10);
    MdtBodyID body[2];
    MdtWorldSetEpsilon(w, 0);
    for (int i = 0; i < 2; i++) {
        body[i] = scene_body(w, 1, 0, -1 - i, 0);
        scene_ball(w, body[i], i ? body[0] : 0, 0, -i, 0);
    }
    MdtWorldStep(w, FRAME); /* its forces are not known yet */
    for (int i = 0; i < 10; i++) {
        MdtWorldStep(w, FRAME);
        ck_assert_int_eq(reportOf(w).stages, 0);
    }
    MdtBodySetLinearVelocity(body[1], 3, 0, 0);
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    ck_assert_int_ge(r.stages, 1);
    ck_assert_int_le(r.stages, r.parts + 2 * r.events);
}

/* ---- what is said of a solve that is not exact: a warning of what somebody can mend, else a word for developers -- */

static char said[512]; /* to developers, last */
static int saidCount;

static void onDebug(const int level, const char *const format, va_list ap) {
    (void)level;
    saidCount++;
    vsnprintf(said, sizeof said, format, ap);
}

/* A step; what was said is in caught and said. */
static MdtReport stepListening(MdtWorldID w) {
    const int level = MeDebugLevel;
    const MeHandler before = MeSetDebugHandler(onDebug);
    MeDebugLevel = 5;
    said[0] = 0;
    saidCount = 0;
    MdtWorldStep(w, FRAME);
    MeDebugLevel = level;
    MeSetDebugHandler(before);
    return reportOf(w);
}

TEST(a_cap_that_suffices_and_an_answer_that_is_exact_are_not_spoken_of) {
    for (int cap = 0; cap <= 10000; cap += 10000) {
        HingedBar s = scene_hingedBar(10);
        MdtWorldEnableReport(s.world);
        MdtWorldSetMaxLCPIterations(s.world, cap);
        const MdtReport r = stepListening(s.world);
        ck_assert_int_eq(r.fallbacks, 0);
        ck_assert_int_eq(saidCount, 0);
    }
}

/* Nobody need mend what a budget ends: its report says so. */
TEST(a_budget_that_is_used_up_is_told_to_developers_only) {
    MdtWorldID w = pileOf(12);
    MdtWorldSetWorkBudget(w, .02);
    const MdtReport r = stepListening(w);
    ck_assert_int_gt(r.limited, 0);
    ck_assert_int_eq(saidCount, r.limited);
    ck_assert_ptr_nonnull(strstr(said, "MdtWorldSetWorkBudget"));
}

/* A bar that turns by more than a half in the shortest part of a step, a 64th. */
static HingedBar whirlingBar(void) {
    HingedBar s = scene_hingedBar(10);
    MdtWorldEnableReport(s.world);
    scene_spinBar(s, 3 * 64 / (double)FRAME);
    return s;
}

TEST(motion_that_no_part_of_a_step_can_follow_is_warned_of_without_a_cap) {
    HingedBar s = whirlingBar();
    const MdtReport r = stepListening(s.world);
    ck_assert_int_gt(r.fallbacks, 0);
    ck_assert_int_eq(r.limited, 0);
    ck_assert_int_eq(caught.warnings, r.fallbacks);
    assert_warned("shorter steps");
    ck_assert_int_eq(saidCount, 0);
}

/* Where a joint has lost its meaning, that is said, once, and what follows from it is not. */
TEST(a_joint_without_meaning_is_warned_of_and_not_the_solve_that_it_spoils) {
    HingedBar s = whirlingBar();
    const double edge[3] = {.4, .6, .5};
    MdtBodyID b = scene_box(s.world, 1, edge, .5, 1, 0);
    MdtUniversalID j = MdtUniversalCreate(s.world);
    MdtUniversalSetBodies(j, b, s.bar);
    MdtUniversalSetPosition(j, .5, 0, 0);
    MdtUniversalSetAxis(j, 0, 0, 0, 1);
    MdtUniversalSetAxis(j, 1, 0, 1, 0);
    MdtUniversalEnable(j);
    MdtBodySetQuaternion(b, sqrt(.5), 0, 0, sqrt(.5));
    const MdtReport r = stepListening(s.world);
    ck_assert_int_gt(r.fallbacks, 0);
    ck_assert_int_eq(caught.warnings, 1);
    ck_assert_ptr_null(strstr(caught.last, "inexact"));
    messages_forget();
}

TEST(a_contradiction_is_told_to_developers) {
    MdtWorldID w = contradiction();
    const MdtReport r = stepListening(w);
    ck_assert_int_gt(r.conflicts, 0);
    ck_assert_int_eq(saidCount, r.conflicts);
    ck_assert_ptr_nonnull(strstr(said, "contradictory"));
}

/* ---- counting ---- */

TEST(bodies_constraints_and_rows_are_counted_by_partition) {
    MdtWorldID w = reportedWorld(5, 8, 10);
    MdtBodyID b[5];
    for (int i = 0; i < 5; i++)
        b[i] = scene_body(w, 1, 4 * i, 1, 0);
    MdtBSJointID j = MdtBSJointCreate(w); /* 0 and 1 */
    MdtBSJointSetBodies(j, b[0], b[1]);
    MdtBSJointEnable(j);
    MdtHingeID h = MdtHingeCreate(w); /* 1 and the world */
    MdtHingeSetBodies(h, b[1], 0);
    MdtHingeEnable(h);
    touch(b[2], 8, 0, 0); /* without friction: one row */
    MdtBodyDisable(b[4]);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtWorldGetReportCount(w), 3);
    const int expected[3][3] = {{2, 2, 8}, {1, 1, 1}, {1, 0, 0}};
    double kinetic = 0;
    for (int i = 0; i < 3; i++) {
        MdtReport r;
        ck_assert(MdtWorldGetPartitionReport(w, MdtBodyGetPartition(b[i == 0 ? 0 : i + 1]), &r));
        ck_assert_int_eq(r.bodies, expected[i][0]);
        ck_assert_int_eq(r.constraints, expected[i][1]);
        ck_assert_int_eq(r.rows, expected[i][2]);
        kinetic += (double)r.kineticEnergy;
    }
    const MdtReport sum = reportOf(w);
    ck_assert_int_eq(sum.bodies, 4);
    ck_assert_int_eq(sum.constraints, 3);
    ck_assert_int_eq(sum.rows, 9);
    assert_near_rel(sum.kineticEnergy, kinetic, TOL(1e-6, 1e-14));
}

TEST(time_is_told_by_stage_and_is_less_than_the_clock_says) {
    HingedBar s = scene_hingedBar(10);
    MdtWorldEnableReport(s.world);
    MeProfileTimerResult before, after;
    MeProfileGetTimerValue(&before);
    MdtWorldStep(s.world, FRAME);
    MeProfileGetTimerValue(&after);
    const double whole = (double)(after.ticks - before.ticks) / (double)MeProfileGetClockSpeed();
    const MdtReport r = reportOf(s.world);
    double sum = 0;
    for (int i = 0; i < MdtReportStages; i++) {
        ck_assert_double_gt(r.time[i], 0);
        sum += (double)r.time[i];
    }
    assert_below(sum, whole * (1 + 1e-6));
}

/* Small ones are timed together, and each has its part. */
TEST(every_one_of_many_partitions_has_a_time) {
    enum { MANY = 40 };
    MdtWorldID w = reportedWorld(MANY, MANY, 10);
    for (int i = 0; i < MANY; i++) {
        MdtBodyID b = scene_body(w, 1, 3 * i, 0, 0);
        if (i % 3 == 0)
            continue;
        scene_ball(w, b, 0, 3 * i + 1, 0, 0);
    }
    MeProfileTimerResult before, after;
    MeProfileGetTimerValue(&before);
    MdtWorldStep(w, FRAME);
    MeProfileGetTimerValue(&after);
    double sum = 0;
    ck_assert_int_eq(MdtWorldGetReportCount(w), MANY);
    for (int i = 0; i < MANY; i++) {
        MdtReport r;
        ck_assert(MdtWorldGetPartitionReport(w, i, &r));
        for (int k = 0; k < MdtReportStages; k++) {
            ck_assert_int_eq(r.time[k] > 0, r.rows > 0 || k == MdtReportStageIntegrate);
            sum += (double)r.time[k];
        }
    }
    const MdtReport all = reportOf(w);
    assert_near_rel(all.time[0] + all.time[1] + all.time[2], sum, TOL(1e-6, 1e-14));
    assert_below(sum * (double)MeProfileGetClockSpeed(), (double)(after.ticks - before.ticks) * (1 + 1e-6));
}

/* ---- ways ---- */

TEST(free_flight_has_no_way) {
    MdtWorldID w = reportedWorld(1, 0, 10);
    scene_body(w, 1, 0, 0, 0);
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    ck_assert_int_eq(r.way, MdtReportWayNone);
    ck_assert_int_eq(r.parts, 1);
    ck_assert_int_eq(r.passes, 0);
}

TEST(a_partition_that_is_put_to_rest_has_no_way_and_no_part) {
    MdtWorldID w = reportedWorld(1, 0, 0);
    MdtWorldSetAutoDisable(w, 1);
    MdtBodyID b = scene_body(w, 2, 0, 3, 0);
    MdtReport r;
    for (int i = 0; i < 60 && MdtBodyIsEnabled(b); i++)
        MdtWorldStep(w, FRAME);
    ck_assert(!MdtBodyIsEnabled(b));
    r = reportOf(w);
    ck_assert_int_eq(r.bodies, 1);
    ck_assert_int_eq(r.parts, 0);
    ck_assert_int_eq(r.way, MdtReportWayNone);
    MdtWorldStep(w, FRAME);
    r = reportOf(w);
    ck_assert_int_eq(r.bodies, 0);
    ck_assert_int_eq(MdtWorldGetReportCount(w), 0);
}

TEST(the_answer_for_a_box_at_rest_is_kept) {
    MdtWorldID w = reportedWorld(1, 4, 10);
    const double edge[3] = {1, 1, 1};
    MdtBodyID b = scene_box(w, 1, edge, 0, .5, 0);
    MdtWorldSetEpsilon(w, 0);
    for (int k = 0; k < 4; k++)
        touch(b, k & 1 ? .5 : -.5, k & 2 ? .5 : -.5, 0);
    steps(w, 60, FRAME);
    MdtReport r = reportOf(w);
    ck_assert_int_eq(r.way, MdtReportWayRest);
    ck_assert_int_eq(r.rested, 1);
    ck_assert_int_eq(r.rows, 0);
    for (int i = 0; i < 4 && r.way != MdtReportWayKept; i++) {
        MdtWorldSetTimedContacts(w, 2 + i); /* a change, for which the answer holds, but for rounding at times */
        MdtWorldStep(w, FRAME);
        r = reportOf(w);
    }
    ck_assert_int_eq(r.way, MdtReportWayKept);
    ck_assert_int_eq(r.factorizations, 0);
    ck_assert_int_eq(r.rows, 4);
    assert_near(r.kineticEnergy, 0, 1e-12);
    assert_near(r.potentialEnergy, 5, TOL(1e-6, 1e-9));
}

TEST(a_pendulum_is_solved) {
    HingedBar s = scene_hingedBar(10);
    MdtWorldEnableReport(s.world);
    const double before = MdtBodyGetKineticEnergy(s.bar);
    for (int i = 0; i < 20; i++) {
        MdtWorldStep(s.world, FRAME);
        const MdtReport r = reportOf(s.world);
        ck_assert_int_eq(r.way, MdtReportWayExact);
        ck_assert_int_gt(r.passes, 0);
        ck_assert_int_gt(r.iterations, 0);
        ck_assert_int_gt(r.factorizations, 0);
        ck_assert_int_eq(r.parts, 1);
        ck_assert_int_eq(r.fallbacks + r.conflicts + r.events, 0);
        assert_below(r.residualVelocity, 1e-6);
        assert_below(r.residualForce, 1e-4);
        assert_below(r.jointGap, 1e-7);
        assert_near(r.kineticEnergy + r.potentialEnergy, before, TOL(2e-5, 9e-9)); /* of 5 J that fall */
    }
}

TEST(a_ball_that_bounces_is_timed) {
    MdtWorldID w = reportedWorld(1, 1, 10);
    MdtBodyID b = scene_body(w, 1, 0, .5 + .05, 0);
    MdtBodySetLinearVelocity(b, 0, -6, 0); /* half a step to the floor */
    MdtContactID c = touch(b, 0, 0, -.05);
    MdtContactParamsSetRestitution(MdtContactGetParams(c), 1);
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    ck_assert_int_eq(r.way, MdtReportWayTimed);
    ck_assert_int_eq(r.events, 1);
    ck_assert_int_eq(r.parts, 2);
    assert_near_rel(r.kineticEnergy + r.potentialEnergy, 18 + 5.5, TOL(1e-6, 1e-9));
}

/* The parts of a step in which a ball turns about y by more than a step can follow, on the floor or on a body that
 * stands still, which is then the contact's first. */
static int partsOfWhirl(double ballRadius, double contactRadius, double offX, double offZ, MeBool isOnBody) {
    MdtWorldID w = reportedWorld(2, 1, 0);
    MdtBodyID b = scene_body(w, 1, 0, ballRadius, 0), floor = isOnBody ? scene_body(w, 1000, 0, -1, 0) : 0;
    MdtContactID c = floor ? MdtContactCreate(w, floor, b) : MdtContactCreate(w, b, 0);
    MdtContactSetPosition(c, offX, 0, offZ);
    MdtContactSetNormal(c, 0, floor ? -1 : 1, 0);
    MdtContactSetRadius(c, floor ? 1 : 0, contactRadius);
    MdtContactEnable(c);
    MdtBodySetAngularVelocity(b, 0, 3 / FRAME, 0);
    MdtWorldStep(w, FRAME);
    const int parts = reportOf(w).parts;
    return parts;
}

/* How a ball is turned matters where a contact pushes past its centre, by more than a thousandth of the radius: the
 * step is then taken in parts, and else in one. So it is with a corner, even under the centre, which turns with the
 * body. */
TEST(a_whirling_ball_is_divided_where_a_contact_pushes_past_its_centre) {
    const double radius = .5, past = 1.2e-3 * radius, within = .8e-3 * radius;
    for (int isOnBody = 0; isOnBody < 2; isOnBody++) {
        for (int side = -1; side <= 1; side += 2) {
            ck_assert_int_eq(partsOfWhirl(radius, radius, side * past, 0, isOnBody), 2);
            ck_assert_int_eq(partsOfWhirl(radius, radius, 0, side * past, isOnBody), 2);
            ck_assert_int_eq(partsOfWhirl(radius, radius, side * within, 0, isOnBody), 1);
            ck_assert_int_eq(partsOfWhirl(radius, radius, 0, side * within, isOnBody), 1);
        }
        ck_assert_int_eq(partsOfWhirl(radius, 0, 0, 0, isOnBody), 2);
    }
}

/* Links that whirl against each other by more than a step can follow. */
static MdtWorldID violentChain(void) {
    MdtWorldID w = reportedWorld(4, 4, 10);
    const double edge[3] = {1, .1, .1};
    MdtBodyID last = 0;
    for (int i = 0; i < 4; i++) {
        MdtBodyID b = scene_box(w, 1, edge, i + .5, 0, 0);
        scene_ball(w, b, last, i, 0, 0);
        MdtBodySetAngularVelocity(b, 0, i % 2 ? 150 : -150, i % 2 ? -150 : 150);
        last = b;
    }
    return w;
}

TEST(a_violent_chain_divides_its_step) {
    MdtWorldID w = violentChain();
    MdtWorldStep(w, FRAME);
    const MdtReport r = reportOf(w);
    ck_assert_int_eq(r.way, MdtReportWayDivided);
    ck_assert_int_gt(r.parts, 1);
    ck_assert_int_eq(r.rows, 12);
}

TEST(a_world_goes_the_way_of_the_most_effort) {
    MdtWorldID w = violentChain();
    MdtReport r;
    MdtWorldSetSubSteps(w, 2);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(reportOf(w).way, MdtReportWayDivided);
    w = reportedWorld(2, 1, 10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    scene_body(w, 1, 9, 0, 0);
    scene_ball(w, b, 0, 1, 0, 0);
    MdtWorldSetSubSteps(w, 2);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(reportOf(w).way, MdtReportWayExact);
    ck_assert(MdtWorldGetPartitionReport(w, 1, &r));
    ck_assert_int_eq(r.way, MdtReportWayNone);
    ck_assert_int_eq(r.parts, 2);
}

/* ---- on and off ---- */

static void assert_zero(const MdtReport *r) {
    static const MdtReport zero;
    ck_assert(memcmp(r, &zero, sizeof zero) == 0);
}

TEST(off_it_is_zero) {
    MdtWorldID w = scene_world(1, 0, 10);
    MdtReport r;
    scene_body(w, 1, 0, 1, 0);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(MdtWorldReportIsEnabled(w), i == 1); /* never on; on, but no step yet; off again */
        memset(&r, 1, sizeof r);
        ck_assert(!MdtWorldGetReport(w, &r));
        assert_zero(&r);
        memset(&r, 1, sizeof r);
        ck_assert(!MdtWorldGetPartitionReport(w, 0, &r));
        assert_zero(&r);
        ck_assert_int_eq(MdtWorldGetReportCount(w), 0);
        if (i == 0) {
            MdtWorldStep(w, FRAME);
            MdtWorldEnableReport(w);
        } else {
            MdtWorldStep(w, FRAME);
            ck_assert_int_eq(MdtWorldGetReportCount(w), i == 1);
            MdtWorldDisableReport(w);
        }
    }
}

TEST(bad_input_is_warned_of) {
    MdtWorldID w = reportedWorld(1, 0, 10);
    MdtReport r;
    scene_body(w, 1, 0, 1, 0);
    MdtWorldStep(w, FRAME);
    assert_refused(MdtWorldEnableReport, NULL);
    assert_refused(MdtWorldDisableReport, NULL);
    assert_none(MdtWorldReportIsEnabled, NULL);
    assert_none(MdtWorldGetReportCount, NULL);
    assert_none(MdtWorldGetReport, w, NULL);
    assert_none(MdtWorldGetPartitionReport, w, 0, NULL);
    memset(&r, 1, sizeof r);
    assert_none(MdtWorldGetReport, NULL, &r);
    assert_zero(&r);
    memset(&r, 1, sizeof r);
    assert_none(MdtWorldGetPartitionReport, NULL, 0, &r);
    assert_zero(&r);
    for (int i = -1; i <= 1; i += 2) {
        memset(&r, 1, sizeof r);
        assert_none(MdtWorldGetPartitionReport, w, i, &r);
        assert_zero(&r);
    }
}

/* A program's callback may switch it in the middle of a step. */
static void MEAPI toggle(MdtPartitionOutput *po, void *data) {
    int *calls = data;
    if (++*calls % 3 == 0)
        MdtWorldDisableReport(po->world);
    else if (*calls % 3 == 1)
        MdtWorldEnableReport(po->world);
    MdtReport r;
    MdtWorldGetReport(po->world, &r);
}

TEST(it_may_be_switched_during_a_step) {
    MdtWorldID w = reportedWorld(4, 0, 10);
    int calls = 0;
    for (int i = 0; i < 4; i++)
        scene_body(w, 1, 3 * i, 0, 0);
    MdtWorldSetPartitionCB(w, toggle, &calls);
    steps(w, 5, FRAME);
    ck_assert_int_eq(calls, 20);
    MdtWorldSetPartitionCB(w, 0, 0);
    MdtWorldEnableReport(w);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(reportOf(w).bodies, 4);
}

static MdtWorldID mixedScene(MdtBodyID b[4]) {
    MdtWorldID w = scene_world(4, 8, 10);
    const double edge[3] = {1, .1, .1};
    for (int i = 0; i < 3; i++) {
        b[i] = scene_box(w, 1 + i, edge, i + .5, 3, 0);
        scene_ball(w, b[i], i ? b[i - 1] : 0, i, 3, 0);
        MdtBodySetAngularVelocity(b[i], 0, i % 2 ? 150 : -150, 20);
    }
    b[3] = scene_body(w, 1, 9, .6, 0);
    MdtContactID c = touch(b[3], 9, 0, -.1);
    MdtContactParamsSetRestitution(MdtContactGetParams(c), .5);
    return w;
}

TEST(the_simulation_is_the_same_bit_for_bit) {
    MdtBodyID with[4], without[4];
    MdtWorldID a = mixedScene(with), b = mixedScene(without);
    MdtWorldEnableReport(a);
    int max = 0;
    for (int i = 0; i < 60; i++) {
        MdtWorldStep(a, FRAME);
        MdtWorldStep(b, FRAME);
        const int way = (int)reportOf(a).way;
        max = way > max ? way : max;
        for (int k = 0; k < 4; k++) {
            ck_assert(memcmp(MdtBodyGetTransformPtr(with[k]), MdtBodyGetTransformPtr(without[k]), sizeof(MeMatrix4)) ==
                      0);
            MeVector3 v[2], u[2];
            MdtBodyGetLinearVelocity(with[k], v[0]), MdtBodyGetAngularVelocity(with[k], v[1]);
            MdtBodyGetLinearVelocity(without[k], u[0]), MdtBodyGetAngularVelocity(without[k], u[1]);
            for (int n = 0; n < 2; n++)
                ck_assert(memcmp(v[n], u[n], 3 * sizeof(MeReal)) == 0);
        }
    }
    ck_assert_int_eq(max, MdtReportWayDivided);
}
