/* Binary heaps (Williams, Heapsort, CACM 1964): item i is not after items 2 i + 1 and 2 i + 2. */
#include "MeHeap.h"

#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <string.h>

static MeBool isHeap(const MeHeap *h, const char *function) {
    if (!me_isGiven(h, "heap", function))
        return MEFALSE;
    MEASSERT(h->count >= 0 && h->count <= h->capacity);
    return METRUE;
}

MeHeap *MEAPI MeHeapCreate(int capacity, MeHeapComparisonFnPtr cmp) {
    if (capacity < 1 || !cmp) {
        MeWarning(1, "MeHeapCreate: capacity is %d, which must be 1 or more; the comparison is %s", capacity,
                  cmp ? "given" : "null");
        return NULL;
    }
    MeHeap *h = MeMemoryTake(1, sizeof *h + (size_t)capacity * sizeof(void *), __func__, "a heap");
    if (!h)
        return NULL;
    MeHeapInit(h, (void **)(h + 1), capacity, cmp);
    h->isCreated = METRUE;
    return h;
}

void MEAPI MeHeapInit(MeHeap *h, void **memory, int capacity, MeHeapComparisonFnPtr cmp) {
    if (!me_isGiven(h, "heap", __func__))
        return;
    memset(h, 0, sizeof *h);
    if (!memory || capacity < 1 || !cmp) {
        MeWarning(1, "MeHeapInit: memory is %p, capacity is %d, which must be 1 or more; the comparison is %s",
                  (void *)memory, capacity, cmp ? "given" : "null");
        return;
    }
    h->item = memory;
    h->capacity = capacity;
    h->compare = cmp;
}

void MEAPI MeHeapDestroy(MeHeap *h) {
    if (!isHeap(h, __func__))
        return;
    if (h->isCreated)
        MeMemoryGive(h);
    else
        MeWarning(1, "MeHeapDestroy: MeHeapCreate has not made this heap");
}

/* Whether item i is removed before item k. */
static MeBool isRemovedBefore(const MeHeap *h, int i, int k) {
    return h->compare(h->item[i], h->item[k]) < 0;
}

static void swapItems(MeHeap *h, int i, int k) {
    void *item = h->item[i];
    h->item[i] = h->item[k];
    h->item[k] = item;
}

static MeBool isHeapOrdered(const MeHeap *h) {
    for (int i = 1; i < h->count; i++)
        if (isRemovedBefore(h, i, (i - 1) / 2))
            return MEFALSE;
    return METRUE;
}

int MEAPI MeHeapPush(MeHeap *h, void *item) {
    if (!isHeap(h, __func__))
        return 0;
    if (h->count >= h->capacity) {
        MeWarning(1, "MeHeapPush: there are %d items already: raise MeHeapCreate's capacity", h->count);
        return 0;
    }
    h->item[h->count] = item;
    for (int i = h->count++; i > 0 && isRemovedBefore(h, i, (i - 1) / 2); i = (i - 1) / 2)
        swapItems(h, i, (i - 1) / 2);
    MEVALIDATE(isHeapOrdered(h));
    return 1;
}

void *MEAPI MeHeapPop(MeHeap *h) {
    if (!isHeap(h, __func__) || h->count == 0)
        return NULL;
    void *min = h->item[0];
    h->item[0] = h->item[--h->count];
    for (int i = 0, child = 1; child < h->count; i = child, child = 2 * i + 1) {
        if (child + 1 < h->count && isRemovedBefore(h, child + 1, child))
            child++;
        if (!isRemovedBefore(h, child, i))
            break;
        swapItems(h, i, child);
    }
    MEVALIDATE(isHeapOrdered(h));
    return min;
}
