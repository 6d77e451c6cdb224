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
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtBSJointDestroy(const MdtBSJointID j) {
    MdtConstraintDestroy(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointEnable(const MdtBSJointID j) {
    MdtConstraintEnable(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointDisable(const MdtBSJointID j) {
    MdtConstraintDisable(MdtBSJointQuaConstraint(j));
}
static inline MeBool MdtBSJointIsEnabled(const MdtBSJointID j) {
    return MdtConstraintIsEnabled(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointSetBodies(const MdtBSJointID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtBSJointQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtBSJointGetBody(const MdtBSJointID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtBSJointQuaConstraint(j), bodyindex);
}
static inline void MdtBSJointGetForce(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtBSJointQuaConstraint(j), bodyindex, force);
}
static inline void MdtBSJointGetTorque(const MdtBSJointID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtBSJointQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtBSJointGetWorld(const MdtBSJointID j) {
    return MdtConstraintGetWorld(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointSetUserData(const MdtBSJointID j, void *data) {
    MdtConstraintSetUserData(MdtBSJointQuaConstraint(j), data);
}
static inline void *MdtBSJointGetUserData(const MdtBSJointID j) {
    return MdtConstraintGetUserData(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointSetSortKey(const MdtBSJointID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtBSJointQuaConstraint(j), key);
}
static inline MeI32 MdtBSJointGetSortKey(const MdtBSJointID j) {
    return MdtConstraintGetSortKey(MdtBSJointQuaConstraint(j));
}
static inline void MdtBSJointSetPosition(const MdtBSJointID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetPosition(MdtBSJointQuaConstraint(j), x, y, z);
}
static inline void MdtBSJointGetPosition(const MdtBSJointID j, MeVector3 position) {
    MdtConstraintGetPosition(MdtBSJointQuaConstraint(j), position);
}
/** @} */

ME_END_C

#endif
