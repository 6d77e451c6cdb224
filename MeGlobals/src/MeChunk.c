/* A growing scratch buffer. */
#include "MeChunk.h"

#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "MeMessage_i.h"
#include <limits.h>

static const int firstSize = 1024;

static MeBool isPowerOfTwo(int n) {
    return n > 0 && (n & (n - 1)) == 0;
}

static void freeMemory(MeChunk *chunk) {
    MEASSERT((chunk->mem == NULL) == (chunk->size == 0));
    MeMemoryGiveAligned(chunk->mem);
    chunk->mem = NULL;
    chunk->size = 0;
}

/* Grows the chunk to at least `size` bytes; false if out of memory. */
static MeBool reserve(MeChunk *chunk, int size, const char *function) {
    MEASSERT(!chunk->inUse);
    if (chunk->mem != NULL && chunk->size >= size)
        return METRUE;
    int newSize = MeMAX(chunk->size, firstSize);
    while (newSize < size)
        newSize = newSize > INT_MAX / 2 ? size : 2 * newSize;
    freeMemory(chunk);
    chunk->mem = MeMemoryTakeAligned((size_t)newSize, 1, (unsigned int)chunk->alignment, function, "a chunk");
    if (chunk->mem == NULL)
        return MEFALSE;
    chunk->size = newSize;
    MEASSERT(chunk->size >= size);
    MEASSERTALIGNED(chunk->mem, chunk->alignment);
    return METRUE;
}

void MEAPI MeChunkInit(MeChunk *chunk, int alignment) {
    if (!me_isGiven(chunk, "chunk", "MeChunkInit"))
        return;
    if (!isPowerOfTwo(alignment)) {
        MeWarning(1, "MeChunkInit: alignment %d is not a power of 2, 16 is used", alignment);
        alignment = 16;
    }
    *chunk = (MeChunk){.alignment = alignment, .mode = kMeChunkModeKeepOnPut};
}

void MEAPI MeChunkTerm(MeChunk *chunk) {
    if (!me_isGiven(chunk, "chunk", "MeChunkTerm"))
        return;
    if (chunk->inUse)
        MeWarning(1, "MeChunkTerm: the memory is in use");
    freeMemory(chunk);
    MeChunkInit(chunk, chunk->alignment);
}

void MEAPI MeChunkSetMode(MeChunk *chunk, kMeChunkMode mode) {
    if (!me_isGiven(chunk, "chunk", "MeChunkSetMode"))
        return;
    if (mode != kMeChunkModeKeepOnPut && mode != kMeChunkModeFreeOnPut) {
        MeWarning(1, "MeChunkSetMode: %d is not a mode", (int)mode);
        return;
    }
    chunk->mode = mode;
}

/* Whether a block of this size may be allocated now. False: with a warning. */
static MeBool mayAllocate(const MeChunk *chunk, int size, const char *function) {
    if (!me_isGiven(chunk, "chunk", function))
        return MEFALSE;
    if (size < 0) {
        MeWarning(1, "%s: size %d is negative", function, size);
        return MEFALSE;
    }
    if (chunk->inUse) {
        MeWarning(1, "%s: the memory is in use", function);
        return MEFALSE;
    }
    return METRUE;
}

void MEAPI MeChunkSetAuto(MeChunk *chunk, int initialSize) {
    if (mayAllocate(chunk, initialSize, "MeChunkSetAuto"))
        reserve(chunk, initialSize, "MeChunkSetAuto");
}

void *MEAPI MeChunkGetMem(MeChunk *chunk, int size) {
    if (!mayAllocate(chunk, size, "MeChunkGetMem") || !reserve(chunk, size, "MeChunkGetMem"))
        return NULL;
    chunk->maxSize = MeMAX(chunk->maxSize, size);
    chunk->inUse = METRUE;
    MEASSERT(chunk->mem != NULL && chunk->size >= size);
    return chunk->mem;
}

void MEAPI MeChunkPutMem(MeChunk *chunk, void *mem) {
    if (!me_isGiven(chunk, "chunk", "MeChunkPutMem") || mem == NULL)
        return;
    if (!chunk->inUse || mem != chunk->mem) {
        MeWarning(1, "MeChunkPutMem: this memory is not in use");
        return;
    }
    chunk->inUse = MEFALSE;
    if (chunk->mode == kMeChunkModeFreeOnPut)
        freeMemory(chunk);
}

MeBool MEAPI MeChunkIsInUse(MeChunk *chunk) {
    return me_isGiven(chunk, "chunk", "MeChunkIsInUse") ? chunk->inUse : MEFALSE;
}

int MEAPI MeChunkGetCurrentSize(MeChunk *chunk) {
    return me_isGiven(chunk, "chunk", "MeChunkGetCurrentSize") ? chunk->size : 0;
}

int MEAPI MeChunkGetMaxSize(MeChunk *chunk) {
    return me_isGiven(chunk, "chunk", "MeChunkGetMaxSize") ? chunk->maxSize : 0;
}

int MEAPI MeChunkGetAlignment(MeChunk *chunk) {
    return me_isGiven(chunk, "chunk", "MeChunkGetAlignment") ? chunk->alignment : 0;
}
