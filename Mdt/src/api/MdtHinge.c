/* API of the hinge. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Hinge, MdtBclHINGE)

MdtLimitID MEAPI MdtHingeGetLimit(const MdtHingeID j) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclHINGE, __func__);
    if (c)
        mdt_constraintMarkWatched(&c->base);
    return c ? &c->bcl.of.limit : NULL;
}

void MEAPI MdtHingeSetLimit(const MdtHingeID j, const MdtLimitID NewLimit) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclHINGE, __func__);
    if (c && mdt_isPointer(__func__, "the limit", NewLimit))
        mdt_limitAssign(&c->bcl.of.limit, NewLimit);
}
