/** @file McdSphyl.h
 *  Sphyls, or capsules: a cylinder about the z axis with a half sphere at each end, centred at the origin. For a
 *  geometry that is not a sphyl: a warning, and 0; sizes that are not > 0 get a warning and change nothing.
 */
#ifndef MCDSPHYL_H
#define MCDSPHYL_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a sphyl of radius @a r whose cylinder has the height @a h (m), both > 0; its total length is h + 2 r.
 *  Null, with a warning, for other sizes, and if the type is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdSphylID MEAPI McdSphylCreate(McdFramework *frame, MeReal r, MeReal h);
MEPUBLIC MeReal MEAPI McdSphylGetRadius(McdSphylID s);         /**< m */
MEPUBLIC MeReal MEAPI McdSphylGetHeight(McdSphylID s);         /**< m, of the cylinder, without the ends */
MEPUBLIC void MEAPI McdSphylSetRadius(McdSphylID s, MeReal r); /**< m, > 0 */
MEPUBLIC void MEAPI McdSphylSetHeight(McdSphylID s, MeReal h); /**< m, > 0, of the cylinder */

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Sphyl);
MCD_DECLARE_LINE_SEGMENT(Sphyl);
/** @} */

ME_END_C

#endif
