/** @file MdtBody.h
 *  Rigid bodies (Dynamics guide ch. 2, "Defining a Body", and ch. 4, "Adding Forces").
 *
 *  A body has a frame, which programs place and transforms describe, and a centre of mass, which moves by Newton's
 *  laws. They coincide unless MdtBodySetCenterOfMassRelativePosition or ...Transform separates them.
 *  Units are SI throughout; vectors are in the world frame unless a comment says otherwise.
 *
 *  A new body has 1 kg and the inertia of a solid ball of 1 m radius, 0.4 kg m² (MdtDefaults.h). MdtBodySetMass does
 *  not change the inertia: set both, or a heavy body topples too easily. In a universe MstModelAndBodyCreate computes
 *  both from the geometry and its density.
 *
 *  A new body is disabled; MdtBodyEnable adds it to the simulation. The world disables bodies at rest (MdtWorld.h).
 *  Such a body wakes when it is enabled, when a constraint connects it to an enabled body, and when something would
 *  move it: docs/simulation.md, "Sleep", has the table. A body that the program has disabled, or never enabled, wakes
 *  by the first two only; forces on it add up until then.
 *
 *  Positions have a bound in every coordinate (MdtBodyGetPositionBound): 2^24 times the world's length scale in single
 *  precision, 2^53 in double. There, neighbouring floating-point numbers differ by the size of an object. A body that
 *  reaches the bound is stopped there in every step, with one warning. Setters refuse positions beyond it.
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
 *  that was destroyed with its world is ignored, in all builds, with a warning only while another world lives. */
MEPUBLIC void MEAPI MdtBodyDestroy(const MdtBodyID b);
/** True for a live body. Nothing is read through the handle, whose body or world may be destroyed. Beyond Karma. */
MEPUBLIC MeBool MEAPI MdtBodyIsValid(const MdtBodyID b);
/** Copies a body into @a w, which may be another world, with all properties except its constraints. */
MEPUBLIC MdtBodyID MEAPI MdtBodyCopy(const MdtBodyID b, const MdtWorldID w);
/** Sets mass, state, damping and accumulated forces to their defaults. Constraints, user data, sort key, and whether
 *  the body is enabled, do not change. */
MEPUBLIC void MEAPI MdtBodyReset(const MdtBodyID b);
/** Adds the body to the simulation. For an enabled body it restarts the alive time (MdtWorldSetAutoDisableAliveTime),
 *  for which the body is not put to sleep: programs that pull at a body which may be at rest enable it before each
 *  step. Dynamics guide ch. 2. */
MEPUBLIC void MEAPI MdtBodyEnable(const MdtBodyID b);
/** Removes the body from the simulation; it keeps its velocity. An enabled body that a constraint connects to it wakes
 *  it. */
MEPUBLIC void MEAPI MdtBodyDisable(const MdtBodyID b);
/** False while it sleeps, after MdtBodyDisable, and for a new body. */
MEPUBLIC MeBool MEAPI MdtBodyIsEnabled(const MdtBodyID b);
/** Seconds for which the body has been enabled. */
MEPUBLIC MeReal MEAPI MdtBodyGetEnabledTime(const MdtBodyID b);
/** True if a velocity of the body is at or above its threshold; also if an acceleration is, unless the body has stayed
 *  in place for a second (docs/simulation.md, "Sleep"). */
MEPUBLIC MeBool MEAPI MdtBodyIsMovingTest(const MdtBodyID b, const MdtPartitionParams *params);
/** @} */

/** @name The body's frame
 *  Transforms are stored as in OpenGL: rows 0-2 are the frame's axes, row 3 its origin.
 *  @{ */
/** m, world frame, of the frame's origin. The body is there at once: it keeps its velocity, pushes nothing on the way,
 *  and wakes. Joints that this opens close by gamma in each step, without a velocity. MdtBodyMoveTo moves a kinematic
 *  body instead. */
MEPUBLIC void MEAPI MdtBodySetPosition(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z);
/** m, world frame: the present position of the frame's origin. Default 0. */
MEPUBLIC void MEAPI MdtBodyGetPosition(const MdtBodyID b, MeVector3 p);
/** m, > 0: the bound of the centre of mass's coordinates, in both directions. Beyond Karma. */
MEPUBLIC MeReal MEAPI MdtBodyGetPositionBound(const MdtBodyID b);
/** (qw, qx, qy, qz), body to world; normalized here. The frame's origin does not move. */
MEPUBLIC void MEAPI MdtBodySetQuaternion(const MdtBodyID b, const MeReal qw, const MeReal qx, const MeReal qy,
                                         const MeReal qz);
/** (qw, qx, qy, qz), body to world, of length 1. Default (1, 0, 0, 0). */
MEPUBLIC void MEAPI MdtBodyGetQuaternion(const MdtBodyID b, MeVector4 q);
/** @a R maps body coordinates to world coordinates: y = R x. It must be a rotation to 1 %, and is orthonormalized. */
MEPUBLIC void MEAPI MdtBodySetOrientation(const MdtBodyID b, const MeMatrix3 R);
/** The rotation, body to world: y = R x. */
MEPUBLIC void MEAPI MdtBodyGetOrientation(const MdtBodyID b, MeMatrix3 R);
/** Position (m) and rotation at once, as MdtBodySetPosition and MdtBodySetOrientation; a scale is refused. */
MEPUBLIC void MEAPI MdtBodySetTransform(const MdtBodyID b, const MeMatrix4 tm);
/** Copies the frame's transform in the world: rows 0-2 are its axes, row 3 its origin, m. */
MEPUBLIC void MEAPI MdtBodyGetTransform(const MdtBodyID b, MeMatrix4 m);
/** Pointer to the transform, which each step updates; valid as long as the body. Read only. */
MEPUBLIC MeMatrix4Ptr MEAPI MdtBodyGetTransformPtr(const MdtBodyID b);
/** @} */

/** @name The centre of mass
 *  The relative position and transform are its pose in the body's frame (default: the body's origin). Setting them
 *  moves the centre of mass, not the frame. The inertia tensor is in the axes of the centre of mass.
 *  @{ */
/** m, in the body's frame. Shapes and attachments of joints stay where they are. */
MEPUBLIC void MEAPI MdtBodySetCenterOfMassRelativePosition(const MdtBodyID b, const MeVector3 pos);
/** m, in the body's frame; 0 by default. */
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassRelativePosition(const MdtBodyID b, MeVector3 pos);
/** The same with the axes of the inertia tensor; rotation as for MdtBodySetOrientation. */
MEPUBLIC void MEAPI MdtBodySetCenterOfMassRelativeTransform(const MdtBodyID b, const MeMatrix4 t);
/** The pose of the centre of mass in the body's frame; the unit matrix by default. */
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassRelativeTransform(const MdtBodyID b, MeMatrix4 t);
/** m, world frame: position of the centre of mass. Setting it moves the whole body. */
MEPUBLIC void MEAPI MdtBodySetCenterOfMassPosition(const MdtBodyID b, const MeVector3 pos);
/** m, world frame: the present position of the centre of mass. */
MEPUBLIC void MEAPI MdtBodyGetCenterOfMassPosition(const MdtBodyID b, MeVector3 pos);
/** Pointer to the transform of the centre of mass, as MdtBodyGetTransformPtr. */
MEPUBLIC MeMatrix4Ptr MEAPI MdtBodyGetCenterOfMassTransformPtr(const MdtBodyID b);
/** @} */

/** @name Motion
 *  Linear velocity and acceleration are those of the centre of mass. Accelerations are those of the last step, with the
 *  effect of constraints. Programs may also write through the pointers: the next step, or the next call that reads the
 *  velocity, applies the new value.
 *  @{ */
/** m/s, world frame. It wakes a sleeping body. */
MEPUBLIC void MEAPI MdtBodySetLinearVelocity(const MdtBodyID b, const MeReal dx, const MeReal dy, const MeReal dz);
/** m/s, world frame: the present velocity of the centre of mass. Default 0. */
MEPUBLIC void MEAPI MdtBodyGetLinearVelocity(const MdtBodyID b, MeVector3 v);
/** Pointer to the velocity, m/s, for reading and writing; valid as long as the body. */
MEPUBLIC MeReal *MEAPI MdtBodyGetLinearVelocityPtr(const MdtBodyID b);
/** rad/s, world frame, right-hand rule. */
MEPUBLIC void MEAPI MdtBodySetAngularVelocity(const MdtBodyID b, const MeReal wx, const MeReal wy, const MeReal wz);
/** rad/s, world frame. Default 0. */
MEPUBLIC void MEAPI MdtBodyGetAngularVelocity(const MdtBodyID b, MeVector3 v);
/** As MdtBodyGetLinearVelocityPtr, rad/s. */
MEPUBLIC MeReal *MEAPI MdtBodyGetAngularVelocityPtr(const MdtBodyID b);
/** m/s², world frame. */
MEPUBLIC void MEAPI MdtBodyGetLinearAcceleration(const MdtBodyID b, MeVector3 v);
/** rad/s², world frame. */
MEPUBLIC void MEAPI MdtBodyGetAngularAcceleration(const MdtBodyID b, MeVector3 v);
/** m/s, world frame: velocity of the body's point that is now at the world position @a p. */
MEPUBLIC void MEAPI MdtBodyGetVelocityAtPoint(const MdtBodyID body, MeVector3 p, MeVector3 v);
/** J, of translation and rotation. */
MEPUBLIC MeReal MEAPI MdtBodyGetKineticEnergy(const MdtBodyID b);
/** @} */

/** @name Bodies that the program moves (kinematic bodies). Beyond Karma.
 *  Nothing moves them but the program, and they move all bodies that touch them or that joints connect to them: they
 *  push, carry by friction, and wake. They are in no partition, and make no contacts with fixed models and with each
 *  other. They do not fall asleep; one that does not move costs what a fixed model costs. While disabled they stand
 *  still. Where they leave a body no room, such as doors that close on it, they enter it, and it stays: the fast solver
 *  takes over, and forces of contacts, above some ten times what the load explains, mean only that it is crushed. A
 *  motor of a bounded force stops instead (MdtLimitSetLimitedForceMotor).
 *  @{ */
/** With METRUE the program moves the body from now on, by its velocities (MdtBodySetLinearVelocity and
 *  ...AngularVelocity), which stay as they are, or by MdtBodyMoveTo. With MEFALSE it obeys forces again, with its mass.
 *  Its constraints remain; its contacts are found anew. In a callback it takes effect when the stage ends. */
MEPUBLIC void MEAPI MdtBodySetKinematic(const MdtBodyID b, const MeBool kinematic);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI MdtBodyIsKinematic(const MdtBodyID b);
/**
 * Moves a kinematic body to a pose that it reaches at the end of the next step, with the velocities that follow:
 * the centre of mass moves in a straight line, and the body turns the shorter way. In the steps after that it stands
 * still until this is called again, or a velocity is set. MdtBodySetPosition puts it there at once, without velocity.
 * @param position    m, of the body's frame, within MdtBodyGetPositionBound
 * @param quaternion  w x y z, of the body's frame; normalized here
 * A body that is not kinematic, numbers that are not finite, and a quaternion of 0 get a warning and change nothing.
 */
MEPUBLIC void MEAPI MdtBodyMoveTo(const MdtBodyID b, const MeVector3 position, const MeVector4 quaternion);
/** @} */

/** @name Locked axes. Beyond Karma.
 *  A body does not move along a locked axis, and does not turn about one: as if its mass, or its moment of inertia,
 *  were infinite there. The axes are those of the world. Locks hold exactly and need no joint: a game in a plane locks
 *  all bodies to it, a character that must not tip over locks its rotations. Contacts and joints act along the free
 *  axes; those whose directions are within a milliradian of locked ones have no force. The forces of the locks are not
 *  reported.
 *  @{ */
/** Values of MdtBodySetLockedAxes, which may be added up. */
typedef enum MdtLockedAxes {
    MdtLockNone = 0,
    MdtLockTranslationX = 1,
    MdtLockTranslationY = 2,
    MdtLockTranslationZ = 4,
    MdtLockRotationX = 8,
    MdtLockRotationY = 16,
    MdtLockRotationZ = 32,
    MdtLockTranslation = 1 + 2 + 4, /**< The centre of mass stays where it is. */
    MdtLockRotation = 8 + 16 + 32,  /**< The body keeps its attitude. */
    MdtLockToPlaneXY = 4 + 8 + 16,  /**< It moves in a plane, and turns about its normal. */
    MdtLockToPlaneYZ = 1 + 16 + 32,
    MdtLockToPlaneZX = 2 + 8 + 32
} MdtLockedAxes;
/**
 * Locks these axes (a sum of MdtLockedAxes), and frees all others. Default MdtLockNone.
 *
 * Velocities along locked axes become 0, also those that are set afterwards; forces and impulses have no effect along
 * them. MdtBodySetPosition, ...SetTransform and other functions that place the body do so as before. While the body is
 * kinematic, its locks have no effect. It wakes a sleeping body. Numbers that are no such sum get a warning and change
 * nothing.
 */
MEPUBLIC void MEAPI MdtBodySetLockedAxes(const MdtBodyID b, const int axes);
/** The locked axes, a sum of MdtLockedAxes. */
MEPUBLIC int MEAPI MdtBodyGetLockedAxes(const MdtBodyID b);
/** @} */

/** @name Mass and inertia
 *  Setting them keeps the velocities.
 *  @{ */
/** kg, > 0. The inertia tensor does not change with it: set both. */
MEPUBLIC void MEAPI MdtBodySetMass(const MdtBodyID b, const MeReal mass);
/** kg. Default 1, times the world's mass scale. */
MEPUBLIC MeReal MEAPI MdtBodyGetMass(const MdtBodyID b);
/** kg m², about the centre of mass, in its axes; symmetric and positive definite, with moments in the range of single
 *  precision. MdtUtilities.h computes tensors of some shapes. */
MEPUBLIC void MEAPI MdtBodySetInertiaTensor(const MdtBodyID b, const MeMatrix3 i);
/** kg m², as set; by default 0.4 times the unit matrix, mass scale and length scale squared. */
MEPUBLIC void MEAPI MdtBodyGetInertiaTensor(const MdtBodyID b, MeMatrix3 i);
/** Sets the tensor to @a i times the unit matrix. */
MEPUBLIC void MEAPI MdtBodySetSphericalInertiaTensor(const MdtBodyID b, const MeReal i);
/** Use the full tensor (the default), or a third of its trace times the unit matrix, as Karma 1.x did (Dynamics guide
 *  ch. 5, "Inertia Problems"): cheaper, but independent of the body's shape. */
MEPUBLIC void MEAPI MdtBodyEnableNonSphericalInertia(const MdtBodyID b);
/** Uses a third of the tensor's trace; MdtBodyGetInertiaTensor still returns the tensor. */
MEPUBLIC void MEAPI MdtBodyDisableNonSphericalInertia(const MdtBodyID b);
/** METRUE by default. */
MEPUBLIC MeBool MEAPI MdtBodyNonSphericalInertiaIsEnabled(const MdtBodyID b);
/** While enabled (the default, physically correct), free rotation conserves angular momentum; else angular velocity. */
MEPUBLIC void MEAPI MdtBodyEnableCoriolisForce(const MdtBodyID b);
/** Free rotation keeps the angular velocity, so that energy and angular momentum change. */
MEPUBLIC void MEAPI MdtBodyDisableCoriolisForce(const MdtBodyID b);
/** METRUE by default. */
MEPUBLIC MeBool MEAPI MdtBodyCoriolisForceIsEnabled(const MdtBodyID b);
/** @} */

/** @name Forces, torques and impulses (Dynamics guide ch. 4)
 *  They add up until the next step in which the body is simulated, act in it, and are cleared. Forces [N] act for the
 *  whole step; impulses [N s] change the momentum at its start, whatever its length, and joints transmit them
 *  immediately. The first force or impulse on a body allocates memory; without any, a fatal error is reported, and
 *  nothing is changed.
 *
 *  Springs and dampers that a program computes itself are stable. Forces in successive steps count as samples of a
 *  continuous force (velocity Verlet): half of the force's change times the step is added when the next step begins. A
 *  force that begins or ends acts for exactly its steps. A step without a call ends it: if a lasting force is zero,
 *  such as that of a spring out of contact, add zero. Setting velocity or pose ends it, too, except for changes below
 *  the thresholds of sleep. With h the step, undamped springs keep their amplitude within 1 % for w h <= 1 and stay
 *  bounded below w h = 2; dampers are stable up to c h = 2 m. Beyond that, one warning is given; MdtSpring and
 *  MdtSpring6 are stable at any stiffness.
 *  @{ */
/** Adds a force at the centre of mass. */
MEPUBLIC void MEAPI MdtBodyAddForce(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz);
/** Adds a force at the world position (px, py, pz), which may be outside of the body. */
MEPUBLIC void MEAPI MdtBodyAddForceAtPosition(const MdtBodyID b, const MeReal fx, const MeReal fy, const MeReal fz,
                                              const MeReal px, const MeReal py, const MeReal pz);
/** Adds a torque, N m. */
MEPUBLIC void MEAPI MdtBodyAddTorque(const MdtBodyID b, const MeReal tx, const MeReal ty, const MeReal tz);
/** Adds an impulse, N s, at the centre of mass: it changes the velocity by impulse / mass. */
MEPUBLIC void MEAPI MdtBodyAddImpulse(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz);
/** Adds an impulse, N s, at the world position (px, py, pz), m. */
MEPUBLIC void MEAPI MdtBodyAddImpulseAtPosition(const MdtBodyID b, const MeReal ix, const MeReal iy, const MeReal iz,
                                                const MeReal px, const MeReal py, const MeReal pz);
/** The sum of the forces [N], or torques [N m], added since the last step; without impulses, gravity and joints. */
MEPUBLIC void MEAPI MdtBodyGetForce(const MdtBodyID b, MeVector3 v);
/** N m, world frame, about the centre of mass: torques, and moments of forces at positions. */
MEPUBLIC void MEAPI MdtBodyGetTorque(const MdtBodyID b, MeVector3 v);
/** Clears the forces and torques, or the impulses, added since the last step. */
MEPUBLIC void MEAPI MdtBodyResetForces(const MdtBodyID b);
/** Clears the impulses added since the last step; forces remain. */
MEPUBLIC void MEAPI MdtBodyResetImpulses(const MdtBodyID b);
/** @} */

/** @name Gravity, damping, speed caps and fast spin
 *  @{ */
/** How much of the world's gravity acts on the body: 0 none, negative ones push it up. Default 1. It wakes a sleeping
 *  body. Beyond Karma. */
MEPUBLIC void MEAPI MdtBodySetGravityFactor(const MdtBodyID b, const MeReal factor);
/** 1 by default. */
MEPUBLIC MeReal MEAPI MdtBodyGetGravityFactor(const MdtBodyID b);
/** The largest speed of the centre of mass (m/s), or of the rotation (rad/s), >= 0: a step, or a sub-step of
 *  continuous motion, ends with the velocity scaled down to it. The step itself moves the body as without a cap: a
 *  body that falls at its cap is faster by g h / 2 in the mean over a step of h seconds. Joints feel the cap in the
 *  next step. Kinematic bodies have no cap. Default MEINFINITY: none. Beyond Karma. */
MEPUBLIC void MEAPI MdtBodySetMaxLinearSpeed(const MdtBodyID b, const MeReal max);
/** m/s; MEINFINITY, the default: no cap. */
MEPUBLIC MeReal MEAPI MdtBodyGetMaxLinearSpeed(const MdtBodyID b);
/** The same for the rotation, rad/s. */
MEPUBLIC void MEAPI MdtBodySetMaxAngularSpeed(const MdtBodyID b, const MeReal max);
/** rad/s; MEINFINITY, the default: no cap. */
MEPUBLIC MeReal MEAPI MdtBodyGetMaxAngularSpeed(const MdtBodyID b);
/** Damping d [1/s], >= 0: without other loads the velocity decays as exp(-d t). Default 0. */
MEPUBLIC void MEAPI MdtBodySetLinearVelocityDamping(const MdtBodyID b, const MeReal d);
/** 1/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtBodyGetLinearVelocityDamping(const MdtBodyID b);
/** The same for the angular velocity, 1/s. */
MEPUBLIC void MEAPI MdtBodySetAngularVelocityDamping(const MdtBodyID b, const MeReal d);
/** 1/s; 0 by default. */
MEPUBLIC MeReal MEAPI MdtBodyGetAngularVelocityDamping(const MdtBodyID b);
/** The axis (world frame, not zero; normalized here) of a body's fast spin. It has no effect, since Kea integrates
 *  every rotation exactly; it exists for programs written for Karma (Dynamics guide ch. 5). */
MEPUBLIC void MEAPI MdtBodySetFastSpinAxis(const MdtBodyID b, const MeReal x, const MeReal y, const MeReal z);
/** The axis; (0, 1, 0) when none is set. */
MEPUBLIC void MEAPI MdtBodyGetFastSpinAxis(const MdtBodyID b, MeVector3 v);
/** Forgets the axis of MdtBodySetFastSpinAxis. */
MEPUBLIC void MEAPI MdtBodySetNoFastSpinAxis(const MdtBodyID b);
/** @} */

/** @name Bookkeeping
 *  @{ */
/** Null, with a warning, for a bad handle. */
MEPUBLIC MdtWorldID MEAPI MdtBodyGetWorld(const MdtBodyID b);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI MdtBodySetUserData(const MdtBodyID b, void *d);
/** The pointer of MdtBodySetUserData; null by default. */
MEPUBLIC void *MEAPI MdtBodyGetUserData(const MdtBodyID b);
/** The body's representation in collision detection, owned by the Simulation Toolkit (McdModelSetBody). Default null.
 *  */
MEPUBLIC void MEAPI MdtBodySetModel(const MdtBodyID b, void *model);
/** The pointer of MdtBodySetModel, in a universe the McdModelID; null by default. */
MEPUBLIC void *MEAPI MdtBodyGetModel(const MdtBodyID b);
/** Bodies are simulated in the order of their keys (0 .. 2^31-1), bodies of equal keys in the order of creation
 *  (Dynamics guide ch. 4, "Sort Keys"). Default 0. A negative key gets a warning. */
MEPUBLIC void MEAPI MdtBodySetSortKey(const MdtBodyID b, const MeI32 key);
/** 0 by default. */
MEPUBLIC MeI32 MEAPI MdtBodyGetSortKey(const MdtBodyID b);
/** The number of the body's partition in the last step; -1: it was not simulated. */
MEPUBLIC int MEAPI MdtBodyGetPartition(const MdtBodyID b);
/** The number of bodies in that partition; 0: the body was in none. Beyond Karma. */
MEPUBLIC int MEAPI MdtBodyGetPartitionSize(const MdtBodyID b);
/** s: how long the body may move before it could hit something, for MdtWorldStepSafeTime. Default MEINFINITY. */
MEPUBLIC void MEAPI MdtBodySetSafeTime(const MdtBodyID b, const MeReal t);
/** s; MEINFINITY by default. */
MEPUBLIC MeReal MEAPI MdtBodyGetSafeTime(const MdtBodyID b);
/** s: the time by which the body is behind its world, after MdtWorldStepSafeTime, before MdtWorldStepRest. Beyond
 *  Karma. */
MEPUBLIC MeReal MEAPI MdtBodyGetLag(const MdtBodyID b);
/** s: length of the body's last step, or of the last part of it by safe time. Constraint forces are means over it. */
MEPUBLIC MeReal MEAPI MdtBodyGetPart(const MdtBodyID b);
/** Writes the body's properties to the log (MeLog). */
MEPUBLIC void MEAPI MdtBodyLog(const MdtBodyID b);
/** Iterate over all bodies of a world, in the order of simulation; null after the last. */
MEPUBLIC MdtBodyID MEAPI MdtBodyGetFirst(const MdtWorldID w);
/** The body after @a b; null after the last. */
MEPUBLIC MdtBodyID MEAPI MdtBodyGetNext(const MdtBodyID b);
/** @} */

/** @name The body's constraints
 *  @{ */
/** Iterate over all constraints that are attached to the body, enabled or not, contacts included: @a c is the one
 *  before. Null after the last. */
MEPUBLIC MdtConstraintID MEAPI MdtBodyGetFirstConstraint(MdtBodyID b);
/** Null, with a warning, if @a c is not attached to the body. */
MEPUBLIC MdtConstraintID MEAPI MdtBodyGetNextConstraint(MdtBodyID b, MdtConstraintID c);
/** Iterate over the contacts of the body; null after the last. */
MEPUBLIC MdtContactID MEAPI MdtBodyGetFirstContact(MdtBodyID b);
/** The contact after @a c; null, with a warning, if @a c is not attached to the body. */
MEPUBLIC MdtContactID MEAPI MdtBodyGetNextContact(MdtBodyID b, MdtContactID c);
/** Calls @a cb for each constraint; it may destroy that constraint and others (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MdtBodyForAllConstraints(const MdtBodyID b, MdtConstraintIteratorCBPtr cb, void *ccbdata);
/** Destroy, or disable, all constraints of the body, or only its contacts. */
MEPUBLIC void MEAPI MdtBodyDestroyConstraints(const MdtBodyID b);
/** Destroys its contacts and contact groups, those of a universe's bridge included; joints remain. */
MEPUBLIC void MEAPI MdtBodyDestroyContacts(const MdtBodyID b);
/** Disables all joints, contacts and contact groups of the body; they remain attached. */
MEPUBLIC void MEAPI MdtBodyDisableConstraints(const MdtBodyID b);
/** Disables its contacts and contact groups; joints act on. */
MEPUBLIC void MEAPI MdtBodyDisableContacts(const MdtBodyID b);
/** @} */

ME_END_C

#endif
