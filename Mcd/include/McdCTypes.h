/** @file McdCTypes.h
 *  The types that the collision library is made of (User Guide ch. 4, "Collision").
 *
 *  A framework knows geometry types and how pairs of them interact. A geometry is a shape. A model is a geometry at a
 *  place, made of one instance, or, for an aggregate, of a tree of instances. A space finds the pairs of models that
 *  are near each other; an interaction turns such a pair into contacts.
 *
 *  Lengths are in the program's unit (m), transforms are MeMatrix4 as in MeMath.h: rigid, no scale. Whoever creates
 *  something destroys it.
 *  - What is destroyed too early (a geometry that models use, a framework that has spaces) is kept, with a warning.
 *  - Frameworks, geometries, models, spaces and instances that have gone may be handed to any function in check builds
 *    (KARMA_CHECK): it gives a warning and a neutral result. In other builds that is undefined, except that the
 *    functions which destroy do nothing.
 *  - So things may go in any order: McdTerm ends what is left in the framework, and destroying a geometry or a model
 *    after it is harmless, in all builds; it is said while there is another framework, to which the handle might
 *    belong. (An address that was given to a new object since is that object.)
 */
#ifndef MCDCTYPES_H
#define MCDCTYPES_H

#include "MeMath.h"

ME_BEGIN_C

typedef struct _McdFramework McdFramework;
typedef McdFramework *McdFrameworkID;
typedef struct _McdGeometry McdGeometry;
typedef McdGeometry *McdGeometryID;
typedef struct _McdGeometryInstance McdGeometryInstance;
typedef McdGeometryInstance *McdGeometryInstanceID;
typedef struct _McdModel McdModel;
typedef McdModel *McdModelID;
typedef McdModelID McdCompositeModelID;
typedef struct _McdModelPair McdModelPair;
typedef McdModelPair *McdModelPairID;
typedef struct _McdModelPairContainer McdModelPairContainer;
typedef struct _McdModelPairContainerIterator McdModelPairContainerIterator;
typedef struct _McdSpace McdSpace;
typedef McdSpace *McdSpaceID;
typedef struct _McdContact McdContact;
typedef McdContact *McdContactID;
typedef struct _McdRequest McdRequest;
typedef McdRequest *McdRequestID;
typedef struct _McdIntersectResult McdIntersectResult;
typedef McdIntersectResult McdInteractionResult; /**< As a sample of the guide calls it. */
typedef struct _McdSafeTimeResult McdSafeTimeResult;
typedef struct _McdLineSegIntersectResult McdLineSegIntersectResult;
typedef struct McdDistanceResult McdDistanceResult;
typedef struct _McdInteractions McdInteractions;

/** The number of a geometry type; the built-in ones are in McdGeometryTypes.h, a program's own follow them. */
typedef MeI16 McdGeometryType;

/** The head of every geometry. A program's own geometry types begin with it and set it up by McdGeometryInit. */
struct _McdGeometry {
    MeU32 magic;           /**< Says that this is a live geometry. Written by McdGeometryInit and McdGeometryDeinit. */
    McdGeometryType type;  /**< Read it by McdGeometryGetType. */
    int referenceCount;    /**< How many instances (of models) and aggregates' elements use it. */
    McdFramework *frame;   /**< What it belongs to. */
    McdGeometry *previous; /**< The framework's list of geometries. */
    McdGeometry *next;
    void *handle[3]; /**< Makes it known while it lives. */
};

/** A model. The rest of it is hidden; use the functions of McdModel.h. */
struct _McdModel {
    void *mBody; /**< What McdModelSetBodyData stored: with the Simulation Toolkit, the MdtBodyID. Null by default. */
    McdModel *mOfBody;               /**< The Simulation Toolkit's: the next model of the same body. */
    void(MEAPI *mLeave)(McdModel *); /**< The Simulation Toolkit's: called before the model is destroyed or reset. */
};

/** What one pair of models is asked for, see McdFrameworkSetDefaultRequestPtr and McdModelPairSetRequestPtr. */
struct _McdRequest {
    int contactMaxCount; /**< At most so many contacts per pair, 1 or more; default 20. */
    /** If true and there are more contacts than that: those whose normals are within 8 degrees of the mean normal are
     *  kept before those at edges and corners (McdContactSimplify). That asks for four times as many contacts first, in
     *  memory of the call. Default: false. */
    MeBool faceNormalsFirst;
};

/** Where a pair is in its life (User Guide ch. 4, "Testing for Collisions"). */
typedef enum McdModelPairPhase {
    kMcdFFStateInactive = 0, /**< In no space's list. */
    kMcdFFStateHello = 1,    /**< Near now, and not before the last change block. */
    kMcdFFStateStaying = 2,  /**< Near now and before. */
    kMcdFFStateGoodbye = 3   /**< Near before, and not now. */
} McdModelPairPhase;

/** Mcd's: what the test of a pair depends on. Zeros: there was none. */
typedef struct McdTest {
    MeU64 stamp1, stamp2; /**< Of the models: others wherever a model moves, or has another shape or margin. */
    MeU64 shape1, shape2; /**< The same, but not where it moves. */
    int contactMaxCount;
    MeBool faceNormalsFirst;
} McdTest;

/** Mcd's: how the first model of a pair stood to the second when the pair was tested last. */
typedef struct McdStand {
    MeReal axes[3][3]; /**< row i: axis i of the first, in the second's frame */
    MeReal place[3];   /**< m, of its origin there */
    MeReal size;       /**< m, of the smaller model; 0: it is not known */
    MeReal apart;      /**< m, by so much at least they were apart; 0: it is not known, or they were not */
} McdStand;

/**
 * Two models that are, or may be, near each other. A space owns its pairs; a program may have its own, zeroed
 * (calloc) but for the models, or made by McdModelPairCreate.
 */
struct _McdModelPair {
    McdModelID model1;       /**< One model. */
    McdModelID model2;       /**< The other. In a space's pairs: the one with the greater sort key, or created later. */
    McdRequest *request;     /**< What is asked for; null: the framework's default. */
    McdTest test;            /**< Mcd's own: as the pair was looked at last. */
    void *responseData;      /**< Collision response's: the Simulation Toolkit keeps its contact group here. */
    McdStand stand;          /**< Mcd's own: as the pair was tested last. */
    McdModelPairPhase phase; /**< Set by the space. */
    void *touch;             /**< The Simulation Toolkit's: what its events know of the pair. */
    void *userData;          /**< The program's. */
    void *m_cachedData;      /**< What the interaction's hello function prepared, its own; null: nothing. */
    void(MEAPI *forget)(McdModelPair *); /**< The Simulation Toolkit's: called before the space takes the pair back. */
    MeBool isHeldApart;                  /**< The same: as its last step began, where some joint holds bodies apart. */
    MeBool mayTurnRound;                 /**< The same: both models may rebound from others before the next test. */
};

/**
 * Pairs as McdSpaceGetPairs hands them over: array[goodbyeFirst .. goodbyeEnd - 1], array[helloFirst .. helloEnd - 1]
 * and array[stayingFirst .. stayingEnd - 1]. The hello pairs end where the staying ones begin, so that one loop from
 * helloFirst to stayingEnd meets all that may touch.
 */
struct _McdModelPairContainer {
    McdModelPair **array; /**< Place for size pairs. */
    int size;
    int goodbyeFirst; /**< 0. */
    int goodbyeEnd;
    int helloFirst;
    int helloEnd;
    int stayingFirst; /**< The same as helloEnd. */
    int stayingEnd;
};

/** Where McdIntersectEach is in a container, see McdModelPairContainerIteratorInit. */
struct _McdModelPairContainerIterator {
    int next; /**< Index into the container's array. */
};

/** Which element of a geometry it is, or what the program knows about it. */
typedef union McdElementData {
    void *ptr; /**< The program's. */
    int tag;   /**< A number. */
} McdElementData;

/** One point where two models touch, or nearly do. */
struct _McdContact {
    MeVector3 position; /**< World frame: half-way between the two surfaces. */
    MeVector3 normal;   /**< World frame, length 1: the way in which the first model is pushed by the second. */
    MeReal separation;  /**< Along the normal: positive for a gap, negative for a penetration. */
    /** Which features touch: the same number for the same ones from step to step, in one result none twice. Of two
     *  convex geometries with at most 256 faces each, or one and a plane, other features have other numbers; else
     *  (larger hulls, triangles, parts of aggregates) the number is a hash, and two features of a pair share one
     *  with a probability of 2e-10. */
    MeU32 feature;
    McdGeometryInstanceID instance1; /**< The part of the first model: its own instance, or an aggregate's child. */
    McdGeometryInstanceID instance2; /**< The part of the second model. */
    /** What touches of the first model's part: the McdUserTriangle.triangleData of a triangle list's triangle, the tag
     *  of a height field's (McdRGHeightField.h); for other geometries a null ptr. */
    McdElementData element1;
    McdElementData element2; /**< The same for the second model's part. */
    int dims; /**< The dimension of the region where the parts touch: 0 in a point, 1 along a line, 2 over an area. */
    double exactSeparation;  /**< separation as it was before MeReal rounded it: see McdContactGetSeparation. */
    double exactPosition[3]; /**< The same of position: see McdContactGetPosition. */
    double radius[2];        /**< Of either model's surface, where it is round: see McdContactGetRadius. */
};

/** What McdIntersect finds. Set the first three members before the call. */
struct _McdIntersectResult {
    McdModelPair *pair;   /**< The pair that was tested. */
    McdContact *contacts; /**< Where contacts go. */
    int contactMaxCount;  /**< How many fit there. */
    int contactCount;     /**< How many there are. */
    int touch;            /**< 1 if the models touch, to within their contact tolerance; else 0. */
    MeVector3 normal;     /**< The mean of the contacts' normals, length 1; (0, 0, 0) where there is no contact. */
    void *data;           /**< The program's. */
    MeReal apart;         /**< Mcd's own: m, the models are so far apart at least; 0: it is not known. */
};

/** What McdSafeTime finds. */
struct _McdSafeTimeResult {
    McdModelPair *pair; /**< The pair that was tested. */
    MeReal time;        /**< The models do not touch before that time (s), at most maxTime. */
    MeVector3 position; /**< Where they touch then, world frame; undefined if they don't. */
    MeVector3 normal;   /**< The way the first model is pushed then; (0, 0, 0) if they do not touch until maxTime. */
};

/** Where a line segment enters a model. */
struct _McdLineSegIntersectResult {
    McdModelID model;   /**< The model that is hit. */
    MeVector3 position; /**< World frame. */
    MeVector3 normal;   /**< Of the model's surface there, outward, length 1. */
    MeReal distance;    /**< From the first end of the segment. */
};

/** The nearest points of two models, see McdDistance. */
struct McdDistanceResult {
    MeReal distance;     /**< Between the surfaces; negative where they penetrate, and then the depth. */
    MeVector3 position1; /**< The point on the first model, world frame. */
    MeVector3 position2; /**< The point on the second. */
    MeVector3 normal;    /**< Length 1, from the second to the first. */
};

/** @name What an interaction and a geometry type are made of
 *  Functions that may not move models, nor change what these are made of, while they are being tested; what they
 *  destroy waits (docs/simulation.md, "Callbacks").
 *  @{ */
/** Prepares a pair; 0 if that is impossible. */
typedef MeBool(MEAPI *McdHelloFn)(McdModelPair *);
/** Undoes what the hello function did. */
typedef void(MEAPI *McdGoodbyeFn)(McdModelPair *);
/** Finds contacts of a pair whose models have the interaction's types in its order; 1 if they touch. */
typedef int(MEAPI *McdIntersectFn)(McdModelPair *, McdIntersectResult *);
/** Finds how long the pair may move without touching; 1 if it could. */
typedef int(MEAPI *McdSafeTimeFn)(McdModelPair *, MeReal maxTime, McdSafeTimeResult *);
/** Intersects a line segment with a model; 1 if it is hit. */
typedef int(MEAPI *McdLineSegIntersectFnPtr)(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                             McdLineSegIntersectResult *outOverlap);
/** How models of two types interact. Null members are what the pair cannot do. */
struct _McdInteractions {
    McdHelloFn helloFn;
    McdGoodbyeFn goodbyeFn;
    McdIntersectFn intersectFn;
    McdSafeTimeFn safeTimeFn;
};

/** Frees what a geometry has beside its own memory, and that memory, which MeMemoryAPI.create gave. */
typedef void(MEAPI *McdGeometryDestroyFnPtr)(McdGeometryID);
/** Calls McdGeometryInstanceSetAABB with a box around the instance where it is; where finalTM is not null, around the
 *  motion from there to finalTM. */
typedef void(MEAPI *McdGeometryGetAABBFnPtr)(McdGeometryInstanceID, const MeMatrix4Ptr finalTM, MeBool tight);
/** The smallest or a small sphere around the geometry, in its own frame. */
typedef void(MEAPI *McdGeometryGetBSphereFnPtr)(const McdGeometryID, MeVector3 center, MeReal *radius);
/** The world point of the instance that is farthest in the world direction inDir. */
typedef void(MEAPI *McdGeometryMaximumPointFnPtr)(McdGeometryInstanceID, MeReal *const inDir, MeReal *const outPoint);
/** Centre of mass (as a transform relative to the geometry), inertia of unit density about it, and volume. 0: none. */
typedef MeI16(MEAPI *McdGeometryGetMassPropertiesFnPtr)(McdGeometryID, MeMatrix4, MeMatrix3, MeReal *);
/** Draws by MeDebugDrawLine. */
typedef void(MEAPI *McdGeometryDebugDrawFnPtr)(const McdGeometryID, const MeMatrix4 tm, const MeReal colour[3]);
/** The type's name. */
typedef char *(MEAPI *McdGeometryGetTypeNameFnPtr)(const McdGeometryID);
/** @} */

/** @name Other functions of the program: what each may do has docs/simulation.md, "Callbacks"
 *  @{ */
/** Called when a model is updated; may move it. */
typedef void(MEAPI *McdModelUpdateFnPtr)(McdModel *model);
/** Called after McdIntersect with the contacts of a pair in which the model is; may change them. */
typedef void(MEAPI *McdModelIntersectFnPtr)(McdModel *model, McdIntersectResult *result);
/** Called by McdHello for each pair. */
typedef void(MEAPI *McdHelloCallbackFnPtr)(McdModelPair *);
/** Called when a space has no place for the pair of these models. */
typedef void(MEAPI *McdSpacePoolErrorFnPtr)(McdModelID model1, McdModelID model2);
/** Called by McdTerm. */
typedef void(MEAPI *McdTermAction)(McdFrameworkID frame);
/** @} */

ME_END_C

#endif
