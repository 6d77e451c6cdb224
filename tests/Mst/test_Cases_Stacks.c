/* Hard cases 1, 4, 5 and 6: heavy on light, towers, towers of any size, and a house of cards. */
#include "cases.h"

TEST(a_heavy_cube_stands_on_a_light_one) {
    static const SceneBound bounds[] = {
        {"heavy-100", 1, 1, 1e-6, 1e-11}, {"heavy-100", 1, 2, 1e-6, 1e-10}, {"heavy-1e4", 1, 1, 1e-6, 2e-10},
        {"heavy-1e4", 1, 2, 1e-6, 2e-10}, {"heavy-1e6", 1, 1, 1e-6, 1e-10}, {"heavy-1e6", 1, 2, 1e-6, 4e-9},
    };
    assert_cases(bounds);
}

TEST(towers_of_twenty_stand) {
    static const SceneBound bounds[] = {
        {"tower", 1, 0, 1e-6, 1e-9},           {"tower", 1, 1, 1e-6, 1e-8},        {"tower-shaken", 1, 0, 0, 0},
        {"tower-shaken", 1, 1, 2.5e-5, 2e-10}, {"tower-shaken", 1, 2, 1e-5, 2e-8},
    };
    assert_cases(bounds);
}

TEST(a_tower_does_not_depend_on_metres) {
    static const SceneBound bounds[] = {
        {"tower-.01m", 1, 0, 3e-6, 5e-8},  {"tower-.01m", 1, 1, 1e-6, 1e-7}, {"tower-.1m", 1, 0, 3e-6, 5e-9},
        {"tower-.1m", 1, 1, 1e-6, 1e-8},   {"tower-1m", 1, 0, 1e-6, 1e-9},   {"tower-1m", 1, 1, 1e-6, 2e-9},
        {"tower-10m", 1, 0, 1e-6, 1e-10},  {"tower-10m", 1, 1, 1e-6, 2e-10}, {"tower-100m", 1, 0, 2e-4, 1e-11},
        {"tower-100m", 1, 1, 6e-6, 2e-11},
    };
    assert_cases(bounds);
}

TEST(a_house_of_cards_stands) {
    static const SceneBound bounds[] = {{"cards", 1, 0, 1e-6, 2e-9}};
    assert_cases(bounds);
}
