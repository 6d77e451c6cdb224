/* Collide: the narrow phase of a run of pairs. Its results are findings, the input of update and commit.
 *
 * Reads models, fixed models near them, poses and motion of their bodies, materials, and each pair's manifold and
 * touch. Writes the run, and Mcd's record of each pair's last test. Nothing here calls the program, allocates from a
 * pool, or writes to anything that two pairs share (with the two exceptions in mst_step_i.h).
 *
 * A pair that has not moved, to the last bit, since its last test keeps its contacts. If it has moved only a little,
 * its contacts are moved with its bodies. All other pairs are tested.
 */
#include "McdContact.h"
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtBody.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "step/mst_step_i.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- memory that will be read ------------------------------------------------------------------------------------ */

/* Prefetch distance, in pairs, for a pair's models, touch and group; that for the pair itself is twice as far. In a
 * heap of 1000 boxes, doubling both costs the same. */
enum { CONTENT_AHEAD = 4 };

void mst_prefetchModels(McdModelPair *const pairs[], int i, int count) {
    enum { MODEL = 3 * ME_CACHE_LINE }; /* bytes of a model that the loop over pairs reads (McdModelRecord) */
    if (i + 2 * CONTENT_AHEAD < count)
        me_prefetch(pairs[i + 2 * CONTENT_AHEAD], sizeof *pairs[i]);
    if (i + CONTENT_AHEAD >= count)
        return;
    me_prefetch(pairs[i + CONTENT_AHEAD]->model1, MODEL);
    me_prefetch(pairs[i + CONTENT_AHEAD]->model2, MODEL);
}

static void prefetchContacts(McdModelPair *const pairs[], int i, int count) {
    if (i + CONTENT_AHEAD >= count)
        return;
    me_prefetch(pairs[i + CONTENT_AHEAD]->touch, 2 * ME_CACHE_LINE);
    me_prefetch(pairs[i + CONTENT_AHEAD]->responseData, MST_GROUP);
}

/* ---- pairs whose contacts remain --------------------------------------------------------------------------------- */

unsigned long mst_moveCountOf(McdModelID m) {
    const MdtBodyID body = mst_bodyOf(m);
    return body ? MdtBodyGetMoves(body) : 0;
}

MeBool mst_hasCallback(const MstMaterialPair *materials) {
    return materials->intersectCb || materials->perContactCb || materials->perPairCb;
}

/* The outcome for a pair that has not moved enough for a new test:
 *     MST_NOTHING   the last test found no contacts
 *     MST_KEPT      both bodies have the same pose as at that test, to the last bit
 *     MST_CARRIED   the bodies have moved since then only by their last step; f->hasMoved: which of the group's bodies
 *     MST_TO_TEST   contacts are missing, the touch does not match them, or they cannot be carried */
static MstOutcome outcomeOfLastTest(const MstBridgeRecord *b, MstFinding *f) {
    const McdModelPair *p = f->pair;
    const MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    const McdModelID model[2] = {p->model1, p->model2};
    const MeBool isSwapped = mst_isSwapped(p);
    if (!t)
        return group ? MST_TO_TEST : MST_NOTHING;
    if (t->found == 0)
        return mst_touchIsTouching(&b->events, t) ? MST_TO_TEST : MST_NOTHING;
    if (!group || MdtContactGroupGetCount(group) != t->found)
        return MST_TO_TEST;
    if (t->moves[0] == mst_moveCountOf(p->model1) && t->moves[1] == mst_moveCountOf(p->model2))
        return MST_KEPT;
    if (t->carried >= MST_CARRIES || b->substep > 0)
        return MST_TO_TEST;
    for (int k = 0; k < 2; k++) {
        const MeBool moved = mst_moveCountOf(model[k]) != t->moves[k];
        if (moved && !MdtBodyMovedByStep(mst_bodyOf(model[k]), t->moves[k]))
            return MST_TO_TEST;
        f->hasMoved[isSwapped ? 1 - k : k] = moved;
    }
    return MdtContactGroupIsFlat(group) ? MST_CARRIED : MST_TO_TEST;
}

/* The outcome if the last test is still valid; else MST_TO_TEST, and the inputs of the coming test are recorded. The
 * last test of a fast pair never is: its time of impact was looked for within another time. Pairs that have moved a
 * little are spared a test only in large partitions: small ones are solved so exactly that contact errors of 1e-7 m
 * would show (as under a mass ratio of a million). */
static MstOutcome outcomeWithoutTest(const MstBridgeRecord *b, MstFinding *f) {
    McdModelPair *p = f->pair;
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    const MeBool mayMove[2] = {body1 != 0, body2 != 0};
    const McdPairChange change = McdModelPairCompare(p, f->isFast ? 0 : b->reuse, mayMove);
    if (change == McdPairHasChanged)
        return MST_TO_TEST;
    if (!f->isFast && !mst_hasCallback(f->materials) &&
        (change != McdPairHasMoved || mst_isInLargeIsland(body1) || mst_isInLargeIsland(body2))) {
        const MstOutcome outcome = outcomeOfLastTest(b, f);
        if (outcome != MST_TO_TEST)
            return outcome;
    }
    McdModelPairStoreTest(p);
    return MST_TO_TEST;
}

/* ---- tests ------------------------------------------------------------------------------------------------------- */

static void convertContact(MdtFoundContact *found, const McdContact *from, MeBool isSwapped,
                           const MstMaterialPair *materials) {
    McdExactContact exact;
    McdContactGetExact(from, &exact);
    for (int i = 0; i < 3; i++) {
        found->normal[i] = isSwapped ? -from->normal[i] : from->normal[i];
        found->position[i] = exact.position[i];
    }
    for (int k = 0; k < 2; k++) {
        const int side = isSwapped ? 1 - k : k;
        found->radius[side] = (MeReal)exact.radius[k];
        found->rim[side] = exact.rim[k];
        found->isVertex[side] = exact.isVertex[k];
        memcpy(found->axis[side], exact.axis[k], sizeof exact.axis[k]);
    }
    found->depth = -exact.separation;
    found->feature = from->feature;
    found->params = &materials->params;
}

void mst_convertContacts(const MstBridgeRecord *b, MstRun *run, MstFinding *f) {
    const McdIntersectResult *result = &run->result;
    const MeBool isSwapped = mst_isSwapped(f->pair);
    f->count = result->contactCount;
    f->separation = MEINFINITY;
    MEASSERT(f->count <= result->contactMaxCount && f->first + f->count <= run->foundMax);
    for (int i = 0; i < f->count; i++) {
        const McdContact *from = &result->contacts[i];
        const MstMaterialPair *materials = f->outcome == MST_TESTED ? f->materials : mst_materialsOf(b, from);
        convertContact(&run->found[f->first + i], from, isSwapped, materials);
        f->separation = MeMIN(f->separation, from->separation);
    }
    run->foundCount = f->first + f->count;
}

static void beginResult(MstRun *run) {
    memset(&run->result, 0, sizeof run->result);
    run->result.contacts = run->contacts;
    run->result.contactMaxCount = run->contactMax;
}

MeBool mst_intersectPair(MstRun *run, McdModelPair *p) {
    beginResult(run);
    return McdIntersect(p, &run->result);
}

/* Removes contacts that the program has made or changed and that are invalid: numbers beyond single precision, a zero
 * normal, or no instance. */
void mst_checkContacts(MstBridgeRecord *b, MstRun *run) {
    McdIntersectResult *result = &run->result;
    const int count = MeCLAMP(result->contactCount, 0, run->contactMax);
    MeBool areGood = count == result->contactCount;
    result->contactCount = 0;
    for (int i = 0; i < count; i++) {
        const McdContact *c = &result->contacts[i];
        const double square = (double)MeVector3MagnitudeSqr(c->normal);
        MeBool isGood = square > 0 && square <= (double)FLT_MAX && fabs((double)c->separation) <= (double)FLT_MAX &&
                        c->instance1 && c->instance2;
        for (int k = 0; k < 3; k++)
            isGood = isGood && fabs((double)c->position[k]) <= (double)FLT_MAX;
        areGood = areGood && isGood;
        if (isGood)
            result->contacts[result->contactCount++] = *c;
    }
    if (!areGood && !b->hasWarned[1])
        MeWarning(
            1,
            "%s: a function of the program has left contacts that are none: more of them than there is place for, "
            "numbers that are not finite, a normal without a length, or no instance; they are left out",
            MeCallerName("MstBridgeUpdateContacts"));
    b->hasWarned[1] = b->hasWarned[1] || !areGood;
}

static void storeResult(const MstBridgeRecord *b, MstRun *run, MstFinding *f) {
    const MeBool mayMove[2] = {mst_bodyOf(f->pair->model1) != 0, mst_bodyOf(f->pair->model2) != 0};
    if (McdModelPairReplaceInternal(f->pair, mayMove, &run->result))
        McdModelPairForgetTest(f->pair);
    f->first = run->foundCount;
    mst_convertContacts(b, run, f);
}

static void testPlainPair(const MstBridgeRecord *b, MstRun *run, MstFinding *f) {
    beginResult(run);
    f->hasInteraction = McdModelPairIntersectPlain(f->pair, &run->result);
    storeResult(b, run, f);
}

void mst_testPair(MstBridgeRecord *b, MstRun *run, MstFinding *f) {
    McdModelPair *p = f->pair;
    f->hasInteraction = mst_intersectPair(run, p);
    mst_checkContacts(b, run);
    if (!McdModelGetTransformPtr(p->model1) || !McdModelGetTransformPtr(p->model2))
        run->result.contactCount = 0; /* a function of the program has removed a transform */
    storeResult(b, run, f);
}

void mst_markNoCollidePairs(McdModelPair *const pairs[], int count) {
    for (int i = 0; i < count; i++) {
        const MdtBodyID body1 = mst_bodyOf(pairs[i]->model1), body2 = mst_bodyOf(pairs[i]->model2);
        pairs[i]->isHeldApart = body1 && body2 && MdtBodiesAreNoCollide(body1, body2);
    }
}

/* Whether collision of the pair is disabled: by a joint, or because both models have the same body. Sensors detect
 * models of their own body all the same. */
static MeBool isDisabled(const MstBridgeRecord *b, const McdModelPair *p, MeU32 traits) {
    return (b->hasNoCollide && p->isHeldApart) || (mst_isOneBody(p) && !(traits & McdPairHasSensor));
}

MeBool mst_isPlainPair(const MstBridgeRecord *b, const McdModelPair *p) {
    MeU32 m[2];
    const MeU32 traits = McdModelPairGetTraits(p, m);
    const MeBool separates = (p->touch || p->responseData) && isDisabled(b, p, traits);
    return !separates && m[0] < b->materialCount && m[1] < b->materialCount && !(traits & McdPairHasSensor) &&
           McdModelPairIsPlain(p) && !mst_hasCallback(mst_materialPair(b, m[0], m[1]));
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* The outcome that follows from the models alone; MST_TO_TEST if it depends on a test. */
static MstOutcome outcomeOfModels(const MstBridgeRecord *b, const McdModelPair *p, MeU32 traits) {
    if (traits & (McdPairIsAsleep | McdPairIsGone))
        return MST_NOTHING;
    if (isDisabled(b, p, traits))
        return p->touch || p->responseData ? MST_TO_REMOVE : MST_NOTHING;
    if (b->substep > 0 && !mst_mayCollide(p))
        return mst_mustClampLagging(p) ? MST_TO_WAIT : MST_NOTHING;
    if (traits & McdPairHasSensor)
        return MST_TO_SENSE;
    if (mst_freeBodyOf(p->model1) || mst_freeBodyOf(p->model2))
        return MST_TO_TEST;
    return p->touch || p->responseData ? MST_TO_REMOVE : MST_NOTHING;
}

static void collidePair(const MstBridgeRecord *b, MstRun *run, McdModelPair *p) {
    MEASSERT(run->pairCount < MST_RUN);
    MstFinding *f = &run->finding[run->pairCount++];
    MeU32 material[2];
    const MeU32 traits = McdModelPairGetTraits(p, material);
    f->pair = p;
    f->isFast = (traits & McdPairIsFast) != 0;
    f->updated = 0;
    f->count = 0;
    f->timeToImpact = MST_UNKNOWN;
    f->outcome = outcomeOfModels(b, p, traits);
    if (f->outcome == MST_TO_WAIT)
        f->timeToImpact = mst_timeToWait(b, p);
    if (f->outcome != MST_TO_TEST)
        return;
    f->materials = mst_materialPair(b, material[0], material[1]);
    p->isWithinLargeIsland = f->isFast && mst_isWithinLargeIsland(p);
    p->mayTurnRound = f->materials->params.restitution > 0;
    f->outcome = outcomeWithoutTest(b, f);
    if (f->outcome != MST_TO_TEST || mst_hasCallback(f->materials) || !McdModelPairIsPlain(p))
        return; /* tests and contacts that involve the program are left to commit */
    f->outcome = MST_TESTED;
    testPlainPair(b, run, f);
    McdModelPairStoreGap(p, f->count == 0 ? run->result.apart : 0);
    if (f->isFast && !p->isWithinLargeIsland)
        f->timeToImpact = mst_timeToImpact(b, p, METRUE);
}

/* The maximum number of pairs in a run. In the first sub-step, pairs are independent of each other's commits. In later
 * ones, a pair may depend on a body that the commit of an earlier pair has woken. */
static int maxPairsOfRun(const MstBridgeRecord *b) {
    return b->substep == 0 ? MST_RUN : 1;
}

/* All pairs are collided before any is updated: the code of both together exceeds an instruction cache of 32 kB, and
 * would be loaded again for each pair. */
int mst_collideRun(const MstBridgeRecord *b, MstRun *run, McdModelPair *const pairs[], int count) {
    const int max = MeMIN(count, maxPairsOfRun(b));
    run->pairCount = run->foundCount = 0;
    while (run->pairCount < max && run->foundCount + run->contactMax <= run->foundMax) {
        const int i = run->pairCount;
        mst_prefetchModels(pairs, i, count);
        prefetchContacts(pairs, i, count);
        collidePair(b, run, pairs[i]);
        if (run->finding[i].outcome == MST_TO_TEST || run->finding[i].outcome == MST_TO_SENSE)
            break;
    }
    MEASSERT(run->pairCount > 0);
    for (int i = 0; i < run->pairCount; i++)
        mst_updatePair(b, run, &run->finding[i]);
    return run->pairCount;
}
