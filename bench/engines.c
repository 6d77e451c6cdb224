/* The engines of a program: those that were built in, and those of --peer. */
#include "engines.h"

#include <dlfcn.h>
#include <stdio.h>

enum { MAX_ENGINES = 10 };

const Engine *engines[MAX_ENGINES + 1] = {
    &engine_karma_single,
    &engine_karma_double,
    &engine_universe_single,
    &engine_universe_double,
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

bool engines_isForScene(const Engine *e, const SceneWorld *world) {
    if (e == &engine_karma_single || e == &engine_karma_double)
        return !world->collides;
    if (e == &engine_universe_single || e == &engine_universe_double)
        return world->collides;
    return true;
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
