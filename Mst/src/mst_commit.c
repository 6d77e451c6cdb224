/* Commit: makes contacts of bodies from findings, in the pairs' order, in one thread.
 *
 * Reads the findings of a run. Writes manifolds, touches and safe times, and calls the program: a pair whose test or
 * contacts a function of the program sees is tested here, and ends its run, as that function may change anything.
 *
 * The contact group is kept in the pair's responseData. It pushes the first model's body; where only the second model
 * has a body, that one is the group's first, and normals are turned.
 */
#include "McdContact.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "mst_i.h"

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Whether the pair's group, if any, has the pair's bodies and refers to the pair. */
static MeBool ownsGroup(const McdModelPair *p) {
    const MdtContactGroupID group = p->responseData;
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    return !group || (MdtContactGroupGetGenerator(group) == (void *)p &&
                      MdtContactGroupGetBody(group, 0) == (body1 ? body1 : body2) &&
                      MdtContactGroupGetBody(group, 1) == (body1 ? body2 : 0));
}

static void destroyGroup(McdModelPair *p) {
    if (p->responseData)
        MdtContactGroupDestroy((MdtContactGroupID)p->responseData);
    MEASSERT(!p->responseData); /* the group has cleared it */
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
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    if (p->responseData)
        return p->responseData;
    const MdtContactGroupID group = MdtContactGroupCreate(w);
    if (group) {
        MdtContactGroupSetBodies(group, body1 ? body1 : body2, body1 ? body2 : 0);
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

/* Of many bodies in one place each overlaps with each, and a thousand would have half a million groups, of 2 kB. What
 * is deep in each other, while both touch so many others, waits until these have separated: it would be pushed apart
 * no faster. What meets at its surface never waits. */
enum { MANY_OTHERS = 32 };

static MeBool mustWait(const McdModelPair *p, MeReal separation) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    const MeReal deep = (MeReal)0.1 * p->stand.size; /* of the smaller one's radius */
    return !p->responseData && body1 && body2 && -separation > deep && deep > 0 &&
           MdtBodyGetManifoldCount(body1) >= MANY_OTHERS && MdtBodyGetManifoldCount(body2) >= MANY_OTHERS;
}

/* ---- contacts that remain ---------------------------------------------------------------------------------------- */

/* Parameters follow the materials. */
static void keepContacts(MstBridgeRecord *b, McdModelPair *p, MstMaterialPair *materials) {
    const MdtContactGroupID group = p->responseData;
    const unsigned long version = mst_materialVersion(b, materials);
    MstTouch *t = p->touch;
    if (t->version != version)
        for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
            MdtContactSetParams(c, &materials->params);
    t->version = version;
    mst_push(b, p);
    MdtContactGroupEnable(group);
    mst_touchNoteAgain(b, p);
}

static void carryContacts(MstBridgeRecord *b, const MstFinding *f) {
    mst_carry(f);
    keepContacts(b, f->pair, f->materials);
}

/* ---- contacts that were found ------------------------------------------------------------------------------------ */

/* Calls the callback of a contact, and destroys the contact if it is rejected. */
static void callPerContact(const MstBridgeRecord *b, MstRun *run, MdtContactGroupID group, int count) {
    McdIntersectResult *result = &run->result;
    for (int i = 0; i < count; i++) {
        McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = mst_materialsOf(b, from);
        if (materials->perContactCb && !materials->perContactCb(result, from, run->made[i]))
            MdtContactGroupDestroyContact(group, run->made[i]);
    }
}

/* Replaces the group's contacts by those found; returns how many there was room for. */
static int renewContacts(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, MdtContactGroupID group) {
    return MdtContactGroupRenew(group, &run->found[f->first], f->count, b->ahead, run->made);
}

/* For the contacts that were found; null: there are none, or is no room for them. */
static MdtContactGroupID contactGroupOf(const MstFinding *f, MdtWorldID w) {
    return f->count > 0 && !mustWait(f->pair, f->separation) ? ensureGroup(f->pair, w) : 0;
}

/* As collide found them. */
static void commitContacts(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, MdtWorldID w) {
    const MdtContactGroupID group = contactGroupOf(f, w);
    if (!group) {
        emptyGroup(f->pair);
        return;
    }
    renewContacts(b, run, f, group);
    mst_push(b, f->pair);
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
}

/* The same, with the program's callbacks; the pair has just been tested. */
static void commitWithCallbacks(MstBridgeRecord *b, MstRun *run, MstFinding *f, MdtWorldID w) {
    const MstMaterialPair *materials = f->materials;
    McdIntersectResult *result = &run->result;
    if (result->touch && materials->intersectCb) {
        materials->intersectCb(result);
        mst_convertContacts(b, run, f);
    }
    const MdtContactGroupID group = contactGroupOf(f, w);
    if (!group) {
        emptyGroup(f->pair);
        return;
    }
    const int renewed = renewContacts(b, run, f, group);
    mst_push(b, f->pair);
    callPerContact(b, run, group, renewed);
    if (MdtContactGroupGetCount(group) > 0)
        MdtContactGroupEnable(group);
    if (materials->perPairCb && !materials->perPairCb(result, group))
        emptyGroup(f->pair);
}

static void rememberTest(MstBridgeRecord *b, const MstFinding *f, int held) {
    if (f->pair->touch)
        mst_rememberTest(f, held, mst_materialVersion(b, f->materials));
    else if (f->count > 0) /* the world, or memory, was full: there may be room in the next step */
        McdModelPairForgetTest(f->pair);
}

static void finishTest(MstBridgeRecord *b, const MstFinding *f, McdSpaceID s, MdtWorldID w) {
    const MdtContactGroupID group = f->pair->responseData;
    const int held = group ? MdtContactGroupGetCount(group) : 0;
    mst_touchNote(b, f->pair, held, f->count, f->separation);
    rememberTest(b, f, held);
    mst_followFast(b, f, f->count > 0, s, w);
}

/* ---- pairs ------------------------------------------------------------------------------------------------------- */

static void commitTested(MstBridgeRecord *b, const MstRun *run, const MstFinding *f, McdSpaceID s, MdtWorldID w) {
    if (f->isKnown)
        commitContacts(b, run, f, w);
    finishTest(b, f, s, w);
}

static MeBool hasFoundContacts(const McdModelPair *p) {
    const MstTouch *t = p->touch;
    return t && t->found != 0;
}

static void testAndCommit(MstBridgeRecord *b, MstRun *run, MstFinding *f, McdSpaceID s, MdtWorldID w) {
    if (!mst_testPairIfChanged(b, run, f)) {
        if (hasFoundContacts(f->pair))
            keepContacts(b, f->pair, f->materials);
        return;
    }
    if (f->isKnown)
        commitWithCallbacks(b, run, f, w);
    if (mst_hasCallback(f->materials))
        mst_beginRound(b); /* callbacks may have changed any input */
    finishTest(b, f, s, w);
}

/* A sensor's overlap makes an event, but no contacts. Two sensors do not overlap. */
static void senseAndCommit(MstBridgeRecord *b, MstRun *run, McdModelPair *p) {
    destroyGroup(p);
    if (McdModelIsSensor(p->model1) && McdModelIsSensor(p->model2))
        return;
    if (mst_intersectPair(run, p))
        mst_touchNoteSensor(b, p, &run->result);
}

/* As at the space's goodbye. The last test is no longer valid when they collide again. */
static void forgetContacts(McdModelPair *p) {
    mst_pairForget(p);
    McdModelPairForgetTest(p);
}

static void commitPair(MstBridgeRecord *b, MstRun *run, MstFinding *f, McdSpaceID s, MdtWorldID w) {
    if (f->updated) {
        mst_touchList(&b->events, f->updated, f->isUndecided);
        return;
    }
    switch (f->outcome) {
    case MST_NOTHING:
        return;
    case MST_KEPT:
        keepContacts(b, f->pair, f->materials);
        return;
    case MST_CARRIED:
        carryContacts(b, f);
        return;
    case MST_TESTED:
        commitTested(b, run, f, s, w);
        return;
    case MST_TO_TEST:
        testAndCommit(b, run, f, s, w);
        return;
    case MST_TO_PART:
        forgetContacts(f->pair);
        return;
    case MST_TO_SENSE:
        senseAndCommit(b, run, f->pair);
        return;
    case MST_TO_WAIT:
        mst_waitFor(b, f);
        return;
    }
}

void mst_commitRun(MstBridgeRecord *b, MstRun *run, McdSpaceID s, MdtWorldID w) {
    for (int i = 0; i < run->pairCount; i++)
        commitPair(b, run, &run->finding[i], s, w);
}
