/** @file McdSpace.h
 *  Spaces: which models are near each other (User Guide ch. 4, "Collision Spaces").
 *
 *  Change blocks. A space is changed between McdSpaceBeginChanges and McdSpaceEndChanges and asked outside; each such
 *  block is one step in the life of pairs. Each function says where it is legal; elsewhere it warns, changes nothing
 *  and returns 0. A space starts inside a block. Both of the guide's ways to step it work:
 *
 *      McdSpaceUpdateAll(s); McdSpaceEndChanges(s); ...pairs...; McdSpaceBeginChanges(s);     blocks by hand
 *      McdSpaceUpdateAll(s); ...pairs...;                       outside a block, McdSpaceUpdateAll opens and closes one
 *
 *  and in the second the first block, which the program never closes, ends with the first call that is legal only
 *  outside blocks, once McdSpaceUpdateAll was called in it.
 *
 *  Pairs. Two models are near each other when their boxes, grown by their contact tolerances, overlap on the axes that
 *  the space tests. A pair says hello in the block that finds it near, stays, and says goodbye in the block that does
 *  not find it near any more; it is the same McdModelPair throughout, and invalid from the next McdSpaceBeginChanges
 *  (or McdSpaceUpdateAll) after its goodbye. model1 is the one with the greater sort key, or created later. Each list
 *  comes in the order of model2, then model1, by sort keys, then creation.
 *
 *  A pair whose models are both frozen stays in silence: it is not reported, takes no time, and is kept as it is (its
 *  userData, responseData, cache) until one of the models is unfrozen; then it is reported as staying again, or says
 *  goodbye if they are not near any more. Removal of a model and disabling have it say goodbye as ever. Two models that
 *  are frozen before they are found near say hello when one of them is unfrozen.
 */
#ifndef MCDSPACE_H
#define MCDSPACE_H

#include "McdCullingTable.h"
#include "McdModelPairContainer.h"

ME_BEGIN_C

/** Axes, to be added up: 1, 2, 4, and all of them. */
extern MEPUBLIC const int McdXAxis, McdYAxis, McdZAxis, McdAllAxes;

/** Where McdSpaceGetPairs is; set by McdSpacePairIteratorBegin. */
typedef struct McdSpacePairIterator {
    MeU32 step;                  /**< Which step of the space it belongs to. */
    int goodbye, hello, staying; /**< How many were handed over. */
} McdSpacePairIterator;
/** Where McdSpaceGetModel is; set by McdSpaceModelIteratorBegin. */
typedef struct McdSpaceModelIterator {
    McdModelID next; /**< Null at the end. */
} McdSpaceModelIterator;
/** Renews a model's box by McdModelUpdate, McdModelUpdatePath or by its own means. What it may do else:
 *  docs/simulation.md, "Callbacks". */
typedef void(MEAPI *McdSpaceUpdateAABBFnPtr)(McdModelID m, MeReal duration);
/** Is the model to be looked at? It may not move models; what it destroys waits until the query is done, and is not met
 *  any more (docs/simulation.md, "Callbacks"). */
typedef int(MEAPI *McdLineSegIntersectEnableCallback)(McdModelID, void *filterData);

/** @name Life
 *  @{ */
/**
 * Creates an empty space, inside a change block.
 * @param axes        the sum of the axes on which boxes are compared; on the others all models count as overlapping.
 * @param objectCount how many models it can hold, 1 or more, or MeNoLimit.
 * @param pairCount   how many pairs there can be at one time, those in silence included, 1 or more, or MeNoLimit; what
 *                    does not fit gets a warning, is told to the pool-full handler, and says hello when there is room.
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
/** Destroys a space. Models in it leave it, and its pairs are gone. Null does nothing. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceDestroy(McdSpaceID s);
/** Says that most models are in: puts the tree of boxes in good order. Legal anywhere, needed nowhere. */
MEPUBLIC void MEAPI McdSpaceBuild(McdSpaceID s);
MEPUBLIC void MEAPI McdSpaceSetUserData(McdSpaceID s, void *data);
MEPUBLIC void *MEAPI McdSpaceGetUserData(McdSpaceID s);
/** Called for each pair that finds no room when it should say hello (docs/simulation.md, "Callbacks"); null: nothing.
 *  Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceSetPoolFullHandler(McdSpaceID space, McdSpacePoolErrorFnPtr handler);
MEPUBLIC McdSpacePoolErrorFnPtr MEAPI McdSpaceGetPoolFullHandler(McdSpaceID space);
/** @} */

/** @name Change blocks
 *  @{ */
/** Opens a block: pairs of the last step's goodbyes become invalid. Outside only. */
MEPUBLIC void MEAPI McdSpaceBeginChanges(McdSpaceID space);
/** Closes the block and finds the pairs. Inside only. */
MEPUBLIC void MEAPI McdSpaceEndChanges(McdSpaceID space);
/** 1 inside, 0 outside. */
MEPUBLIC int MEAPI McdSpaceIsChanging(McdSpaceID space);
/** @} */

/** @name Models
 *  @{ */
/**
 * Puts a model in, unfrozen, with the box of its last update; one that never was updated has none and no pairs until it
 * is. 1 if it is in now, 0 if not: it is in a space already, or the space is full. Inside only.
 */
MEPUBLIC MeBool MEAPI McdSpaceInsertModel(McdSpaceID s, McdModelID cm);
/** The same, then McdSpaceSetModelCullingParameters. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceInsertModelWithCulling(McdSpaceID s, McdModelID cm, McdCullingTable *table,
                                                     int cullingIndex, int cullingID);
/** Takes a model out; its pairs say goodbye, and it lives until they have. 1 if it was in a space. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceRemoveModel(McdModelID cm);
/** How many models are in it. Legal anywhere. */
MEPUBLIC int MEAPI McdSpaceGetModelCount(McdSpaceID space);
/** Before McdSpaceGetModel. Legal anywhere. */
MEPUBLIC void MEAPI McdSpaceModelIteratorBegin(McdSpaceID s, McdSpaceModelIterator *it);
/** Gets the next model, in the order of insertion; 0 at the end. The one just got may be removed. Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpaceGetModel(McdSpaceID s, McdSpaceModelIterator *it, McdModelID *cm);
/** @} */

/** @name Updating
 *  A model without a transform, or with one that is not finite, gets one warning and keeps its old box until it has a
 *  good one.
 *  @{ */
/** Renews the boxes of all models that are not frozen. Legal anywhere, see above. */
MEPUBLIC void MEAPI McdSpaceUpdateAll(McdSpaceID s);
/** The same, with boxes around the motion of the next duration (s) for models that are swept. Legal anywhere. */
MEPUBLIC void MEAPI McdSpacePathUpdateAll(McdSpaceID s, MeReal duration);
/** McdSpaceUpdateAll, inside only. */
MEPUBLIC void MEAPI McdSpaceUpdateModels(McdSpaceID s);
/** Renews one model's box; an error for a frozen one. Inside only. */
MEPUBLIC void MEAPI McdSpaceUpdateModel(McdModelID cm);
/**
 * How far ahead pairs and contacts are made, s, >= 0; default 0, as in Karma. A dynamics step long, it brings contacts
 * of models that would meet within the step: with a gap, before they penetrate. A model looks no farther than the
 * radius of the sphere around it; faster ones want McdSafeTime. Counts from the models' next update on. Legal anywhere.
 * Beyond Karma.
 */
MEPUBLIC void MEAPI McdSpaceSetLookAhead(McdSpaceID s, MeReal duration);
MEPUBLIC MeReal MEAPI McdSpaceGetLookAhead(McdSpaceID s);
/** What renews boxes; null: McdModelUpdate (McdModelUpdatePath for swept models). Outside only. */
MEPUBLIC void MEAPI McdSpaceSetAABBFn(McdSpaceID s, McdSpaceUpdateAABBFnPtr updateAABBFn);
/**
 * Says that a model does not move: it is not updated any more and keeps its box; pairs of two frozen models are not
 * reported, see above. Counts from the end of the next block on. Does not update it. 1 if the model is in a space.
 * Legal anywhere.
 */
MEPUBLIC MeBool MEAPI McdSpaceFreezeModel(McdModelID cm);
/** The opposite. */
MEPUBLIC MeBool MEAPI McdSpaceUnfreezeModel(McdModelID cm);
/** Is it frozen? Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpaceModelIsFrozen(McdModelID cm);
/** The same. */
MEPUBLIC MeBool MEAPI McdSpaceIsFrozen(McdModelID cm);
/** @} */

/** @name Pairs that never collide
 *  @{ */
/** The pair says goodbye and is not reported until it is enabled, or one of the models has left the space. 1 if both
 *  are in the same space, and for a model and itself, which never meet. Inside only. */
MEPUBLIC MeBool MEAPI McdSpaceDisablePair(McdModelID cm1, McdModelID cm2);
/** The opposite. */
MEPUBLIC MeBool MEAPI McdSpaceEnablePair(McdModelID cm1, McdModelID cm2);
/** 0 for pairs that are disabled, culled or filtered (McdModelSetFilter), and for models that are not in the same
 *  space. Legal anywhere. */
MEPUBLIC MeBool MEAPI McdSpacePairIsEnabled(McdModelID cm1, McdModelID cm2);
/** Two models act as disabled if they have the same table and ID and the table's flag for their indices is set. Null
 *  as table: none. An index that the table does not have gets a warning. Inside only. */
MEPUBLIC void MEAPI McdSpaceSetModelCullingParameters(McdSpaceID s, McdModelID cm, McdCullingTable *table,
                                                      int cullingIndex, int cullingID);
/** @} */

/** @name Pairs
 *  @{ */
/** Before McdSpaceGetPairs or McdSpaceGetTransitions, after the end of the block. Outside only. */
MEPUBLIC void MEAPI McdSpacePairIteratorBegin(McdSpaceID s, McdSpacePairIterator *iter);
/**
 * Fills a container (what was in it is dropped) with the pairs that come after the iterator: goodbye pairs first, then
 * hello and staying ones. Non-zero if there are more: use these, and call again. Outside only.
 *
 * The guide's samples leave out the iterator; then each step begins at the first pair and goes on while there are more.
 */
MEPUBLIC int MEAPI McdSpaceGetPairs(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c);
/** The same without staying pairs. */
MEPUBLIC int MEAPI McdSpaceGetTransitions(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c);
/** What the forms with two arguments stand for. */
MEPUBLIC int MEAPI McdSpaceGetNextPairs(McdSpaceID s, McdModelPairContainer *c);
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
 *  From inOrig to inDest, world frame (User Guide ch. 4, "Querying Line Segment Intersections"). A model is met at most
 *  once, where the segment enters it, as McdLineSegIntersect says; triangle lists only after
 *  McdTriangleListLineSegmentRegisterInteraction. Outside only.
 *  @{ */
/** The nearest model that is met; of several at the same distance, the one first in order. 1 if there is one. */
MEPUBLIC int MEAPI McdSpaceGetLineSegFirstIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                       McdLineSegIntersectResult *outResult);
/** The same among the models for which the callback returns non-zero. */
MEPUBLIC int MEAPI McdSpaceGetLineSegFirstEnabledIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                              McdLineSegIntersectEnableCallback filterCB,
                                                              void *filterData, McdLineSegIntersectResult *outResult);
/** The nearest inMaxListSize models that are met, by distance, then order; returns how many were written. */
MEPUBLIC int MEAPI McdSpaceGetLineSegIntersections(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                   McdLineSegIntersectResult *outList, int inMaxListSize);
/** @} */

ME_END_C

#endif
