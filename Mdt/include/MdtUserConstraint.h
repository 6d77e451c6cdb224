/** @file MdtUserConstraint.h
 *  A constraint whose rows a function of the program writes (Dynamics guide ch. 4 lists it among the joints).
 *
 *  Once a step, while it is enabled, the function is called to write up to MdtBclGETMAXROWSUSER rows with MdtBclAddRow
 *  (MdtBcl.h), from the poses of the two bodies. It must depend on nothing that differs from run to run. When joints
 *  turn violently the step is divided, and the function is called for each part. Without a function it has no rows.
 */
#ifndef MDTUSERCONSTRAINT_H
#define MDTUSERCONSTRAINT_H

#include "MdtConstraint.h"
#include "MdtBcl.h"

ME_BEGIN_C

/** Creates an user constraint, disabled, unattached, without a function. The world owns it. Returns null,
 *  with a warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtUserConstraintID MEAPI MdtUserConstraintCreate(const MdtWorldID w);
/** Sets the frames to default; the function stays. Bodies and state stay. */
MEPUBLIC void MEAPI MdtUserConstraintReset(const MdtUserConstraintID j);
/** The user constraint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtUserConstraintQuaConstraint(const MdtUserConstraintID j);
/** The constraint as an user constraint; null when it is none. */
MEPUBLIC MdtUserConstraintID MEAPI MdtConstraintDCastUserConstraint(const MdtConstraintID c);
/** The function that writes the rows; null: no rows. It may not move bodies; what it creates or destroys waits
 *  (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtUserConstraintSetFunction(const MdtUserConstraintID j, MdtBclAddConstraintFn f);
MEPUBLIC MdtBclAddConstraintFn MEAPI MdtUserConstraintGetFunction(const MdtUserConstraintID j);
/** What the function is given as its constraint; at first the user constraint itself. */
MEPUBLIC void MEAPI MdtUserConstraintSetConstraintData(const MdtUserConstraintID j, void *d);
MEPUBLIC void *MEAPI MdtUserConstraintGetConstraintData(const MdtUserConstraintID j);

/** @name What every constraint has, under this joint's name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h).
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
