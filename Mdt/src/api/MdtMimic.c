/* API of the mimic. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Mimic, MdtBclMIMIC)
MDT_JOINT_DATA(Mimic, MdtBclMIMIC, MdtBclCoupling, coupling)

/* The joint if its coordinate can be mimicked; else null, with a warning. */
static MdtJoint *sourceOf(MdtMimicID mimic, MdtConstraintID c, const char *caller) {
    const MdtBclJointType type = mdt_isConstraint(c, caller) ? mdt_constraintType(c) : MdtBclMIMIC;
    if (!c || !MdtConstraintIsValid(c))
        return NULL; /* was warned of */
    if (type != MdtBclHINGE && type != MdtBclPRISMATIC && type != MdtBclCARWHEEL)
        MeWarning(1, "%s: a %s has no coordinate to mimic; pass a Hinge, a Prismatic or a CarWheel", caller,
                  mdt_constraintName(c));
    else if (c->world != ((MdtConstraintID)mimic)->world)
        MeWarning(1, "%s: the %s belongs to another world; nothing is changed", caller, mdt_constraintName(c));
    else if (!c->side[0].body && !c->side[1].body)
        MeWarning(1, "%s: the %s is attached to no body; attach it first", caller, mdt_constraintName(c));
    else
        return mdt_asJoint(c);
    return NULL;
}

void MEAPI MdtMimicSetJoints(const MdtMimicID j, const MdtConstraintID first, const MdtConstraintID second) {
    Data *d = dataOf(j, __func__);
    MdtJoint *source[2] = {d ? sourceOf(j, first, __func__) : NULL, NULL};
    MdtBodyID bodies[2] = {NULL, NULL};
    source[1] = source[0] ? sourceOf(j, second, __func__) : NULL;
    if (!source[1])
        return;
    if (source[0] == source[1]) {
        MeWarning(1, "%s: the two joints are the same; nothing is changed", __func__);
        return;
    }
    mdt_mimicFindBodies(source, bodies);
    for (int i = 0; i < 2; i++) {
        d->joint[i] = source[i];
        d->coordinate[i].isMeasured = MEFALSE;
    }
    mdt_constraintSetBodies((MdtConstraintID)j, bodies[0], bodies[1], __func__);
}

MdtConstraintID MEAPI MdtMimicGetJoint(const MdtMimicID j, const unsigned int jointindex) {
    const Data *d = dataOf(j, __func__);
    const MdtJoint *source = d && mdt_isSide(__func__, jointindex) ? d->joint[jointindex] : NULL;
    return source ? (MdtConstraintID)(uintptr_t)&source->base : NULL;
}

void MEAPI MdtMimicSetRatio(const MdtMimicID j, const MeReal ratio) {
    Data *d = dataOf(j, __func__);
    if (d && mdt_isFinite3(__func__, "the ratio", ratio, 0, 0))
        d->coordinate[0].factor = -(double)ratio;
}

MDT_JOINT_GETTER(Mimic, Ratio, (MeReal)-d->coordinate[0].factor)

void MEAPI MdtMimicSetOffset(const MdtMimicID j, const MeReal offset) {
    Data *d = dataOf(j, __func__);
    if (d && mdt_isFinite3(__func__, "the offset", offset, 0, 0))
        d->offset = offset;
}

MDT_JOINT_GETTER(Mimic, Offset, (MeReal)d->offset)
