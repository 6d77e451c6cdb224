/* Inside Mcd: handles, and the records of instances. */
#ifndef MCD_INSTANCE_I_H
#define MCD_INSTANCE_I_H

#include "McdFrame.h"
#include "McdGeometry.h"
#include "McdGeometryInstance.h"
#include "McdInteractions.h"
#include "McdModel.h"
#include "McdModelPair.h"
#include "convex/mcd_shape_i.h"
#include <stdatomic.h>
#include <stdbool.h>
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

#endif
