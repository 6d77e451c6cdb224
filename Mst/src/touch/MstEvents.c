/* Events: begin, persist and end of touches, made from the step's touches (mst_touch.c) once the step is done.
 *
 * Reads the listed touches, and the forces of their contacts, which decide which of them touch. Writes whether they
 * touch, the members of touches that only events need, and the list of events; calls the program's touch callbacks.
 *
 * The list of events is made when a program reads it, has a callback, or destroys an object in it. If it was not made
 * before the next step begins, only whether each pair touches is stored, since most pairs continue to touch. */
#include "MstEvents.h"
#include "McdInternal.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MeTeam.h"
#include "touch/mst_touch_i.h"
#include <string.h>

/* ---- memory ---------------------------------------------------------------------------------------------------- */

/* Makes room for one more event. False, after MeFatalError: no memory, and the list is unchanged. */
static MeBool growEventList(MstEventList *list) {
    const size_t count = (size_t)list->count, more = count ? 2 * count : 64;
    if (list->count < list->max)
        return METRUE;
    if (!MeMemoryGrow(&list->event, count, more, sizeof *list->event, "MstBridgeUpdateEvents", "events") ||
        !MeMemoryGrow(&list->serial, count, more, sizeof *list->serial, "MstBridgeUpdateEvents", "events"))
        return MEFALSE;
    list->max = (int)more;
    return METRUE;
}

static void addEvent(MstEventList *list, const MstEvent *event, const MeU64 serial[2]) {
    if (!growEventList(list))
        return;
    list->event[list->count] = *event;
    memcpy(list->serial[list->count++], serial, sizeof *list->serial);
}

static void freeList(MstEventList *list) {
    MeMemoryGive(list->event);
    MeMemoryGive(list->serial);
}

/* ---- one event --------------------------------------------------------------------------------------------------- */

static MstEvent makeEvent(const MstTouch *t, MstEventKind kind) {
    MstEvent event;
    memset(&event, 0, sizeof event);
    event.kind = kind;
    event.model1 = t->model[0].model;
    event.model2 = t->model[1].model;
    event.material1 = t->material[0];
    event.material2 = t->material[1];
    event.isSensor = t->isSensor;
    if (kind == MstEventEnd)
        return event;
    event.impulse = t->impulse;
    event.approachSpeed = kind == MstEventBegin ? t->approachSpeed : 0;
    MeVector3Copy(event.position, t->position);
    MeVector3Copy(event.normal, t->normal);
    return event;
}

static void addTouchEvent(MstEventList *list, const MstTouch *t, MstEventKind kind) {
    const MstEvent event = makeEvent(t, kind);
    const MeU64 serial[2] = {t->model[0].serial, t->model[1].serial};
    addEvent(list, &event, serial);
}

void mst_eventsTerm(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    mst_freeTouches(e);
    freeList(&e->done);
    freeList(&e->ended);
}

/* ---- after the step -------------------------------------------------------------------------------------------- */

/* Empties the list of this step's touches. */
static void clearListedTouches(MstEvents *e) {
    e->listedCount = e->undecidedCount = 0;
    e->list++;
}

/* Adds the contacts as they are after the step, if the pair touched before. For other pairs this was done before the
 * solve. */
static void addContactsAfterStep(MstTouch *t) {
    const MdtContactGroupID group = t->pair->responseData;
    if (group && t->wasTouching && !t->isSensor)
        mst_touchAddContacts(t, group);
}

/* Adds the contacts' impulse since the last call for this touch; returns the time for which they acted, s. */
static MeReal addImpulse(MstTouch *t) {
    const MdtContactGroupID group = t->pair->responseData;
    const MeReal before = t->lag;
    t->lag = mst_pairLag(t->pair);
    if (!group || MdtContactGroupGetCount(group) == 0 || !(t->lag < before))
        return 0;
    const MeReal time = MdtBodyGetPart(MdtContactGroupGetBody(group, 0));
    MEASSERT(time >= 0);
    t->impulse += time * MdtContactGroupGetNormalForce(group);
    return time;
}

/* Sets position and normal of the touch to those of the contact with the largest impulse. time: s, for which the
 * contacts acted. */
static void findLargestImpulse(MstTouch *t, MeReal time) {
    const MdtContactGroupID group = t->pair->responseData;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 force, normal;
        MdtContactGetNormal(c, normal);
        MdtContactGetForce(c, 0, force);
        const MeReal impulse = time * MeVector3Dot(force, normal);
        if (impulse <= t->largestImpulse)
            continue;
        t->largestImpulse = impulse;
        MdtContactGetPosition(c, t->position);
        mst_normalOf(t->pair, c, t->normal);
    }
}

/* Updates a touch with its contacts' impulses since the last call. */
static void updateImpulses(MstTouch *t) {
    addContactsAfterStep(t);
    const MeReal time = addImpulse(t);
    if (time > 0)
        findLargestImpulse(t, time);
}

void mst_eventsAddImpulses(MstBridgeRecord *b) {
    for (int i = 0; i < b->events.listedCount; i++)
        if (b->events.listed[i])
            updateImpulses(b->events.listed[i]);
}

static void reportChange(MstEvents *e, MstTouch *t) {
    const MeBool was = t->wasTouching, is = mst_touchEvaluate(t);
    t->isTouching = is;
    if (is)
        addTouchEvent(&e->done, t, was ? MstEventPersist : MstEventBegin);
    else if (was)
        addTouchEvent(&e->done, t, MstEventEnd);
}

static void reportEnded(MstEvents *e) {
    for (int i = 0; i < e->ended.count; i++)
        addEvent(&e->done, &e->ended.event[i], e->ended.serial[i]);
    e->ended.count = 0;
}

static void reportBreaks(MstEvents *e, MdtWorldID w) {
    static const MeU64 none[2] = {0, 0};
    int count;
    const MdtConstraintID *broken = MdtWorldGetBrokenJoints(w, &count);
    e->world = w;
    e->firstBreak = e->done.count;
    for (int i = 0; i < count; i++) {
        MstEvent event;
        memset(&event, 0, sizeof event);
        event.kind = MstEventBreak;
        event.joint = broken[i];
        addEvent(&e->done, &event, none);
    }
}

static McdModelID liveModelOrNull(McdModelID m, MeU64 serial) {
    return McdModelGetSerial(m) == serial ? m : 0;
}

/* Nulls an event's models and joint if destroyed. Breaks are the last events, in the order of the world's list. */
static void refreshEvent(MstEvents *e, int i) {
    MstEvent *event = &e->done.event[i];
    if (event->kind == MstEventBreak) {
        MEASSERT(i >= e->firstBreak);
        event->joint = MdtWorldGetBrokenJoints(e->world, 0)[i - e->firstBreak];
        return;
    }
    event->model1 = liveModelOrNull(event->model1, e->done.serial[i][0]);
    event->model2 = liveModelOrNull(event->model2, e->done.serial[i][1]);
}

static void callTouchCallbacks(MstBridgeRecord *b) {
    const MeProgramCall before = MeProgramEnter("MstBridgeSetTouchCB");
    MEASSERT(b->events.firstBreak <= b->events.done.count);
    for (int i = 0; i < b->events.firstBreak; i++) {
        refreshEvent(&b->events, i);
        const MstEvent *event = &b->events.done.event[i];
        const MstTouchCBPtr cb = mst_materialPair(b, event->material1, event->material2)->touchCb;
        if (cb)
            cb(event);
    }
    MeProgramLeave(&before);
}

/* Makes the list of events of the last step, unless it exists or its world was destroyed. */
static void makeEventList(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    const MeBool isToDo = e->isPending && MdtWorldIsValid(e->world);
    e->isPending = MEFALSE;
    if (!isToDo)
        return;
    MEVALIDATE(mst_touchesAreConsistent(e));
    mst_eventsAddImpulses(b);
    reportEnded(e);
    for (int i = 0; i < e->listedCount; i++)
        if (e->listed[i])
            reportChange(e, e->listed[i]);
    clearListedTouches(e);
    reportBreaks(e, e->world);
}

void MEAPI mst_touchForget(McdModelPair *p) {
    MstTouch *t = p->touch;
    if (!t)
        return;
    makeEventList(t->bridge);
    MEASSERT(t->pair == p);
    p->touch = 0;
    if (mst_touchIsTouching(&t->bridge->events, t))
        addTouchEvent(&t->bridge->events.ended, t, MstEventEnd);
    if (mst_touchIsListed(&t->bridge->events, t))
        mst_touchUnlist(t);
    mst_touchFree(t);
}

/* Prefetches following touches, their pairs and their contacts, each at the distance at which its address is known. */
static void prefetchTouches(MstTouch *const touches[], int i, int end) {
    enum { AHEAD = 4 };
    if (i + 3 * AHEAD < end)
        me_prefetch(touches[i + 3 * AHEAD], 2 * ME_CACHE_LINE);
    if (i + 2 * AHEAD < end && touches[i + 2 * AHEAD])
        ME_PREFETCH(&touches[i + 2 * AHEAD]->pair->responseData);
    if (i + AHEAD < end && touches[i + AHEAD])
        me_prefetch(touches[i + AHEAD]->pair->responseData, MST_GROUP);
}

/* The rule for order (MeTeam.h): each touch is in the list once, and a range writes only to its own touches. */
static void MEAPI settleTouches(void *context, int first, int end, int worker) {
    const MstEvents *e = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        MstTouch *t = e->undecided[i];
        prefetchTouches(e->undecided, i, end);
        if (!t)
            continue;
        MEASSERT(t->isUndecided);
        addContactsAfterStep(t);
        addImpulse(t);
        t->isTouching = mst_touchEvaluate(t);
    }
}

/* The list of events was not made: computes only whether the undecided pairs touch. */
static void settleWithoutEvents(MstBridgeRecord *b, MeTeam *team) {
    MstEvents *e = &b->events;
    MeTeam *workers = e->undecidedCount >= MST_MIN_RUNS * MST_RUN ? team : 0;
    if (MdtWorldIsValid(e->world)) {
        MeTeamOpen(workers);
        MeTeamRunRanges(workers, e->undecidedCount, MST_RUN, settleTouches, e);
        MeTeamClose(workers);
    }
    clearListedTouches(e);
    e->ended.count = 0;
    e->isPending = MEFALSE;
}

void mst_updateEvents(MstBridgeRecord *record, MdtWorldID w) {
    record->events.done.count = record->events.firstBreak = 0;
    record->events.world = w;
    record->events.isPending = METRUE;
    if (record->events.callbacks > 0) {
        makeEventList(record);
        callTouchCallbacks(record);
    }
}

void MEAPI MstBridgeUpdateEvents(const MstBridgeID b, const MdtWorldID w) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeUpdateEvents");
    if (!record || !MeStageIsFree(&record->stage, "MstBridgeUpdateEvents"))
        return;
    MeStageBegin(&record->stage, MST_GUARD_BRIDGE);
    mst_updateEvents(record, w);
    MeStageEnd(&record->stage, MST_GUARD_BRIDGE);
}

void mst_eventsBegin(MstBridgeRecord *b, MeTeam *team) {
    if (b->events.isPending)
        settleWithoutEvents(b, team);
    clearListedTouches(&b->events);
}

/* ---- sensors ---- */

void MEAPI MstSensorSetMask(const McdModelID sensor, const MeU32 mask) {
    if (!McdModelIsValid(sensor))
        MeWarning(1, "MstSensorSetMask: it is no model; nothing is changed");
    else if (mask & ~(MeU32)MstSensesAll)
        MeWarning(1, "MstSensorSetMask: the mask 0x%x has a bit of no kind; nothing is changed", (unsigned int)mask);
    else
        McdModelSetSensorMask(sensor, mask);
}

MeU32 MEAPI MstSensorGetMask(const McdModelID sensor) {
    if (McdModelIsValid(sensor))
        return McdModelGetSensorMask(sensor) & MstSensesAll;
    MeWarning(1, "MstSensorGetMask: it is no model");
    return 0;
}

const MstEvent *MEAPI MstBridgeGetEvents(const MstBridgeID b, int *count) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetEvents");
    if (record)
        makeEventList(record);
    if (count)
        *count = record ? record->events.done.count : 0;
    if (!record)
        return 0;
    for (int i = 0; i < record->events.done.count; i++)
        refreshEvent(&record->events, i);
    return record->events.done.event;
}

/* ---- pairs ---- */

void mst_destroyGroup(McdModelPair *p) {
    if (p->responseData)
        MdtContactGroupDestroy((MdtContactGroupID)p->responseData);
    MEASSERT(!p->responseData); /* cleared by the group's destruction */
}

void MEAPI mst_pairForget(McdModelPair *p) {
    if (!MdtConstraintIsValid(p->responseData)) /* the group may have been destroyed with its world */
        p->responseData = 0;
    mst_touchForget(p); /* before the contacts, whose forces it reads */
    mst_destroyGroup(p);
    p->forget = 0;
}
