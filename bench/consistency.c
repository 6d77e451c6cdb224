/* How far an engine's steps agree with its own much smaller ones (Erez, Tassa, Todorov 2015): as CSV.
 *
 *     consistency [--quick] [--peer FILE]
 *
 * A scene is run with steps of 1/64 of a frame, and its states are kept every tenth of a second. From each of them it
 * is run on for a tenth of a second with larger steps; the error is the distance from the next kept state, the mean
 * over all of the root mean square over the bodies. What an engine does consistently wrong is not seen. */
#include "timing.h"

#include "engines.h"
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FINEST = 64, SPAN = 6 /* frames */, MAX_SPANS = 10, FEW_SPANS = 2 };

static const char *const names[] = {"erez-chain", "erez-capsules", "erez-humanoid", "erez-grasp"};
static const int divisions[] = {1, 2, 4, 8, 16};

static SceneState kept[MAX_SPANS + 1][SCENE_MAX_BODIES];

/* The same world as it is in these states. Stops are left out, since angles begin anew at 0. */
static void moveTo(const SceneWorld *from, const SceneState states[], SceneWorld *to) {
    *to = *from;
    for (int i = 0; i < from->numBodies; i++)
        to->bodies[i].start = states[i];
    for (int i = 0; i < from->numJoints; i++) {
        const SceneJoint *j = &from->joints[i];
        SceneJoint *moved = &to->joints[i];
        scene_attachment(from, states, j->child, j->point, moved->point);
        scene_rotateBack(from->bodies[j->child].start.quaternion, j->axis, moved->axis);
        scene_rotate(states[j->child].quaternion, moved->axis, moved->axis);
        moved->stops[0] = moved->stops[1] = 0;
    }
}

static void read(const Engine *e, EngineWorld *w, int n, SceneState states[]) {
    for (int i = 0; i < n; i++)
        e->getState(w, i, &states[i]);
}

static void advance(const Engine *e, EngineWorld *w, int steps, double h) {
    for (int i = 0; i < steps; i++)
        e->step(w, h);
}

static void keep(const SceneWorld *world, const Engine *e, int setting, int spans) {
    EngineWorld *w = run_make(e, setting, world);
    read(e, w, world->numBodies, kept[0]);
    for (int i = 1; i <= spans; i++) {
        advance(e, w, SPAN * FINEST, SCENE_FRAME / FINEST);
        read(e, w, world->numBodies, kept[i]);
    }
    e->destroy(w);
}

static double errorOf(const SceneState is[], const SceneState should[], int n) {
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double off[3];
        for (int c = 0; c < 3; c++)
            off[c] = is[i].position[c] - should[i].position[c];
        sum += scene_dot(off, off);
    }
    return sqrt(sum / n);
}

static void compare(const Scene *s, const SceneWorld *world, const Engine *e, int setting, int division, int spans) {
    static SceneWorld moved;
    static SceneState states[SCENE_MAX_BODIES];
    double sum = 0, time = 0;
    for (int i = 0; i < spans; i++) {
        moveTo(world, kept[i], &moved);
        EngineWorld *w = run_make(e, setting, &moved);
        read(e, w, world->numBodies, states);
        const double start = cpuTime();
        advance(e, w, SPAN * division, SCENE_FRAME / division);
        time += cpuTime() - start;
        read(e, w, world->numBodies, states);
        sum += errorOf(states, kept[i + 1], world->numBodies);
        e->destroy(w);
    }
    printf("%s,%s,%s,%d,%.4g,%.4g\n", s->name, e->name, e->settings[setting], division, 1e6 * time / (spans * SPAN),
           sum / spans);
    fflush(stdout);
}

/* Settings of Karma whose steps differ much. */
static bool isCompared(const Engine *e, int setting) {
    if (e == &engine_karma_single || e == &engine_karma_double)
        return setting == ENGINE_RIGID || setting == ENGINE_ORDER_4;
    if (e == &engine_universe_single || e == &engine_universe_double)
        return setting == ENGINE_RIGID || setting == ENGINE_FINE;
    return true;
}

static void runScene(const Scene *s, int spans) {
    static SceneWorld world;
    memset(&world, 0, sizeof world);
    s->build(s, &world);
    for (int i = 0; i < world.numJoints; i++)
        world.joints[i].stops[0] = world.joints[i].stops[1] = 0;
    for (int e = 0; engines[e]; e++)
        for (int k = 0; engines[e]->settings[k] && engines_isForScene(engines[e], &world); k++) {
            if (!isCompared(engines[e], k) || run_lack(s, engines[e], k))
                continue;
            keep(&world, engines[e], k, spans);
            for (size_t d = 0; d < sizeof divisions / sizeof *divisions; d++)
                compare(s, &world, engines[e], k, divisions[d], spans);
        }
}

int main(int argc, char *argv[]) {
    int spans = MAX_SPANS;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--quick") == 0)
            spans = FEW_SPANS;
        else if (strcmp(argv[i], "--peer") != 0 || ++i == argc || !engines_addPeer(argv[i]))
            return fputs("usage: consistency [--quick] [--peer FILE]\n", stderr), 2;
    puts("scene,engine,setting,substeps,us,error");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        runScene(scene_find(names[i]), spans);
    return 0;
}
