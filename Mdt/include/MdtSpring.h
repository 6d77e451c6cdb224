/** @file MdtSpring.h
 *  The spring: controls the distance between two points, as a spring, rod, string or elastic does
 *  (Dynamics guide ch. 3, "MdtSpring"). It adds one row, another one for a motor, and leaves all rotations free.
 *
 *  The distance, m, is the coordinate of the joint's limit. Stiffness and damping are those of the limit's two stops,
 *  which both lie at the rest length: initially the distance at which the bodies are attached.
 *
 *      spring    both stops soft (default)                        F = -k (d - l) - c dd/dt
 *      rod       both hard: stiffness MEINFINITY
 *      string    upper hard, lower with stiffness 0 and damping 0
 *      elastic   lower hard, upper soft
 *
 *  If the two points coincide, the force has no direction; the last one is kept, and reaching that state gets a
 *  warning. A motor or lock of the limit acts on the distance: as a winch of a string or an elastic, and beside the
 *  force of a spring. The length of a rod is fixed: its motor and lock do nothing.
 */
#ifndef MDTSPRING_H
#define MDTSPRING_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a spring, disabled, unattached, between the centres of mass, with 10 N/m and 1 N s/m. The world owns
 *  it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtSpringID MEAPI MdtSpringCreate(const MdtWorldID w);
/** Sets positions and limit to the defaults of a new spring. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtSpringReset(const MdtSpringID j);
/** The spring as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtSpringQuaConstraint(const MdtSpringID j);
/** The constraint as a spring; null if it is none. */
MEPUBLIC MdtSpringID MEAPI MdtConstraintDCastSpring(const MdtConstraintID c);
/** Pointer to the spring's limit, for reading and writing; valid as long as the spring. */
MEPUBLIC MdtLimitID MEAPI MdtSpringGetLimit(const MdtSpringID j);
/** Resets the limit, then copies stops, threshold, offset, motor and switches of @a NewLimit. */
MEPUBLIC void MEAPI MdtSpringSetLimit(const MdtSpringID j, const MdtLimitID NewLimit);
/** The spring's attachment to the body of index 0 or 1, world frame. */
MEPUBLIC void MEAPI MdtSpringSetPosition(const MdtSpringID j, const unsigned int bodyindex, const MeReal x,
                                         const MeReal y, const MeReal z);
/** m, world frame: the present attachment to the body of index 0 or 1. */
MEPUBLIC void MEAPI MdtSpringGetPosition(const MdtSpringID j, MeVector3 v, const unsigned int bodyindex);
/**
 * Rest length, m, >= 0: sets both stops of the spring's limit to it. It is the distance of the two attachments without
 * load, l in F = -k (d - l), as the Dynamics guide says (ch. 3: "the spring length under no load"). The User Guide (ch.
 * 3) calls it a distance that is added to the separation of the bodies; where the guides conflict, the Dynamics guide
 * holds. For the User Guide's equilibrium pass the initial distance of the attachments plus its natural length.
 */
MEPUBLIC void MEAPI MdtSpringSetNaturalLength(const MdtSpringID j, const MeReal NewNaturalLength);
/** N/m, at least 0: sets the stiffness of both stops; MEINFINITY makes a rod. */
MEPUBLIC void MEAPI MdtSpringSetStiffness(const MdtSpringID j, const MeReal NewStiffness);
/** N s/m, at least 0: sets the damping of both stops. */
MEPUBLIC void MEAPI MdtSpringSetDamping(const MdtSpringID j, const MeReal NewDamping);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtSpringDestroy(const MdtSpringID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtSpringEnable(const MdtSpringID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtSpringDisable(const MdtSpringID j);
/** False for a new one, after MdtSpringDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtSpringIsEnabled(const MdtSpringID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before: their distance becomes the rest
 *  length, unless it was set. */
MEPUBLIC void MEAPI MdtSpringSetBodies(const MdtSpringID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtSpringGetBody(const MdtSpringID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtSpringGetForce(const MdtSpringID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtSpringGetForce. */
MEPUBLIC void MEAPI MdtSpringGetTorque(const MdtSpringID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtSpringGetWorld(const MdtSpringID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtSpringSetUserData(const MdtSpringID j, void *data);
/** The pointer of MdtSpringSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtSpringGetUserData(const MdtSpringID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtSpringSetSortKey(const MdtSpringID j, const MeI32 key);
/** The key of MdtSpringSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtSpringGetSortKey(const MdtSpringID j);
/** @} */

ME_END_C

#endif
