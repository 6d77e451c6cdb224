/** @file MdtAngular3.h The angular joint: two bodies keep their relative orientation and translate freely (Dynamics
 *  guide ch. 3, "MdtAngular3"). It removes three degrees of freedom; with rotation about its axis enabled it is the
 *  guides' Angular2 and removes two.
 *
 *  It keeps the relative orientation in which the bodies are attached (SetBodies); setting the axis later does not
 *  change that. With a finite stiffness and a finite damping it is an angular spring instead, for instance to keep a
 *  body upright softly.
 */
#ifndef MDTANGULAR3_H
#define MDTANGULAR3_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates an angular joint, disabled, unattached, which aligns the bodies' frames; rigid, rotation not enabled. The
 *  world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtAngular3ID MEAPI MdtAngular3Create(const MdtWorldID w);
/** Aligns the bodies' frames, and resets all else. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtAngular3Reset(const MdtAngular3ID j);
/** The angular joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtAngular3QuaConstraint(const MdtAngular3ID j);
/** The constraint as an angular joint; null if it is none. */
MEPUBLIC MdtAngular3ID MEAPI MdtConstraintDCastAngular3(const MdtConstraintID c);
/** @name Rotation about the axis: off by default
 *  @{ */
/** METRUE: the bodies may rotate about the axis of MdtAngular3SetAxis, which leaves two rows. */
MEPUBLIC void MEAPI MdtAngular3EnableRotation(const MdtAngular3ID j, const MeBool NewRotationState);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtAngular3RotationIsEnabled(const MdtAngular3ID j);
/** @} */
/** @name Stiffness [N m/rad] and damping [N m s/rad] of the constrained rotations, at least 0
 *  Both are MEINFINITY by default. The joint is rigid as long as one of them is.
 *  @{ */
/** N m/rad. A negative number, or one that is not finite but MEINFINITY, gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtAngular3SetStiffness(const MdtAngular3ID j, const MeReal s);
/** N m/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtAngular3GetStiffness(const MdtAngular3ID j);
/** N m s/rad. With a stiffness of 0 the joint only damps. Bad numbers as for the stiffness. */
MEPUBLIC void MEAPI MdtAngular3SetDamping(const MdtAngular3ID j, const MeReal d);
/** N m s/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtAngular3GetDamping(const MdtAngular3ID j);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtAngular3Destroy(const MdtAngular3ID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtAngular3Enable(const MdtAngular3ID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtAngular3Disable(const MdtAngular3ID j);
/** False for a new one, after MdtAngular3Disable, and after a break. */
MEPUBLIC MeBool MEAPI MdtAngular3IsEnabled(const MdtAngular3ID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before: their relative orientation is kept.
 *  */
MEPUBLIC void MEAPI MdtAngular3SetBodies(const MdtAngular3ID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtAngular3GetBody(const MdtAngular3ID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtAngular3GetForce(const MdtAngular3ID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtAngular3GetForce. */
MEPUBLIC void MEAPI MdtAngular3GetTorque(const MdtAngular3ID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtAngular3GetWorld(const MdtAngular3ID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtAngular3SetUserData(const MdtAngular3ID j, void *data);
/** The pointer of MdtAngular3SetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtAngular3GetUserData(const MdtAngular3ID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtAngular3SetSortKey(const MdtAngular3ID j, const MeI32 key);
/** The key of MdtAngular3SetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtAngular3GetSortKey(const MdtAngular3ID j);
/** World frame, not zero, normalized here: the axis of MdtAngular3EnableRotation. The relative orientation to keep does
 *  not change. Default: each body's x-axis. */
MEPUBLIC void MEAPI MdtAngular3SetAxis(const MdtAngular3ID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the axis at present on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtAngular3GetAxis(const MdtAngular3ID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
