/** @file McdModelPairContainer.h
 *  Places for the pairs that a space hands over (User Guide ch. 4, "Testing for Collisions").
 *
 *  One array: goodbye pairs from its start up, hello pairs from its middle down, staying pairs from its middle up.
 *  McdSpaceGetPairs puts the middle where everything fits, if it can; filled by hand, it is half-way.
 */
#ifndef MCDMODELPAIRCONTAINER_H
#define MCDMODELPAIRCONTAINER_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Creates an empty container for size pairs, 1 or more; else null, with a warning. */
MEPUBLIC McdModelPairContainer *MEAPI McdModelPairContainerCreate(int size);
/** Destroys what McdModelPairContainerCreate made. The pairs are the space's. Null does nothing. */
MEPUBLIC void MEAPI McdModelPairContainerDestroy(McdModelPairContainer *a);
/** Makes an empty container of a program's own memory: array has place for size pairs, 1 or more, and is kept. */
MEPUBLIC void MEAPI McdModelPairContainerInit(McdModelPairContainer *c, McdModelPair **array, int size);
/** Empties it. */
MEPUBLIC void MEAPI McdModelPairContainerReset(McdModelPairContainer *c);

/** @name Adding and removing. 1 if there was place.
 *  @{ */
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertHelloPair(McdModelPairContainer *c, McdModelPairID p);
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertStayingPair(McdModelPairContainer *c, McdModelPairID p);
MEPUBLIC MeBool MEAPI McdModelPairContainerInsertGoodbyePair(McdModelPairContainer *c, McdModelPairID p);
/** Removes the pair at a place inside the array, &array[i]; those of its list close up in their order. */
MEPUBLIC void MEAPI McdModelPairContainerRemovePair(McdModelPairContainer *c, McdModelPairID *p);
/** @} */

/** @name What is in it. The arrays are valid until the container changes.
 *  @{ */
MEPUBLIC int MEAPI McdModelPairContainerGetHelloCount(McdModelPairContainer *c);
MEPUBLIC int MEAPI McdModelPairContainerGetStayingCount(McdModelPairContainer *c);
MEPUBLIC int MEAPI McdModelPairContainerGetGoodbyeCount(McdModelPairContainer *c);
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetHelloArray(McdModelPairContainer *c, int *count);
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetStayingArray(McdModelPairContainer *c, int *count);
MEPUBLIC McdModelPair **MEAPI McdModelPairContainerGetGoodbyeArray(McdModelPairContainer *c, int *count);
/** Puts an iterator for McdIntersectEach at the first hello pair. */
MEPUBLIC void MEAPI McdModelPairContainerIteratorInit(McdModelPairContainerIterator *it, McdModelPairContainer *c);
/** Writes the three counts by MeInfo. */
MEPUBLIC void MEAPI McdModelPairContainerPrintStats(McdModelPairContainer *c);
/** The same. */
MEPUBLIC void MEAPI McdPairContainerPrintStats(McdModelPairContainer *c);
/** @} */

ME_END_C

#endif
