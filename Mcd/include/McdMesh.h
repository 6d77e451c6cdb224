/** @file McdMesh.h
 *  Indexed triangle meshes: levels, buildings, terrain with overhangs, drums. Beyond Karma; a triangle list
 *  (McdTriangleList.h) instead asks the program for triangles, a height field (McdRGHeightField.h) is a grid.
 *
 *  A mesh is a surface without a body, at rest or moved by its model's transform; it collides with convex shapes and
 *  aggregates of them. Outside is the side from which a triangle's corners are counter-clockwise, unless the mesh is
 *  two-sided. Contacts are as those of a triangle list with kMcdTriangleUseSmallestPenetration and all edges sharp:
 *  flat and concave edges have no effect. A model without other contacts whose centre is behind the surface is pushed
 *  back if the centre is no farther behind than half of the model's radius. McdContact.element1 or element2 is the
 *  triangle's number as tag.
 *
 *  At creation vertices with exactly equal coordinates are welded: they count as the first one, also after they move.
 *  Triangles are left out if an index is no vertex's, a vertex is not finite, or the height is less than 1e-7 of the
 *  longest side. One warning has their number; numbers of the others do not change. A tree of boxes finds triangles:
 *  queries cost as the logarithm of their number. A million take 0.11 GB, in double precision 0.17 GB, besides the
 *  vertices.
 */
#ifndef MCDMESH_H
#define MCDMESH_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Properties of a mesh; a sum of these. */
typedef enum McdMeshFlags {
    kMcdMeshDefault = 0,        /**< Vertices are copied; contacts are on the front only. */
    kMcdMeshBorrowVertices = 1, /**< Vertices are kept by pointer, and read in every query. */
    kMcdMeshTwoSided = 2        /**< Both sides are outside. */
} McdMeshFlags;

/** @name Creation
 *  For bad arguments: null, with a warning. McdGeometryDestroy destroys a mesh.
 *  @{ */
/**
 * Creates a mesh of copies of the arrays.
 * @param vertices    vertexCount (> 0) vertices (m), in the mesh's frame.
 * @param indices     the corners of triangle i are vertices indices[3 i], [3 i + 1] and [3 i + 2], from 0.
 * @param triangleCount > 0.
 * @param materials   the material of each triangle (McdContactGetMaterial); null: that of the model.
 * @return null, with a warning, also if all triangles are left out, or the type is not registered.
 */
MEPUBLIC McdMeshID MEAPI McdMeshCreate(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                       const int *indices, int triangleCount, const MeU32 *materials);
/** The same, with a sum of McdMeshFlags. Indices and materials are copied in any case. */
MEPUBLIC McdMeshID MEAPI McdMeshCreateWithFlags(McdFramework *frame, const MeVector3 *vertices, int vertexCount,
                                                const int *indices, int triangleCount, const MeU32 *materials,
                                                int flags);
/**
 * Creates a copy at another scale: coordinates are those of @a mesh, times scale[i] (> 0) along each axis. Triangles
 * and tree are shared: it costs a few bytes. Both live on alone; vertices that are set in one are set in both.
 */
MEPUBLIC McdMeshID MEAPI McdMeshCreateScaled(McdMeshID mesh, const MeVector3 scale);
/** @} */

/** @name Accessors
 *  For a geometry that is not a mesh: a warning, and a result of 0.
 *  @{ */
/**
 * Moves the vertices: as many as at creation, in the mesh's frame before scaling; copied, or kept by pointer if they
 * are borrowed. Then calls McdGeometryUpdate, which fits the tree to them: a program that writes borrowed vertices
 * itself calls that. The tree's structure stays: where vertices have moved far relative to each other, a new mesh is
 * faster. Not while models are tested. For null: a warning, and no effect.
 */
MEPUBLIC void MEAPI McdMeshSetVertices(McdMeshID mesh, const MeVector3 *vertices);
/** The flags of its creation. */
MEPUBLIC int MEAPI McdMeshGetFlags(McdMeshID mesh);
/** As given at creation, welded and left-out ones included. */
MEPUBLIC int MEAPI McdMeshGetVertexCount(McdMeshID mesh);
/** As given at creation, left-out ones included. */
MEPUBLIC int MEAPI McdMeshGetTriangleCount(McdMeshID mesh);
/** The number of triangles that were left out at creation. */
MEPUBLIC int MEAPI McdMeshGetLeftOutCount(McdMeshID mesh);
/** Gets the corners (m) of a triangle in the mesh's frame, scaled. False, and writes nothing, if it was left out for a
 *  bad vertex; with a warning, if there is no such triangle. */
MEPUBLIC MeBool MEAPI McdMeshGetTriangle(McdMeshID mesh, int triangle, MeVector3 corner[3]);
/** The material of a triangle; -1: that of the model. If there is no such triangle: a warning, and -1. */
MEPUBLIC int MEAPI McdMeshGetMaterial(McdMeshID mesh, int triangle);
/** Whether the surface has no border: each edge leads as often one way as the other. */
MEPUBLIC MeBool MEAPI McdMeshIsClosed(McdMeshID mesh);
/** @} */

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  The box is that of the mesh's own box. Mass properties are exact for a closed surface with its outside out; else 0.
 *  Line segments hit triangles from outside.
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Mesh);
MCD_DECLARE_LINE_SEGMENT(Mesh);
/** Registers the interactions with all convex types that are registered. Returns 1; 0, with a warning, if @a frame is
 *  not a framework. */
MEPUBLIC MeBool MEAPI McdMeshRegisterInteractions(McdFramework *frame);
/** @} */

ME_END_C

#endif
