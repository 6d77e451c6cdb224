/* API of the FPFO joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(FPFOJoint, MdtBclFPFOJOINT)

void MEAPI MdtFPFOJointSetPosition(const MdtFPFOJointID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclFPFOJOINT, __func__);
    if (c)
        mdt_constraintSetPosition(&c->base, x, y, z, __func__);
}

void MEAPI MdtFPFOJointGetPosition(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 pos) {
    MdtJoint *c = mdt_isResult(__func__, pos, 3) ? mdt_jointOfType(j, MdtBclFPFOJOINT, __func__) : NULL;
    if (c)
        MdtConstraintBodyGetPosition(&c->base, bodyindex, pos);
}
