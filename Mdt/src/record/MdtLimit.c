/* Limits: stops and motors of joints. */
#include "record/mdt_record_i.h"

static MeBool isLimit(const MdtBclLimit *l, const char *caller) {
    return mdt_isPointer(caller, "the limit", l);
}

static MeBool isInUse(const MdtBclLimit *l) {
    return l->bActive || l->bPowered || l->bLocked;
}

/* Check for reading a limit's coordinate: false for null. Warns if the coordinate is not measured. */
static MeBool isReadable(const MdtBclLimit *l, const char *caller) {
    if (!isLimit(l, caller))
        return MEFALSE;
    if (!isInUse(l) && !l->bCalculatePosition)
        MeWarning(2,
                  "%s: neither stops nor motor are active, and so it is not measured: call "
                  "MdtLimitCalculatePosition(limit, METRUE)",
                  caller);
    return METRUE;
}

/* A function that returns a property of the limit l; 0 unless `check` accepts it. */
#define LIMIT_GETTER(Type, function, check, value)                                                                     \
    Type MEAPI function(const MdtLimitID l) {                                                                          \
        return check(l, __func__) ? value : 0;                                                                         \
    }

/* ---- the whole limit ---- */

void MEAPI MdtLimitReset(const MdtLimitID limit) {
    if (isLimit(limit, __func__))
        MdtBclLimitReset(limit);
}

void MEAPI MdtLimitResetState(const MdtLimitID limit) {
    if (!isLimit(limit, __func__))
        return;
    limit->position = limit->velocity = 0;
    limit->measured = 0;
    limit->isMeasured = MEFALSE;
    limit->stopForce[0] = limit->stopForce[1] = 0;
}

void mdt_limitAssign(MdtLimitID to, const MdtBclLimit *from) {
    const MdtBclLimit copy = *from; /* `from` may be `to` */
    MEASSERT(copy.fmax >= 0 && copy.lockForce >= 0);
    MdtBclLimitReset(to);
    to->limit[0] = copy.limit[0];
    to->limit[1] = copy.limit[1];
    to->offset = copy.offset;
    to->stiffnessThreshold = copy.stiffnessThreshold;
    to->desired_vel = copy.desired_vel;
    to->fmax = copy.fmax;
    to->target = copy.target;
    to->frequency = copy.frequency;
    to->dampingRatio = copy.dampingRatio;
    to->lock = copy.lock;
    to->lockForce = copy.lockForce;
    to->bLocked = copy.bLocked;
    to->bPowered = copy.bPowered;
    to->bMotorTracks = copy.bMotorTracks;
    to->bActive = copy.bActive;
    to->bCalculatePosition = copy.bCalculatePosition;
}

LIMIT_GETTER(MeReal, MdtLimitGetPosition, isReadable, l->position)

LIMIT_GETTER(MeReal, MdtLimitGetVelocity, isReadable, l->velocity)

void MEAPI MdtLimitSetPosition(MdtLimitID l, const MeReal NewPosition) {
    if (!isLimit(l, __func__) || !mdt_isFinite(__func__, "the position", NewPosition))
        return;
    l->offset = (MeReal)((double)NewPosition - l->measured);
    l->position = NewPosition;
}

MeReal MEAPI MdtLimitGetOvershoot(const MdtLimitID l) {
    if (!isReadable(l, __func__))
        return 0;
    const MeReal below = l->limit[0].stop - l->position, above = l->position - l->limit[1].stop;
    return below > 0 ? below : above > 0 ? above : 0;
}

void MEAPI MdtLimitSetStiffnessThreshold(const MdtLimitID l, const MeReal NewStiffnessThreshold) {
    if (isLimit(l, __func__) && mdt_isFinite(__func__, "the threshold", NewStiffnessThreshold))
        l->stiffnessThreshold = NewStiffnessThreshold > 0 ? NewStiffnessThreshold : 0;
}

LIMIT_GETTER(MeReal, MdtLimitGetStiffnessThreshold, isLimit, l->stiffnessThreshold)

LIMIT_GETTER(MdtSingleLimitID, MdtLimitGetLowerLimit, isLimit, &l->limit[0])

LIMIT_GETTER(MdtSingleLimitID, MdtLimitGetUpperLimit, isLimit, &l->limit[1])

void MEAPI MdtLimitSetLowerLimit(const MdtLimitID l, const MdtSingleLimitID sl) {
    if (!isLimit(l, __func__) || !mdt_isPointer(__func__, "the stop", sl))
        return;
    l->limit[0] = *sl;
    if (l->limit[1].stop < sl->stop)
        l->limit[1].stop = sl->stop;
}

void MEAPI MdtLimitSetUpperLimit(const MdtLimitID l, const MdtSingleLimitID sl) {
    if (!isLimit(l, __func__) || !mdt_isPointer(__func__, "the stop", sl))
        return;
    l->limit[1] = *sl;
    if (l->limit[0].stop > sl->stop)
        l->limit[0].stop = sl->stop;
}

/* ---- switches ---- */

void MEAPI MdtLimitActivateLimits(const MdtLimitID l, const MeBool NewActivationState) {
    if (!isLimit(l, __func__))
        return;
    l->bActive = NewActivationState != 0;
    if (l->bActive && l->limit[0].stop > l->limit[1].stop)
        MeWarning(1, "%s: the lower stop, %g, is above the upper one, %g: no position satisfies both", __func__,
                  (double)l->limit[0].stop, (double)l->limit[1].stop);
}

LIMIT_GETTER(MeBool, MdtLimitIsActive, isLimit, l->bActive)

void MEAPI MdtLimitActivateMotor(const MdtLimitID l, const MeBool NewActivationState) {
    if (isLimit(l, __func__))
        l->bPowered = NewActivationState != 0;
}

LIMIT_GETTER(MeBool, MdtLimitIsMotorized, isLimit, l->bPowered)

void MEAPI MdtLimitCalculatePosition(const MdtLimitID l, const MeBool NewState) {
    if (isLimit(l, __func__))
        l->bCalculatePosition = NewState || isInUse(l);
}

MeBool MEAPI MdtLimitPositionIsCalculated(const MdtLimitID l) {
    return isLimit(l, __func__) && (l->bCalculatePosition || isInUse(l));
}

/* ---- the motor ---- */

void MEAPI MdtLimitSetLimitedForceMotor(const MdtLimitID l, const MeReal desiredVelocity, const MeReal forceLimit) {
    if (!isLimit(l, __func__) || !mdt_isFinite(__func__, "the velocity", desiredVelocity) ||
        !mdt_isFinite(__func__, "the force limit", forceLimit))
        return;
    if (forceLimit < 0)
        MeWarning(1, "%s: the force limit is %g; a negative one counts as 0, and the motor is off", __func__,
                  (double)forceLimit);
    l->desired_vel = desiredVelocity;
    l->fmax = forceLimit > 0 ? forceLimit : 0;
    l->bPowered = l->fmax > 0;
    l->frequency = 0;
}

void MEAPI MdtLimitSetPositionMotor(const MdtLimitID l, const MeReal target, const MeReal frequency,
                                    const MeReal dampingRatio, const MeReal forceLimit) {
    MdtBclServo motor;
    if (!isLimit(l, __func__) || !mdt_isFinite(__func__, "the target", target) ||
        !mdt_setServo(__func__, &motor, frequency, dampingRatio, forceLimit))
        return;
    l->target = target;
    l->desired_vel = 0;
    l->frequency = motor.frequency;
    l->dampingRatio = motor.dampingRatio;
    l->fmax = motor.force;
    l->bPowered = motor.frequency > 0 && motor.force > 0;
}

void MEAPI MdtLimitSetMotorTarget(const MdtLimitID l, const MeReal target, const MeReal velocity) {
    if (!isLimit(l, __func__) || !mdt_isFinite(__func__, "the target", target) ||
        !mdt_isFinite(__func__, "the velocity", velocity))
        return;
    if (!(l->frequency > 0)) {
        MeWarning(1, "%s: the limit has no position motor: call MdtLimitSetPositionMotor first", __func__);
        return;
    }
    l->target = target;
    l->desired_vel = velocity;
}

LIMIT_GETTER(MeReal, MdtLimitGetMotorTarget, isLimit, l->target)

LIMIT_GETTER(MeReal, MdtLimitGetMotorFrequency, isLimit, l->frequency)

LIMIT_GETTER(MeReal, MdtLimitGetMotorDampingRatio, isLimit, l->dampingRatio)

void MEAPI MdtLimitSetMotorTracking(const MdtLimitID l, const MeBool NewState) {
    if (isLimit(l, __func__))
        l->bMotorTracks = NewState != 0;
}

LIMIT_GETTER(MeBool, MdtLimitMotorIsTracking, isLimit, l->bMotorTracks)

LIMIT_GETTER(MeReal, MdtLimitGetMotorDesiredVelocity, isLimit, l->desired_vel)

LIMIT_GETTER(MeReal, MdtLimitGetMotorMaxForce, isLimit, l->fmax)

/* ---- the lock ---- */

void MEAPI MdtLimitSetLock(const MdtLimitID l, const MeReal lock_value, const MeReal forceLimit) {
    if (!isLimit(l, __func__) || !mdt_isFinite(__func__, "the value", lock_value) ||
        !mdt_isFinite(__func__, "the force limit", forceLimit))
        return;
    l->lock = lock_value;
    l->lockForce = forceLimit > 0 ? forceLimit : 0;
    l->bLocked = METRUE;
}

void MEAPI MdtLimitActivateLock(const MdtLimitID l, const MeBool NewActivationState) {
    if (isLimit(l, __func__))
        l->bLocked = NewActivationState != 0;
}

LIMIT_GETTER(MeBool, MdtLimitIsLocked, isLimit, l->bLocked)

/* ---- one stop ---- */

static MeBool isStop(const MdtBclSingleLimit *sl, const char *caller) {
    return mdt_isPointer(caller, "the stop", sl);
}

#define STOP_GETTER(function, member)                                                                                  \
    MeReal MEAPI function(const MdtSingleLimitID sl) {                                                                 \
        return isStop(sl, __func__) ? sl->member : 0;                                                                  \
    }

void MEAPI MdtSingleLimitReset(const MdtSingleLimitID limit) {
    if (isStop(limit, __func__))
        MdtBclSingleLimitReset(limit);
}

void MEAPI MdtSingleLimitSetStop(const MdtSingleLimitID sl, const MeReal NewStop) {
    if (isStop(sl, __func__) && mdt_isFinite(__func__, "the stop", NewStop))
        sl->stop = NewStop;
}

STOP_GETTER(MdtSingleLimitGetStop, stop)

void MEAPI MdtSingleLimitSetStiffness(const MdtSingleLimitID sl, const MeReal NewStiffness) {
    if (isStop(sl, __func__) && mdt_isFinite(__func__, "the stiffness", NewStiffness))
        sl->stiffness = NewStiffness > 0 ? NewStiffness : 0;
}

STOP_GETTER(MdtSingleLimitGetStiffness, stiffness)

void MEAPI MdtSingleLimitSetDamping(const MdtSingleLimitID sl, const MeReal NewDamping) {
    if (isStop(sl, __func__) && mdt_isFinite(__func__, "the damping", NewDamping))
        sl->damping = NewDamping > 0 ? NewDamping : 0;
}

STOP_GETTER(MdtSingleLimitGetDamping, damping)

void MEAPI MdtSingleLimitSetRestitution(const MdtSingleLimitID sl, const MeReal NewRestitution) {
    if (isStop(sl, __func__) && mdt_isFinite(__func__, "the restitution", NewRestitution))
        sl->restitution = NewRestitution < 0 ? 0 : NewRestitution > 1 ? 1 : NewRestitution;
}

STOP_GETTER(MdtSingleLimitGetRestitution, restitution)
