/** @file MdtBody.h
 *  Rigid bodies (Dynamics guide ch. 2, "Defining a Body", and ch. 4, "Adding Forces").
 *
 *  A body has a frame, which programs place and which transforms describe, and a centre of mass, which moves by
 *  Newton's laws. They are the same until MdtBodySetCenterOfMassRelativePosition or ...Transform parts them.
 *  Units are SI throughout; vectors are in the world frame unless a comment says otherwise.
 *
 *  A new body has 1 kg and the inertia of a solid ball of 1 m radius, 0.4 kg m² (MdtDefaults.h). MdtBodySetMass leaves
 *  the inertia as it is: a body that is heavier and no harder to turn topples too easily, so both are to be set. In a
 *  universe MstModelAndBodyCreate finds both from the geometry and its density.
 *
 *  A new body is disabled: MdtBodyEnable lets it take part. A body at rest is disabled by the world (MdtWorld.h); it
 *  wakes when it is enabled, when a constraint ties it to an enabled body, and by whatever would move it: the table is
 *  in docs/simulation.md, "Sleep". A body that the program itself has disabled, or never enabled, waits: forces on it
 *  add up until it is enabled.
 *
 *  Positions have a bound in every coordinate: 2^24 times the world's length scale in single precision, 2^53 in double,
 *  MdtBodyGetPositionBound. There, neighbouring numbers are as far apart as things are large. A body that gets there is
 *  stopped at the bound, in every step in which it would go on; a warning says so once. No position beyond is taken.
 *
 *  Bad input (a null or destroyed body, a number that is not finite, a mass or an inertia that is not positive) gets a
 *  warning and changes nothing; accessors then return zeros.
 */
#ifndef MDTBODY_H
#define MDTBODY_H

#include "MdtTypes.h"

ME_BEGIN_C

/** @name Life
 *  @{ */
/** Creates a body with default properties (MdtDefaults.h), disabled, at the origin. The world owns it. Returns null,
 *  with a warning that names MdtWorldCreate's maxBodies, when the world is full. Dynamics guide ch. 2. */
MEPUBLIC MdtBodyID MEAPI MdtBodyCreate(const MdtWorldID w);
/** Destroys a body. Its constraints are disabled and detached from it; they remain for the program to destroy. A body
 *  that has gone with its world is left alone, in all builds; that is said while there is another world. */
MEPUBLIC void MEAPI MdtBodyDestroy(const MdtBodyID b);
/** Is it a live body? Nothing is read through the handle, which may be of a body or world long gone. Beyond Karma. */
MEPUBLIC MeBool MEAPI MdtBodyIsValid(const MdtBodyID b);
/** Creates in @a w, which may be another world, a body with all properties of @a b but its constraints. */
MEPUBLIC MdtBodyID MEAPI MdtBodyCopy(const MdtBodyID b, const MdtWorldID w);
/** Sets mass, state, damping and accumulated forces to their defaults. Constraints, user data, sort key and whether the
 *  body is enabled stay. */
MEPUBLIC void MEAPI MdtBodyReset(const MdtBodyID b);
/** Lets the body take part in the simulation. Of one that does so already its alive time begins anew
 *  (MdtWorldSetAutoDisableAliveTime), in which it is not put to sleep: who pulls at a body that may be at rest enables
 *  it before each step. Dynamics guide ch. 2. */
MEPUBLIC void MEAPI MdtBodyEnable(const MdtBodyID b);
/** Takes the body out of the simulation; it keeps its velocity. An enabled body that is tied to it wakes it. */
MEPUBLIC void MEAPI MdtBodyDisable(const MdtBodyID b);
MEPUBLIC MeBool MEAPI MdtBodyIsEnabled(const MdtBodyID b);
/** Seconds for which the body has been enabled. */
MEPUBLIC MeReal MEAPI MdtBodyGetEnabledTime(const MdtBodyID b);
/** True when a speed of the body is at or above its threshold, or its acceleration while it has not stayed in place for
 *  a second (docs/simulation.md, "Sleep"). */
MEPUBLIC MeBool MEAPI MdtBodyIsMovingTest(const MdtBodyID b, const MdtPartitionParams *params);
/** @} */

/** @name Where the body is: its frame
 *  Transforms are stored as OpenGL does: rows 0-2 the frame's axes, row 3 its origin.
 *  @{ */
MEPUBLIC void MEAPI MdtBodySetPosition(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtBodyGetPosition(const MdtBodyID b, MeVector3 p);
/** m, > 0: no coordinate of a body's centre of mass gets beyond, either way. Beyond Karma. */
MEPUBLIC MeReal MEAPI MdtBodyGetPositionBound(const MdtBodyID b);
/** (qw, qx, qy, qz), body to world; it is normalized. The frame's origin stays where it is. */
MEPUBLIC void MEAPI MdtBodySetQuaternion(const MdtBodyID b, const MeReal qw, const MeReal qx, const MeReal qy,
                                         const MeReal qz);
MEPUBLIC void MEAPI MdtBodyGetQuaternion(const MdtBodyID b, MeVector4 q);
/** @a R turns body coordinates into world coordinates: y = R x. Must be a rotation, to 1 %; it is made one exactly. */
MEPUBLIC void MEAPI MdtBodySetOrientation(const MdtBodyID b, const MeMatrix3 R);
MEPUBLIC void MEAPI MdtBodyGetOrientation(const MdtBodyID b, MeMatrix3 R);
MEPUBLIC void MEAPI MdtBodySetTransform(const MdtBodyID b, const MeMatrix4 tm);
MEPUBLIC void MEAPI MdtBodyGetTransform(const MdtBodyID b, MeMatrix4 m);
/** The transform itself: it follows the body after every step and lives as long as the body. Read only. */
MEPUBLIC MeMatrix4Ptr MEAPI MdtBodyGetTransformPtr(const MdtBodyID b);
/** @} */

/** @name The centre of mass
 *  The relative position and transform say where it is in the body's frame (default: its origin). Setting them moves
 *  the centre of mass, not the frame. The inertia tensor refers to the axes of the centre of mass.
 *  @{ */
MEPUBLIC void MEAPI MdtBodySetCenterOfMassRelativePosition(const MdtBodyID b, const MeVector3 pos);
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassRelativePosition(const MdtBodyID b, MeVector3 pos);
MEPUBLIC void MEAPI MdtBodySetCenterOfMassRelativeTransform(const MdtBodyID b, const MeMatrix4 t);
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassRelativeTransform(const MdtBodyID b, MeMatrix4 t);
/** World position of the centre of mass. Setting it moves the whole body. */
MEPUBLIC void MEAPI MdtBodySetCenterOfMassPosition(const MdtBodyID b, const MeVector3 pos);
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassPosition(const MdtBodyID b, MeVector3 pos);
/** Like MdtBodyGetTransformPtr, for the centre of mass. */
MEPUBLIC MeMatrix4Ptr MEAPI MdtBodyGetCenterOfMassTransformPtr(const MdtBodyID b);
/** @} */

/** @name How it moves
 *  Linear velocity and acceleration are those of the centre of mass. Accelerations are those of the last step,
 *  constraints included. The pointers may also be written through: the next step, or the next call that asks for the
 *  velocity, takes the new value over.
 *  @{ */
MEPUBLIC void MEAPI MdtBodySetLinearVelocity(const MdtBodyID b, const MeReal dx, const MeReal dy, const MeReal dz);
MEPUBLIC void MEAPI MdtBodyGetLinearVelocity(const MdtBodyID b, MeVector3 v);
MEPUBLIC MeReal *MEAPI MdtBodyGetLinearVelocityPtr(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodySetAngularVelocity(const MdtBodyID b, const MeReal wx, const MeReal wy, const MeReal wz);
MEPUBLIC void MEAPI MdtBodyGetAngularVelocity(const MdtBodyID b, MeVector3 v);
MEPUBLIC MeReal *MEAPI MdtBodyGetAngularVelocityPtr(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyGetLinearAcceleration(const MdtBodyID b, MeVector3 v);
MEPUBLIC void MEAPI MdtBodyGetAngularAcceleration(const MdtBodyID b, MeVector3 v);
/** Velocity of the body's point that is now at the world position @a p. */
MEPUBLIC void MEAPI MdtBodyGetVelocityAtPoint(const MdtBodyID body, MeVector3 p, MeVector3 v);
/** Of translation and rotation, J. */
MEPUBLIC MeReal MEAPI MdtBodyGetKineticEnergy(const MdtBodyID b);
/** @} */

/** @name Mass and inertia
 *  Setting them keeps the velocities.
 *  @{ */
/** kg, > 0. The inertia tensor does not follow: set it too. */
MEPUBLIC void MEAPI MdtBodySetMass(const MdtBodyID b, const MeReal mass);
MEPUBLIC MeReal MEAPI MdtBodyGetMass(const MdtBodyID b);
/** kg m², about the centre of mass, in its frame; symmetric and positive definite, of moments that single precision can
 *  have. MdtUtilities.h makes some. */
MEPUBLIC void MEAPI MdtBodySetInertiaTensor(const MdtBodyID b, const MeMatrix3 i);
MEPUBLIC void MEAPI MdtBodyGetInertiaTensor(const MdtBodyID b, MeMatrix3 i);
/** @a i times the unit matrix. */
MEPUBLIC void MEAPI MdtBodySetSphericalInertiaTensor(const MdtBodyID b, const MeReal i);
/** Whether the full tensor is used (the default), or a third of its trace times the unit matrix, as Karma 1.x did
 *  (Dynamics guide ch. 5, "Inertia Problems"): cheaper, and blind to the body's shape. */
MEPUBLIC void MEAPI MdtBodyEnableNonSphericalInertia(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyDisableNonSphericalInertia(const MdtBodyID b);
MEPUBLIC MeBool MEAPI MdtBodyNonSphericalInertiaIsEnabled(const MdtBodyID b);
/** Whether free rotation keeps the angular momentum (the default, and physically correct) or the angular velocity. */
MEPUBLIC void MEAPI MdtBodyEnableCoriolisForce(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyDisableCoriolisForce(const MdtBodyID b);
MEPUBLIC MeBool MEAPI MdtBodyCoriolisForceIsEnabled(const MdtBodyID b);
/** @} */

/** @name Forces, torques and impulses (Dynamics guide ch. 4)
 *  They add up until the next step in which the body is simulated, act in it, and are gone. Forces [N] act for the
 *  whole step; impulses [N s] change the momentum at its start, whatever its length, and joints pass them on at once.
 *
 *  Springs and dampers that a program computes itself are stable: forces that are given in successive steps are
 *  samples of one that varies (velocity Verlet), so that half of a change times the step is added as the next step
 *  begins. A force that begins or ends acts for exactly its steps. A step without a call ends it: where a force that
 *  goes on is zero, as of a spring that is not touched, add zero. Setting velocity or pose ends it, too, but for
 *  changes that count as rest. With h the step, undamped springs keep their amplitude within 1 % for w h <= 1 and stay
 *  bounded below w h = 2, dampers are stable up to c h = 2 m. Beyond that, one warning says so; MdtSpring and
 *  MdtSpring6 are stable at any stiffness.
 *  @{ */
/** At the centre of mass. */
MEPUBLIC void MEAPI MdtBodyAddForce(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz);
/** At the world position (px, py, pz), which need not be on the body. */
MEPUBLIC void MEAPI MdtBodyAddForceAtPosition(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz,
                                              const MeReal px, const MeReal py, const MeReal pz);
/** N m. */
MEPUBLIC void MEAPI MdtBodyAddTorque(const MdtBodyID b, const MeReal tx, const MeReal ty, const MeReal tz);
MEPUBLIC void MEAPI MdtBodyAddImpulse(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz);
MEPUBLIC void MEAPI MdtBodyAddImpulseAtPosition(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz,
                                                const MeReal px, const MeReal py, const MeReal pz);
/** What has been added since the last step. */
MEPUBLIC void MEAPI MdtBodyGetForce(const MdtBodyID b, MeVector3 v);
MEPUBLIC void MEAPI MdtBodyGetTorque(const MdtBodyID b, MeVector3 v);
/** Forgets the forces and torques, or the impulses, that wait. */
MEPUBLIC void MEAPI MdtBodyResetForces(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyResetImpulses(const MdtBodyID b);
/** @} */

/** @name Damping and fast spin
 *  @{ */
/** Damping d [1/s], >= 0: left alone, a velocity falls as exp(-d t). Default 0. */
MEPUBLIC void MEAPI MdtBodySetLinearVelocityDamping(const MdtBodyID b, const MeReal d);
MEPUBLIC MeReal MEAPI MdtBodyGetLinearVelocityDamping(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodySetAngularVelocityDamping(const MdtBodyID b, const MeReal d);
MEPUBLIC MeReal MEAPI MdtBodyGetAngularVelocityDamping(const MdtBodyID b);
/** The axis (world frame, not zero; it is normalized) about which the body is said to spin fast. Kea integrates every
 *  rotation exactly, so this changes nothing; programs of the original keep working (Dynamics guide ch. 5). */
MEPUBLIC void MEAPI MdtBodySetFastSpinAxis(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z);
/** The axis; (0, 1, 0) when none is set. */
MEPUBLIC void MEAPI MdtBodyGetFastSpinAxis(const MdtBodyID b, MeVector3 v);
MEPUBLIC void MEAPI MdtBodySetNoFastSpinAxis(const MdtBodyID b);
/** @} */

/** @name Bookkeeping
 *  @{ */
MEPUBLIC MdtWorldID MEAPI MdtBodyGetWorld(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodySetUserData(const MdtBodyID b, void *d);
MEPUBLIC void *MEAPI MdtBodyGetUserData(const MdtBodyID b);
/** What stands for the body in collision: the Simulation Toolkit's, see McdModelSetBody. Default null. */
MEPUBLIC void MEAPI MdtBodySetModel(const MdtBodyID b, void *model);
MEPUBLIC void *MEAPI MdtBodyGetModel(const MdtBodyID b);
/** Bodies are simulated in the order of their keys (0 .. 2^31-1), those of equal keys in the order of creation
 *  (Dynamics guide ch. 4, "Sort Keys"). Default 0. A negative key gets a warning. */
MEPUBLIC void MEAPI MdtBodySetSortKey(const MdtBodyID b, const MeI32 key);
MEPUBLIC MeI32 MEAPI MdtBodyGetSortKey(const MdtBodyID b);
/** The number of the partition that the body was in during the last step; -1: it was not simulated. */
MEPUBLIC int MEAPI MdtBodyGetPartition(const MdtBodyID b);
/** How many bodies that partition has; 0: it was in none. Beyond Karma. */
MEPUBLIC int MEAPI MdtBodyGetPartitionSize(const MdtBodyID b);
/** Seconds for which the body may move before it could hit something; used by MdtWorldStepSafeTime. Default MEINFINITY.
 *  */
MEPUBLIC void MEAPI MdtBodySetSafeTime(const MdtBodyID b, const MeReal t);
MEPUBLIC MeReal MEAPI MdtBodyGetSafeTime(const MdtBodyID b);
/** How far the body is behind its world, s: what MdtWorldStepSafeTime left for MdtWorldStepRest. Beyond Karma. */
MEPUBLIC MeReal MEAPI MdtBodyGetLag(const MdtBodyID b);
/** By how much the body was moved on last, s: a step, or a part of one. Forces of its constraints are of that time. */
MEPUBLIC MeReal MEAPI MdtBodyGetPart(const MdtBodyID b);
/** Writes the body's properties with MeLog. */
MEPUBLIC void MEAPI MdtBodyLog(const MdtBodyID b);
/** All bodies of a world, in the order of simulation; null after the last. */
MEPUBLIC MdtBodyID MEAPI MdtBodyGetFirst(const MdtWorldID w);
MEPUBLIC MdtBodyID MEAPI MdtBodyGetNext(const MdtBodyID b);
/** @} */

/** @name The body's constraints
 *  @{ */
/** All constraints that are attached to the body, enabled or not; null after the last. */
MEPUBLIC MdtConstraintID MEAPI MdtBodyGetFirstConstraint(MdtBodyID b);
MEPUBLIC MdtConstraintID MEAPI MdtBodyGetNextConstraint(MdtBodyID b, MdtConstraintID c);
/** The contacts among them. */
MEPUBLIC MdtContactID MEAPI MdtBodyGetFirstContact(MdtBodyID b);
MEPUBLIC MdtContactID MEAPI MdtBodyGetNextContact(MdtBodyID b, MdtContactID c);
/** Calls @a cb for each, which may destroy it and others (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtBodyForAllConstraints(const MdtBodyID b, MdtConstraintIteratorCBPtr cb, void *ccbdata);
/** Destroys, or disables, all the body's constraints, or only its contacts. */
MEPUBLIC void MEAPI MdtBodyDestroyConstraints(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyDestroyContacts(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyDisableConstraints(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyDisableContacts(const MdtBodyID b);
/** @} */

ME_END_C

#endif
