/* Rows of contacts (Dynamics guide ch. 3, "MdtContact").
 *
 * n is the normal, the direction in which the first body is pushed; t1 the primary direction, t2 = n x t1 the
 * secondary one. With r_k the vector from body k's centre to the contact, the row along d has J_0 = [d, r_0 x d],
 * J_1 = -[d, r_1 x d]: its rate is the velocity of body 0 relative to body 1 along d.
 *
 *   normal:   φ = -depth.   J v⁺ >= γ depth / h if the bodies overlap, >= -gap / h if they do not (speculative), and
 *             >= the rebound of the law of restitution (kea_restitution.c).   λ >= -adhesion.   E = ε + softness.
 *   friction: J v⁺ = slide - slip λ, |λ| <= bound or μ λ_n.   E = slip / h, without ε, which on a velocity row would be
 *             viscosity: bodies that friction holds would creep by h ε λ a second.
 *             Cone, for both directions: λ_1² + λ_2² <= (μ λ_n)², with the primary coefficient.
 *   rolling, spinning: J v⁺ = 0 with J_0 = [0, d], J_1 = [0, -d]; |λ| <= r λ_n, a cone for t1 and t2.
 *             Rows of friction exist only if the bodies touch, or may touch within the step.
 */
#include "exact/kea_contact_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

enum { PRIMARY = 1, SECONDARY = 2, ROLLING = 4, SPINNING = 8, SLIDING = PRIMARY | SECONDARY };

static MeBool hasFriction(const MdtKeaSurface *s, int direction) {
    return s->coefficient[direction] > 0 || s->bound[direction] > 0;
}

static int kindsOfFriction(const MdtKeaSurface *s) {
    return hasFriction(s, 0) * PRIMARY + hasFriction(s, 1) * SECONDARY + (s->rolling > 0) * ROLLING +
           (s->spinning > 0) * SPINNING;
}

/* ---- counting ---- */

static int countFriction(int kinds) {
    return !!(kinds & PRIMARY) + !!(kinds & SECONDARY) + 2 * !!(kinds & ROLLING) + !!(kinds & SPINNING);
}

void kea_contactChooseRows(const MdtKeaSystem *s, KeaContact *c) {
    kea_contactPlace(s, c);
    const KeaApproach approach = kea_approachOfPoint(s, c->manifold, (const double(*)[3])c->arm);
    const MeBool touches = kea_mayTouch(s, c->manifold->body, &approach, -c->depth);
    c->friction = touches ? kindsOfFriction(&c->manifold->surface) : 0;
    c->at->depthNow = c->depth;
    c->at->numRows =
        kea_isContactLocked(s, c->manifold, (const double(*)[3])c->arm) ? 0 : 1 + countFriction(c->friction);
}

static MeBool isPointLocked(const MdtKeaSystem *s, const MdtKeaManifold *m, int k) {
    double arm[2][3];
    if (!s->work->hasLocks)
        return MEFALSE;
    kea_armsTo(s, m, m->point[k].position, arm);
    return kea_isContactLocked(s, m, (const double(*)[3])arm);
}

static int countRowsOfManifolds(MdtKeaSystem *s) {
    int rows = 0;
    for (int i = 0; i < s->numManifolds; i++) {
        const int each = 1 + countFriction(kindsOfFriction(&s->manifolds[i].surface));
        for (int k = 0; k < s->manifolds[i].numPoints; k++)
            rows += s->manifolds[i].point[k].numRows = isPointLocked(s, &s->manifolds[i], k) ? 0 : each;
    }
    return rows;
}

int MEAPI MdtKeaCountContactRows(MdtKeaSystem *s) {
    int rows = 0, n = 0;
    if (s->parameters.solver == MdtKeaSolverFast)
        return countRowsOfManifolds(s);
    for (int i = 0; i < s->numManifolds; i++)
        for (int k = 0; k < s->manifolds[i].numPoints; k++) {
            KeaContact *c = &s->work->contact[n++];
            c->manifold = &s->manifolds[i];
            c->at = &s->manifolds[i].point[k];
            kea_contactChooseRows(s, c);
            rows += c->at->numRows;
        }
    MEASSERT(n <= s->maxContacts);
    s->work->numContacts = n;
    return rows;
}

/* ---- filling ---- */

static void contactJacobian(const double arm[2][3], const double d[3], MdtKeaJBlock J[2]) {
    for (int k = 0; k < 2; k++) {
        keaScale(J[k].lin, k == 0 ? 1 : -1, d);
        keaCross(J[k].ang, arm[k], J[k].lin);
    }
}

/* m/s: the part of a row's rate that comes from a velocity of the world's side; null: 0. */
static double worldRateBy(const KeaContact *c, const MdtKeaJBlock J[2], const MdtKeaVelocity *v) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (v && c->manifold->body[k] < 0)
            rate += keaDot(J[k].lin, v->lin) + keaDot(J[k].ang, v->ang);
    return rate;
}

/* The same by its present velocity (movers, conveyor belts). */
static double worldRate(const KeaContact *c, const MdtKeaJBlock J[2]) {
    return worldRateBy(c, J, c->manifold->worldVelocity);
}

/* Initializes a row with the Jacobian J. The rate of a moving world is known: with reversed sign it is part of the
 * target. */
static void startRow(const KeaContact *c, const MdtKeaJBlock J[2], int owner, double target, MdtKeaRow *row) {
    memset(row, 0, sizeof *row);
    for (int k = 0; k < 2; k++) {
        row->body[k] = c->manifold->body[k];
        row->J[k] = J[k];
    }
    row->drift = -worldRate(c, row->J);
    row->target = target + row->drift;
    row->lower = -HUGE_VAL;
    row->upper = HUGE_VAL;
    row->normal = row->partner = -1;
    row->contact = c->firstRow;
    row->owner = owner;
}

/* Initializes a row along d, which moves with the contact. */
static void startLinearRow(const KeaContact *c, const double d[3], int owner, double target, MdtKeaRow *row) {
    MdtKeaJBlock J[2];
    contactJacobian((const double(*)[3])c->arm, d, J);
    startRow(c, J, owner, target, row);
    row->moves = c->moves;
    row->rolls = c->rolls;
}

/* m/s: by how much the row's rate changes as the step begins, by the velocity of the contact's mover. */
static double jumpOf(const MdtKeaSystem *s, const KeaContact *c, const MdtKeaRow *row) {
    const MeBool isFirst = s->parameters.elapsed + s->parameters.late == 0;
    return c->manifold->mover && isFirst ? worldRateBy(c, row->J, &c->manifold->mover->jump) : 0;
}

static void normalRow(const MdtKeaSystem *s, const KeaContact *c, int owner, MdtKeaRow *row) {
    const MdtKeaParameters *p = &s->parameters;
    const MdtKeaSurface *surface = &c->manifold->surface;
    const double aim = c->depth > 0 ? p->gamma * c->depth : c->depth; /* m: smallest separation within the sub-step */
    startLinearRow(c, c->normal, owner, aim / p->stepsize, row);
    row->error = -c->depth;
    row->turning = kea_turningRate(s, c->manifold, (const double(*)[3])c->arm);
    for (int k = 0; k < 2; k++)
        row->radius[k] = c->manifold->radius[k];
    row->restitution = surface->restitution;
    row->threshold = surface->threshold;
    row->softness = p->epsilon + p->softening * surface->softness;
    row->lower = -surface->adhesion;
    row->force = c->at->guess[0];
    row->jump = jumpOf(s, c, row);
    MEASSERT(row->lower <= 0 && row->softness >= 0);
}

static void directionOf(const KeaContact *c, int direction, double d[3]) {
    if (direction == 0)
        keaCopy(d, c->direction);
    else
        keaCross(d, c->normal, c->direction);
    MEASSERT(fabs(keaDot(d, d) - 1) < kea_unitRounding);
}

static void frictionRow(const MdtKeaSystem *s, const KeaContact *c, int direction, int owner, MdtKeaRow *row) {
    const MdtKeaSurface *surface = &c->manifold->surface;
    double d[3];
    directionOf(c, direction, d);
    startLinearRow(c, d, owner, surface->slide[direction], row);
    row->jump = jumpOf(s, c, row);
    row->softness = surface->slip[direction] / s->parameters.stepsize;
    if (surface->coefficient[direction] > 0) {
        row->normal = c->firstRow;
        row->friction = surface->coefficient[direction];
    } else {
        row->upper = surface->bound[direction];
        row->lower = -row->upper;
    }
}

/* Makes a row of friction against rotation about d, with the bound r λ_n. It has no warm start. */
static void angularRow(const KeaContact *c, const double d[3], double r, int owner, MdtKeaRow *row) {
    MdtKeaJBlock J[2];
    memset(J, 0, sizeof J);
    keaCopy(J[0].ang, d);
    keaScale(J[1].ang, -1, d);
    startRow(c, J, owner, 0, row);
    row->normal = c->firstRow;
    row->friction = r;
}

/* Makes the rows of rolling and spinning friction from row `at` of the system on. Returns the index behind them. */
static int makeAngularRows(MdtKeaSystem *s, const KeaContact *c, int owner, int at) {
    const MdtKeaSurface *surface = &c->manifold->surface;
    if (c->friction & ROLLING) {
        for (int k = 0; k < 2; k++) {
            double d[3];
            directionOf(c, k, d);
            angularRow(c, d, surface->rolling, owner, &s->rows[at + k]);
            s->rows[at + k].partner = at + 1 - k;
        }
        at += 2;
    }
    if (c->friction & SPINNING)
        angularRow(c, c->normal, surface->spinning, owner, &s->rows[at++]);
    return at;
}

/* Warm start of friction: the force of the last step, rotated with the contact about the normal. */
static void warmStartFriction(const KeaContact *c, MdtKeaRow rows[]) {
    const int directions = c->friction & SLIDING;
    const double *guess = c->at->guess, angle = c->moves ? keaDot(c->turn, c->normal) : 0;
    const double cosine = cos(angle), sine = sin(angle);
    if (directions == SLIDING) {
        rows[0].force = cosine * guess[1] - sine * guess[2];
        rows[1].force = sine * guess[1] + cosine * guess[2];
    } else if (directions) {
        rows[0].force = guess[directions == PRIMARY ? 1 : 2];
    }
}

/* Index behind the contact's linear rows, which are its first ones. */
static int endOfLinearRows(const KeaContact *c) {
    return c->firstRow + 1 + countFriction(c->friction & SLIDING);
}

/* Sets the Jacobians of a contact's linear rows in the middle and at the end of the sub-step (s->moves). */
static void setMovedJacobians(MdtKeaSystem *s, const KeaContact *c, const double move[2][6]) {
    static const double share[2] = {0.5, 1};
    MEASSERT(c->firstRow + c->at->numRows <= s->numRows);
    for (int k = 0; k < 2; k++) {
        double arm[2][3];
        kea_contactArms(s, c, move, share[k], arm);
        for (int r = c->firstRow; r < endOfLinearRows(c); r++) {
            MdtKeaMove *moved = &s->moves[r][k];
            double direction[3];
            keaCopy(direction, s->rows[r].J[0].lin);
            kea_contactTurnDirection(s, c, move, share[k], direction);
            contactJacobian((const double(*)[3])arm, direction, moved->J);
            moved->rate = worldRate(c, moved->J) - worldRate(c, s->rows[r].J);
        }
    }
}

/* Replaces a contact's Jacobians by those in the middle of the sub-step. Returns whether its place changed. */
static MeBool replaceJacobians(MdtKeaSystem *s, const KeaContact *c) {
    const double slack = kea_velocityTolerance * kea_smallerExtent(s, c->manifold->body);
    double change2 = 0;
    for (int r = c->firstRow; r < endOfLinearRows(c); r++) {
        KeaProblemRow *p = &s->work->problem.row[r];
        double before[2][6];
        memcpy(before, p->J, sizeof before);
        kea_copyJacobian(s, p, s->moves[r][0].J);
        for (int k = 0; k < 2; k++) {
            double change[3];
            keaSubtract(change, p->J[k] + 3, before[k] + 3);
            change2 += keaDot(change, change);
        }
    }
    return change2 > slack * slack;
}

MeBool kea_moveContacts(MdtKeaSystem *s, MeBool isFirst) {
    MeBool isAny = MEFALSE;
    for (int i = 0; i < s->work->numContacts; i++) {
        const KeaContact *c = &s->work->contact[i];
        double move[2][6] = {{0}};
        if (!c->moves || c->at->numRows == 0 || (!isFirst && kea_isManifoldTied(s, c->manifold)))
            continue;
        for (int k = 0; k < 2; k++)
            if (c->manifold->body[k] >= 0)
                kea_moveVelocity(s, c->manifold->body[k], MEFALSE, move[k]);
        setMovedJacobians(s, c, (const double(*)[6])move);
        isAny |= replaceJacobians(s, c);
    }
    return isAny;
}

void kea_contactMakeRows(MdtKeaSystem *s, KeaContact *c, int owner) {
    const MdtKeaSurface *surface = &c->manifold->surface;
    MdtKeaRow *rows = &s->rows[s->numRows];
    c->friction = c->at->numRows > 1 ? c->friction : 0;
    c->firstRow = s->numRows;
    if (c->at->numRows == 0)
        return;
    kea_contactChooseMotion(s, c);
    normalRow(s, c, owner, rows);
    int count = 1;
    for (int direction = 0; direction < 2; direction++)
        if (c->friction & (direction == 0 ? PRIMARY : SECONDARY))
            frictionRow(s, c, direction, owner, &rows[count++]);
    if ((c->friction & SLIDING) == SLIDING && surface->isCone) {
        rows[1].partner = s->numRows + 2;
        rows[2].partner = s->numRows + 1;
    }
    warmStartFriction(c, rows + 1);
    s->numRows = makeAngularRows(s, c, owner, s->numRows + count);
    MEASSERT(s->numRows == c->firstRow + c->at->numRows && s->numRows <= s->maxRows);
}

void MEAPI MdtKeaMakeContactRows(MdtKeaSystem *s) {
    kea_markTied(s);
    if (s->parameters.solver == MdtKeaSolverFast)
        return;
    for (int i = 0; i < s->work->numContacts; i++)
        kea_contactMakeRows(s, &s->work->contact[i], -1 - i); /* owners of joints are counted from 0 */
}

/* ---- forces ---- */

void kea_contactAddForces(const MdtKeaSystem *s, const KeaContact *c) {
    int row = c->firstRow;
    if (c->at->numRows == 0)
        return;
    c->at->force[0] += s->rows[row++].force;
    for (int direction = 0; direction < 2; direction++)
        if (c->friction & (direction == 0 ? PRIMARY : SECONDARY))
            c->at->force[1 + direction] += s->rows[row++].force;
    MEASSERT(row == endOfLinearRows(c));
}

void kea_returnContactForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->work->numContacts; i++) {
        keaZero(s->work->contact[i].at->force);
        kea_contactAddForces(s, &s->work->contact[i]);
    }
}
