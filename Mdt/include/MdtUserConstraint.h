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
MEPUBLIC MdtBclAddConstraintFn MEAPI MdtUserConstraintGetFunction(const MdtUserConstraintID j);
/** The callback's argument for its constraint; by default the user constraint itself. */
MEPUBLIC void MEAPI MdtUserConstraintSetConstraintData(const MdtUserConstraintID j, void *d);
MEPUBLIC void *MEAPI MdtUserConstraintGetConstraintData(const MdtUserConstraintID j);

/** @name Functions that every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Body indices are 0 and 1, a null
 *  body is the world. Positions (m) and axes are in the world frame; force (N) and torque (N m) on that body are those
 *  of the last step.
 *  @{ */
MEPUBLIC void MEAPI MdtUserConstraintDestroy(const MdtUserConstraintID j);
MEPUBLIC void MEAPI MdtUserConstraintEnable(const MdtUserConstraintID j);
MEPUBLIC void MEAPI MdtUserConstraintDisable(const MdtUserConstraintID j);
MEPUBLIC MeBool MEAPI MdtUserConstraintIsEnabled(const MdtUserConstraintID j);
MEPUBLIC void MEAPI MdtUserConstraintSetBodies(const MdtUserConstraintID j, const MdtBodyID b1, const MdtBodyID b2);
MEPUBLIC MdtBodyID MEAPI MdtUserConstraintGetBody(const MdtUserConstraintID j, const unsigned int bodyindex);
MEPUBLIC void MEAPI MdtUserConstraintGetForce(const MdtUserConstraintID j, const unsigned int bodyindex,
                                              MeVector3 force);
MEPUBLIC void MEAPI MdtUserConstraintGetTorque(const MdtUserConstraintID j, const unsigned int bodyindex,
                                               MeVector3 torque);
MEPUBLIC MdtWorldID MEAPI MdtUserConstraintGetWorld(const MdtUserConstraintID j);
MEPUBLIC void MEAPI MdtUserConstraintSetUserData(const MdtUserConstraintID j, void *data);
MEPUBLIC void *MEAPI MdtUserConstraintGetUserData(const MdtUserConstraintID j);
MEPUBLIC void MEAPI MdtUserConstraintSetSortKey(const MdtUserConstraintID j, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtUserConstraintGetSortKey(const MdtUserConstraintID j);
/** @} */

ME_END_C

#endif
