/* The signed distance of two models: the minimum over all pairs of their convex parts, planes and triangles. */
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"
#include "pair/mcd_pair_i.h"
#include <string.h>

/* Keeps the gap of two parts, if it is the nearest so far. The gap is as seen from the first model. False if the pair
 * is not supported (neither is convex, or one is a null geometry), or a transform is not valid. */
static MeBool measureChildren(McdGeometryInstance *a, McdGeometryInstance *b, const double origin[3], McdGap *nearest) {
    McdShape shape;
    McdGap gap, seen;
    if (!mcd_instanceIsPlaced(a) || !mcd_instanceIsPlaced(b))
        return MEFALSE;
    const MeBool isSwapped = !mcd_shapeOf(a, origin, &shape);
    if (isSwapped && !mcd_shapeOf(b, origin, &shape))
        return MEFALSE;
    if (!mcd_measureGap(&shape, isSwapped ? a : b, isSwapped ? b->model : a->model, origin, INFINITY, &seen))
        return MEFALSE;
    gap = seen;
    if (isSwapped) {
        mcd_copy(gap.onShape, seen.onOther);
        mcd_copy(gap.onOther, seen.onShape);
        mcd_scale(gap.normal, seen.normal, -1);
    }
    if (gap.distance < nearest->distance)
        *nearest = gap;
    return METRUE;
}

static MeBool measureInstances(McdGeometryInstance *a, McdGeometryInstance *b, const double origin[3],
                               McdGap *nearest) {
    MeBool isGood = METRUE;
    if (mcd_asAggregate(a->geometry))
        for (McdGeometryInstance *child = a->firstChild; child; child = child->nextSibling)
            isGood = measureInstances(child, b, origin, nearest) && isGood;
    else if (mcd_asAggregate(b->geometry))
        for (McdGeometryInstance *child = b->firstChild; child; child = child->nextSibling)
            isGood = measureInstances(a, child, origin, nearest) && isGood;
    else
        isGood = measureChildren(a, b, origin, nearest);
    return isGood;
}

MeBool MEAPI McdDistance(McdModelPair *p, McdDistanceResult *result) {
    McdGap nearest = {.distance = INFINITY};
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
    mcd_modelPlaceChildren(a);
    mcd_modelPlaceChildren(b);
    const MeBool isGood = measureInstances(&a->instance, &b->instance, origin, &nearest);
    MeStageEnd(&a->frame->stage, MCD_GUARD_MODELS);
    if (!isGood || nearest.distance == INFINITY)
        return MEFALSE;
    MEASSERT(!isnan(nearest.distance) && isfinite(mcd_dot(nearest.normal, nearest.normal)));
    result->distance = mcd_clampReal(nearest.distance);
    for (int i = 0; i < 3; i++) {
        result->position1[i] = mcd_clampReal(nearest.onShape[i] + origin[i]);
        result->position2[i] = mcd_clampReal(nearest.onOther[i] + origin[i]);
    }
    mcd_toReal(result->normal, nearest.normal);
    return METRUE;
}
