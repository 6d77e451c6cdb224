/** @file McdSpace.h
 *  Spaces: the broad phase, which finds models that are near each other.
 *
 *  Change blocks. A space is changed between McdSpaceBeginChanges and McdSpaceEndChanges, and queried outside; each
 *  block is one step in the phases of pairs. Each function says where it is legal; elsewhere it warns, changes
 *  nothing and returns 0. A space starts inside a block. Both of the guide's ways to step it work:
 *
 *      McdSpaceUpdateAll(s); McdSpaceEndChanges(s); ...pairs...; McdSpaceBeginChanges(s);     blocks by hand
 *      McdSpaceUpdateAll(s); ...pairs...;                       McdSpaceUpdateAll begins and ends a block
 *
 *  In the second way the program never ends the first block: it ends with the first call that is legal only outside
 *  of blocks, once McdSpaceUpdateAll was called in it.
 *
 *  Pairs. Two models are near each other when their boxes, grown by their contact tolerances, overlap on the axes
 *  that the space tests. A pair says hello in the block that finds it near, stays, and says goodbye in the first
 *  block that does not find it near. It is the same McdModelPair throughout, and becomes invalid with the next
 *  McdSpaceBeginChanges (or McdSpaceUpdateAll) after its goodbye. model1 is the one with the greater sort key or, if
 *  these are equal, created later. Each list is in the order of model2, then model1, by sort keys, then creation.
 *
 *  A pair of two frozen models is silent: it is not reported, costs no time, and is kept (with its userData,
 *  responseData, cache) until one of the models is unfrozen; then it is reported as staying again, or says goodbye
 *  if the models are no longer near. If a model is removed, or the pair disabled, it says goodbye as usual. Two
 *  models that were frozen before they were found near say hello when one of them is unfrozen.
 */
#ifndef MCDSPACE_H
#define MCDSPACE_H

#include "McdCullingTable.h"
#include "McdModelPairContainer.h"

ME_BEGIN_C

/** Axes, to be summed: 1, 2, 4; McdAllAxes is the sum of all. */
extern MEPUBLIC const int McdXAxis, McdYAxis, McdZAxis, McdAllAxes;

/** Position of McdSpaceGetPairs; set by McdSpacePairIteratorBegin. */
typedef struct McdSpacePairIterator {
    MeU32 step;                  /**< The step of the space for which it is valid. */
    int goodbye, hello, staying; /**< Numbers of pairs returned so far. */
} McdSpacePairIterator;
/** Position of McdSpaceGetModel; set by McdSpaceModelIteratorBegin. */
typedef struct McdSpaceModelIterator {
    McdModelID next; /**< Null at the end. */
} McdSpaceModelIterator;
/** Updates a model's box, by McdModelUpdate, McdModelUpdatePath or its own means. What else it may do:
 *  docs/simulation.md, "Callbacks". */
typedef void(MEAPI *McdSpaceUpdateAABBFnPtr)(McdModelID m, MeReal duration);
/** Filter of queries: non-zero if the model is to be considered. It must not move models; models that it destroys
 *  are no longer found, and are destroyed when the query ends (docs/simulation.md, "Callbacks"). */
typedef int(MEAPI *McdLineSegIntersectEnableCallback)(McdModelID, void *filterData);

/** @name Creation and destruction
 *  @{ */
/**
 * Creates an empty space, inside a change block.
 * @param axes        the sum of the axes on which boxes are compared; on other axes all models count as overlapping.
 * @param objectCount the maximum number of models, 1 or more, or MeNoLimit.
 * @param pairCount   the maximum number of pairs at one time, silent ones included, 1 or more, or MeNoLimit. For pairs
 *                    without room there is a warning, the pool-full handler is called, and they say hello when there
 *                    is room.
 * @return null, with a warning, if an argument is out of range. McdSpaceDestroy destroys it, before McdTerm.
 *
 * Karma 1.1 had a fifth argument, which is ignored. Karma 1.0's form, without a framework and with a 1 at the end, has
 * four as well; it gets a warning unless KarmaClassic.h is included.
 */
MEPUBLIC McdSpaceID MEAPI McdSpaceAxisSortCreate(McdFrameworkID framework, int axes, int objectCount, int pairCount);
#ifdef __cplusplus
ME_END_C
inline McdSpaceID McdSpaceAxisSortCreate(McdFrameworkID framework, int axes, int objectCount, int pairCount, int) {
    return McdSpaceAxisSortCreate(framework, axes, objectCount, pairCount);
}
ME_BEGIN_C
#else
#define MCD_SIXTH(a, b, c, d, e, f, ...)              f
#define McdSpaceAxisSortCreateWith4(f, a, o, p)       (McdSpaceAxisSortCreate)((f), (a), (o), (p))
#define McdSpaceAxisSortCreateWith5(f, a, o, p, last) ((void)(last), (McdSpaceAxisSortCreate)((f), (a), (o), (p)))
#define McdSpaceAxisSortCreate(...)                                                                                    \
    MCD_SIXTH(__VA_ARGS__, McdSpaceAxisSortCreateWith5, McdSpaceAxisSortCreateWith4,                                   \
              McdSpaceAxisSortCreate_takes_4_or_5_arguments, McdSpaceAxisSortCreate_takes_4_or_5_arguments,            \
              McdSpaceAxisSortCreate_takes_4_or_5_arguments, 0)                                                        \
    (__VA_ARGS__)
#endif
/** Destroys a space. Its models are removed from it, and its pairs are destroyed. Null is ignored. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceDestroy(McdSpaceID s);
/** Rebuilds the tree of boxes: useful after most models were inserted. Legal anywhere, never required. */
MEPUBLIC void MEAPI McdSpaceBuild(McdSpaceID s);
/** A pointer of the program's, which nothing reads. Default null. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceSetUserData(McdSpaceID s, void *data);
/** The pointer of McdSpaceSetUserData; null by default. */
MEPUBLIC void *MEAPI McdSpaceGetUserData(McdSpaceID s);
/** Sets the callback for pairs without room (docs/simulation.md, "Callbacks"); null: none. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceSetPoolFullHandler(McdSpaceID space, McdSpacePoolErrorFnPtr handler);
/** Null by default. */
MEPUBLIC McdSpacePoolErrorFnPtr MEAPI McdSpaceGetPoolFullHandler(McdSpaceID space);
/** @} */

/** @name Change blocks
 *  @{ */
/** Begins a block: goodbye pairs of the last step become invalid. Outside only. */
MEPUBLIC void MEAPI McdSpaceBeginChanges(McdSpaceID space);
/** Ends the block and finds the pairs. Inside only. */
MEPUBLIC void MEAPI McdSpaceEndChanges(McdSpaceID space);
/** 1 inside a block, 0 outside. */
MEPUBLIC int MEAPI McdSpaceIsChanging(McdSpaceID space);
/** @} */

/** @name Models
 *  @{ */
/**
 * Inserts a model, unfrozen, with the box of its last update; a model that was never updated has no box and no pairs
 * until it is. Returns 1 if it was inserted; 0 if it is in a space already, or the space is full. Inside only.
 */
MEPUBLIC MeBool MEAPI McdSpaceInsertModel(McdSpaceID s, McdModelID cm);
/** McdSpaceInsertModel, then McdSpaceSetModelCullingParameters. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceInsertModelWithCulling(McdSpaceID s, McdModelID cm, McdCullingTable *table,
                                                     int cullingIndex, int cullingID);
/** Removes a model; its pairs say goodbye, and it must live until they have. 1 if it was in a space. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceRemoveModel(McdModelID cm);
/** The number of models in the space. Legal anywhere. */
MEPUBLIC int MEAPI McdSpaceGetModelCount(McdSpaceID space);
/** Sets an iterator for McdSpaceGetModel. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceModelIteratorBegin(McdSpaceID s, McdSpaceModelIterator *it);
/** Gets the next model, in the order of insertion; 0 at the end. The model just returned may be removed. Legal
 *  anywhere. */
MEPUBLIC MeBool MEAPI McdSpaceGetModel(McdSpaceID s, McdSpaceModelIterator *it, McdModelID *cm);
/** @} */

/** @name Updating
 *  A model without a transform, or with one that is not finite, gets one warning and keeps its old box until its
 *  transform is valid.
 *  @{ */
/** Updates the boxes of all models that are not frozen. Legal anywhere; outside a block it is a block of its own. */
MEPUBLIC void MEAPI McdSpaceUpdateAll(McdSpaceID s);
/** McdSpaceUpdateAll, with boxes around the motion of the next duration (s) for swept models. Legal anywhere. */
MEPUBLIC void MEAPI McdSpacePathUpdateAll(McdSpaceID s, MeReal duration);
/** McdSpaceUpdateAll, inside only. */
MEPUBLIC void MEAPI McdSpaceUpdateModels(McdSpaceID s);
/** Updates the box of one model; a warning if it is frozen. Inside only. */
MEPUBLIC void MEAPI McdSpaceUpdateModel(McdModelID cm);
/**
 * The look-ahead time for speculative pairs and contacts, s, >= 0; default 0, as in Karma. With the length of a
 * dynamics step, models that would touch within the step get contacts with a gap, before they penetrate. A model looks
 * ahead no farther than its bounding sphere's radius; faster models need McdSafeTime. Takes effect at the models' next
 * update. Legal anywhere. Beyond Karma.
 */
MEPUBLIC void MEAPI McdSpaceSetLookAhead(McdSpaceID s, MeReal duration);
/** s; 0 by default. MstUniverseStep sets it to its step. */
MEPUBLIC MeReal MEAPI McdSpaceGetLookAhead(McdSpaceID s);
/** Sets the function that updates boxes; null: McdModelUpdate (McdModelUpdatePath for swept models). Outside only. */
MEPUBLIC void MEAPI McdSpaceSetAABBFn(McdSpaceID s, McdSpaceUpdateAABBFnPtr updateAABBFn);
/**
 * Freezes a model, which must not move then: it is not updated any more and keeps its box; pairs of two frozen models
 * are not reported, see above. Takes effect at the end of the next block. Does not update the model. 1 if the model is
 * in a space. Legal anywhere.
 */
MEPUBLIC MeBool MEAPI McdSpaceFreezeModel(McdModelID cm);
/** Unfreezes a model. 1 if the model is in a space. Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpaceUnfreezeModel(McdModelID cm);
/** Whether the model is frozen. Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpaceModelIsFrozen(McdModelID cm);
/** As McdSpaceModelIsFrozen. */
MEPUBLIC MeBool MEAPI McdSpaceIsFrozen(McdModelID cm);
/** @} */

/** @name Pairs that never collide
 *  @{ */
/** Disables a pair: it says goodbye and is not reported until it is enabled, or one of the models has left the
 *  space. 1 if both are in the same space, and also for a model and itself, which never collide. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceDisablePair(McdModelID cm1, McdModelID cm2);
/** Enables a pair again. 1 if both models are in the same space. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceEnablePair(McdModelID cm1, McdModelID cm2);
/** Whether a pair may collide: 0 if it is disabled, culled or filtered (McdModelSetFilter), or the models are not in
 *  the same space. Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpacePairIsEnabled(McdModelID cm1, McdModelID cm2);
/** Sets a model's culling parameters. Two models act as a disabled pair if they have the same table and ID, and the
 *  table's flag for their indices is set. Null as table: none. An index out of the table's range gets a warning.
 *  Inside only. */
MEPUBLIC void MEAPI McdSpaceSetModelCullingParameters(McdSpaceID s, McdModelID cm, McdCullingTable *table,
                                                      int cullingIndex, int cullingID);
/** @} */

/** @name Pairs
 *  @{ */
/** Sets an iterator for McdSpaceGetPairs or McdSpaceGetTransitions, after the end of the block. Outside only. */
MEPUBLIC void MEAPI McdSpacePairIteratorBegin(McdSpaceID s, McdSpacePairIterator *iter);
/**
 * Fills a container, replacing its contents, with the pairs that follow the iterator: goodbye pairs first, then hello
 * and staying ones. Non-zero if there are more: process these, and call again. Outside only.
 *
 * The guide's samples omit the iterator; then each step begins at the first pair and continues while there are more.
 */
MEPUBLIC int MEAPI McdSpaceGetPairs(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c);
/** McdSpaceGetPairs without staying pairs. */
MEPUBLIC int MEAPI McdSpaceGetTransitions(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c);
/** The forms with two arguments. */
MEPUBLIC int MEAPI McdSpaceGetNextPairs(McdSpaceID s, McdModelPairContainer *c);
/** McdSpaceGetTransitions, from where the last call ended. */
MEPUBLIC int MEAPI McdSpaceGetNextTransitions(McdSpaceID s, McdModelPairContainer *c);
#ifdef __cplusplus
ME_END_C
inline int McdSpaceGetPairs(McdSpaceID s, McdModelPairContainer *c) {
    return McdSpaceGetNextPairs(s, c);
}
inline int McdSpaceGetTransitions(McdSpaceID s, McdModelPairContainer *c) {
    return McdSpaceGetNextTransitions(s, c);
}
ME_BEGIN_C
#else
#define MCD_THIRD_OF_PAIRS(a, b, c, d, ...) d
#define McdSpaceGetPairsWith2(s, c)         McdSpaceGetNextPairs((s), (c))
#define McdSpaceGetPairsWith3(s, i, c)      (McdSpaceGetPairs)((s), (i), (c))
#define McdSpaceGetPairs(...)                                                                                          \
    MCD_THIRD_OF_PAIRS(__VA_ARGS__, McdSpaceGetPairsWith3, McdSpaceGetPairsWith2,                                      \
                       McdSpaceGetPairs_takes_2_or_3_arguments, 0)                                                     \
    (__VA_ARGS__)
#define McdSpaceGetTransitionsWith2(s, c)    McdSpaceGetNextTransitions((s), (c))
#define McdSpaceGetTransitionsWith3(s, i, c) (McdSpaceGetTransitions)((s), (i), (c))
#define McdSpaceGetTransitions(...)                                                                                    \
    MCD_THIRD_OF_PAIRS(__VA_ARGS__, McdSpaceGetTransitionsWith3, McdSpaceGetTransitionsWith2,                          \
                       McdSpaceGetTransitions_takes_2_or_3_arguments, 0)                                               \
    (__VA_ARGS__)
#endif
/** @} */

/** @name Line segments
 *  From inOrig to inDest, world frame (User Guide ch. 4, "Querying Line Segment Intersections"). A model is hit at
 *  most once, where the segment enters it, see McdLineSegIntersect; triangle lists only after
 *  McdTriangleListLineSegmentRegisterInteraction. Outside only.
 *  @{ */
/** Finds the nearest model that is hit; of several at the same distance, the first in order. 1 if there is one. */
MEPUBLIC int MEAPI McdSpaceGetLineSegFirstIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                       McdLineSegIntersectResult *outResult);
/** McdSpaceGetLineSegFirstIntersection among the models for which the callback returns non-zero. */
MEPUBLIC int MEAPI McdSpaceGetLineSegFirstEnabledIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                              McdLineSegIntersectEnableCallback filterCB,
                                                              void *filterData, McdLineSegIntersectResult *outResult);
/** Finds the nearest inMaxListSize models that are hit, by distance, then order; returns the number written. */
MEPUBLIC int MEAPI McdSpaceGetLineSegIntersections(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                   McdLineSegIntersectResult *outList, int inMaxListSize);
/** @} */

ME_END_C

#endif
