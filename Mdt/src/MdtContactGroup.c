/* Contact groups: the contacts of a manifold, as programs see them. */
#include "mdt_manifold_i.h"
#include "MeAssert.h"

MdtContactGroupID MEAPI MdtContactGroupCreate(const MdtWorldID w) {
    return (MdtContactGroupID)mdt_manifoldCreate(w, __func__);
}

void MEAPI MdtContactGroupReset(const MdtContactGroupID c) {
    MdtManifold *group = mdt_groupOf(c, __func__);
    if (group)
        mdt_manifoldClear(group);
}

MdtConstraintID MEAPI MdtContactGroupQuaConstraint(const MdtContactGroupID c) {
    return (MdtConstraintID)c;
}

MdtContactGroupID MEAPI MdtConstraintDCastContactGroup(const MdtConstraintID c) {
    return mdt_isConstraint(c, __func__) && mdt_isManifold(c) ? (MdtContactGroupID)c : NULL;
}

/* A contact that is in the group, or null with a warning. */
static MdtPoint *memberOf(MdtManifold *group, const MdtContactID c, const char *caller) {
    MdtPoint *p = group ? mdt_pointOf(c, caller) : NULL;
    if (!p || mdt_manifoldOf(p) == group)
        return p;
    MeWarning(1, "%s: the contact is not in this group", caller);
    return NULL;
}

/* ---- the list ---- */

MdtContactID MEAPI MdtContactGroupGetFirstContact(MdtContactGroupID c) {
    MdtManifold *group = mdt_groupOf(c, __func__);
    return group ? (MdtContactID)mdt_pointFirst(group) : NULL;
}

MdtContactID MEAPI MdtContactGroupGetNextContact(MdtContactGroupID g, MdtContactID c) {
    const MdtPoint *p = memberOf(mdt_groupOf(g, __func__), c, __func__);
    return p ? (MdtContactID)mdt_pointAfter(p) : NULL;
}

int MEAPI MdtContactGroupGetCount(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    return group ? group->numPoints : 0;
}

MdtContactID MEAPI MdtContactGroupCreateContact(MdtContactGroupID g) {
    MdtManifold *group = mdt_groupOf(g, __func__);
    return group ? (MdtContactID)mdt_pointCreateIn(group, __func__) : NULL;
}

void MEAPI MdtContactGroupAppendContact(MdtContactGroupID g, MdtContactID c) {
    MdtManifold *group = mdt_groupOf(g, __func__);
    MdtPoint *p = group ? mdt_pointOf(c, __func__) : NULL;
    if (!p)
        return;
    const MeBool isInGroup = mdt_isInGroup(p);
    if (isInGroup || mdt_blockOf(p)->base.world != group->base.world)
        MeWarning(1, "MdtContactGroupAppendContact: the contact is %s; nothing is changed",
                  isInGroup ? "in a group already" : "of another world");
    else
        mdt_pointJoin(p, group);
}

void MEAPI MdtContactGroupRemoveContact(MdtContactGroupID g, MdtContactID c) {
    MdtPoint *p = memberOf(mdt_groupOf(g, __func__), c, __func__);
    if (p && !mdt_pointIsAlone(p))
        MeWarning(1, "MdtContactGroupRemoveContact: the contact was made by a bridge, and lives in its group only; "
                     "nothing is changed");
    else if (p)
        mdt_pointLeave(p);
}

void MEAPI MdtContactGroupDestroyContact(MdtContactGroupID g, MdtContactID c) {
    MdtPoint *p = memberOf(mdt_groupOf(g, __func__), c, __func__);
    if (p)
        mdt_pointTerm(p);
}

/* ---- the rest ---- */

MeReal MEAPI MdtContactGroupGetNormalForce(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    double sum[3] = {0, 0, 0};
    for (const MdtPoint *p = group ? mdt_pointFirst(group) : NULL; p; p = mdt_pointAfter(p)) {
        double normal[3], mean[3];
        mdt_pointNormal(p, normal);
        mdt_fromReal(mean, p->mean);
        keaAddScaled(sum, keaDot(mean, normal), normal);
    }
    return (MeReal)keaLength(sum);
}

MeBool MEAPI MdtContactGroupIsSwapped(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    return group && (group->base.record.flags & MDT_SWAPPED);
}

void MEAPI MdtContactGroupSetGenerator(MdtContactGroupID g, void *generator) {
    MdtManifold *group = mdt_groupOf(g, __func__);
    if (group)
        group->generator = generator;
}

void MEAPI MdtContactGroupSetHolder(MdtContactGroupID g, void **holder) {
    MdtManifold *group = mdt_groupOf(g, __func__);
    if (group)
        group->holder = holder;
}

void *MEAPI MdtContactGroupGetGenerator(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    return group ? group->generator : NULL;
}
