/** @file McduRequestTable.h
 *  A table of requests, by the request ids of both models (McdModelSetRequestID): one for the whole program.
 *
 *  The table belongs to the process, not to a framework: frameworks in several threads share it. Create and fill it
 *  before they run and free it after them; meanwhile any thread may read it. A framework that needs its own requests
 *  sets them by McdModelPairSetRequestPtr or McdFrameworkSetDefaultRequestPtr.
 *
 *  The order of two ids does not matter. An id out of the table's range gets a warning and the default request.
 */
#ifndef MCDUREQUESTTABLE_H
#define MCDUREQUESTTABLE_H

#include "McdCTypes.h"

ME_BEGIN_C

/**
 * Creates the table for ids 0 .. idMaxCount - 1, replacing any earlier one. All entries, and the default for ids out of
 * range, are copies of @a defaultRequest; null: at most 20 contacts. 0, with a warning, if idMaxCount is not 1 ..
 * 10000.
 */
MEPUBLIC MeBool MEAPI McduRequestTableInit(int idMaxCount, McdRequest *defaultRequest);
/** Frees the table. Pairs must no longer use its requests. */
MEPUBLIC void MEAPI McduRequestTableTerm(void);
/** Sets the request of two ids; copied. Null: the default. */
MEPUBLIC void MEAPI McduRequestTableSetRequest(int requestId1, int requestId2, McdRequest *request);
/** The request of two ids: a pointer into the table, valid until McduRequestTableTerm. Null, with a warning, if
 *  there is no table. */
MEPUBLIC McdRequest *MEAPI McduRequestTableGetRequestPtr(int id1, int id2);
/** Copies the request for the pair's models. */
MEPUBLIC void MEAPI McduRequestTableGetRequest(McdModelPair *pair, McdRequest *request);
/** Sets the pair's request from the table: for hello pairs, before McdHello. */
MEPUBLIC void MEAPI McduHelloRequestTableCB(McdModelPair *p);

ME_END_C

#endif
