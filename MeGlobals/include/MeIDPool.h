/** @file MeIDPool.h
 *  Numbers for things: 0, 1, 2 and so on, each given to one at a time.
 *
 *  Every function warns of a null pool, and then does nothing or gives 0 (MeIDPoolRequestID: -1). A pool is for one
 *  thread at a time.
 */
#ifndef MEIDPOOL_H
#define MEIDPOOL_H

#include "MePrecision.h"

ME_BEGIN_C

/** A pool. Its members are private. */
typedef struct MeIDPool {
    MeU32 *taken; /* a bit for each number */
    int words, firstFree, count;
} MeIDPool;

/** Makes a pool that has given nothing. Null, after MeFatalError, without memory. MeIDPoolDestroy gives it back. */
MEPUBLIC MeIDPool *MEAPI MeIDPoolCreate(void);
MEPUBLIC void MEAPI MeIDPoolDestroy(MeIDPool *pool); /**< Frees a pool. */
/** Takes all numbers back. */
MEPUBLIC void MEAPI MeIDPoolReset(MeIDPool *pool);
/** Makes those numbers taken in the first pool that are taken in the second. */
MEPUBLIC void MEAPI MeIDPoolCopy(MeIDPool *to, MeIDPool *from);
/** The least number that is not taken; -1, after MeFatalError, without memory. */
MEPUBLIC int MEAPI MeIDPoolRequestID(MeIDPool *pool);
/** Takes a number back. One that is not taken gets a warning. */
MEPUBLIC void MEAPI MeIDPoolReturnID(MeIDPool *pool, int id);
/** Is there no number left to be given? A pool has 2147483616 of them. */
MEPUBLIC MeBool MEAPI MeIDPoolIsEmpty(MeIDPool *pool);

ME_END_C

#endif
