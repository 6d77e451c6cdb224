/* Towers that a ball brings down: nothing leaves the finite numbers, and few steps are inexact. */
#include "Mst.h"
#include "karma_test.h"

enum { BOXES = 20, TOWERS = 8, STEPS = 500, THROW = 100, IN_STEPS = 50 };

static MstUniverseID u;
static McdModelID box[BOXES], ball;
static MeMatrix4 floorTM;

static void place(McdModelID m, double x, double y, double z, double turn) {
    MdtBodyID b = McdModelGetBody(m);
    MdtBodySetPosition(b, (MeReal)x, (MeReal)y, (MeReal)z);
    MdtBodySetQuaternion(b, (MeReal)cos(turn / 2), 0, (MeReal)sin(turn / 2), 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
    MdtBodyEnable(b);
}

static void makeWorld(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicConstraintsMaxCount = 2000;
    u = MstUniverseCreate(&sizes);
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldEnableReport(u->world);
    MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, (MeReal).5);
}

static void makeModels(void) {
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(floorTM, R, 0, 0, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++) {
        box[i] = MstModelAndBodyCreate(u, cube, 1);
        place(box[i], .03 * (i % 3 - 1), .5 + 1.005 * i, .03 * (i % 2), .05 * (i % 5 - 2));
    }
    ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal).8), 5);
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
        MstUniverseStep(u, (MeReal)(1. / 60));
        ck_assert(MdtWorldGetReport(u->world, &report));
        inexact += report.fallbacks > 0;
    }
    MeVector3 p;
    McdModelDynamicsGetPosition(box[BOXES - 1], p);
    ck_assert((double)p[1] < 19 && (double)p[1] > 0); /* it came down, and not through the floor */
    MstUniverseDestroy(u);
    return inexact;
}

START_TEST(towers_come_down_in_finite_numbers) {
    int inexact = 0;
    messages_catch();
    for (int tower = 0; tower < TOWERS; tower++)
        inexact += runTower(tower);
    ck_assert_msg(strstr(caught.last, "finite") == NULL, "%s", caught.last);
    messages_release();
    printf("%d of %d steps inexact\n", inexact, TOWERS * STEPS);
    ck_assert_int_le(inexact, TOWERS * STEPS / IN_STEPS);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, towers_come_down_in_finite_numbers);
}

TEST_MAIN("Heaps", tests)
