/* Sleep: which partitions are at rest, and what wakes their bodies.
 *
 * A partition sleeps if none of its bodies would move perceptibly in the next second (five alive times). A body
 * qualifies
 *
 *     at once           if its velocity and acceleration are almost 0
 *     after a second    if it has hardly moved in the last one, or has come back twice to where it was, so that it
 *                       trembles, or swings by little; what drifts, creeps or begins to move goes away
 *
 * unless a motor, a path, or a surface that moves drives it, or its load is another than in the step before. The
 * thresholds of the guides have to hold, too. Where the program has set them, what is slower is at rest.
 *
 * Asleep, a body's inputs are those with which it fell asleep. What changes one ends its certificate (mdt_bodyDisturb),
 * and it wakes as the next step begins: docs/simulation.md, "Sleep", has the table. A joint is compared with its hash
 * if a call has had to do with it since, or its limit was handed out.
 */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "island/mdt_choice_i.h"
#include <math.h>
#include <string.h>

/* ---- one body ---- */

/* N s, N m s over h seconds: how its load differs from that with which it rested. */
static void changeOfLoad(const MdtBody *b, double h, double change[2][3]) {
    for (int i = 0; i < 3; i++) {
        change[0][i] = h * (b->force[i] - b->applied.force[i]) + b->impulse[i];
        change[1][i] = h * (b->torque[i] - b->applied.torque[i]) + b->angularImpulse[i];
    }
}

static MeBool isBelowThresholds(MdtBodyID b, double h) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    double change[2][3];
    const MeBool isYoung = sleepParams->alive_window < 0 ? b->aliveTime < (double)sleepParams->alive_time
                                                         : b->aliveSteps < sleepParams->alive_window;
    if (isYoung || b->enabledSteps == 0 || MdtBodyIsMovingTest(b, sleepParams))
        return MEFALSE;
    changeOfLoad(b, h, change);
    return (mdt_isQuiet(b) || mdt_staysInPlace(b)) && !mdt_wouldMove(b, change[0], change[1], h);
}

/* ---- what keeps a partition awake ---- */

/* Whether a joint drives its bodies, or they are in contact with a surface that moves, though what it belongs to need
 * not (MdtContactParamsSetPrimarySlide, MdtConstraintSetWorldLinearVelocity): they move with it, however slowly, or are
 * held against its friction. */
static MeBool isDriving(MdtConstraintID c) {
    const MdtJoint *j = mdt_asJoint(c);
    if (j)
        return j->isDriven;
    for (const MdtPoint *at = mdt_pointFirst(mdt_asManifold(c)); at; at = mdt_pointAfter(at)) {
        const MdtBclContactParams *surface = mdt_pointParams(at);
        const MdtKeaVelocity *world = mdt_pointWorldVelocity(at);
        const MeBool slides = ((surface->options & MdtBclContactOptionSlide1) && surface->slide1 != 0) ||
                              ((surface->options & MdtBclContactOptionSlide2) && surface->slide2 != 0);
        const MeBool moves = keaDot(world->lin, world->lin) + keaDot(world->ang, world->ang) > 0;
        if (at->force[0] > 0 && (slides || moves))
            return METRUE;
    }
    return MEFALSE;
}

MeBool mdt_islandIsToSleep(const MdtIsland *p) {
    if (!p->world->sleepParams.autoDisable)
        return MEFALSE;
    for (int i = 0; i < p->numBodies; i++)
        if (!isBelowThresholds(p->bodies[i], p->h))
            return MEFALSE;
    for (int i = 0; i < p->numActing; i++)
        if (isDriving(p->acting[i]))
            return MEFALSE;
    return METRUE;
}

/* ---- falling asleep, and waking ---- */

/* What is given in the next step continues what was given in this one, if that was the load under which it rests. */
static void noteForced(MdtBodyID b) {
    const MeBool isSame = memcmp(b->force, b->applied.force, sizeof b->force) == 0 &&
                          memcmp(b->torque, b->applied.torque, sizeof b->torque) == 0;
    b->applied.time = (b->record.flags & MDT_FORCED) && isSame ? b->world->lastStep : 0;
}

/* The forces that were given for this step are the ones under which it rests; they are over with it. */
static void keepLoad(MdtBodyID b) {
    mdt_forceForget(b);
    keaCopy(b->applied.force, b->force);
    keaCopy(b->applied.torque, b->torque);
    noteForced(b);
    memset(b->applied.momentum, 0, sizeof b->applied.momentum);
    MdtBodyResetForces(b);
    MdtBodyResetImpulses(b);
}

void mdt_bodySleep(MdtBodyID b) {
    static const double none[3] = {0, 0, 0};
    keaZero(b->kea.velocity);
    MdtKeaBodySetAngularVelocity(&b->kea, none);
    keaZero(b->kea.lastStep.lin);
    keaZero(b->kea.lastStep.ang);
    keaZero(b->push);
    mdt_bodyShow(b);
    keepLoad(b);
    mdt_bodyDisable(b); /* its models are frozen as they are now */
    b->record.flags |= MDT_ASLEEP;
    b->world->asleepBodies++;
    b->certificate = MDT_SLEEPS;
}

void mdt_islandSleep(const MdtIsland *p) {
    mdt_constraintsCertify(p);
    for (int i = 0; i < p->numBodies; i++)
        mdt_bodySleep(p->bodies[i]);
    MEASSERT(p->world->asleepBodies >= p->numBodies);
}

MeBool MEAPI MdtBodyWakeIfAsleep(const MdtBodyID b) {
    MEASSERT(b);
    const MeBool isAsleep = (b->record.flags & MDT_ASLEEP) != 0;
    mdt_bodyWakeIfAsleep(b);
    return isAsleep;
}

/* Pushes in a row add up, so that a slight one that goes on wakes it in the end; after a step without one they are
 * forgotten. */
static MeBool isToWake(MdtBodyID b, double h) {
    double change[2][3], (*pushed)[3] = b->applied.momentum;
    mdt_bodyAcceptVelocities(b);
    if (b->certificate == 0)
        return METRUE;
    changeOfLoad(b, h, change);
    const MeBool isPushed = keaDot(change[0], change[0]) + keaDot(change[1], change[1]) > 0;
    for (int k = 0; k < 2; k++) {
        if (!isPushed || b->world->hasThresholds)
            keaZero(pushed[k]);
        keaAddScaled(pushed[k], 1, change[k]);
    }
    return (isPushed && mdt_wouldMove(b, pushed[0], pushed[1], h)) || !mdt_areConstraintsCertified(b);
}

static void wake(MdtBodyID b) {
    const double time = b->applied.time;
    mdt_bodyEnable(b);
    b->applied.time = time;
    memset(b->applied.momentum, 0, sizeof b->applied.momentum);
}

void mdt_sleepersEndForces(MdtWorldID w) {
    for (MdtLink *link = w->asleepBodies > 0 ? w->bodies.first : NULL; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if (!(b->record.flags & MDT_ASLEEP))
            continue;
        noteForced(b);
        MdtBodyResetForces(b);
        MdtBodyResetImpulses(b);
    }
}

/* Handlers of the program are called. */
void mdt_sleepersWake(MdtWorldID w, double h) {
    if (w->asleepBodies == 0)
        return;
    MeStageBegin(&w->stage, MDT_GUARD_CONSTRAINTS);
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if ((b->record.flags & (MDT_ASLEEP | MDT_CONDEMNED)) == MDT_ASLEEP && isToWake(b, h))
            wake(b);
    }
    MeStageEnd(&w->stage, MDT_GUARD_CONSTRAINTS);
}

void mdt_sleepersWakeAll(MdtWorldID w) {
    for (MdtLink *link = w->asleepBodies > 0 ? w->bodies.first : NULL; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if (b->record.flags & MDT_ASLEEP)
            mdt_bodyDisturb(b);
    }
}
