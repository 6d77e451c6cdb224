/* Scenes of blows without loss: pendulums that hit each other, and a crowd of balls. */
#include "scenes_i.h"

#include <math.h>

/* ---- a cradle of pendulums */

enum { PENDULUMS = 5 };
static const double stringLength = 4, swing = .7, between = .02; /* m; rad, of the first one; of a ball */

static void hangLast(SceneWorld *w, double x, double y) {
    SceneJoint *j = scene_joinLast(w, SCENE_BALL_JOINT, x, y, 0);
    j->parent = SCENE_WORLD;
}

static void buildPendulums(const Scene *s, SceneWorld *w) {
    (void)s;
    const double high = 10;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < PENDULUMS; i++) {
        const double x = (1 + between) * i;
        scene_addSphere(w, 1, .5, x, high, 0)->restitution = 1;
        hangLast(w, x, high + stringLength);
    }
    SceneState *first = &w->bodies[0].start;
    first->position[0] = -stringLength * sin(swing);
    first->position[1] = high + stringLength * (1 - cos(swing));
    first->quaternion[0] = cos(.5 * swing);
    first->quaternion[3] = -sin(.5 * swing);
}

/* Heights that they rise to after the blow, of the first one's at the start. */
static void watchPendulums(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double drop = stringLength * (1 - cos(swing)), period = 2 * PI * sqrt(stringLength / GRAVITY);
    for (int i = 0; i < w->numBodies && time > .3 * period; i++) {
        const double height = (states[i].position[1] - w->bodies[PENDULUMS - 1].start.position[1]) / drop;
        const int which = i == PENDULUMS - 1 ? 0 : 1;
        t->top[0][which] = fmax(t->top[0][which], height);
    }
}

static void measurePendulums(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    (void)w;
    errors[0] = fabs(t->top[0][0] - 1);
    errors[1] = t->top[0][1];
}

const Scene scenes_pendulums = {
    .name = "pendulums",
    .text =
        "five balls hang on strings of four diameters, .02 of one apart, and the first one swings from .7 rad, e = 1, "
        "until the last one has risen: error of its height, largest height of another, of the first one's",
    .duration = 2.6,
    .bounces = true,
    .errors = {{"height", .5, .02}, {"others", .5, .02}},
    .build = buildPendulums,
    .observe = watchPendulums,
    .measure = measurePendulums,
};

/* ---- a crowd */

enum { CROWD_SIDE = 5 };
static const double apart = 1.5; /* diameters */

/* -1 .. 1, the same everywhere: a linear congruential generator. */
static double nextRandom(unsigned *state) {
    *state = (*state * 1664525u + 1013904223u) & 0xffffffffu;
    return (double)(*state >> 8) / (double)(1 << 23) - 1;
}

static void buildElastic(const Scene *s, SceneWorld *w) {
    unsigned random = 1;
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < CROWD_SIDE * CROWD_SIDE * CROWD_SIDE; i++) {
        const int cell[3] = {i % CROWD_SIDE, i / CROWD_SIDE % CROWD_SIDE, i / (CROWD_SIDE * CROWD_SIDE)};
        double at[3];
        for (int k = 0; k < 3; k++)
            at[k] = apart * cell[k] + .1 * nextRandom(&random);
        SceneBody *b = scene_addSphere(w, 1, .5, at[0], at[1] + 1, at[2]);
        b->restitution = 1;
        for (int k = 0; k < 3; k++)
            b->start.velocity[k] = nextRandom(&random);
    }
}

static void watchElastic(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, scene_energy(w, states) / t->energy - 1);
}

const Scene scenes_elastic = {
    .name = "elastic",
    .text =
        "125 balls, half a diameter apart, fall and meet, e = 1, without friction, 5 s: largest relative error of the "
        "energy",
    .duration = 5,
    .bounces = true,
    .errors = {{"energy", 10, 1e-3}},
    .build = buildElastic,
    .observe = watchElastic,
    .measure = scenes_copyWorst,
};
