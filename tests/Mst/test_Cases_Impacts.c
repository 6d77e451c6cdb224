/* Hard cases 16 and 17: balls that bounce, and a cradle. */
#include "cases.h"

START_TEST(balls_rise_as_high_as_they_must) {
    static const SceneBound bounds[] = {
        {"bounce", 1, 0, 1e-6, 1e-12}, {"bounce", 1, 1, 1e-6, 1e-12}, {"bounce", 1, 2, 3e-6, 1e-12}};
    assert_cases(bounds);
}
END_TEST

START_TEST(a_cradle_passes_the_blow_on_to_the_last_ball) {
    static const SceneBound bounds[] = {
        {"cradle", 1, 0, 1e-6, 1e-13}, {"cradle", 1, 1, 1e-6, 1e-13}, {"cradle", 1, 2, 1e-6, 1e-13}};
    assert_cases(bounds);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, balls_rise_as_high_as_they_must);
    tcase_add_test(t, a_cradle_passes_the_blow_on_to_the_last_ball);
}
TEST_MAIN("Cases_Impacts", tests)
