/** @file McdPlane.h
 *  Planes: z = 0 of the geometry's frame; the inside is below. A plane's box is unbounded (as large as numbers allow),
 *  except on the side to which an axis-aligned normal points. A plane has no mass properties and is drawn as a square
 *  about its origin.
 */
#ifndef MCDPLANE_H
#define MCDPLANE_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a plane; null, with a warning, if the type is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdPlaneID MEAPI McdPlaneCreate(McdFramework *frame);
/** The normal of the plane at @a tm (world, length 1): the z axis of tm. */
MEPUBLIC void MEAPI McdPlaneGetNormal(const McdGeometry *g, const MeMatrix4 tm, MeVector3 normal);
/** The height of a world point above the plane at @a tm (m); negative: below. */
MEPUBLIC MeReal MEAPI McdPlaneGetDistanceToPoint(const McdGeometry *g, const MeMatrix4 tm, const MeVector3 point);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Plane);
MCD_DECLARE_LINE_SEGMENT(Plane);
/** @} */

ME_END_C

#endif
