/** @file McdCullingTable.h
 *  Collision filters by kinds of models.
 *
 *  A culling table is a symmetric table of flags, initially 0. See McdSpaceSetModelCullingParameters; a table must
 *  not be changed while models use it.
 */
#ifndef MCDCULLINGTABLE_H
#define MCDCULLINGTABLE_H

#include "McdCTypes.h"

ME_BEGIN_C

typedef struct McdCullingTable McdCullingTable;

/** Creates a table for indices 0 .. size - 1; null, with a warning, for a size below 1 or above 32768. */
MEPUBLIC McdCullingTable *MEAPI McdCullingTableCreate(int size);
/** Destroys a table, which no model may use any more. Null is ignored. */
MEPUBLIC void MEAPI McdCullingTableDestroy(McdCullingTable *const table);
/** Sets the flag of a and b, and of b and a; 1: models with these indices do not collide. An index out of range gets
 *  a warning. */
MEPUBLIC void MEAPI McdCullingTableSet(McdCullingTable *const table, MeU32 a, MeU32 b, MeBool flag);
/** The flag of a and b; 0, with a warning, for an index out of range. */
MEPUBLIC MeBool MEAPI McdCullingTableGet(const McdCullingTable *const table, MeU32 a, MeU32 b);
/** The number of indices. */
MEPUBLIC int MEAPI McdCullingTableGetSize(const McdCullingTable *const table);

ME_END_C

#endif
