/* assert_silent() and assert_warned() where no messages are caught must fail: CTest expects their texts. */
#include "karma_test.h"

START_TEST(silence_of_what_is_not_heard) {
    assert_silent();
}
END_TEST

START_TEST(a_warning_that_is_not_heard) {
    assert_warned("any");
}
END_TEST

START_TEST(silence_after_the_release) {
    messages_catch();
    assert_silent();
    messages_release();
    assert_silent();
}
END_TEST

START_TEST(the_end_of_a_test_releases) {
    ck_assert_msg(!messages_are_caught(), "caught by the test before");
    messages_catch();
    MeWarning(0, "not looked at");
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, the_end_of_a_test_releases);
    tcase_add_test(t, silence_of_what_is_not_heard);
    tcase_add_test(t, a_warning_that_is_not_heard);
    tcase_add_test(t, silence_after_the_release);
    tcase_add_test(t, the_end_of_a_test_releases);
}
TEST_MAIN("uncaught", tests)
