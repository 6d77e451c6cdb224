/* Continuous collision: a lower bound of the time of impact of two models.
 *
 * Conservative advancement (Mirtich): for a fixed direction n the separation s = min a.n - max b.n of two rigid
 * shapes decreases no faster than
 *     mu = -(va - vb).n + |n x wa| Ra + |n x wb| Rb,
 * where R is the largest distance of a point from the shape's origin, because (w x r).n = r.(n x w) and |r| is
 * constant. So the shapes do not touch before the time s / mu. As long as the direction is kept, only support points
 * are needed; when s becomes small compared with the true distance, a new direction is computed.
 */
#include "model/mcd_geometries_i.h"
#include "convex/mcd_vector_i.h"
#include "model/mcd_motion_i.h"
#include "model/mcd_result_i.h"
#include <string.h>

enum { DIRECTIONS = 64, ADVANCES = 32 };

/* A moving shape. */
typedef struct Mover {
    McdShape start;
    double velocity[3], spin[3];
    double reach;
} Mover;

/* Rotates v about the unit axis, by Rodrigues' formula. */
static void rotateVector(double v[3], const double axis[3], double sine, double cosine) {
    double side[3];
    mcd_cross(side, axis, v);
    const double along = mcd_dot(axis, v) * (1 - cosine);
    for (int i = 0; i < 3; i++)
        v[i] = cosine * v[i] + sine * side[i] + along * axis[i];
}

void mcd_shapeMove(const McdShape *s, const double velocity[3], const double spin[3], double time, McdShape *moved) {
    *moved = *s;
    mcd_mad(moved->place, moved->place, time, velocity);
    const double rate = mcd_length(spin);
    if (rate == 0)
        return;
    const double axis[3] = {spin[0] / rate, spin[1] / rate, spin[2] / rate};
    for (int i = 0; i < 3; i++)
        rotateVector(moved->axis[i], axis, sin(rate * time), cos(rate * time));
    MEVALIDATE(!mcd_shapeIsRigid(s) || fabs(mcd_dot(moved->axis[0], moved->axis[1])) < 1e-8);
}

static void getVelocities(const McdModelRecord *m, double velocity[3], double spin[3]) {
    for (int i = 0; i < 3; i++) {
        velocity[i] = m->linearVelocity ? (double)m->linearVelocity[i] : 0;
        spin[i] = m->angularVelocity ? (double)m->angularVelocity[i] : 0;
    }
}

static MeBool makeMover(McdModelID cm, const double origin[3], Mover *mover) {
    McdModelRecord *m = mcd_record(cm);
    getVelocities(m, mover->velocity, mover->spin);
    if (!mcd_shapeOf(&m->instance, origin, &mover->start))
        return MEFALSE;
    mover->reach = mover->start.extent;
    return METRUE;
}

/* m/s: an upper bound of the velocity along n of any point of the mover. */
static double speedAlong(const Mover *m, const double n[3]) {
    double lever[3];
    mcd_cross(lever, n, m->spin);
    return mcd_dot(m->velocity, n) + mcd_length(lever) * m->reach;
}

/* The separation min a.n - max b.n at a time. */
static double separationAlong(const Mover *a, const Mover *b, const double n[3], double time) {
    double back[3];
    double low[3], high[3];
    McdShape moved;
    mcd_scale(back, n, -1);
    mcd_shapeMove(&a->start, a->velocity, a->spin, time, &moved);
    mcd_support(&moved, back, low);
    mcd_shapeMove(&b->start, b->velocity, b->spin, time, &moved);
    mcd_support(&moved, n, high);
    return mcd_dot(low, n) - mcd_dot(high, n);
}

/* Advances the time along one fixed direction while progress is good; s is the separation at `time`. Returns the new
 * time. */
static double advanceAlong(const Mover *a, const Mover *b, const double n[3], double s, double target, double time,
                           double maxTime) {
    double back[3];
    mcd_scale(back, n, -1);
    const double closing = speedAlong(a, back) + speedAlong(b, n);
    for (int i = 0; i < ADVANCES && s > target / 2 && time < maxTime; i++) {
        if (closing <= 0)
            return maxTime;
        time += s / closing;
        MEASSERT(s > 0 && closing > 0); /* time only increases */
        s = separationAlong(a, b, n, MeMIN(time, maxTime));
    }
    return MeMIN(time, maxTime);
}

/* The first time at which the movers are within `target` of each other, or maxTime. n gets the normal then, `at` the
 * point midway between them, `touches` whether they are within target. */
static double firstTouch(const Mover *a, const Mover *b, double target, double maxTime, double n[3], double at[3],
                         MeBool *touches) {
    double time = 0;
    *touches = MEFALSE;
    for (int i = 0; i < DIRECTIONS; i++) {
        McdShape movedA, movedB;
        double onA[3], onB[3];
        mcd_shapeMove(&a->start, a->velocity, a->spin, time, &movedA);
        mcd_shapeMove(&b->start, b->velocity, b->spin, time, &movedB);
        const double distance = mcd_convexDistance(&movedA, &movedB, onA, onB, n);
        MEASSERT(time >= 0 && time <= maxTime);
        for (int k = 0; k < 3; k++)
            at[k] = (onA[k] + onB[k]) / 2;
        *touches = distance <= target;
        if (*touches || time >= maxTime)
            return time;
        time = advanceAlong(a, b, n, distance, target, time, maxTime);
    }
    *touches = METRUE; /* did not converge: the time is safe, but may be early */
    return time;
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
    Mover a, b;
    MeBool touches;
    mcd_pairOrigin(&mcd_record(p->model1)->instance, &mcd_record(p->model2)->instance, origin);
    if (!makeMover(p->model1, origin, &a) || !makeMover(p->model2, origin, &b))
        return 0;
    const double target = MCD_TOUCH * MeMIN(a.reach, b.reach);
    const double time = firstTouch(&a, &b, target, (double)maxTime, n, at, &touches);
    reportTouch(result, time, touches, n, at, origin);
    return 1;
}

/* ---- planes ------------------------------------------------------------------------------------------------------ */

static double heightAbove(const Mover *a, const double n[3], double offset, double time, double at[3]) {
    double back[3];
    McdShape moved;
    mcd_scale(back, n, -1);
    mcd_shapeMove(&a->start, a->velocity, a->spin, time, &moved);
    mcd_support(&moved, back, at);
    return mcd_dot(at, n) - offset;
}

/* m/s: an upper bound of the closing speed of a shape and a moving plane. If the plane rotates with angular velocity
 * w, the height n.(x - p) changes by up to w |x - p| more, since n changes. */
static double closingSpeed(const Mover *a, const McdModelRecord *plane, const double origin[3], const double n[3],
                           double maxTime) {
    double back[3];
    double velocity[3], spin[3], arm[3];
    mcd_scale(back, n, -1);
    getVelocities(plane, velocity, spin);
    if (mcd_length(spin) == 0)
        return speedAlong(a, back) + mcd_dot(velocity, n);
    for (int i = 0; i < 3; i++)
        arm[i] = a->start.place[i] + origin[i] - (double)plane->instance.tm[3][i];
    const double straight = mcd_length(a->velocity) + mcd_length(velocity);
    return straight + mcd_length(a->spin) * a->reach +
           mcd_length(spin) * (mcd_length(arm) + a->reach + straight * maxTime);
}

int MEAPI mcd_safeTimePlane(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    McdModelRecord *shape = mcd_record(p->model1), *plane = mcd_record(p->model2);
    double origin[3], n[3], at[3], offset, time = 0;
    MeMatrix4 tm;
    Mover a;
    mcd_pairOrigin(&shape->instance, &shape->instance, origin);
    if (!makeMover(p->model1, origin, &a))
        return 0;
    const double target = MCD_TOUCH * a.reach;
    for (int i = 0; i < DIRECTIONS * ADVANCES; i++) {
        mcd_modelPlaceAt(plane, time, tm);
        mcd_halfSpaceAt(mcd_const(tm), origin, n, &offset);
        const double height = heightAbove(&a, n, offset, time, at);
        if (height <= target || time >= (double)maxTime) {
            reportTouch(result, time, height <= target, n, at, origin);
            return 1;
        }
        const double closing = closingSpeed(&a, plane, origin, n, (double)maxTime);
        time = closing > 0 ? MeMIN(time + height / closing, (double)maxTime) : (double)maxTime;
        MEASSERT(!(time > (double)maxTime));
    }
    reportTouch(result, time, METRUE, n, at, origin);
    return 1;
}
