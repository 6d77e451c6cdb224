/* The hinge's part of the API. */
#include "mdt_i.h"

MdtHingeID MEAPI MdtHingeCreate(const MdtWorldID w) {
    return (MdtHingeID)mdt_constraintCreate(w, MdtBclHINGE, __func__);
}

void MEAPI MdtHingeReset(const MdtHingeID j) {
    MdtConstraintID c = mdt_constraintOfType(j, MdtBclHINGE, __func__);
    if (c)
        c->type->reset(&c->bcl);
}

MdtConstraintID MEAPI MdtHingeQuaConstraint(const MdtHingeID j) {
    return (MdtConstraintID)j;
}

MdtHingeID MEAPI MdtConstraintDCastHinge(const MdtConstraintID c) {
    return mdt_constraintCast(c, MdtBclHINGE, __func__);
}

MdtLimitID MEAPI MdtHingeGetLimit(const MdtHingeID j) {
    MdtConstraintID c = mdt_constraintOfType(j, MdtBclHINGE, __func__);
    return c ? &c->bcl.of.limit : NULL;
}

void MEAPI MdtHingeSetLimit(const MdtHingeID j, const MdtLimitID NewLimit) {
    MdtConstraintID c = mdt_constraintOfType(j, MdtBclHINGE, __func__);
    if (c && mdt_isPointer(__func__, "the limit", NewLimit))
        mdt_limitAssign(&c->bcl.of.limit, NewLimit);
}
