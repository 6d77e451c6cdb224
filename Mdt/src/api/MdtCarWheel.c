/* API of the car wheel. The steering axis is the primary axis of frame 0, the hinge axis the second axis of frame 1. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(CarWheel, MdtBclCARWHEEL)

MDT_JOINT_DATA(CarWheel, MdtBclCARWHEEL, MdtBclCarWheel, wheel)

/* ---- axes ---- */

void MEAPI MdtCarWheelSetSteeringAxis(const MdtCarWheelID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclCARWHEEL, __func__);
    if (c)
        mdt_constraintSetCrossAxis(&c->base, __func__, 0, x, y, z);
}

void MEAPI MdtCarWheelGetSteeringAxis(const MdtCarWheelID j, MeVector3 v) {
    MdtJoint *c = mdt_isResult(__func__, v, 3) ? mdt_jointOfType(j, MdtBclCARWHEEL, __func__) : NULL;
    if (c)
        MdtConstraintBodyGetAxes(&c->base, 0, v, NULL);
}

void MEAPI MdtCarWheelSetHingeAxis(const MdtCarWheelID j, const MeReal xHinge, const MeReal yHinge,
                                   const MeReal zHinge) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclCARWHEEL, __func__);
    if (c)
        mdt_constraintSetCrossAxis(&c->base, __func__, 1, xHinge, yHinge, zHinge);
}

void MEAPI MdtCarWheelGetHingeAxis(const MdtCarWheelID j, MeVector3 v) {
    MdtJoint *c = mdt_isResult(__func__, v, 3) ? mdt_jointOfType(j, MdtBclCARWHEEL, __func__) : NULL;
    if (c)
        MdtConstraintBodyGetAxes(&c->base, 1, NULL, v);
}

/* ---- steering and rolling ---- */

void MEAPI MdtCarWheelSetSteeringLock(const MdtCarWheelID j, const MeBool lock) {
    Data *w = dataOf(j, __func__);
    if (w)
        w->isLocked = lock != 0;
}

MeBool MEAPI MdtCarWheelIsSteeringLocked(const MdtCarWheelID j) {
    const Data *w = dataOf(j, __func__);
    return w && w->isLocked;
}

/* Whether the motor was set. */
static MeBool setMotor(MdtBclMotor *motor, const char *caller, MeReal velocity, MeReal force) {
    if (!motor || !mdt_isFinite(caller, "the velocity", velocity) || !mdt_isFinite(caller, "the force limit", force))
        return MEFALSE;
    motor->velocity = velocity;
    motor->force = force > 0 ? force : 0;
    return METRUE;
}

void MEAPI MdtCarWheelSetSteeringLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                   const MeReal forceLimit) {
    Data *w = dataOf(j, __func__);
    if (setMotor(w ? &w->steering : NULL, __func__, desiredVelocity, forceLimit))
        w->servo.frequency = 0;
}

void MEAPI MdtCarWheelSetHingeLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                const MeReal forceLimit) {
    Data *w = dataOf(j, __func__);
    setMotor(w ? &w->rolling : NULL, __func__, desiredVelocity, forceLimit);
}

void MEAPI MdtCarWheelSetSteeringPositionMotor(const MdtCarWheelID j, const MeReal angle, const MeReal frequency,
                                               const MeReal dampingRatio, const MeReal torqueLimit) {
    Data *w = dataOf(j, __func__);
    if (w && mdt_isFinite(__func__, "the angle", angle) &&
        mdt_setServo(__func__, &w->servo, frequency, dampingRatio, torqueLimit))
        w->target = angle;
}

MDT_JOINT_GETTER(CarWheel, SteeringMotorDesiredVelocity, d->steering.velocity)
MDT_JOINT_GETTER(CarWheel, SteeringMotorMaxForce, d->steering.force)
MDT_JOINT_GETTER(CarWheel, HingeMotorDesiredVelocity, d->rolling.velocity)
MDT_JOINT_GETTER(CarWheel, HingeMotorMaxForce, d->rolling.force)
MDT_JOINT_GETTER(CarWheel, SteeringAngle, (MeReal)d->steeringAngle)
MDT_JOINT_GETTER(CarWheel, SteeringAngleRate, mdt_real(d->steeringRate))
MDT_JOINT_GETTER(CarWheel, HingeAngle, (MeReal)d->hingeAngle)
MDT_JOINT_GETTER(CarWheel, HingeAngleRate, mdt_real(d->hingeRate))

/* ---- suspension ---- */

void MEAPI MdtCarWheelSetSuspension(const MdtCarWheelID j, const MeReal Kp, const MeReal Kd,
                                    const MeReal limit_softness, const MeReal lolimit, const MeReal hilimit,
                                    const MeReal reference) {
    Data *w = dataOf(j, __func__);
    if (!w || !mdt_isNotBelow(__func__, "Kp", Kp, 0) || !mdt_isNotBelow(__func__, "Kd", Kd, 0) ||
        !mdt_isNotBelow(__func__, "the softness", limit_softness, 0) ||
        !mdt_isFinite(__func__, "the low limit", lolimit) || !mdt_isFinite(__func__, "the high limit", hilimit) ||
        !mdt_isFinite(__func__, "the reference", reference) ||
        !mdt_isNotBelow(__func__, "the high limit", hilimit, lolimit))
        return;
    w->kp = Kp;
    w->kd = Kd;
    w->softness = limit_softness;
    w->low = lolimit;
    w->high = hilimit;
    w->reference = reference;
}

MDT_JOINT_GETTER(CarWheel, SuspensionKp, d->kp)
MDT_JOINT_GETTER(CarWheel, SuspensionKd, d->kd)
MDT_JOINT_GETTER(CarWheel, SuspensionLimitSoftness, d->softness)
MDT_JOINT_GETTER(CarWheel, SuspensionLowLimit, d->low)
MDT_JOINT_GETTER(CarWheel, SuspensionHighLimit, d->high)
MDT_JOINT_GETTER(CarWheel, SuspensionReference, d->reference)
MDT_JOINT_GETTER(CarWheel, SuspensionHeight, mdt_real(d->height))
MDT_JOINT_GETTER(CarWheel, SuspensionRate, mdt_real(d->heightRate))
