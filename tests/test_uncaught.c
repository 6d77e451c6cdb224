/* assert_silent() and assert_warned() where no messages are caught must fail: CTest expects their texts. */
#include "karma_test.h"

TEST(silence_of_what_is_not_heard) {
    assert_silent();
}

TEST(a_warning_that_is_not_heard) {
    assert_warned("any");
}

TEST(silence_after_the_release) {
    messages_catch();
    assert_silent();
    messages_release();
    assert_silent();
}

LOOP_TEST(the_end_of_a_test_releases, 0, 2) {
    ck_assert_msg(!messages_are_caught(), "caught by the test before");
    messages_catch();
    MeWarning(0, "not looked at");
}
