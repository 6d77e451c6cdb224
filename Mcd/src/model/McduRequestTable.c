/* The table of requests: the lower triangle of a matrix indexed by request ids, and one more entry for ids out of
 * range.
 *
 * There is one table per process, since the functions take no framework. It is replaced by an atomic exchange, so
 * that two threads that replace or free it at once do not free it twice. */
#include "McduRequestTable.h"
#include "model/mcd_result_i.h"

typedef struct Table {
    int idCount;
    McdRequest request[]; /* entryCount(idCount) entries, then the default */
} Table;

static _Atomic(Table *) table;

static int entryCount(int idCount) {
    return idCount * (idCount + 1) / 2;
}

MeBool MEAPI McduRequestTableInit(int idMaxCount, McdRequest *defaultRequest) {
    const McdRequest builtIn = {20, MEFALSE};
    if (idMaxCount < 1 || idMaxCount > 10000) {
        MeWarning(1, "McduRequestTableInit: idMaxCount is %d (1 .. 10000)", idMaxCount);
        return MEFALSE;
    }
    const int count = entryCount(idMaxCount);
    Table *made =
        MeMemoryTake(1, sizeof *made + ((size_t)count + 1) * sizeof *made->request, "McduRequestTableInit", "requests");
    if (!made)
        return MEFALSE;
    made->idCount = idMaxCount;
    for (int i = 0; i <= count; i++)
        made->request[i] = defaultRequest ? *defaultRequest : builtIn;
    MeMemoryGive(atomic_exchange(&table, made));
    return METRUE;
}

void MEAPI McduRequestTableTerm(void) {
    MeMemoryGive(atomic_exchange(&table, (Table *)0));
}

static McdRequest *entryOf(int id1, int id2, const char *function) {
    Table *t = atomic_load(&table);
    if (!t) {
        MeWarning(1, "%s: there is no table: see McduRequestTableInit", function);
        return 0;
    }
    if (id1 < 0 || id2 < 0 || id1 >= t->idCount || id2 >= t->idCount) {
        MeWarning(1, "%s: request ids %d and %d are not both 0 .. %d", function, id1, id2, t->idCount - 1);
        return &t->request[entryCount(t->idCount)];
    }
    const int high = MeMAX(id1, id2), low = MeMIN(id1, id2), entry = entryCount(high) + low;
    MEASSERT(entry < entryCount(t->idCount));
    return &t->request[entry];
}

void MEAPI McduRequestTableSetRequest(int requestId1, int requestId2, McdRequest *request) {
    McdRequest *entry = entryOf(requestId1, requestId2, "McduRequestTableSetRequest");
    const Table *t = atomic_load(&table);
    const McdRequest *other = t ? &t->request[entryCount(t->idCount)] : 0;
    if (entry && entry != other)
        *entry = request ? *request : *other;
}

McdRequest *MEAPI McduRequestTableGetRequestPtr(int id1, int id2) {
    return entryOf(id1, id2, "McduRequestTableGetRequestPtr");
}

static McdRequest *entryOfPair(const McdModelPair *p, const char *function) {
    if (!p || !mcd_modelCheck(p->model1, function) || !mcd_modelCheck(p->model2, function))
        return 0;
    return entryOf(mcd_record(p->model1)->requestId, mcd_record(p->model2)->requestId, function);
}

void MEAPI McduRequestTableGetRequest(McdModelPair *pair, McdRequest *request) {
    const McdRequest *entry = entryOfPair(pair, "McduRequestTableGetRequest");
    if (entry && request)
        *request = *entry;
}

void MEAPI McduHelloRequestTableCB(McdModelPair *p) {
    McdRequest *entry = entryOfPair(p, "McduHelloRequestTableCB");
    if (entry)
        McdModelPairSetRequestPtr(p, entry);
}
