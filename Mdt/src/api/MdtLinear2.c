/* API of the Linear2 joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Linear2, MdtBclLINEAR2)

void MEAPI MdtLinear2SetDirection(const MdtLinear2ID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclLINEAR2, __func__);
    if (c)
        mdt_constraintSetAxis(&c->base, x, y, z, __func__);
}

void MEAPI MdtLinear2GetDirection(const MdtLinear2ID j, MeVector3 direction) {
    MdtJoint *c = mdt_isResult(__func__, direction, 3) ? mdt_jointOfType(j, MdtBclLINEAR2, __func__) : NULL;
    if (c)
        MdtConstraintGetAxis(&c->base, direction);
}
