/* Pools of records of one size. */
#include "MePool.h"

#include "MeAssert.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <limits.h>
#include <stdint.h>
#include <string.h>

/* ---- both kinds ---- */

static MeBool isPool(const MePool *pool, MePoolType type, const char *function) {
    if (!me_isGiven(pool, "pool", function))
        return MEFALSE;
    if (pool->type != type)
        MeWarning(1, "%s: the pool is of type %d, expected %d", function, (int)pool->type, (int)type);
    return pool->type == type;
}

/* `size` rounded up to a multiple of `step`; 0 if it does not fit an int. */
static int roundUp(int size, int step) {
    return size > INT_MAX - step ? 0 : MeMathCEILN(step, size);
}

/* Initializes the members of both kinds. Records are aligned to `alignment`, at least that of a pointer. */
static MeBool initCommon(MePool *pool, const struct MePoolAPI *api, int structSize, int alignment,
                         const char *function) {
    if (!me_isGiven(pool, "pool", function))
        return MEFALSE;
    *pool = (MePool){.api = api, .type = MePoolNULL};
    if (structSize >= 1 && alignment >= 1 && (alignment & (alignment - 1)) == 0) {
        pool->alignment = MeMAX(alignment, (int)_Alignof(void *));
        pool->stride = roundUp(structSize, pool->alignment);
    }
    if (pool->stride == 0)
        MeWarning(1, "%s: records of %d bytes at multiples of %d", function, structSize, alignment);
    return pool->stride > 0;
}

/* ---- fixed ---- */

static void *recordAt(const MePool *pool, int i) {
    MEASSERT(i >= 0 && i < pool->u.fixed.count);
    return pool->u.fixed.memory + (size_t)i * (size_t)pool->stride;
}

/* The index of the record at an address; -1 if there is none. */
static int indexOf(const MePool *pool, const void *record) {
    const uintptr_t offset = (uintptr_t)record - (uintptr_t)pool->u.fixed.memory;
    const uintptr_t stride = (uintptr_t)pool->stride;
    if (offset % stride != 0 || offset / stride >= (uintptr_t)pool->u.fixed.count)
        return -1;
    return (int)(offset / stride);
}

static void pushFree(MePool *pool, void *record) {
    memcpy(record, &pool->u.fixed.firstFree, sizeof(void *));
    pool->u.fixed.firstFree = record;
}

static void *popFree(MePool *pool) {
    void *const record = pool->u.fixed.firstFree;
    MEASSERT(indexOf(pool, record) >= 0 && !pool->u.fixed.isOut[indexOf(pool, record)]);
    memcpy(&pool->u.fixed.firstFree, record, sizeof(void *));
    return record;
}

static void MEAPI fixedReset(MePool *pool) {
    if (!isPool(pool, MePoolFIXED, "MePoolFixedAPI.reset"))
        return;
    MePoolFixed *const fixed = &pool->u.fixed;
    pool->used = 0;
    memset(fixed->isOut, 0, (size_t)fixed->count);
    fixed->firstFree = NULL;
    for (int i = fixed->count - 1; i >= 0; i--)
        pushFree(pool, recordAt(pool, i));
}

static MeBool MEAPI fixedInit(MePool *pool, int structSize, int count, int alignment) {
    const char *const function = "MePoolFixedAPI.init";
    if (!initCommon(pool, &MePoolFixedAPI, structSize, alignment, function))
        return MEFALSE;
    if (count < 0) {
        MeWarning(1, "%s: %d records", function, count);
        return MEFALSE;
    }
    const size_t records = (size_t)count * (size_t)pool->stride;
    char *const memory =
        MeMemoryTakeAligned(records + (size_t)count, 1, (unsigned int)pool->alignment, function, "records");
    if (memory == NULL)
        return MEFALSE;
    pool->u.fixed = (MePoolFixed){.memory = memory, .isOut = (MeU8 *)memory + records, .count = count};
    pool->type = MePoolFIXED;
    fixedReset(pool);
    return METRUE;
}

static void MEAPI fixedDestroy(MePool *pool) {
    if (!isPool(pool, MePoolFIXED, "MePoolFixedAPI.destroy"))
        return;
    MeMemoryGiveAligned(pool->u.fixed.memory);
    *pool = (MePool){.api = pool->api, .type = MePoolNULL};
}

static void *MEAPI fixedGetStruct(MePool *pool) {
    if (!isPool(pool, MePoolFIXED, "MePoolFixedAPI.getStruct"))
        return NULL;
    if (pool->u.fixed.firstFree == NULL) {
        MeWarning(1, "MePoolFixedAPI.getStruct: all %d records of %d bytes are out", pool->u.fixed.count, pool->stride);
        return NULL;
    }
    void *const record = popFree(pool);
    pool->u.fixed.isOut[indexOf(pool, record)] = 1;
    pool->used++;
    MEASSERT((pool->used == pool->u.fixed.count) == (pool->u.fixed.firstFree == NULL));
    return record;
}

static void MEAPI fixedPutStruct(MePool *pool, void *record) {
    if (!isPool(pool, MePoolFIXED, "MePoolFixedAPI.putStruct") || record == NULL)
        return;
    const int i = indexOf(pool, record);
    if (i < 0 || !pool->u.fixed.isOut[i]) {
        MeWarning(1, "MePoolFixedAPI.putStruct: not a record that is out");
        return;
    }
    pool->u.fixed.isOut[i] = 0;
    pool->used--;
    MEASSERT(pool->used >= 0);
    pushFree(pool, record);
}

static int MEAPI fixedGetUsed(const MePool *pool) {
    return isPool(pool, MePoolFIXED, "MePoolFixedAPI.getUsed") ? pool->used : 0;
}

static int MEAPI fixedGetCount(const MePool *pool) {
    return isPool(pool, MePoolFIXED, "MePoolFixedAPI.getCount") ? pool->u.fixed.count : 0;
}

const struct MePoolAPI MePoolFixedAPI = {fixedInit,      fixedReset,   fixedDestroy, fixedGetStruct,
                                         fixedPutStruct, fixedGetUsed, fixedGetCount};

/* ---- malloc ---- */

/* Precedes each record: the list of records in use, for reset and destroy. */
typedef struct MePoolMallocLink {
    struct MePoolMallocLink *previous, *next;
} MePoolMallocLink;

static void MEAPI mallocReset(MePool *pool) {
    if (!isPool(pool, MePoolMALLOC, "MePoolMallocAPI.reset"))
        return;
    while (pool->u.allocated.first != NULL) {
        MePoolMallocLink *const link = pool->u.allocated.first;
        pool->u.allocated.first = link->next;
        MeMemoryGiveAligned(link);
    }
    pool->used = 0;
}

static MeBool MEAPI mallocInit(MePool *pool, int structSize, int count, int alignment) {
    (void)count;
    if (!initCommon(pool, &MePoolMallocAPI, structSize, alignment, "MePoolMallocAPI.init"))
        return MEFALSE;
    pool->u.allocated.header = roundUp((int)sizeof(MePoolMallocLink), pool->alignment);
    pool->type = MePoolMALLOC;
    return METRUE;
}

static void MEAPI mallocDestroy(MePool *pool) {
    if (!isPool(pool, MePoolMALLOC, "MePoolMallocAPI.destroy"))
        return;
    mallocReset(pool);
    *pool = (MePool){.api = pool->api, .type = MePoolNULL};
}

static void *MEAPI mallocGetStruct(MePool *pool) {
    const char *const function = "MePoolMallocAPI.getStruct";
    if (!isPool(pool, MePoolMALLOC, function))
        return NULL;
    MePoolMalloc *const list = &pool->u.allocated;
    const size_t bytes = (size_t)list->header + (size_t)pool->stride;
    MePoolMallocLink *const link = MeMemoryTakeAligned(bytes, 1, (unsigned int)pool->alignment, function, "a record");
    if (link == NULL)
        return NULL;
    *link = (MePoolMallocLink){.next = list->first};
    if (list->first != NULL)
        list->first->previous = link;
    list->first = link;
    pool->used++;
    MEASSERTALIGNED((char *)link + list->header, pool->alignment);
    return (char *)link + list->header;
}

static void MEAPI mallocPutStruct(MePool *pool, void *record) {
    if (!isPool(pool, MePoolMALLOC, "MePoolMallocAPI.putStruct") || record == NULL)
        return;
    MePoolMalloc *const list = &pool->u.allocated;
    MePoolMallocLink *const link = (void *)((char *)record - list->header);
    MEASSERT(link->previous != NULL ? link->previous->next == link : list->first == link);
    if (link->next != NULL)
        link->next->previous = link->previous;
    if (link->previous != NULL)
        link->previous->next = link->next;
    else
        list->first = link->next;
    pool->used--;
    MEASSERT((pool->used == 0) == (list->first == NULL));
    MeMemoryGiveAligned(link);
}

static int MEAPI mallocGetUsed(const MePool *pool) {
    return isPool(pool, MePoolMALLOC, "MePoolMallocAPI.getUsed") ? pool->used : 0;
}

static int MEAPI mallocGetCount(const MePool *pool) {
    isPool(pool, MePoolMALLOC, "MePoolMallocAPI.getCount");
    return 0;
}

const struct MePoolAPI MePoolMallocAPI = {mallocInit,      mallocReset,   mallocDestroy, mallocGetStruct,
                                          mallocPutStruct, mallocGetUsed, mallocGetCount};
