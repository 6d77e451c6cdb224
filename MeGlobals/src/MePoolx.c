/* Pools of records of one size in the program's memory. */
#include "MePoolx.h"

#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <stdint.h>
#include <string.h>

static MeBool isPool(const MePoolx *p, const char *function) {
    if (!me_isGiven(p, "pool", function))
        return MEFALSE;
    MEASSERT(p->used >= 0 && p->used <= p->begun && p->begun <= p->count);
    return METRUE;
}

void MEAPI MePoolxInit(MePoolx *p, void *memory, int recsize, int numrec) {
    if (!me_isGiven(p, "pool", __func__))
        return;
    memset(p, 0, sizeof *p);
    if (!memory || recsize < (int)sizeof(void *) || numrec < 0) {
        MeWarning(1, "MePoolxInit: %d records of %d bytes (%d or more) at %p", numrec, recsize, (int)sizeof(void *),
                  memory);
        return;
    }
    p->memory = memory;
    p->size = recsize;
    p->count = numrec;
}

void *MEAPI MePoolxGet(MePoolx *p) {
    if (!isPool(p, __func__) || p->used == p->count)
        return NULL;
    void *record = p->firstFree;
    if (record)
        memcpy(&p->firstFree, record, sizeof(void *));
    else
        record = p->memory + (size_t)p->begun++ * (size_t)p->size;
    p->used++;
    MEASSERT((char *)record >= p->memory && (char *)record < p->memory + (size_t)p->count * (size_t)p->size);
    return record;
}

void *MEAPI MePoolxGetZeroed(MePoolx *p) {
    void *record;
    ME_UNDER_OWN_NAME(record = MePoolxGet(p));
    return record ? memset(record, 0, (size_t)p->size) : NULL;
}

void MEAPI MePoolxPut(MePoolx *p, void *rec) {
    if (!rec || !isPool(p, __func__))
        return;
    const uintptr_t offset = (uintptr_t)rec - (uintptr_t)p->memory;
    if (!p->used || offset % (uintptr_t)p->size || offset / (uintptr_t)p->size >= (uintptr_t)p->begun) {
        MeWarning(1, "MePoolxPut: %p is none of the pool's records that are out", rec);
        return;
    }
    memcpy(rec, &p->firstFree, sizeof(void *));
    p->firstFree = rec;
    p->used--;
}

static MeDictNode *MEAPI getNode(void *context) {
    return MePoolxGetZeroed(context);
}

static void MEAPI putNode(MeDictNode *node, void *context) {
    MePoolxPut(context, node);
}

void MEAPI MePoolxUseWithDict(MePoolx *p, struct MeDict *d) {
    if (!isPool(p, __func__))
        return;
    if (p->count && p->size < (int)sizeof(MeDictNode))
        MeWarning(1, "MePoolxUseWithDict: a record has %d bytes, a node %d", p->size, (int)sizeof(MeDictNode));
    else
        MeDictSetAllocator(d, getNode, putNode, p);
}
