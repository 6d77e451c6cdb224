/* Catapult: a trebuchet throws a stone. Which counterweight, arm and release throw farthest? (docs/sweep.md)
 *
 * A beam turns on an axle 5 m above the ground. Its short arm carries the counterweight, at its end; its long arm the
 * stone, in a cup that opens when the beam has turned to the release angle. The beam begins 45 degrees below the
 * horizontal. The range is where the stone comes down. */
#include "KarmaSweep.h"
#include "Mst.h"
#include <math.h>

enum { WEIGHT, SHORT_ARM, LONG_ARM, RELEASE };
static const SweepParameter parameters[] = {
    {"weight [kg]", 200, 4000, 10},
    {"short arm [m]", .5, 1.5, 10},
    {"long arm [m]", 2, 6, 10},
    {"release [deg]", 0, 90, 10}, /* of the long arm above the horizontal */
};
static const char *const results[] = {"range [m]", "speed [m/s]", "efficiency", "load of the axle [kN]"};

static const double axle = 5, stone = 20, linearDensity = 30; /* m, kg, kg/m of the beam */
static const double step = 1. / 240, g = 9.81;                /* s, m/s²: a throw takes half a second */

typedef struct Catapult {
    MstUniverseID universe;
    MdtBodyID beam, stone;
    MdtHingeID hinge;
    MdtBSJointID cup;
    double start; /* rad, of the long arm: below the horizontal */
} Catapult;

/* A body at a place in the plane y = 0, that of the throw. */
static MdtBodyID addBody(MdtWorldID w, double mass, double inertia, double x, double z) {
    const MdtBodyID b = MdtBodyCreate(w);
    MdtBodySetMass(b, (MeReal)mass);
    MdtBodySetSphericalInertiaTensor(b, (MeReal)inertia);
    MdtBodySetPosition(b, (MeReal)x, 0, (MeReal)z);
    MdtBodyEnable(b);
    return b;
}

static MdtBSJointID addBall(MdtWorldID w, MdtBodyID a, MdtBodyID b, double x, double z) {
    const MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, (MeReal)x, 0, (MeReal)z);
    MdtBSJointEnable(j);
    return j;
}

/* The beam's long arm points along -x and down, the throw goes along +x. */
static Catapult build(const double *p) {
    const double length = p[SHORT_ARM] + p[LONG_ARM], mass = linearDensity * length, start = -ME_PI / 4;
    const double middle = .5 * (p[LONG_ARM] - p[SHORT_ARM]); /* of the beam, from the axle along the long arm */
    const double cx = -cos(start), cz = sin(start);          /* the long arm's direction */
    Catapult c = {.universe = MstUniverseCreate(&MstUniverseGrowingSizes), .start = start};
    const MdtWorldID w = MstUniverseGetWorld(c.universe);
    MdtWorldSetGravity(w, 0, 0, (MeReal)-g);
    MdtWorldSetAutoDisable(w, MEFALSE);
    c.beam = addBody(w, mass, mass * length * length / 12, middle * cx, axle + middle * cz);
    c.hinge = MdtHingeCreate(w);
    MdtHingeSetBodies(c.hinge, c.beam, 0);
    MdtHingeSetPosition(c.hinge, 0, 0, (MeReal)axle);
    MdtHingeSetAxis(c.hinge, 0, 1, 0);
    MdtHingeEnable(c.hinge);
    const double wx = -p[SHORT_ARM] * cx, wz = axle - p[SHORT_ARM] * cz, sx = p[LONG_ARM] * cx,
                 sz = axle + p[LONG_ARM] * cz;
    (void)addBall(w, c.beam, addBody(w, p[WEIGHT], .1 * p[WEIGHT], wx, wz), wx, wz);
    c.stone = addBody(w, stone, .1, sx, sz);
    c.cup = addBall(w, c.beam, c.stone, sx, sz);
    return c;
}

/* rad, of the long arm above the horizontal behind the axle. */
static double angleOf(const Catapult *c) {
    MeVector3 s;
    MdtBodyGetPosition(c->stone, s);
    return atan2((double)s[2] - axle, -(double)s[0]);
}

static double loadOf(const Catapult *c) {
    MeVector3 force;
    MdtHingeGetForce(c->hinge, 0, force);
    return 1e-3 * (double)MeVector3Magnitude(force);
}

/* Until the arm is where the cup opens; 0 if it never gets there. */
static int swing(const Catapult *c, double release, double *load) {
    enum { MOST = 2400 }; /* 10 s: who has not thrown by then swings to and fro */
    for (int i = 0; i < MOST; i++) {
        if (angleOf(c) >= release)
            return i + 1;
        MstUniverseStep(c->universe, (MeReal)step);
        *load = fmax(*load, loadOf(c));
    }
    return 0;
}

/* In the air nothing acts but gravity. */
static double rangeOf(const Catapult *c, double *speed) {
    MeVector3 x, v;
    MdtBodyGetPosition(c->stone, x);
    MdtBodyGetLinearVelocity(c->stone, v);
    *speed = (double)MeVector3Magnitude(v);
    const double up = (double)v[2], time = (up + sqrt(up * up + 2 * g * (double)x[2])) / g;
    return (double)x[0] + (double)v[0] * time;
}

static int run(const double *p, double *result) {
    Catapult c = build(p);
    double load = 0;
    const int isThrown = swing(&c, p[RELEASE] * ME_PI / 180, &load);
    if (isThrown) {
        const double fall = p[SHORT_ARM] * (sin(p[RELEASE] * ME_PI / 180) - sin(c.start));
        result[0] = rangeOf(&c, &result[1]);
        result[2] = .5 * stone * result[1] * result[1] / (p[WEIGHT] * g * fall);
        result[3] = load;
    }
    MstUniverseDestroy(c.universe);
    return isThrown ? 0 : 1; /* 1: too weak to throw */
}

static const SweepScene scene = {SWEEP_VERSION, "catapult", 4, parameters, 4, results, run};

SWEEP_EXPORT const SweepScene *sweepScene(void) {
    return &scene;
}
