/** @file McduDebugDraw.h
 *  Draws collision objects by MeDebugDrawAPI (MeDebugDraw.h), which draws nothing until a program or the viewer sets
 *  its function. Colours are red, green, blue, each 0 to 1. An argument of the wrong kind gets a warning.
 */
#ifndef MCDUDEBUGDRAW_H
#define MCDUDEBUGDRAW_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Flags of what to draw; a sum. */
typedef enum McduDebugDrawFlags {
    kMcduDebugDrawAABB = 1,       /**< The box along the world's axes, as of the last update. */
    kMcduDebugDrawDetail = 2,     /**< The geometry. */
    kMcduDebugDrawEnabledOnly = 4 /**< Only models that are not frozen. */
} McduDebugDrawFlags;

/** Draws a box along the world's axes. */
MEPUBLIC void MEAPI McduDebugDrawAABB(const MeVector3 min, const MeVector3 max, const MeReal colour[3]);
/** Draws any geometry at a transform: as McdGeometryDebugDraw. */
MEPUBLIC void MEAPI McduDebugDrawGeometry(const McdGeometryID geometry, const MeMatrix4Ptr tm, const MeReal colour[3]);
/** @name Geometries of one type; the same as McduDebugDrawGeometry for those
 *  @{ */
/** @a tm: the sphere's transform in the world. */
MEPUBLIC void MEAPI McduDebugDrawSphere(const McdSphereID sphere, const MeMatrix4 tm, const MeReal colour[3]);
/** @a tm: the box's transform in the world. */
MEPUBLIC void MEAPI McduDebugDrawBox(const McdBoxID box, const MeMatrix4 tm, const MeReal colour[3]);
/** @a tm: the cylinder's transform in the world. */
MEPUBLIC void MEAPI McduDebugDrawCylinder(const McdCylinderID cyl, const MeMatrix4 tm, const MeReal colour[3]);
/** @a tm: the hull's transform in the world. */
MEPUBLIC void MEAPI McduDebugDrawConvex(const McdConvexMeshID convex, const MeMatrix4 tm, const MeReal colour[3]);
/** @a tm: the aggregate's transform in the world; draws its elements. */
MEPUBLIC void MEAPI McduDebugDrawAggregate(const McdAggregateID agg, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */
/** Draws a model at its transform. A model without a transform is not drawn. kMcduDebugDrawEnabledOnly is ignored
 *  here. */
MEPUBLIC void MEAPI McduDebugDrawModel(const McdModelID model, McduDebugDrawFlags flags, const MeReal colour[3]);
/** Draws a model's box along the world's axes, as of the last update, in white: McduDebugDrawModel with
 *  kMcduDebugDrawAABB. */
MEPUBLIC void MEAPI McdDebugDrawModelAABB(McdModelID cm);
/** Draws all models of a space, see McduDebugDrawModel; with kMcduDebugDrawEnabledOnly, those that are not frozen. */
MEPUBLIC void MEAPI McduDebugDrawSpace(const McdSpaceID space, McduDebugDrawFlags flags, const MeReal colour[3]);

ME_END_C

#endif
