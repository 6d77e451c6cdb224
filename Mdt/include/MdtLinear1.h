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
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtLinear1Destroy(const MdtLinear1ID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtLinear1Enable(const MdtLinear1ID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtLinear1Disable(const MdtLinear1ID j);
/** False for a new one, after MdtLinear1Disable, and after a break. */
MEPUBLIC MeBool MEAPI MdtLinear1IsEnabled(const MdtLinear1ID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtLinear1SetBodies(const MdtLinear1ID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtLinear1GetBody(const MdtLinear1ID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtLinear1GetForce(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtLinear1GetForce. */
MEPUBLIC void MEAPI MdtLinear1GetTorque(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtLinear1GetWorld(const MdtLinear1ID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtLinear1SetUserData(const MdtLinear1ID j, void *data);
/** The pointer of MdtLinear1SetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtLinear1GetUserData(const MdtLinear1ID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtLinear1SetSortKey(const MdtLinear1ID j, const MeI32 key);
/** The key of MdtLinear1SetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtLinear1GetSortKey(const MdtLinear1ID j);
/** m, world frame: the point of the first body, and a point of the second one's plane. Default: the centres of mass. */
MEPUBLIC void MEAPI MdtLinear1SetPosition(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtLinear1GetPosition(const MdtLinear1ID j, MeVector3 position);
/** World frame, not zero, normalized here: the plane's normal, fixed in the second body from now on. Default: its
 *  x-axis. */
MEPUBLIC void MEAPI MdtLinear1SetAxis(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the axis at present on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtLinear1GetAxis(const MdtLinear1ID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
