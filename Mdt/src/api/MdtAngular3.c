/* API of the angular joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Angular3, MdtBclANGULAR3)

static MdtBclAngular *angularOf(MdtAngular3ID j, const char *caller) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclANGULAR3, caller);
    return c ? &c->bcl.of.angular : NULL;
}

void MEAPI MdtAngular3EnableRotation(const MdtAngular3ID j, const MeBool NewRotationState) {
    MdtBclAngular *joint = angularOf(j, __func__);
    if (joint)
        joint->rotates = NewRotationState != 0;
}

MeBool MEAPI MdtAngular3RotationIsEnabled(const MdtAngular3ID j) {
    const MdtBclAngular *joint = angularOf(j, __func__);
    return joint && joint->rotates;
}

void MEAPI MdtAngular3SetStiffness(const MdtAngular3ID j, const MeReal s) {
    MdtBclAngular *joint = angularOf(j, __func__);
    mdt_setNonNegative(__func__, "the stiffness", joint ? &joint->stiffness : NULL, s);
}

MeReal MEAPI MdtAngular3GetStiffness(const MdtAngular3ID j) {
    const MdtBclAngular *joint = angularOf(j, __func__);
    return joint ? joint->stiffness : 0;
}

void MEAPI MdtAngular3SetDamping(const MdtAngular3ID j, const MeReal d) {
    MdtBclAngular *joint = angularOf(j, __func__);
    mdt_setNonNegative(__func__, "the damping", joint ? &joint->damping : NULL, d);
}

MeReal MEAPI MdtAngular3GetDamping(const MdtAngular3ID j) {
    const MdtBclAngular *joint = angularOf(j, __func__);
    return joint ? joint->damping : 0;
}
