/** @file MdtConeLimit.h The cone limit: keeps the angle between an axis of each body below a half angle (Dynamics
 *  guide ch. 3, "MdtConeLimit"). It has no row inside the cone and one row at its surface; twist about the axes is
 *  free. Combine it with a ball-and-socket or a universal joint. It needs no position.
 *
 *  Half angles below about 5 degrees are not well defined: if the axes are parallel, the plane of the limit's torque is
 *  undefined.
 */
#ifndef MDTCONELIMIT_H
#define MDTCONELIMIT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a cone limit, disabled, unattached, its axes the bodies' x-axes, its half angle pi: no limit. The world owns
 *  it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtConeLimitID MEAPI MdtConeLimitCreate(const MdtWorldID w);
/** Sets axes, half angle and stiffness to the defaults of a new limit. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtConeLimitReset(const MdtConeLimitID j);
/** The cone limit as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtConeLimitQuaConstraint(const MdtConeLimitID j);
/** The constraint as a cone limit; null if it is none. */
MEPUBLIC MdtConeLimitID MEAPI MdtConstraintDCastConeLimit(const MdtConstraintID c);
/** The angle between the cone's axis and its surface, rad, clamped to 0 .. pi. */
MEPUBLIC void MEAPI MdtConeLimitSetConeHalfAngle(const MdtConeLimitID j, const MeReal theta);
MEPUBLIC MeReal MEAPI MdtConeLimitGetConeHalfAngle(const MdtConeLimitID j);
/** @name Stiffness [N m/rad] and damping [N m s/rad] beyond the cone, at least 0
 *  Both are MEINFINITY by default. The limit is hard, without rebound, as long as one of them is.
 *  @{ */
MEPUBLIC void MEAPI MdtConeLimitSetStiffness(const MdtConeLimitID j, const MeReal kp);
MEPUBLIC MeReal MEAPI MdtConeLimitGetStiffness(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetDamping(const MdtConeLimitID j, const MeReal kd);
MEPUBLIC MeReal MEAPI MdtConeLimitGetDamping(const MdtConeLimitID j);
/** @} */
/** Sets the joint's axes on one body, in that body's centre-of-mass frame: primary (px, py, pz), ortho (ox, oy, oz). */
MEPUBLIC void MEAPI MdtConeLimitBodySetAxesRel(const MdtConeLimitID j, const unsigned int bodyindex, const MeReal px,
                                               const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                               const MeReal oz);
/** As MdtConstraintGetAxes. */
MEPUBLIC void MEAPI MdtConeLimitGetAxes(const MdtConeLimitID j, MeVector3 primary, MeVector3 ortho);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtConeLimitDestroy(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitEnable(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitDisable(const MdtConeLimitID j);
MEPUBLIC MeBool MEAPI MdtConeLimitIsEnabled(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetBodies(const MdtConeLimitID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtConeLimitGetBody(const MdtConeLimitID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtConeLimitGetForce(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 force);
MEPUBLIC void MEAPI MdtConeLimitGetTorque(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtConeLimitGetWorld(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetUserData(const MdtConeLimitID j, void *data);
MEPUBLIC void *MEAPI MdtConeLimitGetUserData(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetSortKey(const MdtConeLimitID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtConeLimitGetSortKey(const MdtConeLimitID j);
MEPUBLIC void MEAPI MdtConeLimitSetPosition(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtConeLimitGetPosition(const MdtConeLimitID j, MeVector3 position);
MEPUBLIC void MEAPI MdtConeLimitSetAxis(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtConeLimitGetAxis(const MdtConeLimitID j, MeVector3 axis);
MEPUBLIC void MEAPI MdtConeLimitSetAxes(const MdtConeLimitID j, const MeReal px, const MeReal py, const MeReal pz,
                                        const MeReal ox, const MeReal oy, const MeReal oz);
MEPUBLIC void MEAPI MdtConeLimitBodySetAxes(const MdtConeLimitID j, const unsigned int bodyindex, const MeReal px,
                                            const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                            const MeReal oz);
MEPUBLIC void MEAPI MdtConeLimitBodyGetAxes(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 primary,
                                            MeVector3 ortho);
/** @} */

ME_END_C

#endif
