/* What falls apart, or is torn about: an arch without its keystone, boxes in flight, a rag doll on a stiff spring.
 * How often their steps are divided, and how many matrices that takes. */
#include "universe.h"
#include "ragdoll.h"

#define GRAVITY 9.81
#define FRAME   ((MeReal)(1. / 60))
static const double pi = 3.14159265358979324;

static MeMatrix4 floorPlace = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

static void begin(double friction) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, -GRAVITY, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), friction, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorPlace);
}

typedef struct Cost {
    int events, max, factorizations, worst; /* of a partition in a step: most events, worst: matrices */
    double work, start, energy;             /* millions of multiplications; J, before and now */
} Cost;

static void stepAndCount(Cost *c) {
    MdtReport r;
    MstUniverseStep(u, FRAME);
    ck_assert(MdtWorldGetReport(u->world, &r));
    c->energy = (double)(r.kineticEnergy + r.potentialEnergy);
    c->start = c->start > 0 ? c->start : c->energy;
    c->events += r.events;
    c->factorizations += r.factorizations;
    c->work += (double)r.work;
    for (int i = 0; i < MdtWorldGetReportCount(u->world); i++) {
        ck_assert(MdtWorldGetPartitionReport(u->world, i, &r));
        c->max = c->max > r.events ? c->max : r.events;
        c->worst = c->worst > r.factorizations ? c->worst : r.factorizations;
    }
}

static void tell(const char *name, const Cost *c) {
    printf("%-12s %d events, %d in a step of a partition, %d factorizations, %d in a step, work %.1f, %g of %g J\n",
           name, c->events, c->max, c->factorizations, c->worst, c->work, c->energy, c->start);
}

/* ---- an arch ----------------------------------------------------------------------------------------------------- */

enum { STONES = 15 };

/* Of a ring sector's trapezium, from its two parallel sides. */
static double middleOf(double y1, double side1, double y2, double side2) {
    return y1 + (y2 - y1) * (side1 + 2 * side2) / (3 * (side1 + side2));
}

static void buildArch(McdModelID stone[STONES]) {
    const double half = pi / STONES / 2, r[2] = {3, 3.6}, depth = 1.4;
    const double radius = middleOf(r[0] * cos(half), r[0] * sin(half), r[1] * cos(half), r[1] * sin(half));
    MeVector3 corner[8];
    for (int i = 0; i < 8; i++)
        MeVector3Set(corner[i], (i & 1 ? 1 : -1) * r[i >> 2] * sin(half), r[i >> 2] * cos(half) - radius,
                     (i & 2 ? .5 : -.5) * depth);
    const McdGeometryID wedge = McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corner, 8, 0);
    for (int i = 0; i < STONES; i++) {
        const double angle = pi * (i + .5) / STONES, turn = .5 * (angle - pi / 2);
        stone[i] = MstModelAndBodyCreate(u, wedge, 2400);
        McdModelDynamicsSetPosition(stone[i], radius * cos(angle), radius * sin(angle), 0);
        McdModelDynamicsSetQuaternion(stone[i], cos(turn), 0, 0, sin(turn));
    }
}

/* It stands for a second; then its keystone lies beside it, and the rest comes down. */
static Cost dropArch(MdtSolver solver) {
    McdModelID stone[STONES];
    Cost cost = {0};
    begin(.7);
    MdtWorldSetSolver(u->world, solver);
    buildArch(stone);
    for (int i = 0; i < 60; i++)
        MstUniverseStep(u, FRAME);
    McdModelDynamicsSetPosition(stone[STONES / 2], 0, .5, 4);
    for (int i = 0; i < 240; i++)
        stepAndCount(&cost);
    return cost;
}

/* Stones do not rebound, and what one blow makes is the next one at most. Halves of seven stones that wedge each other
 * may cost Newton's method 1616 matrices in a step: the account does not pay them. */
TEST(an_arch_falls_in_few_parts) {
    const Cost byDefault = dropArch(MdtSolverAuto), exact = dropArch(MdtSolverExact);
    tell("arch", &byDefault);
    tell("arch, exact", &exact);
    ck_assert_int_le(byDefault.max, 2);
    ck_assert_int_eq(exact.max, 2);
    assert_below(byDefault.work, exact.work);
    ck_assert(byDefault.energy < .5 * byDefault.start && exact.energy < .5 * exact.start);
}

/* ---- boxes in flight ------------------------------------------------------------------------------------------- */

enum { BOXES = 12 };

/* Three layers of four that overlap by a millimetre. */
static void buildBlock(double height, double speed) {
    const double apart = .999;
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++) {
        const McdModelID box = MstModelAndBodyCreate(u, cube, 1);
        McdModelDynamicsSetPosition(box, apart * (i % 2), height + apart * (i / 4), apart * (i / 2 % 2));
        McdModelDynamicsSetLinearVelocity(box, 0, -speed, 0);
    }
}

/* Nothing is below them. Their centre of mass falls as a free body, while they part; Newton's method takes 913 matrices
 * and 6 times the work. */
TEST(what_flies_is_no_work_for_newton) {
    Cost cost = {0};
    begin(.5);
    buildBlock(30, 0);
    for (int i = 0; i < 60; i++)
        stepAndCount(&cost);
    tell("in flight", &cost);
    assert_near(cost.energy, cost.start, 1e-3);
    ck_assert_int_eq(cost.factorizations, 0);
}

/* ---- a rag doll on a spring ------------------------------------------------------------------------------------- */

enum { DRAGGED_STEPS = 600 };
static const double stiffness = 1e5, dragSpeed = 3, dragRadius = 1.5, dragHeight = 1.3;

static MdtSpringID pull(McdModelID part, const MeVector3 at) {
    const MdtSpringID s = MdtSpringCreate(u->world);
    MdtSpringSetBodies(s, McdModelGetBody(part), 0);
    for (unsigned int k = 0; k < 2; k++)
        MdtSpringSetPosition(s, k, at[0], at[1], at[2]);
    MdtSpringSetNaturalLength(s, 0);
    MdtSpringSetStiffness(s, stiffness);
    MdtSpringSetDamping(s, 0);
    MdtSpringEnable(s);
    return s;
}

/* On a circle, up to its height in a second. */
static void lead(MdtSpringID s, const MeVector3 from, double time) {
    const double angle = dragSpeed / dragRadius * time, up = (dragHeight - (double)from[1]) * fmin(1, time);
    MdtSpringSetPosition(s, 1, from[0] + (MeReal)(dragRadius * sin(angle)), from[1] + (MeReal)up,
                         from[2] + (MeReal)(dragRadius * (1 - cos(angle))));
}

/* In how many steps a partition is divided. */
static int drag(int part, Cost *c) {
    static const double feet[3] = {0, 0, 0};
    Doll doll;
    MeVector3 at;
    int divided = 0;
    begin(.7);
    doll_make(&doll, u, feet);
    McdModelDynamicsGetPosition(doll.model[part], at);
    const MdtSpringID s = pull(doll.model[part], at);
    for (int i = 0; i < DRAGGED_STEPS; i++) {
        MdtReport r;
        lead(s, at, (i + 1) * (double)FRAME);
        stepAndCount(c);
        ck_assert(MdtWorldGetReport(u->world, &r));
        divided += r.parts > MdtWorldGetReportCount(u->world);
        assert_below(doll_opening(&doll), 1e-5);
    }
    return divided;
}

/* Solved exactly, 591 of the steps were divided. */
TEST(a_doll_on_a_stiff_spring_holds_at_little_work) {
    static const int parts[] = {DOLL_PELVIS, DOLL_FOREARMS};
    for (int i = 0; i < 2; i++) {
        Cost cost = {0};
        const int divided = drag(parts[i], &cost);
        printf("%d steps divided; ", divided);
        tell("doll", &cost);
        assert_below(cost.work, 4 * DRAGGED_STEPS);
    }
}
