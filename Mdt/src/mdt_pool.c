/* Pools of records, and the sorted lists of what is in use. */
#include "mdt_i.h"
#include <stdint.h>
#include <string.h>

MeBool mdt_poolInit(MdtPool *pool, int count, size_t recordSize) {
    memset(pool, 0, sizeof *pool);
    pool->recordSize = (recordSize + 15) & ~(size_t)15;
    pool->count = count;
    if (count == 0)
        return METRUE;
    pool->memory = MeMemoryAPI.createAligned((size_t)count * pool->recordSize, 16);
    if (!pool->memory)
        return MEFALSE;
    memset(pool->memory, 0, (size_t)count * pool->recordSize);
    for (int i = 0; i < count; i++)
        mdt_poolPut(pool, pool->memory + (size_t)i * pool->recordSize);
    pool->used = 0;
    return METRUE;
}

void mdt_poolTerm(MdtPool *pool) {
    if (pool->memory)
        MeMemoryAPI.destroyAligned(pool->memory);
    memset(pool, 0, sizeof *pool);
}

void *mdt_poolGet(MdtPool *pool, unsigned int magic) {
    MdtRecord *record = pool->firstFree;
    if (!record)
        return NULL;
    pool->firstFree = record->free;
    if (!pool->firstFree)
        pool->lastFree = NULL;
    memset(record, 0, pool->recordSize);
    record->magic = magic;
    pool->used++;
    return record;
}

void mdt_poolPut(MdtPool *pool, void *freed) {
    MdtRecord *record = freed;
    record->magic = 0;
    record->free = NULL;
    if (pool->lastFree)
        pool->lastFree->free = record;
    else
        pool->firstFree = record;
    pool->lastFree = record;
    pool->used--;
}

MeBool mdt_poolOwns(const MdtPool *pool, const void *record) {
    const uintptr_t at = (uintptr_t)record, start = (uintptr_t)pool->memory;
    const size_t size = (size_t)pool->count * pool->recordSize;
    return pool->memory && at >= start && at - start < size && (at - start) % pool->recordSize == 0;
}

static MeBool isBefore(const MdtLink *a, const MdtLink *b) {
    return a->sortKey != b->sortKey ? a->sortKey < b->sortKey : a->serial < b->serial;
}

void mdt_listAppend(MdtList *list, MdtLink *link, void *owner, unsigned long serial) {
    link->owner = owner;
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
}

void mdt_listRemove(MdtList *list, MdtLink *link) {
    if (link->previous)
        link->previous->next = link->next;
    else
        list->first = link->next;
    if (link->next)
        link->next->previous = link->previous;
    else
        list->last = link->previous;
    list->count--;
}

void mdt_listSetKey(MdtList *list, MdtLink *link, MeI32 key) {
    if (link->sortKey == key)
        return;
    link->sortKey = key;
    list->isSorted = MEFALSE;
}

/* Takes the smaller head of two runs and appends it to the list that is being built. */
static MdtLink **takeSmaller(MdtLink **end, MdtLink **a, MdtLink **b) {
    MdtLink **from = *b == NULL || (*a && isBefore(*a, *b)) ? a : b;
    *end = *from;
    *from = (*from)->next;
    return &(*end)->next;
}

static MdtLink *cutAfter(MdtLink *run, int length) {
    for (int i = 1; run && i < length; i++)
        run = run->next;
    if (!run)
        return NULL;
    MdtLink *rest = run->next;
    run->next = NULL;
    return rest;
}

/* One pass of the bottom-up merge sort: runs of `length` become runs of twice that. Returns how many runs there were.
 * */
static int mergeRuns(MdtLink **first, int length) {
    MdtLink *rest = *first, **end = first;
    int runs = 0;
    while (rest) {
        MdtLink *a = rest, *b = cutAfter(a, length);
        rest = cutAfter(b, length);
        while (a || b)
            end = takeSmaller(end, &a, &b);
        runs++;
    }
    *end = NULL;
    return runs;
}

void mdt_listSort(MdtList *list) {
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
}
