/** @file McdInteractions.h
 *  What can be asked of a pair of models (User Guide ch. 4, "Testing for Collisions").
 *
 *  McdHello comes before the queries of a pair and McdGoodbye after them. Models in a space are up to date after the
 *  space's update, others after McdModelUpdate.
 *
 *  Queries may run in several threads at once, and within the callbacks of others, while nothing that they are about is
 *  changed. (McdIntersectAt changes the models of its pair meanwhile.)
 */
#ifndef MCDINTERACTIONS_H
#define MCDINTERACTIONS_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Prepares a pair. Warns once per pair of types that has no interaction. */
MEPUBLIC void MEAPI McdHello(McdModelPair *p);
/** Ends what McdHello began. */
MEPUBLIC void MEAPI McdGoodbye(McdModelPair *p);
/** McdHello for each hello pair of a container. */
MEPUBLIC void MEAPI McdHelloEach(McdModelPairContainer *pairs);
/** McdGoodbye for each goodbye pair of a container. */
MEPUBLIC void MEAPI McdGoodbyeEach(McdModelPairContainer *pairs);

/** The farfield test of one pair: do the boxes, grown by the contact tolerances, overlap? */
MEPUBLIC MeBool MEAPI McdNearby(McdModelPair *p);
/**
 * Finds the contacts of a pair (see McdIntersectResult; set contacts and contactMaxCount before). Returns 1 if the pair
 * has an interaction; then contactCount, touch and normal are set. Contacts whose gap is at most the sum of the models'
 * tolerances are made; the deepest are kept if there are more than contactMaxCount or the pair's request allow.
 * The guide also shows a form with a third argument, which is McdIntersectAt.
 */
MEPUBLIC MeBool MEAPI McdIntersect(McdModelPair *p, McdIntersectResult *result);
/** McdIntersect with both models where their velocities will have taken them after @a time (s). */
MEPUBLIC MeBool MEAPI McdIntersectAt(McdModelPair *p, McdIntersectResult *result, MeReal time);
#ifdef __cplusplus
ME_END_C
inline MeBool McdIntersect(McdModelPair *p, McdIntersectResult *result, MeReal time) {
    return McdIntersectAt(p, result, time);
}
ME_BEGIN_C
#else
#define MCD_FOURTH(a, b, c, d, ...) d
#define McdIntersectWith2(p, r)     (McdIntersect)((p), (r))
#define McdIntersectWith3(p, r, t)  McdIntersectAt((p), (r), (t))
#define McdIntersect(...)                                                                                              \
    MCD_FOURTH(__VA_ARGS__, McdIntersectWith3, McdIntersectWith2, McdIntersect_takes_2_or_3_arguments, 0)(__VA_ARGS__)
#endif
/**
 * McdIntersect for the hello and staying pairs of a container from *pairsIter on, as far as the arrays reach. Returns 1
 * if there is more: use up the results and call again.
 */
MEPUBLIC MeBool MEAPI McdIntersectEach(McdModelPairContainer *pairs, McdModelPairContainerIterator *pairsIter,
                                       McdIntersectResult *resultArray, int resultArraySize, int *resultCount,
                                       McdContact *contactArray, int contactArraySize, int *contactCount);
/**
 * How long the models may move at their present velocities, linear and angular, before they touch: at most maxTime (s).
 * 0 for models that touch now. Returns 1 if the pair can be asked; time is maxTime then and otherwise by default.
 */
MEPUBLIC MeBool MEAPI McdSafeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);
/**
 * How far apart the models are, and their nearest points. Returns 1 where one is made of convex parts and the other one
 * of convex parts, planes, triangle lists and height fields, which count as surfaces with nothing inside; 0, with a
 * result of zeros, for all else. Needs no interaction and no McdHello. Beyond Karma.
 */
MEPUBLIC MeBool MEAPI McdDistance(McdModelPair *p, McdDistanceResult *result);
/**
 * Intersects the segment from inOrig to inDest (world) with a model. Returns 1 and fills the result for the first point
 * where the segment enters the model, else 0. If inOrig is inside: distance 0, position inOrig, normal undefined.
 */
MEPUBLIC unsigned int MEAPI McdLineSegIntersect(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                                McdLineSegIntersectResult *outOverlap);

ME_END_C

#endif
