/* What a test does not assert must fail it: CTest expects these texts. */
#include "karma_test.h"

TEST(a_warning_that_is_not_looked_at) {
    MeWarning(0, "not looked at");
}

TEST(a_fatal_error_that_is_not_looked_at) {
    MeFatalError(0, "not looked at");
}

static void warn(void *object) {
    MeWarning(0, "at the end of %s", (const char *)object);
}

TEST(a_warning_at_the_end) {
    static char text[] = "all";
    test_finally(warn, text);
}

LOOP_TEST(tests_begin_in_silence, 0, 2) {
    assert_silent();
    MeWarning(0, "heard");
    assert_warned("heard");
}
