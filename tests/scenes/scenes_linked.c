/* Crowds with joints: rag dolls, a net, machines among crates, a bridge, cars on bumps. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

enum { WATCHED = 15 /* frames: how often overlaps are looked for */ };

static bool isWatched(double time) {
    return lround(time / SCENE_FRAME) % WATCHED == 0;
}

/* low .. high, the same everywhere: a linear congruential generator. */
static double between(unsigned *seed, double low, double high) {
    *seed = (*seed * 1664525u + 1013904223u) & 0xffffffffu;
    return low + (high - low) * (double)(*seed >> 8) / (1 << 24);
}

/* Rag dolls: boxes, a ball and hanging capsules, on ball joints, elbows and knees on hinges with stops */

enum { DOLLS = 100, PARTS = 11, PELVIS = 0, THIGHS = 7 };

typedef struct Part {
    double x, y, size[3]; /* m: of a box; or a radius, the length of a capsule (0: a ball), and 0 */
    int above;            /* the part that it is joined to, */
    double jointX, jointY;
    double bend; /* of a hinge, rad, the most; negative: forward; 0: a ball joint */
} Part;

static const Part parts[PARTS] = {
    {0, 1.02, {.34, .24, .22}, -1, 0, 0, 0},
    {0, 1.38, {.42, .40, .24}, PELVIS, 0, 1.16, 0},
    {0, 1.78, {.15, 0, 0}, 1, 0, 1.60, 0},
    {-.30, 1.36, {.07, .38, 0}, 1, -.27, 1.52, 0},
    {.30, 1.36, {.07, .38, 0}, 1, .27, 1.52, 0},
    {-.30, 1.02, {.06, .36, 0}, 3, -.30, 1.19, -2.2},
    {.30, 1.02, {.06, .36, 0}, 4, .30, 1.19, -2.2},
    {-.11, .71, {.09, .50, 0}, PELVIS, -.11, .92, 0},
    {.11, .71, {.09, .50, 0}, PELVIS, .11, .92, 0},
    {-.11, .26, {.07, .48, 0}, THIGHS, -.11, .49, 2.2},
    {.11, .26, {.07, .48, 0}, THIGHS + 1, .11, .49, 2.2},
};

/* Of the density of water. */
static SceneBody *addPart(SceneWorld *w, const Part *p, const double feet[3]) {
    const double x = feet[0] + p->x, y = feet[1] + p->y, z = feet[2], *size = p->size, r = size[0];
    const double cylinder = size[1] - 2 * r;
    if (size[2] > 0)
        return scene_addBox(w, 1000 * size[0] * size[1] * size[2], size[0], size[1], size[2], x, y, z);
    if (size[1] <= 0)
        return scene_addSphere(w, 4000. / 3 * PI * r * r * r, r, x, y, z);
    SceneBody *b = scene_addCapsule(w, 1000 * PI * r * r * (4 * r / 3 + cylinder), r, size[1], x, y, z);
    b->start.quaternion[0] = cos(-PI / 4);
    b->start.quaternion[1] = sin(-PI / 4);
    return b;
}

static void joinPart(SceneWorld *w, const Part *p, int child, int first, const double feet[3]) {
    SceneJoint *j = scene_join(w, p->bend != 0 ? SCENE_HINGE : SCENE_BALL_JOINT, child, first + p->above,
                               feet[0] + p->jointX, feet[1] + p->jointY, feet[2]);
    if (p->bend != 0) {
        j->axis[0] = 1;
        j->axis[2] = 0;
        j->stops[0] = fmin(p->bend, 0);
        j->stops[1] = fmax(p->bend, 0);
    }
}

/* Each part gets the velocity v + spin x (its place from the feet): the figure turns as one. */
static void throwPart(SceneBody *b, const double feet[3], const double v[3], const double spin[3]) {
    double arm[3];
    for (int i = 0; i < 3; i++)
        arm[i] = b->start.position[i] - feet[i];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        b->start.velocity[i] = v[i] + spin[j] * arm[k] - spin[k] * arm[j];
        b->start.spin[i] = spin[i];
    }
}

static void addDoll(SceneWorld *w, const double feet[3], const double v[3], const double spin[3]) {
    const int first = w->numBodies;
    for (int i = 0; i < PARTS; i++) {
        SceneBody *b = addPart(w, &parts[i], feet);
        b->friction = .5;
        throwPart(b, feet, v, spin);
        if (i != PELVIS)
            joinPart(w, &parts[i], first + i, first, feet);
    }
}

static void buildDolls(const Scene *s, SceneWorld *w) {
    unsigned seed = 1;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < s->count / PARTS; i++) {
        const double feet[3] = {7 * (i % 10), between(&seed, .05, 1), 7 * (i / 10)};
        double v[3], spin[3];
        for (int k = 0; k < 3; k++) {
            v[k] = between(&seed, -2, 2);
            spin[k] = between(&seed, -3, 3);
        }
        addDoll(w, feet, v, spin);
    }
}

/* One whose chest is more than .8 m high is not down. */
static void watchDolls(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    scenes_note(t, 0, scene_gap(w, states));
    if (isWatched(time))
        t->worst[1] = scenes_deepest(w, states);
    t->events[0] = 0;
    for (int i = 1; i < w->numBodies; i += PARTS)
        t->events[0] += states[i].position[1] > .8;
}

const Scene scenes_dolls = {
    .name = "ragdolls-100",
    .text = "100 rag dolls of 11 parts, elbows and knees with stops, are thrown and fall, mu .5, 5 s: largest gap of a "
            "joint, overlap at the end, dolls that are not down at the end",
    .count = DOLLS * PARTS,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 5,
    .errors = {{"gap m", .3, 1e-4}, {"at end m", .3, 1e-3}, {"up", INFINITY, 0}},
    .build = buildDolls,
    .observe = watchDolls,
    .measure = scenes_measureCounted,
};

/* A net of balls that catches boxes of five times their mass */

enum { KNOTS = 10, CAUGHT = 36 };
static const double netHeight = 4, netSpacing = .4; /* m */

static void addKnot(SceneWorld *w, int i, int k) {
    const double middle = netSpacing * (KNOTS - 1) / 2, x = netSpacing * i - middle, z = netSpacing * k - middle;
    const int knot = w->numBodies;
    scene_addSphere(w, 7.238, .12, x, netHeight, z)->friction = .5;
    if (i > 0)
        scene_join(w, SCENE_BALL_JOINT, knot, knot - KNOTS, x - netSpacing / 2, netHeight, z);
    if (k > 0)
        scene_join(w, SCENE_BALL_JOINT, knot, knot - 1, x, netHeight, z - netSpacing / 2);
    if (i == 0 || k == 0 || i == KNOTS - 1 || k == KNOTS - 1)
        scene_join(w, SCENE_BALL_JOINT, knot, SCENE_WORLD, x, netHeight, z);
}

static void buildNet(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < KNOTS; i++)
        for (int k = 0; k < KNOTS; k++)
            addKnot(w, i, k);
    for (int i = 0; i < CAUGHT; i++)
        scene_addBox(w, 37.5, .5, .5, .5, .7 * (i % 3) - .7, 4.6 + .6 * (i / 9), .7 * (i / 3 % 3) - .7)->friction = .5;
}

/* A box that is below the net, and inside its rim, has gone through. */
static void watchNet(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double inside = netSpacing * (KNOTS - 1) / 2 - .5;
    scenes_note(t, 0, scene_gap(w, states));
    if (isWatched(time))
        t->worst[1] = scenes_deepest(w, states);
    t->worst[2] = 0;
    for (int i = KNOTS * KNOTS; i < w->numBodies; i++) {
        const double *at = states[i].position;
        t->worst[2] += at[1] < netHeight - 1 && fabs(at[0]) < inside && fabs(at[2]) < inside;
    }
}

const Scene scenes_net = {
    .name = "net",
    .text = "a net of 10 x 10 balls of 7.2 kg on ball joints, its rim fixed, catches 36 boxes of 37.5 kg, mu .5, 10 s: "
            "largest gap of a joint, overlap at the end, boxes that went through",
    .count = KNOTS * KNOTS + CAUGHT,
    .heaped = KNOTS * KNOTS + CAUGHT,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"gap m", .4, 1e-4}, {"at end m", .3, 1e-3}, {"through", INFINITY, 0}},
    .build = buildNet,
    .observe = watchNet,
    .measure = scenes_copyWorst,
};

/* Vehicles on four balls with motors */

typedef struct Vehicle {
    double mass, wheel; /* kg, of the chassis and of a wheel */
    double speed, torque;
} Vehicle;

static void addHinge(SceneWorld *w, int child, int parent, const double at[3], double speed, double torque) {
    SceneJoint *j = scene_join(w, SCENE_HINGE, child, parent, at[0], at[1], at[2]);
    j->speed = speed;
    j->torque = torque;
}

/* Returns its chassis, which the wheels follow. */
static int addVehicle(SceneWorld *w, const Vehicle *v, double z) {
    const int chassis = w->numBodies;
    scene_addBox(w, v->mass, 2, .4, 1, 0, .7, z)->friction = .5;
    for (int k = 0; k < 4; k++) {
        const double at[3] = {k & 1 ? .8 : -.8, .4, z + (k & 2 ? .75 : -.75)};
        scene_addSphere(w, v->wheel, .4, at[0], at[1], at[2])->friction = .5;
        addHinge(w, chassis + 1 + k, chassis, at, v->speed, v->torque);
    }
    return chassis;
}

/* Machines: a vehicle each, and an arm of five driven links before it */

enum { MACHINES = 10, MACHINE = 10 /* bodies */, ARM = 5, CRATES = 100 };

static void addMachine(SceneWorld *w, double z) {
    static const Vehicle vehicle = {160, 30, -8, 400};
    int last = addVehicle(w, &vehicle, z);
    for (int k = 0; k < ARM; k++) {
        const double at[3] = {1 + k, 1.2, z};
        scene_addBox(w, 2.25, 1, .15, .15, 1.5 + k, 1.2, z)->friction = .5;
        addHinge(w, w->numBodies - 1, last, at, .3 * sin(k), 300);
        last = w->numBodies - 1;
    }
}

static void buildMachines(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < MACHINES; i++)
        addMachine(w, 4 * i);
    for (int i = 0; i < CRATES; i++)
        scene_addBox(w, 21.6, .6, .6, .6, 9 + .9 * (i % 4), .3, 1.5 * (i / 4) - .5)->friction = .5;
}

/* A vehicle that is not past there, or lies on its back, is stuck. */
static int countStuck(const SceneState states[], int vehicles, int bodies, double past) {
    int stuck = 0;
    for (int i = 0; i < vehicles; i++) {
        const SceneState *s = &states[i * bodies];
        const double up[3] = {0, 1, 0};
        double is[3];
        scene_rotate(s->quaternion, up, is);
        stuck += !(s->position[0] > past && is[1] > 0);
    }
    return stuck;
}

static void watchMachines(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    scenes_note(t, 0, scene_gap(w, states));
    if (isWatched(time))
        t->worst[1] = scenes_deepest(w, states);
    t->events[0] = countStuck(states, MACHINES, MACHINE, 5);
}

const Scene scenes_machines = {
    .name = "machines",
    .text =
        "10 vehicles of 280 kg on four balls with motors, an arm of five driven links before each, push 100 crates of "
        "21.6 kg, mu .5, 5 s: largest gap of a joint, overlap at the end, vehicles that have not moved 5 m",
    .count = MACHINES * MACHINE + CRATES,
    .heaped = MACHINES * MACHINE + CRATES,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 5,
    .errors = {{"gap m", .5, 1e-4}, {"at end m", .4, 1e-3}, {"stuck", INFINITY, 0}},
    .build = buildMachines,
    .observe = watchMachines,
    .measure = scenes_measureCounted,
};

/* Cars on a road with bumps, half sunk capsules across it */

enum { CARS = 20, CAR = 5, BUMPS = 12 };

static void buildCars(const Scene *s, SceneWorld *w) {
    static const Vehicle vehicle = {500, 20, -10, 150};
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < CARS; i++)
        addVehicle(w, &vehicle, 3 * i);
    for (int i = 0; i < BUMPS; i++)
        scene_addCapsule(w, 0, .3, 3 * CARS + 10, 4 + 3 * i, -.2, 1.5 * (CARS - 1))->friction = .5;
}

static void watchCars(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    scenes_note(t, 0, scene_gap(w, states));
    if (isWatched(time))
        t->worst[1] = scenes_deepest(w, states);
    t->events[0] = countStuck(states, CARS, CAR, 10);
}

const Scene scenes_cars = {
    .name = "cars",
    .text =
        "20 cars of 580 kg on four balls with motors (10 rad/s, 150 N m) drive over bumps of .1 m every 3 m, mu .5, "
        "8 s: largest gap of a joint, overlap at the end, cars that have not come 10 m or lie on their backs",
    .count = CARS * CAR,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 8,
    .errors = {{"gap m", .5, 1e-4}, {"at end m", .4, 1e-3}, {"stuck", INFINITY, 0}},
    .build = buildCars,
    .observe = watchCars,
    .measure = scenes_measureCounted,
};

/* A bridge with a crate on every plank, in its equilibrium
 *
 * The forces in the joints have a constant part H to the side, and an upright part that grows by the weight G of a
 * plank with its crate from joint to joint, and is 0 in the middle by symmetry: n G beside the n-th plank from the
 * middle, on average. A plank (length L) at the angle a is in balance about its middle if
 *   cos a L n G = sin a (L H - d G'),
 * G' the weight of the crate, whose centre is d above the plank's line: tan a = n k, with k = G / (H - d G' / L). So k
 * may be chosen, and H follows. */

enum { PLANKS = 30 };
static const double plankLength = .5, plankThickness = .05, plankWidth = 2, crateSize = .3; /* m */
static const double slope = .03;                                                            /* k */

static double plankAngle(int i) {
    return atan(slope * (i - (PLANKS - 1) / 2.));
}

static void tilt(SceneBody *b, double angle) {
    b->friction = .8;
    b->start.quaternion[0] = cos(angle / 2);
    b->start.quaternion[3] = sin(angle / 2);
}

static void joinPlank(SceneWorld *w, int child, int parent, const double at[2]) {
    for (int side = -1; side < 2; side += 2)
        scene_join(w, SCENE_BALL_JOINT, child, parent, at[0], at[1], .45 * plankWidth * side);
}

static void buildBridge(const Scene *s, SceneWorld *w) {
    const double above = plankThickness / 2 + crateSize / 2;
    double end[2] = {0, 10};
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < PLANKS; i++) {
        const double a = plankAngle(i), dx = plankLength * cos(a), dy = plankLength * sin(a);
        tilt(scene_addBox(w, 10, plankLength, plankThickness, plankWidth, end[0] + dx / 2, end[1] + dy / 2, 0), a);
        joinPlank(w, i, i > 0 ? i - 1 : SCENE_WORLD, end);
        end[0] += dx;
        end[1] += dy;
    }
    joinPlank(w, PLANKS - 1, SCENE_WORLD, end);
    for (int i = 0; i < PLANKS; i++) {
        const double a = plankAngle(i), *plank = w->bodies[i].start.position;
        tilt(scene_addBox(w, 5, crateSize, crateSize, crateSize, plank[0] - above * sin(a), plank[1] + above * cos(a),
                          0),
             a);
    }
}

static void watchBridge(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    scenes_note(t, 1, scene_gap(w, states));
    for (int i = 0; i < w->numBodies; i++) {
        const double *from = w->bodies[i].start.position, *at = states[i].position;
        const double off[3] = {at[0] - from[0], at[1] - from[1], at[2] - from[2]};
        scenes_note(t, 0, sqrt(scene_dot(off, off)));
    }
}

const Scene scenes_bridge = {
    .name = "bridge",
    .text =
        "a bridge of 30 planks of 10 kg, each on two ball joints a side, hangs in its equilibrium with a crate of 5 kg "
        "on every plank, mu .8, 10 s: largest way of any, largest gap of a joint",
    .count = 2 * PLANKS,
    .heaped = 2 * PLANKS,
    .isCrowd = true,
    .hasEdges = true,
    .duration = 10,
    .errors = {{"moved m", 1, 1e-3}, {"gap m", .3, 1e-5}},
    .build = buildBridge,
    .observe = watchBridge,
    .measure = scenes_copyWorst,
};
