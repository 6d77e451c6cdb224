/* The inner problem by sweeps over its rows: what is done when the work of a step runs out (kea_problem_i.h).
 *
 * Projected Gauss-Seidel on the rows' side. With d = B⁻¹ (Jᵀ p - g) at all times, so that momentum is kept whatever
 * else is left over, row by row
 *
 *     Δp = (r - J d - E p) / (A_ii + E),  p within its bounds,  d += B⁻¹ Jᵀ Δp.
 *
 * Sweeps are accelerated (Nesterov 1983): each starts from y = p + β (p - p_before), d likewise, with β = (θ - 1)/θ',
 * θ' = (1 + √(1 + 4 θ²))/2, and from rest again where the last one went against its momentum, Σ A_ii (y - p)(p -
 * p_before) > 0 (O'Donoghue & Candès 2015). 32 of them do what 500 plain ones do in a pyramid. All go the same way
 * through the rows: momentum does not bear turning round.
 *
 * Without friction a sweep lowers
 *
 *     D(p) = 1/2 (Jᵀ p - g)ᵀ B⁻¹ (Jᵀ p - g) + 1/2 pᵀ E p - pᵀ r,
 *
 * which for contacts that ask for no velocity, r = -J v, is the kinetic energy after the impulses but for a constant.
 * So an answer with a D no higher than that of no impulses at all has gained no energy, and the last sweep's is taken
 * if that holds; if not, that of all sweeps and starts that has the least D. Least is not best: with friction D is
 * lowest where normal forces are raised for the friction that they allow. The start is the one with the least D of the
 * impulses that the problem came with, those that Newton's method had come to, and none.
 *
 * It costs some multiplications per row and no matrix.
 */
#include "inner/kea_problem_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <math.h>
#include <string.h>

static void addResponse(double *d, const KeaMetric *B, double p, const double J[6]) {
    double turn[3];
    keaApply(turn, B->inverse, J + 3);
    for (int i = 0; i < 3; i++) {
        d[i] += p / B->linear * J[i];
        d[3 + i] += p * turn[i];
    }
}

static void addImpulse(KeaProblem *q, const KeaProblemRow *row, double p) {
    for (int k = 0; k < 2 && p != 0; k++)
        if (row->body[k] >= 0)
            addResponse(q->d[row->body[k]], &q->metric[row->body[k]], p, row->J[k]);
}

static double rateOfChange(const KeaProblem *q, const KeaProblemRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += keaDot(row->J[k], q->d[row->body[k]]) + keaDot(row->J[k] + 3, q->d[row->body[k]] + 3);
    return rate;
}

/* d of the impulses that there are. */
static void setMotion(KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++) {
        double minus[6];
        for (int i = 0; i < 6; i++)
            minus[i] = -q->load[b][i];
        memset(q->d[b], 0, sizeof q->d[b]);
        addResponse(q->d[b], &q->metric[b], 1, minus);
    }
    for (int i = 0; i < q->numRows; i++)
        addImpulse(q, &q->row[i], q->row[i].p);
}

/* D, twice. */
static double objective(const KeaProblem *q) {
    double sum = 0;
    for (int b = 0; b < q->numBodies; b++)
        sum += 2 * kea_energyOf(&q->metric[b], q->d[b], q->d[b]);
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (!row->isOff)
            sum += row->p * (row->E * row->p - 2 * row->r);
    }
    return sum;
}

static void keepIfBetter(KeaProblem *q, double *least) {
    const double D = objective(q);
    if (!(D < *least))
        return;
    *least = D;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].best = q->row[i].p;
}

static void setFrictionBound(const KeaProblem *q, KeaProblemRow *row) {
    row->frictionBound = kea_frictionBound(q, row);
}

static void takeBest(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].best;
    for (int i = 0; i < q->numRows; i++)
        if (q->row[i].normal >= 0)
            setFrictionBound(q, &q->row[i]);
    setMotion(q);
}

static double clampToBounds(const KeaProblemRow *row, double p) {
    return keaMin(keaMax(p, row->lower), row->upper);
}

/* Takes the impulses back within their bounds; those of normal forces come before those of friction. */
static void projectImpulses(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i], *other = row->partner >= 0 ? &q->row[row->partner] : NULL;
        if (row->isOff)
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

static void considerStart(KeaProblem *q, double *least) {
    projectImpulses(q);
    setMotion(q);
    keepIfBetter(q, least);
}

/* The best of those that there are: none, what the problem came with, what Newton's method had come to. Returns its
 * D. */
static double chooseStart(KeaProblem *q, double *none) {
    double least = HUGE_VAL;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].best = q->row[i].p; /* should no D be a number */
    considerStart(q, &least);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isOff ? q->row[i].p : q->row[i].p0;
    considerStart(q, &least);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isOff ? q->row[i].p : 0;
    considerStart(q, &least);
    *none = objective(q);
    takeBest(q);
    MEASSERT(!(objective(q) > least + kea_assertedRounding * fabs(least)));
    memcpy(q->kept, q->d, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].last = q->row[i].p;
    return least;
}

/* What p would be without bounds, all others given; a cone's two rows with one and the same unit. */
static double freeImpulse(const KeaProblem *q, const KeaProblemRow *row, double unit) {
    return row->p + (row->r - rateOfChange(q, row) - row->E * row->p) / unit;
}

static void setImpulse(KeaProblem *q, KeaProblemRow *row, double p) {
    addImpulse(q, row, p - row->p);
    row->p = p;
}

static void visitFriction(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i], *other = row->partner >= 0 ? &q->row[row->partner] : NULL;
    setFrictionBound(q, row);
    const double bound = row->frictionBound;
    if (row->isForced) {
        setImpulse(q, row, row->forced * bound);
    } else if (other && !other->isForced) {
        if (row->partner < i)
            return; /* with its partner */
        const double unit = keaMax(row->size + row->E, other->size + other->E);
        const double a = freeImpulse(q, row, unit), b = freeImpulse(q, other, unit), size = keaHypotenuse(a, b);
        const double share = size > bound ? bound / size : 1;
        other->frictionBound = bound;
        setImpulse(q, row, share * a);
        setImpulse(q, other, share * b);
    } else {
        const double p = freeImpulse(q, row, row->size + row->E);
        setImpulse(q, row, keaMin(keaMax(p, keaMax(row->lower, -bound)), keaMin(row->upper, bound)));
    }
}

static void visit(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i];
    if (row->isOff || !(row->size > 0))
        return;
    if (row->normal >= 0)
        visitFriction(q, i);
    else
        setImpulse(q, row, clampToBounds(row, freeImpulse(q, row, row->size + row->E)));
}

/* ---- acceleration ---- */

typedef struct Momentum {
    double theta, beta;
} Momentum;

static Momentum noMomentum(void) {
    const Momentum m = {1, 0};
    return m;
}

/* From p, on along the way of the last sweep; d goes with it, and `last` and `kept` are where it was. */
static void extrapolate(KeaProblem *q, double beta) {
    for (int b = 0; b < q->numBodies; b++)
        for (int k = 0; k < 6; k++) {
            const double d = q->d[b][k];
            q->d[b][k] += beta * (d - q->kept[b][k]);
            q->kept[b][k] = d;
        }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        const double p = row->p;
        row->p = row->y = row->isOff ? p : p + beta * (p - row->last);
        row->last = p;
    }
}

/* What a sweep has done, in the rows' own energies, 2 J. */
typedef struct Change {
    double back;         /* of its way against that of the last one; positive: momentum does harm */
    double moved, total; /* of its way, of the impulses */
} Change;

static Change changeOf(const KeaProblem *q) {
    Change c = {0, 0, 0};
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double way = row->p - row->y;
        c.back -= row->size * way * (row->p - row->last);
        c.moved += row->size * way * way;
        c.total += row->size * row->p * row->p;
    }
    return c;
}

static MeBool hasSettled(Change c) {
    return c.moved <= kea_sweepTolerance * kea_sweepTolerance * c.total;
}

static Momentum nextMomentum(Momentum m) {
    const double theta = 0.5 * (1 + sqrt(1 + 4 * m.theta * m.theta));
    return (Momentum){theta, (m.theta - 1) / theta};
}

static void sweepOnce(KeaProblem *q, double beta) {
    extrapolate(q, beta);
    for (int i = 0; i < q->numRows; i++)
        visit(q, i);
}

double kea_problemSweptPass(const KeaProblem *q, int sweeps) {
    return KEA_LINEARIZATION * ((double)q->numRows + q->numBodies) +
           (double)q->numRows * KEA_SWEEP * (sweeps + KEA_START_SWEEPS);
}

MeBool kea_problemMaySweep(const KeaProblem *q) {
    return q->sweptPasses > 0 &&
           (!(q->maxWork > 0) || q->counts.work + kea_problemSweptPass(q, KEA_FEWEST_SWEEPS) <= q->maxWork);
}

/* In this pass's share of what work is left but for a linearization, should an earlier answer be gone back to; there
 * are fewer passes where each would have less than some sweeps. */
static int numberOfSweeps(const KeaProblem *q) {
    if (!(q->maxWork > 0))
        return KEA_SWEEPS;
    const double left = q->maxWork - q->counts.work - KEA_LINEARIZATION * ((double)q->numRows + q->numBodies);
    const double most = left / kea_problemSweptPass(q, KEA_SOME_SWEEPS);
    const double share = left / keaMax(keaMin(floor(most), q->sweptPasses), 1) - kea_problemSweptPass(q, 0);
    return (int)keaMin(keaMax(share / (KEA_SWEEP * (q->numRows + 1.0)), KEA_FEWEST_SWEEPS), KEA_SWEEPS);
}

void kea_problemSweep(KeaProblem *q) {
    const int most = numberOfSweeps(q);
    int sweeps = 0;
    Momentum m = noMomentum();
    Change c = {0, HUGE_VAL, 0};
    double none, least = chooseStart(q, &none);
    for (; sweeps < most && !hasSettled(c); sweeps++) {
        sweepOnce(q, m.beta);
        keepIfBetter(q, &least);
        c = changeOf(q);
        m = c.back > 0 ? noMomentum() : nextMomentum(m);
    }
    if (!(objective(q) <= none))
        takeBest(q);
    q->sweptPasses--;
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].Jd = rateOfChange(q, &q->row[i]);
        q->row[i].Je = 0;
        q->row[i].state = KEA_HELD;
    }
    memset(q->along, 0, (size_t)q->numBodies * sizeof *q->along);
    kea_problemSpend(q, (double)q->numRows * KEA_SWEEP * (sweeps + KEA_START_SWEEPS));
    kea_problemSolveJoints(q);
}
