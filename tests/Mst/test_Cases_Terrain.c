/* Toothed wheels, a car and planks on height fields, edges and rims. */
#include "cases.h"

TEST(gears_keep_their_ratio) {
    static const SceneBound bounds[] = {
        {"gears", 1, 0, 2e-6, 1e-9}, {"gears", 1, 1, 1e-6, 1e-10}, {"gears", 1, 2, 0, 0}};
    assert_cases(bounds);
}

TEST(a_slope_of_triangles_is_a_plane) {
    static const SceneBound bounds[] = {
        {"terrain-roll", 1, 0, 1e-5, 1e-10}, {"terrain-roll", 1, 1, 3e-6, 2e-9}, {"terrain-roll", 1, 2, 2e-6, 1e-9}};
    assert_cases(bounds);
}

TEST(a_car_comes_across_bumps) {
    static const SceneBound bounds[] = {
        {"terrain-car", 1, 0, .05, .05}, {"terrain-car", 1, 1, 1e-5, 1e-6}, {"terrain-car", 1, 2, 0, 0}};
    assert_cases(bounds);
}

TEST(a_car_on_bumps_converges) {
    static const SceneBound bounds[] = {{"terrain-car", 4, 0, .01, .01}, {"terrain-car", 16, 0, .01, .01}};
    assert_once(bounds);
}

TEST(planks_lie_still_on_bumps) {
    static const SceneBound bounds[] = {{"planks-on-bumps", 1, 0, 0, 0}, {"planks-on-bumps", 1, 1, 1e-8, 1e-8}};
    assert_once(bounds);
}

TEST(edges_and_rims_roll) {
    static const SceneBound bounds[] = {{"block-rocks", 1, 0, 5e-3, 5e-3},
                                        {"block-rocks", 1, 2, .02, .02},
                                        {"disc-rolls", 1, 0, .2, .2},
                                        {"disc-rolls", 1, 1, 2e-4, 2e-4},
                                        {"elastic-pack", 1, 0, 1e-5, 1e-10}};
    assert_once(bounds);
}
