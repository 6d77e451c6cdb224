/* Commit: makes contacts of bodies from findings, in the order of the pairs, in one thread.
 *
 * Reads the findings of a run. Writes manifolds, touches and safe times, and calls the program: if the test or the
 * contacts of a pair involve a function of the program, the pair is tested here, and ends its run, as that function may
 * change anything.
 *
 * The contact group is stored in the pair's responseData. Its first body is that of the first model or, if forces move
 * only the second model's body, that one; then normals are reversed.
 */
#include "McdContact.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MstEvents.h"
#include "step/mst_step_i.h"

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Removes all contacts and disables the group. */
static void emptyGroup(McdModelPair *p) {
    MdtContactGroupID group = p->responseData;
    if (!group)
        return;
    MdtContactGroupReset(group);
    MdtContactGroupDisable(group);
}

static MeBool areBodiesOfWorld(MstBridgeRecord *b, MdtBodyID body1, MdtBodyID body2, MdtWorldID w) {
    if ((!body1 || MdtBodyGetWorld(body1) == w) && (!body2 || MdtBodyGetWorld(body2) == w))
        return METRUE;
    if (!b->hasWarned[0])
        MeWarning(1,
                  "%s: the body of a model that touches another is of another world than the one that is stepped: they "
                  "get no contacts. Bodies of a universe's models are made in its world (MstUniverseGetWorld)",
                  MeCallerName("MstBridgeUpdateContacts"));
    b->hasWarned[0] = METRUE;
    return MEFALSE;
}

/* For assertions: the bodies of the pair's group are those of its models, with the world second. */
static inline MeBool hasGroupItsBodies(const McdModelPair *p) {
    const MeBool isSwapped = mst_isSwapped(p);
    return MdtContactGroupIsBetween(p->responseData, mst_bodyOf(isSwapped ? p->model2 : p->model1),
                                    mst_bodyOf(isSwapped ? p->model1 : p->model2));
}

/* The pair's group, created if needed; null if the world is full, or the pair's bodies make no contacts. */
static MdtContactGroupID ensureGroup(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    MEASSERT(!p->responseData || hasGroupItsBodies(p));
    if (p->responseData)
        return p->responseData;
    if ((!body1 && !body2) || body1 == body2 || !areBodiesOfWorld(b, body1, body2, w))
        return 0;
    const MeBool isSwapped = mst_isSwapped(p);
    p->responseData =
        MdtContactGroupCreateBridged(w, isSwapped ? body2 : body1, isSwapped ? body1 : body2, p, &p->responseData);
    p->forget = mst_pairForget;
    return p->responseData;
}

void mst_joinPartitions(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w) {
    const MdtContactGroupID group = ensureGroup(b, p, w);
    if (group)
        MdtContactGroupEnable(group);
}

/* Defers the group of a deeply overlapping pair while both bodies have MANY_OTHERS manifolds: otherwise a thousand
 * bodies in one place would have half a million groups of 2 kB each, which would not separate them faster. Pairs in
 * contact at the surface are never deferred. */
enum { MANY_OTHERS = 32 };

static MeBool isOverlapDeferred(const McdModelPair *p, MeReal separation) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    const MeReal deep = (MeReal)0.1 * p->stand.size; /* 0.1 of the smaller model's radius */
    return !p->responseData && body1 && body2 && -separation > deep && deep > 0 &&
           MdtBodyGetManifoldCount(body1) >= MANY_OTHERS && MdtBodyGetManifoldCount(body2) >= MANY_OTHERS;
}

/* ---- contacts that remain ---------------------------------------------------------------------------------------- */

/* Updates the parameters of the contacts if the materials have changed; positions and normals stay. */
static void keepContactsInPlace(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials) {
    const MdtContactGroupID group = p->responseData;
    const unsigned long version = mst_materialVersion(b, materials);
    MstTouch *t = p->touch;
    MEASSERT(hasGroupItsBodies(p));
    if (t->version != version)
        for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
            MdtContactSetParams(c, &materials->params);
    t->version = version;
    MdtContactGroupEnable(group);
    mst_touchCommitUnchanged(b, p);
}

static void carryContacts(MstBridgeRecord *b, const MstFinding *f) {
    mst_carryContacts(f);
    keepContactsInPlace(b, f->pair, f->materials);
}

/* ---- contacts that were found ------------------------------------------------------------------------------------ */

/* Whether the group is still the pair's: a callback may have destroyed it, or detached a model from its body. */
static MeBool isGroupOf(const McdModelPair *p, MdtContactGroupID group) {
    return group && p->responseData == group && !McdModelPairIsLeaving(p);
}

/* Calls the per-contact callbacks, and destroys the contacts that they reject. */
static void callPerContact(const MstBridgeRecord *b, MstRun *run, const McdModelPair *p, int count) {
    McdIntersectResult *result = &run->result;
    const MdtContactGroupID group = p->responseData;
    const MeProgramCall before = MeProgramEnter("MstBridgeSetPerContactCB");
    for (int i = 0; i < count && isGroupOf(p, group); i++) {
        McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = mst_materialsOf(b, from);
        if (!materials->perContactCb || !MdtContactGroupHas(group, run->made[i]))
            continue;
        if (!materials->perContactCb(result, from, run->made[i]) && isGroupOf(p, group) &&
            MdtContactGroupHas(group, run->made[i]))
            MdtContactGroupDestroyContact(group, run->made[i]);
    }
    MeProgramLeave(&before);
}

/* Replaces the group's contacts by those found; returns the number for which there was room. */
static int replaceContacts(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, MdtContactGroupID group) {
    MEASSERT(f->first >= 0 && f->first + f->count <= run->foundCount);
    return MdtContactGroupRenew(group, &run->found[f->first], f->count, b->ahead, run->made);
}

/* The group for the contacts found; null if there are none, or no room, or the overlap is deferred. */
static MdtContactGroupID contactGroupOf(MstBridgeRecord *b, const MstFinding *f, MdtWorldID w) {
    return f->count > 0 && !isOverlapDeferred(f->pair, f->separation) ? ensureGroup(b, f->pair, w) : 0;
}

/* Replaces the pair's contacts with those that the narrow phase found. */
static void commitContacts(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, MdtWorldID w) {
    const MdtContactGroupID group = contactGroupOf(b, f, w);
    if (!group) {
        emptyGroup(f->pair);
        return;
    }
    replaceContacts(b, run, f, group);
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
}

static void callIntersect(MstBridgeRecord *b, MstRun *run, MstFinding *f) {
    const MeProgramCall before = MeProgramEnter("MstBridgeSetIntersectCB");
    f->materials->intersectCb(&run->result);
    MeProgramLeave(&before);
    if (McdModelPairIsLeaving(f->pair))
        return;
    mst_checkContacts(b, run);
    mst_convertContacts(b, run, f);
}

static void callPerPair(MstRun *run, const MstFinding *f, MdtContactGroupID group) {
    const MeProgramCall before = MeProgramEnter("MstBridgeSetPerPairCB");
    const MeBool isToStay = f->materials->perPairCb(&run->result, group);
    MeProgramLeave(&before);
    if (!isToStay)
        emptyGroup(f->pair);
}

/* Replaces the pair's contacts, as commitContacts does, and calls the program's callbacks. For a pair that was just
 * tested. */
static void commitWithCallbacks(MstBridgeRecord *b, MstRun *run, MstFinding *f, MdtWorldID w) {
    const MstMaterialPair *materials = f->materials;
    McdModelPair *p = f->pair;
    if (run->result.touch && materials->intersectCb)
        callIntersect(b, run, f);
    const MdtContactGroupID group = McdModelPairIsLeaving(p) ? 0 : contactGroupOf(b, f, w);
    if (!group) {
        emptyGroup(p);
        return;
    }
    const int renewed = replaceContacts(b, run, f, group);
    callPerContact(b, run, p, renewed);
    if (!isGroupOf(p, group))
        return;
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
    if (materials->perPairCb)
        callPerPair(run, f, group);
}

static void recordTestOf(MstBridgeRecord *b, const MstFinding *f, int numContacts) {
    if (f->pair->touch)
        mst_recordTest(f, numContacts, mst_materialVersion(b, f->materials));
    else if (f->count > 0) /* the world or the memory was full: test the pair again in the next step */
        McdModelPairForgetTest(f->pair);
}

/* After a test: updates the pair's touch, records the test, and sets safe times of fast bodies. */
static void recordTestAndTouch(MstBridgeRecord *b, const MstFinding *f, MdtWorldID w) {
    const MdtContactGroupID group = f->pair->responseData;
    const int numContacts = group ? MdtContactGroupGetCount(group) : 0;
    mst_touchCommitTested(b, f->pair, numContacts, f->count, f->separation);
    recordTestOf(b, f, numContacts);
    mst_clampFastPair(b, f, numContacts > 0, w);
}

/* ---- pairs ------------------------------------------------------------------------------------------------------- */

static void commitTested(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, MdtWorldID w) {
    if (f->hasInteraction)
        commitContacts(b, run, f, w);
    recordTestAndTouch(b, f, w);
}

static void testAndCommit(MstBridgeRecord *b, MstRun *run, MstFinding *f, MdtWorldID w) {
    mst_testPair(b, run, f);
    if (f->hasInteraction && !McdModelPairIsLeaving(f->pair))
        commitWithCallbacks(b, run, f, w);
    if (mst_hasCallback(f->materials))
        mst_beginRound(b); /* callbacks may have changed any input */
    if (!McdModelPairIsLeaving(f->pair))
        recordTestAndTouch(b, f, w);
}

static MeU32 kindOf(McdModelID m) {
    const MdtBodyID b = mst_bodyOf(m);
    return !b ? MstSensesFixed : MdtBodyIsMover(b) ? MstSensesMoved : MstSensesDynamic;
}

static MeBool finds(McdModelID sensor, McdModelID other) {
    return McdModelIsSensor(sensor) && !McdModelIsSensor(other) && (McdModelGetSensorMask(sensor) & kindOf(other)) != 0;
}

/* An overlap with a sensor gives an event, but no contacts. Two sensors do not detect each other. */
static void testAndCommitSensor(MstBridgeRecord *b, MstRun *run, McdModelPair *p) {
    mst_destroyGroup(p);
    if (!finds(p->model1, p->model2) && !finds(p->model2, p->model1)) {
        mst_pairForget(p);
        return;
    }
    if (!mst_intersectPair(run, p) || McdModelPairIsLeaving(p))
        return;
    mst_checkContacts(b, run);
    mst_touchCommitSensor(b, p, &run->result);
}

/* Removes contacts and touch as at goodbye, and invalidates the last test, so that it is not reused if the collision is
 * enabled again. */
static void removeContacts(McdModelPair *p) {
    mst_pairForget(p);
    McdModelPairForgetTest(p);
}

/* For the pair's next test, which may be on another thread while bodies get contacts: whether the body on a fixed model
 * has joints. */
static void noteJoints(McdModelPair *p) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    if (!body1 != !body2)
        p->isJointed = MdtBodyHasJoints(body1 ? body1 : body2);
}

static void commitPair(MstBridgeRecord *b, MstRun *run, MstFinding *f, MdtWorldID w) {
    if (f->updated) {
        mst_touchList(&b->events, f->updated, f->isUndecided);
        return;
    }
    switch (f->outcome) {
    case MST_NOTHING:
        return;
    case MST_KEPT:
        keepContactsInPlace(b, f->pair, f->materials);
        return;
    case MST_CARRIED:
        carryContacts(b, f);
        return;
    case MST_TESTED:
        noteJoints(f->pair);
        commitTested(b, run, f, w);
        return;
    case MST_TO_TEST:
        noteJoints(f->pair);
        testAndCommit(b, run, f, w);
        return;
    case MST_TO_REMOVE:
        removeContacts(f->pair);
        return;
    case MST_TO_SENSE:
        testAndCommitSensor(b, run, f->pair);
        return;
    case MST_TO_WAIT:
        mst_clampLaggingBody(b, f);
        return;
    }
}

void mst_commitRun(MstBridgeRecord *b, MstRun *run, MdtWorldID w) {
    for (int i = 0; i < run->pairCount; i++)
        commitPair(b, run, &run->finding[i], w);
}
