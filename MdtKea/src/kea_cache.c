/* Factors for the graphs that have come up: a partition whose bodies are joined as before finds its own again, and so
 * do all partitions that look alike. The least recently used one makes room. */
#include "kea_problem_i.h"
#include "MeMemory.h"
#include <string.h>

enum { MAX_FACTORS = 64 };

typedef struct Entry {
    KeaFactor *factor;
    unsigned long used;
} Entry;

struct MdtKeaCache {
    Entry entry[MAX_FACTORS];
    unsigned long clock;
    int *size, room; /* the sizes of a graph of bodies: 6 each */
};

MdtKeaCache *MEAPI MdtKeaCacheCreate(void) {
    MdtKeaCache *c = MeMemoryAPI.create(sizeof *c);
    if (c)
        memset(c, 0, sizeof *c);
    return c;
}

void MEAPI MdtKeaCacheDestroy(MdtKeaCache *c) {
    if (!c)
        return;
    for (int i = 0; i < MAX_FACTORS; i++)
        if (c->entry[i].factor)
            kea_factorDestroy(c->entry[i].factor);
    if (c->size)
        MeMemoryAPI.destroy(c->size);
    MeMemoryAPI.destroy(c);
}

static MeBool makeSizes(MdtKeaCache *c, int n) {
    if (c->room >= n)
        return METRUE;
    int *size = MeMemoryAPI.create((size_t)(2 * n) * sizeof *size);
    if (!size)
        return MEFALSE;
    if (c->size)
        MeMemoryAPI.destroy(c->size);
    c->size = size;
    c->room = 2 * n;
    for (int i = 0; i < c->room; i++)
        size[i] = 6;
    return METRUE;
}

KeaFactor *kea_cacheFind(MdtKeaCache *c, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    Entry *oldest = &c->entry[0];
    if (!size && !makeSizes(c, numNodes))
        return NULL;
    size = size ? size : c->size;
    c->clock++;
    for (int i = 0; i < MAX_FACTORS; i++) {
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
