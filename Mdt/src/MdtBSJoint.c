/* The ball-and-socket joint's part of the API. */
#include "mdt_i.h"

MdtBSJointID MEAPI MdtBSJointCreate(const MdtWorldID w) {
    return (MdtBSJointID)mdt_constraintCreate(w, MdtBclBSJOINT, __func__);
}

void MEAPI MdtBSJointReset(const MdtBSJointID j) {
    MdtConstraintID c = mdt_constraintOfType(j, MdtBclBSJOINT, __func__);
    if (c)
        c->type->reset(&c->bcl);
}

MdtConstraintID MEAPI MdtBSJointQuaConstraint(const MdtBSJointID j) {
    return (MdtConstraintID)j;
}

MdtBSJointID MEAPI MdtConstraintDCastBSJoint(const MdtConstraintID c) {
    return mdt_constraintCast(c, MdtBclBSJOINT, __func__);
}
