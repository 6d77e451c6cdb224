/** @file MdtInternal.h
 *  For Mst, which makes worlds of its universes' sizes, and contacts of what collision finds. Not installed.
 */
#ifndef MDTINTERNAL_H
#define MDTINTERNAL_H

#include "MdtTypes.h"
#include "MeInternal.h"
#include "MeTeam.h"

ME_BEGIN_C

/** What a message tells the program to raise where there is no room for more, instead of the arguments of
 *  MdtWorldCreate. Strings that stay. Each limit is spoken of once then. */
MEPUBLIC void MEAPI MdtWorldRenameLimits(const MdtWorldID w, const char *bodies, const char *constraints);

/** Whether it is a live world. */
MEPUBLIC MeBool MEAPI MdtWorldIsValid(const MdtWorldID w);

/** @name Bodies that something else uses: Mst, those of models
 *  @{ */
enum {
    MDT_BODY_GUARD = 1 /**< the level at which a stage (MeInternal.h) keeps bodies, or what uses them, from going */
};
typedef struct MdtBodyUser {
    MeStage *(MEAPI *guardOf)(const MdtBodyID b); /**< The stage that keeps its user as it is; null: there is none. */
    void(MEAPI *condemn)(const MdtBodyID b);      /**< It will be destroyed when a stage ends. */
    void(MEAPI *leave)(const MdtBodyID b);        /**< It is being destroyed. */
    void(MEAPI *moved)(const MdtBodyID b);        /**< The program has placed it while it was disabled. */
} MdtBodyUser;
/** Is somebody told? */
MEPUBLIC MeBool MEAPI MdtBodyHasUser(const MdtBodyID b);
/** Sets what MdtBodyGetModel returns, and who is told. Null: nothing, nobody. */
MEPUBLIC void MEAPI MdtBodySetUser(const MdtBodyID b, void *model, const MdtBodyUser *user);
/** @} */

/** The stage of a world, for what goes through its bodies. */
MEPUBLIC MeStage *MEAPI MdtWorldGetStage(const MdtWorldID w);
/** MdtWorldStep, or MdtWorldStepSafeTime, and MdtWorldStepRest, of a world that the caller holds at level 0. */
MEPUBLIC void MEAPI MdtWorldAdvance(const MdtWorldID w, const MeReal h, const MeBool stopAtSafeTime);
MEPUBLIC int MEAPI MdtWorldAdvanceLag(const MdtWorldID w);

/** A version of the body's pose in double, which changes with its last bit: collision results are valid while it is the
 *  same. */
MEPUBLIC unsigned long MEAPI MdtBodyGetMoves(const MdtBodyID b);

/** Its model's geometry has its centre of mass elsewhere than at the origin: a warning before the body is simulated
 *  first, if the program has not said where by then (MdtBodySetCenterOfMassRelativePosition). */
MEPUBLIC void MEAPI MdtBodyExpectCentreOfMass(const MdtBodyID b);

/** How many contact groups, and contacts that are in none, it has. */
MEPUBLIC int MEAPI MdtBodyGetManifoldCount(const MdtBodyID b);

/** Wakes a body that the world has put to sleep, not one that the program has disabled. Returns whether it has. */
MEPUBLIC MeBool MEAPI MdtBodyWakeIfAsleep(const MdtBodyID b);

/** Whether the body's only motion since MdtBodyGetMoves was @a moves is that of its last step. */
MEPUBLIC MeBool MEAPI MdtBodyMovedByStep(const MdtBodyID b, unsigned long moves);

/** A contact as collision found it, between bodies whose transforms were read from MdtBodyGetTransformPtr. World frame.
 */
typedef struct MdtFoundContact {
    double position[3];                /**< m */
    double depth;                      /**< m; negative: a gap */
    MeReal normal[3];                  /**< direction in which the group's first body is pushed; not zero */
    MeReal radius[2];                  /**< m, MdtContactSetRadius, by the group's bodies */
    double rim[2], axis[2][3];         /**< m, unit: MdtContactSetRim, the same */
    MeU32 feature;                     /**< MdtContactSetFeature */
    const MdtBclContactParams *params; /**< copied */
} MdtFoundContact;

/**
 * Replaces the group's contacts by those found; contacts[i] is that of found[i]. A contact of the last step persists,
 * with its force as warm start, where its feature id is found again, or else for the contact nearest to where its body
 * has moved it in @a time seconds; the others are destroyed. Returns their number: fewer than @a count, after a
 * warning, where the world is full.
 */
MEPUBLIC int MEAPI MdtContactGroupRenew(MdtContactGroupID g, const MdtFoundContact found[], int count, MeReal time,
                                        MdtContactID contacts[]);

/** An empty group of these bodies, of which the second may be null, for a bridge: *@a holder is set to null when it is
 *  destroyed, and the program may not attach it to others. Null, after a message, where the world is full. */
MEPUBLIC MdtContactGroupID MEAPI MdtContactGroupCreateBridged(const MdtWorldID w, const MdtBodyID b1,
                                                              const MdtBodyID b2, void *generator, void **holder);

/** Is it still one of the group's contacts? Both may have been destroyed, in a world that lives. */
MEPUBLIC MeBool MEAPI MdtContactGroupHas(MdtContactGroupID g, MdtContactID c);

/** Whether MdtContactGroupRenew would neither create nor destroy a contact, and would write to the group only, and end
 *  the rest certificates of its bodies: then several threads may renew different groups at once. */
MEPUBLIC MeBool MEAPI MdtContactGroupGoesOn(MdtContactGroupID g, const MdtFoundContact found[], int count);

/**
 * Moves the group's contacts along with those of its bodies that have moved, by the motion of their last step: the two
 * surface points are fixed in their bodies, and the normal in the second one. Returns the least separation, m;
 * MEINFINITY where there is no contact.
 */
MEPUBLIC MeReal MEAPI MdtContactGroupCarry(MdtContactGroupID g, const MeBool hasMoved[2]);
/** Are all surfaces corners, edges or faces (MdtContactSetRadius)? */
MEPUBLIC MeBool MEAPI MdtContactGroupIsFlat(MdtContactGroupID g);

/** Has the world a joint whose bodies do not collide with each other (MdtConstraintSetBodiesCollide)? */
MEPUBLIC MeBool MEAPI MdtWorldHasNoCollide(const MdtWorldID w);
/** Does an enabled joint between the two say so? Neither is null. */
MEPUBLIC MeBool MEAPI MdtBodiesAreNoCollide(const MdtBodyID b1, const MdtBodyID b2);

/** The world's workers, for all that belongs to its step; null: there is one. */
MEPUBLIC MeTeam *MEAPI MdtWorldGetTeam(const MdtWorldID w);

ME_END_C

#endif
