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

/* Pointers that programs pass are looked up in the table of live objects before they are dereferenced: by every
 * function in check builds, and in all builds by the functions that destroy, so that programs may destroy objects in
 * any order. Instances, which programs do not destroy, are in the table in check builds only. */
#if KARMA_CHECK
#define MCD_IS_KNOWN(p, kind) MeHandleIsLive((p), (kind))
#else
#define MCD_IS_KNOWN(p, kind) METRUE
#endif

/* Warns that p is not a live object: "function: 0x123 is no model: ..." */
void mcd_warnGone(const void *p, const char *what, const char *function);
/* Whether none of three pointers is null; warns otherwise. With two pointers, pass one of them twice. */
MeBool mcd_areGiven(const char *function, const void *a, const void *b, const void *c);
/* Whether p is a live object that may be destroyed; otherwise warns, if any framework is alive. Null: false, without
 * a warning. */
MeBool mcd_mayDestroy(const void *p, unsigned int kind, const char *what, const char *function);

/* ---- instances ----------------------------------------------------------------------------------------------- */

struct _McdGeometryInstance {
    McdGeometryID geometry;
    McdGeometryInstance *parent;     /* null for a model's own */
    McdGeometryInstance *firstChild; /* of an aggregate's instance, in the order of its elements */
    MeMatrix4Ptr tm;                 /* set by the program: a model's transform, or a copy of a child's */
    int material;                    /* of a child; -1: the parent's. A model's material is in its record */
    int element;                     /* of a child: its index among the parent's elements */
    MeVector3 min, max;              /* box in the world, as of the last update */

    McdModelID model;
    McdGeometryInstance *nextSibling; /* also links the free instances of the pool */
    MeMatrix4 placed;                 /* a child's world transform; of a model's own: that which places its children */
    double placedAxis[3][3];          /* mcd_shapeAxes of `placed`, if isPlaced */
    MeBool isPlaced;                  /* mcd_isValidTransform of `placed` */
    MeHandle handle;
};

/* Add an instance to the table of live objects (MeHandleIsLive), and remove it; in check builds only. */
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

/* The instance's world transform; null if the model has none. */
static inline MeMatrix4Ptr mcd_instanceTM(McdGeometryInstanceID ins) {
    return ins->parent ? ins->placed : ins->tm;
}

/* Whether the instance has a valid transform. */
static inline MeBool mcd_instanceIsPlaced(McdGeometryInstanceID ins) {
    return mcd_isValidTransform(mcd_const(mcd_instanceTM(ins)));
}

/* Create, free and place the children of an instance. mcd_instanceMakeChildren: false, with a message that names the
 * function, if the pool is exhausted. */
MeBool mcd_instanceMakeChildren(McdFramework *frame, McdGeometryInstance *ins, const char *function);
void mcd_instanceFreeChildren(McdFramework *frame, McdGeometryInstance *ins);
void mcd_instancePlaceChildren(McdGeometryInstance *ins); /* recursively, from its own transform */
/* Whether the children of a model's own instance, if there are any, are placed by its current transform. */
static inline MeBool mcd_areChildrenPlaced(const McdGeometryInstance *own) {
    return !own->firstChild || !own->tm || memcmp(own->placed, own->tm, sizeof own->placed) == 0;
}

/* The instance's material: its own, or else that of the nearest ancestor that has one. */
unsigned int mcd_instanceMaterial(const McdGeometryInstance *ins);
/* The material of an element of the part, such as a mesh's triangle; else the part's. */
unsigned int mcd_elementMaterial(const McdGeometryInstance *ins, McdElementData element);
/* Whether it is an instance of a live model; warns if not. */
MeBool mcd_instanceCheck(const McdGeometryInstance *ins, const char *function);

#endif
