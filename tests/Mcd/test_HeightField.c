/* Height fields: the same surface as a triangle list of the same points, holes, heights, line segments. */
#include "terrain.h"

enum { N = 21, ONE_SIDED = kMcdTriangleStandard & ~kMcdTriangleTwoSided };
static const double step = .3;

static Terrain ground;
static MeReal heights[N * N];
static McdFrameworkID frame;
static McdRGHeightFieldID field;
static Probe probe, same;
static unsigned int seed;

static double random01(void) {
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / 16777216.0;
}

/* The field, and a list of the same triangles, from random heights. */
static void begin(double roughness) {
    frame = terrain_framework();
    memset(&ground, 0, sizeof ground);
    seed = 7;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            heights[j * N + i] = (MeReal)(roughness * random01());
            terrain_vertex(&ground, -3 + i * (double)(MeReal)step, -3 + j * (double)(MeReal)step,
                           (double)heights[j * N + i]);
        }
    for (int j = 0; j + 1 < N; j++)
        for (int i = 0; i + 1 < N; i++) {
            const int a = j * N + i;
            terrain_triangle(&ground, a, a + 1, a + N + 1, ONE_SIDED);
            terrain_triangle(&ground, a, a + N + 1, a + N, ONE_SIDED);
        }
    field = McdRGHeightFieldCreate(frame, heights, N, N, step, step, -3, -3);
}

static double deepest(const Probe *p) {
    double min = 1;
    for (int i = 0; i < p->result.contactCount; i++)
        min = fmin(min, p->contact[i].separation);
    return min;
}

static void compareShapes(McdGeometryID shape, double above) {
    probe_init(&probe, shape, field);
    probe_init(&same, shape, terrain_list(frame, &ground));
    int touching = 0;
    for (int i = 0; i < 300; i++) {
        MeMatrix4TMFromEulerAnglesAndPosition(probe.tm, 6 * random01(), 6 * random01(), 6 * random01(),
                                              4 * random01() - 2, 4 * random01() - 2, above + .2 * random01());
        memcpy(same.tm, probe.tm, sizeof same.tm);
        probe_test(&probe);
        probe_test(&same);
        ck_assert_int_eq(probe.result.touch, same.result.touch);
        touching += probe.result.contactCount > 0;
        assert_near(deepest(&probe), deepest(&same), TOL(9e-7, 1e-9));
        for (int k = 0; k < probe.result.contactCount; k++) {
            ck_assert(probe.contact[k].element2.tag >= 0 && probe.contact[k].element2.tag < 2 * (N - 1) * (N - 1));
            ck_assert((double)probe.contact[k].normal[2] > -1e-6);
        }
    }
    ck_assert_int_gt(touching, 100);
    probe_term(&probe);
    probe_term(&same);
}

TEST(it_is_the_list_of_its_triangles) {
    MeVector3 p[7] = {{0, 0, .4}, {.4, 0, 0}, {-.4, 0, 0}, {0, .3, 0}, {0, -.3, 0}, {0, 0, -.4}, {.2, .2, .2}};
    begin(.15);
    compareShapes(McdSphereCreate(frame, .4), .35);
    compareShapes(McdBoxCreate(frame, .6, .4, .5), .3);
    compareShapes(McdSphylCreate(frame, .2, .6), .3);
    compareShapes(McdCylinderCreate(frame, .3, .4), .3);
    compareShapes(McdConeCreate(frame, .6, .3), .3);
    compareShapes(McdConvexMeshCreateHull(frame, (const MeVector3 *)p, 7, 0), .3);
}

TEST(nothing_is_in_a_hole) {
    begin(0);
    const int i = 10, j = 12;
    heights[j * N + i] = NAN;
    McdRGHeightFieldUpdateHeights(field);
    probe_init(&probe, McdSphereCreate(frame, .1), field);
    const double x = -3 + i * step, y = -3 + j * step;
    ck_assert_int_eq(probe_at(&probe, x, y, .05), 0);
    ck_assert_int_eq(probe_at(&probe, x + 2 * step, y, .05), 1);
    ck_assert_int_gt(probe_at(&probe, x + step * 1.01, y, .05), 0);
}

TEST(heights_and_normals) {
    MeReal z, x0, y0;
    MeVector3 n;
    int nx, ny;
    begin(0);
    for (int i = 0; i < N * N; i++)
        heights[i] = (MeReal)(.5 * (i % N) * step - .25 * (i / N) * step);
    ck_assert(McdRGHeightFieldGetHeightAt(field, -2.93, 1.234, &z, n));
    assert_near(z, .5 * .07 - .25 * 4.234, TOL(5e-7, 1e-15));
    assert_vec3_near(n, -.5 / sqrt(1.3125), .25 / sqrt(1.3125), 1 / sqrt(1.3125), TOL(2e-6, 3e-15));
    ck_assert(McdRGHeightFieldGetHeightAt(field, -3, -3, &z, 0));
    assert_near(z, 0, 0);
    ck_assert(!McdRGHeightFieldGetHeightAt(field, -3.01, 0, &z, n));
    ck_assert(!McdRGHeightFieldGetHeightAt(field, 0, NAN, &z, n));
    McdRGHeightFieldGetCounts(field, &nx, &ny);
    McdRGHeightFieldGetOrigin(field, &x0, &y0);
    ck_assert_int_eq(nx, N);
    ck_assert_int_eq(ny, N);
    assert_near(x0, -3, 0);
    ck_assert_ptr_eq(McdRGHeightFieldGetHeights(field), heights);
    MeMatrix4 tm;
    MeVector3 low, high;
    MeMatrix4TMMakeIdentity(tm);
    McdRGHeightFieldUpdateHeights(field);
    McdGeometryGetAABB(field, (const MeVector4 *)tm, low, high);
    assert_vec3_near(low, -3, -3, -1.5, TOL(3e-6, 6e-14));
    assert_vec3_near(high, 3, 3, 3, TOL(3e-6, 6e-14));
}

/* Against all triangles, one by one, by the list. */
TEST(line_segments_meet_the_first_triangle) {
    int hits = 0;
    begin(.4);
    McdRGHeightFieldLineSegmentRegisterInteraction(frame);
    McdTriangleListLineSegmentRegisterInteraction(frame);
    probe_init(&probe, field, field);
    McdModelID list = McdModelCreate(terrain_list(frame, &ground));
    McdModelSetTransformPtr(list, probe.tm);
    MeMatrix4TMFromEulerAnglesAndPosition(probe.tm, 1, 2, 3, 4, 5, 6);
    McdModelUpdate(list);
    McdModelUpdate(probe.model);
    for (int i = 0; i < 3000; i++) {
        MeVector3 a, b, from, to;
        McdLineSegIntersectResult hit, expected;
        const int onGrid = i % 4 == 0; /* along a line of the grid, or straight down on a point of it */
        MeVector3Set(a, 8 * random01() - 4, 8 * random01() - 4, 2 * random01());
        MeVector3Set(b, 8 * random01() - 4, 8 * random01() - 4, -1 * random01());
        if (onGrid) {
            a[0] = b[0] = (MeReal)(-3 + step * (i / 4 % N));
            a[1] = i % 8 ? a[1] : b[1];
        }
        MeMatrix4TMTransform(from, (const MeVector4 *)probe.tm, (const MeReal *)a);
        MeMatrix4TMTransform(to, (const MeVector4 *)probe.tm, (const MeReal *)b);
        const unsigned int is = McdLineSegIntersect(probe.model, from, to, &hit);
        const unsigned int should = McdLineSegIntersect(list, from, to, &expected);
        if (onGrid && is != should) /* at the rim, rounding decides */
            continue;
        ck_assert_uint_eq(is, should);
        hits += (int)is;
        if (is)
            assert_near(hit.distance, expected.distance, TOL(1e-5, 8e-15));
    }
    ck_assert_int_gt(hits, 800);
}

TEST(bad_input) {
    begin(0);
    assert_none(McdRGHeightFieldCreate, frame, 0, N, N, 1, 1, 0, 0);
    ck_assert_ptr_null(McdRGHeightFieldCreate(frame, heights, 1, N, 1, 1, 0, 0));
    assert_warned("points");
    ck_assert_ptr_null(McdRGHeightFieldCreate(frame, heights, N, N, 0, 1, 0, 0));
    assert_warned("steps");
    assert_none(McdRGHeightFieldCreate, frame, heights, N, N, 1, 1, NAN, 0);
    assert_refused(McdRGHeightFieldSetHeights, field, 0);
    for (int i = 0; i < N * N; i++) /* nothing but holes */
        heights[i] = i % 2 ? NAN : INFINITY;
    McdRGHeightFieldSetHeights(field, heights);
    probe_init(&probe, McdBoxCreate(frame, 1, 1, 1), field);
    ck_assert_int_eq(probe_at(&probe, 0, 0, 0), 0);
    ck_assert_int_eq(probe_at(&probe, 1e6, 0, 0), 0);
}
