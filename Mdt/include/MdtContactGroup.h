/** @file MdtContactGroup.h
 *  A contact group: all contacts between two bodies, or a body and the world, as one constraint (Dynamics guide ch. 3,
 *  "MdtContactGroups").
 *
 *  The group is attached, enabled and given a sort key; its contacts have its bodies, act when the group does, and are
 *  simulated in the order in which they were added. MdtContactEnable and MdtContactDisable have no effect on a contact
 *  in a group. In a group with the world the body is the first side: attached as (null, body), a group swaps the two,
 *  and MdtContactGroupIsSwapped returns true. As always, contacts push their first body along the normal.
 *
 *  Bad input gets a warning and changes nothing, as in MdtConstraint.h.
 */
#ifndef MDTCONTACTGROUP_H
#define MDTCONTACTGROUP_H

#include "MdtContact.h"

ME_BEGIN_C

/** Creates an empty group, disabled, unattached. It counts as one of the world's constraints. Returns null, with a
 *  warning that names MdtWorldCreate's maxConstraints, when the world is full. */
MEPUBLIC MdtContactGroupID MEAPI MdtContactGroupCreate(const MdtWorldID w);
/** Destroys the group's contacts. Bodies and enabled state do not change. */
MEPUBLIC void MEAPI MdtContactGroupReset(const MdtContactGroupID c);
/** The group as a constraint. Null if @a c is null. */
MEPUBLIC MdtConstraintID MEAPI MdtContactGroupQuaConstraint(const MdtContactGroupID c);
/** The constraint as a group; null if it is none. */
MEPUBLIC MdtContactGroupID MEAPI MdtConstraintDCastContactGroup(const MdtConstraintID c);

/** @name The group's contacts
 *  @{ */
/** Null for an empty group. */
MEPUBLIC MdtContactID MEAPI MdtContactGroupGetFirstContact(MdtContactGroupID c);
/** The contact after @a c; null after the last, and, with a warning, for a contact of another group. */
MEPUBLIC MdtContactID MEAPI MdtContactGroupGetNextContact(MdtContactGroupID g, MdtContactID c);
/** The number of its contacts, at gaps too; 0, with a warning, for a bad handle. */
MEPUBLIC int MEAPI MdtContactGroupGetCount(MdtContactGroupID g);
/** Creates a contact at the end of the group. Null, with a warning, when the world is full. */
MEPUBLIC MdtContactID MEAPI MdtContactGroupCreateContact(MdtContactGroupID g);
/** Moves a contact that is in no group to the end of this one; the contact gets the group's bodies. */
MEPUBLIC void MEAPI MdtContactGroupAppendContact(MdtContactGroupID g, MdtContactID c);
/** Removes a contact from the group; the contact is disabled and keeps its bodies. A contact that a bridge made
 *  (MstBridge.h) is part of its group's record and is not removed, with a warning. */
MEPUBLIC void MEAPI MdtContactGroupRemoveContact(MdtContactGroupID g, MdtContactID c);
/** Removes a contact from the group and destroys it. */
MEPUBLIC void MEAPI MdtContactGroupDestroyContact(MdtContactGroupID g, MdtContactID c);
/** @} */

/** N: magnitude of the sum of the contacts' normal forces in the last step. */
MEPUBLIC MeReal MEAPI MdtContactGroupGetNormalForce(MdtContactGroupID g);
/** True if the group was attached as (null, body), and has swapped the two. */
MEPUBLIC MeBool MEAPI MdtContactGroupIsSwapped(MdtContactGroupID g);
/** @name A pointer for the group's maker (collision uses it)
 *  @{ */
/** Not read by Karma. Default null. */
MEPUBLIC void MEAPI MdtContactGroupSetGenerator(MdtContactGroupID g, void *generator);
/** The pointer of MdtContactGroupSetGenerator; null by default. */
MEPUBLIC void *MEAPI MdtContactGroupGetGenerator(MdtContactGroupID group);
/** Sets the address of the maker's pointer to the group: *@a holder is set to null when the group is destroyed by
 *  anyone, so that the maker does not mistake a new object in the same memory for it. The pointer must live as long as
 *  the group, or until another holder, or null, is set. Beyond Karma. */
MEPUBLIC void MEAPI MdtContactGroupSetHolder(MdtContactGroupID g, void **holder);
/** @} */

/** @name Functions that every constraint has, under its own name
 *  Each does what the MdtConstraint function of that name does (MdtConstraint.h). Force and torque are the sums over
 *  the contacts. Destroying the group destroys its contacts.
 *  @{ */
/** Destroys the group and its contacts. Their handles are invalid from then on. */
MEPUBLIC void MEAPI MdtContactGroupDestroy(const MdtContactGroupID j);
/** Lets all its contacts act. Without a body: a warning, and it stays disabled. */
MEPUBLIC void MEAPI MdtContactGroupEnable(const MdtContactGroupID j);
/** Ends the effect of its contacts and wakes their sleeping bodies. */
MEPUBLIC void MEAPI MdtContactGroupDisable(const MdtContactGroupID j);
/** False for a new group and after MdtContactGroupDisable. */
MEPUBLIC MeBool MEAPI MdtContactGroupIsEnabled(const MdtContactGroupID j);
/** Attaches it with its contacts; at most one body may be null, the world, which becomes the second side. A group of a
 *  bridge keeps its bodies: a warning. */
MEPUBLIC void MEAPI MdtContactGroupSetBodies(const MdtContactGroupID j, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1. Null: the world, or not attached; another index also gets a warning. */
MEPUBLIC MdtBodyID MEAPI MdtContactGroupGetBody(const MdtContactGroupID j, const unsigned int bodyindex);
/** N, world frame: sum of its contacts' forces on the body of index 0 or 1 in the last step. */
MEPUBLIC void MEAPI MdtContactGroupGetForce(const MdtContactGroupID j, const unsigned int bodyindex, MeVector3 force);
/** N m, world frame: sum of the moments of its contacts' forces about that body's centre of mass. */
MEPUBLIC void MEAPI MdtContactGroupGetTorque(const MdtContactGroupID j, const unsigned int bodyindex, MeVector3 torque);
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtContactGroupGetWorld(const MdtContactGroupID j);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtContactGroupSetUserData(const MdtContactGroupID j, void *data);
/** The pointer of MdtContactGroupSetUserData; null if none was set. */
MEPUBLIC void *MEAPI MdtContactGroupGetUserData(const MdtContactGroupID j);
/** 0 .. 2^31 - 1, default 0: lower keys are simulated first, equal ones in the order of creation. */
MEPUBLIC void MEAPI MdtContactGroupSetSortKey(const MdtContactGroupID j, const MeI32 key);
/** The key of MdtContactGroupSetSortKey; 0 for a bad handle, with a warning. */
MEPUBLIC MeI32 MEAPI MdtContactGroupGetSortKey(const MdtContactGroupID j);
/** Another name of MdtContactGroupGetTorque, in old programs. */
MEPUBLIC void MEAPI MdtContactGroupTorque(const MdtContactGroupID j, const unsigned int bodyindex, MeVector3 torque);
/** @} */

ME_END_C

#endif
