/* Touches: the bridge's records of pairs, kept from step to step and updated as their contacts are committed.
 *
 * A pair has a touch from its first contact until the space releases the pair. In each step, the touches of pairs that
 * were handled and have or had contacts are listed in the order of the pairs; events are made from that list
 * (MstEvents.c).
 *
 * Reads models, the motion of bodies, contacts. Writes touches, the list, and the pairs' pointers to their touches.
 */
#include "McdModel.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "touch/mst_touch_i.h"
#include <string.h>

/* ---- memory ------------------------------------------------------------------------------------------------------ */

static int sizeOfBlock(int block) {
    return MST_TOUCH_BLOCK << block;
}

/* Adds a block of free touches. Without memory, the free list remains empty. */
static void addTouchBlock(MstEvents *e) {
    const int size = sizeOfBlock(e->blockCount);
    MstTouch *touch = e->blockCount == MST_TOUCH_BLOCKS
                          ? 0
                          : MeMemoryTakeAligned((size_t)size, sizeof *touch, ME_CACHE_LINE, "MstBridgeUpdateContacts",
                                                "what touches");
    if (!touch)
        return;
    memset(touch, 0, (size_t)size * sizeof *touch);
    e->block[e->blockCount++] = touch;
    for (int i = size - 1; i >= 0; i--) { /* so that they are allocated in the order of addresses */
        touch[i].nextFree = e->free;
        e->free = &touch[i];
    }
}

static MstTouch *allocateTouch(MstBridgeRecord *b) {
    MstEvents *e = &b->events;
    if (!e->free)
        addTouchBlock(e);
    MstTouch *t = e->free;
    if (!t)
        return 0;
    e->free = t->nextFree;
    MEASSERT(!t->pair && !mst_touchIsListed(e, t));
    memset(t, 0, sizeof *t);
    t->bridge = b;
    return t;
}

void mst_touchFree(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    MEASSERT(t->pair && !t->pair->touch);
    memset(t, 0, sizeof *t);
    t->nextFree = e->free;
    e->free = t;
}

void mst_freeTouches(MstEvents *e) {
    for (int k = 0; k < e->blockCount; k++) {
        for (int i = 0; i < sizeOfBlock(k); i++)
            if (e->block[k][i].pair)
                e->block[k][i].pair->touch = 0;
        MeMemoryGiveAligned(e->block[k]);
    }
    MeMemoryGive(e->listed);
    MeMemoryGive(e->undecided);
}

/* The touch of a pair, allocated if needed; null without memory. */
static MstTouch *ensureTouch(MstBridgeRecord *b, McdModelPair *p) {
    const McdModelID model[2] = {p->model1, p->model2};
    MstTouch *t = p->touch ? p->touch : allocateTouch(b);
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

/* ---- the list of the step ---------------------------------------------------------------------------------------- */

/* Appends a touch to a list. False, after MeFatalError: no memory, and the list is unchanged. */
static MeBool appendTouch(MstTouch ***list, int *count, int *max, MstTouch *t) {
    if (!mst_reserveOne(list, *count, max, sizeof **list, "what touches"))
        return MEFALSE;
    (*list)[(*count)++] = t;
    return METRUE;
}

/* Resets a touch to its state before this step. */
static void markUnlisted(MstTouch *t) {
    t->listedIn = 0;
    t->isTouching = t->wasTouching;
    t->isUndecided = false;
}

void mst_touchList(MstEvents *e, MstTouch *t, MeBool isUndecided) {
    MEASSERT(mst_touchIsListed(e, t) && !isUndecided == !t->isUndecided);
    if (!appendTouch(&e->listed, &e->listedCount, &e->listedMax, t))
        markUnlisted(t);
    else if (isUndecided && !appendTouch(&e->undecided, &e->undecidedCount, &e->undecidedMax, t))
        t->isUndecided = false;
}

static void clearEntriesOf(MstTouch **list, int count, const MstTouch *t) {
    for (int i = 0; i < count; i++)
        if (list[i] == t)
            list[i] = 0;
}

void mst_touchUnlist(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    MEASSERT(mst_touchIsListed(e, t));
    clearEntriesOf(e->listed, e->listedCount, t);
    clearEntriesOf(e->undecided, e->undecidedCount, t);
    markUnlisted(t);
}

MeBool mst_touchesAreConsistent(const MstEvents *e) {
    int listed = 0, undecided = 0;
    for (int k = 0; k < e->blockCount; k++)
        for (const MstTouch *t = e->block[k]; t < e->block[k] + sizeOfBlock(k); t++) {
            const MeBool isListed = mst_touchIsListed(e, t);
            if (t->pair ? t->pair->touch != t : isListed)
                return MEFALSE;
            listed += isListed;
            undecided += isListed && t->isUndecided;
        }
    for (int i = 0; i < e->listedCount; i++)
        listed -= e->listed[i] != 0;
    for (int i = 0; i < e->undecidedCount; i++)
        undecided -= e->undecided[i] != 0;
    return listed == 0 && undecided == 0 && e->done.count <= e->done.max && e->ended.count <= e->ended.max;
}

MeReal mst_pairLag(const McdModelPair *p) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    const MeReal lag1 = body1 ? MdtBodyGetLag(body1) : 0, lag2 = body2 ? MdtBodyGetLag(body2) : 0;
    return MeMAX(lag1, lag2);
}

/* ---- whether it touches ------------------------------------------------------------------------------------------ */

MeBool mst_touchEvaluate(const MstTouch *t) {
    if (!t->hasContacts)
        return MEFALSE;
    return t->impulse > 0 || t->separation <= 0 || (t->wasTouching && !t->isSensor && t->separation <= t->tolerance);
}

/* Evaluates, after an update, whether the pair touches. That is undecided while only contact forces, known after the
 * step, can decide it. */
static void evaluateTouch(MstTouch *t) {
    const MeBool isDecided = !t->hasContacts || t->isSensor || t->separation <= (t->wasTouching ? t->tolerance : 0);
    t->isTouching = mst_touchEvaluate(t);
    t->isUndecided = t->isUndecided || !isDecided;
}

/* evaluateTouch for a touch that is in this step's list already. */
static void evaluateListedTouch(MstTouch *t) {
    MstEvents *e = &t->bridge->events;
    const MeBool wasUndecided = t->isUndecided;
    evaluateTouch(t);
    if (t->isUndecided && !wasUndecided && !appendTouch(&e->undecided, &e->undecidedCount, &e->undecidedMax, t))
        t->isUndecided = false;
}

/* ---- the touch of a step ----------------------------------------------------------------------------------------- */

/* Resets a touch for this step: no contacts are added yet. */
static void beginTouch(const MstBridgeRecord *b, const McdModelPair *p, MeBool hasContacts, MeBool isSensor) {
    MstTouch *t = p->touch;
    MEASSERT(!mst_touchIsListed(&b->events, t));
    t->wasTouching = mst_touchIsTouching(&b->events, t);
    t->listedIn = b->events.list;
    t->isUndecided = false;
    t->lag = b->substep == 0 ? MEINFINITY : mst_pairLag(p);
    t->hasContacts = hasContacts;
    t->isSensor = isSensor;
    t->material[0] = McdModelGetMaterial(p->model1);
    t->material[1] = McdModelGetMaterial(p->model2);
    t->tolerance = McdModelGetContactTolerance(p->model1) + McdModelGetContactTolerance(p->model2);
    t->separation = t->deepest = MEINFINITY;
    t->approachSpeed = t->impulse = t->largestImpulse = 0;
}

/* The touch of a handled pair, listed for this step; null if it has no contacts and had none, or without memory. */
static MstTouch *listedTouch(MstBridgeRecord *b, McdModelPair *p, MeBool hasContacts, MeBool isSensor) {
    const MeBool isSpaces = p->phase != kMcdFFStateInactive; /* a program's own pair may vanish unnoticed */
    MstTouch *t = isSpaces && (hasContacts || p->touch) ? ensureTouch(b, p) : 0;
    if (!t || mst_touchIsListed(&b->events, t)) { /* listed in an earlier sub-step */
        if (t)
            t->hasContacts = t->hasContacts || hasContacts;
        return t;
    }
    if (!appendTouch(&b->events.listed, &b->events.listedCount, &b->events.listedMax, t))
        return 0;
    beginTouch(b, p, hasContacts, isSensor);
    return t;
}

/* ---- its contacts ------------------------------------------------------------------------------------------------ */

static void surfaceVelocityAt(McdModelID m, MeVector3 point, MeVector3 velocity) {
    const MdtBodyID body = mst_bodyOf(m);
    const MeReal *linear = McdModelGetLinearVelocityPtr(m);
    MeVector3Set(velocity, 0, 0, 0);
    if (body)
        MdtBodyGetVelocityAtPoint(body, point, velocity);
    else if (linear)
        MeVector3Copy(velocity, linear);
}

/* m/s²: of a body by gravity and the forces of this step; 0 for the world, and for what sleeps. */
static void freeAccelerationOf(McdModelID m, MeVector3 a) {
    const MdtBodyID body = mst_freeBodyOf(m);
    MeVector3Set(a, 0, 0, 0);
    if (body && !(McdModelGetSpace(m) && McdSpaceModelIsFrozen(m)))
        MdtBodyGetLoadAcceleration(body, a);
}

/* The speed u with which a gap d closes, from the speed v at the beginning of the step: u² = v² + 2 a d. */
MeReal mst_approachSpeedAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal, MeReal gap) {
    MeVector3 v1, v2, a1, a2;
    surfaceVelocityAt(p->model1, point, v1);
    surfaceVelocityAt(p->model2, point, v2);
    freeAccelerationOf(p->model1, a1);
    freeAccelerationOf(p->model2, a2);
    MeVector3Subtract(v1, v1, v2);
    MeVector3Subtract(a1, a1, a2);
    const MeReal speed = -MeVector3Dot(v1, normal), acceleration = -MeVector3Dot(a1, normal);
    if (!(gap > 0) || (speed <= 0 && acceleration <= 0))
        return speed;
    return MeSqrt(MeMAX(speed * speed + 2 * acceleration * gap, 0));
}

/* Adds a contact to the touch. Its position is that of the deepest contact, until impulses select another one. */
static void addContact(MstTouch *t, MeVector3 position, const MeVector3 normal, MeReal separation) {
    t->separation = MeMIN(t->separation, separation);
    if (separation < t->deepest) {
        t->deepest = separation;
        MeVector3Copy(t->position, position);
        MeVector3Copy(t->normal, normal);
    }
    if (!t->wasTouching)
        t->approachSpeed = MeMAX(t->approachSpeed, mst_approachSpeedAt(t->pair, position, normal, separation));
}

void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal) {
    MdtContactGetNormal(c, normal);
    if (mst_isSwapped(p))
        MeVector3MultiplyScalar(normal, normal, -1);
}

void mst_touchAddContacts(MstTouch *t, MdtContactGroupID group) {
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 position, normal;
        MdtContactGetPosition(c, position);
        mst_normalOf(t->pair, c, normal);
        addContact(t, position, normal, -MdtContactGetPenetration(c));
    }
}

/* The least separation of the contacts found or, if callbacks have removed some, of the remaining ones. */
static MeReal minSeparation(MdtContactGroupID group, int numContacts, int found, MeReal separation) {
    MeReal min = MEINFINITY;
    if (numContacts == found)
        return separation;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        min = MeMIN(min, -MdtContactGetPenetration(c));
    return min;
}

static void addUnchangedContacts(MstTouch *t, MeReal separation) {
    t->separation = MeMIN(t->separation, separation);
    if (!t->wasTouching)
        mst_touchAddContacts(t, t->pair->responseData);
}

void mst_touchCommitUnchanged(MstBridgeRecord *b, McdModelPair *p) {
    MstTouch *t = p->touch;
    const MeReal separation = t->separation;
    if (!listedTouch(b, p, METRUE, MEFALSE))
        return;
    addUnchangedContacts(t, separation);
    evaluateListedTouch(t);
}

void mst_touchUpdateUnchanged(const MstBridgeRecord *b, const McdModelPair *p) {
    MstTouch *t = p->touch;
    const MeReal separation = t->separation;
    beginTouch(b, p, METRUE, MEFALSE);
    addUnchangedContacts(t, separation);
    evaluateTouch(t);
}

static void addFoundContacts(MstTouch *t, int numContacts, int found, MeReal separation) {
    const MdtContactGroupID group = t->pair->responseData;
    if (!t->wasTouching) /* the approach speed is known only before the solve */
        mst_touchAddContacts(t, group);
    else
        t->separation = MeMIN(t->separation, minSeparation(group, numContacts, found, separation));
}

void mst_touchCommitTested(MstBridgeRecord *b, McdModelPair *p, int numContacts, int found, MeReal separation) {
    MstTouch *t = listedTouch(b, p, numContacts > 0, MEFALSE);
    if (t && numContacts > 0)
        addFoundContacts(t, numContacts, found, separation);
    if (t)
        evaluateListedTouch(t);
}

void mst_touchUpdateTested(const MstBridgeRecord *b, const McdModelPair *p, int numContacts, int found,
                           MeReal separation) {
    beginTouch(b, p, numContacts > 0, MEFALSE);
    if (numContacts > 0)
        addFoundContacts(p->touch, numContacts, found, separation);
    evaluateTouch(p->touch);
}

void mst_touchCommitSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result) {
    MstTouch *t = listedTouch(b, p, result->contactCount > 0, METRUE);
    if (!t)
        return;
    for (int i = 0; i < result->contactCount; i++)
        addContact(t, result->contacts[i].position, result->contacts[i].normal, result->contacts[i].separation);
    evaluateListedTouch(t);
}
