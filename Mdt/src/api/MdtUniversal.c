/* API of the universal joint: axis 0 is the primary axis of frame 0, axis 1 the second axis of frame 1. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Universal, MdtBclUNIVERSAL)

void MEAPI MdtUniversalSetAxis(const MdtUniversalID j, const unsigned int bodyindex, const MeReal Ax, const MeReal Ay,
                               const MeReal Az) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclUNIVERSAL, __func__);
    if (c && mdt_isSide(__func__, bodyindex))
        mdt_constraintSetCrossAxis(&c->base, __func__, (int)bodyindex, Ax, Ay, Az);
}

void MEAPI MdtUniversalGetAxis(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 axis) {
    MdtJoint *c = mdt_isResult(__func__, axis, 3) ? mdt_jointOfType(j, MdtBclUNIVERSAL, __func__) : NULL;
    if (c && mdt_isSide(__func__, bodyindex))
        MdtConstraintBodyGetAxes(&c->base, bodyindex, bodyindex == 0 ? axis : NULL, bodyindex == 0 ? NULL : axis);
}
