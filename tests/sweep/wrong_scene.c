/* Scenes that karma-sweep has to refuse: SWEEP_TEST_WRONG is the number of one; check_faults.py says what it gets. */
#include "KarmaSweep.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

static int run(const double *parameter, double *result) {
    result[0] = parameter[0];
    return 0;
}

static const SweepParameter right[] = {{"a", 0, 1, 2}}, nameless[] = {{NULL, 0, 1, 2}}, torn[] = {{"a\nb", 0, 1, 2}},
                            backward[] = {{"a", 1, 0, 2}}, endless[] = {{"a", -1e308, 1e308, 2}},
                            undefined[] = {{"a", NAN, 1, 2}}, placeless[] = {{"a", 0, 1, 0}};
static const char *const names[] = {"r"}, *const nulls[] = {NULL}, *const commas[] = {"r,s"};

static const SweepScene scenes[] = {
    {SWEEP_VERSION + 1, "wrong", 1, right, 1, names, run},
    {SWEEP_VERSION, NULL, 1, right, 1, names, run},
    {SWEEP_VERSION, "../wrong", 1, right, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, right, 1, names, NULL},
    {SWEEP_VERSION, "wrong", -1, right, 1, names, run},
    {SWEEP_VERSION, "wrong", SWEEP_PARAMETERS + 1, right, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, NULL, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, right, 0, names, run},
    {SWEEP_VERSION, "wrong", 1, right, -1, names, run},
    {SWEEP_VERSION, "wrong", 1, right, SWEEP_RESULTS + 1, names, run},
    {SWEEP_VERSION, "wrong", 1, right, 1, NULL, run},
    {SWEEP_VERSION, "wrong", 1, right, 1, nulls, run},
    {SWEEP_VERSION, "wrong", 1, right, 1, commas, run},
    {SWEEP_VERSION, "wrong", 1, nameless, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, torn, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, backward, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, endless, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, undefined, 1, names, run},
    {SWEEP_VERSION, "wrong", 1, placeless, 1, names, run},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

SWEEP_EXPORT const SweepScene *sweepScene(void) {
    const int number = atoi(getenv("SWEEP_TEST_WRONG"));
    if (number < SCENES)
        return &scenes[number];
    if (number == SCENES + 1)
        abort();
    if (number == SCENES + 2)
        exit(0);
    return number == SCENES ? NULL : (const SweepScene *)(uintptr_t)64; /* no address of anything */
}
