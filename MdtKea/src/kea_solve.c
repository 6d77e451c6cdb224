/* One step of one partition: solve the rows, renew what depends on the answer, and integrate. */
#include "kea_i.h"
#include <string.h>

/* Passes cost a back-substitution each while the set of active rows stays the same. */
static const int maxFrictionPasses = 20;
static const int maxPositionPasses = 10;
static const double leastContraction = 0.95;   /* of the position errors in a pass; with less the passes are given up */
static const double positionTolerance = 1e-10; /* of sizeOfRow */

static void loadRows(MdtKeaSystem *s) {
    KeaMlcp *p = &s->work->mlcp;
    p->n = s->numRows;
    p->maxIterations = s->parameters.maxIterations;
    for (int i = 0; i < s->numRows; i++) {
        MdtKeaRow *row = &s->rows[i];
        const double bound = kea_firstFrictionBound(s, row);
        p->E[i] = row->softness;
        p->lower[i] = fmax(row->lower, -bound);
        p->upper[i] = fmin(row->upper, bound);
        s->work->shift[i] = 0;
    }
    kea_mlcpBegin(p);
}

static void solveRows(MdtKeaSystem *s) {
    KeaMlcp *p = &s->work->mlcp;
    const double h = s->parameters.stepsize;
    for (int i = 0; i < s->numRows; i++)
        p->b[i] = (s->rows[i].target + s->work->shift[i] - s->work->freeRate[i]) / h;
    kea_mlcpSolve(p);
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = p->x[i];
    s->report.passes++;
}

/* What the error of a position row is compared with: the error it started with, its lever arms, the way that its bodies
 * move, and, for the rounding of places far from the origin, a little of their distance. */
static double sizeOfRow(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const double h = s->parameters.stepsize;
    double size = fabs(row->error);
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const KeaEnd *end = &s->work->end[row->body[k]];
        size += keaLength(row->J[k].ang) + h * keaLength(end->velocity) + 1e-4 * keaLength(end->position);
    }
    return size;
}

/* A force at its bound has given up the position, unless what is missing is the way that the bound leaves open: a stop
 * that did nothing, and is passed all the same. */
static MeBool canCorrect(const KeaMlcp *p, int i, double missing) {
    if (p->lower[i] >= p->upper[i])
        return MEFALSE;
    return p->set[i] == KEA_FREE || (p->set[i] == KEA_LOWER ? missing > 0 : missing < 0);
}

/* How far the position rows end from φ + h (s - h E λ), divided by h, into work->errors; the largest, relative to the
 * rows' sizes, is returned. The forces' first-order answer leaves an error of order (h ω)². */
static double positionErrors(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    double worst = 0;
    s->report.error = 0;
    s->errors(s->context, s->work->endPose, s->work->errors);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const double wanted = row->error + h * (row->target - h * row->softness * row->force);
        const double missing = wanted - s->work->errors[i];
        if (!row->position || !canCorrect(&s->work->mlcp, i, missing)) {
            s->work->errors[i] = 0;
            continue;
        }
        s->work->errors[i] = missing / h;
        s->report.error = fmax(s->report.error, fabs(missing));
        worst = fmax(worst, fabs(missing) / (sizeOfRow(s, row) + 1e-300));
    }
    return worst;
}

static MeBool hasPositionRows(const MdtKeaSystem *s) {
    for (int i = 0; s->errors && i < s->numRows; i++)
        if (s->rows[i].position)
            return METRUE;
    return MEFALSE;
}

static void shiftTargets(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->work->shift[i] += s->work->errors[i];
}

/* Newton's iteration for the position rows with the matrix of the start of the step: each pass turns what is missing
 * into velocity. It contracts by about h ω; where the motion is too violent for that, the first-order answer is kept.
 * */
static void correctPositions(MdtKeaSystem *s) {
    kea_moveWithForces(s);
    if (!hasPositionRows(s))
        return;
    double worst = positionErrors(s);
    for (int pass = 0; worst > positionTolerance && pass < maxPositionPasses; pass++) {
        const double before = worst;
        shiftTargets(s);
        solveRows(s);
        kea_renewFriction(s);
        kea_moveWithForces(s);
        worst = positionErrors(s);
        if (s->work->mlcp.regularized && worst > leastContraction * before)
            break; /* contradictory rows */
    }
    if (worst <= positionTolerance)
        return;
    s->report.violent = METRUE;
    memset(s->work->shift, 0, (size_t)s->numRows * sizeof(double));
    solveRows(s);
    kea_moveWithForces(s);
    positionErrors(s);
}

/* The largest violation of J v⁺ = s - h E λ that its bound does not explain. */
static double residual(const MdtKeaSystem *s) {
    const KeaMlcp *p = &s->work->mlcp;
    double worst = 0;
    for (int i = 0; i < s->numRows; i++) {
        const double w = kea_slip(s, i);
        if (p->scale[i] == 0 || (w > 0 && p->x[i] <= p->lower[i]) || (w < 0 && p->x[i] >= p->upper[i]))
            continue;
        worst = fmax(worst, fabs(w));
    }
    return worst;
}

void MEAPI MdtKeaSolve(MdtKeaSystem *s) {
    memset(&s->report, 0, sizeof s->report);
    if (s->numRows == 0) {
        kea_moveWithForces(s);
        return;
    }
    KeaMlcp *p = &s->work->mlcp;
    kea_assemble(s);
    kea_makeSprings(s);
    loadRows(s);
    do {
        solveRows(s);
    } while (kea_renewFriction(s) && s->report.passes < maxFrictionPasses);
    correctPositions(s);
    s->report.pivots = p->pivots;
    s->report.factorizations = p->factorizations;
    s->report.capped = p->capped;
    s->report.regularized = p->regularized;
    s->report.residual = residual(s);
}

/* Within the range of MeReal, which programs read the state in; false for NaN. */
static MeBool isInRange(const double *v, int n) {
    for (int i = 0; i < n; i++)
        if (!(fabs(v[i]) <= (double)MEINFINITY))
            return MEFALSE;
    return METRUE;
}

static MeBool mayCommit(const MdtKeaBody *body, const KeaEnd *end) {
    double w[3];
    if (!isInRange(end->position, 3) || !isInRange(end->quaternion, 4) || !isInRange(end->velocity, 3) ||
        !isInRange(end->angularMomentum, 3))
        return MEFALSE;
    kea_angularVelocity(body, end->quaternion, end->angularMomentum, w);
    return isInRange(w, 3);
}

static void commit(MdtKeaBody *body, const KeaEnd *end) {
    double w[3];
    const MeBool steady = !(body->flags & MdtKeaBodyFlagAddCoriolisForce);
    if (steady)
        kea_angularVelocity(body, body->quaternion, end->angularMomentum, w);
    keaCopy(body->position, end->position);
    memcpy(body->quaternion, end->quaternion, sizeof body->quaternion);
    keaCopy(body->velocity, end->velocity);
    keaCopy(body->angularMomentum, end->angularMomentum);
    if (steady)
        MdtKeaBodySetAngularVelocity(body, w);
}

MeBool MEAPI MdtKeaIntegrate(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (!mayCommit(s->bodies[i], &s->work->end[i]))
            return MEFALSE;
    for (int i = 0; i < s->numBodies; i++) {
        commit(s->bodies[i], &s->work->end[i]);
        s->pose[i] = s->work->endPose[i];
        keaCopy(s->velocity[i].lin, s->bodies[i]->velocity);
        MdtKeaBodyGetAngularVelocity(s->bodies[i], s->velocity[i].ang);
    }
    return METRUE;
}
