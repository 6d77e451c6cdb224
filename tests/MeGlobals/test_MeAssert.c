/* Assertions, on and off in one file. */
#include "karma_test.h"

static int evaluations;

static int evaluate(int result) {
    evaluations++;
    return result;
}

#undef KARMA_ASSERT
#undef KARMA_VALIDATE
#define KARMA_ASSERT   1
#define KARMA_VALIDATE 1
#include "MeAssert.h"

static void assertTrue(void) {
    MEASSERT(evaluate(1));
}

static void assertFalse(void) {
    MEASSERT(evaluate(100 % 7 == 0)); /* the text has a percent sign */
}

static void validateFalse(void) {
    MEVALIDATE(evaluate(0));
}

static void assertAligned(const void *p) {
    MEASSERTALIGNED(p, 16);
}

#undef MEASSERT_H
#undef MEASSERT
#undef MEASSERTALIGNED
#undef ME_ASSERT_ENABLED
#undef MEVALIDATE
#undef ME_VALIDATE_ENABLED
#undef KARMA_ASSERT
#define KARMA_ASSERT 0
#include "MeAssert.h"

static void assertNothing(void) {
    const int onlyForTheAssertion = 0; /* gives no warning either */
    MEASSERT(onlyForTheAssertion);
    MEASSERT(evaluate(0));
    MEVALIDATE(evaluate(0)); /* KARMA_VALIDATE alone is not enough */
    MEASSERTALIGNED((uintptr_t)evaluate(1), 16);
}

TEST(true_assertions_are_silent) {
    evaluations = 0;
    assertTrue();
    assertAligned((const void *)64);
    ck_assert_int_eq(evaluations, 1);
}

TEST(false_assertions_are_fatal) {
    evaluations = 0;
    assertFalse();
    ck_assert_int_eq(evaluations, 1);
    ck_assert_int_eq(caught.fatal, 1);
    ck_assert_ptr_nonnull(strstr(caught.last, "test_MeAssert.c:"));
    ck_assert_ptr_nonnull(strstr(caught.last, "evaluate(100 % 7 == 0)"));
    assertAligned((const void *)72);
    ck_assert_int_eq(caught.fatal, 2);
    validateFalse();
    ck_assert_int_eq(caught.fatal, 3);
    messages_forget();
}

TEST(assertions_that_are_off_evaluate_nothing) {
    evaluations = 0;
    assertNothing();
    ck_assert_int_eq(evaluations, 0);
}
