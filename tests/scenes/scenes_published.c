/* Scenes of published benchmarks, with their parameters and their measures of error.
 *
 * SimBenchmark (D. Kang and J. Hwangbo 2018, leggedrobotics/SimBenchmark): masses, sizes, times and frames of .01 s are
 * the published ones. Erez, Tassa and Todorov 2015 ("Simulation tools for model-based robotics") have four kinds of
 * systems, of hinges, balls and capsules; their models are not published, so only kinds and numbers are theirs here.
 * What differs is told in docs/bench.md. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

static const double simFrame = .01, simGravity = 9.81; /* s, m/s² */

static void addTo(double to[3], const double from[3], double factor) {
    for (int i = 0; i < 3; i++)
        to[i] += factor * from[i];
}

/* -1 .. 1, the same everywhere: a linear congruential generator. */
static double nextRandom(unsigned *state) {
    *state = (*state * 1664525u + 1013904223u) & 0xffffffffu;
    return (double)(*state >> 8) / (double)(1 << 23) - 1;
}

/* The mean over all frames of what is summed there. */
static void noteMean(SceneTrace *t, double value) {
    t->sums[0][0] += 1;
    t->sums[0][1] += value;
}

static double meanOf(const SceneTrace *t) {
    return t->sums[0][0] > 0 ? t->sums[0][1] / t->sums[0][0] : INFINITY;
}

static void measureMean(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    scenes_copyWorst(t, w, errors);
    errors[0] = meanOf(t);
}

/* Rolling: 150 N push a flat box of 10 kg, with 25 balls of 1 kg on it, over the ground; they roll without slipping */

enum { BALLS = 25 };
static const double boxMass = 10, boxPush = 150, boxFriction = .4, ballFriction = .8; /* kg, N */

static void buildRolling(const Scene *s, SceneWorld *w) {
    const double angle = s->parameter;
    scenes_setDown(w);
    w->collides = true;
    SceneBody *box = scene_addBox(w, boxMass, 20, 1, 20, 0, .5, 0);
    box->friction = boxFriction;
    box->force[0] = boxPush * cos(angle);
    box->force[2] = boxPush * sin(angle);
    for (int i = 0; i < BALLS; i++)
        scene_addSphere(w, 1, .5, 2 * (i % 5) - 4, 1.5, 2 * (i / 5) - 4)->friction = ballFriction;
}

/* A ball is moved by 2/7 of what moves the box. Friction at the ground is at its bound. */
static double boxAcceleration(void) {
    return (boxPush - boxFriction * (boxMass + BALLS) * simGravity) / (boxMass + BALLS * 2. / 7);
}

/* Squares of errors of the velocities of the box and of one ball, m²/s². */
static void watchRolling(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double speed = boxAcceleration() * time, *push = w->bodies[0].force;
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        double off[3] = {states[i].velocity[0], states[i].velocity[1], states[i].velocity[2]};
        addTo(off, push, -speed * (i == 0 ? 1 : 2. / 7) / boxPush);
        sum += scene_dot(off, off);
    }
    noteMean(t, sum);
    scenes_note(t, 1, fmax(scenes_below(&w->bodies[0], &states[0]), 0));
}

#define SIM_ROLLING(label, direction, directionText)                                                                   \
    {                                                                                                                  \
        .name = "sim-rolling-" label,                                                                                  \
        .text = "SimBenchmark: a box of 20 x 1 x 20 m and 10 kg, mu .4, is pushed " directionText                      \
                " with 150 N, 25 balls of 1 kg, mu .8, roll on it, 4 s: mean square error of the velocities of box "   \
                "and ball (as published), overlap with the ground",                                                    \
        .parameter = direction, .frame = .01, .hasEdges = true, .duration = 4,                                         \
        .errors = {{"v2 m2/s2", 100, 1e-12}, {"overlap m", .5, 1e-6}}, .build = buildRolling, .observe = watchRolling, \
        .measure = measureMean,                                                                                        \
    }
const Scene scenes_rollingXY = SIM_ROLLING("xy", PI / 4, "along the diagonal"),
            scenes_rollingY = SIM_ROLLING("y", PI / 2, "along an axis");

/* Bouncing: 49 balls fall from 5 m, elastic, without friction */

static void buildBouncing(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < 49; i++)
        scene_addSphere(w, 10, .1, 2 * (i % 7), 5, 2 * (i / 7))->restitution = 1;
}

static void watchEnergy(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double off = scene_energy(w, states) - t->energy;
    (void)time;
    noteMean(t, off * off);
    scenes_note(t, 1, off / t->energy);
}

const Scene scenes_bouncing49 = {
    .name = "sim-bouncing",
    .text = "SimBenchmark: 49 balls of .1 m and 10 kg fall from 5 m, e = 1, 20 s: mean square error of the energy (as "
            "published), largest relative error",
    .frame = .01,
    .bounces = true,
    .hasEdges = true,
    .duration = 20,
    .errors = {{"E2 J2", INFINITY, 1e-6}, {"energy", 100, 1e-6}},
    .build = buildBouncing,
    .observe = watchEnergy,
    .measure = measureMean,
};

/* 666: a cube of 6 x 6 x 6 balls, a little askew, falls without friction */

enum { SIDE = 6 };

static void build666(const Scene *s, SceneWorld *w) {
    static const double spacing = .21, askew = .001; /* m */
    unsigned random = 42;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        double at[3] = {spacing * (i % SIDE), s->parameter + spacing * (i / SIDE / SIDE), spacing * (i / SIDE % SIDE)};
        for (int c = 0; c < 3; c++)
            at[c] += askew * (.5 + .5 * nextRandom(&random));
        scene_addSphere(w, 10, .1, at[0], at[1], at[2])->restitution = s->bounces;
    }
}

/* The sum of the squares of all overlaps, m². */
static void watch666(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    double sum = 0, deep = 0;
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        const double below = scenes_below(&w->bodies[i], &states[i]);
        deep = fmax(deep, below);
        sum += below > 0 ? below * below : 0;
        for (int j = 0; j < i; j++) {
            const double over = scenes_overlap(&w->bodies[i], &states[i], &w->bodies[j], &states[j]);
            deep = fmax(deep, over);
            sum += over > 0 ? over * over : 0;
        }
    }
    noteMean(t, sum);
    scenes_note(t, 1, deep);
}

const Scene scenes_666 = {
    .name = "sim-666",
    .text = "SimBenchmark: 6 x 6 x 6 balls of .1 m and 10 kg, .21 m apart, up to 1 mm askew, fall, e = 0, no friction, "
            "10 s: mean of the sum of the squares of all overlaps (as published), deepest overlap",
    .parameter = .101,
    .frame = .01,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"pen2 m2", 100, 1e-8}, {"deepest m", .2, 1e-4}},
    .build = build666,
    .observe = watch666,
    .measure = measureMean,
};
const Scene scenes_elastic666 = {
    .name = "sim-666-elastic",
    .text =
        "SimBenchmark: the same from 1.1 m, e = 1: mean square error of the energy (as published), largest relative "
        "error",
    .parameter = 1.101,
    .frame = .01,
    .bounces = true,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"E2 J2", INFINITY, 1e-2}, {"energy", 100, 1e-3}},
    .build = build666,
    .observe = watchEnergy,
    .measure = measureMean,
};

/* The articulated systems: a quadruped robot with three hinges a leg. Its axes are x forward, y left, z up. */

enum { QUADRUPED = 13 };
static const double bodyMass = 21.39, hipMass = 1.1064, thighMass = 1.51, shankMass = .318, footMass = .1922685;

typedef struct Frame {
    double origin[3], q[4]; /* m, and to the world */
} Frame;

static void place(const Frame *f, const double local[3], double out[3]) {
    double turned[3];
    scene_rotate(f->q, local, turned);
    for (int i = 0; i < 3; i++)
        out[i] = f->origin[i] + turned[i];
}

/* Moves a frame to a point of itself and turns it about its own axis. */
static void moveFrame(Frame *f, const double to[3], int axis, double angle) {
    const double c = cos(angle / 2), s = sin(angle / 2);
    double turn[4] = {c, 0, 0, 0}, q[4];
    memcpy(q, f->q, sizeof q);
    place(f, to, f->origin);
    turn[axis + 1] = s;
    f->q[0] = q[0] * turn[0] - q[1] * turn[1] - q[2] * turn[2] - q[3] * turn[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        f->q[i + 1] = q[0] * turn[i + 1] + q[i + 1] * turn[0] + q[j + 1] * turn[k + 1] - q[k + 1] * turn[j + 1];
    }
}

/* A link of a leg, on a hinge at the frame's origin. Its box is what collides; the inertia is the published one
 * without its products, which are less than 2 % of the moments but for the thigh's (13 % of the least). */
static int addLink(SceneWorld *w, const Frame *f, int parent, int axis, double mass, const double centre[3],
                   const double inertia[3], const double half[3]) {
    double at[3], unit[3] = {0, 0, 0};
    unit[axis] = 1;
    place(f, centre, at);
    SceneBody *b = scene_addBox(w, mass, 2 * half[0], 2 * half[1], 2 * half[2], at[0], at[1], at[2]);
    memcpy(b->inertia, inertia, sizeof b->inertia);
    memcpy(b->start.quaternion, f->q, sizeof f->q);
    SceneJoint *j = scene_join(w, SCENE_HINGE, w->numBodies - 1, parent, f->origin[0], f->origin[1], f->origin[2]);
    scene_rotate(f->q, unit, j->axis);
    return w->numBodies - 1;
}

/* Shank and foot are one body: its centre, and by the theorem of parallel axes its moments of inertia. */
static void joinFoot(double front, double left, double centre[3], double inertia[3]) {
    const double shank[3] = {.016355414056 * front, -.00562219106 * left, -.064350437219};
    const double foot[3] = {0, -.016 * left, -.31 - .021388647779};
    const double shankInertia[3] = {.0037693717909, .00400446467635, .000418471691904};
    const double footInertia[3] = {8.3086410294e-05, 8.2860209667e-05, 8.1948124086e-05};
    double d[2][3];
    for (int i = 0; i < 3; i++)
        centre[i] = (shankMass * shank[i] + footMass * foot[i]) / (shankMass + footMass);
    for (int i = 0; i < 3; i++) {
        d[0][i] = shank[i] - centre[i];
        d[1][i] = foot[i] - centre[i];
    }
    for (int i = 0; i < 3; i++)
        inertia[i] = shankInertia[i] + footInertia[i] + shankMass * (scene_dot(d[0], d[0]) - d[0][i] * d[0][i]) +
                     footMass * (scene_dot(d[1], d[1]) - d[1][i] * d[1][i]);
}

static void addLeg(SceneWorld *w, int base, const Frame *body, double front, double left) {
    const double hipJoint[3] = {.2629 * front, .115 * left, 0}, hip[3] = {.0542 * front, -.0136 * left, 0};
    const double thighJoint[3] = {.0585 * front, .0315 * left, 0}, thigh[3] = {.0008 * front, .0545 * left, -.1975};
    const double kneeJoint[3] = {0, .111 * left, -.25};
    const double hipInertia[3] = {.00123301508523, .000993231183395, .00142160349098};
    const double thighInertia[3] = {.0147571628275, .0144188925719, .00178449075964};
    const double hipHalf[3] = {.04, .04, .04}, thighHalf[3] = {.03, .03, .12}, shankHalf[3] = {.015, .015, .15};
    double shank[3], shankInertia[3];
    Frame f = *body;
    joinFoot(front, left, shank, shankInertia);
    moveFrame(&f, hipJoint, 0, .03 * left);
    int last = addLink(w, &f, base, 0, hipMass, hip, hipInertia, hipHalf);
    moveFrame(&f, thighJoint, 1, .4 * front);
    last = addLink(w, &f, last, 1, thighMass, thigh, thighInertia, thighHalf);
    moveFrame(&f, kneeJoint, 1, -.8 * front);
    addLink(w, &f, last, 1, shankMass + footMass, shank, shankInertia, shankHalf);
}

/* Its z is up, the world's y is. */
static SceneBody *addQuadruped(SceneWorld *w, double height) {
    const double inertia[3] = {.268388530624, .884235660795, .829158678306};
    const Frame body = {{0, height, 0}, {cos(PI / 4), -sin(PI / 4), 0, 0}};
    const int base = w->numBodies;
    SceneBody *b = scene_addBox(w, bodyMass, .531, .232, .26, 0, height, 0);
    memcpy(b->inertia, inertia, sizeof b->inertia);
    memcpy(b->start.quaternion, body.q, sizeof body.q);
    for (int leg = 0; leg < 4; leg++)
        addLeg(w, base, &body, leg & 1 ? -1 : 1, leg & 2 ? -1 : 1);
    return b;
}

/* A ball hits it from the side, without gravity. */
static void buildMomentum(const Scene *s, SceneWorld *w) {
    (void)s;
    w->collides = true;
    addQuadruped(w, 2);
    scene_addSphere(w, 10, .2, 0, 2, 5)->start.velocity[2] = -5;
}

static void watchMomentum(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    double off[3] = {0, 0, 0};
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        addTo(off, states[i].velocity, w->bodies[i].mass);
        addTo(off, w->bodies[i].start.velocity, -w->bodies[i].mass);
    }
    noteMean(t, scene_dot(off, off));
    scenes_note(t, 1, scene_gap(w, states));
    t->events[0] = states[QUADRUPED].velocity[2] < -4.99; /* the ball has not been stopped */
}

static void measureMomentum(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    scenes_measureCounted(t, w, errors);
    errors[0] = meanOf(t);
}

const Scene scenes_quadrupedMomentum = {
    .name = "sim-momentum",
    .text = "SimBenchmark: without gravity a ball of 10 kg hits a quadruped robot of 33.9 kg with 5 m/s, e = 0, 10 s: "
            "mean square error of the momentum (as published), largest gap of a joint, 0 if the ball hits it, else 1",
    .frame = .01,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"p2 N2s2", 1e6, 1e-12}, {"gap m", .5, 1e-6}, {"misses", INFINITY, 0}},
    .build = buildMomentum,
    .observe = watchMomentum,
    .measure = measureMomentum,
};

/* It is lifted for a second, by twice its weight, and then left alone. Nothing collides. */
static const double lifted = 1; /* s */

static void buildEnergy(const Scene *s, SceneWorld *w) {
    double mass = 0;
    (void)s;
    scenes_setDown(w);
    SceneBody *base = addQuadruped(w, 2);
    for (int i = 0; i < w->numBodies; i++)
        mass += w->bodies[i].mass;
    base->force[1] = 2 * mass * simGravity;
    base->forceEnds = lifted;
}

static void watchQuadrupedEnergy(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double energy = scene_energy(w, states);
    scenes_note(t, 1, scene_gap(w, states));
    if (time < lifted + simFrame / 2)
        t->reference[0] = energy;
    else
        noteMean(t, (energy - t->reference[0]) * (energy - t->reference[0]));
}

const Scene scenes_quadrupedEnergy = {
    .name = "sim-energy",
    .text = "SimBenchmark: the quadruped is lifted with twice its weight for 1 s, then left alone for 2 s: mean square "
            "error of the energy after 1 s (as published), largest gap of a joint",
    .frame = .01,
    .duration = 3,
    .errors = {{"E2 J2", INFINITY, 1e-4}, {"gap m", .5, 1e-6}},
    .build = buildEnergy,
    .observe = watchQuadrupedEnergy,
    .measure = measureMean,
};

/* Erez, Tassa, Todorov */

/* Planar chain: five capsules on hinges, let go level. */
enum { CHAIN = 5 };

static void buildPlanarChain(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    for (int i = 0; i < CHAIN; i++) {
        SceneBody *b = scene_addCapsule(w, 1, .05, .5, .5 * i + .25, 3, 0);
        b->start.quaternion[0] = cos(PI / 4);
        b->start.quaternion[2] = sin(PI / 4);
        scene_joinLast(w, SCENE_HINGE, .5 * i, 3, 0);
    }
}

static void watchPlanarChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, (scene_energy(w, states) - t->energy) / (CHAIN * GRAVITY * CHAIN * .5));
    scenes_note(t, 1, scene_gap(w, states));
    for (int i = 0; i < w->numBodies; i++)
        scenes_note(t, 2, states[i].position[2]);
}

const Scene scenes_planarChain = {
    .name = "erez-chain",
    .text =
        "after Erez, Tassa, Todorov: five capsules of .5 m and 1 kg on hinges are let go level, 5 s: largest error of "
        "the energy / (weight x length of the chain), largest gap, largest way out of the plane",
    .duration = 5,
    .errors = {{"energy", 10, 1e-3}, {"gap m", .3, 1e-6}, {"plane m", .3, 1e-6}},
    .build = buildPlanarChain,
    .observe = watchPlanarChain,
    .measure = scenes_copyWorst,
};

/* 27 capsules fall on each other. */
static void buildCapsules(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < 27; i++) {
        SceneBody *b = scene_addCapsule(w, 1, .1, .6, .7 * (i % 3) + .05 * (i / 9), .5 + .7 * (i / 9),
                                        .7 * (i / 3 % 3) - .05 * (i / 9));
        const double angle = .2 + .9 * i;
        b->friction = .5;
        b->start.quaternion[0] = cos(angle / 2);
        b->start.quaternion[1 + i % 2] = sin(angle / 2);
    }
}

static void watchCapsules(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, t->worst[1] = scenes_deepest(w, states));
    t->worst[2] = 0;
    for (int i = 0; i < w->numBodies; i++)
        scenes_note(t, 2, sqrt(scene_dot(states[i].velocity, states[i].velocity)));
}

const Scene scenes_capsules = {
    .name = "erez-capsules",
    .text =
        "after Erez, Tassa, Todorov: 27 capsules of .1 x .6 m and 1 kg fall on each other, mu .5, 10 s: how deep any "
        "two are in each other, at most and at the end, largest speed at the end",
    .hasEdges = true,
    .duration = 10,
    .errors = {{"worst m", .2, 1e-2}, {"at end m", .2, 1e-4}, {"speed m/s", INFINITY, .1}},
    .build = buildCapsules,
    .observe = watchCapsules,
    .measure = scenes_copyWorst,
};

/* A humanoid of hinges, which falls: two at each hip, shoulder and the waist, one at neck, knees, ankles, elbows. */

typedef struct Limb {
    int parent;
    double x, y, radius, length, jointY; /* m: its middle, a capsule that stands, its joint */
    double axis[3];
} Limb;

enum { LIMBS = 18 };
static const Limb limbs[LIMBS] = {
    {-1, 0, 1.05, .13, .30, 0, {0}}, /* pelvis */
    {0, 0, 1.22, .06, .14, 1.17, {0, 0, 1}},
    {1, 0, 1.45, .15, .40, 1.25, {1, 0, 0}}, /* waist, chest */
    {2, 0, 1.72, .10, .24, 1.62, {1, 0, 0}}, /* head */
    {2, -.24, 1.55, .05, .11, 1.58, {0, 0, 1}},
    {4, -.28, 1.36, .05, .34, 1.53, {1, 0, 0}},
    {5, -.28, 1.05, .04, .30, 1.20, {1, 0, 0}}, /* left arm */
    {2, .24, 1.55, .05, .11, 1.58, {0, 0, 1}},
    {7, .28, 1.36, .05, .34, 1.53, {1, 0, 0}},
    {8, .28, 1.05, .04, .30, 1.20, {1, 0, 0}}, /* right arm */
    {0, -.11, .90, .06, .14, .95, {0, 0, 1}},
    {10, -.11, .68, .07, .40, .87, {1, 0, 0}},
    {11, -.11, .28, .055, .40, .48, {1, 0, 0}},
    {12, -.11, .05, .045, .10, .08, {1, 0, 0}}, /* left leg */
    {0, .11, .90, .06, .14, .95, {0, 0, 1}},
    {14, .11, .68, .07, .40, .87, {1, 0, 0}},
    {15, .11, .28, .055, .40, .48, {1, 0, 0}},
    {16, .11, .05, .045, .10, .08, {1, 0, 0}}, /* right leg */
};

static void buildHumanoid(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < LIMBS; i++) {
        const Limb *l = &limbs[i];
        const double r = l->radius, mass = 1000 * PI * r * r * (l->length - 2 * r + 4 * r / 3);
        SceneBody *b = scene_addCapsule(w, mass, r, l->length, l->x, l->y + .2, 0);
        b->friction = .7;
        b->start.velocity[2] = .5;
        b->start.quaternion[0] = cos(PI / 4);
        b->start.quaternion[1] = sin(PI / 4);
        if (l->parent >= 0)
            memcpy(scene_join(w, SCENE_HINGE, i, l->parent, l->x, l->jointY + .2, 0)->axis, l->axis, sizeof l->axis);
    }
}

static void watchHumanoid(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, scene_gap(w, states));
    double deep = 0;
    for (int i = 0; i < w->numBodies; i++)
        deep = fmax(deep, scenes_below(&w->bodies[i], &states[i]));
    t->worst[1] = deep;
    t->events[0] = states[0].position[1] > .5;
}

const Scene scenes_humanoid = {
    .name = "erez-humanoid",
    .text = "after Erez, Tassa, Todorov: a humanoid of 18 capsules on 17 hinges falls, mu .7, 5 s: largest gap of a "
            "joint, how deep it is in the ground at the end, 0 if it lies then, else 1",
    .hasEdges = true,
    .duration = 5,
    .errors = {{"gap m", .3, 1e-5}, {"at end m", .1, 1e-4}, {"up", INFINITY, 0}},
    .build = buildHumanoid,
    .observe = watchHumanoid,
    .measure = scenes_measureCounted,
};

/* Grasp: four fingers of two capsules close with constant torques around a capsule that hangs between them. */

enum { FINGERS = 4 };
static const double neverReached = 1000; /* rad/s: the motor's torque stays at its bound */

static void addPhalanx(SceneWorld *w, int parent, const double at[3], const double inward[3], double torque) {
    /* It hangs from `at`, .05 m long; the hinge lies across, and closes inward. */
    const double axis[3] = {-inward[2], 0, inward[0]};
    const int i = w->numBodies;
    SceneBody *b = scene_addCapsule(w, .02, .008, .05, at[0], at[1] - .025, at[2]);
    b->friction = 1;
    b->start.quaternion[0] = cos(PI / 4);
    b->start.quaternion[1] = sin(PI / 4);
    SceneJoint *j = scene_join(w, SCENE_HINGE, i, parent, at[0], at[1], at[2]);
    memcpy(j->axis, axis, sizeof axis);
    j->speed = neverReached;
    j->torque = torque;
    j->stops[0] = -.5;
    j->stops[1] = 1.5;
}

static void buildGrasp(const Scene *s, SceneWorld *w) {
    static const double height = .5, reach = .042; /* m, of the palm and of the fingers beside its middle */
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    scene_addBox(w, 0, .12, .02, .12, 0, height + .03, 0); /* above the fingers' ends */
    SceneBody *held = scene_addCapsule(w, .1, .025, .09, 0, height - .06, 0);
    held->friction = 1;
    held->start.quaternion[0] = cos(PI / 4);
    held->start.quaternion[1] = sin(PI / 4);
    for (int i = 0; i < FINGERS; i++) {
        const double angle = PI / 2 * i + PI / 4, inward[3] = {-cos(angle), 0, -sin(angle)};
        double at[3] = {-reach * inward[0], height, -reach * inward[2]};
        addPhalanx(w, 0, at, inward, .15);
        at[1] -= .05;
        addPhalanx(w, w->numBodies - 1, at, inward, .08);
    }
}

/* It hangs in the air while the fingers close, falls a little, and is held. It slips from then on, or not. */
static void watchGrasp(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    static const double closed = .5; /* s */
    if (time < closed + SCENE_FRAME / 2)
        memcpy(t->marked[1], states[1].position, sizeof t->marked[1]);
    double off[3] = {-t->marked[1][0], -t->marked[1][1], -t->marked[1][2]};
    addTo(off, states[1].position, 1);
    scenes_note(t, 0, sqrt(scene_dot(off, off)));
    scenes_note(t, 1, scene_gap(w, states));
    t->worst[2] = states[1].position[1] < .35;
}

const Scene scenes_grasp = {
    .name = "erez-grasp",
    .text =
        "after Erez, Tassa, Todorov: four fingers of two capsules close with constant torques around a capsule of .1 "
        "kg, mu 1, and hold it, 10 s: how far it slips after .5 s, largest gap of a joint, 0 if it is held, else 1",
    .hasEdges = true,
    .duration = 10,
    .errors = {{"slip m", INFINITY, 1e-5}, {"gap m", .05, 1e-6}, {"dropped", .5, 0}},
    .build = buildGrasp,
    .observe = watchGrasp,
    .measure = scenes_copyWorst,
};
