/** @file McdCTypes.h
 *  The types of the collision library.
 *
 *  A framework registers geometry types and interactions between pairs of them. A geometry is a shape. A model is a
 *  geometry at a place: it has one instance or, for an aggregate, a tree of instances. A space finds the pairs of
 *  models that are near each other; an interaction computes the contacts of such a pair.
 *
 *  Lengths are in the program's unit (m), transforms are MeMatrix4 as in MeMath.h: rigid, without scale. A program
 *  destroys what it creates.
 *  - An object that is still in use (a geometry of models, a framework with spaces) is not destroyed: a warning.
 *  - In check builds (KARMA_CHECK) any function may be given a framework, geometry, model, space or instance that
 *    has been destroyed: it warns and returns a neutral result. In other builds that is undefined, except that
 *    functions which destroy ignore such objects.
 *  - So objects may be destroyed in any order: McdTerm destroys what is left in the framework, and destroying a
 *    geometry or model after it does no harm, in all builds; there is a warning if another framework is alive, to
 *    which the handle might belong. (If a new object has got the address, the handle is that object's.)
 */
#ifndef MCDCTYPES_H
#define MCDCTYPES_H

#include <stdbool.h>

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
typedef McdIntersectResult McdInteractionResult; /**< The name in a sample of the guide. */
typedef struct _McdSafeTimeResult McdSafeTimeResult;
typedef struct _McdLineSegIntersectResult McdLineSegIntersectResult;
typedef struct McdDistanceResult McdDistanceResult;
typedef struct _McdInteractions McdInteractions;

/** The number of a geometry type: the built-in types are in McdGeometryTypes.h, a program's own types follow them. */
typedef MeI16 McdGeometryType;

/** The head of every geometry record. A program's own geometry records begin with it; McdGeometryInit initializes
 *  it. */
struct _McdGeometry {
    MeU32 magic;           /**< Marks a live geometry. Written by McdGeometryInit and McdGeometryDeinit. */
    McdGeometryType type;  /**< Read it by McdGeometryGetType. */
    int referenceCount;    /**< Number of references by instances (of models) and by elements of aggregates. */
    McdFramework *frame;   /**< The framework that it belongs to. */
    McdGeometry *previous; /**< In the framework's list of geometries. */
    McdGeometry *next;
    void *handle[3]; /**< For the table of live objects. */
};

/** A model: the visible part. Use the functions of McdModel.h. */
struct _McdModel {
    void *mBody; /**< The data of McdModelSetBodyData; with the Simulation Toolkit the MdtBodyID. Null by default. */
    McdModel *mOfBody;               /**< For the Simulation Toolkit: the next model of the same body. */
    void(MEAPI *mLeave)(McdModel *); /**< For the Simulation Toolkit: called before the model is destroyed or reset. */
};

/** Options for the test of a pair, see McdFrameworkSetDefaultRequestPtr and McdModelPairSetRequestPtr. */
struct _McdRequest {
    int contactMaxCount; /**< Maximum number of contacts per pair, 1 or more; default 20. */
    /** Whether, if there are more contacts than that, those whose normals are within 8 degrees of the mean normal
     *  are kept before those at edges and corners (McdContactSimplify). To this end four times as many contacts are
     *  computed, in memory of the call. Default: false. */
    MeBool faceNormalsFirst;
};

/** The phase of a pair (User Guide ch. 4, "Testing for Collisions"). */
typedef enum McdModelPairPhase {
    kMcdFFStateInactive = 0, /**< Not in a space's list. */
    kMcdFFStateHello = 1,    /**< Near; not so before the last change block. */
    kMcdFFStateStaying = 2,  /**< Near, and so before. */
    kMcdFFStateGoodbye = 3   /**< Not near; near before the last change block. */
} McdModelPairPhase;

/** Internal: the inputs of a pair's last test. Zeros: there was none. */
typedef struct McdTest {
    MeU64 stamp1, stamp2; /**< Versions of the models: they change with pose, shape and margin. */
    MeU64 shape1, shape2; /**< Versions of the models' shapes: they do not change with the pose. */
    int contactMaxCount;
    MeBool faceNormalsFirst;
} McdTest;

/** Internal: the pose of the pair's first model relative to the second at the last test. */
typedef struct McdStand {
    MeReal axes[3][3]; /**< row i: axis i of the first model in the second's frame */
    MeReal place[3];   /**< m, origin of the first model in the second's frame */
    MeReal size;       /**< m, of the smaller model; 0: not known */
    MeReal apart;      /**< m, lower bound of the models' gap; 0: not known, or no gap */
} McdStand;

/**
 * Two models that are, or may be, near each other. A space owns its pairs. A program may make its own by
 * McdModelPairCreate, or as a record of zeros (calloc) apart from the models.
 */
struct _McdModelPair {
    McdModelID model1;   /**< The first model. */
    McdModelID model2;   /**< The second model; in a space's pairs that with the lower sort key, or created first. */
    McdRequest *request; /**< Options of the test; null: the framework's default. */
    McdTest test;        /**< Internal: inputs of the last test. */
    void *responseData;  /**< For collision response: the Simulation Toolkit stores its contact group. */
    McdStand stand;      /**< Internal: relative pose at the last test. */
    McdModelPairPhase phase;             /**< Set by the space. */
    void *touch;                         /**< For the Simulation Toolkit: its record for events. */
    void *userData;                      /**< The program's. */
    void *m_cachedData;                  /**< Data of the interaction's hello function; null: none. */
    void(MEAPI *forget)(McdModelPair *); /**< For the Simulation Toolkit: called before the space frees the pair. */
    bool isHeldApart;         /**< For the Simulation Toolkit: some joint disables collision of the bodies. */
    bool isWithinLargeIsland; /**< For the Simulation Toolkit: fast models get the contacts of slow ones. */
    bool mayTurnRound;        /**< For the Simulation Toolkit: either model may rebound before the next test. */
    bool isJointed;           /**< For the Simulation Toolkit: the body on a fixed model had joints at the last test. */
};

/**
 * Pairs that McdSpaceGetPairs returns: goodbye pairs in array[goodbyeFirst .. goodbyeEnd - 1], hello pairs in
 * array[helloFirst .. helloEnd - 1], staying pairs in array[stayingFirst .. stayingEnd - 1]. The staying pairs follow
 * the hello pairs directly, so one loop from helloFirst to stayingEnd visits all pairs that may touch.
 */
struct _McdModelPairContainer {
    McdModelPair **array; /**< Room for `size` pairs. */
    int size;
    int goodbyeFirst; /**< 0. */
    int goodbyeEnd;
    int helloFirst;
    int helloEnd;
    int stayingFirst; /**< Equal to helloEnd. */
    int stayingEnd;
};

/** Position of McdIntersectEach in a container, see McdModelPairContainerIteratorInit. */
struct _McdModelPairContainerIterator {
    int next; /**< Index of the next pair in the container's array. */
};

/** Identifies an element of a geometry (a triangle): a number, or the program's data. */
typedef union McdElementData {
    void *ptr; /**< The program's. */
    int tag;   /**< A number. */
} McdElementData;

/** A point where two models touch, or nearly touch. */
struct _McdContact {
    MeVector3 position; /**< World frame: midway between the two surfaces. */
    MeVector3 normal;   /**< World frame, length 1: the direction in which the second model pushes the first. */
    MeReal separation;  /**< Along the normal: positive for a gap, negative for a penetration. */
    /** Feature id: equal for equal features in consecutive steps, and unique within a result. For two convex
     *  geometries with at most 256 faces each, or one of these and a plane, different features have different ids.
     *  Otherwise (larger hulls, triangles, children of aggregates) the id is a hash: two features of a pair have the
     *  same one with a probability of 2e-10. */
    MeU32 feature;
    McdGeometryInstanceID instance1; /**< The first model's shape: its own instance, or a child of an aggregate. */
    McdGeometryInstanceID instance2; /**< The second model's shape. */
    /** The element of the first model's shape: for a triangle list the triangle's McdUserTriangle.triangleData, for a
     *  mesh or a height field the triangle's number as tag (McdMesh.h, McdRGHeightField.h), for other geometries a
     *  null ptr. */
    McdElementData element1;
    McdElementData element2; /**< The element of the second model's shape. */
    int dims;                /**< The dimension of the region in which they touch: 0 a point, 1 a line, 2 an area. */
    double exactSeparation;  /**< The separation before rounding to MeReal: use McdContactGetSeparation. */
    double exactPosition[3]; /**< The position before rounding to MeReal: use McdContactGetPosition. */
    double radius[2];        /**< Radii of both surfaces, where round: use McdContactGetRadius. */
    int vertices;            /**< Bit k: a vertex of model k touches: use McdContactIsVertex. */
    MeVector3 edge;          /**< Axis of the triangle's edge that a round surface rolls over; 0: none. */
};

/** The result of McdIntersect. Set the first three members before the call. */
struct _McdIntersectResult {
    McdModelPair *pair;   /**< The pair that was tested. */
    McdContact *contacts; /**< Array for the contacts. */
    int contactMaxCount;  /**< Room in that array. */
    int contactCount;     /**< Number of contacts. */
    int touch;            /**< 1 if there are contacts: the gap is within the contact tolerance; else 0. */
    MeVector3 normal;     /**< The mean of the contacts' normals, length 1; (0, 0, 0) where there is no contact. */
    void *data;           /**< The program's. */
    MeReal apart;         /**< Internal: m, a lower bound of the gap between the models; 0: not known. */
};

/** The result of McdSafeTime. */
struct _McdSafeTimeResult {
    McdModelPair *pair; /**< The pair that was tested. */
    MeReal time;        /**< The models do not touch before this time (s); at most maxTime. */
    MeVector3 position; /**< Where they touch then, world frame; undefined if they do not. */
    MeVector3 normal;   /**< The direction in which the first model is pushed then; (0, 0, 0) if they do not touch. */
};

/** Where a line segment enters a model. */
struct _McdLineSegIntersectResult {
    McdModelID model;               /**< The model that is hit. */
    MeVector3 position;             /**< World frame. */
    MeVector3 normal;               /**< The model's outward normal there, length 1. */
    MeReal distance;                /**< From the start of the segment. */
    McdGeometryInstanceID instance; /**< The shape hit: the model's own instance, or a child of an aggregate.
                                         Beyond Karma. */
    McdElementData element; /**< The shape's triangle, as in McdContact.element1; for other geometries a null ptr.
                                 Beyond Karma. */
};

/** The closest points of two models, see McdDistance. */
struct McdDistanceResult {
    MeReal distance;     /**< Between the surfaces; if the models penetrate, the negative depth. */
    MeVector3 position1; /**< The point on the first model, world frame. */
    MeVector3 position2; /**< The point on the second. */
    MeVector3 normal;    /**< Length 1, from the second model to the first. */
};

/** @name Functions of interactions and geometry types
 *  While models are being tested, these functions must not move models or change their geometries; objects that they
 *  destroy are destroyed later (docs/simulation.md, "Callbacks").
 *  @{ */
/** Prepares a pair; 0 if that is impossible. */
typedef MeBool(MEAPI *McdHelloFn)(McdModelPair *);
/** Undoes what the hello function did. */
typedef void(MEAPI *McdGoodbyeFn)(McdModelPair *);
/** Finds the contacts of a pair whose models have the interaction's types in its order; returns 1 if they touch. */
typedef int(MEAPI *McdIntersectFn)(McdModelPair *, McdIntersectResult *);
/** Finds how long the models of a pair may move without touching; returns 1 if it could. */
typedef int(MEAPI *McdSafeTimeFn)(McdModelPair *, MeReal maxTime, McdSafeTimeResult *);
/** Intersects a line segment with a model; returns 1 if it is hit. */
typedef int(MEAPI *McdLineSegIntersectFnPtr)(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                             McdLineSegIntersectResult *outOverlap);
/** The functions for pairs of models of two types. Null functions are not supported. */
struct _McdInteractions {
    McdHelloFn helloFn;
    McdGoodbyeFn goodbyeFn;
    McdIntersectFn intersectFn;
    McdSafeTimeFn safeTimeFn;
};

/** Frees a geometry: what it owns, and its own memory, which was allocated by MeMemoryAPI.create. */
typedef void(MEAPI *McdGeometryDestroyFnPtr)(McdGeometryID);
/** Sets the instance's box by McdGeometryInstanceSetAABB: around the instance or, if finalTM is not null, around its
 *  motion from its transform to finalTM. */
typedef void(MEAPI *McdGeometryGetAABBFnPtr)(McdGeometryInstanceID, const MeMatrix4Ptr finalTM, MeBool tight);
/** A bounding sphere of the geometry, in its own frame; preferably a small one. */
typedef void(MEAPI *McdGeometryGetBSphereFnPtr)(const McdGeometryID, MeVector3 center, MeReal *radius);
/** The world point of the instance that is farthest in the world direction inDir. */
typedef void(MEAPI *McdGeometryMaximumPointFnPtr)(McdGeometryInstanceID, MeReal *const inDir, MeReal *const outPoint);
/** The centre of mass (as a transform relative to the geometry), the inertia about it for unit density, and the
 *  volume. Returns 0 if there are none. */
typedef MeI16(MEAPI *McdGeometryGetMassPropertiesFnPtr)(McdGeometryID, MeMatrix4, MeMatrix3, MeReal *);
/** Draws the geometry by MeDebugDrawLine. */
typedef void(MEAPI *McdGeometryDebugDrawFnPtr)(const McdGeometryID, const MeMatrix4 tm, const MeReal colour[3]);
/** Returns the type's name. */
typedef char *(MEAPI *McdGeometryGetTypeNameFnPtr)(const McdGeometryID);
/** @} */

/** @name Other callbacks: docs/simulation.md, "Callbacks", says what each may do
 *  @{ */
/** Called when a model is updated; may move it. */
typedef void(MEAPI *McdModelUpdateFnPtr)(McdModel *model);
/** Called after McdIntersect with the contacts of each pair that contains the model; may change them. */
typedef void(MEAPI *McdModelIntersectFnPtr)(McdModel *model, McdIntersectResult *result);
/** Called by McdHello for each pair. */
typedef void(MEAPI *McdHelloCallbackFnPtr)(McdModelPair *);
/** Called when a space has no room for the pair of these models. */
typedef void(MEAPI *McdSpacePoolErrorFnPtr)(McdModelID model1, McdModelID model2);
/** Called by McdTerm. */
typedef void(MEAPI *McdTermAction)(McdFrameworkID frame);
/** @} */

ME_END_C

#endif
