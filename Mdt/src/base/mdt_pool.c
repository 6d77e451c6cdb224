/* Pools of records, and the sorted lists of live records. */
#include "MeAssert.h"
#include "base/mdt_world_i.h"
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { FIRST_BLOCK = 64 }; /* records */

static size_t roundUp(size_t size) {
    return (size + ME_CACHE_LINE - 1) & ~(size_t)(ME_CACHE_LINE - 1);
}

static void appendFree(MdtPool *pool, MdtRecord *record) {
    MEASSERT((pool->firstFree == NULL) == (pool->lastFree == NULL) && !record->free);
    if (pool->lastFree)
        pool->lastFree->free = record;
    else
        pool->firstFree = record;
    pool->lastFree = record;
}

static MeBool addBlock(MdtPool *pool, int count, const char *caller) {
    MEASSERT(count > 0 && pool->numFresh == 0);
    const size_t head = roundUp(sizeof(void *)), records = (size_t)count;
    const size_t bytes = records <= (SIZE_MAX - head) / pool->recordSize ? head + records * pool->recordSize : SIZE_MAX;
    char *block = MeMemoryTakeAligned(bytes, 1, ME_CACHE_LINE, caller, pool->what);
    if (!block)
        return MEFALSE;
    memcpy(block, &pool->blocks, sizeof pool->blocks);
    pool->blocks = block;
    pool->fresh = block + head;
    pool->numFresh = count;
    pool->room += count;
    return METRUE;
}

MeBool mdt_poolInit(MdtPool *pool, const char *caller) {
    pool->recordSize = roundUp(pool->recordSize);
    MEASSERT(pool->recordSize >= sizeof(MdtRecord) && !pool->blocks);
    return pool->limit.max == 0 || pool->limit.max == MeNoLimit || addBlock(pool, pool->limit.max, caller);
}

void mdt_poolTerm(MdtPool *pool) {
    while (pool->blocks) {
        void *block = pool->blocks;
        memcpy(&pool->blocks, block, sizeof pool->blocks);
        MeMemoryGiveAligned(block);
    }
    memset(pool, 0, sizeof *pool);
}

static MeBool growPool(MdtPool *pool, const char *caller) {
    char what[40];
    MEASSERT(pool->used == pool->room);
    if (pool->limit.max == MeNoLimit)
        return addBlock(pool, pool->room > 0 ? pool->room : FIRST_BLOCK, caller);
    snprintf(what, sizeof what, "more %s", pool->what);
    MeLimitWarn(&pool->limit, caller, what);
    return MEFALSE;
}

static MdtRecord *popFresh(MdtPool *pool) {
    MdtRecord *record = (MdtRecord *)(void *)pool->fresh;
    MEASSERT(pool->numFresh > 0 && (uintptr_t)pool->fresh % ME_CACHE_LINE == 0);
    pool->fresh += pool->recordSize;
    pool->numFresh--;
    return record;
}

static MdtRecord *popFreed(MdtPool *pool) {
    MdtRecord *record = pool->firstFree;
    MEASSERT(record->magic == 0);
    pool->firstFree = record->free;
    if (!pool->firstFree)
        pool->lastFree = NULL;
    return record;
}

void *mdt_poolGet(MdtPool *pool, unsigned int magic, const char *caller) {
    if (!MeProgramMayChange(caller) || (!pool->numFresh && !pool->firstFree && !growPool(pool, caller)))
        return NULL;
    MdtRecord *record = pool->numFresh ? popFresh(pool) : popFreed(pool);
    MEASSERT(pool->used < pool->room);
    memset(record, 0, pool->recordSize);
    record->magic = magic;
    MeHandleEnter(&record->handle, record, magic);
    pool->used++;
    return record;
}

void mdt_poolPut(MdtPool *pool, void *freed) {
    MdtRecord *record = freed;
    MEASSERT(record->magic != 0 && pool->used > 0);
    MeHandleLeave(&record->handle);
    record->magic = 0;
    record->free = NULL;
    appendFree(pool, record);
    pool->used--;
}

static MeBool isBefore(const MdtLink *a, const MdtLink *b) {
    return a->sortKey != b->sortKey ? a->sortKey < b->sortKey : a->serial < b->serial;
}

/* True if the links of the list agree in both directions, its count is right, and it is sorted if isSorted. */
static MeBool isConsistent(const MdtList *list) {
    int count = 0;
    const MdtLink *previous = NULL;
    for (const MdtLink *link = list->first; link; previous = link, link = link->next, count++)
        if (link->previous != previous || (previous && list->isSorted && !isBefore(previous, link)))
            return MEFALSE;
    return list->last == previous && list->count == count;
}

void mdt_listAppend(MdtList *list, MdtLink *link, unsigned long serial) {
    MEASSERT((list->count == 0) == (list->last == NULL));
    link->serial = serial;
    link->next = NULL;
    link->previous = list->last;
    if (list->last) {
        list->last->next = link;
        list->isSorted = list->isSorted && isBefore(list->last, link);
    } else {
        list->first = link;
        list->isSorted = METRUE;
    }
    list->last = link;
    list->count++;
    MEASSERT(list->first && !list->last->next);
}

void mdt_listRemove(MdtList *list, MdtLink *link) {
    MEASSERT(list->count > 0 && (link->previous ? link->previous->next : list->first) == link);
    MEASSERT((link->next ? link->next->previous : list->last) == link);
    if (link->previous)
        link->previous->next = link->next;
    else
        list->first = link->next;
    if (link->next)
        link->next->previous = link->previous;
    else
        list->last = link->previous;
    list->count--;
    MEASSERT((list->count == 0) == (list->first == NULL));
}

void mdt_listSetKey(MdtList *list, MdtLink *link, MeI32 key) {
    if (link->sortKey == key)
        return;
    link->sortKey = key;
    list->isSorted = MEFALSE;
}

/* Moves the smaller one of the heads of two runs to the end of the merged list. Returns the new end. */
static MdtLink **mergeSmaller(MdtLink **end, MdtLink **a, MdtLink **b) {
    MdtLink **from = *b == NULL || (*a && isBefore(*a, *b)) ? a : b;
    *end = *from;
    *from = (*from)->next;
    return &(*end)->next;
}

/* Cuts a run off behind `length` links and returns the links behind the cut. */
static MdtLink *cutRunAfter(MdtLink *run, int length) {
    for (int i = 1; run && i < length; i++)
        run = run->next;
    if (!run)
        return NULL;
    MdtLink *rest = run->next;
    run->next = NULL;
    return rest;
}

/* One pass of the bottom-up merge sort: pairs of runs of `length` links become one. Returns the number of merged
 * runs. */
static int mergeRuns(MdtLink **first, int length) {
    MdtLink *rest = *first, **end = first;
    int runs = 0;
    while (rest) {
        MdtLink *a = rest, *b = cutRunAfter(a, length);
        rest = cutRunAfter(b, length);
        while (a || b)
            end = mergeSmaller(end, &a, &b);
        runs++;
    }
    *end = NULL;
    return runs;
}

void mdt_listSort(MdtList *list) {
    MEVALIDATE(isConsistent(list));
    if (list->isSorted)
        return;
    for (int length = 1; mergeRuns(&list->first, length) > 1; length *= 2) {
    }
    MdtLink *previous = NULL;
    for (MdtLink *link = list->first; link; link = link->next) {
        link->previous = previous;
        previous = link;
    }
    list->last = previous;
    list->isSorted = METRUE;
    MEVALIDATE(isConsistent(list));
}
