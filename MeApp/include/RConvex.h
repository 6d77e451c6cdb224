/** @file RConvex.h
 *  Graphics of convex meshes. RGeometry.h has those of all geometries.
 */
#ifndef RCONVEX_H
#define RCONVEX_H

#include "McdGeometryTypes.h"
#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * Creates a flat-shaded graphic of a convex mesh's faces; otherwise as RGraphicBoxCreate: in the context's 3D list,
 * following @a matrix (null: the identity). Null, with a warning, if @a conv is not a convex mesh or another argument
 * is bad.
 */
MEPUBLIC RGraphic *MEAPI RGraphicConvexCreate(RRender *const rc, const McdConvexMeshID conv, const float color[4],
                                              const MeMatrix4Ptr matrix);

ME_END_C

#endif
