/* Stops and motor of one degree of freedom (Dynamics guide ch. 3, "Joint Limit").
 *
 * For a stop let z be the distance to it (negative: beyond it), J v its rate, and λ >= 0 the force that increases z.
 *   hard:  J v⁺ >= -z/h while z > 0 (speculative: the stop may be reached, not passed), >= -γ z/h beyond, and >= -e J v
 *          when e > 0 and the stop is hit faster than the acceleration of one step explains (else a load at rest on the
 *          stop would rattle). The rebound occurs in the step that would pass the stop: at its end the stop is reached,
 *          and the velocity is e times that of the approach.
 *   soft:  beyond the stop a damped spring that only pushes, λ = -kp z - kd J v >= 0. The row is added, without
 *          damping, in the step in which the stop is reached, so that the spring acts from first contact.
 * The motor is a velocity row J v⁺ = desired velocity with |λ| <= fmax, without ε, so that a brake holds. If it tracks,
 * it is a position row of the coordinate q, q⁺ - q = h x desired velocity: displacement that is lost while the force is
 * at its bound is not made up for later. A position motor is a spring to its target (bcl_servo.c). The lock, which
 * replaces the motor, is the row of a joint, J v⁺ = -γ (position - lock) / h with |λ| <= lockForce. */
#include "bcl_i.h"
#include <string.h>

enum { MOTOR = 1, LOWER = 2, UPPER = 4, LOCK = 8 };

void MEAPI MdtBclSingleLimitReset(MdtBclSingleLimit *stop) {
    if (!stop) {
        MeWarning(1, "MdtBclSingleLimitReset: the limit is null");
        return;
    }
    stop->damping = 0;
    stop->restitution = 1;
    stop->stiffness = MEINFINITY;
    stop->stop = 0;
}

void MEAPI MdtBclLimitReset(MdtBclLimit *limit) {
    if (!limit) {
        MeWarning(1, "MdtBclLimitReset: the limit is null");
        return;
    }
    memset(limit, 0, sizeof *limit);
    MdtBclSingleLimitReset(&limit->limit[0]);
    MdtBclSingleLimitReset(&limit->limit[1]);
    limit->stiffnessThreshold = MEINFINITY;
}

MeBool bcl_limitIsMeasured(const MdtBclLimit *limit) {
    return limit->bActive || limit->bPowered || limit->bLocked || limit->bCalculatePosition;
}

MeBool bcl_isStopHard(const MdtBclLimit *limit, int side) {
    const MeReal stiffness = limit->limit[side].stiffness;
    return stiffness >= MEINFINITY || stiffness > limit->stiffnessThreshold;
}

void bcl_setStopSpring(MdtBclSingleLimit *stop, MeReal stiffness, MeReal damping) {
    const MeBool isSpring = bcl_isSpring(stiffness, damping);
    stop->stiffness = isSpring ? stiffness : MEINFINITY;
    stop->damping = isSpring ? damping : 0;
}

/* The distance to a stop at a value of the coordinate; negative: beyond it. */
static double distanceToStopAt(const MdtBclLimit *limit, int side, double measured) {
    const double position = measured + (double)limit->offset, stop = limit->limit[side].stop;
    return side == 0 ? position - stop : stop - position;
}

static double distanceToStop(const MdtBclLimit *limit, int side) {
    return distanceToStopAt(limit, side, limit->measured);
}

static MeBool isPositionMotor(const MdtBclLimit *limit) {
    return limit->frequency > 0;
}

/* The coordinate minus the position motor's target at the start of the sub-step. */
static double targetError(const MdtBclLimit *limit, const MdtBclContext *x) {
    const double moved = x->elapsed * (double)limit->desired_vel;
    return limit->measured + (double)limit->offset - (double)limit->target - moved;
}

/* The velocity to which the motor may bring the coordinate in this step: a position motor, that which reaches its
 * target. */
static double motorVelocity(const MdtBclLimit *limit, const MdtBclContext *x) {
    const double toTarget = isPositionMotor(limit) ? -targetError(limit, x) / x->parameters.stepsize : 0;
    return (double)limit->desired_vel + toTarget;
}

/* The smallest rate of z in this step: of its present rate, its rate predicted without constraints and, if the motor
 * runs, the motor's velocity. */
static double minRate(const MdtBclLimit *limit, const MdtBclContext *x, int side, double rate, double predicted) {
    const double sign = side == 0 ? 1 : -1, slowest = fmin(sign * rate, sign * predicted);
    return limit->rows & MOTOR ? fmin(slowest, sign * motorVelocity(limit, x)) : slowest;
}

/* rad/s: an upper estimate of the angular velocity that an impact in this step can give a body: its speed over its
 * smallest radius of gyration, sqrt(moment / mass). */
static double spinAfterImpact(const MdtBclContext *x) {
    double max = 0;
    for (int k = 0; k < 2; k++) {
        const MdtKeaInverseMassMatrix *m = x->invMass[k];
        const double inverse = fmax(m->inertia[0][0], fmax(m->inertia[1][1], m->inertia[2][2]));
        if (m->mass > 0)
            max = fmax(max, keaLength(x->velocity[k]->lin) * sqrt(inverse / m->mass));
    }
    return max;
}

/* Whether the coordinate is an angle: its row has no linear part. */
static MeBool isAngle(const MdtKeaRow *coordinate) {
    const MdtKeaJBlock *J = coordinate->J;
    return keaDot(J[0].lin, J[0].lin) + keaDot(J[1].lin, J[1].lin) == 0;
}

/* Whether a stop gets a row in this step: if twice the predicted displacement would pass it, which allows for other
 * constraints; if it limits an angle, which an impact could turn that far (impactSpin); if it carried a force in the
 * last step, so that a load at rest on it does not rattle; or if it was passed (bcl_limitPassed). */
static MeBool isWithinReach(const MdtBclLimit *limit, const MdtBclContext *x, int side, double rate, double predicted,
                            double impactSpin) {
    const MdtBclSingleLimit *stop = &limit->limit[side];
    const double z = distanceToStop(limit, side), h = x->parameters.stepsize;
    if (!bcl_isStopHard(limit, side) && !(stop->stiffness > 0))
        return z < 0 && stop->damping > 0;
    return z <= 0 || limit->stopForce[side] > 0 || limit->watched[side] > 0 || z < h * impactSpin ||
           z + 2 * h * minRate(limit, x, side, rate, predicted) < 0;
}

int bcl_limitRows(const MdtBclLimit *limit) {
    return ((limit->rows & (MOTOR | LOCK)) != 0) + ((limit->rows & LOWER) != 0) + ((limit->rows & UPPER) != 0);
}

int bcl_limitPrepare(MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, double measured) {
    limit->rows = 0;
    if (!bcl_limitIsMeasured(limit))
        return 0;
    limit->measured = measured;
    limit->isMeasured = METRUE;
    const double rate = bcl_rate(coordinate, x->velocity), predicted = bcl_rate(coordinate, x->predicted);
    const double impactSpin = x->parameters.hasContacts && isAngle(coordinate) ? spinAfterImpact(x) : 0;
    if (!isfinite(measured + rate + predicted)) /* overflow: the step will not be committed */
        return 0;
    int count = 0;
    if (limit->bLocked || (limit->bPowered && limit->fmax > 0)) {
        limit->rows |= limit->bLocked ? LOCK : MOTOR;
        count++;
    }
    for (int side = 0; side < 2; side++) {
        if (limit->bActive && isWithinReach(limit, x, side, rate, predicted, impactSpin)) {
            limit->rows |= side == 0 ? LOWER : UPPER;
            count++;
        }
    }
    MEASSERT(count == bcl_limitRows(limit));
    return count;
}

int bcl_limitKeepMotor(MdtBclLimit *limit, MeBool keepsMotor) {
    limit->rows &= keepsMotor ? MOTOR | LOCK : 0;
    return bcl_limitRows(limit);
}

/* Each of the next three functions completes a copy of the coordinate's row. */
static void lockRow(const MdtBclLimit *limit, const MdtBclContext *x, MdtKeaRow *row) {
    row->error = limit->measured + (double)limit->offset - (double)limit->lock;
    row->target = -x->parameters.gamma * row->error / x->parameters.stepsize;
    row->position = METRUE;
    row->upper = bcl_boundOf(limit->lockForce);
    row->lower = -row->upper;
}

/* The row of the position motor, behind `rigid` rows of the joint. */
static void servoRow(const MdtBclLimit *limit, const MdtBclContext *x, int rigid, MdtKeaRow *row) {
    const MdtBclServo motor = {limit->frequency, limit->dampingRatio, limit->fmax};
    bcl_makeServo(row, x, &motor, targetError(limit, x), limit->desired_vel,
                  bcl_effectiveMass(x, row - rigid, rigid, row));
}

static void motorRow(const MdtBclLimit *limit, const MdtBclContext *x, int rigid, MdtKeaRow *row) {
    if (isPositionMotor(limit)) {
        servoRow(limit, x, rigid, row);
        return;
    }
    bcl_makeMotor(row, limit->desired_vel, limit->fmax);
    if (!limit->bMotorTracks)
        return;
    row->error = 0; /* relative to the start of the step */
    row->drift = row->target;
    row->position = METRUE;
}

void bcl_makeStop(MdtKeaRow *row, const MdtBclContext *x) {
    const double h = x->parameters.stepsize, z = row->error;
    row->target = z > 0 ? -z / h : -x->parameters.gamma * z / h;
    row->lower = 0;
    row->position = METRUE;
}

/* The row of a stop; first: the limit's first row, behind `rigid` ones of the joint. */
static void stopRow(const MdtBclLimit *limit, int side, const MdtBclContext *x, const MdtKeaRow *first, int rigid,
                    MdtKeaRow *row) {
    const MdtBclSingleLimit *stop = &limit->limit[side];
    row->error = distanceToStop(limit, side);
    row->lower = 0;
    if (side == 1)
        bcl_negate(row);
    if (bcl_isStopHard(limit, side)) {
        bcl_makeStop(row, x);
        row->restitution = stop->restitution > 0 ? fmin((double)stop->restitution, 1) : 0;
    } else {
        row->mass = rigid > 0 ? bcl_effectiveMass(x, first - rigid, rigid, row) : 0;
        bcl_makeSpring(row, row->error, stop->stiffness, row->error > 0 ? 0 : (double)stop->damping);
    }
}

void bcl_limitFill(const MdtBclLimit *limit, const MdtBclContext *x, const MdtKeaRow *coordinate, int rigid,
                   MdtKeaRow rows[]) {
    MdtKeaRow *const first = rows;
    if (limit->rows & MOTOR) {
        *rows = *coordinate;
        motorRow(limit, x, rigid, rows++);
    } else if (limit->rows & LOCK) {
        *rows = *coordinate;
        lockRow(limit, x, rows++);
    }
    for (int side = 0; side < 2; side++) {
        if (limit->rows & (side == 0 ? LOWER : UPPER)) {
            *rows = *coordinate;
            stopRow(limit, side, x, first, rigid, rows++);
        }
    }
    MEASSERT(rows - first == bcl_limitRows(limit));
    MEVALIDATE(bcl_areRows(first, bcl_limitRows(limit)));
}

/* The error of a stop that is passed would be closed at the speed gamma z / h, which heavy bodies would keep. */
int bcl_limitPassed(MdtBclLimit *limit, double measured) {
    enum { SUBSTEPS = 8 };                /* links whip to and fro */
    static const double tolerance = 1e-3; /* rad, closed at .01 rad/s */
    int count = 0;
    for (int side = 0; side < 2 && limit->bActive; side++) {
        if (limit->rows & (side == 0 ? LOWER : UPPER) || !bcl_isStopHard(limit, side) ||
            !(distanceToStopAt(limit, side, measured) < -tolerance))
            continue;
        limit->watched[side] = SUBSTEPS;
        count++;
    }
    return count;
}

int bcl_limitErrors(const MdtBclLimit *limit, double measured, double errors[]) {
    int n = 0;
    if (limit->rows & LOCK)
        errors[0] = measured + (double)limit->offset - (double)limit->lock;
    else if (limit->rows & MOTOR)
        errors[0] = measured - limit->measured;
    if (limit->rows & (MOTOR | LOCK))
        n++;
    for (int side = 0; side < 2; side++)
        if (limit->rows & (side == 0 ? LOWER : UPPER))
            errors[n++] = distanceToStopAt(limit, side, measured);
    MEASSERT(n == bcl_limitRows(limit));
    return n;
}

void bcl_limitReadBack(MdtBclLimit *limit, double measured, double rate, const MdtKeaRow rows[]) {
    limit->measured = measured;
    limit->isMeasured = METRUE;
    limit->position = (MeReal)(measured + (double)limit->offset);
    limit->velocity = (MeReal)rate;
    if (limit->rows & (MOTOR | LOCK))
        rows++;
    limit->stopForce[0] = limit->rows & LOWER ? (rows++)->force : 0;
    limit->stopForce[1] = limit->rows & UPPER ? rows->force : 0;
    MEASSERT(limit->stopForce[0] >= 0 && limit->stopForce[1] >= 0); /* stops only push */
    for (int side = 0; side < 2; side++)
        limit->watched[side] -= limit->watched[side] > 0;
}
