/* The spin of closed groups: of bodies that acting rows join with each other, and with nothing fixed.
 *
 * A step with θ = 1/2 conserves their angular momentum, as impulses act in the middle of the step. One with θ = 1,
 * x⁺ = x + h v⁺, does not:
 *
 *     Σ (x⁺ x m v⁺ - x x m v) = Σ x x m (v⁺ - v),   but impulses act at (x + x⁺)/2;
 *
 * nor do contacts whose points on both bodies move apart within the step. So a group in which a tied body has θ = 1
 * gets the rigid rotation that makes up for the difference. It changes no rate of a row between the group's bodies. All
 * momenta are about the centre of mass, which moves by its own law.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include <string.h>

enum { IS_OPEN = 1, IS_DAMPED = 2 }; /* of a group, by its root */

/* Whether a row's forces on its two bodies are opposite, or its torques if it has no forces; gears' are not. */
static MeBool isInternal(const KeaProblemRow *p) {
    double sum[3];
    if (p->body[0] < 0 || p->body[1] < 0)
        return MEFALSE;
    const int first = keaDot(p->J[0], p->J[0]) > 0 || keaDot(p->J[1], p->J[1]) > 0 ? 0 : 3;
    for (int k = 0; k < 3; k++)
        sum[k] = p->J[0][first + k] + p->J[1][first + k];
    return keaLength(sum) <= kea_unitRounding * keaLength(p->J[0] + first);
}

static MeBool isDamped(const MdtKeaSystem *s, int b) {
    return !s->work->body[b].isFree && kea_isMovedByU(s, b) && s->work->body[b].theta == 1;
}

static MeBool isAnyDamped(const MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++)
        if (isDamped(s, b))
            return METRUE;
    return MEFALSE;
}

/* Joins the bodies of acting rows (work->parent), and marks the groups (work->activeBody). */
static void findGroups(MdtKeaSystem *s) {
    int *parent = s->work->parent, *flags = s->work->activeBody;
    const KeaProblemRow *rows = s->work->problem.row;
    for (int b = 0; b < s->numBodies; b++) {
        parent[b] = b;
        flags[b] = 0;
    }
    for (int i = 0; i < s->numRows; i++)
        if (rows[i].p != 0 && rows[i].body[0] >= 0 && rows[i].body[1] >= 0)
            kea_unite(parent, rows[i].body[0], rows[i].body[1]);
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++)
            if (rows[i].p != 0 && rows[i].body[k] >= 0 && !isInternal(&rows[i]))
                flags[kea_rootOf(parent, rows[i].body[k])] |= IS_OPEN;
    for (int b = 0; b < s->numBodies; b++)
        if (s->work->body[b].locked)
            flags[kea_rootOf(parent, b)] |= IS_OPEN;
    for (int b = 0; b < s->numBodies; b++)
        if (isDamped(s, b))
            flags[kea_rootOf(parent, b)] |= IS_DAMPED;
}

/* Positions and velocities of a group: the velocity may be a change of velocity. */
typedef struct Motion {
    double mass, centre[3], velocity[3]; /* of the centre of mass */
} Motion;

static void addToMotion(Motion *g, double mass, const double x[3], const double v[3]) {
    const double share = mass / (g->mass + mass);
    g->mass += mass;
    for (int k = 0; k < 3; k++) {
        g->centre[k] += share * (x[k] - g->centre[k]);
        g->velocity[k] += share * (v[k] - g->velocity[k]);
    }
}

/* L += share (x - X) x m (v - V), about the centre of mass. */
static void addOrbit(double L[3], const Motion *g, double share, const double x[3], const double v[3]) {
    double r[3], relative[3], turn[3];
    keaSubtract(r, x, g->centre);
    keaSubtract(relative, v, g->velocity);
    keaCross(turn, r, relative);
    keaAddScaled(L, share, turn);
}

/* Position in the middle of the step, and change of velocity by loads. */
static void setLoad(const MdtKeaSystem *s, int b, double middle[3], double change[3]) {
    for (int k = 0; k < 3; k++)
        middle[k] = 0.5 * (s->bodies[b]->position[k] + s->work->end[b].position[k]);
    keaSubtract(change, s->predicted[b].lin, s->bodies[b]->velocity);
}

/* The angular momentum that the group is to have, less that which it has; and its inertia at the end. */
static void measureGroup(const MdtKeaSystem *s, int root, double residual[3], double inertia[3][3], Motion *end) {
    Motion start = {0}, load = {0};
    double middle[3], change[3], r[3], own[3][3];
    for (int b = 0; b < s->numBodies; b++) {
        if (kea_rootOf(s->work->parent, b) != root)
            continue;
        const double mass = 1 / s->bodies[b]->invMass;
        setLoad(s, b, middle, change);
        addToMotion(&start, mass, s->bodies[b]->position, s->bodies[b]->velocity);
        addToMotion(&load, mass, middle, change);
        addToMotion(end, mass, s->work->end[b].position, s->work->end[b].velocity);
    }
    for (int b = 0; b < s->numBodies; b++) {
        if (kea_rootOf(s->work->parent, b) != root)
            continue;
        const double mass = 1 / s->bodies[b]->invMass;
        setLoad(s, b, middle, change);
        addOrbit(residual, &start, mass, s->bodies[b]->position, s->bodies[b]->velocity);
        addOrbit(residual, &load, mass, middle, change);
        addOrbit(residual, end, -mass, s->work->end[b].position, s->work->end[b].velocity);
        keaAddScaled(residual, 1, s->work->body[b].freeMomentum);
        keaAddScaled(residual, -1, s->work->end[b].angularMomentum);
        keaSubtract(r, s->work->end[b].position, end->centre);
        kea_inertia(s->bodies[b], s->work->end[b].quaternion, own);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                inertia[i][j] += own[i][j] + mass * ((i == j ? keaDot(r, r) : 0) - r[i] * r[j]);
    }
}

/* Adds the rotation w about the centre to the end velocities of a group. */
static void rotateGroup(MdtKeaSystem *s, int root, const double centre[3], const double w[3]) {
    for (int b = 0; b < s->numBodies; b++) {
        KeaEnd *end = &s->work->end[b];
        double r[3], v[3], inertia[3][3], L[3];
        if (kea_rootOf(s->work->parent, b) != root)
            continue;
        keaSubtract(r, end->position, centre);
        keaCross(v, w, r);
        kea_inertia(s->bodies[b], end->quaternion, inertia);
        keaApply(L, (const double(*)[3])inertia, w);
        keaAddScaled(end->velocity, 1, v);
        keaAddScaled(end->angularMomentum, 1, L);
        keaAddScaled(s->work->body[b].endVelocity, 1, v);
        keaAddScaled(s->work->body[b].endVelocity + 3, 1, w);
    }
}

void kea_keepSpin(MdtKeaSystem *s) {
    if (s->parameters.timed || !isAnyDamped(s))
        return;
    findGroups(s);
    for (int b = 0; b < s->numBodies; b++) {
        double residual[3] = {0}, inertia[3][3] = {{0}}, inverse[3][3], w[3];
        Motion end = {0};
        if (s->work->parent[b] != b || s->work->activeBody[b] != IS_DAMPED)
            continue;
        measureGroup(s, b, residual, inertia, &end);
        kea_invert(inverse, (const double(*)[3])inertia);
        keaApply(w, (const double(*)[3])inverse, residual);
        if (isfinite(keaLength(w)))
            rotateGroup(s, b, end.centre, w);
    }
}
