/** @file MdtFixedPath.h
 *  The fixed-path joint: a ball-and-socket joint whose attachment the program moves
 *  (Dynamics guide ch. 3, "MdtFixedPath"). It removes three degrees of freedom.
 *
 *  Before every step, set the present position of the path, and its velocity. With the velocity the bodies follow the
 *  path without lag, and the joint's force includes the inertia of the motion; without it, only gamma corrects the
 *  error. Positions and velocities are in the frame of the body of that index, or of the world if that body is null.
 */
#ifndef MDTFIXEDPATH_H
#define MDTFIXEDPATH_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a fixed-path joint, disabled, unattached, at the bodies' origins, at rest. The world owns it. Returns null,
 *  with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtFixedPathID MEAPI MdtFixedPathCreate(const MdtWorldID w);
/** Sets positions and velocities to 0. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtFixedPathReset(const MdtFixedPathID j);
/** The fixed-path joint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtFixedPathQuaConstraint(const MdtFixedPathID j);
/** The constraint as a fixed-path joint; null if it is none. */
MEPUBLIC MdtFixedPathID MEAPI MdtConstraintDCastFixedPath(const MdtConstraintID c);
/** The attachment to the body of index 0 or 1, m, in that body's frame. Bad input as in MdtConstraint.h. */
MEPUBLIC void MEAPI MdtFixedPathSetPosition(const MdtFixedPathID j, const unsigned int bodyindex, const MeReal x,
                                            const MeReal y, const MeReal z);
/** m, in that body's frame, as set last; 0 by default. */
MEPUBLIC void MEAPI MdtFixedPathGetPosition(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 position);
/** The velocity of that attachment, m/s, in that body's frame. */
MEPUBLIC void MEAPI MdtFixedPathSetVelocity(const MdtFixedPathID j, const unsigned int bodyindex, const MeReal dx,
                                            const MeReal dy, const MeReal dz);
/** m/s, in that body's frame, as set last; 0 by default. */
MEPUBLIC void MEAPI MdtFixedPathGetVelocity(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 velocity);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtFixedPathDestroy(const MdtFixedPathID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtFixedPathEnable(const MdtFixedPathID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtFixedPathDisable(const MdtFixedPathID j);
/** False for a new one, after MdtFixedPathDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtFixedPathIsEnabled(const MdtFixedPathID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtFixedPathSetBodies(const MdtFixedPathID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtFixedPathGetBody(const MdtFixedPathID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtFixedPathGetForce(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtFixedPathGetForce. */
MEPUBLIC void MEAPI MdtFixedPathGetTorque(const MdtFixedPathID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtFixedPathGetWorld(const MdtFixedPathID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtFixedPathSetUserData(const MdtFixedPathID j, void *data);
/** The pointer of MdtFixedPathSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtFixedPathGetUserData(const MdtFixedPathID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtFixedPathSetSortKey(const MdtFixedPathID j, const MeI32 key);
/** The key of MdtFixedPathSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtFixedPathGetSortKey(const MdtFixedPathID j);
/** @} */

ME_END_C

#endif
