/* Contact groups: the list of contacts that a group owns. */
#include "MeAssert.h"
#include "mdt_i.h"

MdtContactGroupID MEAPI MdtContactGroupCreate(const MdtWorldID w) {
    return (MdtContactGroupID)mdt_constraintCreate(w, MdtBclCONTACTGROUP, __func__);
}

void MEAPI MdtContactGroupReset(const MdtContactGroupID c) {
    MdtConstraintID group = mdt_constraintOfType(c, MdtBclCONTACTGROUP, __func__);
    if (group)
        mdt_groupDestroyContacts(group);
}

MdtConstraintID MEAPI MdtContactGroupQuaConstraint(const MdtContactGroupID c) {
    return (MdtConstraintID)c;
}

MdtContactGroupID MEAPI MdtConstraintDCastContactGroup(const MdtConstraintID c) {
    return mdt_constraintCast(c, MdtBclCONTACTGROUP, __func__);
}

static MdtConstraintID groupOf(const MdtContactGroupID g, const char *caller) {
    return mdt_constraintOfType(g, MdtBclCONTACTGROUP, caller);
}

/* A contact that is in the group, or null with a warning. */
static MdtConstraintID memberOf(MdtConstraintID group, const MdtContactID c, const char *caller) {
    MdtConstraintID contact = group ? mdt_constraintOfType(c, MdtBclCONTACT, caller) : NULL;
    if (!contact || contact->group == group)
        return contact;
    MeWarning(1, "%s: the contact is not in this group", caller);
    return NULL;
}

/* ---- the list ---- */

static void append(MdtConstraintID group, MdtConstraintID contact) {
    MEASSERT(!contact->group && contact->world == group->world);
    MdtConstraintDisable(contact);
    contact->group = group;
    contact->previousInGroup = group->lastContact;
    contact->nextInGroup = NULL;
    if (group->lastContact)
        group->lastContact->nextInGroup = contact;
    else
        group->firstContact = contact;
    group->lastContact = contact;
    group->numContacts++;
    mdt_constraintAttach(contact, group->side[0].body, group->side[1].body);
    MEVALIDATE(mdt_groupIsLinked(group));
}

void mdt_groupForget(MdtConstraintID contact) {
    MdtConstraintID group = contact->group;
    mdt_constraintDisturb(contact);
    if (contact->previousInGroup)
        contact->previousInGroup->nextInGroup = contact->nextInGroup;
    else
        group->firstContact = contact->nextInGroup;
    if (contact->nextInGroup)
        contact->nextInGroup->previousInGroup = contact->previousInGroup;
    else
        group->lastContact = contact->previousInGroup;
    contact->group = contact->nextInGroup = contact->previousInGroup = NULL;
    group->numContacts--;
    mdt_graphChanged(group->world);
    MEASSERT(group->numContacts >= 0 && !group->firstContact == !group->numContacts);
    MEVALIDATE(mdt_groupIsLinked(group));
}

void mdt_groupDestroyContacts(MdtConstraintID group) {
    while (group->firstContact)
        mdt_constraintTerm(group->firstContact);
}

void mdt_groupTerm(MdtConstraintID group) {
    mdt_groupDestroyContacts(group);
    MEASSERT(!group->firstContact && !group->lastContact && group->numContacts == 0);
    if (group->holder)
        *group->holder = NULL;
    group->holder = NULL;
}

void mdt_groupAttachContacts(MdtConstraintID group) {
    for (MdtConstraintID c = group->firstContact; c; c = c->nextInGroup)
        mdt_constraintAttach(c, group->side[0].body, group->side[1].body);
    MEVALIDATE(mdt_groupIsLinked(group));
}

MdtContactID MEAPI MdtContactGroupGetFirstContact(MdtContactGroupID c) {
    MdtConstraintID group = groupOf(c, __func__);
    return group ? (MdtContactID)group->firstContact : NULL;
}

MdtContactID MEAPI MdtContactGroupGetNextContact(MdtContactGroupID g, MdtContactID c) {
    MdtConstraintID contact = memberOf(groupOf(g, __func__), c, __func__);
    return contact ? (MdtContactID)contact->nextInGroup : NULL;
}

int MEAPI MdtContactGroupGetCount(MdtContactGroupID g) {
    MdtConstraintID group = groupOf(g, __func__);
    return group ? group->numContacts : 0;
}

MdtContactID MEAPI MdtContactGroupCreateContact(MdtContactGroupID g) {
    MdtConstraintID group = groupOf(g, __func__);
    MdtConstraintID contact = group ? mdt_constraintCreate(group->world, MdtBclCONTACT, __func__) : NULL;
    if (contact)
        append(group, contact);
    return (MdtContactID)contact;
}

void MEAPI MdtContactGroupAppendContact(MdtContactGroupID g, MdtContactID c) {
    MdtConstraintID group = groupOf(g, __func__);
    MdtConstraintID contact = group ? mdt_constraintOfType(c, MdtBclCONTACT, __func__) : NULL;
    if (!contact)
        return;
    if (contact->group || contact->world != group->world)
        MeWarning(1, "MdtContactGroupAppendContact: the contact is %s; nothing is changed",
                  contact->group ? "in a group already" : "of another world");
    else
        append(group, contact);
}

void MEAPI MdtContactGroupRemoveContact(MdtContactGroupID g, MdtContactID c) {
    MdtConstraintID contact = memberOf(groupOf(g, __func__), c, __func__);
    if (contact)
        mdt_groupForget(contact);
}

void MEAPI MdtContactGroupDestroyContact(MdtContactGroupID g, MdtContactID c) {
    MdtConstraintID contact = memberOf(groupOf(g, __func__), c, __func__);
    if (contact)
        mdt_constraintTerm(contact);
}

/* ---- the rest ---- */

MeReal MEAPI MdtContactGroupGetNormalForce(MdtContactGroupID g) {
    MdtConstraintID group = groupOf(g, __func__);
    return group ? (MeReal)keaLength(group->normalForce) : 0;
}

MeBool MEAPI MdtContactGroupIsSwapped(MdtContactGroupID g) {
    MdtConstraintID group = groupOf(g, __func__);
    return group && group->isSwapped;
}

void MEAPI MdtContactGroupSetGenerator(MdtContactGroupID g, void *generator) {
    MdtConstraintID group = groupOf(g, __func__);
    if (group)
        group->generator = generator;
}

void MEAPI MdtContactGroupSetHolder(MdtContactGroupID g, void **holder) {
    MdtConstraintID group = groupOf(g, __func__);
    if (group)
        group->holder = holder;
}

void *MEAPI MdtContactGroupGetGenerator(MdtContactGroupID group) {
    MdtConstraintID c = groupOf(group, __func__);
    return c ? c->generator : NULL;
}
