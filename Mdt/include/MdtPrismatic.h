/** @file MdtPrismatic.h
 *  The prismatic joint, or slider: two bodies slide along a common axis without relative rotation (Dynamics guide ch.
 *  3, "MdtPrismatic"). It removes five degrees of freedom; a running motor, and each stop in contact, adds a row.
 *
 *  Place the bodies, attach them, set the axis: that pose has displacement zero, and its relative orientation is kept.
 *  The displacement, m, is that of the first body relative to the second along the axis. Stops, motor and the
 *  displacement are in the joint's limit (MdtLimit.h). There is no position to set.
 */
#ifndef MDTPRISMATIC_H
#define MDTPRISMATIC_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a prismatic joint, disabled, unattached, its axis the x-axis of the bodies, its limit at default. The world
 *  owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtPrismaticID MEAPI MdtPrismaticCreate(const MdtWorldID w);
/** Sets axes and limit to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtPrismaticReset(const MdtPrismaticID j);
/** The prismatic joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtPrismaticQuaConstraint(const MdtPrismaticID j);
/** The constraint as a prismatic joint; null if it is none. */
MEPUBLIC MdtPrismaticID MEAPI MdtConstraintDCastPrismatic(const MdtConstraintID c);
/** Pointer to the joint's limit, for reading and writing; valid as long as the joint. */
MEPUBLIC MdtLimitID MEAPI MdtPrismaticGetLimit(const MdtPrismaticID j);
/** Resets the joint's limit, then copies stops, threshold, offset, motor and switches of @a NewLimit. */
MEPUBLIC void MEAPI MdtPrismaticSetLimit(const MdtPrismaticID j, const MdtLimitID NewLimit);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtPrismaticDestroy(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticEnable(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticDisable(const MdtPrismaticID j);
MEPUBLIC MeBool MEAPI MdtPrismaticIsEnabled(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticSetBodies(const MdtPrismaticID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtPrismaticGetBody(const MdtPrismaticID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtPrismaticGetForce(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtPrismaticGetTorque(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtPrismaticGetWorld(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticSetUserData(const MdtPrismaticID j, void *data);
MEPUBLIC void *MEAPI MdtPrismaticGetUserData(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticSetSortKey(const MdtPrismaticID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtPrismaticGetSortKey(const MdtPrismaticID j);
MEPUBLIC void MEAPI MdtPrismaticSetAxis(const MdtPrismaticID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtPrismaticGetAxis(const MdtPrismaticID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
