/* Narrow phase of a pair of models: dispatch by the framework's table of interactions. */
#include "McdContact.h"
#include "McdInternal.h"
#include "convex/mcd_kind_i.h"
#include "model/mcd_motion_i.h"
#include "surface/mcd_scratch_i.h"
#include "pair/mcd_pair_i.h"

static MeBool checkPair(const McdModelPair *p, const char *function) {
    if (p)
        return mcd_modelCheck(p->model1, function) && mcd_modelCheck(p->model2, function);
    MeWarning(1, "%s: no pair", function);
    return MEFALSE;
}

static McdGeometryType typeOf(McdModelID cm) {
    return mcd_record(cm)->instance.geometry->type;
}

static McdGridCell *cellOfTypes(McdFramework *frame, int type1, int type2) {
    return &frame->grid[type1 * frame->typeCount + type2];
}

static McdGridCell *cellOfModels(McdModelID m1, McdModelID m2) {
    return cellOfTypes(mcd_record(m1)->frame, typeOf(m1), typeOf(m2));
}

/* The pair's cell in the table of interactions; null if there is none. isSwapped: the cell is for the swapped pair. */
static const McdGridCell *interactionOf(const McdModelPair *p, MeBool *isSwapped) {
    const McdGridCell *direct = cellOfModels(p->model1, p->model2), *swapped = cellOfModels(p->model2, p->model1);
    *isSwapped = !direct->isSet;
    if (direct->isSet)
        return direct;
    return swapped->isSet ? swapped : 0;
}

/* A call of an interaction's function, from beginCall to endCall. Shapes are guarded (MCD_GUARD_SHAPES) while the
 * program's function runs. */
typedef struct Call {
    McdFramework *frame; /* null: the function is the library's */
    MeProgramCall before;
} Call;

static Call beginCall(const McdModelPair *p, MeBool isOfProgram) {
    Call call = {.frame = isOfProgram ? mcd_record(p->model1)->frame : 0};
    if (!isOfProgram)
        return call;
    MeStageBegin(&call.frame->stage, MCD_GUARD_SHAPES);
    call.before = MeProgramEnter("McdFrameworkSetInteractions");
    return call;
}

static void endCall(const Call *call) {
    if (!call->frame)
        return;
    MeProgramLeave(&call->before);
    MeStageEnd(&call->frame->stage, MCD_GUARD_SHAPES);
}

static MeBool areEqual(const McdInteractions *a, const McdInteractions *b) {
    return a->intersectFn == b->intersectFn && a->safeTimeFn == b->safeTimeFn && a->helloFn == b->helloFn &&
           a->goodbyeFn == b->goodbyeFn;
}

MeBool mcd_typesAreBuiltIn(McdFramework *frame, int type1, int type2) {
    const McdGridCell *direct = cellOfTypes(frame, type1, type2), *swapped = cellOfTypes(frame, type2, type1);
    const McdGridCell *cell = direct->isSet ? direct : swapped;
    return cell->isSet && cell->library.intersectFn && areEqual(&cell->interactions, &cell->library);
}

MeBool mcd_interactionIsBuiltIn(const McdModelPair *p) {
    return mcd_typesAreBuiltIn(mcd_record(p->model1)->frame, typeOf(p->model1), typeOf(p->model2));
}

MeBool mcd_instanceTypes(const McdGeometryInstance *ins, MeU64 *types) {
    enum { BITS = 63 }; /* one less than the word: shifts by 64 are undefined */
    const int type = ins->geometry->type;
    const McdKind *kind = mcd_kindOf(ins->geometry);
    if ((ins->parent && ins->material >= 0) || type >= BITS || !kind || kind->callsProgram ||
        mcd_hasMaterials(ins->geometry))
        return MEFALSE;
    *types |= (MeU64)1 << type;
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        if (!mcd_instanceTypes(child, types))
            return MEFALSE;
    return METRUE;
}

MeBool mcd_typesInteractAsBuiltIn(McdFramework *frame, MeU64 types1, MeU64 types2) {
    for (int a = 0; types1 >> a; a++)
        for (int b = 0; types1 >> a & 1 && types2 >> b; b++)
            if (types2 >> b & 1 && !mcd_typesAreBuiltIn(frame, a, b))
                return MEFALSE;
    return METRUE;
}

static McdModelPair swapModels(const McdModelPair *p) {
    McdModelPair swapped = *p;
    swapped.model1 = p->model2;
    swapped.model2 = p->model1;
    return swapped;
}

/* ---- hello, goodbye ---------------------------------------------------------------------------------------------- */

static const McdKind *kindOf(McdModelID cm) {
    return mcd_kindOf(mcd_record(cm)->instance.geometry);
}

/* Whether no interaction is expected: static pairs have none by design (nor in the guide), nor have empty
 * geometries. Then there is no warning. */
static MeBool hasNoneByDesign(const McdModelPair *p) {
    const McdKind *a = kindOf(p->model1), *b = kindOf(p->model2);
    return (a && a->isEmpty) || (b && b->isEmpty) || (a && b && a->isStatic && b->isStatic);
}

static void warnOfNoInteraction(McdModelPair *p) {
    McdGridCell *cell = cellOfModels(p->model1, p->model2);
    if (hasNoneByDesign(p))
        return;
    if (atomic_fetch_add(&cell->warned, 1) == 0)
        MeWarning(2, "McdHello: no interaction of %s and %s is registered: they will not touch",
                  McdGeometryGetTypeName(McdModelGetGeometry(p->model1)),
                  McdGeometryGetTypeName(McdModelGetGeometry(p->model2)));
}

void MEAPI McdModelPairWarnOfSurfaces(const McdModelPair *p) {
    const McdKind *a = kindOf(p->model1), *b = kindOf(p->model2);
    MeBool isSwapped;
    if (!a || !b || a->isEmpty || b->isEmpty || !a->isStatic || !b->isStatic || interactionOf(p, &isSwapped))
        return;
    McdGridCell *cell = cellOfModels(p->model1, p->model2);
    if (atomic_fetch_add(&cell->warned, 1) == 0)
        MeWarning(2,
                  "%s: a %s whose body forces move passes through a %s: surfaces do not touch each other. Make it of "
                  "convex hulls (McdConvexMeshCreateHull), several in an aggregate, or move it yourself "
                  "(MdtBodySetKinematic)",
                  MeCallerName("MstUniverseStep"), McdGeometryGetTypeName(McdModelGetGeometry(p->model1)),
                  McdGeometryGetTypeName(McdModelGetGeometry(p->model2)));
}

void MEAPI McdHello(McdModelPair *p) {
    MeBool isSwapped;
    if (!checkPair(p, "McdHello"))
        return;
    const McdGridCell *cell = interactionOf(p, &isSwapped);
    if (!cell) {
        warnOfNoInteraction(p);
        return;
    }
    const McdHelloFn hello = cell->interactions.helloFn;
    if (!hello)
        return;
    McdModelPair ordered = isSwapped ? swapModels(p) : *p;
    const Call call = beginCall(p, hello != cell->library.helloFn);
    hello(&ordered);
    p->m_cachedData = ordered.m_cachedData;
    endCall(&call);
}

void MEAPI McdGoodbye(McdModelPair *p) {
    MeBool isSwapped;
    if (!checkPair(p, "McdGoodbye"))
        return;
    const McdGridCell *cell = interactionOf(p, &isSwapped);
    const McdGoodbyeFn goodbye = cell ? cell->interactions.goodbyeFn : 0;
    if (!goodbye) {
        p->m_cachedData = 0;
        return;
    }
    McdModelPair ordered = isSwapped ? swapModels(p) : *p;
    const Call call = beginCall(p, goodbye != cell->library.goodbyeFn);
    goodbye(&ordered);
    p->m_cachedData = 0;
    endCall(&call);
}

/* The framework of the models in a container's range; null: there are no models. */
static McdFramework *frameOf(const McdModelPairContainer *pairs, int first, int end) {
    for (int i = first; i < end; i++) {
        const McdModelPair *p = pairs->array[i];
        if (p && p->model1 && MCD_IS_KNOWN(p->model1, MCD_MODEL) && mcd_record(p->model1)->magic == MCD_MODEL)
            return mcd_record(p->model1)->frame;
    }
    return 0;
}

/* Calls `notify` for each pair. Meanwhile, destruction and removal of models by the program's callbacks is deferred. */
static void notifyPairs(const McdModelPairContainer *pairs, int first, int end, void(MEAPI *notify)(McdModelPair *p)) {
    McdFramework *frame = frameOf(pairs, first, end);
    if (!frame)
        return;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    for (int i = first; i < end; i++)
        notify(pairs->array[i]);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

void MEAPI McdHelloEach(McdModelPairContainer *pairs) {
    if (!pairs) {
        MeWarning(1, "McdHelloEach: no container");
        return;
    }
    notifyPairs(pairs, pairs->helloFirst, pairs->helloEnd, McdHello);
}

void MEAPI McdGoodbyeEach(McdModelPairContainer *pairs) {
    if (!pairs) {
        MeWarning(1, "McdGoodbyeEach: no container");
        return;
    }
    notifyPairs(pairs, pairs->goodbyeFirst, pairs->goodbyeEnd, McdGoodbye);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

MeBool MEAPI McdNearby(McdModelPair *p) {
    if (!checkPair(p, "McdNearby"))
        return MEFALSE;
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    const MeReal margin = mcd_modelMargin(a) + mcd_modelMargin(b);
    for (int i = 0; i < 3; i++)
        if (a->instance.min[i] - margin > b->instance.max[i] || b->instance.min[i] - margin > a->instance.max[i])
            return MEFALSE;
    return METRUE;
}

static void clearResult(McdIntersectResult *result, McdModelPair *p) {
    result->pair = p;
    result->contactCount = result->touch = 0;
    MeVector3Set(result->normal, 0, 0, 0);
}

/* Swaps back the result of a pair that was tested with its models swapped: negates normals, exchanges the data of
 * both models. */
static void swapContacts(McdIntersectResult *result) {
    MeVector3MultiplyScalar(result->normal, result->normal, -1);
    for (int i = 0; i < result->contactCount; i++) {
        McdContact *c = &result->contacts[i];
        const McdGeometryInstanceID instance = c->instance1;
        const McdElementData element = c->element1;
        const double radius = c->radius[0];
        MeVector3MultiplyScalar(c->normal, c->normal, -1);
        c->radius[0] = c->radius[1];
        c->radius[1] = radius;
        c->vertices = (c->vertices & 1) << 1 | c->vertices >> 1;
        c->instance1 = c->instance2;
        c->instance2 = instance;
        c->element1 = c->element2;
        c->element2 = element;
    }
}

/* Marks a contact as unused by a negative radius, which no interaction sets. A program's interaction, written for an
 * earlier version of McdContact, sets only some of its members; the others keep their values. */
static void markUnused(McdContact *c) {
    c->radius[0] = c->radius[1] = -1;
}

static void completeContacts(McdIntersectResult *result) {
    if (!result->contactCount || result->contacts[0].radius[0] >= 0)
        return;
    for (int i = 0; i < result->contactCount; i++) {
        McdContact *c = &result->contacts[i];
        c->exactSeparation = (double)c->separation;
        mcd_fromReal(c->exactPosition, c->position);
        c->radius[0] = c->radius[1] = 0;
        c->vertices = 0;
    }
}

static void callIntersect(McdIntersectFn intersect, McdModelPair *p, MeBool isSwapped, McdIntersectResult *result) {
    markUnused(&result->contacts[0]);
    if (isSwapped) {
        McdModelPair swapped = swapModels(p);
        intersect(&swapped, result);
    } else {
        intersect(p, result);
    }
    result->contactCount = MeCLAMP(result->contactCount, 0, result->contactMaxCount);
    completeContacts(result);
    if (isSwapped)
        swapContacts(result);
    result->pair = p;
}

/* For McdRequest.faceNormalsFirst: requests more contacts than needed, and keeps those on faces before others. */
static void intersectFacesFirst(McdIntersectFn intersect, McdModelPair *p, MeBool isSwapped,
                                McdIntersectResult *result) {
    enum { MORE = 4 }; /* so that a whole manifold of four points is found even if one contact is requested */
    McdFramework *frame = mcd_record(p->model1)->frame;
    const int maxCount = result->contactMaxCount;
    McdContact *kept = result->contacts;
    McdScratch *scratch = mcd_scratchAcquire(frame, "McdIntersect");
    if (!scratch)
        return;
    if (mcd_scratchReserveContacts(scratch, 0, MORE * maxCount)) {
        result->contacts = scratch->contact;
        result->contactMaxCount = MORE * maxCount;
        callIntersect(intersect, p, isSwapped, result);
        result->contactCount = mcd_simplify(scratch->contact, result->contactCount, kept, maxCount, result->normal,
                                            1e-6 * (double)frame->lengthScale, scratch->choice);
        result->contacts = kept;
    }
    mcd_scratchRelease(frame, scratch);
}

static void callModelCallbacks(McdModelPair *p, McdIntersectResult *result) {
    McdModelRecord *m[2] = {mcd_record(p->model1), mcd_record(p->model2)};
    if (!m[0]->intersect && !m[1]->intersect)
        return;
    const MeProgramCall before = MeProgramEnter("McdModelSetIntersectCallback");
    for (int k = 0; k < 2; k++)
        if (m[k]->intersect)
            m[k]->intersect(&m[k]->model, result);
    MeProgramLeave(&before);
    result->contactCount = MeCLAMP(result->contactCount, 0, result->contactMaxCount);
}

/* Limits the room for contacts to what the pair's request allows. Returns the previous room. */
static int limitContacts(McdIntersectResult *result, const McdRequest *request) {
    const int max = result->contactMaxCount;
    result->contactMaxCount = MeMIN(max, MeMAX(request->contactMaxCount, 1));
    return max;
}

static void runIntersect(McdIntersectFn intersect, McdModelPair *p, MeBool isSwapped, McdIntersectResult *result) {
    const McdRequest *request = McdModelPairGetRequestPtr(p);
    const int max = limitContacts(result, request);
    if (request->faceNormalsFirst)
        intersectFacesFirst(intersect, p, isSwapped, result);
    else
        callIntersect(intersect, p, isSwapped, result);
    result->contactMaxCount = max;
}

MeBool mcd_intersect(McdModelPair *p, McdIntersectResult *result) {
    MeBool isSwapped;
    clearResult(result, p);
    const McdGridCell *cell = interactionOf(p, &isSwapped);
    const McdIntersectFn intersect = cell ? cell->interactions.intersectFn : 0;
    if (!intersect)
        return MEFALSE;
    if (!mcd_pairIsPlaced(p, "McdIntersect"))
        return METRUE;
    const Call call = beginCall(p, intersect != cell->library.intersectFn);
    runIntersect(intersect, p, isSwapped, result);
    endCall(&call);
    callModelCallbacks(p, result);
    return METRUE;
}

MeBool MEAPI(McdIntersect)(McdModelPair *p, McdIntersectResult *result) {
    if (!checkPair(p, "McdIntersect") || !mcd_resultHasRoom(result, "McdIntersect"))
        return MEFALSE;
    McdFramework *frame = mcd_record(p->model1)->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    const MeBool isKnown = mcd_intersect(p, result);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    return isKnown;
}

/* Finds the contacts of two convex models that have been compared in this round. False for other models. */
static MeBool addConvexContacts(McdModelPair *p, const McdRequest *request, McdIntersectResult *result) {
    const int max = limitContacts(result, request);
    mcd_resultBegin(result, p);
    const MeBool areConvex =
        mcd_convexModels(mcd_record(p->model1), mcd_record(p->model2), mcd_pairReachInRound(p), result);
    result->contactMaxCount = max;
    if (areConvex)
        mcd_resultEnd(result);
    return areConvex;
}

MeBool MEAPI McdModelPairIntersectPlain(McdModelPair *p, McdIntersectResult *result) {
    MEASSERT(p && result && McdModelPairIsPlain(p));
    const McdRequest *request = McdModelPairGetRequestPtr(p);
    MeBool areConvex = MEFALSE;
    if (!request->faceNormalsFirst && cellOfModels(p->model1, p->model2)->isSet) {
        areConvex = addConvexContacts(p, request, result);
    } else if (!request->faceNormalsFirst) {
        McdModelPair ordered = swapModels(p);
        areConvex = addConvexContacts(&ordered, request, result);
        result->pair = p;
        if (areConvex)
            swapContacts(result);
    }
    return areConvex || mcd_intersect(p, result);
}

MeBool MEAPI McdIntersectAt(McdModelPair *p, McdIntersectResult *result, MeReal time) {
    if (!checkPair(p, "McdIntersectAt") || !mcd_resultHasRoom(result, "McdIntersectAt"))
        return MEFALSE;
    clearResult(result, p);
    if (!MeRealIsValid(time)) {
        MeWarning(1, "McdIntersectAt: time is not finite");
        return MEFALSE;
    }
    if (!mcd_pairIsPlaced(p, "McdIntersectAt"))
        return METRUE;
    McdModelRecord *models[2] = {mcd_record(p->model1), mcd_record(p->model2)};
    McdFramework *frame = models[0]->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_SHAPES); /* the models are moved temporarily */
    MeMatrix4 then[2];
    MeMatrix4Ptr now[2];
    for (int i = 0; i < 2; i++) {
        mcd_modelPlaceAt(models[i], time, then[i]);
        now[i] = models[i]->instance.tm;
        models[i]->instance.tm = then[i];
        mcd_modelRefresh(models[i]);
    }
    const MeBool answer = mcd_intersect(p, result);
    for (int i = 0; i < 2; i++) {
        models[i]->instance.tm = now[i];
        mcd_modelRefresh(models[i]);
    }
    MeStageEnd(&frame->stage, MCD_GUARD_SHAPES);
    return answer;
}

/* The arguments of McdIntersectEach. */
typedef struct Each {
    McdModelPairContainer *pairs;
    McdModelPairContainerIterator *iterator;
    McdIntersectResult *results;
    int resultRoom, *resultCount;
    McdContact *contacts;
    int contactRoom, *contactCount;
} Each;

static MeBool isGone(const McdModelPair *p) {
    return p && p->model1 && p->model2 && (mcd_record(p->model1)->isGone || mcd_record(p->model2)->isGone);
}

/* Tests pairs until the arrays are full; true if there is no room for the next pair. */
static MeBool intersectEach(const Each *e) {
    for (; e->iterator->next < e->pairs->stayingEnd; e->iterator->next++) {
        McdModelPair *p = e->pairs->array[e->iterator->next];
        if (isGone(p) || !checkPair(p, "McdIntersectEach"))
            continue;
        const int maxCount = McdModelPairGetRequestPtr(p)->contactMaxCount;
        const int room = e->contactRoom - *e->contactCount;
        const MeBool isFirst = *e->resultCount == 0;
        if (*e->resultCount == e->resultRoom || (room < maxCount && !isFirst))
            return METRUE;
        McdIntersectResult *result = &e->results[*e->resultCount];
        result->contacts = e->contacts + *e->contactCount;
        result->contactMaxCount = MeMIN(room, maxCount);
        if (!mcd_resultHasRoom(result, "McdIntersect") || !mcd_intersect(p, result))
            continue;
        *e->contactCount += result->contactCount;
        ++*e->resultCount;
    }
    return MEFALSE;
}

MeBool MEAPI McdIntersectEach(McdModelPairContainer *pairs, McdModelPairContainerIterator *pairsIter,
                              McdIntersectResult *resultArray, int resultArraySize, int *resultCount,
                              McdContact *contactArray, int contactArraySize, int *contactCount) {
    if (resultCount)
        *resultCount = 0;
    if (contactCount)
        *contactCount = 0;
    if (!pairs || !pairsIter || !resultArray || !resultCount || !contactArray || !contactCount) {
        MeWarning(1, "McdIntersectEach: an argument is null");
        return MEFALSE;
    }
    pairsIter->next = MeMAX(pairsIter->next, pairs->helloFirst); /* not initialized, or for other pairs */
    Each e = {pairs,       pairsIter,    resultArray,      resultArraySize,
              resultCount, contactArray, contactArraySize, contactCount};
    McdFramework *frame = frameOf(pairs, pairsIter->next, pairs->stayingEnd);
    if (!frame)
        return MEFALSE;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    const MeBool isMore = intersectEach(&e);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    return isMore;
}

/* ---- time of impact, line segments ----------------------------------------------------------- */

static MeBool areVelocitiesGood(const McdModelPair *p, const char *function) {
    const McdModelRecord *m[2] = {mcd_record(p->model1), mcd_record(p->model2)};
    for (int i = 0; i < 2; i++) {
        const MeReal *velocity[2] = {m[i]->linearVelocity, m[i]->angularVelocity};
        for (int k = 0; k < 2; k++)
            if (velocity[k] && !mcd_areInRange(velocity[k], 3)) {
                MeWarning(1, "%s: a model's velocity is not finite, or beyond %g", function, (double)FLT_MAX);
                return MEFALSE;
            }
    }
    return METRUE;
}

/* Calls a safe-time function within a stage, since the library's, too, may call the program's for parts. Not for two
 * convex models: workers may test these, and a stage is not thread-safe. */
static MeBool callSafeTime(const McdGridCell *cell, McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    const McdSafeTimeFn safeTime = cell->interactions.safeTimeFn;
    McdFramework *frame = mcd_record(p->model1)->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    const Call call = beginCall(p, safeTime != cell->library.safeTimeFn);
    const MeBool answer = safeTime(p, maxTime, result) != 0;
    endCall(&call);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    return answer;
}

MeBool mcd_safeTimeBegin(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result, const char *function) {
    if (!mcd_areGiven(function, result, result, result))
        return MEFALSE;
    result->pair = p;
    result->time = maxTime;
    MeVector3Set(result->normal, 0, 0, 0);
    MeVector3Set(result->position, 0, 0, 0);
    if (!(maxTime >= 0) || !mcd_areInRange(&maxTime, 1)) {
        MeWarning(1, "%s: maxTime is %g: it must be >= 0", function, (double)maxTime);
        result->time = 0;
        return MEFALSE;
    }
    return checkPair(p, function);
}

MeBool mcd_safeTimeInputsAreValid(const McdModelPair *p, const char *function) {
    return mcd_pairIsPlaced(p, function) && areVelocitiesGood(p, function);
}

MeBool MEAPI McdSafeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {
    MeBool isSwapped;
    if (!mcd_safeTimeBegin(p, maxTime, result, "McdSafeTime"))
        return MEFALSE;
    const McdGridCell *cell = interactionOf(p, &isSwapped);
    const McdSafeTimeFn safeTime = cell ? cell->interactions.safeTimeFn : 0;
    if (!safeTime || !mcd_safeTimeInputsAreValid(p, "McdSafeTime"))
        return MEFALSE;
    McdModelPair ordered = isSwapped ? swapModels(p) : *p;
    const MeBool mayCall = !mcd_isConvex(&mcd_record(p->model1)->instance) ||
                           !mcd_isConvex(&mcd_record(p->model2)->instance) || safeTime != cell->library.safeTimeFn;
    const MeBool answer =
        mayCall ? callSafeTime(cell, &ordered, maxTime, result) : safeTime(&ordered, maxTime, result) != 0;
    if (isSwapped)
        MeVector3MultiplyScalar(result->normal, result->normal, -1);
    result->pair = p;
    return answer;
}

static MeBool isPoint(const MeReal *p) {
    return p && mcd_areInRange(p, 3);
}

/* Whether the tree of instances has an instance. The program's own types may write anything. */
static MeBool hasInstance(const McdGeometryInstance *tree, const McdGeometryInstance *ins) {
    MeBool isFound = ins == tree;
    for (const McdGeometryInstance *child = tree->firstChild; child && !isFound; child = child->nextSibling)
        isFound = hasInstance(child, ins);
    return isFound;
}

MeBool mcd_lineSegIntersect(McdModelID cm, MeReal *inOrig, MeReal *inDest, McdLineSegIntersectResult *outOverlap) {
    McdModelRecord *m = mcd_record(cm);
    const McdTypeRecord *type = &m->frame->types[m->instance.geometry->type];
    if (!type->lineSegment || !mcd_modelIsPlaced(m))
        return MEFALSE;
    mcd_modelPlaceChildren(m);
    const McdTypeCall call = mcd_typeEnter(m->frame, type);
    outOverlap->instance = &m->instance;
    outOverlap->element.ptr = 0;
    const MeBool isHit = type->lineSegment(cm, inOrig, inDest, outOverlap) != 0;
    mcd_typeLeave(&call);
    if (isHit)
        outOverlap->model = cm;
    if (isHit && !hasInstance(&m->instance, outOverlap->instance))
        outOverlap->instance = &m->instance;
    return isHit;
}

MeU32 mcd_lineSegsIntersect(McdModelID cm, McdSegment segment[], int count, McdLineSegIntersectResult hit[]) {
    McdModelRecord *m = mcd_record(cm);
    const McdTypeRecord *type = &m->frame->types[m->instance.geometry->type];
    const MeBool areOneCall = type->kind && type->kind->segments && type->lineSegment == type->kind->segment;
    MeU32 hits = 0;
    MEASSERT(count <= MCD_SEGMENTS);
    if (!areOneCall) {
        for (int i = 0; i < count && !m->isGone; i++)
            if (mcd_lineSegIntersect(cm, segment[i].from, segment[i].to, &hit[i]))
                hits |= 1u << i;
        return hits;
    }
    if (count > 0 && mcd_modelIsPlaced(m))
        hits = type->kind->segments(cm, segment, count, hit);
    for (int i = 0; i < count; i++) {
        hit[i].model = cm;
        hit[i].instance = &m->instance;
    }
    return hits;
}

MeBool mcd_isHitNearer(const McdLineSegIntersectResult *a, const McdLineSegIntersectResult *b) {
    return a->distance != b->distance ? a->distance < b->distance
                                      : mcd_modelPrecedes(mcd_record(a->model), mcd_record(b->model));
}

unsigned int MEAPI McdLineSegIntersect(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                       McdLineSegIntersectResult *outOverlap) {
    McdModelRecord *m = mcd_modelCheck(cm, "McdLineSegIntersect");
    if (!m || !outOverlap)
        return 0;
    if (!isPoint(inOrig) || !isPoint(inDest)) {
        MeWarning(1, "McdLineSegIntersect: an end of the segment is null, not finite, or beyond %g", (double)FLT_MAX);
        return 0;
    }
    McdFramework *frame = m->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    const MeBool isHit = mcd_lineSegIntersect(cm, inOrig, inDest, outOverlap);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    return isHit ? 1 : 0;
}
