/** @file MePool.h
 *  Records of one size, got and put back in any order (User Guide app. C, "Setting Karma Memory Usage").
 *
 *  There are two kinds of pool, each a table of the same functions. A fixed pool allocates once and hands out
 *  up to that many records. A malloc pool allocates each record when it is asked for, and has no limit.
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
 *  A pool is for one thread at a time. Every function warns of a null pool and of one of the other kind or of
 *  none, and then does nothing or gives 0.
 */
#ifndef MEPOOL_H
#define MEPOOL_H

#include "MePrecision.h"

ME_BEGIN_C

/** What a pool is now. */
typedef enum MePoolType {
    MePoolNULL = 0,  /**< Nothing yet, or destroyed. */
    MePoolFIXED = 1, /**< From MePoolFixedAPI. */
    MePoolMALLOC = 2 /**< From MePoolMallocAPI. */
} MePoolType;

/** What a fixed pool has. */
typedef struct MePoolFixed {
    char *memory;    /**< count * stride bytes, then for each record whether it is out */
    MeU8 *isOut;     /**< count flags, the end of memory */
    void *firstFree; /**< the first of a list; a record that is not out holds a pointer to the next */
    int count;       /**< how many records in all */
} MePoolFixed;

/** What a malloc pool has. */
typedef struct MePoolMalloc {
    struct MePoolMallocLink *first; /**< the newest of a list of the records that are out */
    int header;                     /**< bytes that each record has before it, for the list */
} MePoolMalloc;

/** Written by the functions of the table only. */
typedef struct MePool {
    const struct MePoolAPI *api; /**< The table that the pool was made with. */
    MePoolType type;             /**< Of which kind it is. */
    int stride;                  /**< Bytes from record to record. */
    int alignment;               /**< Bytes. */
    int used;                    /**< How many records are out. */
    union {
        MePoolFixed fixed;
        MePoolMalloc allocated;
    } u; /**< What its kind has. */
} MePool;

/** The functions of a kind of pool. */
struct MePoolAPI {
    /** Makes a pool of records of @a structSize bytes (at least 1) at multiples of @a alignment bytes (a
     *  power of 2). @a count is how many a fixed pool has; a malloc pool does not use it. Bad numbers warn.
     *  @return MEFALSE for bad numbers or when out of memory; the pool is then of the type MePoolNULL */
    MeBool(MEAPI *init)(MePool *pool, int structSize, int count, int alignment);
    /** Takes all records back. The next ones come in the order in which those of a new pool do. */
    void(MEAPI *reset)(MePool *pool);
    /** Frees everything, records that are out included. */
    void(MEAPI *destroy)(MePool *pool);
    /** A record, with any contents; null, with a warning that says how large the pool is, when all are out;
     *  null if out of memory. A fixed pool gives its records from the first to the last, and those put back
     *  before all others. */
    void *(MEAPI *getStruct)(MePool *pool);
    /** Puts a record back. Null does nothing. What is not a record that is out warns in a fixed pool, and
     *  must not be given to a malloc pool. */
    void(MEAPI *putStruct)(MePool *pool, void *record);
    /** How many records are out. */
    int(MEAPI *getUsed)(const MePool *pool);
    /** How many records there are in all: 0 (no limit) for a malloc pool. */
    int(MEAPI *getCount)(const MePool *pool);
};

extern MEPUBLIC const struct MePoolAPI MePoolFixedAPI;  /**< Pools that allocate once. */
extern MEPUBLIC const struct MePoolAPI MePoolMallocAPI; /**< Pools that allocate record by record. */

ME_END_C

#endif
