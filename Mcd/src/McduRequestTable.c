/* The table of requests: the lower triangle of a matrix by request id, and one more for ids outside. */
#include "McduRequestTable.h"
#include "mcd_i.h"

static McdRequest *table;
static int idCount;

static int entryCount(void) {
    return idCount * (idCount + 1) / 2;
}

MeBool MEAPI McduRequestTableInit(int idMaxCount, McdRequest *defaultRequest) {
    const McdRequest builtIn = {20, MEFALSE};
    if (idMaxCount < 1 || idMaxCount > 10000) {
        MeWarning(1, "McduRequestTableInit: idMaxCount is %d (1 .. 10000)", idMaxCount);
        return MEFALSE;
    }
    const int count = idMaxCount * (idMaxCount + 1) / 2;
    McdRequest *made = MeMemoryTake((size_t)count + 1, sizeof *made, "McduRequestTableInit", "requests");
    if (!made)
        return MEFALSE;
    for (int i = 0; i <= count; i++)
        made[i] = defaultRequest ? *defaultRequest : builtIn;
    McduRequestTableTerm();
    table = made;
    idCount = idMaxCount;
    return METRUE;
}

void MEAPI McduRequestTableTerm(void) {
    MeMemoryGive(table);
    table = 0;
    idCount = 0;
}

static McdRequest *entryOf(int id1, int id2, const char *function) {
    if (!table) {
        MeWarning(1, "%s: there is no table: see McduRequestTableInit", function);
        return 0;
    }
    if (id1 < 0 || id2 < 0 || id1 >= idCount || id2 >= idCount) {
        MeWarning(1, "%s: request ids %d and %d are not both 0 .. %d", function, id1, id2, idCount - 1);
        return &table[entryCount()];
    }
    const int high = MeMAX(id1, id2), low = MeMIN(id1, id2);
    MEASSERT(high * (high + 1) / 2 + low < entryCount());
    return &table[high * (high + 1) / 2 + low];
}

void MEAPI McduRequestTableSetRequest(int requestId1, int requestId2, McdRequest *request) {
    McdRequest *entry = entryOf(requestId1, requestId2, "McduRequestTableSetRequest");
    if (entry && entry != &table[entryCount()])
        *entry = request ? *request : table[entryCount()];
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
