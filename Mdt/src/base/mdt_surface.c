/* Surfaces: the contact parameters, stored once for all contacts with the same values (mdt_surface_i.h). */
#include "base/mdt_surface_i.h"
#include "MeAssert.h"
#include <string.h>

enum { BLOCK = 16 }; /* surfaces of a block, and buckets at first */

typedef struct MdtSurfaceBlock {
    struct MdtSurfaceBlock *next;
    MdtSurface surface[BLOCK];
} MdtSurfaceBlock;

/* Hash: FNV-1a, 64 bits (Fowler, Noll, Vo). */
static MdtSurface **bucketOf(const MdtSurfaces *s, const MdtBclContactParams *params) {
    const unsigned char *bytes = (const unsigned char *)params;
    MEASSERT(s->numBuckets > 0 && (s->numBuckets & (s->numBuckets - 1)) == 0);
    MeU64 hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < sizeof *params; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return &s->bucket[hash & (MeU64)(s->numBuckets - 1)];
}

static void linkSurface(MdtSurfaces *s, MdtSurface *surface) {
    MdtSurface **bucket = bucketOf(s, &surface->params);
    surface->next = *bucket;
    *bucket = surface;
}

static MeBool addBlock(MdtSurfaces *s, const char *caller) {
    MdtSurfaceBlock *block = MeMemoryTakeZeroed(1, sizeof *block, caller, "surfaces");
    if (!block)
        return MEFALSE;
    block->next = s->blocks;
    s->blocks = block;
    for (int i = 0; i < BLOCK; i++) {
        block->surface[i].next = s->firstFree;
        s->firstFree = &block->surface[i];
    }
    return METRUE;
}

/* Doubles the buckets: there is at most one surface per bucket on average. */
static void addBuckets(MdtSurfaces *s, const char *caller) {
    const MdtSurfaces old = *s;
    MdtSurface **bucket = MeMemoryTakeZeroed(2 * (size_t)s->numBuckets, sizeof(MdtSurface *), caller, "surfaces");
    if (!bucket)
        return; /* the table still works, with longer chains */
    s->bucket = bucket;
    s->numBuckets *= 2;
    for (int i = 0; i < old.numBuckets; i++)
        for (MdtSurface *surface = old.bucket[i], *next; surface; surface = next) {
            next = surface->next;
            linkSurface(s, surface);
        }
    MeMemoryGive(old.bucket);
}

MeBool mdt_surfacesInit(MdtSurfaces *s, MeReal lengthScale, const char *caller) {
    MdtBclContactParamsReset(&s->standard.params);
    s->standard.params.velThreshold *= lengthScale;
    s->standard.users = 1; /* the world itself */
    s->bucket = MeMemoryTakeZeroed(BLOCK, sizeof(MdtSurface *), caller, "surfaces");
    s->numBuckets = BLOCK;
    if (!s->bucket || !addBlock(s, caller))
        return MEFALSE;
    linkSurface(s, &s->standard);
    return METRUE;
}

void mdt_surfacesTerm(MdtSurfaces *s) {
    for (MdtSurfaceBlock *block = s->blocks, *next; block; block = next) {
        next = block->next;
        MeMemoryGive(block);
    }
    MeMemoryGive(s->bucket);
}

const MdtSurface *mdt_surfaceAcquire(MdtSurfaces *s, const MdtBclContactParams *params) {
    static const char caller[] = "MdtContactSetParams";
    for (MdtSurface *known = *bucketOf(s, params); known; known = known->next)
        if (memcmp(&known->params, params, sizeof *params) == 0) {
            known->users++;
            return known;
        }
    if (!s->firstFree && !addBlock(s, caller)) {
        s->standard.users++;
        return &s->standard;
    }
    if (s->count >= s->numBuckets)
        addBuckets(s, caller);
    MdtSurface *surface = s->firstFree;
    MEASSERT(surface && surface->users == 0);
    s->firstFree = surface->next;
    memcpy(&surface->params, params, sizeof *params); /* with the padding, since surfaces are compared as bytes */
    surface->users = 1;
    s->count++;
    linkSurface(s, surface);
    return surface;
}

void mdt_surfaceRelease(MdtSurfaces *s, const MdtSurface *given) {
    MdtSurface **at = bucketOf(s, &given->params);
    while (*at != given) {
        MEASSERT(*at); /* it is in its bucket */
        at = &(*at)->next;
    }
    MdtSurface *surface = *at;
    MEASSERT(surface->users > 0);
    if (--surface->users > 0)
        return;
    MEASSERT(surface != &s->standard);
    *at = surface->next;
    surface->next = s->firstFree;
    s->firstFree = surface;
    MEASSERT(s->count > 0);
    s->count--;
}
