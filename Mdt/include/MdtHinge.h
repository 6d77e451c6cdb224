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
MEPUBLIC void MEAPI MdtHingeDestroy(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeEnable(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeDisable(const MdtHingeID j);
MEPUBLIC MeBool MEAPI MdtHingeIsEnabled(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeSetBodies(const MdtHingeID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtHingeGetBody(const MdtHingeID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtHingeGetForce(const MdtHingeID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtHingeGetTorque(const MdtHingeID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtHingeGetWorld(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeSetUserData(const MdtHingeID j, void *data);
MEPUBLIC void *MEAPI MdtHingeGetUserData(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeSetSortKey(const MdtHingeID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtHingeGetSortKey(const MdtHingeID j);
MEPUBLIC void MEAPI MdtHingeSetPosition(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtHingeGetPosition(const MdtHingeID j, MeVector3 position);
MEPUBLIC void MEAPI MdtHingeSetAxis(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtHingeGetAxis(const MdtHingeID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
