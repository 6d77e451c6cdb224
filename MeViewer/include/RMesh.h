/** @file RMesh.h
 *  Graphics of mesh files: .obj, .stl, .ply, .gltf, .glb and the other formats of the library assimp, which is loaded
 *  at the first call. An addition to the 1.2 interface. MeAppMesh.h and MeAppHull.h (library MeApp) make meshes
 *  and convex hulls of them.
 */
#ifndef RMESH_H
#define RMESH_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * Loads all triangles of all objects in a file, at their places, times @a scale (not 0): in the context's 3D list,
 * following @a matrix (null: the identity). Axes are the file's. Faces without normals are flat-shaded; materials are
 * ignored, texture coordinates are read. Null, after a warning that names the file, if it cannot be read, has no
 * triangles, or assimp (Debian's libassimp5) is missing, and for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI RGraphicLoadMesh(RRender *rc, const char *filename, AcmeReal scale, const float color[4],
                                          MeMatrix4Ptr matrix);

ME_END_C

#endif
