/* Inside Mcd: the records of frameworks and types, geometries, and what waits for the end of a stage. */
#ifndef MCD_FRAME_I_H
#define MCD_FRAME_I_H

#include "convex/mcd_kind_i.h"
#include "model/mcd_model_i.h"

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

/* ---- types ---- */

/* The table of a geometry's type; null for a program's own types. */
static inline const McdKind *mcd_kindOf(const McdGeometry *g) {
    return g->frame->types[g->type].kind;
}

static inline MeBool mcd_isHalfSpace(const McdGeometryInstance *ins) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    return kind && kind->isHalfSpace;
}

/* Registers the type with a framework. */
void mcd_kindRegister(McdFramework *frame, const McdKind *kind, const char *function);
/* Sets the library's own functions for two types. False, with a warning, for a type that is none. */
MeBool mcd_interactionRegister(McdFramework *frame, int type1, int type2, const McdInteractions *library);

/* ---- stages (mcd_stage.c) ------------------------------------------------------------------------------------- */

/* What must stay as it is while a stage calls the program. Each level includes those before it. */
enum {
    MCD_GUARD_FRAME,  /* the framework and its spaces */
    MCD_GUARD_MODELS, /* models and their pairs, geometries, change blocks */
    MCD_GUARD_SHAPES  /* transforms' pointers, what models are made of, boxes in the tree */
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

#endif
