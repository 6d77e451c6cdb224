/* One run of a scene in an engine. */
#ifndef BENCH_RUN_H
#define BENCH_RUN_H

#include "engine.h"

#include <stdint.h>

typedef enum RunOutcome {
    RUN_HOLDS,
    RUN_FAILS,    /* an error passed its bound, or is no number, or the engine gave up */
    RUN_TIMES_OUT /* the budget was spent */
} RunOutcome;

typedef struct RunResult {
    RunOutcome outcome;
    double simulated; /* s */
    double errors[SCENE_MAX_ERRORS];
    uint64_t hash;                  /* of the states after every frame, bit for bit */
    double median, p95, p99, worst; /* µs of a frame, contacts made by hand included */
    double cpu;                     /* s of all threads per simulated second, reading the clock included */
} RunResult;

/* What the scene needs and the engine has not, in words; null: it has all. */
const char *run_lack(const Scene *scene, const Engine *engine, int setting);

/* The engine's world with the scene's, which must live as long. Destroyed by the engine. */
EngineWorld *run_make(const Engine *engine, int setting, const SceneWorld *world);

/* Every frame is `substeps` steps. Ends early when the scene is done, has failed, or has taken `budget` seconds,
 * watching included. */
RunResult run_scene(const Scene *scene, const Engine *engine, int setting, int substeps, double budget);

#endif
