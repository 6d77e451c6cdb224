/* A cache of symbolic factorizations by graph: a partition whose graph has not changed reuses its factor, and
 * partitions with equal graphs share one. The least recently used one is replaced.
 *
 * A cache owns the memory of all factors, in blocks that double when they grow and are never released before it is
 * destroyed: if graphs are no larger than earlier ones, nothing is allocated. Structures are stored one behind the
 * other in one block. When the block is full, the structures still in use are compacted, and the block grows so that at
 * most half of it is used: on average no more bytes are moved than written.
 */
#include "MdtKea.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "common/kea_policy_i.h"
#include "inner/kea_structure_i.h"
#include <string.h>

typedef struct Entry {
    KeaFactor factor;   /* callers keep its address: it never moves */
    size_t at, bytes;   /* offset and size of its structure; 0 bytes: the entry is empty */
    unsigned long used; /* clock when it was last used */
} Entry;

struct MdtKeaCache {
    Entry entry[KEA_MAX_FACTORS];
    unsigned long clock;
    KeaOrder order; /* scratch */
    KeaBlock structures;
    size_t end; /* end of the last structure in this block */
    KeaNumbers numbers;
    KeaBlock sizes;                   /* sizes of a graph of bodies: 6 for each node */
    int numSizes;                     /* number of sizes written so far */
    KeaBlock passes[KEA_PASS_BLOCKS]; /* scratch of the fast solver */
};

MdtKeaCache *MEAPI MdtKeaCacheCreate(void) {
    return MeMemoryTakeZeroed(1, sizeof(MdtKeaCache), "MdtKeaCacheCreate", "the cache of factors");
}

void MEAPI MdtKeaCacheDestroy(MdtKeaCache *c) {
    if (!c)
        return;
    kea_orderFree(&c->order);
    kea_blockFree(&c->structures);
    kea_blockFree(&c->numbers.block);
    kea_blockFree(&c->sizes);
    for (int i = 0; i < KEA_PASS_BLOCKS; i++)
        kea_blockFree(&c->passes[i]);
    MeMemoryGive(c);
}

/* ---- the memory of structures ---- */

/* The entry with the first structure at or after the offset `at`, or null. */
static Entry *nextStructure(MdtKeaCache *c, size_t at) {
    Entry *next = NULL;
    for (int i = 0; i < KEA_MAX_FACTORS; i++) {
        Entry *e = &c->entry[i];
        if (e->bytes > 0 && e->at >= at && (!next || e->at < next->at))
            next = e;
    }
    return next;
}

/* Moves all structures in use to the front of their block. */
static void compactStructures(MdtKeaCache *c) {
    size_t end = 0;
    for (Entry *e = nextStructure(c, 0); e; e = nextStructure(c, end)) {
        MEASSERT(e->at >= end);
        memmove(c->structures.memory + end, c->structures.memory + e->at, e->bytes);
        e->at = end;
        end += e->bytes;
    }
    MEASSERT(end <= c->end);
    c->end = end;
}

/* Reserves bytes at the end of the block of structures; if it grows, to twice what is used then. False: no memory. */
static MeBool reserveStructure(MdtKeaCache *c, size_t bytes) {
    if (c->structures.memory && c->end + bytes <= c->structures.size)
        return METRUE;
    compactStructures(c);
    const MeBool hasMemory =
        kea_blockReserve(&c->structures, c->end, 2 * (c->end + bytes), "the structures of factors");
    for (int i = 0; i < KEA_MAX_FACTORS; i++)
        if (c->entry[i].bytes > 0)
            kea_structureLayOut(&c->entry[i].factor, c->structures.memory + c->entry[i].at);
    return hasMemory;
}

/* ---- factors ---- */

/* Orders and analyses a graph, and stores its structure in the entry. False: no memory. */
static MeBool createFactor(MdtKeaCache *c, Entry *e, int numNodes, const int size[], int numEdges,
                           const int (*edges)[2]) {
    KeaFactor plan;
    e->bytes = 0;
    if (!kea_orderFind(&c->order, numNodes, size, numEdges, edges))
        return MEFALSE;
    const size_t bytes = kea_structurePlan(&plan, &c->order, size, numEdges, edges);
    if (!reserveStructure(c, bytes))
        return MEFALSE;
    e->factor = plan;
    e->factor.numbers = &c->numbers;
    e->at = c->end;
    e->bytes = bytes;
    c->end += bytes;
    MEASSERT(c->end <= c->structures.size);
    kea_structureWrite(&e->factor, c->structures.memory + e->at, &c->order, size, edges);
    return METRUE;
}

/* Reserves memory for the numbers of a factor; no factor owns it then. False: no memory. */
static MeBool reserveNumbers(MdtKeaCache *c, KeaFactor *f) {
    c->numbers.owner = NULL;
    return kea_blockReserve(&c->numbers.block, 0, kea_structureLayOutNumbers(f, NULL), "the numbers of a factor");
}

/* The sizes of a graph of n bodies. Null: no memory. */
static const int *bodySizes(MdtKeaCache *c, int n) {
    if (!kea_blockReserve(&c->sizes, (size_t)c->numSizes * sizeof(int), (size_t)n * sizeof(int), "sizes of a graph"))
        return NULL;
    int *size = (int *)(void *)c->sizes.memory;
    for (; c->numSizes < n; c->numSizes++)
        size[c->numSizes] = 6;
    return size;
}

static Entry *findEntry(MdtKeaCache *c, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    for (int i = 0; i < KEA_MAX_FACTORS; i++) {
        Entry *e = &c->entry[i];
        if (e->bytes > 0 && kea_factorMatches(&e->factor, numNodes, size, numEdges, edges))
            return e;
    }
    return NULL;
}

static Entry *oldestEntry(MdtKeaCache *c) {
    Entry *oldest = &c->entry[0];
    for (int i = 1; i < KEA_MAX_FACTORS; i++)
        if (c->entry[i].used < oldest->used)
            oldest = &c->entry[i];
    return oldest;
}

KeaFactor *kea_cacheFind(MdtKeaCache *c, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    size = size ? size : bodySizes(c, numNodes);
    if (!size)
        return NULL;
    Entry *e = findEntry(c, numNodes, size, numEdges, edges);
    if (!e) {
        e = oldestEntry(c);
        if (!createFactor(c, e, numNodes, size, numEdges, edges))
            return NULL;
    }
    e->used = ++c->clock;
    return reserveNumbers(c, &e->factor) ? &e->factor : NULL;
}

void *kea_cacheScratch(MdtKeaCache *c, int block, size_t bytes) {
    const size_t line = ME_CACHE_LINE;
    MEASSERT(block >= 0 && block < KEA_PASS_BLOCKS);
    if (!kea_blockReserve(&c->passes[block], 0, bytes + line, "the fast solver"))
        return NULL;
    const uintptr_t at = (uintptr_t)c->passes[block].memory;
    return c->passes[block].memory + (line - at % line) % line;
}
