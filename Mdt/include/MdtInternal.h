/** @file MdtInternal.h
 *  For Mst, which creates worlds and converts the results of collision detection to contacts. Not installed.
 */
#ifndef MDTINTERNAL_H
#define MDTINTERNAL_H

#include "MdtBcl.h"
#include "MdtTypes.h"
#include "MeInternal.h"
#include "MeTeam.h"

ME_BEGIN_C

/** Sets the names of the settings that messages tell the program to raise when the world is full, in place of
 *  MdtWorldCreate's arguments. The strings must stay valid. Each limit is then reported once. */
MEPUBLIC void MEAPI MdtWorldRenameLimits(const MdtWorldID w, const char *bodies, const char *constraints);

/** True for a live world. */
MEPUBLIC MeBool MEAPI MdtWorldIsValid(const MdtWorldID w);

/** MdtWorldSetBodyHandlers for Mst: called before the handlers of the program. They change nothing of the world. */
MEPUBLIC void MEAPI MdtWorldSetModelHandlers(const MdtWorldID w, MdtBodyHandler enabled, MdtBodyHandler disabled);

/** @name Users of bodies: Mst, for models
 *  @{ */
enum {
    MDT_BODY_GUARD = 1 /**< level of a stage (MeInternal.h) that guards bodies and their users from destruction */
};
/** Callbacks to the user of a body. */
typedef struct MdtBodyUser {
    MeStage *(MEAPI *guardOf)(const MdtBodyID b); /**< The stage that guards the body's user; null: none. */
    void(MEAPI *condemn)(const MdtBodyID b);      /**< The body will be destroyed when a stage ends. */
    void(MEAPI *leave)(const MdtBodyID b);        /**< The body is being destroyed. */
    void(MEAPI *moved)(const MdtBodyID b);        /**< The program has moved the body while it was disabled. */
} MdtBodyUser;
/** True if the body has a user. */
MEPUBLIC MeBool MEAPI MdtBodyHasUser(const MdtBodyID b);
/** Sets the result of MdtBodyGetModel, and the body's user, which is the same for all bodies of a world; null: none. */
MEPUBLIC void MEAPI MdtBodySetUser(const MdtBodyID b, void *model, const MdtBodyUser *user);
/** @} */

/** The stage of a world, for functions that iterate over its bodies. */
MEPUBLIC MeStage *MEAPI MdtWorldGetStage(const MdtWorldID w);
/** MdtWorldStep or, with stopAtSafeTime, MdtWorldStepSafeTime; MdtWorldStepRest. For a world that the caller guards at
 *  level 0. */
MEPUBLIC void MEAPI MdtWorldAdvance(const MdtWorldID w, const MeReal h, const MeBool stopAtSafeTime);
MEPUBLIC int MEAPI MdtWorldAdvanceLag(const MdtWorldID w);

/** @name Bodies that lag, after the last sub-step
 *  MdtBodyPause takes the angular velocity from a body (rad/s, velocity[1]), which does not turn then, or also the
 *  linear one (m/s, velocity[0]); MdtBodyResume gives back what was taken. MdtWorldPushLagging lets movers act on
 *  bodies that lag for as long as they lag, without gravity and forces, and leaves their lags as they are. @{ */
MEPUBLIC MdtBodyID MEAPI MdtWorldNextLagging(const MdtWorldID w, const MdtBodyID b); /**< null: the first; no more */
MEPUBLIC MeBool MEAPI MdtBodyHasJoints(const MdtBodyID b);
MEPUBLIC void MEAPI MdtBodyPause(const MdtBodyID b, const MeBool translates, double velocity[2][3]);
MEPUBLIC void MEAPI MdtBodyResume(const MdtBodyID b, const MeBool translates, const double velocity[2][3]);
MEPUBLIC void MEAPI MdtWorldPushLagging(const MdtWorldID w);
/** @} */
/** Whether any mover of the world moves in this step. */
MEPUBLIC MeBool MEAPI MdtWorldHasMovingMovers(const MdtWorldID w);

/** Sets the motion of the movers, kinematic bodies, in a step of h seconds. The step does so itself; earlier calls show
 *  the velocities that follow from targets. */
MEPUBLIC void MEAPI MdtWorldBeginMovers(const MdtWorldID w, const MeReal h);

/** Whether a mover moves in this step. */
MEPUBLIC MeBool MEAPI MdtBodyIsMoving(const MdtBodyID b);

/** MdtBodyIsKinematic of a live body, without its check. */
MEPUBLIC MeBool MEAPI MdtBodyIsMover(const MdtBodyID b);

/** Puts the movers, after a step, to where they were after @a time seconds of it; the step's length: to its end. One
 *  of them: whether its pose has changed. */
MEPUBLIC void MEAPI MdtWorldPlaceMovers(const MdtWorldID w, const MeReal time);
MEPUBLIC MeBool MEAPI MdtBodyPlaceMover(const MdtBodyID b, const MeReal time);

/** @name Hidden bodies
 *  Movers of models that have no body: Mst places them. They are none of the world's bodies that programs see, and
 *  functions that return the body of a contact return null for them. A program's functions that change a body refuse
 *  them: they could only come from a stale handle.
 *  @{ */
/** Null, after a message without memory, if the transform is none that MdtBodyFollow accepts. */
MEPUBLIC MdtBodyID MEAPI MdtBodyCreateHidden(const MdtWorldID w, const MeMatrix4 tm);
MEPUBLIC void MEAPI MdtBodyDestroyHidden(const MdtBodyID b);
MEPUBLIC MeBool MEAPI MdtBodyIsHidden(const MdtBodyID b);
/** The world's hidden body after @a b; null: the first one, or no more. */
MEPUBLIC MdtBodyID MEAPI MdtWorldNextHidden(const MdtWorldID w, const MdtBodyID b);
/** Sets the results of MdtBodyGetModel and MdtBodyGetUserData, and whose callback `leave` is called when the world is
 *  destroyed. */
MEPUBLIC void MEAPI MdtBodySetHiddenUser(const MdtBodyID b, void *model, void *data, const MdtBodyUser *user);
/** Moves the body to its target at once, without velocity. */
MEPUBLIC void MEAPI MdtBodyJump(const MdtBodyID b);
/** MdtBodyMoveTo by a transform. False, and nothing is changed: it is beyond MdtBodyGetPositionBound, or no rotation to
 *  1 %. */
MEPUBLIC MeBool MEAPI MdtBodyFollow(const MdtBodyID b, const MeMatrix4 tm);
/** @} */

/** True if the group is between these bodies, which may be null or hidden. */
MEPUBLIC MeBool MEAPI MdtContactGroupIsBetween(MdtContactGroupID g, const MdtBodyID b1, const MdtBodyID b2);

/** Version number of the body's pose in double, which changes with the pose's last bit: collision results stay valid as
 *  long as it is the same. */
MEPUBLIC unsigned long MEAPI MdtBodyGetMoves(const MdtBodyID b);

/** The centre of mass of the body's model is not at the origin: warns when the body is first simulated, unless the
 *  program has called MdtBodySetCenterOfMassRelativePosition by then. */
MEPUBLIC void MEAPI MdtBodyExpectCentreOfMass(const MdtBodyID b);

/** m/s²: what gravity and the program's forces give the centre of mass in the coming part of a step; 0 if disabled. */
MEPUBLIC void MEAPI MdtBodyGetFreeAcceleration(const MdtBodyID b, MeVector3 a);
/** The same of a body that is awake. Reads nothing that the commit of contacts writes: workers may call it. */
MEPUBLIC void MEAPI MdtBodyGetLoadAcceleration(const MdtBodyID b, MeVector3 a);
/** Adds a force on the centre of mass for the coming step, N, world. Unlike MdtBodyAddForce's it is no sample of a
 *  force that is continued between steps (mdt_force.c): the caller has made it implicit. */
MEPUBLIC void MEAPI MdtBodyAddLoad(const MdtBodyID b, const double force[3]);
/** rad/s²: the rate at which the angular velocity of the body changes while no torque acts on it, or more. */
MEPUBLIC MeReal MEAPI MdtBodyGetFreeSpinRate(const MdtBodyID b);
/** Adds the impulses that wait for the step to the velocities of bodies without joints, and wakes these, so that the
 *  collision detection of the step looks ahead as far as they will move. h: the step, s. */
MEPUBLIC void MEAPI MdtWorldApplyImpulses(const MdtWorldID w, const MeReal h);
/** Adds a vector, m, to all coordinates of the world: bodies, joints to the world, contacts. Velocities of moving
 *  worlds are those of the same surfaces. Between steps. False: a body would come beyond MdtBodyGetPositionBound, and
 *  nothing is changed. */
MEPUBLIC MeBool MEAPI MdtWorldShift(const MdtWorldID w, const double by[3]);

/** The number of the body's contact groups and single contacts. */
MEPUBLIC int MEAPI MdtBodyGetManifoldCount(const MdtBodyID b);

/** Wakes a body that the world has put to sleep, not one that the program has disabled. Returns whether it was asleep.
 *  */
MEPUBLIC MeBool MEAPI MdtBodyWakeIfAsleep(const MdtBodyID b);
/** Makes a sleeping body a disabled one, which nothing wakes, without a call of the handlers: it will be destroyed.
 *  While the world's graph is in use nothing is changed; destruction is deferred then. */
MEPUBLIC void MEAPI MdtBodyEndSleep(const MdtBodyID b);

/** True if the body's last step is its only motion since MdtBodyGetMoves returned @a moves. */
MEPUBLIC MeBool MEAPI MdtBodyMovedByStep(const MdtBodyID b, unsigned long moves);

/** A contact as collision detection found it, between bodies whose transforms were read from MdtBodyGetTransformPtr. In
 *  the world frame. */
typedef struct MdtFoundContact {
    double position[3];        /**< m */
    double depth;              /**< m; negative: a gap */
    MeReal normal[3];          /**< direction in which the group's first body is pushed; not zero, of any length */
    MeReal radius[2];          /**< m, for each of the group's bodies: MdtContactSetRadius */
    double rim[2], axis[2][3]; /**< m, unit vectors or 0, likewise: MdtContactSetRim, MdtContactSetEdge if rim is 0 */
    MeBool isVertex[2];        /**< likewise: MdtContactSetVertex */
    MeU32 feature;             /**< MdtContactSetFeature */
    const MdtBclContactParams *params; /**< copied */
} MdtFoundContact;

/**
 * Replaces the group's contacts by those found; contacts[i] is the contact of found[i]. A contact of the last step
 * persists, with its force as warm start, if its feature id is found again; the others are matched to the nearest
 * remaining found contacts, from their positions moved with the body for @a time seconds. Unmatched contacts are
 * destroyed. Returns the number of contacts: fewer than @a count, after a warning, if the world is full.
 */
MEPUBLIC int MEAPI MdtContactGroupRenew(MdtContactGroupID g, const MdtFoundContact found[], int count, MeReal time,
                                        MdtContactID contacts[]);

/** Creates an empty group of two bodies, the second of which may be null, for a bridge: *@a holder is set to null when
 *  the group is destroyed, and the program may not attach it to other bodies. Null, after a message, if the world is
 *  full. */
MEPUBLIC MdtContactGroupID MEAPI MdtContactGroupCreateBridged(const MdtWorldID w, const MdtBodyID b1,
                                                              const MdtBodyID b2, void *generator, void **holder);

/** True if the contact still belongs to the group. Both may have been destroyed, but the world must live. */
MEPUBLIC MeBool MEAPI MdtContactGroupHas(MdtContactGroupID g, MdtContactID c);

/** True if MdtContactGroupRenew would neither create nor destroy a contact, and would write to the group only, except
 *  for ending the rest certificates of its bodies: then several threads may renew different groups at once. */
MEPUBLIC MeBool MEAPI MdtContactGroupGoesOn(MdtContactGroupID g, const MdtFoundContact found[], int count);

/**
 * Moves the group's contacts with the last step's motion of those of its bodies that have moved: the two surface points
 * are fixed in their bodies, and the normal in the second one. Returns the smallest separation, m; MEINFINITY without
 * contacts.
 */
MEPUBLIC MeReal MEAPI MdtContactGroupCarry(MdtContactGroupID g, const MeBool hasMoved[2]);
/** True if all surfaces at the contacts are corners, edges or faces (MdtContactSetRadius). */
MEPUBLIC MeBool MEAPI MdtContactGroupIsFlat(MdtContactGroupID g);

/** True if the world has a joint whose bodies do not collide with each other (MdtConstraintSetBodiesCollide). */
MEPUBLIC MeBool MEAPI MdtWorldHasNoCollide(const MdtWorldID w);
/** True if such a joint is enabled between the two bodies, which are not null. */
MEPUBLIC MeBool MEAPI MdtBodiesAreNoCollide(const MdtBodyID b1, const MdtBodyID b2);

/** @name Wheels without bodies: Mst, for vehicles
 *  A joint of a chassis, the first body, and the ground: the second body, or none.
 *  @{ */
/** Where such a wheel is, and what it rolls on. */
typedef struct MdtWheelPlace {
    double
        position[3]; /**< m, the wheel's centre at suspension length 0; this and the next two in the chassis' frame */
    double up[3], forward[3];   /**< unit, orthogonal */
    double point[3], normal[3]; /**< m, unit: plane of the ground, world frame */
} MdtWheelPlace;
/** Creates the joint of a chassis, enabled, without ground. *@a serial tells it from later joints at the same address.
 *  Null, after a message, if the world is full. */
MEPUBLIC MdtConstraintID MEAPI MdtGroundWheelCreate(const MdtBodyID chassis, MeU64 *serial);
/** Its data, which are an input of the next step; null: it has been destroyed, or its chassis is another body now. */
MEPUBLIC MdtBclGroundWheel *MEAPI MdtGroundWheelGet(const MdtConstraintID c, MeU64 serial, const MdtBodyID chassis);
/** Places the wheel, on a body of the ground, which may be hidden or kinematic, or on the world. */
MEPUBLIC void MEAPI MdtGroundWheelPlace(const MdtConstraintID c, const MdtWheelPlace *place, const MdtBodyID ground);
/** Joins two wheels of a chassis by an anti-roll bar for the next step, after both were placed. False, and there is
 *  none: they are on different bodies. */
MEPUBLIC MeBool MEAPI MdtGroundWheelJoin(const MdtConstraintID c, const MdtConstraintID twin, double stiffness);
/** Destroys the joint, if it is still there. */
MEPUBLIC void MEAPI MdtGroundWheelDestroy(const MdtConstraintID c, MeU64 serial);
/** 1/kg: the velocity at a point along a direction by a unit impulse at another point along another direction, of the
 *  body without joints; world frame. */
MEPUBLIC double MEAPI MdtBodyGetMobility(const MdtBodyID b, const double from[3], const double impulse[3],
                                         const double at[3], const double direction[3]);
/** The pose of a body's frame before rounding: a point p of it is at R p + position. */
MEPUBLIC void MEAPI MdtBodyGetExactPose(const MdtBodyID b, MdtKeaTransformation *pose);
/** @} */

/** The world's workers, for everything that belongs to its step; null if there is one worker. */
MEPUBLIC MeTeam *MEAPI MdtWorldGetTeam(const MdtWorldID w);

ME_END_C

#endif
