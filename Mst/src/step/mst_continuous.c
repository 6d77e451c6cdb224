/* Continuous motion: fast models are stopped at their time of impact, and continue from there.
 *
 * A step is divided into sub-steps. In the first one all bodies move, but the partition of a fast model only up to its
 * time of impact; the other bodies have then completed their step. In each further sub-step the lagging bodies get new
 * contacts, and advance to the next impact or to the end of the step. Two bodies that will collide are joined into one
 * partition beforehand, so that both are at the same time at the impact. The impact itself is a short sub-step of its
 * own, as the motion after it is not known in advance.
 *
 * Lagging bodies must not push bodies that have already advanced, which would then move for longer than the step. A
 * lagging body that reaches such a body is stopped, and loses the rest of its step; so do bodies that still lag after
 * the last sub-step.
 *
 * A mover has made its whole step after the first sub-step. In the others it is put back, for each pair, to where it
 * was at the time of the body that lags.
 *
 * A large partition is not stopped by a fast body that hits it, as each sub-step would need a solve of the whole
 * partition. The fast body waits in front of it and collides in the next step, which is not divided either. Fast bodies
 * within a large partition get safe times in the first sub-steps only.
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
    if (!body || !mst_reserveOne(&b->clamped, b->clampedCount, &b->clampedMax, sizeof *b->clamped, "fast bodies"))
        return;
    MEASSERT(time >= 0 && time <= b->ahead);
    MdtBodySetSafeTime(body, MeMIN(time, MdtBodyGetSafeTime(body)));
    b->clamped[b->clampedCount++] = body;
}

/* ---- time of impact -------------------------------------------------------------------------------------------- */

static int MEAPI isSameModel(McdModelID m, void *other) {
    return m == (McdModelID)other;
}

static void addLinearDisplacement(MeVector3 displacement, McdModelID m, MeReal time) {
    const MeReal *velocity = McdModelGetLinearVelocityPtr(m);
    for (int i = 0; velocity && i < 3; i++)
        displacement[i] += time * velocity[i];
}

/* The time until a convex shape touches a surface of triangles, which McdSafeTime does not support: the shape is cast
 * along its displacement, without rotation, and stopped 1/STOP of its radius before the surface. */
static MeReal timeToSurface(McdModelID shape, McdModelID surface, McdSpaceID s, MeReal max) {
    enum { STOP = 1000 };
    McdCastResult hit;
    MeVector3 displacement = {0, 0, 0}, centre;
    MeReal radius;
    addLinearDisplacement(displacement, shape, max);
    addLinearDisplacement(displacement, surface, -max);
    const MeReal length = MeVector3Magnitude(displacement);
    if (!(length > 0) ||
        !McdSpaceCastGeometry(s, McdModelGetGeometry(shape), (const MeVector4 *)McdModelGetPlace(shape), displacement,
                              isSameModel, surface, &hit))
        return max;
    McdModelGetBSphere(shape, centre, &radius);
    MEASSERT(hit.fraction >= 0 && hit.fraction <= 1);
    return MeMAX(hit.fraction - radius / (STOP * length), 0) * max;
}

static MeReal lagOf(MdtBodyID body) {
    return body ? MdtBodyGetLag(body) : 0;
}

static MeReal fastMarginOf(const McdModelPair *p) {
    return MeMAX(McdModelGetFastMargin(p->model1), McdModelGetFastMargin(p->model2));
}

/* s, the time that the pair's bodies move in this sub-step. */
static MeReal remainingTime(const MstBridgeRecord *b, const McdModelPair *p) {
    return b->substep == 0 ? b->ahead : mst_pairLag(p);
}

MeReal mst_timeToTouch(const MstBridgeRecord *b, McdModelPair *p, McdSpaceID s) {
    const MeReal max = remainingTime(b, p);
    McdSafeTimeResult safe;
    if (McdModelIsSurface(p->model2) && McdModelIsConvex(p->model1))
        return timeToSurface(p->model1, p->model2, s, max);
    if (McdModelIsSurface(p->model1) && McdModelIsConvex(p->model2))
        return timeToSurface(p->model2, p->model1, s, max);
    return McdSafeTime(p, max, &safe) ? safe.time : max;
}

static MeReal maxApproachSpeed(const McdModelPair *p) {
    const MdtContactGroupID group = p->responseData;
    MdtContactID c = group ? MdtContactGroupGetFirstContact(group) : 0;
    MeReal max = 0;
    for (; c; c = MdtContactGroupGetNextContact(group, c)) {
        MeVector3 position, normal;
        MdtContactGetPosition(c, position);
        mst_normalOf(p, c, normal);
        max = MeMAX(max, mst_approachSpeedAt(p, position, normal));
    }
    return max;
}

/* s: a pair that closes fast enough gets a sub-step of its own for the impact, twice as long as the time to close the
 * gap; the motion after the impact is computed in the next one. Sliding and resting pairs: max. */
static MeReal timeOfImpact(const McdModelPair *p, MeReal max) {
    const MeReal approach = maxApproachSpeed(p), margin = fastMarginOf(p);
    return approach * max > 4 * margin ? 2 * margin / approach : max;
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

static void clampPair(MstBridgeRecord *b, McdModelPair *p, MdtWorldID w, MeReal time) {
    const MdtBodyID body1 = mst_freeBodyOf(p->model1), body2 = mst_freeBodyOf(p->model2);
    const MeBool clamps1 =
        !mst_isInLargeIsland(body1) || (b->substep < MAX_LARGE_ISLAND_SUBSTEPS && McdModelGetFastMargin(p->model1) > 0);
    const MeBool clamps2 =
        !mst_isInLargeIsland(body2) || (b->substep < MAX_LARGE_ISLAND_SUBSTEPS && McdModelGetFastMargin(p->model2) > 0);
    if (body1 && body2 && clamps1 && clamps2)
        mst_joinPartitions(b, p, w);
    if (clamps1)
        clampBody(b, body1, time);
    if (clamps2)
        clampBody(b, body2, time);
}

void mst_clampFastPair(MstBridgeRecord *b, const MstFinding *f, MeBool hasContacts, McdSpaceID s, MdtWorldID w) {
    McdModelPair *p = f->pair;
    if (!f->isFast)
        return;
    if (hasContacts && (mst_isInLargeIsland(mst_bodyOf(p->model1)) || mst_isInLargeIsland(mst_bodyOf(p->model2))))
        return;
    const MeReal max = remainingTime(b, p);
    const MeReal time = hasContacts                     ? timeOfImpact(p, max)
                        : f->timeToTouch != MST_UNKNOWN ? f->timeToTouch
                                                        : mst_timeToTouch(b, p, s);
    MEASSERT(time >= 0 && time <= max);
    if (isWorthClamping(b, time, max))
        clampPair(b, p, w, MeMAX(time, minSubstep(b)));
}

MeBool mst_isInLargeIsland(MdtBodyID body) {
    enum { LARGE_ISLAND = 32 };
    return body && MdtBodyGetPartitionSize(body) > LARGE_ISLAND;
}

/* ---- the sub-steps after the first ---------------------------------------------------------------------------------
 */

/* Whether the body has completed its step, so that it must not be pushed. */
static MeBool hasAdvanced(MdtBodyID body) {
    return body && !MdtBodyIsMover(body) && MdtBodyIsEnabled(body) && !(MdtBodyGetLag(body) > 0);
}

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
    return isLaggingPair(p) && hasAdvancedBody(p) && McdModelGetFastMargin(laggingModel(p)) > 0;
}

void mst_clampLaggingBody(MstBridgeRecord *b, const MstFinding *f) {
    MEASSERT(f->timeToTouch != MST_UNKNOWN);
    clampBody(b, mst_bodyOf(laggingModel(f->pair)), f->timeToTouch);
}

/* Makes one more sub-step. Returns 0 if no body can advance. */
static int advanceLag(MstUniverse *u, MstBridgeRecord *b, MeReal step) {
    MEASSERT(b->substep > 0 && b->substep < MAX_SUBSTEPS);
    mst_eventsAddImpulses(b);
    MdtWorldPlaceMovers(u->world, 0); /* their boxes enclose all of their way */
    McdSpacePathUpdateAll(u->space, step);
    mst_updateContacts(b, u->space, u->world);
    return MdtWorldAdvanceLag(u->world);
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
    b->substep = 0;
    MdtWorldPlaceMovers(u->world, step);
    mst_clearSafeTimes(b);
    MEASSERT(b->clampedCount == 0);
}
