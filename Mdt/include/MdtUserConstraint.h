/** @file MdtUserConstraint.h
 *  A constraint whose rows a callback of the program writes (Dynamics guide ch. 4 lists it among the joints).
 *
 *  Once per step, while the constraint is enabled, the callback writes up to MdtBclGETMAXROWSUSER rows with
 *  MdtBclAddRow (MdtBcl.h), from the poses of the two bodies. It must not depend on anything that differs from run to
 *  run. If a step is divided because of violent motion, the callback is called for each part. Without a callback there
 *  are no rows.
 */
#ifndef MDTUSERCONSTRAINT_H
#define MDTUSERCONSTRAINT_H

#include "MdtConstraint.h"
#include "MdtBcl.h"

ME_BEGIN_C

/** Creates a user constraint, disabled, unattached, without a callback. The world owns it. Returns null, with a warning
 *  that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtUserConstraintID MEAPI MdtUserConstraintCreate(const MdtWorldID w);
/** Resets the frames; the callback, bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtUserConstraintReset(const MdtUserConstraintID j);
/** The user constraint as a constraint. Null if @a j is null. */
MEPUBLIC MdtConstraintID MEAPI MdtUserConstraintQuaConstraint(const MdtUserConstraintID j);
/** The constraint as a user constraint; null if it is none. */
MEPUBLIC MdtUserConstraintID MEAPI MdtConstraintDCastUserConstraint(const MdtConstraintID c);
/** The callback that writes the rows; null: no rows. It must not move bodies; objects that it creates or destroys are
 *  processed later (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtUserConstraintSetFunction(const MdtUserConstraintID j, MdtBclAddConstraintFn f);
/** Null by default. */
MEPUBLIC MdtBclAddConstraintFn MEAPI MdtUserConstraintGetFunction(const MdtUserConstraintID j);
/** The callback's argument for its constraint; by default the user constraint itself. */
MEPUBLIC void MEAPI MdtUserConstraintSetConstraintData(const MdtUserConstraintID j, void *d);
/** The pointer of MdtUserConstraintSetConstraintData, or the user constraint itself. */
MEPUBLIC void *MEAPI MdtUserConstraintGetConstraintData(const MdtUserConstraintID j);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
/** Disables and destroys it; its sleeping bodies wake. The handle is invalid from then on. */
MEPUBLIC void MEAPI MdtUserConstraintDestroy(const MdtUserConstraintID j);
/** Lets it act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtUserConstraintEnable(const MdtUserConstraintID j);
/** Ends its effect and wakes its sleeping bodies. It stays attached. */
MEPUBLIC void MEAPI MdtUserConstraintDisable(const MdtUserConstraintID j);
/** False for a new one, after MdtUserConstraintDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtUserConstraintIsEnabled(const MdtUserConstraintID j);
/** Attaches it; at most one body may be null, the world. Place the bodies before; disable it for a change. */
MEPUBLIC void MEAPI MdtUserConstraintSetBodies(const MdtUserConstraintID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtUserConstraintGetBody(const MdtUserConstraintID j, const unsigned int bodyindex);
/** N, world frame: on the body of index 0 or 1, at its centre of mass, in the last step; 0 before the first. */
MEPUBLIC void MEAPI MdtUserConstraintGetForce(const MdtUserConstraintID j, const unsigned int bodyindex,
                                              MeVector3 force);
/** N m, world frame: on that body about its centre of mass, with the moment of MdtUserConstraintGetForce. */
MEPUBLIC void MEAPI MdtUserConstraintGetTorque(const MdtUserConstraintID j, const unsigned int bodyindex,
                                               MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtUserConstraintGetWorld(const MdtUserConstraintID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtUserConstraintSetUserData(const MdtUserConstraintID j, void *data);
/** The pointer of MdtUserConstraintSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtUserConstraintGetUserData(const MdtUserConstraintID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtUserConstraintSetSortKey(const MdtUserConstraintID j, const MeI32 key);
/** The key of MdtUserConstraintSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtUserConstraintGetSortKey(const MdtUserConstraintID j);
/** @} */

ME_END_C

#endif
