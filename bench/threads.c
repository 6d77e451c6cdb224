/* One worker against several: the same scene in universes of their own, step by step in turn, so that what else the
 * machine does falls on all alike.
 *
 *     threads [--workers N] [--steps N] [--scene NAME]
 *
 * 2 workers, 300 steps, all scenes if not given. For each scene: ms a step on one worker and on N in the mean, their
 * ratio, and the share of the time that each worker was busy with the world's tasks. It says so, should the states
 * differ. */
#include "timing.h"

#include "MeTask.h"
#include "Mst.h"

#include <stdio.h>
#include <string.h>

typedef struct Run {
    MstUniverseID u;
    double time; /* s */
} Run;

static double randomFrom(unsigned int *seed, double low, double high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / (1 << 24);
}

static MstUniverseID makeUniverse(void) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).5, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    return u;
}

static McdModelID put(MstUniverseID u, McdGeometryID g, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, g, 1);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    MdtBodyEnable(McdModelGetBody(m));
    return m;
}

static void makeHeap(MstUniverseID u, int boxes, int side) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    const int layer = side * side / 4;
    unsigned int seed = 1;
    for (int i = 0; i < boxes; i++) {
        MeReal q[4];
        const double x = randomFrom(&seed, -.5, .5) * side, z = randomFrom(&seed, -.5, .5) * side;
        const McdModelID m = put(u, cube, x, 2 + 1.2 * (i / layer), z);
        for (int k = 0; k < 4; k++)
            q[k] = (MeReal)randomFrom(&seed, -.5, .5);
        McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
    }
}

static void makeHeap1000(MstUniverseID u) {
    makeHeap(u, 1000, 10);
}

static void makeHeap10000(MstUniverseID u) {
    makeHeap(u, 10000, 32);
}

/* 820 boxes, half a centimetre apart: they fall onto each other, and go on moving a little. */
static void makePyramid(MstUniverseID u) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int row = 0; row < 40; row++)
        for (int i = 0; i < 40 - row; i++)
            put(u, cube, 1.05 * i + .525 * row, .505 + 1.005 * row, 0);
}

static void makeTower(MstUniverseID u) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < 20; i++)
        put(u, cube, 0, .5 + i, 0);
}

/* 200 chains of five balls that swing: partitions of joints. */
static void makeChains(MstUniverseID u) {
    const McdGeometryID ball = McdSphereCreate(u->frame, (MeReal).2);
    for (int i = 0; i < 200; i++) {
        MdtBodyID before = NULL;
        for (int k = 0; k < 5; k++) {
            const MdtBodyID b = McdModelGetBody(put(u, ball, 8. * (i % 20) + .5 * k, 10, 4. * (i / 20)));
            const MdtBSJointID j = MdtBSJointCreate(u->world);
            MdtBSJointSetBodies(j, b, before);
            MdtBSJointSetPosition(j, (MeReal)(8. * (i % 20) + .5 * k - .25), 10, (MeReal)(4. * (i / 20)));
            MdtBSJointEnable(j);
            before = b;
        }
    }
}

static void step(Run *r) {
    const double start = now();
    MstUniverseStep(r->u, (MeReal)(1. / 60));
    r->time += now() - start;
}

static int areAlike(MstUniverseID a, MstUniverseID b) {
    MdtBodyID x = MdtBodyGetFirst(a->world), y = MdtBodyGetFirst(b->world);
    for (; x && y; x = MdtBodyGetNext(x), y = MdtBodyGetNext(y))
        if (memcmp(MdtBodyGetTransformPtr(x), MdtBodyGetTransformPtr(y), sizeof(MeMatrix4)) != 0)
            return 0;
    return !x && !y;
}

static const char *wanted; /* null: all */

static void compare(const char *name, void (*make)(MstUniverseID u), MeTaskPoolID pool, int steps) {
    if (wanted && strcmp(wanted, name) != 0)
        return;
    Run alone = {makeUniverse(), 0}, many = {makeUniverse(), 0};
    make(alone.u);
    make(many.u);
    MdtWorldSetTaskPool(many.u->world, pool);
    for (int i = 0; i < steps; i++) {
        step(&alone);
        step(&many);
    }
    printf("%-12s %8.3f ms %8.3f ms   ratio %.2f   busy", name, 1e3 * alone.time / steps, 1e3 * many.time / steps,
           alone.time / many.time);
    for (int i = 0; i < MdtWorldGetWorkerCount(many.u->world); i++)
        printf(" %.0f %%", 100 * (double)MdtWorldGetWorkerTime(many.u->world, i) / many.time);
    printf(areAlike(alone.u, many.u) ? "\n" : "   THE STATES DIFFER\n");
    fflush(stdout);
    MstUniverseDestroy(alone.u);
    MstUniverseDestroy(many.u);
}

static int countOf(const char *text) {
    const int n = text ? atoi(text) : 0;
    if (n > 0)
        return n;
    fputs("threads: a count is 1 or more\n", stderr);
    exit(2);
}

int main(int argc, char **argv) {
    int workers = 2, steps = 300;
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--workers"))
            workers = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--steps"))
            steps = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--scene"))
            wanted = argv[++i];
        else
            return fputs("threads [--workers N] [--steps N] [--scene NAME]\n", stderr), 2;
    MeTaskPoolID pool = MeTaskPoolCreate(workers);
    compare("tower 20", makeTower, pool, 10 * steps);
    compare("chains 200", makeChains, pool, steps);
    compare("pyramid 820", makePyramid, pool, steps);
    compare("heap 1000", makeHeap1000, pool, steps);
    compare("heap 10000", makeHeap10000, pool, steps / 10 + 1);
    MeTaskPoolDestroy(pool);
    return 0;
}
