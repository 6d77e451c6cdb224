/** @file MePoolx.h
 *  Pools of records of one size in the program's memory: allocate nothing.
 *
 *  Every function warns of a null pool, and then does nothing or returns 0. A pool may be used by one thread at a time.
 */
#ifndef MEPOOLX_H
#define MEPOOLX_H

#include "MeDict.h"

ME_BEGIN_C

/** A pool. Its members are private. */
typedef struct _MePoolx {
    char *memory;
    void *firstFree;              /* free list of released records */
    int size, count, used, begun; /* size of a record, bytes; total number of records; in use; ever used */
} MePoolx;

/** Initializes a pool of numrec records of recsize bytes, contiguous in memory that must remain valid. recsize must be
 *  at least a pointer's size, and a multiple of the records' alignment. With bad numbers it warns, and the pool has no
 *  records. */
MEPUBLIC void MEAPI MePoolxInit(MePoolx *p, void *memory, int recsize, int numrec);
/** Allocates a record, with undefined contents; null if all are in use. */
MEPUBLIC void *MEAPI MePoolxGet(MePoolx *p);
/** Allocates a record of zeros; null if all are in use. */
MEPUBLIC void *MEAPI MePoolxGetZeroed(MePoolx *p);
/** Releases a record. Null does nothing; any other pointer that is not one of its records warns. */
MEPUBLIC void MEAPI MePoolxPut(MePoolx *p, void *rec);
/** Makes the pool the allocator of a dictionary's nodes; a record must be at least a MeDictNode in size. */
MEPUBLIC void MEAPI MePoolxUseWithDict(MePoolx *p, struct MeDict *d);

ME_END_C

#endif
