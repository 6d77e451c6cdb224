/* The inner problem's data (kea_problem_i.h): memory, the graph of its rows, work, and what every method of solution
 * needs. */
#include "common/kea_problem_i.h"
#include "MdtKeaMath.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

void kea_problemLayOut(KeaProblem *q, int numBodies, int maxRows, KeaArena *arena) {
    const size_t n = (size_t)numBodies, m = (size_t)maxRows;
    q->row = kea_carve(arena, m, sizeof *q->row);
    q->tangent = kea_carve(arena, m, sizeof *q->tangent);
    q->metric = kea_carve(arena, n, sizeof *q->metric);
    q->turning = kea_carve(arena, n, sizeof *q->turning);
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
        if (row->body[0] < 0 || row->body[1] < 0 || row->isOut)
            row->edge = -1;
        else if (i > 0 && !before->isOut && before->body[0] == row->body[0] && before->body[1] == row->body[1])
            row->edge = before->edge;
        else
            row->edge = edgeOf(q, row->body[0], row->body[1], slots - 1);
    }
    MEASSERT(q->numEdges <= q->numRows);
}

MeBool kea_problemBegin(KeaProblem *q, struct MdtKeaCache *cache) {
    findEdges(q);
    memset(&q->counts, 0, sizeof q->counts);
    q->hasFriction = q->hasBounds = q->isTangent = MEFALSE;
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

/* One iteration: the matrix and its factors, a solution with them, and some visits of each row: gradient, forces, and
 * the line search, which takes about five. */
double kea_problemIterationWork(const KeaProblem *q, MeBool unsymmetric) {
    return (unsymmetric ? 2 : 1) * kea_factorFlops(q->factor) + 2.0 * (double)kea_factorEntries(q->factor) +
           (double)q->numRows * (KEA_ASSEMBLY + KEA_ITERATION_VISITS * KEA_VISIT);
}

MeBool kea_problemHasBudget(const KeaProblem *q, MeBool unsymmetric) {
    return !(q->maxIterations > 0 && q->counts.iterations >= q->maxIterations) &&
           !(q->maxWork > 0 && q->counts.work + kea_problemIterationWork(q, unsymmetric) > q->maxWork - q->reserve);
}

MeBool kea_problemMaySpend(KeaProblem *q, MeBool unsymmetric) {
    q->counts.isLimited = q->counts.isLimited || !kea_problemHasBudget(q, unsymmetric);
    return !q->counts.isLimited;
}

/* ---- effective masses, and from pass to pass ---- */

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

void kea_problemCarryOn(KeaProblem *q, double (*total)[6]) {
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
