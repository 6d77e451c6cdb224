/* The velocity stage: the velocities at the end that joints, limits, motors and contacts allow where the bodies have
 * arrived, nearest to those that the positions came with.
 *
 *     min 1/2 |v - v⁺|²_M   over what the rows allow:   M (v - v⁺) = Jᵀ (p - p_1),  J at the end,
 *
 * where bounds and cones hold for the whole impulse p of the step: the stage may take some of p_1 back, as when a push
 * out of an overlap is not to go on as a motion. Energy can only fall, and what a rebound gives back is part of what
 * was there.
 *
 *   rigid joint  J v = 0        soft joint  J v + ε'/(1 - γ') p = -γ' φ⁺ / ((1 - γ') h)       motor  J v = s
 *   contact, limit: J v >= 0, or >= the rebound; only those that carry something; springs stay as they are.
 *
 * Makes impacts plastic that come through joints, and damps the midpoint rule's +-1 mode after a discontinuity. In
 * calm motion it is left out: done always, it would cost energy.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static MeBool isUnilateral(const MdtKeaRow *row) {
    return (row->lower > -HUGE_VAL) != (row->upper < HUGE_VAL);
}

/* The joint's error goes on to be taken away at the same rate: what γ leaves of it, φ⁺ = (1 - γ) φ, asks for γ φ /
 * h. */
static void jointLaw(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double gamma = s->parameters.gamma, h = s->parameters.stepsize;
    p->r = row->drift;
    if (gamma >= 1)
        return;
    p->E = row->softness / (1 - gamma);
    p->r -= gamma * (s->work->endErrors[i] - h * row->drift) / ((1 - gamma) * h);
}

/* The row's law for the velocity, as what is to be added to the one at the end. */
static void setRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const MeBool isStop = row->contact == i || (row->position && isUnilateral(row));
    p->p0 = p->p;
    p->Jd = p->E = p->r = 0;
    p->isElsewhere = MEFALSE;
    p->N = (row->position && !isUnilateral(row) ? kea_proximalJoint : kea_proximalLimit) * p->size;
    if (row->spring || p->size == 0)
        p->isOff = METRUE;
    else if (isStop)
        p->r = row->drift + row->rebound;
    else if (row->position)
        jointLaw(s, i, p);
    else
        p->r = row->target, p->E = row->softness;
    if (row->contact >= 0 ? s->work->problem.row[row->contact].p == 0 : isStop && p->p == 0)
        p->isOff = METRUE;
    p->r -= kea_endRate(s, i);
}

static void setMetric(MdtKeaSystem *s, int i) {
    KeaMetric *B = &s->work->problem.metric[i];
    B->linear = 1 / s->bodies[i]->invMass;
    kea_endInertia(s, i, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
}

/* Jᵀ p_1: what the rows have given already. */
static void setLoads(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        memset(q->load[i], 0, sizeof q->load[i]);
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &q->row[i];
        for (int k = 0; k < 2; k++)
            for (int c = 0; c < 6 && p->body[k] >= 0; c++)
                q->load[p->body[k]][c] += p->p * p->J[k][c];
    }
}

static void setProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_refreshRows(s, s->work->endPose, MEFALSE); /* the impulse is one of the whole step */
    for (int i = 0; i < s->numBodies; i++)
        setMetric(s, i);
    kea_problemMeasure(q);
    for (int i = 0; i < s->numRows; i++)
        setRow(s, i, &q->row[i]);
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].partner > i)
            q->row[i].N = q->row[q->row[i].partner].N = keaMax(q->row[i].N, q->row[q->row[i].partner].N);
    setLoads(s);
}

static void addVelocities(MdtKeaSystem *s, double (*added)[6]) {
    for (int i = 0; i < s->numBodies; i++) {
        double dL[3];
        keaApply(dL, (const double(*)[3])s->work->problem.metric[i].angular, added[i] + 3);
        keaAddScaled(s->work->end[i].velocity, 1, added[i]);
        keaAddScaled(s->work->end[i].angularMomentum, 1, dL);
        for (int k = 0; k < 6; k++)
            s->work->body[i].endVelocity[k] += added[i][k];
    }
}

/* Whether there can be anything to do: midpoint bodies, rebounds, contacts that push out of an overlap. */
static MeBool mayBeNeeded(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->body[i].theta < 1)
            return METRUE;
    for (int i = 0; i < s->numRows; i++)
        if (s->work->problem.row[i].p > 0 && (s->rows[i].bounces || (s->rows[i].contact == i && s->rows[i].target > 0)))
            return METRUE;
    return MEFALSE;
}

/* Rebounds, and joints that are moved, whose velocity is known. */
static MeBool isRequired(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if ((s->work->problem.row[i].p > 0 && s->rows[i].bounces) ||
            (s->rows[i].position && !isUnilateral(&s->rows[i]) && s->rows[i].drift != 0))
            return METRUE;
    return MEFALSE;
}

/* The change of velocities that the rows ask for. */
static void solveRows(MdtKeaSystem *s, double start, double (*added)[6]) {
    KeaProblem *q = &s->work->problem;
    memset(added, 0, (size_t)s->numBodies * sizeof *added);
    double residual = start;
    q->isWarm = q->isLinear = s->work->hasJoints;
    q->isFactored = MEFALSE;
    for (int pass = 0; pass < KEA_FULL_BOUND_PASSES && residual > kea_velocityTolerance * start; pass++) {
        kea_frictionRenewBounds(q);
        if (!kea_problemRefine(q))
            kea_problemSolve(q, METRUE);
        kea_problemCarryOn(q, added);
        residual = q->counts.isLimited ? 0 : kea_problemResidual(q, NULL);
    }
    q->isWarm = q->isLinear = MEFALSE;
}

static MeBool rebounds(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !s->work->problem.row[i].isOff)
            return METRUE;
    return MEFALSE;
}

/* The velocities at the end, as the limiter of energy takes them. */
static double (*endVelocities(const MdtKeaSystem *s))[6] {
    for (int b = 0; b < s->numBodies; b++)
        memcpy(s->work->velocity[b], s->work->body[b].endVelocity, sizeof s->work->velocity[b]);
    return s->work->velocity;
}

/* Restitution and friction together, or restitution at several points, can ask for energy that is not there (Newton's
 * law has that flaw): then part of the rebound is taken back. */
static void limitEnergy(MdtKeaSystem *s, double start, double allowed) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numRows; i++)
        q->row[i].p = q->row[i].p0 = s->work->keptP[i];
    setProblem(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !q->row[i].isOff)
            q->row[i].r -= s->rows[i].rebound;
    solveRows(s, start, s->work->plastic);
    const double share =
        kea_elasticShare(s, endVelocities(s), s->work->added, s->work->plastic, allowed * (1 + kea_energyRounding));
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            s->work->added[b][k] = s->work->plastic[b][k] + share * (s->work->added[b][k] - s->work->plastic[b][k]);
}

static void solveStage(MdtKeaSystem *s, double start, double allowed) {
    for (int i = 0; i < s->numRows; i++)
        s->work->keptP[i] = s->work->problem.row[i].p;
    s->report.stages++;
    solveRows(s, start, s->work->added);
    if (rebounds(s) && kea_kineticEnergy(s, endVelocities(s), s->work->added) > allowed)
        limitEnergy(s, start, allowed);
    addVelocities(s, s->work->added);
}

/* m/s, as residuals are. */
static double leftOver(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    return (p->E * p->p - p->r) * kea_lengthOf(s, &s->rows[i]);
}

/* The undamped velocity of the midpoint rule changes its sign at every step; what motion itself leaves does not. */
static MeBool alternates(const MdtKeaSystem *s, double residual) {
    if (s->parameters.pair != MdtKeaPairNone || residual < kea_velocityTolerance * kea_loadSpeed(s))
        return MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const double now = leftOver(s, i), before = s->rows[i].ripple;
        const MeBool counts = s->rows[i].position && !s->work->problem.row[i].isOff;
        if (counts && now * before < 0 && fabs(now + before) < kea_rippleBalance * fabs(now - before) &&
            fabs(now) > kea_rippleShare * residual)
            return METRUE;
    }
    return MEFALSE;
}

static void noteRipples(MdtKeaSystem *s, MeBool isQuieted) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].ripple = isQuieted ? 0 : leftOver(s, i);
}

static MeBool isPushed(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && s->work->problem.row[i].p > 0)
            return METRUE;
    return MEFALSE;
}

/* Two bodies whose joint is open. What opens to the world may be led by the program. */
static MeBool isOpenJoint(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (!row->position || isUnilateral(row) || row->body[0] < 0 || row->body[1] < 0)
        return MEFALSE;
    const double size = keaMax(s->work->body[row->body[0]].size, s->work->body[row->body[1]].size);
    return fabs(row->error) * kea_lengthOf(s, row) > kea_openJoint * size;
}

/* A joint that contacts keep open may take its error away, wedged, in a motion of many times the energy. */
static MeBool isJammed(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (isOpenJoint(s, &s->rows[i]))
            return isPushed(s);
    return MEFALSE;
}

/* Answers that are not the motion: cut short, or a compromise between joints that contradict each other, each of which
 * takes its error away at the cost of the others'. Parts of a step by safe times are watched as well, and so is what
 * took many passes: rows that contradict each other may be found to agree in a motion that has a hundred times the
 * energy. */
static MeBool needsEnergyLimit(const MdtKeaSystem *s) {
    return s->report.capped || s->work->isCompromise || s->work->isSettled || s->report.passes > KEA_UNUSUAL_PASSES ||
           s->work->problem.counts.isLimited || s->parameters.isPart;
}

/* The limiter; of a jam that was solved, it leaves the energy with which errors are taken away. */
static void limitMotion(MdtKeaSystem *s, double allowed) {
    const MeBool isAnswerBad = needsEnergyLimit(s);
    if (!isAnswerBad && !isJammed(s))
        return;
    const double most = isAnswerBad ? allowed : keaMax(allowed, kea_energyOfCorrection(s));
    if (kea_slowDown(s, endVelocities(s), most, s->work->added))
        addVelocities(s, s->work->added);
}

static MeBool isJerk(const MdtKeaSystem *s, double residual) {
    return s->parameters.pair != MdtKeaPairFirst && residual > kea_calmResidual * kea_loadSpeed(s);
}

void kea_velocityStage(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    if (!mayBeNeeded(s) && !needsEnergyLimit(s) && !isJammed(s))
        return;
    if (needsEnergyLimit(s) && kea_stopShort(s))
        kea_moveBodies(s);
    const MeBool isHit = isRequired(s);
    const double allowed = kea_energyAllowed(s);
    kea_keepRows(s);
    setProblem(s);
    const double start = kea_problemResidual(q, NULL);
    const MeBool isNeeded =
        !s->work->isSettled && (isHit || isJerk(s, start) || alternates(s, start)) && kea_problemMaySweep(q);
    noteRipples(s, isNeeded);
    if (isNeeded)
        solveStage(s, start, allowed);
    limitMotion(s, allowed);
    kea_recallRows(s);
}
