/* Inertia tensors, changing frames, and a position controller for limits. */
#include "mdt_i.h"
#include <string.h>

static void setDiagonal(MeMatrix3 i, MeReal x, MeReal y, MeReal z) {
    memset(i, 0, sizeof(MeMatrix3));
    i[0][0] = x, i[1][1] = y, i[2][2] = z;
}

void MEAPI MdtMakeInertiaTensorSphere(const MeReal mass, const MeReal radius, MeMatrix3 i) {
    if (!mdt_isPointer(__func__, "the result", i))
        return;
    setDiagonal(i, 1, 1, 1);
    if (!mdt_isPositive(__func__, "the mass", mass) || !mdt_isPositive(__func__, "the radius", radius))
        return;
    const MeReal moment = (MeReal)0.4 * mass * radius * radius;
    setDiagonal(i, moment, moment, moment);
}

void MEAPI MdtMakeInertiaTensorBox(const MeReal mass, const MeReal lx, const MeReal ly, const MeReal lz, MeMatrix3 i) {
    if (!mdt_isPointer(__func__, "the result", i))
        return;
    setDiagonal(i, 1, 1, 1);
    if (!mdt_isPositive(__func__, "the mass", mass) || !mdt_isPositive(__func__, "an edge", lx) ||
        !mdt_isPositive(__func__, "an edge", ly) || !mdt_isPositive(__func__, "an edge", lz))
        return;
    const MeReal k = mass / 12;
    setDiagonal(i, k * (ly * ly + lz * lz), k * (lx * lx + lz * lz), k * (lx * lx + ly * ly));
}

/* Between the frames of two bodies by way of the world; `w` is 1 for a point and 0 for a direction. */
static void convert(MdtBodyID from, const MeVector3 f, MdtBodyID to, MeVector3 t, MeReal w) {
    MeVector3 world = {f[0], f[1], f[2]};
    if (from) {
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(from);
        for (int i = 0; i < 3; i++)
            world[i] = f[0] * tm[0][i] + f[1] * tm[1][i] + f[2] * tm[2][i] + w * tm[3][i];
    }
    if (!to) {
        memcpy(t, world, sizeof world);
        return;
    }
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(to);
    for (int i = 0; i < 3; i++)
        t[i] = (world[0] - w * tm[3][0]) * tm[i][0] + (world[1] - w * tm[3][1]) * tm[i][1] +
               (world[2] - w * tm[3][2]) * tm[i][2];
}

static MeBool mayConvert(const char *caller, MdtBodyID from, const MeReal *f, MdtBodyID to, const MeReal *t) {
    return mdt_isPointer(caller, "the vector", f) && mdt_isPointer(caller, "the result", t) &&
           (!from || mdt_isBody(from, caller)) && (!to || mdt_isBody(to, caller));
}

void MEAPI MdtConvertPositionVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body,
                                    MeVector3 t) {
    if (mayConvert(__func__, from_body, f, to_body, t))
        convert(from_body, f, to_body, t, 1);
}

void MEAPI MdtConvertVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body, MeVector3 t) {
    if (mayConvert(__func__, from_body, f, to_body, t))
        convert(from_body, f, to_body, t, 0);
}

void MEAPI MdtLimitController(const MdtLimitID limit, const MeReal desiredPosition, const MeReal gap,
                              const MeReal maxSpeed, const MeReal maxForce) {
    if (!mdt_isPointer(__func__, "the limit", limit) || !mdt_isFinite(__func__, "the position", desiredPosition) ||
        !mdt_isPositive(__func__, "the gap", gap) || !mdt_isAtLeast(__func__, "the speed", maxSpeed, 0))
        return;
    const MeReal left = (desiredPosition - limit->position) / gap;
    const MeReal share = left > 1 ? 1 : left < -1 ? -1 : left;
    MdtLimitSetLimitedForceMotor(limit, share * maxSpeed, maxForce);
}
