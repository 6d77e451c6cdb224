/* The dual of the inner problem, with impulses as unknowns, for joints without bounds and loops: there it has fewer
 * unknowns. With p = p_0 + Δp,
 *
 *     (J B⁻¹ Jᵀ + E) Δp = r - E p_0 - J B⁻¹ (Jᵀ p_0 - g),      d = B⁻¹ (Jᵀ p - g).
 *
 * The matrix has a block for every joint, coupled where two joints share a body: for a chain of ball joints its
 * factorization takes a seventh of the work of the primal one. The cheaper one is chosen by flop count.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static MeBool areOfOneJoint(const MdtKeaRow *a, const MdtKeaRow *b) {
    return a->owner == b->owner && a->body[0] == b->body[0] && a->body[1] == b->body[1];
}

/* Makes a node of each run of rows of one joint. False: the dual is not possible, as a row is bounded, inactive or of a
 * contact, or a joint has too many rows. */
static MeBool findNodes(MdtKeaSystem *s, KeaDual *d) {
    d->numNodes = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact >= 0 || row->normal >= 0 || row->lower > -HUGE_VAL || row->upper < HUGE_VAL ||
            s->work->problem.row[i].isInactive)
            return MEFALSE;
        if (i == 0 || !areOfOneJoint(row, row - 1)) {
            d->start[d->numNodes] = i;
            d->size[d->numNodes++] = 0;
        }
        if (++d->size[d->numNodes - 1] > KEA_FACTOR_MAX_BLOCK)
            return MEFALSE;
    }
    d->start[d->numNodes] = s->numRows;
    MEASSERT(d->numNodes <= s->numRows);
    return METRUE;
}

/* Makes an edge of each pair of joints that share a body, by lists of the joints of each body. False: there are more
 * edges than memory, or two joints share both bodies. */
static MeBool findEdges(MdtKeaSystem *s, KeaDual *d) {
    d->numEdges = 0;
    for (int b = 0; b < s->numBodies; b++)
        d->first[b] = -1;
    for (int n = 0; n < d->numNodes; n++) {
        const KeaProblemRow *row = &s->work->problem.row[d->start[n]];
        d->lastJoined[n] = -1;
        for (int k = 0; k < 2; k++) {
            const int b = row->body[k];
            if (b < 0)
                continue;
            for (int m = d->first[b]; m >= 0; m = d->next[m / 2][m % 2]) {
                if (d->numEdges == s->maxRows || d->lastJoined[m / 2] == n)
                    return MEFALSE;
                MEASSERT(m / 2 < n);
                d->lastJoined[m / 2] = n;
                d->edges[d->numEdges][0] = m / 2;
                d->edges[d->numEdges][1] = n;
                d->side[d->numEdges][0] = m % 2;
                d->side[d->numEdges++][1] = k;
            }
        }
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            d->next[n][k] = d->first[row->body[k]];
            d->first[row->body[k]] = 2 * n + k;
        }
    }
    return METRUE;
}

void kea_dualChooseFactor(MdtKeaSystem *s) {
    KeaDual *d = &s->work->dual;
    d->factor = NULL;
    if (s->work->hasLoops || s->work->hasLocks || !findNodes(s, d) || !findEdges(s, d))
        return;
    KeaFactor *factor = kea_cacheFind(s->cache, d->numNodes, d->size, d->numEdges, (const int(*)[2])d->edges);
    if (factor && kea_factorFlops(factor) < kea_factorFlops(s->work->problem.factor))
        d->factor = factor;
}

/* ---- a solve ---- */

/* r = B⁻¹ J */
static void applyInverseMetric(const KeaMetric *B, double r[6], const double J[6]) {
    keaScale(r, 1 / B->linear, J);
    keaApply(r + 3, B->inverse, J + 3);
}

/* Fills the upper triangle of the node's diagonal block, and the responses of its rows. */
static void fillDiagonal(KeaProblem *q, KeaDual *d, int n) {
    double *block = kea_factorDiagonal(d->factor, n);
    const int size = d->size[n], start = d->start[n];
    for (int i = 0; i < size; i++) {
        const KeaProblemRow *a = &q->row[start + i];
        for (int k = 0; k < 2; k++) {
            if (a->body[k] < 0)
                continue;
            double *response = d->response[start + i][k];
            applyInverseMetric(&q->metric[a->body[k]], response, a->J[k]);
            for (int j = i; j < size; j++)
                block[i * size + j] += kea_bodyRate(response, q->row[start + j].J[k]);
        }
        block[i * size + i] += a->E + kea_dualRegularization * a->Aii;
    }
}

/* Adds the block of the two joints of edge e, which share a body. */
static void fillEdge(KeaProblem *q, KeaDual *d, int e) {
    const int m = d->edges[e][0], n = d->edges[e][1], k = d->side[e][0], l = d->side[e][1];
    double *block = kea_factorUpper(d->factor, e);
    for (int i = 0; i < d->size[m]; i++)
        for (int j = 0; j < d->size[n]; j++)
            block[i * d->size[n] + j] += kea_bodyRate(d->response[d->start[m] + i][k], q->row[d->start[n] + j].J[l]);
}

/* Assembles and factors the dual matrix. False: it is not positive definite in the arithmetic. */
static MeBool factorizeDual(KeaProblem *q, KeaDual *d) {
    kea_factorClear(d->factor);
    for (int n = 0; n < d->numNodes; n++)
        fillDiagonal(q, d, n);
    for (int e = 0; e < d->numEdges; e++)
        fillEdge(q, d, e);
    q->counts.factorizations++;
    kea_problemAddWork(q, kea_factorFlops(d->factor) + 2.0 * (double)kea_factorEntries(d->factor) +
                              (double)q->numRows * (KEA_ASSEMBLY + 2 * KEA_VISIT));
    return kea_factorCholesky(d->factor, kea_minPivot);
}

/* Sets d := B⁻¹ (Jᵀ p - g) for the present p, and Jd of all rows. */
static void solveBodies(KeaProblem *q) {
    for (int b = 0; b < q->numBodies; b++)
        for (int i = 0; i < 6; i++)
            q->gradient[b][i] = -q->load[b][i];
    for (int i = 0; i < q->numRows; i++)
        kea_addRowForce(q->gradient, &q->row[i], q->row[i].p);
    for (int b = 0; b < q->numBodies; b++)
        applyInverseMetric(&q->metric[b], q->d[b], q->gradient[b]);
    for (int i = 0; i < q->numRows; i++)
        q->row[i].Jd = kea_rowRate(&q->row[i], q->d);
}

MeBool kea_dualSolve(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    KeaDual *d = &s->work->dual;
    if (!d->factor || !kea_problemMaySpend(q, MEFALSE) || !factorizeDual(q, d))
        return MEFALSE;
    q->counts.iterations++;
    solveBodies(q);
    for (int i = 0; i < q->numRows; i++)
        d->x[i] = q->row[i].r - q->row[i].E * q->row[i].p - q->row[i].Jd;
    kea_factorSolve(d->factor, d->x);
    for (int i = 0; i < q->numRows; i++) {
        q->row[i].p += d->x[i];
        q->row[i].state = KEA_ACTIVE;
    }
    solveBodies(q);
    return METRUE;
}
