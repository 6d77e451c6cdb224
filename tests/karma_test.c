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

void messages_catch(void) {
    memset(&caught, 0, sizeof caught);
    oldWarning = MeSetWarningHandler(onWarning);
    oldFatal = MeSetFatalErrorHandler(onFatal);
}

void messages_release(void) {
    MeSetWarningHandler(oldWarning);
    MeSetFatalErrorHandler(oldFatal);
}

int test_main(const char *name, void (*add)(TCase *)) {
    Suite *suite = suite_create(name);
    TCase *tcase = tcase_create(name);
    tcase_set_timeout(tcase, 120);
    add(tcase);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
