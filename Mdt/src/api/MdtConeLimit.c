/* API of the cone limit. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(ConeLimit, MdtBclCONELIMIT)

static MdtBclCone *coneOf(MdtConeLimitID j, const char *caller) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclCONELIMIT, caller);
    return c ? &c->bcl.of.cone : NULL;
}

void MEAPI MdtConeLimitSetConeHalfAngle(const MdtConeLimitID j, const MeReal theta) {
    MdtBclCone *s = coneOf(j, __func__);
    mdt_setAngle(__func__, "the half angle", s ? &s->limit.limit[1].stop : NULL, theta);
}

MeReal MEAPI MdtConeLimitGetConeHalfAngle(const MdtConeLimitID j) {
    const MdtBclCone *s = coneOf(j, __func__);
    return s ? s->limit.limit[1].stop : 0;
}

void MEAPI MdtConeLimitSetStiffness(const MdtConeLimitID j, const MeReal kp) {
    MdtBclCone *s = coneOf(j, __func__);
    mdt_setNonNegative(__func__, "the stiffness", s ? &s->stiffness : NULL, kp);
}

MeReal MEAPI MdtConeLimitGetStiffness(const MdtConeLimitID j) {
    const MdtBclCone *s = coneOf(j, __func__);
    return s ? s->stiffness : 0;
}

void MEAPI MdtConeLimitSetDamping(const MdtConeLimitID j, const MeReal kd) {
    MdtBclCone *s = coneOf(j, __func__);
    mdt_setNonNegative(__func__, "the damping", s ? &s->damping : NULL, kd);
}

MeReal MEAPI MdtConeLimitGetDamping(const MdtConeLimitID j) {
    const MdtBclCone *s = coneOf(j, __func__);
    return s ? s->damping : 0;
}
