/* What the command line does: which options win, what is eaten, what is refused. */
#define _DEFAULT_SOURCE /* setenv */
#include "viewer_test.h"

TEST(defaults) {
    RRender *rc = make_context("-null");
    ck_assert_int_eq(rc->m_RenderType, kRNull);
    ck_assert_int_eq(rc->m_Options.m_nWidth, 960);
    ck_assert_int_eq(rc->m_Options.m_nHeight, 600);
    ck_assert_int_eq(rc->m_Options.m_nFrames, 0);
    ck_assert_int_eq(rc->m_bPause, 0);
    RRenderContextDestroy(rc);
}

TEST(everything) {
    RRender *rc = make_context("-bench -size 640x480 -frames 7 -every 2 -camera 20,0.5,-0.25 -paused -bar -profile "
                               "-screenshot ./b.png -key F1@3");
    const RRenderOptions *o = &rc->m_Options;
    ck_assert_int_eq(rc->m_RenderType, kRBenchmark);
    ck_assert_int_eq(o->m_nWidth, 640);
    ck_assert_int_eq(o->m_nHeight, 480);
    ck_assert_int_eq(o->m_nFrames, 7);
    ck_assert_int_eq(o->m_nEvery, 2);
    ck_assert(o->m_bCamera && o->m_bBar && o->m_bProfile && o->m_bPaused && rc->m_bPause);
    assert_vec3_near(o->m_Camera, 20, 0.5, -0.25, 0);
    ck_assert_str_eq(o->m_Screenshot, "./b.png");
    ck_assert_str_eq(o->m_Keys, "F1@3");
    RRenderContextDestroy(rc);
}

TEST(the_first_place_wins) {
    RRender *rc = make_context("-null -osmesa");
    ck_assert_int_eq(rc->m_RenderType, kRNull);
    RRenderContextDestroy(rc);
    rc = make_context("-bench -null -gl");
    ck_assert_int_eq(rc->m_RenderType, kRBenchmark);
    RRenderContextDestroy(rc);
}

TEST(overriding_options_win) {
    MeCommandLineOptions *options = make_options("-gl -size 100x100 -frames 5"),
                         *over = make_options("-null -size 50x50");
    RRender *rc = RRenderContextCreate(options, over, 0);
    ck_assert_ptr_nonnull(rc);
    ck_assert_int_eq(rc->m_RenderType, kRNull);
    ck_assert_int_eq(rc->m_Options.m_nWidth, 50);
    ck_assert_int_eq(rc->m_Options.m_nFrames, 5);
    ck_assert_int_eq(options->argc, 6); /* Not eaten. */
    ck_assert_int_eq(over->argc, 4);
    RRenderContextDestroy(rc);
    MeCommandLineOptionsDestroy(options);
    MeCommandLineOptionsDestroy(over);
}

TEST(eating) {
    MeCommandLineOptions *options = make_options("-mine -null -size 100x100 -frames 5 -paused file -camera 1,0,0 -gl");
    MeCommandLineOptions *over = make_options("-bench -frames 3 -yours");
    RRender *rc = RRenderContextCreate(options, over, 1);
    ck_assert_int_eq(options->argc, 3);
    ck_assert_str_eq(options->argv[1], "-mine");
    ck_assert_str_eq(options->argv[2], "file");
    ck_assert_int_eq(over->argc, 2);
    ck_assert_str_eq(over->argv[1], "-yours");
    ck_assert_int_eq(rc->m_Options.m_nFrames, 3);
    RRenderContextDestroy(rc);
    MeCommandLineOptionsDestroy(options);
    MeCommandLineOptionsDestroy(over);
}

/* For programs that pass no options on. */
TEST(options_of_the_environment) {
    setenv("KARMA_VIEWER", "  -null -frames\t600 -size 100x50 -paused ", 1);
    RRender *rc = RRenderContextCreate(NULL, NULL, 1);
    ck_assert_ptr_nonnull(rc);
    ck_assert_int_eq(rc->m_RenderType, kRNull);
    ck_assert_int_eq(rc->m_Options.m_nFrames, 600);
    ck_assert_int_eq(rc->m_Options.m_nWidth, 100);
    ck_assert_int_eq(rc->m_bPause, 1);
    RRenderContextDestroy(rc);
    rc = make_context("-bench -frames 7"); /* The command line wins. */
    ck_assert_int_eq(rc->m_RenderType, kRBenchmark);
    ck_assert_int_eq(rc->m_Options.m_nFrames, 7);
    ck_assert_int_eq(rc->m_Options.m_nWidth, 100);
    RRenderContextDestroy(rc);
    setenv("KARMA_VIEWER", "-null -fames 600", 1);
    rc = RRenderContextCreate(NULL, NULL, 1);
    ck_assert_int_eq(caught.warnings, 1); /* Of the word and its value one. */
    assert_warned("-fames is no option: write -frames");
    RRenderContextDestroy(rc);
    unsetenv("KARMA_VIEWER");
}

TEST(bad_values_are_told_and_ignored) {
    static const struct {
        const char *line, *word;
    } tries[] = {{"-null -size 100", "-size"},
                 {"-null -size 4x4", "-size"},
                 {"-null -size 99999x10", "-size"},
                 {"-null -size 100x100x", "-size"},
                 {"-null -frames -5", "-frames"},
                 {"-null -frames many", "-frames"},
                 {"-null -frames 3.5", "-frames"},
                 {"-null -every 0", "-every"},
                 {"-null -camera 1,2", "-camera"},
                 {"-null -camera -1,0,0", "-camera"},
                 {"-null -camera nan,0,0", "-camera"},
                 {"-null -key F1", "-key"},
                 {"-null -key Foo@3", "-key"},
                 {"-null -key F1@0", "-key"},
                 {"-null -key F1@5-4", "-key"},
                 {"-null -key F1@5-", "-key"},
                 {"-null -key F1@3x", "-key"},
                 {"-null -frames", "-frames VALUE"},
                 {"-null -screenshot no/such/a.png", "no directory no/such"},
                 {"-null -film no/a.mp4", "no directory no:"}};
    for (size_t i = 0; i < sizeof tries / sizeof tries[0]; i++) {
        RRender *rc = make_context(tries[i].line);
        ck_assert_int_eq(caught.warnings, 1);
        assert_warned(tries[i].word);
        ck_assert_int_eq(rc->m_Options.m_nWidth, 960);
        ck_assert_int_eq(rc->m_Options.m_nFrames, 0);
        ck_assert_int_eq(rc->m_Options.m_bCamera, 0);
        ck_assert_str_eq(rc->m_Options.m_Screenshot, "");
        ck_assert_str_eq(rc->m_Options.m_Film, "");
        RRenderContextDestroy(rc);
    }
}

static RRender *seen;

static void MEAPI onCreate(RRender *rc) {
    seen = rc;
    ck_assert_int_eq(rc->m_Options.m_nFrames, 9);
    rc->m_Options.m_Type = kRNull; /* Not started yet: it may still choose. */
}

TEST(the_create_callback) {
    MeCommandLineOptions *options = make_options("-gl -frames 9");
    RRender *rc = RRenderContextCreate2(options, NULL, 0, NULL, onCreate);
    ck_assert_ptr_nonnull(rc);
    ck_assert_ptr_eq(rc, seen);
    ck_assert_int_eq(rc->m_RenderType, kRNull);
    RRenderContextDestroy(rc);
    MeCommandLineOptionsDestroy(options);
}

TEST(no_window_without_a_display) {
    setenv("DISPLAY", ":54321", 1);
    MeCommandLineOptions *options = make_options("-gl");
    ck_assert_ptr_null(RRenderContextCreate(options, NULL, 0));
    assert_warned("-osmesa");
    ck_assert_ptr_null(RRenderContextCreate(options, NULL, 0)); /* And again. */
    assert_warned(":54321");
    MeCommandLineOptionsDestroy(options);
}
