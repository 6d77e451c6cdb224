/* Systems on which the world does not act: what motors and contacts do between their bodies changes neither momentum
 * nor angular momentum. And carts, whose wheels share a load in more ways than one. */
#include "universe.h"

#include "MdtHinge.h"

static McdModelID model[16];
static int numModels;

static void begin(double gravity, double friction) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -gravity);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), friction, 0);
    numModels = 0;
}

static McdModelID add(McdGeometryID shape, double density, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, shape, density);
    McdModelDynamicsSetPosition(m, x, y, z);
    return model[numModels++] = m;
}

static void turnAbout(McdModelID m, int axis) {
    MeVector4 q = {(MeReal)sqrt(.5), 0, 0, 0};
    q[1 + axis] = q[0];
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
}

/* A hinge about the axis `axis` with a motor. */
static void drive(McdModelID m, McdModelID base, const double at[3], int axis, double speed, double torque) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    MdtHingeSetBodies(j, McdModelGetBody(m), McdModelGetBody(base));
    MdtHingeSetPosition(j, at[0], at[1], at[2]);
    MdtHingeSetAxis(j, axis == 0, axis == 1, axis == 2);
    MdtConstraintSetBodiesCollide(MdtHingeQuaConstraint(j), MEFALSE);
    MdtHingeEnable(j);
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), speed, torque);
}

/* ---- arms that press a body ---- */

typedef enum Pressed { NOTHING, BALL, LIGHT_BOX } Pressed;

static void addArm(int side, int links, MeBool isRound, double torque) {
    const double l = .4;
    McdModelID before = model[0];
    for (int i = 0; i < links; i++) {
        const McdGeometryID shape =
            isRound ? McdSphylCreate(u->frame, .06, l - .12) : McdBoxCreate(u->frame, l, .12, .12);
        const McdModelID m = add(shape, 800, .25 + l * (i + .5), .2 * side, 0);
        if (isRound)
            turnAbout(m, 1);
        drive(m, before, (double[3]){.25 + l * i, .2 * side, 0}, 2, -side, torque);
        before = m;
    }
}

static void addArms(int links, MeBool isRound, Pressed pressed, double torque) {
    const double tip = .25 + .4 * (links - .5);
    add(McdBoxCreate(u->frame, .4, .5, .4), 1000, 0, 0, 0);
    addArm(-1, links, isRound, torque);
    addArm(1, links, isRound, torque);
    if (pressed == BALL)
        add(McdSphereCreate(u->frame, .1), 500, tip, 0, 0);
    else if (pressed == LIGHT_BOX)
        add(McdBoxCreate(u->frame, .2, .2, .2), 50, tip, .01, 0);
}

/* Adds momentum and angular momentum, all parallel to the plane z = 0 or along z. Returns the largest of both parts. */
static void addMomenta(McdModelID m, double p[3], double *L, double part[2]) {
    MeVector3 x, v, w;
    MeMatrix3 I;
    const MdtBodyID b = McdModelGetBody(m);
    const double mass = (double)MdtBodyGetMass(b);
    McdModelDynamicsGetPosition(m, x);
    McdModelDynamicsGetLinearVelocity(m, v);
    McdModelDynamicsGetAngularVelocity(m, w);
    MdtBodyGetInertiaTensor(b, I);
    MeVector4 q;
    McdModelDynamicsGetQuaternion(m, q);
    const double inertia = fabs((double)q[2]) > .4 ? (double)I[0][0] : (double)I[2][2]; /* a capsule on its side */
    const double orbit = mass * ((double)x[0] * (double)v[1] - (double)x[1] * (double)v[0]);
    for (int k = 0; k < 3; k++)
        p[k] += mass * (double)v[k];
    *L += orbit + inertia * (double)w[2];
    part[0] = fmax(part[0], mass * hypot((double)v[0], (double)v[1]));
    part[1] = fmax(part[1], fabs(orbit) + inertia * fabs((double)w[2]));
}

static void assertClosed(const char *name, double rate, double seconds) {
    double worst[2] = {0, 0}, part[2] = {0, 0};
    for (int step = 0; step < seconds * rate; step++) {
        double p[3] = {0, 0, 0}, L = 0;
        MstUniverseStep(u, 1 / rate);
        for (int i = 0; i < numModels; i++)
            addMomenta(model[i], p, &L, part);
        worst[0] = fmax(worst[0], sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
        worst[1] = fmax(worst[1], fabs(L));
    }
    ck_assert_msg(worst[0] <= TOL(1e-6, 1e-9) * part[0], "%s, %g Hz: momentum %g of %g", name, rate, worst[0], part[0]);
    ck_assert_msg(worst[1] <= TOL(1e-5, 1e-6) * part[1], "%s, %g Hz: angular momentum %g of %g", name, rate, worst[1],
                  part[1]);
}

static const double rates[] = {30, 60, 240};

/* A step that follows the pressed contacts only in part gave .3 to .4 N m s each. */
TEST(round_arms_that_press_each_other_do_not_turn_their_base) {
    for (double torque = 1; torque <= 1e4; torque *= 100)
        for (int k = 0; k < 3; k++) {
            begin(0, 0);
            addArms(1, METRUE, NOTHING, torque);
            assertClosed("capsules", rates[k], 2);
        }
}

TEST(nor_do_arms_that_squeeze_a_ball) {
    for (double torque = 1; torque <= 1e4; torque *= 100)
        for (int k = 0; k < 3; k++) {
            begin(0, .5);
            addArms(1, MEFALSE, BALL, torque);
            assertClosed("ball", rates[k], 2);
        }
}

/* What the energy forbids was taken from all bodies, and with it 17 of their 17 kg m/s. */
TEST(what_arms_squeeze_out_takes_no_momentum_away) {
    begin(0, 0);
    addArms(3, MEFALSE, LIGHT_BOX, 1e4);
    assertClosed("box", 30, 3);
}

/* ---- carts ---- */

/* m/s: the largest slip of a wheel of a cart of size 2 that four motors drive by `share` of g. */
static double slipOf(double ratio, double share, double rate, MeBool hasBalls) {
    const double size = 2, r = .3 * size;
    begin(9.81, 1);
    universe_addFloor();
    const McdModelID chassis = add(McdBoxCreate(u->frame, 2 * size, size, .3 * size), 1000, 0, 0, r);
    for (int i = 0; i < 4; i++)
        turnAbout(add(hasBalls ? McdSphereCreate(u->frame, r) : McdCylinderCreate(u->frame, r, .2 * size), 1000,
                      (i & 1 ? .7 : -.7) * size, (i & 2 ? .75 : -.75) * size, r),
                  0);
    MeMatrix3 I;
    const double wheel = (double)MdtBodyGetMass(McdModelGetBody(model[1]));
    MdtBodyGetInertiaTensor(McdModelGetBody(model[1]), I);
    MstAutoSetMassProperties(McdModelGetBody(chassis), chassis, ratio * wheel / (1.2 * size * size * size / 2));
    const double mass = (double)MdtBodyGetMass(McdModelGetBody(chassis)) + 4 * wheel +
                        4 * (double)I[hasBalls ? 0 : 2][2 * !hasBalls] / r / r;
    for (int i = 1; i < 5; i++) {
        MeVector3 x;
        McdModelDynamicsGetPosition(model[i], x);
        drive(model[i], chassis, (double[3]){(double)x[0], (double)x[1], r}, 1, 1e4 / r, share * 9.81 * mass * r / 4);
    }
    double slip = 0;
    for (int step = 0; step < 4 * rate; step++) {
        MeVector3 v, w;
        MstUniverseStep(u, 1 / rate);
        McdModelDynamicsGetLinearVelocity(chassis, v);
        for (int i = 1; i < 5; i++) {
            McdModelDynamicsGetAngularVelocity(model[i], w);
            slip = fmax(slip, fabs((double)w[1] * r - (double)v[0]));
        }
    }
    return slip;
}

/* One wheel lost its load to the other three by rounding, and spun up in the air. */
TEST(carts_on_four_driven_wheels_roll) {
    for (double ratio = 1; ratio <= 1000; ratio *= 10)
        for (int k = 0; k < 3; k++)
            for (int balls = 0; balls < 2; balls++) {
                const double slip = slipOf(ratio, .1, rates[k], balls);
                ck_assert_msg(slip < 1e-3, "ratio %g, %g Hz, %s: slips by %g m/s", ratio, rates[k],
                              balls ? "balls" : "cylinders", slip);
            }
}
