/* What the rows of a system ask of the unknowns of a step (kea_scheme.c), pass by pass.
 *
 * With d what a pass adds to u, p the impulses, φ_k and v_k⁺ what the last pass came to, every row is J d + E p = r:
 *
 *   position:  φ⁺ = φ_0 + h (s - E p)             r = s - (φ_k - φ_0)/h
 *   spring:    p = -h [kp φ_0 + (θ h kp + kd)(J u - s)],  1/E = θ h² kp + h kd,   r = s - J u_k - E h kp φ_0;
 *              one that only pushes and has the way φ_0 > 0 left is not strained at the start: (1 - θ) φ_0 less
 *   velocity:  J v⁺ = s - E p, v⁺ = v + (u - v)/θ     r = θ (s - J v_k⁺), E := θ E
 *
 * The velocity v⁺ is, to second order, that of the time h/2θ: of the middle of the step with θ = 1, of its end
 * with 1/2. So the rate J v⁺ of a contact is asked for where its place is then; impulses act at the mean, as those of
 * joints do. With θ = 1, where v⁺ = u, what friction holds is met in place: a box on a turning disc goes round with it.
 * With 1/2 the rates at both ends are met, which is the same forwards and backwards in time.
 *
 * θ is a choice of each body's. It is 1 where a contact can act or a limit does, so that they hold v⁺ and not only the
 * mean of the step, and where a spring is too stiff to be followed; it is one and the same for the two bodies of a
 * velocity row, which would not be symmetric otherwise.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static double rateWith(const MdtKeaRow *row, const MdtKeaVelocity *velocity) {
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const MdtKeaVelocity *v = &velocity[row->body[k]];
        rate += keaDot(row->J[k].lin, v->lin) + keaDot(row->J[k].ang, v->ang);
    }
    return rate;
}

/* ---- theta ---- */

/* Whether the normal row of a contact may carry something in this step. */
static MeBool isWithinReach(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double size = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            size = keaMax(size, s->work->body[row->body[k]].size);
    const double speed = keaMin(rateWith(row, s->velocity), rateWith(row, s->predicted));
    const double h = s->parameters.stepsize, gap = row->error + h * keaMax(speed, 0); /* at best, if it is being left */
    return row->lower < 0 || gap < kea_nearbyGap * size || row->error + kea_reach * h * speed < 0;
}

static void setTheta(MdtKeaSystem *s, const MdtKeaRow *row) {
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            s->work->body[row->body[k]].theta = 1;
}

static double thetaOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double theta = 0.5;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            theta = keaMax(theta, s->work->body[row->body[k]].theta);
    return theta;
}

static MeBool hasOneTheta(const MdtKeaSystem *s, const MdtKeaRow *row) {
    return row->body[0] < 0 || row->body[1] < 0 ||
           s->work->body[row->body[0]].theta == s->work->body[row->body[1]].theta;
}

static double inverseMassOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double sum = 0, turn[3];
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const MdtKeaInverseMassMatrix *m = &s->invMass[row->body[k]];
        keaApply(turn, m->inertia, row->J[k].ang);
        sum += m->mass * keaDot(row->J[k].lin, row->J[k].lin) + keaDot(turn, row->J[k].ang);
    }
    return sum;
}

MeBool kea_isTooStiff(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const double h = s->parameters.stepsize;
    return row->spring && h * h * row->stiffness * inverseMassOf(s, row) > kea_stiffSpring;
}

static void spreadTheta(MdtKeaSystem *s) {
    for (MeBool changed = METRUE; changed;) {
        changed = MEFALSE;
        for (int i = 0; i < s->numRows; i++) {
            const MdtKeaRow *row = &s->rows[i];
            if (row->position || row->spring || s->work->problem.row[i].isOff || hasOneTheta(s, row))
                continue;
            setTheta(s, row);
            changed = METRUE;
        }
    }
}

static void chooseTheta(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].theta = 0.5;
    for (int i = 0; i < s->numRows && !s->parameters.timed; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const MeBool holds = row->contact == i ? !s->work->problem.row[i].isOff
                                               : row->position && kea_mayReachBound(row) && row->force != 0 &&
                                                     rateWith(row, s->velocity) <= 0;
        if (holds || kea_isTooStiff(s, row))
            setTheta(s, row);
    }
    spreadTheta(s);
}

/* ---- begin ---- */

static void copyBounds(KeaProblemRow *p, const MdtKeaRow *row, double h) {
    p->lower = h * row->lower;
    p->upper = h * row->upper;
}

static void copyJacobian(KeaProblemRow *p, const MdtKeaJBlockPair J) {
    for (int k = 0; k < 2; k++) {
        keaCopy(p->J[k], J[k].lin);
        keaCopy(p->J[k] + 3, J[k].ang);
    }
}

static MeBool isIdle(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (row->contact >= 0)
        return s->rows[row->contact].isOpen || (!s->parameters.timed && !isWithinReach(s, &s->rows[row->contact]));
    return row->spring && !(row->stiffness > 0) && !(row->damping > 0);
}

/* Cold start of the friction bound: none, so that the answer sticks, or shows where it slides to; 0 where the slip is
 * more than friction could stop. */
static double firstBound(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const KeaProblemRow *normal = &s->work->problem.row[row->normal];
    if (normal->p > 0 || row->isForced) /* forced: where it slides to is known */
        return row->friction * keaMax(normal->p, 0);
    const double along = rateWith(row, s->predicted) - row->target;
    const double across =
        row->partner >= 0 ? rateWith(&s->rows[row->partner], s->predicted) - s->rows[row->partner].target : 0;
    const double approach = -rateWith(&s->rows[row->normal], s->predicted);
    return keaHypotenuse(along, across) > row->friction * keaMax(approach, 0) ? 0 : HUGE_VAL;
}

void kea_beginRows(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        KeaProblemRow *p = &s->work->problem.row[i];
        MEASSERT(row->body[0] < s->numBodies && row->body[1] < s->numBodies && row->body[0] != row->body[1]);
        MEASSERT(!(row->softness < 0) && (row->normal >= 0 || row->isForced || !(row->lower > row->upper)));
        MEASSERT(row->normal < 0 || (s->rows[row->normal].normal < 0 && row->friction >= 0));
        MEASSERT(row->partner < 0 || s->rows[row->partner].partner == i);
        p->body[0] = row->body[0];
        p->body[1] = row->body[1];
        p->normal = row->normal;
        p->partner = row->partner;
        p->friction = row->friction;
        copyBounds(p, row, h);
        copyJacobian(p, row->moves ? s->moves[i][0].J : row->J);
        s->work->ahead[i] = 0;
        p->isOff = isIdle(s, row);
        p->isOut = row->contact >= 0 && s->rows[row->contact].isOpen;
        p->p = p->p0 = p->isOff || !isfinite(row->force) ? 0 : keaMin(keaMax(h * row->force, p->lower), p->upper);
        p->state = KEA_HELD;
        p->isInconsistent = p->isUnmet = MEFALSE;
        p->isElsewhere = row->position;
        p->isForced = row->isForced;
        p->forced = row->forced;
        p->frictionBound = row->normal >= 0 ? firstBound(s, row) : 0;
    }
    chooseTheta(s);
}

MeBool kea_admitContacts(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    MeBool admitted = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->position && kea_mayReachBound(row) && !row->bounces && s->work->problem.row[i].p != 0 &&
            thetaOf(s, row) < 1) {
            setTheta(s, row);
            admitted = METRUE;
        }
        if (row->contact != i || !s->work->problem.row[i].isOff || row->isOpen)
            continue;
        if (row->error + h * kea_endRate(s, i) >= 0)
            continue;
        for (int k = i; k < s->numRows && s->rows[k].contact == i; k++)
            s->work->problem.row[k].isOff = MEFALSE;
        setTheta(s, row);
        admitted = METRUE;
    }
    if (admitted)
        spreadTheta(s);
    return admitted;
}

/* ---- every pass ---- */

void kea_refreshRows(MdtKeaSystem *s, const MdtKeaTransformation poses[], MeBool withBounds) {
    if (s->jacobians)
        s->jacobians(s->context, poses);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0)
            copyJacobian(&s->work->problem.row[i], s->rows[i].J);
    for (int i = 0; withBounds && i < s->numRows; i++)
        copyBounds(&s->work->problem.row[i], &s->rows[i], s->parameters.stepsize);
}

static double rateAhead(const MdtKeaSystem *s, int i) {
    const MdtKeaMove *mean = &s->moves[i][0], *end = &s->moves[i][1];
    double rate = s->parameters.timed ? end->rate : mean->rate;
    for (int k = 0; k < 2 && s->parameters.timed; k++) {
        if (s->rows[i].body[k] < 0)
            continue;
        const double *v = s->work->body[s->rows[i].body[k]].endVelocity;
        double turn[3];
        keaSubtract(turn, end->J[k].ang, mean->J[k].ang);
        rate += keaDot(turn, v + 3);
    }
    return rate;
}

void kea_rateAhead(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].moves)
            s->work->ahead[i] = rateAhead(s, i);
}

/* By the way that d makes the body turn at the end, over h. */
static void tangentOf(double tangent[6], const MdtKeaJBlock *J, const double w[3], double h) {
    double D[3][3];
    kea_turnDerivative(D, w, h);
    keaCopy(tangent, J->lin);
    keaApplyTransposed(tangent + 3, (const double(*)[3])D, J->ang);
    keaScale(tangent + 3, 1 / h, tangent + 3);
}

void kea_differentiateRows(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_keepRows(s);
    if (s->jacobians)
        s->jacobians(s->context, s->work->endPose);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (!row->position && !row->spring)
            memcpy(q->tangent[i], q->row[i].J, sizeof q->row[i].J);
        for (int k = 0; k < 2 && (row->position || row->spring); k++)
            if (row->body[k] >= 0)
                tangentOf(q->tangent[i][k], &row->J[k], s->work->body[row->body[k]].u + 3, s->parameters.stepsize);
    }
    kea_recallRows(s);
}

static void springRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize, theta = thetaOf(s, row);
    const double slack = row->lower == 0 ? keaMax(row->error, 0) : 0;
    p->E = 1 / (theta * h * h * row->stiffness + h * row->damping);
    p->r = row->target - kea_meanRate(s, i) - p->E * h * row->stiffness * (row->error - (1 - theta) * slack);
    p->N = 0;
}

/* A row's A_ii without lever arms, so that joints that share a load share it evenly. */
static double ownSize(const MdtKeaSystem *s, const KeaProblemRow *p) {
    double sum = 0;
    for (int k = 0; k < 2; k++)
        if (p->body[k] >= 0)
            sum += keaDot(p->J[k], p->J[k]) / s->work->problem.metric[p->body[k]].linear;
    return sum > 0 ? sum : p->size;
}

static void positionRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize;
    p->E = row->softness;
    p->r = row->target - (s->work->endErrors[i] - row->error) / h;
    const MeBool mayContradict = s->work->hasLoops && !s->work->problem.hasTangent;
    p->N = (kea_mayReachBound(row) || mayContradict ? kea_proximalLimit : kea_proximalJoint) * ownSize(s, p);
}

/* A contact that is met in time keeps no velocity from being pushed apart (kea_project does that), but a soft one sinks
 * only until γ of its overlap balances its load. */
static double timedTarget(const MdtKeaRow *row, const KeaProblemRow *p) {
    if (row->lower < 0) /* it may pull */
        return row->target;
    return row->drift + keaMin(keaMax(row->target - row->drift, 0), row->softness * keaMax(p->p, 0));
}

static void velocityRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const int level = s->work->problem.counts.level;
    const MdtKeaRow *row = &s->rows[i];
    const double theta = thetaOf(s, row);
    p->E = theta * row->softness;
    p->r = theta * ((s->parameters.timed && row->contact == i ? timedTarget(row, p) : row->target) - kea_endRate(s, i));
    p->N = (row->contact >= 0 ? kea_proximalContact[level < KEA_PROXIMAL_LEVELS ? level : KEA_PROXIMAL_LEVELS - 1]
                              : kea_proximalLimit) *
           p->size;
}

/* On a cone both rows have one softness, or the direction of friction would not be that of the slip. */
static void shareSoftness(KeaProblemRow *a, KeaProblemRow *b) {
    a->N = b->N = 0.5 * (a->N + b->N);
}

void kea_linearizeRows(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_problemMeasure(q);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        KeaProblemRow *p = &q->row[i];
        p->p0 = p->p;
        p->Jd = 0;
        if (p->size == 0)
            p->isOff = METRUE;
        if (row->spring)
            springRow(s, i, p);
        else if (row->position)
            positionRow(s, i, p);
        else
            velocityRow(s, i, p);
    }
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].partner > i)
            shareSoftness(&q->row[i], &q->row[q->row[i].partner]);
}
