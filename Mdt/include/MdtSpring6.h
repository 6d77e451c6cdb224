/** @file MdtSpring6.h
 *  Six springs between two frames: a joint of configurable compliance.
 *
 *  Each body has an attachment frame. Linear springs act on the offset of the first frame along the axes of the
 *  second, angular ones on the rotation between the frames. Each has a stiffness and a damping, both 0 by default:
 *  such a spring has no row. A stiffness of MEINFINITY constrains that direction. Axis 0 is the primary axis, 1 the
 *  second, 2 their cross product.
 */
#ifndef MDTSPRING6_H
#define MDTSPRING6_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Spring6, disabled, unattached, at the bodies' centres of mass, without any stiffness. The world owns it.
 *  Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtSpring6ID MEAPI MdtSpring6Create(const MdtWorldID w);
/** Sets frames, stiffness and damping to the defaults of a new joint. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtSpring6Reset(const MdtSpring6ID j);
/** The Spring6 as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtSpring6QuaConstraint(const MdtSpring6ID j);
/** The constraint as a Spring6; null if it is none. */
MEPUBLIC MdtSpring6ID MEAPI MdtConstraintDCastSpring6(const MdtConstraintID c);
/** @name Springs by axis, 0 to 2: N/m and N s/m, N m/rad and N m s/rad, at least 0
 *  Default 0: free. A stiffness of MEINFINITY is rigid. A negative number, or another axis, gets a warning and changes
 *  nothing. MdtSpring6SetLinearMotor takes a frequency instead.
 *  @{ */
/** N/m along the axis. */
MEPUBLIC void MEAPI MdtSpring6SetLinearStiffness(const MdtSpring6ID j, int axisindex, MeReal s);
/** N/m; 0 by default, and for another axis. */
MEPUBLIC MeReal MEAPI MdtSpring6GetLinearStiffness(const MdtSpring6ID j, int axisindex);
/** N s/m along the axis. */
MEPUBLIC void MEAPI MdtSpring6SetLinearDamping(const MdtSpring6ID j, int axisindex, MeReal d);
/** N s/m; 0 by default, and for another axis. */
MEPUBLIC MeReal MEAPI MdtSpring6GetLinearDamping(const MdtSpring6ID j, int axisindex);
/** N m/rad about the axis. */
MEPUBLIC void MEAPI MdtSpring6SetAngularStiffness(const MdtSpring6ID j, int axisindex, MeReal s);
/** N m/rad; 0 by default, and for another axis. */
MEPUBLIC MeReal MEAPI MdtSpring6GetAngularStiffness(const MdtSpring6ID j, int axisindex);
/** N m s/rad about the axis. */
MEPUBLIC void MEAPI MdtSpring6SetAngularDamping(const MdtSpring6ID j, int axisindex, MeReal d);
/** N m s/rad; 0 by default, and for another axis. */
MEPUBLIC MeReal MEAPI MdtSpring6GetAngularDamping(const MdtSpring6ID j, int axisindex);
/** @} */
/** @name Position motors, beyond Karma: a spring whose frequency does not depend on masses, with a bounded force
 *  Such a motor replaces the spring of its direction, and is as that of MdtLimitSetPositionMotor (MdtLimit.h); its mass
 *  is what the two bodies show in this direction while rigid directions hold, and the others are free. All six together
 *  lead a frame to a target pose.
 *  @{ */
/** Of an axis, 0 to 2: @a frequency [Hz], @a dampingRatio (1: critically damped), and the largest force [N] or torque
 *  [N m] in either direction (MEINFINITY: any). A frequency of 0, the default, switches the motor off. A negative
 *  number gets a warning, and nothing is changed. */
MEPUBLIC void MEAPI MdtSpring6SetLinearMotor(const MdtSpring6ID j, int axisindex, MeReal frequency, MeReal dampingRatio,
                                             MeReal forceLimit);
/** The same about the axis, N m. */
MEPUBLIC void MEAPI MdtSpring6SetAngularMotor(const MdtSpring6ID j, int axisindex, MeReal frequency,
                                              MeReal dampingRatio, MeReal torqueLimit);
/** @} */
/** @name The target of springs, motors and rigid directions, by default 0: where the first frame is drawn to
 *  At the start of the next step, with its velocity from there on (null: 0). Steps do not change it.
 *  @{ */
/** m, m/s, along the axes of the second frame, from its origin. */
MEPUBLIC void MEAPI MdtSpring6SetTargetPosition(const MdtSpring6ID j, const MeVector3 position,
                                                const MeVector3 velocity);
/** m, in the second frame; 0 by default. */
MEPUBLIC void MEAPI MdtSpring6GetTargetPosition(const MdtSpring6ID j, MeVector3 position);
/** The orientation of the first frame in the second, a quaternion (w, x, y, z), not zero, and its angular velocity,
 *  rad/s, in the axes of the second frame. Angular springs then act about the axes of the target. */
MEPUBLIC void MEAPI MdtSpring6SetTargetQuaternion(const MdtSpring6ID j, const MeVector4 q, const MeVector3 w);
/** (w, x, y, z); (1, 0, 0, 0) by default. */
MEPUBLIC void MEAPI MdtSpring6GetTargetQuaternion(const MdtSpring6ID j, MeVector4 q);
/** @} */
/** @name The velocity of the world where the spring is attached to it: see MdtConstraint.h
 *  @{ */
/** m/s; default 0. */
MEPUBLIC void MEAPI MdtSpring6SetWorldLinearVelocity(const MdtSpring6ID j, MeReal vx, MeReal vy, MeReal vz);
/** m/s; 0 by default. */
MEPUBLIC void MEAPI MdtSpring6GetWorldLinearVelocity(const MdtSpring6ID j, MeVector3 v);
/** rad/s about the world's origin; default 0. */
MEPUBLIC void MEAPI MdtSpring6SetWorldAngularVelocity(const MdtSpring6ID j, MeReal vx, MeReal vy, MeReal vz);
/** rad/s; 0 by default. */
MEPUBLIC void MEAPI MdtSpring6GetWorldAngularVelocity(const MdtSpring6ID j, MeVector3 v);
/** @} */

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtSpring6Destroy(const MdtSpring6ID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtSpring6Enable(const MdtSpring6ID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtSpring6Disable(const MdtSpring6ID j);
/** False for a new one, after MdtSpring6Disable, and after a break. */
MEPUBLIC MeBool MEAPI MdtSpring6IsEnabled(const MdtSpring6ID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtSpring6SetBodies(const MdtSpring6ID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtSpring6GetBody(const MdtSpring6ID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtSpring6GetForce(const MdtSpring6ID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtSpring6GetForce. */
MEPUBLIC void MEAPI MdtSpring6GetTorque(const MdtSpring6ID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtSpring6GetWorld(const MdtSpring6ID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtSpring6SetUserData(const MdtSpring6ID j, void *data);
/** The pointer of MdtSpring6SetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtSpring6GetUserData(const MdtSpring6ID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtSpring6SetSortKey(const MdtSpring6ID j, const MeI32 key);
/** The key of MdtSpring6SetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtSpring6GetSortKey(const MdtSpring6ID j);
/** m, world frame: the origin of both attachment frames, fixed in each body from now on. Default: the centres of mass.
 *  */
MEPUBLIC void MEAPI MdtSpring6SetPosition(const MdtSpring6ID j, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the point's present place on the first body; on the second one, if the first is the world. */
MEPUBLIC void MEAPI MdtSpring6GetPosition(const MdtSpring6ID j, MeVector3 position);
/** World frame: axes 0 (px, py, pz) and 1 of both attachment frames. They are normalized, the second one is made
 *  orthogonal; parallel ones get a warning and change nothing. */
MEPUBLIC void MEAPI MdtSpring6SetAxes(const MdtSpring6ID j, const MeReal px, const MeReal py, const MeReal pz,
                                      const MeReal ox, const MeReal oy, const MeReal oz);
/** Unit vectors, world frame: the present axes 0 and 1 on the first body; on the second one, if the first is the world.
 *  */
MEPUBLIC void MEAPI MdtSpring6GetAxes(const MdtSpring6ID j, MeVector3 primary, MeVector3 ortho);
/** @} */

ME_END_C

#endif
