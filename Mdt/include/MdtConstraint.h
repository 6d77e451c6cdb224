/** @file MdtConstraint.h
 *  Common functions of all joints and contacts (Dynamics guide ch. 3, "Common Constraint Functions", "Base Constraint
 *  Functions").
 *
 *  A constraint connects two bodies, or one body and the world (null for the other one). On each side it has a frame:
 *  a position and two orthogonal axes, fixed in the body. Positions and axes are passed in world coordinates and move
 *  with the bodies; the functions named ...Rel use the frame of the body's centre of mass.
 *
 *  Typical order: create (disabled, unattached), SetBodies, SetPosition and axes, Enable. Place the bodies before
 *  attaching them. Each joint's header has these functions under its own name.
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
/** Disables and destroys a constraint. */
MEPUBLIC void MEAPI MdtConstraintDestroy(const MdtConstraintID c);
/** True for a live constraint, contact or contact group. Nothing is read through the handle, whose world may be
 *  destroyed. Beyond Karma. */
MEPUBLIC MeBool MEAPI MdtConstraintIsValid(const MdtConstraintID c);
/** Lets the constraint act. A constraint without a body gets a warning and stays disabled. A gap closes by gamma in
 *  each step: its bodies are displaced and get no velocity by that. */
MEPUBLIC void MEAPI MdtConstraintEnable(const MdtConstraintID c);
/** Stops the constraint from acting. This wakes its sleeping bodies; so does destroying the constraint. */
MEPUBLIC void MEAPI MdtConstraintDisable(const MdtConstraintID c);
/** False for a new constraint, after MdtConstraintDisable, and after a break. */
MEPUBLIC MeBool MEAPI MdtConstraintIsEnabled(const MdtConstraintID c);
/** @} */

/** @name Attachment
 *  @{ */
/** Attaches the constraint. At most one body may be null, and both must be of the constraint's world. The frames keep
 *  their coordinates in each body (initially: the centre of mass). Call it while the constraint is disabled; an enabled
 *  one gets a warning and is attached nevertheless. */
MEPUBLIC void MEAPI MdtConstraintSetBodies(const MdtConstraintID c, const MdtBodyID b1, const MdtBodyID b2);
/** The body of index 0 or 1; null is the world. */
MEPUBLIC MdtBodyID MEAPI MdtConstraintGetBody(const MdtConstraintID c, const unsigned int bodyindex);

/** The point where both bodies are attached. */
MEPUBLIC void MEAPI MdtConstraintSetPosition(const MdtConstraintID c, const MeReal x, const MeReal y, const MeReal z);
/** The present position on the first body (on the second, if the first is the world). */
MEPUBLIC void MEAPI MdtConstraintGetPosition(const MdtConstraintID c, MeVector3 p);
/** The attachment to one body only, m, world frame: the joint pulls the two points together. */
MEPUBLIC void MEAPI MdtConstraintBodySetPosition(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                                 const MeReal y, const MeReal z);
/** The present attachment to the body of index 0 or 1, m, world frame. */
MEPUBLIC void MEAPI MdtConstraintBodyGetPosition(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p);
/** The same, m, in the frame of that body's centre of mass; of the world, if the body is null. */
MEPUBLIC void MEAPI MdtConstraintBodySetPositionRel(const MdtConstraintID c, const unsigned int bodyindex,
                                                    const MeReal x, const MeReal y, const MeReal z);
/** m, in the frame of that body's centre of mass; 0 by default. */
MEPUBLIC void MEAPI MdtConstraintBodyGetPositionRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p);

/** The primary axis for both bodies, normalized here. The second axis is chosen arbitrarily. */
MEPUBLIC void MEAPI MdtConstraintSetAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz);
/** The primary and the second axis for both bodies. They are normalized, and the second one is orthogonalized; the
 *  third axis is their cross product. Parallel axes get a warning. */
MEPUBLIC void MEAPI MdtConstraintSetAxes(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                         const MeReal ox, const MeReal oy, const MeReal oz);
/** The present axes on the first body (on the second, if the first is the world). */
MEPUBLIC void MEAPI MdtConstraintGetAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o);
/** The axes of one body only, world frame, made as by MdtConstraintSetAxes: the joint turns the bodies until both
 *  agree. */
MEPUBLIC void MEAPI MdtConstraintBodySetAxes(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                             const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                             const MeReal oz);
/** Unit vectors, world frame: the present primary and second axis of the body of index 0 or 1. Either may be null. */
MEPUBLIC void MEAPI MdtConstraintBodyGetAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                             MeVector3 o);
/** The same, in the frame of that body's centre of mass; of the world, if the body is null. */
MEPUBLIC void MEAPI MdtConstraintBodySetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                                const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                                const MeReal oz);
/** Unit vectors in the frame of that body's centre of mass; by default x and y for most joints. */
MEPUBLIC void MEAPI MdtConstraintBodyGetAxesRel(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                                MeVector3 o);
/** The present primary axis only. */
MEPUBLIC void MEAPI MdtConstraintBodyGetAxis(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 a);
/** On the first body (on the second, if the first is the world). */
MEPUBLIC void MEAPI MdtConstraintGetAxis(const MdtConstraintID c, MeVector3 axis);
/** Deprecated names of the guides. */
MEPUBLIC void MEAPI MdtConstraintSetBothAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                             const MeReal ox, const MeReal oy, const MeReal oz);
/** MdtConstraintGetAxes. */
MEPUBLIC void MEAPI MdtConstraintGetBothAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o);
/** MdtConstraintBodyGetAxes. */
MEPUBLIC void MEAPI MdtConstraintBodyGetBothAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                                 MeVector3 o);
/** MdtConstraintBodySetAxes. */
MEPUBLIC void MEAPI MdtConstraintBodySetBothAxis(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                                 const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                                 const MeReal oz);
/** @} */

/** @name The constraint's effect in the last step
 *  @{ */
/** The force [N] on the body of index 0 or 1, acting at its centre of mass. The two forces are opposite. */
MEPUBLIC void MEAPI MdtConstraintGetForce(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 f);
/** The torque [N m] about the body's centre of mass, including the moment of the force. For contacts: the moment of the
 *  force at the position where the contact was found, about the centre of mass at the start of the step. */
MEPUBLIC void MEAPI MdtConstraintGetTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t);
/** The number of the constraint's rows. */
MEPUBLIC int MEAPI MdtConstraintGetRowCount(const MdtConstraintID c);
/** @} */

/** @name Breaking
 *  A joint breaks when its mean force, or torque, in a step exceeds a limit: it is disabled at the end of that step,
 *  not destroyed, and reported by MdtWorldGetBrokenJoints and MdtWorldSetBreakCB. MdtConstraintEnable repairs it; it
 *  keeps its limits. Beyond Karma.
 *  @{ */
/** Break limits: the largest force [N] and torque [N m], >= 0; MEINFINITY, the default: unbreakable. Contacts and
 *  contact groups get a warning, and do not break. */
MEPUBLIC void MEAPI MdtConstraintSetBreakLimits(const MdtConstraintID c, const MeReal force, const MeReal torque);
/** N; MEINFINITY, the default, and for contacts: unbreakable. */
MEPUBLIC MeReal MEAPI MdtConstraintGetBreakForce(const MdtConstraintID c);
/** N m; MEINFINITY, the default, and for contacts: unbreakable. */
MEPUBLIC MeReal MEAPI MdtConstraintGetBreakTorque(const MdtConstraintID c);
/** The torque [N m] on the body of index 0 or 1 about the joint's position, without the moment of the force. The break
 *  limit applies to it. */
MEPUBLIC void MEAPI MdtConstraintGetJointTorque(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 t);
/** @} */

/** @name Collision between the bodies
 *  The models of jointed bodies collide as all others do. The guide recommends joint limits "wherever possible" to
 *  keep the bodies of a joint separated, and contacts elsewhere (Dynamics guide, "Joint Limits versus Contacts"). If
 *  shapes overlap at their joint, such as arm and shoulder, contacts push against the joint: switch collision off.
 *  Beyond Karma.
 *  @{ */
/**
 * Whether the joint's bodies collide with each other; by default they do. If not, their models make no contacts, events
 * or sensor touches while the joint is enabled: from the next step, which removes existing contacts, until the joint is
 * disabled, breaks or is destroyed. One of several joints between two bodies is enough. No effect if one body is the
 * world, which has no model: see McdModelSetFilter. Contacts and contact groups get a warning.
 */
MEPUBLIC void MEAPI MdtConstraintSetBodiesCollide(const MdtConstraintID c, const MeBool collide);
/** METRUE by default, and for contacts. */
MEPUBLIC MeBool MEAPI MdtConstraintGetBodiesCollide(const MdtConstraintID c);
/** @} */

/** @name A moving world
 *  The velocity of the world at the attachment, for moving platforms and belts: m/s, and rad/s about the world's
 *  origin. Default 0. No effect between two bodies, nor while the program moves the model without a body.
 *  @{ */
/** m/s, world frame. Numbers that are not finite get a warning and change nothing. */
MEPUBLIC void MEAPI MdtConstraintSetWorldLinearVelocity(const MdtConstraintID c, const MeReal vx, const MeReal vy,
                                                        const MeReal vz);
/** m/s; 0 by default. */
MEPUBLIC void MEAPI MdtConstraintGetWorldLinearVelocity(const MdtConstraintID c, MeVector3 lv);
/** rad/s about the world's origin: its velocity at the attachment is the cross product with the position. */
MEPUBLIC void MEAPI MdtConstraintSetWorldAngularVelocity(const MdtConstraintID c, const MeReal ax, const MeReal ay,
                                                         const MeReal az);
/** rad/s; 0 by default. */
MEPUBLIC void MEAPI MdtConstraintGetWorldAngularVelocity(const MdtConstraintID c, MeVector3 av);
/** @} */

/** @name Bookkeeping
 *  @{ */
/** The world that owns it; null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtConstraintGetWorld(const MdtConstraintID c);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtConstraintSetUserData(const MdtConstraintID c, void *d);
/** The pointer of MdtConstraintSetUserData; null by default. */
MEPUBLIC void *MEAPI MdtConstraintGetUserData(const MdtConstraintID c);
/** Like MdtBodySetSortKey. */
MEPUBLIC void MEAPI MdtConstraintSetSortKey(const MdtConstraintID c, MeI32 key);
/** 0 by default. */
MEPUBLIC MeI32 MEAPI MdtConstraintGetSortKey(const MdtConstraintID c);
/** Iterate over all constraints of a world, in the order of simulation; null after the last. */
MEPUBLIC MdtConstraintID MEAPI MdtConstraintGetFirst(const MdtWorldID w);
/** The constraint after @a c; a group is followed by its contacts. */
MEPUBLIC MdtConstraintID MEAPI MdtConstraintGetNext(const MdtConstraintID c);
/** @} */

/* The header of every joint, such as MdtHinge.h, has the same functions under its own name: MdtHingeDestroy, Enable,
 * Disable, IsEnabled, SetBodies, GetBody, GetForce, GetTorque, GetWorld, SetUserData, GetUserData, SetSortKey,
 * GetSortKey; joints with a position and axes also have SetPosition, GetPosition, SetAxis, GetAxis, SetAxes,
 * BodySetAxes, BodyGetAxes. Each does the same as the MdtConstraint function of that name. */

ME_END_C

#endif
