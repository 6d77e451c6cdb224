/** @file MdtLimit.h
 *  Stops and motors of joints (Dynamics guide ch. 3, "Joint Limit" and "The Single Joint Limit").
 *
 *  A stop rebounds with all of its speed unless it is told otherwise: restitution is 1 by default, as the guide has it.
 *  A joint that is to come to rest at its stop wants MdtSingleLimitSetRestitution(stop, 0).
 *
 *  A limit governs one degree of freedom: an angle [rad, rad/s, N m] or a length [m, m/s, N]; the comments speak of
 *  lengths. It has a lower and an upper stop and a motor with limited force. A stop is hard, or a damped spring. The
 *  limit of a joint (MdtHingeGetLimit) is part of it; a program may also keep an MdtBclLimit of its own, reset it, and
 *  copy it into joints. None of these functions wakes a body.
 *
 *  A null limit, or a number that is not finite, gets a warning and changes nothing; accessors then return 0.
 */
#ifndef MDTLIMIT_H
#define MDTLIMIT_H

#include "MdtTypes.h"

ME_BEGIN_C

/** @name The whole limit
 *  @{ */
/** Defaults: not active, not powered, the motor not tracking, position not calculated, threshold MEINFINITY, default
 *  stops, offset 0. */
MEPUBLIC void MEAPI MdtLimitReset(const MdtLimitID limit);
/** Forgets the measured position (and with it the full turns), not the settings: for bodies that were put elsewhere. */
MEPUBLIC void MEAPI MdtLimitResetState(const MdtLimitID limit);
/** The coordinate at the end of the last step, offset included. Measured while the limit is active, powered or asked to
 *  calculate it (MdtLimitCalculatePosition); else a warning. */
MEPUBLIC MeReal MEAPI MdtLimitGetPosition(const MdtLimitID l);
/** Its rate. */
MEPUBLIC MeReal MEAPI MdtLimitGetVelocity(const MdtLimitID l);
/** Sets the offset so that the coordinate that was last measured reads @a NewPosition. Nothing moves. */
MEPUBLIC void MEAPI MdtLimitSetPosition(MdtLimitID l, const MeReal NewPosition);
/** How far the coordinate is beyond a stop; 0 between them. */
MEPUBLIC MeReal MEAPI MdtLimitGetOvershoot(const MdtLimitID l);
/** A stop whose stiffness is above the threshold [N/m, >= 0] is hard: damping is ignored and restitution used. At or
 *  below, it is a spring and damper, and restitution is ignored. A stiffness of MEINFINITY is hard at any threshold. */
MEPUBLIC void MEAPI MdtLimitSetStiffnessThreshold(const MdtLimitID l, const MeReal NewStiffnessThreshold);
MEPUBLIC MeReal MEAPI MdtLimitGetStiffnessThreshold(const MdtLimitID l);
/** The stops, to read and to write; they live as long as the limit. */
MEPUBLIC MdtSingleLimitID MEAPI MdtLimitGetLowerLimit(const MdtLimitID l);
MEPUBLIC MdtSingleLimitID MEAPI MdtLimitGetUpperLimit(const MdtLimitID l);
/** Copies @a sl. When the stops would cross, the other one moves to the new stop. */
MEPUBLIC void MEAPI MdtLimitSetLowerLimit(const MdtLimitID l, const MdtSingleLimitID sl);
MEPUBLIC void MEAPI MdtLimitSetUpperLimit(const MdtLimitID l, const MdtSingleLimitID sl);
/** @} */

/** @name Switches
 *  @{ */
/** The stops. Off by default. A warning where the lower one is above the upper one now. */
MEPUBLIC void MEAPI MdtLimitActivateLimits(const MdtLimitID l, const MeBool NewActivationState);
MEPUBLIC MeBool MEAPI MdtLimitIsActive(const MdtLimitID l);
/** The motor. Off by default (the guides' text says on; their tables and samples need off). */
MEPUBLIC void MEAPI MdtLimitActivateMotor(const MdtLimitID l, const MeBool NewActivationState);
MEPUBLIC MeBool MEAPI MdtLimitIsMotorized(const MdtLimitID l);
/** Measuring the coordinate though neither stops nor motor need it. It cannot be switched off while they do. */
MEPUBLIC void MEAPI MdtLimitCalculatePosition(const MdtLimitID l, const MeBool NewState);
/** True when the coordinate is measured, for whatever reason. */
MEPUBLIC MeBool MEAPI MdtLimitPositionIsCalculated(const MdtLimitID l);
/** @} */

/** @name The motor
 *  @{ */
/** The motor aims at @a desiredVelocity with at most @a forceLimit either way (a negative one counts as 0), and is
 *  switched on; a force limit of 0 switches it off. A desired velocity of 0 is a brake with dry friction. */
MEPUBLIC void MEAPI MdtLimitSetLimitedForceMotor(const MdtLimitID l, const MeReal desiredVelocity,
                                                 const MeReal forceLimit);
/** Whether the motor tracks the position that its velocity leads to. Off, the default: the desired velocity is that of
 *  the step's end, as the guide has it. On: as far as the force allows, the coordinate moves by the step's length times
 *  the desired velocity in every step, and ends it with that velocity, so that a program that sets the mean velocity of
 *  a path's next step leads the joint along the path. What a step has missed for want of force is not made up for. */
MEPUBLIC void MEAPI MdtLimitSetMotorTracking(const MdtLimitID l, const MeBool NewState);
MEPUBLIC MeBool MEAPI MdtLimitMotorIsTracking(const MdtLimitID l);
MEPUBLIC MeReal MEAPI MdtLimitGetMotorDesiredVelocity(const MdtLimitID l);
MEPUBLIC MeReal MEAPI MdtLimitGetMotorMaxForce(const MdtLimitID l);
/** @} */

/** @name The lock: holds the coordinate at a value, with at most a force either way; the motor rests meanwhile
 *  @{ */
/** m and N (a negative force counts as 0), and switches the lock on. The coordinate is pulled to the value by gamma. */
MEPUBLIC void MEAPI MdtLimitSetLock(const MdtLimitID l, const MeReal lock_value, const MeReal forceLimit);
MEPUBLIC void MEAPI MdtLimitActivateLock(const MdtLimitID l, const MeBool NewActivationState);
MEPUBLIC MeBool MEAPI MdtLimitIsLocked(const MdtLimitID l);
/** @} */

/** @name One stop
 *  @{ */
/** Defaults: stop 0, restitution 1, stiffness MEINFINITY, damping 0. */
MEPUBLIC void MEAPI MdtSingleLimitReset(const MdtSingleLimitID limit);
/** m: the least or the greatest value of the coordinate. For a soft stop, where the spring begins. */
MEPUBLIC void MEAPI MdtSingleLimitSetStop(const MdtSingleLimitID sl, const MeReal NewStop);
MEPUBLIC MeReal MEAPI MdtSingleLimitGetStop(const MdtSingleLimitID sl);
/** N/m, >= 0 (a negative one counts as 0). With stiffness and damping 0 the stop does nothing. */
MEPUBLIC void MEAPI MdtSingleLimitSetStiffness(const MdtSingleLimitID sl, const MeReal NewStiffness);
MEPUBLIC MeReal MEAPI MdtSingleLimitGetStiffness(const MdtSingleLimitID sl);
/** N s/m, >= 0 (a negative one counts as 0). */
MEPUBLIC void MEAPI MdtSingleLimitSetDamping(const MdtSingleLimitID sl, const MeReal NewDamping);
MEPUBLIC MeReal MEAPI MdtSingleLimitGetDamping(const MdtSingleLimitID sl);
/** 0..1 (clamped). */
MEPUBLIC void MEAPI MdtSingleLimitSetRestitution(const MdtSingleLimitID sl, const MeReal NewRestitution);
MEPUBLIC MeReal MEAPI MdtSingleLimitGetRestitution(const MdtSingleLimitID sl);
/** @} */

ME_END_C

#endif
