/* Many bodies each by itself (mdt_batch.c): those that are the fast solver's are stepped together by it, without being
 * tied to each other. */
#include "universe.h"

#include "jointed.h"

#define FRAME ((MeReal)(1. / 60))

enum { MANY = 100 };

static void turn(McdModelID m) {
    MeReal q[4];
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)between(-.5, .5);
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
}

/* On a grid, 12 m apart, turned any way, thrown in any direction. */
static void scatter(MdtSolver solver, McdGeometryID (*make)(void), int count) {
    seed = 1;
    makeWorld(solver, .5);
    for (int i = 0; i < count; i++) {
        const McdModelID m = putAt(make(), 12 * (i % 25), 1, 12 * (i / 25), 500);
        turn(m);
        McdModelDynamicsSetLinearVelocity(m, between(-3, 3), 0, between(-3, 3));
    }
}

static McdGeometryID brick(void) {
    return box(.6, .5, .4);
}

static McdGeometryID marble(void) {
    return ball(.3);
}

static MdtReport step(int steps) {
    MdtReport r;
    for (int i = 0; i < steps; i++)
        MstUniverseStep(u, FRAME);
    ck_assert(MdtWorldGetReport(u->world, &r));
    return r;
}

static MdtReport reportOf(int partition) {
    MdtReport r;
    ck_assert(MdtWorldGetPartitionReport(u->world, partition, &r));
    return r;
}

/* Partitions that the last step took that way. */
static int countWay(MdtReportWay way) {
    int count = 0;
    for (int i = 0; i < MdtWorldGetReportCount(u->world); i++)
        count += reportOf(i).way == way;
    return count;
}

static int maxTaken(MdtReportWay way, int steps) {
    int max = 0;
    for (int i = 0; i < steps; i++) {
        step(1);
        max = MeMAX(max, countWay(way));
    }
    return max;
}

static void placeOf(int i, double place[3]) {
    MeVector3 p;
    MdtBodyGetCenterOfMassPosition(McdModelGetBody(model[i]), p);
    for (int k = 0; k < 3; k++)
        place[k] = (double)p[k];
}

static double distanceOf(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* ---- the choice ---- */

TEST(what_the_program_wants_exact_is_exact) {
    scatter(MdtSolverExact, brick, MANY);
    ck_assert_int_eq(maxTaken(MdtReportWayFast, 30), 0);
    scatter(MdtSolverAuto, brick, MANY);
    MdtWorldSetAccuracy(u->world, 0);
    ck_assert_int_eq(maxTaken(MdtReportWayFast, 30), 0);
}

/* v²/(2 μ g). */
TEST(what_slides_without_being_hit_is_exact) {
    const double speed = 5, way = speed * speed / (2 * .5 * gravity);
    makeWorld(MdtSolverAuto, .5);
    for (int i = 0; i < MANY; i++)
        McdModelDynamicsSetLinearVelocity(putAt(brick(), 4 * (i % 10), .25, 4 * (i / 10), 500), speed, 0, 0);
    ck_assert_int_eq(maxTaken(MdtReportWayFast, 70), 0);
    for (int i = 0; i < MANY; i++) {
        double place[3];
        placeOf(i, place);
        assert_near(place[0] - 4 * (i % 10), way, 1e-4);
    }
}

TEST(what_bounces_is_met_in_time) {
    scatter(MdtSolverAuto, marble, MANY);
    MdtContactParamsSetRestitution(MstBridgeGetContactParams(u->bridge, 0, 0), 1);
    const MdtReport before = step(1);
    ck_assert_int_eq(maxTaken(MdtReportWayFast, 120), 0);
    const MdtReport after = step(1); /* friction takes 2/7 of 3 J/kg, on average, of 12.8: until the balls roll */
    ck_assert_double_gt((double)after.kineticEnergy + (double)after.potentialEnergy,
                        .9 * ((double)before.kineticEnergy + (double)before.potentialEnergy));
}

/* ---- what they do ---- */

/* What rocks within its resting depths rests by coming back (mdt_sleep.c). */
TEST(they_come_to_rest_on_the_ground) {
    scatter(MdtSolverAuto, brick, MANY);
    MdtWorldSetAutoDisable(u->world, METRUE);
    const MdtReport r = step(300);
    ck_assert_double_lt(r.kineticEnergy, 1e-6);
    for (int i = 0; i < MANY; i++) {
        double place[3];
        placeOf(i, place);
        ck_assert_msg(!MdtBodyIsEnabled(McdModelGetBody(model[i])), "brick %d is awake", i);
        const double off = fmin(fabs(place[1] - .3), fmin(fabs(place[1] - .25), fabs(place[1] - .2)));
        ck_assert_msg(off < 1e-4, "brick %d lies at %g", i, place[1]);
    }
}

TEST(balls_roll) {
    scatter(MdtSolverAuto, marble, MANY);
    step(90);
    for (int i = 0; i < MANY; i++) {
        MeVector3 v, w;
        MdtBodyGetLinearVelocity(McdModelGetBody(model[i]), v);
        MdtBodyGetAngularVelocity(McdModelGetBody(model[i]), w);
        assert_near(w[2], -(double)v[0] / .3, 1e-3);
        assert_near(w[0], (double)v[2] / .3, 1e-3);
    }
}

/* m: how far a brick slides that begins with 2 m/s and spins with 8 rad/s about the vertical. */
static double slideSpinning(MdtSolver solver) {
    double place[3];
    makeWorld(solver, .5);
    const McdModelID m = putAt(brick(), 0, .25, 0, 500);
    McdModelDynamicsSetLinearVelocity(m, 2, 0, 0);
    MdtBodySetAngularVelocity(McdModelGetBody(m), 0, 8, 0);
    step(60);
    placeOf(0, place);
    return place[0];
}

/* Coulomb's law at each corner, with loads that go with the moment of friction, integrated in steps of 1e-4 s: .5706 m.
 * The fast solver lets friction act at the middle and, as much as it can, about the normal. */
TEST(what_spins_while_it_slides_is_stopped_earlier_by_the_fast_solver) {
    const double exact = slideSpinning(MdtSolverExact), fast = slideSpinning(MdtSolverFast);
    printf("a brick that spins while it slides: %.3f m, fast %.3f m\n", exact, fast);
    assert_near(exact, .5706, .005);
    ck_assert_double_lt(fast, exact);
    ck_assert_double_gt(fast, .65 * exact);
}

/* ---- they are not tied to each other ---- */

enum { SHORT = 40 };

/* Where the i-th ball is after SHORT steps by the fast solver, alone in its world. Alone it would meet the ground at
 * its time. */
static void runAlone(int i, double place[3]) {
    scatter(MdtSolverFast, marble, MANY);
    MdtWorldSetTimedContacts(u->world, 0);
    for (int k = 0; k < MANY; k++)
        if (k != i)
            McdModelDynamicsSetPosition(model[k], 0, 1000. + 10 * k, 0);
    step(SHORT);
    placeOf(i, place);
}

TEST(each_moves_as_if_it_were_alone) {
    double alone[3][3], among[3][3];
    for (int i = 0; i < 3; i++)
        runAlone(40 * i, alone[i]);
    scatter(MdtSolverFast, marble, MANY);
    ck_assert_int_ge(maxTaken(MdtReportWayFast, SHORT), MANY);
    for (int i = 0; i < 3; i++) {
        placeOf(40 * i, among[i]);
        assert_below(distanceOf(alone[i], among[i]), 1e-6);
    }
}

/* Among others that fall on the ground meanwhile, pairs that meet in flight: the middle of each falls by g t²/2, to the
 * rounding of places, whatever its two do to each other. */
TEST(what_meets_in_flight_falls_as_one_body) {
    enum { PAIRS = 40, STEPS = 45 };
    const double fall = gravity / 2 * STEPS * STEPS / (60. * 60.);
    makeWorld(MdtSolverFast, .5);
    for (int i = 0; i < PAIRS; i++) {
        const double apart = 1.4 + .02 * i,
                     height = .5 + .005 * i; /* they meet, and hit the ground, at steps 12 to 25 */
        McdModelDynamicsSetLinearVelocity(putAt(marble(), 12 * i, 50, 0, 500), 2, 0, 0);
        McdModelDynamicsSetLinearVelocity(putAt(marble(), 12 * i + apart, 50, 0, 500), -2, 0, 0);
        McdModelDynamicsSetLinearVelocity(putAt(marble(), 12 * i, height, 6, 500), 3, 0, 0);
    }
    ck_assert_int_gt(maxTaken(MdtReportWayFast, STEPS), PAIRS / 2);
    for (int i = 0; i < PAIRS; i++) {
        double a[3], b[3];
        placeOf(3 * i, a);
        placeOf(3 * i + 1, b);
        assert_near((a[1] + b[1]) / 2, 50 - fall, 1e-4);
    }
}

#ifndef _ME_API_DOUBLE /* which has room for what input can be */
/* After SHORT steps and one more, with a ball among them that was given an inertia and a spin whose product is nearly
 * the largest number that there is. */
static void placesWith(MeBool isBad, double place[MANY][3]) {
    const MeReal large = 1e10;
    const MeReal spin = 1e30;
    MeMatrix3 inertia = {{large, 0, 0}, {0, large, 0}, {0, 0, large}};
    scatter(MdtSolverFast, marble, MANY);
    step(SHORT);
    ck_assert_int_eq(countWay(MdtReportWayFast), MANY);
    if (isBad) {
        MdtBodySetInertiaTensor(McdModelGetBody(model[7]), inertia);
        MdtBodySetAngularVelocity(McdModelGetBody(model[7]), spin, 0, 0);
    }
    step(1);
    for (int i = 0; i < MANY; i++)
        placeOf(i, place[i]);
}

TEST(what_one_of_them_spoils_is_solved_by_each) {
    static double with[MANY][3], without[MANY][3];
    placesWith(MEFALSE, without);
    assert_silent();
    placesWith(METRUE, with);
    assert_warned("partition 7 (1 bodies) would leave the finite numbers");
    for (int i = 0; i < MANY; i++) {
        ck_assert(isfinite(distanceOf(with[i], without[i])));
        if (i != 7)
            ck_assert_double_lt(distanceOf(with[i], without[i]), 1e-4);
    }
}
#endif

/* ---- what is reported ---- */

TEST(each_has_its_own_report) {
    static int rows[2 * MANY];
    double time = 0, work = 0;
    scatter(MdtSolverFast, brick, MANY);
    MdtWorldSetMatrixSizeLog(u->world, rows, 2 * MANY);
    step(40);
    ck_assert_int_eq(MdtWorldGetReportCount(u->world), MANY);
    for (int i = 0; i < MANY; i++) {
        MdtReport r;
        ck_assert(MdtWorldGetPartitionReport(u->world, i, &r));
        if (r.way != MdtReportWayFast)
            continue;
        const MdtBodyID b = McdModelGetBody(model[i]);
        double v2 = 0;
        MeVector3 v;
        MdtBodyGetLinearVelocity(b, v);
        for (int k = 0; k < 3; k++)
            v2 += (double)(v[k] * v[k]);
        ck_assert_int_eq(r.bodies, 1);
        ck_assert_int_eq(r.parts, 1);
        ck_assert_int_eq(r.factorizations, 0);
        ck_assert_int_gt(r.rows, 0);
        ck_assert_int_eq(r.rows % 3, 0); /* a normal and two of friction */
        ck_assert_int_eq(rows[i], r.rows);
        ck_assert_double_ge(r.kineticEnergy, .49 * (double)MdtBodyGetMass(b) * v2);
        for (int k = 0; k < MdtReportStages; k++)
            time += (double)r.time[k];
        work += (double)r.work;
    }
    ck_assert_double_gt(time, 0);
    ck_assert_double_gt(work, 0);
}
