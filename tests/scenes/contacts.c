/* Contacts of a scene's bodies: corners and spheres on the ground, spheres against each other, and faces of boxes
 * clipped against each other. */
#include "contacts.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef struct Found {
    SceneContact *contacts;
    int count;
} Found;

static void add(Found *f, const SceneWorld *w, int body, int other, const double point[3], const double normal[3],
                double depth) {
    if (f->count == SCENE_MAX_CONTACTS)
        return;
    const SceneBody *a = &w->bodies[body], *b = other == SCENE_WORLD ? NULL : &w->bodies[other];
    SceneContact *c = &f->contacts[f->count++];
    c->body = body;
    c->other = other;
    memcpy(c->point, point, sizeof c->point);
    memcpy(c->normal, normal, sizeof c->normal);
    c->depth = depth;
    c->radius[0] = a->shape == SCENE_SPHERE ? a->half[0] : 0;
    c->radius[1] = b && b->shape == SCENE_SPHERE ? b->half[0] : 0;
    c->friction = b ? fmax(a->friction, b->friction) : a->friction;
    c->restitution = b ? fmax(a->restitution, b->restitution) : a->restitution;
}

static double smallestHalf(const SceneBody *b) {
    return fmin(b->half[0], fmin(b->half[1], b->half[2]));
}

static double size(const double v[3]) {
    return sqrt(scene_dot(v, v));
}

/* How near something must be to count: what the body may move, and a little. */
static double reachOf(const SceneBody *b, const SceneState *s, double h) {
    return .02 * smallestHalf(b) + h * (size(s->velocity) + size(s->spin) * size(b->half));
}

/* The ground */

static void sphereOnGround(Found *f, const SceneWorld *w, int i, const SceneState *s, double reach) {
    const double up[3] = {0, 1, 0}, point[3] = {s->position[0], 0, s->position[2]};
    const double depth = w->bodies[i].half[0] - s->position[1];
    if (depth > -reach)
        add(f, w, i, SCENE_WORLD, point, up, depth);
}

static void boxOnGround(Found *f, const SceneWorld *w, int i, const SceneState *s, double reach) {
    const double up[3] = {0, 1, 0}, *half = w->bodies[i].half;
    for (int k = 0; k < 8; k++) {
        double p[3] = {k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]};
        scene_rotate(s->quaternion, p, p);
        for (int c = 0; c < 3; c++)
            p[c] += s->position[c];
        const double depth = -p[1];
        p[1] = 0;
        if (depth > -reach)
            add(f, w, i, SCENE_WORLD, p, up, depth);
    }
}

/* Spheres */

static void sphereOnSphere(Found *f, const SceneWorld *w, int i, int j, const SceneState states[], double reach) {
    const double *a = states[i].position, *b = states[j].position;
    const double radii[2] = {w->bodies[i].half[0], w->bodies[j].half[0]};
    double normal[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, point[3];
    const double distance = size(normal), depth = radii[0] + radii[1] - distance;
    if (depth <= -reach || distance <= 0)
        return;
    for (int c = 0; c < 3; c++) {
        normal[c] /= distance;
        point[c] = b[c] + (radii[1] - depth / 2) * normal[c];
    }
    add(f, w, i, j, point, normal, depth);
}

/* Boxes */

typedef struct Box {
    const double *centre, *half;
    double axes[3][3];
} Box;

static Box boxAt(const SceneBody *b, const SceneState *s) {
    Box box = {.centre = s->position, .half = b->half};
    for (int i = 0; i < 3; i++) {
        double unit[3] = {0, 0, 0};
        unit[i] = 1;
        scene_rotate(s->quaternion, unit, box.axes[i]);
    }
    return box;
}

static double extent(const Box *b, const double direction[3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += b->half[i] * fabs(scene_dot(b->axes[i], direction));
    return sum;
}

/* The face of `from`, outward towards `to`, in whose direction the two are the farthest apart. */
static double separation(const Box *from, const Box *to, int *face, double outward[3]) {
    double best = -INFINITY, between[3];
    for (int c = 0; c < 3; c++)
        between[c] = to->centre[c] - from->centre[c];
    for (int i = 0; i < 3; i++) {
        const double along = scene_dot(between, from->axes[i]);
        const double gap = fabs(along) - from->half[i] - extent(to, from->axes[i]);
        if (gap <= best)
            continue;
        best = gap;
        *face = i;
        for (int c = 0; c < 3; c++)
            outward[c] = along < 0 ? -from->axes[i][c] : from->axes[i][c];
    }
    return best;
}

/* The four corners of the face of `b` that looks the most against `direction`. */
static int opposingFace(const Box *b, const double direction[3], double corners[][3]) {
    int face = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(scene_dot(b->axes[i], direction)) > fabs(scene_dot(b->axes[face], direction)))
            face = i;
    const double side = scene_dot(b->axes[face], direction) > 0 ? -1 : 1;
    const int u = (face + 1) % 3, v = (face + 2) % 3;
    for (int k = 0; k < 4; k++) {
        const double su = k == 1 || k == 2 ? 1 : -1, sv = k >= 2 ? 1 : -1;
        for (int c = 0; c < 3; c++)
            corners[k][c] = b->centre[c] + side * b->half[face] * b->axes[face][c] + su * b->half[u] * b->axes[u][c] +
                            sv * b->half[v] * b->axes[v][c];
    }
    return 4;
}

/* Cuts off what of the polygon is beyond the plane direction . (p - centre) = limit. */
static int clip(double points[][3], int n, const double centre[3], const double direction[3], double limit) {
    double kept[16][3], beyond[16];
    int count = 0;
    for (int i = 0; i < n; i++) {
        const double off[3] = {points[i][0] - centre[0], points[i][1] - centre[1], points[i][2] - centre[2]};
        beyond[i] = scene_dot(direction, off) - limit;
    }
    for (int i = 0; i < n; i++) {
        const int next = (i + 1) % n;
        if (beyond[i] <= 0)
            memcpy(kept[count++], points[i], sizeof kept[0]);
        if ((beyond[i] < 0 && beyond[next] > 0) || (beyond[i] > 0 && beyond[next] < 0)) {
            const double part = beyond[i] / (beyond[i] - beyond[next]);
            for (int c = 0; c < 3; c++)
                kept[count][c] = points[i][c] + part * (points[next][c] - points[i][c]);
            count++;
        }
    }
    memcpy(points, kept, (size_t)count * sizeof kept[0]);
    return count;
}

/* The opposing face of the one box, clipped by the sides of the reference face of the other. The tolerance keeps
 * corners of boxes that are aligned but for rounding. */
static void boxOnBox(Found *f, const SceneWorld *w, int i, int j, const SceneState states[], double reach) {
    const Box boxes[2] = {boxAt(&w->bodies[i], &states[i]), boxAt(&w->bodies[j], &states[j])};
    int faces[2] = {0, 0};
    double outward[2][3];
    const double gaps[2] = {separation(&boxes[0], &boxes[1], &faces[0], outward[0]),
                            separation(&boxes[1], &boxes[0], &faces[1], outward[1])};
    if (fmax(gaps[0], gaps[1]) > reach)
        return;
    const int r = gaps[1] > gaps[0] + 1e-3 * boxes[0].half[faces[0]];
    const Box *reference = &boxes[r], *other = &boxes[!r];
    const double *direction = outward[r], tolerance = 1e-6 * reference->half[0];
    double points[16][3];
    int n = opposingFace(other, direction, points);
    for (int side = 1; side <= 2; side++) {
        const int k = (faces[r] + side) % 3;
        const double *axis = reference->axes[k], back[3] = {-axis[0], -axis[1], -axis[2]};
        n = clip(points, n, reference->centre, axis, reference->half[k] + tolerance);
        n = clip(points, n, reference->centre, back, reference->half[k] + tolerance);
    }
    for (int k = 0; k < n; k++) {
        const double off[3] = {points[k][0] - reference->centre[0], points[k][1] - reference->centre[1],
                               points[k][2] - reference->centre[2]};
        const double depth = reference->half[faces[r]] - scene_dot(direction, off);
        if (depth > -reach)
            add(f, w, r ? i : j, r ? j : i, points[k], direction, depth);
    }
}

/* Pairs */

static double radiusAround(const SceneBody *b) {
    return b->shape == SCENE_SPHERE ? b->half[0] : size(b->half);
}

static void pair(Found *f, const SceneWorld *w, int i, int j, const SceneState states[], double reach) {
    const SceneBody *a = &w->bodies[i], *b = &w->bodies[j];
    const double *x = states[i].position, *y = states[j].position, off[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    const double limit = radiusAround(a) + radiusAround(b) + reach;
    if (scene_dot(off, off) > limit * limit)
        return;
    if (a->shape == SCENE_BOX && b->shape == SCENE_BOX)
        boxOnBox(f, w, i, j, states, reach);
    if (a->shape == SCENE_SPHERE && b->shape == SCENE_SPHERE)
        sphereOnSphere(f, w, i, j, states, reach);
}

int scene_contacts(const SceneWorld *w, const SceneState states[], double h,
                   SceneContact contacts[SCENE_MAX_CONTACTS]) {
    Found f = {contacts, 0};
    double reach[SCENE_MAX_BODIES];
    for (int i = 0; i < w->numBodies; i++) {
        reach[i] = reachOf(&w->bodies[i], &states[i], h);
        (w->bodies[i].shape == SCENE_SPHERE ? sphereOnGround : boxOnGround)(&f, w, i, &states[i], reach[i]);
    }
    for (int i = 0; i < w->numBodies; i++)
        for (int j = i + 1; j < w->numBodies; j++)
            pair(&f, w, i, j, states, reach[i] + reach[j]);
    return f.count;
}
