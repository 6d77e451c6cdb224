/* API of the skeletal joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Skeletal, MdtBclSKELETAL)

static MdtBclSkeletal *skeletalOf(MdtSkeletalID j, const char *caller) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSKELETAL, caller);
    return c ? &c->bcl.of.skeletal : NULL;
}

/* ---- angles ---- */

void MEAPI MdtSkeletalSetConePrimaryLimitAngle(const MdtSkeletalID j, const MeReal theta) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setAngle(__func__, "the angle", s ? &s->primary : NULL, theta);
}

MeReal MEAPI MdtSkeletalGetConePrimaryLimitAngle(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->primary : 0;
}

void MEAPI MdtSkeletalSetConeSecondaryLimitAngle(const MdtSkeletalID j, const MeReal theta) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setAngle(__func__, "the angle", s ? &s->secondary : NULL, theta);
}

MeReal MEAPI MdtSkeletalGetConeSecondaryLimitAngle(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->secondary : 0;
}

void MEAPI MdtSkeletalSetTwistLimitAngle(const MdtSkeletalID j, const MeReal theta) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setAngle(__func__, "the angle", s ? &s->twist : NULL, theta);
}

MeReal MEAPI MdtSkeletalGetTwistLimitAngle(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->twist : 0;
}

/* ---- compliance ---- */

void MEAPI MdtSkeletalSetConeStiffness(const MdtSkeletalID j, const MeReal kp) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setNonNegative(__func__, "the stiffness", s ? &s->coneStiffness : NULL, kp);
}

MeReal MEAPI MdtSkeletalGetConeStiffness(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->coneStiffness : 0;
}

void MEAPI MdtSkeletalSetConeDamping(const MdtSkeletalID j, const MeReal kd) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setNonNegative(__func__, "the damping", s ? &s->coneDamping : NULL, kd);
}

MeReal MEAPI MdtSkeletalGetConeDamping(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->coneDamping : 0;
}

void MEAPI MdtSkeletalSetTwistStiffness(const MdtSkeletalID j, const MeReal kp) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setNonNegative(__func__, "the stiffness", s ? &s->twistStiffness : NULL, kp);
}

MeReal MEAPI MdtSkeletalGetTwistStiffness(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->twistStiffness : 0;
}

void MEAPI MdtSkeletalSetTwistDamping(const MdtSkeletalID j, const MeReal kd) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    mdt_setNonNegative(__func__, "the damping", s ? &s->twistDamping : NULL, kd);
}

MeReal MEAPI MdtSkeletalGetTwistDamping(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->twistDamping : 0;
}

/* ---- options ---- */

void MEAPI MdtSkeletalSetConeOption(const MdtSkeletalID j, MdtSkeletalConeOption co) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    if (!s)
        return;
    if (co < MdtSkeletalConeOptionFree || co > MdtSkeletalConeOptionFixed)
        MeWarning(1, "MdtSkeletalSetConeOption: there is no option %d; nothing is changed", (int)co);
    else
        s->coneOption = co;
}

MdtSkeletalConeOption MEAPI MdtSkeletalGetConeOption(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->coneOption : MdtSkeletalConeOptionFree;
}

void MEAPI MdtSkeletalSetTwistOption(const MdtSkeletalID j, MdtSkeletalTwistOption to) {
    MdtBclSkeletal *s = skeletalOf(j, __func__);
    if (!s)
        return;
    if (to < MdtSkeletalTwistOptionFree || to > MdtSkeletalTwistOptionFixed)
        MeWarning(1, "MdtSkeletalSetTwistOption: there is no option %d; nothing is changed", (int)to);
    else
        s->twistOption = to;
}

MdtSkeletalTwistOption MEAPI MdtSkeletalGetTwistOption(const MdtSkeletalID j) {
    const MdtBclSkeletal *s = skeletalOf(j, __func__);
    return s ? s->twistOption : MdtSkeletalTwistOptionFree;
}

void MEAPI MdtSkeletalZeroTwist(const MdtSkeletalID j) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclSKELETAL, __func__);
    MdtKeaTransformation of[2];
    if (!c)
        return;
    mdt_constraintPoses(&c->base, of);
    const MdtKeaTransformation *pose[2] = {&of[0], &of[1]};
    MdtBclSkeletalZeroTwist(&c->bcl, pose);
}
