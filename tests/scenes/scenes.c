/* The scenes: parameters, what is right, and how far from it a simulation is. */
#include "scene.h"
#include "reference.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const double gravity = 9.81, pi = 3.14159265358979323846;

static void setDown(SceneWorld *w) {
    w->gravity[1] = -gravity;
}

/* A larger error replaces the worst one; so does one that is no number. */
static void noteError(SceneTrace *t, int which, double error) {
    if (!(fabs(error) <= t->worst[which]))
        t->worst[which] = fabs(error);
}

static void copyWorst(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    (void)w;
    memcpy(errors, t->worst, sizeof t->worst);
}

/* Pendulums: released from 90 degrees, 20 periods */

enum { SWINGS = 20 };

/* A ball of 1 kg and the radius 1 cm, 1 m from a ball joint. */
static void buildPendulum(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
    scene_addSphere(w, 1, .01, 1, 0, 0);
    scene_joinLast(w, SCENE_BALL_JOINT, 0, 0, 0);
}

/* A box whose principal axes are turned by 30 degrees against the hinge, which goes through the middle of its end. */
static void buildHinge(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, .5, 0, 0);
    b->start.quaternion[0] = cos(pi / 12);
    b->start.quaternion[1] = sin(pi / 12);
    scene_joinLast(w, SCENE_HINGE, 0, 0, 0);
}

/* s; the moment of inertia about the axis n through the joint is n' I n + m r² */
static double pendulumPeriod(const SceneWorld *w) {
    const SceneBody *b = &w->bodies[0];
    const double r = b->start.position[0];
    double inertia[3], axis[3], about = b->mass * r * r;
    scene_inertia(b, inertia);
    scene_rotateBack(b->start.quaternion, w->joints[0].axis, axis);
    for (int i = 0; i < 3; i++)
        about += inertia[i] * axis[i] * axis[i];
    return reference_pendulumPeriod(pi / 2, sqrt(b->mass * gravity * r / about));
}

/* The swing passes the bottom, coming from the side of the start, once a period; there x is linear to second order. */
static void watchPendulum(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double x = states[0].position[0], before = t->last[0].position[0];
    if (time > 0 && before > 0 && x <= 0 && states[0].position[1] < 0) {
        t->lastEvent = t->lastTime + (time - t->lastTime) * before / (before - x);
        if (t->events[0]++ == 0)
            t->firstEvent = t->lastEvent;
        t->isDone = t->events[0] > SWINGS;
    }
    const double scale = w->bodies[0].mass * gravity * w->bodies[0].start.position[0];
    noteError(t, 1, (scene_energy(w, states) - t->energy) / scale);
    noteError(t, 2, scene_gap(w, states));
}

static void measurePendulum(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    copyWorst(t, w, errors);
    errors[0] = t->isDone ? fabs((t->lastEvent - t->firstEvent) / SWINGS / pendulumPeriod(w) - 1) : INFINITY;
}

static const Scene pendulum = {
    .name = "pendulum",
    .text = "a point-like bob of 1 kg on a ball joint 1 m away, let go at 90 degrees: relative error of 20 periods, "
            "largest error of the energy / mgl, largest gap of the joint",
    .duration = 60,
    .errors = {{"period", .5}, {"energy", 1}, {"gap m", 1}},
    .build = buildPendulum,
    .observe = watchPendulum,
    .measure = measurePendulum,
};
static const Scene hinge = {
    .name = "hinge",
    .text = "a box of 1 x .6 x .2 m and 1 kg on a hinge askew to its principal axes, let go at 90 degrees: the same",
    .duration = 60,
    .errors = {{"period", .5}, {"energy", 1}, {"gap m", 1}},
    .build = buildHinge,
    .observe = watchPendulum,
    .measure = measurePendulum,
};

/* Chains */

enum { LINKS = 20, LEVEL_LINKS = 10 };
static const double linkLength = .5, ballRadius = .5;

/* The links lean to this side and that by up to .02 rad, so that every transverse mode is awake. */
static void buildHangingChain(const Scene *s, SceneWorld *w) {
    double end[2] = {0, 0};
    setDown(w);
    for (int i = 0; i < LINKS; i++) {
        const double lean = .02 * sin(2.5 * i + 1), dx = linkLength * sin(lean), dy = -linkLength * cos(lean);
        SceneBody *b = scene_addBox(w, 1, .1, linkLength, .1, end[0] + dx / 2, end[1] + dy / 2, 0);
        b->start.quaternion[0] = cos(lean / 2);
        b->start.quaternion[3] = sin(lean / 2);
        scene_joinLast(w, SCENE_BALL_JOINT, end[0], end[1], 0);
        end[0] += dx;
        end[1] += dy;
    }
    scene_addSphere(w, s->parameter, ballRadius, end[0], end[1] - ballRadius, 0);
    scene_joinLast(w, SCENE_BALL_JOINT, end[0], end[1], 0);
}

static void buildLevelChain(const Scene *s, SceneWorld *w) {
    setDown(w);
    for (int i = 0; i < LEVEL_LINKS; i++) {
        scene_addBox(w, 1, linkLength, .1, .1, (i + .5) * linkLength, 0, 0);
        scene_joinLast(w, SCENE_BALL_JOINT, i * linkLength, 0, 0);
    }
    scene_addSphere(w, s->parameter, ballRadius, LEVEL_LINKS * linkLength + ballRadius, 0, 0);
    scene_joinLast(w, SCENE_BALL_JOINT, LEVEL_LINKS * linkLength, 0, 0);
}

/* Of the energy the scale is all weights times the length of a link, or of the level chain. */
static void watchChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double height) {
    double mass = 0;
    for (int i = 0; i < w->numBodies; i++)
        mass += w->bodies[i].mass;
    noteError(t, 0, scene_gap(w, states) / linkLength);
    noteError(t, 1, (scene_energy(w, states) - t->energy) / (mass * gravity * height));
}

static void watchHangingChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    watchChain(t, w, states, linkLength);
}

static void watchLevelChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    watchChain(t, w, states, LEVEL_LINKS * linkLength);
}

#define HANGING_CHAIN(mass)                                                                                            \
    {                                                                                                                  \
        .name = "chain-" #mass,                                                                                        \
        .text = "20 links of .5 m and 1 kg hang a little askew, with a ball of " #mass " kg, 10 s: largest gap / "     \
                "length of a link, largest error of the energy / (all weights x length of a link)",                    \
        .parameter = mass, .duration = 10, .errors = {{"gap", 1}, {"energy", 10}}, .build = buildHangingChain,         \
        .observe = watchHangingChain, .measure = copyWorst,                                                            \
    }
static const Scene chain10 = HANGING_CHAIN(10), chain100 = HANGING_CHAIN(100), chain1000 = HANGING_CHAIN(1000);
static const Scene levelChain = {
    .name = "chain-level",
    .text = "10 level links of .5 m and 1 kg with a ball of 100 kg are let go, 5 s: largest gap / length of a link, "
            "largest error of the energy / (all weights x length of the chain)",
    .parameter = 100,
    .duration = 5,
    .errors = {{"gap", 1}, {"energy", 10}},
    .build = buildLevelChain,
    .observe = watchLevelChain,
    .measure = copyWorst,
};

/* Free bodies */

static void buildTumbling(const Scene *s, SceneWorld *w) {
    (void)s;
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, 0, 0, 0);
    b->start.spin[0] = .01;
    b->start.spin[1] = 5;
}

static void watchTumbling(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    double now[3], before[3];
    scene_rotateBack(states[0].quaternion, states[0].spin, now);
    scene_rotateBack(t->last[0].quaternion, t->last[0].spin, before);
    if (time > 0 && now[1] * before[1] < 0 && t->events[0]++ == 0)
        t->firstEvent = t->lastTime + (time - t->lastTime) * before[1] / (before[1] - now[1]);
    noteError(t, 0, scene_energy(w, states) / t->energy - 1);
}

static void measureTumbling(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    double inertia[3];
    scene_inertia(&w->bodies[0], inertia);
    const ReferenceTumbling r = reference_tumbling(inertia, w->bodies[0].start.spin, t->lastTime);
    errors[0] = t->worst[0];
    errors[1] = t->events[0] ? fabs(t->firstEvent - r.firstFlip) : INFINITY;
    errors[2] = abs(t->events[0] - r.flips);
}

static const Scene tumbling = {
    .name = "tumbling",
    .text = "a box of 1 x .6 x .2 m turns about its middle axis at 5 rad/s, without gravity, 60 s: largest relative "
            "error of the energy, error of the time of the first flip (2.4543 s), flips too many or too few (of 12)",
    .duration = 60,
    .errors = {{"energy", 10}, {"flip s", INFINITY}, {"flips", INFINITY}},
    .build = buildTumbling,
    .observe = watchTumbling,
    .measure = measureTumbling,
};

static void buildProjectile(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, 0, 0, 0);
    b->start.velocity[0] = 20;
    b->start.velocity[1] = 20;
    b->start.spin[2] = 3;
}

static void watchProjectile(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double *v = w->bodies[0].start.velocity, *x = states[0].position;
    const double off[3] = {x[0] - v[0] * time, x[1] - v[1] * time + gravity * time * time / 2, x[2]};
    noteError(t, 0, sqrt(scene_dot(off, off)));
    noteError(t, 1, (scene_energy(w, states) - t->energy) / t->energy);
}

static const Scene projectile = {
    .name = "projectile",
    .text = "a spinning box is thrown at 45 degrees and 28 m/s, 5 s: largest distance from the parabola, largest "
            "relative error of the energy",
    .duration = 5,
    .errors = {{"off m", 10}, {"energy", 10}},
    .build = buildProjectile,
    .observe = watchProjectile,
    .measure = copyWorst,
};

/* Stacks of cubes of 1 m */

static void addCube(SceneWorld *w, double mass, double y) {
    scene_addBox(w, mass, 1, 1, 1, 0, y, 0)->friction = .5;
}

static void buildHeavyOnLight(const Scene *s, SceneWorld *w) {
    setDown(w);
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
    noteError(t, 1, overlap);
    noteError(t, 2, hypot(states[1].position[0], states[1].position[2]));
}

#define HEAVY_ON_LIGHT(label, mass)                                                                                    \
    {                                                                                                                  \
        .name = "heavy-" label,                                                                                        \
        .text = "a cube of " label " kg stands on one of 1 kg, 5 s: overlap at the end, largest one, largest way to "  \
                "the side",                                                                                            \
        .parameter = mass, .duration = 5, .errors = {{"at end m", .5}, {"worst m", .5}, {"side m", .5}},               \
        .build = buildHeavyOnLight, .observe = watchHeavyOnLight, .measure = copyWorst,                                \
    }
static const Scene heavy100 = HEAVY_ON_LIGHT("100", 100), heavy1e4 = HEAVY_ON_LIGHT("1e4", 1e4),
                   heavy1e6 = HEAVY_ON_LIGHT("1e6", 1e6);

enum { STOREYS = 20 };

static void buildTower(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
    w->collides = true;
    for (int i = 0; i < STOREYS; i++)
        addCube(w, 1, i + .5);
}

static void watchTower(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < w->numBodies; i++)
        noteError(t, 1, hypot(states[i].position[0], states[i].position[2]));
    noteError(t, 0, w->bodies[STOREYS - 1].start.position[1] - states[STOREYS - 1].position[1]);
}

static const Scene tower = {
    .name = "tower",
    .text = "20 cubes of 1 kg on each other, 30 s: how far the top one sinks, largest way of any to the side",
    .duration = 30,
    .errors = {{"sink m", .7}, {"side m", .5}},
    .build = buildTower,
    .observe = watchTower,
    .measure = copyWorst,
};

/* Friction */

static const double frictions[] = {.3, .4, .45, .5, .55, .6};
enum { SLIDERS = sizeof frictions / sizeof *frictions };

/* The slope of atan(.5) is the ground, and gravity leans. */
static void buildIncline(const Scene *s, SceneWorld *w) {
    (void)s;
    w->gravity[0] = gravity * sin(atan(.5));
    w->gravity[1] = -gravity * cos(atan(.5));
    w->collides = true;
    for (int i = 0; i < SLIDERS; i++)
        scene_addBox(w, 1, 1, 1, 1, 0, .5, 3 * i)->friction = frictions[i];
}

static void watchIncline(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    for (int i = 0; i < SLIDERS; i++) {
        const double way = reference_slide(w->gravity[0], -w->gravity[1], frictions[i], time);
        const int which = frictions[i] < .5 ? 0 : frictions[i] > .5 ? 1 : 2;
        noteError(t, which, states[i].position[0] - way);
    }
}

static const Scene incline = {
    .name = "incline",
    .text = "cubes of 1 m on a slope of atan(.5), 2 s: largest error of the slide where mu is .3, .4, .45 (3.510, "
            "1.755, .877 m), slip where it is .55, .6, and where it is .5",
    .duration = 2,
    .errors = {{"slide m", 1}, {"slip m", 1}, {"at .5 m", 1}},
    .build = buildIncline,
    .observe = watchIncline,
    .measure = copyWorst,
};

static void buildRolling(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
    w->collides = true;
    SceneBody *b = scene_addSphere(w, 1, .5, 0, .5, 0);
    b->friction = .3;
    b->start.velocity[0] = 10;
}

static void watchRolling(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const SceneBody *b = &w->bodies[0];
    const double speed = b->start.velocity[0], way = reference_rollingDistance(speed, b->friction, gravity, time);
    t->worst[0] = fabs(states[0].velocity[0] / reference_rollingSpeed(speed) - 1);
    t->worst[1] = time > 0 ? fabs(states[0].position[0] / way - 1) : 0;
    noteError(t, 2, states[0].position[1] - b->half[1]);
}

static const Scene rolling = {
    .name = "rolling",
    .text = "a ball of .5 m is put down with 10 m/s, mu .3, slips, and rolls, 2 s: relative errors of speed (7.142857) "
            "and way (15.672610) at the end, largest error of the height",
    .duration = 2,
    .errors = {{"speed", .5}, {"way", .5}, {"height m", .5}},
    .build = buildRolling,
    .observe = watchRolling,
    .measure = copyWorst,
};

/* Bounces */

static const double dropHeight = 5;

static void buildBounce(const Scene *s, SceneWorld *w) {
    (void)s;
    setDown(w);
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
            noteError(t, 0, top / dropHeight - 1);
    }
}

static void measureBounce(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const double e = w->bodies[1].restitution;
    errors[0] = t->events[0] ? t->worst[0] : INFINITY;
    for (int k = 0; k < 2; k++)
        errors[1 + k] =
            t->events[1] > k ? fabs(t->top[1][k] / (dropHeight * (k ? e * e * e * e : e * e)) - 1) : INFINITY;
}

static const Scene bounce = {
    .name = "bounce",
    .text = "balls of .1 m fall from 5 m, 20 s: largest relative error of a top with e = 1 (5 m), of the first and the "
            "second top with e = .5 (1.25, .3125 m)",
    .duration = 20,
    .bounces = true,
    .errors = {{"e=1", 1}, {"e=.5", 1}, {"second", INFINITY}},
    .build = buildBounce,
    .observe = watchBounce,
    .measure = measureBounce,
};

const Scene *const scenes[] = {
    &pendulum, &hinge,    &chain10,  &chain100, &chain1000, &levelChain, &tumbling, &projectile,
    &heavy100, &heavy1e4, &heavy1e6, &tower,    &incline,   &rolling,    &bounce,   NULL,
};
