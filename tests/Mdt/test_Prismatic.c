/* The prismatic joint: a slider, its stops, its motor and its lock. A cart of the mass 2 slides on the world along an
 * axis that slants, for whatever the axes' signs do. */
#include "measure.h"

static const double mass = 2, axis[3] = {.6, .48, .64};

typedef struct {
    MdtWorldID world;
    MdtBodyID cart;
    MdtPrismaticID joint;
    MdtLimitID limit;
    double start[3];
} Cart;

static Cart makeCart(void) {
    const double edge[3] = {.5, .3, .4};
    Cart s;
    s.world = scene_world(2, 2, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.cart = scene_box(s.world, mass, edge, 1, 2, 3);
    MdtBodySetQuaternion(s.cart, .1, .7, -.1, .7);
    s.joint = MdtPrismaticCreate(s.world);
    MdtPrismaticSetBodies(s.joint, s.cart, 0);
    MdtPrismaticSetAxis(s.joint, axis[0], axis[1], axis[2]);
    MdtPrismaticEnable(s.joint);
    s.limit = MdtPrismaticGetLimit(s.joint);
    MdtLimitCalculatePosition(s.limit, 1);
    measure_position(s.cart, s.start);
    return s;
}

/* How far the cart has gone along the axis, and aside. */
static double wayOf(Cart s, double *aside) {
    double p[3];
    measure_position(s.cart, p);
    keaSubtract(p, p, s.start);
    const double way = keaDot(p, axis);
    keaAddScaled(p, -way, axis);
    if (aside)
        *aside = keaLength(p);
    return way;
}

static double speedOf(Cart s) {
    double v[3];
    measure_velocity(s.cart, v);
    return keaDot(v, axis);
}

static void push(Cart s, double force) {
    double f[3];
    keaScale(f, force, axis);
    add_force(s.cart, f);
}

/* ---- sliding ---- */

/* Zero is where the bodies stand when the axis is set, not when they were attached. */
TEST(zero_is_where_the_bodies_were_when_the_axis_was_set) {
    Cart s = makeCart();
    MdtBodySetPosition(s.cart, -4, 5, 6);
    MdtPrismaticSetAxis(s.joint, 0, 0, 2);
    MdtBodySetLinearVelocity(s.cart, 0, 0, 1);
    steps(s.world, 30, FRAME);
    double p[3];
    measure_position(s.cart, p);
    assert_vec3_near(p, -4, 5, 6.5, TOL(2e-6, 6e-13));
    assert_near(MdtLimitGetPosition(s.limit), .5, TOL(5e-7, 5e-14));
    MeVector3 a;
    MdtPrismaticGetAxis(s.joint, a);
    assert_vec3_near(a, 0, 0, 1, TOL(1e-6, 9e-14));
    MdtLimitSetPosition(s.limit, 10); /* only the reading */
    steps(s.world, 30, FRAME);
    measure_position(s.cart, p);
    assert_vec3_near(p, -4, 5, 7, TOL(2e-6, 7e-13));
    assert_near(MdtLimitGetPosition(s.limit), 10.5, TOL(2e-6, 1e-12));
}

/* The displacement is that of the first body against the second. */
TEST(the_bodies_order_mirrors_the_displacement) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 2, 0, 0);
    MdtPrismaticID j = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(j, a, b);
    MdtPrismaticSetAxis(j, 1, 0, 0);
    MdtPrismaticEnable(j);
    MdtLimitCalculatePosition(MdtPrismaticGetLimit(j), 1);
    MdtBodySetLinearVelocity(a, 1, 0, 0);
    steps(w, 60, FRAME);
    assert_near(MdtLimitGetPosition(MdtPrismaticGetLimit(j)), 1, TOL(1e-6, 9e-14));
    MdtPrismaticDisable(j);
    MdtPrismaticSetBodies(j, b, a);
    MdtPrismaticSetAxis(j, 1, 0, 0);
    MdtPrismaticEnable(j);
    MdtLimitResetState(MdtPrismaticGetLimit(j));
    steps(w, 60, FRAME);
    assert_near(MdtLimitGetPosition(MdtPrismaticGetLimit(j)), -1, TOL(1e-6, 9e-14));
}

/* A rail that turns carries its cart round with it: the axis is one of both bodies. */
TEST(a_turning_rail) {
    const double edge[3] = {4, .2, .2}, small[3] = {.3, .3, .3}, offset[3] = {0, .3, 0};
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID rail = scene_box(w, 5, edge, 0, 0, 0), cart = scene_box(w, 1, small, .5, .3, 0);
    MdtPrismaticID j = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(j, cart, rail);
    MdtPrismaticSetAxis(j, 1, 0, 0);
    MdtPrismaticEnable(j);
    MdtLimitCalculatePosition(MdtPrismaticGetLimit(j), 1);
    MdtBodySetAngularVelocity(rail, 0, 0, 1);
    for (int i = 0; i < 120; i++) {
        double p[3], x[3], y[3], R[2][3][3];
        MdtWorldStep(w, FRAME);
        measure_position(cart, p);
        measure_pointIn(rail, p, x);
        keaSubtract(y, x, offset);
        assert_near(y[1], 0, TOL(1e-6, 4e-9));
        assert_near(y[2], 0, TOL(1e-6, 9e-14));
        assert_near(MdtLimitGetPosition(MdtPrismaticGetLimit(j)), y[0] - .5, TOL(1e-6, 2e-13));
        measure_rotation(rail, R[0]);
        measure_rotation(cart, R[1]);
        for (int n = 0; n < 9; n++)
            assert_near(R[0][n / 3][n % 3], R[1][n / 3][n % 3], TOL(1e-6, 2e-12));
    }
    ck_assert(MdtLimitGetPosition(MdtPrismaticGetLimit(j)) > (MeReal).1); /* thrown outwards */
}

/* ---- motor and lock ---- */

/* γ of the way to the lock a step, up to its force; the motor rests meanwhile. The first step starts at rest and must
 * be twice as fast at its end as in its mean: 2 m γ z / h² = 1440 N. */
TEST(the_lock_draws_to_its_place_and_holds) {
    Cart s = makeCart();
    MdtWorldSetGamma(s.world, .25);
    MdtLimitSetLimitedForceMotor(s.limit, -3, 100);
    MdtLimitSetLock(s.limit, .4, 2000);
    ck_assert(MdtLimitIsLocked(s.limit));
    for (int i = 1; i <= 40; i++) {
        MdtWorldStep(s.world, FRAME);
        assert_near(wayOf(s, NULL), .4 * (1 - pow(.75, i)), TOL(2e-6, 6e-12));
    }
    for (int i = 0; i < 60; i++) {
        push(s, 1800);
        MdtWorldStep(s.world, FRAME);
    }
    assert_near(wayOf(s, NULL), .4, TOL(4e-7, 6e-13));
    push(s, 2200); /* more than it holds */
    MdtWorldStep(s.world, FRAME);
    assert_near(speedOf(s), 200 / mass / 60, TOL(2e-6, 3e-10));
    MdtLimitActivateLock(s.limit, 0);
    steps(s.world, 60, FRAME);
    assert_near(speedOf(s), -3, TOL(3e-6, 3e-13)); /* the motor again */
}
