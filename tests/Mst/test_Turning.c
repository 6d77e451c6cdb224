/* Boxes on turning ground: a disc on a hinge with a motor, and a fixed model that is said to turn. What friction holds
 * turns with the ground, and up to the speed at which mu g = w² r. */
#include "MdtReport.h"
#include "Mst.h"
#include "karma_test.h"

static const double radius = 1, friction = .5, gravity = 9.81, size = .2;

static MstUniverseID u;
static MdtBodyID box, disc;
static MeMatrix4 ground;
static double speed; /* rad/s */
static int factorizations, parts, fallbacks;

static double slidingSpeed(void) {
    return sqrt(friction * gravity / radius);
}

static void tearDown(void) {
    MstUniverseDestroy(u);
}

static MeBool MEAPI turnGround(McdIntersectResult *result, McdContact *c, MdtContactID d) {
    (void)result, (void)c;
    MdtConstraintSetWorldAngularVelocity(MdtContactQuaConstraint(d), 0, 0, (MeReal)speed);
    return METRUE;
}

static void makeFixedDisc(void) {
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMSetPosition(ground, 0, 0, (MeReal)-.1);
    MstFixedModelCreate(u, McdCylinderCreate(u->frame, 2, (MeReal).2), ground);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, turnGround);
}

static void makeDisc(MeReal density, MeBool isDriven) {
    const McdModelID model = MstModelAndBodyCreate(u, McdCylinderCreate(u->frame, 2, (MeReal).2), density);
    disc = McdModelGetBody(model);
    MdtBodySetPosition(disc, 0, 0, (MeReal)-.1);
    MdtBodySetAngularVelocity(disc, 0, 0, (MeReal)speed);
    const MdtHingeID hinge = MdtHingeCreate(u->world);
    const MdtConstraintID c = MdtHingeQuaConstraint(hinge);
    MdtHingeSetBodies(hinge, disc, 0);
    MdtConstraintSetPosition(c, 0, 0, (MeReal)-.1);
    MdtConstraintSetAxis(c, 0, 0, 1);
    MdtHingeEnable(hinge);
    if (isDriven)
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), (MeReal)speed, 1000000);
}

typedef enum Ground { FIXED, DRIVEN, HEAVY } Ground;

static void begin(Ground kind, double share) {
    tearDown();
    u = MstUniverseCreate(0);
    speed = share * slidingSpeed();
    disc = 0;
    factorizations = parts = fallbacks = 0;
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    const MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetSurface(p, (MeReal)friction, 0);
    if (kind == FIXED)
        makeFixedDisc();
    else
        makeDisc(kind == HEAVY ? 1000000 : 1000, kind == DRIVEN);
    box = McdModelGetBody(
        MstModelAndBodyCreate(u, McdBoxCreate(u->frame, (MeReal)size, (MeReal)size, (MeReal)(size / 2)), 100));
    MdtBodySetPosition(box, (MeReal)radius, 0, (MeReal)(size / 4));
    MdtBodySetLinearVelocity(box, 0, (MeReal)(speed * radius), 0);
    MdtBodySetAngularVelocity(box, 0, 0, (MeReal)speed);
}

static double distance(void) {
    MeVector3 x;
    MdtBodyGetPosition(box, x);
    return hypot((double)x[0], (double)x[1]);
}

/* The box in the disc's axes: all of what has turned with the disc is where it was. */
static double angle(void) {
    MeVector3 x;
    MeMatrix4 tm;
    MdtBodyGetPosition(box, x);
    MdtBodyGetTransform(disc, tm);
    const double along = (double)x[0] * (double)tm[0][0] + (double)x[1] * (double)tm[0][1];
    const double across = (double)x[0] * (double)tm[1][0] + (double)x[1] * (double)tm[1][1];
    return atan2(across, along);
}

/* m: the farthest that the box came from its place on the disc. */
static double wayIn(int steps) {
    double worst = 0;
    for (int i = 0; i < steps; i++) {
        MdtReport r;
        MstUniverseStep(u, (MeReal)(1. / 60));
        MdtWorldGetReport(u->world, &r);
        factorizations += r.factorizations;
        parts += r.parts;
        fallbacks += r.fallbacks;
        worst = fmax(worst, fmax(fabs(distance() - radius), disc ? radius * fabs(angle()) : 0));
    }
    return worst;
}

static void setUp(void) {
    u = MstUniverseCreate(0);
}

START_TEST(a_box_stays_where_friction_holds_it) {
    for (int kind = FIXED; kind <= HEAVY; kind++) {
        begin((Ground)kind, .5);
        const double way = wayIn(1200);
        printf("%d: way %g, %d factorizations, %d parts, %d fallbacks\n", kind, way, factorizations, parts, fallbacks);
        assert_below(way, 1e-4);
        ck_assert_int_eq(fallbacks, 0);
        ck_assert_int_eq(parts, 1200); /* it does not slide: no stop divides a step */
        assert_below(factorizations, 10 * 1200);
    }
}
END_TEST

/* The threshold: mu g = w² r. */
START_TEST(a_box_slides_above_the_speed_that_friction_holds) {
    for (int kind = FIXED; kind <= HEAVY; kind++) {
        begin((Ground)kind, .99);
        const double below = wayIn(1200);
        begin((Ground)kind, 1.01);
        const double above = wayIn(120);
        printf("%d: way at .99 %g, at 1.01 %g\n", kind, below, above);
        assert_below(below, 1e-4);
        ck_assert(above > 1e-2);
    }
}
END_TEST

static void tests(TCase *t) {
    tcase_add_checked_fixture(t, setUp, tearDown);
    tcase_add_test(t, a_box_stays_where_friction_holds_it);
    tcase_add_test(t, a_box_slides_above_the_speed_that_friction_holds);
}
TEST_MAIN("Turning", tests)
