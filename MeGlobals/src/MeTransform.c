/* Rigid transforms as MeMatrix4: tm[j][i] = R[i][j], tm[3] = X, for y = R x + X. */
#include "MeMath.h"

#include "MeMessage.h"
#include <string.h>

/* ---- making, reading and changing ---- */

void MEAPI MeMatrix4TMMakeIdentity(MeMatrix4 tm) {
    MeMatrix4SetZero(tm);
    for (int i = 0; i < 4; i++)
        tm[i][i] = 1;
}

void MEAPI MeMatrix4TMMakeFromRotationAndPosition(MeMatrix4 A, const MeMatrix3 R, const MeReal x, const MeReal y,
                                                  const MeReal z) {
    MeMatrix4TMMakeIdentity(A);
    MeMatrix4TMSetRotation(A, R);
    MeMatrix4TMSetPosition(A, x, y, z);
}

void MEAPI MeMatrix4TMFromEulerAnglesAndPosition(MeMatrix4 tm, const MeReal xangle, const MeReal yangle,
                                                 const MeReal zangle, const MeReal x, const MeReal y, const MeReal z) {
    MeMatrix3 R;
    MeMatrix3FromEulerAngles(R, xangle, yangle, zangle);
    MeMatrix4TMMakeFromRotationAndPosition(tm, (const MeVector3 *)R, x, y, z);
}

void MEAPI MeMatrix4TMSetPosition(MeMatrix4 tm, MeReal x, MeReal y, MeReal z) {
    MeVector3Set(tm[3], x, y, z);
}

void MEAPI MeMatrix4TMSetRotation(MeMatrix4 tm, const MeMatrix3 R) {
    for (int i = 0; i < 3; i++)
        MeVector3Set(tm[i], R[0][i], R[1][i], R[2][i]);
}

void MEAPI MeMatrix4TMGetRotation(MeMatrix3 R, const MeMatrix4 tm) {
    for (int i = 0; i < 3; i++)
        MeVector3Set(R[i], tm[0][i], tm[1][i], tm[2][i]);
}

void MEAPI MeMatrix4TMSetRotationFromQuaternion(MeMatrix4 tm, const MeVector4 q) {
    MeMatrix3 R;
    MeQuaternionToR(R, q);
    MeMatrix4TMSetRotation(tm, (const MeVector3 *)R);
}

void MEAPI MeMatrix4TMOrthoNormalize(MeMatrix4 tm) {
    MeVector3 x, y;
    MeVector3Copy(x, tm[0]);
    MeVector3Copy(y, tm[1]);
    if (MeVector3Normalize(x) > 0 && MeVector3Normalize(y) > 0) {
        MeVector3MakeOrthogonal(y, x);
        if (MeVector3Normalize(y) > 8 * ME_EPSILON) { /* smaller values are rounding errors of y */
            MeVector3Copy(tm[0], x);
            MeVector3Copy(tm[1], y);
            MeVector3Cross(tm[2], x, y);
            return;
        }
    }
    MeWarning(1, "MeMatrix4TMOrthoNormalize: the x and y axes do not span a plane, the matrix is not changed");
}

/* ---- using ---- */

void MEAPI MeMatrix4TMTransform(MeVector3 out, const MeMatrix4 tm, const MeVector3 in) {
    MeVector3 t;
    MeMatrix4TMRotate(t, tm, in);
    MeVector3Add(out, t, tm[3]);
}

void MEAPI MeMatrix4TMInverseTransform(MeVector3 out, const MeMatrix4 tm, const MeVector3 in) {
    MeVector3 t;
    MeVector3Subtract(t, in, tm[3]);
    MeMatrix4TMInverseRotate(out, tm, t);
}

void MEAPI MeMatrix4TMRotate(MeVector3 out, const MeMatrix4 tm, const MeVector3 in) {
    MeVector3 t;
    for (int i = 0; i < 3; i++)
        t[i] = in[0] * tm[0][i] + in[1] * tm[1][i] + in[2] * tm[2][i];
    MeVector3Copy(out, t);
}

void MEAPI MeMatrix4TMInverseRotate(MeVector3 out, const MeMatrix4 tm, const MeVector3 in) {
    const MeVector3 t = {MeVector3Dot(tm[0], in), MeVector3Dot(tm[1], in), MeVector3Dot(tm[2], in)};
    MeVector3Copy(out, t);
}

void MEAPI MeMatrix4TMInvert(MeMatrix4 tm) {
    MeVector3 position;
    for (int i = 0; i < 3; i++)
        position[i] = -MeVector3Dot(tm[i], tm[3]);
    for (int i = 0; i < 3; i++)
        MeRealSwap(&tm[i][NextMod3(i)], &tm[NextMod3(i)][i]);
    MeMatrix4TMSetPositionVector(tm, position);
}

void MEAPI MeMatrix4TMCompound(MeMatrix4 A, const MeMatrix4 B, const MeMatrix4 C) {
    MeMatrix4 t;
    MeMatrix4TMMakeIdentity(t);
    for (int i = 0; i < 3; i++)
        MeMatrix4TMRotate(t[i], C, B[i]);
    MeMatrix4TMTransform(t[3], C, B[3]);
    memcpy(A, t, sizeof t);
}

/* ---- moving ---- */

void MEAPI MeMatrix4TMUpdateFromVelocities(MeMatrix4 aTransformReturn, MeReal aEpsilon, MeReal aTimeStep,
                                           const MeVector3 aVelocity, const MeVector3 aAngularVelocity,
                                           const MeMatrix4 aTransform) {
    const MeVector3 none = {0, 0, 0};
    MeMatrix4TMUpdateFromVelocitiesAndAcceler(aTransformReturn, aEpsilon, aTimeStep, aVelocity, none, aAngularVelocity,
                                              none, aTransform);
}

void MEAPI MeMatrix4TMUpdateFromVelocitiesAndAcceler(MeMatrix4 aTransformReturn, MeReal aEpsilon, MeReal aTimeStep,
                                                     const MeVector3 aVelocity, const MeVector3 aAcceler,
                                                     const MeVector3 aAngularVelocity, const MeVector3 aAngularAcceler,
                                                     const MeMatrix4 aTransform) {
    const MeReal h = aTimeStep, half = h * h / 2;
    MeVector3 turn;
    MeVector4 q = {1, 0, 0, 0};
    MeMatrix4Copy(aTransformReturn, aTransform);
    for (int i = 0; i < 3; i++) {
        aTransformReturn[3][i] += h * aVelocity[i] + half * aAcceler[i];
        turn[i] = h * aAngularVelocity[i] + half * aAngularAcceler[i];
    }
    if (MeVector3Magnitude(turn) < aEpsilon)
        return;
    MeQuaternionFiniteRotation(q, turn, 1);
    for (int i = 0; i < 3; i++)
        MeQuaternionRotateVector3(aTransformReturn[i], q, aTransformReturn[i]);
}
