/** @file McdQuery.h
 *  Questions to a space beyond line segments: what is here, what is nearest, what is in the way. Not in Karma 1.2.
 *
 *  All are legal outside change blocks only (elsewhere: a warning and 0), ask models where their transforms are, and
 *  find them by their boxes of the last update. A geometry that asks is convex (sphere, box, cylinder, sphyl, cone,
 *  convex mesh); it needs no model. It meets models of convex geometries, planes, triangle lists and height fields, and
 *  aggregates of these. Lists and fields are surfaces here, with nothing inside: each of their triangles counts by
 *  itself, from both sides; but casts and rays meet triangles that are not two-sided from their front only. Where a
 *  filter is given, only models for which it returns non-zero are looked at. Lists are in the order of sort keys, then
 *  creation; what does not fit is left out from the end. Lengths in the program's unit, everything in the world frame.
 *  Frozen and disabled models are met like others; sensors (McdModelSetSensor) are not, unless McdSpaceSetQuerySensors
 *  says so.
 */
#ifndef MCDQUERY_H
#define MCDQUERY_H

#include "McdSpace.h"

ME_BEGIN_C

/** The nearest model, see McdSpaceGetClosest. */
typedef struct McdClosestResult {
    McdModelID model;               /**< The nearest one. */
    McdGeometryInstanceID instance; /**< The part of it. */
    MeReal distance;                /**< Between the surfaces; negative where they penetrate, and then the depth. */
    MeVector3 position1;            /**< The nearest point of the geometry that asks. */
    MeVector3 position2;            /**< The nearest point of the model. */
    MeVector3 normal;               /**< Length 1, from the model to the geometry. */
} McdClosestResult;

/** What is met first, see McdSpaceCastGeometry. */
typedef struct McdCastResult {
    McdModelID model;
    McdGeometryInstanceID instance; /**< The part of it; for rays the model's own. */
    MeReal fraction;                /**< Of the displacement, 0 .. 1, up to the touch. */
    MeVector3 position;             /**< Where they touch then. */
    MeVector3 normal; /**< Length 1, from the model to what was cast; undefined where a ray starts inside. */
} McdCastResult;

/** The models whose boxes overlap a box; touching counts. Returns how many were written. */
MEPUBLIC int MEAPI McdSpaceOverlapBox(McdSpaceID space, const MeVector3 minCorner, const MeVector3 maxCorner,
                                      McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                                      int listSize);
/** The models that overlap a geometry at a place, exactly; touching counts. Returns how many were written. */
MEPUBLIC int MEAPI McdSpaceOverlapGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm,
                                           McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                                           int listSize);
/** The same for the geometry of a model where it is, which need not be in the space; it does not meet itself. */
MEPUBLIC int MEAPI McdSpaceOverlapModel(McdSpaceID space, McdModelID cm, McdLineSegIntersectEnableCallback filter,
                                        void *filterData, McdModelID *list, int listSize);
/** The model nearest to a geometry at a place, no farther than maxDistance (>= 0); of several, the first in order. 1 if
 *  there is one. */
MEPUBLIC int MEAPI McdSpaceGetClosest(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm, MeReal maxDistance,
                                      McdLineSegIntersectEnableCallback filter, void *filterData,
                                      McdClosestResult *result);
/** What a geometry meets first when it moves from tm by displacement without turning; what it penetrates at the start
 *  it meets at fraction 0; what it touches and leaves it does not meet. 1 if there is something. */
MEPUBLIC int MEAPI McdSpaceCastGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm,
                                        const MeVector3 displacement, McdLineSegIntersectEnableCallback filter,
                                        void *filterData, McdCastResult *result);
/** McdSpaceGetLineSegFirstEnabledIntersection in this form: from a point along a displacement. */
MEPUBLIC int MEAPI McdSpaceCastRay(McdSpaceID space, const MeVector3 from, const MeVector3 displacement,
                                   McdLineSegIntersectEnableCallback filter, void *filterData, McdCastResult *result);

/** Whether queries of the space, segments of McdSpace.h among them, meet sensors. Off by default. */
MEPUBLIC void MEAPI McdSpaceSetQuerySensors(McdSpaceID space, MeBool on);
MEPUBLIC MeBool MEAPI McdSpaceGetQuerySensors(McdSpaceID space);

ME_END_C

#endif
