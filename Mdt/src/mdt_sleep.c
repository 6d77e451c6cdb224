/* Rest: whether a partition has come to rest, by the thresholds of its world, and putting it to sleep. */
#include "MeAssert.h"
#include "mdt_step_i.h"

/* A body that is still coming out of an overlap has no velocity, but it is under way. */
static MeBool isPushedOut(MdtBodyID b, const MdtPartitionParams *rest) {
    const double slow = 1e-4; /* of vel_thresh: squares of velocities */
    return keaDot(b->push, b->push) > slow * (double)rest->vel_thresh;
}

MeBool mdt_islandIsAtRest(const MdtIsland *p) {
    const MdtPartitionParams *rest = &p->world->rest;
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        const MeBool isYoung =
            rest->alive_window < 0 ? b->enabledTime < (double)rest->alive_time : b->enabledSteps < rest->alive_window;
        if (isYoung || b->enabledSteps == 0 || MdtBodyIsMovingTest(b, rest) || isPushedOut(b, rest))
            return MEFALSE;
    }
    return METRUE;
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
