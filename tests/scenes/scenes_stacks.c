/* Scenes of stacks. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

/* Stacks of cubes, of 1 m but where another size is given */

static void addCube(SceneWorld *w, double mass, double y) {
    scene_addBox(w, mass, 1, 1, 1, 0, y, 0)->friction = .5;
}

static void buildHeavyOnLight(const Scene *s, SceneWorld *w) {
    scenes_setDown(w);
    w->collides = true;
    addCube(w, 1, .5);
    addCube(w, s->parameter, 1.5);
}

/* The largest overlap so far, and the one there is now. */
static void watchHeavyOnLight(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)w;
    (void)time;
    const double low = states[0].position[1], high = states[1].position[1];
    const double overlap = fmax(0, fmax(.5 - low, 1 - (high - low)));
    t->worst[0] = overlap;
    scenes_note(t, 1, overlap);
    scenes_note(t, 2, hypot(states[1].position[0], states[1].position[2]));
}

#define HEAVY_ON_LIGHT(label, mass)                                                                                    \
    {                                                                                                                  \
        .name = "heavy-" label,                                                                                        \
        .text = "a cube of " label " kg stands on one of 1 kg, 5 s: overlap at the end, largest one, largest way to "  \
                "the side",                                                                                            \
        .parameter = mass, .duration = 5,                                                                              \
        .errors = {{"at end m", .5, 1e-6}, {"worst m", .5, 1e-6}, {"side m", .5, 1e-9}}, .build = buildHeavyOnLight,   \
        .observe = watchHeavyOnLight, .measure = scenes_copyWorst,                                                     \
    }
const Scene scenes_heavy100 = HEAVY_ON_LIGHT("100", 100), scenes_heavy1e4 = HEAVY_ON_LIGHT("1e4", 1e4),
            scenes_heavy1e6 = HEAVY_ON_LIGHT("1e6", 1e6);

/* Ten cubes of one size: what holds must not depend on metres. */

enum { SIZED_STOREYS = 10 };

/* As dense as water. */
static void buildSizedTower(const Scene *s, SceneWorld *w) {
    const double size = s->parameter, mass = 1000 * size * size * size;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < SIZED_STOREYS; i++)
        scene_addBox(w, mass, size, size, size, 0, (i + .5) * size, 0)->friction = .5;
}

static void watchSizedTower(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double size = 2 * w->bodies[0].half[0];
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        scenes_note(t, 0, (w->bodies[i].start.position[1] - states[i].position[1]) / size);
        scenes_note(t, 1, hypot(states[i].position[0], states[i].position[2]) / size);
    }
}

#define SIZED_TOWER(label, size)                                                                                       \
    {                                                                                                                  \
        .name = "tower-" label "m",                                                                                    \
        .text =                                                                                                        \
            "10 cubes of " label " m, as dense as water, on each other, 30 s: largest sink and largest way to the "    \
            "side, of a cube's size",                                                                                  \
        .parameter = size, .duration = 30, .errors = {{"sink", .7, 1e-3}, {"side", .5, 1e-3}},                         \
        .build = buildSizedTower, .observe = watchSizedTower, .measure = scenes_copyWorst,                             \
    }
const Scene scenes_towerCentimetre = SIZED_TOWER(".01", .01), scenes_towerDecimetre = SIZED_TOWER(".1", .1),
            scenes_towerMetre = SIZED_TOWER("1", 1), scenes_towerTen = SIZED_TOWER("10", 10),
            scenes_towerHundred = SIZED_TOWER("100", 100);

enum { STOREYS = 20 };

static void buildTower(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < STOREYS; i++)
        addCube(w, 1, i + .5);
}

static void watchTower(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < w->numBodies; i++)
        scenes_note(t, 1, hypot(states[i].position[0], states[i].position[2]));
    scenes_note(t, 0, w->bodies[STOREYS - 1].start.position[1] - states[STOREYS - 1].position[1]);
}

const Scene scenes_tower = {
    .name = "tower",
    .text = "20 cubes of 1 kg on each other, 30 s: how far the top one sinks, largest way of any to the side",
    .duration = 30,
    .errors = {{"sink m", .7, 1e-3}, {"side m", .5, 1e-4}},
    .build = buildTower,
    .observe = watchTower,
    .measure = scenes_copyWorst,
};

/* The same tower, put up carelessly */

static const double shakenDriftFrom = 50; /* s */

/* -1 .. 1, the same everywhere: a linear congruential generator. */
static double nextRandom(unsigned *state) {
    *state = (*state * 1664525u + 1013904223u) & 0xffffffffu;
    return (double)(*state >> 8) / (double)(1 << 23) - 1;
}

static void buildShakenTower(const Scene *s, SceneWorld *w) {
    unsigned random = 1;
    double y = .5;
    buildTower(s, w);
    for (int i = 0; i < STOREYS; i++, y++) {
        SceneState *start = &w->bodies[i].start;
        start->position[0] = .08 * nextRandom(&random);
        start->position[2] = .08 * nextRandom(&random);
        start->position[1] = y += .03 + .02 * nextRandom(&random);
        const double yaw = .1 * nextRandom(&random);
        start->quaternion[0] = cos(yaw / 2);
        start->quaternion[2] = sin(yaw / 2);
    }
}

/* It has fallen when the top one has, by more than half a cube. */
static void watchShakenTower(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    t->worst[0] = states[STOREYS - 1].position[1] < STOREYS - 1;
    for (int i = 0; i < w->numBodies; i++) {
        double off[3];
        if (time < shakenDriftFrom - SCENE_FRAME / 2)
            memcpy(t->marked[i], states[i].position, sizeof t->marked[i]);
        for (int c = 0; c < 3; c++)
            off[c] = states[i].position[c] - t->marked[i][c];
        scenes_note(t, 2, sqrt(scene_dot(off, off)));
    }
}

static void measureShakenTower(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    scenes_copyWorst(t, w, errors);
    errors[1] = fabs(STOREYS - .5 - t->last[STOREYS - 1].position[1]);
}

const Scene scenes_longTower = {
    .name = "tower-600s",
    .text = "the shaken tower for 600 s, its way from the 50th second on; not in the list, for the tests alone",
    .duration = 600,
    .errors = {{"falls", .5, 0}, {"sink m", INFINITY, 1e-3}, {"drift m", INFINITY, 1e-4}},
    .build = buildShakenTower,
    .observe = watchShakenTower,
    .measure = measureShakenTower,
};
const Scene scenes_shakenTower = {
    .name = "tower-shaken",
    .text = "20 cubes of 1 kg, up to .08 m and .1 rad askew and 1 to 5 cm above each other, are let go, 60 s: whether "
            "they fall, how far the top one has sunk at the end, largest way of any in the last 10 s",
    .duration = 60,
    .errors = {{"falls", .5, 0}, {"sink m", INFINITY, 1e-3}, {"drift m", INFINITY, 1e-4}},
    .build = buildShakenTower,
    .observe = watchShakenTower,
    .measure = measureShakenTower,
};
