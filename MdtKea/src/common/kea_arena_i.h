/* Carving arrays out of one block of memory. With no block it only measures how much they need. */
#ifndef KEA_ARENA_I_H
#define KEA_ARENA_I_H

#include <stddef.h>

typedef struct KeaArena {
    char *base; /* null: measure */
    size_t used;
} KeaArena;

static inline void *kea_carve(KeaArena *a, size_t count, size_t size) {
    void *at = a->base ? a->base + a->used : NULL;
    a->used += (count * size + 15) & ~(size_t)15;
    return at;
}

#endif
