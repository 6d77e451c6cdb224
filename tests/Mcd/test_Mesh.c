/* Indexed meshes: the same contacts and hits as height fields and lists of their triangles, solids as their closed
 * surfaces, scaled copies, vertices that move, bad input. */
#include "terrain.h"
#include "random_numbers.h"

enum { N = 21, ONE_SIDED = kMcdTriangleStandard & ~kMcdTriangleTwoSided };
static const double step = .3125; /* places are exact in single precision */

static Terrain ground;
static MeReal heights[N * N];
static McdFrameworkID frame;
static McdGeometryID field, mesh;
static Probe probe, same;

/* ---- surfaces ---------------------------------------------------------------------------------------------------- */

/* A height field, and the triangles of the same numbers; */
static void beginWith(double (*height)(double x, double y)) {
    frame = terrain_framework();
    memset(&ground, 0, sizeof ground);
    state = 7;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            const double x = -3 + i * step, y = -3 + j * step;
            heights[j * N + i] = (MeReal)height(x, y);
            terrain_vertex(&ground, x, y, (double)heights[j * N + i]);
        }
    for (int j = 0; j + 1 < N; j++)
        for (int i = 0; i + 1 < N; i++) {
            const int a = j * N + i;
            terrain_triangle(&ground, a, a + 1, a + N + 1, ONE_SIDED);
            terrain_triangle(&ground, a, a + N + 1, a + N, ONE_SIDED);
        }
    field = McdRGHeightFieldCreate(frame, heights, N, N, step, step, -3, -3);
    mesh = terrain_mesh(frame, &ground);
}

static double rough(double x, double y) {
    (void)x, (void)y;
    return uniform(0, .15);
}

static double flat(double x, double y) {
    (void)x, (void)y;
    return .125;
}

/* Terraces: flat parts with borders at steep steps. */
static double terraced(double x, double y) {
    return .25 * floor(x) + (fabs(y) < 1 ? .5 : 0);
}

static MeBool isSameContact(const McdContact *a, const McdContact *b) {
    const double tolerance = TOL(2e-6, 1e-9);
    double sum = fabs((double)a->separation - (double)b->separation);
    for (int i = 0; i < 3; i++)
        sum +=
            fabs((double)a->position[i] - (double)b->position[i]) + fabs((double)a->normal[i] - (double)b->normal[i]);
    return sum < tolerance;
}

static void assertSameContacts(const Probe *a, const Probe *b) {
    ck_assert_int_eq(a->result.contactCount, b->result.contactCount);
    for (int i = 0; i < a->result.contactCount; i++) {
        int k = 0;
        while (k < b->result.contactCount && !isSameContact(&a->contact[i], &b->contact[k]))
            k++;
        ck_assert_int_lt(k, b->result.contactCount);
    }
}

static void randomPose(MeMatrix4 tm, double above) {
    MeMatrix4TMFromEulerAnglesAndPosition(tm, uniform(0, 6), uniform(0, 6), uniform(0, 6), uniform(-3.2, 3.2),
                                          uniform(-3.2, 3.2), above + uniform(-.1, .1));
}

/* Whether the point of the surface at a contact lies in the contact's triangle. */
static void assertInTriangle(const McdContact *c) {
    const int *v = ground.triangle[c->element2.tag];
    ck_assert(c->element2.tag >= 0 && c->element2.tag < ground.triangleCount);
    for (int i = 0; i < 2; i++) {
        const double at = (double)c->position[i] - (double)c->separation / 2 * (double)c->normal[i];
        const double low = MeMIN3(ground.vertex[v[0]][i], ground.vertex[v[1]][i], ground.vertex[v[2]][i]);
        const double high = MeMAX3(ground.vertex[v[0]][i], ground.vertex[v[1]][i], ground.vertex[v[2]][i]);
        ck_assert(at > low - 1e-5 && at < high + 1e-5);
    }
}

static double deepest(const Probe *p) {
    double min = 1;
    for (int i = 0; i < p->result.contactCount; i++)
        min = fmin(min, McdContactGetSeparation(&p->contact[i]));
    return min;
}

/* Compares a shape on the mesh and on another ground, in any pose, and upright in every other one. */
static void compareShape(McdGeometryID shape, double above, McdGeometryID other, double reach) {
    int touching = 0;
    const int isField = other == field, isPlane = McdGeometryGetType(other) == kMcdGeometryTypePlane;
    const int isRound =
        McdGeometryGetType(shape) == kMcdGeometryTypeCylinder || McdGeometryGetType(shape) == kMcdGeometryTypeCone;
    probe_init(&probe, shape, mesh);
    probe_init(&same, shape, other);
    same.groundTM[3][2] = isPlane ? (MeReal).125 : 0;
    for (int i = 0; i < 200; i++) {
        randomPose(probe.tm, above);
        if (i % 2)
            MeMatrix4TMMakeIdentity(probe.tm);
        MeMatrix4TMSetPosition(probe.tm, uniform(-reach, reach), uniform(-reach, reach), above + uniform(-.05, .05));
        memcpy(same.tm, probe.tm, sizeof same.tm);
        touching += probe_test(&probe) > 0;
        probe_test(&same);
        assert_near(deepest(&probe), deepest(&same), TOL(1e-9, 1e-12));
        if (isField || (isPlane && i % 2 && !isRound))
            assertSameContacts(&probe, &same);
        for (int k = 0; isPlane && k < probe.result.contactCount; k++)
            assertInTriangle(&probe.contact[k]);
    }
    ck_assert_int_gt(touching, 40);
    probe_term(&probe);
    probe_term(&same);
}

static void compareShapes(double above, McdGeometryID other, double reach) {
    MeVector3 p[7] = {{0, 0, .4}, {.4, 0, 0}, {-.4, 0, 0}, {0, .3, 0}, {0, -.3, 0}, {0, 0, -.4}, {.2, .2, .2}};
    compareShape(McdSphereCreate(frame, .4), above + .35, other, reach);
    compareShape(McdBoxCreate(frame, .6, .4, .5), above + .22, other, reach);
    compareShape(McdSphylCreate(frame, .2, .6), above + .3, other, reach);
    compareShape(McdCylinderCreate(frame, .3, .4), above + .18, other, reach);
    compareShape(McdConeCreate(frame, .6, .3), above + .2, other, reach);
    compareShape(McdConvexMeshCreateHull(frame, (const MeVector3 *)p, 7, 0), above + .3, other, reach);
}

TEST(it_is_the_height_field_of_its_triangles) {
    beginWith(rough);
    compareShapes(0, field, 3.2);
}

/* Far from the border as on a plane, and in the triangles that are there. */
TEST(flat_parts_are_planes) {
    beginWith(flat);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    compareShapes(.125, McdPlaneCreate(frame), 2);
}

TEST(flat_parts_end_where_they_end) {
    beginWith(flat);
    compareShape(McdSphereCreate(frame, .4), .125 + .35, terrain_list(frame, &ground), 3.6);
    compareShape(McdBoxCreate(frame, .6, .4, .5), .125 + .22, terrain_list(frame, &ground), 3.6);
    beginWith(terraced);
    compareShape(McdSphereCreate(frame, .4), .7, terrain_list(frame, &ground), 3.6);
    compareShape(McdBoxCreate(frame, .6, .4, .5), .7, terrain_list(frame, &ground), 3.6);
}

TEST(it_is_the_same_at_the_second_time) {
    static McdContact first[50][TERRAIN_CONTACTS];
    for (int time = 0; time < 2; time++) {
        beginWith(rough);
        probe_init(&probe, McdBoxCreate(frame, .6, .4, .5), mesh);
        for (int i = 0; i < 50; i++) {
            randomPose(probe.tm, .3);
            probe_test(&probe);
            for (int k = 0; k < probe.result.contactCount; k++) {
                probe.contact[k].instance1 = probe.contact[k].instance2 = 0;
                if (time)
                    ck_assert_mem_eq(&first[i][k], &probe.contact[k], sizeof first[i][k]);
                first[i][k] = probe.contact[k];
            }
        }
        probe_term(&probe);
    }
}

/* ---- line segments ----------------------------------------------------------------------------------------------- */

static void compareSegment(const MeVector3 a, const MeVector3 b, McdModelID model, McdModelID expectedOf) {
    MeVector3 from, to;
    McdLineSegIntersectResult hit, expected;
    MeMatrix4TMTransform(from, (const MeVector4 *)probe.tm, a);
    MeMatrix4TMTransform(to, (const MeVector4 *)probe.tm, b);
    const unsigned int is = McdLineSegIntersect(model, from, to, &hit);
    ck_assert_uint_eq(is, McdLineSegIntersect(expectedOf, from, to, &expected));
    if (!is)
        return;
    assert_near(hit.distance, expected.distance, TOL(1e-5, 1e-14));
    assert_vec3_near(hit.position, expected.position[0], expected.position[1], expected.position[2], TOL(1e-5, 1e-14));
}

TEST(line_segments_meet_what_the_field_meets) {
    beginWith(rough);
    McdRGHeightFieldLineSegmentRegisterInteraction(frame);
    McdMeshLineSegmentRegisterInteraction(frame);
    probe_init(&probe, mesh, field);
    McdModelSetTransformPtr(probe.ground, probe.tm);
    for (int placed = 0; placed < 2; placed++) {
        if (placed)
            MeMatrix4TMFromEulerAnglesAndPosition(probe.tm, 1, 2, 3, 4, 5, 6);
        McdModelUpdate(probe.model);
        McdModelUpdate(probe.ground);
        for (int i = 0; i < 2000; i++) {
            MeVector3 a, b;
            MeVector3Set(a, uniform(-2.9, 2.9), uniform(-2.9, 2.9), uniform(.2, 2));
            MeVector3Set(b, uniform(-2.9, 2.9), uniform(-2.9, 2.9), uniform(-2, .2));
            if (i % 4 == 0 && !placed) { /* straight down on an edge or a vertex */
                a[0] = b[0] = ground.vertex[1 + i / 4 % (N - 2)][0];
                a[1] = b[1] = i % 8 ? a[1] : ground.vertex[N * (1 + i % (N - 2))][1];
            }
            compareSegment(a, b, probe.model, probe.ground);
        }
    }
}

/* A sphere of 20 * 4^levels triangles: halves of an icosahedron's edges, put on the sphere. */
static int midpoint(Terrain *t, int a, int b) {
    MeVector3 m;
    MeVector3Add(m, t->vertex[a], t->vertex[b]);
    const MeReal scale = MeVector3Magnitude(t->vertex[0]) / MeVector3Magnitude(m);
    return terrain_vertex(t, scale * m[0], scale * m[1], scale * m[2]);
}

static void makeSphere(Terrain *t, double radius, int levels) {
    static const int face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    const double g = (1 + sqrt(5)) / 2, unit = radius / sqrt(1 + g * g);
    const double p[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                             {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    memset(t, 0, sizeof *t);
    for (int i = 0; i < 12; i++)
        terrain_vertex(t, unit * p[i][0], unit * p[i][1], unit * p[i][2]);
    for (int i = 0; i < 20; i++)
        terrain_triangle(t, face[i][0], face[i][1], face[i][2], 0);
    for (int level = 0; level < levels; level++)
        for (int i = t->triangleCount - 1; i >= 0; i--) {
            int *v = t->triangle[i];
            const int ab = midpoint(t, v[0], v[1]), bc = midpoint(t, v[1], v[2]), ca = midpoint(t, v[2], v[0]);
            terrain_triangle(t, v[0], ab, ca, 0);
            terrain_triangle(t, ab, v[1], bc, 0);
            terrain_triangle(t, ca, bc, v[2], 0);
            v[0] = ab, v[1] = bc, v[2] = ca;
        }
}

/* The surface lies between two spheres: that of the vertices, and one less the sagitta of the longest edge. */
TEST(rays_meet_a_sphere_between_its_bounds) {
    static Terrain sphere;
    const double radius = 2;
    frame = terrain_framework();
    McdMeshLineSegmentRegisterInteraction(frame);
    makeSphere(&sphere, radius, 3);
    mesh = terrain_mesh(frame, &sphere);
    ck_assert(McdMeshIsClosed(mesh));
    probe_init(&probe, mesh, mesh);
    McdModelUpdate(probe.model);
    for (int i = 0; i < 2000; i++) {
        MeVector3 from, to;
        McdLineSegIntersectResult hit;
        double length;
        do {
            MeVector3Set(from, uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            length = MeVector3Magnitude(from);
        } while (!(length > .1 && length < 1));
        MeVector3MultiplyScalar(from, from, 5 / length);
        MeVector3MultiplyScalar(to, from, -.1);
        ck_assert(McdLineSegIntersect(probe.model, from, to, &hit));
        ck_assert(hit.distance > 5 - radius - 1e-5 && hit.distance < 5 - .99 * radius);
        ck_assert(MeVector3Dot(hit.normal, from) > .9 * 5);
        ck_assert(!McdLineSegIntersect(probe.model, to, from, &hit)); /* from inside: the back */
    }
}

/* ---- solids ------------------------------------------------------------------------------------------------------ */

static const double side[3] = {1, 2, .5};

static void makeBox(Terrain *t, const double centre[3], int outward) {
    static const int quad[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    memset(t, 0, sizeof *t);
    for (int i = 0; i < 8; i++)
        terrain_vertex(t, centre[0] + (i & 1 ? .5 : -.5) * side[0], centre[1] + (i & 2 ? .5 : -.5) * side[1],
                       centre[2] + (i & 4 ? .5 : -.5) * side[2]);
    for (int i = 0; i < 6; i++)
        for (int half = 1; half < 3; half++)
            terrain_triangle(t, quad[i][0], quad[i][outward ? half : half + 1], quad[i][outward ? half + 1 : half], 0);
}

TEST(a_closed_box_touches_as_a_box) {
    static const double origin[3] = {0, 0, 0};
    static Terrain box;
    frame = terrain_framework();
    McdAllRegisterInteractions(frame);
    makeBox(&box, origin, 1);
    mesh = terrain_mesh(frame, &box);
    McdGeometryID solid = McdBoxCreate(frame, side[0], side[1], side[2]), ball = McdSphereCreate(frame, .3);
    probe_init(&probe, ball, mesh);
    probe_init(&same, ball, solid);
    int touching = 0;
    for (int i = 0; i < 500; i++) {
        const double x = uniform(-.85, .85), y = uniform(-1.35, 1.35), z = uniform(-.6, .6);
        if (fabs(x) < .4 && fabs(y) < .9 && fabs(z) < .15)
            continue; /* deep inside the surface lets go */
        touching += probe_at(&probe, x, y, z);
        probe_at(&same, x, y, z);
        ck_assert_int_eq(probe.result.touch, same.result.touch);
        if (!probe.result.touch || same.contact[0].separation < -.3)
            continue;
        assert_near(probe.contact[0].separation, same.contact[0].separation, TOL(1e-6, 1e-9));
        assert_vec3_near(probe.contact[0].normal, same.contact[0].normal[0], same.contact[0].normal[1],
                         same.contact[0].normal[2], TOL(1e-5, 1e-9));
    }
    ck_assert_int_gt(touching, 100);
}

TEST(mass_is_that_of_the_solid_inside) {
    static const double centre[3] = {30, -20, 10};
    static Terrain box;
    MeMatrix4 tm;
    MeMatrix3 inertia;
    MeReal volume;
    frame = terrain_framework();
    makeBox(&box, centre, 1);
    mesh = terrain_mesh(frame, &box);
    ck_assert_int_eq(McdGeometryGetMassProperties(mesh, tm, inertia, &volume), 1);
    assert_near(volume, side[0] * side[1] * side[2], TOL(1e-6, 1e-13));
    assert_vec3_near(tm[3], centre[0], centre[1], centre[2], TOL(4e-6, 1e-13));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double a = side[(i + 1) % 3], b = side[(i + 2) % 3];
            assert_near(inertia[i][j], i == j ? (a * a + b * b) / 12 : 0, TOL(1e-6, 1e-13));
        }
    box.triangleCount--; /* open */
    mesh = terrain_mesh(frame, &box);
    ck_assert(!McdMeshIsClosed(mesh));
    ck_assert_int_eq(McdGeometryGetMassProperties(mesh, tm, inertia, &volume), 0);
    makeBox(&box, centre, 0); /* inside out */
    mesh = terrain_mesh(frame, &box);
    ck_assert(McdMeshIsClosed(mesh));
    ck_assert_int_eq(McdGeometryGetMassProperties(mesh, tm, inertia, &volume), 0);
}

TEST(two_sided_ones_have_two_outsides) {
    beginWith(flat);
    mesh = McdMeshCreateWithFlags(frame, (const MeVector3 *)ground.vertex, ground.vertexCount, &ground.triangle[0][0],
                                  ground.triangleCount, 0, kMcdMeshTwoSided);
    McdMeshLineSegmentRegisterInteraction(frame);
    probe_init(&probe, McdSphereCreate(frame, .25), mesh);
    ck_assert_int_eq(probe_at(&probe, 0, 0, .125 + .2), 1);
    assert_vec3_near(probe.contact[0].normal, 0, 0, 1, TOL(1e-6, 1e-12));
    ck_assert_int_eq(probe_at(&probe, 0, 0, .125 - .2), 1);
    assert_vec3_near(probe.contact[0].normal, 0, 0, -1, TOL(1e-6, 1e-12));
    MeVector3 up = {.1, .2, 1}, down = {.1, .2, -1};
    McdLineSegIntersectResult hit;
    ck_assert(McdLineSegIntersect(probe.ground, down, up, &hit));
    assert_vec3_near(hit.normal, 0, 0, -1, TOL(1e-6, 1e-12));
}

/* ---- hard surfaces ----------------------------------------------------------------------------------------------- */

/* Slivers, T-junctions and a place far away: a ball and a box that slide over a flat floor feel nothing. */
static void slideOver(const MeVector3 *vertex, int vertices, const int *index, int triangles, double far) {
    mesh = McdMeshCreate(frame, vertex, vertices, index, triangles, 0);
    for (int isBox = 0; isBox < 2; isBox++) {
        probe_init(&probe, isBox ? McdBoxCreate(frame, .5, .5, .5) : McdSphereCreate(frame, .25), mesh);
        for (int i = 0; i < 200; i++) {
            ck_assert_int_eq(probe_at(&probe, far + uniform(-.7, .7), uniform(-.7, .7), .24), isBox ? 4 : 1);
            for (int k = 0; k < probe.result.contactCount; k++) {
                assert_vec3_near(probe.contact[k].normal, 0, 0, 1, TOL(1e-6, 1e-9));
                assert_near(probe.contact[k].separation, -.01, TOL(1e-6, 1e-9));
            }
        }
        probe_term(&probe);
    }
}

TEST(flat_floors_are_flat_however_they_are_divided) {
    static const double places[2] = {0, 4096};
    frame = terrain_framework();
    for (int k = 0; k < 2; k++) {
        const MeReal f = places[k];
        MeVector3 two[4] = {{f - 2, -2, 0}, {f + 2, -2, 0}, {f + 2, 2, 0}, {f - 2, 2, 0}};
        static const int ofTwo[6] = {0, 1, 2, 0, 2, 3};
        slideOver((const MeVector3 *)two, 4, ofTwo, 2, places[k]);
        MeVector3 fan[6] = {{f - 2, -2, 0}, {f + 2, -2, 0}, {f + 2, 2, 0}, {f - 2, 2, 0}, {f, 0, 0}, {f - 2, 0, 0}};
        static const int ofJunction[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}; /* (-2, 0) lies on an edge */
        slideOver((const MeVector3 *)fan, 5, ofJunction, 4, places[k]);
        static const int ofHalves[15] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 5, 4, 5, 0, 4};
        slideOver((const MeVector3 *)fan, 6, ofHalves, 5, places[k]);
        MeVector3 sliver[6] = {
            {f - 2, -2, 0},      {f + 2, -2, 0}, {f + 2, 2, 0}, {f - 2, 2, 0}, {f + 2, -1.9990234375, 0},
            {f, 0.0009765625, 0}};
        static const int ofSliver[15] = {0, 1, 4, 0, 4, 5, 4, 2, 5, 2, 3, 5, 3, 0, 5};
        slideOver((const MeVector3 *)sliver, 6, ofSliver, 5, places[k]);
    }
}

TEST(many_triangles) {
    enum { SIDE = 300 };
    MeVector3 *vertex = malloc((SIDE + 1) * (SIDE + 1) * sizeof *vertex);
    int *index = malloc(6 * SIDE * SIDE * sizeof *index), count = 0;
    frame = terrain_framework();
    for (int j = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++)
            MeVector3Set(vertex[j * (SIDE + 1) + i], (MeReal)(i - SIDE / 2), (MeReal)(j - SIDE / 2),
                         (i + j) % 2 ? .25 : 0);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int a = j * (SIDE + 1) + i, of[6] = {a, a + 1, a + SIDE + 2, a, a + SIDE + 2, a + SIDE + 1};
            memcpy(index + count, of, sizeof of);
            count += 6;
        }
    mesh = McdMeshCreate(frame, (const MeVector3 *)vertex, (SIDE + 1) * (SIDE + 1), index, count / 3, 0);
    free(vertex);
    free(index);
    ck_assert_int_eq(McdMeshGetTriangleCount(mesh), 2 * SIDE * SIDE);
    ck_assert_int_eq(McdMeshGetVertexCount(mesh), (SIDE + 1) * (SIDE + 1));
    McdMeshLineSegmentRegisterInteraction(frame);
    probe_init(&probe, McdSphereCreate(frame, .4), mesh);
    for (int i = 0; i < 200; i++) {
        McdLineSegIntersectResult hit;
        const int x = (int)uniform(-140, 140), y = (int)uniform(-140, 140);
        MeVector3 from = {(MeReal)x, (MeReal)y, 1}, to = {(MeReal)x, (MeReal)y, -1};
        ck_assert(McdLineSegIntersect(probe.ground, from, to, &hit));
        assert_near(hit.distance, (x + y) % 2 ? .75 : 1, TOL(1e-6, 1e-14));
        ck_assert_int_gt(probe_at(&probe, x, y, ((x + y) % 2 ? .25 : 0) + .39), 0);
    }
}

/* As a part of an aggregate it touches as alone, and keeps its materials. */
TEST(a_part_of_an_aggregate) {
    static MeU32 material[TERRAIN_TRIANGLES];
    MeMatrix4 place;
    beginWith(rough);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    for (int i = 0; i < ground.triangleCount; i++)
        material[i] = (MeU32)i;
    McdMeshID part = McdMeshCreate(frame, (const MeVector3 *)ground.vertex, ground.vertexCount, &ground.triangle[0][0],
                                   ground.triangleCount, material);
    McdAggregateID whole = McdAggregateCreate(frame, 1);
    MeMatrix4TMMakeIdentity(place);
    McdAggregateAddElement(whole, part, place);
    McdGeometryID ball = McdSphereCreate(frame, .4);
    probe_init(&probe, ball, whole);
    probe_init(&same, ball, mesh);
    for (int i = 0; i < 100; i++) {
        randomPose(probe.tm, .35);
        memcpy(same.tm, probe.tm, sizeof same.tm);
        probe_test(&probe);
        probe_test(&same);
        assertSameContacts(&probe, &same);
        for (int k = 0; k < probe.result.contactCount; k++)
            ck_assert_uint_eq(McdContactGetMaterial(&probe.contact[k], 1), (MeU32)probe.contact[k].element2.tag);
    }
}

/* ---- copies, changes --------------------------------------------------------------------------------------------- */

/* A scaled copy is the mesh of the scaled vertices, and outlives its original. */
TEST(scaled_copies) {
    static const MeReal scales[][3] = {{.0078125, .0078125, .0078125}, {1, 1, 1}, {1024, 1024, 1024}, {2, .5, 4}};
    for (int n = 0; n < 4; n++) {
        static Terrain scaled;
        const MeReal *s = scales[n];
        beginWith(n % 2 ? rough : terraced);
        scaled = ground;
        for (int i = 0; i < scaled.vertexCount; i++)
            MeVector3Set(scaled.vertex[i], s[0] * scaled.vertex[i][0], s[1] * scaled.vertex[i][1],
                         s[2] * scaled.vertex[i][2]);
        McdMeshID copy = McdMeshCreateScaled(mesh, s), twice = McdMeshCreateScaled(copy, scales[1]);
        McdGeometryDestroy(mesh);
        McdGeometryDestroy(copy);
        McdGeometryID box = McdBoxCreate(frame, .5 * s[0], .4 * s[1], .3 * s[2]);
        probe_init(&probe, box, twice);
        probe_init(&same, box, terrain_mesh(frame, &scaled));
        McdModelSetContactTolerance(probe.model, .01 * s[2]);
        McdModelSetContactTolerance(same.model, .01 * s[2]);
        for (int i = 0; i < 100; i++) {
            randomPose(probe.tm, .2);
            for (int k = 0; k < 3; k++)
                probe.tm[3][k] *= s[k];
            memcpy(same.tm, probe.tm, sizeof same.tm);
            probe_test(&probe);
            probe_test(&same);
            ck_assert_int_eq(probe.result.contactCount, same.result.contactCount);
            for (int k = 0; k < probe.result.contactCount; k++) {
                assert_near(probe.contact[k].separation / s[2], same.contact[k].separation / s[2], TOL(1e-6, 1e-12));
                ck_assert_int_eq(probe.contact[k].element2.tag, same.contact[k].element2.tag);
            }
        }
        probe_term(&probe);
        probe_term(&same);
    }
}

static void bend(Terrain *t, double by) {
    for (int i = 0; i < t->vertexCount; i++)
        t->vertex[i][2] = (MeReal)(by * (double)(t->vertex[i][0] * t->vertex[i][0]) + .1 * uniform(0, 1));
}

/* The tree that was fitted finds what a new one finds; other meshes of the same vertices, too. */
TEST(vertices_that_move) {
    beginWith(flat);
    McdMeshID borrowed =
        McdMeshCreateWithFlags(frame, (const MeVector3 *)ground.vertex, ground.vertexCount, &ground.triangle[0][0],
                               ground.triangleCount, 0, kMcdMeshBorrowVertices);
    static const MeVector3 one = {1, 1, 1};
    McdMeshID copy = McdMeshCreateScaled(borrowed, one);
    for (int n = 0; n < 3; n++) {
        bend(&ground, .2 * n - .2);
        McdMeshSetVertices(mesh, (const MeVector3 *)ground.vertex);
        McdGeometryUpdate(borrowed);
        McdGeometryID box = McdBoxCreate(frame, .5, .4, .3);
        probe_init(&same, box, terrain_mesh(frame, &ground));
        for (int which = 0; which < 3; which++) {
            MeVector3 low[2], high[2];
            probe_init(&probe, box, which == 0 ? mesh : which == 1 ? borrowed : copy);
            McdGeometryGetAABB(McdModelGetGeometry(probe.ground), (const MeVector4 *)probe.groundTM, low[0], high[0]);
            McdGeometryGetAABB(McdModelGetGeometry(same.ground), (const MeVector4 *)probe.groundTM, low[1], high[1]);
            ck_assert_mem_eq(low[0], low[1], sizeof low[0]);
            ck_assert_mem_eq(high[0], high[1], sizeof high[0]);
            for (int i = 0; i < 50; i++) {
                randomPose(probe.tm, .2);
                memcpy(same.tm, probe.tm, sizeof same.tm);
                probe_test(&probe);
                probe_test(&same);
                assertSameContacts(&probe, &same);
            }
            probe_term(&probe);
        }
        probe_term(&same);
    }
}

/* Between flat and bent: what was found flat at creation is not believed afterwards. */
TEST(a_flat_mesh_that_bends) {
    beginWith(flat);
    probe_init(&probe, McdSphereCreate(frame, .25), mesh);
    ck_assert_int_eq(probe_at(&probe, 0, 0, .125 + .2), 1);
    for (int i = 0; i < ground.vertexCount; i++)
        ground.vertex[i][2] = (MeReal)(.125 + .5 * fabs((double)ground.vertex[i][0] - .125));
    McdMeshSetVertices(mesh, (const MeVector3 *)ground.vertex);
    ck_assert_int_eq(probe_at(&probe, .125, .1, .125 + .25 * sqrt(1.25) - .01), 2);
    for (int k = 0; k < 2; k++)
        assert_near(fabs(probe.contact[k].normal[0]), .5 / sqrt(1.25), TOL(1e-5, 1e-7));
}

/* ---- queries ----------------------------------------------------------------------------------------------------- */

TEST(queries_of_a_space_as_on_the_field) {
    beginWith(terraced);
    McdAllRegisterInteractions(frame);
    McdGeometryID box = McdBoxCreate(frame, .3, .2, .1);
    McdSpaceID space[2];
    for (int k = 0; k < 2; k++) {
        Probe *p = k ? &same : &probe;
        probe_init(p, box, k ? field : mesh);
        space[k] = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
        McdSpaceInsertModel(space[k], p->ground);
        McdSpaceEndChanges(space[k]);
    }
    for (int i = 0; i < 200; i++) {
        MeMatrix4 tm;
        MeVector3 by;
        McdModelID list[4];
        McdCastResult cast[2];
        McdClosestResult closest[2];
        int overlaps[2], hits[2], rays[2], near[2];
        randomPose(tm, uniform(-.5, 1.5));
        MeVector3Set(by, uniform(-1, 1), uniform(-1, 1), uniform(-3, 0));
        for (int k = 0; k < 2; k++) {
            overlaps[k] = McdSpaceOverlapGeometry(space[k], box, (const MeVector4 *)tm, 0, 0, list, 4);
            near[k] = McdSpaceGetClosest(space[k], box, (const MeVector4 *)tm, 3, 0, 0, &closest[k]);
            hits[k] = McdSpaceCastGeometry(space[k], box, (const MeVector4 *)tm, by, 0, 0, &cast[k]);
            rays[k] = McdSpaceCastRay(space[k], tm[3], by, 0, 0, &cast[k]);
        }
        ck_assert_int_eq(overlaps[0], overlaps[1]);
        ck_assert_int_eq(hits[0], hits[1]);
        ck_assert_int_eq(rays[0], rays[1]);
        ck_assert_int_eq(near[0], near[1]);
        if (near[0])
            assert_near(closest[0].distance, closest[1].distance, TOL(4e-6, 1e-9));
        if (rays[0])
            assert_near(cast[0].fraction, cast[1].fraction, TOL(2e-6, 1e-13));
    }
    for (int k = 0; k < 2; k++) {
        McdSpaceBeginChanges(space[k]);
        McdSpaceRemoveModel(k ? same.ground : probe.ground);
        McdSpaceEndChanges(space[k]);
        McdSpaceDestroy(space[k]);
    }
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

TEST(materials_of_triangles) {
    static MeU32 material[TERRAIN_TRIANGLES];
    beginWith(flat);
    for (int i = 0; i < ground.triangleCount; i++)
        material[i] = (MeU32)i % 5;
    mesh = McdMeshCreate(frame, (const MeVector3 *)ground.vertex, ground.vertexCount, &ground.triangle[0][0],
                         ground.triangleCount, material);
    ck_assert_int_eq(McdMeshGetMaterial(mesh, 13), 3);
    probe_init(&probe, McdSphereCreate(frame, .25), mesh);
    McdModelSetMaterial(probe.model, 77);
    McdModelSetMaterial(probe.ground, 88);
    for (int i = 0; i < 100; i++) {
        ck_assert_int_eq(probe_at(&probe, uniform(-2.9, 2.9), uniform(-2.9, 2.9), .125 + .2), 1);
        assertInTriangle(&probe.contact[0]);
        ck_assert_uint_eq(McdContactGetMaterial(&probe.contact[0], 0), 77);
        ck_assert_uint_eq(McdContactGetMaterial(&probe.contact[0], 1), material[probe.contact[0].element2.tag]);
    }
    probe_term(&probe);
    mesh = terrain_mesh(frame, &ground); /* without */
    ck_assert_int_eq(McdMeshGetMaterial(mesh, 13), -1);
    probe_init(&probe, McdSphereCreate(frame, .25), mesh);
    McdModelSetMaterial(probe.ground, 88);
    ck_assert_int_eq(probe_at(&probe, 0, 0, .125 + .2), 1);
    ck_assert_uint_eq(McdContactGetMaterial(&probe.contact[0], 1), 88);
    ck_assert_uint_eq(McdContactGetMaterial(0, 0), 0);
    assert_warned("McdContactGetMaterial");
}

/* ---- bad input --------------------------------------------------------------------------------------------------- */

TEST(bad_triangles_are_left_out_and_counted_in_one_message) {
    beginWith(flat);
    const int good = ground.triangleCount;
    const int nan = terrain_vertex(&ground, NAN, 0, 0), far = terrain_vertex(&ground, 0, INFINITY, 0);
    terrain_triangle(&ground, 0, 1, nan, 0);
    terrain_triangle(&ground, 0, far, 1, 0);
    terrain_triangle(&ground, -1, 0, 1, 0);
    terrain_triangle(&ground, 0, ground.vertexCount, 1, 0);
    terrain_triangle(&ground, 2, 2, 3, 0);
    terrain_triangle(&ground, 0, 1, 2, 0); /* in line */
    mesh = terrain_mesh(frame, &ground);
    assert_warned(
        "6 of 806 triangles are left out: 2 name a vertex that is none, 2 have one that is not finite, 2 have");
    ck_assert_int_eq(McdMeshGetLeftOutCount(mesh), 6);
    ck_assert_int_eq(McdMeshGetTriangleCount(mesh), good + 6);
    MeVector3 corner[3];
    ck_assert(McdMeshGetTriangle(mesh, good - 1, corner));
    ck_assert(!McdMeshGetTriangle(mesh, good, corner));
    compareShape(McdSphereCreate(frame, .4), .5, field, 3.2);
}

TEST(bad_input) {
    MeVector3 v[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, line[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, zero = {1, 0, 1};
    const MeVector3 *vertex = (const MeVector3 *)v;
    static const int index[3] = {0, 1, 2};
    frame = frame_make(0, 10, 10, 1);
    assert_none(McdMeshCreate, frame, vertex, 3, index, 1, 0); /* the type is not registered */
    frame = terrain_framework();
    assert_none(McdMeshCreate, 0, vertex, 3, index, 1, 0);
    assert_none(McdMeshCreate, frame, 0, 3, index, 1, 0);
    assert_none(McdMeshCreate, frame, vertex, 0, index, 1, 0);
    assert_none(McdMeshCreate, frame, vertex, 3, 0, 1, 0);
    assert_none(McdMeshCreate, frame, vertex, 3, index, 0, 0);
    assert_none(McdMeshCreate, frame, vertex, 3, index, -1, 0);
    assert_none(McdMeshCreate, frame, (const MeVector3 *)line, 3, index, 1, 0);
    assert_none(McdMeshCreateWithFlags, frame, vertex, 3, index, 1, 0, 64);
    mesh = McdMeshCreate(frame, vertex, 3, index, 1, 0);
    assert_none(McdMeshCreateScaled, mesh, 0);
    assert_none(McdMeshCreateScaled, mesh, zero);
    assert_none(McdMeshCreateScaled, McdSphereCreate(frame, 1), v[0]);
    assert_refused(McdMeshSetVertices, mesh, 0);
    assert_refused(McdMeshGetTriangle, mesh, 1, v);
    assert_refused(McdMeshGetTriangle, mesh, -1, v);
    assert_refused(McdMeshGetMaterial, mesh, 1);
    assert_refused(McdMeshGetTriangleCount, McdSphereCreate(frame, 1));
    MeVector3Set(v[2], NAN, 0, 0); /* later: no contacts, no end */
    McdMeshSetVertices(mesh, vertex);
    probe_init(&probe, McdSphereCreate(frame, 1), mesh);
    ck_assert_int_eq(probe_at(&probe, 0, 0, 0), 0);
    MeVector3Set(v[2], 0, 1e6, 0);
    McdMeshSetVertices(mesh, vertex);
    ck_assert_int_gt(probe_at(&probe, 0, 1, .5), 0);
}
