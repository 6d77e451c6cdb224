/** @file MeAppMesh.h
 *  Triangle meshes for collision (McdMesh.h) from graphics and files. An addition to the 1.2 interface.
 *
 *      static MeMatrix4 place;
 *      McdMeshID level = MeAppMeshFromFile(MstUniverseGetFramework(u), app->rc, "level.obj", 1);
 *      MstFixedModelCreate(u, level, place);
 */
#ifndef MEAPPMESH_H
#define MEAPPMESH_H

#include "McdGeometryTypes.h"
#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * Creates a mesh of a graphic's triangles: outside is where they are seen from. Null, with a warning, for a bad
 * argument, or as McdMeshCreate.
 */
MEPUBLIC McdMeshID MEAPI MeAppMeshCreate(McdFrameworkID frame, const RGraphic *rg);
/** Creates a mesh of all triangles in a file, as RGraphicLoadMesh reads them: at their places, times @a scale (not 0).
 *  Null, with a warning, as that. */
MEPUBLIC McdMeshID MEAPI MeAppMeshFromFile(McdFrameworkID frame, RRender *rc, const char *filename, MeReal scale);

ME_END_C

#endif
