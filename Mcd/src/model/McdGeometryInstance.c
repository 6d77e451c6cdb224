/* Instances: geometries at places, and the trees of instances of aggregates. */
#include "model/mcd_geometries_i.h"
#include "convex/mcd_shape_i.h"
#include "convex/mcd_vector_i.h"
#include "model/mcd_result_i.h"
#include <string.h>

MeBool mcd_instanceCheck(const McdGeometryInstance *ins, const char *function) {
    const MeBool isKnown = ins && MCD_IS_KNOWN(ins, MCD_INSTANCE);
    const McdModelRecord *m = isKnown && ins->model ? mcd_record(ins->model) : 0;
    if (m && m->magic == MCD_MODEL)
        return METRUE;
    mcd_warnGone(ins, "instance of a model", function);
    return MEFALSE;
}

/* ---- the tree ------------------------------------------------------------------------------------------------- */

static McdGeometryInstance *instanceFromPool(McdFramework *frame, const char *function) {
    if (!frame->freeInstance && !mcd_frameAddInstances(frame, function))
        return 0;
    McdGeometryInstance *ins = frame->freeInstance;
    MEASSERT(!ins->geometry && frame->instanceCount < frame->instanceRoom);
    frame->freeInstance = ins->nextSibling;
    frame->instanceCount++;
    memset(ins, 0, sizeof *ins);
    ins->material = -1;
    mcd_instanceEnter(ins);
    return ins;
}

static void instanceToPool(McdFramework *frame, McdGeometryInstance *ins) {
    MEASSERT(frame->instanceCount > 0 && !ins->firstChild);
    mcd_instanceLeave(ins);
    memset(ins, 0, sizeof *ins);
    ins->nextSibling = frame->freeInstance;
    frame->freeInstance = ins;
    frame->instanceCount--;
}

void mcd_instanceFreeChildren(McdFramework *frame, McdGeometryInstance *ins) {
    while (ins->firstChild) {
        McdGeometryInstance *child = ins->firstChild;
        ins->firstChild = child->nextSibling;
        mcd_instanceFreeChildren(frame, child);
        MEASSERT(child->parent == ins && child->model == ins->model && child->geometry->referenceCount > 0);
        McdGeometryDecrementReferenceCount(child->geometry);
        instanceToPool(frame, child);
    }
}

MeBool mcd_instanceMakeChildren(McdFramework *frame, McdGeometryInstance *ins, const char *function) {
    const McdAggregate *aggregate = mcd_asAggregate(ins->geometry);
    if (!aggregate)
        return METRUE;
    McdGeometryInstance **end = &ins->firstChild;
    for (int i = 0; i < aggregate->count; i++) {
        McdGeometryInstance *child = instanceFromPool(frame, function);
        if (child) {
            child->geometry = aggregate->element[i].geometry;
            McdGeometryIncrementReferenceCount(child->geometry);
            child->model = ins->model;
            child->parent = ins;
            child->element = i;
            *end = child;
            end = &child->nextSibling;
        }
        if (!child || !mcd_instanceMakeChildren(frame, child, function)) {
            mcd_instanceFreeChildren(frame, ins);
            return MEFALSE;
        }
    }
    MEASSERT(*end == 0 && !ins->firstChild == !aggregate->count);
    return METRUE;
}

void mcd_instancePlaceChildren(McdGeometryInstance *ins) {
    const McdAggregate *aggregate = (const McdAggregate *)ins->geometry;
    const MeMatrix4Ptr tm = mcd_instanceTM(ins);
    if (!ins->parent && ins->firstChild)
        memcpy(ins->placed, tm, sizeof ins->placed);
    for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling) {
        MEASSERT(child->element < aggregate->count); /* its geometry may be another: McdGeometryInstanceSetGeometry */
        const MeMatrix4Ptr relative = aggregate->element[child->element].relTM;
        MeMatrix4TMCompound(child->placed, mcd_const(relative), mcd_const(tm));
        child->isPlaced = mcd_isValidTransform(mcd_const(child->placed));
        if (child->isPlaced && !child->firstChild)
            mcd_shapeAxes(mcd_const(child->placed), child->placedAxis);
        if (child->tm)
            memcpy(child->tm, child->placed, sizeof child->placed);
        mcd_instancePlaceChildren(child);
    }
}

McdGeometryInstanceID MEAPI McdGeometryInstanceGetChild(McdGeometryInstanceID ins, int i) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceGetChild"))
        return 0;
    McdGeometryInstance *child = ins->firstChild;
    while (child && child->element != i)
        child = child->nextSibling;
    return child;
}

int MEAPI McdGeometryInstanceGetChildCount(McdGeometryInstanceID ins) {
    int count = 0;
    if (mcd_instanceCheck(ins, "McdGeometryInstanceGetChildCount"))
        for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
            count++;
    return count;
}

McdGeometryInstanceID MEAPI McdGeometryInstanceGetParent(McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetParent") ? ins->parent : 0;
}

McdModelID MEAPI McdGeometryInstanceGetModel(McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetModel") ? ins->model : 0;
}

/* ---- geometry, place, material --------------------------------------------------------------------------------- */

McdGeometryID MEAPI McdGeometryInstanceGetGeometry(McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetGeometry") ? ins->geometry : 0;
}

void MEAPI McdGeometryInstanceSetGeometry(McdGeometryInstanceID ins, McdGeometryID g) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceSetGeometry") ||
        !mcd_geometryType(g, "McdGeometryInstanceSetGeometry") ||
        !mcd_geometryBelongs(g, mcd_record(ins->model)->frame, "McdGeometryInstanceSetGeometry") ||
        !mcd_mayChangeShapes(g->frame, "McdGeometryInstanceSetGeometry"))
        return;
    if (mcd_asAggregate(g) || mcd_asAggregate(ins->geometry)) {
        MeWarning(1, "McdGeometryInstanceSetGeometry: aggregates are set by McdModelSetGeometry");
        return;
    }
    McdGeometryDecrementReferenceCount(ins->geometry);
    McdGeometryIncrementReferenceCount(g);
    ins->geometry = g;
    mcd_geometryChanged(g);
}

McdGeometryType MEAPI McdGeometryInstanceGetGeometryType(McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetGeometryType") ? ins->geometry->type : (McdGeometryType)-1;
}

MeMatrix4Ptr MEAPI McdGeometryInstanceGetTransformPtr(const McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetTransformPtr") ? ins->tm : 0;
}

void MEAPI McdGeometryInstanceSetTransformPtr(const McdGeometryInstanceID ins, const MeMatrix4Ptr geometryTM) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceSetTransformPtr"))
        return;
    if (ins->parent)
        ins->tm = geometryTM;
    else
        McdModelSetTransformPtr(ins->model, geometryTM);
}

unsigned int mcd_instanceMaterial(const McdGeometryInstance *ins) {
    for (; ins->parent; ins = ins->parent)
        if (ins->material >= 0)
            return (unsigned int)ins->material;
    return mcd_record(ins->model)->material;
}

unsigned int mcd_elementMaterial(const McdGeometryInstance *ins, McdElementData element) {
    const McdKind *kind = mcd_kindOf(ins->geometry);
    const int own = kind && kind->material ? kind->material(ins->geometry, element.tag) : -1;
    return own >= 0 ? (unsigned int)own : mcd_instanceMaterial(ins);
}

unsigned int MEAPI McdGeometryInstanceGetMaterial(McdGeometryInstanceID ins) {
    return mcd_instanceCheck(ins, "McdGeometryInstanceGetMaterial") ? mcd_instanceMaterial(ins) : 0;
}

void MEAPI McdGeometryInstanceSetMaterial(McdGeometryInstanceID ins, int material) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceSetMaterial"))
        return;
    const int before = ins->parent ? ins->material : (int)mcd_record(ins->model)->material;
    if (material < (ins->parent ? -1 : 0))
        MeWarning(1, "McdGeometryInstanceSetMaterial: material is %d", material);
    if (material < (ins->parent ? -1 : 0) || material == before)
        return;
    if (ins->parent)
        ins->material = material;
    else
        mcd_record(ins->model)->material = (unsigned int)material;
    mcd_modelMarkChanged(mcd_record(ins->model));
}

void MEAPI McdGeometryInstanceReset(McdGeometryInstanceID ins) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceReset"))
        return;
    McdGeometryInstanceSetTransformPtr(ins, 0);
    ins->material = -1;
    if (!ins->parent)
        mcd_record(ins->model)->material = 0;
}

/* ---- boxes, support points ------------------------------------------------------------------- */

void MEAPI McdGeometryInstanceGetAABB(McdGeometryInstanceID ins, MeVector3 minCorner, MeVector3 maxCorner) {
    if (!mcd_areGiven(__func__, minCorner, maxCorner, maxCorner))
        return;
    static const MeVector3 origin = {0, 0, 0};
    const MeBool isGood = mcd_instanceCheck(ins, "McdGeometryInstanceGetAABB");
    MeVector3Copy(minCorner, isGood ? ins->min : origin);
    MeVector3Copy(maxCorner, isGood ? ins->max : origin);
}

void MEAPI McdGeometryInstanceSetAABB(McdGeometryInstanceID ins, const MeVector3 minCorner, const MeVector3 maxCorner) {
    if (!ins) {
        MeWarning(1, "McdGeometryInstanceSetAABB: no instance");
        return;
    }
    MeVector3Copy(ins->min, minCorner);
    MeVector3Copy(ins->max, maxCorner);
}

MeBool mcd_instanceUpdateAABB(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    const McdTypeRecord *type = mcd_geometryType(ins->geometry, "McdGeometryInstanceUpdateAABB");
    if (!type || !type->getAABB || !mcd_instanceTM(ins))
        return MEFALSE;
    const McdTypeCall call = mcd_typeEnter(ins->geometry->frame, type);
    type->getAABB(ins, finalTM, tight);
    mcd_typeLeave(&call);
    return METRUE;
}

MeBool mcd_instanceMaximumPoint(McdGeometryInstance *ins, MeReal *const direction, MeReal *const point) {
    const McdTypeRecord *type = mcd_geometryType(ins->geometry, "McdGeometryInstanceMaximumPoint");
    if (!type || !type->maximumPoint || !mcd_instanceTM(ins))
        return MEFALSE;
    const McdTypeCall call = mcd_typeEnter(ins->geometry->frame, type);
    type->maximumPoint(ins, direction, point);
    mcd_typeLeave(&call);
    return METRUE;
}

void MEAPI McdGeometryInstanceUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceUpdateAABB"))
        return;
    McdFramework *frame = ins->geometry->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    mcd_instanceUpdateAABB(ins, finalTM, tight);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

MeBool MEAPI McdGeometryInstanceOverlap(McdGeometryInstanceID a, McdGeometryInstanceID b) {
    if (!mcd_instanceCheck(a, "McdGeometryInstanceOverlap") || !mcd_instanceCheck(b, "McdGeometryInstanceOverlap"))
        return MEFALSE;
    for (int i = 0; i < 3; i++)
        if (a->min[i] > b->max[i] || b->min[i] > a->max[i])
            return MEFALSE;
    return METRUE;
}

static void transformPoint(MeVector3 placed, const MeMatrix4Ptr tm, const MeVector3 local) {
    double point[3];
    mcd_fromReal(point, local);
    for (int i = 0; i < 3; i++)
        placed[i] = mcd_clampReal(mcd_placedCoordinate(mcd_const(tm), point, i));
}

void MEAPI McdGeometryInstanceGetBSphere(const McdGeometryInstanceID ins, MeVector3 center, MeReal *radius) {
    if (!mcd_areGiven(__func__, center, radius, radius))
        return;
    MeVector3Set(center, 0, 0, 0);
    *radius = 0;
    if (!mcd_instanceCheck(ins, "McdGeometryInstanceGetBSphere"))
        return;
    MeVector3 local;
    McdFramework *frame = ins->geometry->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    McdGeometryGetBSphere(ins->geometry, local, radius);
    MeVector3Copy(center, local);
    if (mcd_instanceIsPlaced(ins))
        transformPoint(center, mcd_instanceTM(ins), local);
    else if (mcd_instanceTM(ins))
        MeWarning(1, "McdGeometryInstanceGetBSphere: the transform is not finite, or flat");
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

void MEAPI McdGeometryInstanceMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    MeVector3Set(outPoint, 0, 0, 0);
    if (mcd_instanceCheck(ins, "McdGeometryInstanceMaximumPoint"))
        mcd_instanceMaximumPoint(ins, inDir, outPoint);
}
