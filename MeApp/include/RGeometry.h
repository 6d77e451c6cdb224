/** @file RGeometry.h
 *  How collision geometries look: graphics made from geometries and models (library MeApp: the viewer itself does not
 *  know collision).
 *
 *  Each function returns a graphic in the context's 3D list, which belongs to it as those of RGraphicBoxCreate do, or
 *  null with a warning if an argument is bad. The graphic has the geometry's shape as it is at the call; it does not
 *  keep the geometry. Graphics and transforms are independent of gravity's direction: everything is in the geometry's
 *  own frame.
 *
 *  A plane is a square of side 40 round its origin. A triangle list, whose triangles only the program's callback knows,
 *  is its box in wireframe. A geometry without shape (null type, or one of the program's own) has no graphic: null,
 *  silently.
 */
#ifndef RGEOMETRY_H
#define RGEOMETRY_H

#include "McdGeometryTypes.h"
#include "MeViewerTypes.h"
#include "RConvex.h"

ME_BEGIN_C

/** A geometry at the identity; RGraphicSetTransformPtr has it follow a transform. */
MEPUBLIC RGraphic *MEAPI RGraphicCreateFromGeometry(RRender *rc, McdGeometryID geom, const float color[4]);
/**
 * A model's geometry that follows the model's transform (McdModelGetTransformPtr, as it is at the call: set it before,
 * and destroy the graphic before what the transform belongs to).
 */
MEPUBLIC RGraphic *MEAPI RGraphicCreateFromModel(RRender *rc, McdModelID m, const float color[4]);
/** An aggregate with all its parts as one graphic that follows @a tm; null: the identity. Parts without a shape are
 *  left out. */
MEPUBLIC RGraphic *MEAPI RGraphicAggregateCreate(RRender *rc, McdAggregateID g, const float color[4], MeMatrix4Ptr tm);
/** @a count triangles, flat and seen from both sides, that follow @a tm. An addition to the 1.2 interface. */
MEPUBLIC RGraphic *MEAPI RGraphicTrianglesCreate(RRender *rc, MeVector3 (*corners)[3], int count, const float color[4],
                                                 MeMatrix4Ptr tm);

ME_END_C

#endif
