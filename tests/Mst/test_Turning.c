/* Boxes on a fixed model that is said to turn, about the origin or elsewhere (ground that turns itself:
 * Mst.Cases_Round, Mst.Order_Contacts). What friction holds turns with the ground, up to the speed at which
 * mu g = w² r. */
#include "universe.h"

static const double radius = 1, friction = .5, gravity = 9.81, size = .2;

static MdtBodyID box;
static double speed;  /* rad/s */
static double centre; /* m, along x: where the ground turns about */

static MeBool MEAPI turnGround(McdIntersectResult *result, McdContact *c, MdtContactID d) {
    (void)result, (void)c;
    MdtConstraintSetWorldAngularVelocity(MdtContactQuaConstraint(d), 0, 0, speed);
    MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(d), 0, -speed * centre, 0);
    return METRUE;
}

/* m: the farthest that the box came from its place, at this share of the speed that friction holds; silently, in
 * undivided steps, with one pass each, as the last step's forces turn with the ground. */
static double wayIn(double share, int steps) {
    static MeMatrix4 ground;
    double worst = 0;
    int passes = 0, factorizations = 0;
    universe_begin(0);
    speed = share * sqrt(friction * gravity / radius);
    MdtWorldSetGravity(u->world, 0, 0, -gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), friction, 0);
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMSetPosition(ground, centre, 0, -.1);
    MstFixedModelCreate(u, McdCylinderCreate(u->frame, 2, .2), ground);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, turnGround);
    box = McdModelGetBody(MstModelAndBodyCreate(u, McdBoxCreate(u->frame, size, size, size / 2), 100));
    MdtBodySetPosition(box, centre + radius, 0, size / 4);
    MdtBodySetLinearVelocity(box, 0, speed * radius, 0);
    MdtBodySetAngularVelocity(box, 0, 0, speed);
    for (int i = 0; i < steps; i++) {
        MdtReport r;
        MeVector3 x;
        MstUniverseStep(u, 1. / 60);
        MdtWorldGetReport(u->world, &r);
        passes += r.passes;
        factorizations += r.factorizations;
        if (share < .9) {
            ck_assert_int_eq(r.fallbacks, 0);
            ck_assert_int_eq(r.parts, 1); /* it does not slide: no stop divides a step */
        }
        MdtBodyGetPosition(box, x);
        worst = fmax(worst, fabs(hypot((double)x[0] - centre, x[1]) - radius));
    }
    if (share < .9 && centre == 0) {
        ck_assert_int_le(passes, steps + 10);
        ck_assert_int_le(factorizations, 2 * steps + 20);
    }
    return worst;
}

TEST(a_box_stays_where_friction_holds_it) {
    for (centre = 0; centre <= 10; centre += 10)
        assert_below(wayIn(.5, 1200), 1e-4);
}

TEST(a_box_slides_above_the_speed_that_friction_holds) {
    centre = 0;
    assert_below(wayIn(.99, 1200), 1e-4);
    ck_assert(wayIn(1.01, 120) > 1e-2);
}
