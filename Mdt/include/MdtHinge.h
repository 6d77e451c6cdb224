/** @file MdtHinge.h
 *  The hinge: two bodies rotate about a common axis, with stops and a motor (Dynamics guide ch. 3, "MdtHinge").
 *
 *  It removes five degrees of freedom. A running motor, and each stop in contact, adds a row. The angle is that of the
 *  first body relative to the second, positive about the axis by the right-hand rule, zero in the pose in which the
 *  axis was set. It includes full turns, so that stops may lie beyond half a turn. Stops, motor and angle are in the
 *  joint's limit (MdtLimit.h); the angle is measured while the limit is active or powered, or if
 *  MdtLimitCalculatePosition asks for it.
 */
#ifndef MDTHINGE_H
#define MDTHINGE_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a hinge, disabled, unattached, at the bodies' centres of mass, its axis the x-axis of each, its limit at
 *  default. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtHingeID MEAPI MdtHingeCreate(const MdtWorldID w);
/** Sets position, axes and limit to the defaults of a new hinge. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtHingeReset(const MdtHingeID j);
/** The hinge as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtHingeQuaConstraint(const MdtHingeID j);
/** The constraint as a hinge; null if it is none. */
MEPUBLIC MdtHingeID MEAPI MdtConstraintDCastHinge(const MdtConstraintID c);
/** Pointer to the hinge's limit, for reading and writing; valid as long as the hinge. */
MEPUBLIC MdtLimitID MEAPI MdtHingeGetLimit(const MdtHingeID j);
/** Resets the hinge's limit, then copies stops, threshold, offset, motor and switches of @a NewLimit. */
MEPUBLIC void MEAPI MdtHingeSetLimit(const MdtHingeID j, const MdtLimitID NewLimit);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtHingeDestroy(const MdtHingeID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtHingeEnable(const MdtHingeID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtHingeDisable(const MdtHingeID j);
/** False for a new one, after MdtHingeDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtHingeIsEnabled(const MdtHingeID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtHingeSetBodies(const MdtHingeID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtHingeGetBody(const MdtHingeID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtHingeGetForce(const MdtHingeID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtHingeGetForce. */
MEPUBLIC void MEAPI MdtHingeGetTorque(const MdtHingeID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtHingeGetWorld(const MdtHingeID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtHingeSetUserData(const MdtHingeID j, void *data);
/** The pointer of MdtHingeSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtHingeGetUserData(const MdtHingeID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtHingeSetSortKey(const MdtHingeID j, const MeI32 key);
/** The key of MdtHingeSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtHingeGetSortKey(const MdtHingeID j);
/** m, world frame: the point where both bodies are attached, fixed in each from now on. Default: their centres of mass.
 *  */
MEPUBLIC void MEAPI MdtHingeSetPosition(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtHingeGetPosition(const MdtHingeID j, MeVector3 position);
/** World frame, not zero, normalized here: the axis, fixed in both bodies from now on; their pose becomes the angle 0.
 *  Default: each body's x-axis. */
MEPUBLIC void MEAPI MdtHingeSetAxis(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the axis at present on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtHingeGetAxis(const MdtHingeID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
