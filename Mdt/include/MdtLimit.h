/** @file MdtLimit.h
 *  Stops and motors of joints (Dynamics guide ch. 3, "Joint Limit" and "The Single Joint Limit").
 *
 *  By default a stop rebounds with the full speed: restitution is 1, as in the guide. For a joint that is to come to
 *  rest at its stop, call MdtSingleLimitSetRestitution(stop, 0).
 *
 *  A limit controls one degree of freedom: an angle [rad, rad/s, N m] or a length [m, m/s, N]; the comments use the
 *  units of lengths. It has a lower and an upper stop and a motor with limited force. A stop is hard, or a damped
 *  spring. The limit of a joint (MdtHingeGetLimit) is part of the joint; a program may also have an MdtBclLimit of its
 *  own, reset it, and copy it into joints. A change of a joint's limit wakes both bodies in the next step.
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
/** Clears the measured position, with the full turns, but no settings: for use after the bodies have been moved. */
MEPUBLIC void MEAPI MdtLimitResetState(const MdtLimitID limit);
/** The coordinate at the end of the last step, with the offset. It is measured while the limit is active or powered, or
 *  after MdtLimitCalculatePosition; otherwise a warning. */
MEPUBLIC MeReal MEAPI MdtLimitGetPosition(const MdtLimitID l);
/** The rate of the coordinate, m/s. */
MEPUBLIC MeReal MEAPI MdtLimitGetVelocity(const MdtLimitID l);
/** Sets the offset so that the last measured coordinate becomes @a NewPosition. Nothing moves. */
MEPUBLIC void MEAPI MdtLimitSetPosition(MdtLimitID l, const MeReal NewPosition);
/** The distance of the coordinate beyond a stop; 0 between the stops. */
MEPUBLIC MeReal MEAPI MdtLimitGetOvershoot(const MdtLimitID l);
/** A stop whose stiffness is above the threshold [N/m, >= 0] is hard: its damping is ignored, its restitution used. At
 *  or below it, the stop is a damped spring, and its restitution is ignored. A stiffness of MEINFINITY is always hard.
 *  */
MEPUBLIC void MEAPI MdtLimitSetStiffnessThreshold(const MdtLimitID l, const MeReal NewStiffnessThreshold);
/** N/m; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtLimitGetStiffnessThreshold(const MdtLimitID l);
/** Pointers to the stops, for reading and writing; valid as long as the limit. */
MEPUBLIC MdtSingleLimitID MEAPI MdtLimitGetLowerLimit(const MdtLimitID l);
/** The upper stop; null, with a warning, for a null limit. */
MEPUBLIC MdtSingleLimitID MEAPI MdtLimitGetUpperLimit(const MdtLimitID l);
/** Sets a stop to a copy of @a sl. If the stops would cross, the other one is set to the same value. */
MEPUBLIC void MEAPI MdtLimitSetLowerLimit(const MdtLimitID l, const MdtSingleLimitID sl);
/** The same for the upper stop. */
MEPUBLIC void MEAPI MdtLimitSetUpperLimit(const MdtLimitID l, const MdtSingleLimitID sl);
/** @} */

/** @name Switches
 *  @{ */
/** Switches the stops on and off. Off by default. Warns if the lower stop is above the upper one. */
MEPUBLIC void MEAPI MdtLimitActivateLimits(const MdtLimitID l, const MeBool NewActivationState);
/** Whether the stops are on; MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtLimitIsActive(const MdtLimitID l);
/** Switches the motor on and off. Off by default (the guides' text says on; their tables and samples need off). */
MEPUBLIC void MEAPI MdtLimitActivateMotor(const MdtLimitID l, const MeBool NewActivationState);
/** Whether a motor, of a velocity or a position, is on; MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtLimitIsMotorized(const MdtLimitID l);
/** Measures the coordinate also without stops and motor. It cannot be switched off while they need it. */
MEPUBLIC void MEAPI MdtLimitCalculatePosition(const MdtLimitID l, const MeBool NewState);
/** True if the coordinate is measured, for any reason. */
MEPUBLIC MeBool MEAPI MdtLimitPositionIsCalculated(const MdtLimitID l);
/** @} */

/** @name The motor of a velocity, which replaces one of a position
 *  @{ */
/** Switches the motor on: it drives the coordinate to @a desiredVelocity with at most @a forceLimit in either
 *  direction (a negative one counts as 0, with a warning); a force limit of 0 switches it off. A desired velocity of 0
 *  is a brake with dry friction. */
MEPUBLIC void MEAPI MdtLimitSetLimitedForceMotor(const MdtLimitID l, const MeReal desiredVelocity,
                                                 const MeReal forceLimit);
/** Whether the motor tracks the position that follows from its velocity. Off, the default: the desired velocity is
 *  that at the end of the step, as in the guide; in a step in which it is changed by v the coordinate moves by half a
 *  step's length times v less, as its mean velocity is that of both ends. On: as far as the force allows, each step
 *  moves the coordinate by the step's length times the desired velocity, and ends with that velocity. So a program
 *  that sets the mean velocity of a path's next step leads the joint along the path. Distance lost for lack of force
 *  is not made up for. */
MEPUBLIC void MEAPI MdtLimitSetMotorTracking(const MdtLimitID l, const MeBool NewState);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtLimitMotorIsTracking(const MdtLimitID l);
/** m/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtLimitGetMotorDesiredVelocity(const MdtLimitID l);
/** N; 0 by default. */
MEPUBLIC MeReal MEAPI MdtLimitGetMotorMaxForce(const MdtLimitID l);
/** @} */

/** @name The motor of a position, beyond Karma
 *  A damped spring to a target: what a program would do by proportional and derivative control, but stable at any
 *  stiffness and step, and without forces that lag. The joint moves as an oscillator of the given frequency and damping
 *  ratio. Its mass is that which the joint's two bodies show along the coordinate, the moment of inertia of a door
 *  about its hinge: it is measured in every step, without other joints of these bodies. Under a load F the coordinate
 *  stays off by F / (mass (2 pi frequency)²). Of an angle the target counts full turns, as the coordinate does.
 *
 *  Up to 2 pi frequency x step = 2 the motion is of second order in the step; above it is damped more. It does not
 *  overshoot more than the oscillator, but by a hundredth of its way where steps turn by .3 rad. A frequency far above
 *  1 / step makes the motor as rigid as a joint, up to its force.
 *  @{ */
/** Switches the motor on, in place of one of a velocity: @a target [m] at rest, @a frequency [Hz] of the undamped
 *  oscillation, @a dampingRatio (1: critically damped; 0: none), with at most @a forceLimit [N] in either direction
 *  (MEINFINITY: any force). A frequency or force limit of 0 switches it off. A negative number gets a warning. */
MEPUBLIC void MEAPI MdtLimitSetPositionMotor(const MdtLimitID l, const MeReal target, const MeReal frequency,
                                             const MeReal dampingRatio, const MeReal forceLimit);
/** Moves the target: where it is at the start of the next step, and its velocity [m/s] from there on, which the motor
 *  follows without lag. To be called before every step if the velocity is not 0, as steps do not change the target.
 *  Warns without a position motor. */
MEPUBLIC void MEAPI MdtLimitSetMotorTarget(const MdtLimitID l, const MeReal target, const MeReal velocity);
/** The target's velocity is MdtLimitGetMotorDesiredVelocity, and the force limit MdtLimitGetMotorMaxForce. */
MEPUBLIC MeReal MEAPI MdtLimitGetMotorTarget(const MdtLimitID l);
/** 0: the motor is one of a velocity. */
MEPUBLIC MeReal MEAPI MdtLimitGetMotorFrequency(const MdtLimitID l);
/** As set last; 0 by default. */
MEPUBLIC MeReal MEAPI MdtLimitGetMotorDampingRatio(const MdtLimitID l);
/** @} */

/** @name The lock: keeps the coordinate at a value with limited force; the motor is off meanwhile
 *  @{ */
/** Switches the lock on, at a value [m] with a force limit [N] (a negative one counts as 0). Gamma corrects the error.
 *  */
MEPUBLIC void MEAPI MdtLimitSetLock(const MdtLimitID l, const MeReal lock_value, const MeReal forceLimit);
/** Switches the lock on at its last value and force, or off. Default off. */
MEPUBLIC void MEAPI MdtLimitActivateLock(const MdtLimitID l, const MeBool NewActivationState);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtLimitIsLocked(const MdtLimitID l);
/** @} */

/** @name One stop
 *  @{ */
/** Defaults: stop 0, restitution 1, stiffness MEINFINITY, damping 0. */
MEPUBLIC void MEAPI MdtSingleLimitReset(const MdtSingleLimitID limit);
/** m: the smallest or the largest value of the coordinate. The spring of a soft stop begins there. */
MEPUBLIC void MEAPI MdtSingleLimitSetStop(const MdtSingleLimitID sl, const MeReal NewStop);
/** m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtSingleLimitGetStop(const MdtSingleLimitID sl);
/** N/m, >= 0 (a negative one counts as 0). With stiffness and damping 0 the stop does nothing. */
MEPUBLIC void MEAPI MdtSingleLimitSetStiffness(const MdtSingleLimitID sl, const MeReal NewStiffness);
/** N/m; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtSingleLimitGetStiffness(const MdtSingleLimitID sl);
/** N s/m, >= 0 (a negative one counts as 0). */
MEPUBLIC void MEAPI MdtSingleLimitSetDamping(const MdtSingleLimitID sl, const MeReal NewDamping);
/** N s/m; 0 by default. */
MEPUBLIC MeReal MEAPI MdtSingleLimitGetDamping(const MdtSingleLimitID sl);
/** 0..1 (clamped). */
MEPUBLIC void MEAPI MdtSingleLimitSetRestitution(const MdtSingleLimitID sl, const MeReal NewRestitution);
/** 1 by default. */
MEPUBLIC MeReal MEAPI MdtSingleLimitGetRestitution(const MdtSingleLimitID sl);
/** @} */

ME_END_C

#endif
