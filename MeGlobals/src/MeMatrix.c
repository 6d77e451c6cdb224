/* Matrices of 3 x 3 and 4 x 4 numbers, and rotations as 3 x 3 matrices. */
#include "MeMath_i.h"

#include "MeMessage.h"
#include <string.h>

static void setIdentity(MeReal *m, int n) {
    for (int i = 0; i < n * n; i++)
        m[i] = i % (n + 1) == 0 ? (MeReal)1 : (MeReal)0;
}

static MeBool isIdentity(const MeReal *m, int n, MeReal tolerance) {
    for (int i = 0; i < n * n; i++) {
        const MeReal one = i % (n + 1) == 0 ? (MeReal)1 : (MeReal)0;
        if (!(MeFabs(m[i] - one) <= tolerance))
            return MEFALSE;
    }
    return METRUE;
}

static void transpose(MeReal *m, int n) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++)
            MeRealSwap(&m[i * n + j], &m[j * n + i]);
    }
}

/* Whether x, y, z are orthonormal and right-handed, each dot product within the tolerance. */
static MeBool areAxes(const MeReal *x, const MeReal *y, const MeReal *z, MeReal tolerance) {
    const MeReal *const axes[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            const MeReal expected = i == j ? (MeReal)1 : (MeReal)0;
            if (!(MeFabs(MeVector3Dot(axes[i], axes[j]) - expected) <= tolerance))
                return MEFALSE;
        }
    }
    return MeVector3ScalarTripleProduct(x, y, z) > 0;
}

/* ---- MeMatrix3 ---- */

void MEAPI MeMatrix3MakeIdentity(MeMatrix3 tm) {
    setIdentity((MeReal *)tm, 3);
}

void MEAPI MeMatrix3Copy(MeMatrix3 A, const MeMatrix3 B) {
    memmove(A, B, sizeof(MeMatrix3));
}

void MEAPI MeMatrix3CopyVec(MeMatrix3 A, const MeVector3 B1, const MeVector3 B2, const MeVector3 B3) {
    MeMatrix3 t;
    MeVector3Copy(t[0], B1);
    MeVector3Copy(t[1], B2);
    MeVector3Copy(t[2], B3);
    memcpy(A, t, sizeof t);
}

void MEAPI MeMatrix3Add(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C) {
    for (int i = 0; i < 3; i++)
        MeVector3Add(A[i], B[i], C[i]);
}

void MEAPI MeMatrix3Subtract(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C) {
    for (int i = 0; i < 3; i++)
        MeVector3Subtract(A[i], B[i], C[i]);
}

void MEAPI MeMatrix3Scale(MeMatrix3 A, const MeReal a) {
    for (int i = 0; i < 3; i++)
        MeVector3Scale(A[i], a);
}

void MEAPI MeMatrix3MultiplyMatrix(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C) {
    MeMatrix3 t;
    MeMatrixMultiply((MeReal *)t, 3, 3, 3, (const MeReal *)B, (const MeReal *)C);
    memcpy(A, t, sizeof t);
}

void MEAPI MeMatrix3MultiplyVector(MeVector3 A, const MeMatrix3 B, const MeVector3 C) {
    const MeVector3 t = {MeVector3Dot(B[0], C), MeVector3Dot(B[1], C), MeVector3Dot(B[2], C)};
    MeVector3Copy(A, t);
}

void MEAPI MeMatrix3Transpose(MeMatrix3 A) {
    transpose((MeReal *)A, 3);
}

MeReal MEAPI MeMatrix3Trace(const MeMatrix3 m) {
    return m[0][0] + m[1][1] + m[2][2];
}

void MEAPI MeMatrix3SwapColumns(MeMatrix3 a, const unsigned int col1, const unsigned int col2) {
    if (col1 > 2 || col2 > 2) {
        MeWarning(1, "MeMatrix3SwapColumns: columns %u and %u, expected 0 to 2", col1, col2);
        return;
    }
    for (int i = 0; i < 3; i++)
        MeRealSwap(&a[i][col1], &a[i][col2]);
}

void MEAPI MeMatrix3CrossFromVector(const MeVector3 a, const MeReal factor, MeVector3 A0, MeVector3 A1, MeVector3 A2) {
    const MeReal x = factor * a[0], y = factor * a[1], z = factor * a[2];
    MeVector3Set(A0, 0, -z, y);
    MeVector3Set(A1, z, 0, -x);
    MeVector3Set(A2, -y, x, 0);
}

static MeReal largestOf(const MeVector3 v) {
    return MeMAX3(MeFabs(v[0]), MeFabs(v[1]), MeFabs(v[2]));
}

/* Cramer's rule, with the rows scaled by their largest elements. */
MeBool MEAPI MeMatrix3Invert(MeMatrix3 a) {
    MeVector3 scale;
    MeMatrix3 b, cofactors, inverse;
    for (int i = 0; i < 3; i++) {
        scale[i] = largestOf(a[i]);
        for (int j = 0; j < 3; j++)
            b[i][j] = a[i][j] / scale[i];
    }
    for (int i = 0; i < 3; i++)
        MeVector3Cross(cofactors[i], b[NextMod3(i)], b[PrevMod3(i)]);
    const MeReal det = MeVector3Dot(b[0], cofactors[0]);
    if (!(MeFabs(det) > 8 * ME_EPSILON)) /* false for NaN, which a zero row gives */
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            inverse[j][i] = cofactors[i][j] / det / scale[i];
            if (!isfinite(inverse[j][i]))
                return MEFALSE;
        }
    }
    memcpy(a, inverse, sizeof inverse);
    return METRUE;
}

MeBool MEAPI MeMatrix3SymmetricInvert(MeMatrix3 a) {
    MeMatrix3 b = {{a[0][0], a[0][1], a[0][2]}, {a[0][1], a[1][1], a[1][2]}, {a[0][2], a[1][2], a[2][2]}};
    if (!MeMatrix3Invert(b))
        return MEFALSE;
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++)
            a[i][j] = a[j][i] = b[i][j];
    }
    return METRUE;
}

/* The pivot of column k: the row from k on with the largest weighted element. */
static unsigned int pivotRow(MeMatrix3 u, const MeVector3 weight, unsigned int k) {
    unsigned int pivot = k;
    for (unsigned int i = k + 1; i < 3; i++) {
        if (MeFabs(u[i][k]) * weight[i] > MeFabs(u[pivot][k]) * weight[pivot])
            pivot = i;
    }
    return pivot;
}

/* Gaussian elimination below row k of u; stores the multipliers in l. */
static void eliminate(MeMatrix3 l, MeMatrix3 u, unsigned int k) {
    for (unsigned int i = k + 1; i < 3; i++) {
        l[i][k] = u[k][k] == 0 ? 0 : u[i][k] / u[k][k];
        u[i][k] = 0;
        for (unsigned int j = k + 1; j < 3; j++)
            u[i][j] -= l[i][k] * u[k][j];
    }
}

void MEAPI MeMatrix3LUDecompose(MeMatrix3 L, MeMatrix3 U, const MeMatrix3 a, unsigned int *const SwappedRow,
                                MeVector3 scale) {
    MeVector3 weight;
    for (int i = 0; i < 3; i++)
        scale[i] = weight[i] = MeSafeRecip(largestOf(a[i]));
    MeMatrix3Copy(U, a);
    MeVectorSetZero((MeReal *)L, 9);
    for (unsigned int k = 0; k < 3; k++) {
        const unsigned int pivot = pivotRow(U, weight, k);
        MEASSERT(pivot >= k && pivot < 3);
        SwappedRow[k] = pivot;
        MeVector3Swap(U[k], U[pivot]);
        MeVector3Swap(L[k], L[pivot]);
        MeRealSwap(&weight[k], &weight[pivot]);
        L[k][k] = 1;
        eliminate(L, U, k);
    }
}

MeBool MEAPI MeMatrix3IsIdentity(const MeMatrix3 a, const MeReal tolerance) {
    return isIdentity((const MeReal *)a, 3, tolerance);
}

MeBool MEAPI MeMatrix3IsIsotropic(const MeMatrix3 i) {
    const MeReal tolerance = ME_SMALL_EPSILON * MeMAX3(MeFabs(i[0][0]), MeFabs(i[1][1]), MeFabs(i[2][2]));
    for (int row = 0; row < 3; row++) {
        for (int col = 0; col < 3; col++) {
            const MeReal expected = row == col ? i[0][0] : 0;
            if (!(MeFabs(i[row][col] - expected) <= tolerance))
                return MEFALSE;
        }
    }
    return METRUE;
}

/* ---- rotations ---- */

/* A plane rotated by ME_PI / 2 is exactly level; the cosine of the angle, which is rounded to single precision, would
 * incline it by 4e-8. (The 6e-17 of double precision remain.) A multiple of ME_PI / 2 has a relative error of at most
 * 3/4 ME_EPSILON: 1/4 by rounding of ME_PI, 1/2 by rounding of the product. */
void me_direction(MeReal angle, MeReal *cosine, MeReal *sine) {
    const double quarter = 1.57079632679489661923, turns = rint((double)angle / quarter);
    static const MeReal exact[4] = {1, 0, -1, 0};
    *cosine = MeCos(angle);
    *sine = MeSin(angle);
    if (sizeof(MeReal) == sizeof(float) &&
        fabs((double)angle - turns * quarter) <= (double)ME_EPSILON * fabs((double)angle)) {
        const int quarters = (int)(turns - 4 * floor(turns / 4));
        *cosine = exact[quarters];
        *sine = exact[(quarters + 3) % 4];
    }
}

static void makeRotation(MeMatrix3 m, int axis, MeReal angle) {
    const int j = NextMod3(axis), k = PrevMod3(axis);
    MeReal c, s;
    me_direction(angle, &c, &s);
    MeMatrix3MakeIdentity(m);
    m[j][j] = m[k][k] = c;
    m[k][j] = s;
    m[j][k] = -s;
}

void MEAPI MeMatrix3MakeRotationX(MeMatrix3 m, const MeReal a) {
    makeRotation(m, 0, a);
}

void MEAPI MeMatrix3MakeRotationY(MeMatrix3 m, const MeReal a) {
    makeRotation(m, 1, a);
}

void MEAPI MeMatrix3MakeRotationZ(MeMatrix3 m, const MeReal a) {
    makeRotation(m, 2, a);
}

void MEAPI MeMatrix3FromEulerAngles(MeMatrix3 m, const MeReal xangle, const MeReal yangle, const MeReal zangle) {
    MeReal cx, cy, cz, sx, sy, sz;
    me_direction(xangle, &cx, &sx);
    me_direction(yangle, &cy, &sy);
    me_direction(zangle, &cz, &sz);
    MeVector3Set(m[0], cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx);
    MeVector3Set(m[1], sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx);
    MeVector3Set(m[2], -sy, cy * sx, cy * cx);
}

MeBool MEAPI MeMatrix3IsValidOrientationMatrix(const MeMatrix3 rot, const MeReal tolerance) {
    return areAxes(rot[0], rot[1], rot[2], tolerance);
}

/* ---- MeMatrix4 ---- */

void MEAPI MeMatrix4Copy(MeMatrix4 A, const MeMatrix4 B) {
    memmove(A, B, sizeof(MeMatrix4));
}

void MEAPI MeMatrix4SetZero(MeMatrix4 A) {
    MeVectorSetZero((MeReal *)A, 16);
}

void MEAPI MeMatrix4Add(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C) {
    for (int i = 0; i < 4; i++)
        MeVector4Add(A[i], B[i], C[i]);
}

void MEAPI MeMatrix4MultiplyMatrix(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C) {
    MeMatrix4 t;
    MeMatrixMultiply((MeReal *)t, 4, 4, 4, (const MeReal *)B, (const MeReal *)C);
    memcpy(A, t, sizeof t);
}

void MEAPI MeMatrix4MultiplyVector(MeVector4 A, const MeMatrix4 B, const MeVector4 C) {
    const MeVector4 t = {MeVector4Dot(B[0], C), MeVector4Dot(B[1], C), MeVector4Dot(B[2], C), MeVector4Dot(B[3], C)};
    MeVector4Copy(A, t);
}

void MEAPI MeMatrix4Transpose(MeMatrix4 A) {
    transpose((MeReal *)A, 4);
}

MeBool MEAPI MeMatrix4IsZero(const MeMatrix4 m) {
    return MeRealArrayIsZero((const MeReal *)m, 16);
}

MeBool MEAPI MeMatrix4IsIdentity(const MeMatrix4 a, const MeReal tolerance) {
    return isIdentity((const MeReal *)a, 4, tolerance);
}

MeBool MEAPI MeMatrix4IsTM(const MeMatrix4 tm, const MeReal tolerance) {
    for (int i = 0; i < 4; i++) {
        const MeReal right = i == 3 ? (MeReal)1 : (MeReal)0;
        if (!(MeFabs(tm[i][3] - right) <= tolerance) || !(MeFabs(tm[3][i]) <= MEINFINITY))
            return MEFALSE;
    }
    return areAxes(tm[0], tm[1], tm[2], tolerance);
}
