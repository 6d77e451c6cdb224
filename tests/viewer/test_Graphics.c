/* Graphics as objects: lists, colours, changes to vertices, lines, textures, lights; and all memory given back. */
#include "viewer_test.h"

static RRender *rc;

static void setup(void) {
    rc = make_context("-null");
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

static int length3D(void) {
    int n = 0;
    for (const RGraphic *g = rc->m_p3DGraphics; g; g = g->m_pNext)
        n++;
    return n;
}

TEST(creating_puts_into_the_list) {
    RGraphic *a = RGraphicSphereCreate(rc, 1, RED, NULL), *b = RGraphicBoxCreate(rc, 1, 2, 3, RED, NULL);
    RGraphic *c = RGraphicTorusCreate(rc, 1, 2, RED, NULL), *d = RGraphic2DRectangleCreate(rc, 0, 0, 1, 1, RED);
    ck_assert_ptr_eq(rc->m_p3DGraphics, a);
    ck_assert_ptr_eq(a->m_pNext, b);
    ck_assert_ptr_eq(b->m_pNext, c);
    ck_assert_ptr_eq(rc->m_p2DGraphics, d);
    RGraphicRemoveFromList(rc, b, 0);
    ck_assert_ptr_eq(a->m_pNext, c);
    ck_assert_ptr_eq(c->m_pPrev, a);
    ck_assert_int_eq(length3D(), 2);
    RGraphicAddToList(rc, b, 0);
    ck_assert_ptr_eq(c->m_pNext, b);
    RGraphicDelete(rc, a, 0);
    ck_assert_ptr_eq(rc->m_p3DGraphics, c);
    RGraphicDestroy(b); /* Still in the list: leaves it first. */
    ck_assert_ptr_null(c->m_pNext);
    RGraphicDelete(rc, d, 1);
    ck_assert_ptr_null(rc->m_p2DGraphics);
    ck_assert_int_eq(length3D(), 1);
}

TEST(wrong_lists_are_refused) {
    RGraphic *a = RGraphicSphereCreate(rc, 1, RED, NULL), *empty = RGraphicCreateEmpty(3);
    RGraphicAddToList(rc, a, 0);
    assert_warned("already");
    RGraphicRemoveFromList(rc, a, 1);
    assert_warned("2D");
    RGraphicDelete(rc, empty, 0);
    assert_warned("3D");
    ck_assert_int_eq(length3D(), 1);
    RGraphicDestroy(empty);
}

TEST(an_empty_graphic_is_white_and_has_room) {
    RGraphic *g = RGraphicCreateEmpty(6);
    float color[4];
    ck_assert_int_eq(g->m_nMaxNumVertices, 6);
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 6);
    ck_assert_int_eq(g->m_pObject->m_nTextureID, -1);
    ck_assert_ptr_eq(g->m_pVertices, (void *)(g->m_pObject + 1)); /* The vertices follow the header. */
    assert_near(g->m_pObject->m_Matrix[2][2], 1, 0);
    RGraphicGetColor(g, color);
    assert_near(color[3], 1, 0);
    ck_assert_ptr_null(g->m_pNext);
    RGraphicDestroy(g);
    ck_assert_ptr_null(RGraphicCreateEmpty(4));
    assert_warned("multiple of 3");
    ck_assert_ptr_null(RGraphicCreateEmpty(-3));
    assert_warned("multiple of 3");
}

TEST(colours) {
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, NULL);
    float color[4];
    g->m_pObject->m_ColorEmissive[1] = g->m_pObject->m_ColorSpecular[2] = 1;
    RGraphicSetColor(g, GREEN);
    RGraphicGetColor(g, color);
    for (int i = 0; i < 4; i++) {
        assert_near(color[i], GREEN[i], 0);
        assert_near(g->m_pObject->m_ColorDiffuse[i], GREEN[i], 0);
        assert_near(g->m_pObject->m_ColorEmissive[i], 0, 0);
        assert_near(g->m_pObject->m_ColorSpecular[i], 0, 0);
    }
    g->m_pObject->m_ColorAmbient[0] = 0.5f; /* GetColor gives the ambient one. */
    RGraphicGetColor(g, color);
    assert_near(color[0], 0.5f, 0);
    RGraphicSetColor(g, BROKEN);
    assert_warned("color[1]");
    assert_near(g->m_pObject->m_ColorDiffuse[1], GREEN[1], 0);
}

TEST(transforms) {
    MeMatrix4 m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {5, 6, 7, 1}};
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, m);
    ck_assert_ptr_eq(g->m_matrix, m); /* The other name of the same pointer. */
    RRenderUpdateGraphicMatrices(rc);
    assert_near(g->m_pObject->m_Matrix[3][1], 6, 0);
    m[3][1] = 8;
    RRenderUpdateGraphicMatrices(rc);
    assert_near(g->m_pObject->m_Matrix[3][1], 8, 0);
    RGraphicSetTransformPtr(g, NULL);
    RRenderUpdateGraphicMatrices(rc);
    assert_near(g->m_pObject->m_Matrix[3][1], 0, 0);
}

TEST(scaling_and_moving_vertices) {
    RGraphic *g = RGraphicBoxCreate(rc, 2, 2, 2, RED, NULL);
    const MeVector3 offset = {1, 0, 0};
    AcmeReal low = INFINITY, high = -INFINITY;
    RGraphicScale(g, 1, 2, 3);
    RGraphicTranslateVertices(rc, g, offset);
    for (int i = 0; i < 36; i++) {
        const RObjectVertex *v = &g->m_pVertices[i];
        low = fminf(low, v->m_X);
        high = fmaxf(high, v->m_Z);
        assert_near(v->m_NX * v->m_NX + v->m_NY * v->m_NY + v->m_NZ * v->m_NZ, 1, 1e-6);
    }
    assert_near(low, 0, 0);
    assert_near(high, 3, 0);
    RGraphicNormalize(g, 1); /* 2 x 4 x 6 becomes 1/3 x 2/3 x 1. */
    high = low = 0;
    for (int i = 0; i < 36; i++) {
        low = fmaxf(low, g->m_pVertices[i].m_X);
        high = fmaxf(high, g->m_pVertices[i].m_Z);
    }
    assert_near(low, 1.0 / 6, 1e-6);
    assert_near(high, 0.5, 1e-6);
    RGraphicNormalize(g, 0);
    for (int i = 0; i < 36; i++)
        assert_near(fabsf(g->m_pVertices[i].m_X), 0.5, 1e-6);
    assert_refused(RGraphicScale, g, 0, 1, 1);
    RGraphic *empty = RGraphicCreateEmpty(3);
    RGraphicNormalize(empty, 1);
    assert_warned("one place");
    RGraphicDestroy(empty);
}

TEST(combining) {
    MeMatrix4 m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {10, 0, 0, 1}};
    RGraphic *a = RGraphicBoxCreate(rc, 1, 1, 1, RED, NULL), *b = RGraphicSphereCreate(rc, 1, GREEN, NULL);
    RGraphic *both = RGraphicCombine(rc, a, b, m);
    const int na = a->m_pObject->m_nNumVertices, nb = b->m_pObject->m_nNumVertices;
    ck_assert_int_eq(both->m_pObject->m_nNumVertices, na + nb);
    assert_near(both->m_pVertices[na].m_X, b->m_pVertices[0].m_X + 10, 0);
    assert_near(both->m_pVertices[0].m_X, a->m_pVertices[0].m_X, 0);
    assert_near(both->m_pObject->m_ColorDiffuse[0], RED[0], 0);
    ck_assert_int_eq(length3D(), 3);
}

TEST(strips_become_triangles) {
    RObjectVertex strip[7];
    int sizes[2] = {4, 3}, starts[2] = {0, 4};
    RGraphic *g = RGraphicCreateEmpty(9);
    memset(strip, 0, sizeof strip);
    for (int i = 0; i < 7; i++)
        strip[i].m_X = (AcmeReal)i;
    RConvertTriStripToTriList(g, strip, sizes, starts, 2);
    const int expected[9] = {0, 1, 2, 2, 1, 3, 4, 5, 6}; /* All triangles turn the same way. */
    ck_assert_int_eq(g->m_pObject->m_nNumVertices, 9);
    for (int i = 0; i < 9; i++)
        assert_near(g->m_pVertices[i].m_X, expected[i], 0);
    sizes[0] = 5;
    RConvertTriStripToTriList(g, strip, sizes, starts, 2);
    assert_warned("room");
    sizes[0] = -1;
    RConvertTriStripToTriList(g, strip, sizes, starts, 2);
    assert_warned("negative");
    RGraphicDestroy(g);
}

TEST(lines_as_graphics) {
    const AcmeReal a[3] = {1, 2, 3}, b[3] = {4, 5, 6}, bad[3] = {0, INFINITY, 0};
    RGraphic *line = RGraphicLineCreate(rc, a, b, RED, NULL), *box = RGraphicBoxCreate(rc, 1, 1, 1, RED, NULL);
    ck_assert_int_eq(RGraphicLineMoveEnds(line, b, a), 0);
    assert_near(line->m_pVertices[0].m_X, 4, 0);
    assert_near(line->m_pVertices[1].m_X, 1, 0);
    ck_assert_int_eq(RGraphicLineMoveEnds(box, a, b), 1);
    assert_warned("not a line");
    ck_assert_int_eq(RGraphicLineMoveEnds(NULL, a, b), 1);
    assert_warned("null");
    ck_assert_int_eq(RGraphicLineMoveEnds(line, bad, b), 1);
    assert_warned("origin[1]");
    assert_near(line->m_pVertices[0].m_X, 4, 0);
}

TEST(native_lines) {
    const AcmeReal a[3] = {1, 2, 3}, b[3] = {4, 5, 6};
    const AcmeVector3 p = {0, 0, 0}, q = {1, 1, 1};
    RNativeLine *first = RNLineCreate(rc, a, b, RED, NULL), *second = RNLineCreate(rc, a, b, RED, NULL);
    RNativeLine *third = RNLineCreate(rc, a, b, RED, NULL);
    RNLineMoveEnds(first, b, a);
    assert_near(first->m_Vectors.m_Start[0], 4, 0);
    RNLineSetColor(first, GREEN);
    assert_near(first->m_Color[1], GREEN[1], 0);
    RNLineRemoveFromList(rc, second);
    ck_assert_ptr_eq(first->m_pNext, third);
    RNLineRemoveFromList(rc, second);
    assert_warned("not in the context's list");
    RNLineAddToList(rc, second);
    ck_assert_ptr_eq(third->m_pNext, second);
    RNLineAddToList(rc, second);
    assert_warned("already");
    RNLineDelete(rc, second); /* The last one: another can still be added after it. */
    RNLineDestroy(first);
    RNativeLine *fourth = RNLineCreate(rc, a, b, RED, NULL);
    ck_assert_ptr_eq(rc->m_pNativeLines, third);
    ck_assert_ptr_eq(third->m_pNext, fourth);
    for (int i = 0; i < 1000; i++)
        RLineAdd(rc, p, q, 1, 0, 0);
    RLineRemoveAll(rc);
    RLineAdd(rc, p, q, NAN, 0, 0);
    assert_warned("color");
    assert_refused(RNLineMoveEnds, NULL, a, b);
}

TEST(texture_numbers) {
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, NULL);
    char name[16];
    ck_assert_int_eq(RGraphicSetTexture(rc, g, "checkerboard"), 0);
    ck_assert_int_eq(g->m_pObject->m_nTextureID, 0);
    ck_assert_int_eq(RRenderTextureCreate(rc, "checkerboard"), 0);
    for (int i = 1; i < 100; i++) {
        snprintf(name, sizeof name, "texture%d", i);
        ck_assert_int_eq(RRenderTextureCreate(rc, name), i);
    }
    ck_assert_int_eq(RGraphicSetTexture(rc, g, "one too many"), -1);
    assert_warned("100");
    ck_assert_int_eq(g->m_pObject->m_nTextureID, -1);
    ck_assert_int_eq(RGraphicSetTexture(rc, g, "texture7"), 7);
    ck_assert_int_eq(RGraphicSetTexture(rc, g, NULL), -1);
    ck_assert_int_eq(g->m_pObject->m_nTextureID, -1);
}

TEST(light_switches) {
    rc->m_bForceDirectLight2Update = rc->m_bForcePointLightUpdate = 0;
    RLightSwitchOff(rc, kRAmbient);
    RLightSwitchOff(rc, kRDirect2);
    RLightSwitchOn(rc, kRPoint);
    ck_assert_int_eq(rc->m_bUseAmbientLight, 0);
    ck_assert_int_eq(rc->m_DirectLight1.m_bUseLight, 1);
    ck_assert_int_eq(rc->m_DirectLight2.m_bUseLight, 0);
    ck_assert_int_eq(rc->m_PointLight.m_bUseLight, 1);
    ck_assert_int_ne(rc->m_bForceDirectLight2Update, 0);
    ck_assert_int_ne(rc->m_bForcePointLightUpdate, 0);
    RLightSwitchOn(rc, (RRenderLight)9);
    assert_warned("9");
}

TEST(wireframe_and_resolution) {
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, NULL);
    ck_assert_int_eq(RGraphicIsWireframe(g), 0);
    RGraphicSetWireframe(g, 5);
    ck_assert_int_eq(RGraphicIsWireframe(g), 1);
    ck_assert_int_eq(RRenderGetSphereResolution(rc), 48);
    ck_assert_int_eq(g->m_nMaxNumVertices, 6 * 48 * 23);
    RRenderSetSphereResolution(rc, 16);
    ck_assert_int_eq(RGraphicSphereCreate(rc, 1, RED, NULL)->m_nMaxNumVertices, 6 * 16 * 7);
    RRenderSetSphereResolution(rc, 4);
    assert_warned("res");
    ck_assert_int_eq(RRenderGetSphereResolution(rc), 16);
}

TEST(bad_sizes) {
    struct {
        RGraphic *made;
        const char *argument;
    } tries[] = {{RGraphicSphereCreate(rc, -1, RED, NULL), "radius"},
                 {RGraphicSphereCreate(rc, NAN, RED, NULL), "radius"},
                 {RGraphicSphereCreate(NULL, 1, RED, NULL), "null"},
                 {RGraphicSphereCreate(rc, 1, NULL, NULL), "color"},
                 {RGraphicSphereCreate(rc, 1, BROKEN, NULL), "color[1]"},
                 {RGraphicBoxCreate(rc, 1, 0, 1, RED, NULL), "height"},
                 {RGraphicConeCreate(rc, 1, 1, -1, RED, NULL), "lower_height"},
                 {RGraphicCylinderCreate(rc, 1, INFINITY, RED, NULL), "height"},
                 {RGraphicFrustumCreate(rc, 1, -2, 0, 1, 6, RED, NULL), "Radius"},
                 {RGraphicFrustumCreate(rc, 1, 1, 0, 1, 2, RED, NULL), "sides"},
                 {RGraphicTorusCreate(rc, 2, 1, RED, NULL), "outerRadius"},
                 {RGraphicSphylCreate(rc, 1, -1, RED, NULL), "height"},
                 {RGraphicSquareCreate(rc, 0, RED, NULL), "side"},
                 {RGraphicGroundPlaneCreate(rc, 24, 0, RED, 0), "triangles_per_side"},
                 {RGraphicGroundPlaneCreate(rc, 24, 2, RED, NAN), "y_position"},
                 {RGraphic2DRectangleCreate(rc, 0, 0, -1, 1, RED), "width"},
                 {RGraphicTextCreate(rc, NULL, 0, 0, RED), "text"}};
    for (size_t i = 0; i < sizeof tries / sizeof tries[0]; i++)
        ck_assert_ptr_null(tries[i].made);
    ck_assert_int_eq(caught.warnings, (int)(sizeof tries / sizeof tries[0]));
    assert_warned("text");
    ck_assert_int_eq(length3D(), 0);
    ck_assert_ptr_null(rc->m_p2DGraphics);
    assert_refused(RGraphicDestroy, NULL);
    assert_refused(RGraphicSetColor, NULL, RED);
}

/* ---- Memory ---- */

static long blocks;

static void *MEAPI countCreate(size_t bytes) {
    blocks++;
    return malloc(bytes ? bytes : 1);
}

static void MEAPI countDestroy(void *const block) {
    blocks -= block != NULL;
    free(block);
}

/* Every particle is a triangle round its position that faces the camera. */
TEST(particles_face_the_camera) {
    static MeVector3 at[2] = {{1, 2, 3}, {4, NAN, 6}};
    RParticleSystem *ps = RParticleSystemNew(2, at, -1, RED, 0.5f);
    ck_assert_ptr_nonnull(ps);
    ck_assert_ptr_null(rc->m_pParticleSystems);
    RParticleSystemAddToList(rc, ps);
    ck_assert_ptr_eq(rc->m_pParticleSystems, ps);
    ck_assert_ptr_eq(rc->m_p3DGraphics, ps->m_pGraphic);
    RParticleSystemAddToList(rc, ps);
    assert_warned("already");
    RParticleSystemRemoveFromList(rc, ps);
    ck_assert_ptr_null(rc->m_p3DGraphics);
    RParticleSystemRemoveFromList(rc, ps);
    assert_warned("not in");
    RParticleSystemDestroy(ps);
    ck_assert_ptr_null(RParticleSystemCreate(rc, 0, at, NULL, RED, 1));
    assert_warned("numParticles");
    ck_assert_ptr_null(RParticleSystemCreate(rc, 1, NULL, NULL, RED, 1));
    assert_warned("positions");
    ck_assert_ptr_null(RParticleSystemCreate(rc, 1, at, NULL, RED, 0));
    assert_warned("size");
    ck_assert_ptr_null(rc->m_p3DGraphics);
    RParticleSystemCreate(rc, 2, at, "checkerboard", RED, 1); /* Goes with the context. */
}

TEST(the_context_frees_everything) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    const char *const help[] = {"Space - jump"};
    const AcmeReal a[3] = {0, 0, 0}, b[3] = {1, 1, 1};
    const AcmeVector3 p = {0}, q = {1};
    MeMemoryAPI.create = countCreate;
    MeMemoryAPI.destroy = countDestroy;
    RRender *own = make_context("-null -key F1@3,Enter@4");
    RGraphicSphereCreate(own, 1, RED, NULL);
    RGraphicTextCreate(own, "text", 0, 0, RED);
    RNLineCreate(own, a, b, RED, NULL);
    static MeVector3 particle[1];
    RParticleSystemCreate(own, 1, particle, "font", RED, 1);
    RLineAdd(own, p, q, 1, 1, 1);
    RRenderCreateUserHelp(own, help, 1);
    RRenderSetWindowTitle(own, "title");
    RRenderSetStatusText(own, "status");
    RRenderTextureCreate(own, "checkerboard");
    RRenderSkydomeCreate(own, "checkerboard", 2, 1);
    RPerformanceBarCreate(own);
    RPerformanceBarCreateTicks(own);
    RMenuAddToggleEntry(RMenuCreate(own, "menu"), "entry", NULL, 1);
    ck_assert_int_gt(blocks, 15);
    ck_assert_int_eq(RRenderContextDestroy(own), 0);
    ck_assert_int_eq(blocks, 0);
    ck_assert_int_eq(RRenderContextDestroy(own), 1);
    assert_warned("destroyed");
    MeMemoryAPI = before;
}

TEST(a_context_can_be_looked_at_before_it_starts) {
    RRender *own = RRenderContextCreate2(NULL, NULL, 0, &blocks, NULL);
    ck_assert_ptr_null(own);
    assert_warned("pWnd");
    ck_assert_int_eq(RInit(rc), 0);
    assert_warned("already");
    assert_none(RInit, NULL);
}
