/** @file MdtLinear2.h The Linear2 joint: a point of the first body stays on a line of the second (Dynamics guide ch. 3,
 *  "MdtLinear2"). It removes two degrees of freedom. The line goes through the joint's position. For a line of the
 *  world, make the body the first.
 */
#ifndef MDTLINEAR2_H
#define MDTLINEAR2_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Linear2 joint, disabled, unattached, at the bodies' centres of mass, the line along the second body's
 *  x-axis. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtLinear2ID MEAPI MdtLinear2Create(const MdtWorldID w);
/** Sets position and direction to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtLinear2Reset(const MdtLinear2ID j);
/** The Linear2 joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtLinear2QuaConstraint(const MdtLinear2ID j);
/** The constraint as a Linear2 joint; null if it is none. */
MEPUBLIC MdtLinear2ID MEAPI MdtConstraintDCastLinear2(const MdtConstraintID c);
/** The direction of the line, world frame. Bad input as in MdtConstraintSetAxis. */
MEPUBLIC void MEAPI MdtLinear2SetDirection(const MdtLinear2ID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the line's present direction in the second body. */
MEPUBLIC void MEAPI MdtLinear2GetDirection(const MdtLinear2ID j, MeVector3 direction);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtLinear2Destroy(const MdtLinear2ID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtLinear2Enable(const MdtLinear2ID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtLinear2Disable(const MdtLinear2ID j);
/** False for a new one, after MdtLinear2Disable, and after a break. */
MEPUBLIC MeBool MEAPI MdtLinear2IsEnabled(const MdtLinear2ID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtLinear2SetBodies(const MdtLinear2ID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtLinear2GetBody(const MdtLinear2ID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtLinear2GetForce(const MdtLinear2ID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtLinear2GetForce. */
MEPUBLIC void MEAPI MdtLinear2GetTorque(const MdtLinear2ID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtLinear2GetWorld(const MdtLinear2ID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtLinear2SetUserData(const MdtLinear2ID j, void *data);
/** The pointer of MdtLinear2SetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtLinear2GetUserData(const MdtLinear2ID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtLinear2SetSortKey(const MdtLinear2ID j, const MeI32 key);
/** The key of MdtLinear2SetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtLinear2GetSortKey(const MdtLinear2ID j);
/** m, world frame: the point of the first body, and a point of the second one's line. Default: the centres of mass. */
MEPUBLIC void MEAPI MdtLinear2SetPosition(const MdtLinear2ID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtLinear2GetPosition(const MdtLinear2ID j, MeVector3 position);
/** @} */

ME_END_C

#endif
