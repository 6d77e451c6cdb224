/** @file MeHeap.h
 *  Heaps (priority queues): pointers, of which the least is removed first; insertion and removal take logarithmic time.
 *
 *  The objects are owned by the program and must not change their order while they are in a heap. Every function warns
 *  of a null pointer, and then does nothing or returns 0. A heap may be used by one thread at a time.
 */
#ifndef MEHEAP_H
#define MEHEAP_H

#include "MePrecision.h"

ME_BEGIN_C

/** Returns a value less than, equal to or greater than 0 if elem1 is to be removed before, with or after elem2. */
typedef int(MEAPI *MeHeapComparisonFnPtr)(const void *elem1, const void *elem2);

/** A heap. Its members are private. */
typedef struct _MeHeap {
    void **item;
    int count, capacity;
    MeHeapComparisonFnPtr compare;
    MeBool isCreated;
} MeHeap;

/** Creates an empty heap for at most capacity items, 1 or more. Null: with a warning, for bad arguments; after
 *  MeFatalError, without memory. Free it with MeHeapDestroy. */
MEPUBLIC MeHeap *MEAPI MeHeapCreate(int capacity, MeHeapComparisonFnPtr cmp);
/** Initializes an empty heap in the program's memory: h, and an array of capacity pointers. After bad arguments its
 *  capacity is 0. */
MEPUBLIC void MEAPI MeHeapInit(MeHeap *h, void **memory, int capacity, MeHeapComparisonFnPtr cmp);
/** Destroys a heap made by MeHeapCreate; others get a warning. */
MEPUBLIC void MEAPI MeHeapDestroy(MeHeap *h);
/** Inserts an item and returns 1; returns 0, with a warning, if the heap is full. */
MEPUBLIC int MEAPI MeHeapPush(MeHeap *h, void *item);
/** Removes and returns the least item; null for an empty heap. The order of equal items depends only on the order of
 *  calls. */
MEPUBLIC void *MEAPI MeHeapPop(MeHeap *h);

ME_END_C

#endif
