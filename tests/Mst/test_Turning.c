/* Boxes on turning ground: a disc on a hinge with a motor, and a fixed model that is said to turn, about the origin or
 * elsewhere. What friction holds turns with the ground, up to the speed at which mu g = w² r. */
#include "MdtReport.h"
#include "Mst.h"
#include "karma_test.h"

static const double radius = 1, friction = .5, gravity = 9.81, size = .2;

static MstUniverseID u;
static MdtBodyID box, disc;
static MeMatrix4 ground;
static double speed;  /* rad/s */
static double centre; /* m, along x: where the ground turns about */
static int passes, factorizations, parts, fallbacks;

static double slidingSpeed(void) {
    return sqrt(friction * gravity / radius);
}

static void tearDown(void) {
    MstUniverseDestroy(u);
}

static MeBool MEAPI turnGround(McdIntersectResult *result, McdContact *c, MdtContactID d) {
    (void)result, (void)c;
    MdtConstraintSetWorldAngularVelocity(MdtContactQuaConstraint(d), 0, 0, speed);
    MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(d), 0, -speed * centre, 0);
    return METRUE;
}

static void makeFixedDisc(void) {
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMSetPosition(ground, centre, 0, -.1);
    MstFixedModelCreate(u, McdCylinderCreate(u->frame, 2, .2), ground);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, turnGround);
}

static void makeDisc(MeReal density, MeBool isDriven) {
    const McdModelID model = MstModelAndBodyCreate(u, McdCylinderCreate(u->frame, 2, .2), density);
    disc = McdModelGetBody(model);
    MdtBodySetPosition(disc, centre, 0, -.1);
    MdtBodySetAngularVelocity(disc, 0, 0, speed);
    const MdtHingeID hinge = MdtHingeCreate(u->world);
    const MdtConstraintID c = MdtHingeQuaConstraint(hinge);
    MdtHingeSetBodies(hinge, disc, 0);
    MdtConstraintSetPosition(c, centre, 0, -.1);
    MdtConstraintSetAxis(c, 0, 0, 1);
    MdtHingeEnable(hinge);
    if (isDriven)
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), speed, 1000000);
}

typedef enum Ground { FIXED, DRIVEN, HEAVY } Ground;

static void begin(Ground kind, double share) {
    tearDown();
    u = MstUniverseCreate(0);
    speed = share * slidingSpeed();
    disc = 0;
    passes = factorizations = parts = fallbacks = 0;
    MdtWorldSetGravity(u->world, 0, 0, -gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    const MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetSurface(p, friction, 0);
    if (kind == FIXED)
        makeFixedDisc();
    else
        makeDisc(kind == HEAVY ? 1000000 : 1000, kind == DRIVEN);
    box = McdModelGetBody(MstModelAndBodyCreate(u, McdBoxCreate(u->frame, size, size, size / 2), 100));
    MdtBodySetPosition(box, centre + radius, 0, size / 4);
    MdtBodySetLinearVelocity(box, 0, speed * radius, 0);
    MdtBodySetAngularVelocity(box, 0, 0, speed);
}

static double distance(void) {
    MeVector3 x;
    MdtBodyGetPosition(box, x);
    return hypot((double)x[0] - centre, x[1]);
}

/* The box in the disc's axes: all of what has turned with the disc is where it was. */
static double angle(void) {
    MeVector3 x;
    MeMatrix4 tm;
    MdtBodyGetPosition(box, x);
    MdtBodyGetTransform(disc, tm);
    const double out = (double)x[0] - centre;
    const double along = out * (double)tm[0][0] + (double)x[1] * (double)tm[0][1];
    const double across = out * (double)tm[1][0] + (double)x[1] * (double)tm[1][1];
    return atan2(across, along);
}

/* m: the farthest that the box came from its place on the disc. */
static double wayIn(int steps) {
    double worst = 0;
    for (int i = 0; i < steps; i++) {
        MdtReport r;
        MstUniverseStep(u, 1. / 60);
        MdtWorldGetReport(u->world, &r);
        passes += r.passes;
        factorizations += r.factorizations;
        parts += r.parts;
        fallbacks += r.fallbacks;
        worst = fmax(worst, fmax(fabs(distance() - radius), disc ? radius * fabs(angle()) : 0));
    }
    return worst;
}

static void setUp(void) {
    centre = 0;
    u = MstUniverseCreate(0);
}
TEST_FIXTURE(setUp, tearDown)

static void expectHeld(Ground kind) {
    begin(kind, .5);
    const double way = wayIn(1200);
    printf("%d about %g: way %g, %d passes, %d factorizations\n", kind, centre, way, passes, factorizations);
    assert_below(way, 1e-4);
    ck_assert_int_eq(fallbacks, 0);
    ck_assert_int_eq(parts, 1200); /* it does not slide: no stop divides a step */
}

/* Forces turn with the ground, and the last step's with them, so that one pass finds them. */
TEST(a_box_stays_where_friction_holds_it) {
    for (int kind = FIXED; kind <= HEAVY; kind++) {
        expectHeld((Ground)kind);
        ck_assert_int_le(passes, 1200 + 10);
        ck_assert_int_le(factorizations, 2 * 1200 + 20);
    }
}

TEST(so_it_does_on_ground_that_turns_elsewhere) {
    centre = 10;
    for (int kind = FIXED; kind <= HEAVY; kind++)
        expectHeld((Ground)kind);
}

/* The threshold: mu g = w² r. */
TEST(a_box_slides_above_the_speed_that_friction_holds) {
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
