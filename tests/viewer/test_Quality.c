/* The choice of a picture's quality (r_quality.c): made-up machines, on which a level costs what the test says. */
#include "viewer_test.h"

#include "r_i.h"

static const int64_t MS = 1000000;

/* So many seconds of frames; `cost` is drawing's at each level, ms, `tick` the rest of a frame. Counts changes. */
static int run(RQuality *q, int seconds, const double cost[4], double tick) {
    int changes = 0;
    for (double elapsed = 0; elapsed < 1000. * seconds;) {
        const int level = q->level;
        const double drawing = cost[level], frame = drawing + tick;
        r_qualityFrame(q, (int64_t)(frame * (double)MS), (int64_t)(drawing * (double)MS));
        changes += q->level != level;
        elapsed += frame > 1000. / 60 ? frame : 1000. / 60;
    }
    return changes;
}

static RQuality fresh(void) {
    RQuality q;
    r_qualityRestart(&q);
    return q;
}

/* Software OpenGL at 960x600. */
TEST(it_goes_down_until_thirty_frames_a_second_hold) {
    RQuality q = fresh();
    ck_assert_int_eq(q.level, R_QUALITY_FULL);
    ck_assert_int_eq(run(&q, 4, (const double[]){22, 39, 70, 110}, 1), 3);
    ck_assert_int_eq(q.level, 0);
    ck_assert_int_eq(run(&q, 60, (const double[]){22, 39, 70, 110}, 1), 0);
    q = fresh();
    ck_assert_int_eq(run(&q, 60, (const double[]){12, 18, 28, 45}, 1), 1);
    ck_assert_int_eq(q.level, 2);
}

TEST(a_fast_machine_keeps_full_quality) {
    RQuality q = fresh();
    ck_assert_int_eq(run(&q, 60, (const double[]){1, 2, 3, 4}, 5), 0);
    ck_assert_int_eq(run(&q, 60, (const double[]){16.7, 16.7, 16.7, 16.7}, 0), 0); /* It waits for the screen. */
    ck_assert_int_eq(q.level, R_QUALITY_FULL);
}

/* However long all was well, a scene that becomes heavy is answered within a second or so a level. */
TEST(it_is_lowered_soon) {
    RQuality q = fresh();
    run(&q, 600, (const double[]){10, 15, 17, 60}, 0); /* Full has been tried in vain, and is put off for long. */
    ck_assert_int_eq(q.level, 2);
    for (int i = 0; i < 200; i++)
        r_qualityFrame(&q, 17 * MS, 17 * MS);
    ck_assert_int_eq(run(&q, 1, (const double[]){15, 25, 70, 120}, 0), 1);
    ck_assert_int_eq(q.level, 1);
}

/* One frame of .3 s among short ones, as when a window is dragged or a file is read. */
TEST(a_hiccup_changes_nothing) {
    RQuality q = fresh();
    for (int i = 0; i < 1200; i++) {
        const int64_t drawing = i % 60 == 0 ? 300 * MS : 10 * MS;
        r_qualityFrame(&q, drawing + MS, drawing);
        ck_assert_int_eq(q.level, R_QUALITY_FULL);
    }
}

TEST(slow_physics_does_not_cost_quality) {
    RQuality q = fresh();
    ck_assert_int_eq(run(&q, 60, (const double[]){5, 7, 10, 15}, 40), 0);
    ck_assert_int_eq(q.level, R_QUALITY_FULL);
}

/* The scene becomes heavy, and light again. */
TEST(it_comes_back_up) {
    RQuality q = fresh();
    run(&q, 10, (const double[]){20, 36, 60, 90}, 1);
    ck_assert_int_eq(q.level, 0);
    ck_assert_int_eq(run(&q, 10, (const double[]){4, 7, 12, 17}, 0), 3);
    ck_assert_int_eq(q.level, R_QUALITY_FULL);
    run(&q, 10, (const double[]){20, 36, 60, 90}, 1);
    ck_assert_int_eq(q.level, 0);
    /* Also where a frame always takes 1/60 s, because it waits for the screen. */
    run(&q, 10, (const double[]){16.7, 16.7, 16.7, 16.7}, 0);
    ck_assert_int_eq(q.level, R_QUALITY_FULL);
}

/* As long as a level costs less than 1.9 times the one below, it does not swing; if it costs more, less and less
 * often. */
TEST(it_does_not_swing) {
    for (double min = 4; min < 40; min += 0.25) {
        RQuality q = fresh();
        const double cost[] = {min, 1.86 * min, 1.86 * 1.78 * min, 1.86 * 1.78 * 1.4 * min};
        run(&q, 10, cost, 0.5);
        ck_assert_int_eq(run(&q, 60, cost, 0.5), 0);
    }
    RQuality q = fresh();
    const double cost[] = {10, 15, 17, 60}; /* Only full is too much, by far. */
    const int early = run(&q, 60, cost, 0), late = run(&q, 240, cost, 0);
    ck_assert_int_eq(early % 2, 1);
    ck_assert_int_le(early, 9); /* 2, 4, 8, 16 s apart, and the first */
    ck_assert_int_le(late, 2 * 240 / 60);
}

/* Buffers and shaders of a level are made in its first frame, which takes long. */
TEST(the_first_frame_of_a_level_does_not_count) {
    RQuality q = fresh();
    run(&q, 1, (const double[]){10, 15, 20, 50}, 0);
    ck_assert_int_eq(q.level, 2);
    q = fresh();
    while (q.level == R_QUALITY_FULL)
        r_qualityFrame(&q, 50 * MS, 50 * MS);
    r_qualityFrame(&q, 5000 * MS, 5000 * MS);
    for (int i = 0; i < 100; i++)
        r_qualityFrame(&q, 20 * MS, 20 * MS);
    ck_assert_int_eq(q.level, 2);
}

TEST(setting_it) {
    RRender *rc = make_context("-null");
    ck_assert_int_eq(r_pictureQuality(rc), R_QUALITY_AUTO);
    ck_assert_int_eq(RRenderGetPictureQuality(rc), R_QUALITY_FULL); /* Without a window. */
    RRenderSetPictureQuality(rc, 1);
    ck_assert_int_eq(r_pictureQuality(rc), 1);
    assert_refused(RRenderSetPictureQuality, rc, 4);
    assert_refused(RRenderSetPictureQuality, rc, -2);
    assert_refused(RRenderSetPictureQuality, NULL, 1);
    assert_refused(RRenderGetPictureQuality, NULL);
    ck_assert_int_eq(r_pictureQuality(rc), 1);
    RRenderContextDestroy(rc);
    rc = make_context("-null -quality 2");
    RRenderSetPictureQuality(rc, 1); /* The option wins. */
    ck_assert_int_eq(r_pictureQuality(rc), 2);
    RRenderContextDestroy(rc);
    rc = make_context("-null -quality auto");
    ck_assert_int_eq(r_pictureQuality(rc), R_QUALITY_AUTO);
    RRenderContextDestroy(rc);
    assert_silent();
    rc = make_context("-null -quality 4");
    assert_warned("-quality");
    RRenderContextDestroy(rc);
}

/* Pictures of files do not depend on it. */
TEST(an_off_screen_picture_is_full) {
    RPicture p[2];
    static const char *const options[] = {"-osmesa -size 96x64", "-osmesa -size 96x64 -quality 0"};
    for (int i = 0; i < 2; i++) {
        RRender *rc = make_context(options[i]);
        RGraphicGroundPlaneCreate(rc, 24, 2, WHITE, 0);
        RCameraSetView(rc, 6, 0.4f, 0.3f);
        RGraphicSphereCreate(rc, 1, RED, NULL);
        r_frame(rc, NULL);
        r_drawNow(rc);
        ck_assert_int_eq(RRenderGetPictureQuality(rc), R_QUALITY_FULL);
        ck_assert(r_drawRead(rc, &p[i]));
        RRenderContextDestroy(rc);
    }
    ck_assert_mem_eq(p[0].rgba, p[1].rgba, 4 * 96 * 64);
    r_free(p[0].rgba);
    r_free(p[1].rgba);
}
