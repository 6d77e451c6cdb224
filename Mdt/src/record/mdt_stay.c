/* Whether a body stays near its place, although it jitters or oscillates a little (mdt_sleep.c). */
#include "record/mdt_record_i.h"
#include <math.h>
#include <string.h>

/* Largest displacement of a body at rest in the time that the rule looks ahead and back, relative to the larger of its
 * radius of gyration and a fifth of the length scale: 1 mm/s of a body of 1 m is not visible. A box of 1 m that rotates
 * at 2.5e-3 rad/s, drifts at 1 mm/s, or oscillates by +-1 cm stays awake, and a push that gives it 1 cm/s wakes it. */
static const double stayingReach = 2.5e-3;

/* ---- one body ---- */

/* s: the time that is called "a second" here, five alive times: 1 s by default, and if the alive time is 0. */
static double lookAheadTime(const MdtBody *b) {
    const double alive = (double)b->world->sleepParams.alive_time;
    return 5 * (alive > 0 ? alive : MDTWORLD_DEFAULT_ALIVE_TIME_THRESH);
}

/* m: the radius of gyration, at least a fifth of the length scale. */
static double radiusOf(const MdtBody *b) {
    return fmax(mdt_bodyRadius(b), 0.2 * (double)b->world->params.lengthScale);
}

/* m: largest displacement of a body that is still. */
static double stillDistance(double radius) {
    return stayingReach * radius;
}

/* Restarts the observation at the present pose. reach: MdtStay.reach. */
static void restartAt(MdtBodyID b, double reach) {
    MdtStay *s = &b->stay;
    s->pose = mdt_bodyPose(b);
    s->time = s->maxDistance = s->maxAtReturn = 0;
    s->crossings = 0;
    s->reach = reach;
}

void mdt_stayRestart(MdtBodyID b) {
    memset(b->stay.displacement, 0, sizeof b->stay.displacement);
    b->stay.maxDisplacement = HUGE_VAL;
    restartAt(b, 0);
}

/* m: distance from the reference pose, with the rotation at the radius. */
static double distanceFromPlace(const MdtBody *b, double radius) {
    double moved[3], turned[4];
    mdt_bodyMotionSince(b, &b->stay.pose, moved, turned);
    return keaLength(moved) + 2 * keaLength(turned + 1) * radius;
}

/* m/s: bound of the speed of the body's points, with the position correction of overlaps. */
static double pointSpeed(const MdtBody *b, double radius) {
    double v[3];
    keaCopy(v, b->kea.velocity);
    keaAddScaled(v, 1, b->push);
    return keaLength(v) + radius * keaLength(b->spin);
}

/* The displacement of the last step: of the centre of mass, and of the rotation times the radius. */
static void getStepDisplacement(const MdtBody *b, double radius, double displacement[6]) {
    double turned[4];
    mdt_bodyMotionSince(b, &b->start.pose, displacement, turned);
    keaScale(displacement + 3, 2 * radius, turned + 1);
}

static double lengthOfDisplacement(const double displacement[6]) {
    return keaLength(displacement) + keaLength(displacement + 3);
}

static void clampDisplacement(double displacement[6], double maxDisplacement) {
    const double length = lengthOfDisplacement(displacement);
    for (int i = 0; i < 6 && length > maxDisplacement; i++)
        displacement[i] *= maxDisplacement / length;
}

/* Adds a step's displacement to the exponentially weighted sum over the last second, in which jitter cancels. The sum
 * of an oscillating body passes through zero, so its maximum over the last second is kept as well. Both are limited to
 * e times the still distance, so that large ones decay within a second, too. */
static void addDisplacement(MdtStay *s, const double displacement[6], double still, double share) {
    MEASSERT(still > 0 && share > 0);
    clampDisplacement(s->displacement, exp(1) * still);
    for (int i = 0; i < 6; i++)
        s->displacement[i] = exp(-share) * s->displacement[i] + displacement[i];
    s->maxDisplacement =
        fmax(exp(-share) * fmin(s->maxDisplacement, exp(1) * still), lengthOfDisplacement(s->displacement));
}

/* Counts how often the body returns to half of its farthest distance. Two returns mean oscillation or jitter, unless
 * the body goes a tenth farther in between. One is not enough: a body near a turning point of its path has one, too.
 * */
static void countReturns(MdtStay *s, double distance, double h) {
    const MeBool isBack = distance < 0.5 * s->maxDistance, wasBack = s->crossings % 2 == 0;
    s->maxDistance = fmax(s->maxDistance, distance);
    s->crossings += isBack != wasBack;
    if (isBack && !wasBack)
        s->maxAtReturn = s->maxDistance;
    if (distance > 1.1 * s->maxAtReturn)
        s->crossings = !isBack;
    if (distance > s->reach)
        s->reach = 0;
    s->time += h;
    MEASSERT(s->maxAtReturn <= s->maxDistance && s->crossings >= 0);
}

/* m: the amplitude of a small oscillation, which is one with two returns; 0: there is none. The amplitude may grow with
 * the time observed. */
static double amplitudeOf(const MdtStay *s, double radius, double second) {
    const MeBool isSmall = s->maxDistance <= stayingReach * radius * s->time / second;
    return s->time >= second && s->crossings >= 4 && isSmall ? s->maxDistance : 0;
}

void mdt_stayUpdate(MdtBodyID b, double h) {
    const double radius = radiusOf(b), distance = distanceFromPlace(b, radius), second = lookAheadTime(b);
    MdtStay *s = &b->stay;
    double displacement[6];
    getStepDisplacement(b, radius, displacement);
    addDisplacement(s, displacement, stillDistance(radius), h / second);
    if (distance > 20 * stayingReach * radius) /* the largest oscillation about its place */
        restartAt(b, 0);
    else if (s->time > 20 * second)
        restartAt(b, 2 * amplitudeOf(s, radius, second));
    else
        countReturns(s, distance, h);
    MEASSERT(s->maxDisplacement >= 0);
}

MeBool mdt_bodyStaysInPlace(const MdtBody *b) {
    const double radius = radiusOf(b);
    return b->stay.maxDisplacement <= stillDistance(radius) || b->stay.reach > 0 ||
           amplitudeOf(&b->stay, radius, lookAheadTime(b)) > 0;
}

/* m: displacement in the next second if the motion of the last step goes on. */
static double distanceAhead(const MdtBody *b, double radius) {
    const MdtKeaVelocity *a = &b->kea.lastStep;
    const double t = lookAheadTime(b);
    return t * pointSpeed(b, radius) + 0.5 * t * t * (keaLength(a->lin) + radius * keaLength(a->ang));
}

MeBool mdt_bodyIsQuiet(const MdtBody *b) {
    const double radius = radiusOf(b);
    return b->world->hasThresholds || distanceAhead(b, radius) <= 0.1 * stayingReach * radius;
}

MeBool mdt_bodyWouldMove(const MdtBody *b, double push[2][3], double h) {
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    const double *I = b->kea.moments, radius = radiusOf(b);
    const double speed = keaLength(push[0]) * b->kea.invMass, spin = keaLength(push[1]) / fmin(I[0], fmin(I[1], I[2]));
    if (b->world->hasThresholds)
        return speed * speed > h * h * (double)sleepParams->acc_thresh ||
               spin * spin > h * h * (double)sleepParams->accrot_thresh;
    return (speed + radius * spin) * lookAheadTime(b) > 10 * stayingReach * radius;
}
