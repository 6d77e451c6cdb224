/* Newton's method for the inner problem (kea_problem_i.h).
 *
 * For each row y = (r - J d + N p0) / (E + N), and p is y projected onto the bounds: p = clamp(y), or, for two rows
 * that share a cone of radius R, p = y min(1, R/|y|). The gradient is B d + g - Jᵀ p, its derivative
 *
 *     H = B + Jᵀ D J,    D = 1/(E + N) within the bounds, 0 at them,
 *                        D = R/|y| (1 - ŷ ŷᵀ) / (E + N) on the cone.
 *
 * This is a semismooth Newton method. With fixed R the problem is convex: H is positive definite for any rows, and a
 * line search minimizes along -H⁻¹ (gradient). In the coupled problem R = μ p of the normal row, D has the additional
 * block μ ŷ / (E + N) from the normal row to the friction rows, and H is not symmetric; instead of a line search, the
 * step is halved until the gradient decreases. The same holds for the tangent problem, H = B + Jᵀ D T.
 */
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include "inner/kea_newton_i.h"
#include "inner/kea_problem_i.h"
#include <float.h>
#include <string.h>

/* The derivative of a row with respect to d: T in a tangent problem, else J. */
static double (*derivativeOf(const KeaProblem *q, int i))[6] {
    return q->isTangent ? q->tangent[i] : q->row[i].J;
}

/* r = B d */
static void applyBody(const KeaProblem *q, int b, double r[6], const double d[6]) {
    kea_applyMetric(r, &q->metric[b], d);
    if (q->isTangent)
        keaApply(r + 3, (const double(*)[3])q->tangentInertia[b], d + 3);
}

/* m/s: the rate of record i, without its tail, at the velocities v, by the derivative of the problem that is solved. */
static inline double recordRateAlong(const KeaProblem *q, int i, double (*const v)[6]) {
    double(*const J)[6] = derivativeOf(q, i), sum = 0;
    for (int k = 0; k < 2; k++)
        if (q->row[i].body[k] >= 0)
            sum += kea_dot6(J[k], v[q->row[i].body[k]]);
    return sum;
}

/* The same of row i. */
static double rateAlong(const KeaProblem *q, int i, double (*const v)[6]) {
    const double rate = recordRateAlong(q, i, v);
    return q->row[i].isSplit ? rate + recordRateAlong(q, i + 1, v) : rate;
}

/* ---- forces ---- */

static double clamp(double y, double lower, double upper) {
    return y < lower ? lower : y > upper ? upper : y;
}

/* y within the bounds; sets the state. */
static double clampTo(double y, double lower, double upper, KeaRowState *state) {
    *state = y > lower && y < upper ? KEA_ACTIVE : KEA_IDLE;
    return clamp(y, lower, upper);
}

/* Sets p of the two rows of a cone to y within the cone, and their states. */
static void clampToCone(KeaProblemRow *a, KeaProblemRow *b) {
    const double size = keaHypotenuse(a->y, b->y);
    const MeBool sticks = size < a->frictionBound;
    MEASSERT(!(a->frictionBound < 0));
    const double share = sticks ? 1 : a->frictionBound / size;
    a->p = a->y * (size > 0 ? share : 0);
    b->p = b->y * (size > 0 ? share : 0);
    a->state = b->state = sticks ? KEA_ACTIVE : KEA_SLIPS;
    a->along = sticks || size == 0 ? 0 : a->y / size;
    b->along = sticks || size == 0 ? 0 : b->y / size;
    a->across = b->across = sticks || size == 0 ? 0 : a->frictionBound / size / softness(a);
}

void kea_newtonSetUnclamped(KeaProblem *q, double step) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (!row->isInactive)
            row->y = (row->N * row->p0 + row->r - row->Jd - step * row->Je) / softness(row);
    }
}

void kea_newtonClamp(KeaProblem *q, MeBool coupled) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isInactive)
            continue;
        if (row->normal < 0) {
            row->p = clampTo(row->y, row->lower, row->upper, &row->state);
            continue;
        }
        if (coupled)
            row->frictionBound = kea_frictionBound(q, row);
        if (row->isForced) {
            row->p = row->forced * row->frictionBound;
            row->state = KEA_SLIPS;
        } else if (row->partner > i) {
            q->row[row->partner].frictionBound = row->frictionBound;
            clampToCone(row, &q->row[row->partner]);
        } else if (row->partner < 0) {
            row->p = clampTo(row->y, keaMax(row->lower, -row->frictionBound), keaMin(row->upper, row->frictionBound),
                             &row->state);
            if (row->state == KEA_IDLE && fabs(row->p) >= row->frictionBound)
                row->state = KEA_SLIPS;
            row->along = row->y > 0 ? 1 : row->y < 0 ? -1 : 0;
        }
    }
}

/* Sets y, p and states of all rows at d + step * direction. */
static void setForcesAt(KeaProblem *q, double step, MeBool coupled) {
    kea_newtonSetUnclamped(q, step);
    kea_newtonClamp(q, coupled);
}

/* N s: the rounding error of p of a row within its bounds, due to that of r and J d; 0 for other rows. */
static double impulseRoundingOf(const KeaProblemRow *row) {
    if (row->isInactive || row->state != KEA_ACTIVE)
        return 0;
    return kea_roundingSteps * DBL_EPSILON * (fabs(row->r) + fabs(row->Jd)) / softness(row);
}

/* Sets the gradient to B d + g at d + step * direction. */
static void setBodyGradient(KeaProblem *q, double step) {
    for (int b = 0; b < q->numBodies; b++) {
        double *g = q->gradient[b], d[6];
        for (int i = 0; i < 6; i++)
            d[i] = q->d[b][i] + step * q->direction[b][i];
        applyBody(q, b, g, d);
        kea_addScaled6(g, 1, q->load[b]);
    }
}

void kea_newtonGradient(KeaProblem *q) {
    setBodyGradient(q, 0);
    for (int i = 0; i < q->numRows; i++)
        kea_addRowForce(q->gradient, &q->row[i], -q->row[i].p);
}

/* Adds the rounding of a row's force, N s, to the tolerances of its bodies, without its tail. */
static inline void addTolerance(KeaProblem *q, const KeaProblemRow *row, double known) {
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            q->tolerance[row->body[k]] += row->weight[k] * known;
}

/* Tolerances include the effect of the rounding of r and J d on p. */
double kea_newtonError(KeaProblem *q, double step) {
    double worst = 0;
    setBodyGradient(q, step);
    for (int b = 0; b < q->numBodies; b++)
        q->tolerance[b] = kea_newtonTolerance * q->scale[b];
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double known = kea_newtonTolerance * fabs(row->p) + impulseRoundingOf(row);
        if (known == 0)
            continue; /* no force */
        kea_addRecordForce(q->gradient, row, -row->p);
        addTolerance(q, row, known);
        if (row->isSplit) {
            kea_addRecordForce(q->gradient, row + 1, -row->p);
            addTolerance(q, row + 1, known);
        }
    }
    for (int b = 0; b < q->numBodies; b++) {
        const double *g = q->gradient[b];
        const double size = keaMax(keaLength(g), keaLength(g + 3) / q->length[b]);
        worst = keaMax(worst, size / (q->tolerance[b] + DBL_MIN));
    }
    return worst;
}

/* ---- the matrix ---- */

/* An empty batch for rows that join the same bodies as this one. */
static KeaFactorRows emptyBatchOf(const KeaProblemRow *row) {
    KeaFactorRows rows;
    rows.node[0] = row->body[0];
    rows.node[1] = row->body[1];
    rows.edge = row->edge;
    rows.isCross = MEFALSE;
    rows.count = 0;
    return rows;
}

/* Adds w aᵀ b to the matrix, a and b the Jacobians of two rows between the same bodies. */
static void addRowProduct(KeaProblem *q, const KeaProblemRow *row, double w, double (*const a)[6], double (*const b)[6],
                          MeBool isSymmetric) {
    KeaFactorRows rows = emptyBatchOf(row);
    kea_factorAppendRow(&rows, w, a, b);
    kea_factorAddRows(q->factor, &rows, isSymmetric);
}

static MeBool isActive(const KeaProblemRow *row) {
    return !row->isInactive && row->state == KEA_ACTIVE;
}

/* Adds the active split row i: the blocks of its head, of its tail, and of each pair of bodies of both. */
static void addSplitRow(KeaProblem *q, int i, MeBool isSymmetric) {
    const KeaProblemRow *row = &q->row[i];
    const double w = 1 / softness(row);
    double(*const T)[6] = derivativeOf(q, i), (*const tailT)[6] = derivativeOf(q, i + 1);
    addRowProduct(q, row, w, q->row[i].J, T, isSymmetric);
    addRowProduct(q, row + 1, w, q->row[i + 1].J, tailT, isSymmetric);
    for (int k = 0; k < 4; k++) {
        const int head = k / 2, tail = k % 2, a = row->body[head], b = row[1].body[tail];
        if (a < 0 || b < 0)
            continue;
        KeaFactorRows rows = {.node = {a, b}, .edge = kea_graphEdge(&q->graph, a, b), .isCross = METRUE, .count = 1};
        rows.weight[0] = w;
        rows.a[0][0] = row->J[head], rows.a[1][0] = row[1].J[tail];
        rows.b[0][0] = T[head], rows.b[1][0] = tailT[tail];
        kea_factorAddRows(q->factor, &rows, isSymmetric);
    }
}

/* Adds the run of active rows from `first` on that join the same bodies to the matrix. Returns their number. */
static int addActiveRows(KeaProblem *q, int first, MeBool isSymmetric) {
    const KeaProblemRow *row = &q->row[first];
    KeaFactorRows rows = emptyBatchOf(row);
    if (row->isSplit) {
        addSplitRow(q, first, isSymmetric);
        return 1;
    }
    for (int i = first; i < q->numRows && rows.count < KEA_FACTOR_ROWS && isActive(&q->row[i]); i++) {
        if (q->row[i].body[0] != row->body[0] || q->row[i].body[1] != row->body[1] || q->row[i].isSplit)
            break;
        kea_factorAppendRow(&rows, 1 / softness(&q->row[i]), q->row[i].J, derivativeOf(q, i));
    }
    kea_factorAddRows(q->factor, &rows, isSymmetric);
    return rows.count;
}

/* r = s a + t b */
static void combineJacobians(double r[2][6], double s, double (*const a)[6], double t, double (*const b)[6]) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 6; i++)
            r[k][i] = s * a[k][i] + t * b[k][i];
}

/* Adds the derivative of a forced row's bound with respect to the normal force; with fixed bounds it has none. */
static void addForcedFriction(KeaProblem *q, KeaProblemRow *row, MeBool unsymmetric) {
    KeaProblemRow *normal = &q->row[row->normal];
    if (unsymmetric && !normal->isInactive && normal->state == KEA_ACTIVE)
        addRowProduct(q, row, row->forced * row->friction / softness(normal), row->J, normal->J, MEFALSE);
}

/* Adds a sliding row or cone to the matrix; `unsymmetric`: with the derivative of its bound with respect to the normal
 * force. */
static void addSlidingFriction(KeaProblem *q, KeaProblemRow *row, MeBool unsymmetric) {
    if (row->isForced) {
        addForcedFriction(q, row, unsymmetric);
        return;
    }
    KeaProblemRow *normal = &q->row[row->normal], *other = row->partner >= 0 ? &q->row[row->partner] : row;
    double slip[2][6];
    if (other != row) {
        combineJacobians(slip, -other->along, row->J, row->along, other->J);
        addRowProduct(q, row, row->across, slip, slip, !unsymmetric);
        combineJacobians(slip, row->along, row->J, other->along, other->J);
    } else {
        combineJacobians(slip, row->along, row->J, 0, row->J);
    }
    if (unsymmetric && !normal->isInactive && normal->state == KEA_ACTIVE)
        addRowProduct(q, row, row->friction / softness(normal), slip, normal->J, MEFALSE);
}

/* Whether a row slides whose bound depends on a normal force that is not at its own bound. */
static MeBool slidesUnderLoad(const KeaProblem *q) {
    for (int i = 0; q->hasFriction && i < q->numRows; i++)
        if (q->row[i].state == KEA_SLIPS && !q->row[i].isInactive && q->row[q->row[i].normal].state == KEA_ACTIVE)
            return METRUE;
    return MEFALSE;
}

/* Assembles H for the present states. */
static void fillMatrix(KeaProblem *q, MeBool unsymmetric) {
    kea_factorClear(q->factor);
    for (int b = 0; b < q->numBodies; b++) {
        double *block = kea_factorDiagonal(q->factor, b);
        const KeaMetric *B = &q->metric[b];
        double(*const angular)[3] = q->isTangent ? q->tangentInertia[b] : q->metric[b].angular;
        for (int i = 0; i < 3; i++) {
            block[7 * i] = B->linear;
            for (int j = 0; j < 3; j++)
                block[6 * (i + 3) + j + 3] = angular[i][j];
        }
    }
    for (int i = 0; i < q->numRows;) {
        KeaProblemRow *row = &q->row[i];
        if (isActive(row)) {
            i += addActiveRows(q, i, !unsymmetric);
            continue;
        }
        if (!row->isInactive && row->state == KEA_SLIPS && (row->partner < 0 || row->partner > i || row->isForced))
            addSlidingFriction(q, row, unsymmetric);
        i++;
    }
}

/* Whether p of all rows are within their bounds or cones; for assertions. */
static inline MeBool areWithinBounds(const KeaProblem *q) {
    double sum = 0;
    for (int i = 0; i < q->numRows; i++)
        sum += fabs(q->row[i].p);
    if (!(sum < kea_maxAsserted)) /* too large to be compared */
        return METRUE;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double size = keaHypotenuse(row->p, row->partner >= 0 ? q->row[row->partner].p : 0);
        if (row->isInactive)
            continue;
        if (row->normal < 0 ? row->p < row->lower || row->p > row->upper
                            : size > row->frictionBound * (1 + kea_assertedRounding) + DBL_MIN)
            return MEFALSE;
    }
    return METRUE;
}

MeBool kea_newtonFactorize(KeaProblem *q, MeBool coupled) {
    const MeBool unsymmetric = q->isTangent || (coupled && slidesUnderLoad(q));
    fillMatrix(q, unsymmetric);
    q->isFactored = q->isTangent || (q->isLinear && coupled) || q->isChord;
    q->factoredLevel = q->counts.level;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].factored = q->row[i].state;
    q->counts.factorizations++;
    kea_problemAddWork(q, kea_problemIterationWork(q, unsymmetric));
    return unsymmetric ? kea_factorLU(q->factor, kea_minPivot) : kea_factorCholesky(q->factor, kea_minPivot);
}

void kea_newtonDirection(KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++) {
        double *x = q->x + kea_factorOffset(q->factor, b);
        for (int i = 0; i < 6; i++)
            x[i] = -q->gradient[b][i];
    }
    kea_factorSolve(q->factor, q->x);
    for (int b = 0; b < q->numBodies; b++)
        memcpy(q->direction[b], q->x + kea_factorOffset(q->factor, b), sizeof q->direction[b]);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Je = rateAlong(q, i, q->direction);
}

void kea_newtonApply(KeaProblem *q, double step) {
    for (int b = 0; b < q->numBodies; b++)
        kea_addScaled6(q->d[b], step, q->direction[b]);
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].Jd += step * q->row[i].Je;
        q->row[i].Je = 0;
    }
    memset(q->direction, 0, (size_t)q->numBodies * sizeof *q->direction);
}

/* ---- line search ---- */

/* p Je of a row, or the sum of both rows of a cone, at y + step * yRate. */
static double powerAt(const KeaProblem *q, const KeaProblemRow *row, double step) {
    const double y = row->y + step * row->yRate, bound = row->frictionBound;
    if (row->normal < 0)
        return row->Je * clamp(y, row->lower, row->upper);
    if (row->isForced)
        return row->Je * row->forced * bound;
    if (row->partner < 0)
        return row->Je * clamp(y, keaMax(row->lower, -bound), keaMin(row->upper, bound));
    const KeaProblemRow *other = &q->row[row->partner];
    const double otherY = other->y + step * other->yRate, size = keaHypotenuse(y, otherY);
    return (row->Je * y + other->Je * otherY) * (size < bound ? 1 : size > 0 ? bound / size : 0);
}

/* The derivative of the convex function along the search direction at `step`; constant + step * linear is the bodies'
 * part. */
static double slopeAt(const KeaProblem *q, double constant, double linear, double step) {
    double slope = constant + step * linear;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->isInactive)
            slope -= row->Je * row->p;
        else if (row->isForced || row->partner < 0 || row->partner > i)
            slope -= powerAt(q, row, step);
    }
    return slope;
}

/* Line search: the step at which the derivative along the direction vanishes, to kea_lineSearchTolerance; mostly 1. It
 * is found by regula falsi, with a bisection after each iteration that did not halve the interval, since the derivative
 * is steep where a rigid row with two bounds passes from one to the other. */
static double searchLine(KeaProblem *q) {
    double constant = 0, linear = 0, Bd[6];
    if (!q->hasBounds)
        return 1;
    for (int i = 0; i < q->numRows; i++)
        if (!q->row[i].isInactive)
            q->row[i].yRate = -q->row[i].Je / softness(&q->row[i]);
    for (int b = 0; b < q->numBodies; b++) {
        kea_applyMetric(Bd, &q->metric[b], q->d[b]);
        kea_addScaled6(Bd, 1, q->load[b]);
        constant += kea_dot6(Bd, q->direction[b]);
        kea_applyMetric(Bd, &q->metric[b], q->direction[b]);
        linear += kea_dot6(Bd, q->direction[b]);
    }
    const double start = slopeAt(q, constant, linear, 0), enough = kea_lineSearchTolerance * fabs(start);
    if (!(start < 0))
        return 0; /* no descent direction: the gradient is rounding */
    double low = 0, high = 1, atLow = start, atHigh = slopeAt(q, constant, linear, 1);
    while (atHigh < -enough && high < kea_longestStep) {
        low = high, atLow = atHigh;
        high *= 2;
        atHigh = slopeAt(q, constant, linear, high);
    }
    if (atHigh < -enough)
        return high; /* a longer step is not tried */
    double step = high, at = atHigh;
    MeBool isSlow = MEFALSE;
    for (int i = 0; i < KEA_MAX_LINE_SEARCH && fabs(at) > enough && high > low; i++) {
        const double width = high - low;
        step = isSlow ? 0.5 * (low + high) : low + width * atLow / (atLow - atHigh);
        at = slopeAt(q, constant, linear, step);
        if (at < 0)
            low = step, atLow = at;
        else
            high = step, atHigh = at;
        isSlow = high - low > 0.5 * width;
    }
    MEASSERT(step >= 0 && step <= kea_longestStep);
    return step;
}

/* ---- the iteration ---- */

/* Solves the convex problem, with fixed friction bounds. False: not converged, or the budget is used up. */
static MeBool solveConvex(KeaProblem *q) {
    double before = HUGE_VAL;
    setForcesAt(q, 0, MEFALSE);
    for (int i = 0; i < KEA_MAX_CONVEX; i++) {
        const double error = kea_newtonError(q, 0);
        if (error < 1 || (error < kea_convexRounding && error > kea_convexProgress * before))
            return METRUE; /* converged, or stagnating at rounding */
        if (!kea_problemMaySpend(q, MEFALSE))
            return MEFALSE;
        before = error;
        q->counts.iterations++;
        if (!kea_newtonFactorize(q, MEFALSE))
            return MEFALSE;
        kea_newtonDirection(q);
        const double step = searchLine(q);
        kea_newtonApply(q, step);
        setForcesAt(q, 0, MEFALSE);
        if (!q->hasBounds)
            return METRUE; /* linear: exact after one step */
    }
    return kea_newtonError(q, 0) < kea_convexRounding;
}

/* Solves the coupled problem, starting from the present d and p. False: not converged. */
static MeBool solveCoupled(KeaProblem *q) {
    setForcesAt(q, 0, METRUE);
    double error = kea_newtonError(q, 0);
    for (int i = 0; i < KEA_MAX_COUPLED && error >= 1; i++) {
        if (!kea_problemMaySpend(q, METRUE))
            return MEFALSE;
        q->counts.iterations++;
        if (!kea_newtonFactorize(q, METRUE))
            return MEFALSE;
        kea_newtonDirection(q);
        double step = 1, next = 0;
        for (int half = 0; half < KEA_MAX_HALVINGS; half++, step *= 0.5) {
            setForcesAt(q, step, METRUE);
            next = kea_newtonError(q, step);
            if (next < kea_coupledProgress * error)
                break;
        }
        if (!(next < kea_coupledProgress * error)) {
            setForcesAt(q, 0, METRUE);
            return error < kea_coupledRounding; /* no step length decreases the error */
        }
        kea_newtonApply(q, step);
        error = next;
    }
    return error < kea_coupledRounding;
}

/* Saves d, Jd and friction bounds. */
static void saveAnswer(KeaProblem *q) {
    memcpy(q->savedD, q->d, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].keptJd = q->row[i].Jd, q->row[i].keptBound = q->row[i].frictionBound;
}

/* Restores d, Jd and friction bounds, and the impulses of the convex problem that follow from them. */
static void restoreConvexAnswer(KeaProblem *q) {
    memcpy(q->d, q->savedD, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Jd = q->row[i].keptJd, q->row[i].frictionBound = q->row[i].keptBound, q->row[i].Je = 0;
    setForcesAt(q, 0, MEFALSE);
}

/* Sets d, the search direction, Jd and Je to 0. */
static void clearSolution(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Jd = q->row[i].Je = 0;
    memset(q->d, 0, (size_t)q->numBodies * sizeof *q->d);
    memset(q->direction, 0, (size_t)q->numBodies * sizeof *q->direction);
}

static MeBool isAnswerFinite(const KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++)
        for (int i = 0; i < 6; i++)
            if (!isfinite(q->d[b][i]))
                return MEFALSE;
    for (int i = 0; i < q->numRows; i++)
        if (!isfinite(q->row[i].p))
            return MEFALSE;
    return METRUE;
}

/* Solves the coupled problem, starting from the states that follow from p (kea_states.c). False: not converged; d is 0,
 * and friction bounds are restored. */
static MeBool solveFromStates(KeaProblem *q) {
    saveAnswer(q);
    q->isTangent = q->hasTangent;
    const MeBool isFound = (kea_statesSolve(q) || solveCoupled(q)) && isAnswerFinite(q);
    q->isSingular = q->isTangent && !isFound;
    q->isTangent = MEFALSE;
    if (isFound)
        return METRUE;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].frictionBound = q->row[i].keptBound;
    clearSolution(q);
    return MEFALSE;
}

/* Solves the coupled problem, starting from the answer of the convex one. False: not converged, and that answer is
 * restored. */
static MeBool solveFromConvex(KeaProblem *q) {
    saveAnswer(q);
    q->isTangent = q->hasTangent;
    for (int i = 0; i < q->numRows && q->isTangent; i++)
        q->row[i].Jd = rateAlong(q, i, q->d);
    const MeBool isFound = solveCoupled(q) && isAnswerFinite(q);
    q->isTangent = MEFALSE;
    if (!isFound)
        restoreConvexAnswer(q);
    return isFound;
}

MeBool kea_problemRefine(KeaProblem *q) {
    clearSolution(q);
    const MeBool mayKeep = q->hasTangent || q->isLinear || q->isChord;
    if (!mayKeep || !q->isFactored || q->factoredLevel != q->counts.level || q->counts.isLimited)
        return MEFALSE;
    q->isTangent = q->hasTangent;
    saveAnswer(q);
    const MeBool isFound = kea_statesRefine(q) && isAnswerFinite(q);
    q->isTangent = MEFALSE;
    if (isFound)
        return METRUE;
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].frictionBound = q->row[i].keptBound;
        q->row[i].p = q->row[i].p0;
    }
    clearSolution(q);
    return MEFALSE;
}

MeBool kea_problemSolve(KeaProblem *q, MeBool coupled) {
    clearSolution(q);
    q->isSingular = MEFALSE;
    if (coupled && q->isWarm && (q->hasTangent || q->hasFriction) && !q->counts.isLimited && solveFromStates(q))
        return METRUE;
    const MeBool isFound = !q->counts.isLimited && solveConvex(q);
    if (q->counts.isLimited)
        kea_problemSweep(q);
    MEVALIDATE(areWithinBounds(q));
    if (!isFound)
        return MEFALSE;
    return !coupled || !q->hasFriction || kea_frictionBoundsError(q) < kea_boundsAgree || solveFromConvex(q);
}

double kea_problemError(KeaProblem *q) {
    memset(q->direction, 0, (size_t)q->numBodies * sizeof *q->direction);
    for (int b = 0; b < q->numBodies; b++)
        memset(q->d[b], 0, sizeof q->d[b]);
    return kea_newtonError(q, 0);
}

/* ---- solve for unbounded rows with all others fixed ---- */

static MeBool isUnbounded(const KeaProblemRow *row) {
    return row->normal < 0 && row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* Makes all bounded rows inactive temporarily (isDeactivated). False: no active row is left. */
static MeBool deactivateBoundedRows(KeaProblem *q) {
    MeBool isLeft = MEFALSE;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        row->isDeactivated = !row->isInactive && !isUnbounded(row);
        row->isInactive = row->isInactive || row->isDeactivated;
        isLeft = isLeft || !row->isInactive;
        row->p0 = row->isInactive ? row->p0 : row->p;
    }
    return isLeft;
}

void kea_problemSolveJoints(KeaProblem *q) {
    if (deactivateBoundedRows(q)) {
        setForcesAt(q, 0, MEFALSE);
        kea_newtonGradient(q);
        if (kea_newtonFactorize(q, MEFALSE)) {
            kea_newtonDirection(q);
            kea_newtonApply(q, 1);
            setForcesAt(q, 0, MEFALSE);
        } else {
            for (int i = 0; i < q->numRows; i++)
                q->row[i].p = q->row[i].isInactive ? q->row[i].p : q->row[i].p0;
        }
    }
    for (int i = 0; i < q->numRows; i++)
        q->row[i].isInactive = q->row[i].isInactive && !q->row[i].isDeactivated;
}
