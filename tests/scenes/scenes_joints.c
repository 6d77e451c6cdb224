/* Scenes of joints: pendulums, chains, a top. */
#include "scenes_i.h"
#include "reference.h"

#include <math.h>
#include <stddef.h>

/* Pendulums: released from 90 degrees, 20 periods */

enum { SWINGS = 20 };

/* A ball of 1 kg and the radius 1 cm, 1 m from a ball joint. */
static void buildPendulum(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    scene_addSphere(w, 1, .01, 1, 0, 0);
    scene_joinLast(w, SCENE_BALL_JOINT, 0, 0, 0);
}

/* A box whose principal axes are turned by 30 degrees against the hinge, which goes through the middle of its end. */
static void buildHinge(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    SceneBody *b = scene_addBox(w, 1, 1, .6, .2, .5, 0, 0);
    b->start.quaternion[0] = cos(PI / 12);
    b->start.quaternion[1] = sin(PI / 12);
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
    return reference_pendulumPeriod(PI / 2, sqrt(b->mass * GRAVITY * r / about));
}

/* The mean energy of the periods 0 to 4 and 16 to 20, weighted by 1 - cos, which takes out what goes to and fro. */
static void noteMeanEnergy(SceneTrace *t, double error, double time, double period) {
    for (int span = 0; span < 2; span++) {
        const double part = (time / period - 16 * span) / 4;
        const double weight = part > 0 && part < 1 ? 1 - cos(2 * PI * part) : 0;
        t->sums[span][0] += weight;
        t->sums[span][1] += weight * error;
    }
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
    const double error =
        (scene_energy(w, states) - t->energy) / (w->bodies[0].mass * GRAVITY * w->bodies[0].start.position[0]);
    scenes_note(t, 1, scene_gap(w, states));
    scenes_note(t, 2, error);
    noteMeanEnergy(t, error, time, pendulumPeriod(w));
}

static void measurePendulum(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    const double(*sums)[2] = t->sums;
    errors[0] = t->isDone ? fabs((t->lastEvent - t->firstEvent) / SWINGS / pendulumPeriod(w) - 1) : INFINITY;
    errors[1] = t->worst[1];
    errors[2] = t->isDone ? fabs(sums[1][1] / sums[1][0] - sums[0][1] / sums[0][0]) : INFINITY;
}

const Scene scenes_pendulum = {
    .name = "pendulum",
    .text = "a point-like bob of 1 kg on a ball joint 1 m away, let go at 90 degrees: relative error of 20 periods, "
            "largest gap of the joint, drift of the mean energy / mgl in 16 periods",
    .duration = 60,
    .errors = {{"period", .5, 1e-6}, {"gap m", 1, 1e-9}, {"drift", 1, 1e-9}},
    .build = buildPendulum,
    .observe = watchPendulum,
    .measure = measurePendulum,
};
const Scene scenes_hinge = {
    .name = "hinge",
    .text = "a box of 1 x .6 x .2 m and 1 kg on a hinge askew to its principal axes, let go at 90 degrees: the same",
    .duration = 60,
    .errors = {{"period", .5, 1e-6}, {"gap m", 1, 1e-9}, {"drift", 1, 1e-9}},
    .build = buildHinge,
    .observe = watchPendulum,
    .measure = measurePendulum,
};

/* A heavy symmetric top */

static const double topArm = .1, topTilt = PI / 6, topSpin = 100; /* m, rad, rad/s */

/* A square plate, whose inertia is that of a disc: 30 degrees from upright, it is let go with nothing but its spin. */
static void buildTop(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    const double axis[3] = {sin(topTilt), cos(topTilt), 0};
    SceneBody *b = scene_addBox(w, 1, .2, .02, .2, topArm * axis[0], topArm * axis[1], 0);
    b->start.quaternion[0] = cos(topTilt / 2);
    b->start.quaternion[3] = -sin(topTilt / 2);
    for (int i = 0; i < 3; i++)
        b->start.spin[i] = topSpin * axis[i];
    scene_joinLast(w, SCENE_BALL_JOINT, 0, 0, 0);
}

/* The axis and the angular momentum about the pivot; at the start that is along the axis. */
static void advanceTop(SceneTrace *t, const SceneWorld *w, double time) {
    double inertia[3], *axis = t->reference, *momentum = t->reference + 3;
    scene_inertia(&w->bodies[0], inertia);
    if (time <= 0)
        for (int i = 0; i < 3; i++) {
            axis[i] = w->bodies[0].start.position[i] / topArm;
            momentum[i] = inertia[1] * w->bodies[0].start.spin[i];
        }
    else
        reference_top(t->reference, inertia[0] + w->bodies[0].mass * topArm * topArm,
                      w->bodies[0].mass * GRAVITY * topArm, time - t->lastTime);
}

static void watchTop(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double up[3] = {0, 1, 0}, *should = t->reference;
    double is[3];
    advanceTop(t, w, time);
    scene_rotate(states[0].quaternion, up, is);
    const double across[3] = {is[1] * should[2] - is[2] * should[1], is[2] * should[0] - is[0] * should[2],
                              is[0] * should[1] - is[1] * should[0]};
    scenes_note(t, 0, atan2(sqrt(scene_dot(across, across)), scene_dot(is, should)));
    scenes_note(t, 1, (scene_energy(w, states) - t->energy) / (w->bodies[0].mass * GRAVITY * topArm));
    scenes_note(t, 2, scene_gap(w, states));
}

const Scene scenes_top = {
    .name = "top",
    .text = "a square plate of .2 x .02 x .2 m and 1 kg spins at 100 rad/s, .1 m from a ball joint and leaning by 30 "
            "degrees, 5 s: largest angle between its axis and the right one, largest error of the energy / mgl, "
            "largest gap",
    .duration = 5,
    .errors = {{"axis rad", 4, 1e-4}, {"energy", 10, 1e-6}, {"gap m", 1, 1e-9}},
    .build = buildTop,
    .observe = watchTop,
    .measure = scenes_copyWorst,
};

/* Chains */

enum { LEVEL_LINKS = 10 };
static const double linkLength = .5, ballRadius = .5;

/* The links lean to this side and that by up to .02 rad, so that every transverse mode is awake. */
static void buildHangingChain(const Scene *s, SceneWorld *w) {
    double end[2] = {0, 0};
    scenes_setDown(w);
    for (int i = 0; i < s->count; i++) {
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
    scenes_setDown(w);
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
    scenes_note(t, 0, scene_gap(w, states) / linkLength);
    scenes_note(t, 1, (scene_energy(w, states) - t->energy) / (mass * GRAVITY * height));
}

static void watchHangingChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    watchChain(t, w, states, linkLength);
}

static void watchLevelChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    watchChain(t, w, states, LEVEL_LINKS * linkLength);
}

/* The goal is 1e-5 m. */
#define HANGING_CHAIN(label, links, linksText, mass, massText, time, timeText)                                         \
    {                                                                                                                  \
        .name = "chain-" label,                                                                                        \
        .text = linksText " links of .5 m and 1 kg hang a little askew, with a ball of " massText " kg, " timeText     \
                          " s: largest gap / length of a link, largest error of the energy / (all weights x length "   \
                          "of a link)",                                                                                \
        .parameter = mass, .count = links, .duration = time, .errors = {{"gap", 1, 2e-5}, {"energy", 10, .01}},        \
        .build = buildHangingChain, .observe = watchHangingChain, .measure = scenes_copyWorst,                         \
    }
const Scene scenes_chain10 = HANGING_CHAIN("10", 20, "20", 10, "10", 10, "10"),
            scenes_chain100 = HANGING_CHAIN("100", 20, "20", 100, "100", 10, "10"),
            scenes_chain1000 = HANGING_CHAIN("1000", 20, "20", 1000, "1000", 10, "10"),
            scenes_chain1e5 = HANGING_CHAIN("1e5", 20, "20", 1e5, "1e5", 10, "10"),
            scenes_chain100Links = HANGING_CHAIN("100-links", 100, "100", 1e5, "1e5", 5, "5");

/* The goals are 1e-3 m and 1 %. */
#define LEVEL_CHAIN(label, mass, massText)                                                                             \
    {                                                                                                                  \
        .name = "chain-level" label,                                                                                   \
        .text = "10 level links of .5 m and 1 kg with a ball of " massText " kg are let go, 5 s: largest gap / "       \
                "length of a link, largest error of the energy / (all weights x length of the chain)",                 \
        .parameter = mass, .duration = 5, .errors = {{"gap", 1, 2e-3}, {"energy", 10, .01}}, .build = buildLevelChain, \
        .observe = watchLevelChain, .measure = scenes_copyWorst,                                                       \
    }
const Scene scenes_levelChain = LEVEL_CHAIN("", 100, "100"), scenes_levelChain1000 = LEVEL_CHAIN("-1000", 1000, "1000");
