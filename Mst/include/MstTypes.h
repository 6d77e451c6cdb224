/** @file MstTypes.h
 *  The types of the Simulation Toolkit (User Guide ch. 5, "Creating a Universe").
 */
#ifndef MSTTYPES_H
#define MSTTYPES_H

#include "McdCTypes.h"
#include "MdtTypes.h"

ME_BEGIN_C

typedef unsigned int MstMaterialID; /**< Of a model: 0 is the default material. */
typedef struct MstBridge MstBridge;
typedef MstBridge *MstBridgeID;
typedef struct MstUniverse MstUniverse;
typedef MstUniverse *MstUniverseID;

/** Sees the collision contacts of a pair, and may change them or take some away (contactCount). What this and the next
 *  two may do else, as destroying models: docs/simulation.md, "Callbacks". */
typedef void(MEAPI *MstIntersectCBPtr)(McdIntersectResult *result);
/** Sees each collision contact and the dynamics contact made of it; 0 deletes the latter. */
typedef MeBool(MEAPI *MstPerContactCBPtr)(McdIntersectResult *result, McdContact *colC, MdtContactID dynC);
/** Sees all dynamics contacts of a pair; 0 deletes them. */
typedef MeBool(MEAPI *MstPerPairCBPtr)(McdIntersectResult *result, MdtContactGroupID c);

/** What has happened, see MstEvent. */
typedef enum MstEventKind {
    MstEventBegin = 0,   /**< Two models touch that did not in the step before. */
    MstEventPersist = 1, /**< They touch still. */
    MstEventEnd = 2,     /**< They do not any more. */
    MstEventBreak = 3    /**< A joint broke (MdtConstraintSetBreakLimits). */
} MstEventKind;

/** Something that happened in a step. World frame, SI or the program's units. */
typedef struct MstEvent {
    MstEventKind kind;
    McdModelID model1,
        model2; /**< In the order of McdModelPair; null for one that was destroyed since, and for breaks. */
    MstMaterialID material1, material2; /**< Of the models, as they were when they touched last. */
    MeBool isSensor;                    /**< One of them is a sensor: they overlap, and nothing is pushed. */
    MeReal impulse;        /**< N s: the normal one of all their contacts in the step. 0 for sensors and ends. */
    MeReal approachSpeed;  /**< m/s, at the fastest contact before it was met; of begins only. */
    MeVector3 position;    /**< Of the contact with the largest impulse, the deepest for sensors; 0 for ends. */
    MeVector3 normal;      /**< There, length 1: the way in which model1 is pushed; 0 for ends. */
    MdtConstraintID joint; /**< The one that broke; null for others, and if it was destroyed since. */
} MstEvent;

/** Sees the begin, persist and end events of a pair of materials. It may do anything but step or end the universe, and
 *  at once (docs/simulation.md, "Callbacks"). */
typedef void(MEAPI *MstTouchCBPtr)(const MstEvent *event);

/** What holds where models of two materials touch. */
typedef struct MstMaterialPair {
    MdtBclContactParams params;    /**< Copied into each contact. */
    MstIntersectCBPtr intersectCb; /**< Null: none. */
    MstPerContactCBPtr perContactCb;
    MstPerPairCBPtr perPairCb;
    MstTouchCBPtr touchCb;
} MstMaterialPair;

/** The bridge. The rest of it is hidden; use the functions of MstBridge.h. */
struct MstBridge {
    McdModelPairContainer *pairs; /**< Where pairs are while they are handled. */
};

/** How much there may be in a universe. 0 of anything but of geometry types: as much as there is memory for. Pools grow
 *  when they are full, then, each time to twice their size, and nothing that a program has a pointer to moves; the
 *  motion is the same, bit by bit, whichever the sizes are. With other sizes memory is taken when the universe is
 *  created, and what has no room is not made, with a warning that names the member here, once. */
typedef struct MstUniverseSizes {
    unsigned int dynamicBodiesMaxCount;              /**< Bodies. */
    unsigned int dynamicConstraintsMaxCount;         /**< Joints, contact groups and contacts together. */
    unsigned int collisionUserGeometryTypesMaxCount; /**< The program's own geometry types; 0: none. */
    unsigned int collisionModelsMaxCount;            /**< Models. */
    unsigned int collisionPairsMaxCount;             /**< Pairs of models near each other at a time. */
    unsigned int collisionGeometryInstancesMaxCount; /**< Children of all aggregate models together. */
    unsigned int materialsMaxCount;                  /**< Materials, the default one included. */
    MeReal lengthScale;                              /**< m, of a medium-sized object: tolerances, rest, epsilon. */
    MeReal massScale;                                /**< kg, the same: the default mass, epsilon. */
} MstUniverseSizes;

/** 100 bodies, 500 constraints, 0 types, 100 models, 500 pairs, 100 instances, 10 materials, scales of 1. */
extern MEPUBLIC const MstUniverseSizes MstUniverseDefaultSizes;
/** No limits: 0 of everything, scales of 1. */
extern MEPUBLIC const MstUniverseSizes MstUniverseGrowingSizes;

/** A universe: collision and dynamics with what joins them. */
struct MstUniverse {
    MdtWorldID world;       /**< Dynamics. */
    McdFrameworkID frame;   /**< Geometry types, geometries and models. */
    McdSpaceID space;       /**< The farfield. */
    MstBridgeID bridge;     /**< What makes contacts of touching pairs. */
    MstUniverseSizes sizes; /**< As given to MstUniverseCreate. */
};

ME_END_C

#endif
