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
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtPrismaticDestroy(const MdtPrismaticID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtPrismaticEnable(const MdtPrismaticID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtPrismaticDisable(const MdtPrismaticID j);
/** False for a new one, after MdtPrismaticDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtPrismaticIsEnabled(const MdtPrismaticID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtPrismaticSetBodies(const MdtPrismaticID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtPrismaticGetBody(const MdtPrismaticID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtPrismaticGetForce(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtPrismaticGetForce. */
MEPUBLIC void MEAPI MdtPrismaticGetTorque(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtPrismaticGetWorld(const MdtPrismaticID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtPrismaticSetUserData(const MdtPrismaticID j, void *data);
/** The pointer of MdtPrismaticSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtPrismaticGetUserData(const MdtPrismaticID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtPrismaticSetSortKey(const MdtPrismaticID j, const MeI32 key);
/** The key of MdtPrismaticSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtPrismaticGetSortKey(const MdtPrismaticID j);
/** World frame, not zero, normalized here: the axis, fixed in both bodies from now on; their pose becomes the
 *  displacement 0. Default: each body's x-axis. */
MEPUBLIC void MEAPI MdtPrismaticSetAxis(const MdtPrismaticID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the axis at present on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtPrismaticGetAxis(const MdtPrismaticID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
