/* The inner problem (kea_problem_i.h): memory, the graph of its rows, work, effective masses and residuals, which all
 * methods of solution share. */
#include "inner/kea_problem_i.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

void kea_problemLayOut(KeaProblem *q, int numBodies, int maxRows, KeaArena *arena) {
    const size_t n = (size_t)numBodies, m = (size_t)maxRows;
    KEA_CARVE(arena, q->row, m);
    KEA_CARVE(arena, q->tangent, m);
    KEA_CARVE(arena, q->metric, n);
    KEA_CARVE(arena, q->tangentInertia, n);
    KEA_CARVE(arena, q->load, n);
    KEA_CARVE(arena, q->d, n);
    KEA_CARVE(arena, q->savedD, n);
    KEA_CARVE(arena, q->gradient, n);
    KEA_CARVE(arena, q->direction, n);
    KEA_CARVE(arena, q->scale, n);
    KEA_CARVE(arena, q->length, n);
    KEA_CARVE(arena, q->tolerance, n);
    KEA_CARVE(arena, q->x, 6 * n);
    kea_graphLayOut(&q->graph, m, arena);
}

/* ---- the graph ---- */

/* Adds the edges between the bodies of a split row and those of its tail. */
static void findEdgesOfSplit(KeaProblem *q, const KeaProblemRow *row) {
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++)
            if (row->body[k] >= 0 && row[1].body[l] >= 0)
                kea_graphEdge(&q->graph, row->body[k], row[1].body[l]);
}

static int countSplitRows(const KeaProblem *q) {
    int count = 0;
    for (int i = 0; i < q->numRows; i++)
        count += q->row[i].isSplit != 0;
    return count;
}

static void findEdges(KeaProblem *q) {
    const int maxEdges = q->numRows + MdtKeaSPLITROOM * countSplitRows(q);
    kea_graphBegin(&q->graph, maxEdges);
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i], *before = row - 1;
        if (row->body[0] < 0 || row->body[1] < 0 || row->isOut)
            row->edge = -1;
        else if (i > 0 && !before->isOut && before->body[0] == row->body[0] && before->body[1] == row->body[1])
            row->edge = before->edge;
        else
            row->edge = kea_graphEdge(&q->graph, row->body[0], row->body[1]);
        if (row->isSplit)
            findEdgesOfSplit(q, row);
    }
    MEASSERT(q->graph.numEdges <= maxEdges);
}

MeBool kea_problemBegin(KeaProblem *q, struct MdtKeaCache *cache) {
    findEdges(q);
    memset(&q->counts, 0, sizeof q->counts);
    q->hasFriction = q->hasBounds = MEFALSE;
    q->hasTangent = q->isTangent = q->isWarm = q->isFactored = q->isLinear = q->isChord = MEFALSE;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->isTail)
            continue;
        q->hasFriction = q->hasFriction || row->normal >= 0;
        q->hasBounds = q->hasBounds || row->normal >= 0 || row->lower > -HUGE_VAL || row->upper < HUGE_VAL;
    }
    q->factor = kea_cacheFind(cache, q->numBodies, NULL, q->graph.numEdges, (const int(*)[2])q->graph.edges);
    return q->factor != NULL;
}

/* ---- work ---- */

void kea_problemAddWork(KeaProblem *q, double work) {
    MEASSERT(work >= 0);
    q->counts.work += work;
}

/* An iteration: assembly and factorization, one solution with the factors, and visits of each row for gradient, forces
 * and line search. */
double kea_problemIterationWork(const KeaProblem *q, MeBool unsymmetric) {
    return (unsymmetric ? 2 : 1) * kea_factorFlops(q->factor) + 2.0 * (double)kea_factorEntries(q->factor) +
           (double)q->numRows * (KEA_ASSEMBLY + KEA_ITERATION_VISITS * KEA_VISIT);
}

double kea_problemWorkOfLinearization(const KeaProblem *q) {
    return KEA_LINEARIZATION * ((double)q->numRows + q->numBodies);
}

MeBool kea_problemHasBudget(const KeaProblem *q, MeBool unsymmetric) {
    return !(q->maxIterations > 0 && q->counts.iterations >= q->maxIterations) &&
           !(q->maxWork > 0 && q->counts.work + kea_problemIterationWork(q, unsymmetric) > q->maxWork - q->reserve);
}

MeBool kea_problemMaySpend(KeaProblem *q, MeBool unsymmetric) {
    q->counts.isLimited = q->counts.isLimited || !kea_problemHasBudget(q, unsymmetric);
    return !q->counts.isLimited;
}

/* ---- effective masses, accumulation over solves ---- */

/* The cone of a row that moves nothing, along a locked axis, is the interval of the other row. */
static void leaveCone(KeaProblem *q, KeaProblemRow *row) {
    q->row[row->partner].partner = -1;
    row->partner = -1;
    row->p = row->p0 = 0;
}

void kea_problemSetEffectiveMasses(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        MEASSERT(row->normal < i && row->partner < q->numRows && row->body[0] < q->numBodies &&
                 row->body[1] < q->numBodies);
        row->Aii = row->AiiLinear = 0;
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            const KeaMetric *B = &q->metric[row->body[k]];
            const double square = keaDot(row->J[k], row->J[k]), linear = square / B->linear;
            double turn[3];
            keaApply(turn, B->inverse, row->J[k] + 3);
            row->AiiLinear += linear;
            row->Aii += linear + keaDot(row->J[k] + 3, turn);
            row->weight[k] = sqrt(square) + keaLength(row->J[k] + 3) / q->length[row->body[k]];
        }
        if (row->isTail) {
            row[-1].Aii += row->Aii;
            row[-1].AiiLinear += row->AiiLinear;
            row->Aii = row->AiiLinear = 0;
        } else if (row->Aii == 0 && row->partner >= 0) {
            leaveCone(q, row);
        }
    }
}

void kea_problemShareN(KeaProblem *q) {
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i], *other = row->partner > i ? &q->row[row->partner] : NULL;
        if (other)
            row->N = other->N = keaMax(row->N, other->N);
    }
}

void kea_problemAccumulate(KeaProblem *q, double (*total)[6]) {
    for (int b = 0; b < q->numBodies; b++) {
        double push[6];
        kea_applyMetric(push, &q->metric[b], q->d[b]);
        kea_addScaled6(total[b], 1, q->d[b]);
        kea_addScaled6(q->load[b], 1, push);
    }
    for (int i = 0; i < q->numRows; i++) {
        KeaProblemRow *row = &q->row[i];
        row->r -= row->Jd;
        row->Jd = 0;
        row->p0 = row->p;
    }
}

double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]) {
    double Ba[6];
    kea_applyMetric(Ba, B, a);
    return 0.5 * kea_dot6(Ba, b);
}

/* ---- residuals ---- */

/* m per unit of a row's coordinate: 1 for a linear row, the larger body size for an angular one. */
static double lengthOf(const KeaProblem *q, const KeaProblemRow *row) {
    double size = 0;
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        if (keaDot(row->J[k], row->J[k]) > 0)
            return 1;
        size = keaMax(size, q->length[row->body[k]]);
    }
    return size;
}

/* The projected residual of a friction cone, m/s. */
static double coneResidual(const KeaProblem *q, const KeaProblemRow *row, const double slip[2]) {
    const KeaProblemRow *other = &q->row[row->partner];
    const double bound = kea_frictionBound(q, row);
    const double unit = row->Aii + row->E; /* m/s per N s, compliance included */
    const double a = row->p - slip[0] / unit, b = other->p - slip[1] / unit, size = keaHypotenuse(a, b);
    const double share = size > bound ? bound / size : 1;
    return row->Aii * keaHypotenuse(row->p - share * a, other->p - share * b);
}

double kea_problemResidual(const KeaProblem *q, double *impulse) {
    double worst = 0, max = 0;
    for (int i = 0; i < q->numRows; i++) {
        const KeaProblemRow *row = &q->row[i];
        if (row->isInactive || row->isCheckedElsewhere || row->Aii == 0)
            continue;
        if (row->isForced) {
            const double projected = row->forced * kea_frictionBound(q, row);
            worst = keaMax(worst, row->Aii * fabs(row->p - projected));
            max = keaMax(max, fabs(row->p - projected));
        }
        if (row->isForced || (row->partner >= 0 && row->partner < i))
            continue;
        const double residual[2] = {row->Jd + row->E * row->p - row->r,
                                    row->partner >= 0
                                        ? q->row[row->partner].Jd + q->row[row->partner].E * q->row[row->partner].p -
                                              q->row[row->partner].r
                                        : 0};
        if (row->partner >= 0) {
            const double rowResidual = coneResidual(q, row, residual);
            worst = keaMax(worst, rowResidual);
            max = keaMax(max, rowResidual / row->Aii);
            continue;
        }
        const double bound = row->normal >= 0 ? kea_frictionBound(q, row) : HUGE_VAL;
        const double projected = keaMin(keaMax(row->p - residual[0] / (row->Aii + row->E), keaMax(row->lower, -bound)),
                                        keaMin(row->upper, bound));
        worst = keaMax(worst, lengthOf(q, row) * row->Aii * fabs(row->p - projected));
        max = keaMax(max, fabs(row->p - projected));
    }
    if (impulse)
        *impulse = max;
    return worst;
}
