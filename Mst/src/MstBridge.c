/* The bridge: the material table, and the loop over pairs. */
#include "McdInteractions.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "mst_i.h"
#include <string.h>

MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function) {
    MstBridgeRecord *record = (MstBridgeRecord *)b;
    if (record && record->magic == MST_BRIDGE)
        return record;
    MeWarning(1, "%s: %p is no bridge", function, (void *)b);
    return 0;
}

/* ---- life ---------------------------------------------------------------------------------------------------- */

static size_t pairCount(unsigned int materials) {
    return (size_t)materials * (materials + 1) / 2;
}

static void freeAll(MstBridgeRecord *b) {
    if (b->bridge.pairs)
        McdModelPairContainerDestroy(b->bridge.pairs);
    MeMemoryAPI.destroy(b->materials);
    MeMemoryAPI.destroy(b->contacts);
    MeMemoryAPI.destroy(b->done);
    mst_eventsTerm(b);
    MeMemoryAPI.destroy(b->hurried);
    MeMemoryAPI.destroy(b);
}

static void resetMaterials(MstBridgeRecord *b) {
    memset(b->materials, 0, pairCount(b->materialMax) * sizeof *b->materials);
    for (size_t i = 0; i < pairCount(b->materialMax); i++)
        MdtContactParamsReset(&b->materials[i].params);
}

MstBridgeID MEAPI MstBridgeCreate(McdFrameworkID frame, const unsigned int maxMaterials) {
    if (maxMaterials == 0 || maxMaterials > 10000)
        MeWarning(1, "MstBridgeCreate: maxMaterials is %u: it must be 1 .. 10000", maxMaterials);
    MstBridgeRecord *b = MeMemoryAPI.create(sizeof *b);
    if (!b) {
        MeFatalError(1, "MstBridgeCreate: no memory");
        return 0;
    }
    memset(b, 0, sizeof *b);
    b->frame = frame;
    b->materialMax = MeCLAMP(maxMaterials, 1, 10000);
    b->materialCount = 1;
    b->contactMax = MST_CONTACTS;
    b->materials = MeMemoryAPI.create(pairCount(b->materialMax) * sizeof *b->materials);
    b->contacts = MeMemoryAPI.create(b->contactMax * sizeof *b->contacts);
    b->done = MeMemoryAPI.create(b->contactMax * sizeof *b->done);
    b->bridge.pairs = McdModelPairContainerCreate(MST_PAIRS);
    if (!b->materials || !b->contacts || !b->done || !b->bridge.pairs) {
        freeAll(b);
        MeFatalError(1, "MstBridgeCreate: no memory for %u materials", maxMaterials);
        return 0;
    }
    resetMaterials(b);
    b->magic = MST_BRIDGE;
    return &b->bridge;
}

void MEAPI MstBridgeDestroy(const MstBridgeID b) {
    MstBridgeRecord *record = b ? mst_bridgeCheck(b, "MstBridgeDestroy") : 0;
    if (!record)
        return;
    record->magic = 0;
    freeAll(record);
}

/* ---- materials ------------------------------------------------------------------------------------------------ */

MstMaterialID MEAPI MstBridgeGetNewMaterial(const MstBridgeID b) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetNewMaterial");
    if (!record)
        return MstBridgeGetDefaultMaterial();
    if (record->materialCount == record->materialMax) {
        MeWarning(1,
                  "MstBridgeGetNewMaterial: there are %u materials already: raise MstBridgeCreate's maxMaterials, or "
                  "the universe's materialsMaxCount",
                  record->materialMax);
        return MstBridgeGetDefaultMaterial();
    }
    return record->materialCount++;
}

static MstMaterialID known(const MstBridgeRecord *b, MstMaterialID m) {
    if (m < b->materialCount)
        return m;
    MeWarning(1, "MstBridge: there is no material %u; there are %u. The default one is taken", m, b->materialCount);
    return MstBridgeGetDefaultMaterial();
}

MstMaterialPair *mst_materialPair(MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2) {
    const MstMaterialID a = known(b, m1), c = known(b, m2), high = MeMAX(a, c), low = MeMIN(a, c);
    return &b->materials[(size_t)high * (high + 1) / 2 + low];
}

static MstMaterialPair *pairOf(MstBridgeID b, MstMaterialID m1, MstMaterialID m2, const char *function) {
    MstBridgeRecord *record = mst_bridgeCheck(b, function);
    return record ? mst_materialPair(record, m1, m2) : 0;
}

MdtContactParamsID MEAPI MstBridgeGetContactParams(const MstBridgeID b, const MstMaterialID m1,
                                                   const MstMaterialID m2) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetContactParams");
    return pair ? &pair->params : 0;
}

void MEAPI MstBridgeSetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                   const MstIntersectCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetIntersectCB");
    if (pair)
        pair->intersectCb = cb;
}

MstIntersectCBPtr MEAPI MstBridgeGetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetIntersectCB");
    return pair ? pair->intersectCb : 0;
}

void MEAPI MstBridgeSetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                    const MstPerContactCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetPerContactCB");
    if (pair)
        pair->perContactCb = cb;
}

MstPerContactCBPtr MEAPI MstBridgeGetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetPerContactCB");
    return pair ? pair->perContactCb : 0;
}

void MEAPI MstBridgeSetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                 const MstPerPairCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetPerPairCB");
    if (pair)
        pair->perPairCb = cb;
}

MstPerPairCBPtr MEAPI MstBridgeGetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetPerPairCB");
    return pair ? pair->perPairCb : 0;
}

void MEAPI MstBridgeSetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                               const MstTouchCBPtr cb) {
    MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeSetTouchCB");
    if (pair)
        pair->touchCb = cb;
}

MstTouchCBPtr MEAPI MstBridgeGetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = pairOf(b, m1, m2, "MstBridgeGetTouchCB");
    return pair ? pair->touchCb : 0;
}

/* ---- each step ------------------------------------------------------------------------------------------------- */

void MEAPI MstHandleTransitionsOf(McdModelPairContainer *pairs) {
    if (!pairs) {
        MeWarning(1, "MstHandleTransitions: no container");
        return;
    }
    for (int i = pairs->goodbyeFirst; i < pairs->goodbyeEnd; i++)
        mst_pairForget(pairs->array[i]);
    McdGoodbyeEach(pairs);
    McdHelloEach(pairs);
}

void MEAPI(MstHandleTransitions)(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                 const MstBridgeID b) {
    (void)s, (void)w, (void)b;
    MstHandleTransitionsOf(pairs);
}

static MeBool isAsleep(McdModelID m) {
    return McdModelGetSpace(m) && McdSpaceModelIsFrozen(m);
}

void MEAPI MstHandleCollisions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                               const MstBridgeID b) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstHandleCollisions");
    if (!record || !pairs)
        return;
    for (int i = pairs->helloFirst; i < pairs->stayingEnd; i++)
        if (!isAsleep(pairs->array[i]->model1) || !isAsleep(pairs->array[i]->model2))
            mst_pairCollide(record, pairs->array[i], s, w);
}

void MEAPI MstBridgeUpdateContacts(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    McdSpacePairIterator iterator;
    int isMore;
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeUpdateContacts");
    if (!record)
        return;
    if (record->part == 0)
        mst_eventsBegin(record);
    mst_hurryNobody(record);
    record->ahead = McdSpaceGetLookAhead(s);
    McdSpaceEndChanges(s);
    McdSpacePairIteratorBegin(s, &iterator);
    do {
        McdModelPairContainerReset(b->pairs);
        isMore = McdSpaceGetPairs(s, &iterator, b->pairs);
        MstHandleTransitionsOf(b->pairs);
        MstHandleCollisions(b->pairs, s, w, b);
    } while (isMore);
    McdSpaceBeginChanges(s);
}

void MEAPI MstBridgeUpdateTransitions(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w) {
    McdSpacePairIterator iterator;
    int isMore;
    (void)w;
    if (!mst_bridgeCheck(b, "MstBridgeUpdateTransitions"))
        return;
    McdSpaceEndChanges(s);
    McdSpacePairIteratorBegin(s, &iterator);
    do {
        McdModelPairContainerReset(b->pairs);
        isMore = McdSpaceGetTransitions(s, &iterator, b->pairs);
        MstHandleTransitionsOf(b->pairs);
    } while (isMore);
    McdSpaceBeginChanges(s);
}

/* ---- buffers ---------------------------------------------------------------------------------------------------- */

void MEAPI MstBridgeSetContactBufferSize(const MstBridgeID b, const unsigned int s) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetContactBufferSize");
    if (!record)
        return;
    McdContact *contacts = s ? MeMemoryAPI.create(s * sizeof *contacts) : 0;
    MdtContactID *done = s ? MeMemoryAPI.create(s * sizeof *done) : 0;
    if (!contacts || !done) {
        MeWarning(1, "MstBridgeSetContactBufferSize: %u contacts are too few, or too many for the memory", s);
        MeMemoryAPI.destroy(contacts);
        MeMemoryAPI.destroy(done);
        return;
    }
    MeMemoryAPI.destroy(record->contacts);
    MeMemoryAPI.destroy(record->done);
    record->contacts = contacts;
    record->done = done;
    record->contactMax = s;
}

void MEAPI MstBridgeSetModelPairBufferSize(const MstBridgeID b, const unsigned int s) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeSetModelPairBufferSize");
    if (!record)
        return;
    McdModelPairContainer *pairs = s >= 8 && s < 0x7fffffff ? McdModelPairContainerCreate((int)s) : 0;
    if (!pairs) {
        MeWarning(1, "MstBridgeSetModelPairBufferSize: %u pairs are too few, or too many for the memory", s);
        return;
    }
    McdModelPairContainerDestroy(record->bridge.pairs);
    record->bridge.pairs = pairs;
}
