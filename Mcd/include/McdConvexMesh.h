/** @file McdConvexMesh.h
 *  Convex meshes: the hull of some points (User Guide ch. 4, "Making a Model with a Convex Mesh Geometry").
 *
 *  A fat mesh is made of all points within its fatness of the hull: its edges and corners are round. What is no convex
 *  mesh, and polygons and vertices that it has not got, get a warning and 0. Mass properties are those of uniform
 *  density and exact, with fatness too. The origin is wherever the points have it, the centre of mass need not be
 *  there.
 */
#ifndef MCDCONVEXMESH_H
#define MCDCONVEXMESH_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/**
 * Creates the hull of vertexCount points (m, copied); inner, double and nearly coplanar ones do no harm: what is less
 * than 3e-7 of half the hull's length off a point, a line or a plane counts as in it.
 * @param fatnessRadius 0 or more (m).
 * @return null, with a warning, if the points span no volume (a 1e-6th of their extent across is the least), or are
 *         infinite or NaN, and if the type is not registered. McdGeometryDestroy destroys it.
 */
MEPUBLIC McdConvexMeshID MEAPI McdConvexMeshCreateHull(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                                       MeReal fatnessRadius);
/** Creates a polyhedron with the outline of McdSphylCreate(frame, radius, height): its corners are on the sphyl. */
MEPUBLIC McdConvexMeshID MEAPI McdConvexMeshCreateSphyl(McdFramework *frame, MeReal radius, MeReal height);
MEPUBLIC MeReal MEAPI McdConvexMeshGetFatness(McdConvexMeshID mesh); /**< m */
/** How many faces the hull has. Numbers of polygons and of their vertices count from 0. */
MEPUBLIC int MEAPI McdConvexMeshGetPolygonCount(McdConvexMeshID g);
/** How many vertices a face has, 3 or more. */
MEPUBLIC int MEAPI McdConvexMeshGetPolygonVertexCount(McdConvexMeshID g, int polyID);
/** A face's outward normal, length 1. */
MEPUBLIC void MEAPI McdConvexMeshGetPolygonNormal(McdConvexMeshID g, int polyID, MeVector3 normal);
/** A face's vertex (m); they run counter-clockwise as seen from outside. */
MEPUBLIC void MEAPI McdConvexMeshGetPolygonVertex(McdConvexMeshID g, int polyID, int vertexID, MeVector3 vertex);
/** The same, by pointer; valid as long as the mesh is, to be read only. Null where there is none. */
MEPUBLIC const MeReal *MEAPI McdConvexMeshGetPolygonVertexPtr(McdConvexMeshID g, int polyID, int vertexID);
/** What the mesh at @a tm covers of the world's x and y: bounds = least x, greatest x, least y, greatest y. */
MEPUBLIC void MEAPI McdConvexMeshGetXYAABB(McdConvexMeshID g, MeMatrix4 tm, MeReal bounds[4]);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(ConvexMesh);
MCD_DECLARE_LINE_SEGMENT(ConvexMesh);
/** @} */

ME_END_C

#endif
