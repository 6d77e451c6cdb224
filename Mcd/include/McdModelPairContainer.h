/** @file McdModelPairContainer.h
 *  Containers for the pairs that a space returns.
 *
 *  A container is one array: goodbye pairs from its start up, hello pairs from its middle down, staying pairs from
 *  its middle up. McdSpaceGetPairs puts the middle where everything fits, if possible; in containers filled by hand
 *  it is half the size.
 */
#ifndef MCDMODELPAIRCONTAINER_H
#define MCDMODELPAIRCONTAINER_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Creates an empty container with room for size pairs, 1 or more; else null, with a warning. */
MEPUBLIC McdModelPairContainer *MEAPI McdModelPairContainerCreate(int size);
/** Destroys a container made by McdModelPairContainerCreate; the pairs belong to the space. Null is ignored. */
MEPUBLIC void MEAPI McdModelPairContainerDestroy(McdModelPairContainer *a);
/** Initializes an empty container in the program's own memory: array has room for size pairs, 1 or more, and is
 *  kept. */
MEPUBLIC void MEAPI McdModelPairContainerInit(McdModelPairContainer *c, McdModelPair **array, int size);
/** Empties it. */
MEPUBLIC void MEAPI McdModelPairContainerReset(McdModelPairContainer *c);

/** @name Adding and removing. Returns 1 if there was room.
 *  McdSpaceGetPairs fills a container; programs with pairs of their own insert them by these.
 *  @{ */
/** Puts it before the other hello pairs. */
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertHelloPair(McdModelPairContainer *c, McdModelPairID p);
/** Puts it behind the other staying pairs. */
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertStayingPair(McdModelPairContainer *c, McdModelPairID p);
/** Puts it behind the other goodbye pairs. */
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertGoodbyePair(McdModelPairContainer *c, McdModelPairID p);
/** Removes the pair at a position in the array, p = &array[i]; the other pairs of its list keep their order. */
MEPUBLIC void MEAPI McdModelPairContainerRemovePair(McdModelPairContainer *c, McdModelPairID *p);
/** @} */

/** @name Contents. The arrays are valid until the container changes.
 *  @a count receives the number of pairs in the array that is returned.
 *  @{ */
/** 0, with a warning, for null. */
MEPUBLIC int MEAPI McdModelPairContainerGetHelloCount(McdModelPairContainer *c);
/** 0, with a warning, for null. */
MEPUBLIC int MEAPI McdModelPairContainerGetStayingCount(McdModelPairContainer *c);
/** 0, with a warning, for null. */
MEPUBLIC int MEAPI McdModelPairContainerGetGoodbyeCount(McdModelPairContainer *c);
/** The hello pairs; the container owns the array. */
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetHelloArray(McdModelPairContainer *c, int *count);
/** The staying pairs; the container owns the array. */
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetStayingArray(McdModelPairContainer *c, int *count);
/** The goodbye pairs; the container owns the array. */
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetGoodbyeArray(McdModelPairContainer *c, int *count);
/** Sets an iterator for McdIntersectEach to the first hello pair. */
MEPUBLIC void MEAPI McdModelPairContainerIteratorInit(McdModelPairContainerIterator *it, McdModelPairContainer *c);
/** Prints the three counts by MeInfo. */
MEPUBLIC void MEAPI McdModelPairContainerPrintStats(McdModelPairContainer *c);
/** As McdModelPairContainerPrintStats. */
MEPUBLIC void MEAPI McdPairContainerPrintStats(McdModelPairContainer *c);
/** @} */

ME_END_C

#endif
