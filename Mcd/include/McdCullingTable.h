/** @file McdCullingTable.h
 *  Tables of which kinds of models do not collide (User Guide ch. 4, "Disabling and Enabling Pairs of Models").
 *
 *  A symmetric table of flags, all 0 at first. See McdSpaceSetModelCullingParameters; once models use a table, leave it
 *  as it is.
 */
#ifndef MCDCULLINGTABLE_H
#define MCDCULLINGTABLE_H

#include "McdCTypes.h"

ME_BEGIN_C

typedef struct McdCullingTable McdCullingTable;

/** Creates a table for indices 0 .. size - 1; null, with a warning, for a size below 1 or above 32768. */
MEPUBLIC McdCullingTable *MEAPI McdCullingTableCreate(int size);
/** Destroys a table that no model uses any more. Null does nothing. */
MEPUBLIC void MEAPI McdCullingTableDestroy(McdCullingTable *const table);
/** Sets the flag of a and b, and of b and a; 1: models with these indices do not collide. An index out of range gets a
 *  warning. */
MEPUBLIC void MEAPI McdCullingTableSet(McdCullingTable *const table, MeU32 a, MeU32 b, MeBool flag);
/** That flag; 0, with a warning, for an index out of range. */
MEPUBLIC MeBool MEAPI McdCullingTableGet(const McdCullingTable *const table, MeU32 a, MeU32 b);
/** The number of indices. */
MEPUBLIC int MEAPI McdCullingTableGetSize(const McdCullingTable *const table);

ME_END_C

#endif
