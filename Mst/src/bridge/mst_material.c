/* The bridge's table of materials, and the check of its handle. */
#include "McdContact.h"
#include "McdFrame.h"
#include "McdInternal.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "bridge/mst_bridge_i.h"
#include <string.h>

/* ---- handles ---- */

void mst_warnGone(const void *p, const char *what, const char *function) {
    if (p)
        MeWarning(1, "%s: %p is no %s: it has been destroyed, or never was one", function, p, what);
    else
        MeWarning(1, "%s: null is no %s", function, what);
}

MstBridgeRecord *mst_bridgeCheck(MstBridgeID b, const char *function) {
    MstBridgeRecord *record = (MstBridgeRecord *)b;
    if (record && MST_IS_KNOWN(b, MST_BRIDGE) && record->magic == MST_BRIDGE)
        return record;
    mst_warnGone(b, "bridge", function);
    return 0;
}

/* ---- materials ------------------------------------------------------------------------------------------------ */

/* Adds a row of pairs: the new material with itself and all earlier ones. Rows are never moved. */
MeBool mst_materialAdd(MstBridgeRecord *b, const char *function) {
    const unsigned int m = b->materialCount, more = m ? 2 * m : 8;
    if (m == b->materialRoom) {
        if (!MeMemoryGrow(&b->materials, m, more, sizeof *b->materials, function, "materials"))
            return MEFALSE;
        b->materialRoom = more;
    }
    MstMaterialRecord *row = MeMemoryTakeZeroed((size_t)m + 1, sizeof *row, function, "a material");
    if (!row)
        return MEFALSE;
    for (unsigned int i = 0; i <= m; i++) {
        MdtContactParamsReset(&row[i].pair.params);
        row[i].pair.params.velThreshold *= McdFrameworkGetLengthScale(b->frame);
        row[i].known = row[i].pair.params;
    }
    MEASSERT(b->materialCount < b->materialRoom);
    b->materials[b->materialCount++] = row;
    return METRUE;
}

MstMaterialID MEAPI MstBridgeGetNewMaterial(const MstBridgeID b) {
    MstBridgeRecord *record = mst_bridgeCheck(b, "MstBridgeGetNewMaterial");
    if (!record)
        return MstBridgeGetDefaultMaterial();
    const MstMaterialID m = record->materialCount;
    if (m >= (MstMaterialID)record->materialLimit.max) {
        MeLimitWarn(&record->materialLimit, "MstBridgeGetNewMaterial", "more materials");
        return MstBridgeGetDefaultMaterial();
    }
    return mst_materialAdd(record, "MstBridgeGetNewMaterial") ? m : MstBridgeGetDefaultMaterial();
}

static MstMaterialID knownMaterial(const MstBridgeRecord *b, MstMaterialID m, const char *function) {
    if (m < b->materialCount)
        return m;
    MeWarning(1, "%s: there is no material %u; there are %u: see MstBridgeGetNewMaterial. The default one is taken",
              MeCallerName(function), m, b->materialCount);
    return MstBridgeGetDefaultMaterial();
}

static MstMaterialPair *materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2,
                                     const char *function) {
    const MstMaterialID a = knownMaterial(b, m1, function), c = knownMaterial(b, m2, function);
    const MstMaterialID high = MeMAX(a, c), low = MeMIN(a, c);
    MEASSERT(high < b->materialCount && b->materialCount <= b->materialRoom);
    return &b->materials[high][low].pair;
}

MstMaterialPair *mst_materialPair(const MstBridgeRecord *b, MstMaterialID m1, MstMaterialID m2) {
    return materialPair(b, m1, m2, "MstHandleCollisions");
}

MstMaterialPair *mst_materialsOf(const MstBridgeRecord *b, const McdContact *c) {
    return mst_materialPair(b, McdContactGetMaterial(c, 0), McdContactGetMaterial(c, 1));
}

unsigned long mst_materialVersion(MstBridgeRecord *b, MstMaterialPair *pair) {
    MstMaterialRecord *record = (MstMaterialRecord *)pair;
    if (record->comparedIn == b->round)
        return record->version;
    record->comparedIn = b->round;
    if (record->version == 0 || memcmp(&record->pair, &record->seen, sizeof record->pair) != 0) {
        record->seen = record->pair;
        record->version = ++b->lastVersion;
    }
    MEASSERT(record->version <= b->lastVersion);
    return record->version;
}

static MstMaterialPair *materialPairFor(MstBridgeID b, MstMaterialID m1, MstMaterialID m2, const char *function) {
    const char *const before = MeMessagesAs(function); /* with two unknown materials, only one warning */
    MstBridgeRecord *record = mst_bridgeCheck(b, function);
    MstMaterialPair *pair = record ? materialPair(record, m1, m2, function) : 0;
    MeMessagesAs(before);
    return pair;
}

MdtContactParamsID MEAPI MstBridgeGetContactParams(const MstBridgeID b, const MstMaterialID m1,
                                                   const MstMaterialID m2) {
    MstMaterialPair *pair = materialPairFor(b, m1, m2, "MstBridgeGetContactParams");
    return pair ? &pair->params : 0;
}

/* Functions that set and return a callback of a pair of materials. */
#define CALLBACK(Name, member)                                                                                         \
    void MEAPI MstBridgeSet##Name##CB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,             \
                                      const Mst##Name##CBPtr cb) {                                                     \
        MstMaterialPair *pair = materialPairFor(b, m1, m2, __func__);                                                  \
        if (!pair)                                                                                                     \
            return;                                                                                                    \
        pair->member = cb;                                                                                             \
        mst_wakeBodiesOfMaterials((const MstBridgeRecord *)b, pair);                                                   \
    }                                                                                                                  \
    Mst##Name##CBPtr MEAPI MstBridgeGet##Name##CB(const MstBridgeID b, const MstMaterialID m1,                         \
                                                  const MstMaterialID m2) {                                            \
        const MstMaterialPair *pair = materialPairFor(b, m1, m2, __func__);                                            \
        return pair ? pair->member : 0;                                                                                \
    }

CALLBACK(Intersect, intersectCb)
CALLBACK(PerContact, perContactCb)
CALLBACK(PerPair, perPairCb)

void MEAPI MstBridgeSetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                               const MstTouchCBPtr cb) {
    MstMaterialPair *pair = materialPairFor(b, m1, m2, "MstBridgeSetTouchCB");
    if (!pair)
        return;
    ((MstBridgeRecord *)b)->events.callbacks += (cb != 0) - (pair->touchCb != 0);
    MEASSERT(((MstBridgeRecord *)b)->events.callbacks >= 0);
    pair->touchCb = cb;
}

MstTouchCBPtr MEAPI MstBridgeGetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2) {
    const MstMaterialPair *pair = materialPairFor(b, m1, m2, "MstBridgeGetTouchCB");
    return pair ? pair->touchCb : 0;
}
