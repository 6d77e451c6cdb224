/* The default memory functions, and this library's use of those that are set. */
#include "MeMemory_i.h"

#include "MeMessage.h"
#include <stdint.h>
#include <stdlib.h>

/* malloc may answer a request for nothing with null, which here is to mean that there is no memory. */
static size_t atLeastOne(size_t bytes) {
    return bytes > 0 ? bytes : 1;
}

static void *MEAPI createDefault(size_t bytes) {
    return malloc(atLeastOne(bytes));
}

/* aligned_alloc wants a multiple of the alignment; all that malloc gives is aligned for max_align_t. */
static void *MEAPI createAlignedDefault(size_t bytes, unsigned int alignment) {
    if (alignment <= _Alignof(max_align_t))
        return createDefault(bytes);
    if (bytes > SIZE_MAX - alignment)
        return NULL;
    return aligned_alloc(alignment, (atLeastOne(bytes) + alignment - 1) / alignment * alignment);
}

static void *MEAPI resizeDefault(void *const block, size_t bytes) {
    return realloc(block, atLeastOne(bytes));
}

static void MEAPI destroyDefault(void *const block) {
    free(block);
}

MeMemoryAPIStruct MeMemoryAPI = {createDefault, createAlignedDefault, resizeDefault, destroyDefault, destroyDefault};

static void *checked(void *block, size_t bytes, const char *asker) {
    if (block == NULL)
        MeFatalError(0, "%s: out of memory, %zu bytes wanted", asker, bytes);
    return block;
}

void *me_create(size_t bytes, const char *asker) {
    return checked(MeMemoryAPI.create(bytes), bytes, asker);
}

void *me_createAligned(size_t bytes, unsigned int alignment, const char *asker) {
    return checked(MeMemoryAPI.createAligned(bytes, alignment), bytes, asker);
}
