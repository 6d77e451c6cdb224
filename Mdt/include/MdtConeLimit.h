/** @file MdtConeLimit.h The cone limit: the angle between an axis of each body stays below a half angle (Dynamics guide
 *  ch. 3, "MdtConeLimit"). It has no row inside the cone and one at its side; the twist about the axes stays free. Use
 *  it beside a ball-and-socket or a universal joint. It needs no position.
 *
 *  Half angles below about 5 degrees are not well defined: where the axes are parallel, the limit has no plane to push
 *  in.
 */
#ifndef MDTCONELIMIT_H
#define MDTCONELIMIT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a cone limit, disabled, unattached, its axes the bodies' x-axes, its half angle pi: no limit. The world owns
 *  it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtConeLimitID MEAPI MdtConeLimitCreate(const MdtWorldID w);
/** Sets axes, half angle and stiffness to the defaults of a new limit. Bodies and state stay. */
MEPUBLIC void MEAPI MdtConeLimitReset(const MdtConeLimitID j);
/** The cone limit as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtConeLimitQuaConstraint(const MdtConeLimitID j);
/** The constraint as a cone limit; null when it is none. */
MEPUBLIC MdtConeLimitID MEAPI MdtConstraintDCastConeLimit(const MdtConstraintID c);
/** The angle between the cone's axis and its side, rad, 0 to pi. Beyond, it is clamped. */
MEPUBLIC void MEAPI MdtConeLimitSetConeHalfAngle(const MdtConeLimitID j, const MeReal theta);
MEPUBLIC MeReal MEAPI MdtConeLimitGetConeHalfAngle(const MdtConeLimitID j);
/** @name Stiffness [N m/rad] and damping [N m s/rad] beyond the cone, at least 0
 *  Both are MEINFINITY by default, and as long as one of them is, the limit is hard and without rebound.
 *  @{ */
MEPUBLIC void MEAPI MdtConeLimitSetStiffness(const MdtConeLimitID j, const MeReal kp);
MEPUBLIC MeReal MEAPI MdtConeLimitGetStiffness(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetDamping(const MdtConeLimitID j, const MeReal kd);
MEPUBLIC MeReal MEAPI MdtConeLimitGetDamping(const MdtConeLimitID j);
/** @} */
/** The axes of one body in the frame of its centre of mass. */
#define MdtConeLimitBodySetAxesRel(j, k, px, py, pz, ox, oy, oz)                                                       \
    MdtConstraintBodySetAxesRel(MdtConeLimitQuaConstraint(j), (k), (px), (py), (pz), (ox), (oy), (oz))
#define MdtConeLimitGetAxes(j, p, o) MdtConstraintGetAxes(MdtConeLimitQuaConstraint(j), (p), (o))

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtConeLimitDestroy(const MdtConeLimitID j) {
    MdtConstraintDestroy(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitEnable(const MdtConeLimitID j) {
    MdtConstraintEnable(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitDisable(const MdtConeLimitID j) {
    MdtConstraintDisable(MdtConeLimitQuaConstraint(j));
}
static inline MeBool MdtConeLimitIsEnabled(const MdtConeLimitID j) {
    return MdtConstraintIsEnabled(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitSetBodies(const MdtConeLimitID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtConeLimitQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtConeLimitGetBody(const MdtConeLimitID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtConeLimitQuaConstraint(j), bodyindex);
}
static inline void MdtConeLimitGetForce(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtConeLimitQuaConstraint(j), bodyindex, force);
}
static inline void MdtConeLimitGetTorque(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtConeLimitQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtConeLimitGetWorld(const MdtConeLimitID j) {
    return MdtConstraintGetWorld(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitSetUserData(const MdtConeLimitID j, void *data) {
    MdtConstraintSetUserData(MdtConeLimitQuaConstraint(j), data);
}
static inline void *MdtConeLimitGetUserData(const MdtConeLimitID j) {
    return MdtConstraintGetUserData(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitSetSortKey(const MdtConeLimitID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtConeLimitQuaConstraint(j), key);
}
static inline MeI32 MdtConeLimitGetSortKey(const MdtConeLimitID j) {
    return MdtConstraintGetSortKey(MdtConeLimitQuaConstraint(j));
}
static inline void MdtConeLimitSetPosition(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetPosition(MdtConeLimitQuaConstraint(j), x, y, z);
}
static inline void MdtConeLimitGetPosition(const MdtConeLimitID j, MeVector3 position) {
    MdtConstraintGetPosition(MdtConeLimitQuaConstraint(j), position);
}
static inline void MdtConeLimitSetAxis(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintSetAxis(MdtConeLimitQuaConstraint(j), x, y, z);
}
static inline void MdtConeLimitGetAxis(const MdtConeLimitID j, MeVector3 axis) {
    MdtConstraintGetAxis(MdtConeLimitQuaConstraint(j), axis);
}
static inline void MdtConeLimitSetAxes(const MdtConeLimitID j, const MeReal px, const MeReal py, const MeReal pz,
                                       const MeReal ox, const MeReal oy, const MeReal oz) {
    MdtConstraintSetAxes(MdtConeLimitQuaConstraint(j), px, py, pz, ox, oy, oz);
}
static inline void MdtConeLimitBodySetAxes(const MdtConeLimitID j, const unsigned int bodyindex, const MeReal px,
                                           const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                           const MeReal oz) {
    MdtConstraintBodySetAxes(MdtConeLimitQuaConstraint(j), bodyindex, px, py, pz, ox, oy, oz);
}
static inline void MdtConeLimitBodyGetAxes(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 primary,
                                           MeVector3 ortho) {
    MdtConstraintBodyGetAxes(MdtConeLimitQuaConstraint(j), bodyindex, primary, ortho);
}
/** @} */

ME_END_C

#endif
