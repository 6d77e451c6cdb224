/* The engines of a program: those that were built in, and those of --peer. */
#include "engines.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

enum { MAX_ENGINES = 10 };

/* Karma's of one kind: a program of one precision (BENCH_SINGLE) has those of that. */
#ifdef BENCH_SINGLE
#define KARMA(kind) &engine_##kind##_single
#else
#define KARMA(kind) &engine_##kind##_single, &engine_##kind##_double
#endif

static const Engine *const worlds[] = {KARMA(karma), NULL};
static const Engine *const universes[] = {KARMA(universe), NULL};

const Engine *engines[MAX_ENGINES + 1] = {
    KARMA(karma),   KARMA(universe),
#ifdef BENCH_ODE
    &engine_ode,
#endif
#ifdef BENCH_BULLET
    &engine_bullet,
#endif
#ifdef BENCH_MUJOCO
    &engine_mujoco,
#endif
    NULL,
};

const char *const engines_absent[] = {
#ifndef BENCH_ODE
    "ODE is not there: the Debian package libode-dev brings it.",
#endif
#ifndef BENCH_BULLET
    "Bullet is not there: the Debian package libbullet-dev brings it.",
#endif
#ifndef BENCH_MUJOCO
    "MuJoCo is not there: the Debian package libmujoco-dev brings it.",
#endif
    NULL,
};

static bool isAmong(const Engine *const some[], const Engine *e) {
    while (*some && *some != e)
        some++;
    return *some != NULL;
}

bool engines_isWorld(const Engine *e) {
    return isAmong(worlds, e);
}

bool engines_isUniverse(const Engine *e) {
    return isAmong(universes, e);
}

EngineSolver engines_solver(int n) {
    for (int e = 0; engines[e]; e++)
        for (int s = 0; engines[e]->settings[s]; s++)
            if (n-- == 0)
                return (EngineSolver){engines[e], s};
    return (EngineSolver){NULL, 0};
}

bool engines_isForScene(const Engine *e, const SceneWorld *world) {
    if (engines_isWorld(e))
        return !world->collides;
    if (engines_isUniverse(e))
        return world->collides;
    return true;
}

bool engines_isSolverForScene(EngineSolver solver, const Scene *scene) {
    SceneWorld *world = calloc(1, sizeof *world);
    if (!world)
        abort();
    scene->build(scene, world);
    const bool isFor = engines_isForScene(solver.engine, world);
    free(world);
    return isFor && !(engines_isUniverse(solver.engine) && solver.setting == ENGINE_TWO_WORKERS);
}

bool engines_addPeer(const char *file) {
    int n = 0;
    while (engines[n])
        n++;
    void *library = dlopen(file, RTLD_NOW);
    const Engine *peer = library ? dlsym(library, "engine") : NULL;
    if (!peer)
        fprintf(stderr, "%s: %s\n", file, dlerror());
    if (peer && n < MAX_ENGINES)
        engines[n] = peer;
    return peer && n < MAX_ENGINES;
}
