/** @file MdtKeaMath.h
 *  Small vectors, matrices and quaternions in double precision, for Kea and for programs that write constraints.
 *
 *  Kea computes in double whatever MeReal is; MeMath.h is for MeReal. A matrix is three rows and acts on columns:
 *  y = M x. A quaternion is (w, x, y, z) and rotates body coordinates into world coordinates. A result may be the same
 *  array as an operand only where its comment says so.
 */
#ifndef MDTKEAMATH_H
#define MDTKEAMATH_H

#include "MePrecision.h"

static inline double keaDot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The larger, and the smaller, of two numbers; inlined, unlike fmax and fmin. */
static inline double keaMax(double a, double b) {
    return a > b ? a : b;
}
static inline double keaMin(double a, double b) {
    return a < b ? a : b;
}

static inline double keaLength(const double a[3]) {
    return sqrt(keaDot(a, a));
}

/** Faster than hypot, and the same bits with every C library. */
static inline double keaHypotenuse(double a, double b) {
    return sqrt(a * a + b * b);
}

static inline void keaCopy(double r[3], const double a[3]) {
    r[0] = a[0], r[1] = a[1], r[2] = a[2];
}

static inline void keaZero(double r[3]) {
    r[0] = r[1] = r[2] = 0;
}

/** Sets to 0 the components of v along some axes: bits 0 to 2 for x, y and z. */
static inline void keaDropAxes(int axes, double v[3]) {
    for (int k = 0; axes && k < 3; k++)
        v[k] = axes >> k & 1 ? 0 : v[k];
}

/** r = a x b; r must be another array. */
static inline void keaCross(double r[3], const double a[3], const double b[3]) {
    r[0] = a[1] * b[2] - a[2] * b[1];
    r[1] = a[2] * b[0] - a[0] * b[2];
    r[2] = a[0] * b[1] - a[1] * b[0];
}

/** r = a - b; r may be a or b. */
static inline void keaSubtract(double r[3], const double a[3], const double b[3]) {
    r[0] = a[0] - b[0], r[1] = a[1] - b[1], r[2] = a[2] - b[2];
}

/** r = s a; r may be a. */
static inline void keaScale(double r[3], double s, const double a[3]) {
    r[0] = s * a[0], r[1] = s * a[1], r[2] = s * a[2];
}

/** r += s a; r may be a. */
static inline void keaAddScaled(double r[3], double s, const double a[3]) {
    r[0] += s * a[0], r[1] += s * a[1], r[2] += s * a[2];
}

/** r = M a; r must be another array. */
static inline void keaApply(double r[3], const double M[3][3], const double a[3]) {
    r[0] = keaDot(M[0], a), r[1] = keaDot(M[1], a), r[2] = keaDot(M[2], a);
}

/** r = Mᵀ a; r must be another array. */
static inline void keaApplyTransposed(double r[3], const double M[3][3], const double a[3]) {
    for (int i = 0; i < 3; i++)
        r[i] = M[0][i] * a[0] + M[1][i] * a[1] + M[2][i] * a[2];
}

/** r = p q, the rotation q followed by p; r may be p or q. */
static inline void keaQuaternionProduct(double r[4], const double p[4], const double q[4]) {
    const double w = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    const double x = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    const double y = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    const double z = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
    r[0] = w, r[1] = x, r[2] = y, r[3] = z;
}

static inline void keaQuaternionConjugate(double r[4], const double q[4]) {
    r[0] = q[0], r[1] = -q[1], r[2] = -q[2], r[3] = -q[3];
}

static inline void keaQuaternionNormalize(double q[4]) {
    const double s = 1 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] *= s;
}

/** The rotation matrix of a unit quaternion. */
static inline void keaQuaternionToMatrix(double R[3][3], const double q[4]) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    R[0][0] = 1 - 2 * (y * y + z * z), R[0][1] = 2 * (x * y - w * z), R[0][2] = 2 * (x * z + w * y);
    R[1][0] = 2 * (x * y + w * z), R[1][1] = 1 - 2 * (x * x + z * z), R[1][2] = 2 * (y * z - w * x);
    R[2][0] = 2 * (x * z - w * y), R[2][1] = 2 * (y * z + w * x), R[2][2] = 1 - 2 * (x * x + y * y);
}

/** The unit quaternion of a rotation matrix. */
static inline void keaQuaternionFromMatrix(double q[4], const double R[3][3]) {
    /* Row k of m is 4 times component k of the quaternion times the quaternion. The row with the largest diagonal entry
     * is normalized: it has the smallest rounding error. */
    const double wx = R[2][1] - R[1][2], wy = R[0][2] - R[2][0], wz = R[1][0] - R[0][1];
    const double xy = R[0][1] + R[1][0], xz = R[0][2] + R[2][0], yz = R[1][2] + R[2][1];
    const double m[4][4] = {{1 + R[0][0] + R[1][1] + R[2][2], wx, wy, wz},
                            {wx, 1 + R[0][0] - R[1][1] - R[2][2], xy, xz},
                            {wy, xy, 1 - R[0][0] + R[1][1] - R[2][2], yz},
                            {wz, xz, yz, 1 - R[0][0] - R[1][1] + R[2][2]}};
    int k = 0;
    for (int i = 1; i < 4; i++)
        k = m[i][i] > m[k][k] ? i : k;
    for (int i = 0; i < 4; i++)
        q[i] = m[k][i];
    keaQuaternionNormalize(q);
}

/** The rotation by |u| radians about u. Exact for every u, zero included. */
static inline void keaQuaternionExp(double q[4], const double u[3]) {
    const double angle2 = keaDot(u, u);
    double s; /* sin(|u|/2) / |u| */
    if (angle2 < 1e-8) {
        s = 0.5 - angle2 / 48; /* the next term is angle⁴/3840: below rounding */
        q[0] = 1 - angle2 / 8 + angle2 * angle2 / 384;
    } else {
        const double angle = sqrt(angle2);
        s = sin(angle / 2) / angle;
        q[0] = cos(angle / 2);
    }
    keaScale(q + 1, s, u);
}

#endif
