/** @file McdSphere.h
 *  Spheres, centred at the origin.
 */
#ifndef MCDSPHERE_H
#define MCDSPHERE_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a sphere of radius @a r > 0 (m). Null, with a warning, for another radius, and if the type is not
 *  registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdSphereID MEAPI McdSphereCreate(McdFramework *frame, MeReal r);
/** The radius (m); 0, with a warning, if @a g is not a sphere. */
MEPUBLIC MeReal MEAPI McdSphereGetRadius(McdSphereID g);
/** Sets the radius (m). A radius that is not a number > 0 gets a warning and changes nothing. */
MEPUBLIC void MEAPI McdSphereSetRadius(McdSphereID g, MeReal r);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Sphere);
MCD_DECLARE_LINE_SEGMENT(Sphere);
/** @} */

ME_END_C

#endif
