/** @file McdInternal.h
 *  For Mst, which makes frameworks and spaces of its universes' sizes. Not installed.
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

ME_END_C

#endif
