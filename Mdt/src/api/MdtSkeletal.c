/* API of the skeletal joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Skeletal, MdtBclSKELETAL)
MDT_JOINT_TURN_MOTOR(Skeletal, MdtBclSKELETAL, skeletal.servo)

MDT_JOINT_DATA(Skeletal, MdtBclSKELETAL, MdtBclSkeletal, skeletal)

/* ---- angles ---- */

MDT_JOINT_PROPERTY(Skeletal, ConePrimaryLimitAngle, mdt_setAngle, "the angle", primary)
MDT_JOINT_PROPERTY(Skeletal, ConeSecondaryLimitAngle, mdt_setAngle, "the angle", secondary)
MDT_JOINT_PROPERTY(Skeletal, TwistLimitAngle, mdt_setAngle, "the angle", twist)

/* ---- compliance ---- */

MDT_JOINT_PROPERTY(Skeletal, ConeStiffness, mdt_setNonNegative, "the stiffness", coneStiffness)
MDT_JOINT_PROPERTY(Skeletal, ConeDamping, mdt_setNonNegative, "the damping", coneDamping)
MDT_JOINT_PROPERTY(Skeletal, TwistStiffness, mdt_setNonNegative, "the stiffness", twistStiffness)
MDT_JOINT_PROPERTY(Skeletal, TwistDamping, mdt_setNonNegative, "the damping", twistDamping)

/* ---- options ---- */

void MEAPI MdtSkeletalSetConeOption(const MdtSkeletalID j, MdtSkeletalConeOption co) {
    Data *s = dataOf(j, __func__);
    if (!s)
        return;
    if (co < MdtSkeletalConeOptionFree || co > MdtSkeletalConeOptionFixed)
        MeWarning(1, "MdtSkeletalSetConeOption: there is no option %d; nothing is changed", (int)co);
    else
        s->coneOption = co;
}

MdtSkeletalConeOption MEAPI MdtSkeletalGetConeOption(const MdtSkeletalID j) {
    const Data *s = dataOf(j, __func__);
    return s ? s->coneOption : MdtSkeletalConeOptionFree;
}

void MEAPI MdtSkeletalSetTwistOption(const MdtSkeletalID j, MdtSkeletalTwistOption to) {
    Data *s = dataOf(j, __func__);
    if (!s)
        return;
    if (to < MdtSkeletalTwistOptionFree || to > MdtSkeletalTwistOptionFixed)
        MeWarning(1, "MdtSkeletalSetTwistOption: there is no option %d; nothing is changed", (int)to);
    else
        s->twistOption = to;
}

MdtSkeletalTwistOption MEAPI MdtSkeletalGetTwistOption(const MdtSkeletalID j) {
    const Data *s = dataOf(j, __func__);
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
