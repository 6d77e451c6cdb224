/* Where scenes with known answers stop being exact: one parameter at a time goes through decades, up and down from the
 * scene's own value, and the first value is told at which the error is more than ten times that of its neighbour.
 *
 *     decades [--all] [SCENE ...]    every value; only these scenes
 *
 * Universes with the scales of the scene, epsilon 0, nothing asleep, in the precision of the build. Errors are without
 * units: of the length, the angle, the energy or the speed that the scene is about. A scene whose mass, or whose length
 * with the root of its step, is multiplied as a whole is the same to the last bit (tests/Mst/test_Scales.c): `size' is
 * that of everything at one and the same step, `ratio' the mass of one body over that of the others. */
#include "McdFrame.h"
#include "MdtReport.h"
#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define G  9.81
#define PI 3.14159265358979323846

enum { MAX = 64 };

typedef enum Joint { BALL, HINGE, UNIVERSAL, JOINTS } Joint;

/* A scene's parameters; each uses some. */
typedef struct Case {
    double size, ratio, speed, friction, step, angle, gap, restitution;
    double joint; /* Joint */
} Case;

static const char *const names[] = {"size, m",    "mass ratio",    "speed",       "friction", "step, s",
                                    "angle, rad", "gap, relative", "restitution", "joint"};
enum { PARAMETERS = sizeof names / sizeof *names };

static double *parameter(Case *c, int which) {
    double *const all[] = {&c->size,  &c->ratio, &c->speed,       &c->friction, &c->step,
                           &c->angle, &c->gap,   &c->restitution, &c->joint};
    return all[which];
}

static MstUniverseID u;
static McdModelID model[MAX];
static int count, fallbacks;
static MeMatrix4 ground;

static void begin(const Case *c, double down, double along) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    sizes.lengthScale = (MeReal)c->size;
    u = MstUniverseCreate(&sizes);
    if (!u)
        exit(1);
    count = fallbacks = 0;
    MdtWorldSetEpsilon(u->world, 0);
    MdtWorldSetGravity(u->world, (MeReal)along, 0, (MeReal)-down);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)c->friction, (MeReal)c->restitution);
}

static void makeFloor(void) {
    MeMatrix4TMMakeIdentity(ground);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
}

static MdtBodyID body(int i) {
    return McdModelGetBody(model[i]);
}

/* Of the mass, whatever its shape. */
static MdtBodyID add(McdGeometryID shape, double mass, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, shape, 1);
    const MdtBodyID b = McdModelGetBody(m);
    MeMatrix3 tensor;
    const MeReal share = (MeReal)mass / MdtBodyGetMass(b);
    MdtBodyGetInertiaTensor(b, tensor);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            tensor[i][k] *= share;
    MdtBodySetMass(b, (MeReal)mass);
    MdtBodySetInertiaTensor(b, tensor);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    model[count++] = m;
    return b;
}

static McdGeometryID box(double x, double y, double z) {
    return McdBoxCreate(u->frame, (MeReal)x, (MeReal)y, (MeReal)z);
}

/* About y, at the point. */
static void join(const Case *c, MdtBodyID a, MdtBodyID b, double x, double y, double z) {
    if ((int)c->joint == HINGE) {
        const MdtHingeID j = MdtHingeCreate(u->world);
        MdtHingeSetBodies(j, a, b);
        MdtHingeSetPosition(j, (MeReal)x, (MeReal)y, (MeReal)z);
        MdtHingeSetAxis(j, 0, 1, 0);
        MdtHingeEnable(j);
    } else if ((int)c->joint == UNIVERSAL) {
        const MdtUniversalID j = MdtUniversalCreate(u->world);
        MdtUniversalSetBodies(j, a, b);
        MdtUniversalSetPosition(j, (MeReal)x, (MeReal)y, (MeReal)z);
        MdtUniversalSetAxes(j, 0, 1, 0, 0, 0, 1);
        MdtUniversalEnable(j);
    } else {
        const MdtBSJointID j = MdtBSJointCreate(u->world);
        MdtBSJointSetBodies(j, a, b);
        MdtBSJointSetPosition(j, (MeReal)x, (MeReal)y, (MeReal)z);
        MdtBSJointEnable(j);
    }
}

/* Links do not hit each other. */
static void letPass(void) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < i; k++)
            McdSpaceDisablePair(model[i], model[k]);
}

static void step(const Case *c) {
    MdtReport r;
    MstUniverseStep(u, (MeReal)c->step);
    MdtWorldGetReport(u->world, &r);
    fallbacks += r.fallbacks + r.conflicts;
}

static double place(int i, int axis) {
    MeVector3 p;
    MdtBodyGetPosition(body(i), p);
    return (double)p[axis];
}

static double energy(double down) {
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += (double)MdtBodyGetKineticEnergy(body(i)) + (double)MdtBodyGetMass(body(i)) * down * place(i, 2);
    return sum;
}

static double end(double error) {
    MstUniverseDestroy(u);
    return error;
}

/* Steps that take so long, at least some and not without end. */
static int stepsIn(const Case *c, double time) {
    return (int)fmin(fmax(ceil(time / c->step), 10), 6000);
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* A cube slides down a slope of `angle': its way in 2 s, of what it should be. */
static double incline(const Case *c) {
    begin(c, G * cos(c->angle), G * sin(c->angle));
    makeFloor();
    const MdtBodyID b = add(box(c->size, c->size, c->size / 2), 1, 0, 0, c->size / 4);
    MdtBodySetLinearVelocity(b, (MeReal)c->speed, 0, 0);
    const int steps = stepsIn(c, 2);
    for (int i = 0; i < steps; i++)
        step(c);
    const double t = steps * (double)(MeReal)c->step, a = G * (sin(c->angle) - c->friction * cos(c->angle));
    const double stop = a < 0 ? fmin(t, -c->speed / a) : t, way = c->speed * stop + .5 * a * stop * stop;
    const double scale = way > 0 ? way : c->size;
    return end(fabs(place(0, 0) - fmax(way, 0)) / scale);
}

/* Ten cubes, the top one of another mass: how far it sinks and goes astray, of its size. */
static double tower(const Case *c) {
    begin(c, G, 0);
    makeFloor();
    for (int i = 0; i < 10; i++)
        add(box(c->size, c->size, c->size), i == 9 ? c->ratio : 1, 0, 0, c->size * (.5 + i));
    for (int i = stepsIn(c, 3); i > 0; i--)
        step(c);
    const double off = fmax(hypot(place(9, 0), place(9, 1)), fabs(place(9, 2) - 9.5 * c->size));
    return end(off / c->size);
}

/* Ten links hang, the last one of another mass, and the chain swings: the larger of its gaps, of a link, and of the
 * energy that it gains or loses, of that of its motion at the start. */
static double chain(const Case *c) {
    double gap = 0;
    begin(c, G, 0);
    for (int i = 0; i < 10; i++) {
        const double z = -c->size * (i + .5);
        add(box(.1 * c->size, .1 * c->size, .8 * c->size), i == 9 ? c->ratio : 1, 0, 0, z);
        join(c, body(i), i > 0 ? body(i - 1) : 0, 0, 0, -c->size * i);
        MdtBodySetLinearVelocity(body(i), (MeReal)(c->speed * (i + .5) / 10), 0, 0);
        MdtBodySetAngularVelocity(body(i), 0, (MeReal)(-c->speed / (10 * c->size)), 0);
    }
    letPass();
    const double start = energy(G), max = energy(0);
    for (int i = stepsIn(c, 5); i > 0; i--) {
        MdtReport r;
        step(c);
        MdtWorldGetReport(u->world, &r);
        gap = fmax(gap, (double)r.jointGap / c->size);
    }
    return end(fmax(gap, fabs(energy(G) - start) / max));
}

/* The period of a pendulum, by the arithmetic-geometric mean. */
static double period(double length, double angle) {
    double a = 1, b = cos(angle / 2);
    for (int i = 0; i < 20; i++) {
        const double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return 2 * PI * sqrt(length / G) / a;
}

/* A bar that hangs at its end swings from `angle': five periods. */
static double pendulum(const Case *c) {
    begin(c, G, 0);
    const MdtBodyID b = add(box(.05 * c->size, .05 * c->size, c->size), 1, 0, 0, 0);
    MeMatrix3 I;
    MdtBodyGetInertiaTensor(b, I);
    const double arm = .5 * c->size, length = arm + (double)I[1][1] / arm;
    McdModelDynamicsSetPosition(model[0], (MeReal)(arm * sin(c->angle)), 0, (MeReal)(-arm * cos(c->angle)));
    McdModelDynamicsSetQuaternion(model[0], (MeReal)cos(c->angle / 2), 0, (MeReal)-sin(c->angle / 2), 0);
    join(c, b, 0, 0, 0, 0);
    double before = place(0, 0), first = 0, last = 0;
    int crossings = 0;
    const double whole = period(length, c->angle);
    for (int i = 1; crossings < 11 && i * c->step < 20 * whole && i < 60000; i++) {
        step(c);
        const double now = place(0, 0);
        if ((before > 0) != (now > 0)) {
            last = (i - now / (now - before)) * (double)(MeReal)c->step;
            first = crossings++ == 0 ? last : first;
        }
        before = now;
    }
    return end(crossings == 11 ? fabs((last - first) / 5 / whole - 1) : 1);
}

/* Five balls on strings, one of them lifted, and the last one of another mass: how high that rises, of how high it
 * should. A blow of masses m on M hands on (1 + e) m / (m + M) of the speed. */
static double cradle(const Case *c) {
    const double radius = c->size / 2, length = 4 * c->size, angle = c->angle;
    double top = 0;
    begin(c, G, 0);
    McdFrameworkSetDefaultContactTolerance(u->frame, (MeReal)(.1 * c->size)); /* farther than the gaps */
    for (int i = 0; i < 5; i++) {
        const double x = c->size * (1 + c->gap) * i;
        add(McdSphereCreate(u->frame, (MeReal)radius), i == 4 ? c->ratio : 1, x, 0, 0);
        join(c, body(i), 0, x, 0, length);
    }
    McdModelDynamicsSetPosition(model[0], (MeReal)(-length * sin(angle)), 0, (MeReal)(length * (1 - cos(angle))));
    McdModelDynamicsSetQuaternion(model[0], (MeReal)cos(angle / 2), 0, (MeReal)sin(angle / 2), 0);
    const double whole = period(length + .1 * c->size / 4, angle), e = 1 + c->restitution;
    for (double time = c->step; time < .7 * whole; time += c->step) {
        step(c);
        if (time > .3 * whole)
            top = fmax(top, place(4, 2));
    }
    const double share = pow(e / 2, 3) * e / (1 + c->ratio);
    const double height = share * share * length * (1 - cos(angle));
    return end(fabs(top / fmin(height, 2 * length) - 1));
}

/* 27 elastic balls fall, and fly about between walls: the energy after 3 s. */
static double crowd(const Case *c) {
    static MeMatrix4 wall[4];
    unsigned int seed = 1;
    const double apart = c->size * (1 + c->gap), half = 1.5 * apart + c->size;
    begin(c, G, 0);
    makeFloor();
    for (int i = 0; i < 4; i++) {
        const double side = i % 2 ? 1 : -1;
        MeMatrix4TMMakeIdentity(wall[i]);
        MeMatrix4TMSetPosition(wall[i], (MeReal)(i < 2 ? side * (half + c->size) : 0),
                               (MeReal)(i < 2 ? 0 : side * (half + c->size)), (MeReal)(50 * c->size));
        MstFixedModelCreate(
            u, box(i < 2 ? 2 * c->size : 99 * c->size, i < 2 ? 99 * c->size : 2 * c->size, 200 * c->size), wall[i]);
    }
    for (int i = 0; i < 27; i++) {
        MeReal v[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * 1664525u + 1013904223u;
            v[k] = (MeReal)(c->speed * ((seed >> 8) / 8388608. - 1));
        }
        add(McdSphereCreate(u->frame, (MeReal)(c->size / 2)), i == 13 ? c->ratio : 1, apart * (i / 9 - 1),
            apart * (i / 3 % 3 - 1), apart * (i % 3) + .6 * c->size);
        McdModelDynamicsSetLinearVelocity(model[i], v[0], v[1], v[2]);
    }
    const double start = energy(G) - .5 * c->size * G * (26 + c->ratio);
    for (int i = stepsIn(c, 3); i > 0; i--)
        step(c);
    return end(fabs((energy(G) - .5 * c->size * G * (26 + c->ratio)) / start - 1));
}

/* A disc of the radius `size' rolls on its rim round a circle, with the lean of `angle' from upright: how far that goes
 * astray in 5 s, rad (tests/Mst/test_Rims.c has the equations). */
static double coin(const Case *c) {
    const double R = c->size, thick = c->gap * R, half = thick / 2, circle = 3 * R * pow(fmax(.5 / c->angle, 1), 1.5),
                 s = sin(c->angle), k = cos(c->angle);
    MeMatrix3 I;
    MeMatrix4 tm;
    double worst = 0;
    begin(c, G, 0);
    makeFloor();
    const MdtBodyID b = add(McdCylinderCreate(u->frame, (MeReal)R, (MeReal)thick), 1, 0, 0, 0);
    MdtBodyGetInertiaTensor(b, I);
    const double A = (double)I[2][2], B = (double)I[0][0], dx = half * k - R * s, dz = R * k + half * s;
    const double W = sqrt(-G * dx / (dz * (circle + dx) + A * k * circle / R + (B - A) * s * k));
    const double spin = -W * circle / R;
    if (!(W > 0)) /* there is no such motion */
        return end(0);
    MeMatrix4TMMakeIdentity(tm);
    MeVector3Set(tm[0], (MeReal)-s, 0, (MeReal)k);
    MeVector3Set(tm[1], 0, -1, 0);
    MeVector3Set(tm[2], (MeReal)k, 0, (MeReal)s);
    MeVector3Set(tm[3], (MeReal)(circle + dx), 0, (MeReal)dz);
    MdtBodySetTransform(b, tm);
    MdtBodySetLinearVelocity(b, 0, (MeReal)(W * (circle + dx)), 0);
    MdtBodySetAngularVelocity(b, (MeReal)(spin * k), 0, (MeReal)(W + spin * s));
    for (int i = stepsIn(c, 5); i > 0; i--) {
        step(c);
        MdtBodyGetTransform(b, tm);
        worst = fmax(worst, fabs(asin(fmin(fabs((double)tm[2][2]), 1)) - c->angle));
    }
    return end(worst);
}

static double turnRate;

static MeBool MEAPI turnGround(McdIntersectResult *result, McdContact *contact, MdtContactID d) {
    (void)result, (void)contact;
    MdtConstraintSetWorldAngularVelocity(MdtContactQuaConstraint(d), 0, 0, (MeReal)turnRate);
    return METRUE;
}

/* A box on ground that turns, at 1 m from the axis, with the share `speed' of that at which it slides: how far it
 * creeps outward in 10 s, of its size. */
static double turning(const Case *c) {
    double worst = 0;
    begin(c, G, 0);
    turnRate = c->speed * sqrt(c->friction * G);
    MeMatrix4TMMakeIdentity(ground);
    MeMatrix4TMSetPosition(ground, 0, 0, (MeReal)-.1);
    MstFixedModelCreate(u, McdCylinderCreate(u->frame, 100, (MeReal).2), ground);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, turnGround);
    const MdtBodyID b = add(box(c->size, c->size, c->size / 2), 1, 1, 0, c->size / 4);
    MdtBodySetLinearVelocity(b, 0, (MeReal)turnRate, 0);
    MdtBodySetAngularVelocity(b, 0, 0, (MeReal)turnRate);
    for (int i = stepsIn(c, 10); i > 0; i--) {
        step(c);
        worst = fmax(worst, fabs(hypot(place(0, 0), place(0, 1)) - 1));
    }
    return end(worst / c->size);
}

static MdtBodyID bar(double length, double mass, double size, double x, double z, double angle) {
    const MdtBodyID b = add(box(length, .05 * size, .05 * size), mass, x, 0, z);
    McdModelDynamicsSetQuaternion(model[count - 1], (MeReal)cos(angle / 2), 0, (MeReal)-sin(angle / 2), 0);
    return b;
}

/* A parallelogram linkage, a motor on one crank that turns at `speed' rad/s, the coupler of another mass: how far the
 * cranks are from each other at most in 10 s, rad. */
static double linkage(const Case *c) {
    const double crank = .3 * c->size, x = crank * cos(c->angle), z = crank * sin(c->angle);
    const Case hinge = {.joint = HINGE};
    MdtBodyID cranks[2];
    double worst = 0;
    begin(c, G, 0);
    for (int i = 0; i < 2; i++) {
        cranks[i] = bar(crank, 1, c->size, i * c->size + x / 2, z / 2, c->angle);
        if (i == 1) {
            join(&hinge, cranks[1], 0, c->size, 0, 0);
            continue;
        }
        const MdtHingeID j = MdtHingeCreate(u->world);
        MdtHingeSetBodies(j, cranks[0], 0);
        MdtHingeSetPosition(j, 0, 0, 0);
        MdtHingeSetAxis(j, 0, 1, 0);
        MdtHingeEnable(j);
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), (MeReal)c->speed, (MeReal)(1e4 * c->size * (1 + c->ratio)));
    }
    const MdtBodyID coupler = bar(c->size, c->ratio, c->size, c->size / 2 + x, z, 0);
    join(&hinge, coupler, cranks[0], x, 0, z);
    join(&hinge, coupler, cranks[1], c->size + x, 0, z);
    letPass();
    for (int i = stepsIn(c, 10); i > 0; i--) {
        MeMatrix4 a, b;
        step(c);
        MdtBodyGetTransform(cranks[0], a);
        MdtBodyGetTransform(cranks[1], b);
        worst = fmax(
            worst,
            fabs(remainder(atan2((double)a[0][2], (double)a[0][0]) - atan2((double)b[0][2], (double)b[0][0]), 2 * PI)));
    }
    return end(worst);
}

/* A ring of twelve links hangs at its top, the lowest link of another mass, each link kicked another way: the larger of
 * its gaps, of a link, and of the energy that it gains or loses, of its weight on its length. The kick that its joints
 * do not let it have is gone after a step. */
static double ring(const Case *c) {
    enum { LINKS = 12 };
    const double link = c->size, corner = link / 2 / sin(PI / LINKS), middle = link / 2 / tan(PI / LINKS);
    double start = 0, worst = 0, weight = 0;
    begin(c, G, 0);
    for (int i = 0; i < LINKS; i++) {
        const double a = PI / 2 + 2 * PI * (i + .5) / LINKS;
        const MdtBodyID b =
            bar(link, i == LINKS / 2 ? c->ratio : 1, link, middle * cos(a), middle * sin(a), a + PI / 2);
        MdtBodySetLinearVelocity(b, (MeReal)(c->speed * sin(3 * i)), (MeReal)(c->speed * sin(7 * i)),
                                 (MeReal)(c->speed * cos(5 * i)));
        weight += G * (double)MdtBodyGetMass(b);
    }
    for (int i = 0; i < LINKS; i++) {
        const double a = PI / 2 + 2 * PI * i / LINKS;
        join(c, body(i), body((i + LINKS - 1) % LINKS), corner * cos(a), 0, corner * sin(a));
    }
    const Case ball = {.joint = BALL};
    join(&ball, body(0), 0, 0, 0, corner);
    letPass();
    for (int i = 0, n = stepsIn(c, 5); i < n; i++) {
        MdtReport r;
        step(c);
        MdtWorldGetReport(u->world, &r);
        start = i == 0 ? energy(G) : start;
        worst = fmax(worst, fmax((double)r.jointGap / link, fabs(energy(G) - start) / (weight * LINKS * link)));
    }
    return end(worst);
}

/* An arm is led along the path angle sin(w t) (1 + cos(3 w t) / 2), w = `speed', by the mean speed of each step: the
 * largest error of its angle, rad. */
static double pathAt(const Case *c, double t) {
    return c->angle * sin(c->speed * t) * (1 + cos(3 * c->speed * t) / 2);
}

static double ledArm(const Case *c) {
    const double h = (double)(MeReal)c->step;
    double worst = 0;
    begin(c, G, 0);
    const MdtBodyID b = bar(c->size, c->ratio, c->size, c->size / 2, 0, 0);
    const MdtHingeID j = MdtHingeCreate(u->world);
    MdtHingeSetBodies(j, b, 0);
    MdtHingeSetPosition(j, 0, 0, 0);
    MdtHingeSetAxis(j, 0, -1, 0);
    MdtHingeEnable(j);
    MdtLimitSetMotorTracking(MdtHingeGetLimit(j), METRUE);
    for (int i = 0, n = stepsIn(c, 5); i < n; i++) {
        const double rate = (pathAt(c, (i + 1) * h) - pathAt(c, i * h)) / h;
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(j), (MeReal)rate, (MeReal)1e20);
        step(c);
        worst = fmax(worst, fabs(remainder(atan2(place(0, 2), place(0, 0)) - pathAt(c, (i + 1) * h), 2 * PI)));
    }
    return end(worst);
}

/* ---- sweeps ------------------------------------------------------------------------------------------------------ */

enum { SIZE = 1, RATIO = 2, SPEED = 4, FRICTION = 8, STEP = 16, ANGLE = 32, GAP = 64, RESTITUTION = 128, JOINT = 256 };

typedef struct Scene {
    const char *name;
    double (*run)(const Case *c);
    Case base;
    int varied;
} Scene;

static const double hz60 = 1. / 60;

static const Scene scenes[] = {
    {"slope, slides", incline, {1, 1, 1, .2, hz60, .4, 0, 0, 0}, SIZE | SPEED | FRICTION | STEP | ANGLE},
    {"slope, sticks", incline, {1, 1, 0, .6, hz60, .4, 0, 0, 0}, SIZE | FRICTION | STEP | ANGLE},
    {"block, stops", incline, {1, 1, 3, .3, hz60, 0, 0, 0, 0}, SIZE | SPEED | FRICTION | STEP},
    {"tower", tower, {1, 1, 0, .5, hz60, 0, 0, 0, 0}, SIZE | RATIO | FRICTION | STEP},
    {"chain", chain, {1, 1, 2, .5, hz60, 0, 0, 0, BALL}, SIZE | RATIO | SPEED | STEP | JOINT},
    {"pendulum", pendulum, {1, 1, 0, .5, hz60, .5, 0, 0, HINGE}, SIZE | STEP | ANGLE | JOINT},
    {"cradle", cradle, {1, 1, 0, 0, hz60, .5, .02, 1, BALL}, SIZE | RATIO | STEP | ANGLE | GAP | JOINT},
    {"elastic crowd", crowd, {1, 1, 1, 0, hz60, 0, .5, 1, 0}, SIZE | RATIO | SPEED | STEP | GAP},
    {"coin", coin, {.5, 1, 0, .9, hz60, .5, .04, 0, 0}, SIZE | FRICTION | STEP | ANGLE | GAP},
    {"turning disc", turning, {.2, 1, .5, .5, hz60, 0, 0, 0, 0}, SIZE | SPEED | FRICTION | STEP},
    {"linkage", linkage, {1, 1, 6, .5, hz60, .3, 0, 0, HINGE}, SIZE | RATIO | SPEED | STEP | ANGLE},
    {"ring", ring, {.25, 1, .3, .5, hz60, 0, 0, 0, BALL}, SIZE | RATIO | SPEED | STEP},
    {"led arm", ledArm, {1, 1, 1, .5, hz60, 1, 0, 0, HINGE}, SIZE | RATIO | SPEED | STEP | ANGLE},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static MeBool showsAll;

/* The value so many thirds of a decade away; joints are counted. False: there is none. */
static MeBool valueAt(const Scene *s, int which, int i, double *value) {
    Case c = s->base;
    const double base = *parameter(&c, which);
    if (1 << which == JOINT) {
        *value = base + i;
        return *value >= 0 && *value < JOINTS;
    }
    *value = base * pow(10, i / 2.);
    return i >= -8 && i <= 8 && base > 0 && !(1 << which == RESTITUTION && *value > 1) &&
           !(1 << which == ANGLE && *value > 3) && !(1 << which == STEP && (*value > 1 || *value < 1e-4));
}

static double errorAt(const Scene *s, int which, double value) {
    Case c = s->base;
    *parameter(&c, which) = value;
    const double error = s->run(&c);
    if (showsAll)
        printf("    %-14s %10.3g  %9.2e%s\n", names[which], value, error, fallbacks ? "  (reported inexact)" : "");
    return isfinite(error) ? error : HUGE_VAL;
}

/* Below this, errors are rounding. */
static const double floorOfErrors = sizeof(MeReal) == sizeof(float) ? 1e-5 : 1e-8;

static void goOut(const Scene *s, int which, int direction, double atBase) {
    double before = atBase, value;
    for (int i = direction; valueAt(s, which, i, &value); i += direction) {
        const double error = errorAt(s, which, value);
        if (error > 10 * fmax(before, floorOfErrors)) {
            printf("%-14s %-14s %10.3g   %8.1e -> %8.1e%s\n", s->name, names[which], value, before, error,
                   fallbacks ? "  (reported inexact)" : "");
            if (!showsAll)
                return;
        }
        before = error;
    }
}

static void sweep(const Scene *s) {
    const double atBase = s->run(&s->base);
    printf("%-14s as it is %27.1e\n", s->name, atBase);
    for (int which = 0; which < PARAMETERS; which++)
        for (int direction = -1; direction <= 1 && (s->varied & 1 << which); direction += 2)
            goOut(s, which, direction, atBase);
    fflush(stdout);
}

static MeBool isChosen(const char *name, char *const argv[], int argc, int first) {
    for (int i = first; i < argc; i++)
        if (strcmp(argv[i], name) == 0)
            return METRUE;
    return first >= argc;
}

int main(int argc, char **argv) {
    showsAll = argc > 1 && strcmp(argv[1], "--all") == 0;
    for (int i = 0; i < SCENES; i++)
        if (isChosen(scenes[i].name, argv, argc, 1 + showsAll))
            sweep(&scenes[i]);
    return 0;
}
