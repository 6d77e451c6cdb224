/** @file McdBox.h
 *  Boxes (User Guide ch. 4, "Geometrical Types and Their Interactions"). The middle is the origin, the edges are along
 *  the axes. What is no box gets a warning and 0.
 */
#ifndef MCDBOX_H
#define MCDBOX_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a box with edges of these lengths (m), all > 0. Null, with a warning, for others and if the type is not
 *  registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdBoxID MEAPI McdBoxCreate(McdFramework *frame, MeReal dx, MeReal dy, MeReal dz);
/** The lengths of the edges (m). */
MEPUBLIC void MEAPI McdBoxGetDimensions(McdGeometryID g, MeReal *dx, MeReal *dy, MeReal *dz);
/** Sets them. Lengths that are not all > 0 get a warning and change nothing. */
MEPUBLIC void MEAPI McdBoxSetDimensions(McdGeometryID g, MeReal dx, MeReal dy, MeReal dz);
/** Half the lengths (m); to be read only, as long as the box lives. Null for what is no box. */
MEPUBLIC MeReal *MEAPI McdBoxGetRadii(McdBoxID g);
/** What the box at @a tm covers of the world's x and y: bounds = least x, greatest x, least y, greatest y. */
MEPUBLIC void MEAPI McdBoxGetXYAABB(McdBoxID g, MeMatrix4 tm, MeReal bounds[4]);
/** The corner that is farthest in a direction, both in the box's own frame. */
MEPUBLIC void MEAPI McdBoxMaximumPointLocal(McdBoxID g, MeReal *inDir, MeReal *outPoint);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Box);
MCD_DECLARE_LINE_SEGMENT(Box);
/** @} */

ME_END_C

#endif
