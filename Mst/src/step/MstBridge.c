/* The bridge: creation and destruction, and the loop over pairs, which collides and commits them run by run. */
#include "McdFrame.h"
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtWorld.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "MeProfile.h"
#include "step/mst_step_i.h"
#include <limits.h>
#include <string.h>

/* ---- life ---------------------------------------------------------------------------------------------------- */

void mst_runTerm(MstRun *run) {
    MeMemoryGive(run->contacts);
    MeMemoryGive(run->found);
    MeMemoryGive(run->made);
}

/* AVERAGE: contacts per pair of a run, beyond the first pair's maximum. */
MeBool mst_runInit(MstRun *run, int max, const char *function) {
    enum { AVERAGE = 8 };
    if (max > INT_MAX - AVERAGE * MST_RUN)
        max = INT_MAX - AVERAGE * MST_RUN;
    MEASSERT(max > 0);
    MstRun made = {.contactMax = max, .foundMax = max + AVERAGE * MST_RUN};
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

/* False: no memory, and nothing is changed. */
static MeBool resizeRuns(MstBridgeRecord *b, int max, const char *function) {
    if (!mst_runInit(&b->run, max, function))
        return MEFALSE;
    mst_workersTerm(b); /* workers' runs must have the same capacity: they are allocated again when needed */
    return METRUE;
}

static void freeBridge(MstBridgeRecord *b) {
    if (b->bridge.pairs)
        McdModelPairContainerDestroy(b->bridge.pairs);
    for (unsigned int m = 0; m < b->materialCount; m++)
        MeMemoryGive(b->materials[m]);
    MeMemoryGive(b->materials);
    mst_workersTerm(b);
    mst_runTerm(&b->run);
    mst_eventsTerm(b);
    MeMemoryGive(b->clamped);
    MeMemoryGive(b->paused);
    MeMemoryGive(b->thawed);
    MeMemoryGive(b);
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
    b->materialLimit = (MeLimit){.max = isLimited ? (int)MeCLAMP(maxMaterials, 1, MST_MATERIALS) : MeNoLimit,
                                 .name = "MstBridgeCreate's maxMaterials"};
    b->reuse = (MeReal)MST_CONTACT_REUSE;
    b->events.list = 1; /* new touches have listedIn = 0, in no list */
    b->bridge.pairs = McdModelPairContainerCreate(MST_PAIRS);
    if (!b->bridge.pairs || !resizeRuns(b, MST_CONTACTS, function) || !mst_materialAdd(b, function)) {
        freeBridge(b);
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
    freeBridge(record);
}

/* ---- each step ------------------------------------------------------------------------------------------------- */

/* Computes the versions of all pairs of materials, unless there are more of them than `count` pairs of models. */
static void updateMaterialVersions(MstBridgeRecord *b, int count) {
    if (0.5 * b->materialCount * (b->materialCount + 1.0) > (double)count)
        return;
    for (unsigned int i = 0; i < b->materialCount; i++)
        for (unsigned int k = 0; k <= i; k++)
            mst_materialVersion(b, &b->materials[i][k].pair);
    b->allComparedIn = b->round;
}

void mst_beginRound(MstBridgeRecord *b) {
    b->round++;
    McdFrameworkBeginRound(b->frame);
}

void mst_guardPairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w) {
    MeStageBegin(&b->stage, MST_GUARD_PAIRS);
    MeStageBegin(McdFrameworkGetStage(frame), MCD_GUARD_MODELS);
    if (w)
        MeStageBegin(MdtWorldGetStage(w), MDT_BODY_GUARD);
}

/* Deferred removals of models are done before those of bodies. */
void mst_releasePairs(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w) {
    MeStageEnd(McdFrameworkGetStage(frame), MCD_GUARD_MODELS);
    if (w)
        MeStageEnd(MdtWorldGetStage(w), MDT_BODY_GUARD);
    MeStageEnd(&b->stage, MST_GUARD_PAIRS);
}

/* The world if it is valid, else null. */
static MdtWorldID liveWorld(MdtWorldID w) {
    return MdtWorldIsValid(w) ? w : 0;
}

/* Whether no stage of the bridge, framework or world is active. False: with a message. */
static MeBool areStagesFree(MstBridgeRecord *b, McdFrameworkID frame, MdtWorldID w, const char *function) {
    return MeStageIsFree(&b->stage, function) && MeStageIsFree(McdFrameworkGetStage(frame), function) &&
           (!liveWorld(w) || MeStageIsFree(MdtWorldGetStage(w), function));
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

/* Puts a mover's model, with its boxes and children, where it is after a time of its step. */
static void placeMover(MstBridgeRecord *record, McdModelID m, MeReal time) {
    const MdtBodyID body = mst_bodyOf(m);
    if (!body || !MdtBodyIsMover(body) || !MdtBodyIsMoving(body))
        return;
    const MeBool isElsewhere = MdtBodyPlaceMover(body, time);
    if (isElsewhere)
        mst_beginRound(record);
    if (isElsewhere || record->placed != m) /* a body may have several models */
        McdModelUpdate(m);
    record->placed = m;
}

/* After the first sub-step: puts the pair's mover where it is when its lagging body goes on. */
static void placeMovers(MstBridgeRecord *record, const McdModelPair *p) {
    const MeReal lag = mst_pairLag(p);
    if (!(lag > 0))
        return;
    placeMover(record, p->model1, record->ahead - lag);
    placeMover(record, p->model2, record->ahead - lag);
}

static void handleCollisions(MstBridgeRecord *record, McdModelPairContainer *pairs, McdSpaceID s, MdtWorldID w) {
    mst_beginRound(record);
    record->placed = 0;
    updateMaterialVersions(record, pairs->stayingEnd - pairs->helloFirst);
    mst_stampModelsByWorkers(record, pairs->stayingEnd - pairs->helloFirst, s, w);
    record->hasNoCollide = MdtWorldIsValid(w) && MdtWorldHasNoCollide(w);
    if (record->hasNoCollide)
        mst_markNoCollidePairs(&pairs->array[pairs->helloFirst], pairs->stayingEnd - pairs->helloFirst);
    for (int i = pairs->helloFirst; i < pairs->stayingEnd;) {
        if (record->substep > 0)
            placeMovers(record, pairs->array[i]);
        i += mst_handlePairsByWorkers(record, &pairs->array[i], pairs->stayingEnd - i, w);
        if (i == pairs->stayingEnd)
            break;
        i += mst_collideRun(record, &record->run, &pairs->array[i], pairs->stayingEnd - i);
        mst_commitRun(record, &record->run, w);
    }
    mst_clampFollowers(record, &pairs->array[pairs->helloFirst], pairs->stayingEnd - pairs->helloFirst);
}

/* Makes the bridge the collider of the space: only one bridge may keep records of its pairs. False, with a warning: the
 * space is invalid, of another framework, or another bridge's. */
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

/* The record of a bridge that may handle the pairs of the space now; null, with a warning or message, otherwise. */
static MstBridgeRecord *bridgeFor(MstBridgeID b, McdSpaceID s, MdtWorldID w, const char *function) {
    MstBridgeRecord *record = mst_bridgeCheck(b, function);
    return record && claimSpace(record, s, function) && areStagesFree(record, record->frame, w, function) ? record : 0;
}

void MEAPI MstHandleCollisions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                               const MstBridgeID b) {
    MstBridgeRecord *record = pairs ? bridgeFor(b, s, w, __func__) : mst_bridgeCheck(b, __func__);
    if (!record || !pairs)
        return;
    mst_guardPairs(record, record->frame, liveWorld(w));
    handleCollisions(record, pairs, s, w);
    mst_releasePairs(record, record->frame, liveWorld(w));
}

static MeBool replacePairContainer(MstBridgeRecord *b, int size) {
    McdModelPairContainer *pairs = McdModelPairContainerCreate(size);
    if (!pairs)
        return MEFALSE;
    McdModelPairContainerDestroy(b->bridge.pairs);
    b->bridge.pairs = pairs;
    return METRUE;
}

/* Makes room for all pairs at once, unless the program has set the size: workers are idle at the end of each container.
 * Without memory, pairs are handled in several containers. Half of a container is for goodbye pairs. */
static void reservePairs(MstBridgeRecord *b, int count) {
    int size = b->bridge.pairs->size;
    while (size / 2 < count && size <= INT_MAX / 2)
        size *= 2;
    if (!b->isPairsSizeSet && size > b->bridge.pairs->size)
        replacePairContainer(b, size);
}

static MeBool isMovedByForces(McdModelID m) {
    const MdtBodyID body = mst_freeBodyOf(m);
    return body && MdtBodyIsEnabled(body) && !McdModelIsSensor(m);
}

/* Planes, height fields, lists and meshes have no contacts with each other. */
static void warnOfSurfaces(const McdModelPairContainer *pairs) {
    for (int i = pairs->helloFirst; i < pairs->helloEnd; i++) {
        const McdModelPair *p = pairs->array[i];
        if (isMovedByForces(p->model1) || isMovedByForces(p->model2))
            McdModelPairWarnOfSurfaces(p);
    }
}

/* Tells collision how a body at rest falls in a step: its velocity changes at the step's start. */
static void setFall(McdFrameworkID frame, MdtWorldID w, MeReal step) {
    MeVector3 g = {0, 0, 0};
    double fall[3];
    if (w)
        MdtWorldGetGravity(w, g);
    for (int i = 0; i < 3; i++)
        fall[i] = (double)(g[i] * step * step);
    McdFrameworkSetFall(frame, fall);
}

/* Objects that callbacks destroyed are removed at the end, once the next change block is open. */
void mst_updateContacts(MstBridgeRecord *record, McdSpaceID s, MdtWorldID w) {
    McdSpacePairIterator iterator;
    McdModelPairContainer **const pairs = &record->bridge.pairs;
    const MdtWorldID world = liveWorld(w);
    int isMore;
    const char *before = MeCallerSet("MstBridgeUpdateContacts");
    MeProfileStartSection("Collision", 0);
    if (record->substep == 0) {
        MEASSERT(record->thawedCount == 0);
        record->ahead = McdSpaceGetLookAhead(s);
        mst_eventsBegin(record, w ? MdtWorldGetTeam(w) : 0);
        mst_guardPairs(record, record->frame, world);
        mst_applyProgramChanges(record, s, world);
        mst_releasePairs(record, record->frame, world);
    }
    mst_clearSafeTimes(record);
    record->ahead = McdSpaceGetLookAhead(s);
    setFall(record->frame, w, record->ahead);
    MeProfileStartSection("Pairs", 0);
    McdSpaceEndChanges(s);
    MeProfileEndSection("Pairs");
    reservePairs(record, McdSpaceGetPairCount(s));
    McdSpacePairIteratorBegin(s, &iterator);
    mst_guardPairs(record, record->frame, world);
    do {
        McdModelPairContainerReset(*pairs);
        isMore = McdSpaceGetPairs(s, &iterator, *pairs);
        MEASSERT((*pairs)->goodbyeEnd <= (*pairs)->helloFirst && (*pairs)->helloEnd == (*pairs)->stayingFirst);
        MstHandleTransitionsOf(*pairs);
        warnOfSurfaces(*pairs);
        handleCollisions(record, *pairs, s, w);
    } while (isMore);
    McdSpaceBeginOwnChanges(s);
    mst_refreezeModels(record);
    mst_releasePairs(record, record->frame, world);
    MeProfileEndSection("Collision");
    MeCallerSet(before);
}

void MEAPI MstBridgeUpdateContacts(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    MstBridgeRecord *record = bridgeFor(b, s, w, __func__);
    if (record)
        mst_updateContacts(record, s, w);
}

void MEAPI MstBridgeUpdateTransitions(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    McdSpacePairIterator iterator;
    int isMore;
    MstBridgeRecord *record = bridgeFor(b, s, w, __func__);
    if (!record)
        return;
    McdSpaceEndChanges(s);
    McdSpacePairIteratorBegin(s, &iterator);
    mst_guardPairs(record, record->frame, liveWorld(w));
    do {
        McdModelPairContainerReset(b->pairs);
        isMore = McdSpaceGetTransitions(s, &iterator, b->pairs);
        MstHandleTransitionsOf(b->pairs);
    } while (isMore);
    McdSpaceBeginOwnChanges(s);
    mst_releasePairs(record, record->frame, liveWorld(w));
}

void MEAPI MstBridgeSetContactReuse(const MstBridgeID b, const MeReal share) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetContactReuse");
    if (record && !(share >= 0 && share <= 1))
        MeWarning(1, "MstBridgeSetContactReuse: %g is not between 0 and 1; nothing is changed", (double)share);
    else if (record)
        record->reuse = share;
}

MeReal MEAPI MstBridgeGetContactReuse(const MstBridgeID b) {
    const MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetContactReuse");
    return record ? record->reuse : 0;
}

/* ---- buffers ---------------------------------------------------------------------------------------------------- */

static void MEAPI executeDeferredResize(const MeLater *later) {
    if (later->other[0])
        MstBridgeSetContactBufferSize(later->object, (unsigned int)later->number);
    else
        MstBridgeSetModelPairBufferSize(later->object, (unsigned int)later->number);
}

/* Whether the program may resize a buffer now. False: deferred until all pairs are handled, or refused. */
static MeBool mayResizeNow(MstBridgeRecord *b, MeBool isOfContacts, unsigned int size, const char *function) {
    const MeLater later = {
        .carryOut = executeDeferredResize, .object = b, .other = {isOfContacts ? b : 0}, .number = (long)size};
    const MeWhen when = MeStageWhen(&b->stage, MST_GUARD_PAIRS, function);
    if (when == MeWhenStageEnds)
        MeStageDefer(&b->stage, MST_GUARD_PAIRS, &later, function);
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
    if (mayResizeNow(record, METRUE, s, "MstBridgeSetContactBufferSize"))
        resizeRuns(record, (int)s, "MstBridgeSetContactBufferSize");
}

void MEAPI MstBridgeSetModelPairBufferSize(const MstBridgeID b, const unsigned int s) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetModelPairBufferSize");
    if (!record)
        return;
    if (s < 8 || s > INT_MAX) {
        MeWarning(1, "MstBridgeSetModelPairBufferSize: %u pairs: it must be 8 .. %d", s, INT_MAX);
        return;
    }
    if (mayResizeNow(record, MEFALSE, s, "MstBridgeSetModelPairBufferSize") && replacePairContainer(record, (int)s))
        record->isPairsSizeSet = METRUE;
}
