/* API of the car wheel. The steering axis is the primary axis of frame 0, the hinge axis the second axis of frame 1. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(CarWheel, MdtBclCARWHEEL)

static MdtBclCarWheel *wheelOf(MdtCarWheelID j, const char *caller) {
    MdtJoint *c = mdt_jointOfType(j, MdtBclCARWHEEL, caller);
    return c ? &c->bcl.of.wheel : NULL;
}

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
    MdtBclCarWheel *w = wheelOf(j, __func__);
    if (w)
        w->isLocked = lock != 0;
}

MeBool MEAPI MdtCarWheelIsSteeringLocked(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w && w->isLocked;
}

static void setMotor(MdtBclMotor *motor, const char *caller, MeReal velocity, MeReal force) {
    if (!motor || !mdt_isFinite(caller, "the velocity", velocity) || !mdt_isFinite(caller, "the force limit", force))
        return;
    motor->velocity = velocity;
    motor->force = force > 0 ? force : 0;
}

void MEAPI MdtCarWheelSetSteeringLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                   const MeReal forceLimit) {
    MdtBclCarWheel *w = wheelOf(j, __func__);
    setMotor(w ? &w->steering : NULL, __func__, desiredVelocity, forceLimit);
}

void MEAPI MdtCarWheelSetHingeLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                const MeReal forceLimit) {
    MdtBclCarWheel *w = wheelOf(j, __func__);
    setMotor(w ? &w->rolling : NULL, __func__, desiredVelocity, forceLimit);
}

MeReal MEAPI MdtCarWheelGetSteeringMotorDesiredVelocity(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->steering.velocity : 0;
}

MeReal MEAPI MdtCarWheelGetSteeringMotorMaxForce(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->steering.force : 0;
}

MeReal MEAPI MdtCarWheelGetHingeMotorDesiredVelocity(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->rolling.velocity : 0;
}

MeReal MEAPI MdtCarWheelGetHingeMotorMaxForce(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->rolling.force : 0;
}

MeReal MEAPI MdtCarWheelGetSteeringAngle(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? (MeReal)w->steeringAngle : 0;
}

MeReal MEAPI MdtCarWheelGetSteeringAngleRate(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? mdt_real(w->steeringRate) : 0;
}

MeReal MEAPI MdtCarWheelGetHingeAngle(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? (MeReal)w->hingeAngle : 0;
}

MeReal MEAPI MdtCarWheelGetHingeAngleRate(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? mdt_real(w->hingeRate) : 0;
}

/* ---- suspension ---- */

void MEAPI MdtCarWheelSetSuspension(const MdtCarWheelID j, const MeReal Kp, const MeReal Kd,
                                    const MeReal limit_softness, const MeReal lolimit, const MeReal hilimit,
                                    const MeReal reference) {
    MdtBclCarWheel *w = wheelOf(j, __func__);
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

MeReal MEAPI MdtCarWheelGetSuspensionKp(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->kp : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionKd(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->kd : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionLimitSoftness(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->softness : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionLowLimit(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->low : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionHighLimit(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->high : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionReference(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? w->reference : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionHeight(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? mdt_real(w->height) : 0;
}

MeReal MEAPI MdtCarWheelGetSuspensionRate(const MdtCarWheelID j) {
    const MdtBclCarWheel *w = wheelOf(j, __func__);
    return w ? mdt_real(w->heightRate) : 0;
}
