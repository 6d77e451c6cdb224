/** @file MdtInternal.h
 *  For Mst, which makes worlds of its universes' sizes, and contacts of what collision finds. Not installed.
 */
#ifndef MDTINTERNAL_H
#define MDTINTERNAL_H

#include "MdtTypes.h"
#include "MeTeam.h"

ME_BEGIN_C

/** What a message tells the program to raise where there is no room for more, instead of the arguments of
 *  MdtWorldCreate. Strings that stay. Each limit is spoken of once then. */
MEPUBLIC void MEAPI MdtWorldRenameLimits(const MdtWorldID w, const char *bodies, const char *constraints);

/** Whether that is a world, and a living one. */
MEPUBLIC MeBool MEAPI MdtWorldIsValid(const MdtWorldID w);

/** Counts how often the body's exact place or direction became another one, to the last bit of a double: what was found
 *  of it holds as long as this stays. */
MEPUBLIC unsigned long MEAPI MdtBodyGetMoves(const MdtBodyID b);

/** Has the body, since MdtBodyGetMoves was @a moves, made the motion of its last step, and no other? */
MEPUBLIC MeBool MEAPI MdtBodyMovedByStep(const MdtBodyID b, unsigned long moves);

/** A contact as collision found it, between bodies whose transforms were read from MdtBodyGetTransformPtr. World frame.
 */
typedef struct MdtFoundContact {
    double position[3];                /**< m */
    double depth;                      /**< m; negative: a gap */
    MeReal normal[3];                  /**< the way the group's first body is pushed; not zero */
    MeReal radius[2];                  /**< m, MdtContactSetRadius, by the group's bodies */
    double rim[2], axis[2][3];         /**< m, unit: MdtContactSetRim, the same */
    MeU32 feature;                     /**< MdtContactSetFeature */
    const MdtBclContactParams *params; /**< copied */
} MdtFoundContact;

/**
 * The group's contacts become those that were found, and contacts[i] that of found[i]. One that was there goes on, with
 * its force, where its feature is found again, or else where it is the nearest to where its body has carried it in
 * @a time seconds; the rest is destroyed. Returns how many there are: fewer than @a count where the world is full,
 * which it has said then.
 */
MEPUBLIC int MEAPI MdtContactGroupRenew(MdtContactGroupID g, const MdtFoundContact found[], int count, MeReal time,
                                        MdtContactID contacts[]);

/** Would MdtContactGroupRenew make no contact and destroy none, and write to nothing but the group, and to its bodies
 *  that their rest has ended? Then groups can be renewed by several threads at once, each by one. */
MEPUBLIC MeBool MEAPI MdtContactGroupGoesOn(MdtContactGroupID g, const MdtFoundContact found[], int count);

/**
 * Carries the group's contacts along with those of its bodies that have moved, by the motion of their last step: the
 * points of the two surfaces stay where they are in their bodies, and the normal in the second one. Returns the least
 * separation, m; MEINFINITY where there is no contact.
 */
MEPUBLIC MeReal MEAPI MdtContactGroupCarry(MdtContactGroupID g, const MeBool hasMoved[2]);
/** Are all surfaces corners, edges or faces (MdtContactSetRadius)? */
MEPUBLIC MeBool MEAPI MdtContactGroupIsFlat(MdtContactGroupID g);

/** Has the world a joint whose bodies do not collide with each other (MdtConstraintSetBodiesCollide)? */
MEPUBLIC MeBool MEAPI MdtWorldHasBodiesApart(const MdtWorldID w);
/** Does an enabled joint between the two say so? Neither is null. */
MEPUBLIC MeBool MEAPI MdtBodiesAreApart(const MdtBodyID b1, const MdtBodyID b2);

/** The world's workers, for all that belongs to its step; null: there is one. */
MEPUBLIC MeTeam *MEAPI MdtWorldGetTeam(const MdtWorldID w);

ME_END_C

#endif
