/* Hard cases 4 and 6 for ten minutes: what creeps shows. */
#include "cases.h"

START_TEST(they_stand_for_ten_minutes) {
#ifndef TEST_IS_SLOW
    static const SceneBound bounds[] = {
        {"tower-600s", 1, 0, 0, 0},
        {"tower-600s", 1, 1, 1e-5, 1e-8},
        {"tower-600s", 1, 2, 1e-5, 1e-7},
        {"cards-600s", 1, 0, 1e-3, 1e-6},
    };
    messages_catch();
    const int broken = bounds_countBroken(bounds, sizeof bounds / sizeof *bounds, UNIVERSE, ENGINE_STRICT);
    messages_release();
    assert_silent();
    ck_assert_int_eq(broken, 0);
#endif
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, they_stand_for_ten_minutes);
}
TEST_MAIN("Cases_Long", tests)
