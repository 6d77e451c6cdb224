/* Inside Mcd: what frameworks, models and instances are made of, and what the files of this library share.
 *
 * Ownership: a framework owns its type table, a pool of models and a pool of aggregates' child instances, and the list
 * of geometries. A model's own instance is a part of the model; its children come from the pool.
 * Programs see MeReal; everything between a transform and a contact is double (mcd_shape.h).
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
#include "MeMemory.h"
#include "MeMessage.h"

enum { MCD_GEOMETRY = 0x4d47454f, MCD_MODEL = 0x4d4d4f44, MCD_FRAMEWORK = 0x4d465257, MCD_SPACE = 0x4d535043 };

/* A transform for functions that only read it: before C23, C does not convert the pointer by itself. */
static inline const MeVector4 *mcd_const(MeMatrix4Ptr tm) {
    return (const MeVector4 *)tm;
}

/* ---- instances ----------------------------------------------------------------------------------------------- */

struct _McdGeometryInstance {
    McdGeometryID geometry;
    McdModelID model;
    McdGeometryInstance *parent;      /* null for a model's own */
    McdGeometryInstance *firstChild;  /* of an aggregate's instance, in the order of its elements */
    McdGeometryInstance *nextSibling; /* also links the pool's free ones */
    int element;                      /* which one of the parent's it is */
    int material;                     /* -1: the parent's */
    MeMatrix4Ptr tm;                  /* set by the program: where a model is, or where a child's place is written */
    MeMatrix4 placed;                 /* a child's transform in the world, as of the last update */
    MeVector3 min, max;               /* world; as of the last update */
};

/* Where the instance is; null if a model has no transform. */
static inline MeMatrix4Ptr mcd_instanceTM(McdGeometryInstanceID ins) {
    return ins->parent ? ins->placed : ins->tm;
}

MeBool mcd_instanceMakeChildren(McdFramework *frame, McdGeometryInstance *ins); /* false when the pool is empty */
void mcd_instanceFreeChildren(McdFramework *frame, McdGeometryInstance *ins);
void mcd_instancePlaceChildren(McdGeometryInstance *ins); /* from its own transform, all the way down */

/* The material that counts: its own or an ancestor's. */
unsigned int mcd_instanceMaterial(const McdGeometryInstance *ins);
/* Is it an instance of a live model? Warns if not. */
MeBool mcd_instanceCheck(const McdGeometryInstance *ins, const char *function);

/* ---- models -------------------------------------------------------------------------------------------------- */

/* Which models meet, see McdModelSetFilter. */
typedef struct McdFilter {
    MeU32 category, mask;
    int group;
} McdFilter;

typedef struct McdModelRecord {
    McdModel model; /* what programs see: first */
    MeU32 magic;
    McdFramework *frame;
    struct McdModelRecord *next, *previous; /* the framework's live models in the order of creation, or free ones */
    unsigned long serial;                   /* counts creations in the framework */
    McdGeometryInstance instance;
    MeMatrix4Ptr relTM, refTM; /* null unless relative */
    MeBool ownsRelative;
    MeReal *linearVelocity, *angularVelocity;
    MeReal tolerance;
    MeReal lookAhead, ahead, turnAhead; /* s; m, how far it may get in that time, and by turning alone */
    MeBool isSwept, isSensor;
    MeBool isFast; /* in the time that the space looks ahead */
    McdFilter filter;
    MeI16 sortKey;
    int requestId;
    McdModelUpdateFnPtr update;
    McdModelIntersectFnPtr intersect;
    void *userData;
    McdSpaceID space;
    void *proxy; /* the space's record of the model */
} McdModelRecord;

static inline McdModelRecord *mcd_record(McdModelID cm) {
    return (McdModelRecord *)cm;
}

/* The record of a live model; null, with a warning that names the function, for anything else. */
McdModelRecord *mcd_modelCheck(McdModelID cm, const char *function);
/* Does a come before b: by sort key, then creation? */
MeBool mcd_modelPrecedes(const McdModelRecord *a, const McdModelRecord *b);
/* Renews children and boxes from the present transform, without the program's callback. */
void mcd_modelRefresh(McdModelRecord *m);
/* Has it a transform of finite numbers? */
MeBool mcd_modelIsPlaced(const McdModelRecord *m);
/* Writes where the model will be after time: its transform moved by its velocities (exact screw-free rotation). */
void mcd_modelPlaceAt(const McdModelRecord *m, double time, MeMatrix4 tm);
/* Takes a model out of whatever space it is in, at once; McdFrameworkDestroyAllModelsAndGeometries needs it. The space
 * sets this hook when one is created, so that a program without spaces does not link them. */
extern void (*mcd_spaceForget)(McdModelID cm);
/* The same for a model in a space whose filter is another one now. */
extern void (*mcd_spaceFilter)(McdModelID cm);

/* ---- frameworks ---------------------------------------------------------------------------------------------- */

typedef struct McdTypeRecord {
    MeBool isRegistered;
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
    int warned;
    McdInteractions interactions;
} McdGridCell;

typedef struct McdTermActionLink McdTermActionLink;

struct _McdFramework {
    MeU32 magic;
    int typeCount; /* of the tables: built-in and the program's */
    McdTypeRecord *types;
    McdGridCell *grid; /* typeCount x typeCount */
    int modelMax, modelCount, instanceMax, instanceCount, geometryCount;
    McdModelRecord *models; /* the pool */
    McdModelRecord *firstModel, *lastModel;
    McdModelRecord *firstFree, *lastFree; /* freed ones are reused last, so that stale handles are noticed */
    McdGeometryInstance *instances, *freeInstance;
    McdGeometry *firstGeometry, *lastGeometry;
    unsigned long serial;
    MeReal lengthScale, tolerance;
    McdRequest builtInRequest;
    McdRequest *defaultRequest;
    McdTermActionLink *termActions;
    int spaceCount;
};

MeBool mcd_frameCheck(McdFrameworkID frame, const char *function);
/* The record of a live geometry's type, which is registered; null, with a warning, for anything else. */
const McdTypeRecord *mcd_geometryType(McdGeometryID g, const char *function);
/* Memory for a geometry that begins with McdGeometry, its head made; null, with a warning, if the type is not registered
 * or there is no memory. */
void *mcd_geometryCreate(McdFramework *frame, McdGeometryType type, size_t size, const char *function);
/* Is g a live geometry of that type? Warns with the function's name if not. */
MeBool mcd_geometryIs(McdGeometryID g, McdGeometryType type, const char *function);

/* ---- contacts ------------------------------------------------------------------------------------------------- */

/* How interactions fill a result: begin, add, end. */
typedef struct McdManifold McdManifold; /* mcd_shape.h */
void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p);
/* Adds a manifold whose points are relative to origin. If there is place for some of
 * them only, those that mcd_spread chooses. */
void mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3], McdGeometryInstanceID ins1,
                   McdGeometryInstanceID ins2, int element1, int element2);
/* A feature's number within a part of an aggregate. */
MeU32 mcd_featureMix(MeU32 feature, MeU32 part);
int mcd_resultEnd(McdIntersectResult *result); /* the mean normal; 1 if there are contacts */
/* How far a model may touch: its tolerance, and the way that it may get before it is asked again. */
static inline MeReal mcd_modelReach(const McdModelRecord *m) {
    return m->tolerance + m->ahead;
}
/* The gap up to which a pair of models makes contacts: its tolerances, and the way that the two may get nearer. */
double mcd_pairMargin(const McdModelPair *p);

#endif
