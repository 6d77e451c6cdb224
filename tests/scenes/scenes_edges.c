/* Scenes of edges and rims, of a pack that bounces, and of bumps. */
#include "scenes_i.h"

#include <math.h>

/* A block that rocks on its two lower edges */

enum { PEAKS = 3 };
static const double blockWidth = .2, blockHeight = 1, blockShare = .8; /* m, of the angle of balance */

static double balance(void) {
    return atan2(blockWidth, blockHeight);
}

static void buildRocking(const Scene *s, SceneWorld *w) {
    const double R = hypot(blockWidth, blockHeight) / 2, tilt = blockShare * balance(), left = balance() - tilt;
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    SceneBody *b = scene_addBox(w, 1, blockWidth, blockHeight, blockWidth, -R * sin(left), R * cos(left), 0);
    b->friction = 1;
    b->start.quaternion[0] = cos(tilt / 2);
    b->start.quaternion[3] = -sin(tilt / 2);
}

/* rad, of the peak after the n-th blow (Housner 1963): each leaves the share 1 - 3/2 sin² of the angular velocity. */
static double rockingPeak(int n) {
    const double edge = cos(balance()), kept = 1 - 1.5 * sin(balance()) * sin(balance());
    return balance() - acos(edge + pow(kept, 2 * n) * (cos((1 - blockShare) * balance()) - edge));
}

/* Peaks of the tilt between blows, at which it changes its side. */
static void watchRocking(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double *q = states[0].quaternion, *before = t->last[0].quaternion, tilt = -2 * atan2(q[3], q[0]);
    const int blows = t->events[0] += time > 0 && tilt * atan2(before[3], before[0]) > 0;
    (void)w;
    if (blows > 0 && blows <= PEAKS && !(fabs(tilt) <= t->reference[blows]))
        t->reference[blows] = fabs(tilt);
    t->isDone = blows > PEAKS;
}

static void measureRocking(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    (void)w;
    for (int n = 1; n <= PEAKS; n++)
        errors[n - 1] = fabs(t->reference[n] / rockingPeak(n) - 1);
}

const Scene scenes_rocking = {
    .name = "block-rocks",
    .text = "a block of .2 x 1 m, mu 1, let go at .8 of its balance, rocks on its edges: relative errors of the first "
            "three "
            "peaks (Housner)",
    .duration = 10,
    .hasEdges = true,
    .errors = {{"peak 1", 1, .02}, {"peak 2", 1, .05}, {"peak 3", 1, .1}},
    .build = buildRocking,
    .observe = watchRocking,
    .measure = measureRocking,
};

/* A thin disc that rolls in a circle of its own radius */

static const double discRadius = .5, discThickness = .01, discAngle = 20 * PI / 180; /* m, rad */

/* Its centre rests: the contact goes round a circle of r = R cos a - b sin a with
 * W² [A sin a r/R + (B - A) sin a cos a] = m g r, where A is the moment about its axis, B across, 2 b the thickness. */
static void buildDisc(const Scene *s, SceneWorld *w) {
    const double R = discRadius, b = discThickness / 2, c = cos(discAngle), sine = sin(discAngle);
    const double r = R * c - b * sine, q = sqrt(1 - c) / 2;
    double inertia[3];
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    SceneBody *disc = scene_addCylinder(w, 1, R, discThickness, 0, R * sine + b * c, 0);
    disc->friction = 1;
    scene_inertia(disc, inertia);
    const double about = inertia[2] * sine * r / R + (inertia[0] - inertia[2]) * sine * c;
    const double turn = sqrt(GRAVITY * r / about), spin = -turn * r / R;
    SceneState *at = &disc->start;
    at->quaternion[0] = q;
    at->quaternion[1] = (1 - c) / (4 * q);
    at->quaternion[2] = at->quaternion[3] = sine / (4 * q);
    at->spin[0] = spin * sine;
    at->spin[1] = turn + spin * c;
}

static void watchDisc(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double along[3] = {0, 0, 1};
    double axis[3];
    (void)time;
    scene_rotate(states[0].quaternion, along, axis);
    scenes_note(t, 0, (acos(fmax(fmin(axis[1], 1), -1)) - discAngle) * 180 / PI);
    scenes_note(t, 1, scene_energy(w, states) / t->energy - 1);
}

const Scene scenes_discRolls = {
    .name = "disc-rolls",
    .text =
        "a disc of .5 m radius and 1 cm rolls at 20 degrees about its resting centre, mu 1, 10 s: largest error of its "
        "angle, of its energy",
    .duration = 10,
    .hasEdges = true,
    .errors = {{"angle deg", 60, 1}, {"energy", 10, 1e-3}},
    .build = buildDisc,
    .observe = watchDisc,
    .measure = scenes_copyWorst,
};

/* A pack of elastic balls that falls */

enum { SIDE = 6 };
static const double packGap = 1e-3, packDrop = .5; /* of a ball's size; m */

static void buildPack(const Scene *s, SceneWorld *w) {
    const double apart = 1 + packGap;
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        const int x = i / SIDE / SIDE, y = i % SIDE, z = i / SIDE % SIDE;
        scene_addSphere(w, 1, .5, apart * x, .5 + packDrop + apart * y, apart * z)->restitution = 1;
    }
}

/* Of the energy above that of the pack at rest on the ground. */
static void watchPack(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double rest = w->numBodies * GRAVITY * SIDE / 2.;
    (void)time;
    scenes_note(t, 0, (scene_energy(w, states) - t->energy) / (t->energy - rest));
}

const Scene scenes_pack = {
    .name = "elastic-pack",
    .text =
        "216 elastic balls without friction, a thousandth of their size apart, fall by .5 m, 2 s: largest error of the "
        "energy above that of the pack on the ground",
    .duration = 2,
    .bounces = true,
    .heaped = SIDE * SIDE * SIDE,
    .errors = {{"energy", 10, 1e-3}},
    .build = buildPack,
    .observe = watchPack,
    .measure = scenes_copyWorst,
};

/* Planks that are laid on bumps */

enum { BUMPY = 41, ROWS = 4, COLUMNS = 6 };
static const double bump = .03, restFrom = 19, slow = .01; /* m, s, m/s */

static void buildBumps(const Scene *s, SceneWorld *w) {
    SceneTerrain *t = &w->terrain;
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    *t = (SceneTerrain){.xCount = BUMPY, .zCount = BUMPY, .x0 = -10, .z0 = -10, .step = .5};
    for (int i = 0; i < BUMPY * BUMPY; i++)
        t->heights[i] = bump * sin(1.3 * i);
    for (int i = 0; i < ROWS * COLUMNS; i++)
        scene_addBox(w, 40, 1, .2, .4, 2.513 * (i % COLUMNS) - 6.2, .2, 2.521 * (i / COLUMNS) - 3.7)->friction = .5;
}

/* The planks that move in the last second, and the largest of their speeds. */
static void watchBumps(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    int moving = 0;
    if (time < restFrom)
        return;
    for (int i = 0; i < w->numBodies; i++) {
        const double speed = sqrt(scene_dot(states[i].velocity, states[i].velocity));
        scenes_note(t, 1, speed);
        moving += !(speed < slow);
    }
    scenes_note(t, 0, moving);
}

const Scene scenes_bumps = {
    .name = "planks-on-bumps",
    .text =
        "24 planks of 1 m are laid on bumps of 3 cm, mu .5: those that move faster than 1 cm/s in the last of 20 s, "
        "the largest speed then",
    .duration = 20,
    .hasEdges = true,
    .errors = {{"moving", 25, .5}, {"m/s", 10, slow}},
    .build = buildBumps,
    .observe = watchBumps,
    .measure = scenes_copyWorst,
};
