/* API of the fixed-path joint. Its numbers are in the bodies' frames; those of Bcl are in the frames of the centres of
 * mass. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(FixedPath, MdtBclFIXEDPATH)

/* The joint, if the handle and the body index are valid; otherwise null, with a warning. */
static MdtJoint *jointOf(MdtFixedPathID path, unsigned int bodyindex, const char *caller) {
    MdtJoint *j = mdt_jointOfType(path, MdtBclFIXEDPATH, caller);
    return j && mdt_isSide(caller, bodyindex) ? j : NULL;
}

/* Rotates a vector between the body's frame and the axes of its centre of mass; the world has the same for both. */
static void rotate(const MdtBodyID b, MeBool isToCentre, const double in[3], double out[3]) {
    double R[3][3];
    keaCopy(out, in);
    if (!b)
        return;
    keaQuaternionToMatrix(R, b->centre.quaternion);
    (isToCentre ? keaApplyTransposed : keaApply)(out, (const double(*)[3])R, in);
}

void MEAPI MdtFixedPathSetPosition(const MdtFixedPathID path, const unsigned int bodyindex, const MeReal x,
                                   const MeReal y, const MeReal z) {
    MdtJoint *j = jointOf(path, bodyindex, __func__);
    if (!j || !mdt_isPositionValid(__func__, "the position", j->base.world, x, y, z))
        return;
    const MdtBodyID body = j->base.side[bodyindex].body;
    double p[3] = {x, y, z};
    if (body)
        keaSubtract(p, p, body->centre.position);
    rotate(body, METRUE, p, j->bcl.frame[bodyindex].position);
}

void MEAPI MdtFixedPathGetPosition(const MdtFixedPathID path, const unsigned int bodyindex, MeVector3 position) {
    const MdtJoint *j = mdt_isResult(__func__, position, 3) ? jointOf(path, bodyindex, __func__) : NULL;
    double p[3];
    if (!j)
        return;
    const MdtBodyID body = j->base.side[bodyindex].body;
    rotate(body, MEFALSE, j->bcl.frame[bodyindex].position, p);
    if (body)
        keaAddScaled(p, 1, body->centre.position);
    mdt_toReal(position, p);
}

void MEAPI MdtFixedPathSetVelocity(const MdtFixedPathID path, const unsigned int bodyindex, const MeReal dx,
                                   const MeReal dy, const MeReal dz) {
    MdtJoint *j = jointOf(path, bodyindex, __func__);
    if (!j || !mdt_isFinite3(__func__, "the velocity", dx, dy, dz))
        return;
    const MdtBodyID body = j->base.side[bodyindex].body;
    const double v[3] = {dx, dy, dz};
    rotate(body, METRUE, v, j->bcl.of.path.velocity[bodyindex]);
}

void MEAPI MdtFixedPathGetVelocity(const MdtFixedPathID path, const unsigned int bodyindex, MeVector3 velocity) {
    const MdtJoint *j = mdt_isResult(__func__, velocity, 3) ? jointOf(path, bodyindex, __func__) : NULL;
    double v[3];
    if (!j)
        return;
    const MdtBodyID body = j->base.side[bodyindex].body;
    rotate(body, MEFALSE, j->bcl.of.path.velocity[bodyindex], v);
    mdt_toReal(velocity, v);
}
