/* Inside Mcd: the records of models.
 *
 * Ownership: a framework owns its type table, a pool of models and a pool of aggregates' child instances, and the list
 * of geometries. A model's own instance is a part of the model; its children come from the pool.
 * Programs see MeReal; everything between a transform and a contact is double (mcd_shape_i.h).
 */
#ifndef MCD_MODEL_I_H
#define MCD_MODEL_I_H

#include "model/mcd_instance_i.h"

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

/* Set in McdModelRecord.shapeStamp: its shape, or a part of it, is a surface of triangles, which are not among its
 * inputs. There, as the pair loop reads that line of a model anyway. */
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
MeReal *mcd_childVelocity(const McdGeometryInstance *child, MeVector3 memory);

/* A temporary model for one part of an aggregate: a copy of the aggregate's model with the part's geometry and
 * transform, valid from mcd_standInBegin to mcd_standInEnd. */
typedef struct McdStandIn {
    McdModelRecord record;
    MeVector3 velocity; /* of the part's origin */
} McdStandIn;
/* The part's model itself where the part is no child, else the stand-in. */
McdModelID mcd_standInBegin(McdStandIn *s, McdGeometryInstance *child);
void mcd_standInEnd(McdModelID cm, McdGeometryInstance *child);

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

/* McdModelUpdate, McdModelUpdatePath by a function that holds the models, or of models that involve no function of the
 * program: several threads may call them then. False, without a message: the model is nowhere. */
MeBool mcd_modelUpdate(McdModelRecord *m);
MeBool mcd_modelUpdatePath(McdModelRecord *m, MeReal duration);
void mcd_instanceUpdateAABB(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, MeBool tight);

#endif
