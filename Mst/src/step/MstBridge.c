/* The bridge: the material table, and the loop over pairs, which takes runs of them from collide to commit. */
#include "McdFrame.h"
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "MeProfile.h"
#include "mst_i.h"
#include <limits.h>
#include <string.h>

void mst_warnGone(const void *p, const char *what, const char *function) {
    if (p)
        MeWarning(1, "%s: %p is no %s: it has been destroyed, or never was one", function, p, what);
    else
        MeWarning(1, "%s: null is no %s", function, what);
}

MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function) {
    MstBridgeRecord *record = (MstBridgeRecord *)b;
    if (record && MST_IS_KNOWN(b, MST_BRIDGE) && record->magic == MST_BRIDGE)
        return record;
    mst_warnGone(b, "bridge", function);
    return 0;
}

/* ---- life ---------------------------------------------------------------------------------------------------- */

void mst_runTerm(MstRun *run) {
    MeMemoryGive(run->contacts);
    MeMemoryGive(run->found);
    MeMemoryGive(run->made);
}

/* Room for contacts of a run: so many per pair on average. */
MeBool mst_runInit(MstRun *run, int most, const char *function) {
    enum { AVERAGE = 8 };
    if (most > INT_MAX - AVERAGE * MST_RUN)
        most = INT_MAX - AVERAGE * MST_RUN;
    MstRun made = {.contactMax = most, .foundMax = most + AVERAGE * MST_RUN};
    made.contacts = MeMemoryTake((size_t)made.contactMax, sizeof *made.contacts, function, "contacts");
    if (made.contacts)
        made.found = MeMemoryTake((size_t)made.foundMax, sizeof *made.found, function, "contacts");
    if (made.found)
        made.made = MeMemoryTake((size_t)made.contactMax, sizeof *made.made, function, "contacts");
    if (!made.made) {
        mst_runTerm(&made);
        return MEFALSE;
    }
    mst_runTerm(run);
    *run = made;
    return METRUE;
}

/* False: there is no memory, and all is as it was. */
static MeBool makeContacts(MstBridgeRecord *b, int most, const char *function) {
    if (!mst_runInit(&b->run, most, function))
        return MEFALSE;
    mst_workersTerm(b); /* their runs have the same room */
    return METRUE;
}

static void freeAll(MstBridgeRecord *b) {
    if (b->bridge.pairs)
        McdModelPairContainerDestroy(b->bridge.pairs);
    for (unsigned int m = 0; m < b->materialCount; m++)
        MeMemoryGive(b->materials[m]);
    MeMemoryGive(b->materials);
    mst_workersTerm(b);
    mst_runTerm(&b->run);
    mst_eventsTerm(b);
    MeMemoryGive(b->clamped);
    MeMemoryGive(b->thawed);
    MeMemoryGive(b);
}

/* One more material: a row of pairs, with itself and with all before it, which stays where it is. */
static MeBool addMaterial(MstBridgeRecord *b, const char *function) {
    const unsigned int m = b->materialCount, more = m ? 2 * m : 8;
    if (m == b->materialRoom) {
        if (!MeMemoryGrow(&b->materials, m, more, sizeof *b->materials, function, "materials"))
            return MEFALSE;
        b->materialRoom = more;
    }
    MstMaterialRecord *row = MeMemoryTakeZeroed((size_t)m + 1, sizeof *row, function, "a material");
    if (!row)
        return MEFALSE;
    for (unsigned int i = 0; i <= m; i++) {
        MdtContactParamsReset(&row[i].pair.params);
        row[i].pair.params.velThreshold *= McdFrameworkGetLengthScale(b->frame);
        row[i].known = row[i].pair.params;
    }
    b->materials[b->materialCount++] = row;
    return METRUE;
}

MstBridgeID MEAPI MstBridgeCreate(McdFrameworkID frame, const unsigned int maxMaterials) {
    static const char function[] = "MstBridgeCreate";
    if (!frame) {
        MeWarning(1, "MstBridgeCreate: frame is null");
        return 0;
    }
    if (!MeProgramMayChange(function))
        return 0;
    const MeBool isLimited = maxMaterials != MeNoLimit;
    if (isLimited && (maxMaterials == 0 || maxMaterials > MST_MATERIALS))
        MeWarning(1, "MstBridgeCreate: maxMaterials is %u: it must be 1 .. %d, or MeNoLimit", maxMaterials,
                  MST_MATERIALS);
    MstBridgeRecord *b = MeMemoryTakeZeroed(1, sizeof *b, function, "a bridge");
    if (!b)
        return 0;
    b->frame = frame;
    b->materialLimit = (MeLimit){.most = isLimited ? (int)MeCLAMP(maxMaterials, 1, MST_MATERIALS) : MeNoLimit,
                                 .name = "MstBridgeCreate's maxMaterials"};
    b->reuse = (MeReal)MST_CONTACT_REUSE;
    b->events.list = 1; /* touches that were in none have 0 */
    b->bridge.pairs = McdModelPairContainerCreate(MST_PAIRS);
    if (!b->bridge.pairs || !makeContacts(b, MST_CONTACTS, function) || !addMaterial(b, function)) {
        freeAll(b);
        return 0;
    }
    b->magic = MST_BRIDGE;
    MeHandleEnter(&b->handle, b, MST_BRIDGE);
    return &b->bridge;
}

void MEAPI MstBridgeDestroy(const MstBridgeID b) {
    MstBridgeRecord *record = (MstBridgeRecord *)b;
    if (b && !MeHandleIsLive(b, MST_BRIDGE))
        mst_warnGone(b, "bridge", "MstBridgeDestroy");
    if (!b || !MeHandleIsLive(b, MST_BRIDGE) || !MeStageIsFree(&record->stage, "MstBridgeDestroy"))
        return;
    record->magic = 0;
    MeHandleLeave(&record->handle);
    freeAll(record);
}

/* ---- materials ------------------------------------------------------------------------------------------------ */

MstMaterialID MEAPI MstBridgeGetNewMaterial(const MstBridgeID b) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetNewMaterial");
    if (!record)
        return MstBridgeGetDefaultMaterial();
    const MstMaterialID m = record->materialCount;
    if (m >= (MstMaterialID)record->materialLimit.most) {
        MeLimitWarn(&record->materialLimit, "MstBridgeGetNewMaterial", "more materials");
        return MstBridgeGetDefaultMaterial();
    }
    return addMaterial(record, "MstBridgeGetNewMaterial") ? m : MstBridgeGetDefaultMaterial();
}

static MstMaterialID knownMaterial(const MstBridgeRecord *b, MstMaterialID m, const char *function) {
    if (m < b->materialCount)
        return m;
    MeWarning(1, "%s: there is no material %u; there are %u: see MstBridgeGetNewMaterial. The default one is taken",
              MeCallerName(function), m, b->materialCount);
    return MstBridgeGetDefaultMaterial();
}

static MstMaterialPair *materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2,
                                     const char *function) {
    const MstMaterialID a = knownMaterial(b, m1, function), c = knownMaterial(b, m2, function);
    const MstMaterialID high = MeMAX(a, c), low = MeMIN(a, c);
    MEASSERT(high < b->materialCount && b->materialCount <= b->materialRoom);
    return &b->materials[high][low].pair;
}

MstMaterialPair *mst_materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2) {
    return materialPair(b, m1, m2, "MstHandleCollisions");
}

MstMaterialPair *mst_materialsOf(const MstBridgeRecord *b, const McdContact *c) {
    return mst_materialPair(b, McdGeometryInstanceGetMaterial(c->instance1),
                            McdGeometryInstanceGetMaterial(c->instance2));
}

unsigned long mst_materialVersion(MstBridgeRecord *b, MstMaterialPair *pair) {
    MstMaterialRecord *record = (MstMaterialRecord *)pair;
    if (record->lookedIn == b->round)
        return record->version;
    record->lookedIn = b->round;
    if (record->version == 0 || memcmp(&record->pair, &record->seen, sizeof record->pair) != 0) {
        record->seen = record->pair;
        record->version = ++b->lastVersion;
    }
    return record->version;
}

/* Computes the versions of all, unless there are more pairs of materials than pairs of models. */
static void lookAtMaterials(MstBridgeRecord *b, int count) {
    if (0.5 * b->materialCount * (b->materialCount + 1.0) > (double)count)
        return;
    for (unsigned int i = 0; i < b->materialCount; i++)
        for (unsigned int k = 0; k <= i; k++)
            mst_materialVersion(b, &b->materials[i][k].pair);
    b->allSeenIn = b->round;
}

void mst_beginRound(MstBridgeRecord *b) {
    b->round++;
    McdFrameworkBeginRound(b->frame);
}

static MstMaterialPair *pairOf(MstBridgeID b, MstMaterialID m1, MstMaterialID m2, const char *function) {
    const char *const before = MeMessagesAs(function); /* of two materials that are none one is named */
    MstBridgeRecord *record = mst_bridgeCheck(b, function);
    MstMaterialPair *pair = record ? materialPair(record, m1, m2, function) : 0;
    MeMessagesAs(before);
    return pair;
}

MdtContactParamsID MEAPI MstBridgeGetContactParams(const MstBridgeID b, const MstMaterialID m1,
                                                   const MstMaterialID m2) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetContactParams");
    return pair ? &pair->params : 0;
}

void MEAPI MstBridgeSetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                   const MstIntersectCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetIntersectCB");
    if (!pair)
        return;
    pair->intersectCb = cb;
    mst_wakeTouching(mst_bridgeCheck(b, "MstBridgeSetIntersectCB"), pair);
}

MstIntersectCBPtr MEAPI MstBridgeGetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetIntersectCB");
    return pair ? pair->intersectCb : 0;
}

void MEAPI MstBridgeSetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                    const MstPerContactCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetPerContactCB");
    if (!pair)
        return;
    pair->perContactCb = cb;
    mst_wakeTouching(mst_bridgeCheck(b, "MstBridgeSetPerContactCB"), pair);
}

MstPerContactCBPtr MEAPI MstBridgeGetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetPerContactCB");
    return pair ? pair->perContactCb : 0;
}

void MEAPI MstBridgeSetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                 const MstPerPairCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetPerPairCB");
    if (!pair)
        return;
    pair->perPairCb = cb;
    mst_wakeTouching(mst_bridgeCheck(b, "MstBridgeSetPerPairCB"), pair);
}

MstPerPairCBPtr MEAPI MstBridgeGetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetPerPairCB");
    return pair ? pair->perPairCb : 0;
}

void MEAPI MstBridgeSetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                               const MstTouchCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetTouchCB");
    if (!pair)
        return;
    ((MstBridgeRecord *)b)->events.callbacks += (cb != 0) - (pair->touchCb != 0);
    pair->touchCb = cb;
}

MstTouchCBPtr MEAPI MstBridgeGetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetTouchCB");
    return pair ? pair->touchCb : 0;
}

/* ---- each step ------------------------------------------------------------------------------------------------- */

void mst_holdPairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w) {
    MeStageBegin(&b->stage, MST_HOLD_PAIRS);
    MeStageBegin(McdFrameworkGetStage(frame), MCD_MODELS_HELD);
    if (w)
        MeStageBegin(MdtWorldGetStage(w), MDT_BODY_HELD);
}

/* Models go first, then their bodies. */
void mst_releasePairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w) {
    MeStageEnd(McdFrameworkGetStage(frame), MCD_MODELS_HELD);
    if (w)
        MeStageEnd(MdtWorldGetStage(w), MDT_BODY_HELD);
    MeStageEnd(&b->stage, MST_HOLD_PAIRS);
}

/* The world whose bodies are to be held; null: there is none. */
static MdtWorldID worldOf(MdtWorldID w) {
    return MdtWorldIsValid(w) ? w : 0;
}

/* Is nothing of them in use? Else a message. */
static MeBool areFree(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w, const char *function) {
    return MeStageIsFree(&b->stage, function) && MeStageIsFree(McdFrameworkGetStage(frame), function) &&
           (!worldOf(w) || MeStageIsFree(MdtWorldGetStage(w), function));
}

void MEAPI MstHandleTransitionsOf(McdModelPairContainer *pairs) {
    if (!pairs) {
        MeWarning(1, "MstHandleTransitions: no container");
        return;
    }
    if (!MeProgramMayChange("MstHandleTransitions"))
        return;
    for (int i = pairs->goodbyeFirst; i < pairs->goodbyeEnd; i++)
        mst_pairForget(pairs->array[i]);
    McdGoodbyeEach(pairs);
    McdHelloEach(pairs);
}

void MEAPI(MstHandleTransitions)(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                 const MstBridgeID b) {
    (void)s, (void)w, (void)b;
    MstHandleTransitionsOf(pairs);
}

static void handleCollisions(MstBridgeRecord *record, McdModelPairContainer *pairs, McdSpaceID s, MdtWorldID w) {
    mst_beginRound(record);
    lookAtMaterials(record, pairs->stayingEnd - pairs->helloFirst);
    mst_lookByWorkers(record, pairs->stayingEnd - pairs->helloFirst, s, w);
    record->areApart = MdtWorldIsValid(w) && MdtWorldHasBodiesApart(w);
    if (record->areApart)
        mst_noteHeldApart(&pairs->array[pairs->helloFirst], pairs->stayingEnd - pairs->helloFirst);
    for (int i = pairs->helloFirst; i < pairs->stayingEnd;) {
        i += mst_handleByWorkers(record, &pairs->array[i], pairs->stayingEnd - i, s, w);
        if (i == pairs->stayingEnd)
            break;
        i += mst_collideRun(record, &record->run, &pairs->array[i], pairs->stayingEnd - i, s);
        mst_commitRun(record, &record->run, s, w);
    }
}

/* Makes the bridge the one that collides the space's pairs, whose records are one bridge's. False, with a warning: it
 * cannot be. */
static MeBool claimSpace(MstBridgeRecord *b, McdSpaceID s, const char *function) {
    if (!McdSpaceIsValid(s)) {
        MeWarning(1, "%s: s is %s: it must be a space", function, s ? "no space, or one that is destroyed" : "null");
        return MEFALSE;
    }
    const void *collider = McdSpaceGetCollider(s);
    const MeBool isForeign = McdSpaceGetFramework(s) != b->frame;
    if (isForeign || (collider && collider != b && MeHandleIsLive(collider, MST_BRIDGE))) {
        MeWarning(1, "%s: the space is %s; nothing is done", function,
                  isForeign ? "of another framework than the bridge"
                            : "another bridge's, which has collided its pairs");
        return MEFALSE;
    }
    McdSpaceSetCollider(s, b);
    return METRUE;
}

void MEAPI MstHandleCollisions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                               const MstBridgeID b) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstHandleCollisions");
    if (!record || !pairs || !claimSpace(record, s, "MstHandleCollisions") ||
        !areFree(record, record->frame, w, "MstHandleCollisions"))
        return;
    mst_holdPairs(record, record->frame, worldOf(w));
    handleCollisions(record, pairs, s, w);
    mst_releasePairs(record, record->frame, worldOf(w));
}

static MeBool setPairsSize(MstBridgeRecord *b, int size) {
    McdModelPairContainer *pairs = McdModelPairContainerCreate(size);
    if (!pairs)
        return MEFALSE;
    McdModelPairContainerDestroy(b->bridge.pairs);
    b->bridge.pairs = pairs;
    return METRUE;
}

/* Room for all pairs at once, unless the program has said otherwise: workers wait as each round ends. Without memory,
 * they come in several rounds. Half of a container is for goodbyes. */
static void reservePairs(MstBridgeRecord *b, int count) {
    int size = b->bridge.pairs->size;
    while (size / 2 < count && size <= INT_MAX / 2)
        size *= 2;
    if (!b->isPairsSizeSet && size > b->bridge.pairs->size)
        setPairsSize(b, size);
}

/* What callbacks have destroyed goes when the next change block is open. */
void mst_updateContacts(MstBridgeRecord *record, McdSpaceID s, MdtWorldID w) {
    McdSpacePairIterator iterator;
    McdModelPairContainer **const pairs = &record->bridge.pairs;
    const MdtWorldID held = worldOf(w);
    int isMore;
    const char *before = MeCallerSet("MstBridgeUpdateContacts");
    MeProfileStartSection("Collision", 0);
    if (record->part == 0) {
        mst_eventsBegin(record, w ? MdtWorldGetTeam(w) : 0);
        mst_holdPairs(record, record->frame, held);
        mst_wakeChanged(record, s);
        mst_releasePairs(record, record->frame, held);
    }
    mst_clearSafeTimes(record);
    record->ahead = McdSpaceGetLookAhead(s);
    MeProfileStartSection("Pairs", 0);
    McdSpaceEndChanges(s);
    MeProfileEndSection("Pairs");
    reservePairs(record, McdSpaceGetPairCount(s));
    McdSpacePairIteratorBegin(s, &iterator);
    mst_holdPairs(record, record->frame, held);
    do {
        McdModelPairContainerReset(*pairs);
        isMore = McdSpaceGetPairs(s, &iterator, *pairs);
        MEASSERT((*pairs)->goodbyeEnd <= (*pairs)->helloFirst && (*pairs)->helloEnd == (*pairs)->stayingFirst);
        MstHandleTransitionsOf(*pairs);
        handleCollisions(record, *pairs, s, w);
    } while (isMore);
    McdSpaceOpen(s);
    mst_freezeAgain(record);
    mst_releasePairs(record, record->frame, held);
    MeProfileEndSection("Collision");
    MeCallerSet(before);
}

void MEAPI MstBridgeUpdateContacts(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeUpdateContacts");
    if (record && claimSpace(record, s, "MstBridgeUpdateContacts") &&
        areFree(record, record->frame, w, "MstBridgeUpdateContacts"))
        mst_updateContacts(record, s, w);
}

void MEAPI MstBridgeUpdateTransitions(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    McdSpacePairIterator iterator;
    int isMore;
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeUpdateTransitions");
    if (!record || !claimSpace(record, s, "MstBridgeUpdateTransitions") ||
        !areFree(record, record->frame, w, "MstBridgeUpdateTransitions"))
        return;
    McdSpaceEndChanges(s);
    McdSpacePairIteratorBegin(s, &iterator);
    mst_holdPairs(record, record->frame, worldOf(w));
    do {
        McdModelPairContainerReset(b->pairs);
        isMore = McdSpaceGetTransitions(s, &iterator, b->pairs);
        MstHandleTransitionsOf(b->pairs);
    } while (isMore);
    McdSpaceOpen(s);
    mst_releasePairs(record, record->frame, worldOf(w));
}

void MEAPI MstBridgeSetContactReuse(const MstBridgeID b, const MeReal part) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetContactReuse");
    if (record && !(part >= 0 && part <= 1))
        MeWarning(1, "MstBridgeSetContactReuse: %g is not between 0 and 1; nothing is changed", (double)part);
    else if (record)
        record->reuse = part;
}

MeReal MEAPI MstBridgeGetContactReuse(const MstBridgeID b) {
    const MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetContactReuse");
    return record ? record->reuse : 0;
}

/* ---- buffers ---------------------------------------------------------------------------------------------------- */

static void MEAPI resizeLater(const MeLater *later) {
    if (later->other[0])
        MstBridgeSetContactBufferSize(later->object, (unsigned int)later->number);
    else
        MstBridgeSetModelPairBufferSize(later->object, (unsigned int)later->number);
}

/* False: it is done when the pairs are handled, or refused. */
static MeBool isToResizeNow(MstBridgeRecord *b, MeBool isOfContacts, unsigned int size, const char *function) {
    const MeLater later = {.carryOut = resizeLater, .object = b, .other = {isOfContacts ? b : 0}, .number = (long)size};
    const MeWhen when = MeStageWhen(&b->stage, MST_HOLD_PAIRS, function);
    if (when == MeWhenStageEnds)
        MeStageDefer(&b->stage, MST_HOLD_PAIRS, &later, function);
    return when == MeWhenNow;
}

void MEAPI MstBridgeSetContactBufferSize(const MstBridgeID b, const unsigned int s) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetContactBufferSize");
    if (!record)
        return;
    if (!s || s > INT_MAX) {
        MeWarning(1, "MstBridgeSetContactBufferSize: %u contacts: it must be 1 .. %d", s, INT_MAX);
        return;
    }
    if (isToResizeNow(record, METRUE, s, "MstBridgeSetContactBufferSize"))
        makeContacts(record, (int)s, "MstBridgeSetContactBufferSize");
}

void MEAPI MstBridgeSetModelPairBufferSize(const MstBridgeID b, const unsigned int s) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetModelPairBufferSize");
    if (!record)
        return;
    if (s < 8 || s > INT_MAX) {
        MeWarning(1, "MstBridgeSetModelPairBufferSize: %u pairs: it must be 8 .. %d", s, INT_MAX);
        return;
    }
    if (isToResizeNow(record, MEFALSE, s, "MstBridgeSetModelPairBufferSize") && setPairsSize(record, (int)s))
        record->isPairsSizeSet = METRUE;
}
