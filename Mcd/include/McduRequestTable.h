/** @file McduRequestTable.h
 *  Requests by the request ids of both models (McdModelSetRequestID): one table for the program (User Guide ch. 4,
 *  "Testing for Collisions").
 *
 *  It belongs to the process, not to a framework, of which these functions know nothing: the frameworks of several
 *  threads share it. Make and fill it before they run and end it after them; meanwhile any thread may read it. A
 *  framework that wants requests of its own sets them itself, by McdModelPairSetRequestPtr or
 *  McdFrameworkSetDefaultRequestPtr.
 *
 *  The order of two ids does not matter. An id outside of the table gets a warning and the default request.
 */
#ifndef MCDUREQUESTTABLE_H
#define MCDUREQUESTTABLE_H

#include "McdCTypes.h"

ME_BEGIN_C

/**
 * Makes the table for ids 0 .. idMaxCount - 1, replacing any earlier one. All entries, and what ids outside get, are a
 * copy of @a defaultRequest; null: at most 20 contacts. 0, with a warning, if idMaxCount is not 1 .. 10000.
 */
MEPUBLIC MeBool MEAPI McduRequestTableInit(int idMaxCount, McdRequest *defaultRequest);
/** Frees it. Pairs must not use its requests any more. */
MEPUBLIC void MEAPI McduRequestTableTerm(void);
/** Sets the request of two ids; copied. Null: the default one. */
MEPUBLIC void MEAPI McduRequestTableSetRequest(int requestId1, int requestId2, McdRequest *request);
/** The request of two ids: a pointer into the table, good until McduRequestTableTerm. Null, with a warning, without a
 *  table. */
MEPUBLIC McdRequest *MEAPI McduRequestTableGetRequestPtr(int id1, int id2);
/** Copies the request of the pair's models. */
MEPUBLIC void MEAPI McduRequestTableGetRequest(McdModelPair *pair, McdRequest *request);
/** Sets the request of a pair from the table: for hello pairs, before McdHello. */
MEPUBLIC void MEAPI McduHelloRequestTableCB(McdModelPair *p);

ME_END_C

#endif
