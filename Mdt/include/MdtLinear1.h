/** @file MdtLinear1.h The Linear1 joint: a point of the first body stays in a plane of the second (Dynamics guide ch.
 *  3, "MdtLinear1"). It removes one degree of freedom. The plane contains the joint's position, and the joint's axis is
 *  its normal. For a plane of the world, make the body the first.
 */
#ifndef MDTLINEAR1_H
#define MDTLINEAR1_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Linear1 joint, disabled, unattached, at the bodies' centres of mass, the plane's normal the second body's
 *  x-axis. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtLinear1ID MEAPI MdtLinear1Create(const MdtWorldID w);
/** Sets position and axis to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtLinear1Reset(const MdtLinear1ID j);
/** The Linear1 joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtLinear1QuaConstraint(const MdtLinear1ID j);
/** The constraint as a Linear1 joint; null if it is none. */
MEPUBLIC MdtLinear1ID MEAPI MdtConstraintDCastLinear1(const MdtConstraintID c);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtLinear1Destroy(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1Enable(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1Disable(const MdtLinear1ID j);
MEPUBLIC MeBool MEAPI MdtLinear1IsEnabled(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1SetBodies(const MdtLinear1ID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtLinear1GetBody(const MdtLinear1ID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtLinear1GetForce(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtLinear1GetTorque(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtLinear1GetWorld(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1SetUserData(const MdtLinear1ID j, void *data);
MEPUBLIC void *MEAPI MdtLinear1GetUserData(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1SetSortKey(const MdtLinear1ID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtLinear1GetSortKey(const MdtLinear1ID j);
MEPUBLIC void MEAPI MdtLinear1SetPosition(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtLinear1GetPosition(const MdtLinear1ID j, MeVector3 position);
MEPUBLIC void MEAPI MdtLinear1SetAxis(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtLinear1GetAxis(const MdtLinear1ID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
