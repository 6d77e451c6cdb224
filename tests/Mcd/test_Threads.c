/* Several queries of one geometry at once, in two threads or one within another, give the bits that one gives alone. */
#include "terrain.h"
#include <pthread.h>

enum { N = 15, SHAPES = 5, ONE_SIDED = kMcdTriangleStandard & ~kMcdTriangleTwoSided };

#ifdef TEST_IS_SLOW
enum { POSES = 60, NESTED_POSES = 30 };
#else
enum { POSES = 600, NESTED_POSES = 120 };
#endif

static Terrain ground;
static MeReal heights[N * N];
static McdFrameworkID frame;

static double random01(unsigned int *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 16777216.0;
}

/* As terrain_find, which counts its calls. */
static int MEAPI find(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    int count = 0;
    (void)pair;
    for (int i = 0; i < ground.triangleCount && count < max; i++) {
        if (!terrain_isNear(&ground, i, pos, radius))
            continue;
        for (int c = 0; c < 3; c++)
            triangle[count].vertices[c] = &ground.vertex[ground.triangle[i][c]];
        triangle[count].normal = 0;
        triangle[count].flags = ground.flags[i];
        triangle[count++].triangleData.ptr = ground.triangle[i];
    }
    return count;
}

static double bumps(double x, double y) {
    return .2 * sin(3 * x) * cos(2 * y);
}

static McdTriangleListID makeList(McdTriangleListFnPtr f) {
    MeVector3 min = {-4, -4, -1}, max = {4, 4, 1};
    return McdTriangleListCreate(frame, min, max, TERRAIN_FOUND, f);
}

static McdRGHeightFieldID makeField(void) {
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++)
            heights[j * N + i] = (MeReal)bumps(.4 * i, .4 * j);
    return McdRGHeightFieldCreate(frame, heights, N, N, .4, .4, -2.8, -2.8);
}

/* The list, and boxes around it. */
static McdAggregateID makeAggregate(void) {
    McdAggregateID a = McdAggregateCreate(frame, 5);
    MeMatrix4 tm;
    McdAggregateAddElement(a, makeList(find), 0);
    for (int i = 0; i < 4; i++) {
        MeMatrix4TMMakeIdentity(tm);
        MeMatrix4TMSetPosition(tm, i % 2 * 3 - 1.5, i / 2 * 3 - 1.5, .2);
        McdAggregateAddElement(a, McdBoxCreate(frame, 1, 1, 1), tm);
    }
    return a;
}

static void begin(void) {
    frame = terrain_framework();
    McdBoxBoxRegisterInteraction(frame);
    McdBoxSphereRegisterInteraction(frame);
    McdBoxCylinderRegisterInteraction(frame);
    McdTriangleListLineSegmentRegisterInteraction(frame);
    McdRGHeightFieldLineSegmentRegisterInteraction(frame);
    McdAggregateRegisterType(frame);
    McdAggregateRegisterInteractions(frame);
    memset(&ground, 0, sizeof ground);
    terrain_grid(&ground, N, .4, bumps, ONE_SIDED);
}

/* ---- what a thread asks ------------------------------------------------------------------------------------------ */

typedef struct Asker {
    pthread_t id;
    int poses;
    Probe probe[SHAPES]; /* all against one model of the ground */
    MeU64 hash[POSES];
    int touching;
} Asker;

static void makeAsker(Asker *a, McdModelID on, int poses) {
    static MeVector3 tetrahedron[4] = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};
    McdAggregateID pair = McdAggregateCreate(frame, 2);
    MeMatrix4 aside;
    MeMatrix4TMMakeIdentity(aside);
    MeMatrix4TMSetPosition(aside, .7, 0, 0);
    McdAggregateAddElement(pair, McdSphereCreate(frame, .4), 0);
    McdAggregateAddElement(pair, McdBoxCreate(frame, .5, .6, .7), aside);
    const McdGeometryID shape[SHAPES] = {McdSphereCreate(frame, .5), McdBoxCreate(frame, 1, .8, .6),
                                         McdCylinderCreate(frame, .4, .9),
                                         McdConvexMeshCreateHull(frame, (const MeVector3 *)tetrahedron, 4, 0), pair};
    a->poses = poses;
    for (int i = 0; i < SHAPES; i++) {
        probe_init(&a->probe[i], shape[i], McdModelGetGeometry(on));
        McdModelDestroy(a->probe[i].ground);
        a->probe[i].made.model2 = a->probe[i].ground = on;
    }
}

static void add(MeU64 *hash, const void *data, size_t size) {
    for (size_t i = 0; i < size; i++)
        *hash = (*hash ^ ((const unsigned char *)data)[i]) * 0x100000001b3ull; /* FNV-1a */
}

static MeU64 hashOfContacts(const Probe *p) {
    MeU64 hash = 0xcbf29ce484222325ull;
    for (int i = 0; i < p->result.contactCount; i++) {
        const McdContact *c = &p->contact[i];
        add(&hash, c->exactPosition, sizeof c->exactPosition);
        add(&hash, c->normal, sizeof c->normal);
        add(&hash, &c->exactSeparation, sizeof c->exactSeparation);
        add(&hash, c->radius, sizeof c->radius);
        add(&hash, &c->feature, sizeof c->feature);
        add(&hash, &c->element2, sizeof c->element2);
    }
    return hash;
}

/* Contacts, the distance and a segment, at one place. */
static MeU64 ask(Probe *p, unsigned int *seed) {
    McdDistanceResult distance;
    McdLineSegIntersectResult hit;
    MeReal from[3] = {4 * random01(seed) - 2, 4 * random01(seed) - 2, 2}, to[3] = {0, 0, -2};
    MeMatrix4TMFromEulerAnglesAndPosition(p->tm, 6 * random01(seed), 6 * random01(seed), 6 * random01(seed),
                                          4 * random01(seed) - 2, 4 * random01(seed) - 2, .2 + .6 * random01(seed));
    McdModelUpdate(p->model);
    (McdIntersect)(p->pair, &p->result);
    MeU64 hash = hashOfContacts(p);
    if (McdDistance(p->pair, &distance))
        add(&hash, &distance.distance, sizeof distance.distance);
    if (McdLineSegIntersect(p->ground, from, to, &hit))
        add(&hash, hit.position, sizeof hit.position);
    return hash;
}

static void *run(void *context) {
    Asker *a = context;
    unsigned int seed = 3;
    a->touching = 0;
    for (int i = 0; i < a->poses; i++) {
        a->hash[i] = ask(&a->probe[i % SHAPES], &seed);
        a->touching += a->probe[i % SHAPES].result.contactCount > 0;
    }
    return 0;
}

static void compareThreads(McdGeometryID g) {
    Asker *a = calloc(3, sizeof *a);
    MeMatrix4 tm;
    McdModelID on = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(tm);
    McdModelSetTransformPtr(on, tm);
    McdModelUpdate(on);
    for (int k = 0; k < 3; k++)
        makeAsker(&a[k], on, POSES);
    run(&a[2]);
    for (int k = 0; k < 2; k++)
        ck_assert_int_eq(pthread_create(&a[k].id, NULL, run, &a[k]), 0);
    for (int k = 0; k < 2; k++)
        pthread_join(a[k].id, NULL);
    ck_assert_int_gt(a[2].touching, POSES / 2);
    for (int i = 0; i < POSES; i++)
        ck_assert_msg(a[0].hash[i] == a[2].hash[i] && a[1].hash[i] == a[2].hash[i], "pose %d", i);
    free(a);
}

TEST(two_threads_ask_one_triangle_list) {
    begin();
    compareThreads(makeList(find));
}

TEST(two_threads_ask_one_height_field) {
    begin();
    compareThreads(makeField());
}

TEST(two_threads_ask_one_aggregate) {
    begin();
    compareThreads(makeAggregate());
    messages_forget();
}

/* ---- a query within a query -------------------------------------------------------------------------------------- */

static Asker *inner; /* for each depth */
static int depth, nested;
static unsigned int innerSeed;

/* Asks the same list about something else, when its own triangles are written already. */
static int MEAPI findAndAsk(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    const int count = find(pair, triangle, pos, radius, max);
    if (depth < 2) {
        Probe *p = &inner[depth++].probe[nested++ % SHAPES];
        ask(p, &innerSeed);
        depth--;
    }
    return count;
}

static void compareNested(McdGeometryID g, McdTriangleListID list) {
    Asker *a = calloc(4, sizeof *a);
    MeMatrix4 tm;
    McdModelID on = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(tm);
    McdModelSetTransformPtr(on, tm);
    McdModelUpdate(on);
    for (int k = 0; k < 4; k++)
        makeAsker(&a[k], on, NESTED_POSES);
    run(&a[0]);
    McdTriangleListSetGenerator(list, findAndAsk);
    inner = &a[2];
    nested = 0;
    run(&a[1]);
    ck_assert_int_gt(nested, NESTED_POSES);
    for (int i = 0; i < NESTED_POSES; i++)
        ck_assert_msg(a[0].hash[i] == a[1].hash[i], "pose %d", i);
    free(a);
}

TEST(a_callback_asks_its_own_list) {
    begin();
    McdTriangleListID list = makeList(find);
    compareNested(list, list);
}

TEST(a_callback_asks_the_aggregate_that_its_list_is_in) {
    begin();
    McdAggregateID a = makeAggregate();
    compareNested(a, McdAggregateGetElementGeometry(a, 0));
    messages_forget();
}
