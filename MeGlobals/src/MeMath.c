/* Numbers, vectors, matrices of any size, packed triangles. */
#include "MeMath_i.h"

#include "MeAssert.h"
#include <stdint.h>
#include <string.h>

/* ---- numbers ---- */

void MEAPI MeRealSwap(MeReal *const a, MeReal *const b) {
    const MeReal t = *a;
    *a = *b;
    *b = t;
}

MeReal MEAPI MeSafeRecip(MeReal x) {
    const MeReal r = 1 / x;
    if (!isinf(r))
        return r;
    return x < 0 ? -MEINFINITY : MEINFINITY;
}

/* The next number of a sequence with the period 2^64 - 1 (xorshift64*: Vigna, An experimental exploration of
 * Marsaglia's xorshift generators, 2016). */
static uint64_t nextRandom(void) {
    static uint64_t state = 0x9E3779B97F4A7C15u;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * 0x2545F4914F6CDD1Du;
}

MeReal MEAPI MeRealRandomInRange(MeReal start, MeReal end) {
    const double u = (double)(nextRandom() >> 11) * 0x1p-53;
    const MeReal x = (MeReal)((1 - u) * (double)start + u * (double)end);
    MEASSERT(u >= 0 && u < 1);
    return MeCLAMP(x, MeMIN(start, end), MeMAX(start, end));
}

MeBool MEAPI MeRealArrayIsZero(const MeReal *v, int elements) {
    for (int i = 0; i < elements; i++) {
        if (!(v[i] == 0))
            return MEFALSE;
    }
    return METRUE;
}

void MEAPI MeVectorSetZero(MeReal *const A, const int n) {
    for (int i = 0; i < n; i++)
        A[i] = 0;
}

/* ---- lengths ---- */

static MeReal sumOfSquares(const MeReal *v, int n) {
    MeReal sum = 0;
    for (int i = 0; i < n; i++)
        sum += v[i] * v[i];
    return sum;
}

/* Whether a sum of squares is accurate: neither overflow nor underflow of squares. */
static MeBool isSafeSum(MeReal sum) {
    return sum > (MeReal)1e-30 && sum <= MEINFINITY;
}

static MeReal largestComponent(const MeReal *v, int n) {
    MeReal largest = 0;
    for (int i = 0; i < n; i++)
        largest = MeMAX(largest, MeFabs(v[i]));
    return largest;
}

MeReal me_length(const MeReal *v, int n) {
    const MeReal sum = sumOfSquares(v, n);
    if (isSafeSum(sum))
        return MeSqrt(sum);
    const MeReal scale = largestComponent(v, n);
    if (scale == 0 || isnan(sum) || isinf(scale))
        return sum;
    MeReal scaled = 0;
    for (int i = 0; i < n; i++)
        scaled += MeSqr(v[i] / scale);
    return scale * MeSqrt(scaled);
}

/* me_normalize for vectors whose squares overflow or underflow. */
static MeReal normalizeExtreme(MeReal *v, int n) {
    const MeReal scale = largestComponent(v, n);
    MeReal unit[4];
    for (int i = 0; i < n; i++)
        unit[i] = v[i] / scale;
    const MeReal length = MeSqrt(sumOfSquares(unit, n));
    if (!(length >= 1)) /* v is zero, or has a component that is not a finite number */
        return 0;
    for (int i = 0; i < n; i++)
        v[i] = unit[i] / length;
    return MeMIN(scale * length, MEINFINITY);
}

MeReal me_normalize(MeReal *v, int n) {
    const MeReal sum = sumOfSquares(v, n);
    if (!isSafeSum(sum))
        return normalizeExtreme(v, n);
    const MeReal length = MeSqrt(sum);
    for (int i = 0; i < n; i++)
        v[i] /= length;
    MEVALIDATE(MeFabs(sumOfSquares(v, n) - 1) < 16 * ME_EPSILON);
    return length;
}

MeReal MEAPI MeVector3Magnitude(const MeVector3 v) {
    return me_length(v, 3);
}

MeReal MEAPI MeVector3MagnitudeSqr(const MeVector3 v) {
    return MeVector3Dot(v, v);
}

MeReal MEAPI MeVector3Distance(const MeVector3 a, const MeVector3 b) {
    MeVector3 d;
    MeVector3Subtract(d, a, b);
    return me_length(d, 3);
}

MeReal MEAPI MeVector3DistanceSqr(const MeVector3 a, const MeVector3 b) {
    MeVector3 d;
    MeVector3Subtract(d, a, b);
    return MeVector3Dot(d, d);
}

MeReal MEAPI MeVector3Normalize(MeVector3 v) {
    return me_normalize(v, 3);
}

MeReal MEAPI MeVector4MagnitudeSqr(const MeVector4 v) {
    return MeVector4Dot(v, v);
}

/* ---- MeVector3 ---- */

void MEAPI MeVector3Set(MeVector3 c, const MeReal x, const MeReal y, const MeReal z) {
    c[0] = x;
    c[1] = y;
    c[2] = z;
}

void MEAPI MeVector3Copy(MeVector3 c, const MeVector3 b) {
    MeVector3Set(c, b[0], b[1], b[2]);
}

void MEAPI MeVector3Swap(MeVector3 a, MeVector3 b) {
    for (int i = 0; i < 3; i++)
        MeRealSwap(&a[i], &b[i]);
}

void MEAPI MeVector3Add(MeVector3 a, const MeVector3 b, const MeVector3 c) {
    MeVector3Set(a, b[0] + c[0], b[1] + c[1], b[2] + c[2]);
}

void MEAPI MeVector3Subtract(MeVector3 a, const MeVector3 b, const MeVector3 c) {
    MeVector3Set(a, b[0] - c[0], b[1] - c[1], b[2] - c[2]);
}

void MEAPI MeVector3Scale(MeVector3 v, const MeReal a) {
    MeVector3Set(v, v[0] * a, v[1] * a, v[2] * a);
}

void MEAPI MeVector3MultiplyScalar(MeVector3 a, const MeVector3 b, const MeReal c) {
    MeVector3Set(a, b[0] * c, b[1] * c, b[2] * c);
}

void MEAPI MeVector3MultiplyElements(MeVector3 a, const MeVector3 b, const MeVector3 c) {
    MeVector3Set(a, b[0] * c[0], b[1] * c[1], b[2] * c[2]);
}

void MEAPI MeVector3MultiplyAdd(MeVector3 v, const MeReal a, const MeVector3 v1) {
    MeVector3Set(v, v[0] + a * v1[0], v[1] + a * v1[1], v[2] + a * v1[2]);
}

void MEAPI MeVector3MultiplySubtract(MeVector3 v, const MeReal a, const MeVector3 v1) {
    MeVector3MultiplyAdd(v, -a, v1);
}

void MEAPI MeVector3ScaleAndAdd(MeVector3 a, const MeVector3 b, const MeReal c, const MeVector3 d) {
    MeVector3Set(a, c * b[0] + d[0], c * b[1] + d[1], c * b[2] + d[2]);
}

void MEAPI MeVector3Min(MeVector3 out, const MeVector3 in1, const MeVector3 in2) {
    MeVector3Set(out, MeMIN(in1[0], in2[0]), MeMIN(in1[1], in2[1]), MeMIN(in1[2], in2[2]));
}

void MEAPI MeVector3Max(MeVector3 out, const MeVector3 in1, const MeVector3 in2) {
    MeVector3Set(out, MeMAX(in1[0], in2[0]), MeMAX(in1[1], in2[1]), MeMAX(in1[2], in2[2]));
}

void MEAPI MeVector3Clamp(MeVector3 a, const MeReal min, const MeReal max) {
    for (int i = 0; i < 3; i++)
        a[i] = MeCLAMP(a[i], min, max);
}

void MEAPI MeVector3Lerp(MeVector3 out, const MeVector3 from, const MeVector3 to, const MeReal howFar) {
    for (int i = 0; i < 3; i++)
        out[i] = (1 - howFar) * from[i] + howFar * to[i];
}

MeReal MEAPI MeVector3Dot(const MeVector3 b, const MeVector3 c) {
    return b[0] * c[0] + b[1] * c[1] + b[2] * c[2];
}

void MEAPI MeVector3Cross(MeVector3 a, const MeVector3 b, const MeVector3 c) {
    MeVector3Set(a, b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]);
}

MeReal MEAPI MeVector3ScalarTripleProduct(const MeVector3 a, const MeVector3 b, const MeVector3 c) {
    MeVector3 n;
    MeVector3Cross(n, b, c);
    return MeVector3Dot(a, n);
}

void MEAPI MeVector3OuterProduct(MeMatrix3 a, const MeVector3 b, const MeVector3 c) {
    MeMatrix3 t;
    for (int i = 0; i < 3; i++)
        MeVector3MultiplyScalar(t[i], c, b[i]);
    memcpy(a, t, sizeof t);
}

MeReal MEAPI MeVector3AreaOfTriangle(const MeVector3 v1, const MeVector3 v2) {
    MeVector3 n;
    MeVector3Cross(n, v1, v2);
    return MeVector3Magnitude(n) / 2;
}

void MEAPI MeVector3MakeOrthogonal(MeVector3 v, const MeVector3 v1) {
    MeVector3 n;
    MeVector3Copy(n, v1);
    if (MeVector3Normalize(n) == 0)
        return;
    /* The second pass removes the rounding error of the first, which matters if v is nearly parallel to v1. */
    for (int i = 0; i < 2; i++)
        MeVector3MultiplySubtract(v, MeVector3Dot(v, n), n);
}

void MEAPI MeVector3PlaneSpace(const MeVector3 n, MeVector3 a, MeVector3 b) {
    const MeReal x = n[0], y = n[1], z = n[2];
    const MeReal sign = z < 0 ? (MeReal)-1 : (MeReal)1;
    const MeReal c = -1 / (sign + z), xy = x * y * c;
    MeVector3Set(a, 1 + sign * x * x * c, sign * xy, -sign * x);
    MeVector3Set(b, xy, sign + y * y * c, -y);
}

/* ---- MeVector4 ---- */

void MEAPI MeVector4Copy(MeVector4 c, const MeVector4 b) {
    for (int i = 0; i < 4; i++)
        c[i] = b[i];
}

void MEAPI MeVector4Add(MeVector4 a, const MeVector4 b, const MeVector4 c) {
    for (int i = 0; i < 4; i++)
        a[i] = b[i] + c[i];
}

void MEAPI MeVector4Subtract(MeVector4 a, const MeVector4 b, const MeVector4 c) {
    for (int i = 0; i < 4; i++)
        a[i] = b[i] - c[i];
}

void MEAPI MeVector4Scale(MeVector4 v, const MeReal a) {
    for (int i = 0; i < 4; i++)
        v[i] *= a;
}

void MEAPI MeVector4MultiplyElements(MeVector4 a, const MeVector4 b, const MeVector4 c) {
    for (int i = 0; i < 4; i++)
        a[i] = b[i] * c[i];
}

MeReal MEAPI MeVector4Dot(const MeVector4 b, const MeVector4 c) {
    return b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
}

void MEAPI MeVector4Clamp(MeVector4 a, const MeReal min, const MeReal max) {
    for (int i = 0; i < 4; i++)
        a[i] = MeCLAMP(a[i], min, max);
}

/* ---- matrices of any size ---- */

/* A = B C, p by q times q by r; the entry (i, k) of B is at i rowStep + k columnStep. */
static void multiply(MeReal *A, int p, int q, int r, const MeReal *B, int rowStep, int columnStep, const MeReal *C) {
    for (int i = 0; i < p; i++) {
        for (int j = 0; j < r; j++) {
            MeReal sum = 0;
            for (int k = 0; k < q; k++)
                sum += B[i * rowStep + k * columnStep] * C[k * r + j];
            A[i * r + j] = sum;
        }
    }
}

void MEAPI MeMatrixMultiply(MeReal *A, const int p, const int q, const int r, const MeReal *const B,
                            const MeReal *const C) {
    multiply(A, p, q, r, B, q, 1, C);
}

void MEAPI MeMatrixMultiplyT1(MeReal *A, const int p, const int q, const int r, const MeReal *const B,
                              const MeReal *const C) {
    multiply(A, p, q, r, B, 1, p, C);
}

void MEAPI MeMatrixTranspose(MeReal *A, const int n, const int m, const MeReal *const B) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < m; j++)
            A[j * n + i] = B[i * m + j];
    }
}

void MEAPI MeMatrixFPrint(FILE *const file, const MeReal *const A, const int n, const int m, const char *const format) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < m; j++)
            fprintf(file, format ? format : "%g ", (double)A[i * m + j]);
        fputc('\n', file);
    }
}

void MEAPI MeMatrixPrint(const MeReal *const A, const int n, const int m, const char *const format) {
    MeMatrixFPrint(stdout, A, n, m, format);
}

/* ---- packed triangles ---- */

/* Maximum number of columns for which indices fit into an int. */
enum { MAX_COLUMNS = 46340 };

/* The index in a triangle whose row i starts at column i + gap, or -1 with a warning. */
static int triangleIndex(const char *function, int row, int col, int n, int gap) {
    if (n > MAX_COLUMNS || row < 0 || col < 0 || col >= n || col - gap < row) {
        MeWarning(1, "%s: row %d, column %d of %d is not stored", function, row, col, n);
        return -1;
    }
    const int earlierRows = row * (n - gap) - row * (row - 1) / 2;
    return earlierRows + col - row - gap;
}

int MEAPI MeUpperDiagonalIndex(const int inRow, const int inCol, const int inNCols) {
    return triangleIndex("MeUpperDiagonalIndex", inRow, inCol, inNCols, 0);
}

int MEAPI MeSymUpperDiagonalIndex(const int inRow, const int inCol, const int inNCols) {
    return triangleIndex("MeSymUpperDiagonalIndex", MeMIN(inRow, inCol), MeMAX(inRow, inCol), inNCols, 0);
}

/* The number of entries of that triangle, or 0 with a warning. */
static int triangleSize(const char *function, int n, int gap) {
    if (n >= 0 && n <= MAX_COLUMNS)
        return n * (n + 1 - 2 * gap) / 2;
    MeWarning(1, "%s: %d columns: there may be 0 to %d", function, n, MAX_COLUMNS);
    return 0;
}

int MEAPI MeUpperDiagonalSize(const int inNCols) {
    return triangleSize("MeUpperDiagonalSize", inNCols, 0);
}

int MEAPI MeSuperDiagonalIndex(const int inRow, const int inCol, const int inNCols) {
    return triangleIndex("MeSuperDiagonalIndex", inRow, inCol, inNCols, 1);
}

int MEAPI MeSymSuperDiagonalIndex(const int inRow, const int inCol, const int inNCols) {
    return triangleIndex("MeSymSuperDiagonalIndex", MeMIN(inRow, inCol), MeMAX(inRow, inCol), inNCols, 1);
}

int MEAPI MeSuperDiagonalSize(const int inNCols) {
    return triangleSize("MeSuperDiagonalSize", inNCols, 1);
}
