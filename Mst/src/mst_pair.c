/* One pair of models: collision contacts become dynamics contacts.
 *
 * The contact group is kept in the pair's responseData. It pushes the first model's body; where only the second model has
 * a body, that one is the group's first, and normals are turned.
 */
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "mst_i.h"
#include <string.h>

void mst_pairForget(McdModelPair *p) {
    if (p->responseData)
        MdtContactGroupDestroy((MdtContactGroupID)p->responseData);
    p->responseData = 0;
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
    if (group)
        MdtContactGroupSetGenerator(group, p);
    p->responseData = group;
    return group;
}

/* A contact of the group that has the feature and was not taken yet in this step; taken ones have the mark. */
static MdtContactID findContact(MdtContactGroupID group, MeU32 feature, MdtContactID end) {
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c && c != end;
         c = MdtContactGroupGetNextContact(group, c))
        if (MdtContactGetFeature(c) == feature)
            return c;
    return 0;
}

/* Moves a contact to the end of the list, with all that it remembers. */
static void moveToEnd(MdtContactGroupID group, MdtContactID c) {
    MdtContactGroupRemoveContact(group, c);
    MdtContactGroupAppendContact(group, c);
}

static void setContact(MdtContactID c, const McdContact *from, MeBool isTurned, const MstMaterialPair *materials) {
    const MeReal sign = isTurned ? -1 : 1;
    MdtContactSetParams(c, (MdtContactParamsID)&materials->params);
    MdtContactSetPosition(c, from->position[0], from->position[1], from->position[2]);
    MdtContactSetNormal(c, sign * from->normal[0], sign * from->normal[1], sign * from->normal[2]);
    MdtContactSetPenetration(c, -from->separation);
    MdtContactSetFeature(c, from->feature);
}

/* What holds at a contact: its parts may have materials of their own. */
static MstMaterialPair *materialsOf(MstBridgeRecord *b, const McdContact *c) {
    return mst_materialPair(b, McdGeometryInstanceGetMaterial(c->instance1),
                            McdGeometryInstanceGetMaterial(c->instance2));
}

static void destroyUpTo(MdtContactGroupID group, MdtContactID end) {
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c && c != end;
         c = MdtContactGroupGetFirstContact(group))
        MdtContactGroupDestroyContact(group, c);
}

/* The group's contacts become those of the result, in its order: ones with the same feature are kept, the rest made new
 * or destroyed. Ones that are done stand behind those of the last step, from `firstNew` on. */
static void renewContacts(MstBridgeRecord *b, MdtContactGroupID group, McdIntersectResult *result, MeBool isTurned) {
    MdtContactID firstNew = 0;
    for (int i = 0; i < result->contactCount; i++) {
        McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = materialsOf(b, from);
        MdtContactID c = findContact(group, from->feature, firstNew);
        if (c)
            moveToEnd(group, c);
        else
            c = MdtContactGroupCreateContact(group);
        if (!c)
            break; /* the world is full, and has said so */
        setContact(c, from, isTurned, materials);
        if (materials->perContactCb && !materials->perContactCb(result, from, c))
            MdtContactGroupDestroyContact(group, c);
        else if (!firstNew)
            firstNew = c;
    }
    destroyUpTo(group, firstNew);
}

void mst_pairCollide(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w) {
    const MdtBodyID body1 = McdModelGetBody(p->model1), body2 = McdModelGetBody(p->model2);
    McdIntersectResult result;
    if (!body1 && !body2)
        return;
    memset(&result, 0, sizeof result);
    result.contacts = b->contacts;
    result.contactMaxCount = (int)b->contactMax;
    if (!McdIntersect(p, &result))
        return;
    const MstMaterialPair *materials =
        mst_materialPair(b, McdModelGetMaterial(p->model1), McdModelGetMaterial(p->model2));
    if (result.touch && materials->intersectCb)
        materials->intersectCb(&result);
    MdtContactGroupID group = result.contactCount > 0 ? ensureGroup(p, w) : 0;
    if (!group) {
        emptyGroup(p);
        return;
    }
    renewContacts(b, group, &result, !body1);
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
    if (materials->perPairCb && !materials->perPairCb(&result, group))
        emptyGroup(p);
}
