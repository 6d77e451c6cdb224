/** @file RMesh.h
 *  Graphics of meshes in files: .obj, .stl, .ply, .gltf, .glb and the other formats of the library assimp, which is
 *  loaded when the first one is read. An addition to the 1.2 interface. MeAppHull.h (library MeApp) makes hulls of
 *  them.
 */
#ifndef RMESH_H
#define RMESH_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * All triangles of all objects in a file, where the file places them, times @a scale (not 0): in the context's 3D list,
 * following @a matrix (null: the identity). Axes are the file's. Faces without normals are flat; materials are not
 * read, texture coordinates are. Null after a warning that names the file, if it cannot be read, holds no triangles,
 * or assimp (Debian's libassimp5) is not there, and for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI RGraphicLoadMesh(RRender *rc, const char *filename, AcmeReal scale, const float color[4],
                                          MeMatrix4Ptr matrix);

ME_END_C

#endif
