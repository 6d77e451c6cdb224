/* Inside Mcd: the records of frameworks and types, functions of geometries, and stages. */
#ifndef MCD_FRAME_I_H
#define MCD_FRAME_I_H

#include "McdInternal.h"
#include "convex/mcd_kind_i.h"
#include "model/mcd_model_i.h"

/* ---- frameworks ---------------------------------------------------------------------------------------------- */

typedef struct McdTypeRecord {
    MeBool isRegistered;
    const McdKind *kind; /* null for a program's own type */
    void *ownKind;       /* the kind of a program's convex type, which the framework frees; else null */
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
    atomic_int warned;            /* also by queries, several of which may run at once */
    McdInteractions interactions; /* a program may write here, by McdFrameworkGetInteractions */
    McdInteractions library;      /* the library's functions for these types, if there are any */
} McdGridCell;

typedef struct McdTermActionLink McdTermActionLink;

/* Pools grow by adding blocks, so that records never move. A block starts with this header; its records follow. */
typedef struct McdPoolBlock {
    _Alignas(ME_CACHE_LINE) struct McdPoolBlock *next;
} McdPoolBlock;

enum { MCD_NO_NEIGHBOUR = -1 };

struct _McdFramework {
    MeU32 magic;
    MeHandle handle;
    int typeCount; /* size of the tables: built-in types and the program's */
    McdTypeRecord *types;
    McdGridCell *grid; /* typeCount x typeCount */
    MeLimit typeLimit, modelLimit, instanceLimit;
    int modelRoom, modelCount, instanceRoom, instanceCount, geometryCount; /* room: records in all blocks of the pool */
    McdPoolBlock *modelBlocks, *instanceBlocks;
    McdModelRecord *firstModel, *lastModel;
    McdModelRecord *firstFree, *lastFree; /* freed records are reused last, so that stale handles are noticed */
    McdGeometryInstance *freeInstance;
    McdGeometry *firstGeometry, *lastGeometry;
    unsigned long serial;
    MeReal lengthScale, tolerance;
    McdRequest builtInRequest;
    McdRequest *defaultRequest;
    McdTermActionLink *termActions;
    MeStage stage;    /* which objects are guarded at present (mcd_stage.c) */
    MeBool isEmptied; /* everything is being destroyed: nothing may be created */
    int spaceCount;
    MeBool hasProgramSurfaces;      /* a geometry was created whose triangles come from a function of the program */
    int updateCallbacks;            /* number of models that have one */
    int sweptCount;                 /* number of swept models */
    double fall[3];                 /* m: McdFrameworkSetFall */
    MeU64 round;                    /* counts rounds of pair tests; models do not change within a round */
    MeU64 changes;                  /* counts calls that change a shape or other inputs of collisions */
    struct McdScratch *freeScratch; /* unused scratches of queries (mcd_scratch_i.h) */
    atomic_int scratchIsLocked, placingIsLocked; /* spin locks: of freeScratch, and of mcd_modelPlaceChildren */
    /* Functions of spaces, set when the first space is created, so that programs without spaces do not link them.
     * spaceRemoveDestroyed: removes a model at once. spaceApplyFilter: for a model whose filter has changed. */
    void (*spaceRemoveDestroyed)(McdModelID cm);
    void (*spaceApplyFilter)(McdModelID cm);
    void (*spaceForgetPairs)(McdModelID cm); /* McdModelForgetPairs */
    void (*spaceDropBox)(McdModelID cm);     /* McdModelDropBox */
    /* Iterates over the models that a model has pairs with; *at: MCD_NO_NEIGHBOUR before the first call. Null: the
     * end. */
    McdModelRecord *(*spaceNextNeighbour)(const McdModelRecord *m, int *at);
};

MeBool mcd_frameCheck(McdFrameworkID frame, const char *function);
/* Adds `change` to the number of live frameworks. */
void mcd_countFrames(int change);
/* Frees the framework's memory, except scratches. */
void mcd_frameFree(McdFramework *frame);
/* Enlarge a pool that is exhausted. False, with a message that names the function, if the limit or memory is
 * exhausted. */
MeBool mcd_frameAddModels(McdFramework *frame, const char *function);
MeBool mcd_frameAddInstances(McdFramework *frame, const char *function);
/* Whether objects may be created. False, with a message, while the framework destroys everything, or while a
 * callback runs that may not make changes. */
MeBool mcd_mayCreate(const McdFramework *frame, const char *function);
/* Destroys a geometry without references, immediately, even during a stage of its framework. */
void mcd_geometryDestroy(McdGeometry *g);
/* The type record of a live geometry; null, with a warning, for anything else. */
const McdTypeRecord *mcd_geometryType(McdGeometryID g, const char *function);
/* Allocates a geometry whose record begins with McdGeometry, and initializes that head; null, with a warning, if the
 * type is not registered, and if there is no memory. */
void *mcd_geometryCreate(McdFramework *frame, McdGeometryType type, size_t size, const char *function);
/* Whether g is a live geometry of that type; if not, warns with the function's name. */
MeBool mcd_geometryIs(McdGeometryID g, McdGeometryType type, const char *function);
/* Whether the geometry belongs to the framework; warns if not. */
MeBool mcd_geometryBelongs(McdGeometryID g, const McdFramework *frame, const char *function);
/* Marks all models of the geometry, or of aggregates with it, as changed. */
void mcd_geometryMarkModels(McdGeometry *g);
/* Implements Mcd...Destroy of a type: McdGeometryDestroy for a live geometry of that type; ignores a geometry that
 * has been destroyed (mcd_mayDestroy). */
void mcd_geometryDestroyAs(McdGeometryID g, McdGeometryType type, const char *function);
/* Destructor of geometry types that own no other memory: frees the geometry, whose head has already been released. */
void MEAPI mcd_geometryFree(McdGeometryID g);

/* ---- types ---- */

/* The kind (function table) of a geometry's type; null for a program's own type. */
static inline const McdKind *mcd_kindOf(const McdGeometry *g) {
    return g->frame->types[g->type].kind;
}

static inline MeBool mcd_isHalfSpace(const McdGeometryInstance *ins) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    return kind && kind->isHalfSpace;
}

static inline MeBool mcd_isConvex(const McdGeometryInstance *ins) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    return kind && kind->setShape;
}

/* Whether it is a surface of triangles. */
static inline MeBool mcd_isSurface(const McdGeometryInstance *ins) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    return kind && kind->gather;
}

/* Whether its elements have materials of their own. */
static inline MeBool mcd_hasMaterials(const McdGeometry *g) {
    const McdKind *kind = mcd_kindOf(g);
    return kind && kind->material && kind->material(g, 0) >= 0;
}

/* Registers a built-in type with a framework. */
void mcd_kindRegister(McdFramework *frame, const McdKind *kind, const char *function);
/* Adds a type with the next number, which it writes to the kind. The framework owns the kind, a block of MeMemoryTake,
 * and returns it; null, after a message: it is freed. */
void *mcd_frameAddType(McdFramework *frame, McdKind *kind, const char *name, const char *function);
/* Registers the library's functions for two types. False, with a warning, if one is not a type. */
MeBool mcd_interactionRegister(McdFramework *frame, int type1, int type2, const McdInteractions *library);

/* ---- stages (mcd_stage.c; levels: McdInternal.h) ----------------------------------------------------------------- */

/* When a call takes effect (MeStageWhen): if models are guarded, the call is added to the framework's deferred
 * calls. */
MeWhen mcd_deferWhileGuarded(McdFramework *frame, const MeLater *later, const char *function);
/* The model that a deferred call is for; null: it has been destroyed. */
McdModelRecord *mcd_deferredModel(const MeLater *later);
/* Whether shapes may change; false, with a message, while they are guarded. */
MeBool mcd_mayChangeShapes(const McdFramework *frame, const char *function);

/* Bracket a call of a geometry type's function, which may be the program's. */
typedef struct McdTypeCall {
    McdFramework *frame; /* null: the function is the library's */
    MeProgramCall before;
} McdTypeCall;
McdTypeCall mcd_typeEnterProgram(McdFramework *frame);
void mcd_typeLeaveProgram(const McdTypeCall *call);
static inline McdTypeCall mcd_typeEnter(McdFramework *frame, const McdTypeRecord *type) {
    return type->kind ? (McdTypeCall){.frame = 0} : mcd_typeEnterProgram(frame);
}
static inline void mcd_typeLeave(const McdTypeCall *call) {
    if (call->frame)
        mcd_typeLeaveProgram(call);
}

#endif
