/** @file MdtHinge.h
 *  The hinge: two bodies turn about a common axis, with stops and a motor (Dynamics guide ch. 3, "MdtHinge").
 *
 *  It removes five degrees of freedom. A running motor, and each stop that is touched, adds a row. The angle is that of
 *  the first body against the second, positive about the axis by the right-hand rule, zero as the bodies stood when the
 *  axis was set, and counts full turns, so that stops may lie beyond a half turn. Stops, motor and the angle itself are
 *  in the joint's limit (MdtLimit.h); the angle is measured while the limit is active, powered, or asked to.
 */
#ifndef MDTHINGE_H
#define MDTHINGE_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a hinge, disabled, unattached, at the bodies' centres of mass, its axis the x-axis of each, its limit at
 *  default. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtHingeID MEAPI MdtHingeCreate(const MdtWorldID w);
/** Sets position, axes and limit to the defaults of a new hinge. Bodies and state stay. */
MEPUBLIC void MEAPI MdtHingeReset(const MdtHingeID j);
/** The hinge as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtHingeQuaConstraint(const MdtHingeID j);
/** The constraint as a hinge; null when it is none. */
MEPUBLIC MdtHingeID MEAPI MdtConstraintDCastHinge(const MdtConstraintID c);
/** The hinge's limit, to read and to write; it lives as long as the hinge. */
MEPUBLIC MdtLimitID MEAPI MdtHingeGetLimit(const MdtHingeID j);
/** Resets the hinge's limit, then copies stops, threshold, offset, motor and switches of @a NewLimit. */
MEPUBLIC void MEAPI MdtHingeSetLimit(const MdtHingeID j, const MdtLimitID NewLimit);

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtHingeDestroy(const MdtHingeID j) {
    MdtConstraintDestroy(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeEnable(const MdtHingeID j) {
    MdtConstraintEnable(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeDisable(const MdtHingeID j) {
    MdtConstraintDisable(MdtHingeQuaConstraint(j));
}
static inline MeBool MdtHingeIsEnabled(const MdtHingeID j) {
    return MdtConstraintIsEnabled(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeSetBodies(const MdtHingeID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtHingeQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtHingeGetBody(const MdtHingeID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtHingeQuaConstraint(j), bodyindex);
}
static inline void MdtHingeGetForce(const MdtHingeID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtHingeQuaConstraint(j), bodyindex, force);
}
static inline void MdtHingeGetTorque(const MdtHingeID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtHingeQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtHingeGetWorld(const MdtHingeID j) {
    return MdtConstraintGetWorld(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeSetUserData(const MdtHingeID j, void *data) {
    MdtConstraintSetUserData(MdtHingeQuaConstraint(j), data);
}
static inline void *MdtHingeGetUserData(const MdtHingeID j) {
    return MdtConstraintGetUserData(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeSetSortKey(const MdtHingeID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtHingeQuaConstraint(j), key);
}
static inline MeI32 MdtHingeGetSortKey(const MdtHingeID j) {
    return MdtConstraintGetSortKey(MdtHingeQuaConstraint(j));
}
static inline void MdtHingeSetPosition(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetPosition(MdtHingeQuaConstraint(j), x, y, z);
}
static inline void MdtHingeGetPosition(const MdtHingeID j, MeVector3 position) {
    MdtConstraintGetPosition(MdtHingeQuaConstraint(j), position);
}
static inline void MdtHingeSetAxis(const MdtHingeID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetAxis(MdtHingeQuaConstraint(j), x, y, z);
}
static inline void MdtHingeGetAxis(const MdtHingeID j, MeVector3 axis) {
    MdtConstraintGetAxis(MdtHingeQuaConstraint(j), axis);
}
/** @} */

ME_END_C

#endif
