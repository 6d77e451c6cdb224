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

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(BSJoint)
MDT_JOINT_POSITION(BSJoint)

ME_END_C

#endif
