/* Toothed wheels, and a car on a height field. */
#include "cases.h"

START_TEST(gears_keep_their_ratio) {
    static const SceneBound bounds[] = {
        {"gears", 1, 0, 2e-6, 1e-9}, {"gears", 1, 1, 1e-6, 1e-10}, {"gears", 1, 2, 0, 0}};
    assert_cases(bounds);
}
END_TEST

START_TEST(a_slope_of_triangles_is_a_plane) {
    static const SceneBound bounds[] = {
        {"terrain-roll", 1, 0, .005, .005}, {"terrain-roll", 1, 1, 3e-6, 1e-12}, {"terrain-roll", 1, 2, 2e-6, 1e-12}};
    assert_cases(bounds);
}
END_TEST

START_TEST(a_car_comes_across_bumps) {
    static const SceneBound bounds[] = {
        {"terrain-car", 1, 0, .15, .15}, {"terrain-car", 1, 1, 1e-5, 1e-9}, {"terrain-car", 1, 2, 0, 0}};
    assert_cases(bounds);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, gears_keep_their_ratio);
    tcase_add_test(t, a_slope_of_triangles_is_a_plane);
    tcase_add_test(t, a_car_comes_across_bumps);
}
TEST_MAIN("Cases_Terrain", tests)
