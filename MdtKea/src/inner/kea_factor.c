/* Numerical phase of the sparse block factorization (kea_factor_i.h).
 *
 * A = L U, by blocks, left-looking: when the turn of node j comes, it gathers from every earlier node k that has j in
 * its structure,
 *
 *     A_jj -= L_jk U_kj,    A_ji -= L_jk U_ki,    A_ij -= L_ik U_kj     for i after j in the structure of k,
 *
 * factors A_jj, and divides by it: U_ji = L_jj⁻¹ A_ji, L_ij = A_ij U_jj⁻¹. A column of L is kept as its transpose, so
 * that all products are sums of Xᵀ Y, row by row. Of a symmetric matrix L = Uᵀ: only U is kept.
 */
#include "MeAssert.h"
#include "inner/kea_structure_i.h"
#include <math.h>
#include <string.h>

/* ---- the graph ---- */

MeBool kea_factorMatches(const KeaFactor *f, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    return f->numNodes == numNodes && f->numEdges == numEdges &&
           memcmp(f->size, size, (size_t)numNodes * sizeof(int)) == 0 &&
           (numEdges == 0 || memcmp(f->edges, edges, (size_t)numEdges * sizeof *edges) == 0);
}

int kea_factorOffset(const KeaFactor *f, int node) {
    return f->offset[node];
}

double kea_factorFlops(const KeaFactor *f) {
    return f->flops;
}

size_t kea_factorEntries(const KeaFactor *f) {
    return f->diagonalSize + f->factorSize;
}

/* ---- the matrix ---- */

size_t kea_factorNumbersSize(const KeaFactor *f) {
    KeaFactor plan = *f;
    return kea_structureLayOutNumbers(&plan, NULL);
}

void kea_factorTakeNumbers(KeaFactor *f, char *memory) {
    kea_structureLayOutNumbers(f, memory);
    f->numbers->owner = f;
}

void kea_factorClear(KeaFactor *f) {
    kea_factorClearIn(f, f->numbers->block.memory);
}

void kea_factorClearIn(KeaFactor *f, char *memory) {
    kea_factorTakeNumbers(f, memory);
    memset(f->diagonal, 0, f->diagonalSize * sizeof(double));
    memset(f->upperInput, 0, f->inputSize * sizeof(double));
    memset(f->lowerInput, 0, f->inputSize * sizeof(double));
}

double *kea_factorDiagonal(KeaFactor *f, int node) {
    MEASSERT(node >= 0 && node < f->numNodes);
    return f->diagonal + f->diagonalAt[node];
}

double *kea_factorUpper(KeaFactor *f, int edge) {
    MEASSERT(edge >= 0 && edge < f->numEdges);
    return f->upperInput + f->edgeAt[edge];
}

double *kea_factorLower(KeaFactor *f, int edge) {
    return f->lowerInput + f->edgeAt[edge];
}

/* ---- blocks ---- */

static inline void subtractProductOf(double *restrict C, const double *restrict X, const double *restrict Y, int inner,
                                     int rows, int columns) {
    for (int p = 0; p < inner; p++) {
        for (int i = 0; i < rows; i++) {
            const double x = X[p * rows + i];
            for (int j = 0; j < columns; j++)
                C[i * columns + j] -= x * Y[p * columns + j];
        }
    }
}

/* C -= Xᵀ Y; X has `inner` rows. */
static void subtractProduct(double *C, const double *X, const double *Y, int inner, int rows, int columns) {
    if (inner == 6 && rows == 6 && columns == 6)
        subtractProductOf(C, X, Y, 6, 6, 6);
    else if (inner == 3 && rows == 3 && columns == 3)
        subtractProductOf(C, X, Y, 3, 3, 3);
    else
        subtractProductOf(C, X, Y, inner, rows, columns);
}

static void transpose(double *r, const double *a, int rows, int columns) {
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            r[j * rows + i] = a[i * columns + j];
}

/* D = Uᵀ U in place, the upper triangle; its diagonal is kept inverted. */
static MeBool choleskyOf(double *D, int n, double least) {
    for (int k = 0; k < n; k++) {
        const double start = D[k * n + k];
        double d = start;
        for (int p = 0; p < k; p++)
            d -= D[p * n + k] * D[p * n + k];
        if (!(d > least * start))
            return MEFALSE;
        MEASSERT(d > 0);
        const double inverse = 1 / sqrt(d);
        D[k * n + k] = inverse;
        for (int j = k + 1; j < n; j++) {
            double sum = D[k * n + j];
            for (int p = 0; p < k; p++)
                sum -= D[p * n + k] * D[p * n + j];
            D[k * n + j] = sum * inverse;
        }
    }
    return METRUE;
}

/* Scales of the rows of a block before elimination: an entry a_ij is relative to sqrt(size_i size_j), which has its
 * unit, as a block may have rows in kg and in kg m². */
static void measureRows(const double *A, int n, double size[]) {
    for (int i = 0; i < n; i++) {
        size[i] = fabs(A[i * n + i]);
        for (int j = 0; j < n && A[i * n + i] == 0; j++)
            size[i] = fmax(size[i], fabs(A[i * n + j]));
    }
}

static void exchangeRows(double *D, int n, double size[], int i, int k) {
    for (int j = 0; j < n && i != k; j++) {
        const double t = D[k * n + j];
        D[k * n + j] = D[i * n + j];
        D[i * n + j] = t;
    }
    const double t = size[k];
    size[k] = size[i];
    size[i] = t;
}

/* P D = L U in place, L with a unit diagonal; the diagonal of U is kept inverted. */
static MeBool luOf(double *D, const double *given, int n, int exchange[], double least) {
    double size[KEA_FACTOR_MAX_BLOCK], own[KEA_FACTOR_MAX_BLOCK];
    MEASSERT(n <= KEA_FACTOR_MAX_BLOCK);
    measureRows(given, n, size);
    memcpy(own, size, sizeof own);
    for (int k = 0; k < n; k++) {
        int best = k;
        double most = 0; /* of a_ik² / size_i */
        for (int i = k; i < n; i++) {
            const double square = D[i * n + k] * D[i * n + k];
            if (square > most * size[i]) {
                most = square / size[i];
                best = i;
            }
        }
        exchange[k] = best;
        if (!(most > least * least * own[k]))
            return MEFALSE;
        exchangeRows(D, n, size, best, k);
        const double inverse = 1 / D[k * n + k];
        for (int i = k + 1; i < n; i++) {
            const double factor = D[i * n + k] *= inverse;
            for (int j = k + 1; j < n; j++)
                D[i * n + j] -= factor * D[k * n + j];
        }
        D[k * n + k] = inverse;
    }
    return METRUE;
}

static inline void divideUpperOf(double *restrict B, const double *restrict D, int n, int columns) {
    for (int r = 0; r < n; r++) {
        for (int p = 0; p < r; p++) {
            const double u = D[p * n + r];
            for (int j = 0; j < columns; j++)
                B[r * columns + j] -= u * B[p * columns + j];
        }
        for (int j = 0; j < columns; j++)
            B[r * columns + j] *= D[r * n + r];
    }
}

/* B := U⁻ᵀ B, U the upper triangle of D with its diagonal inverted. */
static void divideUpper(double *B, const double *D, int n, int columns) {
    if (n == 6 && columns == 6)
        divideUpperOf(B, D, 6, 6);
    else
        divideUpperOf(B, D, n, columns);
}

/* B := L⁻¹ P B. */
static void divideLower(double *B, const double *D, const int exchange[], int n, int columns) {
    for (int r = 0; r < n; r++) {
        for (int j = 0; j < columns && exchange[r] != r; j++) {
            const double t = B[r * columns + j];
            B[r * columns + j] = B[exchange[r] * columns + j];
            B[exchange[r] * columns + j] = t;
        }
    }
    for (int r = 0; r < n; r++)
        for (int p = 0; p < r; p++)
            for (int j = 0; j < columns; j++)
                B[r * columns + j] -= D[r * n + p] * B[p * columns + j];
}

/* ---- factorization ---- */

static int sizeOfRow(const KeaFactor *f, const KeaFactorEntry *e) {
    return f->size[f->node[e->row]];
}

static void loadColumn(KeaFactor *f, int t) {
    const int j = f->node[t], n = f->size[j];
    memcpy(f->pivot + f->diagonalAt[j], f->diagonal + f->diagonalAt[j], (size_t)(n * n) * sizeof(double));
    for (int k = f->start[t]; k < f->start[t + 1]; k++) {
        const KeaFactorEntry *e = &f->entry[k];
        const int m = sizeOfRow(f, e);
        const size_t bytes = (size_t)(n * m) * sizeof(double);
        f->place[e->row] = k;
        if (e->edge < 0) {
            memset(f->upper + e->at, 0, bytes);
            if (!f->isSymmetric)
                memset(f->lower + e->at, 0, bytes);
            continue;
        }
        const double *upper = f->upperInput + f->edgeAt[e->edge], *lower = f->lowerInput + f->edgeAt[e->edge];
        /* the block of rows j, columns i; of the symmetric matrix it is the transpose of the given one if flipped */
        if (!e->flip)
            memcpy(f->upper + e->at, upper, bytes);
        else if (f->isSymmetric)
            transpose(f->upper + e->at, upper, m, n);
        else
            memcpy(f->upper + e->at, lower, bytes);
        if (!f->isSymmetric)
            transpose(f->lower + e->at, e->flip ? upper : lower, m, n);
    }
}

static void gatherUpdates(KeaFactor *f, int t) {
    const int j = f->node[t], n = f->size[j];
    const double *left = f->isSymmetric ? f->upper : f->lower;
    for (int s = f->sourceStart[t]; s < f->sourceStart[t + 1]; s++) {
        const int k = f->source[s].turn, first = f->source[s].entry, inner = f->size[f->node[k]];
        const KeaFactorEntry *own = &f->entry[first];
        subtractProduct(f->pivot + f->diagonalAt[j], left + own->at, f->upper + own->at, inner, n, n);
        for (int e = first + 1; e < f->start[k + 1]; e++) {
            const KeaFactorEntry *other = &f->entry[e], *target = &f->entry[f->place[other->row]];
            const int m = sizeOfRow(f, other);
            subtractProduct(f->upper + target->at, left + own->at, f->upper + other->at, inner, n, m);
            if (!f->isSymmetric)
                subtractProduct(f->lower + target->at, f->upper + own->at, f->lower + other->at, inner, n, m);
        }
    }
}

static MeBool divideColumn(KeaFactor *f, int t, double least) {
    const int j = f->node[t], n = f->size[j];
    double *D = f->pivot + f->diagonalAt[j];
    int *exchange = f->exchange + f->offset[j];
    if (!(f->isSymmetric ? choleskyOf(D, n, least) : luOf(D, f->diagonal + f->diagonalAt[j], n, exchange, least)))
        return MEFALSE;
    for (int k = f->start[t]; k < f->start[t + 1]; k++) {
        const KeaFactorEntry *e = &f->entry[k];
        const int m = sizeOfRow(f, e);
        if (f->isSymmetric) {
            divideUpper(f->upper + e->at, D, n, m);
        } else {
            divideLower(f->upper + e->at, D, exchange, n, m);
            divideUpper(f->lower + e->at, D, n, m);
        }
    }
    return METRUE;
}

static MeBool factorize(KeaFactor *f, double least) {
    MEASSERT(f->numbers->owner == f);
    for (int t = 0; t < f->numNodes; t++) {
        loadColumn(f, t);
        gatherUpdates(f, t);
        if (!divideColumn(f, t, least))
            return MEFALSE;
    }
    return METRUE;
}

MeBool kea_factorCholesky(KeaFactor *f, double least) {
    f->isSymmetric = METRUE;
    return factorize(f, least);
}

MeBool kea_factorLU(KeaFactor *f, double least) {
    f->isSymmetric = MEFALSE;
    return factorize(f, least);
}

/* ---- solution ---- */

/* x_i -= Xᵀ x_j. */
static inline void subtractTransposedOf(double *restrict xi, const double *restrict X, const double *restrict xj, int n,
                                        int m) {
    for (int p = 0; p < n; p++)
        for (int i = 0; i < m; i++)
            xi[i] -= X[p * m + i] * xj[p];
}

static void subtractTransposed(double *xi, const double *X, const double *xj, int n, int m) {
    if (n == 6 && m == 6)
        subtractTransposedOf(xi, X, xj, 6, 6);
    else
        subtractTransposedOf(xi, X, xj, n, m);
}

/* x_j -= U x_i. */
static inline void subtractAppliedOf(double *restrict xj, const double *restrict U, const double *restrict xi, int n,
                                     int m) {
    for (int p = 0; p < n; p++)
        for (int i = 0; i < m; i++)
            xj[p] -= U[p * m + i] * xi[i];
}

static void subtractApplied(double *xj, const double *U, const double *xi, int n, int m) {
    if (n == 6 && m == 6)
        subtractAppliedOf(xj, U, xi, 6, 6);
    else
        subtractAppliedOf(xj, U, xi, n, m);
}

static inline void solveUpperOf(const double *restrict D, double *restrict x, int n) {
    for (int r = n - 1; r >= 0; r--) {
        for (int p = r + 1; p < n; p++)
            x[r] -= D[r * n + p] * x[p];
        x[r] *= D[r * n + r];
    }
}

static void solveUpper(const double *D, double *x, int n) {
    if (n == 6)
        solveUpperOf(D, x, 6);
    else
        solveUpperOf(D, x, n);
}

/* x := U⁻ᵀ x, of one column. */
static void solveLower(const double *D, double *x, int n) {
    if (n == 6)
        divideUpperOf(x, D, 6, 1);
    else
        divideUpperOf(x, D, n, 1);
}

static void solveForward(const KeaFactor *f, double x[]) {
    const double *left = f->isSymmetric ? f->upper : f->lower;
    for (int t = 0; t < f->numNodes; t++) {
        const int j = f->node[t], n = f->size[j];
        const double *D = f->pivot + f->diagonalAt[j];
        double *xj = x + f->offset[j];
        if (f->isSymmetric)
            solveLower(D, xj, n);
        else
            divideLower(xj, D, f->exchange + f->offset[j], n, 1);
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            const KeaFactorEntry *e = &f->entry[k];
            subtractTransposed(x + f->offset[f->node[e->row]], left + e->at, xj, n, sizeOfRow(f, e));
        }
    }
}

static void solveBackward(const KeaFactor *f, double x[]) {
    for (int t = f->numNodes - 1; t >= 0; t--) {
        const int j = f->node[t], n = f->size[j];
        double *xj = x + f->offset[j];
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            const KeaFactorEntry *e = &f->entry[k];
            const double *U = f->upper + e->at, *xi = x + f->offset[f->node[e->row]];
            subtractApplied(xj, U, xi, n, sizeOfRow(f, e));
        }
        solveUpper(f->pivot + f->diagonalAt[j], xj, n);
    }
}

void kea_factorSolve(const KeaFactor *f, double x[]) {
    MEASSERT(f->numbers->owner == f);
    solveForward(f, x);
    solveBackward(f, x);
}
