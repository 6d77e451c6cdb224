/* What programs change beside the simulation: frozen models, models without a body that move, parameters of materials.
 *
 * Pairs of two frozen models are skipped. A frozen model that has changed is unfrozen for one step, so that its pairs
 * are tested again: contacts that change wake the bodies (mdt_bodyDisturb). What the program moves stays unfrozen. The
 * bodies that touch by materials whose parameters change are woken one by one.
 *
 * A model without a body that has been moved pushes what it touches: its contacts get the component along their normal
 * of the motion of its surface. Friction is with a world at rest, as before: what stands on it is not carried along.
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

/* False, after MeFatalError: there is no memory; it stays unfrozen. */
static MeBool keepThawed(MstBridgeRecord *b, McdModelID m) {
    if (b->thawedCount == b->thawedMax) {
        const int more = b->thawedMax ? 2 * b->thawedMax : 16;
        if (!MeMemoryGrow(&b->thawed, (size_t)b->thawedCount, (size_t)more, sizeof *b->thawed,
                          "MstBridgeUpdateContacts", "models"))
            return MEFALSE;
        b->thawedMax = more;
    }
    b->thawed[b->thawedCount++] = (MstModelRef){m, McdModelGetSerial(m)};
    return METRUE;
}

static void warnOfMove(McdModelID m) {
    MeWarning(
        1,
        "%s: the matrix of a frozen model (number %d) was changed; it is unfrozen now. Call McdSpaceUnfreezeModel "
        "before a model is moved",
        MeCallerName("MstBridgeUpdateContacts"), (int)McdModelGetSerial(m));
}

static void MEAPI thaw(McdModelID m, MeBool hasMoved, void *bridge) {
    const MdtBodyID body = mst_bodyOf(m);
    if (body && MdtBodyWakeIfAsleep(body))
        return; /* its models are unfrozen */
    McdSpaceUnfreezeModel(m);
    McdSpaceUpdateModel(m);
    if (hasMoved && !body)
        warnOfMove(m);
    else
        keepThawed(bridge, m);
}

void mst_freezeAgain(MstBridgeRecord *b) {
    for (int i = 0; i < b->thawedCount; i++) {
        const MstModelRef *ref = &b->thawed[i];
        const McdModelID m = ref->model;
        if (McdModelIsValid(m) && McdModelGetSerial(m) == ref->serial && McdModelGetSpace(m) && !isAwake(m))
            McdSpaceFreezeModel(m);
    }
    b->thawedCount = 0;
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Its parts may have materials of their own. */
static MeBool hasChildren(McdModelID m) {
    return McdGeometryGetType(McdModelGetGeometry(m)) == kMcdGeometryTypeAggregate;
}

static MeBool maySlideBy(const MstBridgeRecord *b, const McdModelPair *p, const MstMaterialPair *materials) {
    return hasChildren(p->model1) || hasChildren(p->model2) ||
           mst_materialPair(b, McdModelGetMaterial(p->model1), McdModelGetMaterial(p->model2)) == materials;
}

void mst_wakeTouching(const MstBridgeRecord *b, const MstMaterialPair *changed) {
    for (int k = 0; k < b->events.blockCount; k++)
        for (int i = 0; i < MST_TOUCH_BLOCK << k; i++) {
            const McdModelPair *p = b->events.block[k][i].pair;
            if (!p || !maySlideBy(b, p, changed))
                continue;
            if (mst_bodyOf(p->model1))
                MdtBodyWakeIfAsleep(mst_bodyOf(p->model1));
            if (mst_bodyOf(p->model2))
                MdtBodyWakeIfAsleep(mst_bodyOf(p->model2));
        }
}

/* Some pairs of materials a step, in turn. */
static void lookAtMaterials(MstBridgeRecord *b) {
    enum { LOOKS = 64 };
    const unsigned int pairs = b->materialCount * (b->materialCount + 1) / 2;
    for (unsigned int i = 0; i < LOOKS && i < pairs; i++) {
        if (++b->nextMaterial[1] > b->nextMaterial[0]) {
            b->nextMaterial[1] = 0;
            b->nextMaterial[0] = b->nextMaterial[0] + 1 < b->materialCount ? b->nextMaterial[0] + 1 : 0;
        }
        MstMaterialRecord *m = &b->materials[b->nextMaterial[0]][b->nextMaterial[1]];
        if (memcmp(&m->pair.params, &m->known, sizeof m->known) == 0)
            continue;
        m->known = m->pair.params;
        mst_wakeTouching(b, &m->pair);
    }
}

void mst_wakeChanged(MstBridgeRecord *b, McdSpaceID s) {
    lookAtMaterials(b);
    McdSpaceVisitChangedFrozen(s, thaw, b);
}

/* ---- models that are moved --------------------------------------------------------------------------------------- */

/* The model of the pair that has no body; null: both have. */
static McdModelID bodyless(const McdModelPair *p) {
    return !mst_bodyOf(p->model1) ? p->model1 : !mst_bodyOf(p->model2) ? p->model2 : 0;
}

MeBool mst_isPushed(const McdModelPair *p) {
    const McdModelID m = bodyless(p);
    const MstTouch *t = p->touch;
    return m && (McdModelHasMoved(m) || (t && t->isPushed));
}

void mst_push(const MstBridgeRecord *b, const McdModelPair *p) {
    const McdModelID m = bodyless(p);
    const MdtContactGroupID group = p->responseData;
    MstTouch *t = p->touch;
    if (!m || !group || !t || b->substep > 0 || !mst_isPushed(p) || !(b->ahead > 0))
        return; /* in the parts of a step bodies alone move */
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
