/** @file MstTypes.h
 *  The types of the Simulation Toolkit.
 */
#ifndef MSTTYPES_H
#define MSTTYPES_H

#include "McdCTypes.h"
#include "MdtTypes.h"

ME_BEGIN_C

typedef unsigned int MstMaterialID; /**< Material of a model: 0 is the default one. */
typedef struct MstBridge MstBridge;
typedef MstBridge *MstBridgeID;
typedef struct MstUniverse MstUniverse;
typedef MstUniverse *MstUniverseID;

/** Receives the collision contacts of a pair, and may change or remove some (contactCount). For what this and the next
 *  two callbacks may do besides, such as destroying models, see docs/simulation.md, "Callbacks". */
typedef void(MEAPI *MstIntersectCBPtr)(McdIntersectResult *result);
/** Receives each collision contact and the dynamics contact made from it; returning 0 deletes the latter. */
typedef MeBool(MEAPI *MstPerContactCBPtr)(McdIntersectResult *result, McdContact *colC, MdtContactID dynC);
/** Receives all dynamics contacts of a pair; returning 0 deletes them. */
typedef MeBool(MEAPI *MstPerPairCBPtr)(McdIntersectResult *result, MdtContactGroupID c);

/** The kind of an MstEvent. */
typedef enum MstEventKind {
    MstEventBegin = 0,   /**< Two models began to touch. */
    MstEventPersist = 1, /**< Two models continue to touch. */
    MstEventEnd = 2,     /**< Two models no longer touch. */
    MstEventBreak = 3    /**< A joint broke (MdtConstraintSetBreakLimits). */
} MstEventKind;

/** An event of a step. World frame, SI or the program's units. */
typedef struct MstEvent {
    MstEventKind kind;
    McdModelID model1, model2;          /**< In the order of McdModelPair; null if destroyed since, and for breaks. */
    MstMaterialID material1, material2; /**< Of the models, at their last touch. */
    MeBool isSensor;                    /**< One model is a sensor: they overlap, without contact forces. */
    MeReal impulse;        /**< N s: sum of the normal impulses of all their contacts in the step. 0 for sensors and
                                ends. */
    MeReal approachSpeed;  /**< m/s, the largest closing speed of the contacts as they meet, with what gravity and the
                                forces of the step add; begin events only. */
    MeVector3 position;    /**< Of the contact with the largest impulse (sensors: the deepest one); 0 for ends. */
    MeVector3 normal;      /**< At the same contact, length 1: direction in which model1 is pushed; 0 for ends. */
    MdtConstraintID joint; /**< The broken joint; null for other events, and if destroyed since. */
} MstEvent;

/** Receives the begin, persist and end events of a pair of materials. It may do anything, with immediate effect, but
 *  step or destroy the universe (docs/simulation.md, "Callbacks"). */
typedef void(MEAPI *MstTouchCBPtr)(const MstEvent *event);

/** Parameters and callbacks of contacts between two materials. */
typedef struct MstMaterialPair {
    MdtBclContactParams params;    /**< Copied into each contact. */
    MstIntersectCBPtr intersectCb; /**< Null: none. */
    MstPerContactCBPtr perContactCb;
    MstPerPairCBPtr perPairCb;
    MstTouchCBPtr touchCb;
} MstMaterialPair;

/** The bridge. Its other members are private: use the functions of MstBridge.h. */
struct MstBridge {
    McdModelPairContainer *pairs; /**< Buffer of the pairs that are being handled. */
};

/** Capacities of a universe. 0, except for geometry types, means no limit but memory: the pool doubles when it is full,
 *  and pointers of the program stay valid. Any other capacity is allocated when the universe is created; creating an
 *  object beyond it fails, with a warning, given once, that names the member of this structure. The motion is the same,
 *  bit by bit, for all capacities. */
typedef struct MstUniverseSizes {
    unsigned int dynamicBodiesMaxCount;
    unsigned int dynamicConstraintsMaxCount;         /**< Sum of joints, contact groups and contacts. */
    unsigned int collisionUserGeometryTypesMaxCount; /**< The program's own geometry types; 0: none. */
    unsigned int collisionModelsMaxCount;
    unsigned int collisionPairsMaxCount;             /**< Pairs of near models at any time. */
    unsigned int collisionGeometryInstancesMaxCount; /**< Children of all aggregate models together. */
    unsigned int materialsMaxCount;                  /**< Materials, the default one included. */
    MeReal lengthScale;                              /**< m, size of a typical object: sets tolerances, sleep
                                                          thresholds, epsilon. */
    MeReal massScale;                                /**< kg, mass of a typical object: sets the default mass,
                                                          epsilon. */
} MstUniverseSizes;

/** 100 bodies, 500 constraints, 0 types, 100 models, 500 pairs, 100 instances, 10 materials, scales of 1. */
extern MEPUBLIC const MstUniverseSizes MstUniverseDefaultSizes;
/** No limits: 0 of everything, scales of 1. */
extern MEPUBLIC const MstUniverseSizes MstUniverseGrowingSizes;

/** A universe: collision, dynamics and the bridge between them. */
struct MstUniverse {
    MdtWorldID world;            /**< Dynamics. */
    McdFrameworkID frame;        /**< Geometry types, geometries and models. */
    McdSpaceID space;            /**< The farfield (broad phase). */
    MstBridgeID bridge;          /**< Makes contacts of touching pairs. */
    MstUniverseSizes sizes;      /**< As given to MstUniverseCreate. */
    struct MstVehicle *vehicles; /**< Private. */
    struct MstMover *movers;     /**< Private. */
};

ME_END_C

#endif
