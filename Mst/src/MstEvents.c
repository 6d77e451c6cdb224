/* Events: what touches, from step to step.
 *
 * A pair has a touch from its first contact until the space takes the pair back. While contacts are made, the touches
 * of the step are listed; after the step, the forces of their contacts say which of them touch, and what is new about
 * that.
 *
 * The list of events is made when somebody asks for it, or has a callback, or destroys what it is about. When nobody
 * has until the next step begins, only whether each pair touches is kept: most pairs go on touching, and nobody wants
 * to know.
 */
#include "MstEvents.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "mst_i.h"
#include <string.h>

/* ---- memory ---------------------------------------------------------------------------------------------------- */

/* Room for one more. False, after MeFatalError, if there is no memory: all is as it was then. */
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

static void add(MstEventList *list, const MstEvent *event, const MeU64 serial[2]) {
    if (!hasRoom(list))
        return;
    list->event[list->count] = *event;
    memcpy(list->serial[list->count++], serial, sizeof *list->serial);
}

static void freeList(MstEventList *list) {
    MeMemoryGive(list->event);
    MeMemoryGive(list->serial);
}

/* ---- touches --------------------------------------------------------------------------------------------------- */

static MstTouch *takeTouch(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    MstTouch *t = e->free;
    if (t)
        e->free = t->next;
    else
        t = MeMemoryTake(1, sizeof *t, "MstBridgeUpdateContacts", "what touches");
    if (!t)
        return 0;
    memset(t, 0, sizeof *t);
    t->bridge = b;
    t->next = e->first;
    if (e->first)
        e->first->previous = t;
    e->first = t;
    return t;
}

static void giveTouch(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    MEASSERT((t->previous ? t->previous->next : e->first) == t);
    *(t->previous ? &t->previous->next : &e->first) = t->next;
    if (t->next)
        t->next->previous = t->previous;
    t->next = e->free;
    e->free = t;
}

/* The touch of a pair; null if it has none and there is no memory. */
static MstTouch *ensureTouch(MstBridgeRecord *b, McdModelPair *p) {
    const McdModelID model[2] = {p->model1, p->model2};
    MstTouch *t = p->touch ? p->touch : takeTouch(b);
    if (!t || p->touch)
        return t;
    t->pair = p;
    for (int k = 0; k < 2; k++) {
        t->model[k].model = model[k];
        t->model[k].serial = McdModelGetSerial(model[k]);
    }
    p->touch = t;
    p->forget = mst_pairForget;
    return t;
}

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

static void tell(MstEventList *list, const MstTouch *t, MstEventKind kind) {
    const MstEvent event = eventOf(t, kind);
    const MeU64 serial[2] = {t->model[0].serial, t->model[1].serial};
    add(list, &event, serial);
}

static void unlist(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    for (int i = 0; i < e->listedCount; i++)
        if (e->listed[i] == t)
            e->listed[i] = 0;
}

static void freeTouches(MstTouch *t) {
    for (MstTouch *next; t; t = next) {
        next = t->next;
        MeMemoryGive(t);
    }
}

void mst_eventsTerm(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    for (MstTouch *t = e->first; t; t = t->next)
        t->pair->touch = 0;
    freeTouches(e->first);
    freeTouches(e->free);
    freeList(&e->done);
    freeList(&e->ended);
    MeMemoryGive(e->listed);
}

/* ---- before the step ------------------------------------------------------------------------------------------- */

static void unlistAll(MstEvents *e) {
    for (int i = 0; i < e->listedCount; i++)
        if (e->listed[i])
            e->listed[i]->isListed = MEFALSE;
    e->listedCount = 0;
}

static MeBool list(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    if (e->listedCount == e->listedMax) {
        const int more = e->listedMax ? 2 * e->listedMax : 64;
        if (!MeMemoryGrow(&e->listed, (size_t)e->listedCount, (size_t)more, sizeof *e->listed,
                          "MstBridgeUpdateContacts", "what touches"))
            return MEFALSE;
        e->listedMax = more;
    }
    e->listed[e->listedCount++] = t;
    t->isListed = METRUE;
    return METRUE;
}

/* How far the pair's bodies are behind their world: those that are tied move together. */
static MeReal lagOf(const McdModelPair *p) {
    const MdtBodyID body1 = McdModelGetBody(p->model1), body2 = McdModelGetBody(p->model2);
    const MeReal lag1 = body1 ? MdtBodyGetLag(body1) : 0, lag2 = body2 ? MdtBodyGetLag(body2) : 0;
    return MeMAX(lag1, lag2);
}

/* The touch of a pair that was looked at, listed for this step; null where there is nothing to tell. */
static MstTouch *noted(MstBridgeRecord *b, McdModelPair *p, MeBool hasContacts, MeBool isSensor) {
    const MeBool isSpaces = p->phase != kMcdFFStateInactive; /* a program's own pair may go at any time, unnoticed */
    MstTouch *t = isSpaces && (hasContacts || p->touch) ? ensureTouch(b, p) : 0;
    if (!t || t->isListed) { /* in a later part of the step */
        if (t)
            t->hasContacts = t->hasContacts || hasContacts;
        return t;
    }
    if (!list(t))
        return 0;
    t->lag = b->part == 0 ? MEINFINITY : lagOf(p);
    t->hasContacts = hasContacts;
    t->isSensor = isSensor;
    t->material[0] = McdModelGetMaterial(p->model1);
    t->material[1] = McdModelGetMaterial(p->model2);
    t->tolerance = McdModelGetContactTolerance(p->model1) + McdModelGetContactTolerance(p->model2);
    t->separation = t->deepest = MEINFINITY;
    t->approachSpeed = t->impulse = t->largestImpulse = 0;
    return t;
}

static void velocityAt(McdModelID m, MeVector3 point, MeVector3 velocity) {
    const MdtBodyID body = McdModelGetBody(m);
    const MeReal *linear = McdModelGetLinearVelocityPtr(m);
    MeVector3Set(velocity, 0, 0, 0);
    if (body)
        MdtBodyGetVelocityAtPoint(body, point, velocity);
    else if (linear)
        MeVector3Copy(velocity, linear);
}

MeReal mst_approachAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal) {
    MeVector3 v1, v2;
    velocityAt(p->model1, point, v1);
    velocityAt(p->model2, point, v2);
    MeVector3Subtract(v1, v1, v2);
    return -MeVector3Dot(v1, normal);
}

/* The deepest contact is where it touches, until forces say better. */
static void noteContact(MstTouch *t, MeVector3 position, const MeVector3 normal, MeReal separation) {
    t->separation = MeMIN(t->separation, separation);
    if (separation < t->deepest) {
        t->deepest = separation;
        MeVector3Copy(t->position, position);
        MeVector3Copy(t->normal, normal);
    }
    if (!t->isTouching)
        t->approachSpeed = MeMAX(t->approachSpeed, mst_approachAt(t->pair, position, normal));
}

/* A group's normals push its first body; where the first model has none, that is the second model's. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal) {
    MdtContactGetNormal(c, normal);
    if (!McdModelGetBody(p->model1))
        MeVector3MultiplyScalar(normal, normal, -1);
}

static void noteGroup(MstTouch *t, MdtContactGroupID group) {
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 position, normal;
        MdtContactGetPosition(c, position);
        mst_normalOf(t->pair, c, normal);
        noteContact(t, position, normal, -MdtContactGetPenetration(c));
    }
}

/* Of the contacts found, or of those that callbacks have left. */
static MeReal leastSeparation(MdtContactGroupID group, const McdIntersectResult *result) {
    MeReal least = MEINFINITY;
    if (MdtContactGroupGetCount(group) == result->contactCount) {
        for (int i = 0; i < result->contactCount; i++)
            least = MeMIN(least, result->contacts[i].separation);
        return least;
    }
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        least = MeMIN(least, -MdtContactGetPenetration(c));
    return least;
}

void mst_touchNoteAgain(MstBridgeRecord *b, McdModelPair *p) {
    MstTouch *t = p->touch;
    const MeReal separation = t->separation;
    if (!noted(b, p, METRUE, MEFALSE))
        return;
    t->separation = MeMIN(t->separation, separation);
    if (!t->isTouching)
        noteGroup(t, p->responseData);
}

void mst_touchNote(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result) {
    const MdtContactGroupID group = p->responseData;
    const MeBool hasContacts = group && MdtContactGroupGetCount(group) > 0;
    MstTouch *t = noted(b, p, hasContacts, MEFALSE);
    if (!t || !hasContacts)
        return;
    if (!t->isTouching) /* how fast they come is known now only */
        noteGroup(t, group);
    else
        t->separation = MeMIN(t->separation, leastSeparation(group, result));
}

void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result) {
    MstTouch *t = noted(b, p, result->contactCount > 0, METRUE);
    if (!t)
        return;
    for (int i = 0; i < result->contactCount; i++)
        noteContact(t, result->contacts[i].position, result->contacts[i].normal, result->contacts[i].separation);
}

/* ---- after the step -------------------------------------------------------------------------------------------- */

/* Adds what the contacts did since the last time. */
static void gather(MstTouch *t) {
    const MdtContactGroupID group = t->pair->responseData;
    const MeReal before = t->lag;
    t->lag = lagOf(t->pair);
    if (group && t->isTouching && !t->isSensor)
        noteGroup(t, group);
    if (!group || MdtContactGroupGetCount(group) == 0 || !(t->lag < before))
        return;
    const MeReal time = MdtBodyGetPart(MdtContactGroupGetBody(group, 0));
    t->impulse += time * MdtContactGroupGetNormalForce(group);
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

void mst_eventsGather(MstBridgeRecord *b) {
    for (int i = 0; i < b->events.listedCount; i++)
        if (b->events.listed[i])
            gather(b->events.listed[i]);
}

/* Do forces make no difference to whether it touches? */
static MeBool isDecided(const MstTouch *t) {
    return !t->hasContacts || t->isSensor || t->separation <= (t->isTouching ? t->tolerance : 0);
}

static MeBool touches(const MstTouch *t) {
    if (!t->hasContacts)
        return MEFALSE;
    return t->impulse > 0 || t->separation <= 0 || (t->isTouching && !t->isSensor && t->separation <= t->tolerance);
}

static void tellChange(MstEvents *e, MstTouch *t) {
    const MeBool was = t->isTouching, is = touches(t);
    t->isTouching = is;
    if (is)
        tell(&e->done, t, was ? MstEventPersist : MstEventBegin);
    else if (was)
        tell(&e->done, t, MstEventEnd);
}

static void takeEnded(MstEvents *e) {
    for (int i = 0; i < e->ended.count; i++)
        add(&e->done, &e->ended.event[i], e->ended.serial[i]);
    e->ended.count = 0;
}

static void tellBreaks(MstEvents *e, MdtWorldID w) {
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
        add(&e->done, &event, none);
    }
}

static McdModelID ifAlive(McdModelID m, MeU64 serial) {
    return McdModelGetSerial(m) == serial ? m : 0;
}

/* Nulls what was destroyed since. Breaks come last, in the order of the world's list. */
static void refresh(MstEvents *e, int i) {
    MstEvent *event = &e->done.event[i];
    if (event->kind == MstEventBreak) {
        event->joint = MdtWorldGetBrokenJoints(e->world, 0)[i - e->firstBreak];
        return;
    }
    event->model1 = ifAlive(event->model1, e->done.serial[i][0]);
    event->model2 = ifAlive(event->model2, e->done.serial[i][1]);
}

/* Every touch knows its neighbours and its pair, which knows it; what is listed says so. */
static MeBool areTouchesConsistent(const MstEvents *e) {
    int listed = 0;
    for (const MstTouch *t = e->first; t; t = t->next) {
        if (t->pair->touch != t || (t->next && t->next->previous != t))
            return MEFALSE;
        listed += t->isListed;
    }
    for (int i = 0; i < e->listedCount; i++)
        listed -= e->listed[i] != 0;
    return listed == 0 && e->done.count <= e->done.max && e->ended.count <= e->ended.max;
}

static void callBack(MstBridgeRecord *b) {
    for (int i = 0; i < b->events.firstBreak; i++) {
        refresh(&b->events, i);
        const MstEvent *event = &b->events.done.event[i];
        const MstTouchCBPtr cb = mst_materialPair(b, event->material1, event->material2)->touchCb;
        if (cb)
            cb(event);
    }
}

/* Makes the list of the step that is done, unless there is one, or its world is gone. */
static void makeList(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    const MeBool isToDo = e->isPending && MdtWorldIsValid(e->world);
    e->isPending = MEFALSE;
    if (!isToDo)
        return;
    MEVALIDATE(areTouchesConsistent(e));
    mst_eventsGather(b);
    takeEnded(e);
    for (int i = 0; i < e->listedCount; i++)
        if (e->listed[i])
            tellChange(e, e->listed[i]);
    unlistAll(e);
    tellBreaks(e, e->world);
}

void MEAPI mst_touchForget(McdModelPair *p) {
    MstTouch *t = p->touch;
    if (!t)
        return;
    makeList(t->bridge);
    MEASSERT(t->pair == p);
    p->touch = 0;
    if (t->isTouching)
        tell(&t->bridge->events.ended, t, MstEventEnd);
    if (t->isListed)
        unlist(t);
    giveTouch(t);
}

/* Nobody has asked: what touches is kept, and no more. */
static void skipList(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    const MeBool areForcesKnown = MdtWorldIsValid(e->world);
    for (int i = 0; i < e->listedCount; i++) {
        MstTouch *t = e->listed[i];
        if (t && areForcesKnown && !isDecided(t))
            gather(t);
        if (t)
            t->isTouching = touches(t);
    }
    unlistAll(e);
    e->ended.count = 0;
    e->isPending = MEFALSE;
}

void MEAPI MstBridgeUpdateEvents(const MstBridgeID b, const MdtWorldID w) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeUpdateEvents");
    if (!record)
        return;
    record->events.done.count = record->events.firstBreak = 0;
    record->events.world = w;
    record->events.isPending = METRUE;
    if (record->events.callbacks > 0) {
        makeList(record);
        callBack(record);
    }
}

void mst_eventsBegin(MstBridgeRecord *b) {
    if (b->events.isPending)
        skipList(b);
    unlistAll(&b->events);
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
        refresh(&record->events, i);
    return record->events.done.event;
}
