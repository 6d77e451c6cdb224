/* Two toothed wheels, whose teeth are boxes. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

enum { SMALL, LARGE };

typedef struct Wheel {
    int teeth;
    double tip, mass, torque; /* m, radius of the teeth's ends; kg; N m */
    double phase;             /* rad, of the first tooth at the start */
} Wheel;

/* The pitch circles have radii of .6 and 1.2 m: a tooth and its gap are .314 m wide there. The teeth go .08 m beyond
 * them, and with .1 m leave room for each other; how much is what `isFree` says. A tooth of the small wheel points at a
 * gap of the large one. Both torques turn the same way about z, and so work against each other: the load takes a third
 * of the drive. Teeth are so long that only their outer ends meet. */
static const Wheel wheels[2] = {{12, .68, 40, 12, 0}, {24, 1.28, 80, 8, PI / 24}};
static const double between = 1.8, toothLength = .3, toothWidth = .1, thickness = .2; /* m */

static double pitch(int i) {
    return 2 * PI / wheels[i].teeth;
}

static void addWheel(SceneWorld *w, int i, double x) {
    const Wheel *g = &wheels[i];
    const double disc = g->mass * g->tip * g->tip, inertia[3] = {disc / 4, disc / 4, disc / 2};
    scene_addCompound(w, g->mass, inertia, x, 3, 0)->friction = .1;
    for (int k = 0; k < g->teeth; k++) {
        const double turn = g->phase + k * pitch(i), out = g->tip - toothLength / 2;
        const double middle[3] = {out * cos(turn), out * sin(turn), 0};
        scene_addPart(w, toothLength, toothWidth, thickness, middle, turn);
    }
    SceneJoint *j = scene_join(w, SCENE_HINGE, i, SCENE_WORLD, x, 3, 0);
    j->speed = copysign(100, g->torque); /* out of reach: a constant torque */
    j->torque = fabs(g->torque);
}

static void buildGears(const Scene *s, SceneWorld *w) {
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    addWheel(w, SMALL, 0);
    addWheel(w, LARGE, between);
}

/* Whether two opposite teeth of each wheel, as one bar of this direction, are apart: along their sides' normals, or
 * lengthwise. */
static bool areApart(double small, double large) {
    const double turn = small - large, c = fabs(cos(turn)), s = fabs(sin(turn)), r = wheels[SMALL].tip,
                 t = wheels[LARGE].tip, half = toothWidth / 2;
    return fabs(between * cos(small)) > r + t * c + half * s || fabs(between * sin(small)) > half + t * s + half * c ||
           fabs(between * cos(large)) > t + r * c + half * s || fabs(between * sin(large)) > half + r * s + half * c;
}

/* Whether the teeth of the wheels, turned by these angles since the start, do not overlap. */
static bool isFree(const double angles[2]) {
    for (int i = 0; i < wheels[SMALL].teeth / 2; i++)
        for (int k = 0; k < wheels[LARGE].teeth / 2; k++)
            if (!areApart(wheels[SMALL].phase + angles[SMALL] + i * pitch(SMALL),
                          wheels[LARGE].phase + angles[LARGE] + k * pitch(LARGE)))
                return false;
    return true;
}

static double ledAngle(double small) {
    return -small * wheels[SMALL].teeth / wheels[LARGE].teeth;
}

double scenes_gearPlay(double small, int side) {
    double inside = 0, outside = pitch(LARGE) / 2;
    for (int i = 0; i < 40; i++) {
        const double middle = (inside + outside) / 2, angles[2] = {small, ledAngle(small) + side * middle};
        if (isFree(angles))
            inside = middle;
        else
            outside = middle;
    }
    return inside;
}

/* rad, of the large wheel beyond where the teeth that the small one holds against it let it be. */
static double beyondPlay(const double angles[2]) {
    const double off = angles[LARGE] - ledAngle(angles[SMALL]);
    return fmax(fabs(off) - scenes_gearPlay(angles[SMALL], off > 0 ? 1 : -1), 0);
}

/* Angles are counted on from frame to frame, from 0. */
static void watchGears(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = SMALL; i <= LARGE; i++) {
        const double *q = states[i].quaternion, angle = 2 * atan2(q[3], q[0]);
        t->reference[i] += remainder(angle - t->reference[i], 2 * PI);
    }
    scenes_note(t, 0, beyondPlay(t->reference));
    scenes_note(t, 1, scene_gap(w, states));
    t->events[0] = (int)fabs(round((t->reference[LARGE] - ledAngle(t->reference[SMALL])) / pitch(LARGE)));
    t->events[1] = t->reference[SMALL] > 2 * PI;
}

/* A drive that has not gone round has shown nothing. */
static void measureGears(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    scenes_measureCounted(t, w, errors);
    if (!t->events[1])
        errors[2] = INFINITY;
}

const Scene scenes_gears = {
    .name = "gears",
    .text = "a wheel of 12 teeth, driven by 12 N m, turns one of 24, which a load of 8 N m holds back: boxes of .1 m, "
            "mu .1, 10 s: how far the large wheel is beyond the play of the teeth from half of the small one's angle, "
            "largest gap of a hinge, teeth that were skipped",
    .hasEdges = true,
    .duration = 10,
    .errors = {{"beyond rad", .13, 1e-3}, {"gap m", .1, 1e-5}, {"skipped", INFINITY, 0}},
    .build = buildGears,
    .observe = watchGears,
    .measure = measureGears,
};
