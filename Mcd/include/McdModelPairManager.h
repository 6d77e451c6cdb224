/** @file McdModelPairManager.h
 *  Phases of pairs, for programs with a broad phase of their own: what a space keeps besides its own broad phase.
 *
 *  In each step the program activates pairs that have come near and deactivates pairs that are no longer near. It gets
 *  the hello, staying and goodbye pairs in containers, as from a space. Then it ends the step (Flush).
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
 *  Pairs are returned in the order in which they were activated. Models must live as long as their pairs, goodbye
 *  pairs included. Every function warns of a null manager, and then does nothing or returns 0.
 */
#ifndef MCDMODELPAIRMANAGER_H
#define MCDMODELPAIRMANAGER_H

#include "McdSpace.h"

ME_BEGIN_C

/** Opaque. */
typedef struct McdModelPairManager McdModelPairManager;
typedef McdModelPairManager *McdModelPairManagerID;

/** Creates a manager for at most size pairs at a time, goodbye pairs included. Null, with a warning, for a size
 *  below 1; null, after MeFatalError, if there is no memory. */
MEPUBLIC McdModelPairManagerID MEAPI McdModelPairManagerCreate(int size);
/** Destroys a manager; McdGoodbye is called for pairs that were prepared by McdHello. Null is ignored. */
MEPUBLIC void MEAPI McdModelPairManagerDestroy(McdModelPairManager *manager);

/** Announces that a pair is near: it becomes a hello pair or, if it said goodbye in this step, a staying pair again.
 *  METRUE if it is active now. MEFALSE if there is no room, after the pool-full handler was called; and, with a
 *  warning, unless these are two models of one framework. */
MEPUBLIC MeBool MEAPI McdModelPairManagerActivate(McdModelPairManagerID manager, McdModelID model1, McdModelID model2);
/** Announces that a pair is no longer near: it is a goodbye pair until the end of the step; a pair activated in this
 *  step is removed immediately. METRUE if it was active. */
MEPUBLIC MeBool MEAPI McdModelPairManagerDeactivate(McdModelPairManagerID manager, McdModelID model1,
                                                    McdModelID model2);
/** The active pair of two models, in either order; null if there is none. */
MEPUBLIC McdModelPairID MEAPI McdModelPairManagerGetPair(McdModelPairManagerID manager, McdModelID m1, McdModelID m2);
/** Ends a step: hello pairs become staying pairs, goodbye pairs are removed. */
MEPUBLIC void MEAPI McdModelPairManagerFlush(McdModelPairManagerID manager);
/** The maximum number of pairs. */
MEPUBLIC int MEAPI McdModelPairManagerGetSize(McdModelPairManagerID manager);

/** Sets an iterator before the first pair. Must be called again after a pair was activated or deactivated, and after
 *  Flush. */
MEPUBLIC void MEAPI McdModelPairManagerResetIterator(McdModelPairManagerID manager, McdSpacePairIterator *iterator);
/** Fills a container with the pairs that follow the iterator, as McdSpaceGetPairs; METRUE if there are more. */
MEPUBLIC MeBool MEAPI McdModelPairManagerGetPairs(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                                  McdModelPairContainer *container);
/** McdModelPairManagerGetPairs without staying pairs. */
MEPUBLIC MeBool MEAPI McdModelPairManagerGetTransitions(McdModelPairManagerID manager, McdSpacePairIterator *iterator,
                                                        McdModelPairContainer *container);

/** @name Callback for pairs without room (McdModelPairManagerActivate); null, the default: one warning
 *  It may do anything but change the manager (docs/simulation.md, "Callbacks").
 *  @{ */
/** Called in McdModelPairManagerActivate, which then returns MEFALSE. */
MEPUBLIC void MEAPI McdModelPairManagerSetPoolFullHandler(McdModelPairManagerID manager,
                                                          McdSpacePoolErrorFnPtr handler);
/** Null by default. */
MEPUBLIC McdSpacePoolErrorFnPtr MEAPI McdModelPairManagerGetPoolFullHandler(McdModelPairManagerID manager);
/** @} */

ME_END_C

#endif
