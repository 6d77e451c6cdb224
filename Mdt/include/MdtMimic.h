/** @file MdtMimic.h
 *  The mimic: lets the coordinate of one joint follow that of another one. Beyond Karma.
 *
 *      coordinate of the second joint = ratio * coordinate of the first joint + offset
 *
 *  Both are hinges (rad, full turns counted), prismatic joints (m) or car wheels (rad about the hinge axis), in any
 *  combination. The coordinates of the first two are those of their limits (MdtLimitGetPosition). Turns of a car
 *  wheel, and of a hinge whose limit does not measure, are counted from when the mimic is enabled. Limits and motors
 *  of either work, and act on both; forces go both ways. It adds one row.
 *
 *  The joints may have up to four bodies, such as two fingers and the hand that carries them. Then the mimic's
 *  partition is solved by the exact solver, also where the program asks for the fast one. Of these bodies one may be
 *  moved by the program (MdtBodySetKinematic). MdtMimicGetForce has the first two bodies only.
 *
 *  While one of the joints is disabled, has been destroyed or got other bodies, the mimic does nothing, with a warning
 *  when that begins.
 */
#ifndef MDTMIMIC_H
#define MDTMIMIC_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a mimic, disabled, unattached, without joints, with ratio 1 and offset 0. The world owns it.
 *  Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. Beyond Karma, as
 *  all functions of this header. */
MEPUBLIC MdtMimicID MEAPI MdtMimicCreate(const MdtWorldID w);
/** Sets joints, ratio and offset to the defaults of a new mimic. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtMimicReset(const MdtMimicID j);
/** The mimic as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtMimicQuaConstraint(const MdtMimicID j);
/** The constraint as a mimic; null if it is none. */
MEPUBLIC MdtMimicID MEAPI MdtConstraintDCastMimic(const MdtConstraintID c);
/** The two joints; attaches the mimic to their bodies. Attach the joints before. One that is none of these, of another
 *  world, unattached, or the same as the other gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtMimicSetJoints(const MdtMimicID j, const MdtConstraintID first, const MdtConstraintID second);
/** The joint of index 0 or 1; null: not set, or destroyed. */
MEPUBLIC MdtConstraintID MEAPI MdtMimicGetJoint(const MdtMimicID j, const unsigned int jointindex);
/** The ratio, finite: m/rad where the second joint slides and the first turns. 0: the second joint is locked. */
MEPUBLIC void MEAPI MdtMimicSetRatio(const MdtMimicID j, const MeReal ratio);
/** 1 by default. */
MEPUBLIC MeReal MEAPI MdtMimicGetRatio(const MdtMimicID j);
/** The offset, rad or m. */
MEPUBLIC void MEAPI MdtMimicSetOffset(const MdtMimicID j, const MeReal offset);
/** rad or m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtMimicGetOffset(const MdtMimicID j);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  MdtMimicSetJoints sets the bodies; with others, by MdtMimicSetBodies, it does nothing.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtMimicDestroy(const MdtMimicID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtMimicEnable(const MdtMimicID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtMimicDisable(const MdtMimicID j);
/** False for a new one, after MdtMimicDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtMimicIsEnabled(const MdtMimicID j);
/** MdtMimicSetJoints attaches the mimic to its joints' bodies; a program need not call this. */
MEPUBLIC void MEAPI MdtMimicSetBodies(const MdtMimicID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtMimicGetBody(const MdtMimicID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1 in the last step. Further bodies of the joints are not reported. */
MEPUBLIC void MEAPI MdtMimicGetForce(const MdtMimicID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtMimicGetForce. */
MEPUBLIC void MEAPI MdtMimicGetTorque(const MdtMimicID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtMimicGetWorld(const MdtMimicID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtMimicSetUserData(const MdtMimicID j, void *data);
/** The pointer of MdtMimicSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtMimicGetUserData(const MdtMimicID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtMimicSetSortKey(const MdtMimicID j, const MeI32 key);
/** The key of MdtMimicSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtMimicGetSortKey(const MdtMimicID j);
/** @} */

ME_END_C

#endif
