/** @file MdtBSJoint.h
 *  The ball-and-socket joint: a point of one body coincides with a point of the other, and all rotations are free
 *  (Dynamics guide ch. 3, "MdtBSJoint"). It removes three degrees of freedom, with three rows.
 */
#ifndef MDTBSJOINT_H
#define MDTBSJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a joint, disabled, unattached, with its point at the bodies' centres of mass. The world owns it. Returns
 *  null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtBSJointID MEAPI MdtBSJointCreate(const MdtWorldID w);
/** Resets the point to the bodies' centres of mass and the axes to x and y. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtBSJointReset(const MdtBSJointID j);
/** The joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtBSJointQuaConstraint(const MdtBSJointID j);
/** The constraint as a ball-and-socket joint; null if it is none. */
MEPUBLIC MdtBSJointID MEAPI MdtConstraintDCastBSJoint(const MdtConstraintID c);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
MEPUBLIC void MEAPI MdtBSJointDestroy(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointEnable(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointDisable(const MdtBSJointID j);
MEPUBLIC MeBool MEAPI MdtBSJointIsEnabled(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointSetBodies(const MdtBSJointID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtBSJointGetBody(const MdtBSJointID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtBSJointGetForce(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtBSJointGetTorque(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtBSJointGetWorld(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointSetUserData(const MdtBSJointID j, void *data);
MEPUBLIC void *MEAPI MdtBSJointGetUserData(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointSetSortKey(const MdtBSJointID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtBSJointGetSortKey(const MdtBSJointID j);
MEPUBLIC void MEAPI MdtBSJointSetPosition(const MdtBSJointID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtBSJointGetPosition(const MdtBSJointID j, MeVector3 position);
/** @} */

ME_END_C

#endif
