/* API of the angular joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Angular3, MdtBclANGULAR3)

MDT_JOINT_DATA(Angular3, MdtBclANGULAR3, MdtBclAngular, angular)

void MEAPI MdtAngular3EnableRotation(const MdtAngular3ID j, const MeBool NewRotationState) {
    Data *joint = dataOf(j, __func__);
    if (joint)
        joint->rotates = NewRotationState != 0;
}

MeBool MEAPI MdtAngular3RotationIsEnabled(const MdtAngular3ID j) {
    const Data *joint = dataOf(j, __func__);
    return joint && joint->rotates;
}

MDT_JOINT_PROPERTY(Angular3, Stiffness, mdt_setNonNegative, "the stiffness", stiffness)
MDT_JOINT_PROPERTY(Angular3, Damping, mdt_setNonNegative, "the damping", damping)
