/* Universes: collision and dynamics in one. */
#include "MstUniverse.h"
#include "MstEvents.h"
#include "McdFrame.h"
#include "McdAll.h"
#include "MdtWorld.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "mst_i.h"
#include <string.h>

const MstUniverseSizes MstUniverseDefaultSizes = {100, 500, 0, 100, 500, 100, 10, 1, 1};

typedef struct MstUniverseRecord {
    MstUniverse universe; /* what programs see: first */
    MeU32 magic;
} MstUniverseRecord;

static MeBool isUniverse(MstUniverseID u, const char *function) {
    if (u && ((const MstUniverseRecord *)u)->magic == MST_UNIVERSE)
        return METRUE;
    MeWarning(1, "%s: %p is no universe", function, (void *)u);
    return MEFALSE;
}

/* What was created of it. */
static void destroyParts(MstUniverse *u) {
    if (u->space)
        McdSpaceDestroy(u->space);
    if (u->frame) {
        McdFrameworkDestroyAllModelsAndGeometries(u->frame);
        McdTerm(u->frame);
    }
    MstBridgeDestroy(u->bridge);
    if (u->world)
        MdtWorldDestroy(u->world);
    ((MstUniverseRecord *)u)->magic = 0;
    MeMemoryAPI.destroy(u);
}

static void createCollision(MstUniverse *u) {
    const MstUniverseSizes *sizes = &u->sizes;
    u->frame = McdInit((int)sizes->collisionUserGeometryTypesMaxCount, (int)sizes->collisionModelsMaxCount,
                       (int)sizes->collisionGeometryInstancesMaxCount, sizes->lengthScale);
    if (!u->frame)
        return;
    McdAllRegisterTypes(u->frame);
    McdAllRegisterInteractions(u->frame);
    u->space = McdSpaceAxisSortCreate(u->frame, McdAllAxes, (int)sizes->collisionModelsMaxCount,
                                      (int)sizes->collisionPairsMaxCount);
}

MstUniverseID MEAPI MstUniverseCreate(const MstUniverseSizes *const sizes) {
    MstUniverseRecord *record = MeMemoryAPI.create(sizeof *record);
    if (!record) {
        MeFatalError(1, "MstUniverseCreate: no memory");
        return 0;
    }
    memset(record, 0, sizeof *record);
    MstUniverse *u = &record->universe;
    u->sizes = sizes ? *sizes : MstUniverseDefaultSizes;
    u->world = MdtWorldCreate(u->sizes.dynamicBodiesMaxCount, u->sizes.dynamicConstraintsMaxCount, u->sizes.lengthScale,
                              u->sizes.massScale);
    createCollision(u);
    if (u->frame)
        u->bridge = MstBridgeCreate(u->frame, u->sizes.materialsMaxCount);
    record->magic = MST_UNIVERSE;
    if (!u->world || !u->frame || !u->space || !u->bridge) {
        MeWarning(1, "MstUniverseCreate: a part could not be created with these sizes");
        destroyParts(u);
        return 0;
    }
    McdSpaceSetLookAhead(u->space, (MeReal)(1. / 60)); /* until a step says how long it is */
    MdtWorldSetMinSafeTime(u->world, (MeReal)1e-9);    /* what is fast is stopped where it touches */
    MstSetWorldHandlers(u->world);
    return u;
}

void MEAPI MstUniverseDestroy(const MstUniverseID u) {
    if (u && isUniverse(u, "MstUniverseDestroy"))
        destroyParts(u);
}

void MEAPI MstUniverseStep(const MstUniverseID u, const MeReal step) {
    if (!isUniverse(u, "MstUniverseStep"))
        return;
    McdSpaceSetLookAhead(u->space, step);
    McdSpacePathUpdateAll(u->space, step);
    MstBridgeUpdateContacts(u->bridge, u->space, u->world);
    mst_stepWorld(u, step);
    MstBridgeUpdateEvents(u->bridge, u->world);
}

const MstEvent *MEAPI MstUniverseGetEvents(const MstUniverseID u, int *count) {
    return MstBridgeGetEvents(isUniverse(u, "MstUniverseGetEvents") ? u->bridge : 0, count);
}

MdtWorldID MEAPI MstUniverseGetWorld(const MstUniverseID u) {
    return isUniverse(u, "MstUniverseGetWorld") ? u->world : 0;
}

McdFrameworkID MEAPI MstUniverseGetFramework(const MstUniverseID u) {
    return isUniverse(u, "MstUniverseGetFramework") ? u->frame : 0;
}

McdSpaceID MEAPI MstUniverseGetSpace(const MstUniverseID u) {
    return isUniverse(u, "MstUniverseGetSpace") ? u->space : 0;
}

MstBridgeID MEAPI MstUniverseGetBridge(const MstUniverseID u) {
    return isUniverse(u, "MstUniverseGetBridge") ? u->bridge : 0;
}
