/* Linearization of the rows of a system: J, E, r and N of the inner problem in each pass, and θ of each body.
 *
 * With d the change of u in a pass, p the impulses, φ_k and v_k⁺ the errors and end velocities after the last pass,
 * every row is J d + E p = r:
 *
 *   position:  φ⁺ = φ_0 + h (s - E p)             r = s - (φ_k - φ_0)/h
 *   spring:    p = h [F(φ⁺) - kd (J u - s)], F the mean force of the step (meanForce), linearized at the last pass:
 *              1/E = h² |dF/dφ⁺| + h kd,   r = E h [F - kd (J u_k - s)]
 *   velocity:  J v⁺ = s - E p, v⁺ = v + (u - v)/θ     r = θ (s - J v_k⁺), E := θ E
 *
 * θ of the unknown u is chosen per body. It is 1 for bodies on which a contact may act, or a stop acts, so that these
 * rows constrain v⁺ and not only the mean velocity; and for bodies with a spring that is too stiff for the midpoint
 * rule. Both bodies of a velocity row have the same θ, since otherwise the J of its rate would differ from that of its
 * impulse.
 *
 * A body without position rows and springs is untied: no row constrains its displacement. Whatever its θ, it is moved
 * by the mean velocity, which is symmetric in time, or by v⁺ if the mean would press a contact deeper
 * (KeaBody.moveTheta).
 *
 * The rate J v⁺ of a contact is evaluated with its lever arms at the end of the step. But if joints keep θ of all its
 * bodies at 1, so that they are moved by v⁺, the arms are those of the middle of the step: sticking friction then
 * causes no drift on rotating ground. Impulses act with the mean of the lever arms, as those of joints do.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static double rateAt(const MdtKeaRow *row, const MdtKeaVelocity *velocity) {
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

static void useBackwardEuler(MdtKeaSystem *s, const MdtKeaRow *row) {
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

static void spreadTheta(MdtKeaSystem *s) {
    for (MeBool changed = METRUE; changed;) {
        changed = MEFALSE;
        for (int i = 0; i < s->numRows; i++) {
            const MdtKeaRow *row = &s->rows[i];
            const KeaBody *a = row->body[0] < 0 ? NULL : &s->work->body[row->body[0]];
            const KeaBody *b = row->body[1] < 0 ? NULL : &s->work->body[row->body[1]];
            if (row->position || row->spring || s->work->problem.row[i].isInactive || !a || !b || a->theta == b->theta)
                continue;
            useBackwardEuler(s, row);
            changed = METRUE;
        }
    }
}

void kea_markTied(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].isTied = MEFALSE;
    for (int i = 0; i < s->numRows; i++)
        for (int k = 0; k < 2; k++)
            if ((s->rows[i].position || s->rows[i].spring) && s->rows[i].body[k] >= 0)
                s->work->body[s->rows[i].body[k]].isTied = METRUE;
}

MeBool kea_isMovedByU(const MdtKeaSystem *s, int body) {
    return body >= 0 && (s->parameters.timed || s->work->body[body].isTied);
}

/* Bodies that touch a tied body with θ = 1 are moved by v⁺, too: otherwise the contact force would do more work on one
 * body than on the other. */
static void moveTouchingByEnd(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact != i || s->work->problem.row[i].isInactive)
            continue;
        for (int k = 0; k < 2; k++)
            if (row->body[k] >= 0 && kea_isMovedByU(s, row->body[1 - k]) && s->work->body[row->body[1 - k]].theta == 1)
                s->work->body[row->body[k]].moveTheta = 1;
    }
}

/* m/s: the approach above which lossless contacts damp; 0: there are none. */
static double dampedApproach(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i && s->rows[i].restitution > kea_lossyRestitution)
            return kea_separatingSpeed * kea_eventSpeed(s);
    return 0;
}

/* Whether a contact damps its bodies: one that loses next to nothing does only if it stops an approach, which the mean
 * motion would turn into an overlap. Otherwise two balls of a cradle that swing side by side come to rest. */
static MeBool damps(const MdtKeaSystem *s, int i, double approach) {
    const MdtKeaRow *row = &s->rows[i];
    if (s->work->problem.row[i].isInactive)
        return MEFALSE;
    return row->restitution <= kea_lossyRestitution || rateAt(row, s->velocity) - row->drift < -approach;
}

static void chooseTheta(MdtKeaSystem *s) {
    kea_markTied(s);
    for (int i = 0; i < s->numBodies; i++)
        s->work->body[i].theta = s->work->body[i].moveTheta = 0.5;
    const double approach = s->parameters.timed ? 0 : dampedApproach(s);
    for (int i = 0; i < s->numRows && !s->parameters.timed; i++) {
        MdtKeaRow *row = &s->rows[i];
        const MeBool isActing = row->contact == i ? damps(s, i, approach)
                                                  : row->position && kea_mayReachBound(row) && row->force != 0 &&
                                                        rateAt(row, s->velocity) <= -row->carried;
        row->isStiff = row->spring && kea_isBackward(s, row);
        if (isActing || row->backward || row->isStiff)
            useBackwardEuler(s, row);
    }
    spreadTheta(s);
    moveTouchingByEnd(s);
}

/* m/s: the mean rate of a contact's gap in the step, by the displacements of its bodies or, with byEnd, by those that
 * untied bodies would have if v⁺ moved them. */
static double gapRate(const MdtKeaSystem *s, int i, MeBool byEnd) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double rate = (s->rows[i].moves ? s->moves[i][0].rate : 0) - s->rows[i].drift;
    for (int k = 0; k < 2; k++) {
        double move[6];
        if (p->body[k] < 0)
            continue;
        kea_moveVelocity(s, p->body[k], byEnd, move);
        rate += keaDot(p->J[k], move) + keaDot(p->J[k] + 3, move + 3);
    }
    return rate;
}

/* Whether a contact overlaps deeper after the displacement than after that by v⁺, by more than kea_pressedDepth. With
 * restitution 1 only if it comes deeper than it is: bodies that v⁺ moves lose up to m (g h)² / 2. */
static MeBool isPressed(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize, atEnd = row->error + h * gapRate(s, i, METRUE);
    const double free = row->restitution == 1 || row->turning != 0 ? keaMin(row->error, 0) : 0;
    return row->error + h * gapRate(s, i, MEFALSE) <
           keaMin(atEnd, free) - kea_pressedDepth * kea_smallerExtent(s, row->body);
}

/* Moves bodies whose velocities change by no more than the solver resolves by v⁺: they are at rest, and stay where
 * contacts hold them. */
static void moveRestingByEnd(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++) {
        KeaBody *b = &s->work->body[i];
        double linear[3], angular[3];
        keaSubtract(linear, b->endVelocity, s->velocity[i].lin);
        keaSubtract(angular, b->endVelocity + 3, s->velocity[i].ang);
        if (keaLength(linear) + b->size * keaLength(angular) < kea_restingChange * s->report.resolution)
            b->moveTheta = 1;
    }
}

static MeBool areAllMovedByU(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (!kea_isMovedByU(s, i))
            return MEFALSE;
    return METRUE;
}

void kea_chooseMoveThetas(MdtKeaSystem *s) {
    if (areAllMovedByU(s))
        return;
    moveRestingByEnd(s);
    MeBool isAny = !s->parameters.timed;
    for (int sweep = 0; sweep < KEA_PRESSED_SWEEPS && isAny; sweep++) {
        isAny = MEFALSE;
        for (int i = 0; i < s->numRows; i++) {
            const MdtKeaRow *row = &s->rows[i];
            if (row->contact != i || s->work->problem.row[i].isInactive || !isPressed(s, i))
                continue;
            for (int k = 0; k < 2; k++) {
                KeaBody *b = row->body[k] < 0 ? NULL : &s->work->body[row->body[k]];
                if (!b || kea_isMovedByU(s, row->body[k]) || b->moveTheta == 1)
                    continue;
                b->moveTheta = 1;
                isAny = METRUE;
            }
        }
    }
    if (!s->parameters.timed)
        kea_moveBodies(s);
}

/* ---- begin ---- */

static void copyBounds(KeaProblemRow *p, const MdtKeaRow *row, double h) {
    p->lower = h * row->lower;
    p->upper = h * row->upper;
}

void kea_copyJacobian(const MdtKeaSystem *s, KeaProblemRow *p, const MdtKeaJBlockPair J) {
    for (int k = 0; k < 2; k++)
        kea_copyBlock(p->J[k], &J[k]);
    kea_lockRow(s, p->body, p->J);
}

/* Whether the row has no force in this step: a tail, a spring without stiffness and damping, or a row of a contact that
 * is open or out of reach. */
static MeBool isInactive(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (row->isTail)
        return METRUE;
    if (row->contact < 0)
        return row->spring && !(row->stiffness > 0) && !(row->damping > 0);
    const MdtKeaRow *normal = &s->rows[row->contact];
    if (normal->isOpen || s->parameters.timed)
        return normal->isOpen;
    double size = 0;
    for (int k = 0; k < 2; k++)
        if (normal->body[k] >= 0)
            size = keaMax(size, s->work->body[normal->body[k]].size);
    const double speed =
        keaMin(rateAt(normal, s->velocity), rateAt(normal, s->predicted) + normal->turning) - normal->drift;
    const double h = s->parameters.stepsize,
                 gap = normal->error + h * keaMax(speed, 0); /* at the end, if the bodies separate */
    const MeBool mayPull = normal->lower < 0, isNear = gap < kea_nearbyGap * size;
    return !mayPull && !isNear && !(normal->error + kea_reach * h * speed < 0);
}

/* N s: friction bound of the first pass. Warm start: μ p_n. Cold start: infinite, so that the first answer sticks or
 * gives the direction of sliding; or 0 if the predicted slip is more than friction can stop. */
static double startingBound(const MdtKeaSystem *s, const MdtKeaRow *row) {
    const KeaProblemRow *normal = &s->work->problem.row[row->normal];
    if (normal->p > 0 || row->isForced) /* forced: the direction of sliding is known */
        return row->friction * keaMax(normal->p, 0);
    const double along = rateAt(row, s->predicted) - row->target;
    const double across =
        row->partner >= 0 ? rateAt(&s->rows[row->partner], s->predicted) - s->rows[row->partner].target : 0;
    const double approach = s->rows[row->normal].drift - rateAt(&s->rows[row->normal], s->predicted),
                 length = kea_lengthOf(s, row);
    return length * keaHypotenuse(along, across) > row->friction / length * keaMax(approach, 0) ? 0 : HUGE_VAL;
}

void kea_beginRows(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    s->work->hasJoints = MEFALSE;
    s->work->areRowsFixed = s->numRows > 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        KeaProblemRow *p = &s->work->problem.row[i];
        s->work->hasJoints |= row->contact < 0;
        s->work->areRowsFixed = s->work->areRowsFixed && row->isFixed;
        MEASSERT(row->body[0] < s->numBodies && row->body[1] < s->numBodies);
        MEASSERT(row->body[0] != row->body[1] || row->isTail); /* of a mover only */
        MEASSERT(!(row->softness < 0) && (row->normal >= 0 || row->isForced || !(row->lower > row->upper)));
        MEASSERT(row->normal < 0 || (s->rows[row->normal].normal < 0 && row->friction >= 0));
        MEASSERT(row->partner < 0 || s->rows[row->partner].partner == i);
        p->body[0] = row->body[0];
        p->body[1] = row->body[1];
        p->normal = row->normal;
        p->partner = row->partner;
        p->friction = row->friction;
        p->isSplit = row->isSplit;
        p->isTail = row->isTail;
        copyBounds(p, row, h);
        kea_copyJacobian(s, p, row->J);
        s->work->movingRate[i] = 0;
        p->isInactive = isInactive(s, row);
        /* with holdsSlow kea_closeSlowContacts may close an open contact, which then needs its block of the matrix */
        p->isOut = row->contact >= 0 && s->rows[row->contact].isOpen && !s->parameters.holdsSlow;
        p->p = p->p0 = p->isInactive || !isfinite(row->force) ? 0 : keaMin(keaMax(h * row->force, p->lower), p->upper);
        p->state = p->p > p->lower && p->p < p->upper ? KEA_ACTIVE : KEA_IDLE;
        p->isInconsistent = p->isUnmet = MEFALSE;
        p->isCheckedElsewhere = row->position;
        p->isForced = row->isForced;
        p->forced = row->forced;
        p->frictionBound = row->normal >= 0 ? startingBound(s, row) : 0;
    }
    kea_beginBends(s);
    chooseTheta(s);
}

void kea_admitContacts(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    int admitted = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->position && kea_mayReachBound(row) && !row->bounces && s->work->problem.row[i].p != 0 &&
            thetaOf(s, row) < 1) {
            useBackwardEuler(s, row);
            admitted++;
        }
        if (row->contact != i || !s->work->problem.row[i].isInactive || row->isOpen)
            continue;
        if (row->error + h * (kea_endRate(s, i) - row->drift) >= 0)
            continue;
        for (int k = i; k < s->numRows && s->rows[k].contact == i; k++)
            s->work->problem.row[k].isInactive = MEFALSE;
        useBackwardEuler(s, row);
        admitted++;
    }
    if (admitted == 0)
        return;
    spreadTheta(s);
    s->work->problem.isFactored = s->work->problem.isFactored && !s->work->problem.isChord; /* θ is in the metric */
}

/* ---- every pass ---- */

void kea_refreshRows(MdtKeaSystem *s, const MdtKeaTransformation poses[], MeBool withBounds) {
    kea_evaluateJacobians(s, poses, poses == s->work->meanPose ? 0.5 : 1);
    for (int i = 0; i < s->numRows; i++) {
        if (s->rows[i].isFixed)
            continue;
        if (s->rows[i].contact < 0)
            kea_copyJacobian(s, &s->work->problem.row[i], s->rows[i].J);
        if (withBounds)
            copyBounds(&s->work->problem.row[i], &s->rows[i], s->parameters.stepsize);
    }
}

/* Whether at least one body of the row is tied, and all are moved by v⁺. */
static MeBool isMovedByEnd(const MdtKeaSystem *s, const MdtKeaRow *row) {
    for (int k = 0; k < 2; k++) {
        const KeaBody *b = row->body[k] < 0 ? NULL : &s->work->body[row->body[k]];
        if (b && (kea_isMovedByU(s, row->body[k]) ? b->theta : b->moveTheta) < 1)
            return MEFALSE;
    }
    return kea_isMovedByU(s, row->body[0]) || kea_isMovedByU(s, row->body[1]);
}

/* m/s: the rate that the contact constrains minus J v⁺ with the J of the mean lever arms (kea_setMovingRates). */
static double movingRate(const MdtKeaSystem *s, int i) {
    const MdtKeaMove *mean = &s->moves[i][0], *end = &s->moves[i][1];
    if (!s->parameters.timed && isMovedByEnd(s, &s->rows[i]))
        return mean->rate;
    double rate = end->rate;
    for (int k = 0; k < 2; k++) {
        if (s->rows[i].body[k] < 0)
            continue;
        const double *v = s->work->body[s->rows[i].body[k]].endVelocity;
        double turn[3], tilt[3];
        keaSubtract(turn, end->J[k].ang, mean->J[k].ang);
        keaSubtract(tilt, end->J[k].lin, mean->J[k].lin);
        rate += keaDot(turn, v + 3) + keaDot(tilt, v);
    }
    return rate;
}

void kea_setMovingRates(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].moves)
            s->work->movingRate[i] = movingRate(s, i);
}

/* The derivative of a row's error with respect to d, over h: J at the end pose, with its angular part times D / h
 * (MdtKeaWork.turnDerivative). */
static void setTangent(const MdtKeaSystem *s, int body, const double J[6], double tangent[6]) {
    keaCopy(tangent, J);
    keaApplyTransposed(tangent + 3, (const double(*)[3])s->work->turnDerivative[body], J + 3);
    keaScale(tangent + 3, 1 / s->parameters.stepsize, tangent + 3);
    kea_dropLocked(s->work->body[body].locked, tangent);
}

void kea_differentiateRows(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_saveJacobians(s);
    kea_evaluateJacobians(s, s->work->endPose, 1);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (!row->position && !row->spring)
            memcpy(q->tangent[i], q->row[i].J, sizeof q->row[i].J);
        double J[2][6];
        for (int k = 0; k < 2; k++)
            kea_copyBlock(J[k], &row->J[k]);
        kea_lockRow(s, row->body, J);
        for (int k = 0; k < 2 && (row->position || row->spring); k++)
            if (row->body[k] >= 0)
                setTangent(s, row->body[k], J[k], q->tangent[i][k]);
    }
    kea_restoreJacobians(s);
    for (int i = s->numRows; i < q->numRows; i++)
        memcpy(q->tangent[i], q->row[i].J, sizeof q->row[i].J);
}

/* The force of a spring, N, and its decrease with the error at the end, N/m. */
typedef struct SpringForce {
    double force, stiffness;
} SpringForce;

/* N/m: the stiffness at an error. One that only pushes has none beyond its end. */
static double stiffnessAt(const MdtKeaRow *row, double error) {
    return row->lower == 0 && error > 0 ? 0 : row->stiffness;
}

/* The mean force of the step, by the difference of the potential V: F = -(V(end) - V(start)) / (end - start). So its
 * work is exact in a step of any length, also where a spring that only pushes takes hold or lets go. */
static SpringForce meanForce(const MdtKeaRow *row, double end) {
    const double start = row->error, step = end - start, k0 = stiffnessAt(row, start), k = stiffnessAt(row, end);
    if (row->lower == 0 && start > 0 && end >= 0) /* its bound cuts the force off at 0 */
        return (SpringForce){-0.5 * row->stiffness * end, 0.5 * row->stiffness};
    if (k0 == k)
        return (SpringForce){-0.5 * k * (start + end), keaMax(0.5 * k, kea_minSpringSlope * row->stiffness)};
    const double force = -0.5 * (k * end * end - k0 * start * start) / step;
    return (SpringForce){force, keaMax((k * end + force) / step, kea_minSpringSlope * row->stiffness)};
}

/* The force of a spring that is too stiff for the mean: that at the end. */
static SpringForce springForce(const MdtKeaRow *row, double end) {
    return row->isStiff ? (SpringForce){-row->stiffness * end, row->stiffness} : meanForce(row, end);
}

static void springRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize, rate = kea_meanRate(s, i) - row->target;
    const SpringForce f = springForce(row, row->error + h * rate);
    p->E = 1 / (h * h * f.stiffness + h * row->damping);
    p->r = p->E * h * (f.force - row->damping * rate);
    p->N = 0;
}

/* N of a position row, relative to A_ii: smaller for a stop that acts, once passes converge slowly. */
static double proximalOf(const MdtKeaSystem *s, const MdtKeaRow *row, const KeaProblemRow *p) {
    const MeBool mayContradict = s->work->hasLoops && !s->work->problem.hasTangent;
    if (!kea_mayReachBound(row) && !mayContradict)
        return kea_proximalJoint;
    const MeBool acts = p->p > p->lower && p->p < p->upper;
    return acts && !mayContradict && s->work->problem.counts.slow > 0 ? kea_proximalStop : kea_proximalLimit;
}

static void positionRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize;
    p->E = row->softness;
    p->r = row->target + row->carried - (s->work->endErrors[i] - row->error) / h;
    /* without lever arms: else joints that share a load would not share it evenly */
    const double invEffectiveMass = p->AiiLinear > 0 ? p->AiiLinear : p->Aii;
    p->N = proximalOf(s, row, p) * invEffectiveMass;
}

/* Target of a contact in a timed step, in which kea_project removes overlaps, not a velocity. A soft contact uses the
 * separating velocity G to end its sag where γ times its depth balances the load:
 *
 *     J v = drift - max(E p - G, 0),
 *
 * which is rigid up to the load G/E. The branch is chosen by p of the last pass; in the first pass, in which contacts
 * share their load by E, it is the soft one without G. A contact with a gap that acts from the start of the step
 * touches at its end (kea_events.c). */
static double timedTarget(const MdtKeaSystem *s, const MdtKeaRow *row, KeaProblemRow *p) {
    if (row->lower < 0) /* it may pull */
        return row->target;
    if (s->parameters.holdsSlow && !kea_isTouching(s, row))
        return row->drift + keaMin(-2 * row->error / s->parameters.stepsize - kea_startRate(s, row->contact), 0);
    const double separating = keaMax(row->target - row->drift, 0);
    if (p->p > 0 && row->softness * p->p >= separating)
        return row->drift + separating;
    if (p->p > 0)
        p->E = 0;
    return row->drift;
}

static void velocityRow(const MdtKeaSystem *s, int i, KeaProblemRow *p) {
    const int level = s->work->problem.counts.level;
    const MdtKeaRow *row = &s->rows[i];
    const double theta = thetaOf(s, row);
    p->E = theta * row->softness;
    const double target = s->parameters.timed && row->contact == i ? timedTarget(s, row, p) : row->target;
    p->r = theta * (target - kea_endRate(s, i));
    if (row->hop > 0) /* the mean rate of what hops does no work */
        p->r += theta * (s->work->movingRate[i] - row->hop * (rateAt(row, s->velocity) - row->drift));
    p->N = (row->contact >= 0 ? kea_proximalContact[level < KEA_PROXIMAL_LEVELS ? level : KEA_PROXIMAL_LEVELS - 1]
                              : kea_proximalLimit) *
           p->Aii;
}

/* Gives both rows of a cone the same N: otherwise friction would not be antiparallel to the slip. */
static void equalizeN(KeaProblemRow *a, KeaProblemRow *b) {
    a->N = b->N = 0.5 * (a->N + b->N);
}

void kea_linearizeRows(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    kea_linearizeBends(s);
    if (!kea_keepsMetric(s))
        kea_problemSetEffectiveMasses(q);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        KeaProblemRow *p = &q->row[i];
        p->p0 = p->p;
        p->Jd = 0;
        if (p->Aii == 0)
            p->isInactive = METRUE;
        if (row->spring)
            springRow(s, i, p);
        else if (row->position)
            positionRow(s, i, p);
        else
            velocityRow(s, i, p);
    }
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].partner > i)
            equalizeN(&q->row[i], &q->row[q->row[i].partner]);
}
