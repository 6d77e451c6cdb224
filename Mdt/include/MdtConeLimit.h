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

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(ConeLimit)
MDT_JOINT_POSITION(ConeLimit)
MDT_JOINT_AXIS(ConeLimit)
MDT_JOINT_AXES(ConeLimit)
MDT_JOINT_BODY_AXES(ConeLimit)

ME_END_C

#endif
