/* Crowds of loose bodies: columns, pyramids, a mixed heap, dominoes. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

enum { WATCHED = 15 /* frames: how often overlaps are looked for */ };

static bool isWatched(double time) {
    return lround(time / SCENE_FRAME) % WATCHED == 0;
}

static double fastest(const SceneWorld *w, const SceneState states[]) {
    double max = 0;
    for (int i = 0; i < w->numBodies; i++)
        max = fmax(max, sqrt(scene_dot(states[i].velocity, states[i].velocity)));
    return max;
}

/* Columns, each of which stands by itself */

enum { COLUMN = 10, COLUMNS = 100 };

/* -1 .. 1, the same everywhere: a linear congruential generator. */
static double nextRandom(unsigned *state) {
    *state = (*state * 1664525u + 1013904223u) & 0xffffffffu;
    return (double)(*state >> 8) / (double)(1 << 23) - 1;
}

static void buildColumns(const Scene *s, SceneWorld *w) {
    unsigned random = 1;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < s->count; i++) {
        const double turn = .1 * nextRandom(&random);
        SceneBody *b = scene_addBox(w, 1, 1, 1, 1, 3 * (i / COLUMN % 10) + .05 * nextRandom(&random), i % COLUMN + .5,
                                    3 * (i / COLUMN / 10) + .05 * nextRandom(&random));
        b->friction = .5;
        b->start.quaternion[0] = cos(turn / 2);
        b->start.quaternion[2] = sin(turn / 2);
    }
}

/* How far any sinks below where it was put, and goes to the side. */
static void watchStanding(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        const double *from = w->bodies[i].start.position, *at = states[i].position;
        scenes_note(t, 0, fmax(from[1] - at[1], 0));
        scenes_note(t, 1, hypot(at[0] - from[0], at[2] - from[2]));
    }
}

const Scene scenes_columns = {
    .name = "columns-1000",
    .text = "100 columns of 10 cubes of 1 m and 1 kg, up to .05 m and .1 rad askew, mu .5, 10 s: how far any sinks, "
            "largest way of any to the side",
    .count = COLUMN * COLUMNS,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"sink m", .7, 1e-3}, {"side m", .5, 1e-3}},
    .build = buildColumns,
    .observe = watchStanding,
    .measure = scenes_copyWorst,
};

/* Pyramids: rows of cubes a tenth apart, each cube upon two */

static void buildPyramid(const Scene *s, SceneWorld *w) {
    const int rows = (int)s->parameter;
    scenes_setDown(w);
    w->collides = true;
    for (int row = 0; row < rows; row++)
        for (int i = 0; i < rows - row; i++)
            scene_addBox(w, 1, 1, 1, 1, 1.1 * (i + .5 * row), row + .5, 0)->friction = .5;
}

#define PYRAMID(label, boxes, rows, rowsText)                                                                          \
    {                                                                                                                  \
        .name = "pyramid-" label,                                                                                      \
        .text = "a pyramid of " label " cubes of 1 m and 1 kg, " rowsText                                              \
                " in the lowest row, .1 m apart, mu .5, 10 s: how far any sinks, largest way of any to the side",      \
        .parameter = rows, .count = boxes, .heaped = boxes, .isCrowd = true, .hasEdges = true, .duration = 10,         \
        .errors = {{"sink m", .7, 1e-3}, {"side m", .5, 1e-3}}, .build = buildPyramid, .observe = watchStanding,       \
        .measure = scenes_copyWorst,                                                                                   \
    }
const Scene scenes_pyramid210 = PYRAMID("210", 210, 20, "20"), scenes_pyramid820 = PYRAMID("820", 820, 40, "40");

/* A heap of boxes, balls and capsules, the heaviest 64 times as heavy as the lightest */

enum { MIXED = 500, MIXED_LAYER = 7 };

static SceneBody *addMixed(SceneWorld *w, int n, double size, double x, double y, double z) {
    static const double density = 100; /* kg/m³ */
    const double r = size / 2;
    if (n % 3 == 0)
        return scene_addBox(w, density * .48 * size * size * size, size, .8 * size, .6 * size, x, y, z);
    if (n % 3 == 1)
        return scene_addSphere(w, density * 4 / 3 * PI * r * r * r, r, x, y, z);
    return scene_addCapsule(w, density * PI * r * r * (4 * r / 3 + size) / 4, r / 2, 1.5 * size, x, y, z);
}

static void buildMixedHeap(const Scene *s, SceneWorld *w) {
    scenes_setDown(w);
    w->collides = true;
    for (int n = 0; n < s->count; n++) {
        const int x = n % MIXED_LAYER, z = n / MIXED_LAYER % MIXED_LAYER, y = n / MIXED_LAYER / MIXED_LAYER;
        const double angle = .3 + .7 * n, size = .3 * pow(4, .5 + .5 * sin(1.7 * n));
        SceneBody *b = addMixed(w, n, size, 1.5 * (x - MIXED_LAYER / 2) + .1 * (y % 3), 1.2 + 1.5 * y,
                                1.5 * (z - MIXED_LAYER / 2) - .1 * (y % 2));
        b->friction = .5;
        b->start.quaternion[0] = cos(angle / 2);
        b->start.quaternion[1 + n % 3] = sin(angle / 2);
    }
}

static void watchHeap(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    if (isWatched(time))
        scenes_note(t, 0, t->worst[1] = scenes_deepest(w, states));
    t->worst[2] = 0;
    scenes_note(t, 2, fastest(w, states));
}

const Scene scenes_mixedHeap = {
    .name = "heap-mixed",
    .text = "500 boxes, balls and capsules of .3 to 1.2 m, of one density, turned any way, fall on each other, mu .5, "
            "10 s: how deep any two are in each other, at most and at the end, largest speed at the end",
    .count = MIXED,
    .heaped = MIXED,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"worst m", .6, 1e-2}, {"at end m", .6, 1e-3}, {"speed m/s", INFINITY, .1}},
    .build = buildMixedHeap,
    .observe = watchHeap,
    .measure = scenes_copyWorst,
};

/* Dominoes: the first one leans beyond its balance and turns about its lower edge */

enum { DOMINOES = 60, FIRST_TIMED = 20, LAST_TIMED = 50 };
static const double dominoHalf[3] = {.1, .5, .25}, dominoSpacing = .5, firstLean = .25, fallen = .4; /* m, rad */
static const double firstSpin = 3;                                                                   /* rad/s */

/* A point of a domino's plane, from its lower front edge, leans forward. */
static void leanForward(double lean, double x, double y, double out[2]) {
    out[0] = cos(lean) * x + sin(lean) * y;
    out[1] = cos(lean) * y - sin(lean) * x;
}

static void buildDominoes(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < DOMINOES; i++) {
        const double lean = i == 0 ? firstLean : 0, spin = i == 0 ? firstSpin : 0;
        double arm[2];
        leanForward(lean, -dominoHalf[0], dominoHalf[1], arm);
        SceneBody *b = scene_addBox(w, 1, 2 * dominoHalf[0], 2 * dominoHalf[1], 2 * dominoHalf[2],
                                    dominoSpacing * i + dominoHalf[0] + arm[0], arm[1], 0);
        b->friction = .5;
        b->start.quaternion[0] = cos(lean / 2);
        b->start.quaternion[3] = -sin(lean / 2);
        b->start.velocity[0] = spin * arm[1];
        b->start.velocity[1] = -spin * arm[0];
        b->start.spin[2] = -spin;
    }
}

static double leanOf(const SceneState *s) {
    const double up[3] = {0, 1, 0};
    double is[3];
    scene_rotate(s->quaternion, up, is);
    return atan2(hypot(is[0], is[2]), is[1]);
}

/* The time when it passes the angle, between two frames; 0: it does not now. */
static double passes(const SceneTrace *t, const SceneState states[], double time, int i) {
    const double before = leanOf(&t->last[i]), now = leanOf(&states[i]);
    return time > 0 && before < fallen && now >= fallen
               ? t->lastTime + (time - t->lastTime) * (fallen - before) / (now - before)
               : 0;
}

static void watchDominoes(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    if (t->firstEvent <= 0)
        t->firstEvent = passes(t, states, time, FIRST_TIMED);
    if (t->lastEvent <= 0)
        t->lastEvent = passes(t, states, time, LAST_TIMED);
    if (isWatched(time))
        scenes_note(t, 2, scenes_deepest(w, states));
}

/* s, for the wave from the one to the other: 5.268, 5.212, 5.191, 5.177 with 1, 4, 16, 64 sub-steps of the exact solver
 * in double precision, 5.179 with 64 of the fast one, and 5.179 with 64 of Bullet. */
static const double waveTime = 5.18;

static void measureDominoes(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const bool hasPassed = t->firstEvent > 0 && t->lastEvent > 0;
    errors[0] = hasPassed ? fabs((t->lastEvent - t->firstEvent) / waveTime - 1) : INFINITY;
    errors[1] = 0;
    for (int i = 0; i < w->numBodies; i++)
        errors[1] += leanOf(&t->last[i]) < fallen;
    errors[2] = t->worst[2];
}

const Scene scenes_dominoes = {
    .name = "dominoes",
    .text =
        "60 dominoes of .2 x 1 x .5 m, .5 m apart, mu .5, the first one leans by .25 rad and turns with 3 rad/s, 15 s: "
        "relative error of the "
        "time in which the wave goes from the 21st to the 51st (converged: see bench.md), dominoes that stand at the "
        "end, largest overlap",
    .count = DOMINOES,
    .heaped = DOMINOES,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 15,
    .errors = {{"wave", INFINITY, 1e-2}, {"stand", INFINITY, 0}, {"overlap m", .2, 1e-3}},
    .build = buildDominoes,
    .observe = watchDominoes,
    .measure = measureDominoes,
};
