/** @file MdtGear.h
 *  The gear: couples the rotations of two bodies about axes of their own, as toothed wheels or a belt do; or the
 *  rotation of a pinion with the displacement of a rack. Beyond Karma.
 *
 *      wheels   ratio * angle 0 + angle 1 = 0              rad
 *      rack     radius * angle 0 + displacement 1 = 0      rad, m
 *
 *  Angles are relative to the housing that carries the shafts: the world, or one of the two bodies (then the other
 *  shaft is that of the housing in the world). They are positive about the axes by the right-hand rule, count full
 *  turns, and are 0 in the poses in which the gear was engaged: by MdtGearSetBodies, axis, ratio and housing, or by
 *  MdtGearEngage. Wheels on parallel axes that mesh on their outside have a positive ratio, those of a belt, or a wheel
 *  in a ring, a negative one.
 *
 *  The gear adds one row, and only couples: each shaft needs a hinge, the rack a prismatic joint. It corrects
 *  positions, not velocities alone, so that wheels do not get out of phase however long they turn. Where the housing is
 *  a third body, a MdtMimic of the two shafts' joints is the gear.
 */
#ifndef MDTGEAR_H
#define MDTGEAR_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a gear, disabled, unattached, with the x-axes of both bodies, wheels of ratio 1, and the world as housing.
 *  The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full.
 *  Beyond Karma, as all functions of this header. */
MEPUBLIC MdtGearID MEAPI MdtGearCreate(const MdtWorldID w);
/** Sets axes, ratio and housing to the defaults of a new gear. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtGearReset(const MdtGearID j);
/** The gear as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtGearQuaConstraint(const MdtGearID j);
/** The constraint as a gear; null if it is none. */
MEPUBLIC MdtGearID MEAPI MdtConstraintDCastGear(const MdtConstraintID c);
/** The ratio of two wheels: teeth of the first over those of the second one, not 0. Engages the gear. A number that is
 *  0 or not finite gets a warning and changes nothing. */
MEPUBLIC void MEAPI MdtGearSetRatio(const MdtGearID j, const MeReal ratio);
/** The same by numbers of teeth, not 0, which give ratios such as 1/3 exactly. A ring, with teeth on its inside, has a
 *  negative number. */
MEPUBLIC void MEAPI MdtGearSetTeeth(const MdtGearID j, const int first, const int second);
/** Makes the second body a rack, which slides along its axis: m, radius of the pinion, not 0; negative: the rack moves
 *  the other way. Engages the gear. */
MEPUBLIC void MEAPI MdtGearSetRack(const MdtGearID j, const MeReal radius);
/** The ratio of wheels, or the radius of a rack's pinion. */
MEPUBLIC MeReal MEAPI MdtGearGetRatio(const MdtGearID j);
/** The axis of the body of index 0 or 1, world frame, normalized here. Engages the gear. MdtGearSetAxis sets both. */
MEPUBLIC void MEAPI MdtGearBodySetAxis(const MdtGearID j, const unsigned int bodyindex, const MeReal x, const MeReal y,
                                       const MeReal z);
/** Unit vector, world frame: the present axis of the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtGearBodyGetAxis(const MdtGearID j, const unsigned int bodyindex, MeVector3 axis);
/** The housing: null, the world, or one of the gear's bodies; another one gets a warning and changes nothing. Engages
 *  the gear. */
MEPUBLIC void MEAPI MdtGearSetHousing(const MdtGearID j, const MdtBodyID housing);
/** Null, the default: the world. */
MEPUBLIC MdtBodyID MEAPI MdtGearGetHousing(const MdtGearID j);
/** Makes both coordinates 0 in the present poses: the wheels go on from here. */
MEPUBLIC void MEAPI MdtGearEngage(const MdtGearID j);
/** The angle of the body of index 0 or 1 since the gear was engaged, rad, or the rack's displacement, m. */
MEPUBLIC MeReal MEAPI MdtGearGetCoordinate(const MdtGearID j, const unsigned int bodyindex);
/** The error of the equation above: rad at the second wheel, or m at the rack. */
MEPUBLIC MeReal MEAPI MdtGearGetError(const MdtGearID j);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtGearDestroy(const MdtGearID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtGearEnable(const MdtGearID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtGearDisable(const MdtGearID j);
/** False for a new one, after MdtGearDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtGearIsEnabled(const MdtGearID j);
/** Attaches it; at most one body may be null, the world. Engages the gear in the bodies' present poses. */
MEPUBLIC void MEAPI MdtGearSetBodies(const MdtGearID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtGearGetBody(const MdtGearID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtGearGetForce(const MdtGearID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtGearGetForce. */
MEPUBLIC void MEAPI MdtGearGetTorque(const MdtGearID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtGearGetWorld(const MdtGearID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtGearSetUserData(const MdtGearID j, void *data);
/** The pointer of MdtGearSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtGearGetUserData(const MdtGearID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtGearSetSortKey(const MdtGearID j, const MeI32 key);
/** The key of MdtGearSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtGearGetSortKey(const MdtGearID j);
/** World frame, not zero, normalized here: one axis for both bodies, for parallel shafts. Engages the gear. */
MEPUBLIC void MEAPI MdtGearSetAxis(const MdtGearID j, const MeReal x, const MeReal y, const MeReal z);
/** Unit vector, world frame: the first body's axis at present; the second one's, if the first is the world. */
MEPUBLIC void MEAPI MdtGearGetAxis(const MdtGearID j, MeVector3 axis);
/** @} */

ME_END_C

#endif
