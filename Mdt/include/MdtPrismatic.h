/** @file MdtPrismatic.h
 *  The prismatic joint, or slider: two bodies slide along a common axis and do not turn against each other
 *  (Dynamics guide ch. 3, "MdtPrismatic"). It removes five degrees of freedom; a running motor, and each stop that is
 *  touched, adds a row.
 *
 *  Place the bodies, attach them, set the axis: as they stand then, the displacement is zero, and their orientation to
 *  each other is the one to keep. The displacement is that of the first body against the second along the axis, m.
 *  Stops, motor and the displacement itself are in the joint's limit (MdtLimit.h). There is no position to set.
 */
#ifndef MDTPRISMATIC_H
#define MDTPRISMATIC_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a prismatic joint, disabled, unattached, its axis the x-axis of the bodies, its limit at default. The world
 *  owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtPrismaticID MEAPI MdtPrismaticCreate(const MdtWorldID w);
/** Sets axes and limit to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtPrismaticReset(const MdtPrismaticID j);
/** The prismatic joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtPrismaticQuaConstraint(const MdtPrismaticID j);
/** The constraint as a prismatic joint; null when it is none. */
MEPUBLIC MdtPrismaticID MEAPI MdtConstraintDCastPrismatic(const MdtConstraintID c);
/** The joint's limit, to read and to write; it lives as long as the joint. */
MEPUBLIC MdtLimitID MEAPI MdtPrismaticGetLimit(const MdtPrismaticID j);
/** Resets the joint's limit, then copies stops, threshold, offset, motor and switches of @a NewLimit. */
MEPUBLIC void MEAPI MdtPrismaticSetLimit(const MdtPrismaticID j, const MdtLimitID NewLimit);

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtPrismaticDestroy(const MdtPrismaticID j) {
    MdtConstraintDestroy(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticEnable(const MdtPrismaticID j) {
    MdtConstraintEnable(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticDisable(const MdtPrismaticID j) {
    MdtConstraintDisable(MdtPrismaticQuaConstraint(j));
}
static inline MeBool MdtPrismaticIsEnabled(const MdtPrismaticID j) {
    return MdtConstraintIsEnabled(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticSetBodies(const MdtPrismaticID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtPrismaticQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtPrismaticGetBody(const MdtPrismaticID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtPrismaticQuaConstraint(j), bodyindex);
}
static inline void MdtPrismaticGetForce(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtPrismaticQuaConstraint(j), bodyindex, force);
}
static inline void MdtPrismaticGetTorque(const MdtPrismaticID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtPrismaticQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtPrismaticGetWorld(const MdtPrismaticID j) {
    return MdtConstraintGetWorld(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticSetUserData(const MdtPrismaticID j, void *data) {
    MdtConstraintSetUserData(MdtPrismaticQuaConstraint(j), data);
}
static inline void *MdtPrismaticGetUserData(const MdtPrismaticID j) {
    return MdtConstraintGetUserData(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticSetSortKey(const MdtPrismaticID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtPrismaticQuaConstraint(j), key);
}
static inline MeI32 MdtPrismaticGetSortKey(const MdtPrismaticID j) {
    return MdtConstraintGetSortKey(MdtPrismaticQuaConstraint(j));
}
static inline void MdtPrismaticSetAxis(const MdtPrismaticID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetAxis(MdtPrismaticQuaConstraint(j), x, y, z);
}
static inline void MdtPrismaticGetAxis(const MdtPrismaticID j, MeVector3 axis) {
    MdtConstraintGetAxis(MdtPrismaticQuaConstraint(j), axis);
}
/** @} */

ME_END_C

#endif
