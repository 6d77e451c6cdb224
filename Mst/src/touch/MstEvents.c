/* Events: beginning, persisting and ending touches, made of the step's touches (mst_touch.c) once it is done.
 *
 * Reads the touches that are listed, and the forces of their contacts, which say which of them touch. Writes whether
 * they do, what only events need of them, and the list of events; calls the program's callbacks of touches.
 *
 * The list of events is made when a program reads it, has a callback, or destroys an object that it names. If it has
 * not been made when the next step begins, only whether each pair touches is kept: most pairs go on touching. */
#include "MstEvents.h"
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

/* Room for one more. False, after MeFatalError: no memory, and the list is unchanged. */
static MeBool hasRoom(MstEventList *list) {
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
    if (!hasRoom(list))
        return;
    list->event[list->count] = *event;
    memcpy(list->serial[list->count++], serial, sizeof *list->serial);
}

static void freeList(MstEventList *list) {
    MeMemoryGive(list->event);
    MeMemoryGive(list->serial);
}

/* ---- one event --------------------------------------------------------------------------------------------------- */

static MstEvent eventOf(const MstTouch *t, MstEventKind kind) {
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
    const MstEvent event = eventOf(t, kind);
    const MeU64 serial[2] = {t->model[0].serial, t->model[1].serial};
    addEvent(list, &event, serial);
}

void mst_eventsTerm(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    mst_touchesTerm(e);
    freeList(&e->done);
    freeList(&e->ended);
}

/* ---- after the step -------------------------------------------------------------------------------------------- */

/* No touch is of this step any more. */
static void clearList(MstEvents *e) {
    e->listedCount = e->undecidedCount = 0;
    e->list++;
}

/* The contacts' separations and places. Of a pair that did not touch they were noted before the solve. */
static void noteContacts(MstTouch *t) {
    const MdtContactGroupID group = t->pair->responseData;
    if (group && t->wasTouching && !t->isSensor)
        mst_touchNoteGroup(t, group);
}

/* Adds the contacts' impulse since the last time; returns for how long they acted, s. */
static MeReal addImpulse(MstTouch *t) {
    const MdtContactGroupID group = t->pair->responseData;
    const MeReal before = t->lag;
    t->lag = mst_lagOfPair(t->pair);
    if (!group || MdtContactGroupGetCount(group) == 0 || !(t->lag < before))
        return 0;
    const MeReal time = MdtBodyGetPart(MdtContactGroupGetBody(group, 0));
    t->impulse += time * MdtContactGroupGetNormalForce(group);
    return time;
}

/* The touch is where the largest impulse is, of contacts that acted for so long. */
static void findLargest(MstTouch *t, MeReal time) {
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

/* What the contacts did since the last time. */
static void gather(MstTouch *t) {
    noteContacts(t);
    const MeReal time = addImpulse(t);
    if (time > 0)
        findLargest(t, time);
}

void mst_eventsGather(MstBridgeRecord *b) {
    for (int i = 0; i < b->events.listedCount; i++)
        if (b->events.listed[i])
            gather(b->events.listed[i]);
}

static void reportChange(MstEvents *e, MstTouch *t) {
    const MeBool was = t->wasTouching, is = mst_touchTouches(t);
    t->isTouching = is;
    if (is)
        addTouchEvent(&e->done, t, was ? MstEventPersist : MstEventBegin);
    else if (was)
        addTouchEvent(&e->done, t, MstEventEnd);
}

static void removeEnded(MstEvents *e) {
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

static McdModelID ifAlive(McdModelID m, MeU64 serial) {
    return McdModelGetSerial(m) == serial ? m : 0;
}

/* Nulls what was destroyed since. Breaks come last, in the order of the world's list. */
static void refreshEvent(MstEvents *e, int i) {
    MstEvent *event = &e->done.event[i];
    if (event->kind == MstEventBreak) {
        event->joint = MdtWorldGetBrokenJoints(e->world, 0)[i - e->firstBreak];
        return;
    }
    event->model1 = ifAlive(event->model1, e->done.serial[i][0]);
    event->model2 = ifAlive(event->model2, e->done.serial[i][1]);
}

static void callBack(MstBridgeRecord *b) {
    const MeProgramCall before = MeProgramEnter("MstBridgeSetTouchCB");
    for (int i = 0; i < b->events.firstBreak; i++) {
        refreshEvent(&b->events, i);
        const MstEvent *event = &b->events.done.event[i];
        const MstTouchCBPtr cb = mst_materialPair(b, event->material1, event->material2)->touchCb;
        if (cb)
            cb(event);
    }
    MeProgramLeave(&before);
}

/* Makes the list of the step that is done, unless there is one, or its world is gone. */
static void makeList(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    const MeBool isToDo = e->isPending && MdtWorldIsValid(e->world);
    e->isPending = MEFALSE;
    if (!isToDo)
        return;
    MEVALIDATE(mst_touchesAreConsistent(e));
    mst_eventsGather(b);
    removeEnded(e);
    for (int i = 0; i < e->listedCount; i++)
        if (e->listed[i])
            reportChange(e, e->listed[i]);
    clearList(e);
    reportBreaks(e, e->world);
}

void MEAPI mst_touchForget(McdModelPair *p) {
    MstTouch *t = p->touch;
    if (!t)
        return;
    makeList(t->bridge);
    MEASSERT(t->pair == p);
    p->touch = 0;
    if (mst_touchIsTouching(&t->bridge->events, t))
        addTouchEvent(&t->bridge->events.ended, t, MstEventEnd);
    if (mst_touchIsListed(&t->bridge->events, t))
        mst_touchUnlist(t);
    mst_touchGive(t);
}

/* Asks for the memory of touches that follow: of each, of its pair and of its contacts, as each says where the next
 * is. */
static void prefetchSettled(MstTouch *const touches[], int i, int end) {
    enum { AHEAD = 4 };
    if (i + 3 * AHEAD < end)
        me_prefetch(touches[i + 3 * AHEAD], 2 * ME_CACHE_LINE);
    if (i + 2 * AHEAD < end && touches[i + 2 * AHEAD])
        ME_PREFETCH(&touches[i + 2 * AHEAD]->pair->responseData);
    if (i + AHEAD < end && touches[i + AHEAD])
        me_prefetch(touches[i + AHEAD]->pair->responseData, MST_GROUP);
}

/* The rule for order (MeTeam.h): each touch is in the list once, and a range writes to its own alone. */
static void MEAPI settleRange(void *context, int first, int end, int worker) {
    const MstEvents *e = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        MstTouch *t = e->undecided[i];
        prefetchSettled(e->undecided, i, end);
        if (!t)
            continue;
        noteContacts(t);
        addImpulse(t);
        t->isTouching = mst_touchTouches(t);
    }
}

/* No list of events was made: only whether each pair touches is kept, which is known but of the undecided ones. */
static void skipList(MstBridgeRecord *b, MeTeam *team) {
    MstEvents *e = &b->events;
    MeTeam *workers = e->undecidedCount >= MST_MIN_RUNS * MST_RUN ? team : 0;
    if (MdtWorldIsValid(e->world)) {
        MeTeamOpen(workers);
        MeTeamRunRanges(workers, e->undecidedCount, MST_RUN, settleRange, e);
        MeTeamClose(workers);
    }
    clearList(e);
    e->ended.count = 0;
    e->isPending = MEFALSE;
}

void mst_updateEvents(MstBridgeRecord *record, MdtWorldID w) {
    record->events.done.count = record->events.firstBreak = 0;
    record->events.world = w;
    record->events.isPending = METRUE;
    if (record->events.callbacks > 0) {
        makeList(record);
        callBack(record);
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
        skipList(b, team);
    clearList(&b->events);
}

const MstEvent *MEAPI MstBridgeGetEvents(const MstBridgeID b, int *count) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetEvents");
    if (record)
        makeList(record);
    if (count)
        *count = record ? record->events.done.count : 0;
    if (!record)
        return 0;
    for (int i = 0; i < record->events.done.count; i++)
        refreshEvent(&record->events, i);
    return record->events.done.event;
}

/* ---- pairs ---- */

void mst_groupDestroy(McdModelPair *p) {
    if (p->responseData)
        MdtContactGroupDestroy((MdtContactGroupID)p->responseData);
    MEASSERT(!p->responseData); /* the group has cleared it */
}

void MEAPI mst_pairForget(McdModelPair *p) {
    if (!MdtConstraintIsValid(p->responseData)) /* it may have gone with its world */
        p->responseData = 0;
    mst_touchForget(p); /* while its forces can be read */
    mst_groupDestroy(p);
    p->forget = 0;
}
