/** @file MdtBSJoint.h
 *  The ball-and-socket joint: a point of one body stays on a point of the other, and all rotations are free
 *  (Dynamics guide ch. 3, "MdtBSJoint"). It removes three degrees of freedom: three rows.
 */
#ifndef MDTBSJOINT_H
#define MDTBSJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a joint, disabled, unattached, with its point at the bodies' centres of mass. The world owns it. Returns
 *  null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtBSJointID MEAPI MdtBSJointCreate(const MdtWorldID w);
/** Puts the point back to the bodies' centres of mass and the axes to x and y. Bodies and state stay. */
MEPUBLIC void MEAPI MdtBSJointReset(const MdtBSJointID j);
/** The joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtBSJointQuaConstraint(const MdtBSJointID j);
/** The constraint as a ball-and-socket joint; null when it is none. */
MEPUBLIC MdtBSJointID MEAPI MdtConstraintDCastBSJoint(const MdtConstraintID c);

/** @name What every constraint has, under this joint's name
 *  See MdtConstraint.h for what each does. k is 0 or 1, the index of a body.
 *  @{ */
#define MdtBSJointDestroy(j)              MdtConstraintDestroy(MdtBSJointQuaConstraint(j))
#define MdtBSJointEnable(j)               MdtConstraintEnable(MdtBSJointQuaConstraint(j))
#define MdtBSJointDisable(j)              MdtConstraintDisable(MdtBSJointQuaConstraint(j))
#define MdtBSJointIsEnabled(j)            MdtConstraintIsEnabled(MdtBSJointQuaConstraint(j))
#define MdtBSJointSetBodies(j, b1, b2)    MdtConstraintSetBodies(MdtBSJointQuaConstraint(j), (b1), (b2))
#define MdtBSJointGetBody(j, k)           MdtConstraintGetBody(MdtBSJointQuaConstraint(j), (k))
#define MdtBSJointSetPosition(j, x, y, z) MdtConstraintSetPosition(MdtBSJointQuaConstraint(j), (x), (y), (z))
#define MdtBSJointGetPosition(j, p)       MdtConstraintGetPosition(MdtBSJointQuaConstraint(j), (p))
#define MdtBSJointGetForce(j, k, f)       MdtConstraintGetForce(MdtBSJointQuaConstraint(j), (k), (f))
#define MdtBSJointGetTorque(j, k, t)      MdtConstraintGetTorque(MdtBSJointQuaConstraint(j), (k), (t))
#define MdtBSJointGetWorld(j)             MdtConstraintGetWorld(MdtBSJointQuaConstraint(j))
#define MdtBSJointSetUserData(j, d)       MdtConstraintSetUserData(MdtBSJointQuaConstraint(j), (d))
#define MdtBSJointGetUserData(j)          MdtConstraintGetUserData(MdtBSJointQuaConstraint(j))
#define MdtBSJointSetSortKey(j, key)      MdtConstraintSetSortKey(MdtBSJointQuaConstraint(j), (key))
#define MdtBSJointGetSortKey(j)           MdtConstraintGetSortKey(MdtBSJointQuaConstraint(j))
/** @} */

ME_END_C

#endif
