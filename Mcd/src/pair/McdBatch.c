/* Batches of pair tests: McdIntersectEach, with its iterator kept in a context. */
#include "McdBatch.h"
#include "pair/mcd_pair_i.h"

struct McdBatchContext {
    const McdModelPairContainer *pairs; /* the container being processed; null: none */
    McdModelPairContainerIterator at;
};

static MeBool checkBatch(const McdBatchContext *context, const char *function) {
    if (!context)
        MeWarning(1, "%s: no context", function);
    return context != 0;
}

McdBatchContext *MEAPI McdBatchContextCreate(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdBatchContextCreate"))
        return 0;
    return MeMemoryTakeZeroed(1, sizeof(McdBatchContext), "McdBatchContextCreate", "a context");
}

void MEAPI McdBatchContextDestroy(McdBatchContext *context) {
    MeMemoryGive(context);
}

void MEAPI McdBatchContextReset(McdBatchContext *context) {
    if (checkBatch(context, "McdBatchContextReset"))
        context->pairs = 0;
}

void MEAPI McdBatchContextRelease(McdBatchContext *context) {
    ME_UNDER_OWN_NAME(McdBatchContextReset(context));
}

MeBool MEAPI McdBatchIntersectEach(McdBatchContext *context, McdModelPairContainer *pairs,
                                   McdIntersectResult *resultArray, int *resultCount, int resultMaxCount,
                                   McdContact *contactArray, int *contactCount, int contactMaxCount) {
    if (!checkBatch(context, "McdBatchIntersectEach"))
        return MEFALSE;
    if (pairs && context->pairs != pairs) {
        context->pairs = pairs;
        context->at.next = pairs->helloFirst;
    }
    const MeBool isMore = McdIntersectEach(pairs, &context->at, resultArray, resultMaxCount, resultCount, contactArray,
                                           contactMaxCount, contactCount);
    if (!isMore)
        context->pairs = 0;
    return isMore;
}
