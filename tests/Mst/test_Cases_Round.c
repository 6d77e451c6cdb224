/* Coins that roll and fall, and boxes on ground that turns. */
#include "cases.h"

TEST(a_coin_rolls_round) {
    static const SceneBound bounds[] = {{"coin", 1, 0, .1, .1}, {"coin", 1, 1, .01, .01}, {"coin", 1, 2, .1, .1}};
    assert_cases(bounds);
}

TEST(a_coin_that_falls_gains_nothing) {
    static const SceneBound bounds[] = {{"coin-falls", 1, 0, 1e-4, 1e-4}, {"coin-falls", 1, 1, .01, .01}};
    assert_cases(bounds);
}

TEST(boxes_stay_where_turning_ground_takes_them) {
    static const SceneBound bounds[] = {{"turning", 1, 0, 7e-7, 2e-9}, {"turning", 1, 1, 2e-6, 5e-9}};
    assert_cases(bounds);
}

/* Within a hundredth of the speed at which they must. */
TEST(and_slide_from_where_nothing_holds_them) {
    static const SceneBound bounds[] = {{"turning-limit", 1, 0, 2e-6, 7e-9}, {"turning-limit", 1, 1, 0, 0}};
    assert_cases(bounds);
}
