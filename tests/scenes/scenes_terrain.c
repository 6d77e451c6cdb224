/* A car without drive on ground of triangles: down a plane slope, and over bumps. Its front axle swings about its
 * middle, so that all four wheels touch whatever ground there is and every load is determined. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

enum { CHASSIS, AXLE, WHEELS, CAR = WHEELS + 4 };

static const double chassisMass = 500, axleMass = 30, wheelMass = 20, wheelRadius = .4; /* kg, m */

/* Its middle is above the origin of the slope [rad], down along x; at rest. */
static void addCar(SceneWorld *w, double slope) {
    const double c = cos(slope), s = sin(slope);
    scene_addBox(w, chassisMass, 2, .4, 1, 0, 1.2, 0);
    scene_addBox(w, axleMass, .1, .1, 1, .8, wheelRadius, 0);
    for (int k = 0; k < 4; k++)
        scene_addSphere(w, wheelMass, wheelRadius, k & 2 ? .8 : -.8, wheelRadius, k & 1 ? .75 : -.75);
    for (int i = 0; i < CAR; i++) {
        SceneState *at = &w->bodies[i].start;
        const double x = at->position[0], y = at->position[1];
        w->bodies[i].friction = .8;
        at->position[0] = c * x + s * y;
        at->position[1] = c * y - s * x;
        at->quaternion[0] = cos(slope / 2);
        at->quaternion[3] = -sin(slope / 2);
    }
    for (int i = AXLE; i < CAR; i++) {
        const double *at = w->bodies[i].start.position;
        scene_join(w, SCENE_HINGE, i, i < WHEELS + 2 ? CHASSIS : AXLE, at[0], at[1], at[2]);
    }
    const double swing[3] = {c, -s, 0};
    memcpy(w->joints[0].axis, swing, sizeof swing);
}

static void addTerrain(SceneWorld *w, double (*height)(double x, double z)) {
    SceneTerrain *t = &w->terrain;
    *t = (SceneTerrain){.xCount = 157, .zCount = 25, .x0 = -4, .z0 = -3, .step = .25};
    for (int k = 0; k < t->zCount; k++)
        for (int i = 0; i < t->xCount; i++)
            t->heights[k * t->xCount + i] = height(t->x0 + i * t->step, t->z0 + k * t->step);
}

static void noteGap(SceneTrace *t, const SceneWorld *w, const SceneState states[]) {
    scenes_note(t, 1, scene_gap(w, states));
}

/* Down a slope of 1/8, whose heights are exact in binary. */

static double slopeHeight(double x, double z) {
    (void)z;
    return -x / 8;
}

static void buildRoll(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    addTerrain(w, slopeHeight);
    addCar(w, atan(.125));
}

/* m/s²: a wheel that rolls has 7/5 of its mass. */
static double rollAcceleration(void) {
    const double mass = chassisMass + axleMass + 4 * wheelMass;
    return GRAVITY * sin(atan(.125)) * mass / (mass + 4 * .4 * wheelMass);
}

/* How far the chassis is from where it has to be: that is on the way too, so that an edge that was felt shows. */
static void watchRoll(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double way = rollAcceleration() * time * time / 2, *from = w->bodies[CHASSIS].start.position,
                 *at = states[CHASSIS].position, slope = atan(.125);
    const double along = way * cos(slope) - (at[0] - from[0]), down = -way * sin(slope) - (at[1] - from[1]);
    scenes_note(t, 0, along * cos(slope) - down * sin(slope));
    noteGap(t, w, states);
    scenes_note(t, 2, hypot(along * sin(slope) + down * cos(slope), at[2] - from[2]));
}

const Scene scenes_terrainRoll = {
    .name = "terrain-roll",
    .text = "a car of 610 kg on four freely turning balls rolls down a slope of 1/8 of triangles, mu .8, 5 s: largest "
            "error of its way along the slope, largest gap of a joint, largest way off its line, up or to the side",
    .hasEdges = true,
    .duration = 5,
    .errors = {{"way m", 3, 1e-4}, {"gap m", .1, 1e-5}, {"off m", .3, 1e-4}},
    .build = buildRoll,
    .observe = watchRoll,
    .measure = scenes_copyWorst,
};

/* Over bumps, between x = 2 and 27 m, that lie across and askew; they grow and cease over 3 m. It is flat before and
 * behind. */

static double rise(double x) {
    const double share = fmin(fmax(x / 3, 0), 1);
    return share * share * (3 - 2 * share);
}

static double bumpHeight(double x, double z) {
    return .08 * rise(x - 2) * rise(27 - x) * (sin(1.2 * x) + .6 * sin(x + 1.1 * z));
}

static void buildBumps(const Scene *s, SceneWorld *w) {
    static const double speed = 4;
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    addTerrain(w, bumpHeight);
    addCar(w, 0);
    for (int i = 0; i < CAR; i++) {
        w->bodies[i].start.velocity[0] = speed;
        w->bodies[i].start.spin[2] = i < WHEELS ? 0 : -speed / wheelRadius;
    }
}

/* m: Karma with 4, 16 and 64 sub-steps ends at x = 31.544, 31.554, 31.552, z = .297 to .303; ODE with 8, 16 and 32 at
 * x = 31.542, 31.553, 31.549, z = .289 to .294. */
static const double bumpsEnd[3] = {31.55, 1.2, .298};

static void watchBumps(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const double *at = states[CHASSIS].position, up[3] = {0, 1, 0};
    const double off[3] = {at[0] - bumpsEnd[0], at[1] - bumpsEnd[1], at[2] - bumpsEnd[2]};
    double is[3];
    noteGap(t, w, states);
    if (time > scenes_terrainCar.duration - SCENE_FRAME / 2)
        scenes_note(t, 0, sqrt(scene_dot(off, off)));
    scene_rotate(states[CHASSIS].quaternion, up, is);
    t->events[0] = !(at[0] > 28 && is[1] > .99);
}

const Scene scenes_terrainCar = {
    .name = "terrain-car",
    .text = "a car of 610 kg, its front axle swinging, rolls with 4 m/s at the start on four freely turning balls over "
            "25 m of bumps of .1 m of triangles, mu .8, 8 s: where it is at the end, largest gap of a joint, whether "
            "it has not come across upright",
    .hasEdges = true,
    .duration = 8,
    .errors = {{"way m", INFINITY, .01}, {"gap m", .1, 1e-4}, {"stuck", INFINITY, 0}},
    .build = buildBumps,
    .observe = watchBumps,
    .measure = scenes_measureCounted,
};
