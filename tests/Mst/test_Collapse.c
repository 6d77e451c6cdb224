/* What falls apart and what is dragged: an arch without its keystone, a doll of joints on a stiff spring. How often their
 * steps are divided, and how many matrices that takes. */
#include "MdtReport.h"
#include "Mst.h"
#include "karma_test.h"

#define GRAVITY 9.81
#define FRAME   ((MeReal)(1. / 60))
static const double pi = 3.14159265358979324;

static MstUniverseID u;
static MeMatrix4 floorPlace = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

static void begin(double friction) {
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, (MeReal)-GRAVITY, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorPlace);
}

typedef struct Cost {
    int steps, divided, parts, events, factorizations, worst; /* worst: factorizations of a step */
    int fallbacks;
    double work, gap; /* millions of multiplications; m, of the widest joint */
} Cost;

static void stepAndCount(Cost *c) {
    MdtReport r;
    MstUniverseStep(u, FRAME);
    ck_assert(MdtWorldGetReport(u->world, &r));
    c->steps++;
    c->divided += r.parts - r.events > MdtWorldGetReportCount(u->world);
    c->parts += r.parts;
    c->events += r.events;
    c->factorizations += r.factorizations;
    c->worst = c->worst > r.factorizations ? c->worst : r.factorizations;
    c->fallbacks += r.fallbacks;
    c->work += (double)r.work;
    c->gap = fmax(c->gap, (double)r.jointGap);
    if (getenv("V")) printf("step %d bodies %d way %d parts %d ev %d passes %d f %d work %.2f rows %d E %g\n", c->steps, r.bodies, r.way, r.parts, r.events, r.passes, r.factorizations, (double)r.work, r.rows, (double)(r.kineticEnergy + r.potentialEnergy));
}

static void tell(const char *name, const Cost *c) {
    printf("%-24s %d steps, %d divided, %d parts, %d events, %d factorizations, %d at worst, %d fallbacks, work %.1f, gap %.2g\n",
           name, c->steps, c->divided, c->parts, c->events, c->factorizations, c->worst, c->fallbacks, c->work, c->gap);
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
        MeVector3Set(corner[i], (MeReal)((i & 1 ? 1 : -1) * r[i >> 2] * sin(half)),
                     (MeReal)(r[i >> 2] * cos(half) - radius), (MeReal)((i & 2 ? .5 : -.5) * depth));
    const McdGeometryID wedge = McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corner, 8, 0);
    for (int i = 0; i < STONES; i++) {
        const double angle = pi * (i + .5) / STONES, turn = .5 * (angle - pi / 2);
        stone[i] = MstModelAndBodyCreate(u, wedge, 2400);
        McdModelDynamicsSetPosition(stone[i], (MeReal)(radius * cos(angle)), (MeReal)(radius * sin(angle)), 0);
        McdModelDynamicsSetQuaternion(stone[i], (MeReal)cos(turn), 0, 0, (MeReal)sin(turn));
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
    McdModelDynamicsSetPosition(stone[STONES / 2], 0, (MeReal).5, 4);
    for (int i = 0; i < 240; i++)
        stepAndCount(&cost);
    MstUniverseDestroy(u);
    return cost;
}

START_TEST(an_arch_falls) {
    const Cost byDefault = dropArch(MdtSolverAuto), exact = dropArch(MdtSolverExact);
    tell("arch", &byDefault);
    tell("arch, exact", &exact);
}
END_TEST

/* ---- a doll ------------------------------------------------------------------------------------------------------ */

enum { PELVIS, CHEST, HEAD, ARMS, FOREARMS = ARMS + 2, THIGHS = FOREARMS + 2, SHINS = THIGHS + 2, PARTS = SHINS + 2 };

/* A part of 1000 kg/m³: a box if it has a depth, a ball if it has no height, else a sphyl that hangs down. */
typedef struct Part {
    double x, y, size[3]; /* m: its middle */
    int above;            /* the part that it is joined to */
    double jointX, jointY;
    double cone, bend; /* rad: of a socket, half the angle; of a hinge, the most */
} Part;

static const Part part[PARTS] = {
    {0, 1.02, {.34, .24, .22}, -1, 0, 0, 0, 0},
    {0, 1.38, {.42, .40, .24}, PELVIS, 0, 1.16, .6, 0},
    {0, 1.78, {.15, 0, 0}, CHEST, 0, 1.60, .6, 0},
    {-.30, 1.36, {.07, .24, 0}, CHEST, -.27, 1.52, 1.4, 0},
    {.30, 1.36, {.07, .24, 0}, CHEST, .27, 1.52, 1.4, 0},
    {-.30, 1.02, {.06, .24, 0}, ARMS, -.30, 1.19, 0, -2.2},
    {.30, 1.02, {.06, .24, 0}, ARMS + 1, .30, 1.19, 0, -2.2},
    {-.11, .71, {.09, .32, 0}, PELVIS, -.11, .92, 1, 0},
    {.11, .71, {.09, .32, 0}, PELVIS, .11, .92, 1, 0},
    {-.11, .26, {.07, .34, 0}, THIGHS, -.11, .49, 0, 2.2},
    {.11, .26, {.07, .34, 0}, THIGHS + 1, .11, .49, 0, 2.2},
};

static McdGeometryID shapeOf(const Part *p) {
    if (p->size[2] > 0)
        return McdBoxCreate(u->frame, (MeReal)p->size[0], (MeReal)p->size[1], (MeReal)p->size[2]);
    return p->size[1] > 0 ? McdSphylCreate(u->frame, (MeReal)p->size[0], (MeReal)p->size[1])
                          : McdSphereCreate(u->frame, (MeReal)p->size[0]);
}

static void joinSocket(int i, MdtBodyID below, MdtBodyID above) {
    const MdtBSJointID socket = MdtBSJointCreate(u->world);
    const MdtConeLimitID limit = MdtConeLimitCreate(u->world);
    const MeReal sideways = (MeReal)(i >= THIGHS ? 0 : part[i].x > 0 ? .6 : -.6);
    MdtBSJointSetBodies(socket, below, above);
    MdtBSJointSetPosition(socket, (MeReal)part[i].jointX, (MeReal)part[i].jointY, 0);
    MdtBSJointEnable(socket);
    MdtConeLimitSetBodies(limit, below, above);
    MdtConeLimitSetAxes(limit, 0, 1, 0, 1, 0, 0);
    if (i >= ARMS) {
        MdtConeLimitBodySetAxes(limit, 0, 0, -1, 0, 1, 0, 0);
        MdtConeLimitBodySetAxes(limit, 1, sideways, -1, (MeReal).6, 1, 0, 0);
    }
    MdtConeLimitSetConeHalfAngle(limit, (MeReal)part[i].cone);
    MdtConeLimitEnable(limit);
}

static void joinHinge(int i, MdtBodyID below, MdtBodyID above) {
    const MdtHingeID h = MdtHingeCreate(u->world);
    const MdtLimitID limit = MdtHingeGetLimit(h);
    const MdtSingleLimitID low = MdtLimitGetLowerLimit(limit), high = MdtLimitGetUpperLimit(limit);
    MdtHingeSetBodies(h, below, above);
    MdtHingeSetPosition(h, (MeReal)part[i].jointX, (MeReal)part[i].jointY, 0);
    MdtHingeSetAxis(h, 1, 0, 0);
    MdtSingleLimitSetStop(low, (MeReal)fmin(part[i].bend, 0));
    MdtSingleLimitSetStop(high, (MeReal)fmax(part[i].bend, 0));
    MdtSingleLimitSetRestitution(low, 0);
    MdtSingleLimitSetRestitution(high, 0);
    MdtLimitActivateLimits(limit, METRUE);
    MdtHingeEnable(h);
}

static void buildDoll(McdModelID doll[PARTS]) {
    for (int i = 0; i < PARTS; i++) {
        const double turn = part[i].size[2] > 0 || !(part[i].size[1] > 0) ? 0 : -pi / 4; /* a sphyl lies along z */
        doll[i] = MstModelAndBodyCreate(u, shapeOf(&part[i]), 1000);
        McdModelDynamicsSetPosition(doll[i], (MeReal)part[i].x, (MeReal)part[i].y, 0);
        McdModelDynamicsSetQuaternion(doll[i], (MeReal)cos(turn), (MeReal)sin(turn), 0, 0);
        McdModelDynamicsSetDamping(doll[i], 0, 2);
    }
    for (int i = CHEST; i < PARTS; i++) {
        const MdtBodyID below = McdModelGetBody(doll[i]), above = McdModelGetBody(doll[part[i].above]);
        if (part[i].cone > 0)
            joinSocket(i, below, above);
        else
            joinHinge(i, below, above);
        McdSpaceDisablePair(doll[i], doll[part[i].above]);
    }
    McdSpaceDisablePair(doll[THIGHS], doll[THIGHS + 1]);
}

/* By a part, on a circle of 1 m in a plane that stands, once a second, for 10 s. */
static Cost dragDoll(int by, double turns) {
    McdModelID doll[PARTS];
    Cost cost = {0};
    begin(.5);
    buildDoll(doll);
    const MdtSpringID spring = MdtSpringCreate(u->world);
    const double from[2] = {part[by].x, part[by].y};
    MdtSpringSetBodies(spring, McdModelGetBody(doll[by]), 0);
    MdtSpringSetPosition(spring, 0, (MeReal)from[0], (MeReal)from[1], 0);
    MdtSpringSetPosition(spring, 1, (MeReal)from[0], (MeReal)(from[1] + .01), 0);
    MdtSpringSetNaturalLength(spring, 0);
    MdtSpringSetStiffness(spring, 100000);
    MdtSpringSetDamping(spring, (MeReal)(getenv("DAMP") ? atof(getenv("DAMP")) : 1000));
    MdtSpringEnable(spring);
    for (int i = 0; i < 600; i++) {
        const double angle = 2 * pi * turns * i / 60;
        MdtSpringSetPosition(spring, 1, (MeReal)(from[0] + sin(angle)), (MeReal)(from[1] + .01 + .5 * (1 - cos(angle))), 0);
        stepAndCount(&cost);
    }
    MstUniverseDestroy(u);
    return cost;
}

START_TEST(a_doll_is_dragged) {
    const int by[] = {HEAD, FOREARMS, CHEST};
    const double turns[] = {.3, 1, 2};
    for (int i = 0; i < 3; i++) for (int k = 0; k < 3; k++) {
        const Cost cost = dragDoll(by[i], turns[k]);
        printf("by %d %g: ", by[i], turns[k]);
        tell("doll", &cost);
    }
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, an_arch_falls);
    tcase_add_test(t, a_doll_is_dragged);
}
TEST_MAIN("Collapse", tests)
