/* A scene for the tests of karma-sweep: results that anybody can compute; runs that fail, crash or hang on demand. */
#define _DEFAULT_SOURCE /* usleep */
#include "KarmaSweep.h"
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

enum { A, B, MISHAP };
static const SweepParameter parameters[] = {{"a [m]", 0, 3, 4}, {"b", -1, 1, 3}, {"mishap", 0, 0, 1}};
static const char *const results[] = {"product [m]", "root", "nothing"};

/* Microseconds that a run takes. */
static void delay(void) {
    const char *text = getenv("SWEEP_TEST_DELAY");
    if (text)
        usleep((unsigned int)strtoul(text, NULL, 10));
}

static int run(const double *p, double *result) {
    delay();
    if (p[MISHAP] == 1 && p[A] == 2)
        raise(SIGKILL);
    if (p[MISHAP] == 2 && p[A] == 2)
        pause();
    if (p[MISHAP] == 3 && p[A] == 2)
        return 7;
    result[0] = p[A] * p[B];
    result[1] = sqrt(p[A] + 10);
    return 0;
}

static const SweepScene scene = {SWEEP_VERSION, "test", 3, parameters, 3, results, run};

SWEEP_EXPORT const SweepScene *sweepScene(void) {
    return &scene;
}
