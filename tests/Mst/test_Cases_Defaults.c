/* The hard cases with the epsilon that a universe comes with: what a program gets that sets nothing. Where a bound is
 * wider than in the other files, which are rigid, the load's sag is why (epsilon F h² / gamma). */
#include "cases.h"

TEST(stacks_stand_by_default) {
    static const SceneBound bounds[] = {
        {"heavy-1e4", 1, 1, 1e-6, 1e-9},  {"heavy-1e4", 1, 2, 1e-6, 1e-9},  {"heavy-1e6", 1, 1, 1e-6, 1e-7},
        {"heavy-1e6", 1, 2, 1e-6, 1e-7},  {"tower", 1, 0, 1e-6, 1e-9},      {"tower", 1, 1, 1e-6, 1e-8},
        {"tower-.01m", 1, 0, 3e-6, 1e-7}, {"tower-.01m", 1, 1, 1e-6, 1e-7}, {"tower-100m", 1, 0, 2e-4, 2e-5},
        {"tower-100m", 1, 1, 6e-6, 1e-8}, {"cards", 1, 0, 1e-6, 1e-8},
    };
    assert_by_default(bounds);
}

TEST(friction_is_exact_by_default) {
    static const SceneBound bounds[] = {
        {"incline", 1, 0, 4e-6, 1e-10}, {"incline", 1, 1, 1e-10, 1e-11}, {"isotropy", 1, 0, 1e-6, 1e-10},
        {"isotropy", 1, 1, 1e-4, 1e-8}, {"rolling", 1, 0, 1e-6, 2e-9},   {"rolling", 1, 1, 1e-6, 1e-9},
        {"backspin", 1, 0, 1e-5, 1e-7}, {"backspin", 1, 1, 1e-6, 3e-8},  {"block", 1, 0, 1e-6, 1e-9},
        {"block", 1, 1, 1e-6, 1e-8},    {"block", 1, 2, 0, 0},
    };
    assert_by_default(bounds);
}

TEST(impacts_are_exact_by_default) {
    static const SceneBound bounds[] = {
        {"bounce", 1, 0, 1e-6, 1e-12}, {"bounce", 1, 1, 1e-6, 1e-12}, {"bounce", 1, 2, 3e-6, 1e-12},
        {"cradle", 1, 0, 1e-6, 1e-13}, {"cradle", 1, 1, 1e-6, 1e-13}, {"cradle", 1, 2, 1e-6, 1e-13},
    };
    assert_by_default(bounds);
}
