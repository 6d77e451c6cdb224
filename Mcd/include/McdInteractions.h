/** @file McdInteractions.h
 *  Queries of a pair of models.
 *
 *  McdHello must be called before the queries of a pair and McdGoodbye after them. Models in a space are up to date
 *  after the space's update, others after McdModelUpdate.
 *
 *  Queries may run in several threads at once, and within callbacks of other queries, while none of their models is
 *  changed. (McdIntersectAt temporarily changes the models of its pair.)
 */
#ifndef MCDINTERACTIONS_H
#define MCDINTERACTIONS_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Prepares a pair for its interaction. Warns once per pair of types without an interaction. */
MEPUBLIC void MEAPI McdHello(McdModelPair *p);
/** Releases what McdHello prepared. */
MEPUBLIC void MEAPI McdGoodbye(McdModelPair *p);
/** McdHello for each hello pair of a container. */
MEPUBLIC void MEAPI McdHelloEach(McdModelPairContainer *pairs);
/** McdGoodbye for each goodbye pair of a container. */
MEPUBLIC void MEAPI McdGoodbyeEach(McdModelPairContainer *pairs);

/** The broad phase test of one pair: whether the boxes, grown by the contact tolerances, overlap. */
MEPUBLIC MeBool MEAPI McdNearby(McdModelPair *p);
/**
 * Finds the contacts of a pair (see McdIntersectResult; set contacts and contactMaxCount before). Returns 1 if the pair
 * has an interaction; then contactCount, touch and normal are set. There are contacts where the gap is at most the sum
 * of the models' tolerances; if there are more than contactMaxCount or the pair's request allows, the deepest are kept.
 * The guide also shows a form with a third argument, which is McdIntersectAt.
 */
MEPUBLIC MeBool MEAPI McdIntersect(McdModelPair *p, McdIntersectResult *result);
/** McdIntersect with both models moved by their velocities for @a time (s). */
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
 * McdIntersect for the hello and staying pairs of a container from *pairsIter on, until the arrays are full. Returns 1
 * if pairs are left: process the results and call again.
 */
MEPUBLIC MeBool MEAPI McdIntersectEach(McdModelPairContainer *pairs, McdModelPairContainerIterator *pairsIter,
                                       McdIntersectResult *resultArray, int resultArraySize, int *resultCount,
                                       McdContact *contactArray, int contactArraySize, int *contactCount);
/**
 * How long the models may move at their current linear and angular velocities before they touch: at most maxTime (s); 0
 * for models that touch now. Returns 1 if the pair supports this; otherwise 0, and time is maxTime. It is also maxTime
 * if the models do not touch before.
 */
MEPUBLIC MeBool MEAPI McdSafeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result);
/**
 * The distance of two models, and their closest points. Returns 1 if one model has only convex child shapes, and the
 * other one only convex child shapes, planes, triangle lists and height fields; the latter two are surfaces without an
 * inside. Otherwise 0, and a result of zeros. Needs no interaction and no McdHello. Beyond Karma.
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
