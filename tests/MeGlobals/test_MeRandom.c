/* The first random numbers of a process: a program of its own, for nothing may have drawn one before. */
#include "MeMath.h"
#include "karma_test.h"

/* They were computed apart from this library. */
TEST(random_numbers_are_the_same_in_every_run) {
    assert_near(MeRealRandomInRange(0, 1), 0.052790873358508184, TOL(3e-8, 5e-17));
    assert_near(MeRealRandomInRange(0, 1), 0.33112028100185353, TOL(1e-7, 1e-16));
}
