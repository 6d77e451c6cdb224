/* Small scenes of a few dozen bodies, ten seconds each: what a step costs as a rule, and what the worst one does.
 *
 *     spikes [--steps N] [--exact]      600 steps
 *
 * With --exact all is solved exactly (MdtWorldSetSolver). The scenes of tests/states but for the heap, and a wall, with
 * the universe's defaults, steps of 1/60 s; what comes to rest is put to rest. Whole steps, through the pipeline; the
 * best of three runs, step by step, as a step is the same in each of them. */
#include "timing.h"

#include "MdtReport.h"
#include "twelve.h"
#include "wall.h"

#include <stdio.h>
#include <string.h>

enum { RUNS = 3 };

typedef struct Cost {
    double *time; /* s, of each step */
    int factorizations, max;
} Cost;

/* Makes the n-th scene, of which the wall is the last; returns how many bodies it has. */
static int make(int n, MstUniverseID u) {
    static Place place;
    if (n == TWELVE)
        return wall_make(u);
    twelve_make(&place, &twelve[n], u, 0, 0);
    return place.count;
}

static const char *nameOf(int n) {
    return n == TWELVE ? "wall" : twelve[n].name;
}

/* Returns how many bodies there are. */
static int run(int scene, MdtSolver solver, int steps, Cost *cost, MeBool isFirst) {
    const MstUniverseID u = twelve_makeUniverse();
    MdtWorldSetSolver(u->world, solver);
    MdtWorldEnableReport(u->world);
    const int bodies = make(scene, u);
    for (int i = 0; i < steps; i++) {
        MdtReport r;
        const double start = now();
        MstUniverseStep(u, (MeReal)(1. / 60));
        const double time = now() - start;
        cost->time[i] = isFirst || time < cost->time[i] ? time : cost->time[i];
        MdtWorldGetReport(u->world, &r);
        cost->factorizations += isFirst ? r.factorizations : 0;
        cost->max = MeMAX(cost->max, r.factorizations);
    }
    MstUniverseDestroy(u);
    return bodies;
}

static void tell(const char *name, int bodies, int steps, const Cost *c) {
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += c->time[i];
    const double middle = median(c->time, steps);
    printf("| %s | %d | %.3f | %.3f | %.3f | %.3f | %.1f | %d |\n", name, bodies, 1e3 * sum / steps, 1e3 * middle,
           1e3 * c->time[steps * 99 / 100], 1e3 * c->time[steps - 1], (double)c->factorizations / steps, c->max);
    fflush(stdout);
}

int main(int argc, char **argv) {
    int steps = 600;
    MdtSolver solver = MdtSolverAuto;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--exact") == 0)
            solver = MdtSolverExact;
        else if (strcmp(argv[i], "--steps") == 0 && i + 1 < argc)
            steps = atoi(argv[++i]);
        else
            steps = 0;
    if (steps < 1)
        return fputs("spikes [--steps N] [--exact]\n", stderr), 2;
    puts("| scene | bodies | mean, ms | median | 99 % | worst | factorizations | at most |");
    puts("|---|---|---|---|---|---|---|---|");
    for (int i = 0; i <= TWELVE; i++) {
        Cost cost = {.time = calloc((size_t)steps, sizeof(double))};
        int bodies = 0;
        if (!cost.time)
            return 1;
        for (int k = 0; k < RUNS && strcmp(nameOf(i), "heap") != 0; k++)
            bodies = run(i, solver, steps, &cost, k == 0);
        if (bodies > 0)
            tell(nameOf(i), bodies, steps, &cost);
        free(cost.time);
    }
    return 0;
}
