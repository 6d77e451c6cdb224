/* What rag dolls cost that fall on a plane, each by itself: the factorizations and the time of one doll's step.
 *
 *     dolls [--dolls N] [--steps N] [--exact]      100 dolls, 300 steps
 *
 * With --exact all is solved exactly (MdtWorldSetSolver), else only until a doll is hit.
 * The figures of tutorial Ragdolls, thrown and turning in any way, 7 m apart, with the universe's defaults, friction
 * .5, steps of 1/60 s, nothing put to sleep. A line for every sixty steps; times are those of solves. */
#include "timing.h"

#include "MdtReport.h"
#include "ragdoll.h"

#include <stdio.h>
#include <string.h>

enum { STRETCH = 60 }; /* steps */

typedef struct Sum {
    double factorizations, passes, parts, stages, time; /* s */
    int max, inexact, steps;                            /* steps: of single dolls */
} Sum;

static MstUniverseID universe;
static Doll *doll;

static double randomFrom(double low, double high) {
    static unsigned int seed = 1;
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / (1 << 24);
}

static void makeUniverse(MdtSolver solver) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    universe = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!universe)
        abort();
    MdtWorldSetGravity(universe->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(universe->world, MEFALSE);
    MdtWorldEnableReport(universe->world);
    MdtWorldSetSolver(universe->world, solver);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(universe->bridge, 0, 0), (MeReal).5, 0);
    MstFixedModelCreate(universe, McdPlaneCreate(universe->frame), floorTM);
}

static void makeDolls(int dolls) {
    for (int i = 0; i < dolls; i++) {
        const double feet[3] = {7 * (i % 10), randomFrom(.05, 1), 7 * (i / 10)};
        double v[3], w[3];
        for (int k = 0; k < 3; k++)
            v[k] = randomFrom(-2, 2), w[k] = randomFrom(-3, 3);
        doll_make(&doll[i], universe, feet);
        doll_throw(&doll[i], v, w);
    }
}

static void add(Sum *sum) {
    MdtReport r;
    for (int i = 0; i < MdtWorldGetReportCount(universe->world); i++) {
        MdtWorldGetPartitionReport(universe->world, i, &r);
        sum->factorizations += r.factorizations;
        sum->passes += r.passes;
        sum->parts += r.parts;
        sum->stages += r.stages;
        sum->time += (double)r.time[MdtReportStageSolve];
        sum->max = r.factorizations > sum->max ? r.factorizations : sum->max;
        sum->inexact += r.fallbacks > 0;
    }
}

static void tell(const Sum *sum, int steps, int dolls) {
    const double n = (double)STRETCH * dolls;
    double open = 0;
    for (int i = 0; i < dolls; i++)
        open = fmax(open, doll_opening(&doll[i]));
    printf("| %d | %.1f | %d | %.2f | %.2f | %.2f | %d | %.4f | %.1e |\n", steps, sum->factorizations / n, sum->max,
           sum->passes / n, sum->parts / n, sum->stages / n, sum->inexact, 1e3 * sum->time / n, open);
    fflush(stdout);
}

static int usage(void) {
    fprintf(stderr, "usage: dolls [--dolls N] [--steps N] [--exact]\n");
    return 2;
}

int main(int argc, char **argv) {
    int dolls = 100, steps = 300;
    MdtSolver solver = MdtSolverAuto;
    for (int i = 1; i < argc; i++) {
        int *number = strcmp(argv[i], "--dolls") == 0 ? &dolls : strcmp(argv[i], "--steps") == 0 ? &steps : NULL;
        if (strcmp(argv[i], "--exact") == 0)
            solver = MdtSolverExact;
        else if (!number || ++i == argc || (*number = atoi(argv[i])) < 1)
            return usage();
    }
    doll = calloc((size_t)dolls, sizeof *doll);
    if (!doll)
        abort();
    makeUniverse(solver);
    makeDolls(dolls);
    printf("| to step | factorizations of a doll's step | at most | passes | parts | velocity stages | inexact | ms | "
           "joints open, m |\n");
    printf("|---|---|---|---|---|---|---|---|---|\n");
    Sum sum = {0};
    for (int i = 1; i <= steps; i++) {
        MstUniverseStep(universe, (MeReal)(1. / 60));
        add(&sum);
        if (i % STRETCH == 0) {
            tell(&sum, i, dolls);
            memset(&sum, 0, sizeof sum);
        }
    }
    MstUniverseDestroy(universe);
    free(doll);
    return 0;
}
