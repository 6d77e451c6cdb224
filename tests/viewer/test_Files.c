/* Files: .ASE objects, .bmp and .png textures, .png pictures. */
#define _DEFAULT_SOURCE /* mkdtemp, setenv */
#include <unistd.h>

#include "viewer_test.h"

#include "r_i.h"

static RRender *rc;

static void setup(void) {
    rc = make_context("-null");
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

static RGraphic *load(const char *text) {
    make_file("test_Files.ASE", text, strlen(text));
    RGraphic *g = RGraphicLoadASE(rc, "test_Files.ASE", 1, 1, 1, RED, NULL);
    remove("test_Files.ASE");
    return g;
}

static const char *const square =
    "*3DSMAX_ASCIIEXPORT\t200\n*COMMENT \"a { *MESH } in a name\"\n*GEOMOBJECT {\n\t*NODE_NAME \"square\"\n\t*MESH {\n"
    "\t\t*MESH_NUMVERTEX 4\n\t\t*MESH_VERTEX_LIST {\n"
    "\t\t\t*MESH_VERTEX    0\t-1.0000\t-1.0000\t0.0000\n\t\t\t*MESH_VERTEX    1\t1.0000\t-1.0000\t0.0000\n"
    "\t\t\t*MESH_VERTEX    2\t1.0000\t1.0000\t0.0000\n\t\t\t*MESH_VERTEX    3\t-1.0000\t1.0000\t0.0000\n\t\t}\n"
    "\t\t*MESH_FACE_LIST {\n"
    "\t\t\t*MESH_FACE    0:    A:    0 B:    1 C:    2 AB:    1 BC:    1 CA:    0\t *MESH_SMOOTHING 1 *MESH_MTLID 0\n"
    "\t\t\t*MESH_FACE    1:    A:    0 B:    2 C:    3 AB:    1 BC:    1 CA:    0\n\t\t}\n"
    "\t\t*MESH_TVERTLIST {\n\t\t\t*MESH_TVERT 0\t0.25\t0.75\t0.0\n\t\t\t*MESH_TVERT 1\t1.0\t0.0\t0.0\n\t\t}\n"
    "\t\t*MESH_TFACELIST {\n\t\t\t*MESH_TFACE 0\t0\t1\t0\n\t\t}\n";
static const char *const normals =
    "\t\t*MESH_NORMALS {\n\t\t\t*MESH_FACENORMAL 0\t0\t0\t1\n"
    "\t\t\t\t*MESH_VERTEXNORMAL 0\t0.0\t2.0\t0.0\n\t\t\t\t*MESH_VERTEXNORMAL 1\t1.0\t0.0\t0.0\n"
    "\t\t\t\t*MESH_VERTEXNORMAL 2\t0.0\t0.0\t-1.0\n\t\t}\n";

TEST(ase_without_normals) {
    RGraphic *g = load(square);
    ck_assert_ptr_nonnull(g);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    assert_near(g->m_pVertices[4].m_X, 1, 0);
    assert_near(g->m_pVertices[5].m_X, -1, 0);
    for (int i = 0; i < 6; i++)
        assert_near(g->m_pVertices[i].m_NZ, 1, 0); /* Anticlockwise seen from +z. */
    assert_near(g->m_pVertices[0].m_U, 0.25, 0);
    assert_near(g->m_pVertices[0].m_V, 0.25, 0); /* Upside down in the file. */
    assert_near(g->m_pVertices[1].m_V, 1, 0);
    assert_near(g->m_pVertices[3].m_U, 0, 0); /* The second face has no texture. */
}

/* Shapes for collision, by their names, are left out on request; the offset comes after the scale. */
TEST(ase_without_collision_shapes) {
    const MeVector3 offset = {10, 20, 30};
    char text[4096];
    const char *name = strstr(square, "square");
    snprintf(text, sizeof text, "%.*sMCDBX_s%s\t}\n}\n%s\t}\n}\n", (int)(name - square), square, name + 6, square);
    make_file("test_Files.ASE", text, strlen(text));
    RGraphic *g = RGraphicLoadASENoMCD(rc, "test_Files.ASE", 1, 1, 1, RED, NULL);
    ck_assert_ptr_nonnull(g);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    g = RGraphicLoadASEwithOffset(rc, "test_Files.ASE", 2, 1, 1, RED, offset, NULL);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 12);
    assert_vec3_near(&g->m_pVertices[0].m_X, 8, 19, 30, 0);
    g = RGraphicLoadASEwithOffsetNoMcd(rc, "test_Files.ASE", 1, 1, 1, RED, offset, NULL);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    ck_assert_ptr_null(RGraphicLoadASEwithOffset(rc, "test_Files.ASE", 2, 1, 1, RED, NULL, NULL));
    assert_warned("offset");
    remove("test_Files.ASE");
}

TEST(ase_with_normals_and_two_meshes) {
    char text[4096];
    snprintf(text, sizeof text, "%s%s\t}\n}\n%s\t}\n}\n", square, normals, square);
    RGraphic *g = load(text);
    ck_assert_ptr_nonnull(g);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 12);
    assert_near(g->m_pVertices[0].m_NY, 1, 0); /* Normalized. */
    assert_near(g->m_pVertices[1].m_NX, 1, 0);
    assert_near(g->m_pVertices[2].m_NZ, -1, 0);
    assert_near(g->m_pVertices[3].m_NZ, 1, 0); /* Given for the first face only. */
}

TEST(ase_broken) {
    static const char *const texts[] = {
        "",
        "no ASE file at all",
        "*MESH { *MESH_VERTEX 0 1 2",
        "*MESH { *MESH_VERTEX 5 1 2 3 }",
        "*MESH { *MESH_VERTEX 0 1 2 nan }",
        "*MESH { *MESH_VERTEX -1 1 2 3 }",
        "*MESH { *MESH_VERTEX 0 1 2 3 *MESH_FACE 0: A: 0 B: 1 C: 2 }",
        "*MESH { *MESH_VERTEX 0 1 2 3 *MESH_FACE 0: A: 0 C: 0 B: 0 }",
        "*MESH { *MESH_TFACE 0 0 0 0 }",
        "*MESH { *MESH_VERTEX 99999999999999999999 1 2 3 }",
        "*MESH \"never closed",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        ck_assert_ptr_null(load(texts[i]));
        ck_assert_int_eq(caught.warnings, 1);
        assert_warned("test_Files.ASE");
    }
    ck_assert_ptr_null(RGraphicLoadASE(rc, "no such file.ASE", 1, 1, 1, RED, NULL));
    assert_warned("no such file.ASE");
    ck_assert_ptr_null(RGraphicLoadASE(rc, "/", 1, 1, 1, RED, NULL));
    assert_warned("cannot be read");
    ck_assert_ptr_null(RGraphicLoadASE(rc, NULL, 1, 1, 1, RED, NULL));
    assert_warned("filename");
    ck_assert_ptr_null(RGraphicLoadASE(rc, "x", 1, 0, 1, RED, NULL));
    assert_warned("scale");
}

TEST(ase_normalized) {
    make_file("test_Files.ASE", square, strlen(square));
    RGraphic *g = RGraphicCreate(rc, "test_Files.ASE", 4, 2, 1, RED, NULL, 1, 1);
    remove("test_Files.ASE");
    ck_assert_ptr_nonnull(g);
    ck_assert_ptr_eq(rc->m_p2DGraphics, g);
    assert_near(g->m_pVertices[2].m_X, 2, 0);
    assert_near(g->m_pVertices[2].m_Y, 1, 0);
}

/* A .bmp file of 3 x 2 pixels; the lowest row first, blue before green before red, rows of 12 bytes. */
static void makeBmp(const char *name, int bits, int height, size_t size) {
    unsigned char b[54 + 24] = {'B', 'M', [10] = 54, [14] = 40, [18] = 3, [26] = 1};
    b[28] = (unsigned char)bits;
    for (int i = 0; i < 4; i++)
        b[22 + i] = (unsigned char)((unsigned)height >> 8 * i);
    b[54] = 10, b[55] = 20, b[56] = 30;             /* Lower left. */
    b[66 + 6] = 40, b[66 + 7] = 50, b[66 + 8] = 60; /* Upper right. */
    make_file(name, b, size);
}

TEST(bmp) {
    RPicture p;
    makeBmp("test_Files.bmp", 24, 2, 78);
    ck_assert(r_texturePicture("test_Files", &p));
    ck_assert(p.width == 3 && p.height == 2);
    ck_assert(p.rgba[12] == 30 && p.rgba[13] == 20 && p.rgba[14] == 10 && p.rgba[15] == 255);
    ck_assert(p.rgba[8] == 60 && p.rgba[9] == 50 && p.rgba[10] == 40);
    r_free(p.rgba);
    makeBmp("test_Files.bmp", 24, -2, 78); /* The highest row first. */
    ck_assert(r_texturePicture("test_Files", &p));
    ck_assert(p.rgba[0] == 30 && p.rgba[20] == 60);
    r_free(p.rgba);
    remove("test_Files.bmp");
}

TEST(bmp_broken) {
    RPicture p;
    static const struct {
        int bits, height;
        size_t size;
        const char *said;
    } broken[] = {
        {5, 2, 78, "test_Files.bmp"},      {24, 2, 70, "short"},         {24, 0, 78, "size"}, {24, 5000, 78, "size"},
        {24, (int)0x80000000, 78, "size"}, {24, 2, 20, "test_Files.bmp"}};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        makeBmp("test_Files.bmp", broken[i].bits, broken[i].height, broken[i].size);
        ck_assert(!r_imageRead("test_Files.bmp", &p));
        assert_warned(broken[i].said);
    }
    remove("test_Files.bmp");
    ck_assert(!r_texturePicture("test_Files", &p)); /* A file that is not there is a message, and no warning. */
}

TEST(png_as_a_texture) {
    uint8_t pixels[2 * 2 * 4] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 8, 7, 255};
    const RPicture written = {2, 2, pixels};
    RPicture p;
    ck_assert(r_writePng("test_Files.png", &written));
    ck_assert(r_texturePicture("test_Files", &p));
    ck_assert(p.width == 2 && p.height == 2);
    ck_assert_mem_eq(p.rgba, pixels, sizeof pixels);
    r_free(p.rgba);
    ck_assert_int_eq(truncate("test_Files.png", 60), 0);
    ck_assert(!r_imageRead("test_Files.png", &p));
    assert_warned("test_Files.png");
    make_file("test_Files.png", "no picture at all", 17);
    ck_assert(!r_imageRead("test_Files.png", &p));
    assert_warned("test_Files.png");
    remove("test_Files.png");
    ck_assert(!r_imageRead("test_Files.png", &p));
}

TEST(textures_in_their_own_directory) {
    char directory[] = "test_Files.XXXXXX", path[64];
    RPicture p;
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/elsewhere.bmp", directory);
    makeBmp(path, 24, 2, 78);
    setenv("KARMA_TEXTURES", directory, 1);
    ck_assert(r_texturePicture("elsewhere", &p));
    r_free(p.rgba);
    unsetenv("KARMA_TEXTURES");
    remove(path);
    rmdir(directory);
}

TEST(built_in_textures) {
    RPicture p;
    ck_assert(r_texturePicture("checkerboard", &p));
    ck_assert(p.rgba[0] != p.rgba[4 * 32]);
    r_free(p.rgba);
    ck_assert(r_texturePicture("font", &p));
    int ink = 0;
    for (int i = 0; i < p.width * p.height; i++)
        ink += p.rgba[4 * i + 3] == 255;
    ck_assert_int_gt(ink, 1000);
    r_free(p.rgba);
}

TEST(png) {
    uint8_t pixels[2 * 2 * 4] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255};
    const RPicture p = {2, 2, pixels};
    ck_assert(r_writePng("test_Files.png", &p));
    ck_assert_int_eq(remove("test_Files.png"), 0);
    ck_assert(!r_writePng("no/such/directory/test_Files.png", &p));
    assert_warned("no/such/directory");
    if (access("/dev/full", W_OK) == 0) {
        ck_assert(!r_writePng("/dev/full", &p));
        assert_warned("/dev/full");
    }
}
