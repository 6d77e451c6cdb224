/* Detection of the program's changes: frozen models, moving models without a body, parameters of materials.
 *
 * Pairs of two frozen models are skipped. A frozen model that has changed is unfrozen for one step, so that its pairs
 * are tested again; contacts that differ wake the bodies (mdt_bodyDisturb). Models that the program has moved stay
 * unfrozen. Where parameters of a pair of materials change, the bodies that touch with it are woken individually.
 *
 * A model without a body that the program moves gets a hidden body, a mover: it is at its old transform when the step
 * begins and at the new one, which the program has written, at its end. The model is placed by the body's transform;
 * programs go on to see their own.
 */
#include "McdInternal.h"
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

/* ---- models without a body that are moved ------------------------------------------------------------------------ */

/* Takes the program's velocities of a model's surface back, unless it has set other ones meanwhile. */
static void restoreVelocities(McdModelID m, const MstMoved *moved, MdtBodyID body) {
    if (McdModelGetLinearVelocityPtr(m) == MdtBodyGetLinearVelocityPtr(body))
        McdModelSetLinearVelocityPtr(m, moved->velocity[0]);
    if (McdModelGetAngularVelocityPtr(m) == MdtBodyGetAngularVelocityPtr(body))
        McdModelSetAngularVelocityPtr(m, moved->velocity[1]);
}

static void MEAPI endMoved(McdModel *m) {
    const MdtBodyID body = m->mBody;
    MstMoved *moved = MdtBodyGetUserData(body);
    McdModelForgetPairs(m);
    McdModelPlaceBy(m, 0);
    restoreVelocities(m, moved, body);
    m->mLeave = 0;
    m->mBody = 0;
    MeMemoryGive(moved);
    MdtBodyDestroyHidden(body);
}

static void MEAPI leaveHidden(const MdtBodyID body) {
    endMoved(MdtBodyGetModel(body));
}

/* Puts a model at the transform of a hidden body, which will follow the program's, if that is one. */
static void MEAPI beginMoved(McdModelID m, MeMatrix4 before, void *world) {
    static const MdtBodyUser user = {0, 0, leaveHidden, 0};
    if (McdModelIsSensor(m) || m->mLeave || !McdModelGetTransformPtr(m))
        return;
    MstMoved *moved = MeMemoryTakeZeroed(1, sizeof *moved, "MstBridgeUpdateContacts", "a model that is moved");
    const MdtBodyID body = moved ? MdtBodyCreateHidden(world, (const MeVector4 *)before) : 0;
    if (!body || !MdtBodyFollow(body, (const MeVector4 *)McdModelGetTransformPtr(m))) {
        if (body)
            MdtBodyDestroyHidden(body);
        MeMemoryGive(moved);
        return;
    }
    McdModelForgetPairs(m);
    memcpy(moved->seen, before, sizeof moved->seen);
    moved->velocity[0] = McdModelGetLinearVelocityPtr(m);
    moved->velocity[1] = McdModelGetAngularVelocityPtr(m);
    MdtBodySetHiddenUser(body, m, moved, &user);
    m->mBody = body;
    m->mLeave = endMoved;
    McdModelPlaceBy(m, MdtBodyGetTransformPtr(body));
    McdModelSetLinearVelocityPtr(m, MdtBodyGetLinearVelocityPtr(body));
    McdModelSetAngularVelocityPtr(m, MdtBodyGetAngularVelocityPtr(body));
    McdSpaceUpdateModel(m);
}

/* Whether the program has put the model elsewhere, by more than its radius, instead of moving it. */
static MeBool isElsewhere(McdModelID m, MeMatrix4 seen, MeMatrix4 now) {
    MeVector3 way, centre;
    MeReal radius;
    McdModelGetBSphere(m, centre, &radius);
    MeVector3Subtract(way, now[3], seen[3]);
    return !(MeVector3MagnitudeSqr(way) <= radius * radius);
}

/* Lets a hidden body follow the program's transform. False: it is none any more that a body can have. */
static MeBool follow(MdtBodyID body) {
    const McdModelID m = MdtBodyGetModel(body);
    MstMoved *moved = MdtBodyGetUserData(body);
    const MeMatrix4Ptr now = McdModelGetGiven(m);
    if (!now)
        return MEFALSE;
    if (memcmp(now, moved->seen, sizeof moved->seen) == 0)
        return METRUE;
    const MeBool isFar = isElsewhere(m, moved->seen, now);
    memcpy(moved->seen, now, sizeof moved->seen);
    if (McdModelGetSpace(m) && McdSpaceModelIsFrozen(m)) {
        McdSpaceUnfreezeModel(m);
        warnOfFrozenMove(m);
    }
    if (!MdtBodyFollow(body, (const MeVector4 *)now))
        return MEFALSE;
    if (isFar)
        MdtBodyJump(body);
    return METRUE;
}

void mst_followMoved(MdtWorldID w, MeReal step) {
    for (MdtBodyID b = MdtWorldNextHidden(w, 0), next; b; b = next) {
        next = MdtWorldNextHidden(w, b);
        if (!follow(b))
            endMoved(MdtBodyGetModel(b));
    }
    if (step > 0)
        MdtWorldBeginMovers(w, step);
}

void mst_shiftMoved(MdtWorldID w, const double by[3]) {
    for (MdtBodyID b = MdtWorldNextHidden(w, 0); b; b = MdtWorldNextHidden(w, b)) {
        MstMoved *moved = MdtBodyGetUserData(b);
        for (int i = 0; i < 3; i++)
            moved->seen[3][i] = (MeReal)((double)moved->seen[3][i] + by[i]);
    }
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

static MeBool mayUseMaterials(const MstBridgeRecord *b, const McdModelPair *p, const MstMaterialPair *materials) {
    return McdModelMayHaveMaterials(p->model1) || McdModelMayHaveMaterials(p->model2) ||
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

void mst_applyProgramChanges(MstBridgeRecord *b, McdSpaceID s, MdtWorldID w) {
    compareSomeMaterials(b);
    McdSpaceVisitChangedFrozen(s, thawModel, b);
    if (!w)
        return;
    McdSpaceVisitMoved(s, beginMoved, w);
    mst_followMoved(w, b->ahead);
}
