/* The pool of a framework's scratches: a free list, protected by a spin lock that is held for a few instructions. */
#include "surface/mcd_scratch_i.h"
#include <string.h>

static void lock(McdFramework *frame) {
    while (atomic_exchange_explicit(&frame->scratchIsLocked, 1, memory_order_acquire)) {
    }
}

static void unlock(McdFramework *frame) {
    atomic_store_explicit(&frame->scratchIsLocked, 0, memory_order_release);
}

McdScratch *mcd_scratchAcquire(McdFramework *frame, const char *function) {
    lock(frame);
    McdScratch *scratch = frame->freeScratch;
    if (scratch)
        frame->freeScratch = scratch->next;
    unlock(frame);
    if (!scratch)
        scratch = MeMemoryTakeZeroed(1, sizeof *scratch, function, "a query");
    if (scratch)
        scratch->next = 0;
    return scratch;
}

static MeBool areTrianglesZero(const McdScratch *s) {
    const unsigned char *byte = (const unsigned char *)s->triangle;
    for (size_t i = 0; i < (size_t)s->triangleRoom * sizeof *s->triangle; i++)
        if (byte[i])
            return MEFALSE;
    return METRUE;
}

void mcd_scratchRelease(McdFramework *frame, McdScratch *scratch) {
    MEVALIDATE(areTrianglesZero(scratch));
    lock(frame);
    MEASSERT(frame->freeScratch != scratch && !scratch->next);
    scratch->next = frame->freeScratch;
    frame->freeScratch = scratch;
    unlock(frame);
}

static void freeMesh(McdMesh *mesh) {
    void *block[] = {mesh->triangle,     mesh->place, mesh->slot,    mesh->cornerOf, mesh->firstOf,
                     mesh->usersOf,      mesh->fan,   mesh->contact, mesh->cluster,  mesh->merged,
                     mesh->contactOrder, mesh->spots, mesh->sites,   mesh->kept};
    for (size_t i = 0; i < sizeof block / sizeof *block; i++)
        MeMemoryGive(block[i]);
    memset(mesh, 0, sizeof *mesh);
}

void mcd_scratchFreeAll(McdFramework *frame) {
    while (frame->freeScratch) {
        McdScratch *scratch = frame->freeScratch;
        frame->freeScratch = scratch->next;
        freeMesh(&scratch->mesh);
        MeMemoryGive(scratch->triangle);
        MeMemoryGive(scratch->contact);
        MeMemoryGive(scratch->choice);
        MeMemoryGive(scratch->manifold);
        MeMemoryGive(scratch->near);
        MeMemoryGive(scratch->nearChild);
        MeMemoryGive(scratch->nearModel);
        MeMemoryGive(scratch->number);
        MeMemoryGive(scratch);
    }
}

MeBool mcd_scratchReserveContacts(McdScratch *s, int used, int count) {
    if (count <= s->contactRoom)
        return METRUE;
    const int room = MeMAX(count, 2 * s->contactRoom);
    void *choice = MeMemoryTake(1, mcd_simplifyBytes(room), "McdIntersect", "the choice of contacts");
    if (!choice ||
        !MeMemoryGrow(&s->contact, (size_t)used, (size_t)room, sizeof *s->contact, "McdIntersect", "contacts")) {
        MeMemoryGive(choice);
        return MEFALSE;
    }
    MeMemoryGive(s->choice);
    s->choice = choice;
    s->contactRoom = room;
    return METRUE;
}

MeBool mcd_scratchReserveTriangles(McdScratch *s, int count) {
    if (count <= s->triangleRoom)
        return METRUE;
    if (!MeMemoryGrow(&s->triangle, 0, (size_t)count, sizeof *s->triangle, "McdIntersect", "triangles"))
        return MEFALSE;
    memset(s->triangle, 0, (size_t)count * sizeof *s->triangle);
    s->triangleRoom = count;
    return METRUE;
}

MeBool mcd_scratchReserveNumbers(McdScratch *s, int used, int count) {
    if (count <= s->numberRoom)
        return METRUE;
    const int room = MeMAX(count, 2 * s->numberRoom);
    if (!MeMemoryGrow(&s->number, (size_t)used, (size_t)room, sizeof *s->number, "McdIntersect",
                      "numbers of triangles"))
        return MEFALSE;
    s->numberRoom = room;
    return METRUE;
}

MeBool mcd_scratchReserveManifolds(McdScratch *s, int count) {
    const int room = MeMAX(count, 2 * s->manifoldRoom);
    if (count <= s->manifoldRoom)
        return METRUE;
    if (!MeMemoryGrow(&s->manifold, 0, (size_t)room, sizeof *s->manifold, "McdIntersect", "manifolds of parts"))
        return MEFALSE;
    s->manifoldRoom = room;
    return METRUE;
}
