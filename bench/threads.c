/* One worker against several: the same scene in universes of their own, some steps of each in turn, so that what else
 * the machine does falls on all alike.
 *
 *     threads [--workers N] [--steps N] [--turn N] [--scene NAME] [--critical]
 *
 * 2 workers, 300 steps, turns of 20, all scenes if not given; the small scenes make ten times as many steps,
 * the largest a tenth. With --turn 1 each step comes after a pause, in which the other universe has had the caches and
 * the second core has gone idle, as between a game's frames.
 * For each scene: ms a step on one worker and on N in the mean, their ratio, and the share of the time that each worker
 * was busy with the world's tasks. It says so, should the states differ. With --critical, what 2, 4, 8 and 16 cores
 * would gain, and what one thread does alone, both from task times of one core (critical.h). */
#include "timing.h"

#include "MeTask.h"
#include "critical.h"
#include "twelve.h"
#include "ragdoll.h"

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

/* As in bench/ragdolls: thrown and turning in any way, each by itself. */
static void makeRagdolls(MstUniverseID u) {
    unsigned int seed = 1;
    for (int i = 0; i < 100; i++) {
        const double feet[3] = {7 * (i % 10), randomFrom(&seed, .05, 1), 7 * (i / 10)};
        double v[3], w[3];
        Doll doll;
        for (int k = 0; k < 3; k++)
            v[k] = randomFrom(&seed, -2, 2), w[k] = randomFrom(&seed, -3, 3);
        doll_make(&doll, u, feet);
        doll_throw(&doll, v, w);
    }
}

/* The test's, over two sills. */
static void makeCar(MstUniverseID u) {
    static Place place[2]; /* one universe and its like */
    static int made;
    for (int i = 0; i < TWELVE; i++)
        if (strcmp(twelve[i].name, "car") == 0)
            twelve_make(&place[made++ % 2], &twelve[i], u, 0, 0);
}

typedef struct Bench {
    const char *name;
    void (*make)(MstUniverseID u);
    double steps; /* of those asked for */
} Bench;

static const Bench benches[] = {
    {"tower 20", makeTower, 10},       {"car", makeCar, 10},
    {"chains 200", makeChains, 1},     {"ragdolls 100", makeRagdolls, 1},
    {"pyramid 820", makePyramid, 1},   {"heap 1000", makeHeap1000, 1},
    {"heap 10000", makeHeap10000, .1},
};

static void step(Run *r, int steps) {
    const double start = now();
    for (int i = 0; i < steps; i++)
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

static void compare(const Bench *b, MeTaskPoolID pool, int steps, int turn) {
    Run alone = {makeUniverse(), 0}, many = {makeUniverse(), 0};
    b->make(alone.u);
    b->make(many.u);
    MdtWorldSetTaskPool(many.u->world, pool);
    for (int left = steps; left > 0; left -= turn) {
        step(&alone, left < turn ? left : turn);
        step(&many, left < turn ? left : turn);
    }
    printf("%-12s %8.3f ms %8.3f ms   ratio %.2f   busy", b->name, 1e3 * alone.time / steps, 1e3 * many.time / steps,
           alone.time / many.time);
    for (int i = 0; i < MdtWorldGetWorkerCount(many.u->world); i++)
        printf(" %.0f %%", 100 * (double)MdtWorldGetWorkerTime(many.u->world, i) / many.time);
    printf(areAlike(alone.u, many.u) ? "\n" : "   THE STATES DIFFER\n");
    fflush(stdout);
    MstUniverseDestroy(alone.u);
    MstUniverseDestroy(many.u);
}

static const Bench *critical; /* whose universe is to be made */

static MstUniverseID makeCritical(void) {
    const MstUniverseID u = makeUniverse();
    critical->make(u);
    return u;
}

static void tellCritical(const Bench *b, int steps) {
    critical = b;
    critical_tell(b->name, makeCritical, steps);
}

static int countOf(const char *text) {
    const int n = text ? atoi(text) : 0;
    if (n > 0)
        return n;
    fputs("threads: a count is 1 or more\n", stderr);
    exit(2);
}

int main(int argc, char **argv) {
    int workers = 2, steps = 300, turn = 20, isCritical = 0;
    const char *wanted = NULL; /* all */
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--workers"))
            workers = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--steps"))
            steps = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--turn"))
            turn = countOf(argv[++i]);
        else if (!strcmp(argv[i], "--scene"))
            wanted = argv[++i];
        else if (!strcmp(argv[i], "--critical"))
            isCritical = 1;
        else
            return fputs("threads [--workers N] [--steps N] [--turn N] [--scene NAME] [--critical]\n", stderr), 2;
    MeTaskPoolID pool = MeTaskPoolCreate(workers);
    for (size_t i = 0; i < sizeof benches / sizeof *benches; i++) {
        const int count = (int)(steps * benches[i].steps) + 1;
        if (wanted && strcmp(wanted, benches[i].name) != 0)
            continue;
        if (isCritical)
            tellCritical(&benches[i], count);
        else
            compare(&benches[i], pool, count, turn);
    }
    MeTaskPoolDestroy(pool);
    return 0;
}
