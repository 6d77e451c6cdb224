/** @file MdtInternal.h
 *  For Mst, which makes worlds of its universes' sizes. Not installed.
 */
#ifndef MDTINTERNAL_H
#define MDTINTERNAL_H

#include "MdtTypes.h"

ME_BEGIN_C

/** What a message tells the program to raise where there is no room for more, instead of the arguments of
 *  MdtWorldCreate. Strings that stay. Each limit is spoken of once then. */
MEPUBLIC void MEAPI MdtWorldRenameLimits(const MdtWorldID w, const char *bodies, const char *constraints);

/** Whether that is a world, and a living one. */
MEPUBLIC MeBool MEAPI MdtWorldIsValid(const MdtWorldID w);

/** Counts how often the body's exact place or direction became another one, to the last bit of a double: what was found
 *  of it holds as long as this stays. */
MEPUBLIC unsigned long MEAPI MdtBodyGetMoves(const MdtBodyID b);

ME_END_C

#endif
