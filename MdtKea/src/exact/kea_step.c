/* One step of one partition by the exact solver.
 *
 *     begin: the rows that can act, θ of each body, warm start from the last step's answer
 *     passes: move bodies by u; evaluate rows at the mean of the poses; solve the inner problem for the change of u;
 *             until the residuals are below tolerance
 *     velocity stage: the velocities nearest to v⁺ that joints and contacts allow at the end poses
 *
 * Passes solve the tangent problem (kea_problem_i.h), which is Newton's method for the geometry, if a partition without
 * loops has joints and friction, and no body rotates far. If joints form loops without friction, only the first passes
 * do; if they form loops with friction, none.
 *
 * A pass is at once a Newton iteration for the geometry, a proximal step for rigid rows, and an update of the friction
 * bounds. If the last step's answer is within the tolerances, there is no pass and no factorization. Where all rows are
 * fixed, as those of vehicles' wheels, passes but the first keep metric and factors.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include "inner/kea_factor_i.h"
#include <string.h>

/* The state of the passes of a solve. */
typedef struct Passes {
    KeaResiduals e, best;  /* of the present iterate, and of the best one, which is saved */
    double speed;          /* m/s: the largest scale of velocities so far */
    double tangent;        /* the worst residual of the saved tangent iterate; HUGE_VAL: there is none */
    double before, motion; /* in the previous pass: the worst residual; the larger one of positions and momenta */
    int pass, last;        /* index of this pass; index after which they end */
    int worse;             /* number of passes in which `motion` has grown */
    int slow, patience;    /* passes in a row that left more than half of the residual; how many begin tangent ones */
    double mark;           /* the worst residual of the pass `marked`, the last one that left less than half of it */
    int marked;
    MeBool isRefined;     /* the iterate had converged before this pass, which refines it */
    MeBool movesContacts; /* contacts follow the bodies: until they stay, at most KEA_CONTACT_PASSES times */
    MeBool isLimited;     /* the work budget is used up */
    MeBool mayBeTangent;  /* symmetric passes have followed the tangent ones: the saved tangent iterate may be better */
} Passes;

/* Result of a pass. */
typedef enum PassResult {
    PASS_CHANGED,
    PASS_CONVERGED, /* the answer had converged, and kept factors do not refine it: nothing was changed */
    PASS_DIVERGED   /* the change is not finite, and was not applied */
} PassResult;

/* ---- passes ---- */

/* Moves the bodies by u, and linearizes momentum and rows there. With moveContacts, contacts follow the bodies; returns
 * whether some have. */
static MeBool linearizeIterate(MdtKeaSystem *s, MeBool moveContacts) {
    kea_moveBodies(s);
    const MeBool haveMoved = moveContacts && kea_moveContacts(s, s->report.passes == 0);
    s->work->contactPasses += haveMoved;
    kea_refreshRows(s, s->work->meanPose, METRUE);
    kea_setMovingRates(s);
    kea_evaluateErrors(s, s->work->endErrors);
    kea_linearizeBodies(s);
    kea_linearizeRows(s);
    kea_problemAddWork(&s->work->problem, kea_problemWorkOfLinearization(&s->work->problem));
    return haveMoved;
}

/* Sets the derivatives that only the tangent problem needs: of the bodies' momentum and of the rows' errors. */
static void differentiateIterate(MdtKeaSystem *s) {
    kea_differentiateBodies(s);
    kea_differentiateRows(s);
    kea_problemAddWork(&s->work->problem, kea_problemWorkOfLinearization(&s->work->problem));
}

/* Solves the inner problem once. Friction bounds are a fixed point, R = μ p_n(R), and each pass makes one step of its
 * iteration, damped from some pass on. If the iteration does not converge, bounds are frozen: early if the velocity
 * residual is below its loose tolerance, else after KEA_MAX_COUPLED_PASSES. */
static void solveInnerProblem(MdtKeaSystem *s, int pass, MeBool isGoodEnough, MeBool isExactEnough) {
    KeaProblem *q = &s->work->problem;
    if (kea_dualSolve(s))
        return;
    const MeBool isFrozen = q->counts.stuck > 0 && pass >= (isGoodEnough ? KEA_FREEZE_PASS : KEA_MAX_COUPLED_PASSES);
    if (isFrozen && q->counts.freezes == 0)
        kea_frictionSetBounds(q);
    else if (!isFrozen && pass > 0)
        kea_frictionIterateBounds(q, pass);
    q->counts.freezes += isFrozen;
    q->counts.stuck = !kea_problemSolve(q, !isFrozen) || isFrozen;
    q->counts.level += (!q->counts.stuck && !isExactEnough) || isFrozen;
    q->hasTangent = q->hasTangent && !(q->isSingular && s->work->hasLoops);
}

/* Copies u and p of the present iterate. */
static void saveIterate(MdtKeaSystem *s, double (*u)[6], double p[]) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(u[i], s->work->body[i].u, sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        p[i] = s->work->problem.row[i].p;
}

/* Restores u and p of a saved iterate. Returns its residuals. */
static KeaResiduals restoreIterate(MdtKeaSystem *s, double (*const u)[6], const double p[], double speed) {
    for (int i = 0; i < s->numBodies; i++)
        memcpy(s->work->body[i].u, u[i], sizeof u[i]);
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = p[i];
    linearizeIterate(s, MEFALSE);
    return kea_residuals(s, speed);
}

/* Whether a body with the angular velocity w rotates by about half a turn in the step, and its orientation matters to
 * its rows: it does not for a ball whose contacts all push towards its centre. */
static MeBool turnsOver(const MdtKeaSystem *s, int body, const double w[3]) {
    if (s->parameters.stepsize * keaLength(w) <= kea_maxTurn)
        return MEFALSE;
    if (!s->work->body[body].isSpatial)
        return METRUE;
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++) {
            const MdtKeaRow *normal = s->rows[i].contact < 0 ? NULL : &s->rows[s->rows[i].contact];
            const MeBool isCentred =
                normal && normal->radius[k] > 0 && keaLength(normal->J[k].ang) <= kea_centredArm * normal->radius[k];
            if (s->rows[i].body[k] == body && !isCentred)
                return METRUE;
        }
    return MEFALSE;
}

/* The number of bodies that turn over with the present iterate. The Cayley map rotates a body by less than half a turn
 * for any angular velocity: near half a turn, the velocity does not determine the motion. */
static int countTurnedOver(const MdtKeaSystem *s) {
    int count = 0;
    for (int i = 0; i < s->numBodies; i++)
        count += turnsOver(s, i, s->work->body[i].u + 3);
    return count;
}

/* Whether an iterate that has not converged has more kinetic energy than is possible in the step: ten times that of the
 * whole partition at the largest speed that a body has or that is the target of a row. Mean velocities lie between
 * those of the start and of the end, so that no real motion exceeds it. The factor is for answers that are cut short,
 * whose energy is limited later. */
static MeBool isRunaway(const MdtKeaSystem *s) {
    double energy = 0, mass = 0, speed = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const KeaBody *body = &s->work->body[b];
        const double u = keaLength(body->u) + body->size * keaLength(body->u + 3), m = 1 / s->bodies[b]->invMass;
        speed = keaMax(speed, keaLength(s->bodies[b]->velocity) + keaLength(s->predicted[b].lin) +
                                  body->size * keaLength(s->velocity[b].ang));
        energy += m * u * u;
        mass += m;
    }
    for (int i = 0; i < s->numRows; i++)
        speed = keaMax(speed, kea_pushSpeed(s, &s->rows[i], s->rows[i].target));
    return !(energy <= 10 * mass * speed * speed);
}

/* Residuals of the present iterate. At half a turn the mean of the poses, and with it a row's Jacobian, vanishes, so
 * that a runaway iterate fulfils all rows: its residual is set to infinity. */
static KeaResiduals residualsOfPass(MdtKeaSystem *s, double speed) {
    KeaResiduals e = kea_residuals(s, speed);
    if (countTurnedOver(s) > 0 && isRunaway(s))
        e.position = e.worst = HUGE_VAL;
    return e;
}

/* Fallback for a runaway: moves the bodies as if there were no rows. Joints open by no more than the bodies move in one
 * step. */
static void moveWithoutRows(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        KeaBody *body = &s->work->body[b];
        for (int k = 0; k < 3; k++) {
            const double v = s->bodies[b]->velocity[k], w = s->velocity[b].ang[k];
            body->u[k] = v + body->theta * (s->predicted[b].lin[k] - v);
            body->u[3 + k] = w + body->theta * (s->predicted[b].ang[k] - w);
        }
    }
    for (int i = 0; i < s->numRows; i++)
        s->work->problem.row[i].p = 0;
    linearizeIterate(s, MEFALSE);
}

/* Whether the symmetric passes have left the branch of motion that the tangent passes found. They removed joint errors
 * below the rounding ε of attachments, which moves a body by at most sqrt(2 ε) of its size: at a change point a
 * displacement x (in sizes) gives the error x²/2. More means another branch than the one that momentum selects. */
static MeBool hasLeftBranch(const MdtKeaSystem *s) {
    const double max = sqrt(2 * kea_attachmentRounding);
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        double dv[3], dw[3];
        keaSubtract(dv, b->u, s->work->tangentU[i]);
        keaSubtract(dw, b->u + 3, s->work->tangentU[i] + 3);
        if (s->parameters.stepsize * (keaLength(dv) + b->size * keaLength(dw)) > max * b->size)
            return METRUE;
    }
    return MEFALSE;
}

/* Reports how the passes have ended: unfulfilled position rows, capped or limited solves, residuals. */
static void reportMotion(MdtKeaSystem *s, const KeaResiduals *e, MeBool isLimited) {
    const MeBool isMissed = (!s->work->usesTangentAnswer && !kea_isMotionExactEnough(e, 1)) || countTurnedOver(s) > 0;
    s->report.opening = isMissed ? kea_uncorrectedOpening(s) : 0;
    s->report.opens = s->report.opening > kea_violentOpening;
    s->report.violent = isMissed && !isLimited;
    s->report.capped = isMissed || !(e->velocity <= kea_looseVelocity);
    s->report.limited = s->report.capped && isLimited;
    s->report.resolution = e->resolution;
    s->report.residual = e->velocity * e->resolution;
    s->report.force = e->impulse / s->parameters.stepsize;
}

/* Whether passes begin with the tangent problem. Its matrix is not positive definite: if bodies rotate far in a step,
 * it may converge to another solution of the equations, one with more energy. */
static MeBool mayBeTangent(const MdtKeaSystem *s) {
    if (s->work->hasLoops)
        return !s->work->problem.hasFriction; /* with sticking friction on bodies of a loop passes do not converge */
    for (int i = 0; i < s->numBodies; i++)
        if (s->parameters.stepsize * keaLength(s->velocity[i].ang) > kea_tangentTurn)
            return MEFALSE;
    return s->work->hasJoints && s->work->problem.hasFriction;
}

/* The state before the first pass. */
static Passes beginPasses(MdtKeaSystem *s) {
    const KeaResiduals unknown = {.worst = HUGE_VAL};
    KeaProblem *q = &s->work->problem;
    q->hasTangent = mayBeTangent(s);
    q->isChord = s->work->areRowsFixed && !q->hasTangent;
    q->isFactored = MEFALSE;
    q->sweptPasses =
        q->sweptPasses > 1 ? q->sweptPasses : 1; /* at least one: timed steps are solved up to three times */
    return (Passes){.e = unknown,
                    .best = unknown,
                    .speed = kea_bodySpeedScale(s),
                    .tangent = HUGE_VAL,
                    .before = HUGE_VAL,
                    .motion = HUGE_VAL,
                    .mark = HUGE_VAL,
                    .patience = 1,
                    .movesContacts = METRUE,
                    .last = KEA_MAX_COUPLED_PASSES + KEA_FROZEN_PASSES};
}

/* Computes the residuals of the present iterate; saves it if it is the best one, or the best tangent one with joint
 * errors below the rounding of attachments. */
static void measurePass(MdtKeaSystem *s, Passes *p) {
    p->movesContacts = linearizeIterate(s, p->movesContacts) && p->pass + 1 < KEA_CONTACT_PASSES;
    p->speed = keaMax(p->speed, kea_rowSpeedScale(s));
    p->e = residualsOfPass(s, p->speed);
    p->movesContacts = p->movesContacts && p->e.worst < p->before;
    s->work->problem.counts.slow += p->e.worst > 0.5 * p->before;
    if (p->e.worst < 0.5 * p->mark) {
        p->mark = p->e.worst;
        p->marked = p->pass;
    }
    if (p->e.worst < p->best.worst || p->pass == 0) {
        p->best = p->e;
        saveIterate(s, s->work->bestU, s->work->bestP);
    }
    if (s->work->problem.hasTangent && s->work->hasLoops && p->e.attachment < 1 && p->e.worst < p->tangent) {
        p->tangent = p->e.worst;
        saveIterate(s, s->work->tangentU, s->work->tangentP);
    }
}

static MeBool areChains(const MdtKeaSystem *s) {
    return s->work->hasJoints && !s->work->hasLoops && !s->work->problem.hasFriction;
}

/* Whether symmetric passes of chains converge linearly, since they leave out a part of the geometric stiffness that is
 * not small: light links whose axes are pressed against narrow cones. */
static MeBool convergesSlowly(const MdtKeaSystem *s, Passes *p) {
    if (!areChains(s) || p->pass < KEA_ORDINARY_PASSES)
        return MEFALSE;
    p->slow = p->e.worst > 0.5 * p->before && p->e.worst < p->before ? p->slow + 1 : 0;
    return p->slow >= p->patience;
}

/* Begins tangent passes; if they are given up, twice as many slow passes begin them again. */
static void beginTangent(KeaProblem *q, Passes *p) {
    q->hasTangent = METRUE;
    p->motion = HUGE_VAL;
    p->worse = p->slow = 0;
    p->patience *= 2;
}

/* Chooses between the tangent and the symmetric problem. If joints form loops, passes begin with the tangent problem,
 * which follows a linkage through its change point. Its matrix is singular at the change point itself and for redundant
 * joints; the symmetric problem is regular in both cases, and takes over after KEA_TANGENT_PASSES. Without loops and
 * friction, passes begin with the symmetric problem, and the tangent one takes over if they converge slowly. There the
 * tangent problem is given up once the residual of position or momentum has grown twice: it can diverge, since it does
 * not contain the derivative of an angular row's direction. */
static void chooseProblem(MdtKeaSystem *s, Passes *p) {
    KeaProblem *q = &s->work->problem;
    if (!q->hasTangent && convergesSlowly(s, p))
        beginTangent(q, p);
    if (!q->hasTangent)
        return;
    if (!s->work->hasLoops) {
        const double motion = keaMax(p->e.position, p->e.momentum);
        p->worse += motion > 1 && motion > p->motion;
        p->motion = motion;
        q->hasTangent = p->worse < 2;
    } else if (!kea_isConverged(&p->e) && (p->pass >= KEA_TANGENT_PASSES || !isfinite(p->e.worst))) {
        q->hasTangent = MEFALSE;
        p->e = restoreIterate(s, s->work->bestU, s->work->bestP, p->speed);
        p->mayBeTangent = p->tangent < HUGE_VAL;
        p->last = p->mayBeTangent ? p->pass + KEA_UNUSUAL_PASSES : p->last;
    }
}

/* Whether passes leave what remains because contacts that share a load with joints contradict each other by rounding.
 * Further ones would move the load from one contact to the other until one has none. */
static MeBool areRatesRounded(const MdtKeaSystem *s, const Passes *p) {
    return s->work->hasJoints && p->pass > 1 && p->e.worst > 0.5 * p->before && p->e.position < 1 &&
           p->e.momentum < 1 && p->e.velocity * p->e.resolution <= kea_roundingOfRates(s);
}

/* Whether passes end with this iterate. A converged answer is refined once more if that costs no factorization, since
 * it is the warm start of the next step. Passes recover from a runaway only if its friction can still be frozen. Sets
 * isLimited. */
static MeBool isLastPass(MdtKeaSystem *s, Passes *p) {
    KeaProblem *q = &s->work->problem;
    const double share = s->parameters.mayDecline ? kea_workForMotion : kea_workForFriction;
    const MeBool isFrictionSpent =
        s->parameters.maxWork > 0 && q->counts.stuck > 0 && q->counts.work > share * s->parameters.maxWork;
    const MeBool isPaid = s->parameters.mayDecline && !s->work->hasJoints &&
                          q->counts.work > s->parameters.ordinaryWork &&
                          q->counts.factorizations > KEA_ORDINARY_FACTORIZATIONS;
    if (isFrictionSpent && !q->counts.isLimited && kea_isExactEnough(&p->best, isPaid ? kea_paidMargin : 1))
        return METRUE;
    p->isLimited = q->counts.isLimited = q->counts.isLimited || isFrictionSpent;
    const MeBool isEnough =
        p->isRefined || (kea_isConverged(&p->e) && !(q->isFactored && !q->isChord && p->e.worst > kea_refinedEnough));
    const MeBool isCut = p->isLimited && (s->parameters.mayDecline || kea_isExactEnough(&p->e, kea_sweptMargin) ||
                                          !kea_problemMaySweep(q));
    const MeBool hasRunAway = isnan(p->e.worst) || (isinf(p->e.worst) && isfinite(p->best.worst) && !q->hasFriction);
    const double margin = isPaid ? kea_paidMargin : kea_sweptMargin;
    const MeBool mayEnd = areChains(s) || (!s->work->hasJoints && kea_isExactEnough(&p->best, margin));
    const int patience = isPaid ? 0 : KEA_STUCK_PASSES;
    const MeBool isStuck = mayEnd && p->pass - p->marked > patience; /* of chains: the step is too long */
    return isEnough || areRatesRounded(s, p) || isCut || hasRunAway || isStuck || p->pass == p->last;
}

/* Solves the inner problem and applies its answer. If passes converge fast, the factors of the last one are tried
 * first. The matrix of the coupled problem is singular if rows contradict each other; the change d may then be NaN,
 * infinite, or so large that squares of distances overflow. */
static PassResult runPass(MdtKeaSystem *s, Passes *p) {
    KeaProblem *q = &s->work->problem;
    const MeBool isConvergingFast = kea_isExactEnough(&p->e, 1) && p->e.worst < kea_refinedShare * p->before;
    MeBool isFinite = METRUE;
    p->before = p->e.worst;
    p->isRefined = kea_isConverged(&p->e);
    q->isWarm = s->work->hasJoints || p->pass > 0; /* without joints the first pass is convex, to share loads evenly */
    if (q->hasTangent)
        differentiateIterate(s);
    if (!isConvergingFast || !kea_problemRefine(q)) {
        if (p->isRefined)
            return PASS_CONVERGED;
        solveInnerProblem(s, p->pass, p->e.velocity < kea_looseVelocity,
                          q->isChord || (isConvergingFast && q->hasTangent));
    }
    for (int i = 0; i < q->numBodies; i++)
        for (int k = 0; k < 6; k++)
            isFinite = isFinite && fabs(q->d[i][k]) <= kea_largestChange;
    if (!isFinite)
        return PASS_DIVERGED;
    kea_markInconsistentJoints(s);
    for (int i = 0; i < s->numBodies; i++)
        for (int k = 0; k < 6; k++)
            s->work->body[i].u[k] += q->d[i][k];
    kea_admitContacts(s);
    s->report.passes++;
    return PASS_CHANGED;
}

/* Chooses the answer: the best iterate; the last one by sweeps, if only that is exact in positions; for linkages the
 * tangent one, if symmetric passes leave its branch or do not converge; the motion without rows, if the iterate is a
 * runaway. Returns its residuals. */
static KeaResiduals chooseAnswer(MdtKeaSystem *s, const Passes *p) {
    KeaResiduals e = p->e;
    const MeBool isSweepExact =
        p->isLimited && e.position <= kea_loosePosition && !kea_isMotionExactEnough(&p->best, 1);
    if (!(e.worst <= p->best.worst) && !isSweepExact)
        e = restoreIterate(s, s->work->bestU, s->work->bestP, p->speed);
    s->work->usesTangentAnswer = p->mayBeTangent && (!kea_isConverged(&e) || hasLeftBranch(s));
    if (s->work->usesTangentAnswer)
        e = restoreIterate(s, s->work->tangentU, s->work->tangentP, p->speed);
    if (!kea_isConverged(&e) && isRunaway(s)) {
        moveWithoutRows(s);
        e = kea_residuals(s, p->speed);
    }
    return e;
}

/* Newton's method for the step: makes passes until the residuals are below tolerance, or the budget or the number of
 * passes is used up. */
static void runPasses(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    Passes p = beginPasses(s);
    for (PassResult result = PASS_CHANGED; result == PASS_CHANGED; p.pass++) {
        measurePass(s, &p);
        chooseProblem(s, &p);
        if (isLastPass(s, &p))
            break;
        result = runPass(s, &p);
        if (result == PASS_DIVERGED)
            p.e.worst = HUGE_VAL;
    }
    const KeaResiduals e = chooseAnswer(s, &p);
    q->hasTangent = q->isWarm = q->isFactored = q->isChord = MEFALSE;
    s->report.conflicting = kea_isConflicting(s);
    s->work->isInconsistent = kea_isInconsistent(s);
    reportMotion(s, &e, p.isLimited);
}

/* Clears isFree of all bodies that an active row acts on; contacts without force do not count. */
static void markFreeBodies(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].isFree = METRUE;
    for (int i = 0; i < s->numRows; i++) {
        if (s->work->problem.row[i].isInactive || (s->rows[i].contact >= 0 && s->work->problem.row[i].p == 0))
            continue;
        for (int k = 0; k < 2; k++)
            if (s->rows[i].body[k] >= 0)
                s->work->body[s->rows[i].body[k]].isFree = MEFALSE;
    }
}

/* Stores the forces of rows, N, clamped: bounds may change with the poses (MdtKeaJacobianFn), and p was solved with
 * those of the previous pass. */
static void storeForces(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &s->work->problem.row[i];
        const double within = p->normal >= 0 ? p->p : keaMin(keaMax(p->p, p->lower), p->upper);
        s->rows[i].force = within / s->parameters.stepsize;
    }
}

/* Runs the passes of rows that have begun, starting from the last step's accelerations, and computes end velocities. */
static void solveMotion(MdtKeaSystem *s) {
    kea_guessMotion(s);
    runPasses(s);
    kea_chooseMoveThetas(s);
    kea_balanceMomentum(s);
}

/* Solves the motion anew, starting from the last step's forces. */
static void repeatMotion(MdtKeaSystem *s) {
    kea_beginRows(s);
    solveMotion(s);
}

/* N m s: the torque about the world's origin of a contact's impulses on its two bodies, in the mean of the step. */
static double torqueOfPair(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double sum[3] = {0};
    for (int k = 0; k < 2; k++) {
        double mean[3], torque[3];
        keaCopy(mean, s->bodies[p->body[k]]->position);
        keaAddScaled(mean, 1, s->work->end[p->body[k]].position);
        keaScale(mean, 0.5, mean);
        keaCross(torque, mean, p->J[k]);
        keaAddScaled(sum, p->p, torque);
        keaAddScaled(sum, p->p, p->J[k] + 3);
    }
    return keaLength(sum);
}

/* Whether the lever arms of a contact of jointed bodies are not those of the motion that was found: they follow only a
 * first guess of it, as passes under heavy loads would not converge. */
static MeBool isTwisted(const MdtKeaSystem *s) {
    const KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &q->row[i];
        if (s->rows[i].contact < 0 || p->p == 0 || p->body[0] < 0 || p->body[1] < 0)
            continue;
        if (!s->work->body[p->body[0]].isTied && !s->work->body[p->body[1]].isTied)
            continue;
        double scale = 0;
        for (int k = 0; k < 2; k++)
            scale = keaMax(scale, q->scale[p->body[k]] * q->length[p->body[k]]);
        if (torqueOfPair(s, i) > kea_maxTwist * scale)
            return METRUE;
    }
    return MEFALSE;
}

/* Finds the first event, and the motion up to it. A contact that stops sliding needs a second solve, in which its
 * friction still acts against the sliding of the start, to find the time of the stop; if that is after the end of the
 * step, the first solution was right. After slow contacts have been closed from the start (holdsSlow), the step is
 * solved again. */
static void solveToFirstEvent(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    MeBool mustRepeat, isNew;
    double event = kea_firstEvent(s, &mustRepeat);
    while (s->report.trembles && kea_closeSlowContacts(s) > 0) {
        repeatMotion(s);
        event = kea_firstEvent(s, &mustRepeat);
    }
    if (mustRepeat) {
        repeatMotion(s);
        event = kea_firstEvent(s, &isNew);
        if (event > h) {
            kea_releaseFriction(s);
            repeatMotion(s);
        }
    }
    s->report.event = keaMin(event, h);
    s->report.twisted = isTwisted(s);
    MEASSERT(s->report.event >= 0);
}

/* Whether a body rotates too far for the midpoint rule, which rotates bodies with different moments too little by a
 * fraction (h w)²/12 and lets a fast top precess wrongly. Bodies with contacts (θ = 1) are not checked; if any contact
 * acts, the others may rotate five times as far: the error, 2 % of the angle, is less than what an impact loses. */
static MeBool turnsTooFar(const MdtKeaSystem *s) {
    double far = kea_farTurn; /* rad, times the moments' relative difference */
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && !s->work->problem.row[i].isInactive)
            far = 5 * kea_farTurn;
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        if (b->theta < 1 && !b->isSpatial &&
            kea_turnsFar(s->bodies[i]->moments, s->parameters.stepsize * keaLength(s->velocity[i].ang), far))
            return METRUE;
    }
    return MEFALSE;
}

/* Whether all rows of a timed step are those of open contacts: the bodies then move ballistically up to the first time
 * of impact. False if a body rotates by about half a turn: rates of its contacts do not predict the time of impact. */
static MeBool isBallistic(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 || !s->rows[s->rows[i].contact].isOpen)
            return MEFALSE;
    for (int b = 0; b < s->numBodies; b++)
        if (turnsOver(s, b, s->velocity[b].ang))
            return MEFALSE;
    return s->parameters.timed;
}

MeBool MEAPI MdtKeaFlies(MdtKeaSystem *s) {
    kea_markOpenContacts(s);
    return isBallistic(s);
}

/* Moves all bodies freely, and reports the first event. */
static void moveBallistically(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    kea_moveFreeBodies(s);
    s->report.ballistic = METRUE;
    s->report.event = kea_firstEventOfFlight(s);
    kea_problemAddWork(&s->work->problem, KEA_VISIT * ((double)s->numRows + s->numBodies));
    kea_reportWork(s);
}

/* m/s: the residual that a row may have. Unlike the fast solver's tolerance it does not depend on the row's load and
 * mass ratio, since the residual of Newton's method does not. */
static double residualTolerance(const MdtKeaSystem *s) {
    double max = 0;
    for (int i = 0; i < s->numBodies; i++) {
        double change[3];
        keaSubtract(change, s->work->end[i].velocity, s->velocity[i].lin);
        max = keaMax(max, keaLength(change));
    }
    return s->parameters.accuracy + kea_changeShare * max;
}

/* Whether an answer for which the work did not suffice is better than the one that would replace it. */
static MeBool isAcceptable(const MdtKeaSystem *s) {
    return !s->work->hasJoints && s->report.residual <= s->parameters.acceptable;
}

/* Declines the solve, which would take at least `work`: the bodies get the end states of free motion. */
static void declineSolve(MdtKeaSystem *s, double work) {
    s->report.declined = s->report.limited = METRUE;
    s->report.least = work;
    s->report.residual = s->report.excess = HUGE_VAL;
    kea_moveFreeBodies(s);
    kea_reportWork(s);
}

/* Solves the rows. False: it was declined, as the work does not suffice for one factorization. */
static MeBool solveRows(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    const double min = kea_factorFlops(q->factor);
    if (s->parameters.mayDecline && s->parameters.maxWork > 0 && min > s->parameters.maxWork) {
        declineSolve(s, min);
        return MEFALSE;
    }
    if (s->parameters.timed) /* its rows were made for this sub-step only */
        kea_problemAddWork(q, kea_problemWorkOfLinearization(q));
    kea_setBudget(s, kea_workForMotion, KEA_SWEPT_PASSES);
    s->work->hasLoops = kea_hasLoops(s);
    kea_dualChooseFactor(s);
    solveMotion(s);
    if (s->parameters.timed)
        solveToFirstEvent(s);
    markFreeBodies(s);
    kea_setBudget(s, 1, 1);
    if (!s->parameters.timed || s->work->hasJoints)
        kea_velocityStage(s);
    kea_limitRolling(s);
    kea_minimizeRedundantForces(s);
    storeForces(s);
    return METRUE;
}

void kea_exactSolve(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    memset(&q->counts, 0, sizeof q->counts);
    s->work->contactPasses = 0;
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
    s->report.least = KEA_SWEPT_PASSES * kea_problemWorkOfLinearization(q);
    kea_beginBodies(s);
    if (s->parameters.timed)
        kea_markOpenContacts(s);
    if (isBallistic(s)) {
        moveBallistically(s);
        return;
    }
    kea_beginRows(s);
    if (s->parameters.mayRefuse && s->numRows > 0 && turnsTooFar(s)) {
        s->report.violent = s->report.refused = METRUE;
        kea_moveFreeBodies(s); /* defined end states, in case that the caller integrates all the same */
        return;
    }
    s->report.capped = s->numRows > 0; /* remains true if kea_problemBegin has no memory */
    if (s->numRows > 0 && kea_problemBegin(q, s->cache) && !solveRows(s))
        return;
    kea_moveFreeBodies(s);
    if (s->parameters.timed && s->numRows > 0 && q->factor) /* null: there was no memory */
        kea_projectPositions(s);
    kea_reportWork(s);
    s->report.declined = s->report.limited && s->parameters.mayDecline && !isAcceptable(s);
    s->report.excess = s->report.capped ? s->report.residual / residualTolerance(s) : 0;
}
