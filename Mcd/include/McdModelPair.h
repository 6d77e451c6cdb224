/** @file McdModelPair.h
 *  Pairs of models (User Guide ch. 4, "Testing Collision Directly").
 */
#ifndef MCDMODELPAIR_H
#define MCDMODELPAIR_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Creates a pair of two models; null, with a warning, unless both are models. McdModelPairDestroy gives it back. */
MEPUBLIC McdModelPairID MEAPI McdModelPairCreate(McdModelID m1, McdModelID m2);
/** Destroys a pair that McdModelPairCreate made, after McdGoodbye. Null does nothing. */
MEPUBLIC void MEAPI McdModelPairDestroy(McdModelPairID p);
/** Makes it a new pair of these models. Not between McdHello and McdGoodbye. */
MEPUBLIC void MEAPI McdModelPairReset(McdModelPairID p, McdModelID m1, McdModelID m2);
/** What is asked for, by pointer; null: the framework's default. Not between McdHello and McdGoodbye. */
MEPUBLIC void MEAPI McdModelPairSetRequestPtr(McdModelPairID p, McdRequest *request);
/** That request: its own or the framework's. */
MEPUBLIC McdRequest *MEAPI McdModelPairGetRequestPtr(const McdModelPairID p);
/** Both models. */
MEPUBLIC void MEAPI McdModelPairGetModels(McdModelPairID p, McdModelID *m1, McdModelID *m2);
/** The names of both geometry types. */
MEPUBLIC void MEAPI McdModelPairGetGeometryNames(McdModelPairID p, const char **name1, const char **name2);
MEPUBLIC void MEAPI McdModelPairSetUserData(McdModelPairID p, void *data);
MEPUBLIC void *MEAPI McdModelPairGetUserData(McdModelPairID p);

ME_END_C

#endif
