/** @file MdtLinear1.h The Linear1 joint: a point of the first body stays in a plane of the second (Dynamics guide ch.
 *  3, "MdtLinear1"). It removes one degree of freedom. The plane goes through the joint's position, and the joint's
 *  axis is its normal. To hold a point of a body in a plane of the world, make the body the first.
 */
#ifndef MDTLINEAR1_H
#define MDTLINEAR1_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Linear1 joint, disabled, unattached, at the bodies' centres of mass, the plane's normal the second body's
 *  x-axis. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtLinear1ID MEAPI MdtLinear1Create(const MdtWorldID w);
/** Sets position and axis to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtLinear1Reset(const MdtLinear1ID j);
/** The Linear1 joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtLinear1QuaConstraint(const MdtLinear1ID j);
/** The constraint as a Linear1 joint; null when it is none. */
MEPUBLIC MdtLinear1ID MEAPI MdtConstraintDCastLinear1(const MdtConstraintID c);

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtLinear1Destroy(const MdtLinear1ID j) {
    MdtConstraintDestroy(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1Enable(const MdtLinear1ID j) {
    MdtConstraintEnable(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1Disable(const MdtLinear1ID j) {
    MdtConstraintDisable(MdtLinear1QuaConstraint(j));
}
static inline MeBool MdtLinear1IsEnabled(const MdtLinear1ID j) {
    return MdtConstraintIsEnabled(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1SetBodies(const MdtLinear1ID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtLinear1QuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtLinear1GetBody(const MdtLinear1ID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtLinear1QuaConstraint(j), bodyindex);
}
static inline void MdtLinear1GetForce(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtLinear1QuaConstraint(j), bodyindex, force);
}
static inline void MdtLinear1GetTorque(const MdtLinear1ID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtLinear1QuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtLinear1GetWorld(const MdtLinear1ID j) {
    return MdtConstraintGetWorld(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1SetUserData(const MdtLinear1ID j, void *data) {
    MdtConstraintSetUserData(MdtLinear1QuaConstraint(j), data);
}
static inline void *MdtLinear1GetUserData(const MdtLinear1ID j) {
    return MdtConstraintGetUserData(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1SetSortKey(const MdtLinear1ID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtLinear1QuaConstraint(j), key);
}
static inline MeI32 MdtLinear1GetSortKey(const MdtLinear1ID j) {
    return MdtConstraintGetSortKey(MdtLinear1QuaConstraint(j));
}
static inline void MdtLinear1SetPosition(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetPosition(MdtLinear1QuaConstraint(j), x, y, z);
}
static inline void MdtLinear1GetPosition(const MdtLinear1ID j, MeVector3 position) {
    MdtConstraintGetPosition(MdtLinear1QuaConstraint(j), position);
}
static inline void MdtLinear1SetAxis(const MdtLinear1ID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetAxis(MdtLinear1QuaConstraint(j), x, y, z);
}
static inline void MdtLinear1GetAxis(const MdtLinear1ID j, MeVector3 axis) {
    MdtConstraintGetAxis(MdtLinear1QuaConstraint(j), axis);
}
/** @} */

ME_END_C

#endif
