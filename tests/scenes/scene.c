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

SceneBody *scene_addCapsule(SceneWorld *w, double mass, double radius, double length, double x, double y, double z) {
    SceneBody *b = addBody(w, SCENE_CAPSULE, mass, x, y, z);
    b->half[0] = b->half[1] = radius;
    b->half[2] = length / 2;
    return b;
}

SceneBody *scene_addCylinder(SceneWorld *w, double mass, double radius, double length, double x, double y, double z) {
    SceneBody *b = addBody(w, SCENE_CYLINDER, mass, x, y, z);
    b->half[0] = b->half[1] = radius;
    b->half[2] = length / 2;
    return b;
}

SceneBody *scene_addCompound(SceneWorld *w, double mass, const double inertia[3], double x, double y, double z) {
    SceneBody *b = addBody(w, SCENE_COMPOUND, mass, x, y, z);
    memcpy(b->inertia, inertia, sizeof b->inertia);
    b->parts = w->parts + w->numParts;
    return b;
}

void scene_addPart(SceneWorld *w, double lx, double ly, double lz, const double position[3], double turn) {
    SceneBody *b = &w->bodies[w->numBodies - 1];
    ScenePart *p = &w->parts[w->numParts++];
    *p = (ScenePart){.half = {lx / 2, ly / 2, lz / 2}, .quaternion = {cos(turn / 2), 0, 0, sin(turn / 2)}};
    memcpy(p->position, position, sizeof p->position);
    b->numParts++;
    const double c = fabs(cos(turn)), s = fabs(sin(turn));
    const double reach[3] = {c * p->half[0] + s * p->half[1], s * p->half[0] + c * p->half[1], p->half[2]};
    for (int i = 0; i < 3; i++)
        b->half[i] = fmax(b->half[i], fabs(position[i]) + reach[i]);
}

SceneJoint *scene_joinLast(SceneWorld *w, SceneJointKind kind, double x, double y, double z) {
    return scene_join(w, kind, w->numBodies - 1, w->numBodies > 1 ? w->numBodies - 2 : SCENE_WORLD, x, y, z);
}

SceneJoint *scene_join(SceneWorld *w, SceneJointKind kind, int child, int parent, double x, double y, double z) {
    SceneJoint *j = &w->joints[w->numJoints++];
    j->kind = kind;
    j->child = child;
    j->parent = parent;
    j->point[0] = x;
    j->point[1] = y;
    j->point[2] = z;
    j->axis[2] = 1;
    return j;
}

/* A cylinder of the length l, and two halves of a ball whose centres of mass are 3 r / 8 beyond its ends. */
static void capsuleInertia(const SceneBody *b, double inertia[3]) {
    const double r = b->half[0], l = 2 * (b->half[2] - r), share = l / (l + 4 * r / 3);
    const double cylinder = share * b->mass, ball = b->mass - cylinder;
    inertia[2] = cylinder * r * r / 2 + .4 * ball * r * r;
    inertia[0] = inertia[1] = cylinder * (r * r / 4 + l * l / 12) + ball * (.4 * r * r + l * l / 4 + 3 * l * r / 8);
}

static void cylinderInertia(const SceneBody *b, double inertia[3]) {
    const double r = b->half[0], l = 2 * b->half[2];
    inertia[2] = b->mass * r * r / 2;
    inertia[0] = inertia[1] = b->mass * (r * r / 4 + l * l / 12);
}

void scene_inertia(const SceneBody *b, double inertia[3]) {
    if (b->inertia[0] > 0) {
        memcpy(inertia, b->inertia, sizeof b->inertia);
        return;
    }
    if (b->shape == SCENE_CAPSULE) {
        capsuleInertia(b, inertia);
        return;
    }
    if (b->shape == SCENE_CYLINDER) {
        cylinderInertia(b, inertia);
        return;
    }
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

double scene_frame(const Scene *s) {
    return s->frame > 0 ? s->frame : SCENE_FRAME;
}

void scene_attachment(const SceneWorld *w, const SceneState states[], int body, const double point[3], double out[3]) {
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
        scene_attachment(w, states, w->joints[j].child, w->joints[j].point, a);
        scene_attachment(w, states, w->joints[j].parent, w->joints[j].point, b);
        for (int i = 0; i < 3; i++)
            a[i] -= b[i];
        worst = fmax(worst, sqrt(scene_dot(a, a)));
    }
    return worst;
}
