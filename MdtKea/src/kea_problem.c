/* Newton's method for the inner problem (kea_problem_i.h).
 *
 * Per row, y = (r - J d + N p0) / (E + N), and p is y within its bounds: p = clamp(y), or for two rows that share a cone
 * of the radius R, p = y min(1, R/|y|). The gradient is B d + g - Jᵀ p, its derivative
 *
 *     H = B + Jᵀ D J,    D = 1/(E + N) within the bounds, 0 at them,
 *                        D = R/|y| (1 - ŷ ŷᵀ) / (E + N) on the cone.
 *
 * With R fixed this is convex: H is positive definite whatever rows there are, and the step along -H⁻¹ (gradient) is as
 * long as is best. Coupled, R = μ p of the normal row at every moment: then D has the further block μ ŷ / (E + N) from
 * the normal row to the friction rows, H is not symmetric, and the step is shortened until the gradient falls.
 */
#include "kea_problem_i.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include <float.h>
#include <string.h>

enum { MAX_CONVEX = 60, MAX_COUPLED = 12 };
static const double tolerance = 1e-10; /* of the scale of momenta */
static const double leastPivot = 1e-15;

void kea_problemLayOut(KeaProblem *q, int numBodies, int maxRows, KeaArena *arena) {
    const size_t n = (size_t)numBodies, m = (size_t)maxRows;
    q->row = kea_carve(arena, m, sizeof *q->row);
    q->metric = kea_carve(arena, n, sizeof *q->metric);
    q->load = kea_carve(arena, n, sizeof *q->load);
    q->d = kea_carve(arena, n, sizeof *q->d);
    q->kept = kea_carve(arena, n, sizeof *q->kept);
    q->gradient = kea_carve(arena, n, sizeof *q->gradient);
    q->along = kea_carve(arena, n, sizeof *q->along);
    q->scale = kea_carve(arena, n, sizeof(double));
    q->length = kea_carve(arena, n, sizeof(double));
    q->allowed = kea_carve(arena, n, sizeof(double));
    q->x = kea_carve(arena, 6 * n, sizeof(double));
    q->edges = kea_carve(arena, m, sizeof *q->edges);
    q->table = kea_carve(arena, 4 * m + 4, sizeof(int));
}

/* ---- the graph ---- */

/* The number of the edge between two bodies; new ones are appended. `table` is a hash with open addressing. */
static int edgeOf(KeaProblem *q, int a, int b, unsigned int mask) {
    const int low = a < b ? a : b, high = a < b ? b : a;
    unsigned int at = ((unsigned int)low * 2654435761u) ^ ((unsigned int)high * 40503u);
    for (at = (at ^ (at >> 15)) & mask; q->table[at] >= 0; at = (at + 1) & mask) {
        const int e = q->table[at];
        if (q->edges[e][0] == low && q->edges[e][1] == high)
            return e;
    }
    q->table[at] = q->numEdges;
    q->edges[q->numEdges][0] = low;
    q->edges[q->numEdges][1] = high;
    return q->numEdges++;
}

static void findEdges(KeaProblem *q) {
    unsigned int slots = 1;
    while (slots <= 2 * (unsigned int)q->numRows)
        slots *= 2;
    memset(q->table, 0xff, slots * sizeof *q->table);
    q->numEdges = 0;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i], *before = row - 1;
        if (row->body[0] < 0 || row->body[1] < 0)
            row->edge = -1;
        else if (i > 0 && before->body[0] == row->body[0] && before->body[1] == row->body[1])
            row->edge = before->edge;
        else
            row->edge = edgeOf(q, row->body[0], row->body[1], slots - 1);
    }
    MEASSERT(q->numEdges <= q->numRows);
}

MeBool kea_problemBegin(KeaProblem *q, struct MdtKeaCache *cache) {
    findEdges(q);
    memset(&q->counts, 0, sizeof q->counts);
    q->hasFriction = q->hasBounds = MEFALSE;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        q->hasFriction = q->hasFriction || row->normal >= 0;
        q->hasBounds = q->hasBounds || row->normal >= 0 || row->lower > -HUGE_VAL || row->upper < HUGE_VAL;
    }
    q->factor = kea_cacheFind(cache, q->numBodies, NULL, q->numEdges, (const int(*)[2])q->edges);
    return q->factor != NULL;
}

/* ---- work ---- */

void kea_problemSpend(KeaProblem *q, double work) {
    MEASSERT(work >= 0);
    q->counts.work += work;
}

/* One iteration: the matrix and its factors, a solution with them, and some visits of each row: gradient, forces, and the
 * line search, which takes about five. */
static double workOfIteration(const KeaProblem *q, MeBool lopsided) {
    enum { VISITS = 8 };
    return (lopsided ? 2 : 1) * kea_factorFlops(q->factor) + 2.0 * (double)kea_factorEntries(q->factor) +
           (double)q->numRows * (KEA_ASSEMBLY + VISITS * KEA_VISIT);
}

MeBool kea_problemHasMeans(const KeaProblem *q, MeBool lopsided) {
    return !(q->maxIterations > 0 && q->counts.iterations >= q->maxIterations) &&
           !(q->maxWork > 0 && q->counts.work + workOfIteration(q, lopsided) > q->maxWork - q->reserve);
}

MeBool kea_problemAffords(KeaProblem *q, MeBool lopsided) {
    q->counts.isLimited = q->counts.isLimited || !kea_problemHasMeans(q, lopsided);
    return !q->counts.isLimited;
}

/* ---- small parts ---- */

static double dot6(const double a[6], const double b[6]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

static void addScaled6(double r[6], double s, const double a[6]) {
    for (int i = 0; i < 6; i++)
        r[i] += s * a[i];
}

static void applyMetric(double r[6], const KeaMetric *B, const double d[6]) {
    for (int i = 0; i < 3; i++)
        r[i] = B->linear * d[i];
    keaApply(r + 3, B->angular, d + 3);
}

static double rateAlong(const KeaProblemRow *row, double (*const v)[6]) {
    double sum = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            sum += dot6(row->J[k], v[row->body[k]]);
    return sum;
}

static double softness(const KeaProblemRow *row) {
    return row->E + row->N;
}

void kea_problemMeasure(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        MEASSERT(row->normal < i && row->partner < q->numRows && row->body[0] < q->numBodies &&
                 row->body[1] < q->numBodies);
        row->size = 0;
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            const KeaMetric *B = &q->metric[row->body[k]];
            double turn[3];
            keaApply(turn, B->inverse, row->J[k] + 3);
            row->size += keaDot(row->J[k], row->J[k]) / B->linear + keaDot(row->J[k] + 3, turn);
            row->weight[k] = keaLength(row->J[k]) + keaLength(row->J[k] + 3) / q->length[row->body[k]];
        }
    }
}

/* ---- forces ---- */

/* What the normal force makes of a friction bound. */
static double radiusOf(const KeaProblem *q, const KeaProblemRow *row) {
    return row->friction * keaMax(q->row[row->normal].p, 0);
}

static double clampTo(double y, double lower, double upper, KeaRowState *state) {
    *state = y > lower && y < upper ? KEA_HELD : KEA_IDLE;
    return y < lower ? lower : y > upper ? upper : y;
}

static void setCone(KeaProblemRow *a, KeaProblemRow *b) {
    const double size = keaHypotenuse(a->y, b->y);
    const MeBool holds = size < a->radius;
    const double share = holds ? 1 : a->radius / size;
    a->p = a->y * (size > 0 ? share : 0);
    b->p = b->y * (size > 0 ? share : 0);
    a->state = b->state = holds ? KEA_HELD : KEA_SLIPS;
}

/* y, p and states of all rows at d + step * along. */
static void setForces(KeaProblem *q, double step, MeBool coupled) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (!row->isOff)
            row->y = (row->N * row->p0 + row->r - row->Jd - step * row->Je) / softness(row);
    }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isOff)
            continue;
        if (row->normal < 0) {
            row->p = clampTo(row->y, row->lower, row->upper, &row->state);
            continue;
        }
        if (coupled)
            row->radius = radiusOf(q, row);
        if (row->isForced) {
            row->p = row->forced * row->radius;
            row->state = KEA_SLIPS;
        } else if (row->partner > i) {
            q->row[row->partner].radius = row->radius;
            setCone(row, &q->row[row->partner]);
        } else if (row->partner < 0) {
            row->p = clampTo(row->y, keaMax(row->lower, -row->radius), keaMin(row->upper, row->radius), &row->state);
            if (row->state == KEA_IDLE && fabs(row->p) >= row->radius)
                row->state = KEA_SLIPS;
        }
    }
}

/* The gradient, and by how much it is too large: 1 is what is tolerated. A p that is known to rounding of r and J d only
 * is not asked for more. */
static double gradientError(KeaProblem *q, double step) {
    double worst = 0;
    for (int b = 0; b < q->numBodies; b++) {
        double *g = q->gradient[b], d[6];
        for (int i = 0; i < 6; i++)
            d[i] = q->d[b][i] + step * q->along[b][i];
        applyMetric(g, &q->metric[b], d);
        addScaled6(g, 1, q->load[b]);
        q->allowed[b] = tolerance * q->scale[b];
    }
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double rounding = 8 * DBL_EPSILON * (fabs(row->r) + fabs(row->Jd)) / softness(row);
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            addScaled6(q->gradient[row->body[k]], -row->p, row->J[k]);
            q->allowed[row->body[k]] +=
                row->weight[k] * (tolerance * fabs(row->p) + (row->isOff || row->state != KEA_HELD ? 0 : rounding));
        }
    }
    for (int b = 0; b < q->numBodies; b++) {
        const double *g = q->gradient[b];
        const double size = keaMax(keaLength(g), keaLength(g + 3) / q->length[b]);
        worst = keaMax(worst, size / (q->allowed[b] + DBL_MIN));
    }
    return worst;
}

/* ---- the matrix ---- */

static void addOuter(double *block, double w, const double a[6], const double b[6]) {
    for (int i = 0; i < 6; i++) {
        const double s = w * a[i];
        for (int j = 0; j < 6; j++)
            block[6 * i + j] += s * b[j];
    }
}

/* w aᵀ b over the bodies of the rows; they are the same. */
static void addRows(KeaProblem *q, const KeaProblemRow *row, double w, double (*const a)[6], double (*const b)[6],
                    MeBool isSymmetric) {
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            addOuter(kea_factorDiagonal(q->factor, row->body[k]), w, a[k], b[k]);
    if (row->edge < 0)
        return;
    const int low = row->body[0] < row->body[1] ? 0 : 1;
    addOuter(kea_factorUpper(q->factor, row->edge), w, a[low], b[!low]);
    if (!isSymmetric)
        addOuter(kea_factorLower(q->factor, row->edge), w, a[!low], b[low]);
}

static void combine(double r[2][6], double s, double (*const a)[6], double t, double (*const b)[6]) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 6; i++)
            r[k][i] = s * a[k][i] + t * b[k][i];
}

static void addForced(KeaProblem *q, KeaProblemRow *row, MeBool lopsided) {
    KeaProblemRow *normal = &q->row[row->normal];
    if (lopsided && !normal->isOff && normal->state == KEA_HELD)
        addRows(q, row, row->forced * row->friction / softness(normal), row->J, normal->J, MEFALSE);
}

/* A sliding row or cone; `lopsided`: with what the normal force does to it. */
static void addSliding(KeaProblem *q, KeaProblemRow *row, MeBool lopsided) {
    if (row->isForced) {
        addForced(q, row, lopsided);
        return;
    }
    KeaProblemRow *normal = &q->row[row->normal], *other = row->partner >= 0 ? &q->row[row->partner] : row;
    const MeBool isCone = other != row;
    const double size = isCone ? keaHypotenuse(row->y, other->y) : fabs(row->y);
    double slip[2][6];
    if (size == 0)
        return;
    if (isCone) {
        combine(slip, -other->y / size, row->J, row->y / size, other->J);
        addRows(q, row, row->radius / size / softness(row), slip, slip, !lopsided);
        combine(slip, row->y / size, row->J, other->y / size, other->J);
    } else {
        combine(slip, row->y / size, row->J, 0, row->J);
    }
    if (lopsided && !normal->isOff && normal->state == KEA_HELD)
        addRows(q, row, row->friction / softness(normal), slip, normal->J, MEFALSE);
}

static MeBool slidesUnderLoad(const KeaProblem *q) {
    for (int i = 0; q->hasFriction && i < q->numRows; i++)
        if (q->row[i].state == KEA_SLIPS && !q->row[i].isOff && q->row[q->row[i].normal].state == KEA_HELD)
            return METRUE;
    return MEFALSE;
}

static void fillMatrix(KeaProblem *q, MeBool lopsided) {
    kea_factorClear(q->factor);
    for (int b = 0; b < q->numBodies; b++) {
        double *block = kea_factorDiagonal(q->factor, b);
        const KeaMetric *B = &q->metric[b];
        for (int i = 0; i < 3; i++) {
            block[7 * i] = B->linear;
            for (int j = 0; j < 3; j++)
                block[6 * (i + 3) + j + 3] = B->angular[i][j];
        }
    }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->isOff || row->state == KEA_IDLE)
            continue;
        if (row->state == KEA_HELD)
            addRows(q, row, 1 / softness(row), row->J, row->J, !lopsided);
        else if (row->partner < 0 || row->partner > i || row->isForced)
            addSliding(q, row, lopsided);
    }
}

/* Impulses are within their bounds, and those of friction within their radius. */
static inline MeBool areWithinBounds(const KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        const double size = keaHypotenuse(row->p, row->partner >= 0 ? q->row[row->partner].p : 0);
        if (row->isOff || isnan(row->p))
            continue;
        if (row->normal < 0 ? row->p < row->lower || row->p > row->upper : size > row->radius * (1 + 1e-9) + DBL_MIN)
            return MEFALSE;
    }
    return METRUE;
}

static MeBool factor(KeaProblem *q, MeBool coupled) {
    const MeBool lopsided = coupled && slidesUnderLoad(q);
    fillMatrix(q, lopsided);
    q->counts.factorizations++;
    kea_problemSpend(q, workOfIteration(q, lopsided));
    return lopsided ? kea_factorLU(q->factor, leastPivot) : kea_factorCholesky(q->factor, leastPivot);
}

static void findDirection(KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++) {
        double *x = q->x + kea_factorOffset(q->factor, b);
        for (int i = 0; i < 6; i++)
            x[i] = -q->gradient[b][i];
    }
    kea_factorSolve(q->factor, q->x);
    for (int b = 0; b < q->numBodies; b++)
        memcpy(q->along[b], q->x + kea_factorOffset(q->factor, b), sizeof q->along[b]);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Je = rateAlong(&q->row[i], q->along);
}

static void take(KeaProblem *q, double step) {
    for (int b = 0; b < q->numBodies; b++)
        addScaled6(q->d[b], step, q->along[b]);
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].Jd += step * q->row[i].Je;
        q->row[i].Je = 0;
    }
    memset(q->along, 0, (size_t)q->numBodies * sizeof *q->along);
}

/* ---- how far along ---- */

/* The derivative of the convex function along the direction. */
static double slopeAt(KeaProblem *q, double constant, double linear, double step) {
    setForces(q, step, MEFALSE);
    double slope = constant + step * linear;
    for (int i = 0; i < q->numRows; i++)
        slope -= q->row[i].p * q->row[i].Je;
    return slope;
}

/* Where the derivative vanishes, to a thousandth of what it was: mostly the full step. A rigid row that is bounded on
 * both sides makes it jump within a very short way, so what the secant does not halve, the next point does. */
static double bestStep(KeaProblem *q) {
    double constant = 0, linear = 0, Bd[6];
    if (!q->hasBounds)
        return 1;
    for (int b = 0; b < q->numBodies; b++) {
        applyMetric(Bd, &q->metric[b], q->d[b]);
        addScaled6(Bd, 1, q->load[b]);
        constant += dot6(Bd, q->along[b]);
        applyMetric(Bd, &q->metric[b], q->along[b]);
        linear += dot6(Bd, q->along[b]);
    }
    const double start = slopeAt(q, constant, linear, 0), enough = 1e-3 * fabs(start);
    if (!(start < 0))
        return 0; /* downhill by rounding only: there is nothing left to gain */
    double low = 0, high = 1, atLow = start, atHigh = slopeAt(q, constant, linear, 1);
    while (atHigh < -enough && high < 64) {
        low = high, atLow = atHigh;
        high *= 2;
        atHigh = slopeAt(q, constant, linear, high);
    }
    double step = high, at = atHigh;
    MeBool isSlow = MEFALSE;
    for (int i = 0; i < 100 && fabs(at) > enough && high > low; i++) {
        const double width = high - low;
        step = isSlow ? 0.5 * (low + high) : low + width * atLow / (atLow - atHigh);
        at = slopeAt(q, constant, linear, step);
        if (at < 0)
            low = step, atLow = at;
        else
            high = step, atHigh = at;
        isSlow = high - low > 0.5 * width;
    }
    return step;
}

/* ---- the iteration ---- */

/* False: it was not found, or not in what work there is. */
static MeBool solveConvex(KeaProblem *q) {
    double before = HUGE_VAL;
    setForces(q, 0, MEFALSE);
    for (int i = 0; i < MAX_CONVEX; i++) {
        const double error = gradientError(q, 0);
        if (error < 1 || (error < 1e5 && error > 0.3 * before))
            return METRUE; /* found, or as far as rounding allows */
        if (!kea_problemAffords(q, MEFALSE))
            return MEFALSE;
        before = error;
        q->counts.iterations++;
        if (!factor(q, MEFALSE))
            return MEFALSE;
        findDirection(q);
        const double step = bestStep(q);
        take(q, step);
        setForces(q, 0, MEFALSE);
        if (!q->hasBounds)
            return METRUE; /* it was linear */
    }
    return gradientError(q, 0) < 1e5;
}

static MeBool solveCoupled(KeaProblem *q) {
    setForces(q, 0, METRUE);
    double error = gradientError(q, 0);
    for (int i = 0; i < MAX_COUPLED && error >= 1; i++) {
        if (!kea_problemAffords(q, METRUE))
            return MEFALSE;
        q->counts.iterations++;
        if (!factor(q, METRUE))
            return MEFALSE;
        findDirection(q);
        double step = 1, next = 0;
        for (int half = 0; half < 4; half++, step *= 0.5) {
            setForces(q, step, METRUE);
            next = gradientError(q, step);
            if (next < 0.9 * error)
                break;
        }
        if (!(next < 0.9 * error)) {
            setForces(q, 0, METRUE);
            return error < 1e3; /* rounding */
        }
        take(q, step);
        error = next;
    }
    return error < 1e3;
}

/* ---- unbounded rows alone ---- */

static MeBool isUnbounded(const KeaProblemRow *row) {
    return row->normal < 0 && row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* Takes all other rows out of the problem. False: none is left. */
static MeBool setAside(KeaProblem *q) {
    MeBool isLeft = MEFALSE;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        row->isAside = !row->isOff && !isUnbounded(row);
        row->isOff = row->isOff || row->isAside;
        isLeft = isLeft || !row->isOff;
        row->p0 = row->isOff ? row->p0 : row->p;
    }
    return isLeft;
}

double kea_problemWorkOfJoints(const KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        if (!q->row[i].isOff && isUnbounded(&q->row[i]))
            return workOfIteration(q, MEFALSE);
    return 0;
}

void kea_problemSolveJoints(KeaProblem *q) {
    if (setAside(q)) {
        setForces(q, 0, MEFALSE);
        gradientError(q, 0);
        if (factor(q, MEFALSE)) {
            findDirection(q);
            take(q, 1);
            setForces(q, 0, MEFALSE);
        } else {
            for (int i = 0; i < q->numRows; i++)
                q->row[i].p = q->row[i].isOff ? q->row[i].p : q->row[i].p0;
        }
    }
    for (int i = 0; i < q->numRows; i++)
        q->row[i].isOff = q->row[i].isOff && !q->row[i].isAside;
}

/* How far the friction bounds are from μ times the normal forces. */
static double radiusError(const KeaProblem *q) {
    double worst = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->normal < 0 || row->isOff)
            continue;
        const double wanted = radiusOf(q, row);
        if (row->state == KEA_SLIPS || keaHypotenuse(row->p, row->partner >= 0 ? q->row[row->partner].p : 0) > wanted)
            worst = keaMax(worst, fabs(row->radius - wanted) / (wanted + 1e-3 * fabs(q->row[row->normal].p) + DBL_MIN));
    }
    return worst;
}

static void keep(KeaProblem *q) {
    memcpy(q->kept, q->d, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].keptJd = q->row[i].Jd, q->row[i].keptRadius = q->row[i].radius;
}

static void restore(KeaProblem *q) {
    memcpy(q->d, q->kept, (size_t)q->numBodies * sizeof *q->d);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Jd = q->row[i].keptJd, q->row[i].radius = q->row[i].keptRadius, q->row[i].Je = 0;
    setForces(q, 0, MEFALSE);
}

MeBool kea_problemSolve(KeaProblem *q, MeBool coupled) {
    const double agree = 1e-12;
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Jd = q->row[i].Je = 0;
    memset(q->d, 0, (size_t)q->numBodies * sizeof *q->d);
    memset(q->along, 0, (size_t)q->numBodies * sizeof *q->along);
    const MeBool isFound = !q->counts.isLimited && solveConvex(q);
    if (q->counts.isLimited)
        kea_problemSweep(q);
    MEVALIDATE(areWithinBounds(q));
    if (!isFound)
        return MEFALSE;
    if (!coupled || !q->hasFriction || radiusError(q) < agree)
        return METRUE;
    keep(q);
    if (solveCoupled(q))
        return METRUE;
    restore(q);
    return MEFALSE;
}

double kea_problemError(KeaProblem *q) {
    memset(q->along, 0, (size_t)q->numBodies * sizeof *q->along);
    for (int b = 0; b < q->numBodies; b++)
        memset(q->d[b], 0, sizeof q->d[b]);
    return gradientError(q, 0);
}

void kea_problemRenewRadii(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++)
        if (q->row[i].normal >= 0)
            q->row[i].radius = radiusOf(q, &q->row[i]);
}

/* How much of the last step towards the fixed point to take back: t = f·Δf / |Δf|², f what is missing, Δf its change. */
static double secant(const KeaProblem *q) {
    const double least = -4, most = 0.9; /* a straight line is not to be trusted farther */
    double above = 0, below = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->normal < 0 || !isfinite(row->radius) || !isfinite(row->lastMissing))
            continue;
        const double f = radiusOf(q, row) - row->radius, change = f - row->lastMissing;
        above += f * change;
        below += change * change;
    }
    return below > 0 ? keaMin(keaMax(above / below, least), most) : 0;
}

/* R' = R + β f - t (ΔR + β Δf): Anderson's acceleration (1965) with a memory of one step. */
void kea_problemApproachRadii(KeaProblem *q, double share, MeBool isAccelerated) {
    const double t = isAccelerated ? secant(q) : 0;
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        if (row->normal < 0)
            continue;
        const double radius = row->radius, wanted = radiusOf(q, row), f = wanted - radius;
        double next = isfinite(radius) ? radius + share * f : wanted;
        if (t != 0 && isfinite(radius) && isfinite(row->lastRadius))
            next -= t * (radius - row->lastRadius + share * (f - row->lastMissing));
        row->radius = keaMax(next, 0);
        row->lastRadius = radius;
        row->lastMissing = f;
    }
}

double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]) {
    double Ba[6];
    applyMetric(Ba, B, a);
    return 0.5 * dot6(Ba, b);
}

double kea_largestRoot(const double c[3]) {
    const double root = c[1] * c[1] - 4 * c[0] * c[2];
    if (c[0] + c[1] + c[2] <= 0)
        return 1;
    return c[2] > 0 && root > 0 ? keaMin(keaMax((-c[1] + sqrt(root)) / (2 * c[2]), 0), 1) : 0;
}

void kea_problemCarryOn(KeaProblem *q, double (*total)[6]) {
    for (int b = 0; b < q->numBodies; b++) {
        double push[6];
        applyMetric(push, &q->metric[b], q->d[b]);
        addScaled6(total[b], 1, q->d[b]);
        addScaled6(q->load[b], 1, push);
    }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        row->r -= row->Jd;
        row->Jd = 0;
        row->p0 = row->p;
    }
}

static double conePart(const KeaProblem *q, const KeaProblemRow *row, const double slip[2]) {
    const KeaProblemRow *other = &q->row[row->partner];
    const double radius = radiusOf(q, row);
    const double unit = row->size + row->E; /* a soft row's impulse hardly moves */
    const double a = row->p - slip[0] / unit, b = other->p - slip[1] / unit, size = keaHypotenuse(a, b);
    const double share = size > radius ? radius / size : 1;
    return row->size * keaHypotenuse(row->p - share * a, other->p - share * b);
}

double kea_problemResidual(const KeaProblem *q, double *impulse) {
    double worst = 0, most = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->isOff || row->isElsewhere || row->size == 0)
            continue;
        if (row->isForced) {
            const double wanted = row->forced * radiusOf(q, row);
            worst = keaMax(worst, row->size * fabs(row->p - wanted));
            most = keaMax(most, fabs(row->p - wanted));
        }
        if (row->isForced || (row->partner >= 0 && row->partner < i))
            continue;
        const double missing[2] = {row->Jd + row->E * row->p - row->r,
                                   row->partner >= 0
                                       ? q->row[row->partner].Jd + q->row[row->partner].E * q->row[row->partner].p -
                                             q->row[row->partner].r
                                       : 0};
        if (row->partner >= 0) {
            const double part = conePart(q, row, missing);
            worst = keaMax(worst, part);
            most = keaMax(most, part / row->size);
            continue;
        }
        const double bound = row->normal >= 0 ? radiusOf(q, row) : HUGE_VAL;
        const double wanted = keaMin(keaMax(row->p - missing[0] / (row->size + row->E), keaMax(row->lower, -bound)),
                                     keaMin(row->upper, bound));
        worst = keaMax(worst, row->size * fabs(row->p - wanted));
        most = keaMax(most, fabs(row->p - wanted));
    }
    if (impulse)
        *impulse = most;
    return worst;
}
