/** @file RGeometry.h
 *  Graphics made from collision geometries and models (library MeApp: the viewer itself does not depend on collision).
 *
 *  Each function returns a graphic in the context's 3D list, which owns it as those of RGraphicBoxCreate; null, with a
 *  warning, if an argument is bad. The graphic has the geometry's shape at the time of the call, and no reference to
 *  the geometry. Vertices are in the geometry's own frame, independent of the direction of gravity.
 *
 *  A plane is drawn as a square of side 40 about its origin. A triangle list is drawn as its box in wireframe, since
 *  its triangles are known only to the program's callback. Convex shapes of the program (McdConvexType.h) are drawn by
 *  1026 support points. A geometry without a shape (null type, or another type of the program) has no graphic: null,
 *  silently.
 */
#ifndef RGEOMETRY_H
#define RGEOMETRY_H

#include "McdGeometryTypes.h"
#include "MeViewerTypes.h"
#include "RConvex.h"

ME_BEGIN_C

/** Creates a graphic of a geometry with the identity as transform; RGraphicSetTransformPtr sets another one. */
MEPUBLIC RGraphic *MEAPI RGraphicCreateFromGeometry(RRender *rc, McdGeometryID geom, const float color[4]);
/**
 * Creates a graphic of a model's geometry that follows the model's present transform pointer (McdModelGetTransformPtr):
 * set that before, and destroy the graphic before the owner of the transform.
 */
MEPUBLIC RGraphic *MEAPI RGraphicCreateFromModel(RRender *rc, McdModelID m, const float color[4]);
/** Creates one graphic of an aggregate with all its children that follows @a tm; null: the identity. Children without a
 *  shape are omitted. */
MEPUBLIC RGraphic *MEAPI RGraphicAggregateCreate(RRender *rc, McdAggregateID g, const float color[4], MeMatrix4Ptr tm);
/** Creates a graphic of @a count flat-shaded, two-sided triangles that follows @a tm. An addition to the 1.2
 * interface. */
MEPUBLIC RGraphic *MEAPI RGraphicTrianglesCreate(RRender *rc, MeVector3 (*corners)[3], int count, const float color[4],
                                                 MeMatrix4Ptr tm);

ME_END_C

#endif
