/** @file MdtFPFOJoint.h The FPFO joint, fixed position and fixed orientation, rigidly connects two bodies (Dynamics
 *  guide ch. 3, "MdtFPFOJoint"). It removes six degrees of freedom. The guide deprecates it: one body with both shapes
 *  is cheaper, and MdtRPROJoint is more general. The bodies keep the relative pose in which they are attached
 *  (SetBodies).
 */
#ifndef MDTFPFOJOINT_H
#define MDTFPFOJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates an FPFO joint, disabled, unattached, which makes the bodies' frames coincide. The world owns it. Returns
 *  null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtFPFOJointID MEAPI MdtFPFOJointCreate(const MdtWorldID w);
/** Resets the relative pose that the joint holds: the bodies' frames coincide, as before SetBodies. Bodies and enabled
 *  state do not change. */
MEPUBLIC void MEAPI MdtFPFOJointReset(const MdtFPFOJointID j);
/** The FPFO joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtFPFOJointQuaConstraint(const MdtFPFOJointID j);
/** The constraint as an FPFO joint; null if it is none. */
MEPUBLIC MdtFPFOJointID MEAPI MdtConstraintDCastFPFOJoint(const MdtConstraintID c);
/** The point, world frame, at which the joint transmits forces. */
MEPUBLIC void MEAPI MdtFPFOJointSetPosition(const MdtFPFOJointID j, const MeReal x, const MeReal y, const MeReal z);
/** The present point on the body of index 0 or 1, world frame. */
MEPUBLIC void MEAPI MdtFPFOJointGetPosition(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 pos);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtFPFOJointDestroy(const MdtFPFOJointID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtFPFOJointEnable(const MdtFPFOJointID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtFPFOJointDisable(const MdtFPFOJointID j);
/** False for a new one, after MdtFPFOJointDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtFPFOJointIsEnabled(const MdtFPFOJointID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before: their relative pose is kept. */
MEPUBLIC void MEAPI MdtFPFOJointSetBodies(const MdtFPFOJointID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtFPFOJointGetBody(const MdtFPFOJointID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtFPFOJointGetForce(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtFPFOJointGetForce. */
MEPUBLIC void MEAPI MdtFPFOJointGetTorque(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtFPFOJointGetWorld(const MdtFPFOJointID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtFPFOJointSetUserData(const MdtFPFOJointID j, void *data);
/** The pointer of MdtFPFOJointSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtFPFOJointGetUserData(const MdtFPFOJointID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtFPFOJointSetSortKey(const MdtFPFOJointID j, const MeI32 key);
/** The key of MdtFPFOJointSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtFPFOJointGetSortKey(const MdtFPFOJointID j);
/** @} */

ME_END_C

#endif
