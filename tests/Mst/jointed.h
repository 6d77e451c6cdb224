/* Joints among many contacts: a heavy chain that swings into a pile, a net that catches boxes, machines among crates.
 * Tests (test_Jointed.c) and bench/jointed.c have the same scenes, each with its own universe.h, included before. */
#ifndef JOINTED_H
#define JOINTED_H

enum { MAX = 1000 };

static const double gravity = 9.81;
static McdModelID model[MAX];
static MdtConstraintID joint[MAX];
static int numModels, numJoints;
static unsigned int seed;

static inline double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / (1 << 24);
}

static inline void makeWorld(MdtSolver solver, double friction) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    universe_begin(&MstUniverseGrowingSizes);
    numModels = numJoints = 0;
    MdtWorldSetGravity(u->world, 0, -gravity, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), friction, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
}

static inline McdModelID put(McdGeometryID g, const double at[3], double density) {
    const McdModelID m = MstModelAndBodyCreate(u, g, density);
    McdModelDynamicsSetPosition(m, at[0], at[1], at[2]);
    return model[numModels++] = m;
}

static inline McdModelID putAt(McdGeometryID g, double x, double y, double z, double density) {
    return put(g, (double[3]){x, y, z}, density);
}

static inline McdGeometryID box(double x, double y, double z) {
    return McdBoxCreate(u->frame, x, y, z);
}

static inline McdGeometryID ball(double radius) {
    return McdSphereCreate(u->frame, radius);
}

/* b null: the world. */
static inline void joinByBall(McdModelID a, McdModelID b, double x, double y, double z) {
    const MdtBSJointID j = MdtBSJointCreate(u->world);
    MdtBSJointSetBodies(j, McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtBSJointSetPosition(j, x, y, z);
    MdtBSJointEnable(j);
    joint[numJoints++] = MdtBSJointQuaConstraint(j);
    if (b)
        McdSpaceDisablePair(a, b);
}

static inline MdtLimitID joinByHinge(McdModelID a, McdModelID b, const double at[3], const double axis[3]) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    MdtHingeSetBodies(j, McdModelGetBody(a), McdModelGetBody(b));
    MdtHingeSetPosition(j, at[0], at[1], at[2]);
    MdtHingeSetAxis(j, axis[0], axis[1], axis[2]);
    MdtHingeEnable(j);
    joint[numJoints++] = MdtHingeQuaConstraint(j);
    McdSpaceDisablePair(a, b);
    return MdtHingeGetLimit(j);
}

/* m, of the joint that is open furthest. */
static inline double opening(void) {
    double max = 0;
    for (int i = 0; i < numJoints; i++) {
        MeVector3 a, b;
        MdtConstraintBodyGetPosition(joint[i], 0, a);
        MdtConstraintBodyGetPosition(joint[i], 1, b);
        MeVector3Subtract(a, a, b);
        const double open = MeVector3Magnitude(a);
        max = open <= max ? max : open;
    }
    return max;
}

/* A level chain of links of half a kilogram, the first one joined to the world. Returns the last. */
static inline McdModelID makeLinks(int links, double height) {
    McdModelID last = 0;
    for (int i = 0; i < links; i++) {
        const McdModelID m = putAt(box(.2, .05, .05), .1 + .2 * i, height, 0, 1000);
        joinByBall(m, last, .2 * i, height, 0);
        last = m;
    }
    return last;
}

/* Twenty links of half a kilogram and a ball of a ton, let go level, swing into a pile. */
static inline void makeHeavyChain(MdtSolver solver) {
    makeWorld(solver, .5);
    const McdModelID last = makeLinks(20, 6);
    joinByBall(putAt(ball(.4), 4.4, 6, 0, 1000 / (4. / 3 * ME_PI * .4 * .4 * .4)), last, 4, 6, 0);
    for (int i = 0; i < 60; i++)
        putAt(box(.5, .5, .5), -2 + .55 * (i % 6), .25 + .5 * (i / 12), -.3 + .55 * (i / 6 % 2), 300);
}

enum { KNOTS = 10 };

/* Balls joined to their neighbours, level, and the rim to the world, or one side of it. */
static inline void makeKnots(MeBool isRimHeld) {
    McdModelID knot[KNOTS][KNOTS];
    const double middle = .2 * (KNOTS - 1);
    for (int i = 0; i < KNOTS; i++)
        for (int k = 0; k < KNOTS; k++) {
            const double x = .4 * i - middle, z = .4 * k - middle;
            const MeBool isRim = i == 0 || k == 0 || i == KNOTS - 1 || k == KNOTS - 1;
            knot[i][k] = putAt(ball(.12), x, 4, z, 1000);
            if (i > 0)
                joinByBall(knot[i][k], knot[i - 1][k], x - .2, 4, z);
            if (k > 0)
                joinByBall(knot[i][k], knot[i][k - 1], x, 4, z - .2);
            if (isRimHeld ? isRim : i == 0)
                joinByBall(knot[i][k], 0, x, 4, z);
        }
}

/* Let go level, it swings down, and folds. */
static inline void makeCloth(MdtSolver solver) {
    makeWorld(solver, .5);
    makeKnots(MEFALSE);
}

/* Boxes of five times the knots' mass above it. */
static inline void makeNet(MdtSolver solver) {
    makeWorld(solver, .5);
    makeKnots(METRUE);
    for (int i = 0; i < 36; i++)
        putAt(box(.5, .5, .5), .7 * (i % 3) - .7, 4.6 + .6 * (i / 9), .7 * (i / 3 % 3) - .7, 300);
}

/* A car with motors at its four wheels and an arm of five links before it, each driven. */
static inline void makeMachine(double z) {
    static const double across[3] = {0, 0, 1};
    const McdModelID car = putAt(box(2, .4, 1), 0, .7, z, 200);
    McdModelID last = car;
    for (int k = 0; k < 4; k++) {
        const double at[3] = {k & 1 ? .8 : -.8, .4, z + (k & 2 ? .75 : -.75)};
        const McdModelID wheel = put(McdCylinderCreate(u->frame, .4, .3), at, 200);
        const MdtLimitID drive = joinByHinge(wheel, car, at, across);
        MdtLimitSetLimitedForceMotor(drive, -8, 400);
        MdtLimitActivateMotor(drive, METRUE);
    }
    for (int k = 0; k < 5; k++) {
        const McdModelID link = putAt(box(1, .15, .15), 1.5 + k, 1.2, z, 100);
        const MdtLimitID drive = joinByHinge(link, last, (double[3]){1 + k, 1.2, z}, across);
        MdtLimitSetLimitedForceMotor(drive, .3 * sin(k), 300);
        MdtLimitActivateMotor(drive, METRUE);
        last = link;
    }
}

static inline void makeMachines(MdtSolver solver, int machines, int crates) {
    makeWorld(solver, .5);
    for (int i = 0; i < machines; i++)
        makeMachine(4 * i);
    for (int i = 0; i < crates; i++)
        putAt(box(.6, .6, .6), 9 + .9 * (i % 4), .3, .9 * (i / 4) - .5, 100);
}

#endif
