/* Hard cases 16 and 17: balls that bounce, cradles, a crowd. */
#include "cases.h"

TEST(balls_rise_as_high_as_they_must) {
    static const SceneBound bounds[] = {
        {"bounce", 1, 0, 1e-6, 1e-12}, {"bounce", 1, 1, 1e-6, 1e-12}, {"bounce", 1, 2, 3e-6, 1e-12}};
    assert_cases(bounds);
}

TEST(a_cradle_passes_the_blow_on_to_the_last_ball) {
    static const SceneBound bounds[] = {
        {"cradle", 1, 0, 1e-6, 1e-13}, {"cradle", 1, 1, 1e-6, 1e-13}, {"cradle", 1, 2, 1e-6, 1e-13}};
    assert_cases(bounds);
}

/* Contacts begin later than the blow before: a ball meets the next one up to a step late, and overlaps it then. Where
 * such an overlap was no blow, the last one rose to .06. */
TEST(so_do_pendulums) {
    static const SceneBound bounds[] = {{"pendulums", 1, 0, .02, .02}, {"pendulums", 1, 1, .02, .02}};
    assert_cases(bounds);
}

TEST(a_crowd_keeps_its_energy) {
    static const SceneBound bounds[] = {{"elastic", 1, 0, 5e-6, 1e-12}};
    assert_cases(bounds);
}

#ifndef TEST_IS_SLOW
/* 216 balls land as one: the blow runs up and down through six layers, 3.5 impacts for a ball within a few steps. With
 * one for each, a third of the energy was lost. */
TEST(so_does_one_that_lands_as_one) {
    static const SceneBound bounds[] = {{"sim-666-elastic", 2, 1, 3e-5, 2e-5}};
    assert_once(bounds);
}
#endif
