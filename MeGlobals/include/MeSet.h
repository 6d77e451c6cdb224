/** @file MeSet.h
 *  Sets of pointers, in an order that the program gives.
 *
 *  What the pointers point to is the program's and must not change its order while it is in a set. Every function warns
 *  of a null set, and then does nothing or gives 0. A set is for one thread at a time.
 */
#ifndef MESET_H
#define MESET_H

#include "MeDict.h"
#include "MePoolx.h"

ME_BEGIN_C

/** A set. Its members are private. */
typedef struct _MeSet {
    MeDict dict;
    MePoolx pool;
    MeDictNode *next; /* of MeSetIteratorNext */
    MeBool isCreated;
} MeSet;

/** Makes an empty set of any size. Null, with a warning, without a comparison, and, after MeFatalError, without memory.
 *  MeSetDestroy gives it back. */
MEPUBLIC MeSet *MEAPI MeSetCreate(MeDictCompareFn cmp);
/** Makes an empty set in memory that is the program's: s, and maxnode nodes, which is how many items there may be. */
MEPUBLIC void MEAPI MeSetInit(MeSet *s, MeDictNode *nodemem, int maxnode, MeDictCompareFn cmp);
/** Empties a set, and frees it if MeSetCreate made it. */
MEPUBLIC void MEAPI MeSetDestroy(MeSet *s);
/** Puts an item in: 1. 0 if an equal one is in it, and, with a warning, if it is full. */
MEPUBLIC int MEAPI MeSetAdd(MeSet *s, void *item);
/** Takes the item out that equals this one: 1; 0 if there is none. */
MEPUBLIC int MEAPI MeSetRemove(MeSet *s, void *item);
/** Is an item in it that equals this one? */
MEPUBLIC int MEAPI MeSetContains(MeSet *s, void *item);
/** How many items there are. */
MEPUBLIC int MEAPI MeSetSize(MeSet *s);
/** Is there no place for another item? */
MEPUBLIC int MEAPI MeSetIsFull(MeSet *s);
/** Takes the last item out; null for an empty set. */
MEPUBLIC void *MEAPI MeSetPop(MeSet *s);
/** Takes the first item out; null for an empty set. */
MEPUBLIC void *MEAPI MeSetPopFirst(MeSet *s);
/** The items one after the other, in order; after the last one null, and then the first one again. What adds an item or
 *  takes one out starts anew. */
MEPUBLIC void *MEAPI MeSetIteratorNext(MeSet *s);

ME_END_C

#endif
