/* How deep bodies are in each other and in the ground: boxes by the directions of their faces and edges, balls and
 * capsules as a point or a segment with a radius. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

/* How deep two boxes are in each other: the least of what they overlap by along the 15 directions of faces and
 * edges. */
static double overlapAlong(const double axis[3], const double between[3], const double sides[2][3][3]) {
    const double size = sqrt(scene_dot(axis, axis));
    double sum = 0;
    if (size < 1e-6)
        return INFINITY;
    for (int k = 0; k < 6; k++)
        sum += fabs(scene_dot(axis, sides[k / 3][k % 3]));
    return (sum - fabs(scene_dot(axis, between))) / size;
}

static double ofBoxes(const SceneBody *a, const SceneState *p, const SceneBody *b, const SceneState *q) {
    const SceneBody *bodies[2] = {a, b};
    const SceneState *states[2] = {p, q};
    const double between[3] = {q->position[0] - p->position[0], q->position[1] - p->position[1],
                               q->position[2] - p->position[2]};
    double sides[2][3][3] = {{{0}}}, units[2][3][3] = {{{0}}}, min = INFINITY;
    for (int k = 0; k < 6; k++) {
        double *side = sides[k / 3][k % 3], *unit = units[k / 3][k % 3];
        unit[k % 3] = 1;
        scene_rotate(states[k / 3]->quaternion, unit, unit);
        for (int c = 0; c < 3; c++)
            side[c] = bodies[k / 3]->half[k % 3] * unit[c];
    }
    for (int k = 0; k < 6; k++)
        min = fmin(min, overlapAlong(units[k / 3][k % 3], between, sides));
    for (int k = 0; k < 9; k++) {
        const double *u = units[0][k / 3], *v = units[1][k % 3];
        const double cross[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        min = fmin(min, overlapAlong(cross, between, sides));
    }
    return min;
}

/* How far a point is from a box, or, negative, from its surface inside. */
static double boxDistance(const SceneBody *box, const SceneState *s, const double point[3]) {
    double local[3], outside = 0, inside = -INFINITY;
    for (int i = 0; i < 3; i++)
        local[i] = point[i] - s->position[i];
    scene_rotateBack(s->quaternion, local, local);
    for (int i = 0; i < 3; i++) {
        const double beyond = fabs(local[i]) - box->half[i];
        outside += beyond > 0 ? beyond * beyond : 0;
        inside = fmax(inside, beyond);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

/* The ends of a capsule's segment; a ball's are its centre. */
static void segment(const SceneBody *b, const SceneState *s, double ends[2][3]) {
    double along[3] = {0, 0, b->shape == SCENE_CAPSULE ? b->half[2] - b->half[0] : 0};
    scene_rotate(s->quaternion, along, along);
    for (int i = 0; i < 3; i++) {
        ends[0][i] = s->position[i] - along[i];
        ends[1][i] = s->position[i] + along[i];
    }
}

static void pointAt(double ends[2][3], double t, double point[3]) {
    for (int i = 0; i < 3; i++)
        point[i] = (1 - t) * ends[0][i] + t * ends[1][i];
}

/* The distance along a segment is convex: thirds of it are left out until nothing is. */
static double minAlong(double ends[2][3], double (*distance)(const void *of, const double point[3]), const void *of) {
    double low = 0, high = 1, point[3];
    for (int i = 0; i < 60 && high - low > 1e-9; i++) {
        const double t1 = low + (high - low) / 3, t2 = high - (high - low) / 3;
        pointAt(ends, t1, point);
        const double d1 = distance(of, point);
        pointAt(ends, t2, point);
        if (d1 < distance(of, point))
            high = t2;
        else
            low = t1;
    }
    pointAt(ends, (low + high) / 2, point);
    return distance(of, point);
}

typedef struct Placed {
    const SceneBody *body;
    const SceneState *state;
} Placed;

static double distanceToBox(const void *of, const double point[3]) {
    const Placed *box = of;
    return boxDistance(box->body, box->state, point);
}

static double distanceToSegment(const void *of, const double point[3]) {
    const double(*ends)[3] = of;
    double along[3], off[3];
    for (int i = 0; i < 3; i++) {
        along[i] = ends[1][i] - ends[0][i];
        off[i] = point[i] - ends[0][i];
    }
    const double square = scene_dot(along, along);
    const double t = square > 0 ? fmin(fmax(scene_dot(off, along) / square, 0), 1) : 0;
    for (int i = 0; i < 3; i++)
        off[i] -= t * along[i];
    return sqrt(scene_dot(off, off));
}

static double ofRound(const SceneBody *a, const SceneState *p, const SceneBody *b, const SceneState *q) {
    double ends[2][3], others[2][3];
    segment(a, p, ends);
    if (b->shape == SCENE_BOX) {
        const Placed box = {b, q};
        return a->half[0] - minAlong(ends, distanceToBox, &box);
    }
    segment(b, q, others);
    return a->half[0] + b->half[0] - minAlong(ends, distanceToSegment, others);
}

double scenes_overlap(const SceneBody *a, const SceneState *p, const SceneBody *b, const SceneState *q) {
    if (a->shape != SCENE_BOX)
        return ofRound(a, p, b, q);
    return b->shape != SCENE_BOX ? ofRound(b, q, a, p) : ofBoxes(a, p, b, q);
}

static double cylinderBelow(const SceneBody *b, const SceneState *s) {
    double axis[3] = {0, 0, 1};
    scene_rotate(s->quaternion, axis, axis);
    return b->half[2] * fabs(axis[1]) + b->half[0] * hypot(axis[0], axis[2]) - s->position[1];
}

double scenes_below(const SceneBody *b, const SceneState *s) {
    double ends[2][3], reach = 0;
    if (b->shape == SCENE_CYLINDER)
        return cylinderBelow(b, s);
    if (b->shape != SCENE_BOX) {
        segment(b, s, ends);
        return b->half[0] - fmin(ends[0][1], ends[1][1]);
    }
    for (int i = 0; i < 3; i++) {
        double unit[3] = {0, 0, 0};
        unit[i] = 1;
        scene_rotate(s->quaternion, unit, unit);
        reach += b->half[i] * fabs(unit[1]);
    }
    return reach - s->position[1];
}

static bool areJoined(const SceneWorld *w, int a, int b) {
    for (int i = 0; i < w->numJoints; i++) {
        const SceneJoint *j = &w->joints[i];
        if ((j->child == a && j->parent == b) || (j->child == b && j->parent == a))
            return true;
    }
    return false;
}

static bool areNear(const SceneBody *a, const SceneState *p, const SceneBody *b, const SceneState *q) {
    const double d[3] = {p->position[0] - q->position[0], p->position[1] - q->position[1],
                         p->position[2] - q->position[2]};
    const double reach = sqrt(scene_dot(a->half, a->half)) + sqrt(scene_dot(b->half, b->half));
    return scene_dot(d, d) < reach * reach;
}

double scenes_deepest(const SceneWorld *w, const SceneState states[]) {
    double deep = 0;
    for (int i = 0; i < w->numBodies; i++) {
        const SceneBody *a = &w->bodies[i];
        if (a->mass > 0)
            deep = fmax(deep, scenes_below(a, &states[i]));
        for (int j = 0; j < i; j++) {
            const SceneBody *b = &w->bodies[j];
            if ((a->mass > 0 || b->mass > 0) && areNear(a, &states[i], b, &states[j]) && !areJoined(w, i, j))
                deep = fmax(deep, scenes_overlap(a, &states[i], b, &states[j]));
        }
    }
    return deep;
}
