/* Rotations as quaternions (w, x, y, z). */
#include "MeMath_i.h"

#include "MeAssert.h"

/* ---- making ---- */

void MEAPI MeQuaternionSet(MeVector4 q, MeReal w, MeReal x, MeReal y, MeReal z) {
    q[0] = w;
    q[1] = x;
    q[2] = y;
    q[3] = z;
}

void MEAPI MeQuaternionMake(MeVector4 q, const MeVector3 axis, const MeReal angle) {
    MeReal c, s;
    MeVector3 n;
    me_direction(angle / 2, &c, &s);
    MeVector3Copy(n, axis);
    if (MeVector3Normalize(n) == 0) {
        MeWarning(1, "MeQuaternionMake: the axis (%g, %g, %g) has no direction", (double)axis[0], (double)axis[1],
                  (double)axis[2]);
        MeQuaternionSet(q, 1, 0, 0, 0);
        return;
    }
    MeQuaternionSet(q, c, s * n[0], s * n[1], s * n[2]);
}

/* Whether q rotates one unit vector to another. */
static MeBool rotatesTo(const MeVector4 q, const MeVector3 from, const MeVector3 to) {
    MeVector3 turned;
    MeQuaternionRotateVector3(turned, q, from);
    return MeVector3Distance(turned, to) < ME_MEDIUM_EPSILON;
}

/* For unit vectors a, b with the angle 2t between them, |a + b| = 2 cos t and |a - b| = 2 sin t, and the axis is
 * parallel to (a - b) x (a + b). These expressions are accurate for any angle, unlike a . b and a x b. */
void MEAPI MeQuaternionForRotation(MeVector4 q, const MeVector3 v1, const MeVector3 v2) {
    MeVector3 a, b, sum, difference, axis, unused;
    MeVector3Copy(a, v1);
    MeVector3Copy(b, v2);
    if (MeVector3Normalize(a) == 0 || MeVector3Normalize(b) == 0) {
        MeWarning(1, "MeQuaternionForRotation: a vector without a direction");
        MeQuaternionSet(q, 1, 0, 0, 0);
        return;
    }
    MeVector3Add(sum, a, b);
    MeVector3Subtract(difference, a, b);
    MeReal length = MeVector3Normalize(sum);
    if (length < 4 * ME_EPSILON) { /* opposite: the sum is rounding error */
        length = 0;
        MeVector3PlaneSpace(a, sum, unused);
    }
    MeVector3Cross(axis, difference, sum);
    MeQuaternionSet(q, length, axis[0], axis[1], axis[2]);
    me_normalize(q, 4);
    MEVALIDATE(rotatesTo(q, a, b));
}

/* Shepperd's method: computes the largest of w, x, y, z first (times 4 itself), so that nothing cancels. */
void MEAPI MeQuaternionFromTM(MeVector4 q, const MeMatrix4 tm) {
    const MeReal diagonal[3] = {tm[0][0], tm[1][1], tm[2][2]};
    const MeReal trace = diagonal[0] + diagonal[1] + diagonal[2];
    const MeReal negated[3] = {-diagonal[0], -diagonal[1], -diagonal[2]};
    const int i = MinIndex(negated), j = NextMod3(i), k = PrevMod3(i);
    if (trace > diagonal[i]) {
        MeQuaternionSet(q, 1 + trace, tm[1][2] - tm[2][1], tm[2][0] - tm[0][2], tm[0][1] - tm[1][0]);
    } else {
        q[0] = tm[j][k] - tm[k][j];
        q[1 + i] = 1 + diagonal[i] - diagonal[j] - diagonal[k];
        q[1 + j] = tm[i][j] + tm[j][i];
        q[1 + k] = tm[i][k] + tm[k][i];
    }
    me_normalize(q, 4);
    if (q[0] < 0)
        MeVector4Scale(q, -1);
    MEASSERT(!(q[0] < 0));
}

/* ---- using ---- */

/* 2 / |q|^2, by which formulas for unit quaternions hold for any length; 0 for zero, which means no rotation. */
static MeReal twoOverSquare(const MeVector4 q) {
    const MeReal square = MeVector4Dot(q, q);
    return square < (MeReal)1e-30 ? 0 : 2 / square;
}

void MEAPI MeQuaternionToR(MeMatrix3 R, const MeVector4 q) {
    const MeReal s = twoOverSquare(q), w = q[0], x = q[1], y = q[2], z = q[3];
    MeVector3Set(R[0], 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y));
    MeVector3Set(R[1], s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x));
    MeVector3Set(R[2], s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y));
}

void MEAPI MeQuaternionToTM(MeMatrix4 tm, const MeVector4 q) {
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetRotationFromQuaternion(tm, q);
}

void MEAPI MeQuaternionRotateVector3(MeVector3 vout, const MeVector4 q, const MeVector3 v) {
    const MeReal s = twoOverSquare(q), w = q[0];
    MeVector3 t, u;
    MeVector3Cross(t, q + 1, v);
    MeVector3Cross(u, q + 1, t);
    for (int i = 0; i < 3; i++)
        vout[i] = v[i] + s * (w * t[i] + u[i]);
}

void MEAPI MeQuaternionProduct(MeVector4 r, const MeVector4 p, const MeVector4 q) {
    const MeReal w = p[0], x = p[1], y = p[2], z = p[3];
    MeQuaternionSet(r, w * q[0] - x * q[1] - y * q[2] - z * q[3], w * q[1] + x * q[0] + y * q[3] - z * q[2],
                    w * q[2] - x * q[3] + y * q[0] + z * q[1], w * q[3] + x * q[2] - y * q[1] + z * q[0]);
}

/* The angle between two quaternions as vectors in four dimensions, 0 to pi. */
static MeReal angleBetween(const MeVector4 p, const MeVector4 q) {
    MeVector4 sum, difference;
    MeVector4Add(sum, p, q);
    MeVector4Subtract(difference, p, q);
    return 2 * MeAtan2(me_length(difference, 4), me_length(sum, 4));
}

void MEAPI MeQuaternionSlerp(MeVector4 q, const MeVector4 from, const MeVector4 to, const MeReal howFar) {
    MeVector4 end;
    MeVector4Copy(end, to);
    if (MeVector4Dot(from, to) < 0)
        MeVector4Scale(end, -1);
    const MeReal angle = angleBetween(from, end), s = MeSin(angle);
    MEASSERT(!(MeVector4Dot(from, end) < 0)); /* the shorter arc */
    const MeReal a = s > 0 ? MeSin((1 - howFar) * angle) / s : 1 - howFar;
    const MeReal b = s > 0 ? MeSin(howFar * angle) / s : howFar;
    for (int i = 0; i < 4; i++)
        q[i] = a * from[i] + b * end[i];
    me_normalize(q, 4);
}

/* ---- in motion ---- */

void MEAPI MeQuaternionWtoDQ(MeVector4 dq, const MeVector4 q, const MeVector3 w) {
    const MeVector4 half = {0, w[0] / 2, w[1] / 2, w[2] / 2};
    MeQuaternionProduct(dq, half, q);
}

void MEAPI MeQuaternionToD(MeReal D[12], const MeVector4 q) {
    const MeReal w = q[0], x = q[1], y = q[2], z = q[3];
    MeQuaternionSet(D, -x, w, -z, y);
    MeQuaternionSet(D + 4, -y, z, w, -x);
    MeQuaternionSet(D + 8, -z, -y, x, w);
}

void MEAPI MeQuaternionFiniteRotation(MeVector4 q, const MeVector3 w, const MeReal h) {
    const MeVector3 turn = {h * w[0], h * w[1], h * w[2]};
    const MeReal angle = MeVector3Magnitude(turn);
    /* sin(angle / 2) / angle; below epsilon it is 1/2 to rounding, and the quotient may be 0/0 */
    const MeReal s = angle < ME_EPSILON ? (MeReal)0.5 : MeSin(angle / 2) / angle;
    const MeVector4 e = {MeCos(angle / 2), s * turn[0], s * turn[1], s * turn[2]};
    MeQuaternionProduct(q, e, q);
    me_normalize(q, 4);
}
