/** @file MePool.h
 *  Pools of records of one size, allocated and released in any order.
 *
 *  There are two kinds of pool, with the same table of functions. A fixed pool allocates memory once, for a fixed
 *  number of records. A malloc pool allocates each record on request, without limit.
 *
 *  @code
 *      MePool pool;
 *      if (MePoolFixedAPI.init(&pool, sizeof(Record), 100, 16)) {
 *          Record *r = pool.api->getStruct(&pool);
 *          ...
 *          pool.api->putStruct(&pool, r);
 *          pool.api->destroy(&pool);
 *      }
 *  @endcode
 *
 *  A pool may be used by one thread at a time. Every function warns of a null pool and of one of another kind, and then
 *  does nothing or returns 0.
 */
#ifndef MEPOOL_H
#define MEPOOL_H

#include "MePrecision.h"

ME_BEGIN_C

/** The kind of a pool. */
typedef enum MePoolType {
    MePoolNULL = 0,  /**< Not initialized, or destroyed. */
    MePoolFIXED = 1, /**< Made by MePoolFixedAPI. */
    MePoolMALLOC = 2 /**< Made by MePoolMallocAPI. */
} MePoolType;

/** The data of a fixed pool. */
typedef struct MePoolFixed {
    char *memory;    /**< count * stride bytes, followed by a flag per record */
    MeU8 *isOut;     /**< count flags, at the end of memory: is the record in use? */
    void *firstFree; /**< free list; a free record begins with a pointer to the next one */
    int count;       /**< total number of records */
} MePoolFixed;

/** The data of a malloc pool. */
typedef struct MePoolMalloc {
    struct MePoolMallocLink *first; /**< list of the records in use, newest first */
    int header;                     /**< size of the list header before each record, bytes */
} MePoolMalloc;

/** A pool. Its members are read-only. */
typedef struct MePool {
    const struct MePoolAPI *api; /**< The pool's functions. */
    MePoolType type;             /**< The pool's kind. */
    int stride;                  /**< Distance of records, bytes. */
    int alignment;               /**< Bytes. */
    int used;                    /**< Number of records in use. */
    union {
        MePoolFixed fixed;
        MePoolMalloc allocated;
    } u; /**< Data of its kind. */
} MePool;

/** The functions of a pool. */
struct MePoolAPI {
    /** Initializes a pool of records of @a structSize bytes (at least 1), aligned to @a alignment bytes (a power of 2).
     *  @a count is the number of records of a fixed pool; ignored for a malloc pool. Bad numbers warn.
     *  @return MEFALSE for bad numbers or when out of memory; the pool is then of the type MePoolNULL */
    MeBool(MEAPI *init)(MePool *pool, int structSize, int count, int alignment);
    /** Releases all records. The following ones are allocated in the order of a new pool. */
    void(MEAPI *reset)(MePool *pool);
    /** Frees all memory, also of records in use. */
    void(MEAPI *destroy)(MePool *pool);
    /** Allocates a record, with undefined contents. Null: with a warning that names the pool's size, if all records are
     *  in use; without memory. A fixed pool first reuses released records, the last one first, then allocates records
     *  in the order of addresses. */
    void *(MEAPI *getStruct)(MePool *pool);
    /** Releases a record. Null does nothing. A pointer that is not a record in use warns in a fixed pool, and is
     *  undefined in a malloc pool. */
    void(MEAPI *putStruct)(MePool *pool, void *record);
    /** The number of records in use. */
    int(MEAPI *getUsed)(const MePool *pool);
    /** The total number of records: 0 (no limit) for a malloc pool. */
    int(MEAPI *getCount)(const MePool *pool);
};

extern MEPUBLIC const struct MePoolAPI MePoolFixedAPI;  /**< Fixed pools. */
extern MEPUBLIC const struct MePoolAPI MePoolMallocAPI; /**< Malloc pools. */

ME_END_C

#endif
