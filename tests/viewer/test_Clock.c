/* Ticks follow the clock (r_clock.c): a made-up clock, on which frames and ticks take what the test says. */
#include "karma_test.h"
#include "r_i.h"

static const int64_t MS = 1000000, SECOND = 1000000000;

/* So many seconds in frames that take `frame` to draw, and `tick` for each tick; returns how many ticks there were. */
static int run(RClock *c, int64_t *now, int seconds, int64_t frame, int64_t tick, double rate) {
    const int64_t end = *now + seconds * SECOND;
    int ticks = 0;
    while (*now < end) {
        r_clockFrame(c, *now);
        for (; r_clockCountTicks(c, *now, rate); ticks++)
            *now += tick;
        *now += frame;
    }
    return ticks;
}

static RClock start(int64_t *now) {
    RClock c;
    *now = 5 * SECOND;
    r_clockRestart(&c, *now);
    return c;
}

TEST(frames_on_time_have_one_tick_each) {
    int64_t now;
    RClock c = start(&now);
    for (int i = 1; i <= 600; i++) {
        const int64_t late = (i * 7919) % (3 * MS); /* threads wake when they may */
        r_clockFrame(&c, 5 * SECOND + i * SECOND / 60 + late);
        ck_assert(r_clockCountTicks(&c, c.begun, 60));
        ck_assert(!r_clockCountTicks(&c, c.begun, 60));
    }
    ck_assert_double_eq_tol(c.pace, 1, .01);
}

TEST(slow_frames_have_as_many_ticks_as_time_has_passed) {
    static const int frames[] = {17, 40, 100, 250}; /* ms: 60 to 4 frames a second */
    static const double rates[] = {20, 60, 100};
    for (int f = 0; f < 4; f++)
        for (int r = 0; r < 3; r++) {
            int64_t now;
            RClock c = start(&now);
            const int ticks = run(&c, &now, 10, frames[f] * MS, MS / 100, rates[r]);
            ck_assert_double_eq_tol(ticks, 10 * rates[r], .03 * 10 * rates[r] + 1);
            ck_assert_double_eq_tol(c.pace, 1, .05);
        }
}

/* 40 ms of physics for 1/60 s: a frame has one tick, as one is more than the budget, and time is lost. */
TEST(ticks_that_take_too_long_slow_the_simulation_and_not_the_window) {
    int64_t now;
    RClock c = start(&now);
    const int ticks = run(&c, &now, 10, 10 * MS, 40 * MS, 60);
    ck_assert_int_eq(ticks, 200); /* 10 s of frames of 50 ms */
    ck_assert_double_eq_tol(c.pace, (1. / 60) / .05, .01);
}

TEST(what_was_owed_before_a_pause_is_forgotten) {
    int64_t now;
    RClock c = start(&now);
    run(&c, &now, 2, 10 * MS, 40 * MS, 60);
    now += 3600 * SECOND;
    r_clockRestart(&c, now);
    r_clockFrame(&c, now + SECOND / 60);
    ck_assert(r_clockCountTicks(&c, now, 60) && !r_clockCountTicks(&c, now, 60));
    ck_assert_double_eq(c.pace, 1);
}

/* A stopped process, or a window that was dragged, for a minute: a quarter of a second of it is simulated. */
TEST(a_long_stall_is_not_caught_up_with) {
    int64_t now;
    RClock c = start(&now);
    int ticks = 0;
    now += 60 * SECOND;
    for (r_clockFrame(&c, now); r_clockCountTicks(&c, now, 60);)
        ticks++;
    ck_assert_int_eq(ticks, 15);
}
