/* What a step may cost: a cap on iterations, and the budget of work, make steps cheaper and softer, and never gain
 * energy. */
#include "universe.h"

enum { MAX = 100 };

static MdtBodyID body[MAX];
static unsigned int seed;

static double chance(double from, double to) {
    seed = seed * 1664525u + 1013904223u;
    return from + (to - from) * (seed >> 8) / (1 << 24);
}

static void makeWorld(int boxes, int constraints) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = (unsigned int)boxes;
    sizes.collisionModelsMaxCount = (unsigned int)boxes + 1;
    sizes.collisionPairsMaxCount = (unsigned int)(boxes * boxes + 100);
    sizes.dynamicConstraintsMaxCount = (unsigned int)constraints;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldEnableReport(u->world);
    MdtWorldSetSolver(u->world, MdtSolverExact);
    MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, .5);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
}

/* Boxes turned any way, four a layer, that fall onto each other. */
static void makeHeap(int boxes) {
    makeWorld(boxes, 60 * boxes);
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    seed = 1;
    for (int i = 0; i < boxes; i++) {
        const McdModelID m = MstModelAndBodyCreate(u, cube, 1);
        MeReal q[4];
        const double x = chance(-2, 2), z = chance(-2, 2);
        for (int k = 0; k < 4; k++)
            q[k] = (MeReal)chance(-.5, .5);
        McdModelDynamicsSetPosition(m, x, 2 + 1.2 * (i / 4), z);
        McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
        body[i] = McdModelGetBody(m);
    }
}

typedef struct Run {
    int factorizations, fallbacks, limited, rows;
    double work, maxWork; /* millions; in a step and partition */
    double speed;         /* m/s, the largest */
    double growth;        /* J, of the kinetic energy in a step, beyond what gravity has done: by the height, or by the
                            * mean velocity where overlaps that are taken away have lifted boxes */
    double start;         /* J */
} Run;

static double fastest(int boxes) {
    double max = 0;
    for (int i = 0; i < boxes; i++) {
        MeVector3 v;
        MdtBodyGetLinearVelocity(body[i], v);
        max = fmax(max, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
    return max;
}

typedef struct Energy {
    double kinetic, potential; /* J, of all boxes, at rest or not: 1 m and 1 kg, so their moment is 1/6 */
    double fall;               /* kg m/s, their momentum downwards */
} Energy;

static Energy energyOf(int boxes) {
    Energy e = {0, 0, 0};
    for (int i = 0; i < boxes; i++) {
        MeVector3 v, w, x;
        MdtBodyGetLinearVelocity(body[i], v);
        MdtBodyGetAngularVelocity(body[i], w);
        MdtBodyGetCenterOfMassPosition(body[i], x);
        for (int k = 0; k < 3; k++)
            e.kinetic += .5 * ((double)v[k] * (double)v[k] + (double)w[k] * (double)w[k] / 6);
        e.potential += 9.81 * (double)x[1];
        e.fall -= (double)v[1];
    }
    return e;
}

static void noteStep(Run *run, int boxes, Energy *last) {
    const Energy e = energyOf(boxes);
    MdtReport r;
    ck_assert(MdtWorldGetReport(u->world, &r));
    const double work = fmax(last->potential - e.potential, 9.81 / 60 * (last->fall + e.fall) / 2);
    run->growth = fmax(run->growth, e.kinetic - last->kinetic - fmax(work, 0));
    *last = e;
    run->rows = r.rows;
    run->factorizations += r.factorizations;
    run->fallbacks += r.fallbacks > 0;
    run->limited += r.way == MdtReportWayLimited;
    run->work += (double)r.work;
    for (int i = 0; i < MdtWorldGetReportCount(u->world); i++) {
        MdtReport part;
        ck_assert(MdtWorldGetPartitionReport(u->world, i, &part));
        run->maxWork = fmax(run->maxWork, part.work);
    }
}

static Run runHeap(int boxes, int steps, int cap, double budget) {
    Run run = {0};
    makeHeap(boxes);
    Energy energy = energyOf(boxes);
    run.start = energy.potential;
    MdtWorldSetMaxLCPIterations(u->world, cap);
    if (budget >= 0)
        MdtWorldSetWorkBudget(u->world, budget);
    for (int i = 0; i < steps; i++) {
        MstUniverseStep(u, 1. / 60);
        noteStep(&run, boxes, &energy);
        run.speed = fmax(run.speed, fastest(boxes));
    }
    return run;
}

/* With one iteration bodies reached 4e10 m/s in single precision, 1e41 m/s in double; with five a step took 40 times as
 * long as without. In double, without a cap, the heap takes 449 million multiplications, and 97 with one iteration.
 * Nothing falls by more than 12 m: sqrt(2 g 12 m) = 15 m/s. */
TEST(a_cap_on_iterations_makes_steps_cheaper_and_softer) {
    static const int caps[] = {1, 5, 20, 0};
    double work = 0, workOfOne = 0;
    for (int i = 0; i < 4; i++) {
        const Run run = runHeap(30, 80, caps[i], 0);
        assert_below(run.speed, 15);
        assert_below(run.growth, TOL(1e-5, 1e-12) * run.start);
        ck_assert_msg(run.work > work, "cap %d: %g, before %g", caps[i], run.work, work);
        ck_assert_msg(caps[i] > 0 || run.work > 4 * workOfOne, "without a cap: %g, with one iteration: %g", run.work,
                      workOfOne);
        ck_assert_int_eq(run.fallbacks > 0, caps[i] > 0);
        work = run.work;
        workOfOne = i == 0 ? work : workOfOne;
    }
    messages_forget();
}

TEST(a_budget_bounds_every_step_of_a_heap) {
    static const double budgets[] = {1, 4, -1};
    for (int i = 0; i < 3; i++) {
        const Run run = runHeap(30, 80, 0, budgets[i]);
        const double max = budgets[i] < 0 ? MDTWORLD_DEFAULT_WORK_BUDGET : budgets[i];
        assert_below(run.speed, 15);
        assert_below(run.growth, TOL(1e-5, 1e-12) * run.start);
        assert_below(run.maxWork, max + 0.25); /* a linearization, the fewest sweeps and passes, of 230 rows */
        ck_assert(budgets[i] < 0 || run.limited > 0);
    }
}

/* 59 400 rows: the first step took a minute. One Newton iteration of them is 96 millions, more than the budget, so they
 * are solved by sweeps. Gamma would move them apart with 12 m/s. */
TEST(a_hundred_boxes_in_one_place_are_bounded) {
    enum { BOXES = 100, STEPS = 10 };
    const double sweep = 96e-6; /* of a row */
    double max = 0;
    Run run = {0};
    makeWorld(BOXES, 6 * BOXES * BOXES);
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++) {
        const McdModelID m = MstModelAndBodyCreate(u, cube, 1);
        McdModelDynamicsSetPosition(m, 0, 5, 0);
        body[i] = McdModelGetBody(m);
    }
    Energy energy = energyOf(BOXES);
    run.start = energy.potential;
    for (int i = 0; i < STEPS; i++) {
        MstUniverseStep(u, 1. / 60);
        noteStep(&run, BOXES, &energy);
        run.speed = fmax(run.speed, fastest(BOXES));
        max = fmax(max, MDTWORLD_DEFAULT_WORK_BUDGET + sweep * run.rows);
        assert_below(run.maxWork, max);
    }
    ck_assert(run.limited > 0 && run.fallbacks >= run.limited);
    assert_below(run.growth, TOL(1e-5, 1e-12) * run.start);
    assert_below(run.speed, 4);
}

TEST(the_budget_is_a_number_from_0) {
    makeWorld(1, 10);
    assert_near(MdtWorldGetWorkBudget(u->world), MDTWORLD_DEFAULT_WORK_BUDGET, 0);
    MdtWorldSetWorkBudget(u->world, 0);
    ck_assert(MdtWorldGetWorkBudget(u->world) == 0);
    MdtWorldSetWorkBudget(u->world, 2.5);
    assert_refused(MdtWorldSetWorkBudget, u->world, -1);
    assert_refused(MdtWorldSetWorkBudget, u->world, NAN);
    assert_none(MdtWorldGetWorkBudget, NULL);
    assert_near(MdtWorldGetWorkBudget(u->world), 2.5, 0);
}
