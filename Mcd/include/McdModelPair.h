/** @file McdModelPair.h
 *  Pairs of models.
 */
#ifndef MCDMODELPAIR_H
#define MCDMODELPAIR_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Creates a pair of two models; null, with a warning, unless both are models of one framework, and different.
 *  McdModelPairDestroy frees it. */
MEPUBLIC McdModelPairID MEAPI McdModelPairCreate(McdModelID m1, McdModelID m2);
/** Destroys a pair made by McdModelPairCreate; call McdGoodbye before. Null is ignored. */
MEPUBLIC void MEAPI McdModelPairDestroy(McdModelPairID p);
/** Makes the record a new pair of these models. Not between McdHello and McdGoodbye. */
MEPUBLIC void MEAPI McdModelPairReset(McdModelPairID p, McdModelID m1, McdModelID m2);
/** Sets the pair's request, by pointer; null: the framework's default. Not between McdHello and McdGoodbye. */
MEPUBLIC void MEAPI McdModelPairSetRequestPtr(McdModelPairID p, McdRequest *request);
/** The pair's request or, if it has none, the framework's default. */
MEPUBLIC McdRequest *MEAPI McdModelPairGetRequestPtr(const McdModelPairID p);
/** Both models. */
MEPUBLIC void MEAPI McdModelPairGetModels(McdModelPairID p, McdModelID *m1, McdModelID *m2);
/** The names of both geometry types. */
MEPUBLIC void MEAPI McdModelPairGetGeometryNames(McdModelPairID p, const char **name1, const char **name2);
/** A pointer of the program's, which nothing reads. Default null. */
MEPUBLIC void MEAPI McdModelPairSetUserData(McdModelPairID p, void *data);
/** The pointer of McdModelPairSetUserData; null by default. */
MEPUBLIC void *MEAPI McdModelPairGetUserData(McdModelPairID p);

ME_END_C

#endif
