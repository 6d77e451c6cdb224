/* The signed distance of two models: the minimum over all pairs of their convex parts, planes and triangles. */
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"
#include "pair/mcd_pair_i.h"
#include <string.h>

/* The nearest pair of parts so far. */
typedef struct Nearest {
    double distance, onA[3], onB[3], normal[3];
    MeBool isFound;
} Nearest;

static void keepNearest(Nearest *nearest, double distance, const double onA[3], const double onB[3],
                        const double normal[3]) {
    if (nearest->isFound && distance >= nearest->distance)
        return;
    nearest->isFound = METRUE;
    nearest->distance = distance;
    memcpy(nearest->onA, onA, sizeof nearest->onA);
    memcpy(nearest->onB, onB, sizeof nearest->onB);
    memcpy(nearest->normal, normal, sizeof nearest->normal);
}

/* Keeps the distance of a convex shape from another part, if it is the nearest. isSwapped: the shape is the second
 * one of the pair. */
static void setNearest(Nearest *nearest, MeBool isSwapped, double distance, const double onShape[3],
                       const double onOther[3], const double n[3]) {
    const double back[3] = {-n[0], -n[1], -n[2]};
    if (isSwapped)
        keepNearest(nearest, distance, onOther, onShape, back);
    else
        keepNearest(nearest, distance, onShape, onOther, n);
}

static void measurePlane(const McdShape *a, McdGeometryInstance *plane, const double origin[3], MeBool isSwapped,
                         Nearest *nearest) {
    double onA[3], onB[3], n[3];
    const double distance = mcd_planeDistance(a, mcd_const(mcd_instanceTM(plane)), origin, onA, onB, n);
    setNearest(nearest, isSwapped, distance, onA, onB, n);
}

/* Measures the distance of a convex shape and a surface of triangles. asker: the shape's model, for a triangle
 * list's callback. */
static void measureMesh(const McdShape *a, McdModelID asker, McdGeometryInstance *mesh, const double origin[3],
                        MeBool isSwapped, Nearest *nearest) {
    double distance, onA[3], onB[3], n[3];
    if (!mcd_meshNearest(a, mesh, asker, origin, INFINITY, &distance, onA, onB, n))
        return;
    setNearest(nearest, isSwapped, distance, onA, onB, n);
}

/* Measures the distance of two parts. False if the pair is not supported (neither is convex, or one is a null
 * geometry), or a transform is not valid. */
static MeBool measureChildren(McdGeometryInstance *a, McdGeometryInstance *b, const double origin[3],
                              Nearest *nearest) {
    McdShape shapeA, shapeB;
    if (!mcd_instanceIsPlaced(a) || !mcd_instanceIsPlaced(b))
        return MEFALSE;
    double onA[3], onB[3], normal[3];
    const MeBool isConvexA = mcd_shapeOf(a, origin, &shapeA), isConvexB = mcd_shapeOf(b, origin, &shapeB);
    if (isConvexA && isConvexB) {
        const double distance = mcd_convexDistance(&shapeA, &shapeB, onA, onB, normal);
        keepNearest(nearest, distance, onA, onB, normal);
        return METRUE;
    }
    if (isConvexA && mcd_isHalfSpace(b))
        measurePlane(&shapeA, b, origin, MEFALSE, nearest);
    else if (isConvexB && mcd_isHalfSpace(a))
        measurePlane(&shapeB, a, origin, METRUE, nearest);
    else if (isConvexA && mcd_isMesh(b))
        measureMesh(&shapeA, a->model, b, origin, MEFALSE, nearest);
    else if (isConvexB && mcd_isMesh(a))
        measureMesh(&shapeB, b->model, a, origin, METRUE, nearest);
    else
        return MEFALSE;
    return METRUE;
}

static MeBool measureInstances(McdGeometryInstance *a, McdGeometryInstance *b, const double origin[3],
                               Nearest *nearest) {
    MeBool isGood = METRUE;
    if (mcd_asAggregate(a->geometry)) {
        for (McdGeometryInstance *child = a->firstChild; child; child = child->nextSibling)
            isGood = measureInstances(child, b, origin, nearest) && isGood;
        return isGood;
    }
    if (mcd_asAggregate(b->geometry)) {
        for (McdGeometryInstance *child = b->firstChild; child; child = child->nextSibling)
            isGood = measureInstances(a, child, origin, nearest) && isGood;
        return isGood;
    }
    return measureChildren(a, b, origin, nearest);
}

MeBool MEAPI McdDistance(McdModelPair *p, McdDistanceResult *result) {
    Nearest nearest = {0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, MEFALSE};
    double origin[3];
    if (!p || !result || !mcd_modelCheck(p->model1, "McdDistance") || !mcd_modelCheck(p->model2, "McdDistance"))
        return MEFALSE;
    memset(result, 0, sizeof *result);
    McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    if (!mcd_modelIsPlaced(a) || !mcd_modelIsPlaced(b)) {
        MeWarning(1, "McdDistance: a model has no transform, or one that is not finite, or flat");
        return MEFALSE;
    }
    mcd_pairOrigin(&a->instance, &b->instance, origin);
    MeStageBegin(&a->frame->stage, MCD_GUARD_MODELS);
    const MeBool isGood = measureInstances(&a->instance, &b->instance, origin, &nearest);
    MeStageEnd(&a->frame->stage, MCD_GUARD_MODELS);
    if (!isGood || !nearest.isFound)
        return MEFALSE;
    MEASSERT(!isnan(nearest.distance) && isfinite(mcd_dot(nearest.normal, nearest.normal)));
    result->distance = mcd_clampReal(nearest.distance);
    for (int i = 0; i < 3; i++) {
        result->position1[i] = mcd_clampReal(nearest.onA[i] + origin[i]);
        result->position2[i] = mcd_clampReal(nearest.onB[i] + origin[i]);
        result->normal[i] = (MeReal)nearest.normal[i];
    }
    return METRUE;
}
