/* Scenes by which the choice of a solver is judged, each with its error: bench/choice.c measures them, test_Choice.c
 * asserts the errors. Universes with their defaults, y up, friction .5, a ground at height 0, nothing sleeps. */
#ifndef CHOICE_SCENES_H
#define CHOICE_SCENES_H

#include "ragdoll.h"

#include <stdio.h>

enum { MAX = 1100, FIXED = 5, MOTORS = 56, VALUES = 5 };

static const double h = 1. / 60, gravity = 9.81, pi = 3.14159265358979;

/* What a scene is judged by, when it has ended, and one more figure. */
typedef struct Measure {
    const char *what;
    double (*error)(void);
    const char *alsoWhat;
    double (*also)(void);
} Measure;

typedef struct Scene {
    const char *name;
    void (*make)(const double p[3]);
    double values[3][VALUES]; /* that each of p takes in turn; a 0 after the first one ends them */
    double time;              /* s */
    const Measure *measure;
    double acceptable; /* the largest error that is */
} Scene;

/* A scene with one value of each of its parameters. */
typedef struct Variant {
    const Scene *scene;
    double p[3];
    char name[80];
} Variant;

/* ---- the scene that is simulated --------------------------------------------------------------------------------- */

static MstUniverseID universe;
static McdModelID model[MAX];
static MeVector3 start[MAX];              /* where models were */
static int bodies, fixed, watched;        /* the last: the body that the scene's error is about */
static double mass, size;                 /* kg, of all bodies; m, by which an error is divided */
static void (*drive)(double t);           /* called before each step; null: nothing to do */
static double deepest, meanOverlap, late; /* m, of the last step, and the deepest after two seconds */
static double firstEnergy, lastEnergy;    /* J, at the end of the first step and of the last one */
static double gained, widest;             /* J/kg, m: by a step, of a joint's gap, at most of all steps */
static MeVector3 reference;               /* m: where the watched body comes to with sub-steps */
static unsigned int seed;
static MeMatrix4 fixedTM[FIXED]; /* kept by pointer */

static double randomFrom(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / (1 << 24);
}

static McdGeometryID boxOf(double x, double y, double z) {
    return McdBoxCreate(universe->frame, x, y, z);
}

static McdModelID add(McdModelID m) {
    if (bodies == MAX)
        abort();
    mass += (double)MdtBodyGetMass(McdModelGetBody(m));
    return model[bodies++] = m;
}

static McdModelID put(McdGeometryID g, double density, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(universe, g, density);
    McdModelDynamicsSetPosition(m, x, y, z);
    return add(m);
}

static void addFixed(McdGeometryID g, double x, double y, double z) {
    MeMatrix4 *tm = &fixedTM[fixed++];
    MeMatrix4TMMakeIdentity(*tm);
    MeVector3Set((*tm)[3], x, y, z);
    MstFixedModelCreate(universe, g, *tm);
}

/* Around a square of that side. */
static void addWalls(double side, double high) {
    const McdGeometryID along = boxOf(side + 2, high, 1), across = boxOf(1, high, side + 2);
    for (int sign = -1; sign <= 1; sign += 2) {
        addFixed(along, 0, high / 2, sign * (side + 1) / 2);
        addFixed(across, sign * (side + 1) / 2, high / 2, 0);
    }
}

static void turnAnyWay(McdModelID m) {
    MeReal q[4];
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)randomFrom(-.5, .5);
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
}

static void setSurface(double friction, double restitution) {
    MdtContactParamsSetSurface(MstBridgeGetContactParams(universe->bridge, 0, 0), friction, restitution);
}

/* With a ground at height 0. */
static void makeUniverse(MdtSolver solver) {
    static MeMatrix4 groundTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    universe = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!universe)
        abort();
    MdtWorldSetGravity(universe->world, 0, -gravity, 0);
    MdtWorldSetAutoDisable(universe->world, MEFALSE);
    MdtWorldSetSolver(universe->world, solver);
    MdtWorldEnableReport(universe->world);
    MstFixedModelCreate(universe, McdPlaneCreate(universe->frame), groundTM);
    setSurface(.5, 0);
    bodies = watched = fixed = 0;
    mass = late = gained = widest = 0;
    size = seed = 1;
    drive = NULL;
}

/* b: null is the world. */
static MdtHingeID addHinge(McdModelID a, McdModelID b, const double at[3], const double axis[3]) {
    const MdtHingeID hinge = MdtHingeCreate(universe->world);
    MdtHingeSetBodies(hinge, McdModelGetBody(a), b ? McdModelGetBody(b) : NULL);
    MdtHingeSetPosition(hinge, at[0], at[1], at[2]);
    MdtHingeSetAxis(hinge, axis[0], axis[1], axis[2]);
    MdtHingeEnable(hinge);
    if (b)
        McdSpaceDisablePair(a, b);
    return hinge;
}

/* ---- errors ------------------------------------------------------------------------------------------------------ */

/* m, how far it has gone along an axis. */
static double moved(int i, int axis) {
    MeVector3 p;
    McdModelDynamicsGetPosition(model[i], p);
    return (double)p[axis] - (double)start[i][axis];
}

static double drift(void) {
    double max = 0;
    for (int i = 0; i < bodies; i++)
        max = fmax(max, hypot(moved(i, 0), moved(i, 2)));
    return max;
}

static double lateOverlap(void) {
    return late;
}

static double sink(void) {
    return -moved(watched, 1) / size;
}

/* How many are lower than they were by more than half a size of the smallest body. */
static double fallen(void) {
    int count = 0;
    for (int i = 0; i < bodies; i++)
        count += -moved(i, 1) > size / 2;
    return count;
}

/* A contact of two bodies is in the lists of both. */
static void noteOverlaps(void) {
    int count = 0;
    deepest = meanOverlap = 0;
    for (MdtBodyID b = MdtBodyGetFirst(universe->world); b; b = MdtBodyGetNext(b))
        for (MdtContactID k = MdtBodyGetFirstContact(b); k; k = MdtBodyGetNextContact(b, k)) {
            const double depth = fmax(MdtContactGetPenetration(k), 0);
            if (MdtContactGetBody(k, 0) != b)
                continue;
            count++;
            meanOverlap += depth;
            deepest = fmax(deepest, depth);
        }
    meanOverlap /= count ? count : 1;
}

static double endOverlap(void) {
    return deepest;
}

static double endMeanOverlap(void) {
    return meanOverlap;
}

static double belowLowest(void) {
    double lowest = start[0][1];
    for (int i = 0; i < bodies; i++)
        lowest = fmin(lowest, start[i][1]);
    return lowest - (double)start[watched][1] - moved(watched, 1);
}

static double belowOrIn(void) {
    return fmax(belowLowest(), late);
}

static double energyChange(void) {
    return fabs(lastEnergy / firstEnergy - 1);
}

static double fromReference(void) {
    MeVector3 p;
    McdModelDynamicsGetPosition(model[watched], p);
    MeVector3Subtract(p, p, reference);
    return (double)MeVector3Magnitude(p);
}

static const Measure overlapAndDrift = {"deepest overlap after 2 s, m", lateOverlap, "sideways drift, m", drift};
static const Measure below = {"load in or below planks, m", belowOrIn, "below the lowest's start, m", belowLowest};
static const Measure sinkAndFallen = {"top sinks, plank's heights", sink, "planks fallen", fallen};
static const Measure sinkAndDrift = {"top sinks, cubes", sink, "sideways drift, m", drift};
static const Measure overlaps = {"deepest overlap at the end, m", endOverlap, "mean overlap, m", endMeanOverlap};
static const Measure overlapAndSink = {"deepest overlap at the end, m", endOverlap, "top sinks, cubes", sink};
static const Measure overlapAndDown = {"deepest overlap at the end, m", endOverlap, "fallen", fallen};
static const Measure energy = {"energy changes, of 1", energyChange, "deepest overlap, m", endOverlap};
static const Measure placeAndWay = {"from the reference, m", fromReference, "the farthest goes, m", drift};

/* ---- heavy on light ---------------------------------------------------------------------------------------------- */

/* A stack of cubes, with one that is dropped from half a metre: how many, kg. */
static void makeLoadedCubes(const double p[3]) {
    const McdGeometryID cube = boxOf(1, 1, 1);
    const int count = (int)p[0];
    for (int i = 0; i < count; i++)
        put(cube, 1, 0, .5 + i, 0);
    put(cube, p[1], 0, count + 1., 0);
}

/* Four layers of cubes of 1 kg that lie .01 m above each other: cubes along an edge of a layer. */
static void addCubes(int edge) {
    const McdGeometryID cube = boxOf(1, 1, 1);
    for (int i = 0; i < 4 * edge * edge; i++)
        put(cube, 1, 1.02 * (i % edge), .5 + 1.01 * (i / (edge * edge)), 1.02 * (i / edge % edge));
}

/* A drum that lies and falls by .1 m onto such cubes: along an edge; kg. */
static void makeDrumOnCubes(const double p[3]) {
    const double edge = p[0], middle = .51 * (edge - 1);
    addCubes((int)edge);
    put(McdCylinderCreate(universe->frame, edge / 2, edge), p[1] / (pi / 4 * edge * edge * edge), middle,
        4.14 + edge / 2, middle);
}

/* A slab that falls by .1 m onto such cubes: along an edge; kg. */
static void makeSlabOnCubes(const double p[3]) {
    const int edge = (int)p[0];
    addCubes(edge);
    put(boxOf(edge, 1, edge), p[1] / (edge * edge), .51 * (edge - 1), 4.64, .51 * (edge - 1));
}

/* A bridge of 30 planks of 1 kg in a row, hung up at both ends 20 m high, and a cube above its middle: m, by how much
 * it sags at first, to 1 %; kg. */
static void makeLoadedBridge(const double p[3]) {
    static const double axis[3] = {0, 0, 1};
    const McdGeometryID plank = boxOf(1, .1, 2);
    double at[3] = {0, 20, 0}, middle[3] = {0, 0, 0};
    for (int i = 0; i < 30; i++) {
        const double angle = p[0] / 7.76 * (i / 14.5 - 1), x = cos(angle), y = sin(angle);
        const McdModelID m = put(plank, 5, at[0] + x / 2, at[1] + y / 2, 0);
        McdModelDynamicsSetQuaternion(m, cos(angle / 2), 0, 0, sin(angle / 2));
        addHinge(m, i ? model[i - 1] : NULL, at, axis);
        at[0] += x;
        at[1] += y;
        if (i == 14)
            memcpy(middle, at, sizeof at);
    }
    addHinge(model[29], NULL, at, axis);
    watched = 30;
    put(boxOf(1, 1, 1), p[1], middle[0], middle[1] + .05 + .5 + .5, 0);
}

/* ---- towers ------------------------------------------------------------------------------------------------------ */

/* Layers of three planks, crosswise: how many. */
static void makeKapla(const double p[3]) {
    const McdGeometryID plank[2] = {boxOf(.12, .008, .024), boxOf(.024, .008, .12)};
    for (int i = 0; i < (int)p[0]; i++)
        for (int k = -1; k <= 1; k++)
            put(plank[i % 2], 600, i % 2 ? .048 * k : 0, .008 * (i + .5), i % 2 ? 0 : .048 * k);
    watched = bodies - 2; /* the middle one of the top */
    size = .008;
}

/* How many; m; how many times the mass of a cube its top has. A cube of 1 m has 1 kg, the smaller ones water's. */
static void makeStack(const double p[3]) {
    const int count = (int)p[0];
    const McdGeometryID cube = boxOf(p[1], p[1], p[1]);
    const double density = p[1] < 1 ? 1000 : 1;
    for (int i = 0; i < count; i++)
        put(cube, i == count - 1 ? p[2] * density : density, 0, p[1] * (i + .5), 0);
    watched = count - 1;
    size = p[1];
}

/* ---- joints and contacts ----------------------------------------------------------------------------------------- */

/* Of a figure of boxes on its back, m: where it lies and what it is joined to, by a hinge if that has an axis. */
typedef struct Limb {
    double x, z, wide, tall;
    int to;
    double jointX, jointZ, axis[3];
} Limb;

enum { LIMBS = 11, HAND = 6 };
static const double thick = .16; /* m */
static const Limb limb[LIMBS] = {
    {0, 0, .34, .24, -1, 0, 0, {0}},
    {0, .35, .40, .42, 0, 0, .13, {0}},
    {0, .70, .16, .24, 1, 0, .57, {0}},
    {-.36, .5, .28, .10, 1, -.21, .5, {0}},
    {.36, .5, .28, .10, 1, .21, .5, {0}},
    {-.66, .5, .28, .10, 3, -.51, .5, {0, -1, 0}},
    {.66, .5, .28, .10, 4, .51, .5, {0, 1, 0}},
    {-.1, -.35, .14, .42, 0, -.1, -.13, {0}},
    {.1, -.35, .14, .42, 0, .1, -.13, {0}},
    {-.1, -.79, .12, .42, 7, -.1, -.57, {1, 0, 0}},
    {.1, -.79, .12, .42, 8, .1, -.57, {1, 0, 0}},
};

/* Elbows and knees bend to one side only. */
static void addLimb(const Limb *l) {
    const double at[3] = {l->jointX, thick / 2, l->jointZ};
    const McdModelID m = put(boxOf(l->wide, thick, l->tall), 1000, l->x, thick / 2, l->z);
    if (l->to >= 0 && hypot(l->axis[0], l->axis[1]) > 0) {
        const MdtLimitID limit = MdtHingeGetLimit(addHinge(m, model[l->to], at, l->axis));
        doll_setStop(MdtLimitGetLowerLimit(limit), 0);
        doll_setStop(MdtLimitGetUpperLimit(limit), 2.2);
        MdtLimitActivateLimits(limit, METRUE);
    } else if (l->to >= 0) {
        doll_addSocket(universe->world, McdModelGetBody(m), McdModelGetBody(model[l->to]), at);
        McdSpaceDisablePair(m, model[l->to]);
    }
}

static MdtSpringID spring;

/* The spring's end goes along the ground with 1 m/s. */
static void pullSpring(double t) {
    MdtSpringSetPosition(spring, 1, 1.1 + .8 * t, .4, .5 + .6 * t);
}

/* A hand is dragged by a spring from above. */
static void makeDragged(const double p[3]) {
    (void)p;
    for (int i = 0; i < LIMBS; i++)
        addLimb(&limb[i]);
    spring = MdtSpringCreate(universe->world);
    MdtSpringSetBodies(spring, McdModelGetBody(model[HAND]), NULL);
    MdtSpringSetPosition(spring, 0, .8, thick / 2, .5);
    pullSpring(0);
    MdtSpringSetNaturalLength(spring, .4);
    MdtSpringSetStiffness(spring, 5000);
    MdtSpringSetDamping(spring, 200);
    MdtSpringEnable(spring);
    watched = HAND;
    drive = pullSpring;
}

static MdtLimitID motor[MOTORS]; /* of a hip, of its knee, and so on */

/* Hips lift and knees swing: a wave runs along the legs, those of a side against those of the other. */
static void driveLegs(double t) {
    for (int i = 0; i < MOTORS; i++) {
        const int leg = i / 2;
        const double phase = 2 * pi * (leg / 2 / 7. + leg % 2 / 2. - i % 2 / 4.);
        MdtLimitSetLimitedForceMotor(motor[i], 1.6 * cos(2 * pi * t + phase), 2);
    }
}

/* A thigh that sticks out of the trunk to a side, 1 or -1, and a shin that hangs from it; i: its hip's motor. */
static void addLeg(McdModelID trunk, double x, int side, int i) {
    const double hip[3] = {x, .1, .04 * side}, knee[3] = {x, .1, .12 * side};
    const double lift[3] = {-side, 0, 0}, swingAxis[3] = {0, 0, 1};
    const McdModelID thigh = put(boxOf(.03, .03, .076), 1000, x, .1, .08 * side);
    const McdModelID shin = put(boxOf(.03, .1, .03), 1000, x, .05, .137 * side);
    motor[i] = MdtHingeGetLimit(addHinge(thigh, trunk, hip, lift));
    motor[i + 1] = MdtHingeGetLimit(addHinge(shin, thigh, knee, swingAxis));
}

/* A chain of 18 trunks with brakes between them, and legs of two parts at both sides of all but two at each end. */
static void makeWalker(const double p[3]) {
    static const double upright[3] = {0, 1, 0};
    McdModelID trunk[18];
    (void)p;
    for (int i = 0; i < 18; i++) {
        const double between[3] = {.14 * i - .07, .1, 0};
        trunk[i] = put(boxOf(.12, .05, .076), 1000, .14 * i, .1, 0);
        if (i > 0)
            MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(addHinge(trunk[i], trunk[i - 1], between, upright)), 0, 5);
        for (int side = 0; side < 2 && i >= 2 && i < 16; side++)
            addLeg(trunk[i], .14 * i, 2 * side - 1, 4 * (i - 2) + 2 * side);
    }
    drive = driveLegs;
}

/* ---- crowds ------------------------------------------------------------------------------------------------------ */

/* A hundred of ten cubes, 3 mm above each other: m, between columns. */
static void makeColumns(const double p[3]) {
    const McdGeometryID cube = boxOf(1, 1, 1);
    for (int i = 0; i < 1000; i++)
        put(cube, 1, (1 + p[0]) * (i / 100), .5 + .003 + 1.003 * (i % 10), (1 + p[0]) * (i / 10 % 10));
    watched = bodies - 1;
}

/* How many rows, with gaps of .1 m in them. */
static void makePyramid(const double p[3]) {
    const McdGeometryID cube = boxOf(1, 1, 1);
    for (int row = 0; row < (int)p[0]; row++)
        for (int i = 0; i < (int)p[0] - row; i++)
            put(cube, 1, 1.1 * (i + .5 * row), .5 + row, 0);
    watched = bodies - 1;
}

static void makeHeap(const double p[3]) {
    const McdGeometryID box = boxOf(.5, .5, .5);
    addWalls(5, 20);
    for (int i = 0; i < (int)p[0]; i++)
        turnAnyWay(put(box, 500, .95 * (i % 5 - 2), .5 + .95 * (i / 25), .95 * (i / 5 % 5 - 2)));
}

/* Above each other in fours, thrown a little. */
static void makeDolls(const double p[3]) {
    static Doll doll[40];
    for (int i = 0; i < (int)p[0]; i++) {
        const double feet[3] = {.9 * (i % 2), .1 + 2.1 * (i / 4), .9 * (i / 2 % 2)};
        double v[3], w[3];
        doll_make(&doll[i], universe, feet);
        for (int k = 0; k < 3; k++)
            v[k] = randomFrom(-1, 1), w[k] = randomFrom(-1, 1);
        doll_throw(&doll[i], v, w);
        for (int k = 0; k < DOLL_PARTS; k++)
            add(doll[i].model[k]);
    }
}

/* The first one turns about its far lower edge. */
static void makeDominoes(const double p[3]) {
    const McdGeometryID domino = boxOf(.1, .5, .25);
    for (int i = 0; i < (int)p[0]; i++)
        put(domino, 80, .25 * i, .25, 0);
    McdModelDynamicsSetAngularVelocity(model[0], 0, 0, -2);
    McdModelDynamicsSetLinearVelocity(model[0], .5, .1, 0);
    size = .15; /* one that leans on the next one is .1 m lower than it was */
}

/* As many boxes as balls, thrown and turned any way. */
static void makeDebris(const double p[3]) {
    const McdGeometryID shape[2] = {boxOf(.5, .5, .5), McdSphereCreate(universe->frame, .25)};
    for (int i = 0; i < (int)p[0]; i++) {
        const McdModelID m = put(shape[i % 2], 8, 8 * (i % 20), 1, 8 * (i / 20));
        turnAnyWay(m);
        McdModelDynamicsSetLinearVelocity(m, randomFrom(-3, 3), 0, randomFrom(-3, 3));
    }
}

/* Ten rows of five bricks, every second one by half a brick aside, and a ball of 226 kg with 10 m/s. */
static void makeWall(const double p[3]) {
    const McdGeometryID brick = boxOf(.2, .2, .4);
    (void)p;
    for (int i = 0; i < 50; i++)
        put(brick, 2000, 0, .1 + .2 * (i / 5), .4 * (i % 5 - 2) + .2 * (i / 5 % 2));
    McdModelDynamicsSetLinearVelocity(put(McdSphereCreate(universe->frame, .3), 2000, -2, 1.2, .1), 10, 0, 0);
    size = .4;
}

/* Balls that lose nothing, in a box. */
static void makeElastic(const double p[3]) {
    const McdGeometryID ball = McdSphereCreate(universe->frame, .2);
    addWalls(4, 4);
    addFixed(boxOf(6, 1, 6), 0, 4.5, 0);
    setSurface(0, 1);
    for (int i = 0; i < (int)p[0]; i++) {
        const McdModelID m = put(ball, 30, i % 4 - 1.5, .5 + i / 16, i / 4 % 4 - 1.5);
        McdModelDynamicsSetLinearVelocity(m, randomFrom(-5, 5), randomFrom(-5, 5), randomFrom(-5, 5));
    }
}

/* ---- one body with a known answer, alone or beside boxes that fall ----------------------------------------------- */

static const double slope = .35 /* rad */, slidingSpeed = 3 /* m/s */, slidingFriction = .3;

static double slideError(void) {
    return fabs(moved(watched, 0) - slidingSpeed * slidingSpeed / (2 * slidingFriction * gravity));
}

/* After one second. */
static double rollError(void) {
    return fabs(moved(watched, 0) - .5 * 5. / 7 * gravity * sin(slope));
}

/* Of a bar of 1 m that began at rest: of the energy that it has on its way down. */
static double swingError(void) {
    const MdtBodyID b = McdModelGetBody(model[watched]);
    MeVector3 v, w;
    MdtBodyGetLinearVelocity(b, v);
    MdtBodyGetAngularVelocity(b, w);
    const double kinetic = ((double)MeVector3Dot(v, v) + 1.01 / 12 * (double)MeVector3Dot(w, w)) / 2;
    return fabs((kinetic + gravity * moved(watched, 1)) / (gravity / 2));
}

static const Measure slide = {"way is wrong by, m", slideError, "deepest overlap, m", endOverlap};
static const Measure roll = {"way is wrong by, m", rollError, "deepest overlap, m", endOverlap};
static const Measure swing = {"energy is wrong by, of 1", swingError, "deepest overlap, m", endOverlap};

/* At a side, each by itself. */
static void addFalling(int count) {
    const McdGeometryID box = boxOf(.5, .5, .5);
    for (int i = 0; i < count; i++)
        turnAnyWay(put(box, 8, 2 * (i % 10) - 9, randomFrom(.6, 2), 6 + 2 * (i / 10)));
}

static void makeSliding(const double p[3]) {
    setSurface(slidingFriction, 0);
    McdModelDynamicsSetLinearVelocity(put(boxOf(1, .5, 1), 2, 0, .25, 0), slidingSpeed, 0, 0);
    addFalling((int)p[0]);
}

static void makeRolling(const double p[3]) {
    MdtWorldSetGravity(universe->world, gravity * sin(slope), -gravity * cos(slope), 0);
    put(McdSphereCreate(universe->frame, .5), 2, 0, .5, 0);
    addFalling((int)p[0]);
}

static void makeSwinging(const double p[3]) {
    static const double at[3] = {0, 2, 0}, axis[3] = {0, 0, 1};
    addHinge(put(boxOf(1, .1, .1), 100, .5, 2, 0), NULL, at, axis);
    addFalling((int)p[0]);
}

/* ---- all of them ------------------------------------------------------------------------------------------------- */

static const Scene scenes[] = {
    {"ton-cubes", makeLoadedCubes, {{8, 10, 20}, {100, 1000}}, 10, &overlapAndDrift, .001},
    {"slab", makeSlabOnCubes, {{2, 3, 4}, {1e3, 1e4}}, 5, &overlapAndDrift, .001},
    {"drum", makeDrumOnCubes, {{2, 3}, {1e3, 1e4}}, 5, &overlapAndDrift, .001},
    {"ton-bridge", makeLoadedBridge, {{.1, .5, 1}, {1, 1000, 10000}}, 20, &below, .001},
    {"kapla", makeKapla, {{60, 100}}, 30, &sinkAndFallen, .001},
    {"stack", makeStack, {{20, 63, 64, 65, 100}, {1, .05, .02}, {1}}, 10, &sinkAndDrift, 1e-4},
    {"stack", makeStack, {{20, 64}, {1}, {10000}}, 10, &sinkAndDrift, 1e-4},
    {"dragged", makeDragged, {{0}}, 3, &placeAndWay, .02},
    {"walker", makeWalker, {{0}}, 3, &placeAndWay, .02},
    {"columns", makeColumns, {{1, .003}}, 5, &overlapAndSink, .001},
    {"pyramid", makePyramid, {{20, 40}}, 5, &overlapAndSink, .001},
    {"heap", makeHeap, {{500}}, 8, &overlaps, .01},
    {"dolls", makeDolls, {{40}}, 6, &overlaps, .01},
    {"dominoes", makeDominoes, {{60}}, 10, &overlapAndDown, .002},
    {"debris", makeDebris, {{200}}, 6, &overlaps, .002},
    {"wall", makeWall, {{0}}, 5, &overlapAndDown, .005},
    {"elastic", makeElastic, {{64}}, 10, &energy, .01},
    {"slide", makeSliding, {{0, 100}}, 3, &slide, .01},
    {"roll", makeRolling, {{0, 100}}, 1, &roll, .01},
    {"swing", makeSwinging, {{0, 100}}, 10, &swing, .01},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* Of a scene, by its number in all combinations of values; whether there is one. Its name has the values. */
static inline MeBool makeVariant(Variant *v, const Scene *scene, int number) {
    int length = snprintf(v->name, sizeof v->name, "%s", scene->name);
    v->scene = scene;
    for (int k = 0; k < 3; k++, number /= VALUES) {
        v->p[k] = scene->values[k][number % VALUES];
        if (number % VALUES > 0 && !(v->p[k] > 0))
            return MEFALSE;
        if (v->p[k] > 0)
            length += snprintf(v->name + length, sizeof v->name - (size_t)length, "-%g", v->p[k]);
    }
    return METRUE;
}

static void makeScene(const Variant *v) {
    v->scene->make(v->p);
    for (int i = 0; i < bodies; i++)
        McdModelDynamicsGetPosition(model[i], start[i]);
}

/* Takes a step; notes what it did. */
static void advance(int i) {
    if (drive)
        drive(i * h);
    MstUniverseStep(universe, h);
}

static void note(int i) {
    MdtReport report;
    MdtWorldGetReport(universe->world, &report);
    const double e = (double)report.kineticEnergy + (double)report.potentialEnergy;
    noteOverlaps();
    widest = fmax(widest, report.jointGap);
    if (i == 0)
        firstEnergy = e;
    else
        gained = fmax(gained, (e - lastEnergy) / mass);
    if (i * h >= 2)
        late = fmax(late, deepest);
    lastEnergy = e;
}

#endif
