/** @file McdQuery.h
 *  Queries of a space besides line segments: overlaps, closest model, shape casts. Not in Karma 1.2.
 *
 *  All are legal only outside of change blocks (elsewhere: a warning and 0). They use the current transforms of
 *  models, also for the children of aggregates, but find models by their boxes as of the last update. The querying
 *  geometry must be convex (sphere, box, cylinder, sphyl, cone, convex mesh); it needs no model. Queries find models
 *  of convex geometries, planes, meshes, triangle lists and height fields, and aggregates of these. Meshes, lists and
 *  fields are surfaces here, without an inside: each triangle counts alone, from both sides; but casts and rays hit
 *  triangles that are not two-sided only from their front. If a filter is given, only models for which it returns
 *  non-zero are considered. Lists are in the order of sort keys, then creation; if there is not room for all, the last
 *  ones are left out. Lengths are in the program's unit, everything in the world frame. Frozen and disabled models are
 *  found like others; sensors (McdModelSetSensor) are not, unless McdSpaceSetQuerySensors enables it.
 */
#ifndef MCDQUERY_H
#define MCDQUERY_H

#include "McdSpace.h"

ME_BEGIN_C

/** The result of McdSpaceGetClosest. */
typedef struct McdClosestResult {
    McdModelID model;               /**< The closest model. */
    McdGeometryInstanceID instance; /**< The closest shape of it. */
    MeReal distance;                /**< Between the surfaces; if they penetrate, the negative depth. */
    MeVector3 position1;            /**< The closest point of the querying geometry. */
    MeVector3 position2;            /**< The closest point of the model. */
    MeVector3 normal;               /**< Length 1, from the model to the querying geometry. */
} McdClosestResult;

/** The result of McdSpaceCastGeometry and McdSpaceCastRay: the first hit. */
typedef struct McdCastResult {
    McdModelID model;
    McdGeometryInstanceID instance; /**< The shape hit: the model's own instance, or a child of an aggregate. */
    McdElementData element; /**< The shape's triangle, as in McdContact.element1; for other geometries a null ptr. */
    unsigned int material;  /**< There: that of the mesh's triangle (McdMesh.h), or else of the shape. */
    MeReal fraction;        /**< Fraction of the displacement up to the hit, 0 .. 1. */
    MeVector3 position;     /**< The contact point then. */
    MeVector3 normal;       /**< Length 1, from the model to the cast shape; undefined for a ray that starts inside. */
    MeBool hasElement;      /**< Whether the part has triangles: element.tag 0 is then the first, else there is none. */
} McdCastResult;

/** A category, mask and group of a query, which finds the models that would collide with a model of such a filter
 *  (McdModelSetFilter, McdModelSetFilterGroup). */
typedef struct McdQueryFilter {
    MeU32 category, mask;
    int group;
} McdQueryFilter;

/** The filter of a query with a McdQueryFilter: pass this function as @a filter and the address of the record as
 *  @a filterData. Null data finds nothing, with a warning. */
MEPUBLIC int MEAPI McdQueryByFilter(McdModelID cm, void *queryFilter);
/** The filter of a query for what may collide with a model: pass this function as @a filter and the model, which must
 *  be in the same space, as @a filterData. Its category, mask, group, culling table and disabled pairs count
 *  (McdSpacePairIsEnabled), and it is not found itself. */
MEPUBLIC int MEAPI McdQueryByPairs(McdModelID cm, void *model);

/** Finds the models whose boxes overlap a box; touching counts. Returns the number of models written. */
MEPUBLIC int MEAPI McdSpaceOverlapBox(McdSpaceID space, const MeVector3 minCorner, const MeVector3 maxCorner,
                                      McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                                      int listSize);
/** Finds the models that overlap a geometry at a transform, exactly; touching counts. Returns the number of models
 *  written. */
MEPUBLIC int MEAPI McdSpaceOverlapGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm,
                                           McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                                           int listSize);
/** McdSpaceOverlapGeometry for the geometry of a model at its transform; the model need not be in the space, and is
 *  not found itself. */
MEPUBLIC int MEAPI McdSpaceOverlapModel(McdSpaceID space, McdModelID cm, McdLineSegIntersectEnableCallback filter,
                                        void *filterData, McdModelID *list, int listSize);
/** Finds the model closest to a geometry at a transform, within maxDistance (>= 0); of several equally close ones,
 *  the first in order. 1 if there is one. */
MEPUBLIC int MEAPI McdSpaceGetClosest(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm, MeReal maxDistance,
                                      McdLineSegIntersectEnableCallback filter, void *filterData,
                                      McdClosestResult *result);
/** Finds the first hit of a geometry that moves from tm by displacement without rotation. A model that it penetrates
 *  at the start is hit at fraction 0; a model that it touches at the start and leaves is not hit. 1 if there is a
 *  hit. */
MEPUBLIC int MEAPI McdSpaceCastGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm,
                                        const MeVector3 displacement, McdLineSegIntersectEnableCallback filter,
                                        void *filterData, McdCastResult *result);
/** McdSpaceGetLineSegFirstEnabledIntersection in this form: from a point along a displacement. */
MEPUBLIC int MEAPI McdSpaceCastRay(McdSpaceID space, const MeVector3 from, const MeVector3 displacement,
                                   McdLineSegIntersectEnableCallback filter, void *filterData, McdCastResult *result);

/** Whether queries of the space, including the line segments of McdSpace.h, find sensors. Default: no. */
MEPUBLIC void MEAPI McdSpaceSetQuerySensors(McdSpaceID space, MeBool on);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI McdSpaceGetQuerySensors(McdSpaceID space);

ME_END_C

#endif
