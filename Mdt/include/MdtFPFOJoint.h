/** @file MdtFPFOJoint.h The FPFO joint, fixed position and fixed orientation: two bodies become one (Dynamics guide ch.
 *  3, "MdtFPFOJoint"). It removes six degrees of freedom. The guide deprecates it: one body with both shapes is
 *  cheaper, and MdtRPROJoint does more. The bodies stay as they stand to each other when they are attached (SetBodies).
 */
#ifndef MDTFPFOJOINT_H
#define MDTFPFOJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a FPFO joint, disabled, unattached, to hold the bodies' frames together. The world owns it. Returns null,
 *  with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtFPFOJointID MEAPI MdtFPFOJointCreate(const MdtWorldID w);
/** Makes the two bodies' frames coincide, as before SetBodies. Bodies and state stay. */
MEPUBLIC void MEAPI MdtFPFOJointReset(const MdtFPFOJointID j);
/** The FPFO joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtFPFOJointQuaConstraint(const MdtFPFOJointID j);
/** The constraint as a FPFO joint; null when it is none. */
MEPUBLIC MdtFPFOJointID MEAPI MdtConstraintDCastFPFOJoint(const MdtConstraintID c);
/** Where the joint is attached, world frame: forces are passed there. */
MEPUBLIC void MEAPI MdtFPFOJointSetPosition(const MdtFPFOJointID j, const MeReal x, const MeReal y, const MeReal z);
/** Where it is on the body of index 0 or 1, world frame. */
MEPUBLIC void MEAPI MdtFPFOJointGetPosition(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 pos);

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtFPFOJointDestroy(const MdtFPFOJointID j) {
    MdtConstraintDestroy(MdtFPFOJointQuaConstraint(j));
}
static inline void MdtFPFOJointEnable(const MdtFPFOJointID j) {
    MdtConstraintEnable(MdtFPFOJointQuaConstraint(j));
}
static inline void MdtFPFOJointDisable(const MdtFPFOJointID j) {
    MdtConstraintDisable(MdtFPFOJointQuaConstraint(j));
}
static inline MeBool MdtFPFOJointIsEnabled(const MdtFPFOJointID j) {
    return MdtConstraintIsEnabled(MdtFPFOJointQuaConstraint(j));
}
static inline void MdtFPFOJointSetBodies(const MdtFPFOJointID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtFPFOJointQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtFPFOJointGetBody(const MdtFPFOJointID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtFPFOJointQuaConstraint(j), bodyindex);
}
static inline void MdtFPFOJointGetForce(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtFPFOJointQuaConstraint(j), bodyindex, force);
}
static inline void MdtFPFOJointGetTorque(const MdtFPFOJointID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtFPFOJointQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtFPFOJointGetWorld(const MdtFPFOJointID j) {
    return MdtConstraintGetWorld(MdtFPFOJointQuaConstraint(j));
}
static inline void MdtFPFOJointSetUserData(const MdtFPFOJointID j, void *data) {
    MdtConstraintSetUserData(MdtFPFOJointQuaConstraint(j), data);
}
static inline void *MdtFPFOJointGetUserData(const MdtFPFOJointID j) {
    return MdtConstraintGetUserData(MdtFPFOJointQuaConstraint(j));
}
static inline void MdtFPFOJointSetSortKey(const MdtFPFOJointID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtFPFOJointQuaConstraint(j), key);
}
static inline MeI32 MdtFPFOJointGetSortKey(const MdtFPFOJointID j) {
    return MdtConstraintGetSortKey(MdtFPFOJointQuaConstraint(j));
}
/** @} */

ME_END_C

#endif
