/* Detection of the program's changes: frozen models, moving models without a body, parameters of materials.
 *
 * Pairs of two frozen models are skipped. A frozen model that has changed is unfrozen for one step, so that its pairs
 * are tested again; contacts that differ wake the bodies (mdt_bodyDisturb). Models that the program has moved stay
 * unfrozen. Where parameters of a pair of materials change, the bodies that touch with it are woken individually.
 *
 * A model without a body that the program moves pushes bodies: its contacts get the velocity of its surface along their
 * normal. Friction acts as on a world at rest, so bodies standing on it are not carried along.
 */
#include "McdInternal.h"
#include "McdGeometry.h"
#include "McdGeometryTypes.h"
#include "McdModel.h"
#include "MdtBody.h"
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "bridge/mst_bridge_i.h"
#include <string.h>

/* ---- frozen models that have changed ----------------------------------------------------------------------------- */

static MeBool isAwake(McdModelID m) {
    return mst_bodyOf(m) && MdtBodyIsEnabled(mst_bodyOf(m));
}

/* Adds a model to the list of those to freeze again. After MeFatalError, no memory, the model stays unfrozen. */
static void addThawed(MstBridgeRecord *b, McdModelID m) {
    if (mst_reserveOne(&b->thawed, b->thawedCount, &b->thawedMax, sizeof *b->thawed, "models"))
        b->thawed[b->thawedCount++] = (MstModelRef){m, McdModelGetSerial(m)};
}

static void warnOfFrozenMove(McdModelID m) {
    MeWarning(
        1,
        "%s: the matrix of a frozen model (number %d) was changed; it is unfrozen now. Call McdSpaceUnfreezeModel "
        "before a model is moved",
        MeCallerName("MstBridgeUpdateContacts"), (int)McdModelGetSerial(m));
}

static void MEAPI thawModel(McdModelID m, MeBool hasMoved, void *bridge) {
    const MdtBodyID body = mst_bodyOf(m);
    if (body && MdtBodyWakeIfAsleep(body))
        return; /* waking the body has unfrozen its models */
    McdSpaceUnfreezeModel(m);
    McdSpaceUpdateModel(m);
    if (hasMoved && !body)
        warnOfFrozenMove(m);
    else
        addThawed(bridge, m);
}

void mst_refreezeModels(MstBridgeRecord *b) {
    for (int i = 0; i < b->thawedCount; i++) {
        const MstModelRef *ref = &b->thawed[i];
        const McdModelID m = ref->model;
        if (McdModelIsValid(m) && McdModelGetSerial(m) == ref->serial && McdModelGetSpace(m) && !isAwake(m))
            McdSpaceFreezeModel(m);
    }
    b->thawedCount = 0;
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Whether the model is an aggregate, whose children may have materials of their own. */
static MeBool hasChildren(McdModelID m) {
    return McdGeometryGetType(McdModelGetGeometry(m)) == kMcdGeometryTypeAggregate;
}

static MeBool mayUseMaterials(const MstBridgeRecord *b, const McdModelPair *p, const MstMaterialPair *materials) {
    return hasChildren(p->model1) || hasChildren(p->model2) ||
           mst_materialPair(b, McdModelGetMaterial(p->model1), McdModelGetMaterial(p->model2)) == materials;
}

void mst_wakeBodiesOfMaterials(const MstBridgeRecord *b, const MstMaterialPair *changed) {
    for (int k = 0; k < b->events.blockCount; k++)
        for (int i = 0; i < MST_TOUCH_BLOCK << k; i++) {
            const McdModelPair *p = b->events.block[k][i].pair;
            if (!p || !mayUseMaterials(b, p, changed))
                continue;
            if (mst_bodyOf(p->model1))
                MdtBodyWakeIfAsleep(mst_bodyOf(p->model1));
            if (mst_bodyOf(p->model2))
                MdtBodyWakeIfAsleep(mst_bodyOf(p->model2));
        }
}

/* Compares some pairs of materials per step with their last parameters, in turn. */
static void compareSomeMaterials(MstBridgeRecord *b) {
    enum { LOOKS = 64 };
    const unsigned int pairs = b->materialCount * (b->materialCount + 1) / 2;
    for (unsigned int i = 0; i < LOOKS && i < pairs; i++) {
        if (++b->nextMaterial[1] > b->nextMaterial[0]) {
            b->nextMaterial[1] = 0;
            b->nextMaterial[0] = b->nextMaterial[0] + 1 < b->materialCount ? b->nextMaterial[0] + 1 : 0;
        }
        MEASSERT(b->nextMaterial[0] < b->materialCount && b->nextMaterial[1] <= b->nextMaterial[0]);
        MstMaterialRecord *m = &b->materials[b->nextMaterial[0]][b->nextMaterial[1]];
        if (memcmp(&m->pair.params, &m->known, sizeof m->known) == 0)
            continue;
        m->known = m->pair.params;
        mst_wakeBodiesOfMaterials(b, &m->pair);
    }
}

void mst_applyProgramChanges(MstBridgeRecord *b, McdSpaceID s) {
    compareSomeMaterials(b);
    McdSpaceVisitChangedFrozen(s, thawModel, b);
}

/* ---- models that are moved --------------------------------------------------------------------------------------- */

/* The pair's model without a body; null: both have one. */
static McdModelID modelWithoutBody(const McdModelPair *p) {
    return !mst_bodyOf(p->model1) ? p->model1 : !mst_bodyOf(p->model2) ? p->model2 : 0;
}

MeBool mst_isPushedByModel(const McdModelPair *p) {
    const McdModelID m = modelWithoutBody(p);
    const MstTouch *t = p->touch;
    return m && (McdModelHasMoved(m) || (t && t->isPushed));
}

void mst_setPushVelocities(const MstBridgeRecord *b, const McdModelPair *p) {
    const McdModelID m = modelWithoutBody(p);
    const MdtContactGroupID group = p->responseData;
    MstTouch *t = p->touch;
    if (!m || !group || !t || b->substep > 0 || !mst_isPushedByModel(p) || !(b->ahead > 0))
        return; /* after the first sub-step, models without a body do not move */
    t->isPushed = false;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 position, normal, moved;
        MdtContactGetPosition(c, position);
        MdtContactGetNormal(c, normal);
        if (McdModelGetDisplacement(m, position, moved))
            t->isPushed = true;
        MeVector3MultiplyScalar(normal, normal, MeVector3Dot(normal, moved) / b->ahead);
        MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(c), normal[0], normal[1], normal[2]);
    }
}
