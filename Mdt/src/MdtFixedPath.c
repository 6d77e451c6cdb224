/* The fixed-path joint's part of the API. Its numbers are in the bodies' own frames; Bcl's are in those of the centres
 * of mass. */
#include "mdt_i.h"

MDT_JOINT_BASICS(FixedPath, MdtBclFIXEDPATH)

/* The joint's side of that index, or null with a warning. */
static MdtAttachment *sideOf(MdtFixedPathID j, unsigned int bodyindex, const char *caller) {
    MdtConstraintID c = mdt_constraintOfType(j, MdtBclFIXEDPATH, caller);
    return c && mdt_isSide(caller, bodyindex) ? &c->side[bodyindex] : NULL;
}

static void turnToCentre(const MdtBodyID b, const double in[3], double out[3]) {
    double R[3][3];
    if (!b) {
        keaCopy(out, in);
        return;
    }
    keaQuaternionToMatrix(R, b->centreTurn);
    keaApplyTransposed(out, (const double(*)[3])R, in);
}

static void turnFromCentre(const MdtBodyID b, const double in[3], double out[3]) {
    double R[3][3];
    if (!b) {
        keaCopy(out, in);
        return;
    }
    keaQuaternionToMatrix(R, b->centreTurn);
    keaApply(out, (const double(*)[3])R, in);
}

void MEAPI MdtFixedPathSetPosition(const MdtFixedPathID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                                   const MeReal z) {
    MdtAttachment *at = sideOf(j, bodyindex, __func__);
    if (!at || !mdt_isFinite3(__func__, "the position", x, y, z))
        return;
    double p[3] = {x, y, z};
    if (at->body)
        keaSubtract(p, p, at->body->centre);
    turnToCentre(at->body, p, at->constraint->bcl.frame[bodyindex].position);
}

void MEAPI MdtFixedPathGetPosition(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 position) {
    const MdtAttachment *at = mdt_isResult(__func__, position, 3) ? sideOf(j, bodyindex, __func__) : NULL;
    double p[3];
    if (!at)
        return;
    turnFromCentre(at->body, at->constraint->bcl.frame[bodyindex].position, p);
    if (at->body)
        keaAddScaled(p, 1, at->body->centre);
    mdt_toReal(position, p);
}

void MEAPI MdtFixedPathSetVelocity(const MdtFixedPathID j, const unsigned int bodyindex, const MeReal dx,
                                   const MeReal dy, const MeReal dz) {
    MdtAttachment *at = sideOf(j, bodyindex, __func__);
    if (!at || !mdt_isFinite3(__func__, "the velocity", dx, dy, dz))
        return;
    const double v[3] = {dx, dy, dz};
    turnToCentre(at->body, v, at->constraint->bcl.of.path.velocity[bodyindex]);
}

void MEAPI MdtFixedPathGetVelocity(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 velocity) {
    const MdtAttachment *at = mdt_isResult(__func__, velocity, 3) ? sideOf(j, bodyindex, __func__) : NULL;
    double v[3];
    if (!at)
        return;
    turnFromCentre(at->body, at->constraint->bcl.of.path.velocity[bodyindex], v);
    mdt_toReal(velocity, v);
}
