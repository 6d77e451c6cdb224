/** @file MstMover.h
 *  Characters: a capsule that is moved, not simulated. Beyond Karma.
 *
 *  Each step a program gives a mover the velocity that its character wants. The mover goes that way as far as it can:
 *  it slides along what is in the way, climbs steps, follows the ground down, does not climb slopes beyond a limit,
 *  rides on what it stands on, and pushes bodies. It keeps a small gap (the skin) from everything, and never passes
 *  through anything that stands still, at any speed. A model that moves into it pushes it out, if that moves by less
 *  than the capsule's radius in a step. Between surfaces that hold it, such as two steep slopes, it is on ground.
 *
 *  A mover is no model: bodies do not feel it but for its pushes, not its weight, and it does not touch other movers.
 *  Move it between steps, outside of callbacks. Models that were inserted into the space since the last step or
 *  McdSpaceUpdateAll are not found yet. Destroy movers before their universe. Metres, seconds, the world frame;
 *  lengths, positions and speeds beyond 2^24 are bad arguments.
 */
#ifndef MSTMOVER_H
#define MSTMOVER_H

#include "McdModel.h"
#include "McdSpace.h"
#include "MstTypes.h"

ME_BEGIN_C

typedef struct MstMover MstMover;
typedef MstMover *MstMoverID;

/** What a mover is like. */
typedef struct MstMoverParams {
    MeReal radius;                            /**< m, of the capsule. */
    MeReal height;                            /**< m, from its lowest to its highest point; more than 2 radius. */
    MeVector3 up;                             /**< Not zero; normalized at creation. */
    MeReal slopeLimit;                        /**< rad, 0 .. pi/2: steeper ground is not climbed, and not stood on. */
    MeReal stepHeight;                        /**< m, >= 0: lower steps are climbed, and followed down. */
    MeReal skin;                              /**< m, > 0: the gap that is kept, less than the radius. */
    MeReal pushStrength;                      /**< N, >= 0: the largest force on each body in its way. */
    McdLineSegIntersectEnableCallback filter; /**< Only models for which it returns non-zero count; null: all. */
    void *filterData;
} MstMoverParams;

/** What a mover touched; a sum of these. */
typedef enum MstMoverFlags {
    kMstMoverOnGround = 1, /**< It stands on ground within the slope limit. */
    kMstMoverOnSteep = 2,  /**< It touches ground beyond the slope limit. */
    kMstMoverSide = 4,     /**< It touches a wall. */
    kMstMoverHead = 8,     /**< It touches something above it. */
    kMstMoverStepped = 16  /**< It climbed a step. */
} MstMoverFlags;

/** Where a mover came to be. */
typedef struct MstMoverResult {
    MeVector3 position; /**< Of the capsule's lowest point. */
    MeVector3 velocity; /**< For the next call, after sliding: relative to the ground while on ground. */
    int flags;          /**< MstMoverFlags. */
    McdModelID ground;  /**< What it stands on; null if it is not on ground. The next three are 0 then. */
    MeVector3 groundPosition, groundNormal; /**< A point of the ground, and its direction there, length 1. */
    MeVector3 groundVelocity;               /**< m/s, of that point, since the last call. */
} MstMoverResult;

/** Sets parameters of a grown person for a universe: radius .3, height 1.8, step height .35, skin .02 length scales; up
 *  against gravity (z without gravity), slope limit 50 degrees, push strength 500 N times the mass scale. */
MEPUBLIC void MEAPI MstMoverSetDefaults(MstMoverParams *params, MstUniverseID u);
/** Creates a mover with its lowest point at @a position. Null, with a warning, for bad parameters. */
MEPUBLIC MstMoverID MEAPI MstMoverCreate(MstUniverseID u, const MstMoverParams *params, const MeVector3 position);
/** Destroys a mover. Null does nothing. */
MEPUBLIC void MEAPI MstMoverDestroy(MstMoverID m);
/**
 * Moves it for a step.
 * @param velocity m/s, wanted; relative to the ground while on ground. There its component along up is ignored unless
 *                 it is upward, which leaves the ground (a jump); else it should contain the speed of the fall.
 * @param step     s, > 0: the step that follows, or the last one.
 * @param result   may be null.
 * On leaving the ground the ground's velocity is added to result->velocity, on landing it is subtracted.
 * Bad arguments get a warning, and it stays.
 */
MEPUBLIC void MEAPI MstMoverMove(MstMoverID m, const MeVector3 velocity, MeReal step, MstMoverResult *result);
/** Puts its lowest point somewhere, without regard to what is on the way. It is in the air there. */
MEPUBLIC void MEAPI MstMoverSetPosition(MstMoverID m, const MeVector3 position);
/** m, of its lowest point. For a bad handle: a warning, and nothing is written. */
MEPUBLIC void MEAPI MstMoverGetPosition(MstMoverID m, MeVector3 position);
/** Changes its height (m, more than 2 radius), for crouching and standing up; the lowest point stays. Returns false and
 *  changes nothing if the new capsule would overlap something. */
MEPUBLIC MeBool MEAPI MstMoverSetHeight(MstMoverID m, MeReal height);
/** m: of the whole capsule; 0, with a warning, for a bad handle. */
MEPUBLIC MeReal MEAPI MstMoverGetHeight(MstMoverID m);

ME_END_C

#endif
