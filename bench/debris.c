/* What many bodies cost that move each by itself: chosen automatically, which takes them in batches, and exactly.
 *
 *     debris [--bodies N] [--steps N] [--shape box|ball|capsule|cylinder] [--terrain] [--asleep]
 *
 * 600 bodies, 400 steps, boxes, capsules and balls in turn if not given. On a plane they lie 4 m apart, a metre above
 * it, and are thrown in any direction with up to 7 m/s; on a terrain of 64 by 64 cells of a metre they fall on hills of
 * .8 m, where some meet. Friction .5, steps of 1/60 s, nothing put to sleep but with --asleep. A line for every hundred
 * steps: ms a step of either, in turns of ten; how many partitions of the first the fast solver took; the deepest
 * overlap of either. */
#include "timing.h"

#include "MdtReport.h"
#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STRETCH = 100, TURN = 10 /* steps */ };
enum { BOX, BALL, CAPSULE, CYLINDER, SHAPES };

static const char *const shapeName[SHAPES] = {"box", "ball", "capsule", "cylinder"};

typedef struct Options {
    int bodies, steps, shape; /* shape -1: boxes, balls and capsules */
    MeBool isTerrain, sleeps;
} Options;

typedef struct Side {
    MstUniverseID universe;
    double time, deepest; /* s, m, of a stretch */
    long fast;            /* partitions, over its steps */
} Side;

static double randomFrom(unsigned int *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / (1 << 24);
}

static McdGeometryID shapeOf(McdFramework *frame, int shape) {
    switch (shape) {
    case BOX:
        return McdBoxCreate(frame, (MeReal).6, (MeReal).5, (MeReal).4);
    case BALL:
        return McdSphereCreate(frame, (MeReal).3);
    case CAPSULE:
        return McdSphylCreate(frame, (MeReal).2, (MeReal).5);
    default:
        return McdCylinderCreate(frame, (MeReal).3, (MeReal).6);
    }
}

static McdGeometryID groundOf(McdFramework *frame, MeBool isTerrain) {
    enum { POINTS = 65 };
    static MeReal height[POINTS * POINTS]; /* both universes' fields have it */
    if (!isTerrain)
        return McdPlaneCreate(frame);
    for (int i = 0; i < POINTS * POINTS; i++)
        height[i] = (MeReal)(.8 * sin(.5 * (i % POINTS)) * cos(.4 * (i / POINTS)));
    return McdRGHeightFieldCreate(frame, height, POINTS, POINTS, 1, 1, -32, -32);
}

static void putBody(MstUniverseID u, const Options *o, int i, unsigned int *seed) {
    const int shape = o->shape >= 0 ? o->shape : i % 3;
    const McdModelID m = MstModelAndBodyCreate(u, shapeOf(u->frame, shape), 500);
    MeReal q[4], v[2];
    double x = 4 * (i % 25), z = 4 * (i / 25), y = 1;
    if (o->isTerrain)
        x = randomFrom(seed, -25, 25), z = randomFrom(seed, -25, 25), y = 2 + 2 * (i / 200);
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)randomFrom(seed, -.5, .5);
    for (int k = 0; k < 2; k++)
        v[k] = o->isTerrain ? 0 : (MeReal)randomFrom(seed, -5, 5);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
    McdModelDynamicsSetLinearVelocity(m, v[0], 0, v[1]);
}

static MstUniverseID makeUniverse(const Options *o, MdtSolver solver) {
    static MeMatrix4 groundTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    unsigned int seed = 1;
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(u->world, o->sleeps);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldEnableReport(u->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).5, 0);
    MstFixedModelCreate(u, groundOf(u->frame, o->isTerrain), groundTM);
    for (int i = 0; i < o->bodies; i++)
        putBody(u, o, i, &seed);
    return u;
}

static void note(Side *side) {
    MdtReport r;
    for (int i = 0; i < MdtWorldGetReportCount(side->universe->world); i++) {
        MdtWorldGetPartitionReport(side->universe->world, i, &r);
        side->fast += r.way == MdtReportWayFast;
        side->deepest = fmax(side->deepest, (double)r.penetration);
    }
}

static void takeTurn(Side *side) {
    for (int i = 0; i < TURN; i++) {
        const double start = now();
        MstUniverseStep(side->universe, (MeReal)(1. / 60));
        side->time += now() - start;
        note(side);
    }
}

static void tell(int to, Side side[2]) {
    printf("| %d | %.2f | %.2f | %.0f | %.1e | %.1e |\n", to, 1e3 * side[0].time / STRETCH,
           1e3 * side[1].time / STRETCH, (double)side[0].fast / STRETCH, side[0].deepest, side[1].deepest);
    fflush(stdout);
    for (int k = 0; k < 2; k++)
        side[k] = (Side){.universe = side[k].universe};
}

static void run(const Options *o) {
    Side side[2] = {{.universe = makeUniverse(o, MdtSolverAuto)}, {.universe = makeUniverse(o, MdtSolverExact)}};
    printf("| to step | ms a step | exactly | fast partitions | deepest overlap, m | exactly |\n"
           "|---|---|---|---|---|---|\n");
    for (int i = TURN; i <= o->steps; i += TURN) {
        takeTurn(&side[0]);
        takeTurn(&side[1]);
        if (i % STRETCH == 0)
            tell(i, side);
    }
    for (int k = 0; k < 2; k++)
        MstUniverseDestroy(side[k].universe);
}

static int usage(void) {
    fprintf(stderr,
            "usage: debris [--bodies N] [--steps N] [--shape box|ball|capsule|cylinder] [--terrain] [--asleep]\n");
    return 2;
}

static int shapeNamed(const char *name) {
    for (int i = 0; i < SHAPES; i++)
        if (strcmp(name, shapeName[i]) == 0)
            return i;
    return -1;
}

int main(int argc, char **argv) {
    Options o = {.bodies = 600, .steps = 400, .shape = -1};
    for (int i = 1; i < argc; i++) {
        int *number = strcmp(argv[i], "--bodies") == 0 ? &o.bodies : strcmp(argv[i], "--steps") == 0 ? &o.steps : NULL;
        if (strcmp(argv[i], "--terrain") == 0)
            o.isTerrain = METRUE;
        else if (strcmp(argv[i], "--asleep") == 0)
            o.sleeps = METRUE;
        else if (strcmp(argv[i], "--shape") == 0 && i + 1 < argc && (o.shape = shapeNamed(argv[i + 1])) >= 0)
            i++;
        else if (!number || ++i == argc || (*number = atoi(argv[i])) < 1)
            return usage();
    }
    run(&o);
    return 0;
}
