/** @file McdCylinder.h
 *  Cylinders about the z axis, centred at the origin. For a geometry that is not a cylinder: a warning, and 0; sizes
 *  that are not > 0 get a warning and change nothing.
 */
#ifndef MCDCYLINDER_H
#define MCDCYLINDER_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a cylinder of radius @a r and height @a h (m), both > 0. Null, with a warning, for other sizes, and if
 *  the type is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdCylinderID MEAPI McdCylinderCreate(McdFramework *frame, MeReal r, MeReal h);
MEPUBLIC MeReal MEAPI McdCylinderGetRadius(McdCylinderID g);         /**< m */
MEPUBLIC MeReal MEAPI McdCylinderGetHeight(McdCylinderID g);         /**< m, from end to end */
MEPUBLIC MeReal MEAPI McdCylinderGetHalfHeight(McdCylinderID g);     /**< m */
MEPUBLIC void MEAPI McdCylinderSetRadius(McdCylinderID g, MeReal r); /**< m, > 0 */
MEPUBLIC void MEAPI McdCylinderSetHeight(McdCylinderID g, MeReal h); /**< m, > 0 */
/** Sets radius and height (m), both > 0. */
MEPUBLIC void MEAPI McdCylinderSetGeometricalParameters(McdCylinderID g, MeReal inRadius, MeReal inHeight);
/** The bounds of the cylinder at @a tm in the world's x and y: bounds = min x, max x, min y, max y. */
MEPUBLIC void MEAPI McdCylinderGetXYAABB(McdGeometry *g, MeMatrix4 tm, MeReal bounds[4]);
/** The point that is farthest in a direction; both are in the cylinder's own frame. */
MEPUBLIC void MEAPI McdCylinderMaximumPointLocal(McdGeometry *g, MeReal *const inDir, MeReal *const outPoint);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Cylinder);
MCD_DECLARE_LINE_SEGMENT(Cylinder);
/** @} */

ME_END_C

#endif
