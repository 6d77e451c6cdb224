/* Keys and the mouse, and what they do to callbacks, the camera, the pause; frames and their end. */
#include "MeDebugDraw.h"
#include "RKey.h"
#include "RMenu.h"
#include "viewer_test.h"

#include "r_i.h"

static RRender *rc;
static int calls, ticks;
static void *lastData;
static struct {
    int n, x, y, modifiers;
    RMouseButtonWhich which;
    RMouseButtonEvent event;
} mouse;

static void MEAPI onPress(RRender *r, void *userdata) {
    ck_assert_ptr_eq(r, rc);
    calls++;
    lastData = userdata;
}

static void MEAPI onPressNoData(RRender *r) {
    ck_assert_ptr_eq(r, rc);
    calls += 100;
}

static void MEAPI onMouse(RRender *r, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                          void *userdata) {
    ck_assert_ptr_eq(r, rc);
    lastData = userdata;
    mouse.n++;
    mouse.x = x;
    mouse.y = y;
    mouse.modifiers = modifiers;
    mouse.which = which;
    mouse.event = event;
}

static void MEAPI onTick(RRender *r) {
    ck_assert_ptr_eq(r, rc);
    ticks++;
}

static const RTick tick = {.funcNoData = onTick};

static void setup(void) {
    calls = ticks = 0;
    lastData = NULL;
    memset(&mouse, 0, sizeof mouse);
    rc = make_context("-null");
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

static void frames(int n) {
    while (n-- > 0)
        r_frame(rc, &tick);
}

static void key(REventKind kind, int code, int modifiers) {
    r_post(rc, (REvent){.kind = kind, .key = code, .modifiers = modifiers});
}

static void tap(int code, int modifiers) {
    key(rKeyDown, code, modifiers);
    key(rKeyUp, code, modifiers);
    frames(1);
}

static void point(REventKind kind, int which, int modifiers, int x, int y) {
    r_post(rc, (REvent){.kind = kind, .which = which, .modifiers = modifiers, .x = x, .y = y});
    frames(1);
}

TEST(both_kinds_of_callbacks) {
    int data;
    RRenderSetUpCallBack(rc, onPress, &data);
    RRenderSetDownCallBack(rc, onPress);
    RRenderSetLeft2CallBack(rc, onPressNoData);
    RRenderSetRight2CallBack(rc, onPressNoData, 0);
    tap(RKEY_UP, 0);
    ck_assert_ptr_eq(lastData, &data);
    tap(RKEY_DOWN, 0);
    ck_assert_ptr_null(lastData);
    ck_assert_int_eq(calls, 2);
    tap('a', 0);
    tap('d', 0);
    ck_assert_int_eq(calls, 202);
    tap(RKEY_LEFT, 0); /* Nobody wants it. */
    RRenderSetUpCallBack(rc, (RButtonPressCallBack)0);
    tap(RKEY_UP, 0);
    ck_assert_int_eq(calls, 202);
}

TEST(all_buttons_and_actions) {
    static const int keys[] = {RKEY_UP, RKEY_DOWN, RKEY_LEFT,  RKEY_RIGHT, 'w', 's', 'a',
                               'd',     ' ',       RKEY_ENTER, '3',        '4', '5'};
    int data[13];
    RRenderSetUpCallBackWithText(rc, onPress, &data[0], "jump");
    RRenderSetDownCallBackWithText(rc, onPress, &data[1], NULL);
    RRenderSetLeftCallBackWithText(rc, onPress, &data[2], "");
    RRenderSetRightCallBackWithText(rc, onPress, &data[3], "x");
    RRenderSetUp2CallBackWithText(rc, onPress, &data[4], "x");
    RRenderSetDown2CallBackWithText(rc, onPress, &data[5], "x");
    RRenderSetLeft2CallBackWithText(rc, onPress, &data[6], "x");
    RRenderSetRight2CallBackWithText(rc, onPress, &data[7], "x");
    for (int i = 1; i < 5; i++)
        RRenderSetActionNCallBack(rc, i, onPress, &data[7 + i]);
    RRenderSetActionNCallBackWithText(rc, 5, onPress, &data[12], "x");
    for (int i = 0; i < 13; i++) {
        tap(keys[i], 0);
        ck_assert_ptr_eq(lastData, &data[i]);
    }
    ck_assert_int_eq(calls, 13);
    ck_assert_str_eq(rc->m_CallBacks.m_Button[kRButtonUp].m_Text, "jump");
    RRenderSetActionNCallBack(rc, 6, onPress);
    assert_warned("0 to 5");
    RRenderSetActionNCallBack(rc, -1, onPressNoData, 0);
    assert_warned("0 to 5");
    RRenderSetButtonCallBack(rc, kRButtons, onPress, NULL);
    assert_warned("not a button");
}

TEST(actions_can_have_other_keys) {
    RRenderSetActionNCallBack(rc, 2, onPress);
    RRenderSetActionNKey(rc, 2, 'R');
    tap(RKEY_ENTER, 0);
    ck_assert_int_eq(calls, 0);
    tap('r', 0);
    ck_assert_int_eq(calls, 1);
    RRenderSetActionNKey(rc, 2, 'p'); /* The program's wish is stronger than the viewer's own use. */
    tap('p', 0);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(rc->m_bPause, 0);
    RRenderSetActionNCallBack(rc, 2, 0);
    tap('p', 0); /* Without a callback the key is the viewer's again. */
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(rc->m_bPause, 1);
}

TEST(an_action_on_a_direction_key_is_not_repeated_as_the_direction) {
    RRenderSetUp2CallBack(rc, onPressNoData);
    RRenderSetActionNCallBack(rc, 3, onPress);
    RRenderSetActionNKey(rc, 3, 'w');
    key(rKeyDown, 'w', 0);
    frames(60);
    ck_assert_int_eq(calls, 1);
}

static void MEAPI drawOne(RRender *r) {
    MeVector3 a = {0, 0, 0}, b = {1, 2, r ? 3 : 0};
    MeDebugDrawAPI.line(a, b, 1, 0, 0);
}

/* What Karma draws of itself is seen until the next tick, and in a pause. */
TEST(debug_lines_last_until_the_next_tick) {
    static const RTick drawing = {.funcNoData = drawOne};
    MeVector3 a = {0, 0, 0}, bad = {0, NAN, 0};
    MeDebugDrawAPI.line(a, a, 1, 0, 0); /* No frame yet: nobody would ever forget it. */
    ck_assert_uint_eq(rc->m_pViewer->debugLines.count, 0);
    r_frame(rc, &drawing);
    r_frame(rc, &drawing);
    ck_assert_uint_eq(rc->m_pViewer->debugLines.count, 1);
    assert_near(rc->m_pViewer->debugLines.items[0].b[1], 2, 0);
    MeDebugDrawAPI.line(a, bad, 1, 0, 0);
    ck_assert_uint_eq(rc->m_pViewer->debugLines.count, 1);
    RRenderSetPause(rc, 1);
    r_frame(rc, &drawing);
    ck_assert_uint_eq(rc->m_pViewer->debugLines.count, 1);
    RRenderSetPause(rc, 0);
    r_frame(rc, &tick);
    ck_assert_uint_eq(rc->m_pViewer->debugLines.count, 0);
}

static int argumentsSeen;
static void *dataSeen;

static void MEAPI noParameters(void) {
    argumentsSeen = 0;
}

static int MEAPI withResult(RRender *r, int *data) {
    argumentsSeen = r ? 2 : -1;
    dataSeen = data;
    return 5;
}

static void MEAPI oneParameter(RRender *r) {
    argumentsSeen = r ? 1 : -1;
}

/* Every form that programs write gets the arguments that it has. */
TEST(callbacks_of_all_forms_are_called_with_their_arguments) {
    int data = 3;
    RRenderSetUpCallBack(rc, withResult, &data);
    tap(RKEY_UP, 0);
    ck_assert_int_eq(argumentsSeen, 2);
    ck_assert_ptr_eq(dataSeen, &data);
    RRenderSetUpCallBack(rc, oneParameter, &data);
    tap(RKEY_UP, 0);
    ck_assert_int_eq(argumentsSeen, 1);
    RRenderSetUpCallBack(rc, noParameters, &data);
    tap(RKEY_UP, 0);
    ck_assert_int_eq(argumentsSeen, 0);
    argumentsSeen = 7;
    RRenderSetUpCallBack(rc, 0);
    RRenderSetActionNCallBack(rc, 2, NULL, NULL);
    tap(RKEY_UP, 0);
    tap(RKEY_ENTER, 0);
    ck_assert_int_eq(argumentsSeen, 7);
    ck_assert_ptr_null(rc->m_CallBacks.m_Button[kRButtonUp].m_Func);
    ck_assert_ptr_null(rc->m_CallBacks.m_Button[kRButtonUp].m_FuncNoData);
}

TEST(a_held_button_repeats_and_an_action_does_not) {
    RRenderSetUpCallBack(rc, onPress);
    RRenderSetActionNCallBack(rc, 1, onPressNoData);
    key(rKeyDown, RKEY_UP, 0);
    key(rKeyDown, ' ', 0);
    frames(10);
    ck_assert_int_eq(calls, 101);
    frames(60);
    ck_assert_int_gt(calls, 105);
    ck_assert_int_lt(calls, 120);
    key(rKeyUp, RKEY_UP, 0);
    frames(1);
    const int before = calls;
    frames(60);
    ck_assert_int_eq(calls, before);
}

TEST(pause_and_single_step) {
    frames(3);
    ck_assert_int_eq(ticks, 3);
    tap('p', 0);
    frames(5);
    ck_assert_int_eq(ticks, 3);
    tap('o', 0);
    ck_assert_int_eq(ticks, 4);
    frames(5);
    ck_assert_int_eq(ticks, 4);
    tap('.', 0);
    ck_assert_int_eq(ticks, 5);
    tap('p', 0);
    ck_assert_int_eq(ticks, 6);
    tap(RKEY_F1, 0);
    frames(5);
    ck_assert_int_eq(ticks, 6);
    tap(RKEY_F1, 0);
    ck_assert_int_eq(ticks, 7);
}

TEST(camera_keys) {
    RRenderSetLeftCallBack(rc, onPress);
    r_cameraKeepHome(rc);
    tap(RKEY_LEFT, RCONTROL);
    ck_assert_int_eq(calls, 0);
    assert_below(RCameraGetRotation(rc), 0);
    tap(RKEY_UP, RCONTROL);
    assert_below(0, RCameraGetElevation(rc));
    tap(RKEY_PAGE_UP, 0);
    assert_below(RCameraGetDistance(rc), 15);
    const double near = RCameraGetDistance(rc);
    key(rKeyDown, RKEY_PAGE_DOWN, 0);
    frames(40);
    assert_below(near * 1.3, RCameraGetDistance(rc));
    tap(RKEY_HOME, 0);
    assert_near(RCameraGetRotation(rc), 0, 0);
    assert_near(RCameraGetElevation(rc), 0, 0);
}

TEST(the_mouse_moves_the_camera) {
    point(rMouseDown, kRLeftButton, 0, 100, 100);
    point(rMouseMove, 0, 0, 150, 120);
    assert_below(RCameraGetRotation(rc), -0.1); /* The world follows the mouse to the right. */
    assert_below(0.05, RCameraGetElevation(rc));
    point(rMouseUp, kRLeftButton, 0, 150, 120);
    const double angle = RCameraGetRotation(rc);
    point(rMouseMove, 0, 0, 10, 10);
    assert_near(RCameraGetRotation(rc), angle, 0);
    point(rWheel, 2, 0, 480, 300);
    assert_near(RCameraGetDistance(rc), 15 * 0.81, 1e-4);
    static const int buttons[3] = {kRLeftButton, kRMiddleButton, kRRightButton}, modifiers[3] = {RSHIFT, 0, 0};
    for (int i = 0; i < 3; i++) {
        const double before = rc->m_CameraLookAt[1];
        point(rMouseDown, buttons[i], modifiers[i], 100, 100);
        point(rMouseMove, 0, modifiers[i], 100, 150);
        point(rMouseUp, buttons[i], 0, 100, 150);
        assert_near(RCameraGetRotation(rc), angle, 0);
        assert_near(RCameraGetDistance(rc), 15 * 0.81, 1e-4);
        assert_below(before + 0.1, rc->m_CameraLookAt[1]); /* Dragging down looks further up. */
    }
}

/* World to the picture: 2 x 2, y up. */
static void seenAt(const double world[3], double seen[2]) {
    double c[3], w;
    RRenderUpdateProjectionMatrices(rc);
    for (int j = 0; j < 3; j++) {
        c[j] = (double)rc->m_CameraMatrix[3][j];
        for (int i = 0; i < 3; i++)
            c[j] += world[i] * (double)rc->m_CameraMatrix[i][j];
    }
    w = -c[2] * -(double)rc->m_ProjectionMatrix[2][3] + (double)rc->m_ProjectionMatrix[3][3];
    seen[0] = c[0] * (double)rc->m_ProjectionMatrix[0][0] / w;
    seen[1] = c[1] * (double)rc->m_ProjectionMatrix[1][1] / w;
}

TEST(the_wheel_zooms_to_the_pointer) {
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        double before[2], after[2];
        RCameraSetView(rc, 10, 0.4f, 0.3f);
        if (orthographic)
            RCameraSetOrthographicView(rc, 8, 40);
        AcmeVector3 at, up, look;
        RCameraGetLookAt(rc, at);
        RCameraGetUp(rc, up);
        RCameraGetLookDir(rc, look);
        /* A point of the plane through the look-at point that faces the camera. */
        const double right[3] = {(double)(look[1] * up[2] - look[2] * up[1]),
                                 (double)(look[2] * up[0] - look[0] * up[2]),
                                 (double)(look[0] * up[1] - look[1] * up[0])};
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (double)at[i] + 2.5 * right[i] + 1.5 * (double)up[i];
        seenAt(p, before);
        point(rWheel, 3, 0, (int)lround(480 * (1 + before[0])), (int)lround(300 * (1 - before[1])));
        seenAt(p, after);
        assert_near(before[0], after[0], 1e-3); /* Within a pixel. */
        assert_near(before[1], after[1], 1.5e-3);
    }
    ck_assert(rc->m_pViewer->camera.orthoHeight < 8);
}

static double eyeHeight(void) {
    AcmeVector3 eye, up;
    RCameraGetPosition(rc, eye);
    RCameraGetUpAxis(rc, up);
    return (double)eye[0] * up[0] + (double)eye[1] * up[1] + (double)eye[2] * up[2];
}

/* Drags far, turns, and zooms far out and in; returns how low the eye has come. */
static double moveCameraFar(void) {
    static const int buttons[2] = {kRLeftButton, kRRightButton};
    double lowest = INFINITY;
    for (int i = 0; i < 2; i++) {
        point(rMouseDown, buttons[i], 0, 400, 300);
        point(rMouseMove, 0, 0, 420, -900);
        lowest = fmin(lowest, eyeHeight());
        point(rMouseUp, buttons[i], 0, 420, -900);
    }
    tap(RKEY_DOWN, RCONTROL);
    for (int i = 0; i < 30; i++) {
        lowest = fmin(lowest, eyeHeight());
        point(rWheel, i < 10 ? -2 : 2, 0, 480, 500);
    }
    return fmin(lowest, eyeHeight());
}

/* Whatever the user does to it, whichever axis is up, and whichever size the scene has. */
TEST(the_camera_stays_above_the_ground) {
    static const AcmeReal sizes[] = {0.01f, 1, 1000}, ground = -3;
    for (int i = 0; i < 6; i++) {
        const AcmeReal size = sizes[i / 2];
        RGraphic *plane;
        RCameraSetUp(rc, 0, (AcmeReal)(i % 2), (AcmeReal)(1 - i % 2));
        plane = RGraphicGroundPlaneCreate(rc, 24 * size, 2, RPalette[7], ground * size);
        RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
        RCameraSetView(rc, 15 * size, 0, 0.3f);
        assert_below((double)(ground * size), moveCameraFar());
        rc->m_pViewer->camera.goesBelow = true;
        RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
        RCameraSetView(rc, 15 * size, 0, 0.3f);
        assert_below(moveCameraFar(), (double)(ground * size));
        rc->m_pViewer->camera.goesBelow = false;
        RGraphicDelete(rc, plane, 0);
    }
}

/* A program's own view is its own affair; without a ground the lowest thing counts; without that there is no limit. */
TEST(what_the_ground_is) {
    static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, -5, 0, 1}};
    assert_below(moveCameraFar(), -10);
    RGraphicBoxCreate(rc, 1, 2, 1, RPalette[0], tm);
    RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
    RCameraSetView(rc, 15, 0, 0.3f);
    assert_below(-6, moveCameraFar());
    RCameraSetLookAt(rc, (const AcmeVector3){0, -20, 0});
    RCameraSetView(rc, 15, 0, 0);
    assert_near(eyeHeight(), -20, 1e-4);
    point(rMouseDown, kRLeftButton, 0, 400, 300);
    point(rMouseMove, 0, 0, 400, 250);
    assert_near(eyeHeight(), -20, 1e-4); /* It came no lower, */
    point(rMouseMove, 0, 0, 400, 400);
    assert_below(-19, eyeHeight()); /* but can go up. */
    point(rMouseUp, kRLeftButton, 0, 400, 400);
}

static void MEAPI leave(RRender *r, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                        void *userdata) {
    onMouse(r, x, y, modifiers, which, event, userdata);
    if (x > 500)
        RRenderLeaveMouse(r);
}

TEST(a_drag_may_be_left_to_the_camera) {
    RRenderSetMouseCallBack(rc, leave);
    point(rMouseDown, kRLeftButton, 0, 600, 100);
    point(rMouseMove, 0, 0, 650, 100);
    point(rMouseUp, kRLeftButton, 0, 650, 100);
    ck_assert_int_eq(mouse.n, 1); /* It is asked, and told no more. */
    assert_below(RCameraGetRotation(rc), -0.1);
    const double angle = RCameraGetRotation(rc);
    point(rMouseDown, kRLeftButton, 0, 100, 100);
    point(rMouseMove, 0, 0, 150, 100);
    point(rMouseUp, kRLeftButton, 0, 150, 100);
    ck_assert_int_eq(mouse.n, 4);
    assert_near(RCameraGetRotation(rc), angle, 0);
}

TEST(helpers_have_keys_that_the_program_does_not_want) {
    RRenderSetKeyCallBack(rc, ' ', onPress, NULL, "throw");
    RRenderSetKeyCallBack(rc, 'P', onPress, NULL, NULL);
    tap(' ', 0);
    tap('p', 0);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(rc->m_bPause, 0);
    RRenderSetActionNCallBack(rc, 1, onPressNoData);
    tap(' ', 0);
    ck_assert_int_eq(calls, 102);
    RRenderSetKeyCallBack(rc, ' ', NULL, NULL, NULL);
    RRenderSetActionNCallBack(rc, 1, 0);
    tap(' ', 0);
    ck_assert_int_eq(calls, 102);
    RRenderSetKeyCallBack(rc, '\n', onPress, NULL, NULL);
    assert_warned("printable");
}

TEST(slow_motion_ticks_less_often) {
    rc->m_pViewer->slow = 4;
    frames(40);
    ck_assert_int_eq(ticks, 10);
    tap('o', 0); /* A single step comes at once. */
    ck_assert_int_eq(ticks, 11);
}

TEST(the_programs_mouse) {
    int data;
    RRenderSetMouseCallBack(rc, onMouse, &data);
    point(rMouseDown, kRLeftButton, RALT, 30, 40);
    ck_assert(mouse.n == 1 && mouse.event == kRNewlyPressed && mouse.which == kRLeftButton);
    ck_assert(mouse.x == 30 && mouse.y == 40 && mouse.modifiers == RALT);
    ck_assert_ptr_eq(lastData, &data);
    point(rMouseMove, 0, 0, 31, 42);
    ck_assert(mouse.n == 2 && mouse.event == kRStillPressed && mouse.x == 31 && mouse.y == 42);
    point(rMouseUp, kRLeftButton, 0, 33, 44);
    ck_assert(mouse.n == 3 && mouse.event == kRNewlyReleased);
    point(rMouseMove, 0, 0, 0, 0);
    assert_near(RCameraGetRotation(rc), 0, 0);
    point(rMouseDown, kRLeftButton, RCONTROL, 30, 40); /* The camera's. */
    point(rMouseMove, 0, RCONTROL, 90, 40);
    point(rMouseUp, kRLeftButton, RCONTROL, 90, 40);
    ck_assert_int_eq(mouse.n, 3);
    assert_below(RCameraGetRotation(rc), -0.1);
    RRenderSetMouseCallBack(rc, (RMouseCallBack)0);
    point(rMouseDown, kRLeftButton, 0, 30, 40);
    ck_assert_int_eq(mouse.n, 3);
}

static MeReal menuValue;

static void MEAPI onValue(MeReal value) {
    menuValue = value;
}

TEST(arrows_work_a_menu) {
    RMenu *m = RMenuCreate(rc, "menu");
    RMenuAddToggleEntry(m, "one", NULL, 0);
    RMenuAddValueEntry(m, "two", onValue, 10, 0, 1, 5);
    RRenderSetDefaultMenu(rc, m);
    RRenderSetRightCallBack(rc, onPress);
    tap(RKEY_F9, 0);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), m);
    tap(RKEY_DOWN, 0);
    tap(RKEY_RIGHT, 0);
    assert_near(menuValue, 6, 0);
    tap(RKEY_LEFT, 0);
    tap(RKEY_LEFT, 0);
    assert_near(menuValue, 4, 0);
    ck_assert_int_eq(calls, 0);
    tap(RKEY_F9, 0);
    ck_assert_ptr_null(RRenderGetCurrentMenu(rc));
    tap(RKEY_RIGHT, 0);
    ck_assert_int_eq(calls, 1);
}

TEST(leaving) {
    static const int keys[] = {'q', RKEY_ESCAPE};
    for (int i = 0; i < 2; i++) {
        ck_assert(!r_loopEnded(rc));
        tap(keys[i], 0);
        ck_assert(r_loopEnded(rc));
        ck_assert_int_eq(ticks, i); /* Not called any more. */
        rc->m_pViewer->loop.quit = false;
        frames(1);
    }
    r_post(rc, (REvent){.kind = rClose});
    frames(1);
    ck_assert(r_loopEnded(rc));
    rc->m_pViewer->loop.quit = false;
    RRenderQuit(rc);
    ck_assert(r_loopEnded(rc));
}

TEST(scripted_keys_and_the_number_of_frames) {
    RRender *own = make_context("-null -frames 6 -key Enter@2,q@9,Ctrl+Right@3,F1@4,p@5");
    RRender *const before = rc;
    rc = own;
    RRenderSetActionNCallBack(rc, 2, onPress);
    frames(1);
    ck_assert_int_eq(calls, 0);
    frames(1);
    ck_assert_int_eq(calls, 1);
    frames(1);
    assert_below(0.01, RCameraGetRotation(rc));
    frames(1);
    ck_assert(rc->m_bShowHelp && rc->m_bPause && ticks == 3);
    frames(1);
    ck_assert(!rc->m_bPause && ticks == 4);
    ck_assert(!r_loopEnded(rc));
    frames(1);
    ck_assert(r_loopEnded(rc)); /* Paused frames count where nobody can continue. */
    RRenderContextDestroy(own);
    rc = before;
}

TEST(keys_are_held_and_released) {
    static const int up[] = {0, 1, 2, 3, 0, 1, 1, 0};
    RRender *own = make_context("-null -key Up@2-4,Up@6,Up@7,a@3");
    RRender *const before = rc;
    rc = own;
    for (int i = 0; i < 8; i++) {
        frames(1);
        ck_assert_int_eq(RRenderGetKeyFrames(rc, "up"), up[i]);
        ck_assert_int_eq(RRenderGetKeyFrames(rc, "A"), i == 2);
    }
    assert_none(RRenderGetKeyFrames, rc, "Foo");
    assert_none(RRenderGetKeyFrames, rc, 0);
    assert_none(RRenderGetKeyFrames, 0, "Up");
    RRenderContextDestroy(own);
    rc = before;
}

TEST(a_script_presses_once_what_it_holds_and_may_press_often) {
    RRender *own = make_context("-null -key Enter@2-9,Enter@10,Enter@12,Enter@12,Enter@12");
    RRender *const before = rc;
    rc = own;
    RRenderSetActionNCallBack(rc, 2, onPress, 0);
    calls = 0;
    frames(9);
    ck_assert_int_eq(calls, 1);
    frames(1);
    ck_assert_int_eq(calls, 2);
    frames(2);
    ck_assert_int_eq(calls, 5);
    RRenderContextDestroy(own);
    rc = before;
}

TEST(key_names) {
    char name[16];
    ck_assert_int_eq(r_keyByName("F1", 2), RKEY_F1);
    ck_assert_int_eq(r_keyByName("f12", 3), RKEY_F12);
    ck_assert_int_eq(r_keyByName("F13", 3), RKEY_NONE);
    ck_assert_int_eq(r_keyByName("space", 5), ' ');
    ck_assert_int_eq(r_keyByName("PgDn", 4), RKEY_PAGE_DOWN);
    ck_assert_int_eq(r_keyByName("A", 1), 'a');
    ck_assert_int_eq(r_keyByName("", 0), RKEY_NONE);
    r_keyName(RKEY_F9, name, sizeof name);
    ck_assert_str_eq(name, "F9");
    r_keyName('z', name, sizeof name);
    ck_assert_str_eq(name, "Z");
}
