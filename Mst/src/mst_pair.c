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

/* Is every contact that is done a different one of the group, which has no others? */
static MeBool isGroupOf(MdtContactGroupID group, const MdtContactID *done, int count) {
    int found = 0;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        for (int i = 0; i < count; i++)
            found += done[i] == c;
    return found == count && MdtContactGroupGetCount(group) == count;
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

static MeBool isAmong(MdtContactID c, const MdtContactID *list, int count) {
    for (int i = 0; i < count; i++)
        if (list[i] == c)
            return METRUE;
    return MEFALSE;
}

/* ---- which contact of the last step a point continues ------------------------------------------------------------ */

/* The group's contact with the feature that no point has yet. */
static MdtContactID contactOfFeature(MdtContactGroupID group, MeU32 feature, const MdtContactID *taken, int count) {
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        if (MdtContactGetFeature(c) == feature && !isAmong(c, taken, count))
            return c;
    return 0;
}

/* Square of the distance from where a contact has been carried to since it was found, by the body that it pushes. */
static MeReal distanceFrom(MdtContactID c, const MstBridgeRecord *b, const MeVector3 point) {
    MeVector3 place, velocity;
    MdtContactGetPosition(c, place);
    MdtBodyGetVelocityAtPoint(MdtContactGetBody(c, 0), place, velocity);
    MeVector3MultiplyScalar(velocity, velocity, b->ahead);
    MeVector3Add(place, place, velocity);
    MeVector3Subtract(place, place, point);
    return MeVector3Dot(place, place);
}

/* Of all points without a contact, and all contacts of the group that no point has, the two that are nearest to each
 * other: they become one. False: there are none. */
static MeBool matchNearest(MstBridgeRecord *b, MdtContactGroupID group, const McdIntersectResult *result) {
    MdtContactID nearest = 0;
    MeReal least = MEINFINITY;
    int point = 0;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        if (isAmong(c, b->done, result->contactCount))
            continue;
        for (int i = 0; i < result->contactCount; i++) {
            const MeReal distance = b->done[i] ? MEINFINITY : distanceFrom(c, b, result->contacts[i].position);
            if (distance < least) {
                least = distance;
                nearest = c;
                point = i;
            }
        }
    }
    if (nearest)
        b->done[point] = nearest;
    return nearest != 0;
}

/* b->done[i] becomes the contact that point i of the result continues, or null. Features of boxes that lie flat on each
 * other change with their last bits, corner for edge, while the points stay where they are and go on carrying what they
 * carried: what is left over after the features continues the nearest of the old contacts that are left. */
static void matchContacts(MstBridgeRecord *b, MdtContactGroupID group, const McdIntersectResult *result) {
    for (int i = 0; i < result->contactCount; i++)
        b->done[i] = contactOfFeature(group, result->contacts[i].feature, b->done, i);
    while (matchNearest(b, group, result))
        ;
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

static void setContact(MdtContactID c, const McdContact *from, MeBool isTurned, const MstMaterialPair *materials) {
    const MeReal sign = isTurned ? -1 : 1;
    double position[3];
    MdtContactSetParams(c, (MdtContactParamsID)&materials->params);
    MdtContactSetNormal(c, sign * from->normal[0], sign * from->normal[1], sign * from->normal[2]);
    for (int k = 0; k < 2; k++)
        MdtContactSetRadius(c, (unsigned int)(isTurned ? 1 - k : k), (MeReal)McdContactGetRadius(from, k));
    McdContactGetPosition(from, position);
    MdtContactSetExact(c, position, -McdContactGetSeparation(from));
    MdtContactSetFeature(c, from->feature);
}

/* What holds at a contact: its parts may have materials of their own. */
static MstMaterialPair *materialsOf(MstBridgeRecord *b, const McdContact *c) {
    return mst_materialPair(b, McdGeometryInstanceGetMaterial(c->instance1),
                            McdGeometryInstanceGetMaterial(c->instance2));
}

static void destroyOthers(MdtContactGroupID group, const MdtContactID *done, int count) {
    MdtContactID next;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = next) {
        next = MdtContactGroupGetNextContact(group, c);
        if (!isAmong(c, done, count))
            MdtContactGroupDestroyContact(group, c);
    }
}

/* The group's contacts become those of the result. A point that continues one stays the same object, with the force
 * that it had; the rest is made new, or destroyed. */
static void renewContacts(MstBridgeRecord *b, MdtContactGroupID group, McdIntersectResult *result, MeBool isTurned) {
    int count = 0;
    matchContacts(b, group, result);
    for (int i = 0; i < result->contactCount; i++) {
        McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = materialsOf(b, from);
        const MdtContactID c = b->done[i] ? b->done[i] : MdtContactGroupCreateContact(group);
        if (!c)
            break; /* the world is full, and has said so */
        setContact(c, from, isTurned, materials);
        if (!materials->perContactCb || materials->perContactCb(result, from, c))
            b->done[count++] = c;
    }
    MEASSERT(count <= (int)b->contactMax);
    destroyOthers(group, b->done, count);
    MEVALIDATE(isGroupOf(group, b->done, count));
}

/* Overlap is told, and nothing is pushed. Two sensors do not see each other. */
static void meetSensor(MstBridgeRecord *b, McdModelPair *p, McdIntersectResult *result) {
    destroyGroup(p);
    if (McdModelIsSensor(p->model1) && McdModelIsSensor(p->model2))
        return;
    if (McdIntersect(p, result))
        mst_touchNoteSensor(b, p, result);
}

/* ---- pairs that are as they were --------------------------------------------------------------------------------- */

static unsigned long movesOf(McdModelID m) {
    const MdtBodyID body = McdModelGetBody(m);
    return body ? MdtBodyGetMoves(body) : 0;
}

static MeBool hasCallback(const MstMaterialPair *materials) {
    return materials->intersectCb || materials->perContactCb || materials->perPairCb;
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
    t->version = mst_materialVersion(b, materials);
    t->found = group && MdtContactGroupGetCount(group) == result->contactCount && !hasCallback(materials) &&
                       !(McdModelGetFastMargin(p->model1) > 0) && !(McdModelGetFastMargin(p->model2) > 0)
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

/* Would the pair's test give what there is? */
static MeBool isAsItWas(McdModelPair *p, const MstMaterialPair *materials) {
    return McdModelPairIsAsTested(p) && !hasCallback(materials) && (p->touch ? hasItsContacts(p) : !p->responseData);
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
    if (isAsItWas(p, materials)) {
        keepContacts(b, p, materials);
        return;
    }
    meetBodies(b, p, w, materials, &result);
    if (hasCallback(materials))
        mst_beginRound(b); /* they may have changed anything */
    MEASSERT(result.contactCount <= result.contactMaxCount);
    mst_touchNote(b, p, &result);
    remember(b, p, materials, &result);
    mst_followFast(b, p, s, w, result.contactCount > 0);
}
