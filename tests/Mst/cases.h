/* The hard cases through the whole pipeline: Mcd finds the contacts, the bridge makes them, Mdt solves. Scenes and
 * references are those of tests/scenes; here stand the errors that are kept at 60 Hz, one step a frame, and at four.
 * Every step is exact by its own report, and every run has the same bits twice. */
#ifndef CASES_H
#define CASES_H

#include "bounds.h"
#include "karma_test.h"

#ifdef _ME_API_DOUBLE
#define UNIVERSE &engine_universe_double
#else
#define UNIVERSE &engine_universe_single
#endif

#define assert_kept(count, bounds, setting)                                                                            \
    do {                                                                                                               \
        const int broken_ =                                                                                            \
            count(bounds, (int)(sizeof(bounds) / sizeof *(bounds)), UNIVERSE, (setting) | ENGINE_STRICT);              \
        assert_silent();                                                                                               \
        ck_assert_msg(broken_ == 0, "%d errors are too large", broken_);                                               \
    } while (0)

/* One run each: for what takes long, and with sanitizers. */
#define assert_once(bounds) assert_kept(bounds_countBroken, bounds, ENGINE_RIGID)
/* One run each with the universe's own epsilon. */
#define assert_by_default(bounds) assert_kept(bounds_countBroken, bounds, ENGINE_DEFAULTS)
#ifdef TEST_IS_SLOW
#define assert_cases(bounds) assert_once(bounds)
#else
#define assert_cases(bounds) assert_kept(bounds_countBrokenCases, bounds, ENGINE_RIGID)
#endif

#endif
