/** @file MeSet.h
 *  Ordered sets of pointers, with the program's comparison.
 *
 *  The objects are owned by the program and must not change their order while they are in a set. Every function warns
 *  of a null set, and then does nothing or returns 0. A set may be used by one thread at a time.
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
    MeDictNode *next; /* last node of MeSetIteratorNext */
    MeBool isCreated;
} MeSet;

/** Creates an empty set without limit. Null: with a warning, without a comparison; after MeFatalError, without memory.
 *  Free it with MeSetDestroy. */
MEPUBLIC MeSet *MEAPI MeSetCreate(MeDictCompareFn cmp);
/** Initializes an empty set in the program's memory: s, and an array of maxnode nodes, the maximum number of items. */
MEPUBLIC void MEAPI MeSetInit(MeSet *s, MeDictNode *nodemem, int maxnode, MeDictCompareFn cmp);
/** Empties a set, and frees it if it was made by MeSetCreate. */
MEPUBLIC void MEAPI MeSetDestroy(MeSet *s);
/** Inserts an item and returns 1; returns 0 if an equal one exists or, with a warning, if the set is full. */
MEPUBLIC int MEAPI MeSetAdd(MeSet *s, void *item);
/** Removes the item that equals the given one and returns 1; returns 0 if there is none. */
MEPUBLIC int MEAPI MeSetRemove(MeSet *s, void *item);
/** Does the set contain an item equal to the given one? */
MEPUBLIC int MEAPI MeSetContains(MeSet *s, void *item);
/** The number of items. */
MEPUBLIC int MEAPI MeSetSize(MeSet *s);
/** Is the set full? */
MEPUBLIC int MEAPI MeSetIsFull(MeSet *s);
/** Removes and returns the last item; null for an empty set. */
MEPUBLIC void *MEAPI MeSetPop(MeSet *s);
/** Removes and returns the first item; null for an empty set. */
MEPUBLIC void *MEAPI MeSetPopFirst(MeSet *s);
/** Returns the items in order, one per call; null after the last one, then starts again. Inserting or removing an item
 *  also starts again. */
MEPUBLIC void *MEAPI MeSetIteratorNext(MeSet *s);

ME_END_C

#endif
