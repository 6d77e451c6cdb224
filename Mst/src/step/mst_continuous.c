/* Continuous motion: fast models are stopped where they touch, and go on from there.
 *
 * A step is taken in parts. In the first all bodies move, but the partition of a fast model only up to its time of
 * impact; the others have then done their step. In each further part the lagging ones get new contacts, and advance to
 * the next impact or to the end of the step. A pair of bodies that will meet is tied into one partition before it
 * touches, so that both are at the same time when they do. The impact itself is a short part of its own, as the motion
 * after it is not known before.
 *
 * Lagging bodies must not push those already advanced, which would move for longer than the step. A lagging body that
 * meets such a one is stopped, and loses the rest of its step; so do bodies that still lag after the last part.
 *
 * A large partition is not held back by what hits it, which would cost as many solves of it: the fast body waits for it
 * and meets it in the next step, which is not divided either. A fast body in a large partition has safe times in the
 * first parts only.
 *
 * Reads findings, poses and velocities, contacts of the pair. Writes safe times of bodies, and the list of bodies that
 * have one; moves the world on. Times to touch are found by collide, and become safe times in commit.
 */
#include "McdGeometry.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "McdQuery.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MstUniverse.h"
#include "step/mst_step_i.h"

enum {
    MAX_SUBSTEPS = 16,
    MAX_LARGE_ISLAND_SUBSTEPS = 2, /* more than these, for its own */
    MIN_SUBSTEP = 1 << 13,         /* of a step is the shortest part: longer than what MdtWorldStepRest still takes */
};

/* ---- safe times ------------------------------------------------------------------------------------------------ */

void mst_clearSafeTimes(MstBridgeRecord *b) {
    for (int i = 0; i < b->clampedCount; i++)
        if (MdtBodyIsValid(b->clamped[i])) /* a callback may have destroyed it */
            MdtBodySetSafeTime(b->clamped[i], MEINFINITY);
    b->clampedCount = 0;
}

static MeBool hasRoom(MstBridgeRecord *b) {
    if (b->clampedCount < b->clampedMax)
        return METRUE;
    const int more = b->clampedMax ? 2 * b->clampedMax : 32;
    if (!MeMemoryGrow(&b->clamped, (size_t)b->clampedCount, (size_t)more, sizeof(MdtBodyID), "MstBridgeUpdateContacts",
                      "fast bodies"))
        return MEFALSE;
    b->clampedMax = more;
    return METRUE;
}

static void clampSafeTime(MstBridgeRecord *b, MdtBodyID body, MeReal time) {
    if (!body || !hasRoom(b))
        return;
    MEASSERT(time >= 0 && time <= b->ahead);
    MdtBodySetSafeTime(body, MeMIN(time, MdtBodyGetSafeTime(body)));
    b->clamped[b->clampedCount++] = body;
}

/* ---- time of impact -------------------------------------------------------------------------------------------- */

static int MEAPI isThatOne(McdModelID m, void *other) {
    return m == (McdModelID)other;
}

static void addDisplacement(MeVector3 displacement, McdModelID m, MeReal time) {
    const MeReal *velocity = McdModelGetLinearVelocityPtr(m);
    for (int i = 0; velocity && i < 3; i++)
        displacement[i] += time * velocity[i];
}

/* McdSafeTime does not support surfaces of triangles: there the shape is cast along its displacement, without its
 * rotation. It is stopped a little before. */
static MeReal timeToSurface(McdModelID shape, McdModelID surface, McdSpaceID s, MeReal max) {
    enum { STOP = 1000 };
    McdCastResult hit;
    MeVector3 displacement = {0, 0, 0}, centre;
    MeReal radius;
    addDisplacement(displacement, shape, max);
    addDisplacement(displacement, surface, -max);
    const MeReal length = MeVector3Magnitude(displacement);
    if (!(length > 0) ||
        !McdSpaceCastGeometry(s, McdModelGetGeometry(shape), (const MeVector4 *)McdModelGetTransformPtr(shape),
                              displacement, isThatOne, surface, &hit))
        return max;
    McdModelGetBSphere(shape, centre, &radius);
    return MeMAX(hit.fraction - radius / (STOP * length), 0) * max;
}

static MeReal lagOf(MdtBodyID body) {
    return body ? MdtBodyGetLag(body) : 0;
}

static MeReal marginOf(const McdModelPair *p) {
    return MeMAX(McdModelGetFastMargin(p->model1), McdModelGetFastMargin(p->model2));
}

/* s, for which the pair's bodies move in this part of the step. */
static MeReal timeLeft(const MstBridgeRecord *b, const McdModelPair *p) {
    return b->substep == 0 ? b->ahead : mst_lagOfPair(p);
}

MeReal mst_timeToTouch(const MstBridgeRecord *b, McdModelPair *p, McdSpaceID s) {
    const MeReal max = timeLeft(b, p);
    McdSafeTimeResult safe;
    if (McdModelIsSurface(p->model2) && McdModelIsConvex(p->model1))
        return timeToSurface(p->model1, p->model2, s, max);
    if (McdModelIsSurface(p->model1) && McdModelIsConvex(p->model2))
        return timeToSurface(p->model2, p->model1, s, max);
    return McdSafeTime(p, max, &safe) ? safe.time : max;
}

static MeReal approachOf(const McdModelPair *p) {
    const MdtContactGroupID group = p->responseData;
    MdtContactID c = group ? MdtContactGroupGetFirstContact(group) : 0;
    MeReal max = 0;
    for (; c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 position, normal;
        MdtContactGetPosition(c, position);
        mst_normalOf(p, c, normal);
        max = MeMAX(max, mst_approachAt(p, position, normal));
    }
    return max;
}

/* s: an impact gets a part of its own, twice as long as it takes to close the gap; the motion after it is predicted in
 * the next part. Not where the pair slides or rests, and its motion continues. */
static MeReal timeOfImpact(const McdModelPair *p, MeReal max) {
    const MeReal approach = approachOf(p), margin = marginOf(p);
    return approach * max > 4 * margin ? 2 * margin / approach : max;
}

/* s: the shortest part. In it a body moves by no more, or little more, than its speculative margin: at 100 times its
 * size per step by 1 % of its size. */
static MeReal minSubstep(const MstBridgeRecord *b) {
    return b->ahead / MIN_SUBSTEP;
}

/* Bodies are not stopped if the rest of the step would be shorter than the shortest part. */
static MeBool stopsBefore(const MstBridgeRecord *b, MeReal time, MeReal max) {
    return max - time > minSubstep(b);
}

static void stopAt(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w, MeReal time) {
    const MdtBodyID body1 = mst_bodyOf(p->model1), body2 = mst_bodyOf(p->model2);
    const MeBool stops1 =
        !mst_isInLargeIsland(body1) || (b->substep < MAX_LARGE_ISLAND_SUBSTEPS && McdModelGetFastMargin(p->model1) > 0);
    const MeBool stops2 =
        !mst_isInLargeIsland(body2) || (b->substep < MAX_LARGE_ISLAND_SUBSTEPS && McdModelGetFastMargin(p->model2) > 0);
    if (body1 && body2 && stops1 && stops2)
        mst_pairTie(b, p, w);
    if (stops1)
        clampSafeTime(b, body1, time);
    if (stops2)
        clampSafeTime(b, body2, time);
}

void mst_followFast(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, McdSpaceID s, MdtWorldID w) {
    McdModelPair *p = f->pair;
    if (!f->isFast)
        return;
    if (hasContacts && (mst_isInLargeIsland(mst_bodyOf(p->model1)) || mst_isInLargeIsland(mst_bodyOf(p->model2))))
        return;
    const MeReal max = timeLeft(b, p);
    const MeReal time = hasContacts                     ? timeOfImpact(p, max)
                        : f->timeToTouch != MST_UNKNOWN ? f->timeToTouch
                                                        : mst_timeToTouch(b, p, s);
    if (stopsBefore(b, time, max))
        stopAt(b, p, w, MeMAX(time, minSubstep(b)));
}

MeBool mst_isInLargeIsland(MdtBodyID body) {
    enum { LARGE_ISLAND = 32 };
    return body && MdtBodyGetPartitionSize(body) > LARGE_ISLAND;
}

/* ---- the parts after the first --------------------------------------------------------------------------------- */

/* Whether the body has done its step, so that it must not be pushed. */
static MeBool isDone(MdtBodyID body) {
    return body && MdtBodyIsEnabled(body) && !(MdtBodyGetLag(body) > 0);
}

static MeBool isLagging(McdModelID m) {
    return lagOf(mst_bodyOf(m)) > 0;
}

/* Whether a body of the pair lags, so that it still moves in this step, and the pair may have contacts. */
static MeBool mayMove(const McdModelPair *p) {
    return (isLagging(p->model1) || isLagging(p->model2)) && !McdModelIsSensor(p->model1) &&
           !McdModelIsSensor(p->model2);
}

static MeBool hasDoneBody(const McdModelPair *p) {
    return isDone(mst_bodyOf(p->model1)) || isDone(mst_bodyOf(p->model2));
}

static McdModelID laggingModel(const McdModelPair *p) {
    return isLagging(p->model1) ? p->model1 : p->model2;
}

MeBool mst_mayCollide(const McdModelPair *p) {
    return mayMove(p) && !hasDoneBody(p);
}

MeBool mst_mustWait(const McdModelPair *p) {
    return mayMove(p) && hasDoneBody(p) && McdModelGetFastMargin(laggingModel(p)) > 0;
}

void mst_waitFor(MstBridgeRecord *b, const MstFinding *f) {
    MEASSERT(f->timeToTouch != MST_UNKNOWN);
    clampSafeTime(b, mst_bodyOf(laggingModel(f->pair)), f->timeToTouch);
}

/* 0: nothing can move on. */
static int advanceLag(MstUniverse *u, MstBridgeRecord *b, MeReal step) {
    MEASSERT(b->substep > 0 && b->substep < MAX_SUBSTEPS);
    mst_eventsGather(b);
    McdSpacePathUpdateAll(u->space, step);
    mst_updateContacts(b, u->space, u->world);
    return MdtWorldAdvanceLag(u->world);
}

void mst_stepWorld(MstUniverse *u, MeReal step) {
    MstBridgeRecord *b = (MstBridgeRecord *)u->bridge;
    if (b->clampedCount == 0) {
        MdtWorldAdvance(u->world, step, MEFALSE);
        return;
    }
    MdtWorldAdvance(u->world, step, METRUE);
    for (b->substep = 1; b->substep < MAX_SUBSTEPS && MdtWorldGetLaggingBodies(u->world) > 0; b->substep++)
        if (!advanceLag(u, b, step))
            break;
    b->substep = 0;
    mst_clearSafeTimes(b);
    MEASSERT(b->clampedCount == 0);
}
