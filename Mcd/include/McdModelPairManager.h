/** @file McdModelPairManager.h
 *  Which pairs of models are near each other, for programs that find that out by themselves: what a space keeps beside
 *  its farfield.
 *
 *  In each step the program tells which pairs have come near (Activate) and which are no longer (Deactivate), takes the
 *  hello, staying and goodbye pairs in containers as those of a space, and ends the step (Flush).
 *
 *  @code
 *      McdSpacePairIterator iterator;
 *      McdModelPairManagerResetIterator(manager, &iterator);
 *      do {
 *          isMore = McdModelPairManagerGetPairs(manager, &iterator, container);
 *          McdGoodbyeEach(container);
 *          McdHelloEach(container);
 *          ...
 *      } while (isMore);
 *      McdModelPairManagerFlush(manager);
 *  @endcode
 *
 *  Pairs are handed over in the order in which they were activated. Models must live as long as a pair of theirs, a
 *  goodbye pair included. Every function warns of a null manager, and then does nothing or gives 0.
 */
#ifndef MCDMODELPAIRMANAGER_H
#define MCDMODELPAIRMANAGER_H

#include "McdSpace.h"

ME_BEGIN_C

/** Hidden. */
typedef struct McdModelPairManager McdModelPairManager;
typedef McdModelPairManager *McdModelPairManagerID;

/** Creates a manager for at most size pairs at a time, goodbye pairs included; null, with a warning, for less than 1,
 *  and, after MeFatalError, without memory. */
MEPUBLIC McdModelPairManagerID MEAPI McdModelPairManagerCreate(int size);
/** Destroys it; McdGoodbye is called for pairs that were prepared. Null does nothing. */
MEPUBLIC void MEAPI McdModelPairManagerDestroy(McdModelPairManager *manager);

/** The pair is near: a hello pair, or, if it said goodbye in this step, a staying one again. METRUE if it is active
 *  now; MEFALSE if there is no place, which the pool-full handler is told, and, with a warning, unless these are two
 *  models of one framework. */
MEPUBLIC MeBool MEAPI McdModelPairManagerActivate(McdModelPairManagerID manager, McdModelID model1, McdModelID model2);
/** The pair is no longer near: a goodbye pair until the end of the step; one that came in this step is gone at once.
 *  METRUE if it was active. */
MEPUBLIC MeBool MEAPI McdModelPairManagerDeactivate(McdModelPairManagerID manager, McdModelID model1,
                                                    McdModelID model2);
/** The active pair of two models, in either order; null: none. */
MEPUBLIC McdModelPairID MEAPI McdModelPairManagerGetPair(McdModelPairManagerID manager, McdModelID m1, McdModelID m2);
/** Ends a step: hello pairs stay, goodbye pairs are gone. */
MEPUBLIC void MEAPI McdModelPairManagerFlush(McdModelPairManagerID manager);
/** How many pairs there may be. */
MEPUBLIC int MEAPI McdModelPairManagerGetSize(McdModelPairManagerID manager);

/** Puts an iterator before the first pair. What activates or deactivates a pair, and Flush, make that necessary
 *  anew. */
MEPUBLIC void MEAPI McdModelPairManagerResetIterator(McdModelPairManagerID manager, McdSpacePairIterator *iterator);
/** Fills a container with the pairs that come after the iterator, as McdSpaceGetPairs; METRUE if there are more. */
MEPUBLIC MeBool MEAPI McdModelPairManagerGetPairs(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                                  McdModelPairContainer *container);
/** The same without staying pairs. */
MEPUBLIC MeBool MEAPI McdModelPairManagerGetTransitions(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                                        McdModelPairContainer *container);

/** @name What is called when there is no place for a pair; null, which is the default: a warning, once
 *  It may do anything but change the manager (docs/simulation.md, "Callbacks").
 *  @{ */
MEPUBLIC void MEAPI McdModelPairManagerSetPoolFullHandler(McdModelPairManagerID manager,
                                                          McdSpacePoolErrorFnPtr handler);
MEPUBLIC McdSpacePoolErrorFnPtr MEAPI McdModelPairManagerGetPoolFullHandler(McdModelPairManagerID manager);
/** @} */

ME_END_C

#endif
