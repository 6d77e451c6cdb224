/* Scenes that go round: a coin that rolls, ground that turns, linkages and rings of links, an arm that is led. */
#include "scenes_i.h"
#include "reference.h"

#include <math.h>

static double degrees(double angle) {
    return angle * 180 / PI;
}

/* ---- coins ------------------------------------------------------------------------------------------------------- */

/* It touches at (x, 0, 0); its axis leans down by `lean` from x. */
static SceneBody *addCoin(SceneWorld *w, double radius, double width, double lean, double x) {
    const double c = cos(lean), s = sin(lean), half = width / 2, turn = sqrt(.5);
    scenes_setDown(w);
    w->collides = true;
    SceneBody *b = scene_addCylinder(w, 1, radius, width, x + half * c - radius * s, radius * c + half * s, 0);
    b->friction = .9;
    b->start.quaternion[0] = turn; /* z to the axis, by a right angle */
    b->start.quaternion[1] = -turn * s;
    b->start.quaternion[2] = turn * c;
    return b;
}

/* rad, of the plane of the coin, from upright. */
static double leanOf(const SceneState *s) {
    double axis[3] = {0, 0, 1};
    scene_rotate(s->quaternion, axis, axis);
    return atan2(fabs(axis[1]), hypot(axis[0], axis[2]));
}

static const double coinLean = PI / 6, coinRadius = .5, coinWidth = .1, coinCircle = 1.5; /* rad, m */

static double coinRate(void) {
    SceneWorld w = {.numBodies = 0};
    double inertia[3];
    scene_inertia(addCoin(&w, coinRadius, coinWidth, coinLean, coinCircle), inertia);
    const ReferenceDisc disc = {coinRadius, coinWidth / 2, inertia[2], inertia[0], coinLean, coinCircle};
    return reference_rollingDisc(&disc, GRAVITY);
}

static void buildCoin(const Scene *s, SceneWorld *w) {
    (void)s;
    const double rate = coinRate(), spin = -rate * coinCircle / coinRadius;
    SceneState *start = &addCoin(w, coinRadius, coinWidth, coinLean, coinCircle)->start;
    start->velocity[2] = -rate * start->position[0];
    start->spin[0] = spin * cos(coinLean);
    start->spin[1] = rate + spin * sin(coinLean);
}

static void watchCoin(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double *at = states[0].position, *from = w->bodies[0].start.position, angle = coinRate() * time;
    scenes_note(t, 0, degrees(leanOf(&states[0]) - coinLean));
    scenes_note(t, 1, hypot(at[0], at[2]) / from[0] - 1);
    scenes_note(t, 2, hypot(at[0] - from[0] * cos(angle), at[2] + from[0] * sin(angle)));
}

const Scene scenes_coin = {
    .name = "coin",
    .text = "a disc of .5 x .1 m that leans by 30 degrees rolls on a circle of 1.5 m, mu .9, 10 s: largest errors of "
            "the lean, of the distance from the middle, and of the place, against steady rolling",
    .hasEdges = true,
    .duration = 10,
    .errors = {{"lean deg", 45, 1}, {"radius", INFINITY, .01}, {"place m", INFINITY, .1}},
    .build = buildCoin,
    .observe = watchCoin,
    .measure = scenes_copyWorst,
};

/* One that is put down as it leans, with a spin about the upright: it slips, and then rolls on its rim, ever faster as
 * it comes to lie. Nothing but its slip takes energy. */
static void buildCoinFalls(const Scene *s, SceneWorld *w) {
    (void)s;
    SceneBody *b = addCoin(w, .1, .02, coinLean, 0);
    b->friction = .3;
    b->start.spin[1] = 5;
}

static void watchCoinFalls(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, fmax(scene_energy(w, states) / t->energy - 1, 0));
    scenes_note(t, 1, fmax(scenes_below(&w->bodies[0], &states[0]), 0));
}

const Scene scenes_coinFalls = {
    .name = "coin-falls",
    .text =
        "a disc of .1 x .02 m that leans by 30 degrees is put down with 5 rad/s about the upright, mu .3, 10 s: its "
        "largest gain of energy; its largest overlap",
    .hasEdges = true,
    .duration = 10,
    .errors = {{"gain", INFINITY, 1e-3}, {"overlap m", .05, 1e-3}},
    .build = buildCoinFalls,
    .observe = watchCoinFalls,
    .measure = scenes_copyWorst,
};

/* ---- ground that turns ------------------------------------------------------------------------------------------- */

/* A disc on an axis, so heavy that nothing brakes it: what lies on it at the radius r holds up to w² r = mu g. */
static const double discMass = 1e6, discRadius = 2, discWidth = .2, discHeight = 1; /* kg, m */
static const double discFriction = .5, slideRadius = 1;                             /* m, from where on nothing holds */

static double discRate(void) {
    return sqrt(discFriction * GRAVITY / slideRadius);
}

static void addDisc(SceneWorld *w) {
    scenes_setDown(w);
    w->collides = true;
    SceneBody *b = scene_addCylinder(w, discMass, discRadius, discWidth, 0, discHeight, 0);
    b->start.quaternion[0] = cos(-PI / 4);
    b->start.quaternion[1] = sin(-PI / 4);
    b->start.spin[1] = discRate();
    SceneJoint *j = scene_joinLast(w, SCENE_HINGE, 0, discHeight, 0);
    j->axis[1] = 1;
    j->axis[2] = 0;
}

/* On the x axis, on either side; it goes with the disc, at this share of the speed at which it slides. */
static void addRider(SceneWorld *w, double share, double side) {
    const double x = side * share * share * slideRadius;
    SceneBody *b = scene_addBox(w, 1, .2, .1, .2, x, discHeight + discWidth / 2 + .05, 0);
    b->friction = discFriction;
    b->start.velocity[2] = -discRate() * x;
    b->start.spin[1] = discRate();
}

/* m, how far it is from where the disc has turned its place to. */
static double creepOf(const SceneWorld *w, const SceneState states[], int body) {
    double should[3];
    scene_attachment(w, states, 0, w->bodies[body].start.position, should);
    for (int i = 0; i < 3; i++)
        should[i] -= states[body].position[i];
    return sqrt(scene_dot(should, should));
}

static void buildTurning(const Scene *s, SceneWorld *w) {
    (void)s;
    addDisc(w);
    addRider(w, .5, 1);
    addRider(w, .9, -1);
}

static void watchTurning(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < 2; i++)
        scenes_note(t, i, creepOf(w, states, 1 + i));
}

const Scene scenes_turning = {
    .name = "turning",
    .text =
        "boxes of .2 x .1 x .2 m ride on a disc of 1e6 kg that turns on an axis, mu .5, at .5 and .9 of the speed at "
        "which they slide, 20 s: how far they creep",
    .hasEdges = true,
    .duration = 20,
    .errors = {{"at .5 m", .5, 1e-4}, {"at .9 m", .5, 1e-4}},
    .build = buildTurning,
    .observe = watchTurning,
    .measure = scenes_copyWorst,
};

static void buildTurningLimit(const Scene *s, SceneWorld *w) {
    (void)s;
    addDisc(w);
    addRider(w, .99, 1);
    addRider(w, 1.01, -1);
}

static void watchTurningLimit(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, creepOf(w, states, 1));
}

static void measureTurningLimit(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    errors[0] = t->worst[0];
    errors[1] = creepOf(w, t->last, 2) < .01;
}

const Scene scenes_turningLimit = {
    .name = "turning-limit",
    .text =
        "the same at .99 and 1.01 of that speed, 5 s: how far the first creeps, and 0 if the second has slid by more "
        "than .01 m, else 1",
    .hasEdges = true,
    .duration = 5,
    .errors = {{"creep m", .5, 1e-4}, {"stays", INFINITY, 0}},
    .build = buildTurningLimit,
    .observe = watchTurningLimit,
    .measure = measureTurningLimit,
};

/* ---- a parallelogram linkage ------------------------------------------------------------------------------------- */

enum { COUPLER = 0, CRANKS = 1 };
static const double crank = .3, coupler = 1, bar = .05, crankPhase = .3; /* m, rad */
static const double crankSpeed = 2 * PI, crankTorque = 1e4;              /* rad/s; N m, as good as unlimited */

static SceneBody *addBar(SceneWorld *w, double length, double x, double y, double angle) {
    SceneBody *b = scene_addBox(w, 1, length, bar, bar, x, y, 0);
    b->start.quaternion[0] = cos(angle / 2);
    b->start.quaternion[3] = sin(angle / 2);
    return b;
}

static void moveRound(SceneBody *b, double x, double y, double spin) {
    b->start.velocity[0] = -crankSpeed * y;
    b->start.velocity[1] = crankSpeed * x;
    b->start.spin[2] = spin;
}

static void buildLinkage(const Scene *s, SceneWorld *w) {
    (void)s;
    const double x = crank * cos(crankPhase), y = crank * sin(crankPhase);
    scenes_setDown(w);
    moveRound(addBar(w, coupler, coupler / 2 + x, y, 0), x, y, 0);
    for (int i = 0; i < 2; i++)
        moveRound(addBar(w, crank, coupler * i + x / 2, y / 2, crankPhase), x / 2, y / 2, crankSpeed);
    SceneJoint *motor = scene_join(w, SCENE_HINGE, CRANKS, SCENE_WORLD, 0, 0, 0);
    motor->speed = crankSpeed;
    motor->torque = crankTorque;
    scene_join(w, SCENE_HINGE, COUPLER, CRANKS, x, y, 0);
    scene_join(w, SCENE_HINGE, CRANKS + 1, COUPLER, coupler + x, y, 0);
    scene_join(w, SCENE_HINGE, CRANKS + 1, SCENE_WORLD, coupler, 0, 0);
}

static double angleOf(const SceneState *s) {
    return 2 * atan2(s->quaternion[3], s->quaternion[0]);
}

/* On the antiparallel branch the cranks are up to half a turn apart. */
static void watchLinkage(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double apart = fabs(remainder(angleOf(&states[CRANKS]) - angleOf(&states[CRANKS + 1]), 2 * PI));
    (void)time;
    scenes_note(t, 0, apart);
    scenes_note(t, 1, scene_gap(w, states));
    t->events[0] += !(apart < .5);
}

const Scene scenes_linkage = {
    .name = "linkage",
    .text =
        "a parallelogram of two cranks of .3 m and a coupler of 1 m on hinges, a motor turns one crank once a second, "
        "10 s: how far the cranks are from parallel, largest gap of a joint, frames on the antiparallel branch",
    .duration = 10,
    .errors = {{"apart rad", INFINITY, 1e-3}, {"gap m", .3, 1e-6}, {"frames", INFINITY, 0}},
    .build = buildLinkage,
    .observe = watchLinkage,
    .measure = scenes_measureCounted,
};

/* ---- rings ------------------------------------------------------------------------------------------------------- */

enum { LINKS = 40 };
static const double link = .25, kick = .3; /* m, m/s */

static void addLink(SceneWorld *w, double x, double y, double angle) {
    SceneBody *b = addBar(w, link, x, y, angle);
    const int i = w->numBodies - 1;
    b->start.velocity[0] = kick * sin(3 * i);
    b->start.velocity[1] = kick * cos(5 * i);
    b->start.velocity[2] = kick * sin(7 * i);
}

/* It hangs at the joint at its top, from which the tree of its links goes down both sides; it is closed below. */
static void buildRing(const Scene *s, SceneWorld *w) {
    const double radius = link / 2 / sin(PI / LINKS);
    (void)s;
    scenes_setDown(w);
    for (int i = 0; i < LINKS; i++) {
        const double angle = PI / 2 + 2 * PI * (i + .5) / LINKS, r = radius * cos(PI / LINKS);
        addLink(w, r * cos(angle), r * sin(angle), angle + PI / 2);
    }
    scene_join(w, SCENE_BALL_JOINT, 0, SCENE_WORLD, 0, radius, 0);
    for (int i = 1; i <= LINKS; i++) {
        const double angle = PI / 2 + 2 * PI * i / LINKS, x = radius * cos(angle), y = radius * sin(angle);
        if (i <= LINKS / 2)
            scene_join(w, SCENE_BALL_JOINT, i % LINKS, i - 1, x, y, 0);
        else
            scene_join(w, SCENE_BALL_JOINT, i - 1, i % LINKS, x, y, 0);
    }
}

/* An arc of 2 rad, whose ends are on the world. */
static void buildSlackBridge(const Scene *s, SceneWorld *w) {
    double x = 0, y = 0;
    (void)s;
    scenes_setDown(w);
    for (int i = 0; i < LINKS; i++) {
        const double angle = -1 + 2 * (i + .5) / LINKS, dx = link * cos(angle), dy = link * sin(angle);
        addLink(w, x + dx / 2, y + dy / 2, angle);
        scene_joinLast(w, SCENE_HINGE, x, y, 0);
        x += dx;
        y += dy;
    }
    scene_join(w, SCENE_HINGE, LINKS - 1, SCENE_WORLD, x, y, 0);
}

/* Of the energy of the chain's length. */
static void watchRing(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 0, scene_gap(w, states));
    scenes_note(t, 1, (scene_energy(w, states) - t->energy) / (LINKS * GRAVITY * LINKS * link));
}

const Scene scenes_ring = {
    .name = "ring",
    .text = "a ring of 40 links of .25 m and 1 kg on ball joints hangs at one of them, kicked with .3 m/s, 10 s: "
            "largest gap of a joint, largest error of the energy, of 40 kg on 10 m",
    .count = LINKS,
    .duration = 10,
    .errors = {{"gap m", .1, 1e-6}, {"energy", 1, .01}},
    .build = buildRing,
    .observe = watchRing,
    .measure = scenes_copyWorst,
};
const Scene scenes_slackBridge = {
    .name = "slack-bridge",
    .text = "40 such links on hinges sag between two ends, kicked the same way, 10 s: the same",
    .count = LINKS,
    .duration = 10,
    .errors = {{"gap m", .1, 1e-6}, {"energy", 1, .01}},
    .build = buildSlackBridge,
    .observe = watchRing,
    .measure = scenes_copyWorst,
};

/* ---- an arm that is led ------------------------------------------------------------------------------------------ */

static double armPath(double time) {
    return sin(time) * (1 + cos(3 * time) / 2);
}

static void buildLedArm(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    scene_addBox(w, 1, 1, .1, .1, .5, 0, 0);
    SceneJoint *j = scene_joinLast(w, SCENE_HINGE, 0, 0, 0);
    j->path = armPath;
    j->torque = 1e4;
}

static void watchLedArm(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    scenes_note(t, 0, remainder(angleOf(&states[0]) - armPath(time), 2 * PI));
    scenes_note(t, 1, scene_gap(w, states));
}

const Scene scenes_ledArm = {
    .name = "led-arm",
    .text =
        "an arm of 1 m and 1 kg is led by a motor that gets the mean speed of sin t (1 + cos 3t / 2) rad in each step, "
        "5 s: largest error of the angle, largest gap of the joint",
    .duration = 5,
    .errors = {{"path rad", INFINITY, 1e-6}, {"gap m", .1, 1e-6}},
    .build = buildLedArm,
    .observe = watchLedArm,
    .measure = scenes_copyWorst,
};
