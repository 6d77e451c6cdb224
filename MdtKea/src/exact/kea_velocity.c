/* The velocity stage: projects the velocities at the end onto the rows at the end poses.
 *
 * The v⁺ of the passes fulfils the rows only in the mean of the step. This stage finds the velocities nearest to v⁺, in
 * the metric of the masses, that joints, limits, motors and contacts allow at the end poses:
 *
 *     min 1/2 |v - v⁺|²_M   subject to the rows:   M (v - v⁺) = Jᵀ (p - p_1),  J at the end,
 *
 * where p_1 are the impulses of the passes, and bounds and cones hold for the whole impulse p: the stage may take back
 * a part of p_1, so that the correction of an overlap does not remain as a velocity. The projection cannot add energy
 * except by rebounds, which limitEnergy bounds.
 *
 *   rigid joint  J v = 0        soft joint  J v + ε'/(1 - γ') p = -γ' φ⁺ / ((1 - γ') h)       motor  J v = s
 *   contact, limit: J v >= 0, or >= the rebound; only those with p_1 > 0. Springs keep their impulse.
 *
 * The stage makes impacts through joints plastic, and damps the midpoint rule's +-1 mode after a discontinuity. In
 * smooth motion it is left out, since the projection dissipates energy.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static MeBool isUnilateral(const MdtKeaRow *row) {
    return (row->lower > -HUGE_VAL) != (row->upper < HUGE_VAL);
}

/* Whether row i is the normal row of a contact, or a joint's stop. */
static MeBool isStop(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    return row->contact == i || (row->position && isUnilateral(row));
}

/* Whether the error of a rigid joint or of a stop is large enough for the velocity to matter that closes it. */
static MeBool isOpen(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const double error = row->lower == 0 ? keaMax(-row->error, 0) : fabs(row->error);
    return row->position && (kea_isRigidJoint(row) || isUnilateral(row)) &&
           error * kea_lengthOf(s, row) > kea_openJoint * kea_smallerExtent(s, row->body);
}

/* Whether the error of the row's joint closes without a velocity: all of its rows do if one of them is open. */
static MeBool isUnbiased(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    int first = i;
    if (!row->isUnbiased || !(kea_isRigidJoint(row) || isUnilateral(row)) || s->parameters.pair != MdtKeaPairNone)
        return MEFALSE;
    while (first > 0 && s->rows[first - 1].owner == row->owner)
        first--;
    for (int k = first; k < s->numRows && s->rows[k].owner == row->owner; k++)
        if (isOpen(s, &s->rows[k]))
            return METRUE;
    return MEFALSE;
}

/* Sets E and r of a joint. The error φ⁺ = (1 - γ) φ that is left after the passes continues to be corrected at the rate
 * γ φ / h. */
static void setJointLaw(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double gamma = s->parameters.gamma, h = s->parameters.stepsize;
    p->r = row->drift;
    if (gamma >= 1 || isUnbiased(s, i))
        return;
    p->E = row->softness / (1 - gamma);
    p->r -= gamma * (s->work->endErrors[i] - h * (row->drift + row->carried)) / ((1 - gamma) * h);
}

/* Sets row i of the projection, whose unknown is d = v - v⁺. */
static void setVelocityRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    p->p0 = p->p;
    p->Jd = p->E = p->r = 0;
    p->isCheckedElsewhere = MEFALSE;
    p->N = (row->position && !isUnilateral(row) ? kea_proximalJoint : kea_proximalLimit) * p->Aii;
    if (row->spring || p->Aii == 0)
        p->isInactive = METRUE;
    else if (isStop(s, i))
        p->r = row->drift + row->rebound;
    else if (row->position)
        setJointLaw(s, i, p);
    else
        p->r = row->target, p->E = row->softness;
    if (row->contact >= 0 ? s->work->problem.row[row->contact].p == 0 : isStop(s, i) && p->p == 0)
        p->isInactive = METRUE;
    p->r = row->hop > 0 ? 0 : p->r - kea_endRate(s, i); /* what hops has its rate already */
}

/* Sets the metric of body i: mass, and inertia at the end pose. */
static void setVelocityMetric(MdtKeaSystem *s, int i) {
    KeaMetric *B = &s->work->problem.metric[i];
    B->linear = 1 / s->bodies[i]->invMass;
    kea_endInertia(s, i, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
}

/* Adds the impulses p_1 of unbiased or of other rows, along their present directions, to the projection's loads. */
static void addVelocityLoads(MdtKeaSystem *s, MeBool ofUnbiased) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numRows; i++)
        if (isUnbiased(s, i) == ofUnbiased)
            kea_addRowForce(q->load, &q->row[i], q->row[i].p);
}

/* The impulses of unbiased rows, which are taken back, have acted along the directions of the mean poses. */
static void setVelocityProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        memset(q->load[i], 0, sizeof q->load[i]);
    addVelocityLoads(s, METRUE);
    kea_refreshRows(s, s->work->endPose, MEFALSE); /* bounds do not change: p is the impulse of the whole step */
    for (int i = 0; i < s->numBodies; i++)
        setVelocityMetric(s, i);
    kea_problemSetEffectiveMasses(q);
    for (int i = 0; i < s->numRows; i++)
        setVelocityRow(s, i, &q->row[i]);
    kea_disableBends(s);
    kea_problemShareN(q);
    addVelocityLoads(s, MEFALSE);
}

/* Adds a change of velocities to the end states. */
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

/* Whether the row is the normal row of a contact that overlaps, or a joint or stop that is open. */
static MeBool isCorrecting(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    return row->contact == i ? row->target > 0 : isUnbiased(s, i) || (isUnilateral(row) && isOpen(s, row));
}

/* Whether the projection can change velocities: a body has θ < 1, a row rebounds, or an error is corrected. */
static MeBool mayStageBeNeeded(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->body[i].theta < 1)
            return METRUE;
    for (int i = 0; i < s->numRows; i++)
        if (s->work->problem.row[i].p != 0 && (s->rows[i].bounces || isCorrecting(s, i)))
            return METRUE;
    return MEFALSE;
}

/* Whether the rows are fulfilled at the end poses as well as the passes have fulfilled them, since they are fixed, and
 * none constrains a position. */
static MeBool areRowsFulfilled(const MdtKeaSystem *s) {
    if (!s->work->areRowsFixed || s->report.capped)
        return MEFALSE;
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].position)
            return MEFALSE;
    return METRUE;
}

/* Whether the stage is needed for any residual: a row rebounds, a joint closes without velocity, or its attachments
 * move. */
static MeBool isStageRequired(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if ((s->work->problem.row[i].p > 0 && s->rows[i].bounces) || isUnbiased(s, i) ||
            (s->rows[i].position && !isUnilateral(&s->rows[i]) && s->rows[i].drift != 0))
            return METRUE;
    return MEFALSE;
}

/* Solves for the change of velocities, `added`, until the residual is below tolerance. */
static void solveVelocityRows(MdtKeaSystem *s, double start, double (*added)[6]) {
    KeaProblem *q = &s->work->problem;
    memset(added, 0, (size_t)s->numBodies * sizeof *added);
    double residual = start;
    q->isWarm = q->isLinear = s->work->hasJoints;
    q->isFactored = MEFALSE;
    for (int pass = 0; pass < KEA_FULL_BOUND_PASSES && residual > kea_velocityTolerance * start; pass++) {
        kea_frictionSetBounds(q);
        if (!kea_problemRefine(q))
            kea_problemSolve(q, METRUE);
        kea_problemAccumulate(q, added);
        residual = q->counts.isLimited ? 0 : kea_problemResidual(q, NULL);
    }
    q->isWarm = q->isLinear = MEFALSE;
}

/* Whether an active row rebounds. */
static MeBool hasRebounds(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !s->work->problem.row[i].isInactive)
            return METRUE;
    return MEFALSE;
}

/* The end velocities, copied to work->velocity, which the energy limiter reads. */
static double (*endVelocities(const MdtKeaSystem *s))[6] {
    for (int b = 0; b < s->numBodies; b++)
        memcpy(s->work->velocity[b], s->work->body[b].endVelocity, sizeof s->work->velocity[b]);
    return s->work->velocity;
}

/* Newton's law of restitution, with friction or at several points at once, may add energy. This interpolates between
 * the answer and the plastic one, which has no rebounds, down to the energy allowed. */
static void limitEnergy(MdtKeaSystem *s, double start, double allowed) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numRows; i++)
        q->row[i].p = q->row[i].p0 = s->work->savedP[i];
    setVelocityProblem(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].bounces && !q->row[i].isInactive)
            q->row[i].r -= s->rows[i].rebound;
    solveVelocityRows(s, start, s->work->plastic);
    const double share =
        kea_elasticShare(s, endVelocities(s), s->work->added, s->work->plastic, allowed * (1 + kea_energyRounding));
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            s->work->added[b][k] = s->work->plastic[b][k] + share * (s->work->added[b][k] - s->work->plastic[b][k]);
}

/* Projects the end velocities, with at most the energy `allowed` if there are rebounds; start: residual before. */
static void projectVelocities(MdtKeaSystem *s, double start, double allowed) {
    kea_saveImpulses(s);
    s->report.stages++;
    MEASSERT(s->report.stages == 1);
    solveVelocityRows(s, start, s->work->added);
    if (hasRebounds(s) && kea_kineticEnergy(s, endVelocities(s), s->work->added) > allowed)
        limitEnergy(s, start, allowed);
    addVelocities(s, s->work->added);
}

/* m/s: the velocity residual of a row, E p - r. */
static double velocityResidual(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    return (p->E * p->p - p->r) * kea_lengthOf(s, &s->rows[i]);
}

/* Whether a residual is that of the midpoint rule's undamped mode (-1)^n: some row's is about minus that of the last
 * step, as their sum is below half of their difference. */
static MeBool isAlternating(const MdtKeaSystem *s, double residual) {
    if (s->parameters.pair != MdtKeaPairNone || residual < kea_velocityTolerance * kea_loadSpeed(s))
        return MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const double now = velocityResidual(s, i), before = s->rows[i].ripple;
        const MeBool counts = s->rows[i].position && !s->work->problem.row[i].isInactive;
        if (counts && now * before < 0 && fabs(now + before) < 0.5 * fabs(now - before) &&
            fabs(now) > kea_rippleShare * residual)
            return METRUE;
    }
    return MEFALSE;
}

/* Stores the residuals for the next step's isAlternating; 0 if the stage has removed them. */
static void storeRipples(MdtKeaSystem *s, MeBool isDamped) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].ripple = isDamped ? 0 : velocityResidual(s, i);
}

/* Whether a contact pushes. */
static MeBool hasActingContact(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && s->work->problem.row[i].p > 0)
            return METRUE;
    return MEFALSE;
}

/* Whether a row of a joint between two bodies has a position error. Joints to the world do not count, since the program
 * may move their attachments. */
static MeBool isOpenJoint(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (!row->position || isUnilateral(row) || row->body[0] < 0 || row->body[1] < 0)
        return MEFALSE;
    const double size = keaMax(s->work->body[row->body[0]].size, s->work->body[row->body[1]].size);
    return fabs(row->error) * kea_lengthOf(s, row) > kea_openJoint * size;
}

/* Whether contacts act while a joint is open: the correction of the joint's error against the contacts may then add a
 * multiple of the energy. */
static MeBool areContactsJammed(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (isOpenJoint(s, &s->rows[i]))
            return hasActingContact(s);
    return MEFALSE;
}

/* Whether the energy has to be limited, as the answer may have gained some: passes have not converged; joints
 * contradict each other, so that each corrects its error at the cost of others; there were many passes, in which
 * contradicting rows may have converged to a motion of a hundred times the energy; or the sub-step ends at a safe
 * time. */
static MeBool needsEnergyLimit(const MdtKeaSystem *s) {
    return s->report.capped || s->work->isInconsistent || s->work->usesTangentAnswer ||
           s->report.passes - s->work->contactPasses > KEA_UNUSUAL_PASSES || s->work->problem.counts.isLimited ||
           s->parameters.isPart;
}

/* Limits the kinetic energy to `allowed` if needsEnergyLimit; if only areContactsJammed, to `allowed` or the energy
 * that the correction of errors needs, whichever is more. */
static void limitEndEnergy(MdtKeaSystem *s, double allowed) {
    const MeBool isSuspect = needsEnergyLimit(s);
    if (!isSuspect && !areContactsJammed(s))
        return;
    const double max = isSuspect ? allowed : keaMax(allowed, kea_energyOfCorrection(s));
    if (kea_scaleVelocities(s, endVelocities(s), max, s->work->added))
        addVelocities(s, s->work->added);
}

/* Whether the residual shows a discontinuity, such as an impact; never in the first step of a pair. */
static MeBool isDiscontinuity(const MdtKeaSystem *s, double residual) {
    return s->parameters.pair != MdtKeaPairFirst && residual > kea_calmResidual * kea_loadSpeed(s);
}

void kea_velocityStage(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    const MeBool mayChange = mayStageBeNeeded(s) && !areRowsFulfilled(s);
    if (!mayChange && !needsEnergyLimit(s) && !areContactsJammed(s)) {
        kea_keepSpin(s);
        return;
    }
    if (needsEnergyLimit(s) && kea_limitDisplacements(s))
        kea_moveBodies(s);
    const MeBool isMandatory = isStageRequired(s);
    const double allowed = kea_energyAllowed(s);
    kea_saveJacobians(s);
    setVelocityProblem(s);
    const double start = kea_problemResidual(q, NULL);
    const MeBool isNeeded = !s->work->usesTangentAnswer && start > kea_velocityTolerance * kea_minSpeedOfAll(s) &&
                            (isMandatory || isDiscontinuity(s, start) || isAlternating(s, start)) &&
                            kea_problemMaySweep(q);
    storeRipples(s, isNeeded);
    if (isNeeded)
        projectVelocities(s, start, allowed);
    kea_keepSpin(s);
    limitEndEnergy(s, allowed);
    kea_restoreJacobians(s);
}

/* Whether a loaded contact rolls, and the world's surfaces rest: the work of moving ones is known to (h w)² only. */
static MeBool mayRollingGain(const MdtKeaSystem *s) {
    MeBool rolls = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        if (s->rows[i].contact >= 0 && s->rows[i].drift != 0)
            return MEFALSE;
        rolls |= s->rows[i].rolls && s->work->problem.row[i].p > 0;
    }
    return rolls;
}

void kea_limitRolling(MdtKeaSystem *s) {
    if (!mayRollingGain(s))
        return;
    for (int i = 0; i < s->numBodies; i++)
        setVelocityMetric(s, i);
    const double allowed = kea_energyAllowed(s);
    if (kea_kineticEnergy(s, endVelocities(s), NULL) > (1 + kea_rollingGain) * allowed &&
        kea_scaleVelocities(s, endVelocities(s), allowed, s->work->added))
        addVelocities(s, s->work->added);
}
