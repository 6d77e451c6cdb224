/* Inside Mcd: the records of frameworks, models and instances, and functions shared by the files of this library.
 *
 * Ownership: a framework owns its type table, a pool of models and a pool of aggregates' child instances, and the list
 * of geometries. A model's own instance is a part of the model; its children come from the pool.
 * Programs see MeReal; everything between a transform and a contact is double (mcd_shape_i.h).
 */
#ifndef MCD_I_H
#define MCD_I_H

#include "McdCTypes.h"
#include "McdFrame.h"
#include "McdGeometry.h"
#include "McdGeometryInstance.h"
#include "McdGeometryTypes.h"
#include "McdInteractions.h"
#include "McdModel.h"
#include "McdModelPair.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include <float.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* ---- handles ------------------------------------------------------------------------------------------------- */

enum {
    MCD_GEOMETRY = 0x4d47454f,
    MCD_MODEL = 0x4d4d4f44,
    MCD_FRAMEWORK = 0x4d465257,
    MCD_SPACE = 0x4d535043,
    MCD_INSTANCE = 0x4d494e53
};

/* A program's pointer is looked up in the table of live objects before anything is read through it: in check builds by
 * every function, in all builds by those that destroy, so that programs may destroy their objects in any order.
 * Instances are in the table in check builds only: programs do not destroy them. */
#if KARMA_CHECK
#define MCD_IS_KNOWN(p, kind) MeHandleIsLive((p), (kind))
#else
#define MCD_IS_KNOWN(p, kind) METRUE
#endif

/* "function: 0x123 is no model: ..." */
void mcd_warnGone(const void *p, const char *what, const char *function);
/* Have all of these an address? Else a warning: one is null. Say a pointer twice where there are two. */
MeBool mcd_areGiven(const char *function, const void *a, const void *b, const void *c);
/* Whether it is a live object that may be destroyed; else a warning, if any framework lives. */
MeBool mcd_mayDestroy(const void *p, unsigned int kind, const char *what, const char *function);

/* A transform for functions that only read it: before C23, C does not convert the pointer by itself. */
static inline const MeVector4 *mcd_const(MeMatrix4Ptr tm) {
    return (const MeVector4 *)tm;
}

/* ---- instances ----------------------------------------------------------------------------------------------- */

struct _McdGeometryInstance {
    McdGeometryID geometry;
    McdGeometryInstance *parent;     /* null for a model's own */
    McdGeometryInstance *firstChild; /* of an aggregate's instance, in the order of its elements */
    MeMatrix4Ptr tm;                 /* set by the program: where a model is, or where a child's place is written */
    int material;                    /* a child's; -1: the parent's. A model's is in its record */
    int element;                     /* index among the parent's elements */
    MeVector3 min, max;              /* world; as of the last update */

    McdModelID model;
    McdGeometryInstance *nextSibling; /* also links the pool's free ones */
    MeMatrix4 placed;                 /* a child's transform in the world, as of the last update, */
    double placedAxis[3][3];          /* mcd_shapeAxes of it, if isPlaced */
    MeBool isPlaced;                  /* mcd_isPlace of it */
    MeHandle handle;
};

/* From enter to leave an instance is known to MeHandleIsLive; in check builds only. */
static inline void mcd_instanceEnter(McdGeometryInstance *ins) {
#if KARMA_CHECK
    MeHandleEnter(&ins->handle, ins, MCD_INSTANCE);
#else
    (void)ins;
#endif
}

static inline void mcd_instanceLeave(McdGeometryInstance *ins) {
    MeHandleLeave(&ins->handle);
}

/* Where the instance is; null if a model has no transform. */
static inline MeMatrix4Ptr mcd_instanceTM(McdGeometryInstanceID ins) {
    return ins->parent ? ins->placed : ins->tm;
}

/* Numbers that collision takes from programs, and from products of their transforms, are finite and not beyond the
 * range of single precision, in double precision too: so no product of eight of them is beyond the range of double. */
static inline MeBool mcd_areNear(const MeReal *x, int count) {
    MeBool areNear = METRUE;
    for (int i = 0; i < count; i++)
        areNear &= MeFabs(x[i]) <= (MeReal)FLT_MAX; /* false for NaN */
    return areNear;
}

static inline MeBool mcd_isNear3(const double x[3]) {
    return fabs(x[0]) <= (double)FLT_MAX && fabs(x[1]) <= (double)FLT_MAX && fabs(x[2]) <= (double)FLT_MAX;
}

/* A result for programs: numbers beyond the range of MeReal become its largest. */
static inline MeReal mcd_real(double x) {
    return (MeReal)MeCLAMP(x, -(double)MEINFINITY, (double)MEINFINITY);
}

/* Transforms whose axes are not of length 1, or not at right angles, are accepted, though not rigid: only overflow of
 * products is excluded, and axes near one plane, which make shapes flat. False for null. */
MeBool mcd_isPlace(const MeVector4 *tm);

/* Has it a valid transform? */
static inline MeBool mcd_instanceIsPlaced(McdGeometryInstanceID ins) {
    return mcd_isPlace(mcd_const(mcd_instanceTM(ins)));
}

/* False, with a message that names the function, when the pool is empty. */
MeBool mcd_instanceMakeChildren(McdFramework *frame, McdGeometryInstance *ins, const char *function);
void mcd_instanceFreeChildren(McdFramework *frame, McdGeometryInstance *ins);
void mcd_instancePlaceChildren(McdGeometryInstance *ins); /* from its own transform, all the way down */

/* The material that counts: its own or an ancestor's. */
unsigned int mcd_instanceMaterial(const McdGeometryInstance *ins);
/* Is it an instance of a live model? Warns if not. */
MeBool mcd_instanceCheck(const McdGeometryInstance *ins, const char *function);

/* ---- shapes ---------------------------------------------------------------------------------------------------- */

typedef struct McdKind McdKind; /* mcd_kind_i.h */
typedef struct McdHull McdHull; /* mcd_shape_i.h */

/* A convex shape at a place (mcd_shape_i.h). */
typedef struct McdShape {
    const McdKind *kind; /* its type's functions */
    const McdHull *hull;
    double axis[3][3];   /* rows: its own axes */
    double place[3];     /* its own origin */
    double size[3];      /* box: half sizes. cylinder and cone: lower radius, upper radius, length; they lie between
                          z = -low and length - low */
    double low;          /* cylinder and cone: distance of the base below the origin; of a cylinder and a sphyl's core
                          half the height */
    double rounding;     /* all points within it of the core belong to the shape */
    double extent;       /* no point is farther than this from `place`: tolerances are relative to it */
    double corner[3][3]; /* triangle: its corners, in the coordinates of the query */
} McdShape;

/* ---- models -------------------------------------------------------------------------------------------------- */

/* Which models meet, see McdModelSetFilter. */
typedef struct McdFilter {
    MeU32 category, mask;
    int group;
} McdFilter;

/* All inputs of a model's box, margin and tests; compared bit by bit (mcd_tested.c), so without padding. */
enum { MCD_SHAPE_PARAMETERS = 4 };
typedef struct McdModelInputs {
    MeVector3 axis[3], place; /* rows of the transform */
    MeVector3 velocity, spin; /* zero where there is none */
    struct McdShapeInputs {
        const McdGeometry *geometry;
        MeU64 parameters[MCD_SHAPE_PARAMETERS]; /* the geometry's members behind its head, or a hash of
                                                   more than that; of an aggregate a hash of its parts */
        MeReal tolerance;
        MeBool isSwept;
    } shape;
} McdModelInputs;

/* Set in McdModelRecord.shapeStamp: its shape, or a part of it, has triangles that are not among its inputs
 * (McdKind.hashNear). There, as the pair loop reads that line of a model anyway. */
#define MCD_HAS_SURFACE ((MeU64)1 << 63)

/* Where a model was before its transform became what it is, and the block of its space in which it did. */
typedef struct McdPast {
    MeVector3 axis[3], place;
    MeU32 block;
    MeBool isSet;
} McdPast;

/* Grouped by cache lines of 64 bytes, in single precision: the pair loop reads those of pairs, and of pairs that are
 * tested the shape; a space's update reads the hot ones; the others are read by the program's calls. */
typedef struct McdModelRecord {
    /* hot, pairs: 1 */
    _Alignas(ME_CACHE_LINE) McdModel model; /* what programs see: first */
    MeU32 magic;
    MeReal tolerance;
    McdFramework *frame;
    MeU64 stamp, shapeStamp; /* versions of the model's inputs, and of its shape's (MCD_HAS_SURFACE); 0: none yet */
    MeU64 comparedIn;        /* the framework's round of the last comparison with `inputs` */
    /* hot, pairs: 2; isPlaced, radius, reach follow from `inputs` */
    bool isPlaced; /* mcd_isPlace of its transform */
    bool isFast;   /* in the time lookAhead */
    bool isSensor;
    bool isGone;               /* it, or its body, is to be destroyed, or to leave the space, when a stage ends */
    MeReal radius;             /* m, of the bounding sphere; */
    MeReal reach;              /* and of one about the origin */
    MeReal lookAhead;          /* s */
    MeReal travel, turnTravel; /* m, upper bounds of its displacement within lookAhead, and of that by rotation */
    McdSpaceID space;
    void *proxy; /* the space's record of the model */
    McdFilter filter;
    MeI16 sortKey;
    unsigned int material;
    /* hot: 3, 4; pairs: 3, its pose and velocity */
    _Alignas(ME_CACHE_LINE) McdModelInputs inputs; /* at the last comparison */
    /* hot: 5 to 8; follows from `inputs` */
    _Alignas(ME_CACHE_LINE) McdShape shape; /* in the world, without corners; kind 0: it is no convex one */
    /* hot: 10 */
    _Alignas(ME_CACHE_LINE) McdGeometryInstance instance;
    /* hot: 14 */
    _Alignas(ME_CACHE_LINE) McdModelIntersectFnPtr intersect;
    McdModelUpdateFnPtr update;
    MeMatrix4Ptr relTM; /* null unless relative */
    MeReal *linearVelocity, *angularVelocity;
    MeU64 boxStamp;                   /* the stamp that the box belongs to, */
    MeReal boxDuration, boxLookAhead; /* s, duration and look-ahead with which it was made */
    MeU64 lastStamp;                  /* the last stamp that it was given; at first one less than its first */
    MeBool isSwept;
    MeBool isStirred; /* a setter has changed what is not among its inputs (mcd_frozen.c) */
    McdPast past;
    /* cold */
    MeU64 types; /* mcd_instanceTypes, as of `inputs` */
    void *userData;
    int requestId;
    MeMatrix4Ptr refTM; /* null unless relative */
    MeBool ownsRelative;
    bool isBeingUpdated, isCondemned;       /* its update callback runs; it will be destroyed when a stage ends */
    McdModelID standsFor;                   /* of a stand-in: the model; else null */
    unsigned long serial;                   /* counts creations in the framework */
    struct McdModelRecord *next, *previous; /* the framework's live models in the order of creation, or free ones */
    MeHandle handle;
} McdModelRecord;

_Static_assert(offsetof(McdModelRecord, isPlaced) == ME_CACHE_LINE || sizeof(MeReal) > 4, "one line");
_Static_assert(offsetof(McdModelRecord, inputs) == 2 * ME_CACHE_LINE || sizeof(MeReal) > 4, "and one");
_Static_assert(offsetof(McdModelInputs, spin) <= ME_CACHE_LINE || sizeof(MeReal) > 4, "and one with pose and velocity");
_Static_assert(offsetof(McdGeometryInstance, model) <= ME_CACHE_LINE || sizeof(MeReal) > 4, "its boxes are in it");
_Static_assert(sizeof(McdModelInputs) == 40 + 20 * sizeof(MeReal) || sizeof(MeReal) > 4, "no padding");

/* A call has changed a shape: frozen models may not be what they were. */
void mcd_geometryChanged(McdGeometryID g);
/* The same of a model, in what its tests do not depend on. */
void mcd_modelStir(McdModelRecord *m);

static inline McdModelRecord *mcd_record(McdModelID cm) {
    return (McdModelRecord *)cm;
}
/* m, McdModelGetFastMargin. */
static inline MeReal mcd_fastMargin(const McdModelRecord *m) {
    return m->isFast ? m->travel : 0;
}

/* The velocity of a part's origin, or its model's, in the memory given or the model's own; null: it has none. */
MeReal *mcd_partVelocity(const McdGeometryInstance *part, MeVector3 memory);

/* A temporary model for one part of an aggregate: a copy of the aggregate's model with the part's geometry and
 * transform, valid from mcd_standInBegin to mcd_standInEnd. */
typedef struct McdStandIn {
    McdModelRecord record;
    MeVector3 velocity; /* of the part's origin */
} McdStandIn;
/* The part's model itself where the part is no child, else the stand-in. */
McdModelID mcd_standInBegin(McdStandIn *s, McdGeometryInstance *part);
void mcd_standInEnd(McdModelID cm, McdGeometryInstance *part);

/* The record of a live model; null, with a warning that names the function, for anything else. */
McdModelRecord *mcd_modelCheck(McdModelID cm, const char *function);
/* Destroys it, in a stage of its framework, too. */
void mcd_modelDestroy(McdModelRecord *m);
/* Does a come before b: by sort key, then creation? */
MeBool mcd_modelPrecedes(const McdModelRecord *a, const McdModelRecord *b);
/* Renews children and boxes from the present transform, without the program's callback. */
void mcd_modelRefresh(McdModelRecord *m);
/* Is its transform valid and, to the last bit, the one in `inputs`? */
static inline MeBool mcd_isPlacedAsSeen(const McdModelRecord *m) {
    const MeMatrix4Ptr tm = m->instance.tm;
    return m->isPlaced && tm && memcmp(tm[0], m->inputs.axis[0], sizeof(MeVector3)) == 0 &&
           memcmp(tm[1], m->inputs.axis[1], sizeof(MeVector3)) == 0 &&
           memcmp(tm[2], m->inputs.axis[2], sizeof(MeVector3)) == 0 &&
           memcmp(tm[3], m->inputs.place, sizeof(MeVector3)) == 0;
}

/* Has it a valid transform (mcd_isPlace)? */
MeBool mcd_modelIsPlaced(const McdModelRecord *m);
/* Writes the transform of the model after `time`, s, at constant linear and angular velocity. */
void mcd_modelPlaceAt(const McdModelRecord *m, double time, MeMatrix4 tm);

/* ---- frameworks ---------------------------------------------------------------------------------------------- */

typedef struct McdTypeRecord {
    MeBool isRegistered;
    const McdKind *kind; /* null for a program's own */
    const char *name;
    McdGeometryDestroyFnPtr destroy;
    McdGeometryGetAABBFnPtr getAABB;
    McdGeometryGetBSphereFnPtr getBSphere;
    McdGeometryMaximumPointFnPtr maximumPoint;
    McdGeometryGetMassPropertiesFnPtr getMassProperties;
    McdGeometryDebugDrawFnPtr debugDraw;
    McdLineSegIntersectFnPtr lineSegment;
} McdTypeRecord;

typedef struct McdGridCell {
    MeBool isSet;
    atomic_int warned;            /* by queries too, which may be several at once */
    McdInteractions interactions; /* a program may write them */
    McdInteractions library;      /* the library's own for these types, if it has any */
} McdGridCell;

typedef struct McdTermActionLink McdTermActionLink;

/* Pools grow by further blocks of records, so that records never move. This is a block's head, the records follow. */
typedef struct McdPoolBlock {
    _Alignas(ME_CACHE_LINE) struct McdPoolBlock *next;
} McdPoolBlock;

struct _McdFramework {
    MeU32 magic;
    MeHandle handle;
    int typeCount; /* of the tables: built-in and the program's */
    McdTypeRecord *types;
    McdGridCell *grid; /* typeCount x typeCount */
    MeLimit typeLimit, modelLimit, instanceLimit;
    int modelRoom, modelCount, instanceRoom, instanceCount, geometryCount; /* room: records in all blocks of the pool */
    McdPoolBlock *modelBlocks, *instanceBlocks;
    McdModelRecord *firstModel, *lastModel;
    McdModelRecord *firstFree, *lastFree; /* freed ones are reused last, so that stale handles are noticed */
    McdGeometryInstance *freeInstance;
    McdGeometry *firstGeometry, *lastGeometry;
    unsigned long serial;
    MeReal lengthScale, tolerance;
    McdRequest builtInRequest;
    McdRequest *defaultRequest;
    McdTermActionLink *termActions;
    MeStage stage;    /* at which level it is held (mcd_stage.c) */
    MeBool isEmptied; /* nothing is created meanwhile */
    int spaceCount;
    int updateCallbacks;            /* models that have one */
    MeU64 round;                    /* of tests, in which models stay as they are */
    MeU64 changes;                  /* counts calls that change a shape, or what a model's collisions depend on */
    struct McdScratch *freeScratch; /* what queries work in (mcd_scratch_i.h): those that no query has */
    atomic_int scratchIsLocked;
    /* Set when a space is created, so that a program without spaces does not link them: takes a model out of the space
     * that it is in, at once; has the space look at the model's filter, which is another one now. */
    void (*spaceForget)(McdModelID cm);
    void (*spaceFilter)(McdModelID cm);
    void (*spaceForgetPairs)(McdModelID cm); /* McdModelForgetPairs */
    void (*spaceDropBox)(McdModelID cm);     /* McdModelDropBox */
};

MeBool mcd_frameCheck(McdFrameworkID frame, const char *function);
/* How many frameworks live: one more, or one less. */
void mcd_countFrames(int change);
/* Returns its memory, but for scratches. */
void mcd_frameFree(McdFramework *frame);
/* Makes a pool that is empty larger. False, with a message that names the function, if it must not be, or cannot. */
MeBool mcd_frameAddModels(McdFramework *frame, const char *function);
MeBool mcd_frameAddInstances(McdFramework *frame, const char *function);
/* False, with a message: all of it is being destroyed, or a quiet function of the program runs. */
MeBool mcd_mayCreate(const McdFramework *frame, const char *function);
/* Destroys one that nothing uses, in a stage of its framework, too. */
void mcd_geometryDestroy(McdGeometry *g);
/* The record of a live geometry's type, which is registered; null, with a warning, for anything else. */
const McdTypeRecord *mcd_geometryType(McdGeometryID g, const char *function);
/* Memory for a geometry that begins with McdGeometry, its head made; null, with a warning, if the type is not
 * registered or there is no memory. */
void *mcd_geometryCreate(McdFramework *frame, McdGeometryType type, size_t size, const char *function);
/* Is g a live geometry of that type? Warns with the function's name if not. */
MeBool mcd_geometryIs(McdGeometryID g, McdGeometryType type, const char *function);
/* Does it belong to that framework? Warns if not. */
MeBool mcd_geometryBelongs(McdGeometryID g, const McdFramework *frame, const char *function);
/* Mcd...Destroy of a type: McdGeometryDestroy of a live geometry of it, nothing for what has gone. */
void mcd_geometryDestroyAs(McdGeometryID g, McdGeometryType type, const char *function);
/* The destructor that a type without memory of its own registers: the head has been released before. */
void MEAPI mcd_geometryFree(McdGeometryID g);

/* ---- stages (mcd_stage.c) ------------------------------------------------------------------------------------- */

/* What must stay as it is while a stage calls the program. Each level includes those before it. */
enum {
    MCD_HOLD_FRAME,  /* the framework and its spaces */
    MCD_HOLD_MODELS, /* models and their pairs, geometries, change blocks */
    MCD_HOLD_SHAPES  /* transforms' pointers, what models are made of, boxes in the tree */
};
/* MeStageWhen, for what has to wait as long as models are held; it is in the framework's list then. */
MeWhen mcd_when(McdFramework *frame, const MeLater *later, const char *function);
/* The model that was meant; null: it has gone. */
McdModelRecord *mcd_laterModel(const MeLater *later);
/* False, with a message: shapes are held. */
MeBool mcd_mayPlace(const McdFramework *frame, const char *function);

/* Around a call of a function of a geometry type, which may be the program's. */
typedef struct McdTypeCall {
    McdFramework *frame; /* null: it is the library's */
    MeProgramCall before;
} McdTypeCall;
McdTypeCall mcd_typeEnterOwn(McdFramework *frame);
void mcd_typeLeaveOwn(const McdTypeCall *call);
static inline McdTypeCall mcd_typeEnter(McdFramework *frame, const McdTypeRecord *type) {
    return type->kind ? (McdTypeCall){.frame = 0} : mcd_typeEnterOwn(frame);
}
static inline void mcd_typeLeave(const McdTypeCall *call) {
    if (call->frame)
        mcd_typeLeaveOwn(call);
}

/* McdModelUpdate, McdModelUpdatePath, McdIntersect, McdLineSegIntersect by a function that holds the models, or of
 * models that involve no function of the program: several threads may call them then. False of an update, without a
 * message: the model is nowhere. */
MeBool mcd_modelUpdate(McdModelRecord *m);
MeBool mcd_modelUpdatePath(McdModelRecord *m, MeReal duration);
MeBool mcd_intersect(McdModelPair *p, McdIntersectResult *result);
MeBool mcd_lineSegIntersect(McdModelID cm, MeReal *inOrig, MeReal *inDest, McdLineSegIntersectResult *outOverlap);
void mcd_instanceUpdateAABB(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, MeBool tight);

/* ---- contacts ------------------------------------------------------------------------------------------------- */

/* How interactions fill a result: begin, add, end. */
typedef struct McdManifold McdManifold; /* mcd_shape_i.h */
MeBool mcd_resultHasRoom(const McdIntersectResult *result, const char *function); /* warns if not */
void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p);
/* Adds a manifold whose points are relative to origin, and returns its first contact, null for none. If there is place
 * for some of them only, those that mcd_spread chooses. */
McdContact *mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3],
                          McdGeometryInstanceID ins1, McdGeometryInstanceID ins2);
/* The dimension of a region that so many points of one manifold span: 0 .. 2. */
static inline int mcd_regionDims(int pointCount) {
    return MeMIN(pointCount, 3) - 1;
}
/* A hash of a feature's number and of what it is a part of. */
MeU32 mcd_featureMix(MeU32 feature, MeU32 part);
/* McdContact.feature of two shapes' features: of shapes with at most 256 faces as it is, of others a hash. */
MeU32 mcd_featureNumber(MeU64 feature);
int mcd_resultEnd(McdIntersectResult *result); /* the mean normal; 1 if there are contacts */
/* May these be a pair: two models of one framework? Warns if not. */
MeBool mcd_modelsMakeAPair(McdModelID m1, McdModelID m2, const char *function);
/* m: a model's share of the speculative margin: its tolerance, and how far it may move before the next test. */
static inline MeReal mcd_modelReach(const McdModelRecord *m) {
    return m->tolerance + m->travel;
}
/* Mixes bytes into a hash of 128 bits: eight of them, or fewer at the end, always change it; all together may leave it
 * as it was by chance only. */
void mcd_hashAdd(MeU64 hash[2], const void *data, size_t bytes);
/* A version that changes with every input of the model's box and tests; 0: its inputs cannot be compared. */
MeU64 mcd_modelStamp(McdModelRecord *m);
/* The same, unless it has a stamp of this round. */
MeU64 mcd_modelStampInRound(McdModelRecord *m);
/* A stamp that no model has had. */
MeU64 mcd_modelNewStamp(McdModelRecord *m);
/* Sets the library's own functions for two types. False, with a warning, for a type that is none. */
MeBool mcd_interactionRegister(McdFramework *frame, int type1, int type2, const McdInteractions *library);
/* Do two types, or the pair's models, interact as the library has it, not by a function of the program's? */
MeBool mcd_typesAreBuiltIn(McdFramework *frame, int type1, int type2);
MeBool mcd_interactionIsBuiltIn(const McdModelPair *p);
/* The types of an instance and its parts, as bits. False: a part has a material of its own, or is a surface that a
 * function of the program makes; or a type is the program's, or has no bit. */
MeBool mcd_instanceTypes(const McdGeometryInstance *ins, MeU64 *types);
/* Does each of these types interact with each of those as the library has it? */
MeBool mcd_typesInteractAsBuiltIn(McdFramework *frame, MeU64 types1, MeU64 types2);
/* m: the gap up to which a pair gets contacts (speculative margin): its tolerances, and the distance by which the two
 * may approach before the next test. */
double mcd_pairMargin(const McdModelPair *p);
double mcd_pairMarginInRound(const McdModelPair *p); /* of models that have a stamp of this round */
/* The same of two parts, whose origins move with the models that turn. */
double mcd_partsMargin(const McdModelPair *p, const McdGeometryInstance *part1, const McdGeometryInstance *part2);
/* m: by how much model1 moves against model2 until the next test, with the velocities that they have; 0 of fast models,
 * whose contacts are those of now. */
void mcd_pairWay(const McdModelPair *p, double way[3]);

#endif
