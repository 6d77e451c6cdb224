/* CarWheel: a wheel, body 1, that steers, springs and rolls under a chassis, body 0 (Dynamics guide ch. 3,
 * "MdtCarWheel").
 *
 * s is the steering axis, the primary axis of frame 0, and h the hinge axis, the second axis of frame 1; o and t = s x
 * o are the other axes of frame 0; d = P_1 - P_0 from the attachment in the chassis to the wheel's.
 *     φ_1,2 = o·d, t·d     the wheel's centre stays on the line through the attachment along s
 *     φ_3 = s·h            the two axes stay at right angles
 *     locked: φ_4 = t·h    the wheel does not steer; else the steering motor's row
 *     steering: the wheel's angle ψ about s, dψ/dt = (s - (s·h) h)·(ω_1 - ω_0) / (1 - (s·h)²). The motor's row is a
 *                          position row of ψ at the end of the step: a wheel rolls so far in a step that a rate at one
 *                          pose does not determine the change of ψ; a position motor has a spring row (bcl_servo.c)
 *     suspension: a damped spring of the height s·d, and one-sided rows at its stops
 *     the hinge motor's row
 * The steering angle that is read back is -angle(o, h) about s: that of the chassis relative to the wheel, as of hinges
 * (body 0 relative to body 1). Motors drive the wheel relative to the chassis.
 */
#include "bcl_i.h"
#include <string.h>

static const double fullTurn = 6.283185307179586476925;

enum { STEER = 1, LOCK = 2, SUSPEND = 4, LOW = 8, HIGH = 16, ROLL = 32 };

static void reset(MdtBclConstraint *c) {
    static const MdtBclFrame standard = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    MdtBclCarWheel *w = &c->of.wheel;
    c->frame[0] = c->frame[1] = standard;
    memset(w, 0, sizeof *w);
    w->steering.force = (MeReal)1e9;
    w->servo = (MdtBclServo){.dampingRatio = 1};
    w->high = (MeReal)1e9;
    w->low = (MeReal)-1e9;
}

/* The vectors s, o, t, h and d of the equations above. */
typedef struct {
    double s[3], o[3], t[3], h[3], d[3];
} Axes;

static void axesOf(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], Axes *a) {
    double chassis[3][3];
    bcl_axes(chassis, c, 0, pose[0]);
    keaCopy(a->s, chassis[0]);
    keaCopy(a->o, chassis[1]);
    keaCopy(a->t, chassis[2]);
    keaApply(a->h, pose[1]->R, c->frame[1].ortho);
    bcl_separation(c, pose, a->d);
    keaScale(a->d, -1, a->d);
}

/* rad: the wheel's angle ψ about the steering axis. */
static double wheelAngle(const Axes *a) {
    return atan2(keaDot(a->t, a->h), keaDot(a->o, a->h));
}

/* The row of d·direction, with the direction fixed in the chassis: the wheel's displacement relative to the chassis. */
static void wheelRow(const MdtBclConstraint *c, const MdtBclContext *x, const double direction[3], MdtKeaRow *row) {
    bcl_alongRow(c, x, direction, 0, row);
    bcl_negate(row);
}

/* The row of the wheel's rotation relative to the chassis about a world axis. */
static void wheelSpinRow(const MdtBclContext *x, const double axis[3], MdtKeaRow *row) {
    bcl_spinRow(x, axis, row);
    bcl_negate(row);
}

/* Whether a stop gets a row in this step: z is the distance to it, m, and rate the smallest predicted rate of z. */
static MeBool isNearStop(const MdtBclCarWheel *w, int side, double z, double rate, double h) {
    return z <= 0 || w->stopForce[side] > 0 || z + 2 * h * rate < 0;
}

/* Whether the steering has a position motor. */
static MeBool isPositioned(const MdtBclCarWheel *w) {
    return w->servo.frequency > 0;
}

/* The set of this step's rows (flags STEER to ROLL). */
static int chooseRows(const MdtBclConstraint *c, const MdtBclContext *x, const Axes *a) {
    const MdtBclCarWheel *w = &c->of.wheel;
    MdtKeaRow along;
    wheelRow(c, x, a->s, &along);
    const double height = keaDot(a->s, a->d), h = x->parameters.stepsize;
    const double rate[2] = {bcl_rate(&along, x->velocity), bcl_rate(&along, x->predicted)};
    const MeBool steers = isPositioned(w) ? bcl_isServo(&w->servo) : w->steering.force > 0;
    int rows = w->isLocked ? LOCK : steers ? STEER : 0;
    if (w->kp > 0 || w->kd > 0)
        rows |= SUSPEND;
    if (isNearStop(w, 0, height - (double)w->low, fmin(rate[0], rate[1]), h))
        rows |= LOW;
    if (isNearStop(w, 1, (double)w->high - height, -fmax(rate[0], rate[1]), h))
        rows |= HIGH;
    return w->rolling.force > 0 ? rows | ROLL : rows;
}

static int countRows(const MdtBclCarWheel *w) {
    int count = 3;
    for (int row = STEER; row <= ROLL; row *= 2)
        count += (w->rows & row) != 0;
    return count;
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    Axes a;
    axesOf(c, x->pose, &a);
    c->of.wheel.rows = chooseRows(c, x, &a);
    c->of.wheel.startAngle = wheelAngle(&a);
    c->isDegenerate = keaDot(a.s, a.h) * keaDot(a.s, a.h) > 0.99;
    return countRows(&c->of.wheel);
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    Axes a;
    axesOf(c, pose, &a);
    e[0] = keaDot(a.o, a.d);
    e[1] = keaDot(a.t, a.d);
    e[2] = keaDot(a.s, a.h);
    const MdtBclCarWheel *w = &c->of.wheel;
    const double height = keaDot(a.s, a.d);
    e += 3;
    if (w->rows & LOCK)
        *e++ = keaDot(a.t, a.h);
    else if (w->rows & STEER)
        *e++ = remainder(wheelAngle(&a) - w->startAngle, fullTurn);
    if (w->rows & SUSPEND)
        e++;
    if (w->rows & LOW)
        *e++ = height - (double)w->low;
    if (w->rows & HIGH)
        *e++ = (double)w->high - height;
}

/* The row of the locked steering, or of the steering motor, behind those of φ_1..3. */
static void steeringRow(const MdtBclConstraint *c, const MdtBclContext *x, const Axes *a, MdtKeaRow *row) {
    const MdtBclCarWheel *w = &c->of.wheel;
    MEASSERT(w->rows & (STEER | LOCK));
    if (w->rows & LOCK) {
        bcl_dotRow(x, a->t, a->h, row);
        bcl_makePosition(row, x, keaDot(a->t, a->h));
    } else {
        const double slant = keaDot(a->s, a->h), size = fmax(1 - slant * slant, 1e-6);
        double axis[3];
        keaScale(axis, 1 / size, a->s);
        keaAddScaled(axis, -slant / size, a->h);
        wheelSpinRow(x, axis, row);
        if (isPositioned(w)) {
            bcl_makeServo(row, x, &w->servo, remainder(wheelAngle(a) + (double)w->target, fullTurn), 0,
                          bcl_effectiveMass(x, row - 3, 3, row));
            return;
        }
        bcl_makeMotor(row, w->steering.velocity, w->steering.force);
        row->drift = row->target;
        row->position = !c->isDegenerate;
    }
}

/* A stop of the suspension: a one-sided position row of the distance to the stop. The guide's limit_softness is added
 * to epsilon, as the softness of a contact is. */
static void stopRow(const MdtBclConstraint *c, const MdtBclContext *x, const Axes *a, int side, MdtKeaRow *row) {
    const MdtBclCarWheel *w = &c->of.wheel;
    const double height = keaDot(a->s, a->d);
    wheelRow(c, x, a->s, row);
    if (side == 1)
        bcl_negate(row);
    row->error = side == 0 ? height - (double)w->low : (double)w->high - height;
    bcl_makeStop(row, x);
    row->softness += x->parameters.softening * fmax((double)w->softness, 0);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclCarWheel *w = &c->of.wheel;
    MdtKeaRow *const first = rows;
    Axes a;
    axesOf(c, x->pose, &a);
    wheelRow(c, x, a.o, rows);
    bcl_makePosition(rows++, x, keaDot(a.o, a.d));
    wheelRow(c, x, a.t, rows);
    bcl_makePosition(rows++, x, keaDot(a.t, a.d));
    bcl_dotRow(x, a.s, a.h, rows);
    bcl_makePosition(rows++, x, keaDot(a.s, a.h));
    if (w->rows & (STEER | LOCK))
        steeringRow(c, x, &a, rows++);
    if (w->rows & SUSPEND) {
        wheelRow(c, x, a.s, rows);
        bcl_makeSpring(rows++, keaDot(a.s, a.d) - (double)w->reference, w->kp, w->kd);
    }
    for (int side = 0; side < 2; side++)
        if (w->rows & (side == 0 ? LOW : HIGH))
            stopRow(c, x, &a, side, rows++);
    if (w->rows & ROLL) {
        wheelSpinRow(x, a.h, rows);
        bcl_makeMotor(rows++, w->rolling.velocity, w->rolling.force);
    }
    MEASSERT(rows - first == countRows(w));
    MEVALIDATE(bcl_areRows(first, countRows(w)));
}

static void readStopForces(MdtBclCarWheel *w, const MdtKeaRow rows[]) {
    rows += 3 + ((w->rows & (STEER | LOCK)) != 0) + ((w->rows & SUSPEND) != 0);
    w->stopForce[0] = w->rows & LOW ? (rows++)->force : 0;
    w->stopForce[1] = w->rows & HIGH ? rows->force : 0;
    MEASSERT(w->stopForce[0] >= 0 && w->stopForce[1] >= 0); /* stops push */
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclCarWheel *w = &c->of.wheel;
    Axes a;
    MdtKeaRow row;
    double spoke[3];
    axesOf(c, x->pose, &a);
    readStopForces(w, rows);
    wheelRow(c, x, a.s, &row);
    w->height = keaDot(a.s, a.d);
    w->heightRate = bcl_rate(&row, x->velocity);
    wheelSpinRow(x, a.s, &row);
    w->steeringAngle = -wheelAngle(&a);
    w->steeringRate = -bcl_rate(&row, x->velocity);
    wheelSpinRow(x, a.h, &row);
    keaApply(spoke, x->pose[1]->R, c->frame[1].primary);
    w->hingeAngle = acos(fmax(-1, fmin(1, keaDot(spoke, a.s))));
    w->hingeRate = bcl_rate(&row, x->velocity);
}

const MdtBclType bcl_carWheel = {.name = "CarWheel",
                                 .maxRows = MdtBclGETMAXROWSCARWHEEL,
                                 .reset = reset,
                                 .prepare = prepare,
                                 .fill = fill,
                                 .errors = errors,
                                 .readBack = readBack,
                                 .degenerate = "its steering and hinge axes have become parallel"};
