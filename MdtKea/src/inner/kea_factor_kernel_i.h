/* The kernel of sparse factors: numeric factorization and solution by dense blocks. It is compiled for each width of
 * registers by a file that defines KEA_FACTOR_KERNEL; operations have the same order in each, and results the same
 * bits.
 *
 * A = L U by blocks, left-looking: when node j is eliminated, it gathers updates from every earlier node k that has j
 * in its structure,
 *
 *     A_jj -= L_jk U_kj,    A_ji -= L_jk U_ki,    A_ij -= L_ik U_kj     for i after j in the structure of k,
 *
 * factors A_jj, and divides by it: U_ji = L_jj⁻¹ A_ji, L_ij = A_ij U_jj⁻¹. Columns of L are stored transposed, so that
 * all products are sums of Xᵀ Y, row by row. For a symmetric matrix L = Uᵀ, and only U is stored.
 *
 * In a solve with U_jj each unknown depends on the previous one. For many solves with a symmetric matrix, blocks are
 * inverted once, E_j = (U_jjᵀ U_jj)⁻¹ and M_ji = U_jj⁻¹ U_ji, and a solve only multiplies:
 *
 *     forward   x_i -= M_jiᵀ x_j,     backward   x_j := E_j x_j - Σ M_ji x_i.
 */
#include "inner/kea_doubles_i.h"
#include "MeAssert.h"
#include "inner/kea_structure_i.h"
#include <math.h>
#include <string.h>

/* ---- blocks ---- */

/* A block of six by six, row-major, is stored in nine vectors of four: three vectors for two rows. */
typedef double KeaFour __attribute__((vector_size(4 * 8)));

KEA_INLINE KeaFour fourAt(const double *p) {
    KeaFour v;
    memcpy(&v, p, sizeof v);
    return v;
}
KEA_INLINE void putFour(double *p, KeaFour v) {
    memcpy(p, &v, sizeof v);
}

/* A row of six. */
typedef struct KeaSix {
    KeaFour four;
    KeaTwo two;
} KeaSix;

KEA_INLINE KeaSix sixAt(const double *p) {
    return (KeaSix){fourAt(p), twoAt(p + 4)};
}
KEA_INLINE void putSix(double *p, KeaSix v) {
    putFour(p, v.four);
    putTwo(p + 4, v.two);
}
/* a - s b */
KEA_INLINE KeaSix lessScaled(KeaSix a, double s, KeaSix b) {
    return (KeaSix){a.four - s * b.four, a.two - s * b.two};
}

/* Two rows of six, one behind the other. */
typedef struct KeaRows {
    KeaFour v[3];
} KeaRows;

KEA_INLINE KeaRows rowsAt(const double *p) {
    return (KeaRows){{fourAt(p), fourAt(p + 4), fourAt(p + 8)}};
}
KEA_INLINE void putRows(double *p, KeaRows r) {
    putFour(p, r.v[0]);
    putFour(p + 4, r.v[1]);
    putFour(p + 8, r.v[2]);
}
/* Two rows that are both y. */
KEA_INLINE KeaRows twice(const double y[6]) {
    return (KeaRows){{fourAt(y), {y[4], y[5], y[0], y[1]}, fourAt(y + 2)}};
}
/* The rows x0 y and x1 y. */
KEA_INLINE KeaRows products(double x0, double x1, KeaRows y) {
    return (KeaRows){
        {(KeaFour){x0, x0, x0, x0} * y.v[0], (KeaFour){x0, x0, x1, x1} * y.v[1], (KeaFour){x1, x1, x1, x1} * y.v[2]}};
}

KEA_INLINE KeaRows plus(KeaRows a, KeaRows b) {
    return (KeaRows){{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2]}};
}
KEA_INLINE KeaRows minus(KeaRows a, KeaRows b) {
    return (KeaRows){{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2]}};
}

/* block += Σ w aᵀ b */
static void addOuters(double *block, int count, const double w[], const double *const a[], const double *const b[]) {
    KeaRows top = rowsAt(block), middle = rowsAt(block + 12), bottom = rowsAt(block + 2 * 12);
    for (int r = 0; r < count; r++) {
        const KeaRows y = twice(b[r]);
        top = plus(top, products(w[r] * a[r][0], w[r] * a[r][1], y));
        middle = plus(middle, products(w[r] * a[r][2], w[r] * a[r][3], y));
        bottom = plus(bottom, products(w[r] * a[r][4], w[r] * a[r][5], y));
    }
    putRows(block, top);
    putRows(block + 12, middle);
    putRows(block + 2 * 12, bottom);
}

static void addRows(KeaFactor *f, const KeaFactorRows *rows, MeBool isSymmetric) {
    const int low = rows->node[0] < rows->node[1] ? 0 : 1, high = !low, n = rows->count;
    for (int k = 0; k < 2; k++)
        if (rows->node[k] >= 0 && !rows->isCross)
            addOuters(f->diagonal + f->diagonalAt[rows->node[k]], n, rows->weight, rows->a[k], rows->b[k]);
    if (rows->edge < 0)
        return;
    addOuters(f->upperInput + f->edgeAt[rows->edge], n, rows->weight, rows->a[low], rows->b[high]);
    if (!isSymmetric)
        addOuters(f->lowerInput + f->edgeAt[rows->edge], n, rows->weight, rows->a[high], rows->b[low]);
}

/* C -= Xᵀ Y, all of size six. */
KEA_INLINE void subtractProduct6(double *C, const double *X, const double *Y) {
    KeaRows top = rowsAt(C), middle = rowsAt(C + 12), bottom = rowsAt(C + 2 * 12);
    for (int p = 0; p < 6; p++) {
        const KeaRows y = twice(Y + 6 * p);
        top = minus(top, products(X[6 * p], X[6 * p + 1], y));
        middle = minus(middle, products(X[6 * p + 2], X[6 * p + 3], y));
        bottom = minus(bottom, products(X[6 * p + 4], X[6 * p + 5], y));
    }
    putRows(C, top);
    putRows(C + 12, middle);
    putRows(C + 2 * 12, bottom);
}

/* C -= Xᵀ Y, one number at a time. */
KEA_INLINE void subtractProductOf(double *restrict C, const double *restrict X, const double *restrict Y, int inner,
                                  int rows, int columns) {
    for (int p = 0; p < inner; p++) {
        for (int i = 0; i < rows; i++) {
            const double x = X[p * rows + i];
            for (int j = 0; j < columns; j++)
                C[i * columns + j] -= x * Y[p * columns + j];
        }
    }
}

/* C -= Xᵀ Y; C has rows x columns entries, X and Y have `inner` rows. */
static void subtractProduct(double *C, const double *X, const double *Y, int inner, int rows, int columns) {
    if (inner == 6 && rows == 6 && columns == 6)
        subtractProduct6(C, X, Y);
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

/* Factors D = Uᵀ U in place, in the upper triangle; the diagonal of U is stored inverted. */
KEA_INLINE MeBool choleskyOf(double *D, int n, double min) {
    for (int k = 0; k < n; k++) {
        const double start = D[k * n + k];
        double d = start;
        for (int p = 0; p < k; p++)
            d -= D[p * n + k] * D[p * n + k];
        if (!(d > min * start))
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

static MeBool cholesky(double *D, int n, double min) {
    return n == 6 ? choleskyOf(D, 6, min) : n == 3 ? choleskyOf(D, 3, min) : choleskyOf(D, n, min);
}

/* Sets the scales of the rows of a given block: an entry a_ij is compared with sqrt(size_i size_j), which has the same
 * unit, since a block may have rows of kg and of kg m². */
static void setRowScales(const double *A, int n, double size[]) {
    for (int i = 0; i < n; i++) {
        size[i] = fabs(A[i * n + i]);
        for (int j = 0; j < n && A[i * n + i] == 0; j++)
            size[i] = fmax(size[i], fabs(A[i * n + j]));
    }
}

static void swapNumbers(double *a, double *b) {
    const double t = *a;
    *a = *b;
    *b = t;
}

static void swapRows(double *B, int columns, int i, int k) {
    for (int j = 0; j < columns && i != k; j++)
        swapNumbers(&B[i * columns + j], &B[k * columns + j]);
}

/* The pivot row of column k: the row with the largest a_ik² / size_i, which is written to `max`. */
KEA_INLINE int pivotOf(const double *D, int n, const double size[], int k, double *max) {
    int best = k;
    *max = 0;
    for (int i = k; i < n; i++) {
        const double square = D[i * n + k] * D[i * n + k];
        if (square > *max * size[i]) {
            *max = square / size[i];
            best = i;
        }
    }
    return best;
}

/* Factors P D = L U in place, L with unit diagonal; the diagonal of U is stored inverted. given: the block before
 * updates by earlier nodes, for scaling. */
KEA_INLINE MeBool luOf(double *D, const double *given, int n, int exchange[], double min) {
    double size[KEA_FACTOR_MAX_BLOCK], own[KEA_FACTOR_MAX_BLOCK], max;
    MEASSERT(n <= KEA_FACTOR_MAX_BLOCK);
    setRowScales(given, n, size);
    memcpy(own, size, sizeof own);
    for (int k = 0; k < n; k++) {
        exchange[k] = pivotOf(D, n, size, k, &max);
        if (!(max > min * min * own[k]))
            return MEFALSE;
        swapRows(D, n, exchange[k], k);
        swapNumbers(&size[exchange[k]], &size[k]);
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

/* Row k is 1 from column k on: a mask that extracts a row of U from one that begins with entries of L. */
static const double fromColumn[6][6] = {{1, 1, 1, 1, 1, 1}, {0, 1, 1, 1, 1, 1}, {0, 0, 1, 1, 1, 1},
                                        {0, 0, 0, 1, 1, 1}, {0, 0, 0, 0, 1, 1}, {0, 0, 0, 0, 0, 1}};

/* luOf for n = 6, by whole rows: the same operations in the same order. */
static MeBool lu6(double *D, const double *given, int exchange[], double min) {
    double size[6], own[6], max;
    setRowScales(given, 6, size);
    memcpy(own, size, sizeof own);
    for (int k = 0; k < 6; k++) {
        exchange[k] = pivotOf(D, 6, size, k, &max);
        if (!(max > min * min * own[k]))
            return MEFALSE;
        swapRows(D, 6, exchange[k], k);
        swapNumbers(&size[exchange[k]], &size[k]);
        const KeaSix whole = sixAt(D + 6 * k), from = sixAt(fromColumn[k]);
        const KeaSix row = {whole.four * from.four, whole.two * from.two};
        const double inverse = 1 / D[7 * k];
        for (int i = k + 1; i < 6; i++) {
            const double factor = D[6 * i + k] * inverse;
            putSix(D + 6 * i, lessScaled(sixAt(D + 6 * i), factor, row));
            D[6 * i + k] = factor;
        }
        D[7 * k] = inverse;
    }
    return METRUE;
}

static MeBool lu(double *D, const double *given, int n, int exchange[], double min) {
    return n == 6 ? lu6(D, given, exchange, min) : luOf(D, given, n, exchange, min);
}

/* Forward substitution: B := T⁻¹ B, T being the lower triangle of D with unit diagonal or, if byUpper, the transposed
 * upper triangle, whose diagonal is stored inverted. */
KEA_INLINE void substituteOf(double *restrict B, const double *restrict D, int n, int columns, MeBool byUpper) {
    for (int r = 0; r < n; r++) {
        for (int p = 0; p < r; p++) {
            const double t = D[byUpper ? p * n + r : r * n + p];
            for (int j = 0; j < columns; j++)
                B[r * columns + j] -= t * B[p * columns + j];
        }
        for (int j = 0; j < columns && byUpper; j++)
            B[r * columns + j] *= D[r * n + r];
    }
}

/* substituteOf for blocks of six, by whole rows. */
KEA_INLINE void substitute6(double *B, const double *D, MeBool byUpper) {
    KeaSix row[6];
    for (int r = 0; r < 6; r++) {
        row[r] = sixAt(B + 6 * r);
        for (int p = 0; p < r; p++)
            row[r] = lessScaled(row[r], D[byUpper ? 6 * p + r : 6 * r + p], row[p]);
        if (byUpper) {
            row[r].four *= D[7 * r];
            row[r].two *= D[7 * r];
        }
        putSix(B + 6 * r, row[r]);
    }
}

/* B := U⁻ᵀ B, with U the upper triangle of D, whose diagonal is stored inverted. */
static void divideUpper(double *B, const double *D, int n, int columns) {
    if (n == 6 && columns == 6)
        substitute6(B, D, METRUE);
    else if (n == 3 && columns == 3)
        substituteOf(B, D, 3, 3, METRUE);
    else
        substituteOf(B, D, n, columns, METRUE);
}

/* B := L⁻¹ P B. */
static void divideLower(double *B, const double *D, const int exchange[], int n, int columns) {
    for (int r = 0; r < n; r++)
        swapRows(B, columns, exchange[r], r);
    if (n == 6 && columns == 6)
        substitute6(B, D, MEFALSE);
    else if (n == 6 && columns == 1)
        substituteOf(B, D, 6, 1, MEFALSE);
    else
        substituteOf(B, D, n, columns, MEFALSE);
}

/* ---- factorization ---- */

/* The number of unknowns of an entry's row. */
static int sizeOfRow(const KeaFactor *f, const KeaFactorEntry *e) {
    return f->size[f->node[e->row]];
}

/* Copies the given blocks of column t to the factor; fill-in is set to 0. */
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
        /* the block with rows j and columns i: if flipped, the transpose of the given block of a symmetric matrix */
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

/* Subtracts the updates of all earlier columns from column t. */
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

/* Factors the diagonal block of column t, and divides its other blocks by it. False: a pivot is too small. */
static MeBool divideColumn(KeaFactor *f, int t, double min) {
    const int j = f->node[t], n = f->size[j];
    double *D = f->pivot + f->diagonalAt[j];
    int *exchange = f->exchange + f->offset[j];
    if (!(f->isSymmetric ? cholesky(D, n, min) : lu(D, f->diagonal + f->diagonalAt[j], n, exchange, min)))
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

static MeBool factorize(KeaFactor *f, double min) {
    MEASSERT(f->numbers->owner == f);
    for (int t = 0; t < f->numNodes; t++) {
        loadColumn(f, t);
        gatherUpdates(f, t);
        if (!divideColumn(f, t, min))
            return MEFALSE;
    }
    return METRUE;
}

/* ---- solution ---- */

/* x_i -= Xᵀ x_j. */
KEA_INLINE void subtractTransposedOf(double *restrict xi, const double *restrict X, const double *restrict xj, int n,
                                     int m) {
    for (int p = 0; p < n; p++)
        for (int i = 0; i < m; i++)
            xi[i] -= X[p * m + i] * xj[p];
}

KEA_INLINE void subtractTransposed6(double *xi, const double *X, const double *xj) {
    KeaSix x = sixAt(xi);
    for (int p = 0; p < 6; p++)
        x = lessScaled(x, xj[p], sixAt(X + 6 * p));
    putSix(xi, x);
}

KEA_INLINE void subtractTransposed(double *xi, const double *X, const double *xj, int n, int m) {
    if (n == 6 && m == 6)
        subtractTransposed6(xi, X, xj);
    else if (n == 3 && m == 3)
        subtractTransposedOf(xi, X, xj, 3, 3);
    else
        subtractTransposedOf(xi, X, xj, n, m);
}

/* x_j -= U x_i. */
KEA_INLINE void subtractAppliedOf(double *restrict xj, const double *restrict U, const double *restrict xi, int n,
                                  int m) {
    for (int p = 0; p < n; p++)
        for (int i = 0; i < m; i++)
            xj[p] -= U[p * m + i] * xi[i];
}

static void subtractApplied(double *xj, const double *U, const double *xi, int n, int m) {
    if (n == 6 && m == 6)
        subtractAppliedOf(xj, U, xi, 6, 6);
    else if (n == 3 && m == 3)
        subtractAppliedOf(xj, U, xi, 3, 3);
    else
        subtractAppliedOf(xj, U, xi, n, m);
}

KEA_INLINE void solveUpperOf(const double *restrict D, double *restrict x, int n) {
    for (int r = n - 1; r >= 0; r--) {
        for (int p = r + 1; p < n; p++)
            x[r] -= D[r * n + p] * x[p];
        x[r] *= D[r * n + r];
    }
}

static void solveUpper(const double *D, double *x, int n) {
    if (n == 6)
        solveUpperOf(D, x, 6);
    else if (n == 3)
        solveUpperOf(D, x, 3);
    else
        solveUpperOf(D, x, n);
}

/* x := U⁻ᵀ x. */
static void solveLower(const double *D, double *x, int n) {
    if (n == 6)
        substituteOf(x, D, 6, 1, METRUE);
    else if (n == 3)
        substituteOf(x, D, 3, 1, METRUE);
    else
        substituteOf(x, D, n, 1, METRUE);
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

static void solve(const KeaFactor *f, double x[]) {
    solveForward(f, x);
    solveBackward(f, x);
}

/* ---- solution by inverted blocks ---- */

/* Replaces the pivot by -E_j and each entry U_ji by M_ji, with its transpose in `lower`. */
KEA_INLINE void invertColumnOf(KeaFactor *f, int t, int n) {
    enum { MAX = KEA_FACTOR_MAX_BLOCK * KEA_FACTOR_MAX_BLOCK };
    double inverse[MAX], minus[MAX];
    double *D = f->pivot + f->diagonalAt[f->node[t]];
    for (int i = 0; i < n * n; i++)
        inverse[i] = i % (n + 1) == 0;
    divideUpper(inverse, D, n, n); /* U_jj⁻ᵀ */
    for (int i = 0; i < n * n; i++) {
        minus[i] = -inverse[i];
        D[i] = 0;
    }
    subtractProduct(D, inverse, inverse, n, n, n);
    for (int k = f->start[t]; k < f->start[t + 1]; k++) {
        const KeaFactorEntry *e = &f->entry[k];
        const int m = sizeOfRow(f, e);
        double *M = f->upper + e->at, *turned = f->lower + e->at;
        for (int i = 0; i < n * m; i++) {
            turned[i] = M[i];
            M[i] = 0;
        }
        subtractProduct(M, minus, turned, n, n, m);
        transpose(turned, M, n, m);
    }
}

static void invert(KeaFactor *f) {
    for (int t = 0; t < f->numNodes; t++)
        if (f->size[f->node[t]] == 6)
            invertColumnOf(f, t, 6);
        else
            invertColumnOf(f, t, f->size[f->node[t]]);
}

static void solveInverted(const KeaFactor *f, double x[]) {
    for (int t = 0; t < f->numNodes; t++) {
        const int j = f->node[t];
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            const KeaFactorEntry *e = &f->entry[k];
            subtractTransposed(x + f->offset[f->node[e->row]], f->upper + e->at, x + f->offset[j], f->size[j],
                               sizeOfRow(f, e));
        }
    }
    for (int t = f->numNodes - 1; t >= 0; t--) {
        const int j = f->node[t], n = f->size[j];
        double sum[KEA_FACTOR_MAX_BLOCK] = {0}, *xj = x + f->offset[j];
        subtractTransposed(sum, f->pivot + f->diagonalAt[j], xj, n, n);
        for (int k = f->start[t]; k < f->start[t + 1]; k++) {
            const KeaFactorEntry *e = &f->entry[k];
            subtractTransposed(sum, f->lower + e->at, x + f->offset[f->node[e->row]], sizeOfRow(f, e), n);
        }
        memcpy(xj, sum, (size_t)n * sizeof *xj);
    }
}

const KeaFactorKernel KEA_FACTOR_KERNEL = {factorize, solve, invert, solveInverted, addRows};
