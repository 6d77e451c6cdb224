/* What joints among many contacts cost: a ton on a light chain that swings into a pile, a net of a hundred balls that
 * catches boxes, one that hangs by a side like a cloth, thirty machines that drive through crates; with the automatic
 * choice of the solver and with the exact one, in turn.
 *
 *     jointed [--steps N]      300 steps
 *
 * Steps of 1/60 s, the universe's defaults, friction .5, nothing put to sleep. A line for every hundred steps: mean and
 * worst time of a step, and how far the worst joint was open. */
#include "timing.h"

#include "universe.h"

#include "jointed.h"

#include <stdio.h>
#include <string.h>

enum { STRETCH = 100 }; /* steps */

static void makeThirtyMachines(MdtSolver solver) {
    makeMachines(solver, 30, 300);
}

static const struct {
    const char *name;
    void (*make)(MdtSolver solver);
} scenes[] = {
    {"heavy chain", makeHeavyChain}, {"net", makeNet}, {"cloth", makeCloth}, {"30 machines", makeThirtyMachines}};

static void run(const char *name, const char *solver, int steps) {
    double sum = 0, worst = 0, open = 0;
    for (int i = 1; i <= steps; i++) {
        const double start = now();
        MstUniverseStep(u, (MeReal)(1. / 60));
        const double time = now() - start;
        sum += time;
        worst = fmax(worst, time);
        open = fmax(open, opening());
        if (i % STRETCH != 0)
            continue;
        printf("| %s | %s | %d | %.2f | %.1f | %.1e |\n", name, solver, i, 1e3 * sum / STRETCH, 1e3 * worst, open);
        fflush(stdout);
        sum = worst = open = 0;
    }
    universe_end();
}

int main(int argc, char **argv) {
    const int steps = argc == 1 ? 300 : argc == 3 && strcmp(argv[1], "--steps") == 0 ? atoi(argv[2]) : 0;
    if (steps < 1) {
        fprintf(stderr, "usage: jointed [--steps N]\n");
        return 2;
    }
    printf("| scene | solver | to step | mean, ms | worst, ms | open, m |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        scenes[i].make(MdtSolverAuto);
        run(scenes[i].name, "auto", steps);
        scenes[i].make(MdtSolverExact);
        run(scenes[i].name, "exact", steps);
    }
    return 0;
}
