/* The framework: creation, types, interactions, defaults. */
#include "convex/mcd_kind_i.h"
#include "model/mcd_result_i.h"
#include "McdInternal.h"
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

static const McdRequest builtInRequest = {20, MEFALSE};

/* ---- handles ------------------------------------------------------------------------------------------------- */

static atomic_int liveFrames;

MeBool mcd_areGiven(const char *function, const void *a, const void *b, const void *c) {
    if (a && b && c)
        return METRUE;
    MeWarning(1, "%s: a pointer is null: it must say where to read or write", function);
    return MEFALSE;
}

void mcd_countFrames(int change) {
    atomic_fetch_add(&liveFrames, change);
}

void mcd_warnGone(const void *p, const char *what, const char *function) {
    if (p)
        MeWarning(1, "%s: %p is no %s: it has been destroyed, or never was one", function, p, what);
    else
        MeWarning(1, "%s: null is no %s", function, what);
}

MeBool mcd_mayDestroy(const void *p, unsigned int kind, const char *what, const char *function) {
    if (!p)
        return MEFALSE;
    if (MeHandleIsLive(p, kind))
        return METRUE;
    if (atomic_load(&liveFrames))
        mcd_warnGone(p, what, function);
    return MEFALSE;
}

MeBool mcd_frameCheck(McdFrameworkID frame, const char *function) {
    if (frame && MCD_IS_KNOWN(frame, MCD_FRAMEWORK) && frame->magic == MCD_FRAMEWORK)
        return METRUE;
    mcd_warnGone(frame, "collision framework", function);
    return MEFALSE;
}

/* ---- creation, pools ------------------------------------------------------------------------- */

static void freeBlocks(McdPoolBlock *block) {
    for (McdPoolBlock *next; block; block = next) {
        next = block->next;
        MeMemoryGiveAligned(block);
    }
}

void mcd_frameFree(McdFramework *frame) {
    for (int i = 0; frame->types && i < frame->typeCount; i++)
        MeMemoryGive(frame->types[i].ownKind);
    MeMemoryGive(frame->types);
    MeMemoryGive(frame->grid);
    freeBlocks(frame->modelBlocks);
    freeBlocks(frame->instanceBlocks);
    MeMemoryGive(frame);
}

/* Adds a block of records to a pool. Returns the first record; null if there is no memory. */
static void *addBlock(McdPoolBlock **blocks, int count, size_t size, const char *function, const char *what) {
    McdPoolBlock *block = 0;
    if ((size_t)count <= (SIZE_MAX - sizeof *block) / size)
        block = MeMemoryTakeAligned(1, sizeof *block + (size_t)count * size, ME_CACHE_LINE, function, what);
    else
        MeFatalError(0, "%s: no memory for %s (%d times %zu bytes)", function, what, count, size);
    if (!block)
        return 0;
    memset(block, 0, sizeof *block + (size_t)count * size);
    block->next = *blocks;
    *blocks = block;
    return block + 1;
}

static MeBool addModels(McdFramework *frame, int count, const char *function) {
    McdModelRecord *record = addBlock(&frame->modelBlocks, count, sizeof *record, function, "models");
    if (!record)
        return MEFALSE;
    for (int i = 0; i + 1 < count; i++)
        record[i].next = &record[i + 1];
    *(frame->lastFree ? &frame->lastFree->next : &frame->firstFree) = record;
    frame->lastFree = &record[count - 1];
    frame->modelRoom += count;
    return METRUE;
}

static MeBool addInstances(McdFramework *frame, int count, const char *function) {
    McdGeometryInstance *ins = addBlock(&frame->instanceBlocks, count, sizeof *ins, function, "parts of aggregates");
    if (!ins)
        return MEFALSE;
    for (int i = 0; i + 1 < count; i++)
        ins[i].nextSibling = &ins[i + 1];
    ins[count - 1].nextSibling = frame->freeInstance;
    frame->freeInstance = ins;
    frame->instanceRoom += count;
    return METRUE;
}

/* The size of a pool's next block: as large as all earlier blocks together. */
static int nextBlockSize(int room) {
    enum { FIRST_BLOCK = 64 };
    return room ? room : FIRST_BLOCK;
}

MeBool mcd_frameAddModels(McdFramework *frame, const char *function) {
    MEASSERT(!frame->firstFree && frame->modelCount == frame->modelRoom);
    if (frame->modelLimit.max == MeNoLimit)
        return addModels(frame, nextBlockSize(frame->modelRoom), function);
    MeLimitWarn(&frame->modelLimit, function, "more models");
    return MEFALSE;
}

MeBool mcd_frameAddInstances(McdFramework *frame, const char *function) {
    MEASSERT(!frame->freeInstance && frame->instanceCount == frame->instanceRoom);
    if (frame->instanceLimit.max == MeNoLimit)
        return addInstances(frame, nextBlockSize(frame->instanceRoom), function);
    MeLimitWarn(&frame->instanceLimit, function, "the parts of an aggregate");
    return MEFALSE;
}

static MeBool sizesAreGood(int types, int models, int instances, MeReal lengthScale) {
    if (types < 0 || types > 1000 || models < 1 || instances < 0) {
        MeWarning(1, "McdInit: geoTypeMaxCount is %d (0..1000), modelCount %d (> 0), instanceCount %d (>= 0)", types,
                  models, instances);
        return MEFALSE;
    }
    if (!(lengthScale >= (MeReal)FLT_MIN) || !MeRealIsValid(lengthScale)) {
        MeWarning(1, "McdInit: lengthScale is %g: it must be positive", (double)lengthScale);
        return MEFALSE;
    }
    return METRUE;
}

McdFrameworkID MEAPI(McdInit)(int geoTypeMaxCount, int modelCount, int instanceCount, MeReal lengthScale) {
    if (!sizesAreGood(geoTypeMaxCount, modelCount, instanceCount, lengthScale))
        return 0;
    McdFramework *frame = MeMemoryTakeZeroed(1, sizeof *frame, "McdInit", "a framework");
    if (!frame)
        return 0;
    const size_t types = (size_t)(kMcdGeometryFirstUserType + geoTypeMaxCount);
    frame->typeCount = (int)types;
    frame->typeLimit = (MeLimit){.max = geoTypeMaxCount, .name = "McdInit's geoTypeMaxCount"};
    frame->modelLimit = (MeLimit){.max = modelCount, .name = "McdInit's modelCount"};
    frame->instanceLimit = (MeLimit){.max = instanceCount, .name = "McdInit's instanceCount"};
    frame->types = MeMemoryTakeZeroed(types, sizeof *frame->types, "McdInit", "geometry types");
    frame->grid = MeMemoryTakeZeroed(types * types, sizeof *frame->grid, "McdInit", "interactions");
    if (!frame->types || !frame->grid || (modelCount != MeNoLimit && !addModels(frame, modelCount, "McdInit")) ||
        (instanceCount && instanceCount != MeNoLimit && !addInstances(frame, instanceCount, "McdInit"))) {
        mcd_frameFree(frame);
        return 0;
    }
    frame->lengthScale = lengthScale;
    frame->tolerance = (MeReal)0.01 * lengthScale;
    frame->builtInRequest = builtInRequest;
    frame->defaultRequest = &frame->builtInRequest;
    frame->magic = MCD_FRAMEWORK;
    MeHandleEnter(&frame->handle, frame, MCD_FRAMEWORK);
    mcd_countFrames(1);
    return frame;
}

void MEAPI McdFrameworkRenameLimits(McdFrameworkID frame, const char *types, const char *models,
                                    const char *instances) {
    if (!mcd_frameCheck(frame, "McdFrameworkRenameLimits"))
        return;
    MeLimitRename(&frame->typeLimit, types);
    MeLimitRename(&frame->modelLimit, models);
    MeLimitRename(&frame->instanceLimit, instances);
}

McdFrameworkID MEAPI McdInitUnscaled(int geoTypeMaxCount, int modelCount, int instanceCount) {
    ME_RETURN_UNDER_OWN_NAME(McdFrameworkID, (McdInit)(geoTypeMaxCount, modelCount, instanceCount, 1));
}

MeBool mcd_mayCreate(const McdFramework *frame, const char *function) {
    if (frame->isEmptied)
        MeProgramRefuse(function, "the framework is being emptied");
    return !frame->isEmptied && MeProgramMayChange(function);
}

int MEAPI McdFrameworkGetModelCount(McdFrameworkID frame) {
    return mcd_frameCheck(frame, "McdFrameworkGetModelCount") ? frame->modelCount : 0;
}

int MEAPI McdFrameworkGetGeometryCount(McdFrameworkID frame) {
    return mcd_frameCheck(frame, "McdFrameworkGetGeometryCount") ? frame->geometryCount : 0;
}

/* ---- types --------------------------------------------------------------------------------------------------- */

MeBool MEAPI McdFrameworkTypeIsValid(McdFrameworkID frame, int typeId) {
    return mcd_frameCheck(frame, "McdFrameworkTypeIsValid") && typeId >= 0 && typeId < frame->typeCount;
}

/* The record of a type number; null, with a warning, if the number is out of range. */
static McdTypeRecord *typeRecord(McdFramework *frame, int typeId, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return 0;
    if (typeId >= 0 && typeId < frame->typeCount)
        return &frame->types[typeId];
    MeWarning(1, "%s: there is no geometry type %d: own types are from %d on, %d of them: see %s", function, typeId,
              kMcdGeometryFirstUserType, frame->typeLimit.max, frame->typeLimit.name);
    return 0;
}

void MEAPI McdFrameworkRegisterGeometryType(McdFrameworkID frame, McdGeometryType typeId, char *typeName,
                                            McdGeometryDestroyFnPtr destroy, McdGeometryGetAABBFnPtr getAABB,
                                            McdGeometryGetBSphereFnPtr getBSphere,
                                            McdGeometryMaximumPointFnPtr maximumPoint,
                                            McdGeometryGetMassPropertiesFnPtr getMassProperties,
                                            McdGeometryDebugDrawFnPtr debugDraw) {
    McdTypeRecord *type = typeRecord(frame, typeId, "McdFrameworkRegisterGeometryType");
    if (!type || type->isRegistered)
        return;
    const McdTypeRecord made = {METRUE,
                                type->kind,
                                type->ownKind,
                                typeName ? typeName : "(no name)",
                                destroy,
                                getAABB,
                                getBSphere,
                                maximumPoint,
                                getMassProperties,
                                debugDraw,
                                type->lineSegment};
    *type = made;
}

void mcd_kindRegister(McdFramework *frame, const McdKind *kind, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return;
    McdFrameworkRegisterGeometryType(frame, (McdGeometryType)kind->type, kind->name(0), kind->destroy, kind->box,
                                     kind->sphere, kind->farthest, kind->mass, kind->draw);
    MEASSERT(!frame->types[kind->type].kind || frame->types[kind->type].kind == kind); /* two types with one number */
    frame->types[kind->type].kind = kind;
}

/* Enlarges both tables by one type. */
static MeBool addTypeToTables(McdFramework *frame, const char *function) {
    const size_t before = (size_t)frame->typeCount, now = before + 1;
    McdTypeRecord *types = MeMemoryTakeZeroed(now, sizeof *types, function, "geometry types");
    McdGridCell *grid = MeMemoryTakeZeroed(now * now, sizeof *grid, function, "interactions");
    if (!types || !grid) {
        MeMemoryGive(types);
        MeMemoryGive(grid);
        return MEFALSE;
    }
    memcpy(types, frame->types, before * sizeof *types);
    for (size_t row = 0; row < before; row++)
        memcpy(grid + row * now, frame->grid + row * before, before * sizeof *grid);
    MeMemoryGive(frame->types);
    MeMemoryGive(frame->grid);
    frame->types = types;
    frame->grid = grid;
    frame->typeCount++;
    return METRUE;
}

void *mcd_frameAddType(McdFramework *frame, McdKind *kind, const char *name, const char *function) {
    enum { MAX_TYPES = 2000 };
    const int number = frame->typeCount;
    if (number >= MAX_TYPES)
        MeWarning(1, "%s: there are %d types already", function, number);
    if (number >= MAX_TYPES || !addTypeToTables(frame, function)) {
        MeMemoryGive(kind);
        return 0;
    }
    kind->type = number;
    frame->types[number] = (McdTypeRecord){.isRegistered = METRUE,
                                           .kind = kind,
                                           .ownKind = kind,
                                           .name = name,
                                           .destroy = kind->destroy,
                                           .getAABB = kind->box,
                                           .getBSphere = kind->sphere,
                                           .maximumPoint = kind->farthest,
                                           .getMassProperties = kind->mass,
                                           .debugDraw = kind->draw};
    return kind;
}

MeI16 MEAPI McdFrameworkGetRegisteredTypeCount(McdFrameworkID frame) {
    MeI16 count = 0;
    if (mcd_frameCheck(frame, "McdFrameworkGetRegisteredTypeCount"))
        for (int i = 0; i < frame->typeCount; i++)
            count = (MeI16)(count + (frame->types[i].isRegistered != 0));
    return count;
}

MeBool MEAPI McdFrameworkTypeIsRegistered(McdFrameworkID frame, int typeId) {
    return mcd_frameCheck(frame, "McdFrameworkTypeIsRegistered") && McdFrameworkTypeIsValid(frame, typeId) &&
           frame->types[typeId].isRegistered;
}

const char *MEAPI McdFrameworkGetTypeName(McdFrameworkID frame, int typeId) {
    const McdTypeRecord *type = typeRecord(frame, typeId, "McdFrameworkGetTypeName");
    return type && type->isRegistered ? type->name : "(not registered)";
}

void MEAPI McdFrameworkShowTypes(McdFrameworkID frame) {
    if (!mcd_frameCheck(frame, "McdFrameworkShowTypes"))
        return;
    for (int i = 0; i < frame->typeCount; i++)
        if (frame->types[i].isRegistered)
            MeInfo(1, "geometry type %2d: %s", i, frame->types[i].name);
}

/* ---- interactions -------------------------------------------------------------------------------------------- */

static McdGridCell *gridCell(McdFramework *frame, int type1, int type2, const char *function) {
    if (!typeRecord(frame, type1, function) || !typeRecord(frame, type2, function))
        return 0;
    return &frame->grid[type1 * frame->typeCount + type2];
}

void MEAPI McdFrameworkSetInteractions(McdFramework *frame, int geoType1, int geoType2, McdInteractions *interactions) {
    McdGridCell *cell = gridCell(frame, geoType1, geoType2, "McdFrameworkSetInteractions");
    if (!cell)
        return;
    cell->isSet = interactions != 0;
    if (interactions)
        cell->interactions = *interactions;
}

MeBool mcd_interactionRegister(McdFramework *frame, int type1, int type2, const McdInteractions *library) {
    McdGridCell *cell = gridCell(frame, type1, type2, "McdFrameworkSetInteractions");
    if (!cell)
        return MEFALSE;
    cell->isSet = METRUE;
    cell->interactions = cell->library = *library;
    return METRUE;
}

McdInteractions *MEAPI McdFrameworkGetInteractions(McdFramework *frame, int geoType1, int geoType2) {
    McdGridCell *cell = gridCell(frame, geoType1, geoType2, "McdFrameworkGetInteractions");
    return cell && cell->isSet ? &cell->interactions : 0;
}

int MEAPI McdFrameworkGetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2) {
    const McdGridCell *cell = gridCell(framework, geoType1, geoType2, "McdFrameworkGetInteractionsWarned");
    return cell ? atomic_load(&cell->warned) : 0;
}

void MEAPI McdFrameworkSetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2, int count) {
    McdGridCell *cell = gridCell(framework, geoType1, geoType2, "McdFrameworkSetInteractionsWarned");
    if (cell)
        atomic_store(&cell->warned, count);
}

void MEAPI McdFrameworkSetLineSegInteraction(McdFramework *frame, int geoType, McdLineSegIntersectFnPtr intersect) {
    McdTypeRecord *type = typeRecord(frame, geoType, "McdFrameworkSetLineSegInteraction");
    if (type)
        type->lineSegment = intersect;
}

McdLineSegIntersectFnPtr MEAPI McdFrameworkGetLineSegInteraction(McdFramework *frame, int geoType) {
    const McdTypeRecord *type = typeRecord(frame, geoType, "McdFrameworkGetLineSegInteraction");
    return type ? type->lineSegment : 0;
}

/* Prints one row of the table: the types with which the row's type interacts, in either order. */
static void printRow(McdFramework *frame, int row) {
    char line[512] = "";
    for (int i = 0; i < frame->typeCount; i++) {
        const MeBool isSet =
            frame->grid[row * frame->typeCount + i].isSet || frame->grid[i * frame->typeCount + row].isSet;
        if (isSet && strlen(line) + strlen(frame->types[i].name ? frame->types[i].name : "") + 3 < sizeof line) {
            strcat(line, " ");
            strcat(line, frame->types[i].name ? frame->types[i].name : "(not registered)");
        }
    }
    MeInfo(1, "%s:%s", frame->types[row].name, line[0] ? line : " nothing");
}

void MEAPI McdFrameworkPrintInteractionTable(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdFrameworkPrintInteractionTable"))
        return;
    for (int i = 0; i < frame->typeCount; i++)
        if (frame->types[i].isRegistered)
            printRow(frame, i);
}

/* ---- defaults ------------------------------------------------------------------------------------------------- */

void MEAPI McdFrameworkSetDefaultRequestPtr(McdFrameworkID frame, McdRequest *request) {
    if (mcd_frameCheck(frame, "McdFrameworkSetDefaultRequestPtr"))
        frame->defaultRequest = request ? request : &frame->builtInRequest;
}

McdRequest *MEAPI McdFrameworkGetDefaultRequestPtr(McdFrameworkID frame) {
    return mcd_frameCheck(frame, "McdFrameworkGetDefaultRequestPtr") ? frame->defaultRequest : 0;
}

void MEAPI McdFrameworkSetDefaultContactTolerance(McdFrameworkID frame, MeReal tolerance) {
    if (!mcd_frameCheck(frame, "McdFrameworkSetDefaultContactTolerance"))
        return;
    if (!(tolerance >= 0) || !MeRealIsValid(tolerance))
        MeWarning(1, "McdFrameworkSetDefaultContactTolerance: tolerance is %g: it must be >= 0", (double)tolerance);
    else
        frame->tolerance = tolerance;
}

MeReal MEAPI McdFrameworkGetDefaultContactTolerance(McdFrameworkID frame) {
    return mcd_frameCheck(frame, "McdFrameworkGetDefaultContactTolerance") ? frame->tolerance : 0;
}

MeReal MEAPI McdFrameworkGetLengthScale(McdFrameworkID frame) {
    return mcd_frameCheck(frame, "McdFrameworkGetLengthScale") ? frame->lengthScale : 0;
}
