/** @file MePoolx.h
 *  Records of one size in memory that is the program's: MePool without an allocation.
 *
 *  Every function warns of a null pool, and then does nothing or gives 0. A pool is for one thread at a time.
 */
#ifndef MEPOOLX_H
#define MEPOOLX_H

#include "MeDict.h"

ME_BEGIN_C

/** A pool. Its members are private. */
typedef struct _MePoolx {
    char *memory;
    void *firstFree;              /* of a list of records that were put back */
    int size, count, used, begun; /* bytes of a record; how many there are, are out, were out once */
} MePoolx;

/** Makes a pool of numrec records of recsize bytes, one after the other in memory, which must stay: recsize must be at
 *  least a pointer's size, and a multiple of what the records are to be aligned to. With bad numbers it warns, and has
 *  none. */
MEPUBLIC void MEAPI MePoolxInit(MePoolx *p, void *memory, int recsize, int numrec);
/** A record, with any contents; null when all are out. */
MEPUBLIC void *MEAPI MePoolxGet(MePoolx *p);
/** A record whose bytes are 0; null when all are out. */
MEPUBLIC void *MEAPI MePoolxGetZeroed(MePoolx *p);
/** Puts a record back. Null does nothing; what is none of its records warns. */
MEPUBLIC void MEAPI MePoolxPut(MePoolx *p, void *rec);
/** Has a dictionary take its nodes from the pool, whose records must have room for a MeDictNode. */
MEPUBLIC void MEAPI MePoolxUseWithDict(MePoolx *p, struct MeDict *d);

ME_END_C

#endif
