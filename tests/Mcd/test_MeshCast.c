/* Shapes and rays that are cast onto meshes, and shapes beside them, against the gap of the closest point. */
#include "McdInternal.h"
#include "random_numbers.h"
#include "terrain.h"

enum { CELLS = 16, SHAPES = 6, QUERIES = 100 };

static Terrain ground;
static McdFrameworkID frame;
static McdSpaceID space;
static McdModelID model[2];
static MeMatrix4 tm[2];

static double bumps(double x, double y) {
    (void)x, (void)y;
    return uniform(0, .6);
}

/* A two-sided mesh of bumps with triangles of 1 m, turned somehow, and a ball. */
static void setUp(void) {
    state = 11;
    memset(&ground, 0, sizeof ground);
    frame = terrain_framework();
    McdAllRegisterInteractions(frame);
    terrain_grid(&ground, CELLS, 1, bumps, 0);
    model[0] = McdModelCreate(McdMeshCreateWithFlags(frame, (const MeVector3 *)ground.vertex, ground.vertexCount,
                                                     ground.triangle[0], ground.triangleCount, 0, kMcdMeshTwoSided));
    model[1] = McdModelCreate(McdSphereCreate(frame, 1));
    MeMatrix4TMFromEulerAnglesAndPosition(tm[0], .2, -.3, .4, 0, 0, 0);
    MeMatrix4TMFromEulerAnglesAndPosition(tm[1], 0, 0, 0, 1, 2, 2);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    for (int i = 0; i < 2; i++) {
        McdModelSetTransformPtr(model[i], tm[i]);
        McdSpaceInsertModel(space, model[i]);
    }
    McdSpaceUpdateAll(space);
    McdSpaceEndChanges(space);
}

static McdGeometryID shapeOf(int kind, double size) {
    MeVector3 corner[12];
    if (kind == 0)
        return McdSphereCreate(frame, (MeReal)size);
    if (kind == 1)
        return McdBoxCreate(frame, (MeReal)(2 * size), (MeReal)size, (MeReal)(.5 * size));
    if (kind == 2)
        return McdCylinderCreate(frame, (MeReal)size, (MeReal)(.5 * size));
    if (kind == 3)
        return McdSphylCreate(frame, (MeReal)(.5 * size), (MeReal)size);
    if (kind == 4)
        return McdConeCreate(frame, (MeReal)size, (MeReal)(.6 * size));
    for (int i = 0; i < 12; i++)
        MeVector3Set(corner[i], (MeReal)uniform(-size, size), (MeReal)uniform(-size, size),
                     (MeReal)uniform(-.5 * size, .5 * size));
    return McdConvexMeshCreateHull(frame, corner, 12, 0);
}

static void somewhere(MeMatrix4 at, double low, double high) {
    MeMatrix4TMFromEulerAnglesAndPosition(at, (MeReal)uniform(0, 6), (MeReal)uniform(0, 6), (MeReal)uniform(0, 6),
                                          (MeReal)uniform(-5, 5), (MeReal)uniform(-5, 5), (MeReal)uniform(low, high));
}

static double gapAt(McdGeometryID g, MeMatrix4 at, const MeVector3 by, double fraction) {
    McdClosestResult closest;
    MeMatrix4 moved;
    memcpy(moved, at, sizeof moved);
    for (int k = 0; k < 3; k++)
        moved[3][k] = (MeReal)((double)at[3][k] + fraction * (double)by[k]);
    return McdSpaceGetClosest(space, g, (const MeVector4 *)moved, 100, 0, 0, &closest) ? (double)closest.distance : 100;
}

/* Up to the hit nothing is touched, and there something is. */
TEST(shapes_are_cast_up_to_what_they_touch_first) {
    enum { SAMPLES = 12 };
    int hits = 0, misses = 0;
    setUp();
    for (int n = 0; n < SHAPES * QUERIES; n++) {
        const double size = n % 3 == 0 ? .1 : n % 3 == 1 ? .4 : 3, tolerance = TOL(1e-5, 1e-6) * fmax(size, 1);
        const McdGeometryID g = shapeOf(n % SHAPES, size);
        McdCastResult hit;
        MeMatrix4 at;
        somewhere(at, size + .5, size + 3);
        const MeVector3 by = {(MeReal)uniform(-3, 3), (MeReal)uniform(-3, 3), (MeReal)uniform(-6, 1)};
        if (gapAt(g, at, by, 0) > 0) {
            const MeBool isHit = McdSpaceCastGeometry(space, g, (const MeVector4 *)at, by, 0, 0, &hit) != 0;
            const double end = isHit ? (double)hit.fraction : 1;
            for (int i = 0; i < SAMPLES; i++)
                ck_assert(gapAt(g, at, by, end * i / SAMPLES) > -tolerance);
            if (isHit)
                assert_near(gapAt(g, at, by, end), 0, tolerance);
            ck_assert(!isHit || MeVector3Dot(hit.normal, by) < 0);
            ck_assert(!isHit || hit.hasElement == (hit.model == model[0]));
            hits += isHit;
            misses += !isHit;
        }
        McdGeometryDestroy(g);
    }
    ck_assert_int_gt(hits, SHAPES * QUERIES / 4);
    ck_assert_int_gt(misses, SHAPES * QUERIES / 20);
    McdSpaceDestroy(space);
}

static void assertSameHit(const McdCastResult *a, const McdCastResult *b) {
    ck_assert(a->model == b->model && a->instance == b->instance && a->element.tag == b->element.tag);
    ck_assert(a->hasElement == (a->model == model[0]) && a->hasElement == b->hasElement && a->material == b->material);
    ck_assert(memcmp(&a->fraction, &b->fraction, sizeof a->fraction) == 0);
    ck_assert(memcmp(a->position, b->position, sizeof a->position) == 0);
    ck_assert(memcmp(a->normal, b->normal, sizeof a->normal) == 0);
}

/* Rays of a vehicle, or all over the place; more than are cast at once, and some of no length. */
TEST(rays_side_by_side_hit_what_each_hits_alone) {
    enum { RAYS = 9 };
    int hits = 0, misses = 0;
    setUp();
    for (int n = 0; n < 3 * QUERIES; n++) {
        McdRay ray[RAYS];
        McdCastResult all[RAYS], one;
        const int count = n % (RAYS + 1);
        const double wide = n % 2 ? .5 : 6, far = n % 3 ? 1 : 20;
        MeMatrix4 at;
        somewhere(at, 0, 3);
        for (int i = 0; i < count; i++)
            for (int k = 0; k < 3; k++) {
                ray[i].from[k] = at[3][k] + (MeReal)uniform(-wide, wide);
                ray[i].by[k] = n % 7 == k || (n % 5 == 0 && i == 1) ? 0 : (MeReal)uniform(-far, k == 2 ? 0 : far);
            }
        McdSpaceCastRays(space, ray, count, 0, 0, all);
        for (int i = 0; i < count; i++) {
            const MeBool isHit = McdSpaceCastRay(space, ray[i].from, ray[i].by, 0, 0, &one) != 0;
            ck_assert_int_eq(isHit, all[i].model != 0);
            hits += isHit;
            misses += !isHit;
            if (isHit)
                assertSameHit(&one, &all[i]);
        }
    }
    ck_assert_int_gt(hits, QUERIES);
    ck_assert_int_gt(misses, QUERIES);
    McdSpaceDestroy(space);
}

/* Shapes of a vehicle, or all over the place; of all types, and some that cannot be cast. */
TEST(shapes_side_by_side_hit_what_each_hits_alone) {
    enum { CASTS = 9 };
    int hits = 0, misses = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        McdShapeCast cast[CASTS];
        McdCastResult all[CASTS], one;
        const int count = n % (CASTS + 1);
        const double wide = n % 2 ? .5 : 6, far = n % 3 ? 1 : 20;
        MeMatrix4 at;
        somewhere(at, 0, 3);
        for (int i = 0; i < count; i++) {
            cast[i].geometry = shapeOf((n + i) % SHAPES, uniform(.1, .6));
            somewhere(cast[i].tm, 0, 3);
            for (int k = 0; k < 3; k++) {
                cast[i].tm[3][k] = at[3][k] + (MeReal)uniform(-wide, wide);
                cast[i].by[k] = n % 7 == k || (n % 5 == 0 && i == 1) ? 0 : (MeReal)uniform(-far, k == 2 ? 0 : far);
            }
        }
        McdSpaceCastGeometries(space, cast, count, 0, 0, all);
        for (int i = 0; i < count; i++) {
            const MeBool isHit = McdSpaceCastGeometry(space, cast[i].geometry, (const MeVector4 *)cast[i].tm,
                                                      cast[i].by, 0, 0, &one) != 0;
            ck_assert_int_eq(isHit, all[i].model != 0);
            hits += isHit;
            misses += !isHit;
            if (isHit)
                assertSameHit(&one, &all[i]);
            McdGeometryDestroy(cast[i].geometry);
        }
    }
    ck_assert_int_gt(hits, QUERIES);
    ck_assert_int_gt(misses, QUERIES);
    McdSpaceDestroy(space);
}

TEST(shapes_that_cannot_be_cast_hit_nothing) {
    McdShapeCast cast[2];
    McdCastResult hit[2];
    setUp();
    for (int i = 0; i < 2; i++) {
        cast[i].geometry = i ? shapeOf(0, .5) : McdModelGetGeometry(model[0]);
        somewhere(cast[i].tm, 2, 2);
        MeVector3Set(cast[i].by, 0, 0, -9);
    }
    McdSpaceCastGeometries(space, cast, 2, 0, 0, hit);
    assert_warned("McdSpaceCastGeometry: the geometry is not convex");
    ck_assert(!hit[0].model && hit[1].model);
    McdSpaceDestroy(space);
}

static void moveToGap(McdGeometryID g, MeMatrix4 at, double gap) {
    McdClosestResult closest;
    if (McdSpaceGetClosest(space, g, (const MeVector4 *)at, 100, 0, 0, &closest))
        for (int k = 0; k < 3; k++)
            at[3][k] += closest.normal[k] * ((MeReal)gap - closest.distance);
}

/* A shape has no contacts if its gap is beyond the margin, and some if it is within, but at internal edges. */
TEST(shapes_touch_where_the_gap_is_within_the_margin) {
    static const MeVector3 none = {0, 0, 0};
    static Probe probe;
    const double margin = .05;
    int touching = 0, missed = 0, apart = 0;
    setUp();
    McdSpaceBeginChanges(space);
    McdSpaceRemoveModel(model[1]);
    McdSpaceEndChanges(space);
    for (int n = 0; n < SHAPES * QUERIES; n++) {
        const McdGeometryID g = shapeOf(n % SHAPES, n % 3 == 0 ? .1 : n % 3 == 1 ? .4 : 2);
        probe_init(&probe, g, McdModelGetGeometry(model[0]));
        memcpy(probe.groundTM, tm[0], sizeof probe.groundTM);
        somewhere(probe.tm, 0, 2);
        moveToGap(g, probe.tm, uniform(-margin, 2 * margin));
        McdModelSetContactTolerance(probe.model, (MeReal)margin);
        McdModelSetContactTolerance(probe.ground, 0);
        const int count = probe_test(&probe);
        const double gap = gapAt(g, probe.tm, none, 0);
        ck_assert(gap < 1.001 * margin || count == 0);
        touching += gap < .99 * margin;
        missed += gap < .99 * margin && count == 0;
        apart += gap > 1.001 * margin && gap < .5;
        probe_term(&probe);
        McdGeometryDestroy(g);
    }
    ck_assert_int_gt(touching, QUERIES);
    ck_assert_int_le(missed, 3); /* whose nearest point is at an edge that is no border of the surface */
    ck_assert_int_gt(apart, QUERIES);
    McdSpaceDestroy(space);
}
