/* The inner problem by accelerated projected Gauss-Seidel: the fallback when the budget of work is used up
 * (kea_problem_i.h).
 *
 * The unknowns are impulses. d = B⁻¹ (Jᵀ p - g) at all times, so that momentum is conserved even by sweeps that have
 * not converged. A sweep updates row by row
 *
 *     Δp = (r - J d - E p) / (A_ii + E),  p within its bounds,  d += B⁻¹ Jᵀ Δp.
 *
 * Sweeps are accelerated (Nesterov 1983): each starts from y = p + β (p - p_before), d likewise, with β = (θ - 1)/θ',
 * θ' = (1 + √(1 + 4 θ²))/2. The momentum is restarted from β = 0 if the last sweep went against it, Σ A_ii (y - p)(p -
 * p_before) > 0 (O'Donoghue & Candès 2015). In a pyramid 32 such sweeps do what 500 plain ones do. All visit the rows
 * in the same order: with alternating order the momentum does not help.
 *
 * Without friction a sweep lowers
 *
 *     D(p) = 1/2 (Jᵀ p - g)ᵀ B⁻¹ (Jᵀ p - g) + 1/2 pᵀ E p - pᵀ r,
 *
 * which for contacts with the target velocity 0, r = -J v, is the kinetic energy after the impulses, up to a constant.
 * An answer with D(p) <= D(0) has gained no energy. The answer is that of the last sweep, if this holds for it, else
 * that of smallest D among all sweeps and starts. The smallest D is not the first choice: with friction, D decreases
 * when normal forces exceed what is needed, because of the friction that they allow. The start is the one of smallest D
 * among the impulses of Newton's last iterate, those that the problem came with (p0), and p = 0.
 *
 * The cost is some multiplications per row; no matrix is needed.
 */
#include "inner/kea_problem_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <math.h>
#include <string.h>

/* d += B⁻¹ Jᵀ p, for one body. */
static void addRowResponse(double *d, const KeaMetric *B, double p, const double J[6]) {
    double turn[3];
    keaApply(turn, B->inverse, J + 3);
    for (int i = 0; i < 3; i++) {
        d[i] += p / B->linear * J[i];
        d[3 + i] += p * turn[i];
    }
}

/* Adds the response of all bodies of a row to the impulse p. */
static void addImpulse(KeaProblem *q, const KeaProblemRow *row, double p) {
    const int last = row->isSplit ? 1 : 0;
    for (const KeaProblemRow *record = row; record <= row + last; record++)
        for (int k = 0; k < 2 && p != 0; k++)
            if (record->body[k] >= 0)
                addRowResponse(q->d[record->body[k]], &q->metric[record->body[k]], p, record->J[k]);
}

/* d := B⁻¹ (Jᵀ p - g). */
static void solveBodies(KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++) {
        double minus[6];
        for (int i = 0; i < 6; i++)
            minus[i] = -q->load[b][i];
        memset(q->d[b], 0, sizeof q->d[b]);
        addRowResponse(q->d[b], &q->metric[b], 1, minus);
    }
    for (int i = 0; i < q->numRows; i++)
        addImpulse(q, &q->row[i], q->row[i].p);
}

/* 2 D, J. */
static double objective(const KeaProblem *q) {
    double sum = 0;
    for (int b = 0; b < q->numBodies; b++)
        sum += 2 * kea_energyOf(&q->metric[b], q->d[b], q->d[b]);
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (!row->isInactive)
            sum += row->p * (row->E * row->p - 2 * row->r);
    }
    return sum;
}

/* Saves the impulses if they have a smaller objective than *min, and lowers that. */
static void saveIfBest(KeaProblem *q, double *min) {
    const double D = objective(q);
    if (!(D < *min))
        return;
    *min = D;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].bestP = q->row[i].p;
}

static void setFrictionBound(const KeaProblem *q, KeaProblemRow *row) {
    row->frictionBound = kea_frictionBound(q, row);
}

/* Restores the impulses of smallest objective, with their friction bounds and d. */
static void restoreBest(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].bestP;
    for (int i = 0; i < q->numRows; i++)
        if (q->row[i].normal >= 0)
            setFrictionBound(q, &q->row[i]);
    solveBodies(q);
}

static double clampToBounds(const KeaProblemRow *row, double p) {
    return keaMin(keaMax(p, row->lower), row->upper);
}

/* Clamps impulses to their bounds; normal rows come before their friction rows. */
static void projectImpulses(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i], *other = row->partner >= 0 ? &q->row[row->partner] : NULL;
        if (row->isInactive)
            continue;
        if (row->normal < 0) {
            row->p = clampToBounds(row, row->p);
            continue;
        }
        setFrictionBound(q, row);
        if (row->isForced)
            row->p = row->forced * row->frictionBound;
        else if (!other || other->isForced)
            row->p = keaMin(keaMax(clampToBounds(row, row->p), -row->frictionBound), row->frictionBound);
        else if (row->partner > i) {
            const double size = keaHypotenuse(row->p, other->p),
                         share = size > row->frictionBound ? row->frictionBound / size : 1;
            row->p *= share;
            other->p *= share;
        }
    }
}

/* Saves the present impulses, clamped to their bounds, if they are the best start so far. */
static void tryStart(KeaProblem *q, double *min) {
    projectImpulses(q);
    solveBodies(q);
    saveIfBest(q, min);
}

/* Chooses the start of smallest D. Returns its 2 D; writes 2 D(0) to `none`. */
static double chooseStart(KeaProblem *q, double *none) {
    double min = HUGE_VAL;
    tryStart(q, &min);
    for (int i = 0; i < q->numRows && min == HUGE_VAL; i++)
        q->row[i].bestP = q->row[i].p; /* within its bounds, for the case that all D are NaN */
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isInactive ? q->row[i].p : q->row[i].p0;
    tryStart(q, &min);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isInactive ? q->row[i].p : 0;
    tryStart(q, &min);
    *none = objective(q);
    restoreBest(q);
    MEASSERT(!(objective(q) > min + kea_assertedRounding * fabs(min)));
    memcpy(q->savedD, q->d, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].previousP = q->row[i].p;
    return min;
}

/* The Gauss-Seidel update of p without bounds; `unit` is A_ii + E, for a cone the larger one of its two rows. 0 if the
 * geometric stiffness of a very fast spin has made `unit` not positive. */
static double unboundedImpulse(const KeaProblem *q, const KeaProblemRow *row, double unit) {
    return !(unit > 0) ? 0 : row->p + (row->r - kea_rowRate(row, q->d) - row->E * row->p) / unit;
}

/* Changes the impulse of a row to p. */
static void sweepImpulse(KeaProblem *q, KeaProblemRow *row, double p) {
    addImpulse(q, row, p - row->p);
    row->p = p;
}

/* Solves friction row i alone, or the cone that it begins. */
static void relaxFriction(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i], *other = row->partner >= 0 ? &q->row[row->partner] : NULL;
    setFrictionBound(q, row);
    const double bound = row->frictionBound;
    if (row->isForced) {
        sweepImpulse(q, row, row->forced * bound);
    } else if (other && !other->isForced) {
        if (row->partner < i)
            return; /* solved with its partner */
        const double unit = keaMax(row->Aii + row->E, other->Aii + other->E);
        const double a = unboundedImpulse(q, row, unit), b = unboundedImpulse(q, other, unit),
                     size = keaHypotenuse(a, b);
        const double share = size > bound ? bound / size : 1;
        other->frictionBound = bound;
        sweepImpulse(q, row, share * a);
        sweepImpulse(q, other, share * b);
    } else {
        const double p = unboundedImpulse(q, row, row->Aii + row->E);
        sweepImpulse(q, row, keaMin(keaMax(p, keaMax(row->lower, -bound)), keaMin(row->upper, bound)));
    }
}

/* Solves row i alone: the step of the Gauss-Seidel method. */
static void relaxRow(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i];
    if (row->isInactive)
        return;
    if (row->normal >= 0)
        relaxFriction(q, i);
    else if (row->Aii > 0)
        sweepImpulse(q, row, clampToBounds(row, unboundedImpulse(q, row, row->Aii + row->E)));
}

/* ---- acceleration ---- */

/* Of Nesterov's method: θ, and the factor β of the extrapolation. */
typedef struct Momentum {
    double theta, beta;
} Momentum;

static Momentum noMomentum(void) {
    const Momentum m = {1, 0};
    return m;
}

/* p := p + β (p - previousP), d likewise. Stores the old values in previousP and savedD, the new p in y. */
static void extrapolate(KeaProblem *q, double beta) {
    for (int b = 0; b < q->numBodies; b++)
        for (int k = 0; k < 6; k++) {
            const double d = q->d[b][k];
            q->d[b][k] += beta * (d - q->savedD[b][k]);
            q->savedD[b][k] = d;
        }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        const double p = row->p;
        row->p = row->y = row->isInactive ? p : p + beta * (p - row->previousP);
        row->previousP = p;
    }
}

/* The change of the impulses by a sweep; scalar products are weighted by A_ii. */
typedef struct Change {
    double against;      /* minus the scalar product of change and momentum; positive: restart */
    double moved, total; /* squared norms of the change and of p */
} Change;

static Change measureChange(const KeaProblem *q) {
    Change c = {0, 0, 0};
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double change = row->p - row->y;
        c.against -= row->Aii * change * (row->p - row->previousP);
        c.moved += row->Aii * change * change;
        c.total += row->Aii * row->p * row->p;
    }
    return c;
}

/* Whether the sweeps have converged. */
static MeBool hasSettled(Change c) {
    return c.moved <= kea_sweepTolerance * kea_sweepTolerance * c.total;
}

static Momentum nextMomentum(Momentum m) {
    MEASSERT(m.theta >= 1);
    const double theta = 0.5 * (1 + sqrt(1 + 4 * m.theta * m.theta));
    return (Momentum){theta, (m.theta - 1) / theta};
}

static void sweepOnce(KeaProblem *q, double beta) {
    extrapolate(q, beta);
    for (int i = 0; i < q->numRows; i++)
        relaxRow(q, i);
}

double kea_problemWorkOfSweptPass(const KeaProblem *q, int sweeps) {
    return kea_problemWorkOfLinearization(q) + (double)q->numRows * KEA_SWEEP * (sweeps + KEA_START_SWEEPS);
}

MeBool kea_problemMaySweep(const KeaProblem *q) {
    return q->sweptPasses > 0 &&
           (!(q->maxWork > 0) || q->counts.work + kea_problemWorkOfSweptPass(q, KEA_FEWEST_SWEEPS) <= q->maxWork);
}

/* The number of sweeps within this pass's share of the remaining work. One linearization is reserved, for restoring an
 * earlier answer. If passes would have fewer than KEA_SOME_SWEEPS, there are fewer passes. */
static int numberOfSweeps(const KeaProblem *q) {
    if (!(q->maxWork > 0))
        return KEA_SWEEPS;
    const double left = q->maxWork - q->counts.work - kea_problemWorkOfLinearization(q);
    const double max = left / kea_problemWorkOfSweptPass(q, KEA_SOME_SWEEPS);
    const double share = left / keaMax(keaMin(floor(max), q->sweptPasses), 1) - kea_problemWorkOfSweptPass(q, 0);
    return (int)keaMin(keaMax(share / (KEA_SWEEP * (q->numRows + 1.0)), KEA_FEWEST_SWEEPS), KEA_SWEEPS);
}

void kea_problemSweep(KeaProblem *q) {
    const int max = numberOfSweeps(q);
    int sweeps = 0;
    Momentum m = noMomentum();
    Change c = {0, HUGE_VAL, 0};
    double none, min = chooseStart(q, &none);
    for (; sweeps < max && !hasSettled(c); sweeps++) {
        sweepOnce(q, m.beta);
        saveIfBest(q, &min);
        c = measureChange(q);
        m = c.against > 0 ? noMomentum() : nextMomentum(m);
    }
    if (!(objective(q) <= none))
        restoreBest(q);
    q->sweptPasses--;
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].Jd = kea_rowRate(&q->row[i], q->d);
        q->row[i].Je = 0;
        q->row[i].state = KEA_ACTIVE;
    }
    memset(q->direction, 0, (size_t)q->numBodies * sizeof *q->direction);
    kea_problemAddWork(q, (double)q->numRows * KEA_SWEEP * (sweeps + KEA_START_SWEEPS));
    kea_problemSolveJoints(q);
}
