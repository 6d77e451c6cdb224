/* Towers that a ball brings down, heaps that fall and go to sleep: nothing leaves the finite numbers, few steps are
 * inexact, and what sleeps does not sleep inside something. */
#include "universe.h"

enum { BOXES = 20, STEPS = 500, THROW = 100, IN_STEPS = 50 };

#if defined TEST_IS_SLOW || defined _ME_API_DOUBLE /* it takes a minute */
enum { CUBES = 60, TOWERS = 2 };
#else
enum { CUBES = 300, TOWERS = 8 };
#endif

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
    universe_begin(&sizes);
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
        MdtBodySetPosition(makeCube(cube), 3. * i, .5 - .01 * i, 0);
    universe_step(200);
    ck_assert_int_eq(MdtWorldGetEnabledBodies(u->world), 0);
    const double deep = deepest();
    ck_assert_msg(deep < 5e-4, "%g m deep", deep);
}
