/* Variables in texts, characters, and the layout of the help. */
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

static const char *parsed(const char *text) {
    static char out[256];
    RParseText(rc, text, out, sizeof out);
    return out;
}

TEST(variables) {
    RRenderSetAppName(rc, "Rainbow");
    ck_assert_str_eq(parsed("plain"), "plain");
    ck_assert_str_eq(parsed(""), "");
    ck_assert_str_eq(parsed("$APPNAME!"), "Rainbow!");
    ck_assert_str_eq(parsed("$UP $DOWN $LEFT $RIGHT"), "Up Down Left Right");
    ck_assert_str_eq(parsed("$UP2$DOWN2$LEFT2$RIGHT2"), "WSAD");
    ck_assert_str_eq(parsed("$ACTION1 $ACTION2 $ACTION3 $ACTION4 $ACTION5"), "Space Enter 3 4 5");
    ck_assert_str_eq(parsed("$MOUSE - push"), "Left mouse button - push");
}

TEST(what_is_no_variable_stays) {
    ck_assert_str_eq(parsed("$"), "$");
    ck_assert_str_eq(parsed("100$ $up $ACTION9 $ACTION0 $UP3 $UPS"), "100$ $up $ACTION9 $ACTION0 $UP3 $UPS");
    ck_assert_str_eq(parsed("$$UP"), "$Up");
}

TEST(keys_follow_their_actions) {
    RRenderSetActionNKey(rc, 2, 'x');
    ck_assert_str_eq(parsed("$ACTION2"), "X");
    RRenderSetActionNKey(rc, 3, 'X'); /* Case does not matter, so the key is taken over. */
    assert_warned("action 2");
    ck_assert_str_eq(parsed("$ACTION3 $ACTION2"), "X (no key)");
    RRenderSetActionNKey(rc, 4, 'p'); /* The viewer uses it itself: no word about that. */
    assert_silent();
    RRenderSetActionNKey(rc, 1, 'z');
    assert_warned("2 to 5");
    RRenderSetActionNKey(rc, 6, 'z');
    assert_warned("2 to 5");
    RRenderSetActionNKey(rc, 5, '\n');
    assert_warned("printable");
    ck_assert_str_eq(parsed("$ACTION5"), "5");
}

TEST(output_is_cut) {
    char out[6] = "-----";
    RParseText(rc, "ab$ACTION1", out, 5);
    ck_assert_str_eq(out, "abSp");
    ck_assert_int_eq(out[5], 0);
    RParseText(rc, "abc", out, 1);
    ck_assert_str_eq(out, "");
    RParseText(rc, "abc", out, 0);
    assert_warned("outbuffersize");
    RParseText(rc, NULL, out, 5);
    assert_warned("text_in");
    RParseText(rc, "abc", NULL, 5);
    assert_warned("text_out");
}

TEST(characters) {
    const char *text = "a\xc2\xb5\xe2\x86\x92\xb0z"; /* a, micro, arrow, a degree sign in Latin-1, z */
    ck_assert_uint_eq(r_nextCharacter(&text), 'a');
    ck_assert_uint_eq(r_nextCharacter(&text), 0xb5);
    ck_assert_uint_eq(r_nextCharacter(&text), 0x2192);
    ck_assert_uint_eq(r_nextCharacter(&text), 0xb0);
    ck_assert_uint_eq(r_nextCharacter(&text), 'z');
    ck_assert_int_eq(*text, 0);
    text = "\xe2"; /* Cut in the middle of a character. */
    ck_assert_uint_eq(r_nextCharacter(&text), 0xe2);
    ck_assert_int_eq(*text, 0);
}

static double width(const char *text, float size) {
    return (double)r_uiTextSize(text, size, 0, NULL);
}

TEST(widths) {
    float height;
    ROverlay overlay = {.vertices = {0}};
    ck_assert(r_panelsStart(rc));
    r_panelsBegin(rc);
    assert_near(width("", 10), 0, 0);
    assert_near(width("ab", 20), 2 * width("ab", 10), 1.01); /* ImGui rounds up to pixels. */
    assert_near(width("abc\na", 10), width("abc", 10), 0);
    assert_below(width("i", 10), width("W", 10));
    assert_near(width("\xe4\xb8\xad", 10), width("?", 10), 0); /* A character that the font lacks. */
    assert_near(width("\xb0", 10), width("\xc2\xb0", 10), 0);  /* A degree sign in Latin-1, and in UTF-8. */
    assert_below(r_uiTextSize("some words that are long", 10, 40, &height), 40);
    assert_below(2 * 10, height);
    r_panelsEnd(rc, &overlay);
    r_overlayFree(&overlay);
}

/* Everything is inside of the panel, and what is laid over the picture is cut nowhere. */
TEST(help_fits_any_window) {
    static const char *const sizes[] = {"-null -size 320x240", "-null -size 960x600", "-null -size 3840x2160",
                                        "-null -size 1600x200", "-null -size 200x1600"};
    static const double smallest[] = {6.5, 13, 35, 7, 5};
    char *help[] = {"$ACTION1 - toggle options menu",
                    "$ACTION2 - reset",
                    "$MOUSE - apply mouse force, which is a rather long line that does not fit into a small window",
                    "Just a sentence.",
                    "andawordthathasnoplacewhereitcanbebrokenandgoesonandonandonandonandonandon",
                    ""};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        RRender *own = make_context(sizes[i]);
        const RHelpLayout *l = &own->m_pViewer->helpLayout;
        ROverlay *overlay = &own->m_pViewer->overlay;
        RRenderCreateUserHelp(own, help, 6);
        RRenderToggleUserHelp(own);
        ck_assert(r_panelsStart(own));
        r_hudDraw(own, overlay);
        ck_assert(l->left >= 0 && l->top >= 0);
        ck_assert(l->right <= (float)own->m_pViewer->width && l->bottom <= (float)own->m_pViewer->height);
        assert_below(smallest[i], l->size);
        ck_assert_uint_gt(overlay->vertices.count, 1000);
        for (size_t k = 0; k < overlay->vertices.count; k++) {
            const ROverlayVertex *v = &overlay->vertices.items[k];
            ck_assert(v->x >= l->left - 1.01f && v->x <= l->right + 1.01f);
            ck_assert(v->y >= l->top - 1.01f && v->y <= l->bottom + 1.01f);
        }
        RRenderContextDestroy(own);
    }
}

/* A status line that is longer than the window is wide goes on in another line: nothing is cut. */
TEST(a_status_line_is_never_cut) {
    static const char *const sizes[] = {"-null -size 320x240", "-null -size 960x600", "-null -size 480x300"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        RRender *own = make_context(sizes[i]);
        const ROverlay *o = &own->m_pViewer->overlay;
        RRenderSetStatusText(own,
                             "joints open at most 0.0000 mm    limits passed by 0.0002 rad, now by 0.0000    lowest "
                             "head at 4.97 m    awake 88    motion 4059.40 J");
        ck_assert(r_panelsStart(own));
        r_hudDraw(own, &own->m_pViewer->overlay);
        ck_assert_uint_gt(o->vertices.count, 400); /* Four for each letter. */
        for (size_t k = 0; k < o->vertices.count; k++) {
            ck_assert(o->vertices.items[k].x >= 0 && o->vertices.items[k].x <= (float)own->m_pViewer->width);
            ck_assert(o->vertices.items[k].y >= 0 && o->vertices.items[k].y <= (float)own->m_pViewer->height);
        }
        RRenderContextDestroy(own);
    }
}

typedef struct {
    float left, top, right, bottom;
} Bounds;

/* Of the letters, which have four vertices each, from one to before another, counted from the end. */
static Bounds boundsOf(const ROverlay *o, int from, int to) {
    Bounds b = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t k = o->vertices.count - 4 * (size_t)from; k < o->vertices.count - 4 * (size_t)to; k++) {
        const ROverlayVertex *v = &o->vertices.items[k];
        b = (Bounds){fminf(b.left, v->x), fminf(b.top, v->y), fmaxf(b.right, v->x), fmaxf(b.bottom, v->y)};
    }
    return b;
}

/* At every width of the window: no number is broken, nor parted from its unit, and the hint is beside or above. */
TEST(a_status_line_keeps_numbers_whole_and_clear_of_the_hint) {
    enum { ALL = 48, GROUP = 14, HINT = 15 }; /* Letters without spaces. */
    int isBeside = 0, isAbove = 0;
    for (int width = 320; width < 1300; width += 7) {
        char options[64];
        snprintf(options, sizeof options, "-null -size %dx600", width);
        RRender *own = make_context(options);
        const ROverlay *o = &own->m_pViewer->overlay;
        const float line = 1.4f * 13 * r_uiScale(own);
        RBackend seen = *own->m_pViewer->backend;
        RRenderSetStatusText(own, "top at 20.0000 m    awake 0 of 21    contacts 102    motion 4059.40 J");
        ck_assert(r_panelsStart(own));
        r_hudDraw(own, &own->m_pViewer->overlay);
        const Bounds last = boundsOf(o, GROUP, 0), all = boundsOf(o, ALL, 0);
        assert_below(last.bottom - last.top, line);
        seen.window = true;
        own->m_pViewer->backend = &seen;
        r_hudDraw(own, &own->m_pViewer->overlay);
        const Bounds hint = boundsOf(o, HINT, 0);
        ck_assert(hint.left > all.right || hint.bottom < all.top);
        ck_assert(hint.left >= 0 && hint.right <= (float)width);
        isBeside += hint.bottom > all.top;
        isAbove += hint.bottom < all.top;
        RRenderContextDestroy(own);
    }
    ck_assert(isBeside > 10 && isAbove > 10);
}

/* A key and its text are divided by the first " - ", and by ": " only in a line without that. */
TEST(help_lines_are_not_split_at_a_colon_in_their_text) {
    static const char *const one[] = {"$ACTION1 - start: again"}, *const other[] = {"Space\tstart: again"};
    float panels[2];
    for (int i = 0; i < 2; i++) {
        RRender *own = make_context("-null");
        RRenderCreateUserHelp(own, i ? other : one, 1);
        RRenderToggleUserHelp(own);
        ck_assert(r_panelsStart(own));
        r_hudDraw(own, &own->m_pViewer->overlay);
        panels[i] = own->m_pViewer->helpLayout.right - own->m_pViewer->helpLayout.left;
        RRenderContextDestroy(own);
    }
    assert_near(panels[0], panels[1], 0);
}

/* The panel of a help of one line. */
static float widthOfHelp(const char *line) {
    RRender *own = make_context("-null");
    RRenderCreateUserHelp(own, &line, 1);
    RRenderToggleUserHelp(own);
    ck_assert(r_panelsStart(own));
    r_hudDraw(own, &own->m_pViewer->overlay);
    const float width = own->m_pViewer->helpLayout.right - own->m_pViewer->helpLayout.left;
    RRenderContextDestroy(own);
    return width;
}

/* Words before a colon are a sentence, laid out like the same one without a colon; one word is a key. */
TEST(help_sentences_are_not_split_at_a_colon) {
    const float sentence = widthOfHelp("First a chair: a seat and four legs that are thrown about in here");
    assert_near(sentence, widthOfHelp("First a chair; a seat and four legs that are thrown about in here"), 0);
    assert_near(widthOfHelp("Enter: jump over all of the things that are lying about in here, twice"),
                widthOfHelp("Enter - jump over all of the things that are lying about in here, twice"), 0);
}

TEST(help_of_all_kinds) {
    const char *const constant[] = {"a", "b"};
    const char *variable[] = {"a"};
    RRenderCreateUserHelp(rc, constant, 2);
    ck_assert_uint_eq(rc->m_pViewer->help.lines.count, 2);
    RRenderCreateUserHelp(rc, variable, 1); /* Takes the place of the first ones. */
    ck_assert_uint_eq(rc->m_pViewer->help.lines.count, 1);
    RRenderCreateUserHelp(rc, NULL, 0);
    ck_assert_uint_eq(rc->m_pViewer->help.lines.count, 0);
    RRenderCreateUserHelp(rc, NULL, 2);
    assert_warned("null");
    RRenderCreateUserHelp(rc, constant, -1);
    assert_warned("-1");
}

TEST(toggling_help_toggles_pause) {
    RRenderToggleUserHelp(rc);
    ck_assert_int_eq(rc->m_bShowHelp, 1);
    ck_assert_int_eq(rc->m_bPause, 1);
    RRenderToggleUserHelp(rc);
    ck_assert_int_eq(rc->m_bShowHelp, 0);
    ck_assert_int_eq(rc->m_bPause, 0);
    RRenderSetPause(rc, 1); /* What was paused before is paused afterwards. */
    RRenderToggleUserHelp(rc);
    RRenderToggleUserHelp(rc);
    ck_assert_int_eq(rc->m_bPause, 1);
}
