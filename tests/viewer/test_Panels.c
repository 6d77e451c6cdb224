/* Panels and menus in a picture: what they show, what the mouse and keys do to them, and what they leave to others. */
#include "RMark.h"
#include "RMenu.h"
#include "RPanel.h"
#include "viewer_test.h"

#include "r_i.h"

enum { SCENE = 672, X = 690, Y = 315 }; /* The scene's width beside panels; the first item of a panel "Mine". */

static RRender *rc;
static int shows, presses, mouseCalls, pointed;
static MeReal value;
static char edited[16];

static void setup(void) {
    shows = presses = mouseCalls = 0;
    value = 5;
    strcpy(edited, "");
    rc = make_context("-null -size 960x600");
    ck_assert(r_panelsStart(rc));
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

static void MEAPI onMouse(RRender *r, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                          void *userdata) {
    (void)r, (void)x, (void)y, (void)modifiers, (void)which, (void)event, (void)userdata;
    mouseCalls++;
}

static void frame(void) {
    r_frame(rc, NULL);
    r_hudDraw(rc, &rc->m_pViewer->overlay);
}

static void tap(int code) {
    r_post(rc, (REvent){.kind = rKeyDown, .key = code});
    r_post(rc, (REvent){.kind = rKeyUp, .key = code});
    frame();
}

static void point(REventKind kind, int x, int y) {
    r_post(rc, (REvent){.kind = kind, .which = kRLeftButton, .x = x, .y = y});
    frame();
}

/* Down and up come in one frame, as from a quick hand or a slow machine. */
static void click(int x, int y) {
    point(rMouseMove, x, y);
    r_post(rc, (REvent){.kind = rMouseDown, .which = kRLeftButton, .x = x, .y = y});
    r_post(rc, (REvent){.kind = rMouseUp, .which = kRLeftButton, .x = x, .y = y});
    frame(); /* ImGui sees it go down, */
    frame(); /* and up; */
    frame(); /* what it did to a menu is done. */
}

static void MEAPI showButton(RRender *r, void *userdata) {
    ck_assert_ptr_eq(r, rc);
    ck_assert_ptr_eq(userdata, &shows);
    shows++;
    presses += RPanelButton("a button") != 0;
    pointed = RPanelIsPointedAt() != 0;
}

static void MEAPI showSlider(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    presses += RPanelSlider("x", &value, 0, 10, "m") != 0;
}

static void MEAPI showEdit(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    presses += RPanelEdit("x", edited, sizeof edited) != 0;
}

TEST(f9_shows_panels_and_hides_them) {
    RPanelCreate(rc, "Mine", showButton, &shows);
    frame();
    ck_assert_int_eq(shows, 0);
    tap(RKEY_F9);
    ck_assert_int_gt(shows, 0);
    tap(RKEY_F9);
    const int before = shows;
    frame();
    ck_assert_int_eq(shows, before);
    RPanelShow(rc, "Mine", 0);
    tap(RKEY_F9);
    ck_assert_int_eq(shows, before);
    RPanelShow(rc, "Mine", 1);
    frame();
    ck_assert_int_gt(shows, before);
    tap(RKEY_F9); /* They were all shown. */
    const int hidden = shows;
    frame();
    ck_assert_int_eq(shows, hidden);
    RPanelShow(rc, "Mine", 1); /* Alone; F9 shows the others. */
    frame();
    ck_assert_int_gt(shows, hidden);
    ck_assert(!rc->m_pViewer->panelsShown);
    tap(RKEY_F9);
    ck_assert(rc->m_pViewer->panelsShown);
}

/* Where there is no program's menu, F9 opens the viewer's panel. */
TEST(f9_is_never_in_vain) {
    frame();
    const size_t before = rc->m_pViewer->overlay.vertices.count;
    tap(RKEY_F9);
    ck_assert_uint_gt(rc->m_pViewer->overlay.vertices.count, before + 500);
    tap(RKEY_F9);
    ck_assert_uint_eq(rc->m_pViewer->overlay.vertices.count, before);
}

TEST(a_click_is_a_panels_or_the_programs) {
    RRenderSetMouseCallBack(rc, onMouse);
    RPanelCreate(rc, "Mine", showButton, &shows);
    tap(RKEY_F9);
    click(X, Y);
    ck_assert_int_eq(presses, 1);
    ck_assert_int_eq(mouseCalls, 0);
    ck_assert_int_eq(pointed, 1);
    click(480, 500);
    ck_assert_int_eq(pointed, 0);
    ck_assert_int_eq(presses, 1);
    ck_assert_int_eq(mouseCalls, 2);
    point(rMouseDown, 480, 500); /* A drag that begins outside stays outside. */
    point(rMouseMove, X, Y);
    point(rMouseUp, X, Y);
    ck_assert_int_eq(presses, 1);
    ck_assert_int_eq(mouseCalls, 5);
    tap(RKEY_F9);
    click(X, Y); /* Where it was, there is the program again. */
    ck_assert_int_eq(mouseCalls, 7);
}

/* A slow machine sees several clicks in one frame: none is lost, and none is two. */
TEST(clicks_in_one_frame_are_all_counted) {
    RPanelCreate(rc, "Mine", showButton, &shows);
    tap(RKEY_F9);
    for (int i = 0; i < 3; i++) {
        r_post(rc, (REvent){.kind = rMouseMove, .x = 480, .y = 500});
        r_post(rc, (REvent){.kind = rMouseMove, .x = X, .y = Y});
        r_post(rc, (REvent){.kind = rMouseDown, .which = kRLeftButton, .x = X, .y = Y});
        r_post(rc, (REvent){.kind = rMouseUp, .which = kRLeftButton, .x = X, .y = Y});
    }
    for (int i = 0; i < 9; i++)
        frame();
    ck_assert_int_eq(presses, 3);
}

TEST(a_slider_follows_the_mouse) {
    RPanelCreate(rc, "Mine", showSlider, NULL);
    tap(RKEY_F9);
    point(rMouseMove, X, Y);
    point(rMouseDown, X, Y);
    frame();
    ck_assert(value > 0 && value < 5);
    const MeReal low = value;
    point(rMouseMove, X + 60, 100); /* Held, it goes on being moved from outside. */
    ck_assert(value > low && value < 10);
    point(rMouseMove, 900, 100);
    assert_near(value, 10, 0);
    point(rMouseUp, 900, 100);
    point(rMouseMove, X, Y);
    assert_near(value, 10, 0);
}

static void MEAPI showScale(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    presses += RPanelScale("x", &value, 1, 100, "m") != 0;
}

/* In the middle of a scale stands the geometric mean. */
TEST(a_scale_goes_by_factors) {
    RPanelCreate(rc, "Mine", showScale, NULL);
    tap(RKEY_F9);
    click(747, Y);
    ck_assert_int_gt(presses, 0);
    assert_near(value, 10, 2);
}

static void MEAPI showNoScale(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    ck_assert(!RPanelScale("x", &value, 0, 100, "m"));
}

TEST(a_scale_from_zero_is_refused) {
    RPanelCreate(rc, "Mine", showNoScale, NULL);
    tap(RKEY_F9);
    assert_warned("RPanelScale: low is 0");
    RPanelDestroy(rc, "Mine");
}

TEST(what_is_written_is_not_a_key) {
    RPanelCreate(rc, "Mine", showEdit, NULL);
    tap(RKEY_F9);
    click(X, Y);
    tap('p');
    tap('q');
    tap('p');
    ck_assert_str_eq(edited, "pqp");
    tap(RKEY_BACKSPACE);
    ck_assert_str_eq(edited, "pq");
    ck_assert_int_eq(rc->m_bPause, 0);
    ck_assert(!rc->m_pViewer->loop.quit);
    click(480, 500);
    tap('p');
    ck_assert_str_eq(edited, "pq");
    ck_assert_int_eq(rc->m_bPause, 1);
}

static int toggles;

static void MEAPI onToggle(MeBool on) {
    (void)on;
    toggles++;
}

TEST(the_mouse_works_a_menu) {
    RMenu *m = RMenuCreate(rc, "menu"), *inner = RMenuCreate(rc, "inner");
    RMenuAddToggleEntry(m, "toggle", onToggle, 0);
    RMenuAddValueEntry(m, "value", NULL, 10, 0, 1, 5);
    RMenuAddSubmenuEntry(m, "more", inner);
    RRenderSetDefaultMenu(rc, m);
    tap(RKEY_F9);
    const RMenuValueEntry *number = (RMenuValueEntry *)m->m_pFirst->m_pNext;
    const int left = 38, row = 24, first = 72 + 14 + row + row / 2;
    click(left + 30, first);
    ck_assert_int_eq(toggles, 1);
    click(left + 200, first + row);
    assert_near(number->m_Value, 6, 0);
    click(left + 30, first + row);
    click(left + 30, first + row);
    assert_near(number->m_Value, 4, 0);
    click(left + 30, first + 2 * row);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), inner);
    tap(RKEY_F9);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), m);
    tap(RKEY_F9);
    ck_assert_ptr_null(RRenderGetCurrentMenu(rc));
}

/* A menu that is destroyed between the picture and the click's effect. */
TEST(a_menu_may_go_after_a_click) {
    RMenu *m = RMenuCreate(rc, "menu");
    RMenuAddToggleEntry(m, "toggle", onToggle, 0);
    RMenuDisplay(m);
    frame();
    toggles = 0;
    rc->m_pViewer->clicked = m->m_pFirst;
    RMenuDestroy(m);
    frame();
    ck_assert_int_eq(toggles, 0);
}

static const float red[4] = {1, 0, 0, 1};
static MeVector3 from, to;

static void MEAPI drawMarks(RRender *r, void *userdata) {
    ck_assert_ptr_eq(userdata, &from);
    shows++;
    RMarkLine(r, from, to, red, 4);
}

/* Where red triangles are. */
static void redBox(double box[4]) {
    const ROverlay *o = &rc->m_pViewer->overlay;
    box[0] = box[1] = 1e9;
    box[2] = box[3] = -1e9;
    for (size_t i = 0; i < o->vertices.count; i++) {
        const ROverlayVertex *v = &o->vertices.items[i];
        if (v->color != 0xff0000ffu)
            continue;
        box[0] = fmin(box[0], v->x);
        box[1] = fmin(box[1], v->y);
        box[2] = fmax(box[2], v->x);
        box[3] = fmax(box[3], v->y);
    }
}

static void markLine(double x0, double y0, double z0, double x1, double y1, double z1, double box[4]) {
    MeVector3Set(from, x0, y0, z0);
    MeVector3Set(to, x1, y1, z1);
    RRenderUpdateProjectionMatrices(rc);
    frame();
    redBox(box);
}

TEST(marks_are_where_the_camera_sees_their_places) {
    double box[4];
    RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
    RCameraSetView(rc, 10, 0, 0);
    RRenderSetMarkCallBack(rc, drawMarks, &from);
    /* What is 10 m away is seen 2 tan(.35) 10 m high. */
    const double perMetre = 600 / (20 * tan(0.35));
    markLine(0, 0, 0, 2, 0, 0, box);
    assert_near(box[0], 480, 3);
    assert_near(box[2], 480 + 2 * perMetre, 3);
    assert_near(box[1], 300, 3);
    markLine(0, 1, 0, 0, 0, 0, box);
    assert_near(box[1], 300 - perMetre, 3);
    markLine(1, 0, 0, 1, 0, 30, box); /* Ends behind the camera: what is in front of it is drawn. */
    assert_near(box[0], 480 + perMetre, 3);
    assert_below(960, box[2]);
    markLine(1, 0, 20, 1, 0, 30, box);
    assert_below(box[2], box[0]); /* Nothing. */
    markLine(NAN, 0, 0, 1, 0, 0, box);
    assert_below(box[2], box[0]);
    RCameraSetOrthographicView(rc, 6, 50);
    markLine(0, 0, 0, 2, 0, 3, box);
    assert_near(box[2], 680, 3);
    shows = 0;
    RRenderSetMarkCallBack(rc, NULL, NULL);
    frame();
    ck_assert_int_eq(shows, 0);
    RMarkPoint(rc, from, red, 4);
    assert_warned("RRenderSetMarkCallBack");
}

static void MEAPI destroy(RRender *r, void *userdata) {
    (void)userdata;
    shows++;
    ck_assert_int_eq(RRenderContextDestroy(r), 1);
}

TEST(a_panel_cannot_destroy_its_context) {
    RPanelCreate(rc, "Mine", destroy, NULL);
    tap(RKEY_F9);
    ck_assert_int_gt(shows, 0);
    assert_warned("RRenderContextDestroy");
    RPanelDestroy(rc, "Mine");
    frame();
}

static int actions;

static void MEAPI onAction(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    actions++;
}

/* In the viewer's panel: a click on the section opens it, then one on the first button in it presses the key. */
TEST(the_programs_keys_are_buttons_too) {
    char *help[] = {"$ACTION2 - start again", "Just a sentence."};
    RRenderCreateUserHelp(rc, help, 2);
    RRenderSetActionNCallBack(rc, 2, onAction);
    tap(RKEY_F9);
    actions = 0;
    click(X, 237);
    ck_assert_int_eq(actions, 0);
    click(X, 262);
    ck_assert_int_eq(actions, 1);
}

/* The least x of what the text of panels covers. */
static float leftOfPanels(void) {
    const ROverlay *o = &rc->m_pViewer->overlay;
    float left = INFINITY;
    for (size_t i = 0; i < o->vertices.count; i++)
        left = fminf(left, o->vertices.items[i].x);
    return left;
}

static void MEAPI showLines(RRender *r, void *userdata) {
    (void)r, (void)userdata;
    for (int i = 0; i < 40; i++)
        RPanelText("a line that is far too long for the column at the right edge of the window, and has to be wrapped");
}

/* Whatever the window's size: what panels cover the scene does not have. */
TEST(panels_and_the_scene_are_side_by_side) {
    static const int sizes[][2] = {{960, 600}, {2560, 1440}, {480, 360}, {200, 600}};
    RPanelCreate(rc, "First", showLines, NULL);
    RPanelCreate(rc, "Second", showLines, NULL);
    ck_assert_int_eq(r_sceneWidth(rc), 960);
    tap(RKEY_F9);
    ck_assert_int_eq(r_sceneWidth(rc), SCENE);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        r_post(rc, (REvent){.kind = rResize, .x = sizes[i][0], .y = sizes[i][1]});
        frame();
        ck_assert_int_ge(r_sceneWidth(rc), sizes[i][0] / 2);
        assert_near(leftOfPanels(), r_sceneWidth(rc), 1);
    }
    RRenderToggleUserHelp(rc); /* The help has all of the window. */
    ck_assert_int_eq(r_sceneWidth(rc), 200);
    RRenderToggleUserHelp(rc);
    tap(RKEY_F9);
    ck_assert_int_eq(r_sceneWidth(rc), 200);
}

/* The middle of the scene is the middle of what panels leave. */
TEST(a_panel_moves_the_scene) {
    double box[4];
    AcmeReal x = 1, y = 1;
    RPanelCreate(rc, "First", showLines, NULL);
    RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
    RRenderSetMarkCallBack(rc, drawMarks, &from);
    tap(RKEY_F9);
    markLine(0, -1, 0, 0, 1, 0, box);
    assert_near((box[0] + box[2]) / 2, SCENE / 2, 1);
    RCalculatePortalCoordinates(rc, 2, 2, SCENE / 2, 300, &x, &y);
    assert_near(x, 0, 1e-6);
    assert_near(y, 0, 1e-6);
    RRenderSetMarkCallBack(rc, NULL, NULL);
}

/* What lies below the window's edge can be reached: by the wheel, or because it has just been opened. */
TEST(the_column_scrolls) {
    RPanelCreate(rc, "First", showLines, NULL);
    RPanelCreate(rc, "Mine", showButton, &shows);
    RPanelShow(rc, "Mine", 0);
    tap(RKEY_F9);
    shows = 0;
    RPanelShow(rc, "Mine", 1);
    for (int i = 0; i < 3; i++)
        frame();
    ck_assert_int_gt(shows, 0);
    click(X, 576); /* It is the last one. */
    ck_assert_int_eq(presses, 1);
}

TEST(a_panel_may_go) {
    RPanelCreate(rc, "Mine", showButton, &shows);
    RPanelCreate(rc, "Other", showSlider, NULL);
    tap(RKEY_F9);
    RPanelDestroy(rc, "Mine");
    RPanelDestroy(rc, "Mine");
    shows = 0;
    frame();
    ck_assert_int_eq(shows, 0);
    ck_assert_uint_eq(rc->m_pViewer->panelList.count, 1);
}

TEST(bad_input) {
    MeReal x = 0;
    RPanelCreate(rc, NULL, showButton, NULL);
    assert_warned("title");
    RPanelCreate(rc, "Mine", NULL, NULL);
    assert_warned("func");
    RPanelShow(rc, "Mine", 1);
    assert_warned("no panel Mine");
    assert_none(RPanelButton, "alone");
    assert_none(RPanelSlider, "alone", &x, 0, 1, NULL);
    assert_none(RPanelScale, "alone", &x, 1, 2, NULL);
    assert_refused(RPanelText, NULL);
}
