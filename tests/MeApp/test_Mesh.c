/* Meshes from files, and hulls of them. */
#include "MeAppHull.h"
#include "MeAppMesh.h"
#include "RMesh.h"
#include "app_test.h"

static float red[4] = {.8f, .1f, .1f, 1};

/* A box from (0, 0, 0) to (2, 4, 6) in three formats. */
static const char obj[] = "v 0 0 0\nv 2 0 0\nv 2 4 0\nv 0 4 0\nv 0 0 6\nv 2 0 6\nv 2 4 6\nv 0 4 6\n"
                          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
static const char ply[] =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 6\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n2 4 0\n0 4 0\n0 0 6\n2 0 6\n2 4 6\n0 4 6\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

/* One face of it is enough for a format that names each corner. */
static const char stl[] =
    "solid face\nfacet normal 0 0 1\nouter loop\nvertex 0 0 6\nvertex 2 0 6\nvertex 2 4 6\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 6\nvertex 2 4 6\nvertex 0 4 6\nendloop\n"
    "endfacet\nendsolid face\n";

/* A triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) under a node that moves it by 5 along z. */
static const char gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"mesh\":0,\"translation\":[0,0,5]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"
    ","
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
    "\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
    "\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

static void make_text(const char *name, const char *text) {
    FILE *file = fopen(name, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_ge(fputs(text, file), 0);
    ck_assert_int_eq(fclose(file), 0);
}

static RGraphic *load(const char *name, const char *text, AcmeReal scale) {
    make_text(name, text);
    RGraphic *g = RGraphicLoadMesh(rc, name, scale, red, 0);
    remove(name);
    return g;
}

static void setup(void) {
    set_up();
}

static void teardown(void) {
    assert_silent();
    tear_down();
}
TEST_FIXTURE(setup, teardown)

static void assert_extent(const RGraphic *g, double x, double y, double z) {
    double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i++) {
        const double p[3] = {g->m_pVertices[i].m_X, g->m_pVertices[i].m_Y, g->m_pVertices[i].m_Z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    assert_vec3_near(low, 0, 0, 0, 1e-6);
    assert_vec3_near(high, x, y, z, 1e-6);
}

TEST(a_box_in_two_formats) {
    RGraphic *const both[] = {load("test_Mesh.obj", obj, 1), load("test_Mesh.ply", ply, 1)};
    for (int i = 0; i < 2; i++) {
        ck_assert_ptr_nonnull(both[i]);
        ck_assert_int_eq(both[i]->m_pObject->m_nNumVertices, 36);
        assert_extent(both[i], 2, 4, 6);
        for (int k = 0; k < 36; k++) { /* Flat: each normal is an axis. */
            const RObjectVertex *v = &both[i]->m_pVertices[k];
            assert_near(fabs(v->m_NX) + fabs(v->m_NY) + fabs(v->m_NZ), 1, 1e-6);
        }
    }
    assert_extent(load("test_Mesh.obj", obj, 0.5f), 1, 2, 3);
}

TEST(normals_of_the_file) {
    RGraphic *g = load("test_Mesh.stl", stl, 1);
    ck_assert_ptr_nonnull(g);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    for (int i = 0; i < 6; i++) {
        assert_near(g->m_pVertices[i].m_Z, 6, 0);
        assert_near(g->m_pVertices[i].m_NZ, 1, 1e-6);
    }
}

TEST(objects_are_where_the_file_places_them) {
    RGraphic *g = load("test_Mesh.gltf", gltf, 2);
    ck_assert_ptr_nonnull(g);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 3);
    for (int i = 0; i < 3; i++)
        assert_near(g->m_pVertices[i].m_Z, 10, 1e-6);
}

/* The box's hull: its volume, its centre of mass, and the graphic that goes with the body. */
TEST(a_hull_for_a_body) {
    MeVector3 centre;
    RGraphic *g = load("test_Mesh.obj", obj, 1);
    const McdConvexMeshID hull = MeAppHullCreate(u->frame, rc, g, centre);
    ck_assert_ptr_nonnull(hull);
    assert_vec3_near(centre, 1, 2, 3, TOL(1e-5, 1e-12));
    assert_near(g->m_pVertices[0].m_X * g->m_pVertices[0].m_X, 1, 1e-6);
    const McdModelID m = MstModelAndBodyCreate(u, hull, 2);
    assert_near_rel(MdtBodyGetMass(McdModelGetBody(m)), 96, TOL(1e-5, 1e-12));
    RGraphic *first = MeAppShowModel(app, m, red);
    ck_assert_ptr_nonnull(first);
    ck_assert_ptr_eq(MeAppShowModelAs(app, m, g), g);
    ck_assert_ptr_eq(MeAppShowModelAs(app, m, g), g);
    ck_assert_ptr_eq(MeAppShowModel(app, m, red), g);
    ck_assert_ptr_eq(g->m_pLWMatrix, McdModelGetTransformPtr(m));
    ck_assert_ptr_eq(rc->m_p3DGraphics, g); /* The one before is gone. */
    ck_assert_ptr_null(g->m_pNext);
    McdModelDestroy(m);
    MeAppShowUniverse(app);
    ck_assert_ptr_null(rc->m_p3DGraphics);
    McdGeometryDestroy(hull);
}

/* The box as a surface: closed, its six faces of two triangles, and the file's scale. */
TEST(a_mesh_for_collision) {
    MeMatrix4 tm;
    MeMatrix3 inertia;
    MeReal volume;
    make_text("test_Mesh.obj", obj);
    const McdMeshID mesh = MeAppMeshFromFile(u->frame, rc, "test_Mesh.obj", 2);
    remove("test_Mesh.obj");
    ck_assert_ptr_nonnull(mesh);
    ck_assert_ptr_null(rc->m_p3DGraphics);
    ck_assert_int_eq(McdMeshGetTriangleCount(mesh), 12);
    ck_assert(McdMeshIsClosed(mesh));
    ck_assert_int_eq(McdGeometryGetMassProperties(mesh, tm, inertia, &volume), 1);
    assert_near(volume, 8 * 48, TOL(1e-4, 1e-10));
    assert_vec3_near(tm[3], 2, 4, 6, TOL(1e-5, 1e-12));
    ck_assert_ptr_null(MeAppMeshFromFile(u->frame, rc, "no such file.obj", 1));
    assert_warned("no such file.obj");
    assert_none(MeAppMeshCreate, u->frame, 0);
    assert_none(MeAppMeshCreate, 0, 0);
}

TEST(bad_input) {
    static const char *const broken[] = {"", "no mesh", "v 0 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nl 1 2\n"};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        ck_assert_ptr_null(load("test_Mesh.obj", broken[i], 1));
        assert_warned("test_Mesh.obj");
    }
    ck_assert_ptr_null(RGraphicLoadMesh(rc, "no such file.stl", 1, red, 0));
    assert_warned("no such file.stl");
    ck_assert_ptr_null(RGraphicLoadMesh(rc, NULL, 1, red, 0));
    assert_warned("filename");
    ck_assert_ptr_null(load("test_Mesh.obj", obj, 0));
    assert_warned("scale");
    RGraphic *flat = load("test_Mesh.stl", stl, 1);
    assert_none(MeAppHullCreate, u->frame, rc, flat, 0);
    ck_assert_ptr_null(MeAppHullCreate(0, rc, flat, 0));
    assert_warned("frame");
    ck_assert_ptr_null(MeAppHullCreate(u->frame, rc, 0, 0));
    assert_warned("rg");
    ck_assert_ptr_null(MeAppShowModelAs(app, 0, flat));
    assert_warned("m is null");
    ck_assert_ptr_null(MeAppShowModelAs(app, make_box(0, 0, 0), 0));
    assert_warned("rg is null");
}
