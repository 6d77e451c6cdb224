/* Scenes of the map of stability: a load, a count and a stiffness that bench varies over decades. An error beyond its
 * bound means that the setting does not hold. */
#include "scenes_i.h"

#include <math.h>

static const double linkLength = .5, lean = PI / 6; /* m, rad */

/* The errors: largest gap / length of a link, energy gained / (all weights x length of the chain). */
static void buildChain(const Scene *s, SceneWorld *w) {
    const double along[2] = {sin(lean), -cos(lean)};
    scenes_setDown(w);
    for (int i = 0; i < s->count; i++) {
        const double from = i * linkLength, middle = from + linkLength / 2;
        const double mass = i + 1 < s->count ? 1 : s->parameter;
        SceneBody *b = scene_addBox(w, mass, .1, linkLength, .1, middle * along[0], middle * along[1], 0);
        b->start.quaternion[0] = cos(lean / 2);
        b->start.quaternion[3] = sin(lean / 2);
        scene_joinLast(w, SCENE_BALL_JOINT, from * along[0], from * along[1], 0);
    }
}

static void watchChain(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    double mass = 0;
    (void)time;
    for (int i = 0; i < w->numBodies; i++)
        mass += w->bodies[i].mass;
    const double gained = (scene_energy(w, states) - t->energy) / (mass * GRAVITY * linkLength * w->numBodies);
    scenes_note(t, 0, scene_gap(w, states) / linkLength);
    scenes_note(t, 1, isnan(gained) ? gained : fmax(gained, 0));
}

/* The errors: deepest overlap, largest way to the side. */
static void buildTower(const Scene *s, SceneWorld *w) {
    scenes_setDown(w);
    w->collides = true;
    for (int i = 0; i < s->count; i++)
        scene_addBox(w, i + 1 < s->count ? 1 : s->parameter, 1, 1, 1, 0, i + .5, 0)->friction = .5;
}

static void watchTower(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        const double below = i > 0 ? states[i - 1].position[1] + .5 : 0;
        scenes_note(t, 0, fmax(0, below + .5 - states[i].position[1]));
        scenes_note(t, 1, hypot(states[i].position[0], states[i].position[2]));
    }
}

/* Each hinge is bent by a spring against the force at the tip, so that the level beam is in balance. */
static void buildBeam(const Scene *s, SceneWorld *w) {
    const double force = 10. / s->count, turn = 2 * PI * s->parameter;
    for (int i = 0; i < s->count; i++) {
        const double inertia = linkLength * linkLength / 3, arm = (s->count - i - .5) * linkLength;
        SceneBody *b = scene_addBox(w, 1, linkLength, .1, .1, (i + .5) * linkLength, 0, 0);
        SceneJoint *j = scene_joinLast(w, SCENE_HINGE, i * linkLength, 0, 0);
        j->stiffness = inertia * turn * turn;
        j->damping = .2 * inertia * turn;
        j->rest = force * arm / j->stiffness;
        b->force[1] = i + 1 < s->count ? 0 : -force;
    }
}

/* The errors: largest gap / length of a link, largest way of the tip / length of the beam. */
static void watchBeam(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    const int tip = w->numBodies - 1;
    double way = 0;
    (void)time;
    for (int i = 0; i < 3; i++)
        way = hypot(way, states[tip].position[i] - w->bodies[tip].start.position[i]);
    scenes_note(t, 0, scene_gap(w, states) / linkLength);
    scenes_note(t, 1, way / (linkLength * w->numBodies));
}

const Scene scenes_mapChain = {
    .name = "chain",
    .text = "links of .5 m and 1 kg, the last one heavier, let go at 30 degrees: no joint opens by more than 1 % of a "
            "link, no energy is gained",
    .duration = 5,
    .frame = SCENE_MAP_FRAME,
    .errors = {{"gap", .01, 0}, {"gain", .01, 0}},
    .build = buildChain,
    .observe = watchChain,
    .measure = scenes_copyWorst,
};
const Scene scenes_mapTower = {
    .name = "tower",
    .text = "cubes of 1 m and 1 kg, the top one heavier: none overlaps by more than 2 cm or moves aside by 5 cm",
    .duration = 5,
    .frame = SCENE_MAP_FRAME,
    .errors = {{"overlap m", .02, 0}, {"side m", .05, 0}},
    .build = buildTower,
    .observe = watchTower,
    .measure = scenes_copyWorst,
};
const Scene scenes_mapBeam = {
    .name = "beam",
    .text = "links of .5 m and 1 kg on hinges with damped springs, in balance with a force at the tip: the tip stays "
            "within 1 % of the length, no joint opens by more than 1 % of a link",
    .duration = 5,
    .frame = SCENE_MAP_FRAME,
    .errors = {{"gap", .01, 0}, {"tip", .01, 0}},
    .build = buildBeam,
    .observe = watchBeam,
    .measure = scenes_copyWorst,
};
