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
 *  As the functions of MdtBody.h.
 *  @{ */
#define McdModelDynamicsEnable(m)               MdtBodyEnable(McdModelGetBody(m))
#define McdModelDynamicsDisable(m)              MdtBodyDisable(McdModelGetBody(m))
#define McdModelDynamicsIsEnabled(m)            MdtBodyIsEnabled(McdModelGetBody(m))
#define McdModelDynamicsGetPosition(m, p)       MdtBodyGetPosition(McdModelGetBody(m), (p))
#define McdModelDynamicsSetPosition(m, x, y, z) MdtBodySetPosition(McdModelGetBody(m), (x), (y), (z))
#define McdModelDynamicsGetQuaternion(m, q)     MdtBodyGetQuaternion(McdModelGetBody(m), (q))
#define McdModelDynamicsSetQuaternion(m, qw, qx, qy, qz)                                                               \
    MdtBodySetQuaternion(McdModelGetBody(m), (qw), (qx), (qy), (qz))
#define McdModelDynamicsSetTransform(m, t)             MdtBodySetTransform(McdModelGetBody(m), (t))
#define McdModelDynamicsGetLinearVelocity(m, v)        MdtBodyGetLinearVelocity(McdModelGetBody(m), (v))
#define McdModelDynamicsSetLinearVelocity(m, x, y, z)  MdtBodySetLinearVelocity(McdModelGetBody(m), (x), (y), (z))
#define McdModelDynamicsGetAngularVelocity(m, v)       MdtBodyGetAngularVelocity(McdModelGetBody(m), (v))
#define McdModelDynamicsSetAngularVelocity(m, x, y, z) MdtBodySetAngularVelocity(McdModelGetBody(m), (x), (y), (z))
#define McdModelDynamicsGetForce(m, f)                 MdtBodyGetForce(McdModelGetBody(m), (f))
#define McdModelDynamicsGetTorque(m, t)                MdtBodyGetTorque(McdModelGetBody(m), (t))
#define McdModelDynamicsAddForce(m, fx, fy, fz)        MdtBodyAddForce(McdModelGetBody(m), (fx), (fy), (fz))
#define McdModelDynamicsAddTorque(m, tx, ty, tz)       MdtBodyAddTorque(McdModelGetBody(m), (tx), (ty), (tz))
/** Damping of the linear and of the angular velocity. */
#define McdModelDynamicsSetDamping(m, lvd, avd)                                                                        \
    do {                                                                                                               \
        MdtBodySetLinearVelocityDamping(McdModelGetBody(m), (lvd));                                                    \
        MdtBodySetAngularVelocityDamping(McdModelGetBody(m), (avd));                                                   \
    } while (0)
/** @} */

ME_END_C

#endif
