/* Hard cases 4 and 6 for ten minutes: what creeps shows. */
#include "cases.h"

#ifndef TEST_IS_SLOW
TEST(they_stand_for_ten_minutes) {
    static const SceneBound bounds[] = {
        {"tower-600s", 1, 0, 0, 0},
        {"tower-600s", 1, 1, 2.5e-5, 1e-8},
        {"tower-600s", 1, 2, 1e-5, 1e-7},
        {"cards-600s", 1, 0, 1e-6, 1e-8},
    };
    assert_once(bounds);
}
#endif
