/* Contacts of convex shapes that are known by their support function, in random poses, against a slow search: the
 * signed distance is the largest separation along any direction, so no direction may separate the shapes better than
 * the normal that was found. Sizes of 1e-2 to 1e2. */
#include "frame.h"
#include "own_shapes.h"
#include "convex/mcd_sampled_i.h"
#include "model/mcd_result_i.h"
#include "reference.h"

enum { ELLIPSOID, TAPER, BRICK, CAN, ROUND_BRICK, OWN_KINDS };
static const char *const ownName[] = {"ellipsoid", "taper", "brick", "can", "round brick"};

#ifdef TEST_IS_SLOW
enum { POSES = 40 };
#else
enum { POSES = 100 };
#endif

static McdFrameworkID frame;

static void setUp(void) {
    frame = frame_make(0, 4, 4, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
}

TEST_FIXTURE(setUp, NULL)

static McdGeometryID makeOwn(int kind, double size, Random *r) {
    const double x = size * random_between(r, .2, 1), y = size * random_between(r, .2, 1),
                 z = size * random_between(r, .2, 1);
    switch (kind) {
    case ELLIPSOID:
        return ellipsoid_create(frame, x, y, z);
    case TAPER:
        return taper_create(frame, x / 2, y / 2, fabs(x - y) / 2 + z);
    case BRICK:
        return brick_create(frame, x, y, z, 0);
    case CAN:
        return can_create(frame, x / 2, y, MEFALSE);
    default:
        return brick_create(frame, x, y, z, size * random_between(r, .01, .3));
    }
}

static void shapeOf(McdGeometryID g, McdShape *s) {
    memset(s, 0, sizeof *s);
    ck_assert(mcd_shapeSizes(g, s));
    for (int i = 0; i < 3; i++)
        s->axis[i][i] = 1;
}

static double separationAlong(const McdShape *a, const McdShape *b, const double n[3]) {
    return mcd_separationAlong(a, b, n) - a->rounding - b->rounding;
}

/* Improves a normal by steps to all sides, which become smaller where none is better. */
static double climb(const McdShape *a, const McdShape *b, double n[3], double step) {
    double best = separationAlong(a, b, n);
    for (int tries = 0; step > 1e-9 && tries < 200; tries++) {
        double u[3], w[3], next[3];
        MeBool isBetter = MEFALSE;
        mcd_basis(n, u, w);
        for (int i = 0; i < 8 && !isBetter; i++) {
            mcd_mad(next, n, step * cos(i * .7853981633974483), u);
            mcd_mad(next, next, step * sin(i * .7853981633974483), w);
            mcd_scale(next, next, 1 / mcd_length(next));
            const double there = separationAlong(a, b, next);
            isBetter = there > best;
            best = fmax(best, there);
        }
        if (isBetter)
            mcd_copy(n, next);
        else
            step /= 2;
    }
    return best;
}

/* The best of many directions, and of the climbs from the best of these. */
static double slowDistance(const McdShape *a, const McdShape *b, const double found[3], double n[3], Random *r) {
    enum { TRIES = 60, CLIMBS = 3 };
    double start[CLIMBS][3], value[CLIMBS] = {-INFINITY, -INFINITY, -INFINITY}, best = -INFINITY;
    for (int i = 0; i < TRIES; i++) {
        double d[3];
        random_direction(r, d);
        if (i == 0)
            mcd_copy(d, found);
        double s = separationAlong(a, b, d);
        for (int k = 0; k < CLIMBS; k++)
            if (s > value[k]) {
                const double other = value[k];
                double old[3];
                mcd_copy(old, start[k]);
                mcd_copy(start[k], d);
                mcd_copy(d, old);
                value[k] = s;
                s = other;
            }
    }
    for (int k = 0; k < CLIMBS; k++) {
        const double s = climb(a, b, start[k], .3);
        if (s <= best)
            continue;
        best = s;
        mcd_copy(n, start[k]);
    }
    return best;
}

/* From deep in each other to a little apart; every third pair a hair, so that resting contacts are among them. */
static void placePair(McdShape *a, const McdShape *b, int pose, double size, Random *r) {
    double n[3] = {0, 0, 1}, best = -INFINITY;
    for (int i = 0; i < 20; i++) { /* nearly along the normal */
        double d[3];
        random_direction(r, d);
        if (separationAlong(a, b, d) > best)
            mcd_copy(n, d);
        best = fmax(best, separationAlong(a, b, d));
    }
    const double depth = pose % 3 == 0 ? size * 1e-3 * random_between(r, -1, 1) : size * random_between(r, -.1, .4);
    const double k = -separationAlong(a, b, n) - depth;
    shape_move(a, k * n[0], k * n[1], k * n[2]);
}

typedef struct Worst {
    double depth, along, normal, place;
    int touching, apart;
} Worst;

static MeBool isSmooth(int kind) {
    return kind == ELLIPSOID || kind == SHAPE_SPHERE + OWN_KINDS;
}

static void comparePair(const McdShape *a, const McdShape *b, double size, MeBool areSmooth, Worst *worst, Random *r) {
    double onA[3], onB[3], n[3], best[3] = {0, 0, 0}, between[3];
    McdManifold m;
    const double margin = .02 * size, distance = mcd_convexDistance(a, b, onA, onB, n);
    const double reference = slowDistance(a, b, n, best, r);
    worst->depth = fmax(worst->depth, (reference - distance) / size);
    worst->along = fmax(worst->along, fabs(separationAlong(a, b, n) - distance) / size);
    mcd_sub(between, onA, onB);
    mcd_mad(between, between, -distance, n);
    worst->place = fmax(worst->place, mcd_length(between) / size);
    if (areSmooth && fabs(distance) > 1e-6 * size && distance > -.1 * size)
        worst->normal = fmax(worst->normal, sqrt(mcd_distanceSquared(n, best)));
    const int count = mcd_convexManifold(a, b, (McdReach){.margin = margin}, &m);
    worst->touching += count > 0;
    worst->apart += count == 0;
    ck_assert_msg(count > 0 || reference > margin - 1e-6 * size, "missed at a gap of %g", reference);
    ck_assert_msg(count == 0 || reference < margin + 1e-6 * size, "%d contacts at a gap of %g", count, reference);
    double min = INFINITY;
    for (int i = 0; i < count; i++)
        min = fmin(min, m.point[i].separation);
    if (count)
        worst->depth = fmax(worst->depth, fabs(min - reference) / size);
}

static void compareKinds(int kindA, int kindB) {
    Random r = {.state = (unsigned long long)(1 + 100 * kindA + kindB)};
    Worst worst = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < POSES; i++) {
        const double size = i % 4 == 0 ? .01 : i % 4 == 1 ? 100 : 1;
        McdShape a, b;
        McdGeometryID g[2] = {makeOwn(kindA, size, &r), 0};
        shapeOf(g[0], &a);
        if (kindB < OWN_KINDS) {
            g[1] = makeOwn(kindB, size, &r);
            shapeOf(g[1], &b);
        } else {
            shape_random(&b, kindB - OWN_KINDS, size, MEFALSE, &r);
        }
        shape_rotateRandomly(&a, &r);
        shape_rotateRandomly(&b, &r);
        placePair(&a, &b, i, fmin(a.extent, b.extent), &r);
        if (i % 2)
            comparePair(&a, &b, fmin(a.extent, b.extent), isSmooth(kindA) && isSmooth(kindB), &worst, &r);
        else
            comparePair(&b, &a, fmin(a.extent, b.extent), isSmooth(kindA) && isSmooth(kindB), &worst, &r);
        McdGeometryDestroy(g[0]);
        if (g[1])
            McdGeometryDestroy(g[1]);
    }
    printf("%s, %s: depth %.2g, along the normal %.2g, normal %.2g, places %.2g; %d touch\n", ownName[kindA],
           kindB < OWN_KINDS ? ownName[kindB] : shape_name[kindB - OWN_KINDS], worst.depth, worst.along, worst.normal,
           worst.place, worst.touching);
    ck_assert_int_gt(worst.touching, POSES / 8);
    ck_assert_int_gt(worst.apart, 0);
    assert_near(worst.depth, 0, 1e-6);
    assert_near(worst.along, 0, 1e-8);
    assert_near(worst.place, 0, 3e-9);
    assert_near(worst.normal, 0, 2e-7);
}

LOOP_TEST(no_direction_separates_better, 0, OWN_KINDS) {
    for (int kindB = _i; kindB < OWN_KINDS + SHAPE_KINDS; kindB++)
        compareKinds(_i, kindB);
}

/* ---- faces and lines --------------------------------------------------------------------------------------------- */

/* The hull of discs across z, which are ellipses, and of balls: of all shapes with round and flat parts. */
typedef struct Hulled {
    int discs, balls;
    double disc[2][3], ball[8][4]; /* half axes, height; middle, radius */
} Hulled;

static void keepFarther(const double d[3], const double candidate[3], double *max, double point[3]) {
    const double height = mcd_dot(candidate, d);
    if (height <= *max)
        return;
    *max = height;
    mcd_copy(point, candidate);
}

static void MEAPI hulledSupport(const void *data, const double d[3], double point[3]) {
    const Hulled *h = data;
    double max = -INFINITY;
    for (int i = 0; i < h->discs; i++) {
        const double *e = h->disc[i], x = e[0] * d[0], y = e[1] * d[1], across = sqrt(x * x + y * y),
                     k = across > 0 ? 1 / across : 0;
        const double at[3] = {e[0] * x * k, e[1] * y * k, e[2]};
        keepFarther(d, at, &max, point);
    }
    for (int i = 0; i < h->balls; i++) {
        double at[3];
        mcd_mad(at, h->ball[i], h->ball[i][3], d);
        keepFarther(d, at, &max, point);
    }
}

typedef struct Expected {
    const char *name;
    Hulled shape;
    int flats, corners; /* all flat faces, and all corners of those that have some */
    MeBool hasLines, isPolyhedron, hasDisc;
    int minPoints; /* of a face in any direction */
} Expected;

static const Expected expected[] = {
    {"cylinder", {.discs = 2, .disc = {{1, 1, 1}, {1, 1, -1}}}, 2, 0, 1, 0, 1, 2},
    {"coin of a hundredth", {.discs = 2, .disc = {{1, 1, .01}, {1, 1, -.01}}}, 2, 0, 1, 0, 1, 2},
    {"needle", {.discs = 2, .disc = {{.01, .01, 1}, {.01, .01, -1}}}, 2, 0, 1, 0, 1, 2},
    {"elliptic cylinder", {.discs = 2, .disc = {{1, .5, 1}, {1, .5, -1}}}, 2, 0, 1, 0, 0, 2},
    {"elliptic cone", {.discs = 1, .balls = 1, .disc = {{1, .5, 0}}, .ball = {{0, 0, 1, 0}}}, 1, 0, 1, 0, 0, 2},
    {"bullet", {.discs = 1, .balls = 1, .disc = {{.5, .5, -1}}, .ball = {{0, 0, .5, .5}}}, 1, 0, 1, 0, 1, 2},
    {"half a ball on a cone", {.balls = 2, .ball = {{0, 0, 0, .5}, {0, 0, 2, 0}}}, 0, 0, 1, 0, 0, 2},
    {"two balls", {.balls = 2, .ball = {{0, 0, 0, 1}, {0, .3, 1.2, .2}}}, 0, 0, 1, 0, 0, 2},
    {"rounded box",
     {.balls = 8,
      .ball = {{1, .7, .5, .2},
               {-1, .7, .5, .2},
               {1, -.7, .5, .2},
               {-1, -.7, .5, .2},
               {1, .7, -.5, .2},
               {-1, .7, -.5, .2},
               {1, -.7, -.5, .2},
               {-1, -.7, -.5, .2}}},
     6,
     24,
     1,
     0,
     0,
     3},
    {"tetrahedron",
     {.balls = 4, .ball = {{1, 0, .5, 0}, {-1, 0, .5, 0}, {0, 1, -.5, 0}, {0, -1, -.5, 0}}},
     4,
     12,
     0,
     1,
     0,
     3},
    {"plate", {.balls = 4, .ball = {{1, .5, 0, 0}, {-1, .5, 0, 0}, {1, -.5, 0, 0}, {-1, -.5, 0, 0}}}, 2, 8, 0, 1, 0, 2},
    {"segment", {.balls = 2, .ball = {{1, .5, .1, 0}, {-1, .5, 0, 0}}}, 0, 0, 1, 0, 0, 2},
    {"ball", {.balls = 1, .ball = {{0, 0, 0, 1}}}, 0, 0, 0, 0, 0, 1},
};

/* No point of a face is above the shape, and one is as high as it. */
static void checkFaces(const McdShape *s, const Expected *e, Random *r) {
    const double size = s->extent;
    for (int i = 0; i < 2000; i++) {
        double n[3], farthest[3], max = -INFINITY;
        McdFace f;
        random_direction(r, n);
        mcd_coreSupport(s, n, farthest);
        mcd_faceToward(s, n, &f);
        ck_assert_msg(f.count >= e->minPoints, "%s: %d points towards %g %g %g", e->name, f.count, n[0], n[1], n[2]);
        for (int k = 0; k < f.count; k++)
            max = fmax(max, mcd_heightOver(f.point[k], farthest, n));
        ck_assert_msg(max < 1e-6 * size, "%s: %g above", e->name, max);
    }
}

TEST(faces_and_lines_are_found) {
    static const McdConvexFunctions functions = {.support = hulledSupport};
    const int type = McdFrameworkRegisterConvexType(frame, "Hulled", sizeof(Hulled), &functions);
    Random r = {.state = 1};
    for (int i = 0; i < (int)(sizeof expected / sizeof *expected); i++) {
        const Expected *e = &expected[i];
        McdShape s;
        shapeOf(McdConvexCreate(frame, type, &e->shape), &s);
        const McdFeatures *k = s.sampled->features;
        ck_assert_msg(k->flats == e->flats && k->corners == e->corners && (k->rulings > 0) == e->hasLines &&
                          k->isPolyhedron == e->isPolyhedron && k->hasDisc == e->hasDisc,
                      "%s: %d faces, %d corners, %d lines, %d, %d", e->name, k->flats, k->corners, k->rulings,
                      k->isPolyhedron, k->hasDisc);
        checkFaces(&s, e, &r);
    }
}

/* Of corners on a ball, nearly all faces are triangles, some at angles of 1e-4 rad. */
TEST(all_faces_of_a_polyhedron_are_found) {
    Random r = {.state = 2};
    for (int count = 4; count <= GEM_CORNERS; count *= 2) {
        Gem gem = {.count = count};
        McdShape s;
        for (int i = 0; i < count; i++)
            random_direction(&r, gem.corner[i]);
        shapeOf(gem_create(frame, &gem), &s);
        ck_assert(s.sampled->features->isPolyhedron);
        ck_assert_int_eq(s.sampled->features->flats, 2 * count - 4);
    }
}
