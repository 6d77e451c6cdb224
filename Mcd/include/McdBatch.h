/** @file McdBatch.h
 *  Tests of many pairs: McdIntersectEach, with a context that stores the position in the container.
 */
#ifndef MCDBATCH_H
#define MCDBATCH_H

#include "McdCTypes.h"

ME_BEGIN_C

/** The position in a container. Opaque. */
typedef struct McdBatchContext McdBatchContext;

/** Creates a context; null, with a warning, if @a frame is not a framework. McdBatchContextDestroy frees it. */
MEPUBLIC McdBatchContext *MEAPI McdBatchContextCreate(McdFramework *frame);
/** Destroys a context. Null is ignored. */
MEPUBLIC void MEAPI McdBatchContextDestroy(McdBatchContext *context);
/** Makes the next McdBatchIntersectEach start with the container's first pair. */
MEPUBLIC void MEAPI McdBatchContextReset(McdBatchContext *context);
/** As McdBatchContextReset: a context has no memory of its own to release. */
MEPUBLIC void MEAPI McdBatchContextRelease(McdBatchContext *context);
/**
 * McdIntersect for the hello and staying pairs of a container, until the arrays are full. The results' contacts follow
 * one another in the array of contacts.
 * @param resultCount,contactCount get the numbers of results and contacts that were written.
 * @return 1 if pairs are left: process the results and call again with the same container. 0 at the end; the next call
 *         starts again, and so does a call with another container. 0, with a warning, if an argument is null.
 */
MEPUBLIC MeBool MEAPI McdBatchIntersectEach(McdBatchContext *context, McdModelPairContainer *pairs,
                                            McdIntersectResult *resultArray, int *resultCount, int resultMaxCount,
                                            McdContact *contactArray, int *contactCount, int contactMaxCount);

ME_END_C

#endif
