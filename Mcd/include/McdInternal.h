/** @file McdInternal.h
 *  For Mst, which makes frameworks and spaces of its universes' sizes, and knows no geometry types. Not installed.
 */
#ifndef MCDINTERNAL_H
#define MCDINTERNAL_H

#include "McdCTypes.h"

ME_BEGIN_C

/** @name Names of limits
 *  What a message tells the program to raise where there is no room for more, instead of the arguments of McdInit and
 *  McdSpaceAxisSortCreate. Strings that stay. Each limit is spoken of once then.
 *  @{ */
MEPUBLIC void MEAPI McdFrameworkRenameLimits(McdFrameworkID frame, const char *types, const char *models,
                                             const char *instances);
MEPUBLIC void MEAPI McdSpaceRenameLimits(McdSpaceID s, const char *models, const char *pairs);
/** @} */

/** @name What a model's geometry is
 *  MEFALSE, with a warning, for what is no model.
 *  @{ */
/** Is it one convex shape, which can be cast (McdSpaceCastGeometry)? */
MEPUBLIC MeBool MEAPI McdModelIsConvex(McdModelID cm);
/** Is it a surface of triangles, of which McdSafeTime knows nothing? */
MEPUBLIC MeBool MEAPI McdModelIsSurface(McdModelID cm);
/** @} */

ME_END_C

#endif
