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

/* Check notes every assertion in a file, which takes longer than most of what is asserted; here only those that fail. */
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
#endif

/* |actual - expected| <= tolerance (absolute); prints all three. NaN fails. */
#define assert_near(actual, expected, tolerance)                                                                       \
    do {                                                                                                               \
        const double a_ = (double)(actual), e_ = (double)(expected), t_ = (double)(tolerance);                         \
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

/* Messages caught instead of shown. Tests of bad input start with messages_catch(). */
typedef struct {
    int warnings;
    int fatal;
    char last[1024];
} CaughtMessages;

extern CaughtMessages caught;

void messages_catch(void);   /* From here on warnings and fatal errors are counted, not shown. */
void messages_release(void); /* Back to the handlers that were set before. */

/* One warning was given since the last call, and its text contains the word. */
#define assert_warned(word)                                                                                            \
    do {                                                                                                               \
        ck_assert_msg(caught.warnings > 0, "no warning, expected one with '%s'", word);                                \
        ck_assert_msg(strstr(caught.last, word) != NULL, "warning '%s' does not say '%s'", caught.last, word);         \
        caught.warnings = 0;                                                                                           \
        caught.last[0] = 0;                                                                                            \
    } while (0)

#define assert_silent()                                                                                                \
    do {                                                                                                               \
        ck_assert_msg(caught.warnings == 0, "%d unexpected warning(s): %s", caught.warnings, caught.last);             \
        ck_assert_msg(caught.fatal == 0, "unexpected fatal error: %s", caught.last);                                   \
    } while (0)

/* A file's tests: `static void tests(TCase *t) { tcase_add_test(t, a); ... }  TEST_MAIN("MdtBody", tests)` */
int test_main(const char *name, void (*add)(TCase *));
#define TEST_MAIN(name, add)                                                                                           \
    int main(void) {                                                                                                   \
        return test_main(name, add);                                                                                   \
    }

#endif
