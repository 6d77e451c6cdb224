/** @file MdtCarWheel.h
 *  The car wheel: a wheel with rolling, steering and suspension under a chassis (Dynamics guide ch. 3, "MdtCarWheel";
 *  User Guide ch. 3, "The Car Wheel Constraint"). The chassis is the first body, the wheel the second.
 *
 *  The steering axis, fixed in the chassis, is also the axis of the suspension; the hinge axis, fixed in the wheel,
 *  stays orthogonal to it. The wheel's centre slides along the steering axis through the joint's position. Four
 *  degrees of freedom are left with free steering, three if it is locked. Set the bodies, then the position (the
 *  wheel's centre), then the axes, in the pose for driving straight ahead.
 *
 *  Heights are those of the wheel along the steering axis, from the joint's position in the chassis. Motors act between
 *  wheel and chassis. The steering angle is defined as a hinge's: the first body relative to the second.
 */
#ifndef MDTCARWHEEL_H
#define MDTCARWHEEL_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a car wheel, disabled, unattached, its steering axis the chassis' z, its hinge axis the wheel's y. The world
 *  owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtCarWheelID MEAPI MdtCarWheelCreate(const MdtWorldID w);
/** Sets position, axes, motors and suspension to the defaults of a new joint. Bodies and enabled state do not change.
 *  */
MEPUBLIC void MEAPI MdtCarWheelReset(const MdtCarWheelID j);
/** The car wheel as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtCarWheelQuaConstraint(const MdtCarWheelID j);
/** The constraint as a car wheel; null if it is none. */
MEPUBLIC MdtCarWheelID MEAPI MdtConstraintDCastCarWheel(const MdtConstraintID c);
/** @name Axes in the world frame. The setters normalize them; for bad input see MdtConstraint.h
 *  @{ */
/** Set both axes while the wheel stands straight: the hinge axis is made orthogonal to the steering axis. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringAxis(const MdtCarWheelID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtCarWheelGetSteeringAxis(const MdtCarWheelID j, MeVector3 v);
MEPUBLIC void MEAPI MdtCarWheelSetHingeAxis(const MdtCarWheelID j, const MeReal xHinge, const MeReal yHinge,
                                            const MeReal zHinge);
MEPUBLIC void MEAPI MdtCarWheelGetHingeAxis(const MdtCarWheelID j, MeVector3 v);
MEPUBLIC void MEAPI MdtCarWheelSetSteeringAndHingeAxes(const MdtCarWheelID j, const MeReal px, const MeReal py,
                                                       const MeReal pz, const MeReal ox, const MeReal oy,
                                                       const MeReal oz);
MEPUBLIC void MEAPI MdtCarWheelGetSteeringAndHingeAxes(const MdtCarWheelID j, const unsigned int bodyindex,
                                                       MeVector3 primary, MeVector3 ortho);
/** @} */
/** @name Steering: locked, or moved by a motor of limited force
 *  A new wheel's motor holds the steering at rest with up to 1e9 N m. A negative force counts as 0, which leaves it
 *  free.
 *  @{ */
/** METRUE: the steering is held as rigidly as a joint, at the angle 0. Default MEFALSE. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringLock(const MdtCarWheelID j, const MeBool lock);
MEPUBLIC MeBool MEAPI MdtCarWheelIsSteeringLocked(const MdtCarWheelID j);
/** rad/s, N m: turns the steering at a velocity. Ends a position motor. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                            const MeReal forceLimit);
/** Beyond Karma: holds the steering at an angle [rad], as MdtCarWheelGetSteeringAngle tells it, in place of a motor
 *  of a velocity: as MdtLimitSetPositionMotor (MdtLimit.h), with a frequency [Hz], damping ratio and largest torque
 *  [N m]. The mass is the moment of inertia of wheel and chassis about the steering axis; against friction at the
 *  ground 20 Hz and more hold a wheel. A frequency of 0 gives the steering back to the motor of a velocity. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringPositionMotor(const MdtCarWheelID j, const MeReal angle,
                                                        const MeReal frequency, const MeReal dampingRatio,
                                                        const MeReal torqueLimit);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringMotorDesiredVelocity(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringMotorMaxForce(const MdtCarWheelID j);
/** rad and rad/s, after the last step. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringAngle(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringAngleRate(const MdtCarWheelID j);
/** @} */
/** @name Rolling: a motor of limited force, off by default; with the velocity 0 it is a brake
 *  @{ */
/** rad/s of the wheel relative to the chassis, positive about the hinge axis, and N m. A negative torque counts as 0.
 *  */
MEPUBLIC void MEAPI MdtCarWheelSetHingeLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                         const MeReal forceLimit);
MEPUBLIC MeReal MEAPI MdtCarWheelGetHingeMotorDesiredVelocity(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetHingeMotorMaxForce(const MdtCarWheelID j);
/** Between 0 and pi, after the last step: the angle of the wheel from its pose when the axes were set. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetHingeAngle(const MdtCarWheelID j);
/** rad/s, of the wheel relative to the chassis. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetHingeAngleRate(const MdtCarWheelID j);
/** @} */
/** @name Suspension: a damped spring, F = -Kp (height - reference) - Kd rate on the wheel, between two stops
 *  Kp in N/m and Kd in N s/m, at least 0. The stops are hard if @a limit_softness [1/kg] is 0; otherwise it is added to
 *  the world's epsilon at the stops. A low limit above the high one gets a warning, and nothing is changed.
 *  @{ */
/** @a lolimit, @a hilimit, @a reference: heights of the wheel, m. New wheels have Kp = Kd = 0: set a spring. */
MEPUBLIC void MEAPI MdtCarWheelSetSuspension(const MdtCarWheelID j, const MeReal Kp, const MeReal Kd,
                                             const MeReal limit_softness, const MeReal lolimit, const MeReal hilimit,
                                             const MeReal reference);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionKp(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionKd(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionLimitSoftness(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionLowLimit(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionHighLimit(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionReference(const MdtCarWheelID j);
/** m and m/s, after the last step. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionHeight(const MdtCarWheelID j);
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionRate(const MdtCarWheelID j);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtCarWheelDestroy(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelEnable(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelDisable(const MdtCarWheelID j);
MEPUBLIC MeBool MEAPI MdtCarWheelIsEnabled(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelSetBodies(const MdtCarWheelID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtCarWheelGetBody(const MdtCarWheelID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtCarWheelGetForce(const MdtCarWheelID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtCarWheelGetTorque(const MdtCarWheelID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtCarWheelGetWorld(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelSetUserData(const MdtCarWheelID j, void *data);
MEPUBLIC void *MEAPI MdtCarWheelGetUserData(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelSetSortKey(const MdtCarWheelID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtCarWheelGetSortKey(const MdtCarWheelID j);
MEPUBLIC void MEAPI MdtCarWheelSetPosition(const MdtCarWheelID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtCarWheelGetPosition(const MdtCarWheelID j, MeVector3 position);
/** @} */

ME_END_C

#endif
