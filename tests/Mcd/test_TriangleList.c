/* Triangle lists: contacts with single triangles as the flags say, and with surfaces as if they were one piece. */
#include "MeDebugDraw.h"
#include "terrain.h"

enum { ONE_SIDED = kMcdTriangleStandard & ~kMcdTriangleTwoSided };

static Terrain ground;
static McdFrameworkID frame;
static Probe probe;

static void begin(void) {
    frame = terrain_framework();
    memset(&ground, 0, sizeof ground);
}

static double deepest(const Probe *p) {
    double min = INFINITY;
    for (int i = 0; i < p->result.contactCount; i++)
        min = fmin(min, p->contact[i].separation);
    return min;
}

static int hasNormal(const Probe *p, double x, double y, double z) {
    for (int i = 0; i < p->result.contactCount; i++) {
        const MeReal *n = p->contact[i].normal;
        if (fabs((double)n[0] - x) + fabs((double)n[1] - y) + fabs((double)n[2] - z) < TOL(1e-5, 1e-8))
            return 1;
    }
    return 0;
}

static unsigned int seed;
static double random01(void) {
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / 16777216.0;
}

static void randomTurn(MeMatrix4 tm) {
    MeMatrix3 r;
    MeMatrix3FromEulerAngles(r, 6.3 * random01(), 6.3 * random01(), 6.3 * random01());
    MeMatrix4TMSetRotation(tm, (const MeVector3 *)r);
}

/* ---- surfaces that are flat -------------------------------------------------------------------------------------- */

/* Long, flat, with sharp corners: whatever comes. */
static McdGeometryID randomHull(int number, double size) {
    MeVector3 p[12];
    const int count = 4 + number % 9;
    const double width = .2 + .8 * random01();
    for (int i = 0; i < count; i++)
        MeVector3Set(p[i], size * (random01() - .5), size * width * (random01() - .5), size * (random01() - .5));
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)p, count, 0);
}

static McdGeometryID makeShape(int kind, double size) {
    const MeReal s = size;
    MeVector3 p[9];
    if (kind >= 7)
        return randomHull(kind - 7, size);
    for (int i = 0; i < 8; i++)
        MeVector3Set(p[i], i & 1 ? s : -s / 2, i & 2 ? s / 2 : -s, i & 4 ? s / 3 : -s / 2);
    MeVector3Set(p[8], 0, 0, s);
    switch (kind) {
    case 0:
        return McdSphereCreate(frame, s / 2);
    case 1:
        return McdBoxCreate(frame, s, s * (MeReal).6, s * (MeReal)1.6);
    case 2:
        return McdCylinderCreate(frame, s / 2, s);
    case 3:
        return McdSphylCreate(frame, s / 3, s);
    case 4:
        return McdConeCreate(frame, s, s / 2);
    default:
        return McdConvexMeshCreateHull(frame, (const MeVector3 *)p, 9, kind == 5 ? 0 : s / 10);
    }
}

/* Pushes only up. With it, the surface is not just one plane. */
static void addLowTriangle(double size) {
    const double z = -.01 * size, r = .3 * size;
    terrain_triangle(&ground, terrain_vertex(&ground, -r, -r, z), terrain_vertex(&ground, r, -r, z),
                     terrain_vertex(&ground, 0, r, z), 0);
}

#ifdef TEST_IS_SLOW
enum { TURNS = 30 };
#else
enum { TURNS = 120 };
#endif

/* On a grid of triangles as on a plane: the lowest point is the deepest, and the normal is the plane's. */
static void onPlane(int kind, double size, int isAlone) {
    MeReal down[3] = {0, 0, -1}, up[3] = {0, 0, 1};
    MeVector3 lowest, highest;
    begin();
    seed = (unsigned int)kind;
    terrain_grid(&ground, 20, .23 * size, 0, ONE_SIDED);
    if (!isAlone)
        addLowTriangle(size);
    probe_init(&probe, makeShape(kind, size), terrain_list(frame, &ground));
    McdModelSetContactTolerance(probe.model, .01 * size);
    McdModelSetContactTolerance(probe.ground, 0);
    seed = 1;
    for (int i = 0; i < TURNS; i++) {
        randomTurn(probe.tm);
        MeMatrix4TMSetPosition(probe.tm, size * (random01() - .5), size * (random01() - .5), 0);
        McdGeometryMaximumPoint(McdModelGetGeometry(probe.model), (const MeVector4 *)probe.tm, down, lowest);
        McdGeometryMaximumPoint(McdModelGetGeometry(probe.model), (const MeVector4 *)probe.tm, up, highest);
        const double deep = fmin(.15 * size, .45 * (double)(highest[2] - lowest[2])); /* its middle stays in front */
        probe.tm[3][2] = (MeReal)(-(double)lowest[2] - deep * random01() + .005 * size);
        McdGeometryMaximumPoint(McdModelGetGeometry(probe.model), (const MeVector4 *)probe.tm, down, lowest);
        ck_assert_int_gt(probe_test(&probe), 0);
        assert_near(deepest(&probe), lowest[2], size * TOL(8e-7, 5e-15));
        for (int k = 0; k < probe.result.contactCount; k++)
            assert_vec3_near(probe.contact[k].normal, 0, 0, 1, TOL(5e-7, 2e-15));
        ck_assert_int_le(probe.result.contactCount, 4);
    }
}

TEST(a_flat_grid_is_a_plane) {
    for (int kind = 0; kind < 40; kind++) {
        onPlane(kind, 1, 1);
        onPlane(kind, 1e-3, 1);
        onPlane(kind, 1e3, 1);
        onPlane(kind, 1, 0);
    }
}

/* A pole leans in a hole of the ground: it touches the border, and its lower end is under the ground beyond. */
TEST(what_is_under_the_ground_through_a_hole_is_not_pushed_up) {
    MeReal down[3] = {0, 0, -1};
    MeVector3 lowest;
    MeMatrix3 r;
    begin();
    terrain_grid(&ground, 20, .2, 0, ONE_SIDED);
    int kept = 0;
    for (int i = 0; i < ground.triangleCount; i++) { /* the hole is 1.2 x 1.2 around the origin */
        double x = 0, y = 0;
        for (int c = 0; c < 3; c++) {
            x += (double)ground.vertex[ground.triangle[i][c]][0] / 3;
            y += (double)ground.vertex[ground.triangle[i][c]][1] / 3;
        }
        if (fabs(x) < .6 && fabs(y) < .6)
            continue;
        memmove(ground.triangle[kept], ground.triangle[i], sizeof ground.triangle[i]);
        ground.flags[kept++] = ground.flags[i];
    }
    ground.triangleCount = kept;
    probe_init(&probe, McdBoxCreate(frame, .2, .2, 4), terrain_list(frame, &ground));
    McdModelSetContactTolerance(probe.model, .01);
    MeMatrix3FromEulerAngles(r, 0, 1, 0);
    MeMatrix4TMSetRotation(probe.tm, (const MeVector3 *)r);
    int touching = 0;
    for (int i = 0; i < 200; i++) {
        /* the end that is above leans on the border at one side, the other end is below that at the other side */
        MeMatrix4TMSetPosition(probe.tm, .4 + .15 * random01(), .8 * (random01() - .5), .1 * random01());
        McdGeometryMaximumPoint(McdModelGetGeometry(probe.model), (const MeVector4 *)probe.tm, down, lowest);
        ck_assert(fabs(lowest[0]) > .7 && lowest[2] < (MeReal)-.5);
        touching += probe_test(&probe) > 0;
        for (int k = 0; k < probe.result.contactCount; k++)
            ck_assert(probe.contact[k].separation > (MeReal)-.3);
    }
    ck_assert_int_gt(touching, 20);
}

TEST(a_box_on_its_face_has_its_four_corners) {
    begin();
    terrain_grid(&ground, 20, .23, 0, ONE_SIDED);
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), terrain_list(frame, &ground));
    seed = 2;
    for (int i = 0; i < 200; i++) {
        const double x = random01(), y = random01();
        ck_assert_int_eq(probe_at(&probe, x, y, .499), 4);
        for (int k = 0; k < 4; k++) {
            const McdContact *c = &probe.contact[k];
            assert_near(fabs((double)c->position[0] - x), .5, TOL(1e-6, 5e-16));
            assert_near(fabs((double)c->position[1] - y), .5, TOL(1e-6, 5e-16));
            assert_near(c->position[2], -.0005, TOL(7e-8, 5e-18));
            assert_near(c->separation, -.001, TOL(2e-7, 9e-18));
            ck_assert_ptr_null(c->element1.ptr);
            ck_assert(terrain_owns(&ground, c->element2.ptr));
            ck_assert_int_eq(c->dims, 2);
        }
    }
}

TEST(features_stay_while_sliding_and_in_any_order) {
    MeU32 feature[4];
    begin();
    terrain_grid(&ground, 20, .23, 0, ONE_SIDED);
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), terrain_list(frame, &ground));
    for (int i = 0; i < 100; i++) {
        ground.backwards = i % 2;
        ck_assert_int_eq(probe_at(&probe, .011 * i, .007 * i, .5), 4);
        for (int k = 0; k < 4; k++) {
            if (i == 0)
                feature[k] = probe.contact[k].feature;
            ck_assert_uint_eq(probe.contact[k].feature, feature[k]);
            for (int other = 0; other < k; other++)
                ck_assert_uint_ne(feature[other], feature[k]);
        }
    }
}

/* ---- folds ------------------------------------------------------------------------------------------------------- */

static double valley(double x, double y) {
    (void)y;
    return fabs(x);
}

static double ridge(double x, double y) {
    (void)y;
    return -fabs(x);
}

static const double slope = 0.70710678118654752;

TEST(in_a_valley_only_the_faces_push) {
    begin();
    terrain_grid(&ground, 20, .25, valley, kMcdTriangleStandard & ~kMcdTriangleTwoSided);
    probe_init(&probe, McdSphereCreate(frame, .5), terrain_list(frame, &ground));
    for (int i = -40; i <= 40; i++) {
        const double x = .01 * i;
        ck_assert_int_gt(probe_at(&probe, x, .013 * i, sqrt(.5) + fabs(x)), 0);
        for (int k = 0; k < probe.result.contactCount; k++)
            assert_near(fabs(probe.contact[k].normal[0]), slope, TOL(4e-7, 2e-15));
        assert_near(deepest(&probe), 0, TOL(1e-6, 2e-15));
        ck_assert_int_le(probe.result.contactCount, 2);
        ck_assert(i != 0 || (probe.result.contactCount == 2 && hasNormal(&probe, slope, 0, slope)));
    }
}

TEST(over_a_ridge_the_normal_turns_smoothly) {
    double last = -1;
    begin();
    terrain_grid(&ground, 20, .25, ridge, ONE_SIDED);
    probe_init(&probe, McdSphereCreate(frame, .5), terrain_list(frame, &ground));
    for (int i = -60; i <= 60; i++) { /* at the height of the surface offset by the radius */
        const double x = .01 * i, flat = .5 * slope;
        const double z = fabs(x) < flat ? sqrt(.25 - x * x) : .5 / slope - fabs(x);
        ck_assert_int_gt(probe_at(&probe, x, .013 * i, z - .001), 0);
        assert_near(deepest(&probe), fabs(x) < flat ? -.001 * z / .5 : -.001 * slope, TOL(3e-6, 3e-6));
        const double expected = fabs(x) < flat ? x / .5 : x > 0 ? slope : -slope;
        for (int k = 0; k < probe.result.contactCount; k++)
            assert_near(probe.contact[k].normal[0], expected, 2e-3);
        ck_assert(last < (double)probe.contact[0].normal[0] + 1e-3);
        last = (double)probe.contact[0].normal[0];
    }
}

TEST(a_box_balances_on_a_ridge) {
    begin();
    terrain_grid(&ground, 20, .25, ridge, ONE_SIDED);
    probe_init(&probe, McdBoxCreate(frame, 2, 1, .2), terrain_list(frame, &ground));
    for (int i = -10; i <= 10; i++) {
        ck_assert_int_eq(probe_at(&probe, .03 * i, .017 * i, .099), 2);
        for (int k = 0; k < 2; k++) {
            assert_vec3_near(probe.contact[k].normal, 0, 0, 1, TOL(5e-7, 9e-16));
            assert_near(probe.contact[k].separation, -.001, TOL(3e-8, 6e-17));
            assert_near(fabs((double)probe.contact[k].position[1] - .017 * i), .5, TOL(4e-7, 6e-16));
        }
    }
}

/* A floor at height 0 for x < 0, a wall down to a lower floor at -1. */
static void makeStep(void) {
    for (int j = -8; j < 8; j++)
        for (int k = 0; k < 16; k++) {
            const double s = .25, y = j * s;
            const double from[2] = {k < 8    ? (k - 8) * s
                                    : k < 12 ? 0
                                             : (k - 12) * s,
                                    k < 8    ? 0
                                    : k < 12 ? -(k - 8) * s
                                             : -1};
            const double to[2] = {k < 8    ? (k - 7) * s
                                  : k < 12 ? 0
                                           : (k - 11) * s,
                                  k < 8    ? 0
                                  : k < 12 ? -(k - 7) * s
                                           : -1};
            const int a = terrain_vertex(&ground, from[0], y, from[1]), b = terrain_vertex(&ground, to[0], y, to[1]);
            const int c = terrain_vertex(&ground, to[0], y + s, to[1]),
                      d = terrain_vertex(&ground, from[0], y + s, from[1]);
            terrain_triangle(&ground, a, b, c, ONE_SIDED);
            terrain_triangle(&ground, a, c, d, ONE_SIDED);
        }
}

TEST(at_a_step_nothing_hooks) {
    begin();
    makeStep();
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), terrain_list(frame, &ground));
    for (int i = 0; i < 50; i++) { /* on the upper floor, over the edge by less and more than it sinks in */
        ck_assert_int_gt(probe_at(&probe, -.51 + .0203 * i * (i > 0), .1, .499), 0);
        for (int k = 0; k < probe.result.contactCount; k++)
            assert_vec3_near(probe.contact[k].normal, 0, 0, 1, TOL(5e-7, 9e-16));
        assert_near(deepest(&probe), -.001, TOL(2e-7, 5e-18));
    }
    for (int i = 0; i < 20; i++) { /* on the lower floor, against the wall, taller and smaller than it */
        MeMatrix4TMMakeIdentity(probe.tm);
        const double z = -.5 + .0001 * i;
        ck_assert_int_gt(probe_at(&probe, .499, .1, z - .001), 0);
        for (int k = 0; k < probe.result.contactCount; k++) {
            const MeReal *n = probe.contact[k].normal;
            assert_near(fmax(n[0], n[2]), 1, TOL(5e-7, 9e-16));
            ck_assert((double)probe.contact[k].separation > -.0011);
        }
        ck_assert(hasNormal(&probe, 1, 0, 0) && hasNormal(&probe, 0, 0, 1));
    }
}

/* ---- bumpy ground ------------------------------------------------------------------------------------------------ */

static double bumps(double x, double y) {
    return .2 * sin(2.1 * x + .3) * cos(1.7 * y) + .05 * sin(9 * x) * sin(7 * y + 1);
}

/* The nearest point of a triangle, by its seven cases (Ericson, Real-Time Collision Detection, 5.1.5). */
static double distanceToTriangle(const double p[3], double c[3][3]) {
    double best = INFINITY, n[3], e[2][3], d[3];
    for (int k = 0; k < 3; k++) {
        e[0][k] = c[1][k] - c[0][k];
        e[1][k] = c[2][k] - c[0][k];
        d[k] = p[k] - c[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    const double nn = n[0] * n[0] + n[1] * n[1] + n[2] * n[2], h = (d[0] * n[0] + d[1] * n[1] + d[2] * n[2]) / nn;
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        double a[3], q[3], dot = 0, len = 0, off = 0;
        for (int k = 0; k < 3; k++) {
            a[k] = c[(i + 1) % 3][k] - c[i][k];
            q[k] = p[k] - c[i][k];
            dot += a[k] * q[k];
            len += a[k] * a[k];
        }
        const double t = fmin(1, fmax(0, dot / len));
        for (int k = 0; k < 3; k++)
            off += (q[k] - t * a[k]) * (q[k] - t * a[k]);
        best = fmin(best, sqrt(off));
        const double side = n[0] * (a[1] * q[2] - a[2] * q[1]) + n[1] * (a[2] * q[0] - a[0] * q[2]) +
                            n[2] * (a[0] * q[1] - a[1] * q[0]);
        inside = inside && side >= 0;
    }
    return inside ? fabs(h) * sqrt(nn) : best;
}

static double distanceToGround(const double p[3]) {
    double min = INFINITY;
    for (int i = 0; i < ground.triangleCount; i++) {
        double c[3][3];
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                c[v][k] = (double)ground.vertex[ground.triangle[i][v]][k];
        min = fmin(min, distanceToTriangle(p, c));
    }
    return min;
}

TEST(a_ball_on_bumpy_ground_touches_its_nearest_point) {
    begin();
    terrain_grid(&ground, 16, .25, bumps, ONE_SIDED);
    probe_init(&probe, McdSphereCreate(frame, .4), terrain_list(frame, &ground));
    seed = 3;
    for (int i = 0; i < 1000; i++) {
        const double x = 3 * (random01() - .5), y = 3 * (random01() - .5);
        double p[3] = {(double)(MeReal)x, (double)(MeReal)y, (double)(MeReal)(bumps(x, y) + .25 + .2 * random01())};
        const double distance = distanceToGround(p);
        probe_at(&probe, p[0], p[1], p[2]);
        if (distance > .42 - 1e-5)
            continue;
        assert_near(deepest(&probe), distance - .4, TOL(2e-7, 2e-15));
        for (int k = 0; k < probe.result.contactCount; k++) { /* all of them are on the ball and true */
            const McdContact *c = &probe.contact[k];
            double off = 0;
            for (int m = 0; m < 3; m++)
                off += ((double)c->position[m] - p[m]) * (double)c->normal[m];
            assert_near(off, -.4 - (double)c->separation / 2, TOL(5e-7, 2e-15));
            ck_assert((double)c->normal[2] > .5);
        }
    }
}

/* ---- one triangle, its flags ------------------------------------------------------------------------------------- */

static void oneTriangle(int flags) {
    terrain_triangle(&ground, terrain_vertex(&ground, -1, -1, 0), terrain_vertex(&ground, 1, -1, 0),
                     terrain_vertex(&ground, -1, 1, 0), flags);
}

static int ballOver(int flags, double x, double y, double z) {
    begin();
    oneTriangle(flags);
    probe_init(&probe, McdSphereCreate(frame, .5), terrain_list(frame, &ground));
    return probe_at(&probe, x, y, z);
}

TEST(flags) {
    const int smallest = kMcdTriangleUseSmallestPenetration, both = kMcdTriangleTwoSided;
    ck_assert_int_eq(ballOver(kMcdTriangleStandard, -.5, -.5, .4), 1);
    assert_vec3_near(probe.contact[0].normal, 0, 0, 1, 0);
    assert_vec3_near(probe.contact[0].position, -.5, -.5, -.05, TOL(3e-7, 5e-16));
    assert_vec3_near(probe.result.normal, 0, 0, 1, TOL(5e-7, 9e-16));
    ck_assert_int_eq(probe.result.touch, 1);
    ck_assert_int_eq(ballOver(kMcdTriangleStandard, -.5, -.5, -.4), 1); /* two sides */
    assert_vec3_near(probe.contact[0].normal, 0, 0, -1, 0);
    ck_assert_int_eq(ballOver(ONE_SIDED, -.5, -.5, -.1), 1); /* brought back */
    assert_vec3_near(probe.contact[0].normal, 0, 0, 1, 0);
    assert_near(probe.contact[0].separation, -.6, TOL(3e-7, 6e-16));
    ck_assert_int_eq(ballOver(ONE_SIDED, -.5, -.5, -.45), 0); /* comes from behind */
    /* Beside the edge from vertex 2 to 0, at x = -1: 0.3 out, 0.3 up. */
    ck_assert_int_eq(ballOver(kMcdTriangleStandard, -1.3, -.5, .3), 1);
    assert_vec3_near(probe.contact[0].normal, -slope, 0, slope, TOL(1e-6, 3e-15));
    assert_near(probe.contact[0].separation, .3 / slope - .5, TOL(3e-7, 2e-15));
    ck_assert_int_eq(ballOver(smallest | both | kMcdTriangleUseEdge0 | kMcdTriangleUseEdge1, -1.3, -.5, .3), 0);
    ck_assert_int_eq(ballOver(smallest | both | kMcdTriangleUseEdge2, -1.3, -.5, .3), 1);
    ck_assert_int_eq(ballOver(both | kMcdTriangleUseEdges, -1.3, -.5, .3), 0); /* the face's normal only */
    ck_assert_int_eq(ballOver(0, -.9, -.5, .3), 1);
    assert_vec3_near(probe.contact[0].normal, 0, 0, 1, 0);
}

static MeVector3 downward = {0, 0, -1};
static MeVector3 nowhere = {0, 0, 0};
static MeVector3 *given;

static int MEAPI findWithNormal(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    const int count = terrain_find(pair, triangle, pos, radius, max);
    for (int i = 0; i < count; i++)
        triangle[i].normal = given;
    return count;
}

TEST(the_given_normal_says_which_side_is_outside) {
    ballOver(ONE_SIDED, 0, 0, 0);
    McdTriangleListSetGenerator(McdModelGetGeometry(probe.ground), findWithNormal);
    given = &downward;
    ck_assert_int_eq(probe_at(&probe, -.5, -.5, -.4), 1);
    assert_vec3_near(probe.contact[0].normal, 0, 0, -1, 0);
    ck_assert_int_eq(probe_at(&probe, -.5, -.5, .4), 0);
    given = &nowhere; /* says nothing */
    ck_assert_int_eq(probe_at(&probe, -.5, -.5, .4), 1);
}

/* ---- the list ---------------------------------------------------------------------------------------------------- */

TEST(the_list_may_stand_anywhere) {
    begin();
    terrain_grid(&ground, 10, .5, 0, ONE_SIDED);
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), terrain_list(frame, &ground));
    MeMatrix4TMFromEulerAnglesAndPosition(probe.groundTM, 1, 2, 3, 40, -30, 20);
    MeMatrix4 rel;
    MeMatrix4TMMakeIdentity(rel);
    MeMatrix4TMSetPosition(rel, .3, -.2, .499);
    MeMatrix4TMCompound(probe.tm, (const MeVector4 *)rel, (const MeVector4 *)probe.groundTM);
    ck_assert_int_eq(probe_test(&probe), 4);
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 3; i++)
            assert_near(probe.contact[k].normal[i], probe.groundTM[2][i], TOL(5e-7, 9e-16));
        assert_near(probe.contact[k].separation, -.001, TOL(1e-5, 6e-15));
    }
    McdModelPairID turned = McdModelPairCreate(probe.ground, probe.model);
    ck_assert(McdIntersect(turned, &probe.result)); /* turned round: terrain_find wants the list second */
    ck_assert_int_eq(probe.result.contactCount, 4);
    for (int i = 0; i < 3; i++)
        assert_near(probe.contact[0].normal[i], -(double)probe.groundTM[2][i], TOL(5e-7, 9e-16));
    ck_assert_ptr_eq(probe.contact[0].instance1, McdModelGetGeometryInstance(probe.ground));
    McdModelPairDestroy(turned);
}

/* Cells of .4 at x < 0, of .2 at x > 0: on the line between them every other corner is on an edge. */
static void makeSeam(int use) {
    for (int side = 0; side < 2; side++) {
        const double cell = side ? .2 : .4;
        const int n = side ? 20 : 10, first = ground.vertexCount;
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++)
                terrain_vertex(&ground, (side ? 0 : -4) + i * cell, -2 + j * cell, 0);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                const int a = first + j * (n + 1) + i;
                terrain_triangle(&ground, a, a + 1, a + n + 2, use);
                terrain_triangle(&ground, a, a + n + 2, a + n + 1, use);
            }
    }
}

static double lowestOf(const Probe *p) {
    MeReal down[3] = {0, 0, -1};
    MeVector3 lowest;
    McdGeometryMaximumPoint(McdModelGetGeometry(p->model), (const MeVector4 *)p->tm, down, lowest);
    return (double)lowest[2];
}

/* Out along each contact by what of its depth the others have left. */
static void pushOut(Probe *p) {
    double way[3] = {0, 0, 0};
    for (int i = 0; i < p->result.contactCount; i++) {
        const McdContact *c = &p->contact[i];
        double left = -(double)c->separation;
        for (int k = 0; k < 3; k++)
            left -= way[k] * (double)c->normal[k];
        for (int k = 0; k < 3 && left > 0; k++)
            way[k] += left * (double)c->normal[k];
    }
    for (int k = 0; k < 3; k++)
        p->tm[3][k] += (MeReal)way[k];
}

TEST(nothing_falls_through_where_corners_meet_edges) {
    for (int kind = 0; kind < 24; kind++) {
        begin();
        seed = (unsigned int)kind;
        makeSeam(kind % 2 ? ONE_SIDED : kMcdTriangleUseSmallestPenetration);
        probe_init(&probe, makeShape(kind / 2, 1), terrain_list(frame, &ground));
        for (int i = 0; i < TURNS / 10; i++) {
            randomTurn(probe.tm);
            MeMatrix4TMSetPosition(probe.tm, .6 * (random01() - .5), 2 * (random01() - .5), 0);
            probe.tm[3][2] = (MeReal)(.01 - lowestOf(&probe));
            for (int step = 0; step < 60; step++) {
                probe.tm[3][2] -= (MeReal).02;
                probe_test(&probe);
                for (int k = 0; k < probe.result.contactCount; k++)
                    assert_vec3_near(probe.contact[k].normal, 0, 0, 1, TOL(5e-7, 2e-15));
                pushOut(&probe);
                assert_near(fmin(lowestOf(&probe), 0), 0, TOL(2e-6, 3e-15));
            }
        }
    }
}

TEST(triangles_without_area_do_nothing) {
    begin();
    oneTriangle(ONE_SIDED);
    const int a = terrain_vertex(&ground, -1, -1, 0), b = terrain_vertex(&ground, 1, 1, 0);
    terrain_triangle(&ground, a, b, a, ONE_SIDED);
    terrain_triangle(&ground, a, b, terrain_vertex(&ground, 0, 0, 0), ONE_SIDED);
    terrain_triangle(&ground, a, b, terrain_vertex(&ground, 0, NAN, 0), ONE_SIDED);
    terrain_triangle(&ground, a, b, terrain_vertex(&ground, INFINITY, 0, 0), ONE_SIDED);
    MeVector3 min = {-1, -1, 0}, max = {1, 1, 0};
    McdTriangleListID list = McdTriangleListCreate(frame, min, max, 10, terrain_find);
    McdTriangleListSetUserData(list, &ground);
    probe_init(&probe, McdSphereCreate(frame, .5), list);
    ck_assert_int_eq(probe_at(&probe, -.5, -.5, .4), 1);
    assert_near(probe.contact[0].separation, -.1, TOL(6e-8, 3e-16));
}

TEST(too_many_triangles_are_told_once) {
    begin();
    terrain_grid(&ground, 10, .1, 0, ONE_SIDED);
    McdTriangleListID list = terrain_list(frame, &ground);
    McdTriangleListSetMaxTriangles(list, 7);
    ck_assert_int_eq(McdTriangleListGetMaxTriangles(list), 7);
    probe_init(&probe, McdSphereCreate(frame, .5), list);
    probe_at(&probe, 0, 0, .4);
    assert_warned("triangleMaxCount");
    probe_at(&probe, 0, 0, .4);
}

/* As the User Guide's chapter 8 does it. */
TEST(the_number_of_triangles_may_be_written) {
    begin();
    terrain_grid(&ground, 10, .1, 0, ONE_SIDED);
    McdTriangleListID list = terrain_list(frame, &ground);
    ((McdTriangleList *)list)->triangleMaxCount = 7;
    ck_assert_int_eq(McdTriangleListGetMaxTriangles(list), 7);
    probe_init(&probe, McdSphereCreate(frame, .5), list);
    probe_at(&probe, 0, 0, .4);
    assert_warned("triangleMaxCount");
    ((McdTriangleList *)list)->triangleMaxCount = 1000;
    ck_assert_int_gt(probe_at(&probe, 0, 0, .4), 0);
    assert_silent();
    ((McdTriangleList *)list)->triangleMaxCount = 0;
    ck_assert_int_gt(probe_at(&probe, 0, 0, .4), 0);
    assert_warned("triangleMaxCount is 0");
    ck_assert_int_eq(McdTriangleListGetMaxTriangles(list), 1000);
}

TEST(the_result_has_no_more_than_fit) {
    begin();
    terrain_grid(&ground, 20, .1, bumps, ONE_SIDED);
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), terrain_list(frame, &ground));
    const int all = probe_at(&probe, 0, 0, .4);
    const double depth = deepest(&probe);
    ck_assert_int_gt(all, 6);
    ck_assert_int_le(all, 20); /* the default request's */
    for (int max = 1; max < 6; max++) {
        probe.result.contactMaxCount = max;
        ck_assert_int_eq(probe_test(&probe), max);
        assert_near(deepest(&probe), depth, TOL(2e-7, 3e-16));
    }
}

TEST(line_segments_pass_unless_asked_for) {
    MeReal from[3] = {-.5, -.5, 1}, to[3] = {-.5, -.5, -3};
    McdLineSegIntersectResult hit;
    ballOver(ONE_SIDED, 5, 5, 5);
    ck_assert_uint_eq(McdLineSegIntersect(probe.ground, from, to, &hit), 0);
    McdTriangleListLineSegmentRegisterInteraction(frame);
    ck_assert_uint_eq(McdLineSegIntersect(probe.ground, from, to, &hit), 1);
    assert_near(hit.distance, 1, TOL(5e-7, 9e-16));
    assert_vec3_near(hit.position, -.5, -.5, 0, TOL(5e-7, 9e-16));
    assert_vec3_near(hit.normal, 0, 0, 1, 0);
    ck_assert_ptr_eq(hit.model, probe.ground);
    ck_assert_uint_eq(McdLineSegIntersect(probe.ground, to, from, &hit), 0); /* from behind */
    ground.flags[0] = kMcdTriangleStandard;
    ck_assert_uint_eq(McdLineSegIntersect(probe.ground, to, from, &hit), 1);
    assert_near(hit.distance, 3, TOL(1e-6, 3e-15));
    assert_vec3_near(hit.normal, 0, 0, -1, 0);
    from[0] = to[0] = (MeReal).9;
    ck_assert_uint_eq(McdLineSegIntersect(probe.ground, from, to, &hit), 0);
}

TEST(bad_input) {
    MeVector3 min = {0, 0, 0}, max = {1, 1, 1}, bad = {1, NAN, 1};
    begin();
    assert_none(McdTriangleListCreate, frame, min, bad, 10, terrain_find);
    ck_assert_ptr_null(McdTriangleListCreate(frame, max, min, 10, terrain_find));
    assert_warned("min <= max");
    ck_assert_ptr_null(McdTriangleListCreate(frame, min, max, 0, terrain_find));
    assert_warned("triangleMaxCount");
    McdTriangleListID list = McdTriangleListCreate(frame, min, max, 10, 0);
    assert_refused(McdTriangleListSetMaxTriangles, list, 0);
    assert_refused(McdTriangleListSetBoundingBox, list, max, min);
    McdGeometryID ball = McdSphereCreate(frame, 1);
    assert_none(McdTriangleListGetUserData, ball);
    probe_init(&probe, ball, list); /* no callback: no contacts */
    ck_assert_int_eq(probe_at(&probe, 0, 0, 0), 0);
    MeVector3 low, high;
    McdTriangleListGetBoundingBox(list, low, high);
    assert_vec3_near(high, 1, 1, 1, 0);
    MeMatrix4 tm;
    MeMatrix3 inertia;
    MeReal volume;
    ck_assert_int_eq(McdGeometryGetMassProperties(list, tm, inertia, &volume), 0);
    assert_silent();
    McdFrameworkID empty = McdInit(0, 1, 0, 1);
    ck_assert_ptr_null(McdTriangleListCreate(empty, min, max, 1, 0));
    assert_warned("register");
    McdTerm(empty);
}

/* A triangle on its own, its corners at thirds of a turn, in a list of its own flags. */
static void lonelyTriangle(int edges) {
    begin();
    for (int i = 0; i < 3; i++)
        terrain_vertex(&ground, cos(i * 2.0943951023931953), sin(i * 2.0943951023931953), 0);
    terrain_triangle(&ground, 0, 1, 2, kMcdTriangleUseSmallestPenetration | edges);
    probe_init(&probe, McdSphereCreate(frame, .5), terrain_list(frame, &ground));
    McdModelSetContactTolerance(probe.model, 0);
    McdModelSetContactTolerance(probe.ground, 0);
}

/* A ball .3 beyond a place on the border and .2 above it: a contact there if it is sharp, else none. */
static void expectBeyond(double x, double y, MeBool isSharp) {
    const double out = hypot(x, y), distance = hypot(.3, .2);
    probe_at(&probe, x + .3 * x / out, y + .3 * y / out, .2);
    ck_assert_int_eq(probe.result.contactCount, isSharp);
    if (!isSharp)
        return;
    assert_near(probe.contact[0].separation, distance - .5, TOL(1e-6, 1e-9));
    assert_vec3_near(probe.contact[0].normal, .3 / distance * x / out, .3 / distance * y / out, .2 / distance,
                     TOL(1e-6, 1e-9));
}

/* The corner between edges i - 1 and i is sharp if both are. */
TEST(a_ball_beyond_each_corner_and_edge_for_all_sets_of_flags) {
    for (int edges = 0; edges <= kMcdTriangleUseEdges; edges += kMcdTriangleUseEdge0) {
        lonelyTriangle(edges);
        for (int i = 0; i < 3; i++) {
            const double turn = i * 2.0943951023931953, half = turn + 1.0471975511965976;
            const MeBool isSharp = (edges & kMcdTriangleUseEdge0 << i) != 0;
            const MeBool isSharpBefore = (edges & kMcdTriangleUseEdge0 << (i + 2) % 3) != 0;
            expectBeyond(cos(turn), sin(turn), isSharp && isSharpBefore);
            expectBeyond(.5 * cos(half), .5 * sin(half), isSharp);
        }
    }
}

static int edges;
static double drawn; /* m */
static const MeVector3 listMin = {-1, -2, -4}, listMax = {8, 16, 32};

static void MEAPI onEdge(MeVector3 from, MeVector3 to, MeReal r, MeReal g, MeReal b) {
    int along = 0;
    for (int k = 0; k < 3; k++) {
        ck_assert(from[k] == listMin[k] || from[k] == listMax[k]);
        ck_assert(to[k] == listMin[k] || to[k] == listMax[k]);
        along += from[k] != to[k];
    }
    ck_assert_int_eq(along, 1);
    ck_assert(r == 1 && g == 0 && b == 0);
    drawn += (double)MeVector3Distance(from, to);
    edges++;
}

TEST(the_box_around_a_list_is_drawn_edge_by_edge) {
    const MeReal red[3] = {1, 0, 0};
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    MeMatrix4 tm;
    const McdFrameworkID f = terrain_framework();
    const McdTriangleListID list =
        McdTriangleListCreate(f, (MeReal *)listMin, (MeReal *)listMax, TERRAIN_FOUND, terrain_find);
    MeMatrix4TMMakeIdentity(tm);
    edges = 0;
    drawn = 0;
    MeDebugDrawAPI.line = onEdge;
    McdTriangleListDebugDraw(list, tm, red);
    MeDebugDrawAPI.line = before;
    ck_assert_int_eq(edges, 12);
    assert_near(drawn, 4 * (9 + 18 + 36), 0);
}
