/** @file MdtRPROJoint.h The RPRO joint, relative position and relative orientation: a program or an animation drives
 *  how one body is turned against the other, up to a strength (Dynamics guide ch. 3, "MdtRPROJoint"). It removes six
 *  degrees of freedom.
 *
 *  Each body has an attachment frame, by default that of its centre of mass. The joint holds the frames at one place,
 *  and the first frame turned against the second by the relative quaternion. A moving orientation is given before every
 *  step as the quaternion now and the angular velocity with which it moves on. Strengths bound the forces: where more
 *  would be needed, the joint gives way, and comes back when it can. Half a turn away from its quaternion the joint has
 *  no direction to turn back in; coming there gets a warning.
 */
#ifndef MDTRPROJOINT_H
#define MDTRPROJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates an RPRO joint, disabled, unattached, with the frames of the centres of mass, aligned, at rest, of unlimited
 *  strength. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtRPROJointID MEAPI MdtRPROJointCreate(const MdtWorldID w);
/** Sets frames, quaternion, velocity and strengths to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtRPROJointReset(const MdtRPROJointID j);
/** The RPRO joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtRPROJointQuaConstraint(const MdtRPROJointID j);
/** The constraint as an RPRO joint; null when it is none. */
MEPUBLIC MdtRPROJointID MEAPI MdtConstraintDCastRPROJoint(const MdtConstraintID c);
/** @name The wanted orientation of the first frame in the second
 *  A unit quaternion (w, x, y, z) is wanted; others are normalized, and one of length zero gets a warning. The angular
 *  velocity [rad/s] is in the axes of the second frame: the world's, where the second body is null.
 *  @{ */
MEPUBLIC void MEAPI MdtRPROJointSetRelativeQuaternion(const MdtRPROJointID j, const MeVector4 q);
MEPUBLIC void MEAPI MdtRPROJointGetRelativeQuaternion(const MdtRPROJointID j, MeVector4 q);
MEPUBLIC void MEAPI MdtRPROJointSetRelativeAngularVelocity(MdtRPROJointID j, MeVector3 w);
MEPUBLIC void MEAPI MdtRPROJointGetRelativeAngularVelocity(const MdtRPROJointID j, MeVector3 w);
/** @} */
/** @name The attachment frames, in the frames of the bodies' centres of mass
 *  @{ */
MEPUBLIC void MEAPI MdtRPROJointSetAttachmentPosition(const MdtRPROJointID j, const MeReal x, const MeReal y,
                                                      const MeReal z, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtRPROJointGetAttachmentPosition(const MdtRPROJointID j, const unsigned int bodyindex,
                                                      MeVector3 position);
MEPUBLIC void MEAPI MdtRPROJointSetAttachmentQuaternion(const MdtRPROJointID j, const MeReal q0, const MeReal q1,
                                                        const MeReal q2, const MeReal q3, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtRPROJointGetAttachmentQuaternion(const MdtRPROJointID j, const unsigned int bodyindex,
                                                        MeVector4 quaternion);
/** @} */
/** @name Strengths: the most force [N] along, and torque [N m] about, each axis of the second frame
 *  At least 0; MEINFINITY, the default, never gives way.
 *  @{ */
MEPUBLIC void MEAPI MdtRPROJointSetLinearStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY,
                                                  const MeReal sZ);
MEPUBLIC void MEAPI MdtRPROJointGetLinearStrength(const MdtRPROJointID j, MeVector3 v);
MEPUBLIC void MEAPI MdtRPROJointSetAngularStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY,
                                                   const MeReal sZ);
MEPUBLIC void MEAPI MdtRPROJointGetAngularStrength(const MdtRPROJointID j, MeVector3 v);
/** @} */
/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
 *  @{ */
static inline void MdtRPROJointDestroy(const MdtRPROJointID j) {
    MdtConstraintDestroy(MdtRPROJointQuaConstraint(j));
}
static inline void MdtRPROJointEnable(const MdtRPROJointID j) {
    MdtConstraintEnable(MdtRPROJointQuaConstraint(j));
}
static inline void MdtRPROJointDisable(const MdtRPROJointID j) {
    MdtConstraintDisable(MdtRPROJointQuaConstraint(j));
}
static inline MeBool MdtRPROJointIsEnabled(const MdtRPROJointID j) {
    return MdtConstraintIsEnabled(MdtRPROJointQuaConstraint(j));
}
static inline void MdtRPROJointSetBodies(const MdtRPROJointID j, const MdtBodyID b1, const MdtBodyID b2) {
    MdtConstraintSetBodies(MdtRPROJointQuaConstraint(j), b1, b2);
}
static inline MdtBodyID MdtRPROJointGetBody(const MdtRPROJointID j, const unsigned int bodyindex) {
    return MdtConstraintGetBody(MdtRPROJointQuaConstraint(j), bodyindex);
}
static inline void MdtRPROJointGetForce(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 force) {
    MdtConstraintGetForce(MdtRPROJointQuaConstraint(j), bodyindex, force);
}
static inline void MdtRPROJointGetTorque(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 torque) {
    MdtConstraintGetTorque(MdtRPROJointQuaConstraint(j), bodyindex, torque);
}
static inline MdtWorldID MdtRPROJointGetWorld(const MdtRPROJointID j) {
    return MdtConstraintGetWorld(MdtRPROJointQuaConstraint(j));
}
static inline void MdtRPROJointSetUserData(const MdtRPROJointID j, void *data) {
    MdtConstraintSetUserData(MdtRPROJointQuaConstraint(j), data);
}
static inline void *MdtRPROJointGetUserData(const MdtRPROJointID j) {
    return MdtConstraintGetUserData(MdtRPROJointQuaConstraint(j));
}
static inline void MdtRPROJointSetSortKey(const MdtRPROJointID j, const MeI32 key) {
    MdtConstraintSetSortKey(MdtRPROJointQuaConstraint(j), key);
}
static inline MeI32 MdtRPROJointGetSortKey(const MdtRPROJointID j) {
    return MdtConstraintGetSortKey(MdtRPROJointQuaConstraint(j));
}
/** @} */

/** @name Other names of the guides and of old programs for the above
 *  @{ */
static inline void MdtRPROJointGetAttachmentOrientation(const MdtRPROJointID j, const unsigned int bodyindex,
                                                        MeVector4 quaternion) {
    MdtRPROJointGetAttachmentQuaternion(j, bodyindex, quaternion);
}
static inline void MdtRPROJointGetPosition(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 position) {
    MdtRPROJointGetAttachmentPosition(j, bodyindex, position);
}
static inline void MdtRPROJointSetPosition(const MdtRPROJointID j, const MeReal x, const MeReal y, const MeReal z,
                                           const unsigned int bodyindex) {
    MdtRPROJointSetAttachmentPosition(j, x, y, z, bodyindex);
}
#define MdtRPROSetSortKey(j, key) MdtRPROJointSetSortKey((j), (key))
#define MdtRPROGetSortKey(j)      MdtRPROJointGetSortKey(j)
/** @} */

ME_END_C

#endif
