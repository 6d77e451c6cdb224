/* The coupled problem by states: which rows hold, which let go, and where to contacts slide (Alart and Curnier 1991).
 *
 * Of a row that has the impulse p and misses its law by m = r - J d - E p - N (p - p0), the state follows from
 *
 *     z = p + m / A_ii:    held while z is within its bounds or its cone, else at the bound, or sliding along z.
 *
 * That is the impulse with which the row alone would meet its law. (y of kea_newton.c is z with N in place of A_ii: the
 * same at the answer, but of what N is small against it tells the sign of m only.) The states give p as an affine
 * function of d, with R = μ p of the normal row, k = R/|z| and w = z/|z|:
 *
 *     held:  p = (r - J d + N p0) / (E + N)
 *     slid:  along w  p = R,  across it  p = (r - J d + N p0) / (A (1 - k)/k + E + N)
 *
 * and one linear system gives d; z of both gives the next states. Where these are nearly known, as those of the last
 * step or pass are, that ends in one to five solves. It has no line search and may alternate: then it is left.
 */
#include "common/kea_policy_i.h"
#include "inner/kea_newton_i.h"
#include <math.h>

/* 1/kg: of both rows of a cone, so that z has the direction of the slip. */
static double sizeOf(const KeaProblem *q, const KeaProblemRow *row) {
    return (row->partner < 0 ? row->size : 0.5 * (row->size + q->row[row->partner].size)) + row->E;
}

static double aloneWith(const KeaProblemRow *row, double size) {
    return row->affine + (row->r - row->Jd - row->E * row->affine - row->N * (row->affine - row->p0)) / size;
}

/* How far p is from where it is allowed, J: the same unit for forces and for torques. */
static double distance(double p, double allowed, double size) {
    return size * (p - allowed) * (p - allowed);
}

static double chooseBounded(KeaProblemRow *row, double lower, double upper, double size) {
    const double z = aloneWith(row, size);
    row->state = z > lower && z < upper ? KEA_HELD : KEA_IDLE;
    row->p = keaMin(keaMax(z, lower), upper);
    return distance(row->affine, row->p, size);
}

static double chooseForced(KeaProblemRow *row, double bound) {
    row->state = KEA_SLIPS;
    return distance(row->affine, row->forced * bound, row->size);
}

static double chooseInterval(KeaProblemRow *row, double bound, double size) {
    const double missed = chooseBounded(row, keaMax(row->lower, -bound), keaMin(row->upper, bound), size);
    if (row->state == KEA_IDLE && fabs(row->p) >= bound)
        row->state = KEA_SLIPS;
    row->along = row->p > 0 || (row->p == 0 && aloneWith(row, size) > 0) ? 1 : -1;
    row->across = 0;
    return missed;
}

static double chooseCone(KeaProblemRow *row, KeaProblemRow *other, double bound, double size) {
    const double a = aloneWith(row, size), b = aloneWith(other, size), length = keaHypotenuse(a, b);
    const MeBool isHeld = length <= bound;
    const double share = isHeld ? 1 : bound / length;
    row->state = other->state = isHeld ? KEA_HELD : KEA_SLIPS;
    row->along = isHeld ? 0 : a / length;
    other->along = isHeld ? 0 : b / length;
    row->across = other->across = share > 0 ? 1 / (size * (1 - share) / share + softness(row)) : 0;
    return distance(row->affine, share * a, size) + distance(other->affine, share * b, size);
}

/* The states that `affine' and d tell. Returns what is missed by all of them, J. */
static double chooseStates(KeaProblem *q) {
    double missed = 0;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isOff || (row->partner >= 0 && row->partner < i))
            continue;
        const double size = sizeOf(q, row);
        const double bound = row->normal < 0 ? 0 : row->friction * keaMax(q->row[row->normal].affine, 0);
        if (row->normal < 0)
            missed += chooseBounded(row, row->lower, row->upper, size);
        else if (row->isForced)
            missed += chooseForced(row, bound);
        else if (row->partner < 0)
            missed += chooseInterval(row, bound, size);
        else
            missed += chooseCone(row, &q->row[row->partner], bound, size);
    }
    return missed;
}

/* p of what slides; the normal row's is known. */
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

/* p at d as the states have it: affine. */
static void setForces(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        row->y = (row->N * row->p0 + row->r - row->Jd) / softness(row);
    }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isOff || row->state == KEA_IDLE)
            continue;
        row->p = row->state == KEA_HELD ? row->y : slidingForce(q, row);
    }
}

static void keepAffine(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        q->row[i].affine = q->row[i].p;
}

/* To where the affine p are right, and those within their bounds. Returns the error of these, in tolerances. */
static double takeStep(KeaProblem *q) {
    kea_newtonDirection(q);
    kea_newtonTake(q, 1);
    setForces(q);
    keepAffine(q);
    kea_newtonForces(q, 0, METRUE);
    return kea_newtonError(q, 0);
}

static MeBool areStatesFactored(const KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        if (!q->row[i].isOff && q->row[i].state != q->row[i].factored)
            return MEFALSE;
    return METRUE;
}

MeBool kea_statesRefine(KeaProblem *q) {
    double error = HUGE_VAL;
    keepAffine(q);
    chooseStates(q);
    for (int i = 0; i < KEA_MAX_REFINEMENTS && areStatesFactored(q); i++) {
        const double before = error;
        setForces(q);
        kea_newtonError(q, 0);
        error = takeStep(q);
        if (error < 1)
            return METRUE;
        if (!(error < kea_refinedShare * before))
            return MEFALSE;
        chooseStates(q);
    }
    return MEFALSE;
}

MeBool kea_statesSolve(KeaProblem *q) {
    keepAffine(q);
    double missed = chooseStates(q);
    for (int i = 0; i < KEA_MAX_COUPLED; i++) {
        setForces(q);
        kea_newtonError(q, 0);
        if (!kea_problemMaySpend(q, METRUE) || !kea_newtonFactorize(q, METRUE))
            return MEFALSE;
        q->counts.iterations++;
        if (takeStep(q) < 1)
            return METRUE;
        const double before = missed;
        missed = chooseStates(q);
        if (i > 0 && !(missed < before))
            return MEFALSE;
    }
    return MEFALSE;
}
