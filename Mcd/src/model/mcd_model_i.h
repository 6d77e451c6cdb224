/* Inside Mcd: the records of models.
 *
 * Ownership: a framework owns its type table, a pool of models, a pool of child instances of aggregates, and the
 * list of geometries. A model's own instance is part of the model; child instances come from the pool. The interface
 * is in MeReal; everything between a transform and a contact is double (mcd_shape_i.h).
 */
#ifndef MCD_MODEL_I_H
#define MCD_MODEL_I_H

#include "model/mcd_instance_i.h"

/* ---- models -------------------------------------------------------------------------------------------------- */

/* Which models collide, see McdModelSetFilter. */
typedef struct McdFilter {
    MeU32 category, mask;
    int group;
} McdFilter;
/* Whether two filters leave a pair out, by the rule of McdModelSetFilter. */
static inline MeBool mcd_areFiltered(const McdFilter *a, const McdFilter *b) {
    if (a->group != 0 && a->group == b->group)
        return a->group < 0;
    return !(a->category & b->mask) || !(b->category & a->mask);
}

/* All inputs of a model's box, margin and tests. Compared bit by bit (mcd_tested.c), so without padding. */
enum { MCD_SHAPE_PARAMETERS = 4 };
typedef struct McdModelInputs {
    MeVector3 axis[3], place; /* rows of the transform */
    MeVector3 velocity, spin; /* linear and angular; zero if the model has none */
    struct McdShapeInputs {
        const McdGeometry *geometry;
        MeU64 parameters[MCD_SHAPE_PARAMETERS]; /* members after the head, or their hash; aggregate: its parts' hash */
        MeReal tolerance;
        MeBool isSwept;
    } shape;
} McdModelInputs;

/* Flag in McdModelRecord.shapeStamp: the shape or a part of it is a surface of triangles, which are not among its
 * inputs. It is a bit of the stamp because the pair loop reads that cache line anyway. */
#define MCD_HAS_SURFACE ((MeU64)1 << 63)

/* Whether a model's impacts are predicted, by its motion in lookAhead; flags. */
typedef enum McdSweep {
    MCD_SWEPT = 1, /* the program has said so */
    MCD_FAST = 2,  /* it is swept, and moves by more than its thickness: in all of its pairs */
    MCD_QUICK = 4, /* it is not swept, and moves by more than its radius: in pairs with swept models */
} McdSweep;

/* The pose of a model before its last change, and the change block of its space in which that was seen. */
typedef struct McdPast {
    MeVector3 axis[3], place;
    MeU32 block;
    MeBool isSet;
} McdPast;

/* Grouped by cache lines of 64 bytes, in single precision: the pair loop reads the lines marked "pairs", and the
 * shape of pairs that are tested; a space's update reads the lines marked "hot"; calls of the program read the
 * others. */
typedef struct McdModelRecord {
    /* hot, pairs: line 1 */
    _Alignas(ME_CACHE_LINE) McdModel model; /* the public part: first */
    MeU32 magic;
    MeReal tolerance;
    McdFramework *frame;
    MeU64 stamp, shapeStamp; /* versions of `inputs`, and of inputs.shape with the flag MCD_HAS_SURFACE; 0: none */
    MeU64 comparedIn;        /* the round (McdFramework.round) of the last comparison with `inputs` */
    /* hot, pairs: line 2; isPlaced, radius, reach are derived from `inputs` */
    bool isPlaced; /* mcd_isValidTransform of its transform */
    MeU8 sweep;    /* McdSweep */
    bool isSensor;
    bool isGone;               /* it or its body will be destroyed, or removed from the space, when a stage ends */
    MeReal radius;             /* m, of the bounding sphere */
    MeReal reach;              /* m, of a bounding sphere about the origin */
    MeReal lookAhead;          /* s */
    MeReal travel, turnTravel; /* m, upper bounds of its displacement in lookAhead, and of the part due to rotation */
    McdSpaceID space;
    void *proxy; /* the space's record of the model (McdProxy) */
    McdFilter filter;
    MeI16 sortKey;
    unsigned int material;
    /* hot: lines 3 and 4; pairs: line 3, pose and velocity */
    _Alignas(ME_CACHE_LINE) McdModelInputs inputs; /* as of the last comparison */
    /* hot: lines 5 to 8; derived from `inputs` */
    _Alignas(ME_CACHE_LINE) McdShape shape; /* in the world, without corners; kind null: not convex */
    /* hot: line 10 */
    _Alignas(ME_CACHE_LINE) McdGeometryInstance instance;
    /* hot: line 14 */
    _Alignas(ME_CACHE_LINE) McdModelIntersectFnPtr intersect;
    McdModelUpdateFnPtr update;
    MeMatrix4Ptr relTM; /* null unless relative */
    MeMatrix4Ptr given; /* the program's transform, if a mover's is in its place (McdModelPlaceBy); else null */
    MeReal *linearVelocity, *angularVelocity;
    MeU64 boxStamp;                   /* the stamp for which the box was made */
    MeReal boxDuration, boxLookAhead; /* s, motion duration and look-ahead for which the box was made */
    MeU64 lastStamp;                  /* the model's last stamp; initially one less than its first */
    MeReal fastMargin;                /* m, of a fast or quick model; else 0 */
    MeBool isMarkedChanged;           /* a setter has changed something that is not in `inputs` (mcd_frozen.c) */
    McdPast past;
    /* cold */
    MeU64 types; /* mcd_instanceTypes, for `inputs` */
    void *userData;
    int requestId;
    MeU32 sensorMask;   /* kinds of models that a sensor finds (MstSensorSetMask) */
    MeMatrix4Ptr refTM; /* null unless relative */
    MeBool ownsRelative;
    MeMatrix4Ptr own;                 /* null, or a transform that is freed with the model (McdModelPlaceAtCopy) */
    bool isBeingUpdated, isCondemned; /* its update callback runs; it will be destroyed when a stage ends */
    McdModelID standsFor;             /* of a stand-in: the aggregate's model; else null */
    unsigned long serial;             /* its number in the order of creation in the framework */
    struct McdModelRecord *next, *previous; /* in the list of live models, by creation, or the free list */
    MeHandle handle;
} McdModelRecord;

_Static_assert(offsetof(McdModelRecord, isPlaced) == ME_CACHE_LINE || sizeof(MeReal) > 4, "line 1 is full");
_Static_assert(offsetof(McdModelRecord, inputs) == 2 * ME_CACHE_LINE || sizeof(MeReal) > 4, "line 2 is full");
_Static_assert(offsetof(McdModelInputs, spin) <= ME_CACHE_LINE || sizeof(MeReal) > 4,
               "line 3 has the pose and velocity");
_Static_assert(offsetof(McdGeometryInstance, model) <= ME_CACHE_LINE || sizeof(MeReal) > 4, "line 10 has the box");
_Static_assert(sizeof(McdModelInputs) == 40 + 20 * sizeof(MeReal) || sizeof(MeReal) > 4, "no padding");

/* Counts a change of a shape: frozen models are compared again. */
void mcd_geometryChanged(McdGeometryID g);
/* Marks a model as changed in something that is not in its `inputs` (mcd_frozen.c). */
void mcd_modelMarkChanged(McdModelRecord *m);

static inline McdModelRecord *mcd_record(McdModelID cm) {
    return (McdModelRecord *)cm;
}
static inline MeBool mcd_isSwept(const McdModelRecord *m) {
    return (m->sweep & MCD_SWEPT) != 0;
}
/* Whether impacts of two models are predicted: one is fast, or one is swept and the other one quick. */
static inline MeBool mcd_areFast(const McdModelRecord *a, const McdModelRecord *b) {
    const int both = a->sweep | b->sweep;
    return (both & MCD_FAST) || (both & (MCD_SWEPT | MCD_QUICK)) == (MCD_SWEPT | MCD_QUICK);
}

/* The velocity of the origin of an aggregate's part, computed into `memory`; the model's own velocity if the child
 * is not a part or the model has no angular velocity; null: it has none. */
MeReal *mcd_childVelocity(const McdGeometryInstance *child, MeVector3 memory);

/* A temporary model (stand-in) for one part of an aggregate: a copy of the aggregate's model with the part's
 * geometry and transform, valid from mcd_standInBegin to mcd_standInEnd. */
typedef struct McdStandIn {
    McdModelRecord record;
    MeVector3 velocity; /* of the part's origin */
} McdStandIn;
/* Returns the stand-in; if the instance is a model's own, that model. */
McdModelID mcd_standInBegin(McdStandIn *s, McdGeometryInstance *child);
void mcd_standInEnd(McdModelID cm, McdGeometryInstance *child);

/* The record of a live model; null, with a warning that names the function, for anything else. */
McdModelRecord *mcd_modelCheck(McdModelID cm, const char *function);
/* Destroys a model immediately, even during a stage of its framework. */
void mcd_modelDestroy(McdModelRecord *m);
/* Whether a precedes b: by sort key, then by creation. */
MeBool mcd_modelPrecedes(const McdModelRecord *a, const McdModelRecord *b);
/* Updates children and boxes from the current transform, without the update callback. */
void mcd_modelRefresh(McdModelRecord *m);
/* Places the children by the current transform, unless they are: for queries, since a step moves models after their
 * update. Their boxes stay. Several threads may call it at once, while none changes the model. */
void mcd_modelPlaceChildren(McdModelRecord *m);
/* Whether the transform is valid and equal, to the last bit, to the one in `inputs`. */
static inline MeBool mcd_isPlacedAsCompared(const McdModelRecord *m) {
    const MeMatrix4Ptr tm = m->instance.tm;
    return m->isPlaced && tm && memcmp(tm[0], m->inputs.axis[0], sizeof(MeVector3)) == 0 &&
           memcmp(tm[1], m->inputs.axis[1], sizeof(MeVector3)) == 0 &&
           memcmp(tm[2], m->inputs.axis[2], sizeof(MeVector3)) == 0 &&
           memcmp(tm[3], m->inputs.place, sizeof(MeVector3)) == 0;
}

/* Whether the model has a valid transform (mcd_isValidTransform). */
MeBool mcd_modelIsPlaced(const McdModelRecord *m);
/* Computes the model's transform after `time`, s, at constant linear and angular velocity. */
void mcd_modelPlaceAt(const McdModelRecord *m, double time, MeMatrix4 tm);

/* McdModelUpdate and McdModelUpdatePath without a stage of their own: for callers that guard the models, or for
 * models that call no function of the program; these may be updated by several threads. False, without a message, if
 * the model has no valid transform. */
MeBool mcd_modelUpdate(McdModelRecord *m);
MeBool mcd_modelUpdatePath(McdModelRecord *m, MeReal duration);
/* Call the function of the instance's type; false if there is none, or the instance has no transform. */
MeBool mcd_instanceUpdateAABB(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, MeBool tight);
MeBool mcd_instanceMaximumPoint(McdGeometryInstance *ins, MeReal *const direction, MeReal *const point);

#endif
