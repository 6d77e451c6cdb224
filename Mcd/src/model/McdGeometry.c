/* Common to all geometries: head, type and reference count; queries are dispatched to the type's functions. */
#include "model/mcd_result_i.h"
#include <string.h>

/* ---- creation, destruction ------------------------------------------------------------------- */

/* The public head of a geometry has opaque storage for its handle. */
_Static_assert(sizeof(MeHandle) <= sizeof(((McdGeometry *)0)->handle), "McdGeometry has place for its handle");

static MeHandle *handleOf(McdGeometry *g) {
    return (MeHandle *)(void *)g->handle;
}

static MeBool isLive(const McdGeometry *g) {
    return g && MCD_IS_KNOWN(g, MCD_GEOMETRY) && g->magic == MCD_GEOMETRY;
}

MeBool MEAPI McdGeometryIsValid(McdGeometryID g) {
    return g && MeHandleIsLive(g, MCD_GEOMETRY) && McdFrameworkTypeIsRegistered(g->frame, g->type);
}

static MeBool checkLive(const McdGeometry *g, const char *function) {
    if (isLive(g))
        return METRUE;
    mcd_warnGone(g, "geometry", function);
    return MEFALSE;
}

MeBool mcd_geometryBelongs(McdGeometryID g, const McdFramework *frame, const char *function) {
    if (g->frame == frame)
        return METRUE;
    MeWarning(1, "%s: the %s belongs to another framework: make one in the model's", function,
              McdGeometryGetTypeName(g));
    return MEFALSE;
}

const McdTypeRecord *mcd_geometryType(McdGeometryID g, const char *function) {
    return checkLive(g, function) ? &g->frame->types[g->type] : 0;
}

MeBool mcd_geometryIs(McdGeometryID g, McdGeometryType type, const char *function) {
    if (!checkLive(g, function))
        return MEFALSE;
    if (g->type == type)
        return METRUE;
    MeWarning(1, "%s: the geometry is a %s", function, McdGeometryGetTypeName(g));
    return MEFALSE;
}

void mcd_geometryChanged(McdGeometryID g) {
    g->frame->changes++;
}

static MeBool usesGeometry(const McdGeometryInstance *ins, const McdGeometry *g) {
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        if (usesGeometry(child, g))
            return METRUE;
    return ins->geometry == g;
}

void mcd_geometryMarkModels(McdGeometry *g) {
    for (McdModelRecord *m = g->frame->firstModel; m; m = m->next)
        if (usesGeometry(&m->instance, g))
            mcd_modelMarkChanged(m);
}

void MEAPI McdGeometryUpdate(McdGeometryID g) {
    if (!checkLive(g, "McdGeometryUpdate"))
        return;
    const McdKind *kind = mcd_kindOf(g);
    if (kind && kind->update)
        kind->update(g);
    mcd_geometryMarkModels(g);
}

void mcd_modelMarkChanged(McdModelRecord *m) {
    m->isMarkedChanged = METRUE;
    m->frame->changes++;
}

void MEAPI McdGeometryInit(McdGeometryID g, McdFramework *frame, MeI16 typeId) {
    if (!g || !mcd_frameCheck(frame, "McdGeometryInit") || !mcd_mayCreate(frame, "McdGeometryInit"))
        return;
    if (!McdFrameworkTypeIsRegistered(frame, typeId)) {
        MeWarning(1, "McdGeometryInit: geometry type %d is not registered", typeId);
        return;
    }
    memset(g, 0, sizeof *g);
    g->magic = MCD_GEOMETRY;
    g->type = typeId;
    g->frame = frame;
    g->previous = frame->lastGeometry;
    *(g->previous ? &g->previous->next : &frame->firstGeometry) = g;
    frame->lastGeometry = g;
    frame->geometryCount++;
    MEASSERT(frame->firstGeometry && (g->previous != 0) == (frame->geometryCount > 1));
    MeHandleEnter(handleOf(g), g, MCD_GEOMETRY);
}

void MEAPI McdGeometryDeinit(McdGeometryID g) {
    if (!checkLive(g, "McdGeometryDeinit"))
        return;
    McdFramework *frame = g->frame;
    *(g->previous ? &g->previous->next : &frame->firstGeometry) = g->next;
    *(g->next ? &g->next->previous : &frame->lastGeometry) = g->previous;
    frame->geometryCount--;
    MEASSERT(frame->geometryCount >= 0 && !frame->firstGeometry == !frame->geometryCount);
    g->magic = 0;
    MeHandleLeave(handleOf(g));
}

void *mcd_geometryCreate(McdFramework *frame, McdGeometryType type, size_t size, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return 0;
    if (!mcd_mayCreate(frame, function))
        return 0;
    if (!frame->types[type].isRegistered) {
        MeWarning(1, "%s: register its geometry type first, for example by McdPrimitivesRegisterTypes", function);
        return 0;
    }
    McdGeometry *g = MeMemoryTakeZeroed(1, size, function, "a geometry");
    if (!g)
        return 0;
    McdGeometryInit(g, frame, type);
    const McdKind *kind = frame->types[type].kind;
    frame->hasProgramSurfaces = frame->hasProgramSurfaces || (kind && kind->callsProgram);
    return g;
}

void mcd_geometryDestroy(McdGeometry *g) {
    McdFramework *frame = g->frame;
    const McdTypeRecord *type = &frame->types[g->type];
    McdGeometryDeinit(g);
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    const McdTypeCall call = mcd_typeEnter(frame, type);
    if (type->destroy)
        type->destroy(g);
    else
        MeMemoryGive(g);
    mcd_typeLeave(&call);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

/* Reference counts are checked only now: models that use the geometry may have been destroyed in the same stage. */
static void MEAPI destroyDeferred(const MeLater *later) {
    if (MeHandleIsLive(later->object, MCD_GEOMETRY))
        McdGeometryDestroy(later->object);
}

void MEAPI McdGeometryDestroy(McdGeometryID g) {
    if (!mcd_mayDestroy(g, MCD_GEOMETRY, "geometry", "McdGeometryDestroy"))
        return;
    const MeLater later = {.carryOut = destroyDeferred, .object = g};
    if (mcd_deferWhileGuarded(g->frame, &later, "McdGeometryDestroy") != MeWhenNow)
        return;
    if (g->referenceCount > 0) {
        MeWarning(1, "McdGeometryDestroy: %d models or aggregates still use the %s", g->referenceCount,
                  McdGeometryGetTypeName(g));
        return;
    }
    mcd_geometryDestroy(g);
}

void mcd_geometryDestroyAs(McdGeometryID g, McdGeometryType type, const char *function) {
    if (mcd_mayDestroy(g, MCD_GEOMETRY, "geometry", function) && mcd_geometryIs(g, type, function))
        McdGeometryDestroy(g);
}

void MEAPI mcd_geometryFree(McdGeometryID g) {
    MeMemoryGive(g);
}

/* ---- references ---------------------------------------------------------------------------------------------- */

int MEAPI McdGeometryGetReferenceCount(const McdGeometryID g) {
    return checkLive(g, "McdGeometryGetReferenceCount") ? g->referenceCount : 0;
}

void MEAPI McdGeometrySetReferenceCount(McdGeometryID g, int refCount) {
    if (checkLive(g, "McdGeometrySetReferenceCount"))
        g->referenceCount = MeMAX(refCount, 0);
}

void MEAPI McdGeometryIncrementReferenceCount(McdGeometryID g) {
    if (checkLive(g, "McdGeometryIncrementReferenceCount"))
        g->referenceCount++;
}

void MEAPI McdGeometryDecrementReferenceCount(McdGeometryID g) {
    if (checkLive(g, "McdGeometryDecrementReferenceCount"))
        g->referenceCount = MeMAX(g->referenceCount - 1, 0);
}

/* ---- accessors ------------------------------------------------------------------------------------------------ */

int MEAPI McdGeometryGetType(const McdGeometryID g) {
    return checkLive(g, "McdGeometryGetType") ? g->type : -1;
}

int MEAPI McdGeometryGetTypeId(const McdGeometryID g) {
    return checkLive(g, "McdGeometryGetTypeId") ? g->type : -1;
}

const char *MEAPI McdGeometryGetTypeName(const McdGeometryID g) {
    return checkLive(g, "McdGeometryGetTypeName") ? McdFrameworkGetTypeName(g->frame, g->type) : "(none)";
}

McdFrameworkID MEAPI McdGeometryGetFramework(const McdGeometryID g) {
    return checkLive(g, "McdGeometryGetFramework") ? g->frame : 0;
}

McdLineSegIntersectFnPtr MEAPI McdGeometryGetLineSegIntersectFnPtr(McdGeometryID g) {
    const McdTypeRecord *type = mcd_geometryType(g, "McdGeometryGetLineSegIntersectFnPtr");
    return type ? type->lineSegment : 0;
}

/* A temporary instance of the geometry without children, for functions that take an instance. */
static McdGeometryInstance temporaryInstance(McdGeometryID g, const MeMatrix4 tm) {
    McdGeometryInstance ins;
    memset(&ins, 0, sizeof ins);
    ins.geometry = g;
    ins.tm = (MeMatrix4Ptr)tm;
    return ins;
}

void MEAPI McdGeometryGetAABB(McdGeometryID g, const MeMatrix4 tm, MeVector3 minCorner, MeVector3 maxCorner) {
    if (!mcd_areGiven(__func__, minCorner, maxCorner, maxCorner))
        return;
    McdGeometryInstance ins = temporaryInstance(g, tm);
    mcd_instanceEnter(&ins);
    if (checkLive(g, "McdGeometryGetAABB"))
        mcd_instanceUpdateAABB(&ins, 0, METRUE);
    mcd_instanceLeave(&ins);
    MeVector3Copy(minCorner, ins.min);
    MeVector3Copy(maxCorner, ins.max);
}

void MEAPI McdGeometryGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    if (!mcd_areGiven(__func__, center, radius, radius))
        return;
    const McdTypeRecord *type = mcd_geometryType(g, "McdGeometryGetBSphere");
    MeVector3Set(center, 0, 0, 0);
    *radius = 0;
    if (!type || !type->getBSphere)
        return;
    const McdTypeCall call = mcd_typeEnter(g->frame, type);
    type->getBSphere(g, center, radius);
    mcd_typeLeave(&call);
}

void MEAPI McdGeometryMaximumPoint(McdGeometryID g, const MeMatrix4 tm, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    McdGeometryInstance ins = temporaryInstance(g, tm);
    MeVector3Set(outPoint, 0, 0, 0);
    mcd_instanceEnter(&ins);
    if (checkLive(g, "McdGeometryMaximumPoint"))
        mcd_instanceMaximumPoint(&ins, inDir, outPoint);
    mcd_instanceLeave(&ins);
}

MeI16 MEAPI McdGeometryGetMassProperties(McdGeometryID g, MeMatrix4 relativeTransform, MeMatrix3 inertiaMatrix,
                                         MeReal *volume) {
    if (!mcd_areGiven(__func__, relativeTransform, inertiaMatrix, volume))
        return 0;
    const McdTypeRecord *type = mcd_geometryType(g, "McdGeometryGetMassProperties");
    MeMatrix4TMMakeIdentity(relativeTransform);
    memset(inertiaMatrix, 0, sizeof(MeMatrix3));
    *volume = 0;
    if (!type || !type->getMassProperties)
        return 0;
    const McdTypeCall call = mcd_typeEnter(g->frame, type);
    const MeI16 hasMass = type->getMassProperties(g, relativeTransform, inertiaMatrix, volume);
    mcd_typeLeave(&call);
    return hasMass;
}

void MEAPI McdGeometryDebugDraw(const McdGeometryID g, const MeMatrix4Ptr tm, const MeReal colour[3]) {
    if (!mcd_areGiven(__func__, tm, colour, colour))
        return;
    const McdTypeRecord *type = mcd_geometryType(g, "McdGeometryDebugDraw");
    if (!type || !type->debugDraw)
        return;
    const McdTypeCall call = mcd_typeEnter(g->frame, type);
    type->debugDraw(g, mcd_const(tm), colour);
    mcd_typeLeave(&call);
}
