/** @file McdCone.h
 *  Cones and truncated cones about the z axis, with the base below and the centre of mass at the origin. For a
 *  geometry that is not a cone: a warning, and 0.
 */
#ifndef MCDCONE_H
#define MCDCONE_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a cone of a length and a base radius (m), both > 0. Null, with a warning, for other sizes, and if the
 *  type is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdConeID MEAPI McdConeCreate(McdFramework *frame, MeReal length, MeReal lowerRadius);
/** Sets the length (> 0) and the radii of both ends (>= 0, not both 0; m). The origin remains the centre of mass,
 *  whose place within the cone changes. Other sizes get a warning and change nothing. */
MEPUBLIC void MEAPI McdConeSetGeometricalParameters(McdConeID g, MeReal length, MeReal lowerRadius, MeReal upperRadius);
MEPUBLIC MeReal MEAPI McdConeGetLength(McdConeID g);      /**< m, from end to end */
MEPUBLIC MeReal MEAPI McdConeGetLowerRadius(McdConeID g); /**< m, at the end with the smaller z */
MEPUBLIC MeReal MEAPI McdConeGetUpperRadius(McdConeID g); /**< m, at the end with the greater z */
MEPUBLIC MeReal MEAPI McdConeGetLowerHeight(McdConeID g); /**< m, from the lower end up to the origin */
MEPUBLIC MeReal MEAPI McdConeGetUpperHeight(McdConeID g); /**< m, from the origin up to the upper end */
MEPUBLIC MeReal MEAPI McdConeGetZOffset(McdConeID g);     /**< m, z of the point midway between the ends */

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Cone);
MCD_DECLARE_LINE_SEGMENT(Cone);
/** @} */

ME_END_C

#endif
