/* The framework: types, interactions, defaults, and the end of everything in it. */
#include "mcd_i.h"
#include <string.h>

struct McdTermActionLink {
    McdTermAction action;
    McdTermActionLink *next; /* registered before */
};

static const McdRequest builtInRequest = {20};

void (*mcd_spaceForget)(McdModelID cm) = 0;
void (*mcd_spaceFilter)(McdModelID cm) = 0;

MeBool mcd_frameCheck(McdFrameworkID frame, const char *function) {
    if (frame && frame->magic == MCD_FRAMEWORK)
        return METRUE;
    MeWarning(1, "%s: %p is no collision framework", function, (void *)frame);
    return MEFALSE;
}

/* ---- life ---------------------------------------------------------------------------------------------------- */

static void *createZeroed(size_t count, size_t size) {
    void *memory = MeMemoryAPI.create(count * size + 1);
    if (memory)
        memset(memory, 0, count * size);
    return memory;
}

static void freeTables(McdFramework *frame) {
    MeMemoryAPI.destroy(frame->types);
    MeMemoryAPI.destroy(frame->grid);
    MeMemoryAPI.destroy(frame->models);
    MeMemoryAPI.destroy(frame->instances);
    MeMemoryAPI.destroy(frame);
}

static void linkPools(McdFramework *frame) {
    for (int i = 0; i + 1 < frame->modelMax; i++)
        frame->models[i].next = &frame->models[i + 1];
    frame->firstFree = frame->models;
    frame->lastFree = &frame->models[frame->modelMax - 1];
    for (int i = 0; i + 1 < frame->instanceMax; i++)
        frame->instances[i].nextSibling = &frame->instances[i + 1];
    frame->freeInstance = frame->instanceMax ? frame->instances : 0;
}

static MeBool sizesAreGood(int types, int models, int instances, MeReal lengthScale) {
    if (types < 0 || types > 1000 || models < 1 || instances < 0) {
        MeWarning(1, "McdInit: geoTypeMaxCount is %d (0..1000), modelCount %d (> 0), instanceCount %d (>= 0)", types,
                  models, instances);
        return MEFALSE;
    }
    if (!(lengthScale > 0) || !MeRealIsValid(lengthScale)) {
        MeWarning(1, "McdInit: lengthScale is %g: it must be positive", (double)lengthScale);
        return MEFALSE;
    }
    return METRUE;
}

McdFrameworkID MEAPI(McdInit)(int geoTypeMaxCount, int modelCount, int instanceCount, MeReal lengthScale) {
    if (!sizesAreGood(geoTypeMaxCount, modelCount, instanceCount, lengthScale))
        return 0;
    McdFramework *frame = createZeroed(1, sizeof *frame);
    if (!frame) {
        MeFatalError(1, "McdInit: no memory");
        return 0;
    }
    frame->typeCount = kMcdGeometryFirstUserType + geoTypeMaxCount;
    frame->modelMax = modelCount;
    frame->instanceMax = instanceCount;
    frame->types = createZeroed((size_t)frame->typeCount, sizeof *frame->types);
    frame->grid = createZeroed((size_t)frame->typeCount * (size_t)frame->typeCount, sizeof *frame->grid);
    frame->models = createZeroed((size_t)modelCount, sizeof *frame->models);
    frame->instances = createZeroed((size_t)instanceCount, sizeof *frame->instances);
    if (!frame->types || !frame->grid || !frame->models || !frame->instances) {
        freeTables(frame);
        MeFatalError(1, "McdInit: no memory for %d models and %d instances", modelCount, instanceCount);
        return 0;
    }
    linkPools(frame);
    frame->lengthScale = lengthScale;
    frame->tolerance = (MeReal)0.01 * lengthScale;
    frame->builtInRequest = builtInRequest;
    frame->defaultRequest = &frame->builtInRequest;
    frame->magic = MCD_FRAMEWORK;
    return frame;
}

McdFrameworkID MEAPI McdInitUnscaled(int geoTypeMaxCount, int modelCount, int instanceCount) {
    return (McdInit)(geoTypeMaxCount, modelCount, instanceCount, 1);
}

/* What nothing refers to goes first: an aggregate before its parts, whichever is older. */
static void destroyGeometries(McdFramework *frame) {
    while (frame->lastGeometry) {
        const int before = frame->geometryCount;
        for (McdGeometry *g = frame->lastGeometry, *previous; g; g = previous) {
            previous = g->previous;
            if (g->referenceCount == 0)
                McdGeometryDestroy(g);
        }
        if (frame->geometryCount == before) /* the program has set counts that nothing accounts for */
            frame->lastGeometry->referenceCount = 0;
    }
}

void MEAPI McdFrameworkDestroyAllModelsAndGeometries(McdFrameworkID frame) {
    if (!mcd_frameCheck(frame, "McdFrameworkDestroyAllModelsAndGeometries"))
        return;
    while (frame->lastModel) {
        McdModelRecord *m = frame->lastModel;
        if (m->space)
            mcd_spaceForget(&m->model);
        McdModelDestroy(&m->model);
    }
    destroyGeometries(frame);
}

static void runTermActions(McdFramework *frame) {
    while (frame->termActions) {
        McdTermActionLink *link = frame->termActions;
        frame->termActions = link->next;
        link->action(frame);
        MeMemoryAPI.destroy(link);
    }
}

void MEAPI McdTerm(McdFrameworkID frame) {
    if (!mcd_frameCheck(frame, "McdTerm"))
        return;
    if (frame->spaceCount) {
        MeWarning(1, "McdTerm: %d spaces are left; destroy them first. Nothing was destroyed", frame->spaceCount);
        return;
    }
    runTermActions(frame);
    if (frame->modelCount || frame->geometryCount)
        MeWarning(2, "McdTerm: %d models and %d geometries were left", frame->modelCount, frame->geometryCount);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    frame->magic = 0;
    freeTables(frame);
}

void MEAPI McdFrameworkRegisterTermAction(McdFrameworkID frame, McdTermAction action) {
    if (!mcd_frameCheck(frame, "McdFrameworkRegisterTermAction") || !action)
        return;
    McdTermActionLink *link = MeMemoryAPI.create(sizeof *link);
    if (!link) {
        MeFatalError(1, "McdFrameworkRegisterTermAction: no memory");
        return;
    }
    link->action = action;
    link->next = frame->termActions;
    frame->termActions = link;
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

/* The record of a type number; null, with a warning, if there can be no such type. */
static McdTypeRecord *typeRecord(McdFramework *frame, int typeId, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return 0;
    if (typeId >= 0 && typeId < frame->typeCount)
        return &frame->types[typeId];
    MeWarning(1, "%s: there is no geometry type %d: own types are %d .. %d, see McdInit's geoTypeMaxCount", function,
              typeId, kMcdGeometryFirstUserType, frame->typeCount - 1);
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

MeI16 MEAPI McdFrameworkGetRegisteredTypeCount(McdFrameworkID frame) {
    MeI16 count = 0;
    if (mcd_frameCheck(frame, "McdFrameworkGetRegisteredTypeCount"))
        for (int i = 0; i < frame->typeCount; i++)
            count = (MeI16)(count + (frame->types[i].isRegistered != 0));
    return count;
}

MeBool MEAPI McdFrameworkTypeIsRegistered(McdFrameworkID frame, int typeId) {
    return McdFrameworkTypeIsValid(frame, typeId) && frame->types[typeId].isRegistered;
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

McdInteractions *MEAPI McdFrameworkGetInteractions(McdFramework *frame, int geoType1, int geoType2) {
    McdGridCell *cell = gridCell(frame, geoType1, geoType2, "McdFrameworkGetInteractions");
    return cell && cell->isSet ? &cell->interactions : 0;
}

int MEAPI McdFrameworkGetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2) {
    const McdGridCell *cell = gridCell(framework, geoType1, geoType2, "McdFrameworkGetInteractionsWarned");
    return cell ? cell->warned : 0;
}

void MEAPI McdFrameworkSetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2, int count) {
    McdGridCell *cell = gridCell(framework, geoType1, geoType2, "McdFrameworkSetInteractionsWarned");
    if (cell)
        cell->warned = count;
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

/* One row of the table: the types with which the row's type interacts, in one order or the other. */
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
