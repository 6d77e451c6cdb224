/* One step of one partition.
 *
 *     begin: which rows can act, how implicit each body is, warm start from the last step's answer
 *     passes: move by u; rows at the mean of the poses; the inner problem for the change of u;
 *             until the residuals are below tolerance
 *     velocity stage: the nearest velocities that joints and contacts allow where the bodies have arrived
 *
 * Passes solve the tangent problem (kea_problem_i.h), which is Newton's method for the geometry, where no body turns
 * far; where joints make loops, the first of them, and none if anything rubs.
 *
 * A pass is at once a Newton iteration for the geometry, a proximal step for rigid rows, and a renewal of the friction
 * bounds. Where the last answer still holds, no pass is needed and nothing is factored.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* ---- budget ---- */

static double workOfLinearization(const MdtKeaSystem *s) {
    return KEA_LINEARIZATION * ((double)s->numRows + s->numBodies);
}

/* With an iteration cap, passes by sweeps are capped in proportion: the cap is to make a step cheaper. Sweeps have no
 * more kept for them than Newton's method has. */
/* ---- passes ---- */

static void linearize(MdtKeaSystem *s) {
    kea_moveBodies(s);
    kea_refreshRows(s, s->work->meanPose, METRUE);
    kea_rateAhead(s);
    if (s->errors)
        s->errors(s->context, s->work->endPose, s->work->endErrors);
    kea_linearizeBodies(s);
    kea_linearizeRows(s);
    kea_problemSpend(&s->work->problem, workOfLinearization(s));
}

/* What the tangent problem needs beside. */
static void differentiate(MdtKeaSystem *s) {
    kea_differentiateBodies(s);
    kea_differentiateRows(s);
    kea_problemSpend(&s->work->problem, workOfLinearization(s));
}

static void takePass(MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        for (int k = 0; k < 6; k++)
            s->work->body[i].u[k] += q->d[i][k];
}

/* The work goes on friction bounds that do not settle. */
static MeBool isLate(const MdtKeaSystem *s) {
    return s->parameters.maxWork > 0 && s->work->problem.counts.work > kea_workForFriction * s->parameters.maxWork;
}

/* Friction bounds follow the normal forces, later on more carefully; should that not settle, they are left where they
 * are once the answer is good enough, or in the end. */
static void solvePass(MdtKeaSystem *s, int pass, MeBool isGoodEnough, MeBool isExactEnough) {
    KeaProblem *q = &s->work->problem;
    if (kea_dualSolve(s))
        return;
    const MeBool isFrozen = q->counts.stuck > 0 && pass >= (isGoodEnough ? KEA_FREEZE_PASS : KEA_MAX_COUPLED_PASSES);
    if (isFrozen && q->counts.freezes == 0)
        kea_frictionRenewBounds(q);
    else if (!isFrozen && pass > 0)
        kea_frictionApproachBounds(q, pass);
    q->counts.freezes += isFrozen;
    q->counts.stuck = !kea_problemSolve(q, !isFrozen) || isFrozen;
    q->counts.level += (!q->counts.stuck && !isExactEnough) || isFrozen;
    q->hasTangent = q->hasTangent && !(q->isSingular && s->work->hasLoops);
}

/* A pass towards the answer: where that is near, by the factors of the last pass, if these are still right. False: it
 * has converged, and cannot be refined. */
static MeBool improve(MdtKeaSystem *s, int pass, const KeaResiduals *e, MeBool isNear) {
    KeaProblem *q = &s->work->problem;
    if (q->hasTangent)
        differentiate(s);
    if (isNear && kea_problemRefine(q))
        return METRUE;
    if (kea_isConverged(e))
        return MEFALSE;
    solvePass(s, pass, e->velocity < kea_looseVelocity, isNear && q->hasTangent);
    return METRUE;
}

/* An answer that has converged is refined once where that costs no factorization: the next step begins with it. */
static MeBool isFinal(const KeaProblem *q, const KeaResiduals *e, MeBool isPolished) {
    return isPolished || (kea_isConverged(e) && !(q->isFactored && e->worst > kea_refinedEnough));
}

static void keepAnswer(MdtKeaSystem *s, double (*u)[6], double p[]) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(u[i], s->work->body[i].u, sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        p[i] = s->work->problem.row[i].p;
}

static void takeAnswer(MdtKeaSystem *s, double (*const u)[6], const double p[]) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(s->work->body[i].u, u[i], sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = p[i];
    linearize(s);
}

static void takeBest(MdtKeaSystem *s) {
    takeAnswer(s, s->work->bestU, s->work->bestP);
}

/* Does the body roll on the contact, about its own centre? */
static MeBool isCentred(const MdtKeaRow *normal, int k) {
    return normal->radius[k] > 0 && keaLength(normal->J[k].ang) <= kea_centredArm * normal->radius[k];
}

/* Whether it matters how a body is turned: not for a ball whose contacts all push towards its centre. */
static MeBool isTurnRelevant(const MdtKeaSystem *s, int body) {
    if (!s->work->body[body].isSpatial)
        return METRUE;
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++) {
            const int normal = s->rows[i].contact;
            if (s->rows[i].body[k] == body && (normal < 0 || !isCentred(&s->rows[normal], k)))
                return METRUE;
        }
    return MEFALSE;
}

/* The Cayley map turns a body by less than half a turn, however fast it is: near that, the velocity means nothing. */
static MeBool turnsOver(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (!(s->parameters.stepsize * keaLength(s->work->body[i].u + 3) <= kea_mostTurn) && isTurnRelevant(s, i))
            return METRUE;
    return MEFALSE;
}

/* The coupled problem of contradictory rows may be singular: its step is then no number, and no pass can follow it. */
static MeBool isStepFinite(const KeaProblem *q) {
    for (int i = 0; i < q->numBodies; i++)
        for (int k = 0; k < 6; k++)
            if (!isfinite(q->d[i][k]))
                return MEFALSE;
    return METRUE;
}

/* Has an answer that was not found taken the bodies where no motion goes? Mean velocities lie between those at the
 * start and those at the end, and have less energy than the whole partition at the greatest speed that anything in it
 * has or wants. */
static MeBool isRunaway(const MdtKeaSystem *s) {
    double energy = 0, mass = 0, speed = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const KeaBody *body = &s->work->body[b];
        const double u = keaLength(body->u) + body->size * keaLength(body->u + 3), m = 1 / s->bodies[b]->invMass;
        speed = keaMax(speed, keaLength(s->bodies[b]->velocity) + keaLength(body->freeVelocity) +
                                  body->size * keaLength(s->velocity[b].ang));
        energy += m * u * u;
        mass += m;
    }
    for (int i = 0; i < s->numRows; i++)
        speed = keaMax(speed, kea_pushSpeed(s, &s->rows[i], s->rows[i].target));
    return !(energy <= kea_runawayRoom * mass * speed * speed);
}

/* How far the pass is from the laws. At half a turn a row's mean Jacobian vanishes, and asks for nothing: a runaway
 * that turns so far meets them all, but is no answer. */
static KeaResiduals residualsOfPass(MdtKeaSystem *s, double speed) {
    KeaResiduals e = kea_residuals(s, speed);
    if (turnsOver(s) && isRunaway(s))
        e.position = e.worst = HUGE_VAL;
    return e;
}

/* The last resort: the bodies move as if there were no rows. Joints open by no more than a step's way. */
static void moveWithoutRows(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        KeaBody *body = &s->work->body[b];
        for (int k = 0; k < 3; k++) {
            const double v = s->bodies[b]->velocity[k], w = s->velocity[b].ang[k];
            body->u[k] = v + body->theta * (body->freeVelocity[k] - v);
            body->u[3 + k] = w + body->theta * (s->predicted[b].ang[k] - w);
        }
    }
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = 0;
    linearize(s);
}

/* Where joints make loops, passes begin with the tangent problem, which follows a linkage through its change point. At
 * one its matrix is singular, and no answer may be found; nor is one with redundant joints, for which the symmetric
 * problem is then solved: they are no trouble there. */
static MeBool mustLeaveTangent(const MdtKeaSystem *s, int pass, const KeaResiduals *e) {
    return s->work->problem.hasTangent && s->work->hasLoops && !kea_isConverged(e) &&
           (pass >= KEA_TANGENT_PASSES || !isfinite(e->worst));
}

/* Where they make none, the tangent problem is left once the motion has got worse by it twice: what the direction of
 * an angular row changes by is not in it, and may be more than the rest. */
static MeBool isLost(const KeaResiduals *e, double *motion, int *worse) {
    const double before = *motion;
    *motion = keaMax(e->position, e->momentum);
    *worse += *motion > 1 && *motion > before;
    return *worse >= 2;
}

/* Has removing errors within the rounding ε of attachments moved a body by more than such an error can? At a change
 * point, where a joint's error is x²/2 of the way x, that is sqrt(2 ε) of its size: a larger motion is one on another
 * branch than the one that momentum chooses. */
static MeBool hasLeftBranch(const MdtKeaSystem *s) {
    const double most = sqrt(2 * kea_attachmentRounding);
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        double dv[3], dw[3];
        keaSubtract(dv, b->u, s->work->nearU[i]);
        keaSubtract(dw, b->u + 3, s->work->nearU[i] + 3);
        if (s->parameters.stepsize * (keaLength(dv) + b->size * keaLength(dw)) > most * b->size)
            return METRUE;
    }
    return MEFALSE;
}

/* The tangent problem has a matrix that is not positive: where bodies turn far in a step, it may lead to another of
 * the motions that keep all laws, one with energy from nowhere. */
static MeBool mayBeTangent(const MdtKeaSystem *s) {
    if (s->work->hasLoops)
        return !s->work->problem.hasFriction; /* that holds what makes loops: passes would not settle */
    for (int i = 0; i < s->numBodies; i++)
        if (s->parameters.stepsize * keaLength(s->velocity[i].ang) > kea_tangentTurn)
            return MEFALSE;
    return s->work->hasJoints && s->work->problem.hasFriction;
}

static void takePasses(MdtKeaSystem *s) {
    int last = KEA_MAX_COUPLED_PASSES + KEA_FROZEN_PASSES;
    KeaProblem *q = &s->work->problem;
    MeBool ranOut = MEFALSE;
    double speed = 0, best = HUGE_VAL, nearest = HUGE_VAL;
    KeaResiduals e = {.worst = HUGE_VAL};
    double motion = HUGE_VAL, before = HUGE_VAL;
    int worse = 0;
    MeBool hasNear = MEFALSE, isPolished = MEFALSE;
    q->hasTangent = mayBeTangent(s);
    q->isWarm = s->work->hasJoints; /* of contacts alone, the convex problem shares loads evenly */
    q->isFactored = MEFALSE;
    q->sweptPasses =
        q->sweptPasses > 1 ? q->sweptPasses : 1; /* motions of timed contacts are solved up to three times */
    for (int pass = 0;; pass++) {
        linearize(s);
        speed = keaMax(speed, kea_speedOf(s));
        e = residualsOfPass(s, speed);
        if (e.worst < best || pass == 0) {
            best = e.worst;
            keepAnswer(s, s->work->bestU, s->work->bestP);
        }
        if (q->hasTangent && s->work->hasLoops && e.attachment < 1 && e.worst < nearest) {
            nearest = e.worst;
            keepAnswer(s, s->work->nearU, s->work->nearP);
        }
        q->hasTangent = q->hasTangent && (s->work->hasLoops || !isLost(&e, &motion, &worse));
        if (mustLeaveTangent(s, pass, &e)) {
            q->hasTangent = MEFALSE;
            takeBest(s);
            e = kea_residuals(s, speed);
            hasNear = nearest < HUGE_VAL;
            last = hasNear ? pass + KEA_UNUSUAL_PASSES : last;
        }
        q->counts.isLimited = q->counts.isLimited || (isLate(s) && q->counts.stuck > 0);
        ranOut = q->counts.isLimited;
        const MeBool isNear = kea_isExactEnough(&e, 1) && e.worst < kea_refinedShare * before;
        before = e.worst;
        if (isFinal(q, &e, isPolished) || pass == last ||
            (ranOut && (kea_isExactEnough(&e, kea_sweptMargin) || !kea_problemMaySweep(q))))
            break;
        isPolished = kea_isConverged(&e);
        if (!improve(s, pass, &e, isNear))
            break;
        if (!isStepFinite(q)) {
            e.worst = HUGE_VAL;
            break;
        }
        kea_noteInconsistent(s);
        takePass(s);
        kea_admitContacts(s);
        s->report.passes++;
    }
    if (!(e.worst <= best) && !(ranOut && e.position <= kea_loosePosition)) {
        takeBest(s);
        e = kea_residuals(s, speed);
    }
    s->work->isSettled = hasNear && (!kea_isConverged(&e) || hasLeftBranch(s));
    if (s->work->isSettled) {
        takeAnswer(s, s->work->nearU, s->work->nearP);
        e = kea_residuals(s, speed);
    }
    if (!kea_isConverged(&e) && isRunaway(s)) {
        moveWithoutRows(s);
        e = kea_residuals(s, speed);
    }
    q->hasTangent = q->isWarm = q->isFactored = MEFALSE;
    s->report.conflicting = kea_isConflicting(s);
    s->work->isCompromise = kea_isCompromise(s);
    const MeBool isMissed =
        (!s->work->isSettled && !(e.position <= kea_loosePosition && e.momentum <= kea_loosePosition)) || turnsOver(s);
    s->report.violent = isMissed && !ranOut;
    s->report.capped = isMissed || !(e.velocity <= kea_looseVelocity);
    s->report.limited = s->report.capped && ranOut;
    s->report.resolution = e.resolution;
    s->report.residual = e.velocity * e.resolution;
    s->report.force = e.impulse / s->parameters.stepsize;
}

static void setFree(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].isFree = METRUE;
    for (int i = 0; i < s->numRows; i++) {
        if (s->work->problem.row[i].isOff || (s->rows[i].contact >= 0 && s->work->problem.row[i].p == 0))
            continue;
        for (int k = 0; k < 2; k++)
            if (s->rows[i].body[k] >= 0)
                s->work->body[s->rows[i].body[k]].isFree = MEFALSE;
    }
}

/* Bounds may move with the bodies (MdtKeaJacobianFn): the last pass has met those of the pass before. */
static void returnForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &s->work->problem.row[i];
        const double within = p->normal >= 0 ? p->p : keaMin(keaMax(p->p, p->lower), p->upper);
        s->rows[i].force = within / s->parameters.stepsize;
    }
}

/* Passes from the last answer. */
static void solveMotion(MdtKeaSystem *s) {
    kea_beginRows(s);
    kea_guessMotion(s);
    takePasses(s);
    kea_balanceMomentum(s);
}

/* A stop needs a second solve, in which what stops slides on; should it not stop within the step after all, the first
 * solution was right. */
static void solveInTime(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    MeBool mustRepeat, isNew;
    double event = kea_firstEvent(s, &mustRepeat);
    if (mustRepeat) {
        solveMotion(s);
        event = kea_firstEvent(s, &isNew);
        if (event > h) {
            kea_releaseSlides(s);
            solveMotion(s);
        }
    }
    s->report.event = keaMin(event, h);
    MEASSERT(s->report.event >= 0);
}

static MeBool hasActingContact(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && !s->work->problem.row[i].isOff)
            return METRUE;
    return MEFALSE;
}

/* The midpoint rule follows a body whose moments differ only as long as it does not turn far in a step: a fast top
 * would precess wrongly, and by (h w)²/12 it turns less far than it should. Bodies with contacts are left alone, and
 * where there are any, others may turn five times as far: more is lost in an impact than the 2 % of the angle that
 * this is. */
static MeBool turnsTooFar(const MdtKeaSystem *s) {
    const double far =
        hasActingContact(s) ? kea_farTurnInContact : kea_farTurn; /* rad, times the moments' relative difference */
    for (int i = 0; i < s->numBodies; i++) {
        const double *I = s->bodies[i]->moments;
        const double most = keaMax(I[0], keaMax(I[1], I[2])), least = keaMin(I[0], keaMin(I[1], I[2]));
        const KeaBody *b = &s->work->body[i];
        if (b->theta < 1 && !b->isSpatial &&
            s->parameters.stepsize * keaLength(s->velocity[i].ang) * (most - least) > far * most)
            return METRUE;
    }
    return MEFALSE;
}

static MeBool hasJoint(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0)
            return METRUE;
    return MEFALSE;
}

/* All contacts are open, and there is nothing else: the bodies fly up to the first of them that is met. One that turns
 * over is not followed by the rates of its contacts. */
static MeBool isFlight(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 || !s->rows[s->rows[i].contact].isOpen)
            return MEFALSE;
    for (int b = 0; b < s->numBodies; b++)
        if (s->parameters.stepsize * keaLength(s->velocity[b].ang) > kea_mostTurn && isTurnRelevant(s, b))
            return MEFALSE;
    return s->parameters.timed;
}

static void fly(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    kea_moveFreely(s);
    s->report.event = kea_firstEventOfFlight(s);
    kea_problemSpend(&s->work->problem, KEA_VISIT * ((double)s->numRows + s->numBodies));
    kea_reportWork(s);
}

void kea_exactSolve(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    memset(&q->counts, 0, sizeof q->counts);
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
    s->report.least = workOfLinearization(s);
    kea_beginBodies(s);
    if (s->parameters.timed)
        kea_timedBegin(s);
    if (isFlight(s)) {
        fly(s);
        return;
    }
    kea_beginRows(s);
    if (s->parameters.mayRefuse && s->numRows > 0 && turnsTooFar(s)) {
        s->report.violent = s->report.refused = METRUE;
        kea_moveFreely(s); /* a state, should the step be taken all the same */
        return;
    }
    s->report.capped = s->numRows > 0; /* until they are solved: there may be no memory */
    if (s->numRows > 0 && kea_problemBegin(q, s->cache)) {
        kea_setBudget(s, kea_workForMotion, KEA_SWEPT_PASSES);
        s->work->hasLoops = kea_hasLoops(s);
        s->work->hasJoints = hasJoint(s);
        kea_dualBegin(s);
        solveMotion(s);
        if (s->parameters.timed)
            solveInTime(s);
        setFree(s);
        kea_setBudget(s, 1, 1);
        if (!s->parameters.timed || s->work->hasJoints)
            kea_velocityStage(s);
        kea_shareForces(s);
        returnForces(s);
    }
    kea_moveFreely(s);
    if (s->parameters.timed && s->numRows > 0 && q->factor) /* null: there was no memory */
        kea_project(s);
    kea_reportWork(s);
}
