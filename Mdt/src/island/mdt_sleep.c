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
#include "mdt_step_i.h"
#include <math.h>
#include <string.h>

/* Alive times that the rule looks ahead, and back: 1 s by default, and without. */
enum { AHEAD = 5 };
/* How far a body moves in that time, of its radius of gyration, or of a fifth of the length scale if that is larger. A
 * box of 1 m that turns at 2.5e-3 rad/s, drifts at 1 mm/s, or swings by 1 cm to either side stays awake, and a push
 * that gives it 1 cm/s wakes it. */
static const double stayingReach = 2.5e-3; /* less is at rest: nobody sees a millimetre a second */
static const double swingingReach = 5e-2;  /* the same in 20 s: so far it may swing about its place */
static const double quietReach = 2.5e-4;   /* a tenth: less is at rest at once */
static const double wakingReach = 2.5e-2;  /* ten times: a push that moves a sleeper as far wakes it */

/* ---- one body ---- */

/* s: "a second". */
static double timeAhead(const MdtBody *b) {
    const double alive = (double)b->world->rest.alive_time;
    return AHEAD * (alive > 0 ? alive : MDTWORLD_DEFAULT_ALIVE_TIME_THRESH);
}

/* m: of gyration, or a fifth of the length scale, for what is smaller. */
static double radiusOf(const MdtBody *b) {
    const double *I = b->kea.moments, least = 0.2 * (double)b->world->params.lengthScale;
    return fmax(sqrt(fmax(I[0], fmax(I[1], I[2])) * b->kea.invMass), least);
}

/* m: it is still if its way is no longer than this. */
static double stillWay(double radius) {
    return stayingReach * radius;
}

/* It is near where it is now, and within `reach` of that. */
static void settle(MdtBodyID b, double reach) {
    MdtStay *s = &b->stay;
    keaCopy(s->position, b->kea.position);
    memcpy(s->quaternion, b->kea.quaternion, sizeof s->quaternion);
    s->time = s->farthest = s->known = 0;
    s->returns = 0;
    s->isBack = METRUE;
    s->reach = reach;
}

void mdt_stayForget(MdtBodyID b) {
    memset(b->stay.way, 0, sizeof b->stay.way);
    b->stay.most = HUGE_VAL;
    settle(b, 0);
}

/* m, that it is away from there. */
static double distanceOf(const MdtBody *b, double radius) {
    double moved[3], back[4], turned[4];
    keaSubtract(moved, b->kea.position, b->stay.position);
    keaQuaternionConjugate(back, b->stay.quaternion);
    keaQuaternionProduct(turned, b->kea.quaternion, back);
    return keaLength(moved) + 2 * keaLength(turned + 1) * radius;
}

/* m/s, of its points; overlaps that are corrected included. */
static double speedOf(const MdtBody *b, double radius) {
    double v[3];
    keaCopy(v, b->kea.velocity);
    keaAddScaled(v, 1, b->push);
    return keaLength(v) + radius * keaLength(b->spin);
}

/* Of the last step: of the centre of mass, and of what turns about it at the radius. */
static void findWay(const MdtBody *b, double radius, double way[6]) {
    double back[4], turned[4];
    keaSubtract(way, b->kea.position, b->start.position);
    keaQuaternionConjugate(back, b->start.quaternion);
    keaQuaternionProduct(turned, b->kea.quaternion, back);
    keaScale(way + 3, 2 * radius, turned + 1);
}

static double lengthOfWay(const double way[6]) {
    return keaLength(way) + keaLength(way + 3);
}

static void clamp(double way[6], double most) {
    const double length = lengthOfWay(way);
    for (int i = 0; i < 6 && length > most; i++)
        way[i] *= most / length;
}

/* In the last second, each part of it forgotten exponentially: of what trembles nothing is left. What swings comes
 * through its place: the most that there was is forgotten in a second, too, at e times what is still. */
static void countWay(MdtStay *s, const double way[6], double still, double part) {
    clamp(s->way, exp(1) * still);
    for (int i = 0; i < 6; i++)
        s->way[i] = exp(-part) * s->way[i] + way[i];
    s->most = fmax(exp(-part) * fmin(s->most, exp(1) * still), lengthOfWay(s->way));
}

/* What comes back twice swings or trembles, unless it goes a tenth farther in between. Once is not enough: so does what
 * turns slowly near an end of its way. */
static void countReturns(MdtStay *s, double distance, double h) {
    const MeBool isBack = distance < 0.5 * s->farthest;
    s->farthest = fmax(s->farthest, distance);
    if (isBack && !s->isBack) {
        s->returns++;
        s->known = s->farthest;
    }
    if (distance > 1.1 * s->known)
        s->returns = 0;
    if (distance > s->reach)
        s->reach = 0;
    s->isBack = isBack;
    s->time += h;
}

/* What swings is given the more time to come to rest the farther it swings. */
static MeBool swingsLittle(const MdtStay *s, double radius, double second) {
    return s->time >= second && s->returns > 1 && s->farthest <= stayingReach * radius * s->time / second;
}

void mdt_stayCount(MdtBodyID b, double h) {
    const double radius = radiusOf(b), distance = distanceOf(b, radius), second = timeAhead(b);
    MdtStay *s = &b->stay;
    double way[6];
    findWay(b, radius, way);
    countWay(s, way, stillWay(radius), h / second);
    if (distance > swingingReach * radius)
        settle(b, 0);
    else if (s->time > swingingReach / stayingReach * second)
        settle(b, swingsLittle(s, radius, second) ? 2 * s->farthest : 0);
    else
        countReturns(s, distance, h);
}

MeBool mdt_staysInPlace(const MdtBody *b) {
    const double radius = radiusOf(b);
    return b->stay.most <= stillWay(radius) || b->stay.reach > 0 || swingsLittle(&b->stay, radius, timeAhead(b));
}

/* m, in the next second, if it goes on as in the last step. */
static double wayAhead(const MdtBody *b, double radius) {
    const MdtKeaVelocity *a = &b->kea.lastStep;
    const double t = timeAhead(b);
    return t * speedOf(b, radius) + 0.5 * t * t * (keaLength(a->lin) + radius * keaLength(a->ang));
}

/* N s, N m s over h seconds: how its load differs from that with which it rested. */
static void changeOfLoad(const MdtBody *b, double h, double change[2][3]) {
    for (int i = 0; i < 3; i++) {
        change[0][i] = h * (b->force[i] - b->applied.force[i]) + b->impulse[i];
        change[1][i] = h * (b->torque[i] - b->applied.torque[i]) + b->twist[i];
    }
}

/* By a change of momentum in h seconds. */
static MeBool wouldMove(const MdtBody *b, const double push[3], const double twist[3], double h) {
    const MdtPartitionParams *rest = &b->world->rest;
    const double *I = b->kea.moments, radius = radiusOf(b);
    const double speed = keaLength(push) * b->kea.invMass, spin = keaLength(twist) / fmin(I[0], fmin(I[1], I[2]));
    if (b->world->hasThresholds)
        return speed * speed > h * h * (double)rest->acc_thresh || spin * spin > h * h * (double)rest->accrot_thresh;
    return (speed + radius * spin) * timeAhead(b) > wakingReach * radius;
}

static MeBool isAtRest(MdtBodyID b, double h) {
    const MdtPartitionParams *rest = &b->world->rest;
    const double radius = radiusOf(b);
    double change[2][3];
    const MeBool isYoung =
        rest->alive_window < 0 ? b->aliveTime < (double)rest->alive_time : b->aliveSteps < rest->alive_window;
    if (isYoung || b->enabledSteps == 0 || MdtBodyIsMovingTest(b, rest))
        return MEFALSE;
    const MeBool isQuiet = b->world->hasThresholds || wayAhead(b, radius) <= quietReach * radius;
    changeOfLoad(b, h, change);
    return (isQuiet || mdt_staysInPlace(b)) && !wouldMove(b, change[0], change[1], h);
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
    if (!p->world->rest.autoDisable)
        return MEFALSE;
    for (int i = 0; i < p->numBodies; i++)
        if (!isAtRest(p->bodies[i], p->h))
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
    mdt_restCertifyConstraints(p);
    for (int i = 0; i < p->numBodies; i++)
        mdt_bodySleep(p->bodies[i]);
    MEASSERT(p->world->asleepBodies >= p->numBodies);
}

void mdt_bodyWakeIfAsleep(MdtBodyID b) {
    if (b->record.flags & MDT_ASLEEP)
        MdtBodyEnable(b);
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
    return (isPushed && wouldMove(b, pushed[0], pushed[1], h)) || !mdt_restAreConstraintsAsCertified(b);
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
    MeStageBegin(&w->stage, MDT_HOLD_CONSTRAINTS);
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if ((b->record.flags & (MDT_ASLEEP | MDT_CONDEMNED)) == MDT_ASLEEP && isToWake(b, h))
            wake(b);
    }
    MeStageEnd(&w->stage, MDT_HOLD_CONSTRAINTS);
}

void mdt_sleepersWakeAll(MdtWorldID w) {
    for (MdtLink *link = w->asleepBodies > 0 ? w->bodies.first : NULL; link; link = link->next) {
        MdtBodyID b = mdt_linkOwner(link);
        if (b->record.flags & MDT_ASLEEP)
            mdt_bodyDisturb(b);
    }
}
