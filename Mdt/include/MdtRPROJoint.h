/** @file MdtRPROJoint.h The RPRO joint, relative position and relative orientation: a program or an animation drives
 *  the relative orientation of two bodies, with limited strength (Dynamics guide ch. 3, "MdtRPROJoint"). It removes
 *  six degrees of freedom.
 *
 *  Each body has an attachment frame, by default that of its centre of mass. The joint makes the origins of the frames
 *  coincide, and rotates the first frame relative to the second by the relative quaternion. For a moving orientation,
 *  set the present quaternion and its angular velocity before every step. Strengths limit the forces: under larger
 *  loads the joint gives way, and returns when it can. Half a turn away from its quaternion the direction of return is
 *  undefined; reaching that gets a warning.
 */
#ifndef MDTRPROJOINT_H
#define MDTRPROJOINT_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates an RPRO joint, disabled, unattached, with the frames of the centres of mass, aligned, at rest, of unlimited
 *  strength. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtRPROJointID MEAPI MdtRPROJointCreate(const MdtWorldID w);
/** Sets frames, quaternion, velocity and strengths to the defaults of a new joint. Bodies and enabled state do not
 *  change. */
MEPUBLIC void MEAPI MdtRPROJointReset(const MdtRPROJointID j);
/** The RPRO joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtRPROJointQuaConstraint(const MdtRPROJointID j);
/** The constraint as an RPRO joint; null if it is none. */
MEPUBLIC MdtRPROJointID MEAPI MdtConstraintDCastRPROJoint(const MdtConstraintID c);
/** @name Target orientation of the first frame in the second
 *  A unit quaternion (w, x, y, z); others are normalized, and one of length zero gets a warning. The angular velocity
 *  [rad/s] is in the axes of the second frame: the world's, if the second body is null.
 *  @{ */
/** The target at the start of the next step; steps do not change it. */
MEPUBLIC void MEAPI MdtRPROJointSetRelativeQuaternion(const MdtRPROJointID j, const MeVector4 q);
/** The target, not the bodies' present orientation; (1, 0, 0, 0) by default. */
MEPUBLIC void MEAPI MdtRPROJointGetRelativeQuaternion(const MdtRPROJointID j, MeVector4 q);
/** rad/s: the target's velocity in the next step, which the joint follows without lag. */
MEPUBLIC void MEAPI MdtRPROJointSetRelativeAngularVelocity(MdtRPROJointID j, MeVector3 w);
/** rad/s; 0 by default. */
MEPUBLIC void MEAPI MdtRPROJointGetRelativeAngularVelocity(const MdtRPROJointID j, MeVector3 w);
/** @} */
/** @name The attachment frames, in the frames of the bodies' centres of mass
 *  m, and quaternions (w, x, y, z), of the body of index 0 or 1; of the world, if it is null. Default: 0, no rotation.
 *  @{ */
/** m: origin of the frame of the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtRPROJointSetAttachmentPosition(const MdtRPROJointID j, const MeReal x, const MeReal y,
                                                      const MeReal z, const unsigned int bodyindex);
/** m; 0 by default. */
MEPUBLIC void MEAPI MdtRPROJointGetAttachmentPosition(const MdtRPROJointID j, const unsigned int bodyindex,
                                                      MeVector3 position);
/** (q0, q1, q2, q3) = (w, x, y, z): rotation of that frame; normalized here, zero gets a warning. */
MEPUBLIC void MEAPI MdtRPROJointSetAttachmentQuaternion(const MdtRPROJointID j, const MeReal q0, const MeReal q1,
                                                        const MeReal q2, const MeReal q3, const unsigned int bodyindex);
/** (w, x, y, z); (1, 0, 0, 0) by default. */
MEPUBLIC void MEAPI MdtRPROJointGetAttachmentQuaternion(const MdtRPROJointID j, const unsigned int bodyindex,
                                                        MeVector4 quaternion);
/** @} */
/** @name Strengths: the largest force [N] along, and torque [N m] about, each axis of the second frame
 *  At least 0; MEINFINITY, the default: unlimited.
 *  @{ */
/** N. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtRPROJointSetLinearStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY,
                                                  const MeReal sZ);
/** N; MEINFINITY by default. */
MEPUBLIC void MEAPI MdtRPROJointGetLinearStrength(const MdtRPROJointID j, MeVector3 v);
/** N m. A negative number gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtRPROJointSetAngularStrength(const MdtRPROJointID j, const MeReal sX, const MeReal sY,
                                                   const MeReal sZ);
/** N m; MEINFINITY by default. */
MEPUBLIC void MEAPI MdtRPROJointGetAngularStrength(const MdtRPROJointID j, MeVector3 v);
/** @} */
/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtRPROJointDestroy(const MdtRPROJointID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtRPROJointEnable(const MdtRPROJointID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtRPROJointDisable(const MdtRPROJointID j);
/** False for a new one, after MdtRPROJointDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtRPROJointIsEnabled(const MdtRPROJointID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtRPROJointSetBodies(const MdtRPROJointID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtRPROJointGetBody(const MdtRPROJointID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtRPROJointGetForce(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtRPROJointGetForce. */
MEPUBLIC void MEAPI MdtRPROJointGetTorque(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtRPROJointGetWorld(const MdtRPROJointID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtRPROJointSetUserData(const MdtRPROJointID j, void *data);
/** The pointer of MdtRPROJointSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtRPROJointGetUserData(const MdtRPROJointID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtRPROJointSetSortKey(const MdtRPROJointID j, const MeI32 key);
/** The key of MdtRPROJointSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtRPROJointGetSortKey(const MdtRPROJointID j);
/** @} */

/** @name Other names of the guides and of old programs for the above
 *  @{ */
/** MdtRPROJointGetAttachmentQuaternion. */
MEPUBLIC void MEAPI MdtRPROJointGetAttachmentOrientation(const MdtRPROJointID j, const unsigned int bodyindex,
                                                         MeVector4 quaternion);
/** MdtRPROJointGetAttachmentPosition. */
MEPUBLIC void MEAPI MdtRPROJointGetPosition(const MdtRPROJointID j, const unsigned int bodyindex, MeVector3 position);
/** MdtRPROJointSetAttachmentPosition. */
MEPUBLIC void MEAPI MdtRPROJointSetPosition(const MdtRPROJointID j, const MeReal x, const MeReal y, const MeReal z,
                                            const unsigned int bodyindex);
/** MdtRPROJointSetSortKey. */
MEPUBLIC void MEAPI MdtRPROSetSortKey(const MdtRPROJointID j, const MeI32 key);
/** MdtRPROJointGetSortKey. */
MEPUBLIC MeI32 MEAPI MdtRPROGetSortKey(const MdtRPROJointID j);
/** @} */

ME_END_C

#endif
