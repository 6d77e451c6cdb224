/* Graphics of geometries and models, and what worlds and models draw of themselves. */
#include "MeDebugDraw.h"
#include "RGeometry.h"
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

static float red[4] = {.8f, .1f, .1f, 1};
static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

/* The box round a graphic's vertices. */
static void extent(const RGraphic *g, double low[3], double high[3]) {
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i++) {
        const double p[3] = {g->m_pVertices[i].m_X, g->m_pVertices[i].m_Y, g->m_pVertices[i].m_Z};
        for (int k = 0; k < 3; k++) {
            low[k] = i == 0 || p[k] < low[k] ? p[k] : low[k];
            high[k] = i == 0 || p[k] > high[k] ? p[k] : high[k];
        }
    }
}

static void assert_extent(const RGraphic *g, double x0, double y0, double z0, double x1, double y1, double z1) {
    double low[3] = {0}, high[3] = {0};
    ck_assert_ptr_nonnull(g);
    extent(g, low, high);
    assert_vec3_near(low, x0, y0, z0, 1e-5);
    assert_vec3_near(high, x1, y1, z1, 1e-5);
}

TEST(every_shape_is_as_large_as_its_geometry) {
    MeVector3 corner[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, low = {-1, -2, 0}, high = {1, 2, 3};
    static const MeReal heights[] = {0, 1, 2, 3, 4, 5};
    RGraphic *g = RGraphicCreateFromGeometry(rc, McdBoxCreate(u->frame, 1, 2, 3), red);
    assert_extent(g, -.5, -1, -1.5, .5, 1, 1.5);
    ck_assert_ptr_null(g->m_pLWMatrix);
    ck_assert_ptr_eq(rc->m_p3DGraphics, g);
    assert_extent(RGraphicCreateFromGeometry(rc, McdSphereCreate(u->frame, 2), red), -2, -2, -2, 2, 2, 2);
    assert_extent(RGraphicCreateFromGeometry(rc, McdCylinderCreate(u->frame, 1, 4), red), -1, -1, -2, 1, 1, 2);
    assert_extent(RGraphicCreateFromGeometry(rc, McdSphylCreate(u->frame, 1, 4), red), -1, -1, -3, 1, 1, 3);
    assert_extent(RGraphicCreateFromGeometry(rc, McdPlaneCreate(u->frame), red), -20, -20, 0, 20, 20, 0);
    McdConvexMeshID mesh = McdConvexMeshCreateHull(u->frame, corner, 4, 0);
    g = RGraphicConvexCreate(rc, mesh, red, floorTM);
    assert_extent(g, 0, 0, 0, 1, 2, 3);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 12);
    ck_assert_ptr_eq(g->m_pLWMatrix, floorTM);
    g = RGraphicCreateFromGeometry(rc, McdTriangleListCreate(u->frame, low, high, 5, 0), red);
    assert_extent(g, -1, -2, 0, 1, 2, 3);
    ck_assert(RGraphicIsWireframe(g)); /* Its box: the triangles are the program's. */
    McdRGHeightFieldRegisterType(u->frame);
    g = RGraphicCreateFromGeometry(rc, McdRGHeightFieldCreate(u->frame, heights, 3, 2, 1, 2, 5, 6), red);
    assert_extent(g, 5, 6, 0, 7, 8, 5);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 12);
}

TEST(a_mesh_is_its_triangles) {
    MeVector3 corner[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    static const int index[] = {0, 1, 2, 0, 3, 1};
    const MeVector3 *vertices = (const MeVector3 *)corner;
    RGraphic *g = RGraphicCreateFromGeometry(rc, McdMeshCreate(u->frame, vertices, 4, index, 2, 0), red);
    assert_extent(g, 0, 0, 0, 1, 2, 3);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    g = RGraphicCreateFromGeometry(rc, McdMeshCreateWithFlags(u->frame, vertices, 4, index, 2, 0, kMcdMeshTwoSided),
                                   red);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 12);
}

TEST(an_aggregate_is_one_graphic) {
    MeMatrix4 place;
    McdAggregateID whole = McdAggregateCreate(u->frame, 2);
    MeMatrix4TMMakeIdentity(place);
    MeMatrix4 other;
    MeMatrix4TMMakeIdentity(other);
    other[3][0] = 3;
    McdAggregateAddElement(whole, McdBoxCreate(u->frame, 1, 1, 1), place);
    McdAggregateAddElement(whole, McdBoxCreate(u->frame, 2, 2, 2), other);
    RGraphic *g = RGraphicAggregateCreate(rc, whole, red, 0);
    assert_extent(g, -.5, -1, -1, 4, 1, 1);
    ck_assert_ptr_eq(rc->m_p3DGraphics, g);
    ck_assert_ptr_null(g->m_pNext);
    McdGeometryDestroy(whole);
}

TEST(a_models_graphic_follows_it) {
    McdModelID m = make_box(1, 2, 3);
    RGraphic *g = RGraphicCreateFromModel(rc, m, red);
    assert_extent(g, -.5, -.5, -.5, .5, .5, .5);
    RRenderUpdateGraphicMatrices(rc);
    assert_vec3_near(g->m_pObject->m_Matrix[3], 1, 2, 3, 0);
}

TEST(bad_input) {
    McdGeometryID box = McdBoxCreate(u->frame, 1, 1, 1);
    float bad[4] = {NAN, 0, 0, 1};
    assert_none(RGraphicCreateFromGeometry, rc, 0, red);
    ck_assert_ptr_null(RGraphicCreateFromGeometry(0, box, red));
    assert_warned("rc is null");
    assert_none(RGraphicCreateFromModel, rc, 0, red);
    ck_assert_ptr_null(RGraphicCreateFromGeometry(rc, box, bad));
    assert_warned("color");
    assert_none(RGraphicConvexCreate, rc, box, red, 0);
    assert_none(RGraphicAggregateCreate, rc, box, red, 0);
    assert_none(RGraphicTrianglesCreate, rc, 0, 1, red, 0);
    ck_assert_ptr_null(rc->m_p3DGraphics);
    McdGeometryDestroy(box);
}

/* ---- debug drawing ---- */

static int lines;
static double lengths;

static void MEAPI countLine(MeVector3 a, MeVector3 b, MeReal r, MeReal g, MeReal blue) {
    (void)r, (void)g, (void)blue;
    lines++;
    lengths += (b[2] - a[2]);
}

/* A box of 2 kg on the plane z = 0; one step more, drawn as `options` say. */
static void draw_a_step(int options) {
    static MeMatrix4 ground;
    MeMatrix4TMMakeIdentity(ground);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
    make_box(0, 0, .5);
    run(30);
    lines = 0;
    lengths = 0;
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    MeDebugDrawAPI.line = countLine;
    MdtWorldSetDebugDrawing(u->world, (MdtDebugDrawOptions)options);
    run(1);
    MdtWorldSetDebugDrawing(u->world, (MdtDebugDrawOptions)0);
    run(1);
    MeDebugDrawAPI.line = before;
}

TEST(a_world_draws_its_contacts) {
    draw_a_step(MdtDebugDrawContacts);
    ck_assert_int_eq(lines, 4);
    assert_near(fabs(lengths), 4 * .3, 1e-3);
}

/* What carries a body's weight of 10 m/s² is a metre long together. */
TEST(a_world_draws_its_contact_forces) {
    draw_a_step(MdtDebugDrawContactForce);
    ck_assert_int_eq(lines, 4);
    assert_near(fabs(lengths), 1, 1e-2);
}

TEST(a_model_draws_its_box) {
    McdModelID m = make_box(0, 0, 0);
    run(1);
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    MeDebugDrawAPI.line = countLine;
    lines = 0;
    McdDebugDrawModelAABB(m);
    MeDebugDrawAPI.line = before;
    ck_assert_int_eq(lines, 12);
    assert_refused(McdDebugDrawModelAABB, 0);
    assert_refused(MdtWorldSetDebugDrawing, u->world, (MdtDebugDrawOptions)8);
}
