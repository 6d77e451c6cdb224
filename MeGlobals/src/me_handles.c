/* The table of live objects: buckets by address, each with its own spin lock. */
#include "MeInternal.h"

#include "MeAssert.h"
#include <stdatomic.h>
#include <stdint.h>

enum { BUCKETS = 1 << 14 };

typedef struct Bucket {
    atomic_int isLocked;
    MeHandle *first;
} Bucket;

static Bucket table[BUCKETS];

static Bucket *lockedBucket(const void *object) {
    const uint64_t mixed = (uint64_t)(uintptr_t)object * 0x9e3779b97f4a7c15ull; /* Fibonacci hashing */
    Bucket *b = &table[mixed >> 50];
    while (atomic_exchange_explicit(&b->isLocked, 1, memory_order_acquire)) {
    }
    return b;
}

static void unlock(Bucket *b) {
    MEASSERT(atomic_load_explicit(&b->isLocked, memory_order_relaxed));
    atomic_store_explicit(&b->isLocked, 0, memory_order_release);
}

void MEAPI MeHandleEnter(MeHandle *handle, const void *object, unsigned int kind) {
    Bucket *const b = lockedBucket(object);
    MEASSERT(object != NULL);
    handle->object = object;
    handle->kind = kind;
    handle->next = b->first;
    b->first = handle;
    unlock(b);
}

void MEAPI MeHandleLeave(MeHandle *handle) {
    if (handle->object == NULL)
        return;
    Bucket *const b = lockedBucket(handle->object);
    MeHandle **at = &b->first;
    while (*at != NULL && *at != handle)
        at = &(*at)->next;
    if (*at == handle)
        *at = handle->next;
    handle->object = NULL;
    unlock(b);
}

MeBool MEAPI MeHandleIsLive(const void *object, unsigned int kind) {
    Bucket *const b = lockedBucket(object);
    const MeHandle *h = b->first;
    while (h != NULL && !(h->object == object && h->kind == kind))
        h = h->next;
    unlock(b);
    return h != NULL;
}
