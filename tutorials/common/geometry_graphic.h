/* How collision geometries look, for tutorials. */
#ifndef GEOMETRY_GRAPHIC_H
#define GEOMETRY_GRAPHIC_H

#include "Mcd.h"
#include "MeViewer.h"

/* A graphic of a geometry, in the viewer's list, that follows tm. Null for types that have no shape of their own to show:
 * triangle lists (whose triangles only the program knows), null. A plane is shown as a square. */
RGraphic *geometryGraphic(RRender *rc, McdGeometryID g, const float color[4], MeMatrix4Ptr tm);

/* A graphic of triangles, three corners each, with their own normals, seen from both sides. */
RGraphic *triangleGraphic(RRender *rc, MeVector3 (*corners)[3], int count, const float color[4], MeMatrix4Ptr tm);

#endif
