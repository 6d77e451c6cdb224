/* Hard cases 8, 9, 10 and 12: slopes, friction that is the same in every direction, balls that come to roll, and a
 * block that topples. */
#include "cases.h"

TEST(cubes_slide_and_stick_on_a_slope) {
    static const SceneBound bounds[] = {
        {"incline", 1, 0, 4e-6, 1e-10}, {"incline", 1, 1, 1e-10, 1e-11}, {"incline", 1, 2, 1e-6, 1e-9}};
    assert_cases(bounds);
}

TEST(friction_is_the_same_in_every_direction) {
    static const SceneBound bounds[] = {{"isotropy", 1, 0, 1e-6, 1e-10}, {"isotropy", 1, 1, 1e-4, 1e-8}};
    assert_cases(bounds);
}

TEST(balls_come_to_roll) {
    static const SceneBound bounds[] = {
        {"rolling", 1, 0, 1e-6, 2e-9},
        {"rolling", 1, 1, 1e-6, 1e-9},
        {"backspin", 1, 0, 1e-5, 1e-7},
        {"backspin", 1, 1, 1e-6, 3e-8},
    };
    assert_cases(bounds);
}

TEST(one_block_stops_and_one_topples) {
    static const SceneBound bounds[] = {
        {"block", 1, 0, 1e-6, 1e-9}, {"block", 1, 1, 1e-6, 1e-8}, {"block", 1, 2, 0, 0}};
    assert_cases(bounds);
}
