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
/** rad; pi, the default: no limit. */
MEPUBLIC MeReal MEAPI MdtConeLimitGetConeHalfAngle(const MdtConeLimitID j);
/** @name Stiffness [N m/rad] and damping [N m s/rad] beyond the cone, at least 0
 *  Both are MEINFINITY by default. The limit is hard, without rebound, as long as one of them is.
 *  @{ */
/** N m/rad beyond the cone. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtConeLimitSetStiffness(const MdtConeLimitID j, const MeReal kp);
/** N m/rad; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtConeLimitGetStiffness(const MdtConeLimitID j);
/** N m s/rad beyond the cone. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtConeLimitSetDamping(const MdtConeLimitID j, const MeReal kd);
/** N m s/rad; MEINFINITY by default. */
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
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtConeLimitDestroy(const MdtConeLimitID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtConeLimitEnable(const MdtConeLimitID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtConeLimitDisable(const MdtConeLimitID j);
/** False for a new one, after MdtConeLimitDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtConeLimitIsEnabled(const MdtConeLimitID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtConeLimitSetBodies(const MdtConeLimitID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtConeLimitGetBody(const MdtConeLimitID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtConeLimitGetForce(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtConeLimitGetForce. */
MEPUBLIC void MEAPI MdtConeLimitGetTorque(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtConeLimitGetWorld(const MdtConeLimitID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtConeLimitSetUserData(const MdtConeLimitID j, void *data);
/** The pointer of MdtConeLimitSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtConeLimitGetUserData(const MdtConeLimitID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtConeLimitSetSortKey(const MdtConeLimitID j, const MeI32 key);
/** The key of MdtConeLimitSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtConeLimitGetSortKey(const MdtConeLimitID j);
/** m, world frame. It has no effect: a cone limit needs no position. */
MEPUBLIC void MEAPI MdtConeLimitSetPosition(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtConeLimitGetPosition(const MdtConeLimitID j, MeVector3 position);
/** World frame, not zero, normalized here: one axis for both bodies, whose angle is 0 now. Default: each body's x-axis.
 *  */
MEPUBLIC void MEAPI MdtConeLimitSetAxis(const MdtConeLimitID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the axis at present on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtConeLimitGetAxis(const MdtConeLimitID j, MeVector3 axis);
/** World frame: primary axis (px, py, pz) and second axis of both bodies. They are normalized, the second one is made
 *  orthogonal; parallel ones get a warning and change nothing. */
MEPUBLIC void MEAPI MdtConeLimitSetAxes(const MdtConeLimitID j, const MeReal px, const MeReal py, const MeReal pz,
                                        const MeReal ox, const MeReal oy, const MeReal oz);
/** The same for the body of index 0 or 1 alone, if the limited angle is not to be 0 in the present poses. */
MEPUBLIC void MEAPI MdtConeLimitBodySetAxes(const MdtConeLimitID j, const unsigned int bodyindex, const MeReal px,
                                            const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                            const MeReal oz);
/** Unit vectors, world frame: the present axes of the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtConeLimitBodyGetAxes(const MdtConeLimitID j, const unsigned int bodyindex, MeVector3 primary,
                                            MeVector3 ortho);
/** @} */

ME_END_C

#endif
