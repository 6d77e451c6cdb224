/* One pair of models: collision contacts become dynamics contacts.
 *
 * The contact group is kept in the pair's responseData. It pushes the first model's body; where only the second model
 * has a body, that one is the group's first, and normals are turned.
 */
#include "McdContact.h"
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "mst_i.h"
#include <string.h>

/* Does the pair's group, if it has one, push the pair's bodies, and know the pair? */
static MeBool ownsGroup(const McdModelPair *p) {
    const MdtContactGroupID group = p->responseData;
    const MdtBodyID body1 = McdModelGetBody(p->model1), body2 = McdModelGetBody(p->model2);
    return !group || (MdtContactGroupGetGenerator(group) == (void *)p &&
                      MdtContactGroupGetBody(group, 0) == (body1 ? body1 : body2) &&
                      MdtContactGroupGetBody(group, 1) == (body1 ? body2 : 0));
}

static void destroyGroup(McdModelPair *p) {
    if (p->responseData)
        MdtContactGroupDestroy((MdtContactGroupID)p->responseData);
    MEASSERT(!p->responseData); /* the group has told */
}

void MEAPI mst_pairForget(McdModelPair *p) {
    if (!MdtConstraintIsValid(p->responseData)) /* it may have gone with its world */
        p->responseData = 0;
    mst_touchForget(p); /* while its forces can be read */
    destroyGroup(p);
    p->forget = 0;
}

/* The group stays, empty. */
static void emptyGroup(McdModelPair *p) {
    MdtContactGroupID group = p->responseData;
    if (!group)
        return;
    MdtContactGroupReset(group);
    MdtContactGroupDisable(group);
}

/* The pair's group; null if the world is full. */
static MdtContactGroupID ensureGroup(McdModelPair *p, MdtWorldID w) {
    const MdtBodyID body1 = McdModelGetBody(p->model1), body2 = McdModelGetBody(p->model2);
    if (p->responseData)
        return p->responseData;
    const MdtContactGroupID group = MdtContactGroupCreate(w);
    if (group)
        MdtContactGroupSetBodies(group, body1 ? body1 : body2, body1 ? body2 : 0);
    if (group) {
        MdtContactGroupSetGenerator(group, p);
        MdtContactGroupSetHolder(group, &p->responseData);
    }
    p->responseData = group;
    p->forget = mst_pairForget;
    MEASSERT(ownsGroup(p));
    return group;
}

void mst_pairTie(McdModelPair *p, MdtWorldID w) {
    const MdtContactGroupID group = ensureGroup(p, w);
    if (group)
        MdtContactGroupEnable(group);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

/* What holds at a contact: its parts may have materials of their own. */
static MstMaterialPair *materialsOf(MstBridgeRecord *b, const McdContact *c) {
    return mst_materialPair(b, McdGeometryInstanceGetMaterial(c->instance1),
                            McdGeometryInstanceGetMaterial(c->instance2));
}

static void findContact(MdtFoundContact *found, const McdContact *from, MeBool isTurned,
                        const MstMaterialPair *materials) {
    for (int i = 0; i < 3; i++)
        found->normal[i] = isTurned ? -from->normal[i] : from->normal[i];
    for (int k = 0; k < 2; k++) {
        const int side = isTurned ? 1 - k : k;
        found->radius[side] = (MeReal)McdContactGetRadius(from, k);
        found->rim[side] = McdContactGetRim(from, k, found->axis[side]);
    }
    McdContactGetPosition(from, found->position);
    found->depth = -McdContactGetSeparation(from);
    found->feature = from->feature;
    found->params = &materials->params;
}

/* A contact that its callback does not want is destroyed. */
static void askAbout(MstBridgeRecord *b, MdtContactGroupID group, McdIntersectResult *result, int count) {
    for (int i = 0; i < count; i++) {
        McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = materialsOf(b, from);
        if (materials->perContactCb && !materials->perContactCb(result, from, b->done[i]))
            MdtContactGroupDestroyContact(group, b->done[i]);
    }
}

/* The group's contacts become those of the result. */
static void renewContacts(MstBridgeRecord *b, MdtContactGroupID group, McdIntersectResult *result, MeBool isTurned) {
    MEASSERT(result->contactCount <= (int)b->contactMax);
    for (int i = 0; i < result->contactCount; i++)
        findContact(&b->found[i], &result->contacts[i], isTurned, materialsOf(b, &result->contacts[i]));
    const int count = MdtContactGroupRenew(group, b->found, result->contactCount, b->ahead, b->done);
    askAbout(b, group, result, count);
}

/* Overlap is told, and nothing is pushed. Two sensors do not see each other. */
static void meetSensor(MstBridgeRecord *b, McdModelPair *p, McdIntersectResult *result) {
    destroyGroup(p);
    if (McdModelIsSensor(p->model1) && McdModelIsSensor(p->model2))
        return;
    if (McdIntersect(p, result))
        mst_touchNoteSensor(b, p, result);
}

MeBool mst_isInCrowd(MdtBodyID body) {
    enum { CROWD = 32 };
    return body && MdtBodyGetPartitionSize(body) > CROWD;
}

/* ---- pairs that are as they were --------------------------------------------------------------------------------- */

static unsigned long movesOf(McdModelID m) {
    const MdtBodyID body = McdModelGetBody(m);
    return body ? MdtBodyGetMoves(body) : 0;
}

static MeBool hasCallback(const MstMaterialPair *materials) {
    return materials->intersectCb || materials->perContactCb || materials->perPairCb;
}

static MeBool isSwept(const McdModelPair *p) {
    return McdModelGetFastMargin(p->model1) > 0 || McdModelGetFastMargin(p->model2) > 0;
}

/* What the contacts were made from, unless it is to be tested in every step: what is fast, or has callbacks, or has not
 * got all the contacts that were found. */
static void remember(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials,
                     const McdIntersectResult *result) {
    MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    if (!t && result->contactCount > 0) /* the world, or memory, was full: there may be room in the next step */
        McdModelPairForgetTest(p);
    if (!t)
        return;
    t->moves[0] = movesOf(p->model1);
    t->moves[1] = movesOf(p->model2);
    t->carried = 0;
    t->version = mst_materialVersion(b, materials);
    t->found = group && MdtContactGroupGetCount(group) == result->contactCount && !hasCallback(materials) && !isSwept(p)
                   ? result->contactCount
                   : MST_UNKNOWN;
}

/* Has the pair all the contacts that it had when it was tested, and did its bodies stay there, to the last bit? */
static MeBool hasItsContacts(const McdModelPair *p) {
    const MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    if (t->found == 0)
        return !t->isTouching;
    return t->found > 0 && group && MdtContactGroupGetCount(group) == t->found && t->moves[0] == movesOf(p->model1) &&
           t->moves[1] == movesOf(p->model2);
}

static MeBool isApart(const McdModelPair *p) {
    const MstTouch *t = p->touch;
    return t ? t->found == 0 && !t->isTouching : !p->responseData;
}

/* A body that has moved, has moved by its last step. */
static MeBool movedByStep(McdModelID m, unsigned long before, MeBool *hasMoved) {
    *hasMoved = movesOf(m) != before;
    return !*hasMoved || MdtBodyMovedByStep(McdModelGetBody(m), before);
}

/* The bodies of the pair's group that have moved since its contacts were found, or carried. False: they cannot be
 * carried. */
static MeBool mayCarry(const MstBridgeRecord *b, const McdModelPair *p, MeBool hasMoved[2]) {
    const MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    MeBool moved[2];
    if (!t || t->found <= 0 || !group || MdtContactGroupGetCount(group) != t->found || t->carried >= MST_CARRIES ||
        !movedByStep(p->model1, t->moves[0], &moved[0]) || !movedByStep(p->model2, t->moves[1], &moved[1]))
        return MEFALSE;
    const MeBool isTurned = !McdModelGetBody(p->model1);
    hasMoved[0] = moved[isTurned];
    hasMoved[1] = moved[!isTurned];
    return b->part == 0 && MdtContactGroupIsFlat(group);
}

static void keepContacts(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials) {
    const MdtContactGroupID group = p->responseData;
    MstTouch *t = p->touch;
    if (!t || t->found == 0)
        return;
    if (t->version != mst_materialVersion(b, materials))
        for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
            MdtContactSetParams(c, &materials->params);
    t->version = mst_materialVersion(b, materials);
    MdtContactGroupEnable(group);
    mst_touchNoteAgain(b, p);
}

/* The pair has hardly moved: its contacts move with its bodies. */
static void carryContacts(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials, const MeBool hasMoved[2]) {
    MstTouch *t = p->touch;
    t->separation = MdtContactGroupCarry(p->responseData, hasMoved);
    t->carried++;
    t->moves[0] = movesOf(p->model1);
    t->moves[1] = movesOf(p->model2);
    keepContacts(b, p, materials);
}

/* Partitions of a few bodies are solved to the rounding of their contacts: there each test counts (a million kilograms
 * on one show contacts that are off by 1e-7 m). */
static MeBool mayReuse(const McdModelPair *p) {
    return (mst_isInCrowd(McdModelGetBody(p->model1)) || mst_isInCrowd(McdModelGetBody(p->model2))) && !isSwept(p);
}

/* Did the pair's last test, or what has been carried since, give what a test would give now? Then that is kept. */
static MeBool reuseContacts(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials) {
    const MeBool mayMove[2] = {McdModelGetBody(p->model1) != 0, McdModelGetBody(p->model2) != 0};
    const McdPairChange change = McdModelPairLook(p, mayReuse(p) ? b->reuse : 0, mayMove);
    MeBool hasMoved[2];
    if (change == McdPairHasChanged || hasCallback(materials))
        return MEFALSE;
    if (p->touch ? hasItsContacts(p) : change == McdPairIsUnchanged && !p->responseData) {
        keepContacts(b, p, materials);
        return METRUE;
    }
    if (isApart(p)) /* by more than they have moved */
        return METRUE;
    if (!mayCarry(b, p, hasMoved))
        return MEFALSE;
    carryContacts(b, p, materials, hasMoved);
    return METRUE;
}

/* ---- pairs that have to be tested -------------------------------------------------------------------------------- */

static void meetBodies(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w, MstMaterialPair *materials,
                       McdIntersectResult *result) {
    if (!McdIntersect(p, result))
        return;
    if (result->touch && materials->intersectCb)
        materials->intersectCb(result);
    MdtContactGroupID group = result->contactCount > 0 ? ensureGroup(p, w) : 0;
    if (!group) {
        emptyGroup(p);
        return;
    }
    renewContacts(b, group, result, !McdModelGetBody(p->model1));
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
    if (materials->perPairCb && !materials->perPairCb(result, group))
        emptyGroup(p);
}

static McdIntersectResult emptyResult(const MstBridgeRecord *b) {
    McdIntersectResult result;
    memset(&result, 0, sizeof result);
    result.contacts = b->contacts;
    result.contactMaxCount = (int)b->contactMax;
    return result;
}

void mst_pairCollide(MstBridgeRecord *b, McdModelPair *p, McdSpaceID s, MdtWorldID w) {
    McdIntersectResult result = emptyResult(b);
    if (b->part > 0 && !mst_mayMeet(b, p, s))
        return;
    if (McdModelIsSensor(p->model1) || McdModelIsSensor(p->model2)) {
        meetSensor(b, p, &result);
        return;
    }
    if (!McdModelGetBody(p->model1) && !McdModelGetBody(p->model2))
        return;
    MstMaterialPair *materials = mst_materialPair(b, McdModelGetMaterial(p->model1), McdModelGetMaterial(p->model2));
    if (reuseContacts(b, p, materials))
        return;
    McdModelPairNoteTest(p);
    meetBodies(b, p, w, materials, &result);
    if (hasCallback(materials))
        mst_beginRound(b); /* they may have changed anything */
    MEASSERT(result.contactCount <= result.contactMaxCount);
    mst_touchNote(b, p, &result);
    remember(b, p, materials, &result);
    mst_followFast(b, p, s, w, result.contactCount > 0);
}
