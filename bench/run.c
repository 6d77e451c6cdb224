/* One run of a scene in an engine. */
#include "timing.h"

#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Run {
    const Scene *scene;
    const Engine *engine;
    EngineWorld *in;
    SceneWorld world;
    SceneTrace trace;
    SceneState states[SCENE_MAX_BODIES];
    SceneContact contacts[SCENE_MAX_CONTACTS];
} Run;

/* Of the bits of all states of all frames: FNV-1a. */
static void hash(const Run *r, uint64_t *sum) {
    const unsigned char *bytes = (const unsigned char *)r->states;
    for (size_t i = 0; i < (size_t)r->world.numBodies * sizeof r->states[0]; i++)
        *sum = (*sum ^ bytes[i]) * 1099511628211u;
}

const char *run_lack(const Scene *scene, const Engine *engine, int setting) {
    if (scene->bounces && !engine->bounces)
        return "no restitution";
    if (scene->hasEdges && engine->setContacts)
        return "no collision of its own";
    SceneWorld *world = calloc(1, sizeof *world);
    if (!world)
        abort();
    scene->build(scene, world);
    const char *lack = world->terrain.xCount > 0 && !engine->addTerrain ? "no terrain"
                       : engine->lack                                   ? engine->lack(scene, world, setting)
                                                                        : NULL;
    free(world);
    return lack;
}

EngineWorld *run_make(const Engine *engine, int setting, const SceneWorld *world) {
    EngineWorld *w = engine->create(setting, world->gravity, world->collides);
    if (world->collides && world->terrain.xCount > 0)
        engine->addTerrain(w, &world->terrain);
    else if (world->collides)
        engine->addGround(w);
    for (int i = 0; i < world->numBodies; i++)
        engine->addBody(w, &world->bodies[i]);
    for (int i = 0; i < world->numJoints; i++)
        engine->addJoint(w, &world->joints[i]);
    return w;
}

static void readStates(Run *r) {
    for (int i = 0; i < r->world.numBodies; i++)
        r->engine->getState(r->in, i, &r->states[i]);
}

/* What is not a number fails too. */
static bool isFiniteState(const Run *r) {
    double sum = 0;
    for (int i = 0; i < r->world.numBodies; i++)
        sum += scene_dot(r->states[i].position, r->states[i].position) +
               scene_dot(r->states[i].velocity, r->states[i].velocity) +
               scene_dot(r->states[i].spin, r->states[i].spin);
    return isfinite(sum);
}

static bool hasFailed(const Run *r) {
    for (int k = 0; k < SCENE_MAX_ERRORS && r->scene->errors[k].name; k++)
        if (!(r->trace.worst[k] < r->scene->errors[k].fails))
            return true;
    return !isFiniteState(r) || (r->engine->hasGivenUp && r->engine->hasGivenUp(r->in));
}

static void observe(Run *r, double time) {
    r->scene->observe(&r->trace, &r->world, r->states, time);
    for (int i = 0; i < r->world.numBodies; i++)
        memcpy(r->trace.before[i], r->trace.last[i].position, sizeof r->trace.before[i]);
    memcpy(r->trace.last, r->states, (size_t)r->world.numBodies * sizeof r->states[0]);
    r->trace.lastTime = time;
}

/* Returns the seconds that it took. */
static double frame(Run *r, int substeps) {
    const double start = now(), h = scene_frame(r->scene) / substeps;
    for (int i = 0; i < substeps; i++) {
        if (r->engine->setContacts && r->world.collides) {
            readStates(r);
            const int n = scene_contacts(&r->world, r->states, h, r->contacts);
            r->engine->setContacts(r->in, r->contacts, n);
        }
        r->engine->step(r->in, h);
    }
    return now() - start;
}

static void summarize(const Run *r, double times[], int n, RunResult *result) {
    result->median = n ? 1e6 * median(times, n) : 0;
    result->p95 = n ? 1e6 * times[95 * n / 100] : 0;
    result->p99 = n ? 1e6 * times[99 * n / 100] : 0;
    result->worst = n ? 1e6 * times[n - 1] : 0;
    r->scene->measure(&r->trace, &r->world, result->errors);
    for (int k = 0; k < SCENE_MAX_ERRORS && r->scene->errors[k].name; k++)
        if (result->outcome == RUN_HOLDS && isnan(result->errors[k]))
            result->outcome = RUN_FAILS;
}

RunResult run_scene(const Scene *scene, const Engine *engine, int setting, int substeps, double budget) {
    RunResult result = {.outcome = RUN_HOLDS, .hash = 14695981039346656037u};
    Run *r = calloc(1, sizeof *r);
    const int frames = (int)lround(scene->duration / scene_frame(scene));
    double *times = calloc((size_t)frames, sizeof *times);
    const double start = now();
    double cpu = 0;
    int n = 0;
    if (!r || !times)
        abort();
    r->scene = scene;
    r->engine = engine;
    scene->build(scene, &r->world);
    r->trace.energy = scene_startEnergy(&r->world);
    r->in = run_make(engine, setting, &r->world);
    readStates(r);
    observe(r, 0);
    while (n < frames && !r->trace.isDone && result.outcome == RUN_HOLDS) {
        const double before = cpuTime();
        times[n] = frame(r, substeps);
        cpu += cpuTime() - before;
        readStates(r);
        hash(r, &result.hash);
        observe(r, ++n * scene_frame(scene));
        result.outcome = hasFailed(r) ? RUN_FAILS : now() - start > budget ? RUN_TIMES_OUT : RUN_HOLDS;
    }
    result.simulated = n * scene_frame(scene);
    result.cpu = n ? cpu / result.simulated : 0;
    summarize(r, times, n, &result);
    engine->destroy(r->in);
    free(times);
    free(r);
    return result;
}
