/* The map of stability: of each engine the cheapest setting that holds, over mass ratio, stiffness and count.
 *
 * stability [--quick] [--scene NAME] [--peer FILE]... writes CSV: scene, parameter, count, engine, solver, step [s],
 * CPU time [us] of a simulated second. A step of 0: nothing held. Each solver gets longer steps first; the longest that
 * holds is timed. */
#include "timing.h"

#include "engines.h"
#include "run.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MAX_STEPS = 64 /* a frame */, RUNS = 3, MAX_PLACES = 8 };
static const double budget = 4; /* s, of one run; what takes longer is of no use to a game */

typedef struct Map {
    const Scene *scene;
    double parameters[MAX_PLACES]; /* end with a 0, */
    int counts[MAX_PLACES];        /* and so do these */
} Map;

static const Map maps[] = {
    {&scenes_mapChain, {1, 10, 100, 1e3, 1e4, 1e5, 1e6}, {3, 10, 30, 100}},
    {&scenes_mapTower, {1, 10, 100, 1e3, 1e4, 1e5, 1e6}, {2, 5, 10, 20}},
    {&scenes_mapBeam, {1, 10, 100, 1e3, 1e4, 1e5}, {3, 10, 30, 100}},
};
static const Map few[] = {
    {&scenes_mapChain, {1, 100, 1e4}, {3, 30}},
    {&scenes_mapTower, {1, 100, 1e4}, {2, 10}},
    {&scenes_mapBeam, {1, 100, 1e4}, {3, 30}},
};

typedef struct Best {
    EngineSolver solver;
    int steps;  /* a frame; 0: nothing held */
    double cpu; /* s per simulated second */
} Best;

static bool holds(const Scene *cell, EngineSolver solver, int steps, double *cpu) {
    const RunResult run = run_scene(cell, solver.engine, solver.setting, steps, budget);
    *cpu = run.cpu;
    return run.outcome == RUN_HOLDS;
}

/* The longest step with which the solver holds. */
static Best longestStep(const Scene *cell, EngineSolver solver) {
    Best best = {.solver = solver};
    for (int steps = 1; best.steps == 0 && steps <= MAX_STEPS; steps *= 2)
        if (holds(cell, solver, steps, &best.cpu))
            best.steps = steps;
    return best;
}

static void timeAgain(const Scene *cell, Best *best) {
    double times[RUNS] = {best->cpu};
    for (int i = 1; i < RUNS; i++)
        holds(cell, best->solver, best->steps, &times[i]);
    best->cpu = median(times, RUNS);
}

/* The cheapest of an engine's solvers. */
static Best cheapest(const Scene *cell, const Engine *engine) {
    Best best = {.solver = {engine, 0}};
    for (int s = 0; engine->settings[s]; s++) {
        const EngineSolver solver = {engine, s};
        if (!engines_isSolverForScene(solver, cell) || run_lack(cell, engine, s))
            continue;
        const Best mine = longestStep(cell, solver);
        if (mine.steps > 0 && (best.steps == 0 || mine.cpu < best.cpu))
            best = mine;
    }
    if (best.steps > 0)
        timeAgain(cell, &best);
    return best;
}

static bool isForCell(const Engine *engine, const Scene *cell) {
    return engines_isSolverForScene((EngineSolver){engine, 0}, cell);
}

static void print(const Scene *cell, const Best *best) {
    const Engine *engine = best->solver.engine;
    printf("%s,%g,%d,%s,\"%s\",%g,%.4g\n", cell->name, cell->parameter, cell->count, engine->name,
           best->steps ? engine->settings[best->solver.setting] : "-", best->steps ? cell->frame / best->steps : 0,
           1e6 * best->cpu);
    fflush(stdout);
}

static void drawMap(const Map *map) {
    for (int i = 0; i < MAX_PLACES && map->parameters[i] > 0; i++)
        for (int k = 0; k < MAX_PLACES && map->counts[k] > 0; k++) {
            Scene cell = *map->scene;
            cell.parameter = map->parameters[i];
            cell.count = map->counts[k];
            for (int e = 0; engines[e]; e++)
                if (isForCell(engines[e], &cell)) {
                    const Best best = cheapest(&cell, engines[e]);
                    print(&cell, &best);
                }
        }
}

int main(int argc, char **argv) {
    const Map *drawn = maps;
    const char *only = NULL;
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--quick"))
            drawn = few;
        else if (!strcmp(argv[i], "--scene") && i + 1 < argc)
            only = argv[++i];
        else if (strcmp(argv[i], "--peer") != 0 || i + 1 == argc || !engines_addPeer(argv[++i])) {
            fprintf(stderr, "stability [--quick] [--scene NAME] [--peer FILE]...\n");
            return 2;
        }
    printf("scene,parameter,count,engine,solver,step,us\n");
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (!only || !strcmp(only, drawn[i].scene->name))
            drawMap(&drawn[i]);
    return 0;
}
