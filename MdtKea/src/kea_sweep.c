/* The inner problem by sweeps over its rows: what is done when the work of a step runs out (kea_problem_i.h).
 *
 * Projected Gauss-Seidel on the rows' side. With d = B⁻¹ (Jᵀ p - g) at all times, so that momentum is kept whatever else is
 * left over, row by row
 *
 *     Δp = (r - J d - E p) / (A_ii + E),  p within its bounds,  d += B⁻¹ Jᵀ Δp.
 *
 * Each of these lowers
 *
 *     D(p) = 1/2 (Jᵀ p - g)ᵀ B⁻¹ (Jᵀ p - g) + 1/2 pᵀ E p - pᵀ r,
 *
 * which for contacts that ask for no velocity, r = -J v, is the kinetic energy after the impulses but for a constant:
 * however few sweeps there are, the answer has no more energy than it starts with. That is why it starts from whichever has
 * the least D: the impulses that the problem came with, those that Newton's method had come to, or none.
 *
 * It costs some multiplications per row and no matrix, and is soft: a sweep carries an impulse over as many rows as it happens
 * to meet in order. Sweeps go forth and back, so that it does so in both directions.
 */
#include "kea_problem_i.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include <math.h>
#include <string.h>

enum { FEWEST = 4, MOST = 32, SWEEP = 96 }; /* multiplications of a visit: J d, the bound, B⁻¹ Jᵀ p */

static void respond(double *d, const KeaMetric *B, double p, const double J[6]) {
    double turn[3];
    keaApply(turn, B->inverse, J + 3);
    for (int i = 0; i < 3; i++) {
        d[i] += p / B->linear * J[i];
        d[3 + i] += p * turn[i];
    }
}

static void push(KeaProblem *q, const KeaProblemRow *row, double p) {
    for (int k = 0; k < 2 && p != 0; k++)
        if (row->body[k] >= 0)
            respond(q->d[row->body[k]], &q->metric[row->body[k]], p, row->J[k]);
}

static double rateOf(const KeaProblem *q, const KeaProblemRow *row) {
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
        respond(q->d[b], &q->metric[b], 1, minus);
    }
    for (int i = 0; i < q->numRows; i++)
        push(q, &q->row[i], q->row[i].p);
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

/* y keeps the best impulses so far. */
static void takeIfBetter(KeaProblem *q, double *least) {
    setMotion(q);
    const double D = objective(q);
    const MeBool isBetter = D < *least;
    *least = isBetter ? D : *least;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].y = isBetter ? q->row[i].p : q->row[i].y;
}

static double within(const KeaProblemRow *row, double p) {
    return keaMin(keaMax(p, row->lower), row->upper);
}

static void chooseStart(KeaProblem *q) {
    double least = HUGE_VAL;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].y = q->row[i].isOff ? q->row[i].p : 0;
    takeIfBetter(q, &least); /* what Newton's method had come to */
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isOff ? q->row[i].p : within(&q->row[i], q->row[i].p0);
    takeIfBetter(q, &least);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].isOff ? q->row[i].p : within(&q->row[i], 0);
    takeIfBetter(q, &least);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].p = q->row[i].y;
    setMotion(q);
    MEASSERT(!(objective(q) > least + 1e-9 * fabs(least)));
}

/* What p would be without bounds, all others given; a cone's two rows with one and the same unit. */
static double wanted(const KeaProblem *q, const KeaProblemRow *row, double unit) {
    return row->p + (row->r - rateOf(q, row) - row->E * row->p) / unit;
}

static void setImpulse(KeaProblem *q, KeaProblemRow *row, double p) {
    push(q, row, p - row->p);
    row->p = p;
}

static void visitFriction(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i], *other = row->partner >= 0 ? &q->row[row->partner] : NULL;
    const double radius = row->friction * keaMax(q->row[row->normal].p, 0);
    row->radius = radius;
    if (row->isForced) {
        setImpulse(q, row, row->forced * radius);
    } else if (other && !other->isForced) {
        if (row->partner < i)
            return; /* with its partner */
        const double unit = keaMax(row->size + row->E, other->size + other->E);
        const double a = wanted(q, row, unit), b = wanted(q, other, unit), size = keaHypotenuse(a, b);
        const double share = size > radius ? radius / size : 1;
        other->radius = radius;
        setImpulse(q, row, share * a);
        setImpulse(q, other, share * b);
    } else {
        const double p = wanted(q, row, row->size + row->E);
        setImpulse(q, row, keaMin(keaMax(p, keaMax(row->lower, -radius)), keaMin(row->upper, radius)));
    }
}

static void visit(KeaProblem *q, int i) {
    KeaProblemRow *row = &q->row[i];
    if (row->isOff || !(row->size > 0))
        return;
    if (row->normal >= 0)
        visitFriction(q, i);
    else
        setImpulse(q, row, within(row, wanted(q, row, row->size + row->E)));
}

static int numberOfSweeps(const KeaProblem *q) {
    const double left = q->maxWork > 0 ? q->maxWork - q->counts.work : HUGE_VAL;
    return (int)keaMin(keaMax(left / (SWEEP * (q->numRows + 1.0)), FEWEST), MOST);
}

void kea_problemSweep(KeaProblem *q) {
    const int sweeps = numberOfSweeps(q);
    chooseStart(q);
    for (int n = 0; n < sweeps; n++)
        for (int i = 0; i < q->numRows; i++)
            visit(q, n % 2 ? q->numRows - 1 - i : i);
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].Jd = rateOf(q, &q->row[i]);
        q->row[i].Je = 0;
        q->row[i].state = KEA_HELD;
    }
    memset(q->along, 0, (size_t)q->numBodies * sizeof *q->along);
    kea_problemSpend(q, (double)q->numRows * SWEEP * (sweeps + 2));
}
