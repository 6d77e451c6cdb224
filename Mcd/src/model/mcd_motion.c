/* Continuous collision: the time of impact of two shapes in motion, by conservative advancement (Mirtich).
 *
 * For a fixed direction n the separation s = min a.n - max b.n of two rigid shapes decreases no faster than
 *     mu = -(va - vb).n + |n x wa| Ra + |n x wb| Rb,
 * where R is the largest distance of a point of the core from the pivot, because (w x r).n = r.(n x w) and |r| is
 * constant; a rounding does not turn. So the shapes do not touch before the time s / mu. As long as the direction is
 * kept, only support points are needed; when s becomes small compared with the true distance, a new direction is
 * computed.
 *
 * What touches need not be in the way: a ball that rolls over flush tiles meets the edge of the next one with a normal
 * that leans against its motion. So advancement goes on into the obstacle, to the depth `margin` that is left to
 * contacts, and there is no impact if on the way the closing speed along the normal becomes so slow that contacts
 * cope. The same decides about an obstacle that is in touch at the start.
 *
 * A free body's spin changes, and contacts take points to move straight. Where poses are not known any more, the shape
 * is somewhere in the ball about its pivot, and stops where that ball touches, or there and then, to look anew. */
#include "convex/mcd_kind_i.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_vector_i.h"
#include "model/mcd_motion_i.h"
#include "model/mcd_result_i.h"
#include <string.h>

enum { DIRECTIONS = 64, ADVANCES = 32 };

/* ---- movers ------------------------------------------------------------------------------------------------------ */

/* Rotates v about the unit axis, by Rodrigues' formula. */
static void rotateVector(double v[3], const double axis[3], double sine, double cosine) {
    double side[3];
    mcd_cross(side, axis, v);
    const double along = mcd_dot(axis, v) * (1 - cosine);
    for (int i = 0; i < 3; i++)
        v[i] = cosine * v[i] + sine * side[i] + along * axis[i];
}

void mcd_moverInit(McdMover *m, const McdShape *start, const double pivot[3]) {
    *m = (McdMover){.start = *start, .arm = sqrt(mcd_distanceSquared(start->place, pivot))};
    mcd_copy(m->pivot, pivot);
}

/* The shape after a time, s; its axes turn exactly. A triangle must be at rest. */
static void moverAt(const McdMover *m, double time, McdShape *moved) {
    *moved = m->start;
    mcd_mad(moved->place, moved->place, time, m->velocity);
    const double rate = mcd_length(m->spin);
    if (rate == 0)
        return;
    const double axis[3] = {m->spin[0] / rate, m->spin[1] / rate, m->spin[2] / rate};
    const double sine = sin(rate * time), cosine = cos(rate * time);
    double arm[3];
    mcd_sub(arm, m->start.place, m->pivot);
    rotateVector(arm, axis, sine, cosine);
    mcd_mad(moved->place, m->pivot, time, m->velocity);
    mcd_mad(moved->place, moved->place, 1, arm);
    for (int i = 0; i < 3; i++)
        rotateVector(moved->axis[i], axis, sine, cosine);
    MEVALIDATE(!mcd_shapeIsRigid(moved) || fabs(mcd_dot(moved->axis[0], moved->axis[1])) < 1e-8);
}

/* m: no point of the core is farther from the shape's origin. */
static double coreOf(const McdMover *m) {
    return m->start.extent - m->start.rounding;
}

/* rad/s: the spin that moves the core. A solid of revolution about its z axis does not change by the part along that
 * axis, whose angle with the spin is constant. */
static double coreSpin(const McdMover *m) {
    const McdRank rank = m->start.kind->rank;
    double tilt[3];
    if (rank != MCD_RANK_SPHYL && rank != MCD_RANK_CYLINDER && rank != MCD_RANK_CONE)
        return mcd_length(m->spin);
    mcd_cross(tilt, m->start.axis[2], m->spin);
    return mcd_length(tilt);
}

/* m/s: an upper bound of the velocity along n that rotation gives any point. */
static double turnSpeedAlong(const McdMover *m, const double n[3]) {
    double lever[3];
    mcd_cross(lever, n, m->spin);
    const double turn = mcd_length(lever);
    return turn * m->arm + MeMIN(turn, coreSpin(m)) * coreOf(m);
}

/* m/s: an upper bound of the velocity along n of any point of the mover. */
static double speedAlong(const McdMover *m, const double n[3]) {
    return mcd_dot(m->velocity, n) + turnSpeedAlong(m, n);
}

/* ---- approaches -------------------------------------------------------------------------------------------------- */

/* m/s: an upper bound of the speed at which the separation along n decreases. */
static double closingSpeed(const McdApproach *p, const double n[3]) {
    double back[3];
    mcd_scale(back, n, -1);
    return speedAlong(&p->shape, back) + (p->isHalfSpace ? 0 : speedAlong(&p->other, n));
}

/* The separation min a.n - max b.n at a time; `at` gets the shape's point there. */
static double separationAlong(const McdApproach *p, const double n[3], double time, double at[3]) {
    double back[3], high[3];
    McdShape moved;
    mcd_scale(back, n, -1);
    moverAt(&p->shape, time, &moved);
    mcd_support(&moved, back, at);
    if (p->isHalfSpace)
        return mcd_dot(at, n) - p->offset;
    moverAt(&p->other, time, &moved);
    mcd_support(&moved, n, high);
    return mcd_dot(at, n) - mcd_dot(high, n);
}

/* The signed distance at a time, its normal, and the point midway. */
static double gapAt(const McdApproach *p, double time, double n[3], double at[3]) {
    McdShape a, b;
    double onA[3], onB[3];
    if (p->isHalfSpace) {
        mcd_copy(n, p->normal);
        return separationAlong(p, n, time, at);
    }
    moverAt(&p->shape, time, &a);
    moverAt(&p->other, time, &b);
    const double distance = mcd_convexDistance(&a, &b, onA, onB, n);
    for (int k = 0; k < 3; k++)
        at[k] = (onA[k] + onB[k]) / 2;
    return distance;
}

/* Advances the time along one fixed direction while progress is good; s is the separation at `time`. Returns the new
 * time. */
static double advanceAlong(const McdApproach *p, const double n[3], double s, double time, double maxTime) {
    double at[3];
    const double closing = closingSpeed(p, n);
    for (int i = 0; i < ADVANCES && s > p->touch / 2 && time < maxTime; i++) {
        if (closing <= 0)
            return maxTime;
        time += s / closing;
        MEASSERT(s > 0 && closing > 0); /* time only increases */
        s = separationAlong(p, n, MeMIN(time, maxTime), at);
    }
    return MeMIN(time, maxTime);
}

/* The first time from `time` at which both are within touch, or maxTime. n gets the normal then, `at` the point midway
 * between them, `touches` whether they are within touch. */
static double firstTouch(const McdApproach *p, double time, double maxTime, double n[3], double at[3],
                         MeBool *touches) {
    for (int i = 0; i < DIRECTIONS; i++) {
        const double distance = gapAt(p, time, n, at);
        MEASSERT(time >= 0 && time <= maxTime);
        *touches = distance <= p->touch;
        if (*touches || time >= maxTime)
            return time;
        time = advanceAlong(p, n, distance, time, maxTime);
    }
    *touches = METRUE; /* did not converge: the time is safe, but may be early */
    return time;
}

/* ---- what is known ----------------------------------------------------------------------------------------------- */

/* m/s²: how much points accelerate that are taken to move as the spin at the start has it or, by contacts, straight. A
 * body that tips over a contact falls. */
static double unknownAcceleration(const McdMover *m, MeBool hasContacts) {
    const double core = coreOf(m), turn = hasContacts ? coreSpin(m) : 0, all = hasContacts ? mcd_length(m->spin) : 0;
    const double tips = hasContacts && core + m->arm > 0 ? mcd_length(m->acceleration) : 0;
    return (m->spinRate + all * all) * m->arm + (m->spinRate + turn * turn) * core + tips + m->bend;
}

/* s: how long the shapes' points are known to within the margin: acceleration t² / 2. */
static double horizonOf(const McdApproach *p, MeBool hasContacts) {
    const double other = p->isHalfSpace ? 0 : unknownAcceleration(&p->other, hasContacts);
    return sqrt(2 * p->margin / (unknownAcceleration(&p->shape, hasContacts) + other)); /* INFINITY if they are 0 */
}

/* ---- impacts ----------------------------------------------------------------------------------------------------- */

/* s: a time, from `time`, at which the depth is at most `depth` and nearly that. max: it is not reached, but the shapes
 * close. INFINITY: on the way they do not close any more, or slowly. */
static double timeToDepth(const McdApproach *p, double depth, double slack, double time, double max) {
    double n[3], at[3];
    for (int i = 0; i < DIRECTIONS && time < max; i++) {
        const double distance = gapAt(p, time, n, at), closing = closingSpeed(p, n);
        if (closing <= p->slow)
            return INFINITY;
        if (distance <= slack - depth)
            return time;
        time += (distance + depth) / closing;
    }
    return MeMIN(time, max);
}

/* Whether the shape is behind the obstacle, where nothing stops it. */
static MeBool isBehind(const McdApproach *p) {
    return p->front && mcd_heightOver(p->shape.start.place, p->other.start.corner[0], p->front) < 0;
}

/* s: for what is within the margin at the start. Contacts yield while they are known, and until the shapes are deeper
 * by the margin. */
static double impactOfNear(const McdApproach *p, double gap, double max) {
    const double known = fmin(horizonOf(p, METRUE), max);
    switch (p->near) {
    case kMcdNearPass:
        return max;
    case kMcdNearYield:
        return fmin(timeToDepth(p, p->margin - MeMIN(gap, 0), .1 * p->margin, 0, known), known);
    case kMcdNearBlock:
        return timeToDepth(p, -gap, .1 * fabs(gap), 0, max) < max ? 0 : max;
    }
    return max;
}

/* The approach of shapes that no contacts hold. */
static McdApproach freeApproach(const McdApproach *p) {
    McdApproach free = *p;
    mcd_mad(free.shape.velocity, p->shape.velocity, p->time / 2, p->shape.acceleration);
    if (!p->isHalfSpace)
        mcd_mad(free.other.velocity, p->other.velocity, p->time / 2, p->other.acceleration);
    return free;
}

/* When the shapes begin to touch; max: not from `from` to `to`, or they touch at `from`. */
static double beginOfTouch(const McdApproach *p, double from, double to, double max) {
    double n[3], at[3];
    MeBool touches = MEFALSE;
    const double time = gapAt(p, from, n, at) > p->touch ? firstTouch(p, from, to, n, at, &touches) : max;
    return touches ? fmin(time, max) : max;
}

/* For what is not in touch at the start, while poses are known. Contacts with others may hold the shape, or nothing: it
 * must neither go into the obstacle straight on, nor fall on it. */
static double knownImpact(const McdApproach *p, const McdApproach *free, double from, double to, double max) {
    double n[3], at[3];
    const double straight = beginOfTouch(p, from, to, max);
    const double fall = p->isFalling ? beginOfTouch(free, from, to, max) : max;
    if (straight < max && timeToDepth(p, p->margin, .1 * p->margin, straight, max) <= max)
        return fmin(straight, fall);
    return fall < max && gapAt(p, fall, n, at) > p->margin ? fall : max;
}

/* Kind of a ball. */
static const McdKind ballKind = {.support = mcd_pointSupport, .face = mcd_pointFace, .rank = MCD_RANK_SPHERE};

/* Replaces a mover that turns, or leaves its uniform motion, by the ball about its pivot that it does not leave in the
 * time. */
static void boundByBall(McdMover *m, double time) {
    if (mcd_dot(m->spin, m->spin) == 0 && m->bend == 0)
        return;
    m->start.kind = &ballKind;
    m->start.rounding = m->start.extent = m->arm + m->start.extent + m->bend * time * time / 2;
    mcd_copy(m->start.place, m->pivot);
    mcd_set(m->spin, 0, 0, 0);
    m->arm = 0;
}

/* When the shapes are to stop because they may touch from then on, in poses that are not known yet. */
static double unknownImpact(const McdApproach *free, double from, double to, double max) {
    McdApproach bound = *free;
    double n[3], at[3];
    MeBool touches;
    boundByBall(&bound.shape, max);
    if (!free->isHalfSpace)
        boundByBall(&bound.other, max);
    const double gap = gapAt(&bound, from, n, at);
    if (gap <= free->touch)
        return from;
    const double time = firstTouch(&bound, from, to, n, at, &touches);
    return touches && time < max ? time : max;
}

double mcd_impactTime(const McdApproach *p, double from, double to, double max) {
    double n[3], at[3];
    if (isBehind(p))
        return max;
    const double gap = from == 0 ? gapAt(p, 0, n, at) : INFINITY, known = fmin(horizonOf(p, MEFALSE), max);
    if (gap <= p->margin)
        return impactOfNear(p, gap, max);
    const McdApproach free = freeApproach(p);
    const double time = from < known ? knownImpact(p, &free, from, fmin(to, known), known) : known;
    if (time < known || !(to > known))
        return time < known ? time : max;
    return unknownImpact(&free, fmax(from, known), to, max);
}

/* ---- safe times -------------------------------------------------------------------------------------------------- */

static void getVelocities(const McdModelRecord *m, double velocity[3], double spin[3]) {
    for (int i = 0; i < 3; i++) {
        velocity[i] = m->linearVelocity ? (double)m->linearVelocity[i] : 0;
        spin[i] = m->angularVelocity ? (double)m->angularVelocity[i] : 0;
    }
}

static MeBool makeMover(McdModelID cm, const double origin[3], McdMover *mover) {
    McdModelRecord *m = mcd_record(cm);
    McdShape shape;
    if (!mcd_shapeOf(&m->instance, origin, &shape))
        return MEFALSE;
    mcd_moverInit(mover, &shape, shape.place);
    getVelocities(m, mover->velocity, mover->spin);
    return METRUE;
}

static void reportTouch(McdSafeTimeResult *result, double time, MeBool touches, const double n[3], const double at[3],
                        const double origin[3]) {
    MEASSERT(time >= 0 && (!touches || isfinite(mcd_length(n))));
    result->time = (MeReal)time;
    for (int i = 0; i < 3; i++) {
        result->normal[i] = touches ? (MeReal)n[i] : 0;
        result->position[i] = (MeReal)(origin[i] + at[i]);
    }
}

int MEAPI mcd_safeTimeConvex(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    double origin[3], n[3], at[3];
    McdApproach approach = {.isHalfSpace = MEFALSE};
    MeBool touches;
    mcd_pairOrigin(&mcd_record(p->model1)->instance, &mcd_record(p->model2)->instance, origin);
    if (!makeMover(p->model1, origin, &approach.shape) || !makeMover(p->model2, origin, &approach.other))
        return 0;
    approach.touch = MCD_TOUCH * MeMIN(approach.shape.start.extent, approach.other.start.extent);
    const double time = firstTouch(&approach, 0, (double)maxTime, n, at, &touches);
    reportTouch(result, time, touches, n, at, origin);
    return 1;
}

/* ---- planes ------------------------------------------------------------------------------------------------------ */

static double heightAbove(const McdMover *a, const double n[3], double offset, double time, double at[3]) {
    double back[3];
    McdShape moved;
    mcd_scale(back, n, -1);
    moverAt(a, time, &moved);
    mcd_support(&moved, back, at);
    return mcd_dot(at, n) - offset;
}

/* m/s: an upper bound of the closing speed of a shape and a moving plane. If the plane rotates with angular velocity
 * w, the height n.(x - p) changes by up to w |x - p| more, since n changes. */
static double closingSpeedOfPlane(const McdMover *a, const McdModelRecord *plane, const double origin[3],
                                  const double n[3], double maxTime) {
    double back[3];
    double velocity[3], spin[3], arm[3];
    mcd_scale(back, n, -1);
    getVelocities(plane, velocity, spin);
    if (mcd_length(spin) == 0)
        return speedAlong(a, back) + mcd_dot(velocity, n);
    for (int i = 0; i < 3; i++)
        arm[i] = a->start.place[i] + origin[i] - (double)plane->instance.tm[3][i];
    const double straight = mcd_length(a->velocity) + mcd_length(velocity);
    return straight + mcd_length(a->spin) * a->start.extent +
           mcd_length(spin) * (mcd_length(arm) + a->start.extent + straight * maxTime);
}

int MEAPI mcd_safeTimePlane(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    McdModelRecord *shape = mcd_record(p->model1), *plane = mcd_record(p->model2);
    double origin[3], n[3], at[3], offset, time = 0;
    MeMatrix4 tm;
    McdMover a;
    mcd_pairOrigin(&shape->instance, &shape->instance, origin);
    if (!makeMover(p->model1, origin, &a))
        return 0;
    const double target = MCD_TOUCH * a.start.extent;
    for (int i = 0; i < DIRECTIONS * ADVANCES; i++) {
        mcd_modelPlaceAt(plane, time, tm);
        mcd_halfSpaceAt(mcd_const(tm), origin, n, &offset);
        const double height = heightAbove(&a, n, offset, time, at);
        if (height <= target || time >= (double)maxTime) {
            reportTouch(result, time, height <= target, n, at, origin);
            return 1;
        }
        const double closing = closingSpeedOfPlane(&a, plane, origin, n, (double)maxTime);
        time = closing > 0 ? MeMIN(time + height / closing, (double)maxTime) : (double)maxTime;
        MEASSERT(!(time > (double)maxTime));
    }
    reportTouch(result, time, METRUE, n, at, origin);
    return 1;
}
