/* What is drawn, in an off-screen buffer: where things are, light and shadow, help, and that nothing is left to chance.
 * */
#include "viewer_test.h"

#include "RMenu.h"
#include "r_draw_i.h"

enum { WIDTH = 320, HEIGHT = 240 };

static RRender *rc;

static RPicture shots[64]; /* of the test */
static int numShots;

static void stop(void) {
    if (rc)
        RRenderContextDestroy(rc);
    rc = NULL;
    assert_silent();
}

/* A context until the next one, or the test's end. */
static void start(const char *options) {
    if (rc)
        stop();
    rc = make_context(options);
}

static void stopAndFree(void) {
    if (rc)
        stop();
    while (numShots > 0)
        r_free(shots[--numShots].rgba);
}
TEST_FIXTURE(NULL, stopAndFree)

static void drawFrame(void) {
    r_frame(rc, NULL);
    r_drawNow(rc);
}

/* Draws n frames and reads the last one. */
static RPicture shoot(int n) {
    RPicture p;
    while (n-- > 0)
        drawFrame();
    ck_assert(r_drawRead(rc, &p));
    ck_assert_int_lt(numShots, 64);
    return shots[numShots++] = p;
}

static void press(int key) {
    r_post(rc, (REvent){.kind = rKeyDown, .key = key});
    r_post(rc, (REvent){.kind = rKeyUp, .key = key});
}

static const uint8_t *pixel(const RPicture *p, double x, double y) {
    const int column = (int)floor(x), row = (int)floor(y);
    ck_assert(column >= 0 && column < p->width && row >= 0 && row < p->height);
    return p->rgba + 4 * (row * p->width + column);
}

static int brightness(const RPicture *p, const double at[2]) {
    const uint8_t *c = pixel(p, at[0], at[1]);
    return c[0] + c[1] + c[2];
}

static size_t differences(const RPicture *p, const RPicture *q) {
    size_t n = 0;
    ck_assert(p->width == q->width && p->height == q->height);
    for (int i = 0; i < p->width * p->height; i++)
        n += memcmp(p->rgba + 4 * i, q->rgba + 4 * i, 4) != 0;
    return n;
}

/* Where the camera sees a point: computed from its polar coordinates alone, as the guide defines them. */
static void project(const double view[3], const double at[3], const double p[3], const RPicture *picture,
                    double out[2]) {
    const double st = sin(view[1]), ct = cos(view[1]), sp = sin(view[2]), cp = cos(view[2]), fov = 0.7;
    const double right[3] = {ct, 0, -st}, up[3] = {-sp * st, cp, -sp * ct}, back[3] = {cp * st, sp, cp * ct};
    double x = 0, y = 0, z = view[0];
    for (int i = 0; i < 3; i++) {
        x += right[i] * (p[i] - at[i]);
        y += up[i] * (p[i] - at[i]);
        z -= back[i] * (p[i] - at[i]);
    }
    const double scale = 0.5 * picture->height / tan(fov / 2) / z;
    out[0] = 0.5 * picture->width + scale * x;
    out[1] = 0.5 * picture->height - scale * y;
}

/* From where the sphere's shadow, which falls away from the light, lies in front of the sphere. */
static const double view[3] = {9, 2.46, 0.6}, lookAt[3] = {0.3, 0.5, -0.2};
static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 1}};

static RGraphic *sphereOnGround(void) {
    const AcmeVector3 at = {(float)lookAt[0], (float)lookAt[1], (float)lookAt[2]};
    RCameraSetLookAt(rc, at);
    RCameraSetView(rc, (float)view[0], (float)view[1], (float)view[2]);
    RGraphicGroundPlaneCreate(rc, 24, 2, WHITE, 0);
    return RGraphicSphereCreate(rc, 1, BLUE, tm);
}

TEST(the_sphere_is_where_the_camera_sees_it) {
    double centre[2], left[2];
    start("-osmesa -size 320x240");
    sphereOnGround();
    RPicture p = shoot(3);
    ck_assert(p.width == WIDTH && p.height == HEIGHT);
    project(view, lookAt, (const double[3]){0, 1, 0}, &p, centre);
    const uint8_t *c = pixel(&p, centre[0], centre[1]);
    ck_assert_msg(c[2] > 100 && c[2] > 2 * c[0], "the sphere's middle is %d %d %d", c[0], c[1], c[2]);
    /* Just inside its outline, and just outside. */
    project(view, lookAt, (const double[3]){-0.92 * cos(view[1]), 1, 0.92 * sin(view[1])}, &p, left);
    c = pixel(&p, left[0], left[1]);
    ck_assert(c[2] > c[0] + 40);
    project(view, lookAt, (const double[3]){-1.1 * cos(view[1]), 1, 1.1 * sin(view[1])}, &p, left);
    c = pixel(&p, left[0], left[1]);
    ck_assert(abs(c[2] - c[0]) < 30);
}

TEST(the_transform_is_read_in_every_frame) {
    double before[2], after[2];
    start("-osmesa -size 320x240");
    sphereOnGround();
    RPicture p = shoot(1);
    project(view, lookAt, (const double[3]){0, 1, 0}, &p, before);
    tm[3][1] = 3;
    RPicture q = shoot(1);
    tm[3][1] = 1;
    project(view, lookAt, (const double[3]){0, 3, 0}, &q, after);
    const uint8_t *c = pixel(&q, after[0], after[1]);
    ck_assert(c[2] > 100 && c[2] > 2 * c[0]);
    c = pixel(&q, before[0], before[1]);
    ck_assert(abs(c[2] - c[0]) < 30);
}

TEST(a_shadow_falls_on_the_ground) {
    double shadow[2], lit[2], contact[2];
    start("-osmesa -size 320x240");
    sphereOnGround();
    RPicture p = shoot(2);
    /* The light comes from (-0.45, 1, 0.55): the shadow's middle is at (0.45, 0, -0.55). Halfway to its far edge, and
     * as
       far from the sphere to the side. */
    project(view, lookAt, (const double[3]){0.9, 0, -1.1}, &p, shadow);
    project(view, lookAt, (const double[3]){1.1 + 0.45, 0, 0.9 - 0.55}, &p, lit);
    ck_assert_msg(brightness(&p, shadow) < 0.8 * brightness(&p, lit), "shadow %d, light %d", brightness(&p, shadow),
                  brightness(&p, lit));
    /* Without shadows it is as bright there, but for the grid. F5 brings them back. */
    press(RKEY_F5);
    RPicture q = shoot(1);
    ck_assert(brightness(&q, shadow) > 0.9 * brightness(&q, lit));
    press(RKEY_F5);
    RPicture r = shoot(1);
    ck_assert_uint_eq(differences(&p, &r), 0);
    /* Where the sphere touches the ground, the sky is hidden too. */
    project(view, lookAt, (const double[3]){0.32, 0, -0.39}, &p, contact);
    ck_assert(brightness(&p, contact) < brightness(&p, shadow));
}

TEST(outlines_are_smooth) {
    double centre[2];
    start("-osmesa -size 320x240");
    RCameraSetView(rc, 6, 0, 0);
    RGraphicSphereCreate(rc, 1, BLUE, NULL);
    RPicture p = shoot(1);
    project((const double[3]){6, 0, 0}, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 0}, &p, centre);
    /* In each row through the sphere: a pixel at the outline that is neither inside nor outside. */
    int rows = 0, between = 0;
    for (int y = HEIGHT / 2 - 40; y < HEIGHT / 2 + 40; y++, rows++) {
        int x = 1;
        while (pixel(&p, x, y)[0] > 140) /* The background is light, the sphere is blue. */
            x++;
        const int edge = pixel(&p, x - 1, y)[0], outside = pixel(&p, x - 3, y)[0], inside = pixel(&p, x + 2, y)[0];
        const int second = pixel(&p, x, y)[0];
        between += (edge < outside - 8 && edge > inside + 8) || (second < outside - 8 && second > inside + 8);
    }
    ck_assert_msg(between > rows / 2, "%d of %d rows", between, rows);
}

TEST(the_same_picture_twice) {
    RPicture p[2];
    for (int i = 0; i < 2; i++) {
        start("-osmesa -size 320x240");
        sphereOnGround();
        RGraphicBoxCreate(rc, 1, 1, 1, RED, NULL);
        RGraphicTextCreate(rc, "text", -0.9f, 0.9f, RED);
        p[i] = shoot(3);
        stop();
    }
    ck_assert_uint_eq(differences(&p[0], &p[1]), 0);
}

TEST(f1_shows_and_hides_the_help) {
    char *help[] = {"$ACTION2 - start again"};
    start("-osmesa -size 320x240");
    sphereOnGround();
    RRenderCreateUserHelp(rc, help, 1);
    RPicture p = shoot(2);
    press(RKEY_F1);
    RPicture q = shoot(1);
    ck_assert_int_eq(rc->m_bPause, 1);
    ck_assert_uint_gt(differences(&p, &q), WIDTH * HEIGHT / 3);
    press(RKEY_F1);
    RPicture r = shoot(1);
    ck_assert_int_eq(rc->m_bPause, 0);
    ck_assert_uint_eq(differences(&p, &r), 0);
}

TEST(help_is_inside_the_picture) {
    static const char *const sizes[] = {"-osmesa -size 320x240", "-osmesa -size 960x600", "-osmesa -size 1920x1200"};
#ifdef TEST_IS_SLOW
    enum { SIZES = 2 };
#else
    enum { SIZES = 3 };
#endif
    for (int n = 0; n < SIZES; n++) {
        start(sizes[n]);
        sphereOnGround();
        RPicture p = shoot(1);
        press(RKEY_F1);
        RPicture q = shoot(1);
        const RHelpLayout *l = &rc->m_pViewer->helpLayout;
        int changed = 0, light = 0, outside = 0;
        for (int i = 0; i < p.width * p.height; i++) {
            const uint8_t *a = p.rgba + 4 * i, *b = q.rgba + 4 * i;
            const int x = i % p.width, y = i / p.width;
            if (memcmp(a, b, 3) == 0)
                continue;
            changed++;
            light += b[0] > 200 && b[1] > 200 && b[2] > 200;
            outside += x < (int)l->left - 2 || x > (int)l->right + 1 || y < (int)l->top - 2 || y > (int)l->bottom + 1;
        }
        ck_assert_int_eq(outside, 0);
        ck_assert(l->left > 0 && l->top > 0 && l->right < (float)p.width && l->bottom < (float)p.height);
        ck_assert_int_gt(light, changed / 200); /* Light text. */
        ck_assert_int_lt(light, changed / 4);
        stop();
    }
}

/* The picture's middle in front of a light background, with what `make` creates there. */
static void middle(void (*make)(void), int rgb[3]) {
    start("-osmesa -size 64x64");
    RCameraSetView(rc, 6, 0, 0);
    make();
    RPicture p = shoot(1);
    for (int k = 0; k < 3; k++)
        rgb[k] = pixel(&p, 32, 32)[k];
}

static void makeNothing(void) {}

static void makeAlpha0(void) {
    const float red[4] = {1, 0, 0, 0};
    RGraphicSphereCreate(rc, 1, red, NULL);
}

static void makeGlass(void) {
    const float red[4] = {1, 0, 0, 0.4f};
    RGraphicSphereCreate(rc, 1, red, NULL);
}

static void makeRemoved(void) {
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, NULL);
    RGraphicRemoveFromList(rc, g, 0);
    RGraphicDestroy(g);
}

static void makeLine(void) {
    const AcmeReal a[3] = {-5, 0, 0}, b[3] = {5, 0, 0};
    RNLineCreate(rc, a, b, RED, NULL);
}

static void makeAddedLine(void) {
    const AcmeVector3 a = {0, 0, -5}, b = {0.6f, 0, 100}; /* Ends behind the camera. */
    RLineAdd(rc, a, b, 1, 0, 0);
}

static void makeSquareFromBehind(void) {
    RGraphicSquareCreate(rc, 2, RED, NULL);
    RCameraRotateAngle(rc, 3.14159265f);
}

static void make2D(void) {
    RGraphic2DRectangleCreate(rc, -0.5f, 0.5f, 1, 1, RED);
}

static void makeUnlit(void) {
    const float dark[4] = {0, 0, 0, 1};
    RGraphic *g = RGraphicSphereCreate(rc, 1, dark, NULL);
    g->m_pObject->m_ColorEmissive[0] = 1;
}

static void makeSky(void) {
    RRenderSkydomeCreate(rc, "checkerboard", 4, 4);
    RCameraSetView(rc, 6, 0, -0.5f);
}

TEST(what_is_seen_in_the_middle) {
    int back[3], c[3];
    middle(makeNothing, back);
    ck_assert(back[0] > 180 && back[2] >= back[0]);
    middle(makeAlpha0, c); /* Old programs write 0 and mean opaque. */
    ck_assert(c[0] > 120 && c[1] < 90 && c[2] < 90);
    middle(makeGlass, c);
    ck_assert(c[0] > 150 && c[1] > 90 && c[1] < back[1] - 20);
    middle(makeRemoved, c);
    ck_assert(abs(c[0] - back[0]) <= 1 && abs(c[2] - back[2]) <= 1);
    middle(makeLine, c);
    ck_assert(c[0] > c[1] + 40);
    middle(makeAddedLine, c);
    ck_assert(c[0] > c[1] + 40);
    middle(makeSquareFromBehind, c);
    ck_assert(c[0] > c[1] + 40);
    middle(make2D, c);
    ck_assert(abs(c[0] - 204) < 3 && abs(c[1] - 26) < 3);
    middle(makeUnlit, c);
    ck_assert(c[0] > 200 && c[1] < 100);
    middle(makeSky, c);
    ck_assert(abs(c[0] - c[2]) <= 2); /* Grey, and not the bluish sky. */
}

TEST(vertices_may_change) {
    start("-osmesa -size 64x64");
    RCameraSetView(rc, 6, 0, 0);
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, NULL);
    RPicture p = shoot(1);
    ck_assert(pixel(&p, 32, 32)[1] < 90);
    for (int i = 0; i < g->m_pObject->m_nNumVertices; i++)
        g->m_pVertices[i].m_X += 10;
    p = shoot(1);
    ck_assert(pixel(&p, 32, 32)[1] > 150);
    for (int i = 0; i < 100; i++) { /* Another mesh in every frame: old ones are forgotten. */
        g->m_pVertices[0].m_X = (AcmeReal)i;
        drawFrame();
    }
    g->m_pObject->m_nNumVertices = 0;
    drawFrame();
    assert_silent();
    g->m_pObject->m_nNumVertices = g->m_nMaxNumVertices + 3;
    drawFrame();
    drawFrame();
    ck_assert_int_eq(caught.warnings, 1);
    assert_warned("vertices");
}

TEST(what_is_not_finite_is_not_drawn) {
    MeMatrix4 bad = {{1, 0, 0, 0}, {0, NAN, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    start("-osmesa -size 64x64");
    RCameraSetView(rc, 6, 0, 0);
    RGraphic *g = RGraphicSphereCreate(rc, 1, RED, bad), *h = RGraphicBoxCreate(rc, 1, 1, 1, RED, NULL);
    h->m_pVertices[7].m_Y = INFINITY;
    RPicture p = shoot(3);
    ck_assert(pixel(&p, 32, 32)[1] > 150);
    ck_assert_int_eq(caught.warnings, 2); /* Once for each. */
    caught.warnings = 0;
    bad[1][1] = 1;
    p = shoot(1);
    ck_assert(pixel(&p, 32, 32)[1] < 90);
    RGraphicDestroy(g);
}

static RPicture lastPicture;

/* How much of the picture a change of something changes; all are made one after the other. */
static double changed(void (*change)(void)) {
    change();
    const RPicture p = shoot(1);
    const double n = (double)differences(&p, &lastPicture) / (WIDTH * HEIGHT);
    lastPicture = p;
    return n;
}

static void noChange(void) {}

static void moveUnflaggedLight(void) {
    rc->m_DirectLight1.m_Direction[0] = 5;
}

static void moveFlaggedLight(void) {
    moveUnflaggedLight();
    rc->m_bForceDirectLight1Update = 1;
}

static void switchPoint(void) {
    RLightSwitchOn(rc, kRPoint);
}

static void dimAmbient(void) {
    rc->m_rgbAmbientLightColor[0] = 0;
}

static void switchFill(void) {
    RLightSwitchOff(rc, kRDirect2);
}

static void wireframe(void) {
    press(RKEY_F4);
}

static void flat(void) {
    rc->m_Quality = kRQualityFlat;
}

static void filled(void) {
    rc->m_Quality = kRFilled;
}

static void checkered(void) {
    RGraphicSetTexture(rc, rc->m_p3DGraphics, "checkerboard");
}

static void missingTexture(void) {
    RGraphicSetTexture(rc, rc->m_p3DGraphics->m_pNext, "there is no such texture");
}

static void menu(void) {
    RMenu *m = RMenuCreate(rc, "Menu");
    RMenuAddToggleEntry(m, "entry", NULL, 1);
    RMenuDisplay(m);
}

static void status(void) {
    RRenderSetStatusText(rc, "12 bodies");
}

static void fps(void) {
    RRenderDisplayFps(rc, 60);
}

static void background(void) {
    RRenderSetBackgroundColor(rc, RED);
}

static void bar(void) {
    RPerformanceBarCreate(rc);
    RPerformanceBarCreateTicks(rc);
}

static void startChanges(void) {
    start("-osmesa -size 320x240");
    sphereOnGround();
    lastPicture = shoot(1);
}

TEST(changes_are_seen) {
    startChanges();
    ck_assert(changed(noChange) == 0);
    ck_assert(changed(moveUnflaggedLight) == 0);
    assert_below(0.05, changed(moveFlaggedLight));
    assert_below(0.1, changed(switchPoint));
    assert_below(0.1, changed(dimAmbient));
    assert_below(0.1, changed(switchFill));
    assert_below(0.2, changed(checkered));
    assert_below(0.01, changed(flat));
    assert_below(0.05, changed(menu));
    assert_below(0.003, changed(status));
    assert_below(0.003, changed(fps));
    assert_below(0.02, changed(background));
    ck_assert(changed(bar) == 0); /* Only with -bar. */
    assert_below(0.3, changed(filled));
    assert_below(0.03, changed(wireframe));
}

static MeMatrix4 turned = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

/* How much of the picture is another one when a graphic has turned, by 40 degrees about y. */
static double seenToTurn(RGraphic *(*make)(void), const char *texture) {
    MeMatrix4TMMakeIdentity(turned);
    start("-osmesa -size 320x240");
    RCameraSetView(rc, 5, 0.3f, 0.4f);
    RGraphic *g = make();
    if (texture)
        RGraphicSetTexture(rc, g, texture);
    RPicture p = shoot(1);
    turned[0][0] = turned[2][2] = MeCos(0.7);
    turned[0][2] = -(turned[2][0] = MeSin(0.7));
    RPicture q = shoot(1);
    size_t clearly = 0;
    for (int i = 0; i < p.width * p.height; i++)
        clearly += abs(p.rgba[4 * i] - q.rgba[4 * i]) > 10;
    stop();
    return (double)clearly / (WIDTH * HEIGHT);
}

static RGraphic *makeBall(void) {
    return RGraphicSphereCreate(rc, 1, WHITE, turned);
}

/* So short that it is a ball, and its outline tells nothing. */
static RGraphic *makeSphyl(void) {
    return RGraphicSphylCreate(rc, 1, 0.001f, WHITE, turned);
}

TEST(a_round_shape_is_seen_to_turn) {
    ck_assert(seenToTurn(makeBall, "checkerboard") > 0.05); /* Its texture tells. */
    assert_below(0.05, seenToTurn(makeBall, NULL));
    assert_below(0.05, seenToTurn(makeSphyl, NULL));
}

/* The mean light of the left and of the right half, of two boxes of one colour side by side. */
TEST(equal_neighbours_have_tones_of_their_own) {
    static MeMatrix4 right = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 1}};
    static MeMatrix4 left = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 1}};
    start("-osmesa -size 320x240");
    RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
    RCameraSetOrthographicView(rc, 3, 50);
    RGraphic *a = RGraphicBoxCreate(rc, 2, 2, 2, GREEN, left);
    RGraphicBoxCreate(rc, 2, 2, 2, GREEN, right);
    RPicture p = shoot(1);
    const uint8_t *l = pixel(&p, 120, 120), *r = pixel(&p, 200, 120);
    ck_assert_int_ge(abs(l[1] - r[1]), 2);
    ck_assert_int_le(abs(l[1] - r[1]), 24);
    const int before = r[1];
    RGraphicDelete(rc, a, 0); /* A tone stays when others go. */
    RPicture q = shoot(1);
    ck_assert_int_eq(pixel(&q, 200, 120)[1], before);
}

static char infoText[256];
static int infos;

static void catchInfo(const int level, const char *const format, va_list ap) {
    (void)level;
    vsnprintf(infoText, sizeof infoText, format, ap);
    infos++;
}

/* Programs run without their pictures: one message, however many frames, and no warning, so that the exit code is 0. */
TEST(a_missing_texture_is_one_message) {
    startChanges();
    const MeHandler before = MeSetInfoHandler(catchInfo);
    ck_assert(changed(missingTexture) == 0);
    MeSetInfoHandler(before);
    ck_assert_int_eq(infos, 1);
    ck_assert_ptr_nonnull(strstr(infoText, "there is no such texture"));
}

/* 600 frames with a bar took as long as 600 pictures, and showed none of them. */
TEST(a_bar_costs_nothing_without_a_window) {
    start("-osmesa -size 320x240");
    ck_assert_ptr_nonnull(RPerformanceBarCreate(rc));
    ck_assert(!rc->m_pViewer->profiling);
    r_frame(rc, NULL);
    ck_assert(!rc->m_pViewer->loop.isDrawn);
    stop();
    start("-osmesa -size 320x240 -bar");
    RPerformanceBarCreate(rc);
    ck_assert(rc->m_pViewer->profiling);
    r_frame(rc, NULL);
    ck_assert(rc->m_pViewer->loop.isDrawn);
}

TEST(the_bar) {
    start("-osmesa -size 320x240 -bar");
    RPicture p = shoot(1);
    RPerformanceBar *b = RPerformanceBarCreate(rc);
    ck_assert_ptr_eq(RPerformanceBarCreate(rc), b);
    RPerformanceBarUpdate(rc, 0.004f, 0.008f, 0.002f, 0);
    RPicture q = shoot(1);
    ck_assert_uint_gt(differences(&p, &q), 500);
    assert_near(b->m_Dynamics, 0.008f, 0);
    press(RKEY_F3);
    RPicture r = shoot(1);
    ck_assert_uint_eq(differences(&p, &r), 0);
}

static void MEAPI slowTick(RRender *r) {
    const int64_t begin = r_now();
    ck_assert_ptr_eq(r, rc);
    MeProfileStartSection("Collision", 0);
    while (r_now() < begin + 140000000)
        continue;
    MeProfileEndSection("Collision");
}

/* Where a frame takes long, the bar does not wait for many of them. */
TEST(the_bar_has_figures_after_three_slow_frames) {
    static const RTick slow = {.funcNoData = slowTick};
    start("-osmesa -size 64x48 -bar");
    RPerformanceBar *b = RPerformanceBarCreate(rc);
    for (int i = 0; i < 3; i++)
        r_frame(rc, &slow);
    assert_below(0.13, b->m_Collision);
    assert_below(0, rc->m_pViewer->bar.fps);
    assert_below(rc->m_pViewer->bar.fps, 1 / 0.14);
}

/* The picture's size follows the window's, and one context follows another. */
TEST(resizing) {
    start("-osmesa -size 64x64");
    r_post(rc, (REvent){.kind = rResize, .x = 100, .y = 50});
    RPicture p = shoot(1);
    ck_assert(p.width == 100 && p.height == 50);
    RRender *first = rc;
    rc = make_context("-osmesa -size 32x32"); /* Both at once. */
    p = shoot(1);
    ck_assert_int_eq(p.width, 32);
    RRenderContextDestroy(rc);
    rc = first;
    p = shoot(1);
    ck_assert_int_eq(p.width, 100);
}

/* A wall on a floor, both bodies: where they meet both are darker than a metre away, and were not without. F5 is the
 * switch. The light comes along the view, so that the wall casts its shadow behind itself. */
TEST(corners_between_bodies_are_darker) {
    static const double towards[3] = {9, 0, 0.5}, at[3] = {0, 1, 0};
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, -0.5f, 0, 1}};
    static MeMatrix4 wallTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 1.5f, -0.5f, 1}};
    const AcmeVector3 middle = {0, 1, 0};
    double share[2];
    start("-osmesa -size 320x240");
    RCameraSetLookAt(rc, middle);
    RCameraSetView(rc, (float)towards[0], (float)towards[1], (float)towards[2]);
    RGraphicBoxCreate(rc, 8, 1, 8, WHITE, floorTM);
    RGraphicBoxCreate(rc, 4, 3, 1, WHITE, wallTM);
    rc->m_pViewer->lights.key.m_bUseLight = 0;
    for (int i = 0; i < 2; i++) {
        double corner[2], wall[2];
        RPicture p = shoot(1);
        project(towards, at, (const double[3]){0, 0.06, 0}, &p, corner);
        project(towards, at, (const double[3]){0, 1.6, 0}, &p, wall);
        share[i] = (double)brightness(&p, corner) / brightness(&p, wall);
        press(RKEY_F5);
    }
    ck_assert_msg(share[0] < 0.92 && share[1] > 0.98, "with: %.3f, without: %.3f", share[0], share[1]);
}

/* Of a long row of balls the camera sees a few: the map holds these alone, and their shadows. */
TEST(the_shadow_map_holds_what_is_seen) {
    enum { BALLS = 41 };
    static MeMatrix4 place[BALLS];
    const AcmeVector3 origin = {0, 0, 0};
    start("-osmesa -size 320x240");
    RGraphicGroundPlaneCreate(rc, 400, 2, WHITE, -1);
    for (int i = 0; i < BALLS; i++) {
        MeMatrix4TMMakeIdentity(place[i]);
        place[i][3][0] = (MeReal)(5 * (i - BALLS / 2));
        RGraphicSphereCreate(rc, 1, BLUE, place[i]);
    }
    RCameraSetLookAt(rc, origin);
    float texel[2];
    for (int i = 0; i < 2; i++) { /* From near, and from where all are seen. */
        RCameraSetView(rc, i == 0 ? 10 : 250, 0.3f, 0.5f);
        shoot(1);
        texel[i] = rc->m_pViewer->draw->block.shadowSettings[1] / 1.2f;
    }
    ck_assert_msg(texel[0] * 1024 > 10 && texel[0] * 1024 < 40, "the map is %g m wide", (double)texel[0] * 1024);
    ck_assert_msg(texel[1] * 1024 > 200, "the map is %g m wide where all is seen", (double)texel[1] * 1024);
}

/* Each look differs from each other in a good part of the ground, and -1 is the ground's own. */
TEST(grounds_look_different) {
    RPicture p[R_GROUNDS + 1];
    start("-osmesa -size 320x240");
    sphereOnGround();
    for (int i = 0; i <= R_GROUNDS; i++) {
        RRenderSetGroundLook(rc, i - 1);
        ck_assert_int_eq(RRenderGetGroundLook(rc), i - 1);
        p[i] = shoot(1);
    }
    ck_assert_uint_eq(differences(&p[0], &p[1]), 0);
    for (int i = 1; i <= R_GROUNDS; i++)
        for (int k = 1; k < i; k++)
            ck_assert_uint_gt(differences(&p[i], &p[k]), (size_t)WIDTH * HEIGHT / 8);
    RRenderSetGroundLook(rc, R_GROUNDS);
    assert_warned("look");
    RRenderSetGroundLook(rc, -2);
    assert_warned("look");
    ck_assert_int_eq(RRenderGetGroundLook(rc), R_GROUNDS - 1);
}

/* The same picture at twice the pixels: text is twice as large, and the window's size only if it was not given. */
TEST(a_scale_is_for_dense_displays) {
    static const struct {
        const char *options;
        int width;
        double scale;
    } cases[] = {{"-null", 960, 1}, {"-null -scale 2", 1920, 2}, {"-null -scale 2 -size 960x600", 960, 1.5}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        start(cases[i].options);
        ck_assert_int_eq(rc->m_pViewer->width, cases[i].width);
        assert_near(r_uiScale(rc), cases[i].scale, 1e-6);
        stop();
    }
    static const char *const mistakes[] = {"-null -scale 9", "-null -scale 2x", "-null -ground sand"};
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        start(mistakes[i]);
        assert_warned(i < 2 ? "-scale" : "-ground");
        stop();
    }
}
