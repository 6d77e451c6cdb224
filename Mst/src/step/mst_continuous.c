/* Continuous motion: fast models are stopped at their time of impact, and continue from there.
 *
 * A step is divided into sub-steps. In the first one all bodies move, but the partition of a fast model only up to its
 * time of impact; the other bodies have then completed their step. In each further sub-step the lagging bodies get new
 * contacts, and advance to the next impact or to the end of the step. Two bodies that will collide are joined into one
 * partition beforehand, so that both are at the same time at the impact. The impact itself is a short sub-step of its
 * own, as the motion after it is not known in advance.
 *
 * Lagging bodies must not push bodies that have already advanced, which would then move for longer than the step. A
 * lagging body that reaches such a body is stopped, and loses the rest of its step.
 *
 * What would reach a body that will be stopped is stopped with it: the bodies of a row one after the other. Their next
 * impacts are found in the next sub-step.
 *
 * A mover has made its whole step after the first sub-step. In the others it is put back, for each pair, to where it
 * was at the time of the body that lags.
 *
 * A body that still lags after the last sub-step turns too fast: its pose was known for a short time only. It goes on
 * without turning, from impact to impact. What lags even then, as bodies with joints do, loses the rest of the step,
 * which movers do not: they push it, as if it were at rest. Otherwise they would pass it.
 *
 * A large partition is not stopped by a fast body that hits it, as each sub-step would need a solve of the whole
 * partition. The fast body waits in front of it and collides in the next step, which is not divided either. Fast bodies
 * within a large partition get safe times in the first sub-steps only, and none for each other: those pairs have
 * contacts ahead of their impacts, as slow ones do (mst_isWithinLargeIsland).
 *
 * Reads findings, poses and velocities, contacts of the pair. Writes safe times of bodies, and the list of bodies that
 * have one; advances the world. Collide computes the times of impact; commit sets them as safe times.
 */
#include "McdGeometry.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "McdQuery.h"
#include "MdtBody.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MstUniverse.h"
#include "step/mst_step_i.h"

enum {
    MAX_SUBSTEPS = 16,
    MAX_LARGE_ISLAND_SUBSTEPS = 2, /* sub-steps with safe times for fast bodies in a large partition */
    MIN_SUBSTEP = 1 << 13,         /* step / shortest sub-step; MdtWorldStepRest skips those below 1 / 2^14 of a step */
};

/* ---- safe times ------------------------------------------------------------------------------------------------ */

void mst_clearSafeTimes(MstBridgeRecord *b) {
    for (int i = 0; i < b->clampedCount; i++)
        if (MdtBodyIsValid(b->clamped[i])) /* a callback may have destroyed it */
            MdtBodySetSafeTime(b->clamped[i], MEINFINITY);
    b->clampedCount = 0;
}

static void clampBody(MstBridgeRecord *b, MdtBodyID body, MeReal time) {
    if (!body || b->isPushing ||
        !mst_reserveOne(&b->clamped, b->clampedCount, &b->clampedMax, sizeof *b->clamped, "fast bodies"))
        return;
    MEASSERT(time >= 0 && time <= b->ahead);
    MdtBodySetSafeTime(body, MeMIN(time, MdtBodyGetSafeTime(body)));
    b->clamped[b->clampedCount++] = body;
}

/* ---- time of impact -------------------------------------------------------------------------------------------- */

static MeReal lagOf(MdtBodyID body) {
    return body ? MdtBodyGetLag(body) : 0;
}

/* s, the time that the pair's bodies move in this sub-step. A body that has not moved in this step may have the lag of
 * an earlier, longer one. */
static MeReal remainingTime(const MstBridgeRecord *b, const McdModelPair *p) {
    return b->substep == 0 ? b->ahead : MeMIN(mst_pairLag(p), b->ahead);
}

static void copyVector(MeVector3 to, const MeReal *from) {
    for (int i = 0; i < 3; i++)
        to[i] = from ? from[i] : 0;
}

/* Whether the body has completed its step, so that it must not be pushed. */
static MeBool hasAdvanced(MdtBodyID body) {
    return body && !MdtBodyIsMover(body) && MdtBodyIsEnabled(body) && !(MdtBodyGetLag(body) > 0);
}

/* The point about which the model turns, in world coordinates; null without a transform. */
static const MeReal *centreOf(McdModelID m) {
    const MdtBodyID body = mst_bodyOf(m);
    const MeMatrix4Ptr tm = body ? MdtBodyGetCenterOfMassTransformPtr(body) : McdModelGetPlace(m);
    return tm ? tm[3] : 0;
}

/* A body that has completed its step stands still for those that lag. */
static McdMotion motionOf(const MstBridgeRecord *b, McdModelID m) {
    McdMotion motion = {.spinRate = 0};
    const MdtBodyID body = mst_bodyOf(m), freeBody = mst_freeBodyOf(m);
    copyVector(motion.centre, centreOf(m));
    if (b->substep > 0 && hasAdvanced(body))
        return motion;
    copyVector(motion.velocity, McdModelGetLinearVelocityPtr(m));
    copyVector(motion.spin, McdModelGetAngularVelocityPtr(m));
    motion.spinRate = freeBody ? MdtBodyGetFreeSpinRate(freeBody) : 0;
    if (freeBody)
        MdtBodyGetFreeAcceleration(freeBody, motion.acceleration);
    return motion;
}

/* Contacts of a large partition are left to its step, as each sub-step would solve it anew. */
static MeBool areContactsTimed(const McdModelPair *p) {
    return !mst_isInLargeIsland(mst_bodyOf(p->model1)) && !mst_isInLargeIsland(mst_bodyOf(p->model2));
}

static MeReal impactTime(const MstBridgeRecord *b, McdModelPair *p, McdNearParts near) {
    const McdMotion motion[2] = {motionOf(b, p->model1), motionOf(b, p->model2)};
    return McdModelPairImpactTime(p, motion, remainingTime(b, p), near);
}

MeReal mst_timeToImpact(const MstBridgeRecord *b, McdModelPair *p, MeBool hasContacts) {
    return impactTime(b, p, hasContacts && areContactsTimed(p) ? kMcdNearYield : kMcdNearPass);
}

MeReal mst_timeToWait(const MstBridgeRecord *b, McdModelPair *p) {
    return impactTime(b, p, kMcdNearBlock);
}

/* s: the shortest sub-step. In it, a body moves hardly farther than its speculative margin: 1 % of its size at a speed
 * of 100 times its size per step. */
static MeReal minSubstep(const MstBridgeRecord *b) {
    return b->ahead / MIN_SUBSTEP;
}

/* Bodies are not stopped if the remaining time would be less than the shortest sub-step. */
static MeBool isWorthClamping(const MstBridgeRecord *b, MeReal time, MeReal max) {
    return max - time > minSubstep(b);
}

static MeBool mayClamp(const MstBridgeRecord *b, McdModelID m) {
    return !mst_isInLargeIsland(mst_freeBodyOf(m)) ||
           (b->substep < MAX_LARGE_ISLAND_SUBSTEPS && McdModelGetFastMargin(m) > 0);
}

static void clampPair(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w, MeReal time) {
    const MdtBodyID body1 = mst_freeBodyOf(p->model1), body2 = mst_freeBodyOf(p->model2);
    const MeBool clamps1 = mayClamp(b, p->model1), clamps2 = mayClamp(b, p->model2);
    if (body1 && body2 && clamps1 && clamps2)
        mst_joinPartitions(b, p, w);
    if (clamps1)
        clampBody(b, body1, time);
    if (clamps2)
        clampBody(b, body2, time);
}

/* m/s: the largest speed at which the bodies of the pair close at a contact. */
static MeReal closingSpeed(const McdModelPair *p) {
    const MdtContactGroupID group = p->responseData;
    MeReal max = 0;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 normal, velocity;
        MdtContactGetNormal(c, normal);
        MdtContactGetRelativeVelocity(c, velocity);
        max = MeMAX(max, -MeVector3Dot(normal, velocity));
    }
    return max;
}

/* s: how long the motions of bodies in contact are known. The contacts change them by about the closing speed at once,
 * also where the shapes pass each other and do not get deep. */
static MeReal knownTime(const McdModelPair *p, MeReal max) {
    const MeReal margin = McdModelPairGetFastMargin(p), closing = closingSpeed(p);
    return closing * max > margin ? margin / closing : max;
}

void mst_clampFastPair(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, MdtWorldID w) {
    McdModelPair *p = f->pair;
    if (!f->isFast || p->isWithinLargeIsland)
        return;
    const MeReal max = remainingTime(b, p);
    MeReal time = f->timeToImpact != MST_UNKNOWN ? f->timeToImpact : mst_timeToImpact(b, p, hasContacts);
    MEASSERT(time >= 0 && time <= max);
    if (hasContacts && areContactsTimed(p))
        time = knownTime(p, time);
    if (isWorthClamping(b, time, max))
        clampPair(b, p, w, MeMAX(time, minSubstep(b)));
}

MeBool mst_isInLargeIsland(MdtBodyID body) {
    enum { LARGE_ISLAND = 32 };
    return body && MdtBodyGetPartitionSize(body) > LARGE_ISLAND;
}

MeBool mst_isWithinLargeIsland(const McdModelPair *p) {
    const MdtBodyID body1 = mst_freeBodyOf(p->model1), body2 = mst_freeBodyOf(p->model2);
    return mst_isInLargeIsland(body1) && body2 && MdtBodyGetPartition(body1) == MdtBodyGetPartition(body2);
}

/* ---- followers --------------------------------------------------------------------------------------------------- */

/* Whether the bodies of the pair may stop each other in this sub-step. */
static MeBool isOfTwoBodies(const MstBridgeRecord *b, McdModelPair *p) {
    enum { OTHER = McdPairIsAsleep | McdPairIsGone | McdPairHasSensor };
    MeU32 materials[2];
    return mst_freeBodyOf(p->model1) && mst_freeBodyOf(p->model2) && !mst_isOneBody(p) && !p->isHeldApart &&
           (b->substep == 0 || mst_mayCollide(p)) && !(McdModelPairGetTraits(p, materials) & OTHER);
}

/* Whether the pair's body that moves on reaches the one that stops early, or goes with it, by contacts. */
static MeBool reachesStopped(MstBridgeRecord *b, McdModelPair *p, int stopped, MeReal early, MeReal late) {
    MeU32 materials[2];
    if (p->responseData && MdtContactGroupGetCount(p->responseData) > 0)
        return METRUE;
    if (!(McdModelPairGetTraits(p, materials) & McdPairIsFast) || p->isWithinLargeIsland)
        return MEFALSE;
    McdMotion motion[2] = {motionOf(b, p->model1), motionOf(b, p->model2)};
    MeVector3MultiplyScalar(motion[stopped].velocity, motion[stopped].velocity, early / late);
    MeVector3MultiplyScalar(motion[stopped].spin, motion[stopped].spin, early / late);
    return late - McdModelPairImpactTime(p, motion, late, kMcdNearPass) > minSubstep(b);
}

/* Stops the pair's body that moves on at the time at which the other one stops, if it would reach that. */
static MeBool stopFollower(MstBridgeRecord *b, McdModelPair *p) {
    if (!isOfTwoBodies(b, p))
        return MEFALSE;
    const MeReal max = remainingTime(b, p);
    const MdtBodyID body[2] = {mst_freeBodyOf(p->model1), mst_freeBodyOf(p->model2)};
    const MeReal safe[2] = {MeMIN(MdtBodyGetSafeTime(body[0]), max), MeMIN(MdtBodyGetSafeTime(body[1]), max)};
    const int stopped = safe[1] < safe[0];
    if (!isWorthClamping(b, safe[stopped], safe[!stopped]) || !mayClamp(b, stopped ? p->model1 : p->model2) ||
        !reachesStopped(b, p, stopped, safe[stopped], safe[!stopped]))
        return MEFALSE;
    clampBody(b, body[!stopped], safe[stopped]);
    return METRUE;
}

/* Each body takes the earliest safe time of those that it follows: once through, for each body of a row. */
void mst_clampFollowers(MstBridgeRecord *b, McdModelPair *const pairs[], int count) {
    for (MeBool isAny = b->clampedCount > 0; isAny;) {
        isAny = MEFALSE;
        for (int i = 0; i < count; i++)
            isAny = stopFollower(b, pairs[i]) || isAny;
    }
}

/* ---- the sub-steps after the first ---------------------------------------------------------------------------------
 */

static MeBool isLagging(McdModelID m) {
    return lagOf(mst_bodyOf(m)) > 0;
}

/* Whether a body of the pair lags, so that it still moves in this step, and neither model is a sensor. */
static MeBool isLaggingPair(const McdModelPair *p) {
    return (isLagging(p->model1) || isLagging(p->model2)) && !McdModelIsSensor(p->model1) &&
           !McdModelIsSensor(p->model2);
}

static MeBool hasAdvancedBody(const McdModelPair *p) {
    return hasAdvanced(mst_bodyOf(p->model1)) || hasAdvanced(mst_bodyOf(p->model2));
}

static McdModelID laggingModel(const McdModelPair *p) {
    return isLagging(p->model1) ? p->model1 : p->model2;
}

MeBool mst_mayCollide(const McdModelPair *p) {
    return isLaggingPair(p) && !hasAdvancedBody(p);
}

MeBool mst_mustClampLagging(const McdModelPair *p) {
    return isLaggingPair(p) && hasAdvancedBody(p);
}

void mst_clampLaggingBody(MstBridgeRecord *b, const MstFinding *f) {
    MEASSERT(f->timeToImpact != MST_UNKNOWN);
    if (isWorthClamping(b, f->timeToImpact, remainingTime(b, f->pair)))
        clampBody(b, mst_bodyOf(laggingModel(f->pair)), f->timeToImpact);
}

/* Bodies with joints do not move without turning. */
static void clampJointed(MstBridgeRecord *b, MdtWorldID w) {
    for (MdtBodyID body = MdtWorldNextLagging(w, 0); body; body = MdtWorldNextLagging(w, body))
        if (MdtBodyHasJoints(body))
            clampBody(b, body, 0);
}

/* Makes one more sub-step. Returns 0 if no body can advance. */
static int advanceLag(MstUniverse *u, MstBridgeRecord *b, MeReal step) {
    MEASSERT(b->substep > 0 && b->substep <= MAX_SUBSTEPS);
    mst_eventsAddImpulses(b);
    MdtWorldPlaceMovers(u->world, 0); /* their boxes enclose all of their way */
    McdSpacePathUpdateAll(u->space, step);
    mst_updateContacts(b, u->space, u->world);
    if (b->isStraight)
        clampJointed(b, u->world);
    return MdtWorldAdvanceLag(u->world);
}

/* ---- bodies that lag after the last sub-step --------------------------------------------------------------------- */

/* Takes velocities from the bodies that lag: their spins, of those without joints; or all. */
static void pauseLagging(MstBridgeRecord *b, MdtWorldID w, MeBool translate) {
    MEASSERT(b->pausedCount == 0);
    for (MdtBodyID body = MdtWorldNextLagging(w, 0); body; body = MdtWorldNextLagging(w, body)) {
        if (translate && MdtBodyHasJoints(body))
            continue;
        if (!mst_reserveOne(&b->paused, b->pausedCount, &b->pausedMax, sizeof *b->paused, "bodies that lag"))
            return;
        b->paused[b->pausedCount].body = body;
        MdtBodyPause(body, translate, b->paused[b->pausedCount++].velocity);
    }
}

static void resumePaused(MstBridgeRecord *b, MeBool translate) {
    for (int i = 0; i < b->pausedCount; i++)
        if (MdtBodyIsValid(b->paused[i].body)) /* a callback may have destroyed it */
            MdtBodyResume(b->paused[i].body, translate, (const double(*)[3])b->paused[i].velocity);
    b->pausedCount = 0;
}

/* Bodies that lag go on without turning: their poses are known then, so that few sub-steps suffice. */
static void advanceStraight(MstUniverse *u, MstBridgeRecord *b, MeReal step) {
    pauseLagging(b, u->world, METRUE);
    b->isStraight = METRUE;
    for (int i = 0; i < MAX_SUBSTEPS && MdtWorldGetLaggingBodies(u->world) > 0; i++)
        if (!advanceLag(u, b, step))
            break;
    b->isStraight = MEFALSE;
    resumePaused(b, METRUE);
}

/* Movers complete their step, and push the bodies that do not. */
static void pushLagging(MstUniverse *u, MstBridgeRecord *b, MeReal step) {
    mst_eventsAddImpulses(b);
    pauseLagging(b, u->world, MEFALSE);
    b->isPushing = METRUE;
    MdtWorldPlaceMovers(u->world, 0);
    McdSpacePathUpdateAll(u->space, step);
    mst_updateContacts(b, u->space, u->world);
    MdtWorldPushLagging(u->world);
    b->isPushing = MEFALSE;
    resumePaused(b, MEFALSE);
}

void mst_stepWorld(MstUniverse *u, MeReal step) {
    MstBridgeRecord *b = (MstBridgeRecord *)u->bridge;
    MEASSERT(b->substep == 0);
    if (b->clampedCount == 0) {
        MdtWorldAdvance(u->world, step, MEFALSE);
        return;
    }
    MdtWorldAdvance(u->world, step, METRUE);
    for (b->substep = 1; b->substep < MAX_SUBSTEPS && MdtWorldGetLaggingBodies(u->world) > 0; b->substep++)
        if (!advanceLag(u, b, step))
            break;
    if (MdtWorldGetLaggingBodies(u->world) > 0)
        advanceStraight(u, b, step);
    if (MdtWorldGetLaggingBodies(u->world) > 0 && MdtWorldHasMovingMovers(u->world))
        pushLagging(u, b, step);
    b->substep = 0;
    MdtWorldPlaceMovers(u->world, step);
    mst_clearSafeTimes(b);
    MEASSERT(b->clampedCount == 0);
}
