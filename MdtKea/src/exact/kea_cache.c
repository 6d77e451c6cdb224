/* Factors for the graphs that have come up: a partition whose bodies are joined as before finds its own again, and so
 * do all partitions that look alike. The least recently used one makes room. */
#include "common/kea_problem_i.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "common/kea_policy_i.h"

typedef struct Entry {
    KeaFactor *factor;
    unsigned long used;
} Entry;

struct MdtKeaCache {
    Entry entry[KEA_MAX_FACTORS];
    unsigned long clock;
    int *size, room; /* the sizes of a graph of bodies: 6 each */
};

MdtKeaCache *MEAPI MdtKeaCacheCreate(void) {
    return MeMemoryTakeZeroed(1, sizeof(MdtKeaCache), "MdtKeaCacheCreate", "the cache of factors");
}

void MEAPI MdtKeaCacheDestroy(MdtKeaCache *c) {
    if (!c)
        return;
    for (int i = 0; i < KEA_MAX_FACTORS; i++)
        if (c->entry[i].factor)
            kea_factorDestroy(c->entry[i].factor);
    MeMemoryGive(c->size);
    MeMemoryGive(c);
}

static MeBool makeSizes(MdtKeaCache *c, int n) {
    if (c->room >= n)
        return METRUE;
    if (!MeMemoryGrow(&c->size, 0, (size_t)(2 * n), sizeof *c->size, "MdtKeaSolve", "sizes of a graph"))
        return MEFALSE;
    c->room = 2 * n;
    for (int i = 0; i < c->room; i++)
        c->size[i] = 6;
    return METRUE;
}

KeaFactor *kea_cacheFind(MdtKeaCache *c, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    Entry *oldest = &c->entry[0];
    if (!size && !makeSizes(c, numNodes))
        return NULL;
    size = size ? size : c->size;
    c->clock++;
    for (int i = 0; i < KEA_MAX_FACTORS; i++) {
        Entry *e = &c->entry[i];
        if (e->factor && kea_factorMatches(e->factor, numNodes, size, numEdges, edges)) {
            e->used = c->clock;
            return e->factor;
        }
        if (e->used < oldest->used)
            oldest = e;
    }
    if (oldest->factor)
        kea_factorDestroy(oldest->factor);
    oldest->factor = kea_factorCreate(numNodes, size, numEdges, edges);
    oldest->used = c->clock;
    return oldest->factor;
}
