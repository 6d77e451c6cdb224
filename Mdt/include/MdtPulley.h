/** @file MdtPulley.h
 *  The pulley: a rope over two wheels that are fixed in the world, with a body at each of its ends. Beyond Karma.
 *
 *      length 0 + ratio * length 1 = length      m
 *
 *  with the lengths from each body's attachment to its wheel. A ratio of 2 is that of a block and tackle which has two
 *  strands on the side of the second body. It adds one row. By default it also pushes, as a chain of rods would; with
 *  MdtPulleySetSlack the sum may be smaller: a rope. It is a stop then, of first order in the step; without slack the
 *  pulley is of second order. One body may be the world (null): the rope then only holds the other one.
 *
 *  The rope does not end at a wheel: where a length reaches 0 it has no direction. The last one is kept, that end
 *  passes its wheel and its length grows again; reaching that state gets a warning. Stop bodies before they are there,
 *  as by the limit of a prismatic joint.
 */
#ifndef MDTPULLEY_H
#define MDTPULLEY_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a pulley, disabled, unattached, at the centres of mass, its wheels at the origin, ratio 1. The world owns
 *  it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. Beyond Karma,
 *  as all functions of this header. */
MEPUBLIC MdtPulleyID MEAPI MdtPulleyCreate(const MdtWorldID w);
/** Sets attachments, wheels, ratio, length and slack to the defaults of a new pulley. Bodies and enabled state do not
 *  change. */
MEPUBLIC void MEAPI MdtPulleyReset(const MdtPulleyID j);
/** The pulley as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtPulleyQuaConstraint(const MdtPulleyID j);
/** The constraint as a pulley; null if it is none. */
MEPUBLIC MdtPulleyID MEAPI MdtConstraintDCastPulley(const MdtConstraintID c);
/** The attachment to the body of index 0 or 1, world frame. */
MEPUBLIC void MEAPI MdtPulleySetPosition(const MdtPulleyID j, const unsigned int bodyindex, const MeReal x,
                                         const MeReal y, const MeReal z);
/** m, world frame: the present attachment to the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtPulleyGetPosition(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 position);
/** The point of the world at which the wheel of the body of index 0 or 1 turns the rope round. */
MEPUBLIC void MEAPI MdtPulleySetWheel(const MdtPulleyID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                                      const MeReal z);
/** m, world frame; 0 by default. */
MEPUBLIC void MEAPI MdtPulleyGetWheel(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 position);
/** The ratio, > 0. */
MEPUBLIC void MEAPI MdtPulleySetRatio(const MdtPulleyID j, const MeReal ratio);
/** 1 by default. */
MEPUBLIC MeReal MEAPI MdtPulleyGetRatio(const MdtPulleyID j);
/** m, >= 0: the length; as long as it has not been set, the sum in the poses in which bodies, attachments, wheels or
 *  ratio were set last. A program that changes it in each step, by little, has a winch. */
MEPUBLIC void MEAPI MdtPulleySetLength(const MdtPulleyID j, const MeReal length);
/** m: as set, or the sum in the poses set last. */
MEPUBLIC MeReal MEAPI MdtPulleyGetLength(const MdtPulleyID j);
/** Whether the rope may be slack: it pulls, and does not push. */
MEPUBLIC void MEAPI MdtPulleySetSlack(const MdtPulleyID j, const MeBool isSlack);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtPulleyGetSlack(const MdtPulleyID j);
/** m: the present length from the attachment of the body of index 0 or 1 to its wheel. */
MEPUBLIC MeReal MEAPI MdtPulleyGetDistance(const MdtPulleyID j, const unsigned int bodyindex);
/** N: what the rope pulls with at the first body in the last step (at the second one, times the ratio). */
MEPUBLIC MeReal MEAPI MdtPulleyGetTension(const MdtPulleyID j);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtPulleyDestroy(const MdtPulleyID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtPulleyEnable(const MdtPulleyID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtPulleyDisable(const MdtPulleyID j);
/** False for a new one, after MdtPulleyDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtPulleyIsEnabled(const MdtPulleyID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtPulleySetBodies(const MdtPulleyID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtPulleyGetBody(const MdtPulleyID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtPulleyGetForce(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtPulleyGetForce. */
MEPUBLIC void MEAPI MdtPulleyGetTorque(const MdtPulleyID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtPulleyGetWorld(const MdtPulleyID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtPulleySetUserData(const MdtPulleyID j, void *data);
/** The pointer of MdtPulleySetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtPulleyGetUserData(const MdtPulleyID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtPulleySetSortKey(const MdtPulleyID j, const MeI32 key);
/** The key of MdtPulleySetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtPulleyGetSortKey(const MdtPulleyID j);
/** @} */

ME_END_C

#endif
