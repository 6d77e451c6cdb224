/** @file McdNull.h
 *  The null geometry, without extent, which touches nothing: for models that only carry data.
 */
#ifndef MCDNULL_H
#define MCDNULL_H

#include "McdGeometryDeclare.h"

ME_BEGIN_C

/** Creates a null geometry; null, with a warning, if the type is not registered. McdGeometryDestroy destroys it. */
MEPUBLIC McdNullID MEAPI McdNullCreate(McdFramework *frame);

/** @name What every geometry type has, see McdGeometryDeclare.h
 *  @{ */
MCD_DECLARE_GEOMETRY_TYPE(Null);
/** @} */

ME_END_C

#endif
