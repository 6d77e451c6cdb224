/* Towers that a ball brings down, heaps that fall and go to sleep: nothing leaves the finite numbers, few steps are
 * inexact, and what sleeps does not sleep inside something. */
#include "Mst.h"
#include "karma_test.h"

enum { BOXES = 20, STEPS = 500, THROW = 100, IN_STEPS = 50 };

#if defined TEST_IS_SLOW || defined _ME_API_DOUBLE /* it takes a minute */
enum { CUBES = 60, TOWERS = 2 };
#else
enum { CUBES = 300, TOWERS = 8 };
#endif

static MstUniverseID u;
static McdModelID box[BOXES], ball;
static MeMatrix4 floorTM;
static MdtBodyID body[CUBES];
static int numBodies;

static void place(McdModelID m, double x, double y, double z, double turn) {
    MdtBodyID b = McdModelGetBody(m);
    MdtBodySetPosition(b, x, y, z);
    MdtBodySetQuaternion(b, cos(turn / 2), 0, sin(turn / 2), 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
    MdtBodyEnable(b);
}

static void makeWorld(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MeMatrix3 R;
    numBodies = 0;
    sizes.dynamicBodiesMaxCount = CUBES + 10;
    sizes.collisionModelsMaxCount = CUBES + 10;
    sizes.dynamicConstraintsMaxCount = 50 * CUBES;
    sizes.collisionPairsMaxCount = 30 * CUBES;
    u = MstUniverseCreate(&sizes);
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldSetWorkBudget(u->world, 0); /* what the exact solver can do */
    MdtWorldEnableReport(u->world);
    MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, .5);
    MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(floorTM, R, 0, 0, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
}

static void makeModels(void) {
    McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++) {
        box[i] = MstModelAndBodyCreate(u, cube, 1);
        place(box[i], .03 * (i % 3 - 1), .5 + 1.005 * i, .03 * (i % 2), .05 * (i % 5 - 2));
    }
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .8), 5);
    place(ball, -8, .8, 0, 0);
}

/* How many steps were inexact. */
static int runTower(int tower) {
    int inexact = 0;
    makeWorld();
    makeModels();
    for (int i = 0; i < STEPS; i++) {
        MdtReport report;
        if (i == THROW) {
            place(ball, -8, 6 + .05 * tower, .01 * tower, 0);
            MdtBodySetLinearVelocity(McdModelGetBody(ball), 16, 2, 0);
        }
        MstUniverseStep(u, 1. / 60);
        ck_assert(MdtWorldGetReport(u->world, &report));
        inexact += report.fallbacks > 0;
    }
    MeVector3 p;
    McdModelDynamicsGetPosition(box[BOXES - 1], p);
    ck_assert((double)p[1] < 19 && (double)p[1] > 0); /* it came down, and not through the floor */
    MstUniverseDestroy(u);
    return inexact;
}

TEST(towers_come_down_in_finite_numbers) {
    int inexact = 0;
    for (int tower = 0; tower < TOWERS; tower++)
        inexact += runTower(tower);
    ck_assert_msg(strstr(caught.last, "finite") == NULL, "%s", caught.last);
    printf("%d of %d steps inexact\n", inexact, TOWERS * STEPS);
    ck_assert_int_le(inexact, TOWERS * STEPS / IN_STEPS);
}

static MdtBodyID makeCube(McdGeometryID cube) {
    return body[numBodies++] = McdModelGetBody(MstModelAndBodyCreate(u, cube, 1));
}

/* How deep the deepest contact is, awake or asleep. */
static double deepest(void) {
    MdtReport report;
    for (int i = 0; i < numBodies; i++)
        MdtBodyEnable(body[i]);
    MstUniverseStep(u, 1e-5);
    ck_assert(MdtWorldGetReport(u->world, &report));
    return (double)report.penetration;
}

TEST(nothing_falls_asleep_inside_something) {
    makeWorld();
    McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < 5; i++)
        MdtBodySetPosition(makeCube(cube), (MeReal)(3 * i), (MeReal)(.5 - .01 * i), 0);
    for (int i = 0; i < 200; i++)
        MstUniverseStep(u, 1. / 60);
    ck_assert_int_eq(MdtWorldGetEnabledBodies(u->world), 0);
    const double deep = deepest();
    ck_assert_msg(deep < 5e-4, "%g m deep", deep);
    MstUniverseDestroy(u);
}

static unsigned int seed;
static double chance(double from, double to) {
    seed = seed * 1664525u + 1013904223u;
    return from + (to - from) * (seed >> 8) / (1 << 24);
}

/* Cubes turned any way, thrown onto each other. */
static void makeHeap(void) {
    McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    seed = 1;
    for (int i = 0; i < CUBES; i++) {
        MdtBodyID b = makeCube(cube);
        MeVector4 q;
        MdtBodySetPosition(b, chance(-2, 2), 2 + 1.2 * (i / 4), chance(-2, 2));
        for (int k = 0; k < 4; k++)
            q[k] = (MeReal)chance(-.5, .5);
        MdtBodySetQuaternion(b, q[0], q[1], q[2], q[3]);
    }
}

TEST(a_heap_settles_and_sleeps) {
    enum { MAX = 1200 };
    int inexact = 0, steps = 0;
    makeWorld();
    makeHeap();
    for (; steps < MAX && (steps == 0 || MdtWorldGetEnabledBodies(u->world) > 0); steps++) {
        MdtReport report;
        MstUniverseStep(u, 1. / 60);
        ck_assert(MdtWorldGetReport(u->world, &report));
        inexact += report.fallbacks > 0;
    }
    ck_assert_int_eq(caught.warnings, 0);
    printf("%d cubes sleep after %d steps, %d of them inexact\n", CUBES, steps, inexact);
    ck_assert_int_lt(steps, MAX);
    ck_assert_int_le(inexact, steps / IN_STEPS);
    ck_assert(deepest() < 5e-4);
    MstUniverseDestroy(u);
}
