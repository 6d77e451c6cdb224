/** @file MdtUniversal.h The universal joint: two bodies share a point, and an axis of one stays orthogonal to an axis
 *  of the other (Dynamics guide ch. 3, "MdtUniversal"). It removes four degrees of freedom: the bodies can bend about
 *  both axes, but not twist.
 *
 *  Bent by 90 degrees it transmits no torque; reaching that angle gets a warning, and a cone limit can prevent it. The
 *  bend is measured from the pose in which the axes are set. By default the axes are x in body 0 and y in body 1.
 */
#ifndef MDTUNIVERSAL_H
#define MDTUNIVERSAL_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a universal joint, disabled, unattached, at the bodies' centres of mass, its axes x in the first and y in
 *  the second. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the
 *  world is full. */
MEPUBLIC MdtUniversalID MEAPI MdtUniversalCreate(const MdtWorldID w);
/** Sets position and axes to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtUniversalReset(const MdtUniversalID j);
/** The universal joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtUniversalQuaConstraint(const MdtUniversalID j);
/** The constraint as a universal joint; null if it is none. */
MEPUBLIC MdtUniversalID MEAPI MdtConstraintDCastUniversal(const MdtConstraintID c);
/** The joint's axis in the body of index 0 or 1, world frame. Bad input as in MdtConstraint.h. */
MEPUBLIC void MEAPI MdtUniversalSetAxis(const MdtUniversalID j, const unsigned int bodyindex, const MeReal Ax,
                                        const MeReal Ay, const MeReal Az);
/** The present direction of axis @a bodyindex, world frame. */
MEPUBLIC void MEAPI MdtUniversalGetAxis(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 axis);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtUniversalDestroy(const MdtUniversalID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtUniversalEnable(const MdtUniversalID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtUniversalDisable(const MdtUniversalID j);
/** False for a new one, after MdtUniversalDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtUniversalIsEnabled(const MdtUniversalID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtUniversalSetBodies(const MdtUniversalID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtUniversalGetBody(const MdtUniversalID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtUniversalGetForce(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtUniversalGetForce. */
MEPUBLIC void MEAPI MdtUniversalGetTorque(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtUniversalGetWorld(const MdtUniversalID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtUniversalSetUserData(const MdtUniversalID j, void *data);
/** The pointer of MdtUniversalSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtUniversalGetUserData(const MdtUniversalID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtUniversalSetSortKey(const MdtUniversalID j, const MeI32 key);
/** The key of MdtUniversalSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtUniversalGetSortKey(const MdtUniversalID j);
/** m, world frame: the point where both bodies are attached, fixed in each from now on. Default: their centres of mass.
 *  */
MEPUBLIC void MEAPI MdtUniversalSetPosition(const MdtUniversalID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtUniversalGetPosition(const MdtUniversalID j, MeVector3 position);
/** Sets both axes: the primary one is that of body 0, the second one that of body 1 (User Guide app. D). */
MEPUBLIC void MEAPI MdtUniversalSetAxes(const MdtUniversalID j, const MeReal px, const MeReal py, const MeReal pz,
                                        const MeReal ox, const MeReal oy, const MeReal oz);
/** Unit vectors, world frame: the present axes of MdtUniversalSetAxes on the first body; on the second one, if the
 *  first is the world. */
MEPUBLIC void MEAPI MdtUniversalGetAxes(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 primary,
                                        MeVector3 ortho);
/** @} */

ME_END_C

#endif
