/** @file MdtBSJoint.h
 *  The ball-and-socket joint: a point of one body coincides with a point of the other, and all rotations are free
 *  (Dynamics guide ch. 3, "MdtBSJoint"). It removes three degrees of freedom, with three rows.
 */
#ifndef MDTBSJOINT_H
#define MDTBSJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a joint, disabled, unattached, with its point at the bodies' centres of mass. The world owns it. Returns
 *  null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtBSJointID MEAPI MdtBSJointCreate(const MdtWorldID w);
/** Resets the point to the bodies' centres of mass and the axes to x and y. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtBSJointReset(const MdtBSJointID j);
/** The joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtBSJointQuaConstraint(const MdtBSJointID j);
/** The constraint as a ball-and-socket joint; null if it is none. */
MEPUBLIC MdtBSJointID MEAPI MdtConstraintDCastBSJoint(const MdtConstraintID c);

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
MEPUBLIC void MEAPI MdtBSJointSetPositionMotor(const MdtBSJointID j, const MeReal frequency, const MeReal dampingRatio,
                                               const MeReal torqueLimit);
/** The target: the orientation of the first body's frame in that of the second, a quaternion (w, x, y, z), not zero, by
 *  default (1, 0, 0, 0), at the start of the next step; and its angular velocity [rad/s], in the axes of the second
 *  one, from there on; null: 0. Steps do not change it. */
MEPUBLIC void MEAPI MdtBSJointSetMotorTarget(const MdtBSJointID j, const MeVector4 q, const MeVector3 w);
/** The target orientation, a quaternion (w, x, y, z); (1, 0, 0, 0) if none was set. */
MEPUBLIC void MEAPI MdtBSJointGetMotorTarget(const MdtBSJointID j, MeVector4 q);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtBSJointDestroy(const MdtBSJointID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtBSJointEnable(const MdtBSJointID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtBSJointDisable(const MdtBSJointID j);
/** False for a new one, after MdtBSJointDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtBSJointIsEnabled(const MdtBSJointID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtBSJointSetBodies(const MdtBSJointID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtBSJointGetBody(const MdtBSJointID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtBSJointGetForce(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtBSJointGetForce. */
MEPUBLIC void MEAPI MdtBSJointGetTorque(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtBSJointGetWorld(const MdtBSJointID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtBSJointSetUserData(const MdtBSJointID j, void *data);
/** The pointer of MdtBSJointSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtBSJointGetUserData(const MdtBSJointID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtBSJointSetSortKey(const MdtBSJointID j, const MeI32 key);
/** The key of MdtBSJointSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtBSJointGetSortKey(const MdtBSJointID j);
/** m, world frame: the point where both bodies are attached, fixed in each from now on. Default: their centres of mass.
 *  */
MEPUBLIC void MEAPI MdtBSJointSetPosition(const MdtBSJointID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtBSJointGetPosition(const MdtBSJointID j, MeVector3 position);
/** @} */

ME_END_C

#endif
