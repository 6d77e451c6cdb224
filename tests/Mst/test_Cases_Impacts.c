/* Hard cases 16 and 17: balls that bounce, cradles, a crowd. */
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

/* Contacts begin later than the blow before: a ball meets the next one up to a step late, and overlaps it then. Where
 * such an overlap was no blow, the last one rose to .06. */
START_TEST(so_do_pendulums) {
    static const SceneBound bounds[] = {{"pendulums", 1, 0, .02, .02}, {"pendulums", 1, 1, .02, .02}};
    assert_cases(bounds);
}
END_TEST

START_TEST(a_crowd_keeps_its_energy) {
    static const SceneBound bounds[] = {{"elastic", 1, 0, 5e-6, 1e-12}};
    assert_cases(bounds);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, balls_rise_as_high_as_they_must);
    tcase_add_test(t, a_cradle_passes_the_blow_on_to_the_last_ball);
    tcase_add_test(t, so_do_pendulums);
    tcase_add_test(t, a_crowd_keeps_its_energy);
}
TEST_MAIN("Cases_Impacts", tests)
