/* Models: geometries at places, which collide. */
#include "McdInternal.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "model/mcd_result_i.h"
#include <string.h>

McdModelRecord *mcd_modelCheck(McdModelID cm, const char *function) {
    McdModelRecord *m = mcd_record(cm);
    if (m && MCD_IS_KNOWN(m, MCD_MODEL) && m->magic == MCD_MODEL)
        return m;
    mcd_warnGone(cm, "model", function);
    return 0;
}

MeBool mcd_modelPrecedes(const McdModelRecord *a, const McdModelRecord *b) {
    return a->sortKey != b->sortKey ? a->sortKey < b->sortKey : a->serial < b->serial;
}

/* ---- creation, destruction ------------------------------------------------------------------- */

static void setFilter(McdModelRecord *m, McdFilter filter) {
    m->filter = filter;
    if (m->space)
        m->frame->spaceApplyFilter(&m->model);
}

static void setUpdate(McdModelRecord *m, McdModelUpdateFnPtr f) {
    m->frame->updateCallbacks += (f != 0) - (m->update != 0);
    m->update = f;
    MEASSERT(m->frame->updateCallbacks >= 0);
}

static void setSwept(McdModelRecord *m, MeBool isSwept) {
    m->frame->sweptCount += isSwept - mcd_isSwept(m);
    m->sweep = isSwept ? MCD_SWEPT : 0; /* the next update adds whether it is fast or quick */
    MEASSERT(m->frame->sweptCount >= 0);
}

/* Resets everything except the geometry, the space and the entry in the framework's list. */
static void setDefaults(McdModelRecord *m) {
    m->model.mBody = 0;
    m->instance.tm = 0;
    m->material = 0;
    m->relTM = m->refTM = 0;
    m->ownsRelative = MEFALSE;
    m->linearVelocity = m->angularVelocity = 0;
    m->tolerance = m->frame->tolerance;
    m->isSensor = MEFALSE;
    setSwept(m, MEFALSE);
    m->sensorMask = ~0u;
    setFilter(m, (McdFilter){.category = 1, .mask = 0xffffffffu, .group = 0});
    m->requestId = McdModelGetDefaultRequestID();
    setUpdate(m, 0);
    m->intersect = 0;
    m->userData = 0;
}

/* For checks: the framework's list of models is in the order of creation, doubly linked, and as long as its count. */
static MeBool areModelsGood(const McdFramework *frame) {
    int count = 0;
    for (const McdModelRecord *m = frame->firstModel; m; m = m->next, count++)
        if (m->magic != MCD_MODEL || m->frame != frame || (m->previous && m->previous->serial >= m->serial) ||
            (m->next ? m->next->previous : frame->lastModel) != m)
            return MEFALSE;
    return count == frame->modelCount;
}

/* Takes a record from the pool, which has one, and appends it to the framework's list. */
static McdModelRecord *recordFromPool(McdFramework *frame) {
    McdModelRecord *m = frame->firstFree;
    MEASSERT(m->magic == 0 && frame->modelCount < frame->modelRoom);
    frame->firstFree = m->next;
    if (!frame->firstFree)
        frame->lastFree = 0;
    memset(m, 0, sizeof *m);
    m->frame = frame;
    m->serial = ++frame->serial;
    m->lastStamp = (MeU64)m->serial << 32;
    m->magic = MCD_MODEL;
    m->previous = frame->lastModel;
    *(m->previous ? &m->previous->next : &frame->firstModel) = m;
    frame->lastModel = m;
    frame->modelCount++;
    MeHandleEnter(&m->handle, m, MCD_MODEL);
    mcd_instanceEnter(&m->instance);
    return m;
}

static void recordToPool(McdModelRecord *m) {
    McdFramework *frame = m->frame;
    *(m->previous ? &m->previous->next : &frame->firstModel) = m->next;
    *(m->next ? &m->next->previous : &frame->lastModel) = m->previous;
    frame->modelCount--;
    MEASSERT(frame->modelCount >= 0 && !frame->firstModel == !frame->modelCount);
    MEASSERT(!m->space && !m->instance.geometry && !m->instance.firstChild);
    MeHandleLeave(&m->handle);
    mcd_instanceLeave(&m->instance);
    m->magic = 0;
    m->next = 0;
    *(frame->lastFree ? &frame->lastFree->next : &frame->firstFree) = m;
    frame->lastFree = m;
}

/* Makes g the geometry of a model that has none. False, with a message, if the pool has too few child instances. */
static MeBool acquireGeometry(McdModelRecord *m, McdGeometryID g, const char *function) {
    MEASSERT(!m->instance.geometry && !m->instance.firstChild);
    m->instance.geometry = g;
    m->instance.model = &m->model;
    if (!mcd_instanceMakeChildren(m->frame, &m->instance, function)) {
        m->instance.geometry = 0;
        return MEFALSE;
    }
    McdGeometryIncrementReferenceCount(g);
    memset(m->instance.placed, 0, sizeof m->instance.placed);
    MEVALIDATE(m->frame->modelCount > 100 || areModelsGood(m->frame));
    return METRUE;
}

static void dropGeometry(McdModelRecord *m) {
    mcd_instanceFreeChildren(m->frame, &m->instance);
    MEASSERT(m->instance.geometry->referenceCount > 0);
    McdGeometryDecrementReferenceCount(m->instance.geometry);
    m->instance.geometry = 0;
}

McdModelID MEAPI McdModelCreate(McdGeometryID g) {
    if (!mcd_geometryType(g, "McdModelCreate"))
        return 0;
    McdFramework *frame = g->frame;
    if (!mcd_mayCreate(frame, "McdModelCreate"))
        return 0;
    if (!frame->firstFree && !mcd_frameAddModels(frame, "McdModelCreate"))
        return 0;
    McdModelRecord *m = recordFromPool(frame);
    if (!acquireGeometry(m, g, "McdModelCreate")) {
        recordToPool(m);
        return 0;
    }
    setDefaults(m);
    return &m->model;
}

static void freeRelative(McdModelRecord *m) {
    if (!m->ownsRelative)
        return;
    MEASSERT(m->relTM && m->instance.tm);
    MeMemoryGive(m->relTM);
    MeMemoryGive(m->instance.tm);
    m->instance.tm = 0;
    m->ownsRelative = MEFALSE;
}

/* Calls mLeave, which removes the model from its body's list. */
static void leaveBody(McdModelRecord *m) {
    if (m->model.mLeave)
        m->model.mLeave(&m->model);
}

static void destroyModel(McdModelRecord *m) {
    if (m->space)
        m->frame->spaceRemoveDestroyed(&m->model);
    leaveBody(m);
    freeRelative(m);
    MeMemoryGive(m->own);
    m->own = 0;
    setUpdate(m, 0);
    setSwept(m, MEFALSE);
    dropGeometry(m);
    recordToPool(m);
}

/* Guards models, since the space may call functions of the program for the model's pairs. */
void mcd_modelDestroy(McdModelRecord *m) {
    McdFramework *frame = m->frame;
    MEASSERT(!m->standsFor);
    m->isCondemned = m->isGone = true;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    destroyModel(m);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

static void MEAPI destroyDeferred(const MeLater *later) {
    McdModelRecord *m = mcd_deferredModel(later);
    if (m && m->isCondemned)
        mcd_modelDestroy(m);
}

static MeBool mayDestroy(const McdModelRecord *m, const char *function) {
    if (!mcd_mayDestroy(m, MCD_MODEL, "model", function))
        return MEFALSE;
    if (m->isCondemned)
        mcd_warnGone(m, "model", function);
    else if (m->standsFor)
        MeWarning(1, "%s: the model stands for a child of an aggregate's model; nothing is changed", function);
    return !m->isCondemned && !m->standsFor;
}

void MEAPI McdModelDestroy(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    if (!mayDestroy(m, "McdModelDestroy"))
        return;
    const MeLater later = {.carryOut = destroyDeferred, .object = m, .serial = m->serial};
    const MeWhen when = mcd_deferWhileGuarded(m->frame, &later, "McdModelDestroy");
    if (when == MeWhenNow)
        mcd_modelDestroy(m);
    else if (when == MeWhenStageEnds)
        m->isCondemned = m->isGone = true;
}

void MEAPI McdModelSetGone(McdModelID cm, MeBool isGone) {
    mcd_record(cm)->isGone = isGone || mcd_record(cm)->isCondemned;
}

MeBool MEAPI McdModelPairIsLeaving(const McdModelPair *p) {
    return mcd_record(p->model1)->isGone || mcd_record(p->model2)->isGone;
}

void MEAPI McdModelForgetPairs(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    if (m->space)
        m->frame->spaceForgetPairs(cm);
}

void MEAPI McdModelDropBox(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    if (m->space)
        m->frame->spaceDropBox(cm);
}

void MEAPI McdModelMarkChanged(McdModelID cm) {
    mcd_modelMarkChanged(mcd_record(cm));
}

void MEAPI McdModelReset(McdModelID cm) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelReset");
    if (!m || !MeProgramMayChange("McdModelReset") || !mcd_mayChangeShapes(m->frame, "McdModelReset"))
        return;
    leaveBody(m);
    freeRelative(m);
    setDefaults(m);
    if (!m->space)
        m->sortKey = 0;
}

MeBool MEAPI McdModelIsValid(McdModelID cm) {
    return cm && MeHandleIsLive(cm, MCD_MODEL) && !mcd_record(cm)->isCondemned;
}

MeU64 MEAPI McdModelGetSerial(McdModelID cm) {
    return McdModelIsValid(cm) ? mcd_record(cm)->serial : 0;
}

MeReal *mcd_childVelocity(const McdGeometryInstance *child, MeVector3 memory) {
    const McdModelRecord *m = mcd_record(child->model);
    MeVector3 arm;
    if (!child->parent || !m->linearVelocity || !m->angularVelocity)
        return m->linearVelocity;
    MeVector3Subtract(arm, child->placed[3], m->instance.tm[3]);
    MeVector3Cross(memory, m->angularVelocity, arm);
    MeVector3Add(memory, memory, m->linearVelocity);
    return memory;
}

McdModelID mcd_standInBegin(McdStandIn *s, McdGeometryInstance *child) {
    static const MeHandle none = {0, 0, 0};
    const McdModelRecord *m = mcd_record(child->model);
    if (!child->parent)
        return child->model;
    s->record = *m;
    s->record.handle = none;
    s->record.instance = *child;
    s->record.instance.handle = none;
    s->record.instance.parent = s->record.instance.nextSibling = 0;
    s->record.instance.model = &s->record.model;
    s->record.standsFor = child->model;
    s->record.instance.tm = child->placed;
    s->record.material = mcd_instanceMaterial(child);
    s->record.relTM = s->record.refTM = 0;
    s->record.ownsRelative = MEFALSE;
    s->record.update = 0;
    s->record.intersect = 0; /* it is called once, for the whole aggregate */
    s->record.linearVelocity = mcd_childVelocity(child, s->velocity);
#if KARMA_CHECK
    MeHandleEnter(&s->record.handle, &s->record, MCD_MODEL);
#endif
    mcd_instanceEnter(&s->record.instance);
    return &s->record.model;
}

void mcd_standInEnd(McdModelID cm, McdGeometryInstance *child) {
    McdModelRecord *m = mcd_record(cm);
    if (cm == child->model)
        return;
    MEASSERT(m->standsFor == child->model);
    MeHandleLeave(&m->handle);
    mcd_instanceLeave(&m->instance);
}

/* ---- accessors --------------------------------------------------------------------------------------------------- */

/* Defines a function that gets a value of the model `m`; `otherwise`, with a warning, if it is not a model. */
#define DEFINE_GETTER(Type, Name, value, otherwise)                                                                    \
    Type MEAPI Name(McdModelID cm) {                                                                                   \
        McdModelRecord *m = mcd_modelCheck(cm, __func__);                                                              \
        return m ? (value) : (otherwise);                                                                              \
    }
/* Defines a function that sets a member of a model. */
#define DEFINE_SETTER(Name, Type, member)                                                                              \
    void MEAPI Name(McdModelID cm, Type value) {                                                                       \
        McdModelRecord *m = mcd_modelCheck(cm, __func__);                                                              \
        if (m)                                                                                                         \
            m->member = value;                                                                                         \
    }

/* ---- shape ---------------------------------------------------------------------------------------------------- */

DEFINE_GETTER(McdGeometryID, McdModelGetGeometry, m->instance.geometry, 0)

void MEAPI McdModelSetGeometry(McdModelID cm, McdGeometryID g) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetGeometry");
    if (!m || !mcd_geometryType(g, "McdModelSetGeometry") || !mcd_geometryBelongs(g, m->frame, "McdModelSetGeometry"))
        return;
    if (m->space && !mcd_asAggregate(g) && !mcd_asAggregate(m->instance.geometry)) {
        ME_UNDER_OWN_NAME(McdGeometryInstanceSetGeometry(&m->instance, g));
        return;
    }
    if (m->space) {
        MeWarning(1, "McdModelSetGeometry: an aggregate's model is in a space: take it out first");
        return;
    }
    if (!MeProgramMayChange("McdModelSetGeometry") || !mcd_mayChangeShapes(m->frame, "McdModelSetGeometry"))
        return;
    const McdGeometryID old = m->instance.geometry;
    dropGeometry(m);
    if (!acquireGeometry(m, g, "McdModelSetGeometry"))
        acquireGeometry(m, old, "McdModelSetGeometry");
}

DEFINE_GETTER(McdGeometryType, McdModelGetGeometryType, m->instance.geometry->type, (McdGeometryType)-1)

DEFINE_GETTER(MeBool, McdModelMayHaveMaterials, m->instance.firstChild || mcd_hasMaterials(m->instance.geometry),
              MEFALSE)

DEFINE_GETTER(McdGeometryInstanceID, McdModelGetGeometryInstance, &m->instance, 0)

void MEAPI McdModelGetAABB(McdModelID cm, MeVector3 minCorner, MeVector3 maxCorner) {
    if (!mcd_areGiven(__func__, minCorner, maxCorner, maxCorner))
        return;
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelGetAABB");
    MeVector3Set(minCorner, 0, 0, 0);
    MeVector3Set(maxCorner, 0, 0, 0);
    if (m)
        McdGeometryInstanceGetAABB(&m->instance, minCorner, maxCorner);
}

void MEAPI McdModelGetBSphere(McdModelID cm, MeVector3 center, MeReal *radius) {
    if (!mcd_areGiven(__func__, center, radius, radius))
        return;
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelGetBSphere");
    MeVector3Set(center, 0, 0, 0);
    *radius = 0;
    if (m)
        McdGeometryInstanceGetBSphere(&m->instance, center, radius);
}

/* ---- place ----------------------------------------------------------------------------------------------------- */

static MeMatrix4Ptr transformOf(const McdModelRecord *m) {
    return m->given ? m->given : m->instance.tm;
}

DEFINE_GETTER(MeMatrix4Ptr, McdModelGetTransformPtr, transformOf(m), 0)

/* Ends the motion of a model that the program moves: it has its transform again. */
static void leaveMover(McdModelRecord *m) {
    if (m->given)
        leaveBody(m);
    MEASSERT(!m->given);
}

void MEAPI McdModelSetTransformPtr(const McdModelID cm, const MeMatrix4Ptr geometryTM) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetTransformPtr");
    if (!m || !mcd_mayChangeShapes(m->frame, "McdModelSetTransformPtr"))
        return;
    leaveMover(m);
    freeRelative(m);
    m->relTM = m->refTM = 0;
    m->instance.tm = geometryTM;
    mcd_modelMarkChanged(m);
}

MeBool MEAPI McdModelPlaceAtCopy(McdModelID cm, const MeMatrix4 tm) {
    McdModelRecord *m = mcd_record(cm);
    MEASSERT(!m->own);
    m->own = MeMemoryTake(1, sizeof(MeMatrix4), MeCallerName("McdModelPlaceAtCopy"), "a transform");
    if (!m->own)
        return MEFALSE;
    MeMatrix4Copy(m->own, tm);
    McdModelSetTransformPtr(cm, m->own);
    return METRUE;
}

static void composeTransforms(McdModelRecord *m) {
    if (m->relTM && m->refTM && transformOf(m))
        MeMatrix4TMCompound(transformOf(m), mcd_const(m->relTM), mcd_const(m->refTM));
}

void MEAPI McdModelPlaceBy(McdModelID cm, MeMatrix4Ptr mover) {
    McdModelRecord *m = mcd_record(cm);
    const MeMatrix4Ptr given = transformOf(m);
    m->given = mover ? given : 0;
    m->instance.tm = mover ? mover : given;
}

MeMatrix4Ptr MEAPI McdModelGetPlace(McdModelID cm) {
    return mcd_record(cm)->instance.tm;
}

MeMatrix4Ptr MEAPI McdModelGetGiven(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    composeTransforms(m);
    return m->given;
}

void MEAPI McdModelSetRelativeTransformPtrs(McdModelID cm, MeMatrix4 relTM, MeMatrix4 refTM, MeMatrix4 compoundTM,
                                            MeBool own) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetRelativeTransformPtrs");
    if (!m || !mcd_mayChangeShapes(m->frame, "McdModelSetRelativeTransformPtrs"))
        return;
    if (!relTM || !refTM || !compoundTM) {
        MeWarning(1, "McdModelSetRelativeTransformPtrs: a transform is null");
        return;
    }
    leaveMover(m);
    freeRelative(m);
    m->relTM = relTM;
    m->refTM = refTM;
    m->instance.tm = compoundTM;
    m->ownsRelative = own;
    composeTransforms(m);
}

void MEAPI McdModelGetRelativeTransformPtrs(McdModelID cm, MeMatrix4Ptr *relTM, MeMatrix4Ptr *refTM) {
    if (!mcd_areGiven(__func__, relTM, refTM, refTM))
        return;
    const McdModelRecord *m = mcd_modelCheck(cm, "McdModelGetRelativeTransformPtrs");
    *relTM = m ? m->relTM : 0;
    *refTM = m ? m->refTM : 0;
}

void MEAPI McdModelSetRelativeTransform(McdModelID cm, MeMatrix4 relTM) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetRelativeTransform");
    if (!m || !mcd_mayChangeShapes(m->frame, "McdModelSetRelativeTransform"))
        return;
    const MeMatrix4Ptr reference = m->refTM ? m->refTM : transformOf(m);
    if (!relTM) {
        McdModelSetTransformPtr(cm, reference);
        return;
    }
    if (!reference) {
        MeWarning(1, "McdModelSetRelativeTransform: set a transform first: it becomes the reference");
        return;
    }
    MeMatrix4Ptr copy = MeMemoryTake(1, sizeof(MeMatrix4), "McdModelSetRelativeTransform", "a transform");
    MeMatrix4Ptr product = MeMemoryTake(1, sizeof(MeMatrix4), "McdModelSetRelativeTransform", "a transform");
    if (!copy || !product) {
        MeMemoryGive(copy);
        MeMemoryGive(product);
        return;
    }
    MeMatrix4Copy(copy, mcd_const(relTM));
    McdModelSetRelativeTransformPtrs(cm, copy, reference, product, METRUE);
}

DEFINE_GETTER(MeMatrix4Ptr, McdModelGetRelativeTransform, m->relTM, 0)

void MEAPI McdModelCompoundTransforms(McdModelID cm) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelCompoundTransforms");
    if (m)
        composeTransforms(m);
}

DEFINE_SETTER(McdModelSetLinearVelocityPtr, MeReal *, linearVelocity)

DEFINE_SETTER(McdModelSetAngularVelocityPtr, MeReal *, angularVelocity)

DEFINE_GETTER(MeReal *, McdModelGetLinearVelocityPtr, m->linearVelocity, 0)

DEFINE_GETTER(MeReal *, McdModelGetAngularVelocityPtr, m->angularVelocity, 0)

MeBool mcd_modelIsPlaced(const McdModelRecord *m) {
    return mcd_isPlacedAsCompared(m) || mcd_isValidTransform(mcd_const(m->instance.tm));
}

void mcd_modelPlaceAt(const McdModelRecord *m, double time, MeMatrix4 tm) {
    static const MeVector3 still = {0, 0, 0};
    MeMatrix4TMUpdateFromVelocities(tm, 0, (MeReal)time, m->linearVelocity ? m->linearVelocity : still,
                                    m->angularVelocity ? m->angularVelocity : still, mcd_const(m->instance.tm));
}

/* ---- updating --------------------------------------------------------------------------------------------------- */

/* Updates the boxes of children first: an aggregate's box is made from theirs. */
static void updateBoxes(McdGeometryInstance *ins, const MeMatrix4Ptr finalTM) {
    for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        updateBoxes(child, 0);
    mcd_instanceUpdateAABB(ins, finalTM, METRUE);
}

void mcd_modelRefresh(McdModelRecord *m) {
    mcd_instancePlaceChildren(&m->instance);
    updateBoxes(&m->instance, 0);
}

void mcd_modelPlaceChildren(McdModelRecord *m) {
    atomic_int *const isLocked = &m->frame->placingIsLocked;
    if (!m->instance.firstChild)
        return;
    while (atomic_exchange_explicit(isLocked, 1, memory_order_acquire)) {
    }
    if (!mcd_areChildrenPlaced(&m->instance))
        mcd_instancePlaceChildren(&m->instance);
    atomic_store_explicit(isLocked, 0, memory_order_release);
}

/* Calls the update callback; not again if the callback itself updates the model. */
static void callUpdateCallback(McdModelRecord *m) {
    if (!m->update || m->isBeingUpdated)
        return;
    m->isBeingUpdated = true;
    const MeProgramCall before = MeProgramEnter("McdModelSetUpdateCallback");
    m->update(&m->model);
    MeProgramLeave(&before);
    m->isBeingUpdated = false;
}

/* Places the model and its children by the current transform. False if it has no valid transform. */
static MeBool placeModel(McdModelRecord *m) {
    callUpdateCallback(m);
    if (!m->instance.tm)
        return MEFALSE;
    composeTransforms(m);
    mcd_instancePlaceChildren(&m->instance);
    return mcd_modelIsPlaced(m);
}

MeBool mcd_modelUpdate(McdModelRecord *m) {
    if (!placeModel(m))
        return MEFALSE;
    updateBoxes(&m->instance, 0);
    return METRUE;
}

static void warnNoTransform(const char *function) {
    MeWarning(1, "%s: the model has no transform, or one that is not finite: see McdModelSetTransformPtr", function);
}

void MEAPI McdModelUpdate(McdModelID cm) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelUpdate");
    if (!m)
        return;
    McdFramework *frame = m->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    if (!mcd_modelUpdate(m))
        warnNoTransform("McdModelUpdate");
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

/* How far a point of the model deviates from the straight line between its start and end while the model rotates by
 * an angle: r (1 - cos(angle / 2)), where r is the largest distance of a point from the transform's origin; for more
 * than half a turn: r. */
static MeReal deviationByTurning(const McdModelRecord *m, MeReal duration) {
    MeVector3 centre;
    MeReal radius;
    if (!m->angularVelocity)
        return 0;
    McdGeometryGetBSphere(m->instance.geometry, centre, &radius);
    const MeReal angle = MeVector3Magnitude(m->angularVelocity) * MeFabs(duration);
    MEASSERT(!(radius < 0));
    const MeReal reach = MeVector3Magnitude(centre) + radius;
    return angle < ME_PI ? reach * (1 - MeCos(angle / 2)) : reach;
}

MeBool mcd_modelUpdatePath(McdModelRecord *m, MeReal motionDuration) {
    MeMatrix4 finalTM;
    if (!placeModel(m))
        return MEFALSE;
    mcd_modelPlaceAt(m, motionDuration, finalTM);
    updateBoxes(&m->instance, finalTM);
    const MeReal more = deviationByTurning(m, motionDuration);
    for (int i = 0; i < 3; i++) {
        m->instance.min[i] -= more;
        m->instance.max[i] += more;
    }
    return METRUE;
}

void MEAPI McdModelUpdatePath(McdModelID cm, MeReal motionDuration) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelUpdatePath");
    if (!m)
        return;
    McdFramework *frame = m->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    if (!mcd_modelUpdatePath(m, motionDuration))
        warnNoTransform("McdModelUpdatePath");
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

void MEAPI McdModelUpdatePathCompatible(McdModelID cm, MeReal dummy) {
    ME_UNDER_OWN_NAME({
        (void)dummy;
        McdModelUpdate(cm);
    });
}

void MEAPI McdModelSetUpdateCallback(McdModelID cm, McdModelUpdateFnPtr f) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetUpdateCallback");
    if (m)
        setUpdate(m, f);
}

DEFINE_GETTER(McdModelUpdateFnPtr, McdModelGetUpdateCallback, m->update, 0)

/* ---- collision -------------------------------------------------------------------------------------------------- */

DEFINE_GETTER(McdSpaceID, McdModelGetSpace, m->space, 0)

void MEAPI McdModelSetMaterial(McdModelID cm, int material) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetMaterial");
    if (m)
        ME_UNDER_OWN_NAME(McdGeometryInstanceSetMaterial(&m->instance, material));
}

DEFINE_GETTER(unsigned int, McdModelGetMaterial, mcd_instanceMaterial(&m->instance), 0)

void MEAPI McdModelSetContactTolerance(McdModelID cm, MeReal tolerance) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetContactTolerance");
    if (!m)
        return;
    if (!(tolerance >= 0) || !MeRealIsValid(tolerance))
        MeWarning(1, "McdModelSetContactTolerance: tolerance is %g: it must be >= 0", (double)tolerance);
    else
        m->tolerance = tolerance;
    mcd_modelMarkChanged(m);
}

DEFINE_GETTER(MeReal, McdModelGetContactTolerance, m->tolerance, 0)

void MEAPI McdModelSetSwept(McdModelID cm, MeBool swept) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetSwept");
    if (!m)
        return;
    if (mcd_isSwept(m) != (swept != 0))
        setSwept(m, swept != 0);
    mcd_modelMarkChanged(m);
}

DEFINE_GETTER(MeBool, McdModelIsSwept, mcd_isSwept(m), MEFALSE)

DEFINE_GETTER(MeReal, McdModelGetFastMargin, m->sweep &MCD_FAST ? m->fastMargin : 0, 0)

void MEAPI McdModelSetSensor(McdModelID cm, MeBool sensor) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetSensor");
    if (!m || !m->isSensor == !sensor)
        return;
    m->isSensor = sensor != 0;
    mcd_modelMarkChanged(m);
}

DEFINE_GETTER(MeBool, McdModelIsSensor, m->isSensor, MEFALSE)

void MEAPI McdModelSetSensorMask(McdModelID cm, MeU32 mask) {
    mcd_record(cm)->sensorMask = mask;
}

MeU32 MEAPI McdModelGetSensorMask(McdModelID cm) {
    return mcd_record(cm)->sensorMask;
}

void MEAPI McdModelSetFilter(McdModelID cm, MeU32 category, MeU32 mask) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetFilter");
    if (m)
        setFilter(m, (McdFilter){.category = category, .mask = mask, .group = m->filter.group});
}

void MEAPI McdModelSetFilterGroup(McdModelID cm, int group) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetFilterGroup");
    if (m)
        setFilter(m, (McdFilter){.category = m->filter.category, .mask = m->filter.mask, .group = group});
}

DEFINE_GETTER(MeU32, McdModelGetFilterCategory, m->filter.category, 0)

DEFINE_GETTER(MeU32, McdModelGetFilterMask, m->filter.mask, 0)

DEFINE_GETTER(int, McdModelGetFilterGroup, m->filter.group, 0)

void MEAPI McdModelSetSortKey(McdModelID cm, MeI16 key) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdModelSetSortKey");
    if (!m)
        return;
    if (key < 0)
        MeWarning(1, "McdModelSetSortKey: key is %d: it must be 0 .. 32767", key);
    else if (m->space)
        MeWarning(1, "McdModelSetSortKey: the model is in a space, whose pairs are in the order of keys");
    else
        m->sortKey = key;
}

DEFINE_GETTER(MeI16, McdModelGetSortKey, m->sortKey, 0)

DEFINE_SETTER(McdModelSetRequestID, int, requestId)

DEFINE_GETTER(int, McdModelGetRequestID, m->requestId, McdModelGetDefaultRequestID())

DEFINE_SETTER(McdModelSetIntersectCallback, McdModelIntersectFnPtr, intersect)

DEFINE_GETTER(McdModelIntersectFnPtr, McdModelGetIntersectCallback, m->intersect, 0)

/* ---- the program's data ---------------------------------------------------------------------- */

DEFINE_SETTER(McdModelSetUserData, void *, userData)

DEFINE_GETTER(void *, McdModelGetUserData, m->userData, 0)

DEFINE_SETTER(McdModelSetBodyData, void *, model.mBody)

DEFINE_GETTER(void *, McdModelGetBodyData, m->model.mBody, 0)
