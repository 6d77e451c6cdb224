/* Queries of a space that has a triangle list, a height field and a list in an aggregate, and distances to them,
 * against every triangle one by one in closed forms. */
#include "terrain.h"
#include "random_numbers.h"

enum { CELLS = 14, TRIANGLES = 2 * CELLS * CELLS, QUERIES = 150 };

typedef double Triangle[3][3];

typedef struct Surface {
    McdModelID model;
    MeMatrix4 tm;
    Triangle triangle[TRIANGLES];
    int isTwoSided[TRIANGLES];
} Surface;

static McdFrameworkID frame;
static McdSpaceID space;
static Terrain terrain;
static MeReal heights[(CELLS + 1) * (CELLS + 1)];
static Surface surface[3]; /* the list, the field, the aggregate */
static MeMatrix4 partTM, at;
static McdGeometryID ball, box;
static const double radius = .4, half[3] = {.5, .3, .2};
static int ownCalls; /* of the list's callback, with one model twice */

/* ---- closed forms ------------------------------------------------------------------------------------------------ */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void sub(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static void cross(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Between the segments p + s d and q + t e, 0 <= s, t <= 1: the least over the inside of both and their four ends. */
static double pointSegment(const double x[3], const double p[3], const double d[3]) {
    double off[3], rest[3];
    sub(off, x, p);
    const double s = fmin(1, fmax(0, dot(off, d) / dot(d, d)));
    for (int i = 0; i < 3; i++)
        rest[i] = off[i] - s * d[i];
    return sqrt(dot(rest, rest));
}

static double segments(const double p[3], const double p2[3], const double q[3], const double q2[3]) {
    double d[3], e[3], r[3], rest[3];
    sub(d, p2, p);
    sub(e, q2, q);
    sub(r, p, q);
    const double a = dot(d, d), b = dot(d, e), c = dot(e, e), f = dot(d, r), g = dot(e, r), under = a * c - b * b;
    double min =
        fmin(fmin(pointSegment(p, q, e), pointSegment(p2, q, e)), fmin(pointSegment(q, p, d), pointSegment(q2, p, d)));
    const double s = (b * g - c * f) / under, t = (a * g - b * f) / under;
    if (under > 1e-12 * a * c && s >= 0 && s <= 1 && t >= 0 && t <= 1) {
        for (int i = 0; i < 3; i++)
            rest[i] = r[i] + s * d[i] - t * e[i];
        min = fmin(min, sqrt(dot(rest, rest)));
    }
    return min;
}

static void normalOf(double n[3], const Triangle t) {
    double e1[3], e2[3];
    sub(e1, t[1], t[0]);
    sub(e2, t[2], t[0]);
    cross(n, e1, e2);
    const double length = sqrt(dot(n, n));
    for (int i = 0; i < 3; i++)
        n[i] /= length;
}

/* Is the point's foot on the triangle's plane inside it? */
static int isOver(const double x[3], const Triangle t) {
    double n[3];
    normalOf(n, t);
    for (int i = 0; i < 3; i++) {
        double edge[3], off[3], side[3];
        sub(edge, t[(i + 1) % 3], t[i]);
        sub(off, x, t[i]);
        cross(side, edge, off);
        if (dot(side, n) < 0)
            return 0;
    }
    return 1;
}

static double pointTriangle(const double x[3], const Triangle t) {
    double n[3], off[3], min = 1e30;
    normalOf(n, t);
    sub(off, x, t[0]);
    if (isOver(x, t))
        return fabs(dot(off, n));
    for (int i = 0; i < 3; i++) {
        double edge[3];
        sub(edge, t[(i + 1) % 3], t[i]);
        min = fmin(min, pointSegment(x, t[i], edge));
    }
    return min;
}

/* Corners of the box at `at`, moved. */
static void cornerOf(int c, const double by[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = (double)at[3][i] + by[i];
        for (int k = 0; k < 3; k++)
            out[i] += (c >> k & 1 ? half[k] : -half[k]) * (double)at[k][i];
    }
}

/* From a triangle's corner to the box. */
static double pointBox(const double x[3], const double by[3]) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double along = 0;
        for (int i = 0; i < 3; i++)
            along += (x[i] - (double)at[3][i] - by[i]) * (double)at[k][i];
        sum += pow(fmax(0, fabs(along) - half[k]), 2);
    }
    return sqrt(sum);
}

/* How far box and triangle are apart along the best of all axes that can separate them; negative if none does. */
static double separation(const Triangle t, const double by[3]) {
    double axis[13][3], max = -1e30, corner[8][3];
    normalOf(axis[0], t);
    for (int k = 0; k < 3; k++) {
        const double own[3] = {(double)at[k][0], (double)at[k][1], (double)at[k][2]};
        memcpy(axis[1 + k], own, sizeof own);
        for (int i = 0; i < 3; i++) {
            double edge[3];
            sub(edge, t[(i + 1) % 3], t[i]);
            cross(axis[4 + 3 * k + i], own, edge);
        }
    }
    for (int c = 0; c < 8; c++)
        cornerOf(c, by, corner[c]);
    for (int n = 0; n < 13; n++) {
        double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
        const double length = sqrt(dot(axis[n], axis[n]));
        if (length < 1e-9)
            continue;
        for (int c = 0; c < 11; c++) {
            const double x = dot(axis[n], c < 8 ? corner[c] : t[c - 8]) / length;
            low[c >= 8] = fmin(low[c >= 8], x);
            high[c >= 8] = fmax(high[c >= 8], x);
        }
        max = fmax(max, fmax(low[0] - high[1], low[1] - high[0]));
    }
    return max;
}

/* Between the box and a triangle that it does not touch. */
static double boxTriangle(const Triangle t) {
    static const double still[3] = {0, 0, 0};
    double min = 1e30, a[3], b[3];
    for (int c = 0; c < 8; c++) {
        cornerOf(c, still, a);
        min = fmin(min, pointTriangle(a, t));
        for (int k = 0; k < 3; k++) {
            cornerOf(c ^ 1 << k, still, b);
            for (int i = 0; i < 3 && !(c >> k & 1); i++)
                min = fmin(min, segments(a, b, t[i], t[(i + 1) % 3]));
        }
    }
    for (int i = 0; i < 3; i++)
        min = fmin(min, pointBox(t[i], still));
    return min;
}

/* The gap between what asks, moved, and a triangle; for boxes that penetrate something negative. */
static double gapTo(McdGeometryID g, const Triangle t, const double by[3]) {
    const double x[3] = {(double)at[3][0] + by[0], (double)at[3][1] + by[1], (double)at[3][2] + by[2]};
    return g == ball ? pointTriangle(x, t) - radius : separation(t, by);
}

/* ---- the world --------------------------------------------------------------------------------------------------- */

static double wave(double x, double y) {
    return .5 * sin(1.1 * x) * cos(.9 * y) + .1 * x;
}

static int MEAPI find(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal reach, int max) {
    ck_assert_int_eq(McdGeometryGetType(McdModelGetGeometry(pair->model2)), kMcdGeometryTypeTriangleList);
    ownCalls += pair->model1 == pair->model2;
    return terrain_find(pair, triangle, pos, reach, max);
}

static void toWorld(MeMatrix4Ptr tm, const double in[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)tm[3][i] + in[0] * (double)tm[0][i] + in[1] * (double)tm[1][i] + in[2] * (double)tm[2][i];
}

static void addTerrain(Surface *s, MeMatrix4Ptr part) {
    for (int n = 0; n < TRIANGLES; n++) {
        s->isTwoSided[n] = n % 7 == 0;
        for (int c = 0; c < 3; c++) {
            const MeReal *v = terrain.vertex[terrain.triangle[n][c]];
            double in[3] = {(double)v[0], (double)v[1], (double)v[2]}, placed[3];
            if (part) {
                toWorld(part, in, placed);
                memcpy(in, placed, sizeof in);
            }
            toWorld(s->tm, in, s->triangle[n][c]);
        }
    }
}

static void addField(Surface *s) {
    for (int n = 0; n < TRIANGLES; n++)
        for (int c = 0; c < 3; c++) {
            const int h = n % 2, i = n / 2 % CELLS + (c == 1 || (c == 2 && !h)),
                      j = n / 2 / CELLS + (c == 2 || (c == 1 && h));
            const double in[3] = {i - CELLS / 2, j - CELLS / 2, (double)heights[j * (CELLS + 1) + i]};
            toWorld(s->tm, in, s->triangle[n][c]);
        }
}

static void addModel(Surface *s, McdGeometryID g) {
    s->model = McdModelCreate(g);
    McdModelSetTransformPtr(s->model, s->tm);
    ck_assert(McdSpaceInsertModel(space, s->model));
}

static void turn(MeMatrix4 tm, double a, double b, double x, double y, double z) {
    MeMatrix4TMFromEulerAnglesAndPosition(tm, a, b, .3, x, y, z);
}

static void setUp(void) {
    state = 3;
    memset(&terrain, 0, sizeof terrain);
    frame = terrain_framework();
    McdAggregateRegisterType(frame);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 100);
    terrain_grid(&terrain, CELLS, 1, wave, kMcdTriangleStandard & ~kMcdTriangleTwoSided);
    for (int n = 0; n < TRIANGLES; n += 7)
        terrain.flags[n] = kMcdTriangleStandard;
    const McdTriangleListID list = terrain_list(frame, &terrain);
    McdTriangleListSetGenerator(list, find);
    for (int n = 0; n < (CELLS + 1) * (CELLS + 1); n++)
        heights[n] = (MeReal)wave(n % (CELLS + 1) - 3, .7 * (n / (CELLS + 1)));
    const McdGeometryID aggregate = McdAggregateCreate(frame, 1);
    turn(partTM, 2.5, .2, 0, 1, .5);
    McdAggregateAddElement(aggregate, list, partTM);
    turn(surface[0].tm, .1, -.2, 0, 0, 0);
    turn(surface[1].tm, -.2, .1, 3, -5, 4);
    turn(surface[2].tm, .3, .3, -2, 3, 7);
    addModel(&surface[0], list);
    addModel(&surface[1], McdRGHeightFieldCreate(frame, heights, CELLS + 1, CELLS + 1, 1, 1, -CELLS / 2, -CELLS / 2));
    addModel(&surface[2], aggregate);
    ball = McdSphereCreate(frame, radius);
    box = McdBoxCreate(frame, 2 * half[0], 2 * half[1], 2 * half[2]);
    McdSpaceUpdateAll(space);
    McdSpaceEndChanges(space);
    addTerrain(&surface[0], 0);
    addField(&surface[1]);
    addTerrain(&surface[2], partTM);
}

/* A random place near one of the surfaces. */
static void placeNear(double max) {
    const Surface *s = &surface[(int)uniform(0, 3)];
    const double *corner = s->triangle[(int)uniform(0, TRIANGLES)][0];
    turn(at, uniform(0, 6), uniform(0, 6), corner[0] + uniform(0, 2 * max) - max, corner[1] + uniform(0, 2 * max) - max,
         corner[2] + uniform(0, 2 * max) - max);
}

static int surfaceOf(McdModelID m) {
    for (int i = 0; i < 3; i++)
        if (surface[i].model == m)
            return i;
    ck_abort_msg("a model of none of the surfaces");
    return 0;
}

static const double still[3] = {0, 0, 0};

static double gapToSurface(McdGeometryID g, int i) {
    double min = 1e30;
    for (int n = 0; n < TRIANGLES; n++)
        min = fmin(min, gapTo(g, surface[i].triangle[n], still));
    return min;
}

/* ---- tests ------------------------------------------------------------------------------------------------------- */

TEST(overlaps) {
    const double unsure = TOL(1e-4, 1e-9);
    int met = 0, free = 0;
    setUp();
    for (int n = 0; n < 4 * QUERIES; n++) {
        const McdGeometryID g = n % 2 ? ball : box;
        McdModelID list[4], own[4];
        placeNear(1);
        const int count = McdSpaceOverlapGeometry(space, g, at, 0, 0, list, 4);
        int k = 0;
        for (int i = 0; i < 3; i++) {
            const double gap = gapToSurface(g, i);
            const int isMet = k < count && list[k] == surface[i].model;
            ck_assert(fabs(gap) < unsure || isMet == (gap < 0));
            k += isMet;
            met += isMet;
            free += !isMet;
        }
        ck_assert_int_eq(k, count);
        if (n % 10)
            continue;
        const McdModelID asker = McdModelCreate(g); /* the same with a model, which the callback sees */
        McdModelSetTransformPtr(asker, at);
        McdModelUpdate(asker);
        const int before = ownCalls;
        ck_assert_int_eq(McdSpaceOverlapModel(space, asker, 0, 0, own, 4), count);
        ck_assert_int_eq(ownCalls, before);
        McdModelDestroy(asker);
    }
    ck_assert_int_gt(met, 100);
    ck_assert_int_gt(free, 100);
    ck_assert_int_gt(ownCalls, 100);
    McdSpaceDestroy(space);
}

/* The gap of balls, penetrating or not, and of boxes that are free; else -1. */
static double exactGap(McdGeometryID g, int i) {
    double min = gapToSurface(g, i);
    if (g == ball)
        return min;
    if (min < 0)
        return -1;
    min = 1e30;
    for (int n = 0; n < TRIANGLES; n++)
        min = fmin(min, boxTriangle(surface[i].triangle[n]));
    return min;
}

/* Are the points where they must be? */
static void assertPoints(McdGeometryID g, int i, const MeReal *onShape, const MeReal *onMesh, const MeReal *normal,
                         double gap) {
    const double tol = TOL(2e-5, 2e-13);
    const double x[3] = {(double)onShape[0], (double)onShape[1], (double)onShape[2]};
    const double y[3] = {(double)onMesh[0], (double)onMesh[1], (double)onMesh[2]};
    double min = 1e30;
    for (int n = 0; n < TRIANGLES; n++)
        min = fmin(min, pointTriangle(y, surface[i].triangle[n]));
    assert_below(min, tol);
    if (g == box)
        assert_below(pointBox(x, still), tol);
    for (int k = 0; k < 3; k++)
        assert_near(x[k] - y[k], gap * (double)normal[k], tol);
}

TEST(the_nearest) {
    int found = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        const McdGeometryID g = n % 2 ? ball : box;
        const double max = n % 5 ? 1e6 : .5;
        McdClosestResult r;
        int nearest = 0;
        placeNear(n % 3 ? 2 : 12);
        double gap[3];
        for (int i = 0; i < 3; i++)
            gap[i] = exactGap(g, i);
        for (int i = 1; i < 3; i++)
            if (gap[i] < gap[nearest])
                nearest = i;
        const int isFound = McdSpaceGetClosest(space, g, at, max, 0, 0, &r);
        ck_assert(isFound == (gap[nearest] <= max) || fabs(gap[nearest] - max) < TOL(1e-5, 1e-10));
        if (!isFound)
            continue;
        found++;
        if (g == box && gap[nearest] < 0) {
            ck_assert(r.distance <= 0);
            continue;
        }
        assert_near(r.distance, gap[nearest], TOL(1e-5, 4e-14));
        assertPoints(g, surfaceOf(r.model), r.position1, r.position2, r.normal, (double)r.distance);
    }
    ck_assert_int_gt(found, QUERIES / 2);
    McdSpaceDestroy(space);
}

TEST(distances_of_pairs) {
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        const McdGeometryID g = n % 2 ? ball : box;
        const int i = n % 3;
        McdDistanceResult r, back;
        placeNear(n % 7 ? 3 : 30);
        const McdModelID asker = McdModelCreate(g);
        McdModelSetTransformPtr(asker, at);
        McdModelUpdate(asker);
        const McdModelPairID pair = McdModelPairCreate(asker, surface[i].model);
        const McdModelPairID turned = McdModelPairCreate(surface[i].model, asker);
        const int before = ownCalls;
        ck_assert(McdDistance(pair, &r) && McdDistance(turned, &back));
        ck_assert_int_eq(ownCalls, before);
        ck_assert(r.distance == back.distance);
        for (int k = 0; k < 3; k++)
            ck_assert(r.position1[k] == back.position2[k] && r.normal[k] == -back.normal[k]);
        const double gap = exactGap(g, i);
        if (g == box && gap < 0)
            ck_assert(r.distance <= 0);
        else {
            assert_near(r.distance, gap, TOL(2e-5, 8e-14));
            assertPoints(g, i, r.position1, r.position2, r.normal, (double)r.distance);
        }
        McdModelPairDestroy(pair);
        McdModelPairDestroy(turned);
        McdModelDestroy(asker);
    }
    const McdModelPairID surfaces = McdModelPairCreate(surface[0].model, surface[1].model);
    McdDistanceResult none;
    ck_assert(!McdDistance(surfaces, &none) && none.distance == 0);
    McdModelPairDestroy(surfaces);
    McdSpaceDestroy(space);
}

/* May the cast meet it, coming from that side? */
static int isFaced(const Surface *s, int n, const double by[3]) {
    double normal[3];
    normalOf(normal, s->triangle[n]);
    return s->isTwoSided[n] || dot(normal, by) <= 0;
}

/* Where the cast meets the triangle: by steps that cannot pass it, as the gap shrinks no faster than the motion. Above
 * 1 if it does not. */
static double castOnto(McdGeometryID g, const Triangle t, const double by[3]) {
    const double length = sqrt(dot(by, by));
    double fraction = 0;
    for (int i = 0; i < 3000 && fraction <= 1; i++) {
        const double moved[3] = {fraction * by[0], fraction * by[1], fraction * by[2]};
        const double gap = gapTo(g, t, moved);
        if (gap < 1e-9)
            return fraction;
        fraction += gap / length;
    }
    return 2;
}

static double firstMet(McdGeometryID g, const double by[3]) {
    double first = 2;
    for (int i = 0; i < 3; i++)
        for (int n = 0; n < TRIANGLES; n++)
            if (gapTo(g, surface[i].triangle[n], still) < 0)
                return 0;
            else if (isFaced(&surface[i], n, by))
                first = fmin(first, castOnto(g, surface[i].triangle[n], by));
    return first;
}

TEST(casts) {
    const double tol = TOL(2e-6, 2e-8);
    int hits = 0, misses = 0, starts = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        const McdGeometryID g = n % 2 ? ball : box;
        McdCastResult r;
        MeVector3 displacement;
        double by[3];
        placeNear(2);
        for (int k = 0; k < 3; k++) {
            displacement[k] = (MeReal)(uniform(0, n % 3 ? 4 : 40) - (n % 3 ? 2 : 20));
            by[k] = (double)displacement[k];
        }
        const double first = firstMet(g, by);
        const int isHit = McdSpaceCastGeometry(space, g, at, displacement, 0, 0, &r);
        ck_assert_int_eq(isHit, first <= 1);
        hits += isHit && first > 0;
        misses += !isHit;
        starts += first == 0;
        if (!isHit)
            continue;
        assert_near(r.fraction, first, tol);
        surfaceOf(r.model);
        ck_assert(first == 0 || MeVector3Dot(r.normal, displacement) < 0);
    }
    ck_assert_int_gt(hits, QUERIES / 6);
    ck_assert_int_gt(misses, QUERIES / 10);
    ck_assert_int_gt(starts, QUERIES / 10);
    McdSpaceDestroy(space);
}

/* A grain of sand flies a thousand kilometres beside a hill: the work does not grow with the way. */
TEST(long_casts_of_small_shapes_end) {
    static MeReal corner[4] = {0, 0, 0, 10};
    const MeReal wide = 1e6;
    const MeVector3 by = {9e5, 0, 0};
    McdCastResult r;
    MeMatrix4 tm, from;
    const McdFrameworkID f = terrain_framework();
    const McdSpaceID s = McdSpaceAxisSortCreate(f, McdAllAxes, 1, 1);
    const McdGeometryID grain = McdSphereCreate(f, 1e-3);
    const McdModelID hill = McdModelCreate(McdRGHeightFieldCreate(f, corner, 2, 2, wide, wide, -wide / 2, -wide / 2));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMMakeIdentity(from);
    MeMatrix4TMSetPosition(from, -4.5e5, -4.5e5, 5);
    McdModelSetTransformPtr(hill, tm);
    McdSpaceInsertModel(s, hill);
    McdSpaceUpdateAll(s);
    McdSpaceEndChanges(s);
    ck_assert_int_eq(McdSpaceCastGeometry(s, grain, from, (MeReal *)by, 0, 0, &r), 0);
    McdSpaceDestroy(s);
}

/* Where the segment meets the triangle; above 1 if it does not. */
static double rayOnto(const Triangle t, const double from[3], const double by[3]) {
    double n[3], off[3], x[3];
    normalOf(n, t);
    sub(off, t[0], from);
    const double fraction = dot(off, n) / dot(by, n);
    for (int k = 0; k < 3; k++)
        x[k] = from[k] + fraction * by[k];
    return fraction >= 0 && fraction <= 1 && isOver(x, t) ? fraction : 2;
}

static int MEAPI isPlain(McdModelID m, void *data) {
    (void)data;
    return m != surface[2].model;
}

static double firstOfRay(const double from[3], const double by[3], int surfaces) {
    double first = 2;
    for (int i = 0; i < 2; i++)
        for (int n = 0; n < TRIANGLES && surfaces >> i & 1; n++)
            if (isFaced(&surface[i], n, by))
                first = fmin(first, rayOnto(surface[i].triangle[n], from, by));
    return first;
}

/* Lists and fields are met once that was asked for. */
TEST(rays) {
    int hits = 0;
    setUp();
    McdRGHeightFieldLineSegmentRegisterInteraction(frame);
    for (int n = 0; n < 4 * QUERIES; n++) {
        MeVector3 displacement;
        double from[3], by[3];
        McdCastResult r;
        if (n == 2 * QUERIES)
            McdTriangleListLineSegmentRegisterInteraction(frame);
        placeNear(3);
        const double *aim = surface[n % 2].triangle[(int)uniform(0, TRIANGLES)][1];
        for (int k = 0; k < 3; k++) {
            from[k] = (double)at[3][k];
            displacement[k] = (MeReal)(1.1 * (aim[k] + uniform(0, .5) - from[k]));
            by[k] = (double)displacement[k];
        }
        const double first = firstOfRay(from, by, n < 2 * QUERIES ? 2 : 3);
        ck_assert_int_eq(McdSpaceCastRay(space, at[3], displacement, isPlain, 0, &r), first <= 1);
        if (first > 1)
            continue;
        hits++;
        assert_near(r.fraction, first, TOL(4e-6, 1e-14));
    }
    ck_assert_int_gt(hits, QUERIES / 2);
    McdSpaceDestroy(space);
}
