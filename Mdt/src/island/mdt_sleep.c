/* Sleep: finds partitions at rest, and wakes bodies.
 *
 * A partition falls asleep if none of its bodies would move perceptibly in the next second (five alive times). A body
 * qualifies
 *
 *     at once           if its velocity and acceleration are almost 0
 *     after a second    if it has hardly moved in the last one, or has twice returned to its place, so that it jitters
 *                       or oscillates little, instead of drifting, creeping or starting to move
 *
 * unless a motor, a path, or a moving surface drives it, or its load differs from that of the last step. Its speeds
 * must be below the guides' thresholds, too. If the program has set these, they alone decide.
 *
 * While a body sleeps, its inputs have to stay as they were. A change ends its certificate (mdt_bodyDisturb), and it
 * wakes when the next step begins: docs/simulation.md, "Sleep", has the table. Joints are compared by their hash if an
 * API call has had the joint as argument since, or if the program has a pointer to its limit.
 */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "island/mdt_choice_i.h"
#include <math.h>
#include <string.h>

/* ---- one body ---- */

/* N s, N m s: the change of the body's load against the one under which it came to rest, over h seconds. */
static void getLoadChange(const MdtBody *b, double h, double change[2][3]) {
    const MdtForces *f = mdt_forcesOf(b);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++)
            change[k][i] = h * (f->load[k][i] - f->lastLoad[k][i]) + f->impulse[k][i];
}

static MeBool maySleep(MdtBodyID b, double h) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    double change[2][3];
    const MeBool isYoung = sleepParams->alive_window < 0 ? b->aliveTime < (double)sleepParams->alive_time
                                                         : b->aliveSteps < sleepParams->alive_window;
    if (isYoung || b->enabledTime == 0 || MdtBodyIsMovingTest(b, sleepParams))
        return MEFALSE;
    getLoadChange(b, h, change);
    return (mdt_bodyIsQuiet(b) || mdt_bodyStaysInPlace(b)) && !mdt_bodyWouldMove(b, change, h);
}

/* ---- what keeps a partition awake ---- */

/* True if a joint drives its bodies, or a contact's surface moves (MdtContactParamsSetPrimarySlide,
 * MdtConstraintSetWorldLinearVelocity): bodies then move with it, however slowly, or are held against its friction. */
static MeBool drivesBodies(MdtConstraintID c) {
    const MdtJoint *j = mdt_asJoint(c);
    if (mdt_isCarried(c))
        return METRUE;
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
        if (!maySleep(p->bodies[i], p->h))
            return MEFALSE;
    for (int i = 0; i < p->numActing; i++)
        if (drivesBodies(p->acting[i]))
            return MEFALSE;
    return METRUE;
}

/* ---- falling asleep, and waking ---- */

/* Lets forces of the next step continue those of this step, if these are the load under which the body rests. */
static void continueForce(MdtBodyID b) {
    MdtForces *f = b->forces;
    const MeBool isSame = f && memcmp(f->load, f->lastLoad, sizeof f->load) == 0;
    if (f)
        f->time = (b->record.flags & MDT_FORCED) && isSame ? b->world->lastStep : 0;
}

static void endForces(MdtBodyID b) {
    continueForce(b);
    MdtBodyResetForces(b);
    MdtBodyResetImpulses(b);
}

/* Stores the forces of this step as the load under which the body rests, and clears the accumulators. */
static void storeSleepLoad(MdtBodyID b) {
    mdt_forceRestart(b);
    if (b->forces) {
        memcpy(b->forces->lastLoad, b->forces->load, sizeof b->forces->lastLoad);
        memset(b->forces->momentum, 0, sizeof b->forces->momentum);
    }
    endForces(b);
}

void mdt_bodySleep(MdtBodyID b) {
    static const double none[3] = {0, 0, 0};
    MEASSERT((b->record.flags & (MDT_ENABLED | MDT_ASLEEP)) == MDT_ENABLED);
    keaZero(b->kea.velocity);
    MdtKeaBodySetAngularVelocity(&b->kea, none);
    keaZero(b->kea.lastStep.lin);
    keaZero(b->kea.lastStep.ang);
    keaZero(b->push);
    mdt_bodyShow(b);
    storeSleepLoad(b);
    mdt_bodyDisable(b); /* freezes its collision models in the present pose */
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

/* Wakes a sleeping body if its inputs have changed. Impulses of successive steps add up, so that a small lasting push
 * wakes the body in the end; a step without a push clears the sum. */
static void wakeIfChanged(MdtBodyID b, double h) {
    MdtForces *f = b->forces;
    double change[2][3];
    MEASSERT(b->record.flags & MDT_ASLEEP);
    mdt_bodyAcceptVelocities(b);
    getLoadChange(b, h, change);
    const MeBool isPushed = keaDot(change[0], change[0]) + keaDot(change[1], change[1]) > 0;
    for (int k = 0; k < 2 && f; k++) {
        if (!isPushed || b->world->hasThresholds)
            keaZero(f->momentum[k]);
        keaAddScaled(f->momentum[k], 1, change[k]);
    }
    if (b->certificate != 0 && !(isPushed && mdt_bodyWouldMove(b, f->momentum, h)) && mdt_areConstraintsCertified(b))
        return;
    const double time = mdt_forcesOf(b)->time;
    mdt_bodyEnable(b); /* restarts the forces */
    if (f) {
        f->time = time;
        memset(f->momentum, 0, sizeof f->momentum);
    }
}

void mdt_sleepersEndForces(MdtWorldID w) {
    for (MdtLink *link = w->asleepBodies > 0 ? w->bodies.first : NULL; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if (b->record.flags & MDT_ASLEEP)
            endForces(b);
    }
}

static int countAsleep(const MdtWorld *w) {
    int count = 0;
    for (const MdtLink *link = w->bodies.first; link; link = link->next)
        count += (((const MdtBody *)mdt_linkOwner(link))->record.flags & MDT_ASLEEP) != 0;
    return count;
}

/* The stage defers calls that the program's handlers make. */
void mdt_sleepersWakeChanged(MdtWorldID w, double h) {
    MEVALIDATE(countAsleep(w) == w->asleepBodies);
    if (w->asleepBodies == 0)
        return;
    MeStageBegin(&w->stage, MDT_GUARD_CONSTRAINTS);
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if ((b->record.flags & (MDT_ASLEEP | MDT_CONDEMNED)) == MDT_ASLEEP)
            wakeIfChanged(b, h);
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
