/* Residuals of an answer, in units of their tolerances, and the test of convergence.
 *
 *   velocity  for every row of the inner problem: the change of its impulse if it were solved alone (projected
 *             residual: 0 exactly if complementarity holds) times its A_ii, m/s; for an angular row rad/s times the
 *             size of the larger body
 *   position  for every position row: the part of its error that was to be corrected and is left, m; for an angular
 *             row rad
 *   momentum  for every body: B d + g - Jᵀ p, N s
 */
#include "kea_i.h"
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"

/* ---- position rows ---- */

/* m: the distance of a body's end position from the origin. */
static double endDistance(const MdtKeaSystem *s, int body) {
    return keaLength(s->work->end[body].position);
}

void kea_setErrorScales(MdtKeaSystem *s, int body) {
    const double h = s->parameters.stepsize;
    KeaBody *b = &s->work->body[body];
    b->errorScale[0] = h * keaLength(b->u) + kea_bodySizeShare * b->size + kea_roundingShare * endDistance(s, body);
    b->errorScale[1] = h * keaLength(b->u + 3);
}

/* Scale of a position row's error: the sum of its initial error, lever arms, the displacements of its bodies and
 * fractions of their size and, for rounding far from the origin, of their distance from it. For an angular row all of
 * these are angles. */
static double lengthScaleOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double size = fabs(row->error);
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const KeaBody *b = &s->work->body[row->body[k]];
        size += keaLength(row->J[k].ang);
        size += b->errorScale[keaDot(row->J[k].lin, row->J[k].lin) > 0 ? 0 : 1];
    }
    return size;
}

/* m or rad: the rounding of a row's attachments, which programs give in single precision. */
static double roundingOfRow(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double size = 0;
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        if (keaDot(row->J[k].lin, row->J[k].lin) == 0)
            return kea_attachmentRounding; /* of an angle */
        size += keaLength(row->arm[k]) + endDistance(s, row->body[k]);
    }
    return kea_attachmentRounding * size + DBL_MIN;
}

/* m or rad: the part of a position row's error that was to be corrected and is left; 0 if a bound of the row is the
 * reason. */
static double uncorrectedError(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    const double residual = s->parameters.stepsize * (p->r - p->E * p->p);
    const MeBool isKept = (p->p >= p->upper && residual > 0) || (p->p <= p->lower && residual < 0);
    return s->rows[i].position && !p->isInactive && !isKept ? fabs(residual) : 0;
}

double kea_uncorrectedOpening(const MdtKeaSystem *s) {
    double max = 0;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0)
            max = keaMax(max,
                         uncorrectedError(s, i) * kea_lengthOf(s, &s->rows[i]) / kea_smallerExtent(s, s->rows[i].body));
    return max;
}

/* The largest uncorrected error of a position row, relative to its scale, without inconsistent rows. Writes the largest
 * one in units of the rounding of attachments to `attachment`, and the largest in m to report.error. */
static double largestPositionError(MdtKeaSystem *s, double *attachment) {
    double worst = 0;
    *attachment = 0;
    s->report.error = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const double left = uncorrectedError(s, i);
        if (left == 0)
            continue;
        s->report.error = keaMax(s->report.error, left);
        *attachment = keaMax(*attachment, left / roundingOfRow(s, row));
        if (s->work->problem.row[i].isInconsistent)
            continue;
        worst = keaMax(worst, left / (lengthScaleOf(s, row) + DBL_MIN));
    }
    return worst;
}

/* ---- joints that contradict each other ---- */

/* Whether a row can be inconsistent. It can if it is a joint without bounds in reach, or a stop whose bodies friction
 * keeps in place: its impulse would grow from pass to pass until a contact slides. While the stop's error is below the
 * rounding of attachments, it counts as inconsistent with the contacts instead. */
static MeBool mayContradict(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    const KeaProblemRow *p = &s->work->problem.row[i];
    if (!row->position || !kea_mayReachBound(row))
        return row->position;
    return s->work->problem.hasFriction && p->p > p->lower && p->p < p->upper &&
           s->parameters.stepsize * fabs(p->r - p->E * p->p) < roundingOfRow(s, row);
}

/* Whether a pass has left more than half of a joint's residual, and this is above the tolerance. (It leaves nothing if
 * the row can be fulfilled, and everything if it contradicts others.) */
static MeBool isUnfulfilledByPass(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    if (!s->rows[i].position)
        return MEFALSE;
    const double required = p->r - p->E * p->p0, left = required - p->Jd - p->E * (p->p - p->p0);
    return fabs(left) > 0.5 * fabs(required) && mayContradict(s, i) &&
           s->parameters.stepsize * fabs(required) > kea_positionTolerance * lengthScaleOf(s, &s->rows[i]);
}

/* A joint is inconsistent if two passes in succession have left most of its residual. */
void kea_markInconsistentJoints(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        KeaProblemRow *p = &s->work->problem.row[i];
        const MeBool isUnmet = isUnfulfilledByPass(s, i);
        p->isInconsistent = isUnmet && p->isUnmet;
        p->isUnmet = isUnmet;
    }
}

/* m or rad: the residual of an inconsistent row; 0 for other rows. */
static double positionResidual(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    return p->isInconsistent && !p->isInactive ? s->parameters.stepsize * fabs(p->r - p->E * p->p) : 0;
}

MeBool kea_isInconsistent(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->work->problem.row[i].isInconsistent &&
            positionResidual(s, i) > kea_positionTolerance * lengthScaleOf(s, &s->rows[i]))
            return METRUE;
    return MEFALSE;
}

MeBool kea_isConflicting(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->work->problem.row[i].isInconsistent && positionResidual(s, i) > roundingOfRow(s, &s->rows[i]))
            return METRUE;
    return MEFALSE;
}

/* ---- a whole step ---- */

/* m/s: the change of a body's velocity by its loads in the step. */
static double changeByLoads(const MdtKeaSystem *s, int i) {
    double change[3];
    keaSubtract(change, s->predicted[i].lin, s->bodies[i]->velocity);
    return keaLength(change);
}

double kea_loadSpeed(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++)
        speed = keaMax(speed, changeByLoads(s, i));
    return speed;
}

double kea_minSpeedOfAll(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numBodies; i++)
        speed = keaMax(speed, kea_minSpeed(s->work->body[i].size, s->parameters.stepsize));
    return speed;
}

double kea_bodySpeedScale(const MdtKeaSystem *s) {
    double speed = kea_minSpeedOfAll(s);
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        speed = keaMax(speed, changeByLoads(s, i) + kea_ownSpeedShare * keaLength(s->predicted[i].lin) +
                                  kea_ownSpeedShare * b->size * keaLength(s->predicted[i].ang));
    }
    return speed;
}

double kea_rowSpeedScale(const MdtKeaSystem *s) {
    double speed = 0;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 && !s->rows[i].position)
            speed = keaMax(speed, kea_lengthOf(s, &s->rows[i]) * s->work->problem.row[i].Aii *
                                      fabs(s->work->problem.row[i].p));
    return speed;
}

double kea_roundingOfRates(const MdtKeaSystem *s) {
    double max = 0;
    for (int i = 0; i < s->work->numContacts; i++) {
        const KeaContact *c = &s->work->contact[i];
        double speed = 0;
        for (int k = 0; k < 2; k++)
            if (c->manifold->body[k] >= 0)
                speed += keaLength(s->work->body[c->manifold->body[k]].u + 3) * keaLength(c->arm[k]);
        max = keaMax(max, speed);
    }
    return kea_poseRounding * max;
}

KeaResiduals kea_residuals(MdtKeaSystem *s, double speed) {
    KeaResiduals e = {.resolution = kea_velocityTolerance, .worst = INFINITY};
    e.position = e.velocity = e.momentum = e.impulse = e.attachment = INFINITY;
    if (!(speed > 0)) /* trial poses have diverged so far that effective masses are not positive */
        return e;
    e.resolution = kea_velocityTolerance * speed;
    e.position = largestPositionError(s, &e.attachment) / kea_positionTolerance;
    e.velocity = kea_problemResidual(&s->work->problem, &e.impulse) / e.resolution;
    e.momentum = kea_problemError(&s->work->problem) / kea_momentumSlack;
    e.worst = keaMax(e.position, keaMax(e.momentum, e.velocity));
    return e;
}

MeBool kea_isConverged(const KeaResiduals *e) {
    return e->worst < 1;
}

MeBool kea_isMotionExactEnough(const KeaResiduals *e, double margin) {
    return e->position <= margin * kea_loosePosition && e->momentum <= margin * kea_loosePosition;
}

MeBool kea_isExactEnough(const KeaResiduals *e, double margin) {
    return kea_isMotionExactEnough(e, margin) && e->velocity <= margin * kea_looseVelocity;
}
