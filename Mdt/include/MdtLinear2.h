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
MEPUBLIC void MEAPI MdtLinear2GetDirection(const MdtLinear2ID j, MeVector3 direction);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtLinear2Destroy(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2Enable(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2Disable(const MdtLinear2ID j);
MEPUBLIC MeBool MEAPI MdtLinear2IsEnabled(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2SetBodies(const MdtLinear2ID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtLinear2GetBody(const MdtLinear2ID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtLinear2GetForce(const MdtLinear2ID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtLinear2GetTorque(const MdtLinear2ID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtLinear2GetWorld(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2SetUserData(const MdtLinear2ID j, void *data);
MEPUBLIC void *MEAPI MdtLinear2GetUserData(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2SetSortKey(const MdtLinear2ID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtLinear2GetSortKey(const MdtLinear2ID j);
MEPUBLIC void MEAPI MdtLinear2SetPosition(const MdtLinear2ID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtLinear2GetPosition(const MdtLinear2ID j, MeVector3 position);
/** @} */

ME_END_C

#endif
