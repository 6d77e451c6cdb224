/* Scenes of bodies that fly, and meet only for an instant. */
#include "scenes_i.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Free bodies */

static void buildTumbling(const Scene *s, SceneWorld *w) {
    (void)s;
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, 0, 0, 0);
    b->start.spin[0] = .01;
    b->start.spin[1] = 5;
}

/* The angular velocity about the middle axis, and its rate by Euler's equations. */
static void middleSpin(const SceneBody *b, const SceneState *s, double *spin, double *rate) {
    double inertia[3], w[3];
    scene_inertia(b, inertia);
    scene_rotateBack(s->quaternion, s->spin, w);
    *spin = w[1];
    *rate = (inertia[2] - inertia[0]) * w[2] * w[0] / inertia[1];
}

/* The part of a span h where the cubic with these values and rates at its ends is 0. */
static double cubicZero(double a, double rateA, double b, double rateB, double h) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        const double s = (low + high) / 2, r = 1 - s;
        const double value = r * r * (a * (1 + 2 * s) + rateA * h * s) + s * s * (b * (1 + 2 * r) - rateB * h * r);
        *(value * a > 0 ? &low : &high) = s;
    }
    return low;
}

static void watchTumbling(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double h = time - t->lastTime;
    double now, before, rates[2];
    middleSpin(&w->bodies[0], &t->last[0], &before, &rates[0]);
    middleSpin(&w->bodies[0], &states[0], &now, &rates[1]);
    if (time > 0 && now * before < 0 && t->events[0]++ == 0)
        t->firstEvent = t->lastTime + h * cubicZero(before, rates[0], now, rates[1], h);
    scenes_note(t, 0, scene_energy(w, states) / t->energy - 1);
}

static void measureTumbling(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    double inertia[3];
    scene_inertia(&w->bodies[0], inertia);
    const ReferenceTumbling r = reference_tumbling(inertia, w->bodies[0].start.spin, t->lastTime);
    errors[0] = t->worst[0];
    errors[1] = t->events[0] ? fabs(t->firstEvent - r.firstFlip) : INFINITY;
    errors[2] = abs(t->events[0] - r.flips);
}

const Scene scenes_tumbling = {
    .name = "tumbling",
    .text = "a box of 1 x .6 x .2 m turns about its middle axis at 5 rad/s, without gravity, 60 s: largest relative "
            "error of the energy, error of the time of the first flip (2.4543 s), flips too many or too few (of 12)",
    .duration = 60,
    .errors = {{"energy", 10, 1e-9}, {"flip s", INFINITY, 1e-6}, {"flips", INFINITY, 0}},
    .build = buildTumbling,
    .observe = watchTumbling,
    .measure = measureTumbling,
};

static void buildProjectile(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, 0, 0, 0);
    b->start.velocity[0] = 20;
    b->start.velocity[1] = 20;
    b->start.spin[2] = 3;
}

static void watchProjectile(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double *v = w->bodies[0].start.velocity, *x = states[0].position;
    const double off[3] = {x[0] - v[0] * time, x[1] - v[1] * time + GRAVITY * time * time / 2, x[2]};
    scenes_note(t, 0, sqrt(scene_dot(off, off)));
    scenes_note(t, 1, (scene_energy(w, states) - t->energy) / t->energy);
}

const Scene scenes_projectile = {
    .name = "projectile",
    .text = "a spinning box is thrown at 45 degrees and 28 m/s, 5 s: largest distance from the parabola, largest "
            "relative error of the energy",
    .duration = 5,
    .errors = {{"off m", 10, 1e-9}, {"energy", 10, 1e-9}},
    .build = buildProjectile,
    .observe = watchProjectile,
    .measure = scenes_copyWorst,
};

/* Bounces */

static const double dropHeight = 5;

static void buildBounce(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    scene_addSphere(w, 1, .1, 0, dropHeight + .1, 0)->restitution = 1;
    scene_addSphere(w, 1, .1, 0, dropHeight + .1, 2)->restitution = .5;
}

/* The top of the parabola through three heights, of which the middle one is the highest. */
static double topOf(double a, double b, double c) {
    return b - (c - a) * (c - a) / (8 * (a - 2 * b + c));
}

static void watchBounce(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    for (int i = 0; i < 2; i++) {
        const double a = t->before[i][1], b = t->last[i].position[1], c = states[i].position[1];
        if (time < 2.5 * SCENE_FRAME || !(b > a && b >= c))
            continue;
        const double top = topOf(a, b, c) - w->bodies[i].half[1];
        if (t->events[i] < 2)
            t->top[i][t->events[i]] = top;
        t->events[i]++;
        if (i == 0)
            scenes_note(t, 0, top / dropHeight - 1);
    }
}

static void measureBounce(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const double e = w->bodies[1].restitution;
    errors[0] = t->events[0] ? t->worst[0] : INFINITY;
    for (int k = 0; k < 2; k++)
        errors[1 + k] =
            t->events[1] > k ? fabs(t->top[1][k] / (dropHeight * (k ? e * e * e * e : e * e)) - 1) : INFINITY;
}

const Scene scenes_bounce = {
    .name = "bounce",
    .text = "balls of .1 m fall from 5 m, 20 s: largest relative error of a top with e = 1 (5 m), of the first and the "
            "second top with e = .5 (1.25, .3125 m)",
    .duration = 20,
    .bounces = true,
    .errors = {{"e=1", 1, 1e-5}, {"e=.5", 1, 1e-4}, {"second", INFINITY, 1e-4}},
    .build = buildBounce,
    .observe = watchBounce,
    .measure = measureBounce,
};

/* Newton's cradle */

enum { CRADLE_BALLS = 5 };
static const double cradleGap = 1e-3, cradleWay = .99; /* m; the first hits within a frame, not at its end */

/* A row that touches, and one that does not, in the sky, where nothing weighs. */
static void buildCradle(const Scene *s, SceneWorld *w) {
    (void)s;
    w->collides = true;
    for (int row = 0; row < 2; row++)
        for (int i = 0; i < CRADLE_BALLS; i++) {
            SceneBody *b = scene_addSphere(w, 1, .5, i * (row ? 1 : 1 + cradleGap), 10, 20 * row);
            b->restitution = 1;
            if (i == 0) {
                b->start.position[0] -= cradleWay;
                b->start.velocity[0] = 1;
            }
        }
}

/* The speeds that there are now: all but the last ball's should be 0. */
static void watchCradle(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    t->worst[0] = t->worst[1] = 0;
    for (int i = 0; i < w->numBodies; i++) {
        const bool isFirst = i % CRADLE_BALLS == 0, isLast = i % CRADLE_BALLS == CRADLE_BALLS - 1;
        const double should = time > 1.5 ? isLast : isFirst, *v = states[i].velocity;
        if (time <= 0 || time > 1.5)
            scenes_note(t, i / CRADLE_BALLS, hypot(v[0] - should, hypot(v[1], v[2])));
    }
    scenes_note(t, 2, scene_energy(w, states) / t->energy - 1);
}

const Scene scenes_cradle = {
    .name = "cradle",
    .text = "a ball with 1 m/s meets four that wait in a row, e = 1, without gravity, 2.5 s: largest error of a speed "
            "at the end, where there are gaps of 1 mm, and where all touch; largest relative error of the energy",
    .duration = 2.5,
    .bounces = true,
    .errors = {{"apart m/s", INFINITY, 1e-9}, {"touch m/s", INFINITY, 1e-9}, {"energy", 10, 1e-9}},
    .build = buildCradle,
    .observe = watchCradle,
    .measure = scenes_copyWorst,
};
