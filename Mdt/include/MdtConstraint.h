/** @file MdtConstraint.h
 *  What all joints and contacts have in common (Dynamics guide ch. 3, "Common Constraint Functions", "Base Constraint
 *  Functions").
 *
 *  A constraint ties two bodies, or one body and the world (null in place of the other). On each side it has a frame:
 *  a position and two axes at right angles, fixed in the body. Positions and axes are given and returned in the world
 *  frame and move with the bodies; the functions named ...Rel use the frame of the body's centre of mass.
 *
 *  Life: create (disabled, unattached), SetBodies, SetPosition and axes, Enable. Place the bodies before attaching
 *  them. Each joint's header has these functions under its own name.
 *
 *  Bad input (null or destroyed handles, numbers that are not finite, an axis of length zero, a body index other than 0
 *  and 1) gets a warning and changes nothing; accessors then return zeros.
 */
#ifndef MDTCONSTRAINT_H
#define MDTCONSTRAINT_H

#include "MdtTypes.h"

ME_BEGIN_C

/** @name Life
 *  @{ */
/** Destroys a constraint; it is disabled first. */
MEPUBLIC void MEAPI MdtConstraintDestroy(const MdtConstraintID c);
/** Is it a live constraint, contact or contact group? Nothing is read through the handle, whose world may be long gone.
 *  Beyond Karma. */
MEPUBLIC MeBool MEAPI MdtConstraintIsValid(const MdtConstraintID c);
/** Lets the constraint act. One that is not attached to a body gets a warning and stays disabled. */
MEPUBLIC void MEAPI MdtConstraintEnable(const MdtConstraintID c);
/** Has it act no more. Bodies that slept with it wake; so they do when it is destroyed. */
MEPUBLIC void MEAPI MdtConstraintDisable(const MdtConstraintID c);
MEPUBLIC MeBool MEAPI MdtConstraintIsEnabled(const MdtConstraintID c);
/** @} */

/** @name Attachment
 *  @{ */
/** Attaches the constraint. At most one body may be null, and both must be of the constraint's world. The frames are
 *  kept as they are in each body (new: at its centre of mass). Should be called while disabled; an enabled constraint
 *  gets a warning and is attached all the same. */
MEPUBLIC void MEAPI MdtConstraintSetBodies(const MdtConstraintID c, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1; null is the world. */
MEPUBLIC MdtBodyID MEAPI MdtConstraintGetBody(const MdtConstraintID c, const unsigned int bodyindex);

/** The point where both bodies are attached. */
MEPUBLIC void MEAPI MdtConstraintSetPosition(const MdtConstraintID c, const MeReal x, const MeReal y, const MeReal z);
/** Where it is now, on the first body (on the second, when the first is the world). */
MEPUBLIC void MEAPI MdtConstraintGetPosition(const MdtConstraintID c, MeVector3 p);
MEPUBLIC void MEAPI MdtConstraintBodySetPosition(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                                 const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtConstraintBodyGetPosition(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p);
MEPUBLIC void MEAPI MdtConstraintBodySetPositionRel(const MdtConstraintID c, const unsigned int bodyindex,
                                                    const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtConstraintBodyGetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p);

/** The primary axis for both bodies; it is normalized. The second axis is chosen. */
MEPUBLIC void MEAPI MdtConstraintSetAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz);
/** The primary and the second axis for both bodies. They are normalized, and the second is made orthogonal to the
 *  first; the third is their cross product. Parallel axes get a warning. */
MEPUBLIC void MEAPI MdtConstraintSetAxes(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                         const MeReal ox, const MeReal oy, const MeReal oz);
/** The axes now, on the first body (on the second, when the first is the world). */
MEPUBLIC void MEAPI MdtConstraintGetAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o);
MEPUBLIC void MEAPI MdtConstraintBodySetAxes(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                             const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                             const MeReal oz);
MEPUBLIC void MEAPI MdtConstraintBodyGetAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                             MeVector3 o);
MEPUBLIC void MEAPI MdtConstraintBodySetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                                const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                                const MeReal oz);
MEPUBLIC void MEAPI MdtConstraintBodyGetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                                MeVector3 o);
/** The primary axis alone. */
MEPUBLIC void MEAPI MdtConstraintBodyGetAxis(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 a);
MEPUBLIC void MEAPI MdtConstraintGetAxis(const MdtConstraintID c, MeVector3 axis);
/** Deprecated names of the guides. */
MEPUBLIC void MEAPI MdtConstraintSetBothAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                             const MeReal ox, const MeReal oy, const MeReal oz);
MEPUBLIC void MEAPI MdtConstraintGetBothAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o);
MEPUBLIC void MEAPI MdtConstraintBodyGetBothAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                                 MeVector3 o);
MEPUBLIC void MEAPI MdtConstraintBodySetBothAxis(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                                 const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                                 const MeReal oz);
/** @} */

/** @name What the constraint did in the last step
 *  @{ */
/** The force [N] on the body of index 0 or 1, at its centre of mass. The two are opposite. */
MEPUBLIC void MEAPI MdtConstraintGetForce(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 f);
/** The torque [N m] about the body's centre of mass, that of the force at its lever arm included; of a contact, of the
 *  force at the place where it was found, about where the centre was as the step began. */
MEPUBLIC void MEAPI MdtConstraintGetTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t);
/** How many rows it had. */
MEPUBLIC int MEAPI MdtConstraintGetRowCount(const MdtConstraintID c);
/** @} */

/** @name Breaking
 *  A joint breaks when the mean force, or torque, that it carries in a step exceeds a limit: it is disabled at the end
 *  of that step, not destroyed, and told by MdtWorldGetBrokenJoints and MdtWorldSetBreakCB. MdtConstraintEnable mends
 *  it; it keeps its limits. Beyond Karma.
 *  @{ */
/** The largest force [N] and torque [N m] that it bears, >= 0; MEINFINITY, the default, for any. Contacts and contact
 *  groups get a warning, and do not break. */
MEPUBLIC void MEAPI MdtConstraintSetBreakLimits(const MdtConstraintID c, const MeReal force, const MeReal torque);
MEPUBLIC MeReal MEAPI MdtConstraintGetBreakForce(const MdtConstraintID c);
MEPUBLIC MeReal MEAPI MdtConstraintGetBreakTorque(const MdtConstraintID c);
/** The torque [N m] on the body of index 0 or 1 about the joint's position: without that of the force at its lever arm.
 *  It is what the limit is for. */
MEPUBLIC void MEAPI MdtConstraintGetJointTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t);
/** @} */

/** @name Collision between the bodies
 *  The models of bodies that a joint ties collide as all others do, as in the guide: it keeps a joint's parts from each
 *  other by limits "wherever possible", and by contacts elsewhere (Dynamics guide, "Joint Limits versus Contacts").
 *  Where shapes overlap at their joint, as arm and shoulder do, contacts push against the joint: switch them off.
 *  Beyond Karma.
 *  @{ */
/**
 * Whether the two bodies collide with each other; at first they do. Off, their models make no contacts, events or
 * sensors' touches as long as the joint is enabled: from the next step on, in which those that they have go, and until
 * it is disabled, breaks or is destroyed. Of several joints between two bodies one is enough. Without effect where one
 * body is the world, which has no model: McdModelSetFilter is for that. Contacts and contact groups get a warning.
 */
MEPUBLIC void MEAPI MdtConstraintSetBodiesCollide(const MdtConstraintID c, const MeBool collide);
MEPUBLIC MeBool MEAPI MdtConstraintGetBodiesCollide(const MdtConstraintID c);
/** @} */

/** @name A moving world
 *  The velocity of the world where the constraint is attached to it, for moving platforms and belts: m/s, and rad/s
 *  about the world's origin. Default 0. Without effect between two bodies.
 *  @{ */
MEPUBLIC void MEAPI MdtConstraintSetWorldLinearVelocity(const MdtConstraintID c, const MeReal vx, const MeReal vy,
                                                        const MeReal vz);
MEPUBLIC void MEAPI MdtConstraintGetWorldLinearVelocity(const MdtConstraintID c, MeVector3 lv);
MEPUBLIC void MEAPI MdtConstraintSetWorldAngularVelocity(const MdtConstraintID c, const MeReal ax, const MeReal ay,
                                                         const MeReal az);
MEPUBLIC void MEAPI MdtConstraintGetWorldAngularVelocity(const MdtConstraintID c, MeVector3 av);
/** @} */

/** @name Bookkeeping
 *  @{ */
MEPUBLIC MdtWorldID MEAPI MdtConstraintGetWorld(const MdtConstraintID c);
MEPUBLIC void MEAPI MdtConstraintSetUserData(const MdtConstraintID c, void *d);
MEPUBLIC void *MEAPI MdtConstraintGetUserData(const MdtConstraintID c);
/** Like MdtBodySetSortKey. */
MEPUBLIC void MEAPI MdtConstraintSetSortKey(const MdtConstraintID c, MeI32 key);
MEPUBLIC MeI32 MEAPI MdtConstraintGetSortKey(const MdtConstraintID c);
/** All constraints of a world, in the order of simulation; null after the last. */
MEPUBLIC MdtConstraintID MEAPI MdtConstraintGetFirst(const MdtWorldID w);
MEPUBLIC MdtConstraintID MEAPI MdtConstraintGetNext(const MdtConstraintID c);
/** @} */

/* The header of every joint, say MdtHinge.h, has the same functions under its own name: MdtHingeDestroy, Enable,
 * Disable, IsEnabled, SetBodies, GetBody, GetForce, GetTorque, GetWorld, SetUserData, GetUserData, SetSortKey,
 * GetSortKey; and, of those that have a position and axes, SetPosition, GetPosition, SetAxis, GetAxis, SetAxes,
 * BodySetAxes, BodyGetAxes. Each does what the MdtConstraint function of that name does. */

ME_END_C

#endif
