/** @file MstModelDynamics.h
 *  Models with bodies.
 */
#ifndef MSTMODELDYNAMICS_H
#define MSTMODELDYNAMICS_H

#include "McdModel.h"
#include "MdtBody.h"
#include "MstTypes.h"

ME_BEGIN_C

/**
 * Attaches a model to a body: the model gets pointers to the body's transform and velocities. Null detaches it; it then
 * has no transform until one is set. A body may have several models, a model one body. A later McdModelSetTransformPtr
 * places the model independently of the body. Destroy or detach the model before its body.
 */
MEPUBLIC void MEAPI McdModelSetBody(const McdModelID m, const MdtBodyID b);
/** The model's body, or null. */
MEPUBLIC MdtBodyID MEAPI McdModelGetBody(const McdModelID m);
/** Moves the model's body to the origin, with identity rotation and zero velocity; a model without a body is
 * unchanged. */
MEPUBLIC void MEAPI McdModelDynamicsReset(const McdModelID m);

/** @name Properties of a model's body
 *  They call the functions of MdtBody.h for the model's body. A model without a body gets a warning, and zeros. Move a
 *  fixed model by its transform: McdModelSetTransformPtr. World frame: m, m/s, rad/s, N, N m, quaternions (w, x, y, z);
 *  positions are those of the body's frame, linear velocities those of its centre of mass. Forces act in the next step.
 *  @{ */
/** Wakes the body: MdtBodyEnable. Before each step it keeps it awake. */
MEPUBLIC void MEAPI McdModelDynamicsEnable(const McdModelID m);
/** MdtBodyDisable: removes the body from the simulation. */
MEPUBLIC void MEAPI McdModelDynamicsDisable(const McdModelID m);
/** MEFALSE while the body sleeps, or is disabled. */
MEPUBLIC MeBool MEAPI McdModelDynamicsIsEnabled(const McdModelID m);
/** m, world frame, of the body's frame. */
MEPUBLIC void MEAPI McdModelDynamicsGetPosition(const McdModelID m, MeVector3 p);
/** m, world frame: the body is there at once, keeps its velocity, and wakes. */
MEPUBLIC void MEAPI McdModelDynamicsSetPosition(const McdModelID m, const MeReal x, const MeReal y, const MeReal z);
/** (w, x, y, z), body to world. */
MEPUBLIC void MEAPI McdModelDynamicsGetQuaternion(const McdModelID m, MeVector4 q);
/** (w, x, y, z), body to world; normalized here. */
MEPUBLIC void MEAPI McdModelDynamicsSetQuaternion(const McdModelID m, const MeReal qw, const MeReal qx, const MeReal qy,
                                                  const MeReal qz);
/** Position (m) and rotation at once; a matrix that is no rotation to 1 % gets a warning. */
MEPUBLIC void MEAPI McdModelDynamicsSetTransform(const McdModelID m, const MeMatrix4 t);
/** m/s, world frame, of the centre of mass. */
MEPUBLIC void MEAPI McdModelDynamicsGetLinearVelocity(const McdModelID m, MeVector3 v);
/** m/s, world frame. It wakes the body. */
MEPUBLIC void MEAPI McdModelDynamicsSetLinearVelocity(const McdModelID m, const MeReal x, const MeReal y,
                                                      const MeReal z);
/** rad/s, world frame. */
MEPUBLIC void MEAPI McdModelDynamicsGetAngularVelocity(const McdModelID m, MeVector3 v);
/** rad/s, world frame. It wakes the body. */
MEPUBLIC void MEAPI McdModelDynamicsSetAngularVelocity(const McdModelID m, const MeReal x, const MeReal y,
                                                       const MeReal z);
/** N, world frame: the sum of the forces added since the last step. */
MEPUBLIC void MEAPI McdModelDynamicsGetForce(const McdModelID m, MeVector3 f);
/** N m, world frame: the sum of the torques added since the last step. */
MEPUBLIC void MEAPI McdModelDynamicsGetTorque(const McdModelID m, MeVector3 t);
/** N, world frame, at the centre of mass, for the next step only. */
MEPUBLIC void MEAPI McdModelDynamicsAddForce(const McdModelID m, const MeReal fx, const MeReal fy, const MeReal fz);
/** N m, world frame, for the next step only. */
MEPUBLIC void MEAPI McdModelDynamicsAddTorque(const McdModelID m, const MeReal tx, const MeReal ty, const MeReal tz);
/** Sets the damping of the linear and the angular velocity, 1/s, >= 0. */
MEPUBLIC void MEAPI McdModelDynamicsSetDamping(const McdModelID m, const MeReal lvd, const MeReal avd);
/** @} */

ME_END_C

#endif
