/* API of the prismatic joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Prismatic, MdtBclPRISMATIC)

MdtLimitID MEAPI MdtPrismaticGetLimit(const MdtPrismaticID j) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclPRISMATIC, __func__);
    if (c)
        mdt_constraintMarkWatched(&c->base);
    return c ? &c->bcl.of.limit : NULL;
}

void MEAPI MdtPrismaticSetLimit(const MdtPrismaticID j, const MdtLimitID NewLimit) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclPRISMATIC, __func__);
    if (c && mdt_isPointer(__func__, "the limit", NewLimit))
        mdt_limitAssign(&c->bcl.of.limit, NewLimit);
}
