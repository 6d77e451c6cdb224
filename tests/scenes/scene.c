/* What all scenes share: building their worlds, and the energies and gaps of states. */
#include "scene.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

void scene_rotate(const double q[4], const double v[3], double out[3]) {
    const double t[3] = {2 * (q[2] * v[2] - q[3] * v[1]), 2 * (q[3] * v[0] - q[1] * v[2]),
                         2 * (q[1] * v[1] - q[2] * v[0])};
    const double r[3] = {v[0] + q[0] * t[0] + q[2] * t[2] - q[3] * t[1], v[1] + q[0] * t[1] + q[3] * t[0] - q[1] * t[2],
                         v[2] + q[0] * t[2] + q[1] * t[1] - q[2] * t[0]};
    memcpy(out, r, sizeof r);
}

void scene_rotateBack(const double q[4], const double v[3], double out[3]) {
    const double back[4] = {q[0], -q[1], -q[2], -q[3]};
    scene_rotate(back, v, out);
}

static SceneBody *addBody(SceneWorld *w, SceneShape shape, double mass, double x, double y, double z) {
    SceneBody *b = &w->bodies[w->numBodies++];
    b->shape = shape;
    b->mass = mass;
    b->start.position[0] = x;
    b->start.position[1] = y;
    b->start.position[2] = z;
    b->start.quaternion[0] = 1;
    return b;
}

SceneBody *scene_addBox(SceneWorld *w, double mass, double lx, double ly, double lz, double x, double y, double z) {
    SceneBody *b = addBody(w, SCENE_BOX, mass, x, y, z);
    b->half[0] = lx / 2;
    b->half[1] = ly / 2;
    b->half[2] = lz / 2;
    return b;
}

SceneBody *scene_addSphere(SceneWorld *w, double mass, double radius, double x, double y, double z) {
    SceneBody *b = addBody(w, SCENE_SPHERE, mass, x, y, z);
    b->half[0] = b->half[1] = b->half[2] = radius;
    return b;
}

SceneJoint *scene_joinLast(SceneWorld *w, SceneJointKind kind, double x, double y, double z) {
    SceneJoint *j = &w->joints[w->numJoints++];
    j->kind = kind;
    j->child = w->numBodies - 1;
    j->parent = w->numBodies > 1 ? w->numBodies - 2 : SCENE_WORLD;
    j->point[0] = x;
    j->point[1] = y;
    j->point[2] = z;
    j->axis[2] = 1;
    return j;
}

void scene_inertia(const SceneBody *b, double inertia[3]) {
    for (int i = 0; i < 3; i++) {
        const double p = b->half[(i + 1) % 3], q = b->half[(i + 2) % 3];
        inertia[i] = b->shape == SCENE_SPHERE ? .4 * b->mass * p * p : b->mass * (p * p + q * q) / 3;
    }
}

static double bodyEnergy(const SceneWorld *w, const SceneBody *b, const SceneState *s) {
    double inertia[3], spin[3];
    scene_inertia(b, inertia);
    scene_rotateBack(s->quaternion, s->spin, spin);
    double twice = b->mass * scene_dot(s->velocity, s->velocity);
    for (int i = 0; i < 3; i++)
        twice += inertia[i] * spin[i] * spin[i];
    return twice / 2 - b->mass * scene_dot(w->gravity, s->position);
}

double scene_energy(const SceneWorld *w, const SceneState states[]) {
    double sum = 0;
    for (int i = 0; i < w->numBodies; i++)
        sum += bodyEnergy(w, &w->bodies[i], &states[i]);
    return sum;
}

double scene_startEnergy(const SceneWorld *w) {
    double sum = 0;
    for (int i = 0; i < w->numBodies; i++)
        sum += bodyEnergy(w, &w->bodies[i], &w->bodies[i].start);
    return sum;
}

/* Where the body has taken the point that was at `point` at the start. */
static void attachment(const SceneWorld *w, const SceneState states[], int body, const double point[3], double out[3]) {
    memcpy(out, point, 3 * sizeof *out);
    if (body == SCENE_WORLD)
        return;
    const SceneState *start = &w->bodies[body].start, *now = &states[body];
    for (int i = 0; i < 3; i++)
        out[i] -= start->position[i];
    scene_rotateBack(start->quaternion, out, out);
    scene_rotate(now->quaternion, out, out);
    for (int i = 0; i < 3; i++)
        out[i] += now->position[i];
}

double scene_gap(const SceneWorld *w, const SceneState states[]) {
    double worst = 0;
    for (int j = 0; j < w->numJoints; j++) {
        double a[3], b[3];
        attachment(w, states, w->joints[j].child, w->joints[j].point, a);
        attachment(w, states, w->joints[j].parent, w->joints[j].point, b);
        for (int i = 0; i < 3; i++)
            a[i] -= b[i];
        worst = fmax(worst, sqrt(scene_dot(a, a)));
    }
    return worst;
}
