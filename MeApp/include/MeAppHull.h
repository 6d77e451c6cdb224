/** @file MeAppHull.h
 *  Convex hulls of graphics, such as meshes from files (RMesh.h). An addition to the 1.2 interface.
 *
 *      RGraphic *rock = RGraphicLoadMesh(app->rc, "rock.stl", 1, RPalette[0], 0);
 *      McdConvexMeshID hull = MeAppHullCreate(frame, app->rc, rock, 0);
 *      MeAppShowModelAs(app, MstModelAndBodyCreate(u, hull, 2000), rock);
 */
#ifndef MEAPPHULL_H
#define MEAPPHULL_H

#include "McdGeometryTypes.h"
#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * Creates the convex hull of a graphic's vertices. Translates the vertices of hull and graphic so that the hull's
 * centre of mass is the origin, as a body's centre of mass is the origin of its geometry; @a centre (may be null) gets
 * its former position. Null, with a warning, for a bad argument, or if the vertices span no volume.
 */
MEPUBLIC McdConvexMeshID MEAPI MeAppHullCreate(McdFrameworkID frame, RRender *rc, RGraphic *rg, MeVector3 centre);

ME_END_C

#endif
