/* Scenes of friction: cubes that stick and slide, balls that roll, a block that topples. */
#include "scenes_i.h"
#include "reference.h"

#include <math.h>

/* Friction */

static const double frictions[] = {.3, .4, .45, .5, .55, .6};
enum { SLIDERS = sizeof frictions / sizeof *frictions };

/* Cubes on a slope: it is the ground, and gravity leans by atan(.5). */
static void buildIncline(const Scene *s, SceneWorld *w) {
    (void)s;
    w->gravity[0] = GRAVITY * sin(atan(.5));
    w->gravity[1] = -GRAVITY * cos(atan(.5));
    w->collides = true;
    for (int i = 0; i < SLIDERS; i++)
        scene_addBox(w, 1, 1, 1, 1, 0, .5, 3 * i)->friction = frictions[i];
}

static void watchIncline(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    for (int i = 0; i < SLIDERS; i++) {
        const double way = reference_slide(w->gravity[0], -w->gravity[1], frictions[i], time);
        const int which = frictions[i] < .5 ? 0 : frictions[i] > .5 ? 1 : 2;
        scenes_note(t, which, states[i].position[0] - way);
    }
}

const Scene scenes_incline = {
    .name = "incline",
    .text = "cubes of 1 m on a slope of atan(.5), 2 s: largest error of the slide where mu is .3, .4, .45 (3.510, "
            "1.755, .877 m), slip where it is .55, .6, and where it is .5",
    .duration = 2,
    .errors = {{"slide m", 1, 1e-5}, {"slip m", 1, 1e-9}, {"at .5 m", 1, 1e-9}},
    .build = buildIncline,
    .observe = watchIncline,
    .measure = scenes_copyWorst,
};

/* The same cubes on the flat, pushed at their centres: the pairs differ in direction, their members in force */

enum { DIRECTIONS = 24 };
static const double isotropyFriction = .5, pushes[2] = {.49, .51}; /* the latter in weights */

static void direct(int body, double direction[3]) {
    const double angle = 2 * PI / DIRECTIONS * (body / 2);
    direction[0] = cos(angle);
    direction[1] = 0;
    direction[2] = sin(angle);
}

static void buildIsotropy(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < 2 * DIRECTIONS; i++) {
        SceneBody *b = scene_addBox(w, 1, 1, 1, 1, 4 * (i / 8), .5, 4 * (i % 8));
        b->friction = isotropyFriction;
        direct(i, b->force);
        for (int c = 0; c < 3; c++)
            b->force[c] *= pushes[i % 2] * b->mass * GRAVITY;
    }
}

/* Relative error of a vector that should be `size` times the direction. */
static double vectorError(const double is[3], const double direction[3], double size) {
    double off[3];
    for (int c = 0; c < 3; c++)
        off[c] = is[c] - size * direction[c];
    return sqrt(scene_dot(off, off)) / size;
}

static void watchIsotropy(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    t->worst[1] = t->worst[2] = 0;
    for (int i = 0; i < w->numBodies; i++) {
        const double *from = w->bodies[i].start.position, *at = states[i].position;
        const double moved[3] = {at[0] - from[0], at[1] - from[1], at[2] - from[2]};
        const double speed = (pushes[i % 2] - isotropyFriction) * GRAVITY * time;
        double direction[3];
        direct(i, direction);
        if (speed <= 0)
            scenes_note(t, 0, i % 2 ? 0 : sqrt(scene_dot(moved, moved)));
        else {
            scenes_note(t, 1, vectorError(states[i].velocity, direction, speed));
            scenes_note(t, 2, vectorError(moved, direction, speed * time / 2));
        }
    }
}

const Scene scenes_isotropy = {
    .name = "isotropy",
    .text = "cubes of 1 m on the flat, mu .5, pushed with .49 and .51 of their weight at 0, 15, 30, ... degrees, 2 s: "
            "largest creep with .49, largest relative error of speed and way at the end with .51",
    .duration = 2,
    .errors = {{"creep m", .5, 1e-9}, {"speed", INFINITY, 1e-3}, {"way", INFINITY, 1e-3}},
    .build = buildIsotropy,
    .observe = watchIsotropy,
    .measure = scenes_copyWorst,
};

/* Balls that slip, then roll */

static void addSlippingBall(SceneWorld *w, double radius, double speed, double spin) {
    scenes_setDown(w);
    w->collides = true;
    SceneBody *b = scene_addSphere(w, 1, radius, 0, radius, 0);
    b->friction = .3;
    b->start.velocity[0] = speed;
    b->start.spin[2] = -spin;
}

static void buildRolling(const Scene *s, SceneWorld *w) {
    (void)s;
    addSlippingBall(w, .5, 10, 0);
}

static void buildBackspin(const Scene *s, SceneWorld *w) {
    (void)s;
    addSlippingBall(w, .1, 10, -200);
}

static void watchRolling(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 2, states[0].position[1] - w->bodies[0].half[1]);
}

static void measureRolling(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const SceneBody *b = &w->bodies[0];
    const double speed = b->start.velocity[0], surface = -b->start.spin[2] * b->half[0];
    const double way = reference_rollingDistance(speed, surface, b->friction, GRAVITY, t->lastTime);
    errors[0] = fabs(t->last[0].velocity[0] / reference_rollingSpeed(speed, surface) - 1);
    errors[1] = fabs(t->last[0].position[0] / way - 1);
    errors[2] = t->worst[2];
}

const Scene scenes_rolling = {
    .name = "rolling",
    .text = "a ball of .5 m is put down with 10 m/s, mu .3, slips, and rolls, 2 s: relative errors of speed (7.142857) "
            "and way (15.672610) at the end, largest error of the height",
    .duration = 2,
    .errors = {{"speed", INFINITY, 1e-9}, {"way", INFINITY, 1e-6}, {"height m", .5, 1e-9}},
    .build = buildRolling,
    .observe = watchRolling,
    .measure = measureRolling,
};
const Scene scenes_backspin = {
    .name = "backspin",
    .text = "a ball of .1 m is put down with 10 m/s and 200 rad/s backwards, mu .3, 4 s: the same (1.428571 m/s, "
            "18.196343 m)",
    .duration = 4,
    .errors = {{"speed", INFINITY, 1e-9}, {"way", INFINITY, 1e-6}, {"height m", .5, 1e-9}},
    .build = buildBackspin,
    .observe = watchRolling,
    .measure = measureRolling,
};

/* Two blocks twice as high as wide, 3 m/s: one stops, the other trips over its edge */

static void buildBlock(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < 2; i++) {
        SceneBody *b = scene_addBox(w, 1, .5, 1, .5, 0, .5, 5 * i);
        b->friction = i ? .55 : .45;
        b->start.velocity[0] = 3;
    }
}

static double tilt(const SceneState *s) {
    const double up[3] = {0, 1, 0};
    double is[3];
    scene_rotate(s->quaternion, up, is);
    return atan2(hypot(is[0], is[2]), is[1]);
}

/* Past 27 degrees there is no way back. */
static void watchBlock(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)w;
    (void)time;
    scenes_note(t, 1, tilt(&states[0]));
    t->events[1] |= tilt(&states[1]) > PI / 4;
}

static void measureBlock(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const SceneBody *b = &w->bodies[0];
    const double way = reference_stop(b->start.velocity[0], b->friction, GRAVITY);
    errors[0] = fabs(t->last[0].position[0] - way);
    errors[1] = t->worst[1];
    errors[2] = !t->events[1];
}

const Scene scenes_block = {
    .name = "block",
    .text = "blocks of .5 x 1 x .5 m slide with 3 m/s, 3 s: error of the way of the one with mu .45 (1.019368 m), its "
            "largest tilt, and 0 if the one with mu .55 topples (exactly it does from .52 on), else 1",
    .duration = 3,
    .errors = {{"way m", INFINITY, 1e-5}, {"tilt rad", INFINITY, 1e-9}, {"stands", INFINITY, 0}},
    .build = buildBlock,
    .observe = watchBlock,
    .measure = measureBlock,
};
