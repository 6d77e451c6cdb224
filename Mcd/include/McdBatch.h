/** @file McdBatch.h
 *  Many pairs at once (User Guide ch. 4, "Testing for Collisions"): McdIntersectEach, with a context that knows where
 *  in the container it is.
 */
#ifndef MCDBATCH_H
#define MCDBATCH_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Where a batch is. */
typedef struct McdBatchContext McdBatchContext;

/** Creates a context; null, with a warning, for what is no framework. McdBatchContextDestroy frees it. */
MEPUBLIC McdBatchContext *MEAPI McdBatchContextCreate(McdFramework *frame);
/** Null does nothing. */
MEPUBLIC void MEAPI McdBatchContextDestroy(McdBatchContext *context);
/** The next McdBatchIntersectEach begins with a container's first pair. */
MEPUBLIC void MEAPI McdBatchContextReset(McdBatchContext *context);
/** The same: a context has no memory of its own to give back. */
MEPUBLIC void MEAPI McdBatchContextRelease(McdBatchContext *context);
/**
 * McdIntersect for the hello and staying pairs of a container, as far as the arrays reach. Results share the array of
 * contacts, one after the other.
 * @param resultCount,contactCount get how many results and contacts were written.
 * @return 1 if there are pairs left: use up the results and call again with the same container. 0 at the end; the next
 *         call begins anew, and so does one with another container. 0, with a warning, if an argument is null.
 */
MEPUBLIC MeBool MEAPI McdBatchIntersectEach(McdBatchContext *context, McdModelPairContainer *pairs,
                                            McdIntersectResult *resultArray, int *resultCount, int resultMaxCount,
                                            McdContact *contactArray, int *contactCount, int contactMaxCount);

ME_END_C

#endif
