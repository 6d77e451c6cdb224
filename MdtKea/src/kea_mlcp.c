/* Exact solution of a dense mixed linear complementarity problem with a symmetric positive semidefinite matrix:
 *
 *     (A + E) x = b + w,   lower <= x <= upper,
 *     w >= 0 where x = lower, w <= 0 where x = upper, w = 0 between.
 *
 * Block principal pivoting (Júdice and Pires 1994): guess which x are free, solve for them, and move every row that
 * contradicts the guess at once. This takes a few rounds, but it can go round in circles; when the number of
 * contradictions has not fallen for a few rounds, the primal active-set method takes over. It is slower and cannot
 * fail: the problem is that of the least 1/2 x·(A + E) x - b·x within the bounds, and every round brings it down.
 *
 * Positive definite it becomes by a regularization δ, taken out again by proximal passes, (A + E + δ) x⁺ = b + δ x, so
 * that the answer obeys the original equations to rounding. δ is the same for all rows, as ε is, some 1e-10 of their
 * mobility: redundant rows then share a load as they would for ε -> 0, with the least sum of squares. Only where
 * mobilities differ by many orders does δ follow the row's own. Rows that contradict each other never agree, and the
 * passes notice: then a stronger regularization strikes a bounded compromise.
 */
#include "kea_mlcp_i.h"
#include "MePrecision.h"
#include <string.h>

static const double usualShift = 1e-10; /* of the mean mobility */
static const double leastShift = 1e-12; /* of the row's own: below, rounding makes redundant rows indefinite */
static const double mostShift = 1e-6;   /* of the row's own: above, proximal passes are slow */
static const double strongFactor = 1e5; /* for contradictory rows */
static const double feasible = 1e-11;   /* slack of the pivoting tests, relative to the largest entry */
static const double converged = 1e-12;  /* how far the original equations may be missed, relative to the load */
static const double acceptable = 1e-7;  /* the same, when the proximal passes are used up */
static const int maxProximalPasses = 10;
static const int patience = 3; /* block exchanges without progress before the active-set method */

void kea_mlcpInit(KeaMlcp *p, int n, const double *A, KeaArena *arena) {
    const size_t m = (size_t)n;
    memset(p, 0, sizeof *p);
    p->n = n;
    p->A = A;
    double **vectors[] = {&p->E, &p->b,        &p->lower, &p->upper, &p->x,     &p->scale,
                          &p->y, &p->previous, &p->rhs,   &p->w,     &p->shift, &p->from};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        *vectors[i] = kea_carve(arena, m, sizeof(double));
    p->factor = kea_carve(arena, m * m, sizeof(double));
    p->index = kea_carve(arena, m, sizeof(int));
    p->set = kea_carve(arena, m, sizeof(KeaSet));
}

static double clamp(double x, double lower, double upper) {
    return x < lower ? lower : x > upper ? upper : x;
}

static void scaleRow(KeaMlcp *p, int i) {
    const double diagonal = p->A[i * p->n + i] + p->E[i];
    p->scale[i] = diagonal > 0 ? 1 / sqrt(diagonal) : 0;
    p->shift[i] = diagonal > 0 ? clamp(usualShift * p->mobility / diagonal, leastShift, mostShift) : leastShift;
}

void kea_mlcpBegin(KeaMlcp *p) {
    p->mobility = 0;
    for (int i = 0; i < p->n; i++)
        p->mobility += p->A[i * p->n + i] / p->n;
    for (int i = 0; i < p->n; i++) {
        scaleRow(p, i);
        p->set[i] = KEA_FREE;
    }
    p->pivots = p->factorizations = 0;
    p->capped = p->regularized = p->factorValid = MEFALSE;
}

void kea_mlcpRenew(KeaMlcp *p, int i) {
    scaleRow(p, i);
    p->factorValid = MEFALSE;
}

/* The scaled matrix: A + E with a unit diagonal. */
static double entry(const KeaMlcp *p, int i, int j) {
    const double a = p->A[i * p->n + j] + (i == j ? p->E[i] : 0);
    return p->scale[i] * a * p->scale[j];
}

static double scaledBound(const KeaMlcp *p, int i, double bound) {
    return isinf(bound) ? bound : p->scale[i] > 0 ? bound / p->scale[i] : 0;
}

static double lowerOf(const KeaMlcp *p, int i) {
    return scaledBound(p, i, p->lower[i]);
}

static double upperOf(const KeaMlcp *p, int i) {
    return scaledBound(p, i, p->upper[i]);
}

/* A row that no force can move, or that has no choice of force, stays at its bound. */
static MeBool isFixed(const KeaMlcp *p, int i) {
    return p->scale[i] == 0 || p->lower[i] >= p->upper[i];
}

/* Cholesky of the free part plus the shift. Returns false when rounding makes a pivot vanish. */
static MeBool factorize(KeaMlcp *p) {
    p->numFree = 0;
    for (int i = 0; i < p->n; i++)
        if (p->set[i] == KEA_FREE)
            p->index[p->numFree++] = i;
    double *L = p->factor;
    const int k = p->numFree;
    p->factorizations++;
    for (int i = 0; i < k; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = entry(p, p->index[i], p->index[j]) + (i == j ? p->shiftFactor * p->shift[p->index[i]] : 0);
            for (int c = 0; c < j; c++)
                sum -= L[i * k + c] * L[j * k + c];
            if (i != j) {
                L[i * k + j] = sum / L[j * k + j];
            } else {
                if (!(sum > 0.25 * p->shiftFactor * p->shift[p->index[i]]))
                    return MEFALSE;
                L[i * k + i] = sqrt(sum);
            }
        }
    }
    return METRUE;
}

static void solveFactored(const KeaMlcp *p, double *x) {
    const double *L = p->factor;
    const int k = p->numFree;
    for (int i = 0; i < k; i++) {
        for (int c = 0; c < i; c++)
            x[i] -= L[i * k + c] * x[c];
        x[i] /= L[i * k + i];
    }
    for (int i = k - 1; i >= 0; i--) {
        for (int c = i + 1; c < k; c++)
            x[i] -= L[c * k + i] * x[c];
        x[i] /= L[i * k + i];
    }
}

/* Solves the free rows with the others at their bounds, then the w of those. */
static MeBool solveForSets(KeaMlcp *p) {
    if (!p->factorValid && !(p->factorValid = factorize(p)))
        return MEFALSE;
    for (int i = 0; i < p->n; i++)
        if (p->set[i] != KEA_FREE)
            p->y[i] = p->scale[i] == 0 ? 0 : p->set[i] == KEA_LOWER ? lowerOf(p, i) : upperOf(p, i);
    for (int k = 0; k < p->numFree; k++) {
        const int i = p->index[k];
        double sum = p->scale[i] * p->b[i] + p->shiftFactor * p->shift[i] * p->previous[i];
        for (int j = 0; j < p->n; j++)
            if (p->set[j] != KEA_FREE)
                sum -= entry(p, i, j) * p->y[j];
        p->rhs[k] = sum;
    }
    solveFactored(p, p->rhs);
    for (int k = 0; k < p->numFree; k++)
        p->y[p->index[k]] = p->rhs[k];
    for (int i = 0; i < p->n; i++) {
        p->w[i] = 0;
        if (p->set[i] == KEA_FREE)
            continue;
        double sum = p->shiftFactor * p->shift[i] * (p->y[i] - p->previous[i]) - p->scale[i] * p->b[i];
        for (int j = 0; j < p->n; j++)
            sum += entry(p, i, j) * p->y[j];
        p->w[i] = sum;
    }
    return METRUE;
}

static double largest(const double *v, int n) {
    double m = 0;
    for (int i = 0; i < n; i++)
        m = fmax(m, fabs(v[i]));
    return m;
}

static double largestLoad(const KeaMlcp *p) {
    double m = 0;
    for (int i = 0; i < p->n; i++)
        m = fmax(m, fabs(p->scale[i] * p->b[i]));
    return m;
}

/* Where row i should go, given y and w: its own set when nothing contradicts it. */
static KeaSet wantedSet(const KeaMlcp *p, int i, double slackY, double slackW) {
    switch (p->set[i]) {
    case KEA_FREE:
        if (p->y[i] < lowerOf(p, i) - slackY)
            return KEA_LOWER;
        if (p->y[i] > upperOf(p, i) + slackY)
            return KEA_UPPER;
        return KEA_FREE;
    case KEA_LOWER:
        return p->w[i] < -slackW ? KEA_FREE : KEA_LOWER;
    case KEA_UPPER:
        break;
    }
    return p->w[i] > slackW ? KEA_FREE : KEA_UPPER;
}

static void moveTo(KeaMlcp *p, int i, KeaSet set) {
    p->set[i] = set;
    p->factorValid = MEFALSE;
}

typedef struct {
    double y, w; /* how far y may be beyond a bound, and w of the wrong sign: rounding */
} Slack;

static Slack slackOf(const KeaMlcp *p) {
    const double y = largest(p->y, p->n);
    return (Slack){feasible * y, feasible * fmax(largestLoad(p), y)};
}

/* Moves every row that contradicts its set; returns how many. */
static int exchange(KeaMlcp *p) {
    const Slack slack = slackOf(p);
    int count = 0;
    for (int i = 0; i < p->n; i++) {
        const KeaSet wanted = isFixed(p, i) ? p->set[i] : wantedSet(p, i, slack.y, slack.w);
        if (wanted == p->set[i])
            continue;
        moveTo(p, i, wanted);
        count++;
    }
    return count;
}

/* Moves y from `from` towards the solution of the free rows, as far as the bounds allow. Returns the row that is in the
 * way, which is put to its bound; -1 when there is none. */
static int stepToBound(KeaMlcp *p, const double *from) {
    double share = 1;
    int blocking = -1;
    for (int k = 0; k < p->numFree; k++) {
        const int i = p->index[k];
        const double bound = p->y[i] < from[i] ? lowerOf(p, i) : upperOf(p, i);
        if (p->y[i] < lowerOf(p, i) || p->y[i] > upperOf(p, i)) {
            const double reach = (bound - from[i]) / (p->y[i] - from[i]);
            if (reach < share || blocking < 0) {
                share = clamp(reach, 0, 1);
                blocking = i;
            }
        }
    }
    if (blocking < 0)
        return -1;
    const KeaSet side = p->y[blocking] < from[blocking] ? KEA_LOWER : KEA_UPPER;
    for (int k = 0; k < p->numFree; k++) {
        const int i = p->index[k];
        p->y[i] = clamp(from[i] + share * (p->y[i] - from[i]), lowerOf(p, i), upperOf(p, i));
    }
    moveTo(p, blocking, side);
    return blocking;
}

/* The row at a bound that would bring the energy down most when it is let go; -1 when the answer is found. */
static int rowToFree(const KeaMlcp *p) {
    const Slack slack = slackOf(p);
    int best = -1;
    for (int i = 0; i < p->n; i++)
        if (p->set[i] != KEA_FREE && !isFixed(p, i) && wantedSet(p, i, slack.y, slack.w) == KEA_FREE &&
            (best < 0 || fabs(p->w[i]) > fabs(p->w[best])))
            best = i;
    return best;
}

/* The primal active-set method, from y put within its bounds. */
static MeBool descend(KeaMlcp *p, int limit) {
    for (int i = 0; i < p->n; i++) {
        if (isFixed(p, i))
            continue;
        p->y[i] = clamp(p->y[i], lowerOf(p, i), upperOf(p, i));
        moveTo(p, i, p->y[i] <= lowerOf(p, i) ? KEA_LOWER : p->y[i] >= upperOf(p, i) ? KEA_UPPER : KEA_FREE);
    }
    for (int round = 0; round < limit; round++) {
        memcpy(p->from, p->y, (size_t)p->n * sizeof(double));
        if (!solveForSets(p))
            return MEFALSE;
        p->pivots++;
        if (stepToBound(p, p->from) >= 0)
            continue;
        const int free = rowToFree(p);
        if (free < 0)
            return METRUE;
        moveTo(p, free, KEA_FREE);
    }
    p->capped = METRUE;
    return METRUE;
}

/* Pivots until the sets are right for the current right-hand side. Returns false when a factorization fails. */
static MeBool pivot(KeaMlcp *p) {
    const int limit = p->maxIterations > 0 ? p->maxIterations : 100 + 20 * p->n;
    int best = p->n + 1, tries = patience;
    for (int round = 0; round < limit; round++) {
        if (!solveForSets(p))
            return MEFALSE;
        const int count = exchange(p);
        if (count == 0)
            return METRUE;
        p->pivots++;
        tries = count < best ? patience : tries - 1;
        best = count < best ? count : best;
        if (tries == 0)
            return descend(p, limit - round);
    }
    p->capped = METRUE;
    return METRUE;
}

/* Makes the sets of the last solve fit the bounds now set. */
static void startSets(KeaMlcp *p) {
    for (int i = 0; i < p->n; i++) {
        KeaSet set = p->set[i];
        if (isFixed(p, i))
            set = KEA_LOWER;
        else if ((set == KEA_LOWER && isinf(p->lower[i])) || (set == KEA_UPPER && isinf(p->upper[i])))
            set = KEA_FREE;
        if (set != p->set[i])
            p->factorValid = MEFALSE;
        p->set[i] = set;
    }
}

/* Proximal passes at one regularization. Returns false when a factorization fails or the rows contradict. */
static MeBool solveWithShift(KeaMlcp *p, double factor, int passes) {
    if (p->shiftFactor != factor) {
        p->shiftFactor = factor;
        p->factorValid = MEFALSE;
    }
    memset(p->previous, 0, (size_t)p->n * sizeof(double));
    const double load = largestLoad(p);
    double wrong = 0; /* by how much the original equations are missed */
    for (int pass = 0; pass < passes; pass++) {
        if (!pivot(p))
            return MEFALSE;
        wrong = 0;
        for (int i = 0; i < p->n; i++) {
            wrong = fmax(wrong, factor * p->shift[i] * fabs(p->y[i] - p->previous[i]));
            p->previous[i] = p->y[i];
        }
        if (p->capped || wrong <= converged * load)
            return METRUE;
    }
    return wrong <= acceptable * load;
}

/* Unscaled; exactly at the bound for a row that is there, and within bounds also where the pivoting was cut short. */
static double answerOf(const KeaMlcp *p, int i) {
    if (p->scale[i] == 0)
        return clamp(0, p->lower[i], p->upper[i]);
    if (p->set[i] != KEA_FREE)
        return p->set[i] == KEA_LOWER ? p->lower[i] : p->upper[i];
    const double x = p->scale[i] * p->y[i]; /* a solve that was capped may have left it outside */
    return clamp(isfinite(x) ? x : 0, p->lower[i], p->upper[i]);
}

void kea_mlcpSolve(KeaMlcp *p) {
    startSets(p);
    if (!solveWithShift(p, 1, maxProximalPasses)) {
        p->regularized = METRUE;
        solveWithShift(p, strongFactor, 1);
    }
    for (int i = 0; i < p->n; i++)
        p->x[i] = answerOf(p, i);
}
