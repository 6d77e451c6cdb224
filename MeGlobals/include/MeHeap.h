/** @file MeHeap.h
 *  Heaps: pointers, of which the least is taken out first, put in and taken out in logarithmic time.
 *
 *  What the pointers point to is the program's and must not change its order while it is in a heap. Every function
 *  warns of a null pointer, and then does nothing or gives 0. A heap is for one thread at a time.
 */
#ifndef MEHEAP_H
#define MEHEAP_H

#include "MePrecision.h"

ME_BEGIN_C

/** Less than, equal to or greater than 0, as elem1 is to come out before, with or after elem2. */
typedef int(MEAPI *MeHeapComparisonFnPtr)(const void *elem1, const void *elem2);

/** A heap. Its members are private. */
typedef struct _MeHeap {
    void **item;
    int count, capacity;
    MeHeapComparisonFnPtr compare;
    MeBool isCreated;
} MeHeap;

/** Makes an empty heap for at most capacity items, 1 or more. Null, with a warning, for bad arguments, and, after
 *  MeFatalError, without memory. MeHeapDestroy gives it back. */
MEPUBLIC MeHeap *MEAPI MeHeapCreate(int capacity, MeHeapComparisonFnPtr cmp);
/** The same in memory that is the program's: h, and place for capacity pointers. After bad arguments it has no
 *  place. */
MEPUBLIC void MEAPI MeHeapInit(MeHeap *h, void **memory, int capacity, MeHeapComparisonFnPtr cmp);
/** Destroys a heap that MeHeapCreate made; others get a warning. */
MEPUBLIC void MEAPI MeHeapDestroy(MeHeap *h);
/** Puts an item in: 1; 0, with a warning, if the heap is full. */
MEPUBLIC int MEAPI MeHeapPush(MeHeap *h, void *item);
/** Takes the least item out; null for an empty heap. Which one of equal ones comes first depends on nothing but the
 *  order of calls. */
MEPUBLIC void *MEAPI MeHeapPop(MeHeap *h);

ME_END_C

#endif
