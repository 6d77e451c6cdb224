/* Parameters: one table makes keys, lines of the help, and sliders. */
#include "RPanel.h"
#include "RParameter.h"
#include "viewer_test.h"

#include "r_i.h"

static RRender *rc;
static MeReal slope, weight;
static int calls;

static void MEAPI onChange(RRender *r, void *userdata) {
    ck_assert_ptr_eq(r, rc);
    ck_assert_ptr_eq(userdata, &calls);
    calls++;
}

static const RParameter both[] = {
    {"the slope", "degrees", &slope, 5, 45, 2, .less = "Down", .more = "Up", .changed = onChange, .userdata = &calls},
    {"the weight", 0, &weight, 1, 1000, 10, .isFactor = METRUE, .less = "a", .more = "d"},
};

static void setup(void) {
    calls = 0;
    slope = 25;
    weight = 100;
    rc = make_context("-null -size 960x600");
    ck_assert(r_panelsStart(rc));
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

static void frame(void) {
    r_frame(rc, NULL);
    r_hudDraw(rc, &rc->m_pViewer->overlay);
}

static void tap(int code) {
    r_post(rc, (REvent){.kind = rKeyDown, .key = code});
    r_post(rc, (REvent){.kind = rKeyUp, .key = code});
    frame();
}

TEST(keys_step_within_the_range) {
    RRenderCreateParameters(rc, both, 2);
    tap(RKEY_UP);
    ck_assert_double_eq(slope, 27);
    tap(RKEY_DOWN);
    tap(RKEY_DOWN);
    ck_assert_double_eq(slope, 23);
    ck_assert_int_eq(calls, 3);
    for (int i = 0; i < 20; i++)
        tap(RKEY_UP);
    ck_assert_double_eq(slope, 45);
    for (int i = 0; i < 40; i++)
        tap(RKEY_DOWN);
    ck_assert_double_eq(slope, 5);
    ck_assert_double_eq(weight, 100);
}

TEST(a_factor_multiplies) {
    RRenderCreateParameters(rc, both, 2);
    tap('d');
    ck_assert_double_eq(weight, 1000);
    tap('d');
    ck_assert_double_eq(weight, 1000);
    tap('a');
    tap('a');
    ck_assert_double_eq(weight, 10);
    ck_assert_int_eq(calls, 0);
}

TEST(a_key_that_is_held_goes_on) {
    RRenderCreateParameters(rc, both, 2);
    r_post(rc, (REvent){.kind = rKeyDown, .key = RKEY_DOWN});
    for (int i = 0; i < 24; i++)
        frame();
    ck_assert_double_eq(slope, 23);
    for (int i = 0; i < 9; i++)
        frame();
    ck_assert_double_eq(slope, 19);
    r_post(rc, (REvent){.kind = rKeyUp, .key = RKEY_DOWN});
    for (int i = 0; i < 30; i++)
        frame();
    ck_assert_double_eq(slope, 19);
}

static void MEAPI onAction(RRender *r, void *userdata) {
    (void)r;
    ++*(int *)userdata;
}

/* Actions come first, then parameters, then the buttons. */
TEST(its_keys_are_between_actions_and_buttons) {
    int actions = 0, buttons = 0;
    RRenderSetUpCallBackWithText(rc, onAction, &buttons, "nothing");
    RRenderCreateParameters(rc, both, 2);
    RRenderSetActionNKey(rc, 3, 'd');
    RRenderSetActionNCallBack(rc, 3, onAction, &actions);
    tap(RKEY_UP);
    tap('d');
    ck_assert_int_eq(buttons, 0);
    ck_assert_int_eq(actions, 1);
    ck_assert_double_eq(slope, 27);
    ck_assert_double_eq(weight, 100);
}

static void point(REventKind kind, int x, int y) {
    r_post(rc, (REvent){.kind = kind, .which = kRLeftButton, .x = x, .y = y});
    frame();
}

/* Where the panel has its first slider, from x = 680 to 938, and its button. */
enum { SLIDER_Y = 333, BUTTON_X = 700, BUTTON_Y = 380 };

TEST(the_slider_goes_by_steps) {
    static const struct {
        int x;
        MeReal value;
    } places[] = {{684, 5}, {936, 45}, {809, 25}, {746, 15}};
    RRenderCreateParameters(rc, both, 2);
    tap(RKEY_F9);
    frame();
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const int before = calls;
        point(rMouseMove, places[i].x, SLIDER_Y);
        point(rMouseDown, places[i].x, SLIDER_Y);
        frame();
        point(rMouseUp, places[i].x, SLIDER_Y);
        frame();
        ck_assert_msg(MeFabs(slope - places[i].value) <= 2, "at %d: %g", places[i].x, slope);
        ck_assert_double_eq(fmod((double)slope - 5, 2), 0);
        ck_assert_int_eq(calls, before + 1);
    }
}

TEST(all_go_back_to_where_they_were_at_first) {
    RRenderCreateParameters(rc, both, 2);
    tap(RKEY_UP);
    tap('d');
    calls = 0;
    tap(RKEY_F9);
    frame();
    point(rMouseMove, BUTTON_X, BUTTON_Y);
    point(rMouseDown, BUTTON_X, BUTTON_Y);
    point(rMouseUp, BUTTON_X, BUTTON_Y);
    frame();
    ck_assert_double_eq(slope, 25);
    ck_assert_double_eq(weight, 100);
    ck_assert_int_eq(calls, 1);
}

TEST(the_help_names_them) {
    char text[64];
    RRenderCreateParameters(rc, both, 2);
    const RParameterKept *p = r_parameterOfKey(rc, 'd', NULL);
    r_parameterKeys(p, text, sizeof text);
    ck_assert_str_eq(text, "A, D");
    r_parameterText(&rc->m_pViewer->parameters.items[0], text, sizeof text);
    ck_assert_str_eq(text, "the slope (degrees)");
    RRenderToggleUserHelp(rc);
    frame();
    const float with = rc->m_pViewer->helpLayout.bottom - rc->m_pViewer->helpLayout.top;
    r_parametersFree(&rc->m_pViewer->parameters);
    frame();
    ck_assert_float_gt(with, rc->m_pViewer->helpLayout.bottom - rc->m_pViewer->helpLayout.top);
}

/* What is mistaken is told, and left out; the rest is there. */
TEST(mistakes_are_told) {
    const RParameter mistaken[] = {
        {.value = &slope, .low = 0, .high = 1, .step = 1},
        {.name = "no value", .low = 0, .high = 1, .step = 1},
        {"no range", 0, &slope, 1, 1, 1, .changed = 0},
        {"not finite", 0, &slope, 0, INFINITY, 1, .changed = 0},
        {.name = "no step", .value = &slope, .low = 0, .high = 1},
        {"no factor", 0, &slope, 1, 2, 1, .isFactor = METRUE},
        {"no root", 0, &slope, 0, 2, 2, .isFactor = METRUE},
        {"no key", 0, &slope, 0, 2, 1, .less = "Nowhere"},
        {"its key", 0, &slope, 0, 2, 1, .less = "Up"},
        {"the slope", 0, &slope, 0, 2, 1, .changed = 0},
    };
    enum { COUNT = sizeof mistaken / sizeof mistaken[0] };
    RRenderCreateParameters(rc, both, 2);
    for (int i = 0; i < COUNT; i++) {
        assert_refused(RRenderCreateParameters, rc, &mistaken[i], 1);
    }
    assert_refused(RRenderCreateParameters, rc, NULL, 1);
    assert_refused(RRenderCreateParameters, NULL, both, 2);
    ck_assert_uint_eq(rc->m_pViewer->parameters.count, 2);
}
