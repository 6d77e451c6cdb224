/* The default memory functions, and calls of those that are set. */
#include "MeInternal.h"

#include "MeAssert.h"
#include "MeMessage.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* malloc(0) may return null, which would count as out of memory. */
static size_t nonZero(size_t bytes) {
    return bytes > 0 ? bytes : 1;
}

static void *MEAPI createDefault(size_t bytes) {
    return malloc(nonZero(bytes));
}

/* aligned_alloc needs a multiple of the alignment; malloc aligns for max_align_t. */
static void *MEAPI createAlignedDefault(size_t bytes, unsigned int alignment) {
    if (alignment <= _Alignof(max_align_t))
        return createDefault(bytes);
    if (bytes > SIZE_MAX - alignment)
        return NULL;
    return aligned_alloc(alignment, (nonZero(bytes) + alignment - 1) / alignment * alignment);
}

static void *MEAPI resizeDefault(void *const block, size_t bytes) {
    return realloc(block, nonZero(bytes));
}

static void MEAPI destroyDefault(void *const block) {
    free(block);
}

MeMemoryAPIStruct MeMemoryAPI = {createDefault, createAlignedDefault, resizeDefault, destroyDefault, destroyDefault};

/* ---- calls of the functions that are set: quiet callbacks, which may change nothing (MeInternal.h) ---- */

static void *callCreate(size_t bytes) {
    const MeProgramCall before = MeProgramEnterQuiet("MeMemoryAPI.create");
    void *const block = MeMemoryAPI.create(bytes);
    MeProgramLeave(&before);
    return block;
}

static void *callCreateAligned(size_t bytes, unsigned int alignment) {
    const MeProgramCall before = MeProgramEnterQuiet("MeMemoryAPI.createAligned");
    void *const block = MeMemoryAPI.createAligned(bytes, alignment);
    MeProgramLeave(&before);
    return block;
}

static void callDestroy(void *block) {
    const MeProgramCall before = MeProgramEnterQuiet("MeMemoryAPI.destroy");
    MeMemoryAPI.destroy(block);
    MeProgramLeave(&before);
}

/* ---- for all libraries, this one included (MeInternal.h) ---- */

/* The size of a block, at least 1; 0 on overflow. */
static size_t bytesOf(size_t count, size_t size) {
    return size > 0 && count > (SIZE_MAX - 1) / size ? 0 : nonZero(count * size);
}

static void *reportIfNoMemory(void *block, size_t count, size_t size, const char *function, const char *what) {
    if (block == NULL)
        MeFatalError(0, "%s: no memory for %s (%zu times %zu bytes)", MeCallerName(function), what, count, size);
    return block;
}

void *MEAPI MeMemoryTake(size_t count, size_t size, const char *function, const char *what) {
    const size_t bytes = bytesOf(count, size);
    return reportIfNoMemory(bytes > 0 ? callCreate(bytes) : NULL, count, size, function, what);
}

void *MEAPI MeMemoryTakeZeroed(size_t count, size_t size, const char *function, const char *what) {
    void *const block = MeMemoryTake(count, size, function, what);
    if (block != NULL)
        memset(block, 0, bytesOf(count, size));
    return block;
}

MeBool MEAPI MeMemoryGrow(void *block, size_t used, size_t count, size_t size, const char *function, const char *what) {
    void *old, *const larger = MeMemoryTake(count, size, function, what);
    if (larger == NULL)
        return MEFALSE;
    MEASSERT(used <= count);
    memcpy(&old, block, sizeof old); /* copied as bytes, as the pointer may be of any type */
    if (old != NULL && used > 0)
        memcpy(larger, old, used * size);
    memcpy(block, &larger, sizeof larger);
    MeMemoryGive(old);
    return METRUE;
}

void MEAPI MeMemoryGive(void *block) {
    if (block != NULL)
        callDestroy(block);
}

void *MEAPI MeMemoryTakeAligned(size_t count, size_t size, unsigned int alignment, const char *function,
                                const char *what) {
    MEASSERT(alignment > 0 && (alignment & (alignment - 1)) == 0);
    const size_t bytes = bytesOf(count, size);
    void *const block = bytes > 0 ? callCreateAligned(bytes, alignment) : NULL;
    return reportIfNoMemory(block, count, size, function, what);
}

void MEAPI MeMemoryGiveAligned(void *block) {
    if (block == NULL)
        return;
    const MeProgramCall before = MeProgramEnterQuiet("MeMemoryAPI.destroyAligned");
    MeMemoryAPI.destroyAligned(block);
    MeProgramLeave(&before);
}
