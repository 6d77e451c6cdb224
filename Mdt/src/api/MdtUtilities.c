/* Inertia tensors, changing frames, and a position controller for limits. */
#include "api/mdt_api_i.h"
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

/* Converts a vector from one body's frame to another's, by way of the world. w: 1 for a point, 0 for a direction. */
static void convertVector(MdtBodyID from, const MeVector3 f, MdtBodyID to, MeVector3 t, double w) {
    double given[3], world[3], result[3];
    mdt_fromReal(given, f);
    keaCopy(world, given);
    if (from) {
        const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(from);
        for (int i = 0; i < 3; i++)
            world[i] = given[0] * (double)tm[0][i] + given[1] * (double)tm[1][i] + given[2] * (double)tm[2][i] +
                       w * (double)tm[3][i];
    }
    keaCopy(result, world);
    if (to) {
        const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(to);
        for (int i = 0; i < 3; i++)
            world[i] -= w * (double)tm[3][i];
        for (int i = 0; i < 3; i++)
            result[i] = world[0] * (double)tm[i][0] + world[1] * (double)tm[i][1] + world[2] * (double)tm[i][2];
    }
    mdt_toReal(t, result);
}

static MeBool mayConvert(const char *caller, MdtBodyID from, const MeReal *f, MdtBodyID to, const MeReal *t) {
    return mdt_isPointer(caller, "the vector", f) && mdt_isPointer(caller, "the result", t) &&
           mdt_isFinite3(caller, "the vector", f[0], f[1], f[2]) && (!from || mdt_isBody(from, caller)) &&
           (!to || mdt_isBody(to, caller));
}

void MEAPI MdtConvertPositionVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body,
                                    MeVector3 t) {
    if (mayConvert(__func__, from_body, f, to_body, t))
        convertVector(from_body, f, to_body, t, 1);
}

void MEAPI MdtConvertVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body, MeVector3 t) {
    if (mayConvert(__func__, from_body, f, to_body, t))
        convertVector(from_body, f, to_body, t, 0);
}

void MEAPI MdtLimitController(const MdtLimitID limit, const MeReal desiredPosition, const MeReal gap,
                              const MeReal maxSpeed, const MeReal maxForce) {
    if (!mdt_isPointer(__func__, "the limit", limit) || !mdt_isFinite(__func__, "the position", desiredPosition) ||
        !mdt_isPositive(__func__, "the gap", gap) || !mdt_isNotBelow(__func__, "the speed", maxSpeed, 0))
        return;
    const MeReal left = (desiredPosition - limit->position) / gap;
    const MeReal share = left > 1 ? 1 : left < -1 ? -1 : left;
    MdtLimitSetLimitedForceMotor(limit, share * maxSpeed, maxForce);
}
