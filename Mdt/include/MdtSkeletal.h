/** @file MdtSkeletal.h
 *  The skeletal joint: a ball-and-socket joint whose swing and twist are limited (User Guide app. D, "MdtSkeletal").
 *
 *  The first body's primary axis swings inside an elliptical cone round the second body's: by the primary angle towards
 *  the second axis, by the secondary angle towards the third. The twist is the rest of the turn, zero where the swing
 *  alone, along a great circle, brought the axis to where it is. It removes three degrees of freedom; each limit that
 *  is touched adds a row.
 */
#ifndef MDTSKELETAL_H
#define MDTSKELETAL_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a skeletal joint, disabled, unattached, at the bodies' centres of mass, about their x-axes, with limits of
 *  pi/4. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is
 *  full. */
MEPUBLIC MdtSkeletalID MEAPI MdtSkeletalCreate(const MdtWorldID w);
/** Sets frame, limits and options to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtSkeletalReset(const MdtSkeletalID j);
/** The skeletal joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtSkeletalQuaConstraint(const MdtSkeletalID j);
/** The constraint as a skeletal joint; null when it is none. */
MEPUBLIC MdtSkeletalID MEAPI MdtConstraintDCastSkeletal(const MdtConstraintID c);
/** @name Limit angles, rad, 0 to pi (clamped)
 *  @{ */
MEPUBLIC void MEAPI MdtSkeletalSetConePrimaryLimitAngle(const MdtSkeletalID j, const MeReal theta);
MEPUBLIC MeReal MEAPI MdtSkeletalGetConePrimaryLimitAngle(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetConeSecondaryLimitAngle(const MdtSkeletalID j, const MeReal theta);
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeSecondaryLimitAngle(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetTwistLimitAngle(const MdtSkeletalID j, const MeReal theta);
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistLimitAngle(const MdtSkeletalID j);
/** @} */
/** @name Stiffness [N m/rad] and damping [N m s/rad] beyond the limits, at least 0
 *  All are MEINFINITY by default, and as long as one of a pair is, that limit is hard and without rebound.
 *  @{ */
MEPUBLIC void MEAPI MdtSkeletalSetConeStiffness(const MdtSkeletalID j, const MeReal kp);
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeStiffness(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetConeDamping(const MdtSkeletalID j, const MeReal kd);
MEPUBLIC MeReal MEAPI MdtSkeletalGetConeDamping(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetTwistStiffness(const MdtSkeletalID j, const MeReal kp);
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistStiffness(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetTwistDamping(const MdtSkeletalID j, const MeReal kd);
MEPUBLIC MeReal MEAPI MdtSkeletalGetTwistDamping(const MdtSkeletalID j);
/** @} */
/** @name What is free, limited, or held (MdtBcl.h); a value that is none gets a warning
 *  @{ */
MEPUBLIC void MEAPI MdtSkeletalSetConeOption(const MdtSkeletalID j, MdtSkeletalConeOption co);
MEPUBLIC MdtSkeletalConeOption MEAPI MdtSkeletalGetConeOption(const MdtSkeletalID j);
MEPUBLIC void MEAPI MdtSkeletalSetTwistOption(const MdtSkeletalID j, MdtSkeletalTwistOption to);
MEPUBLIC MdtSkeletalTwistOption MEAPI MdtSkeletalGetTwistOption(const MdtSkeletalID j);
/** @} */
/** Makes the twist that the bodies have now the zero of the twist. */
MEPUBLIC void MEAPI MdtSkeletalZeroTwist(const MdtSkeletalID j);
#define MdtSkeletalBodyGetAxis(j, k, a) MdtConstraintBodyGetAxis(MdtSkeletalQuaConstraint(j), (k), (a))

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtSkeletalDestroy(const MdtSkeletalID j) {
    MdtConstraintDestroy(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalEnable(const MdtSkeletalID j) {
    MdtConstraintEnable(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalDisable(const MdtSkeletalID j) {
    MdtConstraintDisable(MdtSkeletalQuaConstraint(j));
}
static inline MeBool MdtSkeletalIsEnabled(const MdtSkeletalID j) {
    return MdtConstraintIsEnabled(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalSetBodies(const MdtSkeletalID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtSkeletalQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtSkeletalGetBody(const MdtSkeletalID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtSkeletalQuaConstraint(j), bodyindex);
}
static inline void MdtSkeletalGetForce(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtSkeletalQuaConstraint(j), bodyindex, force);
}
static inline void MdtSkeletalGetTorque(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtSkeletalQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtSkeletalGetWorld(const MdtSkeletalID j) {
    return MdtConstraintGetWorld(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalSetUserData(const MdtSkeletalID j, void *data) {
    MdtConstraintSetUserData(MdtSkeletalQuaConstraint(j), data);
}
static inline void *MdtSkeletalGetUserData(const MdtSkeletalID j) {
    return MdtConstraintGetUserData(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalSetSortKey(const MdtSkeletalID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtSkeletalQuaConstraint(j), key);
}
static inline MeI32 MdtSkeletalGetSortKey(const MdtSkeletalID j) {
    return MdtConstraintGetSortKey(MdtSkeletalQuaConstraint(j));
}
static inline void MdtSkeletalSetPosition(const MdtSkeletalID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetPosition(MdtSkeletalQuaConstraint(j), x, y, z);
}
static inline void MdtSkeletalGetPosition(const MdtSkeletalID j, MeVector3 position) {
    MdtConstraintGetPosition(MdtSkeletalQuaConstraint(j), position);
}
static inline void MdtSkeletalSetAxes(const MdtSkeletalID j, const MeReal px, const MeReal py, const MeReal pz,
                                      const MeReal ox, const MeReal oy, const MeReal oz) {
    MdtConstraintSetAxes(MdtSkeletalQuaConstraint(j), px, py, pz, ox, oy, oz);
}
static inline void MdtSkeletalBodySetAxes(const MdtSkeletalID j, const unsigned int bodyindex, const MeReal px,
                                          const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                          const MeReal oz) {
    MdtConstraintBodySetAxes(MdtSkeletalQuaConstraint(j), bodyindex, px, py, pz, ox, oy, oz);
}
static inline void MdtSkeletalBodyGetAxes(const MdtSkeletalID j, const unsigned int bodyindex, MeVector3 primary,
                                          MeVector3 ortho) {
    MdtConstraintBodyGetAxes(MdtSkeletalQuaConstraint(j), bodyindex, primary, ortho);
}
/** @} */

ME_END_C

#endif
