/* Sections, frames, what happens when they do not match, reports, the stopwatch.
 *
 * Times have lower bounds, from waits that read the same clock; upper bounds come from other times, never
 * from how fast the machine is. */
#include "karma_test.h"

#include "MeProfile.h"
#include <threads.h>

static const MeProfileTimerMode mode = {kMeProfileCounterModeFlops};

static void start(MeProfileLogModes_enum logging) {
    MeProfileStartTiming(mode, logging);
}

static void stop(void) {
    MeProfileStopTiming();
    assert_silent();
}

/* Seconds since the first call. */
static double now(void) {
    static MeU64 origin;
    MeProfileTimerResult result;
    MeProfileGetTimerValue(&result);
    if (origin == 0)
        origin = result.ticks;
    return (double)(result.ticks - origin) / (double)MeProfileGetClockSpeed();
}

/* Keeps busy for at least 2 milliseconds. */
static const double waiting = 0.002;

static void spend(void) {
    const double begin = now();
    while (now() - begin < waiting) {
    }
}

/* Single precision rounds times: this much of them is allowed for. */
static const double rounding = 1e-6;

static double timeOf(const char *name) {
    return (double)MeProfileGetSectionTime(name);
}

static void assertNotBelow(double time, double min) {
    ck_assert_msg(time >= min * (1 - rounding), "%g seconds, expected at least %g", time, min);
}

/* ---- sections ---- */

TEST(clock_counts_seconds) {
    const double begin = now();
    spend();
    assertNotBelow(now() - begin, waiting);
    assert_refused(MeProfileGetTimerValue, NULL);
}

TEST(inner_time_counts_for_the_outer) {
    start(kMeProfileDontLog);
    const double begin = now();
    MeProfileStartFrame();
    MeProfileStartSection("outer", 0);
    spend();
    for (int i = 0; i < 2; i++) {
        MeProfileStartSection("inner", 0);
        spend();
        MeProfileEndSection("inner");
    }
    MeProfileEndSection("outer");
    MeProfileStartSection("other", 0);
    spend();
    MeProfileEndSection("other");
    MeProfileEndFrame();
    const double whole = now() - begin;
    assertNotBelow(timeOf("inner"), 2 * waiting);
    assertNotBelow(timeOf("outer"), timeOf("inner") + waiting);
    assertNotBelow(timeOf("other"), waiting);
    assertNotBelow(whole, (double)MeProfileGetAllSectionTime());
    assert_near_rel(MeProfileGetAllSectionTime(), timeOf("outer") + timeOf("other"), rounding);
    stop();
}

/* Of the same name in several places, and not as a pointer but as text. */
TEST(sections_are_told_apart_by_text_and_place) {
    char name[] = "solve";
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    MeProfileStartSection("solve", 0);
    spend();
    MeProfileEndSection(name);
    MeProfileEndSection("a");
    MeProfileStartSection("b", 0);
    MeProfileStartSection(name, 0);
    name[0] = 'S';
    spend();
    MeProfileEndSection("solve");
    MeProfileEndSection("b");
    MeProfileEndFrame();
    assertNotBelow(timeOf("solve"), 2 * waiting);
    assertNotBelow((double)MeProfileGetAllSectionTime(), timeOf("solve"));
    ck_assert(timeOf("Solve") == 0);
    ck_assert(MeProfileGetSectionTime("unknown") == 0);
    ck_assert(MeProfileGetSectionTime(NULL) == 0);
    ck_assert(MeProfileGetSectionTime("") == 0);
    stop();
}

TEST(recursion_is_not_counted_twice) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    for (int i = 0; i < 3; i++)
        MeProfileStartSection("a", 0);
    spend();
    for (int i = 0; i < 3; i++)
        MeProfileEndSection("a");
    MeProfileEndFrame();
    assertNotBelow(timeOf("a"), waiting);
    assert_near_rel(timeOf("a"), MeProfileGetAllSectionTime(), 0);
    stop();
}

TEST(auto_stop_sections_follow_one_another) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("step", 0);
    MeProfileStartSection("collide", 1);
    spend();
    MeProfileStartSection("solve", 1);
    spend();
    MeProfileEndSection("step"); /* ends "solve" too, without a word */
    MeProfileStartSection("draw", 0);
    spend();
    MeProfileEndSection("draw");
    MeProfileEndFrame();
    assertNotBelow(timeOf("collide"), waiting);
    assertNotBelow(timeOf("solve"), waiting);
    assertNotBelow(timeOf("step"), timeOf("collide") + timeOf("solve"));
    assert_near_rel(MeProfileGetAllSectionTime(), timeOf("step") + timeOf("draw"), rounding);
    stop();
}

/* Only an auto-stop section is ended by the next, and only by an auto-stop one. */
TEST(auto_stop_needs_both) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("plain", 0);
    MeProfileStartSection("auto", 1);
    MeProfileStartSection("in auto", 0);
    spend();
    MeProfileEndSection("in auto");
    MeProfileEndSection("auto");
    MeProfileEndSection("plain");
    MeProfileEndFrame();
    assertNotBelow(timeOf("auto"), timeOf("in auto"));
    assertNotBelow(timeOf("plain"), timeOf("auto"));
    assert_near_rel(timeOf("plain"), MeProfileGetAllSectionTime(), 0);
    stop();
}

/* ---- frames ---- */

TEST(times_are_those_of_the_last_frame) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    spend();
    MeProfileEndSection("a");
    ck_assert(timeOf("a") == 0); /* the frame is not finished */
    MeProfileStartFrame();       /* which finishes the first */
    assertNotBelow(timeOf("a"), waiting);
    MeProfileEndFrame();
    ck_assert(timeOf("a") == 0 && MeProfileGetAllSectionTime() == 0);
    stop();
}

TEST(an_end_without_a_frame_does_nothing) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    spend();
    MeProfileEndSection("a");
    MeProfileEndFrame();
    MeProfileEndFrame();
    assertNotBelow(timeOf("a"), waiting);
    stop();
}

TEST(time_outside_of_frames_is_in_no_frame) {
    start(kMeProfileDontLog);
    MeProfileStartSection("a", 0);
    spend();
    MeProfileEndSection("a");
    MeProfileStartFrame();
    MeProfileEndFrame();
    ck_assert(timeOf("a") == 0);
    stop();
}

TEST(sections_are_split_by_frames) {
    start(kMeProfileDontLog);
    MeProfileStartSection("a", 0);
    spend();
    const double begin = now();
    MeProfileStartFrame();
    spend();
    MeProfileEndFrame();
    const double whole = now() - begin;
    assertNotBelow(timeOf("a"), waiting);
    assertNotBelow(whole, timeOf("a"));
    MeProfileStartFrame();
    MeProfileEndSection("a");
    MeProfileEndFrame();
    assertNotBelow(whole, timeOf("a"));
    stop();
}

TEST(results_outlive_the_timers) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    spend();
    MeProfileStopTimers();
    const double time = timeOf("a");
    assertNotBelow(time, waiting);
    MeProfileStartFrame();
    MeProfileStartSection("b", 0);
    spend();
    MeProfileEndSection("b");
    MeProfileEndFrame();
    MeProfileStopTimers();
    assert_near(timeOf("a"), time, 0);
    ck_assert(timeOf("b") == 0);
    MeProfileStopTiming();
    ck_assert(timeOf("a") == 0 && MeProfileGetAllSectionTime() == 0);
    stop();
}

TEST(starting_again_forgets) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    MeProfileStartTiming(mode, kMeProfileLogTotals);
    ck_assert(timeOf("a") == 0);
    MeProfileStartSection("b", 0); /* not inside "a" */
    MeProfileEndSection("b");
    stop();
}

TEST(nothing_happens_while_off) {
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    MeProfileStartSection(NULL, 0);
    MeProfileEndSection("b");
    MeProfileEndSection(NULL);
    MeProfileEndFrame();
    MeProfileStopTimers();
    MeProfileStopTiming();
    ck_assert(MeProfileGetSectionTime("a") == 0 && MeProfileGetAllSectionTime() == 0);
}

/* ---- what does not match ---- */

TEST(ends_without_a_beginning_warn_once) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("a", 0);
    MeProfileEndSection("b");
    assert_warned("'b' has not been started");
    MeProfileEndSection("b");
    MeProfileEndSection(NULL);
    MeProfileEndSection("");
    spend();
    MeProfileEndSection("a");
    MeProfileEndSection("a");
    MeProfileEndFrame();
    assert_silent();
    assertNotBelow(timeOf("a"), waiting);
    MeProfileStartTiming(mode, kMeProfileDontLog);
    MeProfileEndSection("b");
    assert_warned("'b'");
    stop();
}

TEST(inner_sections_end_with_the_outer) {
    start(kMeProfileDontLog);
    MeProfileStartFrame();
    MeProfileStartSection("outer", 0);
    MeProfileStartSection("inner", 0);
    MeProfileStartSection("auto", 1);
    spend();
    MeProfileEndSection("outer");
    assert_warned("'outer' ends before");
    MeProfileStartSection("next", 0);
    spend();
    MeProfileEndSection("next");
    MeProfileEndFrame();
    assertNotBelow(timeOf("inner"), waiting);
    assertNotBelow(timeOf("outer"), timeOf("inner"));
    assert_near_rel(MeProfileGetAllSectionTime(), timeOf("outer") + timeOf("next"), rounding);
    stop();
}

static int markElsewhere(void *unused) {
    (void)unused;
    MeProfileStartFrame();
    MeProfileStartSection("elsewhere", 0);
    MeProfileEndSection("here");
    MeProfileEndFrame();
    MeProfileStopTimers();
    return 0;
}

TEST(other_threads_are_not_timed) {
    thrd_t thread;
    start(kMeProfileLogTotals);
    MeProfileStartFrame();
    MeProfileStartSection("here", 0);
    ck_assert_int_eq(thrd_create(&thread, markElsewhere, NULL), thrd_success);
    thrd_join(thread, NULL);
    spend();
    MeProfileEndSection("here");
    MeProfileEndFrame();
    assertNotBelow(timeOf("here"), waiting);
    ck_assert(timeOf("elsewhere") == 0);
    stop();
}

TEST(null_names_warn) {
    start(kMeProfileDontLog);
    assert_refused(MeProfileStartSection, NULL, 0);
    stop();
}

/* ---- reports ---- */

#define REPORT "test_MeProfile.txt"

/* The lines of a file that is then removed. */
static struct {
    int count;
    char lines[64][160];
} report;

static void readReport(void) {
    FILE *const file = fopen(REPORT, "r");
    ck_assert_ptr_nonnull(file);
    report.count = 0;
    while (report.count < 64 && fgets(report.lines[report.count], sizeof report.lines[0], file))
        report.count++;
    fclose(file);
    remove(REPORT);
}

static void makeReport(MeProfileOutput_enum format) {
    MeProfileSetOutputParameters((MeProfileOutput){format, REPORT});
    MeProfileOutputResults();
    assert_silent();
    readReport();
}

static void assertColumns(int line, int numbers, const char *name, double *values) {
    char *at = report.lines[line] + strlen(name);
    ck_assert_msg(strncmp(report.lines[line], name, strlen(name)) == 0, "'%s' is not of '%s'", report.lines[line],
                  name);
    for (int i = 0; i < numbers; i++) {
        char *end;
        values[i] = strtod(at, &end);
        ck_assert_msg(end != at, "'%s' has no number %d", report.lines[line], i);
        at = end;
    }
    ck_assert_str_eq(at, "\n");
}

/* Three frames with "step" and inside it "solve", twice; the first is preceded by a "step" in no frame.
 * Returns how many milliseconds all of it took. */
static double measure(MeProfileLogModes_enum logging) {
    const double begin = now();
    start(logging);
    MeProfileStartSection("step", 0);
    MeProfileEndSection("step");
    for (int i = 0; i < 3; i++) {
        MeProfileStartFrame();
        MeProfileStartSection("step", 0);
        for (int j = 0; j < 2; j++) {
            MeProfileStartSection("solve", 0);
            spend();
            MeProfileEndSection("solve");
        }
        MeProfileEndSection("step");
        MeProfileEndFrame();
    }
    return 1000 * (now() - begin);
}

TEST(totals_are_reported) {
    double step[4], solve[4];
    const double whole = measure(kMeProfileLogTotals);
    makeReport(kMeProfileOutputNormal);
    ck_assert_int_eq(report.count, 3);
    ck_assert_ptr_nonnull(strstr(report.lines[0], "total ms"));
    assertColumns(1, 4, "step ", step);
    assertColumns(2, 4, "  solve ", solve);
    ck_assert(step[0] == 4 && solve[0] == 6); /* calls */
    assertNotBelow(solve[1], 6 * 1000 * waiting);
    ck_assert(step[1] >= solve[1] - 1e-4 && step[1] <= whole + 1e-4);
    ck_assert_uint_eq(strlen(report.lines[1]), strlen(report.lines[0]));
    ck_assert_uint_eq(strlen(report.lines[2]), strlen(report.lines[0]));
    assert_near(solve[2], solve[1] / 3, 2e-4);
    ck_assert(solve[3] >= solve[2] - 1e-4 && solve[3] <= solve[1]); /* the worst frame */
    stop();
}

TEST(averages_are_reported) {
    double step[3], solve[3];
    const double whole = measure(kMeProfileLogTotals);
    makeReport(kMeProfileOutputAverage);
    ck_assert_int_eq(report.count, 3);
    assertColumns(1, 3, "step ", step);
    assertColumns(2, 3, "  solve ", solve);
    ck_assert(step[0] == 1 && solve[0] == 2); /* calls per frame, without those outside */
    assertNotBelow(solve[1], 2 * 1000 * waiting);
    ck_assert(solve[2] >= solve[1] - 1e-4 && 3 * step[1] <= whole + 3e-4);
    stop();
}

TEST(calls_are_reported) {
    static const char *names[] = {"step", "solve", "solve", "step", "solve", "solve", "step", "solve", "solve", "step"};
    static const int frames[] = {0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    double last = 0;
    const double whole = measure(kMeProfileLogAll);
    makeReport(kMeProfileOutputEvent);
    ck_assert_int_eq(report.count, 11);
    for (int i = 0; i < 10; i++) {
        int frame;
        double begin, duration;
        char name[32];
        ck_assert_int_eq(sscanf(report.lines[i + 1], "%d %lf %lf %31s", &frame, &begin, &duration, name), 4);
        ck_assert_int_eq(frame, frames[i]);
        ck_assert_str_eq(name, names[i]);
        ck_assert(strstr(report.lines[i + 1], strcmp(name, "step") == 0 ? "  step\n" : "    solve\n") ==
                  report.lines[i + 1] + strlen("   frame     begin ms           ms"));
        if (strcmp(name, "solve") == 0)
            assertNotBelow(duration, 1000 * waiting);
        ck_assert(begin + duration >= last - 2.1e-4); /* four times rounded to 1e-4 */
        last = begin + duration;
    }
    ck_assert(last <= whole + 1.1e-4);
    stop();
}

TEST(frames_are_reported) {
    double sum = 0;
    const double whole = measure(kMeProfileLogAll);
    makeReport(kMeProfileOutputGnuplot);
    ck_assert_int_eq(report.count, 4);
    ck_assert_str_eq(report.lines[0], "# frame, step, solve\n");
    for (int i = 1; i <= 3; i++) {
        double columns[3];
        assertColumns(i, 3, "", columns);
        ck_assert(columns[0] == i);
        assertNotBelow(columns[2], 2 * 1000 * waiting);
        ck_assert(columns[1] >= columns[2] - 1e-4);
        sum += columns[1];
    }
    ck_assert(sum <= whole + 3e-4);
    stop();
}

TEST(averages_without_frames_are_zero) {
    double columns[4];
    start(kMeProfileLogTotals);
    MeProfileStartSection("a", 0);
    spend();
    MeProfileEndSection("a");
    makeReport(kMeProfileOutputNormal);
    assertColumns(1, 4, "a ", columns);
    ck_assert(columns[0] == 1 && columns[2] == 0 && columns[3] == 0);
    assertNotBelow(columns[1], 1000 * waiting);
    stop();
}

/* More calls than the log begins with room for. */
TEST(long_logs) {
    start(kMeProfileLogAll);
    for (int i = 0; i < 5000; i++) {
        MeProfileStartFrame();
        MeProfileStartSection("a", 0);
        MeProfileEndSection("a");
        MeProfileEndFrame();
    }
    MeProfileSetOutputParameters((MeProfileOutput){kMeProfileOutputGnuplot, REPORT});
    MeProfileOutputResults();
    FILE *const file = fopen(REPORT, "r");
    ck_assert_ptr_nonnull(file);
    int lines = 0;
    for (int c = fgetc(file); c != EOF; c = fgetc(file))
        lines += c == '\n';
    fclose(file);
    remove(REPORT);
    ck_assert_int_eq(lines, 5001);
    stop();
}

TEST(full_log_warns_and_totals_go_on) {
    double columns[4];
    start(kMeProfileLogAll);
    for (int i = 0; i < (1 << 20) + 5; i++) {
        MeProfileStartSection("a", 0);
        MeProfileEndSection("a");
    }
    assert_warned("kMeProfileLogTotals");
    makeReport(kMeProfileOutputNormal);
    assertColumns(1, 4, "a ", columns);
    ck_assert(columns[0] == (1 << 20) + 5);
    stop();
}

TEST(reports_that_cannot_be_made_warn) {
    MeProfileSetOutputParameters((MeProfileOutput){kMeProfileOutputNormal, REPORT});
    MeProfileOutputResults();
    assert_warned("nothing has been logged");
    MeProfileStartTiming(mode, kMeProfileDontLog);
    MeProfileOutputResults();
    assert_warned("nothing has been logged");
    MeProfileStartTiming(mode, kMeProfileLogTotals);
    MeProfileSetOutputParameters((MeProfileOutput){kMeProfileOutputEvent, REPORT});
    MeProfileOutputResults();
    assert_warned("kMeProfileLogAll");
    MeProfileSetOutputParameters((MeProfileOutput){kMeProfileOutputGnuplot, REPORT});
    MeProfileOutputResults();
    assert_warned("kMeProfileLogAll");
    MeProfileSetOutputParameters((MeProfileOutput){kMeProfileOutputNormal, "/no/such/directory/report"});
    MeProfileOutputResults();
    assert_warned("/no/such/directory/report");
    MeProfileSetOutputParameters((MeProfileOutput){(MeProfileOutput_enum)4, NULL});
    assert_warned("4 is not a format");
    stop();
}

/* ---- the stopwatch ---- */

/* A line for a section that was passed twice, in no more than so many milliseconds. */
static void assertTicLine(int line, const char *name, double max) {
    char found[32];
    int calls;
    double milliseconds;
    ck_assert_int_eq(sscanf(report.lines[line], "%31s %d %lf ms\n", found, &calls, &milliseconds), 3);
    ck_assert_str_eq(found, name);
    ck_assert_int_eq(calls, 2);
    assertNotBelow(milliseconds, 2 * 1000 * waiting);
    ck_assert(milliseconds <= max);
}

TEST(tic_times_what_follows) {
    tic("before"); /* ignored */
    ticOutputResults(REPORT);
    ck_assert_ptr_null(fopen(REPORT, "r"));
    const double begin = now();
    ticInit();
    for (int i = 0; i < 2; i++) {
        tic("collide");
        spend();
        tic("solve");
        spend();
    }
    tic(NULL);
    const double max = 1000 * (now() - begin - 2 * waiting) + 1e-4; /* without the other */
    spend();
    tic(NULL);
    ticOutputResults(REPORT);
    readReport();
    ck_assert_int_eq(report.count, 2);
    assertTicLine(0, "collide", max);
    assertTicLine(1, "solve", max);
    assert_refused(ticOutputResults, "/no/such/directory/report");
    ticInit();
    ticOutputResults(REPORT);
    readReport();
    ck_assert_int_eq(report.count, 0);
    ticCleanup();
    tic("after");
    ticCleanup();
}
