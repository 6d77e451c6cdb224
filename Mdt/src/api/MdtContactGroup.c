/* API of contact groups. A group is a manifold of up to four contacts; further manifolds in a list hold its fifth and
 * later contacts (mdt_manifold_i.h). */
#include "MdtInternal.h"
#include "api/mdt_api_i.h"
#include "MeAssert.h"

MdtContactGroupID MEAPI MdtContactGroupCreate(const MdtWorldID w) {
    return (MdtContactGroupID)mdt_manifoldCreate(w, __func__);
}

void MEAPI MdtContactGroupReset(const MdtContactGroupID c) {
    MdtManifold *group = mdt_groupOf(c, __func__);
    for (MdtPoint *p = group ? mdt_pointFirst(group) : NULL, *next; p; p = next) {
        next = mdt_pointAfter(p);
        if (!p->isCondemned)
            mdt_constraintDestroy((MdtConstraintID)(void *)p, __func__);
    }
}

MdtConstraintID MEAPI MdtContactGroupQuaConstraint(const MdtContactGroupID c) {
    return (MdtConstraintID)c;
}

MdtContactGroupID MEAPI MdtConstraintDCastContactGroup(const MdtConstraintID c) {
    return mdt_isConstraint(c, __func__) && mdt_isManifold(c) ? (MdtContactGroupID)c : NULL;
}

/* The contact if it belongs to the group; otherwise null, with a warning. */
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

/* The contact of a deferred call that moves it into or out of a group. Null if it, or the group, has been destroyed,
 * or if it has no record of its own any more. */
static MdtPoint *deferredMember(const MeLater *later) {
    MdtPoint *p = later->other[0];
    return mdt_deferredConstraint(later) && mdt_isPoint(later->other[0]) && mdt_pointIsAlone(p) ? p : NULL;
}

/* Whether the contact may be moved into or out of the group now. Otherwise the move is deferred, or refused with a
 * message. */
static MeBool mayRegroupNow(MdtManifold *group, MdtPoint *p, void(MEAPI *carryOut)(const MeLater *later),
                            const char *caller) {
    const MeLater later = {.carryOut = carryOut, .object = group, .other = {p}, .serial = group->base.link.serial};
    return mdt_deferIfGuarded(group->base.world, MDT_GUARD_CONSTRAINTS, caller, &later) == MeWhenNow;
}

static void MEAPI applyDeferredJoin(const MeLater *later) {
    MdtPoint *p = deferredMember(later);
    if (p && !mdt_isInGroup(p))
        mdt_pointJoin(p, later->object);
}

static MeBool mayJoin(const MdtPoint *p, const MdtManifold *group) {
    const char *reason = mdt_isInGroup(p)                                  ? "the contact is in a group already"
                         : mdt_blockOf(p)->base.world != group->base.world ? "the contact is of another world"
                         : (group->base.record.flags & MDT_BRIDGED)        ? "the group was made by a bridge"
                                                                           : NULL;
    if (reason)
        MeWarning(1, "MdtContactGroupAppendContact: %s; nothing is changed", reason);
    return !reason;
}

void MEAPI MdtContactGroupAppendContact(MdtContactGroupID g, MdtContactID c) {
    MdtManifold *group = mdt_groupOf(g, __func__);
    MdtPoint *p = group ? mdt_pointOf(c, __func__) : NULL;
    if (p && mayJoin(p, group) && mayRegroupNow(group, p, applyDeferredJoin, __func__))
        mdt_pointJoin(p, group);
}

static void MEAPI applyDeferredLeave(const MeLater *later) {
    MdtPoint *p = deferredMember(later);
    if (p && mdt_manifoldOf(p) == later->object)
        mdt_pointLeave(p);
}

void MEAPI MdtContactGroupRemoveContact(MdtContactGroupID g, MdtContactID c) {
    MdtPoint *p = memberOf(mdt_groupOf(g, __func__), c, __func__);
    if (p && !mdt_pointIsAlone(p))
        MeWarning(1, "MdtContactGroupRemoveContact: the contact was made by a bridge, and lives in its group only; "
                     "nothing is changed");
    else if (p && mayRegroupNow(mdt_manifoldOf(p), p, applyDeferredLeave, __func__))
        mdt_pointLeave(p);
}

void MEAPI MdtContactGroupDestroyContact(MdtContactGroupID g, MdtContactID c) {
    MdtPoint *p = memberOf(mdt_groupOf(g, __func__), c, __func__);
    if (p)
        mdt_constraintDestroy((MdtConstraintID)(void *)p, __func__);
}

/* ---- properties ---- */

MeReal MEAPI MdtContactGroupGetNormalForce(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    double sum[3] = {0, 0, 0};
    for (const MdtPoint *p = group ? mdt_pointFirst(group) : NULL; p; p = mdt_pointAfter(p)) {
        double normal[3], mean[3];
        mdt_pointNormal(p, normal);
        mdt_fromReal(mean, p->mean);
        keaAddScaled(sum, keaDot(mean, normal), normal);
    }
    return mdt_real(keaLength(sum));
}

MeBool MEAPI MdtContactGroupIsSwapped(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    return group && (group->base.record.flags & MDT_SWAPPED);
}

/* The group if the program made it; null, with a warning, for a group of the bridge. */
static MdtManifold *ownGroup(MdtContactGroupID g, const char *caller) {
    MdtManifold *group = mdt_groupOf(g, caller);
    if (!group || !(group->base.record.flags & MDT_BRIDGED))
        return group;
    MeWarning(1, "%s: the group was made by a bridge; nothing is changed", caller);
    return NULL;
}

void MEAPI MdtContactGroupSetGenerator(MdtContactGroupID g, void *generator) {
    MdtManifold *group = ownGroup(g, __func__);
    if (group)
        group->generator = generator;
}

void MEAPI MdtContactGroupSetHolder(MdtContactGroupID g, void **holder) {
    MdtManifold *group = ownGroup(g, __func__);
    if (group)
        group->holder = holder;
}

MeBool MEAPI MdtContactGroupHas(MdtContactGroupID g, MdtContactID c) {
    const MdtPoint *p = (const MdtPoint *)(const void *)c;
    return g && p && p->magic == MDT_POINT && !p->isCondemned && (MdtContactGroupID)mdt_manifoldOf(p) == g;
}

MdtContactGroupID MEAPI MdtContactGroupCreateBridged(const MdtWorldID w, const MdtBodyID b1, const MdtBodyID b2,
                                                     void *generator, void **holder) {
    MdtManifold *group = mdt_manifoldCreate(w, "MdtContactGroupCreate");
    if (!group)
        return NULL;
    MEASSERT(b1 && b1->world == w && b1 != b2 && (!b2 || b2->world == w));
    mdt_constraintAttach(&group->base, b1, b2);
    group->base.record.flags |= MDT_BRIDGED;
    group->generator = generator;
    group->holder = holder;
    return (MdtContactGroupID)group;
}

void *MEAPI MdtContactGroupGetGenerator(MdtContactGroupID g) {
    const MdtManifold *group = mdt_groupOf(g, __func__);
    return group ? group->generator : NULL;
}

MeBool MEAPI MdtContactGroupIsBetween(MdtContactGroupID g, const MdtBodyID b1, const MdtBodyID b2) {
    const MdtManifold *m = mdt_groupOf(g, __func__);
    return m && m->base.side[0].body == b1 && m->base.side[1].body == b2;
}
