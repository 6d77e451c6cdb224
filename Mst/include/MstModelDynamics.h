/** @file MstModelDynamics.h
 *  Models with bodies (User Guide ch. 5, "Fitting Out the Universe").
 */
#ifndef MSTMODELDYNAMICS_H
#define MSTMODELDYNAMICS_H

#include "McdModel.h"
#include "MdtBody.h"
#include "MstTypes.h"

ME_BEGIN_C

/**
 * Joins a model to a body: it takes the body's transform and velocities, by pointer. Null parts them; the model then
 * has no transform until one is set. A body may have several models, a model one body. McdModelSetTransformPtr, called
 * afterwards, puts the model elsewhere than the body. The model is destroyed, or parted, before the body.
 */
MEPUBLIC void MEAPI McdModelSetBody(const McdModelID m, const MdtBodyID b);
/** The model's body, or null. */
MEPUBLIC MdtBodyID MEAPI McdModelGetBody(const McdModelID m);
/** Puts the model's body at the origin, unturned and at rest; a model without a body stays where it is. */
MEPUBLIC void MEAPI McdModelDynamicsReset(const McdModelID m);

/** @name The body's properties, by its model
 *  As the functions of MdtBody.h. A model without a body gets a warning, and zeros. A fixed model is moved by its
 *  transform: McdModelSetTransformPtr.
 *  @{ */
MEPUBLIC void MEAPI McdModelDynamicsEnable(const McdModelID m);
MEPUBLIC void MEAPI McdModelDynamicsDisable(const McdModelID m);
MEPUBLIC MeBool MEAPI McdModelDynamicsIsEnabled(const McdModelID m);
MEPUBLIC void MEAPI McdModelDynamicsGetPosition(const McdModelID m, MeVector3 p);
MEPUBLIC void MEAPI McdModelDynamicsSetPosition(const McdModelID m, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI McdModelDynamicsGetQuaternion(const McdModelID m, MeVector4 q);
MEPUBLIC void MEAPI McdModelDynamicsSetQuaternion(const McdModelID m, const MeReal qw, const MeReal qx, const MeReal qy,
                                                  const MeReal qz);
MEPUBLIC void MEAPI McdModelDynamicsSetTransform(const McdModelID m, const MeMatrix4 t);
MEPUBLIC void MEAPI McdModelDynamicsGetLinearVelocity(const McdModelID m, MeVector3 v);
MEPUBLIC void MEAPI McdModelDynamicsSetLinearVelocity(const McdModelID m, const MeReal x, const MeReal y,
                                                      const MeReal z);
MEPUBLIC void MEAPI McdModelDynamicsGetAngularVelocity(const McdModelID m, MeVector3 v);
MEPUBLIC void MEAPI McdModelDynamicsSetAngularVelocity(const McdModelID m, const MeReal x, const MeReal y,
                                                       const MeReal z);
MEPUBLIC void MEAPI McdModelDynamicsGetForce(const McdModelID m, MeVector3 f);
MEPUBLIC void MEAPI McdModelDynamicsGetTorque(const McdModelID m, MeVector3 t);
MEPUBLIC void MEAPI McdModelDynamicsAddForce(const McdModelID m, const MeReal fx, const MeReal fy, const MeReal fz);
MEPUBLIC void MEAPI McdModelDynamicsAddTorque(const McdModelID m, const MeReal tx, const MeReal ty, const MeReal tz);
/** Damping of the linear and of the angular velocity. */
MEPUBLIC void MEAPI McdModelDynamicsSetDamping(const McdModelID m, const MeReal lvd, const MeReal avd);
/** @} */

ME_END_C

#endif
