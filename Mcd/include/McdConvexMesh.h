/** @file McdConvexMesh.h
 *  Convex meshes: convex hulls of points.
 *
 *  A fat mesh consists of all points within its fatness of the hull: its edges and corners are rounded. For a
 *  geometry that is not a convex mesh, and for polygons and vertices that do not exist: a warning, and 0. Mass
 *  properties are those of uniform density, exact also with fatness. The origin is that of the given points; the
 *  centre of mass may be elsewhere.
 */
#ifndef MCDCONVEXMESH_H
#define MCDCONVEXMESH_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/**
 * Creates the convex hull of vertexCount points (m, copied). Inner, duplicate and nearly coplanar points are allowed: a
 * point counts as lying in another point, a line or a plane if it is nearer than 3e-7 of half the hull's length.
 * @param fatnessRadius 0 or more (m).
 * @return null, with a warning, if the hull has no volume (its thickness must be at least 1e-6 of half its length), if
 *         points are infinite or NaN, and if the type is not registered. McdGeometryDestroy destroys it.
 */
MEPUBLIC McdConvexMeshID MEAPI McdConvexMeshCreateHull(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                                       MeReal fatnessRadius);
/** Creates a polyhedron that approximates McdSphylCreate(frame, radius, height), with its vertices on the sphyl. */
MEPUBLIC McdConvexMeshID MEAPI McdConvexMeshCreateSphyl(McdFramework *frame, MeReal radius, MeReal height);
MEPUBLIC MeReal MEAPI McdConvexMeshGetFatness(McdConvexMeshID mesh); /**< m */
/** The number of faces of the hull. Indices of polygons and of their vertices start at 0. */
MEPUBLIC int MEAPI McdConvexMeshGetPolygonCount(McdConvexMeshID g);
/** The number of vertices of a face, 3 or more. */
MEPUBLIC int MEAPI McdConvexMeshGetPolygonVertexCount(McdConvexMeshID g, int polyID);
/** The outward normal of a face, length 1. */
MEPUBLIC void MEAPI McdConvexMeshGetPolygonNormal(McdConvexMeshID g, int polyID, MeVector3 normal);
/** A vertex of a face (m), counter-clockwise seen from outside. */
MEPUBLIC void MEAPI McdConvexMeshGetPolygonVertex(McdConvexMeshID g, int polyID, int vertexID, MeVector3 vertex);
/** A vertex of a face, as a pointer: read-only, valid while the mesh lives. Null if there is no such vertex. */
MEPUBLIC const MeReal *MEAPI McdConvexMeshGetPolygonVertexPtr(McdConvexMeshID g, int polyID, int vertexID);
/** The bounds of the mesh at @a tm in the world's x and y: bounds = min x, max x, min y, max y. */
MEPUBLIC void MEAPI McdConvexMeshGetXYAABB(McdConvexMeshID g, MeMatrix4 tm, MeReal bounds[4]);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(ConvexMesh);
MCD_DECLARE_LINE_SEGMENT(ConvexMesh);
/** @} */

ME_END_C

#endif
