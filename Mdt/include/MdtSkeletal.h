/** @file MdtSkeletal.h
 *  The skeletal joint: a ball-and-socket joint whose swing and twist are limited.
 *
 *  The first body's primary axis swings inside an elliptical cone around the second body's primary axis: up to the
 *  primary angle towards the second axis, up to the secondary angle towards the third. The twist is the remaining
 *  rotation: zero if swinging alone, along a great circle, has moved the axis to its place. The joint removes three
 *  degrees of freedom; each limit in contact adds a row.
 */
#ifndef MDTSKELETAL_H
#define MDTSKELETAL_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a skeletal joint, disabled, unattached, at the bodies' centres of mass, about their x-axes, with limits of
 *  pi/4. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is
 *  full. */
MEPUBLIC MdtSkeletalID MEAPI MdtSkeletalCreate(const MdtWorldID w);
/** Sets frame, limits and options to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtSkeletalReset(const MdtSkeletalID j);
/** The skeletal joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtSkeletalQuaConstraint(const MdtSkeletalID j);
/** The constraint as a skeletal joint; null if it is none. */
MEPUBLIC MdtSkeletalID MEAPI MdtConstraintDCastSkeletal(const MdtConstraintID c);
/** @name Limit angles, rad, 0 to pi (clamped), default pi/4
 *  The first axis stays within an elliptic cone about the second body's; the twist about it within +- its limit.
 *  @{ */
/** The cone's half angle towards the second axis of the joint. */
MEPUBLIC void MEAPI MdtSkeletalSetConePrimaryLimitAngle(const MdtSkeletalID j, const MeReal theta);
/** rad; pi/4 by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetConePrimaryLimitAngle(const MdtSkeletalID j);
/** The cone's half angle towards the third axis, primary x second. */
MEPUBLIC void MEAPI MdtSkeletalSetConeSecondaryLimitAngle(const MdtSkeletalID j, const MeReal theta);
/** rad; pi/4 by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeSecondaryLimitAngle(const MdtSkeletalID j);
/** The largest twist in either direction. */
MEPUBLIC void MEAPI MdtSkeletalSetTwistLimitAngle(const MdtSkeletalID j, const MeReal theta);
/** rad; pi/4 by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistLimitAngle(const MdtSkeletalID j);
/** @} */
/** @name Stiffness [N m/rad] and damping [N m s/rad] beyond the limits, at least 0
 *  All are MEINFINITY by default. A limit is hard, without rebound, as long as one of its two is.
 *  @{ */
/** N m/rad beyond the cone. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtSkeletalSetConeStiffness(const MdtSkeletalID j, const MeReal kp);
/** N m/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeStiffness(const MdtSkeletalID j);
/** N m s/rad beyond the cone. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtSkeletalSetConeDamping(const MdtSkeletalID j, const MeReal kd);
/** N m s/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeDamping(const MdtSkeletalID j);
/** N m/rad beyond the twist limit. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtSkeletalSetTwistStiffness(const MdtSkeletalID j, const MeReal kp);
/** N m/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistStiffness(const MdtSkeletalID j);
/** N m s/rad beyond the twist limit. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtSkeletalSetTwistDamping(const MdtSkeletalID j, const MeReal kd);
/** N m s/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistDamping(const MdtSkeletalID j);
/** @} */
/** @name Options of swing and twist (MdtBcl.h); an invalid value gets a warning and changes nothing
 *  @{ */
/** MdtSkeletalConeOptionFree, Slot (swings in the primary plane only), Cone, or Fixed (no swing). */
MEPUBLIC void MEAPI MdtSkeletalSetConeOption(const MdtSkeletalID j, MdtSkeletalConeOption co);
/** MdtSkeletalConeOptionCone by default. */
MEPUBLIC MdtSkeletalConeOption MEAPI MdtSkeletalGetConeOption(const MdtSkeletalID j);
/** MdtSkeletalTwistOptionFree, Limited, or Fixed (no twist). */
MEPUBLIC void MEAPI MdtSkeletalSetTwistOption(const MdtSkeletalID j, MdtSkeletalTwistOption to);
/** MdtSkeletalTwistOptionLimited by default. */
MEPUBLIC MdtSkeletalTwistOption MEAPI MdtSkeletalGetTwistOption(const MdtSkeletalID j);
/** @} */
/** Makes the present twist of the bodies the zero of the twist. */
MEPUBLIC void MEAPI MdtSkeletalZeroTwist(const MdtSkeletalID j);
/** As MdtConstraintBodyGetAxis. */
MEPUBLIC void MEAPI MdtSkeletalBodyGetAxis(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 axis);

/** @name A position motor of the relative orientation, beyond Karma
 *  A damped spring to a target, as MdtLimitSetPositionMotor (MdtLimit.h) is for an angle: implicit, stable at any
 *  frequency and step. The joint turns to its target as an oscillator of the frequency and damping ratio, from any
 *  orientation and about any axis, whatever the shape of its bodies: the torque is the effective inertia, a tensor,
 *  times what the oscillator's law demands. Effective is the inertia that the two bodies show about the joint,
 *  without other joints of theirs. Beyond half a turn from its target the motor turns the shorter way.
 *  @{ */
/** Switches the motor on: @a frequency [Hz] of the undamped oscillation, @a dampingRatio (1: critically damped), with
 *  at most @a torqueLimit [N m] (MEINFINITY: any) about each principal axis of the effective inertia. A frequency or
 *  torque limit of 0, the default, switches it off. A negative number gets a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtSkeletalSetPositionMotor(const MdtSkeletalID j, const MeReal frequency,
                                                const MeReal dampingRatio, const MeReal torqueLimit);
/** The target: the orientation of the first axes in that of the second, a quaternion (w, x, y, z), not zero, by
 *  default (1, 0, 0, 0), at the start of the next step; and its angular velocity [rad/s], in the axes of the second
 *  one, from there on; null: 0. Steps do not change it. */
MEPUBLIC void MEAPI MdtSkeletalSetMotorTarget(const MdtSkeletalID j, const MeVector4 q, const MeVector3 w);
/** The target orientation, a quaternion (w, x, y, z); (1, 0, 0, 0) if none was set. */
MEPUBLIC void MEAPI MdtSkeletalGetMotorTarget(const MdtSkeletalID j, MeVector4 q);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtSkeletalDestroy(const MdtSkeletalID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtSkeletalEnable(const MdtSkeletalID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtSkeletalDisable(const MdtSkeletalID j);
/** False for a new one, after MdtSkeletalDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtSkeletalIsEnabled(const MdtSkeletalID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtSkeletalSetBodies(const MdtSkeletalID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtSkeletalGetBody(const MdtSkeletalID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtSkeletalGetForce(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtSkeletalGetForce. */
MEPUBLIC void MEAPI MdtSkeletalGetTorque(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtSkeletalGetWorld(const MdtSkeletalID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtSkeletalSetUserData(const MdtSkeletalID j, void *data);
/** The pointer of MdtSkeletalSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtSkeletalGetUserData(const MdtSkeletalID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtSkeletalSetSortKey(const MdtSkeletalID j, const MeI32 key);
/** The key of MdtSkeletalSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtSkeletalGetSortKey(const MdtSkeletalID j);
/** m, world frame: the point where both bodies are attached, fixed in each from now on. Default: their centres of mass.
 *  */
MEPUBLIC void MEAPI MdtSkeletalSetPosition(const MdtSkeletalID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtSkeletalGetPosition(const MdtSkeletalID j, MeVector3 position);
/** World frame: primary axis (px, py, pz) and second axis of both bodies, in the pose without swing and twist. They are
 *  normalized, the second one is made orthogonal; parallel ones get a warning and change nothing. */
MEPUBLIC void MEAPI MdtSkeletalSetAxes(const MdtSkeletalID j, const MeReal px, const MeReal py, const MeReal pz,
                                       const MeReal ox, const MeReal oy, const MeReal oz);
/** The same for the body of index 0 or 1 alone: so the cone's axis may lean off the first body's. */
MEPUBLIC void MEAPI MdtSkeletalBodySetAxes(const MdtSkeletalID j, const unsigned int bodyindex, const MeReal px,
                                           const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                           const MeReal oz);
/** Unit vectors, world frame: the present axes of the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtSkeletalBodyGetAxes(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 primary,
                                           MeVector3 ortho);
/** @} */

ME_END_C

#endif
