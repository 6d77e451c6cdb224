/* Whether a body stays where it is: what trembles, or swings by little, does (mdt_sleep.c). */
#include "record/mdt_record_i.h"
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
    const double alive = (double)b->world->sleepParams.alive_time;
    return AHEAD * (alive > 0 ? alive : MDTWORLD_DEFAULT_ALIVE_TIME_THRESH);
}

/* m: of gyration, or a fifth of the length scale, for what is smaller. */
static double radiusOf(const MdtBody *b) {
    const double *I = b->kea.moments, min = 0.2 * (double)b->world->params.lengthScale;
    return fmax(sqrt(fmax(I[0], fmax(I[1], I[2])) * b->kea.invMass), min);
}

/* m: it is still if its displacement is no longer than this. */
static double stillDistance(double radius) {
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
    memset(b->stay.displacement, 0, sizeof b->stay.displacement);
    b->stay.maxDisplacement = HUGE_VAL;
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
static void findDisplacement(const MdtBody *b, double radius, double displacement[6]) {
    double back[4], turned[4];
    keaSubtract(displacement, b->kea.position, b->start.position);
    keaQuaternionConjugate(back, b->start.quaternion);
    keaQuaternionProduct(turned, b->kea.quaternion, back);
    keaScale(displacement + 3, 2 * radius, turned + 1);
}

static double lengthOfDisplacement(const double displacement[6]) {
    return keaLength(displacement) + keaLength(displacement + 3);
}

static void clamp(double displacement[6], double maxDisplacement) {
    const double length = lengthOfDisplacement(displacement);
    for (int i = 0; i < 6 && length > maxDisplacement; i++)
        displacement[i] *= maxDisplacement / length;
}

/* In the last second, each part of it forgotten exponentially: of what trembles nothing is left. What swings comes
 * through its place: the most that there was is forgotten in a second, too, at e times what is still. */
static void addDisplacement(MdtStay *s, const double displacement[6], double still, double share) {
    clamp(s->displacement, exp(1) * still);
    for (int i = 0; i < 6; i++)
        s->displacement[i] = exp(-share) * s->displacement[i] + displacement[i];
    s->maxDisplacement =
        fmax(exp(-share) * fmin(s->maxDisplacement, exp(1) * still), lengthOfDisplacement(s->displacement));
}

/* What comes back twice swings or trembles, unless it goes a tenth farther in between. Once is not enough: so does what
 * turns slowly near an end of its path. */
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
    double displacement[6];
    findDisplacement(b, radius, displacement);
    addDisplacement(s, displacement, stillDistance(radius), h / second);
    if (distance > swingingReach * radius)
        settle(b, 0);
    else if (s->time > swingingReach / stayingReach * second)
        settle(b, swingsLittle(s, radius, second) ? 2 * s->farthest : 0);
    else
        countReturns(s, distance, h);
}

MeBool mdt_staysInPlace(const MdtBody *b) {
    const double radius = radiusOf(b);
    return b->stay.maxDisplacement <= stillDistance(radius) || b->stay.reach > 0 ||
           swingsLittle(&b->stay, radius, timeAhead(b));
}

/* m, in the next second, if it goes on as in the last step. */
static double distanceAhead(const MdtBody *b, double radius) {
    const MdtKeaVelocity *a = &b->kea.lastStep;
    const double t = timeAhead(b);
    return t * speedOf(b, radius) + 0.5 * t * t * (keaLength(a->lin) + radius * keaLength(a->ang));
}

MeBool mdt_isQuiet(const MdtBody *b) {
    const double radius = radiusOf(b);
    return b->world->hasThresholds || distanceAhead(b, radius) <= quietReach * radius;
}

/* By a change of momentum in h seconds. */
MeBool mdt_wouldMove(const MdtBody *b, const double push[3], const double angularImpulse[3], double h) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    const double *I = b->kea.moments, radius = radiusOf(b);
    const double speed = keaLength(push) * b->kea.invMass,
                 spin = keaLength(angularImpulse) / fmin(I[0], fmin(I[1], I[2]));
    if (b->world->hasThresholds)
        return speed * speed > h * h * (double)sleepParams->acc_thresh ||
               spin * spin > h * h * (double)sleepParams->accrot_thresh;
    return (speed + radius * spin) * timeAhead(b) > wakingReach * radius;
}
