/* See karma_test.h. */
#include "karma_test.h"

CaughtMessages caught;

static int isCatching;
static MeHandler oldWarning, oldFatal;

static void onWarning(const int level, const char *const format, va_list ap) {
    (void)level;
    caught.warnings++;
    vsnprintf(caught.last, sizeof caught.last, format, ap);
}

static void onFatal(const int level, const char *const format, va_list ap) {
    (void)level;
    caught.fatal++;
    vsnprintf(caught.last, sizeof caught.last, format, ap);
}

void messages_catch(void) {
    if (isCatching)
        return;
    memset(&caught, 0, sizeof caught);
    oldWarning = MeSetWarningHandler(onWarning);
    oldFatal = MeSetFatalErrorHandler(onFatal);
    isCatching = 1;
}

void messages_release(void) {
    if (!isCatching)
        return;
    MeSetWarningHandler(oldWarning);
    MeSetFatalErrorHandler(oldFatal);
    isCatching = 0;
}

int messages_are_caught(void) {
    return isCatching;
}

enum { TESTS = 256 };

static struct {
    const TTest *test;
    int start, end;
} added[TESTS];

static int addedCount;

void test_add(const TTest *test, int start, int end) {
    if (addedCount == TESTS) {
        fprintf(stderr, "karma_test.c: raise TESTS\n");
        abort();
    }
    added[addedCount].test = test;
    added[addedCount].start = start;
    added[addedCount++].end = end;
}

static void (*beforeEach)(void), (*afterEach)(void);

void test_fixture(void (*before)(void), void (*after)(void)) {
    beforeEach = before;
    afterEach = after;
}

static void addInOrder(TCase *tcase) {
    const char *const order = getenv("KARMA_TEST_ORDER");
    const int isReverse = order && !strcmp(order, "reverse");
    for (int i = 0; i < addedCount; i++) {
        const int k = isReverse ? addedCount - 1 - i : i;
        _tcase_add_test(tcase, added[k].test, 0, 0, added[k].start, added[k].end);
    }
}

int test_main(const char *name) {
    Suite *suite = suite_create(name);
    TCase *tcase = tcase_create(name);
    tcase_set_timeout(tcase, 0); /* CTest has one */
    (tcase_add_checked_fixture)(tcase, NULL, messages_release);
    (tcase_add_checked_fixture)(tcase, beforeEach, afterEach);
    addInOrder(tcase);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
