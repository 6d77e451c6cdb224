/* Joints among many contacts, which the fast solver takes: heavy chains, nets, machines, figures of any kind. Joints
 * hold, nothing gains energy, and motions are those of the exact solver where that has an answer. */
#include "MdtReport.h"
#include "Mst.h"
#include "karma_test.h"

#ifdef TEST_IS_SLOW
enum { FIGURES = 4, FIGURE_STEPS = 150 };
#else
enum { FIGURES = 40, FIGURE_STEPS = 200 };
#endif

enum { MOST = 400 };

static const double gravity = 9.81;
static MstUniverseID u;
static McdModelID model[MOST];
static MdtConstraintID joint[MOST];
static int numModels, numJoints;
static unsigned int seed;

static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / (1 << 24);
}

static void makeWorld(MdtSolver solver, double friction) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    numModels = numJoints = 0;
    MdtWorldSetGravity(u->world, 0, (MeReal)-gravity, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
}

static McdModelID put(McdGeometryID g, const double at[3], double density) {
    const McdModelID m = MstModelAndBodyCreate(u, g, (MeReal)density);
    McdModelDynamicsSetPosition(m, (MeReal)at[0], (MeReal)at[1], (MeReal)at[2]);
    return model[numModels++] = m;
}

static McdModelID putAt(McdGeometryID g, double x, double y, double z, double density) {
    return put(g, (double[3]){x, y, z}, density);
}

static McdGeometryID box(double x, double y, double z) {
    return McdBoxCreate(u->frame, (MeReal)x, (MeReal)y, (MeReal)z);
}

static McdGeometryID ball(double radius) {
    return McdSphereCreate(u->frame, (MeReal)radius);
}

/* b null: the world. */
static void joinByBall(McdModelID a, McdModelID b, double x, double y, double z) {
    const MdtBSJointID j = MdtBSJointCreate(u->world);
    MdtBSJointSetBodies(j, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtBSJointSetPosition(j, (MeReal)x, (MeReal)y, (MeReal)z);
    MdtBSJointEnable(j);
    joint[numJoints++] = MdtBSJointQuaConstraint(j);
    if (b)
        McdSpaceDisablePair(a, b);
}

static MdtLimitID joinByHinge(McdModelID a, McdModelID b, const double at[3], const double axis[3]) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    MdtHingeSetBodies(j, McdModelGetBody(a), McdModelGetBody(b));
    MdtHingeSetPosition(j, (MeReal)at[0], (MeReal)at[1], (MeReal)at[2]);
    MdtHingeSetAxis(j, (MeReal)axis[0], (MeReal)axis[1], (MeReal)axis[2]);
    MdtHingeEnable(j);
    joint[numJoints++] = MdtHingeQuaConstraint(j);
    McdSpaceDisablePair(a, b);
    return MdtHingeGetLimit(j);
}

/* ---- what is measured ---- */

/* m, of the joint that is open furthest. */
static double opening(void) {
    double most = 0;
    for (int i = 0; i < numJoints; i++) {
        MeVector3 a, b;
        MdtConstraintBodyGetPosition(joint[i], 0, a);
        MdtConstraintBodyGetPosition(joint[i], 1, b);
        MeVector3Subtract(a, a, b);
        const double open = (double)MeVector3Magnitude(a);
        most = open <= most ? most : open;
    }
    return most;
}

static double energyOf(MdtBodyID b) {
    MeVector3 v, w, x, turned;
    MeMatrix3 inertia;
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(b);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    MdtBodyGetCenterOfMassPosition(b, x);
    MdtBodyGetInertiaTensor(b, inertia);
    for (int i = 0; i < 3; i++)
        turned[i] = tm[i][0] * w[0] + tm[i][1] * w[1] + tm[i][2] * w[2];
    double turning = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turning += .5 * (double)(turned[i] * inertia[i][k] * turned[k]);
    const double mass = (double)MdtBodyGetMass(b);
    return mass * (.5 * (double)MeVector3Dot(v, v) + gravity * (double)x[1]) + turning;
}

static double energy(void) {
    double sum = 0;
    for (int i = 0; i < numModels; i++)
        sum += energyOf(McdModelGetBody(model[i]));
    return sum;
}

typedef struct Course {
    double open, gain; /* m; J, of any step */
    double energy;     /* J, at the end */
    int fast, exact;   /* partitions with joints, over the steps, by the solver that took them */
    int factorizations;
} Course;

static void notePartitions(Course *c) {
    MdtReport r;
    for (int i = 0; i < MdtWorldGetReportCount(u->world); i++) {
        ck_assert(MdtWorldGetPartitionReport(u->world, i, &r));
        c->fast += r.way == MdtReportWayFast && r.bodies > 1;
        c->exact += r.way == MdtReportWayExact && r.bodies > 1;
        c->factorizations += r.factorizations;
    }
}

static Course run(int steps) {
    Course c = {0};
    double before = energy();
    for (int i = 0; i < steps; i++) {
        MstUniverseStep(u, (MeReal)(1. / 60));
        notePartitions(&c);
        const double now = energy(), open = opening();
        c.gain = now - before <= c.gain ? c.gain : now - before;
        c.open = open <= c.open ? c.open : open;
        before = now;
    }
    c.energy = before;
    MstUniverseDestroy(u);
    return c;
}

/* ---- scenes ---- */

/* Twenty links of half a kilogram and a ball of a ton, let go level, swing into a pile. */
static void makeHeavyChain(MdtSolver solver) {
    McdModelID last = 0;
    makeWorld(solver, .5);
    for (int i = 0; i < 20; i++) {
        const McdModelID m = putAt(box(.2, .05, .05), .1 + .2 * i, 6, 0, 1000);
        joinByBall(m, last, .2 * i, 6, 0);
        last = m;
    }
    joinByBall(putAt(ball(.4), 4.4, 6, 0, 1000 / (4. / 3 * ME_PI * .4 * .4 * .4)), last, 4, 6, 0);
    for (int i = 0; i < 60; i++)
        putAt(box(.5, .5, .5), -2 + .55 * (i % 6), .25 + .5 * (i / 12), -.3 + .55 * (i / 6 % 2), 300);
}

/* The ball comes with 60 kJ. Without geometric stiffness the chain opens by more than a metre. */
START_TEST(a_ton_on_a_light_chain_stays_on_it_where_it_hits) {
    makeHeavyChain(MdtSolverAuto);
    const Course c = run(180);
    printf("heavy chain: open by %.1e m, gains %.1e J, %d partitions fast, %d exact\n", c.open, c.gain, c.fast,
           c.exact);
    assert_below(c.open, 2e-3);
    assert_below(c.gain, 60);
    ck_assert_int_gt(c.fast, 60);
}
END_TEST

enum { KNOTS = 10 };

/* Balls joined to their neighbours, the rim to the world, and boxes of five times their mass above it. */
static void makeNet(void) {
    McdModelID knot[KNOTS][KNOTS];
    const double middle = .2 * (KNOTS - 1);
    makeWorld(MdtSolverAuto, .5);
    for (int i = 0; i < KNOTS; i++)
        for (int k = 0; k < KNOTS; k++) {
            const double x = .4 * i - middle, z = .4 * k - middle;
            const MeBool isRim = i == 0 || k == 0 || i == KNOTS - 1 || k == KNOTS - 1;
            knot[i][k] = putAt(ball(.12), x, 4, z, 1000);
            if (i > 0)
                joinByBall(knot[i][k], knot[i - 1][k], x - .2, 4, z);
            if (k > 0)
                joinByBall(knot[i][k], knot[i][k - 1], x, 4, z - .2);
            if (isRim)
                joinByBall(knot[i][k], 0, x, 4, z);
        }
    for (int i = 0; i < 36; i++)
        putAt(box(.5, .5, .5), .7 * (i % 3) - .7, 4.6 + .6 * (i / 9), .7 * (i / 3 % 3) - .7, 300);
}

/* 216 joints in loops, a ton in it. */
START_TEST(a_net_catches_boxes) {
    makeNet();
    const Course c = run(90);
    printf("net: open by %.1e m, gains %.1e J\n", c.open, c.gain);
    assert_below(c.open, 1e-4);
    assert_below(c.gain, 20);
    ck_assert_int_gt(c.fast, 60);
}
END_TEST

/* A car with motors at its four wheels and an arm of five links before it, each driven. */
static void makeMachine(double z) {
    static const double across[3] = {0, 0, 1};
    const McdModelID car = putAt(box(2, .4, 1), 0, .7, z, 200);
    McdModelID last = car;
    for (int k = 0; k < 4; k++) {
        const double at[3] = {k & 1 ? .8 : -.8, .4, z + (k & 2 ? .75 : -.75)};
        const McdModelID wheel = put(McdCylinderCreate(u->frame, (MeReal).4, (MeReal).3), at, 200);
        const MdtLimitID drive = joinByHinge(wheel, car, at, across);
        MdtLimitSetLimitedForceMotor(drive, -8, 400);
        MdtLimitActivateMotor(drive, METRUE);
    }
    for (int k = 0; k < 5; k++) {
        const McdModelID link = putAt(box(1, .15, .15), 1.5 + k, 1.2, z, 100);
        const MdtLimitID drive = joinByHinge(link, last, (double[3]){1 + k, 1.2, z}, across);
        MdtLimitSetLimitedForceMotor(drive, (MeReal)(.3 * sin(k)), 300);
        MdtLimitActivateMotor(drive, METRUE);
        last = link;
    }
}

static void makeMachines(MdtSolver solver) {
    makeWorld(solver, .5);
    for (int i = 0; i < 4; i++)
        makeMachine(4 * i);
    for (int i = 0; i < 60; i++)
        putAt(box(.6, .6, .6), 9 + .9 * (i % 4), .3, .9 * (i / 4) - .5, 100);
}

/* In single precision their wheels touch with the rounding of places, so that the exact solver does not settle which of
 * them stick: 40 factorizations a step; after the first such step a machine is the fast one's. In double precision none
 * is. */
START_TEST(machines_move_as_the_exact_solver_moves_them_and_settle) {
    makeMachines(MdtSolverExact);
    const Course exact = run(90);
    makeMachines(MdtSolverAuto);
    const Course c = run(90);
    printf("machines: %.6g J, exact %.6g J; %d factorizations, exact %d; open by %.1e m\n", c.energy, exact.energy,
           c.factorizations, exact.factorizations, c.open);
    assert_near(c.energy, exact.energy, 5e-3 * exact.energy);
    ck_assert_int_le(c.factorizations, exact.factorizations);
    ck_assert_int_lt(c.factorizations, 8 * 4 * 90);
    assert_below(c.open, 1e-4);
}
END_TEST

/* ---- figures of any kind ---- */

static McdGeometryID anyShape(void) {
    const double a = between(.1, .5), b = between(.1, .5), c = between(.1, .5), kind = between(0, 3);
    return kind < 1.5 ? box(a, b, c) : kind < 2.2 ? ball(a / 2) : McdSphylCreate(u->frame, (MeReal)(a / 3), (MeReal)b);
}

static void setStops(MdtLimitID limit, double low, double high) {
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), (MeReal)low);
    MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), (MeReal)high);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
    MdtLimitActivateLimits(limit, METRUE);
}

static void joinByPrismatic(McdModelID a, McdModelID b) {
    const MdtPrismaticID j = MdtPrismaticCreate(u->world);
    MdtPrismaticSetBodies(j, McdModelGetBody(a), McdModelGetBody(b));
    MdtPrismaticSetAxis(j, (MeReal)between(-1, 1), 1, (MeReal)between(-1, 1));
    setStops(MdtPrismaticGetLimit(j), -.2, .2);
    MdtPrismaticEnable(j);
    McdSpaceDisablePair(a, b);
}

static void joinAnyhow(McdModelID a, McdModelID b, const double at[3]) {
    const double kind = between(0, 4);
    if (kind < 1) {
        joinByBall(a, b, at[0], at[1], at[2]);
    } else if (kind < 3) {
        const MdtLimitID limit = joinByHinge(a, b, at, (double[3]){between(-1, 1), between(-1, 1), 1});
        if (between(0, 1) < .6)
            setStops(limit, -between(.1, 1), between(.1, 1));
    } else {
        joinByPrismatic(a, b);
    }
}

/* Nine to thirty bodies, a tree and up to two loops, masses over four decades, thrown at some boxes. */
static void makeFigure(int number) {
    double x[30][3];
    seed = 7919u * (unsigned int)number + 1;
    makeWorld(MdtSolverFast, between(0, 1));
    const int parts = 9 + (int)between(0, 22), loops = (int)between(0, 3);
    for (int i = 0; i < parts; i++) {
        const int above = i > 0 ? (int)between(0, i) : -1;
        double at[3];
        for (int k = 0; k < 3; k++) {
            x[i][k] = above < 0 ? (k == 1 ? 3 : 0) : x[above][k] + between(-.6, .6);
            at[k] = above < 0 ? 0 : .5 * (x[i][k] + x[above][k]);
        }
        put(anyShape(), x[i], 1000 * pow(10, between(-2, 2)));
        if (above >= 0)
            joinAnyhow(model[i], model[above], at);
    }
    for (int i = 0; i < loops; i++) {
        const int a = (int)between(0, parts), b = (int)between(0, parts);
        if (a != b)
            joinByBall(model[a], model[b], .5 * (x[a][0] + x[b][0]), .5 * (x[a][1] + x[b][1]),
                       .5 * (x[a][2] + x[b][2]));
    }
    for (int i = 0; i < parts; i++)
        McdModelDynamicsSetLinearVelocity(model[i], 3, 0, 1);
    for (int i = 0; i < 12; i++)
        putAt(box(.4, .4, .4), .6 * (i % 4) + .5, .25 + .45 * (i / 8), .6 * (i / 4 % 2) - .5, 500);
}

static double weight(void) {
    double sum = 0;
    for (int i = 0; i < numModels; i++)
        sum += gravity * (double)MdtBodyGetMass(McdModelGetBody(model[i]));
    return sum;
}

/* No energy but what overlaps that are taken away have lifted: 5 mm of the weight in a step. */
START_TEST(figures_of_any_kind_hold_together_and_gain_no_energy) {
    double open = 0, lift = 0;
    for (int i = 0; i < FIGURES; i++) {
        makeFigure(i);
        const double all = weight();
        const Course c = run(FIGURE_STEPS);
        ck_assert_msg(c.open < 1e-3, "figure %d: open by %g m", i, c.open);
        ck_assert_msg(c.gain < 5e-3 * all, "figure %d: gains %g J, weighs %g N", i, c.gain, all);
        open = fmax(open, c.open);
        lift = fmax(lift, c.gain / all);
    }
    printf("figures: open by %.1e m at most, lifted by %.1e m\n", open, lift);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, a_ton_on_a_light_chain_stays_on_it_where_it_hits);
    tcase_add_test(t, a_net_catches_boxes);
    tcase_add_test(t, machines_move_as_the_exact_solver_moves_them_and_settle);
    tcase_add_test(t, figures_of_any_kind_hold_together_and_gain_no_energy);
}

TEST_MAIN("Jointed", tests)
