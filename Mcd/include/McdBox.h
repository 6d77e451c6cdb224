/** @file McdBox.h
 *  Boxes, centred at the origin, with edges along the axes. For a geometry that is not a box: a warning, and 0.
 */
#ifndef MCDBOX_H
#define MCDBOX_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a box with edges of these lengths (m), all > 0. Null, with a warning, for other lengths, and if the type
 *  is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdBoxID MEAPI McdBoxCreate(McdFramework *frame, MeReal dx, MeReal dy, MeReal dz);
/** The lengths of the edges (m). */
MEPUBLIC void MEAPI McdBoxGetDimensions(McdGeometryID g, MeReal *dx, MeReal *dy, MeReal *dz);
/** Sets the lengths of the edges (m). Lengths that are not all > 0 get a warning and change nothing. */
MEPUBLIC void MEAPI McdBoxSetDimensions(McdGeometryID g, MeReal dx, MeReal dy, MeReal dz);
/** The half lengths of the edges (m): read-only, valid while the box lives. Null if @a g is not a box. */
MEPUBLIC MeReal *MEAPI McdBoxGetRadii(McdBoxID g);
/** The bounds of the box at @a tm in the world's x and y: bounds = min x, max x, min y, max y. */
MEPUBLIC void MEAPI McdBoxGetXYAABB(McdBoxID g, MeMatrix4 tm, MeReal bounds[4]);
/** The corner that is farthest in a direction; both are in the box's own frame. */
MEPUBLIC void MEAPI McdBoxMaximumPointLocal(McdBoxID g, MeReal *inDir, MeReal *outPoint);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Box);
MCD_DECLARE_LINE_SEGMENT(Box);
/** @} */

ME_END_C

#endif
