/* What every test file uses: Check, comparisons with one tolerance per precision, captured messages, and main(). */
#ifndef KARMA_TEST_H
#define KARMA_TEST_H

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "MeMessage.h"
#include "MePrecision.h"

/* Check notes every assertion in a file, which takes longer than most of what is asserted; here only those that
 * fail. */
#undef ck_assert
#undef ck_assert_msg
#define ck_assert(expr)          ((expr) ? (void)0 : _ck_assert_failed(__FILE__, __LINE__, "Not true: " #expr, NULL))
#define ck_assert_msg(expr, ...) ((expr) ? (void)0 : _ck_assert_failed(__FILE__, __LINE__, #expr, __VA_ARGS__))

/* The tolerance for this build's precision. */
#ifdef _ME_API_DOUBLE
#define TOL(single, double_) (double_)
#else
#define TOL(single, double_) (single)
#endif

/* With sanitizers what takes seconds takes minutes: long runs are left out where this is defined. */
#if defined __SANITIZE_ADDRESS__
#define TEST_IS_SLOW 1
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define TEST_IS_SLOW 1
#endif
#if __has_feature(thread_sanitizer)
#define TEST_IS_FOR_THREADS 1 /* of the build that looks for races, which takes 15 times as long */
#endif
#endif

/* margins.c: with KARMA_TEST_MARGINS=file each comparison appends to that file how much of its tolerance it used. */
void margin_note(const char *file, int line, double actual, double expected, double tolerance);

/* |actual - expected| <= tolerance (absolute); prints all three. NaN fails. */
#define assert_near(actual, expected, tolerance)                                                                       \
    do {                                                                                                               \
        const double a_ = (double)(actual), e_ = (double)(expected), t_ = (double)(tolerance);                         \
        margin_note(__FILE__, __LINE__, a_, e_, t_);                                                                   \
        ck_assert_msg(fabs(a_ - e_) <= t_, "%s = %.17g, expected %.17g within %.3g (off by %.3g)", #actual, a_, e_,    \
                      t_, a_ - e_);                                                                                    \
    } while (0)

/* The same, relative to the expected value. */
#define assert_near_rel(actual, expected, tolerance)                                                                   \
    assert_near(actual, expected, (double)(tolerance)*fabs((double)(expected)))

/* actual < bound; prints both. NaN fails. */
#define assert_below(actual, bound)                                                                                    \
    do {                                                                                                               \
        const double a_ = (double)(actual), b_ = (double)(bound);                                                      \
        ck_assert_msg(a_ < b_, "%s = %.17g, expected below %.17g", #actual, a_, b_);                                   \
    } while (0)

#define assert_vec3_near(actual, x, y, z, tolerance)                                                                   \
    do {                                                                                                               \
        assert_near((actual)[0], (x), (tolerance));                                                                    \
        assert_near((actual)[1], (y), (tolerance));                                                                    \
        assert_near((actual)[2], (z), (tolerance));                                                                    \
    } while (0)

/* Messages are caught, not shown, from before the fixture of a test to its end. A test is to be silent but for what it
 * asserts: warnings and fatal errors that are left over at its end fail it. */
typedef struct {
    int warnings;
    int fatal;
    char last[1024];
} CaughtMessages;

extern CaughtMessages caught;

void messages_forget(void); /* What has been caught until now does not matter. */
void messages_show(void);   /* From here to the end of the test nothing is caught. */

/* One warning was given since the last call, and its text contains the word. */
#define assert_warned(word)                                                                                            \
    do {                                                                                                               \
        ck_assert_msg(caught.warnings > 0, "no warning, expected one with '%s'", word);                                \
        ck_assert_msg(strstr(caught.last, word) != NULL, "warning '%s' does not say '%s'", caught.last, word);         \
        caught.warnings = 0;                                                                                           \
        caught.last[0] = 0;                                                                                            \
    } while (0)

/* f(...) gives a warning that names f; assert_none: and returns 0 or null. */
#define assert_refused(f, ...)                                                                                         \
    do {                                                                                                               \
        f(__VA_ARGS__);                                                                                                \
        assert_warned(#f);                                                                                             \
    } while (0)
#define assert_none(f, ...)                                                                                            \
    do {                                                                                                               \
        ck_assert(f(__VA_ARGS__) == 0);                                                                                \
        assert_warned(#f);                                                                                             \
    } while (0)

#define assert_silent()                                                                                                \
    do {                                                                                                               \
        ck_assert_msg(caught.warnings == 0, "%d unexpected warning(s): %s", caught.warnings, caught.last);             \
        ck_assert_msg(caught.fatal == 0, "unexpected fatal error: %s", caught.last);                                   \
    } while (0)

/* At the end of the test, before the fixture's end, `end` is called with the object, the latest one first. */
void test_finally(void (*end)(void *), void *object);
void test_end(void);

/* A test: `TEST(a_ball_falls) { ... }`, which adds itself to the file's; a LOOP_TEST runs for each _i from start to end
 * - 1. Each stands alone: the three builds of CI run them in the written order, in reverse (KARMA_TEST_ORDER=reverse),
 * and each in a process of its own (CK_FORK=yes). */
#define LOOP_TEST(name, start, end)                                                                                    \
    static const TTest *name;                                                                                          \
    __attribute__((constructor)) static void name##_add(void) {                                                        \
        test_add(name, start, end);                                                                                    \
    }                                                                                                                  \
    static void name##_body(int _i);                                                                                   \
    START_TEST(name) {                                                                                                 \
        name##_body(_i);                                                                                               \
        test_end();                                                                                                    \
    }                                                                                                                  \
    static void name##_body(int _i CK_ATTRIBUTE_UNUSED)
#define TEST(name) LOOP_TEST(name, 0, 1)
void test_add(const TTest *test, int start, int end);

/* Called before and after each test of the file; may be null. One a file. */
#define TEST_FIXTURE(before, after)                                                                                    \
    __attribute__((constructor)) static void addFixture(void) {                                                        \
        test_fixture(before, after);                                                                                   \
    }
void test_fixture(void (*before)(void), void (*after)(void));

/* Runs them; main() of a file that has none of its own (test_main.c). */
int test_main(const char *name);

#endif
