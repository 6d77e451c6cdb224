/* The coupled problem by an active set method. The state of a row: within its bounds (active), at a bound, or sliding
 * in a known direction (Alart and Curnier, A mixed formulation for frictional contact problems prone to Newton like
 * solution methods, 1991).
 *
 * With p the impulse of a row and m = r - J d - E p - N (p - p0) its residual, its state follows from
 *
 *     z = p + m / A_ii:    active if z is within its bounds or its cone, else at the bound, or sliding along z.
 *
 * z is the impulse by which the row alone would fulfil its law. (y of kea_newton.c is z with N in place of A_ii: equal
 * at the solution, but far from it, as N << A_ii, it has no more information than the sign of m.) For given states p is
 * an affine function of d, with R = μ p of the normal row, k = R/|z| and w = z/|z|:
 *
 *     active:   p = (r - J d + N p0) / (E + N)
 *     sliding:  along w  p = R,  across it  p = (r - J d + N p0) / (A (1 - k)/k + E + N)
 *
 * and one linear system gives d; z of the new d and p gives the next states. From good states, such as those of the
 * last step or pass, this takes one to five solves. There is no line search: if states alternate, the method fails.
 */
#include "common/kea_policy_i.h"
#include "inner/kea_newton_i.h"
#include <math.h>

/* 1/kg: A_ii + E, for a cone with the mean A_ii of its two rows, so that z has the direction of the slip. */
static double diagonalOf(const KeaProblem *q, const KeaProblemRow *row) {
    return (row->partner < 0 ? row->Aii : 0.5 * (row->Aii + q->row[row->partner].Aii)) + row->E;
}

/* N s: z of a row. */
static double isolatedImpulse(const KeaProblemRow *row, double diagonal) {
    return row->affine + (row->r - row->Jd - row->E * row->affine - row->N * (row->affine - row->p0)) / diagonal;
}

/* J: the squared distance of p from its bounds, in a unit that is the same for forces and torques. */
static double squaredViolation(double p, double allowed, double diagonal) {
    return diagonal * (p - allowed) * (p - allowed);
}

/* Each of the next four functions chooses the state of a row, sets p within its bounds, and returns the violation of
 * the bounds by `affine`, J. */
static double chooseBounded(KeaProblemRow *row, double lower, double upper, double diagonal) {
    const double z = isolatedImpulse(row, diagonal);
    row->state = z > lower && z < upper ? KEA_ACTIVE : KEA_IDLE;
    row->p = keaMin(keaMax(z, lower), upper);
    return squaredViolation(row->affine, row->p, diagonal);
}

static double chooseForced(KeaProblemRow *row, double bound) {
    row->state = KEA_SLIPS;
    return squaredViolation(row->affine, row->forced * bound, row->Aii);
}

static double chooseInterval(KeaProblemRow *row, double bound, double diagonal) {
    const double violated = chooseBounded(row, keaMax(row->lower, -bound), keaMin(row->upper, bound), diagonal);
    if (row->state == KEA_IDLE && fabs(row->p) >= bound)
        row->state = KEA_SLIPS;
    row->along = row->p > 0 || (row->p == 0 && isolatedImpulse(row, diagonal) > 0) ? 1 : -1;
    row->across = 0;
    return violated;
}

static double chooseCone(KeaProblemRow *row, KeaProblemRow *other, double bound, double diagonal) {
    const double a = isolatedImpulse(row, diagonal), b = isolatedImpulse(other, diagonal), length = keaHypotenuse(a, b);
    const MeBool sticks = length <= bound;
    const double share = sticks ? 1 : bound / length;
    row->state = other->state = sticks ? KEA_ACTIVE : KEA_SLIPS;
    row->along = sticks ? 0 : a / length;
    other->along = sticks ? 0 : b / length;
    row->across = other->across = share > 0 ? 1 / (diagonal * (1 - share) / share + softness(row)) : 0;
    return squaredViolation(row->affine, share * a, diagonal) + squaredViolation(other->affine, share * b, diagonal);
}

/* Chooses the states of all rows from `affine` and d. Returns the sum of their violations, J. */
static double chooseStates(KeaProblem *q) {
    double violated = 0;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isInactive || (row->partner >= 0 && row->partner < i))
            continue;
        const double diagonal = diagonalOf(q, row);
        const double bound = row->normal < 0 ? 0 : row->friction * keaMax(q->row[row->normal].affine, 0);
        if (row->normal < 0)
            violated += chooseBounded(row, row->lower, row->upper, diagonal);
        else if (row->isForced)
            violated += chooseForced(row, bound);
        else if (row->partner < 0)
            violated += chooseInterval(row, bound, diagonal);
        else
            violated += chooseCone(row, &q->row[row->partner], bound, diagonal);
    }
    return violated;
}

/* p of a sliding row; p of its normal row is set already. */
static double slidingForce(const KeaProblem *q, const KeaProblemRow *row) {
    const double bound = row->friction * q->row[row->normal].p;
    if (row->isForced)
        return row->forced * bound;
    if (row->partner < 0)
        return row->along * bound;
    const KeaProblemRow *other = &q->row[row->partner];
    const double along = row->along * row->y + other->along * other->y;
    return row->along * bound + row->across * softness(row) * (row->y - row->along * along);
}

/* Sets p from y for the present states, not clamped. */
static void setForces(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isInactive || row->state == KEA_IDLE)
            continue;
        row->p = row->state == KEA_ACTIVE ? row->y : slidingForce(q, row);
    }
}

/* Copies p, before it is clamped, to `affine`. */
static void saveAffine(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        q->row[i].affine = q->row[i].p;
}

/* Solves the linear system of the present states, then clamps p to its bounds. */
static void applyNewtonStep(KeaProblem *q) {
    kea_newtonDirection(q);
    kea_newtonApply(q, 1);
    kea_newtonSetUnclamped(q, 0);
    setForces(q);
    saveAffine(q);
    kea_newtonClamp(q, METRUE);
}

/* Whether the present states are those that the matrix was factored for. */
static MeBool areStatesFactored(const KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        if (!q->row[i].isInactive && q->row[i].state != q->row[i].factored)
            return MEFALSE;
    return METRUE;
}

MeBool kea_statesRefine(KeaProblem *q) {
    double error = HUGE_VAL;
    saveAffine(q);
    chooseStates(q);
    kea_newtonSetUnclamped(q, 0);
    for (int i = 0; i < KEA_MAX_REFINEMENTS && areStatesFactored(q); i++) {
        const double before = error;
        setForces(q);
        kea_newtonGradient(q);
        applyNewtonStep(q);
        if (q->isChord) /* the matrix is that of the problem; the next pass measures the answer */
            return METRUE;
        error = kea_newtonError(q, 0);
        if (error < 1)
            return METRUE;
        if (!(error < kea_refinedShare * before))
            return MEFALSE;
        chooseStates(q);
    }
    return MEFALSE;
}

MeBool kea_statesSolve(KeaProblem *q) {
    saveAffine(q);
    double violated = chooseStates(q);
    kea_newtonSetUnclamped(q, 0);
    for (int i = 0; i < KEA_MAX_COUPLED; i++) {
        setForces(q);
        kea_newtonGradient(q);
        if (!kea_problemMaySpend(q, METRUE) || !kea_newtonFactorize(q, METRUE))
            return MEFALSE;
        q->counts.iterations++;
        applyNewtonStep(q);
        if (kea_newtonError(q, 0) < 1)
            return METRUE;
        const double before = violated;
        violated = chooseStates(q);
        if (i > 0 && !(violated < before))
            return MEFALSE;
    }
    return MEFALSE;
}
