/* One step of one partition.
 *
 *     begin: which rows can act, how implicit each body is, warm start from the last step's answer
 *     passes: move by u; rows at the mean of the poses; the inner problem for the change of u;
 *             until the residuals are below tolerance
 *     velocity stage: the nearest velocities that joints and contacts allow where the bodies have arrived
 *
 * Passes solve the tangent problem (kea_problem_i.h), which is Newton's method for the geometry, if joints and friction
 * meet but make no loop, and no body turns far. Where joints make loops without friction, only the first passes do;
 * where they make loops with friction, none.
 *
 * A pass is at once a Newton iteration for the geometry, a proximal step for rigid rows, and a renewal of the friction
 * bounds. Where the last answer still holds, no pass is needed and nothing is factored.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include "inner/kea_factor_i.h"
#include <string.h>

/* ---- budget ---- */

static double workOfLinearization(const MdtKeaSystem *s) {
    return KEA_LINEARIZATION * ((double)s->numRows + s->numBodies);
}

/* ---- passes ---- */

static void linearize(MdtKeaSystem *s) {
    kea_moveBodies(s);
    kea_refreshRows(s, s->work->meanPose, METRUE);
    kea_setMovingRates(s);
    if (s->errors)
        s->errors(s->context, s->work->endPose, s->work->endErrors);
    kea_linearizeBodies(s);
    kea_linearizeRows(s);
    kea_problemSpend(&s->work->problem, workOfLinearization(s));
}

/* The derivatives that only the tangent problem needs: of the bodies' momentum and of the rows' errors. */
static void differentiate(MdtKeaSystem *s) {
    kea_differentiateBodies(s);
    kea_differentiateRows(s);
    kea_problemSpend(&s->work->problem, workOfLinearization(s));
}

static void applyPass(MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        for (int k = 0; k < 6; k++)
            s->work->body[i].u[k] += q->d[i][k];
}

/* Whether the share of the work that the iteration of friction bounds may take is used up. */
static MeBool isFrictionBudgetSpent(const MdtKeaSystem *s) {
    const double share = s->parameters.mayDecline ? kea_workForMotion : kea_workForFriction;
    return s->parameters.maxWork > 0 && s->work->problem.counts.work > share * s->parameters.maxWork;
}

/* One solve of the inner problem. Friction bounds are a fixed point, R = μ p_n(R), of which each pass takes one step,
 * damped from some pass on. Where the iteration does not converge, they are frozen: early if the velocity residual is
 * below its loose tolerance, else after KEA_MAX_COUPLED_PASSES. */
static void solveInnerProblem(MdtKeaSystem *s, int pass, MeBool isGoodEnough, MeBool isExactEnough) {
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

/* One pass. Where passes converge fast, the factors of the last one are tried first. False: the answer has converged,
 * and these factors do not refine it. */
static MeBool runPass(MdtKeaSystem *s, int pass, const KeaResiduals *e, MeBool isConvergingFast) {
    KeaProblem *q = &s->work->problem;
    if (q->hasTangent)
        differentiate(s);
    if (isConvergingFast && kea_problemRefine(q))
        return METRUE;
    if (kea_isConverged(e))
        return MEFALSE;
    solveInnerProblem(s, pass, e->velocity < kea_looseVelocity, isConvergingFast && q->hasTangent);
    return METRUE;
}

/* Whether passes end here. A converged answer is refined once more where that costs no factorization, since it is the
 * warm start of the next step. */
static MeBool isFinal(const KeaProblem *q, const KeaResiduals *e, MeBool isRefined) {
    return isRefined || (kea_isConverged(e) && !(q->isFactored && e->worst > kea_refinedEnough));
}

static void saveIterate(MdtKeaSystem *s, double (*u)[6], double p[]) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(u[i], s->work->body[i].u, sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        p[i] = s->work->problem.row[i].p;
}

static void restoreIterate(MdtKeaSystem *s, double (*const u)[6], const double p[]) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(s->work->body[i].u, u[i], sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = p[i];
    linearize(s);
}

static void restoreBest(MdtKeaSystem *s) {
    restoreIterate(s, s->work->bestU, s->work->bestP);
}

/* Whether the normal of this contact goes through the body's centre, so that the body may turn without changing the
 * contact. */
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

/* The Cayley map turns a body by less than half a turn for any angular velocity: near half a turn, the velocity does
 * not determine the motion. */
static MeBool turnsOver(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (!(s->parameters.stepsize * keaLength(s->work->body[i].u + 3) <= kea_mostTurn) && isTurnRelevant(s, i))
            return METRUE;
    return MEFALSE;
}

/* The matrix of the coupled problem is singular where rows contradict each other; d may then be NaN, infinite, or so
 * large that the squares of distances are, and passes have to end. */
static MeBool isStepFinite(const KeaProblem *q) {
    for (int i = 0; i < q->numBodies; i++)
        for (int k = 0; k < 6; k++)
            if (!(fabs(q->d[i][k]) <= kea_largestChange))
                return MEFALSE;
    return METRUE;
}

/* Whether an iterate that has not converged has more kinetic energy than any motion of the step: than the whole
 * partition at the greatest speed that a body has or that a row aims at. Mean velocities lie between those of the start
 * and of the end, so that no real motion exceeds it. */
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

/* Residuals of the pass. At half a turn the mean of the poses, and with it a row's Jacobian, vanishes, so that a
 * runaway iterate fulfils all rows: its residual is set to infinity. */
static KeaResiduals residualsOfPass(MdtKeaSystem *s, double speed) {
    KeaResiduals e = kea_residuals(s, speed);
    if (turnsOver(s) && isRunaway(s))
        e.position = e.worst = HUGE_VAL;
    return e;
}

/* Fallback for a runaway: the bodies move as if there were no rows. Joints open by no more than the bodies move in one
 * step. */
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

/* Whether to go on with the symmetric problem. Where joints make loops, passes begin with the tangent problem, which
 * follows a linkage through its change point. Its matrix is singular at the change point itself and where joints are
 * redundant; the symmetric problem is regular in both cases. */
static MeBool mustLeaveTangent(const MdtKeaSystem *s, int pass, const KeaResiduals *e) {
    return s->work->problem.hasTangent && s->work->hasLoops && !kea_isConverged(e) &&
           (pass >= KEA_TANGENT_PASSES || !isfinite(e->worst));
}

/* Where joints make no loops, the tangent problem is given up once the residual of position or momentum has grown
 * twice. It can diverge, since the derivative of an angular row's direction is left out of it. */
static MeBool isDiverging(const KeaResiduals *e, double *motion, int *worse) {
    const double before = *motion;
    *motion = keaMax(e->position, e->momentum);
    *worse += *motion > 1 && *motion > before;
    return *worse >= 2;
}

/* Whether the symmetric passes have left the branch of motion that the tangent passes found. They removed joint errors
 * below the rounding ε of attachments, which moves a body by at most sqrt(2 ε) of its size: at a change point a
 * displacement x (in sizes) gives the error x²/2. More means another branch than the one that momentum selects. */
static MeBool hasLeftBranch(const MdtKeaSystem *s) {
    const double most = sqrt(2 * kea_attachmentRounding);
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        double dv[3], dw[3];
        keaSubtract(dv, b->u, s->work->tangentU[i]);
        keaSubtract(dw, b->u + 3, s->work->tangentU[i] + 3);
        if (s->parameters.stepsize * (keaLength(dv) + b->size * keaLength(dw)) > most * b->size)
            return METRUE;
    }
    return MEFALSE;
}

/* Whether passes begin with the tangent problem. Its matrix is not positive definite: where bodies turn far in a step,
 * it may converge to another solution of the equations, one that gains energy. */
static MeBool mayBeTangent(const MdtKeaSystem *s) {
    if (s->work->hasLoops)
        return !s->work->problem.hasFriction; /* where friction holds bodies of a loop, passes do not converge */
    for (int i = 0; i < s->numBodies; i++)
        if (s->parameters.stepsize * keaLength(s->velocity[i].ang) > kea_tangentTurn)
            return MEFALSE;
    return s->work->hasJoints && s->work->problem.hasFriction;
}

/* Writes how the passes have ended: missed positions, capped or limited solves, residuals. */
static void reportMotion(MdtKeaSystem *s, const KeaResiduals *e, MeBool isLimited) {
    const MeBool isMissed = (!s->work->usesTangentAnswer && !kea_isMotionExactEnough(e, 1)) || turnsOver(s);
    s->report.opening = isMissed ? kea_openingLeft(s) : 0;
    s->report.opens = s->report.opening > kea_violentOpening;
    s->report.violent = isMissed && !isLimited;
    s->report.capped = isMissed || !(e->velocity <= kea_looseVelocity);
    s->report.limited = s->report.capped && isLimited;
    s->report.resolution = e->resolution;
    s->report.residual = e->velocity * e->resolution;
    s->report.force = e->impulse / s->parameters.stepsize;
}

/* Newton's method for the step: passes until the residuals are below tolerance, or the budget or the passes are used
 * up. The answer is the best iterate, but the last sweep's if only that is exact in positions; of linkages the tangent
 * one, if symmetric passes leave its branch or do not converge; the motion without rows, if passes run away. */
static void takePasses(MdtKeaSystem *s) {
    int last = KEA_MAX_COUPLED_PASSES + KEA_FROZEN_PASSES;
    KeaProblem *q = &s->work->problem;
    MeBool isLimited = MEFALSE;
    double speed = kea_bodySpeedScale(s);           /* m/s: the largest scale of velocities so far */
    double bestTangent = HUGE_VAL;                  /* the worst residual of the kept tangent iterate */
    KeaResiduals e = {.worst = HUGE_VAL}, best = e; /* of this pass, and of the kept iterate */
    double motion = HUGE_VAL, before = HUGE_VAL;
    int worse = 0;
    MeBool hasTangentAnswer = MEFALSE, isRefined = MEFALSE;
    q->hasTangent = mayBeTangent(s);
    q->isFactored = MEFALSE;
    q->sweptPasses =
        q->sweptPasses > 1 ? q->sweptPasses : 1; /* motions of timed contacts are solved up to three times */
    for (int pass = 0;; pass++) {
        linearize(s);
        speed = keaMax(speed, kea_rowSpeedScale(s));
        e = residualsOfPass(s, speed);
        if (e.worst < best.worst || pass == 0) {
            best = e;
            saveIterate(s, s->work->bestU, s->work->bestP);
        }
        if (q->hasTangent && s->work->hasLoops && e.attachment < 1 && e.worst < bestTangent) {
            bestTangent = e.worst;
            saveIterate(s, s->work->tangentU, s->work->tangentP);
        }
        q->hasTangent = q->hasTangent && (s->work->hasLoops || !isDiverging(&e, &motion, &worse));
        if (mustLeaveTangent(s, pass, &e)) {
            q->hasTangent = MEFALSE;
            restoreBest(s);
            e = kea_residuals(s, speed);
            hasTangentAnswer = bestTangent < HUGE_VAL;
            last = hasTangentAnswer ? pass + KEA_UNUSUAL_PASSES : last;
        }
        if (isFrictionBudgetSpent(s) && q->counts.stuck > 0) {
            if (!q->counts.isLimited && kea_isExactEnough(&best, 1))
                break;
            q->counts.isLimited = METRUE;
        }
        isLimited = q->counts.isLimited;
        const MeBool isConvergingFast = kea_isExactEnough(&e, 1) && e.worst < kea_refinedShare * before;
        before = e.worst;
        if (isFinal(q, &e, isRefined) || pass == last ||
            (isLimited && (s->parameters.mayDecline || kea_isExactEnough(&e, kea_sweptMargin) ||
                           !kea_problemMaySweep(q))))
            break;
        if (isnan(e.worst) || (isinf(e.worst) && isfinite(best.worst) && !q->hasFriction))
            break; /* a runaway: none returns but where its friction is frozen, and the best iterate is taken */
        isRefined = kea_isConverged(&e);
        /* in the first pass contacts alone start from the convex problem, which shares loads evenly */
        q->isWarm = s->work->hasJoints || pass > 0;
        if (!runPass(s, pass, &e, isConvergingFast))
            break;
        if (!isStepFinite(q)) {
            e.worst = HUGE_VAL;
            break;
        }
        kea_noteInconsistent(s);
        applyPass(s);
        kea_admitContacts(s);
        s->report.passes++;
    }
    if (!(e.worst <= best.worst) &&
        (kea_isMotionExactEnough(&best, 1) || !(isLimited && e.position <= kea_loosePosition))) {
        restoreBest(s);
        e = kea_residuals(s, speed);
    }
    s->work->usesTangentAnswer = hasTangentAnswer && (!kea_isConverged(&e) || hasLeftBranch(s));
    if (s->work->usesTangentAnswer) {
        restoreIterate(s, s->work->tangentU, s->work->tangentP);
        e = kea_residuals(s, speed);
    }
    if (!kea_isConverged(&e) && isRunaway(s)) {
        moveWithoutRows(s);
        e = kea_residuals(s, speed);
    }
    q->hasTangent = q->isWarm = q->isFactored = MEFALSE;
    s->report.conflicting = kea_isConflicting(s);
    s->work->isInconsistent = kea_isInconsistent(s);
    reportMotion(s, &e, isLimited);
}

static void markFreeBodies(MdtKeaSystem *s) {
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

/* Forces, N, clamped: bounds may move with the bodies (MdtKeaJacobianFn), and p was solved with those of the pass
 * before. */
static void storeForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &s->work->problem.row[i];
        const double within = p->normal >= 0 ? p->p : keaMin(keaMax(p->p, p->lower), p->upper);
        s->rows[i].force = within / s->parameters.stepsize;
    }
}

/* Passes, started from the last step's forces and accelerations. */
static void solveMotion(MdtKeaSystem *s) {
    kea_beginRows(s);
    kea_guessMotion(s);
    takePasses(s);
    kea_balanceMomentum(s);
}

/* Finds the motion up to the first event. A contact that stops sliding needs a second solve, in which its friction
 * still acts against the sliding of the start, to find the time of the stop; if that is after the end of the step, the
 * first solution was right. Where contacts that meet slowly are held, there is a solve more, without their impacts. */
static void solveToFirstEvent(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    MeBool mustRepeat, isNew;
    double event = kea_firstEvent(s, &mustRepeat);
    while (s->report.trembles && kea_holdMeeting(s)) {
        solveMotion(s);
        event = kea_firstEvent(s, &mustRepeat);
    }
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

/* Whether a body turns too far for the midpoint rule, which turns a body with different moments too little by (h w)²/12
 * and lets a fast top precess wrongly. Bodies with contacts (θ = 1) are not checked; if any contact acts, the others
 * may turn five times as far: the error, 2 % of the angle, is less than what an impact loses. */
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

/* Whether all rows are those of open contacts: the bodies then move ballistically up to the first time of impact. Not
 * where a body turns by half a turn or so: rates of its contacts do not predict the time of impact. */
static MeBool isBallistic(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 || !s->rows[s->rows[i].contact].isOpen)
            return MEFALSE;
    for (int b = 0; b < s->numBodies; b++)
        if (s->parameters.stepsize * keaLength(s->velocity[b].ang) > kea_mostTurn && isTurnRelevant(s, b))
            return MEFALSE;
    return s->parameters.timed;
}

MeBool MEAPI MdtKeaFlies(MdtKeaSystem *s) {
    kea_timedBegin(s);
    return isBallistic(s);
}

static void moveBallistically(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    kea_moveFreely(s);
    s->report.ballistic = METRUE;
    s->report.event = kea_firstEventOfFlight(s);
    kea_problemSpend(&s->work->problem, KEA_VISIT * ((double)s->numRows + s->numBodies));
    kea_reportWork(s);
}

/* Whether the work would end before the answer does, as even simple steps take so many factorizations. */
static MeBool isTooExpensive(const MdtKeaSystem *s) {
    return s->parameters.mayDecline && s->parameters.maxWork > 0 &&
           KEA_ORDINARY_FACTORIZATIONS * kea_factorFlops(s->work->problem.factor) > s->parameters.maxWork;
}

/* m/s: what a row may leave; its load and masses do not count, as Newton's method does not leave more where they
 * differ. */
static double tolerance(const MdtKeaSystem *s) {
    double most = 0;
    for (int i = 0; i < s->numBodies; i++) {
        double change[3];
        keaSubtract(change, s->work->end[i].velocity, s->velocity[i].lin);
        most = keaMax(most, keaLength(change));
    }
    return s->parameters.accuracy + kea_changeShare * most;
}

/* The answer is left as it is. */
static void decline(MdtKeaSystem *s) {
    s->report.declined = s->report.limited = METRUE;
    s->report.least = KEA_ORDINARY_FACTORIZATIONS * kea_factorFlops(s->work->problem.factor);
    s->report.residual = s->report.excess = HUGE_VAL;
    kea_moveFreely(s);
    kea_reportWork(s);
}

void kea_exactSolve(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    memset(&q->counts, 0, sizeof q->counts);
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
    s->report.least = KEA_SWEPT_PASSES * workOfLinearization(s);
    kea_beginBodies(s);
    if (s->parameters.timed)
        kea_timedBegin(s);
    if (isBallistic(s)) {
        moveBallistically(s);
        return;
    }
    kea_beginRows(s);
    if (s->parameters.mayRefuse && s->numRows > 0 && turnsTooFar(s)) {
        s->report.violent = s->report.refused = METRUE;
        kea_moveFreely(s); /* a defined end of the step, should the caller integrate it all the same */
        return;
    }
    s->report.capped = s->numRows > 0; /* stays if kea_problemBegin has no memory */
    if (s->numRows > 0 && kea_problemBegin(q, s->cache)) {
        if (isTooExpensive(s)) {
            decline(s);
            return;
        }
        if (s->parameters.timed) /* its rows were made for this part of the step alone */
            kea_problemSpend(q, workOfLinearization(s));
        kea_setBudget(s, kea_workForMotion, KEA_SWEPT_PASSES);
        s->work->hasLoops = kea_hasLoops(s);
        s->work->hasJoints = hasJoint(s);
        kea_dualBegin(s);
        solveMotion(s);
        if (s->parameters.timed)
            solveToFirstEvent(s);
        markFreeBodies(s);
        kea_setBudget(s, 1, 1);
        if (!s->parameters.timed || s->work->hasJoints)
            kea_velocityStage(s);
        kea_minimizeRedundantForces(s);
        storeForces(s);
    }
    kea_moveFreely(s);
    if (s->parameters.timed && s->numRows > 0 && q->factor) /* null: there was no memory */
        kea_project(s);
    kea_reportWork(s);
    s->report.declined = s->report.limited && s->parameters.mayDecline;
    s->report.excess = s->report.capped ? s->report.residual / tolerance(s) : 0;
}
