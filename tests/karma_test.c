/* See karma_test.h. */
#include "karma_test.h"

CaughtMessages caught;

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

void messages_forget(void) {
    memset(&caught, 0, sizeof caught);
}

void messages_show(void) {
    MeSetWarningHandler(oldWarning);
    MeSetFatalErrorHandler(oldFatal);
}

static void beginTest(void) {
    messages_forget();
    oldWarning = MeSetWarningHandler(onWarning);
    oldFatal = MeSetFatalErrorHandler(onFatal);
}

static struct {
    void (*end)(void *);
    void *object;
} * ends;

static int endCount;

void test_finally(void (*end)(void *), void *object) {
    ends = realloc(ends, (size_t)(endCount + 1) * sizeof *ends);
    ends[endCount].end = end;
    ends[endCount++].object = object;
}

static void endObjects(void) {
    while (endCount > 0) {
        endCount--;
        ends[endCount].end(ends[endCount].object);
    }
    free(ends);
    ends = NULL;
}

void test_end(void) {
    endObjects();
    assert_silent();
}

static void finishTest(void) {
    endObjects(); /* of a test that failed */
    messages_show();
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
    tcase_add_checked_fixture(tcase, beginTest, finishTest);
    tcase_add_checked_fixture(tcase, beforeEach, afterEach);
    addInOrder(tcase);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
