/* Workers (MdtWorldSetTaskPool, MdtWorldSetTaskCallbacks): a simulation is the same to the last bit on any number of
 * threads, with any way of running tasks. Queries may be made by several threads at once. */
#include "Mst.h"
#include "jobs.h"
#include "karma_test.h"
#include <stdint.h>

#define FRAME ((MeReal)(1. / 60))

enum { MAX = 400, JOINTED = 6 };

typedef struct Scene {
    MstUniverseID u;
    McdModelID model[MAX];
    int count;
    unsigned int seed;
} Scene;

static MeMatrix4 floorPlace = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

static double chance(Scene *s, double low, double high) {
    s->seed = s->seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(s->seed >> 8) / (1 << 24);
}

static void makeWorld(Scene *s) {
    memset(s, 0, sizeof *s);
    s->seed = 1;
    s->u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(s->u->world, 0, -9.81, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(s->u->bridge, 0, 0), .5, .2);
    MstFixedModelCreate(s->u, McdPlaneCreate(s->u->frame), floorPlace);
}

static MdtBodyID put(Scene *s, McdGeometryID g, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(s->u, g, 1);
    McdModelDynamicsSetPosition(m, x, y, z);
    MdtBodyEnable(McdModelGetBody(m));
    s->model[s->count++] = m;
    return McdModelGetBody(m);
}

/* One partition that is most of the scene: all workers step it together. */
static void makeHeap(Scene *s) {
    const McdGeometryID box = McdBoxCreate(s->u->frame, 1, .8, .6);
    for (int i = 0; i < 300; i++)
        put(s, box, 1.1 * (i % 5) + chance(s, 0, .3), .6 + 1.05 * (i / 25), 1.1 * (i / 5 % 5) + chance(s, 0, .3));
}

/* Many partitions, of different sizes: tasks. */
static void makeChains(Scene *s) {
    const McdGeometryID ball = McdSphereCreate(s->u->frame, .3);
    for (int i = 0; i < 40; i++) {
        MdtBodyID before = NULL;
        for (int k = 0; k <= i % JOINTED; k++) {
            MdtBodyID b = put(s, ball, 5. * i + k, 2 + .3 * k, chance(s, 0, .2));
            MdtBSJointID joint = before ? MdtBSJointCreate(s->u->world) : NULL;
            if (joint) {
                MdtBSJointSetBodies(joint, before, b);
                MdtBSJointSetPosition(joint, 5 * i + k - .5, 1.85 + .3 * k, 0);
                MdtBSJointEnable(joint);
            }
            before = b;
        }
    }
}

/* Both, and what flies. */
static void makeMixed(Scene *s) {
    makeChains(s);
    const McdGeometryID box = McdBoxCreate(s->u->frame, 1, 1, 1), rod = McdSphylCreate(s->u->frame, .2, 1);
    for (int i = 0; i < 120; i++)
        put(s, i % 3 ? box : rod, -20 + 1.05 * (i % 6) + chance(s, 0, .2), .6 + 1.1 * (i / 36), 1.05 * (i / 6 % 6));
}

/* Each ball is near more others than a range of workers has room for (mcd_pairs.c), and the floor is everywhere. */
static void makeDense(Scene *s) {
    const McdGeometryID ball = McdSphereCreate(s->u->frame, .3);
    for (int i = 0; i < 343; i++)
        put(s, ball, .605 * (i % 7), .31 + .605 * (i / 49), .605 * (i / 7 % 7));
}

/* A board with a leg: two parts. */
static McdGeometryID stool(McdFrameworkID frame) {
    const McdAggregateID a = McdAggregateCreate(frame, 2);
    MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    McdAggregateAddElement(a, McdBoxCreate(frame, 1, .2, 1), tm);
    tm[3][1] = (MeReal)-.5;
    McdAggregateAddElement(a, McdCylinderCreate(frame, .2, .8), tm);
    return a;
}

/* One triangle below everything, told by a function of the program. */
static int MEAPI giveGround(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    static MeVector3 corner[3] = {{-99, -99, 1}, {99, -99, 1}, {0, 99, 1}};
    (void)pair, (void)pos, (void)radius, (void)max;
    for (int i = 0; i < 3; i++)
        triangle->vertices[i] = &corner[i];
    triangle->flags = kMcdTriangleStandard;
    return 1;
}

/* What is tested by workers on a height field, parts against it and each other, and where it is left to the calling
 * thread: by a function of the program, and by parts with materials of their own. */
static void makeTerrain(Scene *s) {
    enum { SIDE = 25 };
    static MeReal height[SIDE * SIDE];
    MeVector3 low = {-99, -99, 0}, high = {99, 99, 1};
    for (int i = 0; i < SIDE * SIDE; i++)
        height[i] = (MeReal)chance(s, 1, 1.8);
    MstFixedModelCreate(s->u, McdRGHeightFieldCreate(s->u->frame, height, SIDE, SIDE, 1, 1, -12, -12), floorPlace);
    MstFixedModelCreate(s->u, McdTriangleListCreate(s->u->frame, low, high, 2, giveGround), floorPlace);
    const McdGeometryID shape[] = {stool(s->u->frame), McdBoxCreate(s->u->frame, .8, .6, .5),
                                   McdSphereCreate(s->u->frame, .4)};
    for (int i = 0; i < 160; i++) {
        put(s, shape[i < 156 ? i % 3 : 0], -9 + 2.2 * (i % 8) + chance(s, 0, .2), 3.5 + 1.2 * (i / 64),
            -9 + 2.2 * (i / 8 % 8));
        if (i >= 156) /* the last, or few would be left to workers */
            McdGeometryInstanceSetMaterial(McdGeometryInstanceGetChild(McdModelGetGeometryInstance(s->model[i]), 1), 0);
    }
}

/* Bodies each by itself, which workers take in batches. */
static void makeDebris(Scene *s) {
    MstFixedModelCreate(s->u, McdPlaneCreate(s->u->frame), floorPlace);
    const McdGeometryID shape[] = {McdBoxCreate(s->u->frame, .8, .6, .5), McdSphereCreate(s->u->frame, .4)};
    for (int i = 0; i < 200; i++)
        put(s, shape[i % 2], 3 * (i % 16) + chance(s, 0, 1), 1 + chance(s, 0, 1), 3 * (i / 16));
}

/* Bodies that lie on a height field, or fall over, so that workers compare its heights, which the program changes
 * between steps. It is above the plane. */
enum { FIELD_SIDE = 41 };
static MeReal heights[FIELD_SIDE * FIELD_SIDE];

static void makeAtRest(Scene *s) {
    for (int i = 0; i < FIELD_SIDE * FIELD_SIDE; i++)
        heights[i] = 1;
    MstFixedModelCreate(s->u, McdRGHeightFieldCreate(s->u->frame, heights, FIELD_SIDE, FIELD_SIDE, 1, 1, -20, -20),
                        floorPlace);
    const McdGeometryID shape[] = {stool(s->u->frame), McdBoxCreate(s->u->frame, .8, .6, .5)};
    for (int i = 0; i < 200; i++)
        put(s, shape[i % 4 > 0], -18 + 2.3 * (i % 16), i % 4 ? 1.3 : 1.9, -18 + 2.6 * (i / 16));
}

static void dig(Scene *s, int frame) {
    for (int i = 0; i < 50 && frame % 10 == 9; i++)
        heights[(int)chance(s, 0, FIELD_SIDE * FIELD_SIDE)] -= (MeReal).02;
}

static void (*const scenes[])(Scene *s) = {makeHeap,    makeChains, makeMixed, makeDense,
                                           makeTerrain, makeDebris, makeAtRest};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* FNV-1a. */
static uint64_t add(uint64_t hash, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ byte[i]) * 0x100000001b3u;
    return hash;
}

static uint64_t stateOf(const Scene *s) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < s->count; i++) {
        MdtBodyID b = McdModelGetBody(s->model[i]);
        MeVector3 v, w;
        MdtBodyGetLinearVelocity(b, v);
        MdtBodyGetAngularVelocity(b, w);
        hash = add(hash, MdtBodyGetTransformPtr(b), sizeof(MeMatrix4));
        hash = add(add(hash, v, sizeof v), w, sizeof w);
    }
    return hash;
}

/* ---- the same bits ---- */

#ifdef TEST_IS_FOR_THREADS
enum { FRAMES = 40 };
#else
enum { FRAMES = 60 };
#endif

static uint64_t run(void (*make)(Scene *s), MeTaskPoolID pool, MeBool isReported) {
    Scene s;
    makeWorld(&s);
    make(&s);
    MdtWorldSetTaskPool(s.u->world, pool);
    if (isReported)
        MdtWorldEnableReport(s.u->world);
    for (int i = 0; i < FRAMES; i++) {
        MstUniverseStep(s.u, FRAME);
        dig(&s, i);
    }
    const uint64_t hash = stateOf(&s);
    MstUniverseDestroy(s.u);
    return hash;
}

static uint64_t runWith(int workers, void (*make)(Scene *s), MeBool isReported) {
    MeTaskPoolID pool = MeTaskPoolCreate(workers);
    const uint64_t hash = run(make, pool, isReported);
    MeTaskPoolDestroy(pool);
    return hash;
}

#ifdef TEST_IS_FOR_THREADS
/* The bits are compared where there is no sanitizer. */
LOOP_TEST(workers_do_not_race, 0, SCENES) {
    runWith(_i % 2 ? 8 : 3, scenes[_i], _i % 3 == 0);
    messages_forget();
}
#else
LOOP_TEST(every_number_of_workers_gives_the_same_bits, 0, SCENES) {
    static const int counts[] = {3, 8, 2};
    const uint64_t alone = run(scenes[_i], NULL, MEFALSE);
    for (int k = 0; k < 3; k++)
        ck_assert_msg(runWith(counts[k], scenes[_i], k % 2) == alone, "%d workers, scene %d", counts[k], _i);
    messages_forget();
}
#endif

TEST(every_way_of_running_tasks_gives_the_same_bits) {
    static const struct {
        MeEnqueueTaskCB enqueue;
        MeFinishTaskCB finish;
    } ways[] = {{callAtOnce, runKeptJob}, {keepJob, runKeptJob}, {startJob, waitForJob}};
    const uint64_t alone = run(makeMixed, NULL, MEFALSE);
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        Scene s;
        makeWorld(&s);
        makeMixed(&s);
        MdtWorldSetTaskCallbacks(s.u->world, 3, ways[k].enqueue, ways[k].finish, NULL);
        for (int i = 0; i < FRAMES; i++)
            MstUniverseStep(s.u, FRAME);
        ck_assert_msg(stateOf(&s) == alone, "way %zu", k);
        MstUniverseDestroy(s.u);
    }
}

/* Each on a thread of its own, on one pool. */
static MeTaskPoolID shared;

static void *runOnThread(void *hash) {
    *(uint64_t *)hash = run(makeMixed, shared, MEFALSE);
    return NULL;
}

TEST(two_universes_share_a_pool_at_once) {
    const uint64_t alone = run(makeMixed, NULL, MEFALSE);
    uint64_t hash[2];
    pthread_t thread[2];
    shared = MeTaskPoolCreate(3);
    for (int t = 0; t < 2; t++)
        ck_assert_int_eq(pthread_create(&thread[t], NULL, runOnThread, &hash[t]), 0);
    for (int t = 0; t < 2; t++)
        pthread_join(thread[t], NULL);
    ck_assert(hash[0] == alone && hash[1] == alone);
    MeTaskPoolDestroy(shared);
}

/* ---- queries ---- */

enum { RAYS = 200, ASKING = 3 };

typedef struct Asking {
    McdSpaceID space;
    pthread_t thread;
    MeReal fraction[RAYS];
} Asking;

static void *castRays(void *asking) {
    Asking *a = asking;
    for (int i = 0; i < RAYS; i++) {
        const MeVector3 from = {(MeReal)(-3 + .4 * (i % 20)), 9, (MeReal)(-3 + .8 * (i / 20))}, by = {0, -9, 0};
        McdCastResult hit;
        a->fraction[i] = McdSpaceCastRay(a->space, from, by, NULL, NULL, &hit) ? hit.fraction : 2;
    }
    return NULL;
}

/* Of compounds that fall, and that the first query places anew; by one thread after the other, or by all at once. */
static void ask(Asking asking[ASKING], MeBool isAtOnce) {
    Scene s;
    makeWorld(&s);
    const McdGeometryID g = stool(s.u->frame);
    for (int i = 0; i < 64; i++)
        MdtBodySetLinearVelocity(put(&s, g, -4 + 1.2 * (i % 8), 5 + .1 * (i % 5), -4 + 1.2 * (i / 8)), 0, -30, 0);
    MstUniverseStep(s.u, FRAME);
    messages_forget(); /* centres of mass */
    McdSpaceEndChanges(MstUniverseGetSpace(s.u));
    for (int t = 0; t < ASKING; t++) {
        asking[t].space = MstUniverseGetSpace(s.u);
        ck_assert_int_eq(pthread_create(&asking[t].thread, NULL, castRays, &asking[t]), 0);
        if (!isAtOnce)
            pthread_join(asking[t].thread, NULL);
    }
    for (int t = 0; t < ASKING && isAtOnce; t++)
        pthread_join(asking[t].thread, NULL);
    MstUniverseDestroy(s.u);
}

TEST(threads_may_ask_at_once) {
    static Asking one[ASKING], all[ASKING];
    ask(one, MEFALSE);
    ask(all, METRUE);
    for (int t = 0; t < ASKING; t++)
        ck_assert(memcmp(all[t].fraction, one[0].fraction, sizeof one[0].fraction) == 0);
}

/* ---- settings, times, messages ---- */

TEST(workers_are_counted_and_their_time_is_told) {
    Scene s;
    MeTaskPoolID pool = MeTaskPoolCreate(2);
    makeWorld(&s);
    makeMixed(&s);
    ck_assert_int_eq(MdtWorldGetWorkerCount(s.u->world), 1);
    MdtWorldSetTaskPool(s.u->world, pool);
    ck_assert_int_eq(MdtWorldGetWorkerCount(s.u->world), 2);
    for (int i = 0; i < FRAMES; i++)
        MstUniverseStep(s.u, FRAME);
    ck_assert(MdtWorldGetWorkerTime(s.u->world, 0) > 0);
    MdtWorldSetTaskPool(s.u->world, NULL);
    ck_assert_int_eq(MdtWorldGetWorkerCount(s.u->world), 1);
    MstUniverseDestroy(s.u);
    MeTaskPoolDestroy(pool);
}

TEST(bad_workers_are_refused) {
    const MdtWorldID w = MdtWorldCreate(1, 1, 1, 1);
    assert_refused(MdtWorldSetTaskCallbacks, w, 0, startJob, waitForJob, NULL);
    assert_refused(MdtWorldSetTaskCallbacks, w, MeTaskMaxWorkers + 1, startJob, waitForJob, NULL);
    MdtWorldSetTaskCallbacks(w, 2, NULL, waitForJob, NULL);
    assert_warned("enqueue");
    MdtWorldSetTaskCallbacks(w, 2, startJob, NULL, NULL);
    assert_warned("finish");
    ck_assert_int_eq(MdtWorldGetWorkerCount(w), 1);
    ck_assert(MdtWorldGetWorkerTime(w, 1) == 0);
    assert_warned("worker 1");
    MdtWorldSetTaskCallbacks(w, 1, NULL, NULL, NULL);
    MdtWorldDestroy(w);
}

static char order[64];

static void MEAPI noteNumber(const int level, const char *const text) {
    const char *key = strstr(text, "sort key ");
    (void)level;
    ck_assert(key != NULL);
    snprintf(order + strlen(order), sizeof order - strlen(order), "%d ", atoi(key + strlen("sort key ")));
}

/* Bodies that come to the bound of positions: each is a partition, and says so. */
TEST(messages_of_workers_come_in_the_order_of_partitions) {
    messages_show();
    const MdtWorldID w = MdtWorldCreate(200, 1, 1, 1);
    MeTaskPoolID pool = MeTaskPoolCreate(4);
    MdtBodyID body[200];
    MdtWorldSetTaskPool(w, pool);
    for (int i = 0; i < 200; i++) {
        body[i] = MdtBodyCreate(w);
        MdtBodyEnable(body[i]);
        if (i % 40 == 7) {
            MdtBodySetSortKey(body[i], i);
            MdtBodySetLinearVelocity(body[i], 2 * MdtBodyGetPositionBound(body[i]), 0, 0);
        }
    }
    MeSetWarningShow(noteNumber);
    MdtWorldStep(w, 1);
    MeSetWarningShow(NULL);
    ck_assert_str_eq(order, "7 47 87 127 167 ");
    MdtWorldDestroy(w);
    MeTaskPoolDestroy(pool);
}
