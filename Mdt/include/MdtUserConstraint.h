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
/** The function that writes the rows; null: no rows. */
MEPUBLIC void MEAPI MdtUserConstraintSetFunction(const MdtUserConstraintID j, MdtBclAddConstraintFn f);
MEPUBLIC MdtBclAddConstraintFn MEAPI MdtUserConstraintGetFunction(const MdtUserConstraintID j);
/** What the function is given as its constraint; at first the user constraint itself. */
MEPUBLIC void MEAPI MdtUserConstraintSetConstraintData(const MdtUserConstraintID j, void *d);
MEPUBLIC void *MEAPI MdtUserConstraintGetConstraintData(const MdtUserConstraintID j);

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(UserConstraint)

ME_END_C

#endif
