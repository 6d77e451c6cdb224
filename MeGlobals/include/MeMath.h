/** @file MeMath.h
 *  Vectors, matrices, quaternions and rigid transforms.
 *
 *  Frames are right-handed and angles are in radians: a positive rotation about z takes x to y. A transform maps the
 *  coordinates x of a point in one frame to those in another, y = R x + X:
 *
 *  @verbatim
 *      MeMatrix3 R                 MeMatrix4 tm, a "TM"
 *      { { xx, yx, zx },           { { xx, xy, xz, 0 },      row 0: direction of the x axis
 *        { xy, yy, zy },             { yx, yy, yz, 0 },      row 1: direction of the y axis
 *        { xz, yz, zz } }            { zx, zy, zz, 0 },      row 2: direction of the z axis
 *                                    { X,  Y,  Z,  1 } }     row 3: position of the origin, X
 *
 *      y[i] = sum over j of R[i][j] x[j] + X[i]        tm[j][i] == R[i][j]
 *  @endverbatim
 *
 *  A MeMatrix3 is an ordinary row-major matrix for column vectors. A TM has OpenGL's layout: its rotation is the
 *  transpose of R, and each axis is a row that can be used as a MeVector3. A quaternion is (w, x, y, z): (cos a/2, n
 *  sin a/2) for the angle a about the unit axis n; q and -q are the same rotation. Unless a function says otherwise, a
 *  quaternion of another length counts as normalized, and a zero one as the identity.
 *
 *  For every function here:
 *  - Results come first. An output may be the same array as an input, unless the function says otherwise; the result
 *    is as if the input had been copied first. Two outputs must be different arrays.
 *  - Pointers and array sizes are not checked, unlike in the rest of Karma. NaN in gives NaN out, without a warning,
 *    and tests ("Is...") of NaN are false.
 *  - All functions are stateless and thread-safe, except MeRealRandomInRange.
 *
 *  Before C23, passing a MeMatrix3 or MeMatrix4 as a const one is an extension of C. All compilers have it; gcc
 *  -Wpedantic mentions it.
 *
 *  The header includes messages, assertions and headers of the C library, on which programs rely.
 */
#ifndef MEMATH_H
#define MEMATH_H

#include "MeAssert.h"
#include "MeMessage.h"
#include "MePrecision.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

ME_BEGIN_C

#define ME_PI ((MeReal)3.14159265358979323846) /**< pi. */

/** @name Minimum, maximum, clamping
 *  Macros for all number types; they may evaluate an argument twice. MeCLAMP: a, limited to b .. c.
 *  @{ */
#define MeMIN(a, b)      ((a) < (b) ? (a) : (b))
#define MeMAX(a, b)      ((a) > (b) ? (a) : (b))
#define MeMIN3(a, b, c)  MeMIN(a, MeMIN(b, c))
#define MeMAX3(a, b, c)  MeMAX(a, MeMAX(b, c))
#define MeCLAMP(a, b, c) ((a) < (b) ? (b) : (a) > (c) ? (c) : (a))
/** @} */

/** @name Rounding to multiples
 *  For integers n >= 0: the smallest multiple >= n (CEIL), the largest <= n (FLOOR). MeMathCEILN has the multiple c as
 *  its first argument.
 *  @{ */
#define MeMathCEILN(c, n) (((n) + ((c)-1)) / (c) * (c))
#define MeMathCEIL4(n)    MeMathCEILN(4, n)
#define MeMathCEIL12(n)   MeMathCEILN(12, n)
#define MeMathCEIL16(n)   MeMathCEILN(16, n)
#define MeMathCEIL64(n)   MeMathCEILN(64, n)
#define MeMathFLOOR4(n)   ((n) / 4 * 4)
/** @} */

/** @name Cyclic indices
 *  The index after or before i modulo N; i must be in 0 .. N-1.
 *  @{ */
static inline int NextModN(const int i, const int N) {
    return i + 1 < N ? i + 1 : 0;
}
static inline int PrevModN(const int i, const int N) {
    return i > 0 ? i - 1 : N - 1;
}
static inline int NextMod2(const int i) {
    return NextModN(i, 2);
}
static inline int PrevMod2(const int i) {
    return PrevModN(i, 2);
}
static inline int NextMod3(const int i) {
    return NextModN(i, 3);
}
static inline int PrevMod3(const int i) {
    return PrevModN(i, 3);
}
static inline int NextMod4(const int i) {
    return NextModN(i, 4);
}
static inline int PrevMod4(const int i) {
    return PrevModN(i, 4);
}
/** @} */

/** The index of the smallest of three numbers; of equal ones, the first. */
static inline MeI32 MinIndex(const MeReal a[3]) {
    const MeI32 min = a[1] < a[0] ? 1 : 0;
    return a[2] < a[min] ? 2 : min;
}

/** The indices of three numbers in ascending order: a[index[0]] <= a[index[1]] <= a[index[2]]. Equal numbers keep their
 *  order. */
static inline void Sort3(MeI32 index[3], const MeReal a[3]) {
    const MeI32 low = a[1] < a[0] ? 1 : 0, high = 1 - low;
    const MeI32 place = a[2] < a[low] ? 0 : a[2] < a[high] ? 1 : 2;
    index[place] = 2;
    index[place == 0 ? 1 : 0] = low;
    index[place == 2 ? 1 : 2] = high;
}

/** @name Numbers
 *  @{ */
/** Swaps two numbers. */
MEPUBLIC void MEAPI MeRealSwap(MeReal *const a, MeReal *const b);
/** 1/x, or MEINFINITY with the sign of x where that would be infinite. Both zeros count as positive. */
MEPUBLIC MeReal MEAPI MeSafeRecip(MeReal x);
/**
 * A random number from start to end, uniformly distributed. The sequence is the same in every run of a program (and, up
 * to rounding, in both precisions). Not thread-safe.
 */
MEPUBLIC MeReal MEAPI MeRealRandomInRange(MeReal start, MeReal end);
/** Are all numbers 0? True for no numbers at all. */
MEPUBLIC MeBool MEAPI MeRealArrayIsZero(const MeReal *v, int elements);
/** Sets n numbers to 0. */
MEPUBLIC void MEAPI MeVectorSetZero(MeReal *const A, const int n);
/** @} */

/** @name MeVector3: sums and products, component by component
 *  @{ */
/** c = (x, y, z) */
MEPUBLIC void MEAPI MeVector3Set(MeVector3 c, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MeVector3Copy(MeVector3 c, const MeVector3 b); /**< c = b */
MEPUBLIC void MEAPI MeVector3Swap(MeVector3 a, MeVector3 b);       /**< Swaps a and b. */
/** a = b + c */
MEPUBLIC void MEAPI MeVector3Add(MeVector3 a, const MeVector3 b, const MeVector3 c);
/** a = b - c */
MEPUBLIC void MEAPI MeVector3Subtract(MeVector3 a, const MeVector3 b, const MeVector3 c);
/** v = a v */
MEPUBLIC void MEAPI MeVector3Scale(MeVector3 v, const MeReal a);
/** a = c b */
MEPUBLIC void MEAPI MeVector3MultiplyScalar(MeVector3 a, const MeVector3 b, const MeReal c);
/** a_i = b_i c_i */
MEPUBLIC void MEAPI MeVector3MultiplyElements(MeVector3 a, const MeVector3 b, const MeVector3 c);
/** v = v + a v1 */
MEPUBLIC void MEAPI MeVector3MultiplyAdd(MeVector3 v, const MeReal a, const MeVector3 v1);
/** v = v - a v1 */
MEPUBLIC void MEAPI MeVector3MultiplySubtract(MeVector3 v, const MeReal a, const MeVector3 v1);
/** a = c b + d */
MEPUBLIC void MEAPI MeVector3ScaleAndAdd(MeVector3 a, const MeVector3 b, const MeReal c, const MeVector3 d);
/** The component-wise minimum. */
MEPUBLIC void MEAPI MeVector3Min(MeVector3 out, const MeVector3 in1, const MeVector3 in2);
/** The component-wise maximum. */
MEPUBLIC void MEAPI MeVector3Max(MeVector3 out, const MeVector3 in1, const MeVector3 in2);
/** Clamps each component of a to min .. max. */
MEPUBLIC void MEAPI MeVector3Clamp(MeVector3 a, const MeReal min, const MeReal max);
/** Linear interpolation: (1 - howFar) from + howFar to. 0 and 1 give the end points exactly; other numbers
 *  extrapolate. */
MEPUBLIC void MEAPI MeVector3Lerp(MeVector3 out, const MeVector3 from, const MeVector3 to, const MeReal howFar);
/** @} */

/** @name MeVector3: lengths, angles, directions
 *  Magnitude, Distance, Normalize and MakeOrthogonal are accurate even where squares of components overflow or
 *  underflow; the Sqr functions are not.
 *  @{ */
MEPUBLIC MeReal MEAPI MeVector3Dot(const MeVector3 b, const MeVector3 c); /**< b . c */
/** a = b x c */
MEPUBLIC void MEAPI MeVector3Cross(MeVector3 a, const MeVector3 b, const MeVector3 c);
MEPUBLIC MeReal MEAPI MeVector3Magnitude(const MeVector3 v); /**< |v| */
/** |v| squared */
MEPUBLIC MeReal MEAPI MeVector3MagnitudeSqr(const MeVector3 v);
MEPUBLIC MeReal MEAPI MeVector3Distance(const MeVector3 a, const MeVector3 b); /**< |a - b| */
/** |a - b| squared */
MEPUBLIC MeReal MEAPI MeVector3DistanceSqr(const MeVector3 a, const MeVector3 b);
/** Normalizes v and returns its previous length. A vector that is zero, infinite or NaN is unchanged, and the result is
 *  0. */
MEPUBLIC MeReal MEAPI MeVector3Normalize(MeVector3 v);
/** vec x e, where e is the x, y or z axis (axisN 0, 1 or 2). */
static inline void MeVector3CrossAxis(MeVector3 result, const MeVector3 vec, const int axisN) {
    const int j = NextMod3(axisN), k = PrevMod3(axisN);
    const MeReal vj = vec[j];
    result[j] = vec[k];
    result[k] = -vj;
    result[axisN] = 0;
}
/** a . (b x c): the volume of the parallelepiped, positive if a, b, c are right-handed. */
MEPUBLIC MeReal MEAPI MeVector3ScalarTripleProduct(const MeVector3 a, const MeVector3 b, const MeVector3 c);
/** a[i][j] = b[i] c[j] */
MEPUBLIC void MEAPI MeVector3OuterProduct(MeMatrix3 a, const MeVector3 b, const MeVector3 c);
/** The area of a triangle with the edges v1 and v2 from one corner: |v1 x v2| / 2. */
MEPUBLIC MeReal MEAPI MeVector3AreaOfTriangle(const MeVector3 v1, const MeVector3 v2);
/** Removes the component of v along v1 (of any length), so that v . v1 = 0. If v1 has no direction, v is unchanged. */
MEPUBLIC void MEAPI MeVector3MakeOrthogonal(MeVector3 v, const MeVector3 v1);
/**
 * Two unit vectors a, b that complete the unit vector n to a right-handed frame: n x a = b. They depend continuously on
 * n, except for a jump where n[2] changes its sign; for the z axis they are x and y. (Duff et al., Building an
 * Orthonormal Basis, Revisited, JCGT 2017.)
 */
MEPUBLIC void MEAPI MeVector3PlaneSpace(const MeVector3 n, MeVector3 a, MeVector3 b);
/** @} */

/** @name MeVector4
 *  @{ */
/** c = b */
MEPUBLIC void MEAPI MeVector4Copy(MeVector4 c, const MeVector4 b);
/** a = b + c */
MEPUBLIC void MEAPI MeVector4Add(MeVector4 a, const MeVector4 b, const MeVector4 c);
/** a = b - c */
MEPUBLIC void MEAPI MeVector4Subtract(MeVector4 a, const MeVector4 b, const MeVector4 c);
/** v = a v */
MEPUBLIC void MEAPI MeVector4Scale(MeVector4 v, const MeReal a);
/** a_i = b_i c_i */
MEPUBLIC void MEAPI MeVector4MultiplyElements(MeVector4 a, const MeVector4 b, const MeVector4 c);
/** b . c */
MEPUBLIC MeReal MEAPI MeVector4Dot(const MeVector4 b, const MeVector4 c);
/** v . v */
MEPUBLIC MeReal MEAPI MeVector4MagnitudeSqr(const MeVector4 v);
/** Clamps each component of a to min .. max. */
MEPUBLIC void MEAPI MeVector4Clamp(MeVector4 a, const MeReal min, const MeReal max);
/** @} */

/** @name MeMatrix3: any matrix
 *  @{ */
MEPUBLIC void MEAPI MeMatrix3MakeIdentity(MeMatrix3 tm); /**< The identity. */
/** A = B */
MEPUBLIC void MEAPI MeMatrix3Copy(MeMatrix3 A, const MeMatrix3 B);
/** A = B + C */
MEPUBLIC void MEAPI MeMatrix3Add(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C);
/** A = B - C */
MEPUBLIC void MEAPI MeMatrix3Subtract(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C);
/** A = a A */
MEPUBLIC void MEAPI MeMatrix3Scale(MeMatrix3 A, const MeReal a);
/** A = B C */
MEPUBLIC void MEAPI MeMatrix3MultiplyMatrix(MeMatrix3 A, const MeMatrix3 B, const MeMatrix3 C);
/** A = B C */
MEPUBLIC void MEAPI MeMatrix3MultiplyVector(MeVector3 A, const MeMatrix3 B, const MeVector3 C);
MEPUBLIC void MEAPI MeMatrix3Transpose(MeMatrix3 A);     /**< Exchanges A[i][j] and A[j][i]. */
MEPUBLIC MeReal MEAPI MeMatrix3Trace(const MeMatrix3 m); /**< The sum of the diagonal. */
/** The rows of A become B1, B2, B3. */
MEPUBLIC void MEAPI MeMatrix3CopyVec(MeMatrix3 A, const MeVector3 B1, const MeVector3 B2, const MeVector3 B3);
/** Swaps two columns, 0 to 2. With any other number it warns and changes nothing. */
MEPUBLIC void MEAPI MeMatrix3SwapColumns(MeMatrix3 a, const unsigned int col1, const unsigned int col2);
/** Sets the rows of the cross product matrix A: A v = factor (a x v). */
MEPUBLIC void MEAPI MeMatrix3CrossFromVector(const MeVector3 a, const MeReal factor, MeVector3 A0, MeVector3 A1,
                                             MeVector3 A2);
/**
 * Inverts a in place and returns METRUE. A matrix that is singular to working precision is unchanged, and the result is
 * MEFALSE; the test, which compares det a with the product of the rows' largest elements, does not depend on the units
 * of the rows. The same for a matrix that has an element that is not finite, or whose inverse would have one.
 */
MEPUBLIC MeBool MEAPI MeMatrix3Invert(MeMatrix3 a);
/** The same for a symmetric matrix: only the diagonal and the upper triangle are read, and the inverse is exactly
 *  symmetric. */
MEPUBLIC MeBool MEAPI MeMatrix3SymmetricInvert(MeMatrix3 a);
/**
 * LU decomposition with partial pivoting: L U = P a, where L is unit lower triangular and U is upper triangular.
 * Singular matrices are factored, too: then U has a 0 on its diagonal. The permutation P swaps rows 0 and
 * SwappedRow[0], then 1 and SwappedRow[1], then 2 and SwappedRow[2]. scale gets the weights of the rows in the choice
 * of pivots: one over the row's largest element.
 */
MEPUBLIC void MEAPI MeMatrix3LUDecompose(MeMatrix3 L, MeMatrix3 U, const MeMatrix3 a, unsigned int *const SwappedRow,
                                         MeVector3 scale);
/** Is every element within the tolerance of the identity's? */
MEPUBLIC MeBool MEAPI MeMatrix3IsIdentity(const MeMatrix3 a, const MeReal tolerance);
/** Is this inertia isotropic, i.e. a multiple of the identity? The tolerance is ME_SMALL_EPSILON times the largest
 *  diagonal element. */
MEPUBLIC MeBool MEAPI MeMatrix3IsIsotropic(const MeMatrix3 i);
/** @} */

/** @name MeMatrix3: rotations
 *  y = R x, see above. In single precision, angles that are multiples of a quarter turn up to rounding, such as ME_PI /
 *  2, give exact matrices: a plane rotated by them is exactly level.
 *  @{ */
/** Rotation by the angle a about x: y to z. */
MEPUBLIC void MEAPI MeMatrix3MakeRotationX(MeMatrix3 m, const MeReal a);
/** Rotation by the angle a about y: z to x. */
MEPUBLIC void MEAPI MeMatrix3MakeRotationY(MeMatrix3 m, const MeReal a);
/** Rotation by the angle a about z: x to y. */
MEPUBLIC void MEAPI MeMatrix3MakeRotationZ(MeMatrix3 m, const MeReal a);
/** Rotation about the fixed axis x, then y, then z: m = Rz Ry Rx. */
MEPUBLIC void MEAPI MeMatrix3FromEulerAngles(MeMatrix3 m, const MeReal xangle, const MeReal yangle,
                                             const MeReal zangle);
/** Is it a rotation matrix: orthonormal rows, each dot product within the tolerance, and no reflection? */
MEPUBLIC MeBool MEAPI MeMatrix3IsValidOrientationMatrix(const MeMatrix3 rot, const MeReal tolerance);
/** @} */

/** @name MeMatrix4: any matrix
 *  Ordinary matrix products. For transforms use the functions of TMs.
 *  @{ */
MEPUBLIC void MEAPI MeMatrix4Copy(MeMatrix4 A, const MeMatrix4 B); /**< A = B */
MEPUBLIC void MEAPI MeMatrix4SetZero(MeMatrix4 A);                 /**< A = 0 */
/** A = B + C */
MEPUBLIC void MEAPI MeMatrix4Add(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C);
/** A = B C */
MEPUBLIC void MEAPI MeMatrix4MultiplyMatrix(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C);
/** A = B C */
MEPUBLIC void MEAPI MeMatrix4MultiplyVector(MeVector4 A, const MeMatrix4 B, const MeVector4 C);
MEPUBLIC void MEAPI MeMatrix4Transpose(MeMatrix4 A);      /**< Exchanges A[i][j] and A[j][i]. */
MEPUBLIC MeBool MEAPI MeMatrix4IsZero(const MeMatrix4 m); /**< Is every element 0? */
/** Is every element within the tolerance of the identity's? */
MEPUBLIC MeBool MEAPI MeMatrix4IsIdentity(const MeMatrix4 a, const MeReal tolerance);
/** Is it a rigid transform: a rotation, a finite position, and 0, 0, 0, 1 in the last column, all within the
 *  tolerance? */
MEPUBLIC MeBool MEAPI MeMatrix4IsTM(const MeMatrix4 tm, const MeReal tolerance);
/** A = B, for matrices aligned to 16 bytes (MeALIGNDATA). The same as MeMatrix4Copy here. */
static inline void MeMatrix4CopyAligned(MeMatrix4 A, const MeMatrix4 B) {
    MeMatrix4Copy(A, B);
}
/** @} */

/** @name TMs: construction and access
 *  Functions that make a TM write all of it. Functions that set a part leave the rest unchanged.
 *  @{ */
MEPUBLIC void MEAPI MeMatrix4TMMakeIdentity(MeMatrix4 tm); /**< No rotation, position 0. */
/** Rotation R, position (x, y, z). */
MEPUBLIC void MEAPI MeMatrix4TMMakeFromRotationAndPosition(MeMatrix4 A, const MeMatrix3 R, const MeReal x,
                                                           const MeReal y, const MeReal z);
/** Rotation as from MeMatrix3FromEulerAngles, position (x, y, z). */
MEPUBLIC void MEAPI MeMatrix4TMFromEulerAnglesAndPosition(MeMatrix4 tm, const MeReal xangle, const MeReal yangle,
                                                          const MeReal zangle, const MeReal x, const MeReal y,
                                                          const MeReal z);
/** Sets the position. */
MEPUBLIC void MEAPI MeMatrix4TMSetPosition(MeMatrix4 tm, MeReal x, MeReal y, MeReal z);
/** Sets the position. */
static inline void MeMatrix4TMSetPositionVector(MeMatrix4 tm, const MeVector3 position) {
    MeMatrix4TMSetPosition(tm, position[0], position[1], position[2]);
}
/** Sets the rotation. */
MEPUBLIC void MEAPI MeMatrix4TMSetRotation(MeMatrix4 tm, const MeMatrix3 R);
/** Reads the rotation. */
MEPUBLIC void MEAPI MeMatrix4TMGetRotation(MeMatrix3 R, const MeMatrix4 tm);
/** Sets the rotation. */
MEPUBLIC void MEAPI MeMatrix4TMSetRotationFromQuaternion(MeMatrix4 tm, const MeVector4 q);
/** Orthonormalizes a rotation that has accumulated rounding errors: x keeps its direction, y its plane with x, and z =
 *  x cross y. If x or y is zero, or both are parallel, it warns and changes nothing. The position is kept. */
MEPUBLIC void MEAPI MeMatrix4TMOrthoNormalize(MeMatrix4 tm);
/** @} */

/** @name TMs: application
 *  The TM must be a rigid transform (MeMatrix4IsTM).
 *  @{ */
/** Transforms a point: R in + X. */
MEPUBLIC void MEAPI MeMatrix4TMTransform(MeVector3 out, const MeMatrix4 tm, const MeVector3 in);
/** Transforms a point by the inverse: transpose(R) (in - X). */
MEPUBLIC void MEAPI MeMatrix4TMInverseTransform(MeVector3 out, const MeMatrix4 tm, const MeVector3 in);
/** Rotates a direction: R in. */
MEPUBLIC void MEAPI MeMatrix4TMRotate(MeVector3 out, const MeMatrix4 tm, const MeVector3 in);
/** Rotates a direction by the inverse: transpose(R) in. */
MEPUBLIC void MEAPI MeMatrix4TMInverseRotate(MeVector3 out, const MeMatrix4 tm, const MeVector3 in);
/** Inverts tm in place. */
MEPUBLIC void MEAPI MeMatrix4TMInvert(MeMatrix4 tm);
/** Composes transforms, B first and then C: if B maps a part's frame to a body's and C the body's frame to the world's,
 *  A maps the part's frame to the world's. In memory it is the product B C. */
MEPUBLIC void MEAPI MeMatrix4TMCompound(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C);
/**
 * The transform of a body after a time of constant linear and angular velocity, both in the world frame: the position
 * moves by v h, and the rotation is multiplied by exp(h w) from the left. If the total angle is less than @a aEpsilon
 * (radians), the rotation is unchanged. After many updates of a transform see MeMatrix4TMOrthoNormalize.
 */
MEPUBLIC void MEAPI MeMatrix4TMUpdateFromVelocities(MeMatrix4 aTransformReturn, MeReal aEpsilon, MeReal aTimeStep,
                                                    const MeVector3 aVelocity, const MeVector3 aAngularVelocity,
                                                    const MeMatrix4 aTransform);
/** The same with constant accelerations: the position moves by h v + h^2/2 a, the rotation by h w + h^2/2 alpha, which
 *  is exact if w and alpha are parallel. */
MEPUBLIC void MEAPI MeMatrix4TMUpdateFromVelocitiesAndAcceler(
    MeMatrix4 aTransformReturn, MeReal aEpsilon, MeReal aTimeStep, const MeVector3 aVelocity, const MeVector3 aAcceler,
    const MeVector3 aAngularVelocity, const MeVector3 aAngularAcceler, const MeMatrix4 aTransform);
/** @} */

/** @name Quaternions: construction
 *  @{ */
MEPUBLIC void MEAPI MeQuaternionSet(MeVector4 q, MeReal w, MeReal x, MeReal y, MeReal z); /**< As given. */
/** The rotation by the angle about the axis, which may have any length. For a zero axis it warns and returns the
 *  identity. */
MEPUBLIC void MEAPI MeQuaternionMake(MeVector4 q, const MeVector3 axis, const MeReal angle);
/** The smallest rotation that takes the direction of v1 to that of v2; for opposite ones, half a turn about some
 *  perpendicular axis. For a zero vector it warns and returns the identity. */
MEPUBLIC void MEAPI MeQuaternionForRotation(MeVector4 q, const MeVector3 v1, const MeVector3 v2);
/** The rotation of a TM, with w >= 0. */
MEPUBLIC void MEAPI MeQuaternionFromTM(MeVector4 q, const MeMatrix4 tm);
/** @} */

/** @name Quaternions: application
 *  @{ */
MEPUBLIC void MEAPI MeQuaternionToR(MeMatrix3 R, const MeVector4 q); /**< The rotation matrix. */
/** A TM with that rotation and position 0. */
MEPUBLIC void MEAPI MeQuaternionToTM(MeMatrix4 tm, const MeVector4 q);
/** v rotated by q: R v. */
MEPUBLIC void MEAPI MeQuaternionRotateVector3(MeVector3 vout, const MeVector4 q, const MeVector3 v);
/** r = p q: the rotation q first, then p. Lengths are multiplied. */
MEPUBLIC void MEAPI MeQuaternionProduct(MeVector4 r, const MeVector4 p, const MeVector4 q);
/** Spherical linear interpolation along the shorter arc: 0 gives @a from, 1 gives @a to (or its negative), other
 *  numbers extrapolate. Both must have length 1; so has the result. */
MEPUBLIC void MEAPI MeQuaternionSlerp(MeVector4 q, const MeVector4 from, const MeVector4 to, const MeReal howFar);
/** @} */

/** @name Quaternions in motion
 *  For a body with the orientation q and the angular velocity w, in the world frame, radians per second.
 *  @{ */
/** The time derivative of q: dq = (0, w) q / 2. For q of length 1. */
MEPUBLIC void MEAPI MeQuaternionWtoDQ(MeVector4 dq, const MeVector4 q, const MeVector3 w);
/** The 3 x 4 matrix D, row by row, with dq = D^T w / 2 and w = 2 D dq. For q of length 1. */
MEPUBLIC void MEAPI MeQuaternionToD(MeReal D[12], const MeVector4 q);
/** The orientation after the time h: q = exp(h w) q, exact for any angle, normalized. */
MEPUBLIC void MEAPI MeQuaternionFiniteRotation(MeVector4 q, const MeVector3 w, const MeReal h);
/** @} */

/** @name Matrices of any size, row by row
 *  The result must not overlap the operands. A size below 0 counts as 0.
 *  @{ */
/** A (p x r) = B (p x q) C (q x r) */
MEPUBLIC void MEAPI MeMatrixMultiply(MeReal *A, const int p, const int q, const int r, const MeReal *const B,
                                     const MeReal *const C);
/** A (p x r) = B^T C, where B is q x p and C is q x r. */
MEPUBLIC void MEAPI MeMatrixMultiplyT1(MeReal *A, const int p, const int q, const int r, const MeReal *const B,
                                       const MeReal *const C);
/** A (m x n) = B^T, where B is n x m. */
MEPUBLIC void MEAPI MeMatrixTranspose(MeReal *A, const int n, const int m, const MeReal *const B);
/** Prints n rows of m numbers on stdout, one row per line; format is the printf format of a double (null: "%g "). */
MEPUBLIC void MEAPI MeMatrixPrint(const MeReal *const A, const int n, const int m, const char *const format);
/** The same to a file. */
MEPUBLIC void MEAPI MeMatrixFPrint(FILE *const file, const MeReal *const A, const int n, const int m,
                                   const char *const format);
/** @} */

/** @name Packed triangles
 *  The index of an element of an n x n matrix of which only one triangle is stored, row by row:
 *
 *  @verbatim
 *      UpperDiagonal, n = 4        SuperDiagonal
 *      0 1 2 3                     . 0 1 2
 *        4 5 6                       . 3 4
 *          7 8                         . 5
 *            9                           .
 *  @endverbatim
 *
 *  The Sym functions are for symmetric matrices: an element below the diagonal has the index of its mirror image. An
 *  element that is not stored: warning, and -1.
 *  @{ */
/** Index of an element on or above the diagonal. */
MEPUBLIC int MEAPI MeUpperDiagonalIndex(const int inRow, const int inCol, const int inNCols);
/** Index of any element. */
MEPUBLIC int MEAPI MeSymUpperDiagonalIndex(const int inRow, const int inCol, const int inNCols);
MEPUBLIC int MEAPI MeUpperDiagonalSize(const int inNCols); /**< How many numbers that are. */
/** Index of an element above the diagonal. */
MEPUBLIC int MEAPI MeSuperDiagonalIndex(const int inRow, const int inCol, const int inNCols);
/** Index of any element off the diagonal. */
MEPUBLIC int MEAPI MeSymSuperDiagonalIndex(const int inRow, const int inCol, const int inNCols);
MEPUBLIC int MEAPI MeSuperDiagonalSize(const int inNCols); /**< How many numbers that are. */
/** @} */

ME_END_C

#endif
