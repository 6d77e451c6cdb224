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
/** Unit vector: the present steering axis, which is fixed in the chassis. */
MEPUBLIC void MEAPI MdtCarWheelGetSteeringAxis(const MdtCarWheelID j, MeVector3 v);
/** The wheel's axle, not zero. The steering axis stays; both stay orthogonal. */
MEPUBLIC void MEAPI MdtCarWheelSetHingeAxis(const MdtCarWheelID j, const MeReal xHinge, const MeReal yHinge,
                                            const MeReal zHinge);
/** Unit vector: the present hinge axis, which turns with the steering. */
MEPUBLIC void MEAPI MdtCarWheelGetHingeAxis(const MdtCarWheelID j, MeVector3 v);
/** Steering axis (px, py, pz) and hinge axis (ox, oy, oz) at once; the latter is made orthogonal to the former. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringAndHingeAxes(const MdtCarWheelID j, const MeReal px, const MeReal py,
                                                       const MeReal pz, const MeReal ox, const MeReal oy,
                                                       const MeReal oz);
/** Unit vectors: the present axes on the body of index 0 (chassis) or 1 (wheel). */
MEPUBLIC void MEAPI MdtCarWheelGetSteeringAndHingeAxes(const MdtCarWheelID j, const unsigned int bodyindex,
                                                       MeVector3 primary, MeVector3 ortho);
/** @} */
/** @name Steering: locked, or moved by a motor of limited force
 *  A new wheel's motor holds the steering at rest with up to 1e9 N m. A negative force counts as 0, which leaves it
 *  free.
 *  @{ */
/** METRUE: the steering is locked as rigidly as a joint, at the angle 0. Default MEFALSE. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringLock(const MdtCarWheelID j, const MeBool lock);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtCarWheelIsSteeringLocked(const MdtCarWheelID j);
/** rad/s, N m: turns the steering at a velocity. Ends a position motor. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                            const MeReal forceLimit);
/** Beyond Karma: holds the steering at an angle [rad], as MdtCarWheelGetSteeringAngle returns it, in place of a motor
 *  of a velocity: as MdtLimitSetPositionMotor (MdtLimit.h), with a frequency [Hz], damping ratio and largest torque
 *  [N m]. The mass is the moment of inertia of wheel and chassis about the steering axis; against friction at the
 *  ground 20 Hz and more hold a wheel. A frequency of 0 gives the steering back to the motor of a velocity. */
MEPUBLIC void MEAPI MdtCarWheelSetSteeringPositionMotor(const MdtCarWheelID j, const MeReal angle,
                                                        const MeReal frequency, const MeReal dampingRatio,
                                                        const MeReal torqueLimit);
/** rad/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringMotorDesiredVelocity(const MdtCarWheelID j);
/** N m, of the motor of a velocity; 1e9 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringMotorMaxForce(const MdtCarWheelID j);
/** rad and rad/s, after the last step. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringAngle(const MdtCarWheelID j);
/** rad/s; 0 before the first step. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSteeringAngleRate(const MdtCarWheelID j);
/** @} */
/** @name Rolling: a motor of limited force, off by default; with the velocity 0 it is a brake
 *  @{ */
/** rad/s of the wheel relative to the chassis, positive about the hinge axis, and N m. A negative torque counts as 0.
 *  */
MEPUBLIC void MEAPI MdtCarWheelSetHingeLimitedForceMotor(const MdtCarWheelID j, const MeReal desiredVelocity,
                                                         const MeReal forceLimit);
/** rad/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetHingeMotorDesiredVelocity(const MdtCarWheelID j);
/** N m; 0, the default: no motor. */
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
/** N/m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionKp(const MdtCarWheelID j);
/** N s/m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionKd(const MdtCarWheelID j);
/** 1/kg; 0, the default: hard stops. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionLimitSoftness(const MdtCarWheelID j);
/** m: the lowest height; -1e9 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionLowLimit(const MdtCarWheelID j);
/** m: the greatest height; 1e9 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionHighLimit(const MdtCarWheelID j);
/** m: the height at which the spring has no force; 0 by default. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionReference(const MdtCarWheelID j);
/** m and m/s, after the last step. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionHeight(const MdtCarWheelID j);
/** m/s: the rate of the height, positive upwards along the steering axis. */
MEPUBLIC MeReal MEAPI MdtCarWheelGetSuspensionRate(const MdtCarWheelID j);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtCarWheelDestroy(const MdtCarWheelID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtCarWheelEnable(const MdtCarWheelID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtCarWheelDisable(const MdtCarWheelID j);
/** False for a new one, after MdtCarWheelDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtCarWheelIsEnabled(const MdtCarWheelID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtCarWheelSetBodies(const MdtCarWheelID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtCarWheelGetBody(const MdtCarWheelID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtCarWheelGetForce(const MdtCarWheelID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtCarWheelGetForce. */
MEPUBLIC void MEAPI MdtCarWheelGetTorque(const MdtCarWheelID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtCarWheelGetWorld(const MdtCarWheelID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtCarWheelSetUserData(const MdtCarWheelID j, void *data);
/** The pointer of MdtCarWheelSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtCarWheelGetUserData(const MdtCarWheelID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtCarWheelSetSortKey(const MdtCarWheelID j, const MeI32 key);
/** The key of MdtCarWheelSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtCarWheelGetSortKey(const MdtCarWheelID j);
/** m, world frame: the wheel's centre, from which the suspension's height counts. Default: both centres of mass. */
MEPUBLIC void MEAPI MdtCarWheelSetPosition(const MdtCarWheelID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: that point's present place in the chassis; in the wheel, if the chassis is the world. */
MEPUBLIC void MEAPI MdtCarWheelGetPosition(const MdtCarWheelID j, MeVector3 position);
/** @} */

ME_END_C

#endif
