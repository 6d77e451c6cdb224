/** @file MeIDPool.h
 *  Pools of ids: 0, 1, 2 and so on, each assigned once at a time.
 *
 *  Every function warns of a null pool, and then does nothing or returns 0 (MeIDPoolRequestID: -1). A pool may be used
 *  by one thread at a time.
 */
#ifndef MEIDPOOL_H
#define MEIDPOOL_H

#include "MePrecision.h"

ME_BEGIN_C

/** A pool. Its members are private. */
typedef struct MeIDPool {
    MeU32 *taken; /* one bit per id */
    int words, firstFree, count;
} MeIDPool;

/** Creates a pool without assigned ids. Null, after MeFatalError, without memory. Free it with MeIDPoolDestroy. */
MEPUBLIC MeIDPool *MEAPI MeIDPoolCreate(void);
MEPUBLIC void MEAPI MeIDPoolDestroy(MeIDPool *pool); /**< Frees a pool. */
/** Releases all ids. */
MEPUBLIC void MEAPI MeIDPoolReset(MeIDPool *pool);
/** Copies the set of assigned ids. */
MEPUBLIC void MEAPI MeIDPoolCopy(MeIDPool *to, MeIDPool *from);
/** Assigns and returns the smallest free id; -1: with a warning if all are assigned; after MeFatalError, without
 * memory. */
MEPUBLIC int MEAPI MeIDPoolRequestID(MeIDPool *pool);
/** Releases an id. Warns if it is not assigned. */
MEPUBLIC void MEAPI MeIDPoolReturnID(MeIDPool *pool, int id);
/** Are all 2147483616 ids of the pool assigned? */
MEPUBLIC MeBool MEAPI MeIDPoolIsEmpty(MeIDPool *pool);

ME_END_C

#endif
