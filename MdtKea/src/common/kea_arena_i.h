/* Arena allocation: arrays within one block of memory; and blocks that grow. */
#ifndef KEA_ARENA_I_H
#define KEA_ARENA_I_H

#include "MeInternal.h"
#include <stddef.h>

/* Without a block, kea_carve only sums up the bytes that the arrays need. */
typedef struct KeaArena {
    char *base; /* null: measure */
    size_t used;
} KeaArena;

static inline void *kea_carve(KeaArena *a, size_t count, size_t size) {
    void *at = a->base ? a->base + a->used : NULL;
    a->used += (count * size + 15) & ~(size_t)15;
    return at;
}

/* Sets `array` to `count` elements of its type. */
#define KEA_CARVE(arena, array, count) ((array) = kea_carve(arena, count, sizeof *(array)))

/* Reused memory. It grows to twice the requested size, so that later requests up to that allocate nothing. */
typedef struct KeaBlock {
    char *memory;
    size_t size;
} KeaBlock;

/* Grows the block to at least `bytes`; the first `kept` bytes keep their contents; the block may move. False: no
 * memory, and the block is unchanged. `what` names the block in the message. */
static inline MeBool kea_blockReserve(KeaBlock *b, size_t kept, size_t bytes, const char *what) {
    if (b->memory && bytes <= b->size)
        return METRUE;
    if (!MeMemoryGrow(&b->memory, kept, 2 * bytes, 1, "MdtKeaSolve", what))
        return MEFALSE;
    b->size = 2 * bytes;
    return METRUE;
}

static inline void kea_blockFree(KeaBlock *b) {
    MeMemoryGive(b->memory);
    *b = (KeaBlock){NULL, 0};
}

#endif
