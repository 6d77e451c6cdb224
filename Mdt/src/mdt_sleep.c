/* Rest: whether a partition has come to rest, by the thresholds of its world and by the surfaces that it
 * stands on, and putting it to sleep. */
#include "MeAssert.h"
#include "mdt_step_i.h"

/* A body whose overlap is being corrected moves though its velocity is 0: it must not be put to sleep. */
static MeBool isPushedOut(MdtBodyID b, const MdtPartitionParams *rest) {
    const double slow = 1e-4; /* of vel_thresh: squares of velocities */
    return keaDot(b->push, b->push) > slow * (double)rest->vel_thresh;
}

/* Does the surface of the contact's other side move, though what it belongs to need not
 * (MdtContactParamsSetPrimarySlide, MdtConstraintSetWorldLinearVelocity)? */
static MeBool isSurfaceMoving(const MdtPoint *point) {
    const MdtBclContactParams *surface = mdt_pointParams(point);
    const MdtKeaVelocity *world = mdt_pointWorldVelocity(point);
    return ((surface->options & MdtBclContactOptionSlide1) && surface->slide1 != 0) ||
           ((surface->options & MdtBclContactOptionSlide2) && surface->slide2 != 0) ||
           keaDot(world->lin, world->lin) + keaDot(world->ang, world->ang) > 0;
}

/* Bodies on a moving surface stay awake: they move with it, however slowly, or are held against its friction. */
static MeBool isCarried(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++) {
        if (mdt_isJoint(p->acting[i]))
            continue;
        for (const MdtPoint *at = mdt_pointFirst(mdt_asManifold(p->acting[i])); at; at = mdt_pointAfter(at))
            if (at->force[0] > 0 && isSurfaceMoving(at))
                return METRUE;
    }
    return MEFALSE;
}

MeBool mdt_islandIsAtRest(const MdtIsland *p) {
    const MdtPartitionParams *rest = &p->world->rest;
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        const MeBool isYoung =
            rest->alive_window < 0 ? b->aliveTime < (double)rest->alive_time : b->aliveSteps < rest->alive_window;
        if (isYoung || b->enabledSteps == 0 || MdtBodyIsMovingTest(b, rest) || mdt_bodyIsStarting(b) ||
            isPushedOut(b, rest))
            return MEFALSE;
    }
    return !isCarried(p);
}

MeBool mdt_islandIsToSleep(const MdtIsland *p) {
    const MdtWorld *w = p->world;
    if (w->partitionCb)
        return w->output.info[p->number].isDisabled;
    return w->rest.autoDisable && mdt_islandIsAtRest(p);
}

void mdt_islandSleep(const MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++)
        mdt_bodySleep(p->bodies[i]);
    MEASSERT(p->world->asleepBodies >= p->numBodies);
}
