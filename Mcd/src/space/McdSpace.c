/* Spaces: change blocks, models and their boxes, lists of pairs for programs. Pairs are found in mcd_pairs.c. */
#include "space/mcd_space_i.h"
#include "McdInternal.h"
#include "convex/mcd_kind_i.h"
#include "model/mcd_motion_i.h"
#include <string.h>

const int McdXAxis = 1, McdYAxis = 2, McdZAxis = 4, McdAllAxes = 7;

/* ---- checks ------------------------------------------------------------------------------------------------------ */

MeBool mcd_spaceCheck(McdSpaceID s, const char *function) {
    if (s && MCD_IS_KNOWN(s, MCD_SPACE) && s->magic == MCD_SPACE)
        return METRUE;
    mcd_warnGone(s, "space", function);
    return MEFALSE;
}

/* Whether s is a space inside a change block; warns if not. */
static MeBool checkInside(McdSpaceID s, const char *function) {
    if (!mcd_spaceCheck(s, function))
        return MEFALSE;
    if (!s->isChanging && !s->isInner)
        MeWarning(1, "%s: legal only inside a change block: see McdSpaceBeginChanges", function);
    return s->isChanging || s->isInner;
}

static MeBool areModelsGuarded(const McdSpace *s) {
    return MeStageIsActive(&s->frame->stage, MCD_GUARD_MODELS);
}

static void endBlock(McdSpace *s) {
    MeStageBegin(&s->frame->stage, MCD_GUARD_MODELS); /* guarded during callbacks about pairs without room */
    mcd_pairsEnd(s);
    s->isChanging = s->isFirstBlock = s->isUpdated = MEFALSE;
    s->step++;
    McdSpacePairIteratorBegin(s, &s->own);
    MeStageEnd(&s->frame->stage, MCD_GUARD_MODELS);
}

static void beginBlock(McdSpace *s) {
    s->isChanging = METRUE;
    mcd_pairsBegin(s);
}

MeBool mcd_spaceIsReady(McdSpaceID s, const char *function) {
    if (!mcd_spaceCheck(s, function))
        return MEFALSE;
    if (s->isFirstBlock && s->isUpdated && !areModelsGuarded(s))
        endBlock(s);
    const MeBool isReady = s->allowsQueries || (!s->isChanging && !s->isInner);
    if (!isReady)
        MeWarning(1, "%s: legal only outside change blocks: see McdSpaceEndChanges", function);
    return isReady;
}

void MEAPI McdSpaceAllowQueries(McdSpaceID s, MeBool on) {
    s->allowsQueries = on;
}

/* The proxy of a model; null, with a warning: the model is in no space. */
static McdProxy *proxyOf(McdModelID cm, const char *function) {
    McdModelRecord *m = mcd_modelCheck(cm, function);
    if (m && !m->space)
        MeWarning(1, "%s: the model is in no space", function);
    return m && m->space ? m->proxy : 0;
}

/* ---- creation, destruction --------------------------------------------------------------------------------------- */

static void freeSpace(McdSpace *s) {
    mcd_pairsDestroy(s);
    if (s->tree)
        mcd_treeDestroy(s->tree);
    MeMemoryGiveAligned(s->proxy);
    MeMemoryGive(s->dirty);
    MeMemoryGive(s->found);
    MeMemoryGive(s->foundEnd);
    MeMemoryGive(s->changes);
    MeMemoryGive(s->unbounded);
    MeMemoryGive(s->awake);
    MeMemoryGive(s->updates);
    s->magic = 0;
    MeMemoryGive(s);
}

/* Enlarges the proxies to `count`; the new ones are added to the free list. */
static MeBool reserveProxies(McdSpace *s, int count, const char *function) {
    const size_t room = (size_t)s->proxyRoom, more = (size_t)count;
    if (!MeMemoryGrow(&s->dirty, room, more, sizeof *s->dirty, function, "models that moved") ||
        !MeMemoryGrow(&s->awake, room, more, sizeof *s->awake, function, "models that are updated") ||
        !MeMemoryGrow(&s->updates, room, more, sizeof *s->updates, function, "models that are updated") ||
        !MeMemoryGrow(&s->unbounded, room, more, sizeof *s->unbounded, function, "models without bounds"))
        return MEFALSE;
    McdProxy *proxy = MeMemoryTakeAligned(more, sizeof *proxy, ME_CACHE_LINE, function, "boxes of models");
    if (!proxy)
        return MEFALSE;
    if (room > 0)
        memcpy(proxy, s->proxy, room * sizeof *proxy);
    memset(proxy + room, 0, (more - room) * sizeof *proxy);
    MeMemoryGiveAligned(s->proxy);
    s->proxy = proxy;
    for (int i = s->firstProxy; i != MCD_NONE; i = proxy[i].next)
        proxy[i].model->proxy = &proxy[i];
    for (int i = s->proxyRoom; i < count; i++)
        proxy[i].next = i + 1 < count ? i + 1 : s->freeProxy;
    s->freeProxy = s->proxyRoom;
    s->proxyRoom = count;
    return METRUE;
}

/* Ensures that there is a free proxy. False, with a message, if the limit is reached or there is no memory. */
static MeBool reserveOneProxy(McdSpace *s, const char *function) {
    enum { FIRST_ROOM = 64 };
    if (s->freeProxy != MCD_NONE)
        return METRUE;
    MEASSERT(s->proxyCount == s->proxyRoom);
    if (s->modelLimit.max == MeNoLimit)
        return reserveProxies(s, s->proxyRoom ? 2 * s->proxyRoom : FIRST_ROOM, function);
    MeLimitWarn(&s->modelLimit, function, "more models");
    return MEFALSE;
}

static MeBool checkSizes(McdFrameworkID frame, int axes, int objectCount, int pairCount) {
    if ((size_t)frame <= (size_t)McdAllAxes && frame) {
        MeWarning(1,
                  "McdSpaceAxisSortCreate: the framework is %d: the arguments are framework, axes, objectCount, "
                  "pairCount; Karma 1.0's form had no framework",
                  (int)(size_t)frame);
        return MEFALSE;
    }
    if (!mcd_frameCheck(frame, "McdSpaceAxisSortCreate"))
        return MEFALSE;
    if (axes < 1 || axes > McdAllAxes)
        MeWarning(1, "McdSpaceAxisSortCreate: axes is %d: a sum of McdXAxis, McdYAxis, McdZAxis", axes);
    else if (objectCount < 1)
        MeWarning(1, "McdSpaceAxisSortCreate: objectCount is %d: it must be 1 or more", objectCount);
    else if (pairCount < 1)
        MeWarning(1, "McdSpaceAxisSortCreate: pairCount is %d: it must be 1 or more", pairCount);
    else
        return METRUE;
    return MEFALSE;
}

static McdSpace *makeSpace(int objectCount) {
    static const char function[] = "McdSpaceAxisSortCreate";
    McdSpace *s = MeMemoryTakeZeroed(1, sizeof *s, function, "a space");
    if (!s)
        return 0;
    s->firstProxy = s->lastProxy = s->firstAwake = s->lastAwake = s->awakeCount = s->freeLink = s->freeProxy = MCD_NONE;
    s->tree = mcd_treeCreate();
    if (!s->tree)
        MeFatalError(0, "%s: no memory for the tree of boxes", MeCallerName(function));
    if (s->tree && (objectCount == MeNoLimit || reserveProxies(s, objectCount, function)))
        return s;
    freeSpace(s);
    return 0;
}

static void releaseModel(McdSpace *s, McdProxy *p);
static void dropLeaf(McdSpace *s, McdProxy *p);
static void dropUnbounded(McdSpace *s, McdProxy *p);

/* Removes a model that is being destroyed, and its pairs, which get no goodbye phase. */
static void removeDestroyedModel(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    McdProxy *p = m->proxy;
    if (!m->space)
        return;
    mcd_pairsEraseProxy(p);
    releaseModel(m->space, p);
}

/* Forgets the contacts of a model's pairs. The pairs stay, so this is legal while models are guarded. */
static void forgetContactsOf(McdModelID cm) {
    mcd_pairsForgetContacts(mcd_record(cm)->proxy);
}

/* McdFramework.spaceNextNeighbour. */
static McdModelRecord *nextNeighbour(const McdModelRecord *m, int *at) {
    const McdSpace *space = m->space;
    const int own = space ? mcd_proxyIndex(space, m->proxy) : MCD_NONE;
    while (space) {
        *at = *at == MCD_NO_NEIGHBOUR ? space->proxy[own].firstLink
                                      : space->link[*at].next[space->link[*at].proxy[1] == own];
        if (*at == MCD_NONE)
            break;
        const McdLink *link = &space->link[*at];
        if (link->record)
            return space->proxy[link->proxy[link->proxy[0] == own]].model;
    }
    return 0;
}

/* Drops a model's box, and unfreezes the model; it has no pairs until it is updated again. */
static void dropBoxOf(McdModelID cm) {
    McdSpace *s = mcd_record(cm)->space;
    McdProxy *p = mcd_record(cm)->proxy;
    dropLeaf(s, p);
    dropUnbounded(s, p);
    p->hasBox = MEFALSE;
    mcd_proxyMarkDirty(p);
    McdSpaceUnfreezeModel(cm);
}

static void applyFilter(McdModelID cm) {
    McdModelRecord *m = mcd_record(cm);
    McdProxy *p = m->proxy;
    p->filter = m->filter;
    mcd_proxyMarkDirty(p);
}

McdSpaceID MEAPI(McdSpaceAxisSortCreate)(McdFrameworkID framework, int axes, int objectCount, int pairCount) {
    if (!checkSizes(framework, axes, objectCount, pairCount) || !MeProgramMayChange("McdSpaceAxisSortCreate"))
        return 0;
    McdSpace *s = makeSpace(objectCount);
    if (!s)
        return 0;
    s->magic = MCD_SPACE;
    s->frame = framework;
    s->axes = axes;
    s->modelLimit = (MeLimit){.max = objectCount, .name = "McdSpaceAxisSortCreate's objectCount"};
    s->pairLimit = (MeLimit){.max = pairCount, .name = "McdSpaceAxisSortCreate's pairCount"};
    s->isChanging = s->isFirstBlock = METRUE;
    s->step = MCD_SPACE; /* a number that an uninitialized iterator is unlikely to contain */
    framework->spaceRemoveDestroyed = removeDestroyedModel;
    framework->spaceApplyFilter = applyFilter;
    framework->spaceForgetPairs = forgetContactsOf;
    framework->spaceDropBox = dropBoxOf;
    framework->spaceNextNeighbour = nextNeighbour;
    framework->spaceCount++;
    MeHandleEnter(&s->handle, s, MCD_SPACE);
    return s;
}

void MEAPI McdSpaceRenameLimits(McdSpaceID s, const char *models, const char *pairs) {
    if (!mcd_spaceCheck(s, "McdSpaceRenameLimits"))
        return;
    MeLimitRename(&s->modelLimit, models);
    MeLimitRename(&s->pairLimit, pairs);
}

void MEAPI McdSpaceDestroy(McdSpaceID s) {
    if (!mcd_mayDestroy(s, MCD_SPACE, "space", "McdSpaceDestroy") ||
        !MeStageIsFree(&s->frame->stage, "McdSpaceDestroy"))
        return;
    MeStageBegin(&s->frame->stage, MCD_GUARD_MODELS); /* callbacks may be called for goodbyes */
    s->isUpdating = METRUE;                           /* so that these cannot insert models */
    while (s->firstProxy != MCD_NONE)
        removeDestroyedModel(&s->proxy[s->firstProxy].model->model);
    s->frame->spaceCount--;
    MEASSERT(s->proxyCount == 0 && s->frame->spaceCount >= 0);
    MeHandleLeave(&s->handle);
    McdFramework *frame = s->frame;
    freeSpace(s);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
}

void MEAPI McdSpaceBuild(McdSpaceID s) {
    if (mcd_spaceCheck(s, "McdSpaceBuild") && mcd_mayChangeShapes(s->frame, "McdSpaceBuild"))
        mcd_treeRebuild(s->tree);
}

McdFrameworkID MEAPI McdSpaceGetFramework(McdSpaceID s) {
    return s->frame;
}

void *MEAPI McdSpaceGetCollider(McdSpaceID s) {
    return s->collider;
}

void MEAPI McdSpaceSetCollider(McdSpaceID s, void *collider) {
    s->collider = collider;
}

void MEAPI McdSpaceSetUserData(McdSpaceID s, void *data) {
    if (mcd_spaceCheck(s, "McdSpaceSetUserData"))
        s->userData = data;
}

void *MEAPI McdSpaceGetUserData(McdSpaceID s) {
    return mcd_spaceCheck(s, "McdSpaceGetUserData") ? s->userData : 0;
}

void MEAPI McdSpaceSetPoolFullHandler(McdSpaceID space, McdSpacePoolErrorFnPtr handler) {
    if (mcd_spaceCheck(space, "McdSpaceSetPoolFullHandler"))
        space->poolFull = handler;
}

McdSpacePoolErrorFnPtr MEAPI McdSpaceGetPoolFullHandler(McdSpaceID space) {
    return mcd_spaceCheck(space, "McdSpaceGetPoolFullHandler") ? space->poolFull : 0;
}

/* ---- change blocks ----------------------------------------------------------------------------------------------- */

void MEAPI McdSpaceBeginOwnChanges(McdSpaceID s) {
    s->isInner = MEFALSE;
    if (!s->isChanging)
        beginBlock(s);
}

/* Inner blocks: change blocks that the program begins in a callback. Models inserted in one are in the space
 * immediately, but without a box. All other changes are deferred until the stage ends, when a block is opened for
 * them unless one is open. */

static McdSpace *spaceOfDeferred(const MeLater *later) {
    return MeHandleIsLive(later->object, MCD_SPACE) ? later->object : 0;
}

static void MEAPI beginDeferredBlock(const MeLater *later) {
    McdSpace *s = spaceOfDeferred(later);
    if (!s)
        return;
    s->isOpenedLater = !s->isChanging;
    McdSpaceBeginOwnChanges(s);
}

static void MEAPI endDeferredBlock(const MeLater *later) {
    McdSpace *s = spaceOfDeferred(later);
    if (!s || !s->isOpenedLater)
        return;
    s->isInner = MEFALSE;
    if (s->isChanging)
        endBlock(s);
}

void MEAPI McdSpaceBeginChanges(McdSpaceID space) {
    if (!mcd_spaceIsReady(space, "McdSpaceBeginChanges"))
        return;
    const MeLater later = {.carryOut = beginDeferredBlock, .object = space};
    const MeWhen when = mcd_deferWhileGuarded(space->frame, &later, "McdSpaceBeginChanges");
    if (when == MeWhenNow)
        beginBlock(space);
    space->isInner = when == MeWhenStageEnds;
}

void MEAPI McdSpaceEndChanges(McdSpaceID space) {
    if (!checkInside(space, "McdSpaceEndChanges"))
        return;
    const MeLater later = {.carryOut = endDeferredBlock, .object = space};
    if (space->isInner)
        space->isInner = mcd_deferWhileGuarded(space->frame, &later, "McdSpaceEndChanges") == MeWhenNever;
    else if (areModelsGuarded(space))
        MeProgramRefuse("McdSpaceEndChanges", "the space is in use");
    else if (MeProgramMayChange("McdSpaceEndChanges"))
        endBlock(space);
}

int MEAPI McdSpaceIsChanging(McdSpaceID space) {
    return mcd_spaceCheck(space, "McdSpaceIsChanging") && (space->isChanging || space->isInner);
}

/* ---- boxes ------------------------------------------------------------------------------------------------------- */

/* Rounds to float, clamped to the tree's range: up for side 1, down for side -1. */
static float roundOutward(double x, double side) {
    const double clamped = x > MCD_TREE_REACH ? MCD_TREE_REACH : x < -MCD_TREE_REACH ? -MCD_TREE_REACH : x;
    const float f = (float)clamped;
    return side * ((double)f - clamped) >= 0 ? f : nextafterf(f, side > 0 ? INFINITY : -INFINITY);
}

void mcd_treeBox(const double min[3], const double max[3], McdTreeBox *box) {
    for (int i = 0; i < 3; i++) {
        box->min[i] = roundOutward(min[i], -1);
        box->max[i] = roundOutward(max[i], 1);
    }
}

static double largestSide(const McdProxy *p) {
    const double x = (double)p->max[0] - (double)p->min[0], y = (double)p->max[1] - (double)p->min[1];
    return fmax(fmax(x, y), (double)p->max[2] - (double)p->min[2]);
}

static MeBool isUnbounded(double side) {
    return !(side < 1e-6 * MCD_TREE_REACH);
}

/* The size to which the fat box's margin is relative: the model's or, if the box is unbounded, that of a
 * medium-sized object. */
static double sizeOfProxy(const McdProxy *p, double side) {
    return isUnbounded(side) ? (double)p->model->frame->lengthScale : side;
}

/* m: the distance of the fat box from the exact one, apart from motion and rounding. */
static double fatMargin(const McdProxy *p, double size) {
    return .1 * size + 1.0001 * (double)p->tolerance;
}

/* Makes the fat box. Predictive enlargement: it covers four more steps of the last step's motion, at most twice the
 * model's size. */
static void makeFatBox(McdProxy *p, const double moved[3]) {
    const double size = sizeOfProxy(p, largestSide(p)), margin = fatMargin(p, size), rounding = 4 * (double)ME_EPSILON;
    double min[3], max[3];
    for (int i = 0; i < 3; i++) {
        const double ahead = fmax(-2 * size, fmin(4 * moved[i], 2 * size));
        const double low = (double)p->min[i], high = (double)p->max[i];
        min[i] = low - rounding * fabs(low) - margin + fmin(ahead, 0);
        max[i] = high + rounding * fabs(high) + margin + fmax(ahead, 0);
    }
    mcd_treeBox(min, max, &p->fat);
    MEASSERT(mcd_proxyIsWithinFatBox(p));
}

/* Whether the fat box still contains the exact one grown by the tolerance, and is not far too large for it. */
static MeBool isFatBoxGood(const McdProxy *p) {
    const double side = largestSide(p), size = sizeOfProxy(p, side), tolerance = 1.00001 * (double)p->tolerance;
    const double maxSide = isUnbounded(side) ? INFINITY : 4 * (size + 2 * fatMargin(p, size));
    for (int i = 0; i < 3; i++) {
        const double low = (double)p->fat.min[i], high = (double)p->fat.max[i];
        const double min = (double)p->min[i] - tolerance, max = (double)p->max[i] + tolerance;
        if (MeMAX(min, -MCD_TREE_REACH) < low || MeMIN(max, MCD_TREE_REACH) > high || high - low > maxSide)
            return MEFALSE;
    }
    return METRUE;
}

static void dropUnbounded(McdSpace *s, McdProxy *p) {
    int at = 0;
    if (!p->isUnbounded)
        return;
    while (s->unbounded[at] != mcd_proxyIndex(s, p))
        at++;
    MEASSERT(at < s->unboundedCount);
    memmove(s->unbounded + at, s->unbounded + at + 1, (size_t)(--s->unboundedCount - at) * sizeof *s->unbounded);
    p->isUnbounded = MEFALSE;
}

static void dropLeaf(McdSpace *s, McdProxy *p) {
    if (p->leaf)
        mcd_treeRemove(s->tree, p->leaf);
    p->leaf = 0;
}

/* Unbounded boxes (planes) would overlap the whole tree. They are few, so they are kept in a list and tested one by
 * one. */
static void putUnbounded(McdSpace *s, McdProxy *p) {
    dropLeaf(s, p);
    MEASSERT(s->unboundedCount - p->isUnbounded < s->proxyRoom);
    if (!p->isUnbounded)
        s->unbounded[s->unboundedCount++] = mcd_proxyIndex(s, p);
    p->isUnbounded = METRUE;
}

static void putInTree(McdSpace *s, McdProxy *p) {
    dropUnbounded(s, p);
    if (p->leaf)
        mcd_treeMove(s->tree, p->leaf, &p->fat);
    else
        p->leaf = mcd_treeInsert(s->tree, &p->fat, mcd_proxyIndex(s, p));
    if (!p->leaf) {
        MeFatalError(0, "%s: no memory for the tree of boxes", MeCallerName("McdSpaceUpdateModel"));
        putUnbounded(s, p); /* without memory for the tree: slower, but correct */
    }
}

/* The result of a proxy's update. */
typedef enum McdBoxUpdate {
    MCD_BOX_KEPT,
    MCD_BOX_MOVED,  /* moved within its fat box */
    MCD_BOX_MARKED, /* as MCD_BOX_MOVED, and a worker has marked the proxy dirty: its index must be added to the list */
    MCD_BOX_LEFT,   /* left its fat box and has a new one */
    MCD_BOX_UNSET,  /* the model has no transform */
    MCD_BOX_INVALID, /* the box is not finite */
    MCD_BOX_LATER,   /* to be updated by the calling thread */
} McdBoxUpdate;

/* Copies the model's box to the proxy and renews the fat box if necessary. Writes only to the proxy. */
static McdBoxUpdate copyBox(McdProxy *p) {
    const McdModelRecord *m = p->model;
    double moved[3] = {0, 0, 0};
    MeBool isSame = p->hasBox && p->tolerance == mcd_modelMargin(m);
    for (int i = 0; i < 3; i++) {
        isSame = isSame && p->min[i] == m->instance.min[i] && p->max[i] == m->instance.max[i];
        if (p->hasBox)
            moved[i] = (double)m->instance.min[i] - (double)p->min[i];
    }
    if (isSame)
        return MCD_BOX_KEPT;
    MeVector3Copy(p->min, m->instance.min);
    MeVector3Copy(p->max, m->instance.max);
    p->tolerance = mcd_modelMargin(m);
    const MeBool hadBox = p->hasBox;
    p->hasBox = METRUE;
    if (hadBox && isFatBoxGood(p))
        return MCD_BOX_MOVED;
    makeFatBox(p, moved);
    p->isMoved = METRUE;
    return MCD_BOX_LEFT;
}

/* Applies a box update to the space's shared data: dirty list, tree, list of unbounded proxies. */
static void applyBox(McdSpace *s, McdProxy *p, McdBoxUpdate update) {
    if (update == MCD_BOX_KEPT)
        return;
    mcd_proxyMarkDirty(p);
    if (update != MCD_BOX_LEFT)
        return;
    if (isUnbounded(largestSide(p)))
        putUnbounded(s, p);
    else
        putInTree(s, p);
}

static MeBool isBox(const McdModelRecord *m) {
    for (int i = 0; i < 3; i++)
        if (!(m->instance.min[i] <= m->instance.max[i]))
            return MEFALSE;
    return METRUE;
}

static void warnTransform(McdProxy *p, const char *what) {
    if (!p->isWarned)
        MeWarning(1,
                  "%s: the transform of a model (number %lu, a %s) %s; models keep their matrix by "
                  "pointer, which must live as long as they do",
                  MeCallerName("McdSpaceUpdateModel"), p->model->serial,
                  McdGeometryGetTypeName(p->model->instance.geometry), what);
    p->isWarned = METRUE;
}

/* Calls the space's box callback; not again if the callback itself has the model updated. */
static void callBoxCallback(const McdSpace *s, McdModelRecord *m, MeReal duration) {
    m->isBeingUpdated = true;
    const MeProgramCall before = MeProgramEnter("McdSpaceSetAABBFn");
    s->update(&m->model, duration);
    MeProgramLeave(&before);
    m->isBeingUpdated = false;
}

static MeReal speedOf(const MeReal *velocity) {
    return velocity ? MeVector3Magnitude(velocity) : 0;
}

/* m: an upper bound of the displacement of the model's points in the look-ahead time. */
static MeReal displacementOf(const McdSpace *s, const McdModelRecord *m, MeReal reach) {
    return s->lookAhead * (speedOf(m->linearVelocity) + speedOf(m->angularVelocity) * reach);
}

/* Whether the model's box encloses its path: it is swept, or may meet one that is, and moves farther than a box with
 * its travel reaches. */
static MeBool isBoxOfPath(const McdSpace *s, const McdModelRecord *m) {
    MeVector3 centre;
    MeReal radius;
    if (mcd_isSwept(m) || s->frame->sweptCount == 0 || (!m->linearVelocity && !m->angularVelocity))
        return mcd_isSwept(m);
    McdGeometryGetBSphere(m->instance.geometry, centre, &radius);
    return displacementOf(s, m, MeVector3Magnitude(centre) + radius) > radius;
}

/* Updates the model's box; false if the model has no valid transform. */
static MeBool updateBox(const McdSpace *s, McdModelRecord *m, MeReal duration) {
    if (s->update && !m->isBeingUpdated) {
        callBoxCallback(s, m, duration);
        return mcd_modelIsPlaced(m);
    }
    return duration != 0 && isBoxOfPath(s, m) ? mcd_modelUpdatePath(m, duration) : mcd_modelUpdate(m);
}

static void clearLookAhead(McdModelRecord *m) {
    m->lookAhead = m->travel = m->turnTravel = m->fastMargin = 0;
    m->sweep &= MCD_SWEPT;
}

/* m: half of the model's smallest extent along its own axes, at most `max`. */
static MeReal thicknessOf(McdModelRecord *m, MeReal max) {
    MeReal min = max;
    for (int i = 0; i < 3; i++) {
        MeVector3 axis, back, high, low;
        MeVector3Copy(axis, m->instance.tm[i]);
        MeVector3MultiplyScalar(back, axis, -1);
        McdGeometryInstanceMaximumPoint(&m->instance, axis, high);
        McdGeometryInstanceMaximumPoint(&m->instance, back, low);
        MeVector3Subtract(high, high, low);
        min = MeMIN(min, MeVector3Dot(high, axis) / 2);
    }
    return MeMAX(min, 0);
}

/* Sets the margin of a model that is swept, or may meet one that is. If that one moves by more than its thickness it is
 * fast, this one by more than its radius, quick: its time of impact is computed (McdSafeTime), and it gets nearly no
 * speculative contacts, which would be at its current position instead of that of the impact. */
static void setFastMargin(McdModelRecord *m, MeReal radius, MeReal reach, MeReal displacement) {
    if (!mcd_isSwept(m) && !(displacement > radius))
        return;
    const MeReal thickness = thicknessOf(m, reach);
    if (!mcd_isSwept(m))
        m->sweep |= MCD_QUICK;
    else if (displacement > thickness)
        m->sweep |= MCD_FAST;
    if (m->sweep & (MCD_FAST | MCD_QUICK))
        m->fastMargin = MeMAX((MeReal)0.02 * thickness, (MeReal)(3 * MCD_TOUCH) * reach);
}

/* Sets the model's travel (m): an upper bound of its displacement during the space's look-ahead time, clamped to its
 * radius, since more would give speculative contacts with obstacles that it only passes. isCompared: the model has
 * been compared, so its radius and reach are known. */
static void setTravel(const McdSpace *s, McdModelRecord *m, MeBool isCompared) {
    MeVector3 centre;
    MeReal radius = m->radius, reach = m->reach;
    clearLookAhead(m);
    if (!(s->lookAhead > 0) || (!m->linearVelocity && !m->angularVelocity))
        return;
    if (!isCompared) {
        McdGeometryGetBSphere(m->instance.geometry, centre, &radius);
        reach = MeVector3Magnitude(centre) + radius;
    }
    const MeReal turn = s->lookAhead * speedOf(m->angularVelocity) * reach;
    const MeReal displacement = s->lookAhead * speedOf(m->linearVelocity);
    m->lookAhead = s->lookAhead;
    m->turnTravel = MeMIN(turn, radius);
    m->travel = MeMIN(displacement + turn, radius);
    if (s->frame->sweptCount > 0)
        setFastMargin(m, radius, reach, displacement + turn);
    if (!MeRealIsValid(m->travel) || !MeRealIsValid(m->turnTravel))
        clearLookAhead(m);
    MEASSERT(m->travel >= 0 && m->turnTravel >= 0 && m->turnTravel <= m->travel);
}

/* Compares the model with its last inputs before its update. False if the comparison cannot show that the box is up
 * to date: with an update callback of the model or the space, or a relative transform, which the update applies. */
static MeBool isComparedBeforeUpdate(const McdSpace *s, McdModelRecord *m) {
    return !m->update && !s->update && !m->relTM && mcd_modelCompare(m) != 0;
}

/* Whether the box and margin of a model that has been compared are still valid, and its children at their places: a
 * query may have placed them where the model was meanwhile. */
static MeBool isUpToDate(const McdSpace *s, const McdModelRecord *m, MeReal duration) {
    return m->stamp == m->boxStamp && m->boxDuration == duration && m->boxLookAhead == s->lookAhead &&
           mcd_areChildrenPlaced(&m->instance);
}

/* Marks the box as valid. A changed margin makes a new stamp, since pair tests depend on it. */
static void markBoxValid(const McdSpace *s, McdModelRecord *m, MeReal duration) {
    if (m->boxDuration != duration || m->boxLookAhead != s->lookAhead)
        m->stamp = m->stamp ? mcd_modelNewStamp(m) : 0;
    m->boxStamp = m->stamp; /* 0 until it has been compared once */
    m->boxDuration = duration;
    m->boxLookAhead = s->lookAhead;
}

/* Updates the box of a model. Writes only to the proxy and its model, so workers may call it. */
static McdBoxUpdate updateProxy(const McdSpace *s, McdProxy *p, MeReal duration) {
    McdModelRecord *m = p->model;
    m->isMarkedChanged = MEFALSE; /* its pairs will be tested */
    const MeBool isCompared = p->hasBox && isComparedBeforeUpdate(s, m);
    if (isCompared && isUpToDate(s, m, duration))
        return MCD_BOX_KEPT;
    if (!m->instance.tm && !m->update && !s->update)
        return MCD_BOX_UNSET;
    if (!updateBox(s, m, duration) || !isBox(m)) {
        MeVector3Copy(m->instance.min, p->min);
        MeVector3Copy(m->instance.max, p->max);
        return m->instance.tm ? MCD_BOX_INVALID : MCD_BOX_UNSET;
    }
    p->isWarned = MEFALSE;
    setTravel(s, m, isCompared);
    const McdBoxUpdate update = copyBox(p);
    markBoxValid(s, m, duration);
    return update;
}

McdModelID MEAPI McdFrameworkNextModel(McdFrameworkID frame, McdModelID cm) {
    McdModelRecord *next = cm ? mcd_record(cm)->next : frame->firstModel;
    return next ? &next->model : 0;
}

MeBool MEAPI McdModelIsCurrent(McdModelID cm) {
    return mcd_isPlacedAsCompared(mcd_record(cm));
}

MeU64 MEAPI McdModelGetStamp(McdModelID cm) {
    return mcd_record(cm)->stamp;
}

static void shiftInputs(McdModelRecord *m, const double by[3], MeBool wasCurrent) {
    for (int i = 0; i < 3; i++) {
        m->inputs.place[i] = wasCurrent ? m->instance.tm[3][i] : (MeReal)((double)m->inputs.place[i] + by[i]);
        m->past.place[i] = (MeReal)((double)m->past.place[i] + by[i]);
        m->instance.min[i] = (MeReal)((double)m->instance.min[i] + by[i]);
        m->instance.max[i] = (MeReal)((double)m->instance.max[i] + by[i]);
    }
    mcd_fromReal(m->shape.place, m->inputs.place);
    if (m->frame->sweptCount > 0)
        m->boxDuration = -1; /* its box along its motion is made in the next update */
}

/* The fat box is new, too: the links of the proxy are found again as those that they were. */
void MEAPI McdModelShift(McdModelID cm, const double by[3], MeBool wasCurrent) {
    McdModelRecord *m = mcd_record(cm);
    McdProxy *p = m->proxy;
    shiftInputs(m, by, wasCurrent);
    McdModelCompoundTransforms(cm);
    if (mcd_modelIsPlaced(m))
        mcd_modelRefresh(m);
    if (!m->space || !p->hasBox || !isBox(m))
        return;
    p->hasBox = MEFALSE;
    applyBox(m->space, p, copyBox(p));
}

/* Applies an update to the space; warns if the transform is not valid. */
static void applyUpdate(McdSpace *s, McdProxy *p, McdBoxUpdate update) {
    MEASSERT(update != MCD_BOX_LATER && update != MCD_BOX_MARKED);
    if (update == MCD_BOX_UNSET)
        warnTransform(p, p->hasBox ? "is not set; it keeps its old box"
                                   : "is not set, or its body was destroyed; it collides with nothing");
    else if (update == MCD_BOX_INVALID)
        warnTransform(p, "or box is not finite; it keeps its old box");
    else
        applyBox(s, p, update);
}

/* ---- updating ---------------------------------------------------------------------------------------------------- */

/* Appends a proxy to the list of proxies that are updated. */
static void appendAwake(McdSpace *s, McdProxy *p) {
    if (p->isAwake)
        return;
    s->awakeCount = MCD_NONE;
    p->isAwake = METRUE;
    p->nextAwake = MCD_NONE;
    p->previousAwake = s->lastAwake;
    MEASSERT((s->firstAwake == MCD_NONE) == (s->lastAwake == MCD_NONE));
    *(p->previousAwake == MCD_NONE ? &s->firstAwake : &s->proxy[p->previousAwake].nextAwake) = mcd_proxyIndex(s, p);
    s->lastAwake = mcd_proxyIndex(s, p);
}

static void unlinkAwake(McdSpace *s, McdProxy *p) {
    if (!p->isAwake)
        return;
    s->awakeCount = MCD_NONE;
    p->isAwake = MEFALSE;
    *(p->previousAwake == MCD_NONE ? &s->firstAwake : &s->proxy[p->previousAwake].nextAwake) = p->nextAwake;
    *(p->nextAwake == MCD_NONE ? &s->lastAwake : &s->proxy[p->nextAwake].previousAwake) = p->previousAwake;
    MEASSERT((s->firstAwake == MCD_NONE) == (s->lastAwake == MCD_NONE));
}

/* Whether a proxy needs no updates: it is frozen, and has a box or cannot get one. */
static MeBool needsNoUpdate(const McdProxy *p) {
    return p->isFrozen && (p->hasBox || !p->model->instance.tm);
}

static void updateInOrder(McdSpace *s, MeReal duration) {
    for (int i = s->firstAwake; i != MCD_NONE; i = s->proxy[i].nextAwake)
        if (needsNoUpdate(&s->proxy[i]))
            unlinkAwake(s, &s->proxy[i]);
        else /* callbacks may freeze and unfreeze models */
            applyUpdate(s, &s->proxy[i], updateProxy(s, &s->proxy[i], duration));
}

/* ---- by workers ---- */

typedef struct Updating {
    McdSpace *s;
    MeReal duration;
} Updating;

/* Marks a proxy dirty if it moved within its fat box. The calling thread then only adds its index to the list, without
 * loading the proxy. */
static McdBoxUpdate markDirtyIfMoved(McdProxy *p, McdBoxUpdate update) {
    if (update != MCD_BOX_MOVED)
        return update;
    if (p->isDirty)
        return MCD_BOX_KEPT;
    p->isDirty = METRUE;
    return MCD_BOX_MARKED;
}

/* Whether a function of the program computes the box of the instance or of one of its parts. */
static MeBool isBoxOfProgram(const McdGeometryInstance *ins) {
    const McdTypeRecord *type = &ins->geometry->frame->types[ins->geometry->type];
    if (!type->kind || type->getAABB != type->kind->box)
        return METRUE;
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        if (isBoxOfProgram(child))
            return METRUE;
    return MEFALSE;
}

static void MEAPI updateRange(void *context, int first, int end, int worker) {
    const Updating *u = context;
    McdSpace *s = u->s;
    (void)worker;
    for (int i = first; i < end; i++) {
        McdProxy *p = &s->proxy[s->awake[i]];
        s->updates[i] =
            (MeU8)(isBoxOfProgram(&p->model->instance) ? MCD_BOX_LATER
                                                       : markDirtyIfMoved(p, updateProxy(s, p, u->duration)));
    }
}

/* Lists the proxies to be updated, in order; returns their number. The list is kept until a proxy is added or
 * removed; not while some are frozen. */
static int listAwake(McdSpace *s) {
    int count = 0, frozen = 0;
    if (s->awakeCount != MCD_NONE)
        return s->awakeCount;
    for (int i = s->firstAwake; i != MCD_NONE; i = s->proxy[i].nextAwake) {
        frozen += s->proxy[i].isFrozen;
        if (needsNoUpdate(&s->proxy[i]))
            unlinkAwake(s, &s->proxy[i]);
        else
            s->awake[count++] = i;
    }
    s->awakeCount = frozen > 0 ? MCD_NONE : count;
    return count;
}

/* Updates boxes by workers. Deterministic: each range writes only to its own proxies and their models; then the
 * calling thread updates the tree and the dirty list, in the same order as without workers. */
static void updateByWorkers(McdSpace *s, MeReal duration) {
    Updating u = {s, duration};
    const int count = listAwake(s);
    mcd_spaceRunRanges(s, count, MCD_RANGE, updateRange, &u);
    for (int i = 0; i < count; i++) {
        McdProxy *p = &s->proxy[s->awake[i]];
        if (s->updates[i] == MCD_BOX_MARKED)
            s->dirty[s->dirtyCount++] = s->awake[i];
        else if (s->updates[i] != MCD_BOX_KEPT)
            applyUpdate(s, p,
                        s->updates[i] == MCD_BOX_LATER ? updateProxy(s, p, duration) : (McdBoxUpdate)s->updates[i]);
    }
    MEASSERT(s->dirtyCount <= s->proxyRoom);
}

/* Compares a range of models. Deterministic: each model is in one range, and only its own data are written. */
static void MEAPI compareRange(void *space, int first, int end, int worker) {
    const McdSpace *s = space;
    (void)worker;
    for (int i = first; i < end; i++)
        mcd_modelCompareInRound(s->proxy[s->awake[i]].model);
}

int MEAPI McdSpaceGetPairCount(McdSpaceID s) {
    MEASSERT(s);
    return s->hello.count + s->staying.count + s->goodbye.count;
}

void MEAPI McdSpaceCompareModels(McdSpaceID s) {
    MEASSERT(s);
    MeTeamRunRanges(s->team, listAwake(s), MCD_RANGE, compareRange, s);
}

static void updateAll(McdSpace *s, MeReal duration) {
    const MeBool ownsBlock = !s->isChanging;
    const int before = s->proxyCount;
    if (ownsBlock)
        beginBlock(s);
    MeStageBegin(&s->frame->stage, MCD_GUARD_MODELS);
    s->isUpdating = METRUE;
    if (s->team && s->proxyCount >= MCD_MIN_RANGES * MCD_RANGE && !s->update && s->frame->updateCallbacks == 0)
        updateByWorkers(s, duration);
    else
        updateInOrder(s, duration);
    s->isUpdating = MEFALSE;
    MEASSERT(before == s->proxyCount); /* callbacks do not insert or remove models */
    (void)before;
    s->isUpdated = METRUE;
    MeStageEnd(&s->frame->stage, MCD_GUARD_MODELS);
    if (ownsBlock)
        endBlock(s);
}

/* Whether the space may be updated. False, with a message, while models are guarded: boxes and pairs are in use. */
static MeBool mayUpdate(McdSpaceID s, const char *function) {
    if (!mcd_spaceCheck(s, function) || !MeProgramMayChange(function))
        return MEFALSE;
    if (areModelsGuarded(s))
        MeProgramRefuse(function, "the space is in use");
    return !areModelsGuarded(s);
}

void MEAPI McdSpaceSetTeam(McdSpaceID s, MeTeam *team) {
    MEASSERT(s);
    s->team = team;
}

void MEAPI McdSpaceSetLookAhead(McdSpaceID s, MeReal duration) {
    if (!mcd_spaceCheck(s, "McdSpaceSetLookAhead"))
        return;
    if (!(duration >= 0) || !MeRealIsValid(duration))
        MeWarning(1, "McdSpaceSetLookAhead: duration is %g: it must be >= 0", (double)duration);
    else
        s->lookAhead = duration;
}

MeReal MEAPI McdSpaceGetLookAhead(McdSpaceID s) {
    return mcd_spaceCheck(s, "McdSpaceGetLookAhead") ? s->lookAhead : 0;
}

void MEAPI McdSpaceUpdateAll(McdSpaceID s) {
    if (mayUpdate(s, "McdSpaceUpdateAll"))
        updateAll(s, 0);
}

void MEAPI McdSpacePathUpdateAll(McdSpaceID s, MeReal duration) {
    if (!mayUpdate(s, "McdSpacePathUpdateAll"))
        return;
    if (!(duration >= 0) || !MeRealIsValid(duration)) {
        MeWarning(1, "McdSpacePathUpdateAll: duration is %g: it must be >= 0", (double)duration);
        duration = 0;
    }
    updateAll(s, duration);
}

void MEAPI McdSpaceUpdateModels(McdSpaceID s) {
    if (checkInside(s, "McdSpaceUpdateModels") && mayUpdate(s, "McdSpaceUpdateModels"))
        updateAll(s, 0);
}

void MEAPI McdSpaceUpdateModel(McdModelID cm) {
    McdProxy *p = proxyOf(cm, "McdSpaceUpdateModel");
    if (!p || !checkInside(p->model->space, "McdSpaceUpdateModel"))
        return;
    if (MeStageIsActive(&p->model->frame->stage, MCD_GUARD_SHAPES))
        return; /* the next update finds the change */
    if (p->isFrozen)
        MeWarning(1, "McdSpaceUpdateModel: the model is frozen: see McdSpaceUnfreezeModel");
    else
        applyUpdate(p->model->space, p, updateProxy(p->model->space, p, 0));
}

void MEAPI McdSpaceSetAABBFn(McdSpaceID s, McdSpaceUpdateAABBFnPtr updateAABBFn) {
    if (mcd_spaceIsReady(s, "McdSpaceSetAABBFn"))
        s->update = updateAABBFn;
}

static MeBool setFrozen(McdModelID cm, MeBool isFrozen, const char *function) {
    McdProxy *p = proxyOf(cm, function);
    if (!p)
        return MEFALSE;
    if (p->isFrozen == isFrozen)
        return METRUE;
    p->isFrozen = isFrozen;
    p->model->space->awakeCount = MCD_NONE;
    if (isFrozen) { /* a frozen model does not move */
        clearLookAhead(p->model);
        p->tolerance = mcd_modelMargin(p->model);
        if (p->hasBox)
            p->model->boxStamp = mcd_modelCompare(p->model); /* the stamp to compare with (mcd_frozen.c) */
    } else {
        appendAwake(p->model->space, p);
        p->isMoved = METRUE; /* its links to frozen models without a pair were dropped: search them again */
    }
    mcd_proxyMarkDirty(p);
    return METRUE;
}

MeBool MEAPI McdSpaceFreezeModel(McdModelID cm) {
    return setFrozen(cm, METRUE, "McdSpaceFreezeModel");
}

MeBool MEAPI McdSpaceUnfreezeModel(McdModelID cm) {
    return setFrozen(cm, MEFALSE, "McdSpaceUnfreezeModel");
}

MeBool MEAPI McdSpaceModelIsFrozen(McdModelID cm) {
    const McdProxy *p = proxyOf(cm, "McdSpaceModelIsFrozen");
    return p && p->isFrozen;
}

MeBool MEAPI McdSpaceIsFrozen(McdModelID cm) {
    ME_RETURN_UNDER_OWN_NAME(MeBool, McdSpaceModelIsFrozen(cm));
}

/* ---- models ------------------------------------------------------------------------------------------------------ */

static MeBool canInsert(McdSpaceID s, McdModelID cm, const char *function) {
    if (!checkInside(s, function) || !mcd_modelCheck(cm, function))
        return MEFALSE;
    if (mcd_record(cm)->space)
        MeWarning(1, "%s: the model is in a space already", function);
    else if (mcd_record(cm)->frame != s->frame)
        MeWarning(1, "%s: the model belongs to another framework", function);
    else if (s->isUpdating)
        MeProgramRefuse(function, "the space is being updated");
    else if (!MeProgramMayChange(function))
        return MEFALSE;
    else
        return reserveOneProxy(s, function);
    return MEFALSE;
}

static McdProxy *allocateProxy(McdSpace *s) {
    const int i = s->freeProxy;
    MEASSERT(i >= 0 && i < s->proxyRoom && s->proxyCount < s->proxyRoom);
    McdProxy *p = &s->proxy[i];
    s->freeProxy = p->next;
    s->proxyCount++;
    memset(p, 0, sizeof *p);
    p->firstLink = p->next = MCD_NONE;
    p->previous = s->lastProxy;
    *(p->previous == MCD_NONE ? &s->firstProxy : &s->proxy[p->previous].next) = i;
    s->lastProxy = i;
    appendAwake(s, p);
    return p;
}

/* Removes a proxy whose links have been dropped from the space, and frees it. */
static void releaseModel(McdSpace *s, McdProxy *p) {
    MEASSERT(p->firstLink == MCD_NONE && !p->isDirty && p->model->proxy == p);
    dropLeaf(s, p);
    dropUnbounded(s, p);
    unlinkAwake(s, p);
    clearLookAhead(p->model);
    p->model->space = 0;
    p->model->proxy = 0;
    p->model->isGone = p->model->isCondemned;
    p->model = 0;
    *(p->previous == MCD_NONE ? &s->firstProxy : &s->proxy[p->previous].next) = p->next;
    *(p->next == MCD_NONE ? &s->lastProxy : &s->proxy[p->next].previous) = p->previous;
    p->next = s->freeProxy;
    s->freeProxy = mcd_proxyIndex(s, p);
    s->proxyCount--;
}

/* Whether the model has ever been updated; if not, its box is all zeros. */
static MeBool wasUpdated(const McdModelRecord *m) {
    static const MeVector3 zero = {0, 0, 0};
    return isBox(m) && (memcmp(m->instance.min, zero, sizeof zero) || memcmp(m->instance.max, zero, sizeof zero));
}

static void insertModel(McdSpace *s, McdModelRecord *m) {
    McdProxy *p = allocateProxy(s);
    MEASSERT(m->frame == s->frame && !m->space && !m->proxy);
    p->model = m;
    p->filter = m->filter;
    p->order = (MeU64)(MeU16)m->sortKey << 48 | ((MeU64)m->serial & 0xffffffffffffull);
    m->space = s;
    m->proxy = p;
    if (wasUpdated(m) && !areModelsGuarded(s))
        applyBox(s, p, copyBox(p));
}

MeBool MEAPI McdSpaceInsertModel(McdSpaceID s, McdModelID cm) {
    const MeBool isGood = canInsert(s, cm, "McdSpaceInsertModel");
    if (isGood)
        insertModel(s, mcd_record(cm));
    return isGood;
}

static void setCulling(McdProxy *p, McdCullingTable *table, int index, int id, const char *function) {
    if (table && (index < 0 || index >= McdCullingTableGetSize(table))) {
        MeWarning(1, "%s: cullingIndex is %d: the table is for 0 .. %d", function, index,
                  McdCullingTableGetSize(table) - 1);
        return;
    }
    p->table = table;
    p->cullingIndex = index;
    p->cullingID = id;
    mcd_proxyMarkDirty(p);
}

MeBool MEAPI McdSpaceInsertModelWithCulling(McdSpaceID s, McdModelID cm, McdCullingTable *table, int cullingIndex,
                                            int cullingID) {
    if (!canInsert(s, cm, "McdSpaceInsertModelWithCulling"))
        return MEFALSE;
    insertModel(s, mcd_record(cm));
    setCulling(mcd_record(cm)->proxy, table, cullingIndex, cullingID, "McdSpaceInsertModelWithCulling");
    return METRUE;
}

static void removeProxy(McdProxy *p) {
    mcd_pairsForgetProxy(p);
    releaseModel(p->model->space, p);
}

static void MEAPI removeDeferred(const MeLater *later) {
    const McdModelRecord *m = mcd_deferredModel(later);
    if (m && m->space)
        removeProxy(m->proxy);
}

MeBool MEAPI McdSpaceRemoveModel(McdModelID cm) {
    McdProxy *p = proxyOf(cm, "McdSpaceRemoveModel");
    if (!p || !checkInside(p->model->space, "McdSpaceRemoveModel"))
        return MEFALSE;
    McdModelRecord *m = p->model; /* cm may be a stand-in for a part of it */
    const MeLater later = {.carryOut = removeDeferred, .object = m, .serial = m->serial};
    const MeWhen when = mcd_deferWhileGuarded(m->frame, &later, "McdSpaceRemoveModel");
    if (when == MeWhenNow)
        removeProxy(p);
    else if (when == MeWhenStageEnds)
        m->isGone = true;
    return when != MeWhenNever;
}

int MEAPI McdSpaceGetModelCount(McdSpaceID space) {
    return mcd_spaceCheck(space, "McdSpaceGetModelCount") ? space->proxyCount : 0;
}

static McdModelID modelAt(const McdSpace *s, int proxy) {
    return proxy == MCD_NONE ? 0 : &s->proxy[proxy].model->model;
}

void MEAPI McdSpaceModelIteratorBegin(McdSpaceID s, McdSpaceModelIterator *it) {
    if (!it)
        MeWarning(1, "McdSpaceModelIteratorBegin: no iterator");
    else
        it->next = mcd_spaceCheck(s, "McdSpaceModelIteratorBegin") ? modelAt(s, s->firstProxy) : 0;
}

MeBool MEAPI McdSpaceGetModel(McdSpaceID s, McdSpaceModelIterator *it, McdModelID *cm) {
    if (!mcd_spaceCheck(s, "McdSpaceGetModel") || !it || !cm) {
        if (!it || !cm)
            MeWarning(1, "McdSpaceGetModel: no iterator, or no place for the model");
        return MEFALSE;
    }
    *cm = it->next && mcd_record(it->next)->space == s ? it->next : 0;
    it->next = *cm ? modelAt(s, ((const McdProxy *)mcd_record(*cm)->proxy)->next) : 0;
    return *cm != 0;
}

/* ---- pairs that never collide ------------------------------------------------------------------------------------ */

/* Finds the proxies of two different models in one space; false, with a warning, if they are not. */
static MeBool proxiesOf(McdModelID cm1, McdModelID cm2, McdProxy **p1, McdProxy **p2, const char *function) {
    *p1 = proxyOf(cm1, function);
    *p2 = *p1 ? proxyOf(cm2, function) : 0;
    if (!*p2)
        return MEFALSE;
    if (cm1 != cm2 && (*p1)->model->space == (*p2)->model->space)
        return METRUE;
    MeWarning(1, "%s: it must be two models of one space", function);
    return MEFALSE;
}

MeBool MEAPI McdSpaceDisablePair(McdModelID cm1, McdModelID cm2) {
    McdProxy *a, *b;
    if (cm1 == cm2 && cm1 && mcd_modelCheck(cm1, "McdSpaceDisablePair")) /* a model never collides with itself */
        return METRUE;
    if (!proxiesOf(cm1, cm2, &a, &b, "McdSpaceDisablePair") || !checkInside(a->model->space, "McdSpaceDisablePair"))
        return MEFALSE;
    return mcd_pairsDisable(a, b);
}

MeBool MEAPI McdSpaceEnablePair(McdModelID cm1, McdModelID cm2) {
    McdProxy *a, *b;
    if (!proxiesOf(cm1, cm2, &a, &b, "McdSpaceEnablePair") || !checkInside(a->model->space, "McdSpaceEnablePair"))
        return MEFALSE;
    mcd_pairsEnable(a, b);
    return METRUE;
}

MeBool MEAPI McdSpacePairIsEnabled(McdModelID cm1, McdModelID cm2) {
    McdProxy *a, *b;
    return proxiesOf(cm1, cm2, &a, &b, "McdSpacePairIsEnabled") && mcd_pairsAreEnabled(a, b);
}

void MEAPI McdSpaceSetModelCullingParameters(McdSpaceID s, McdModelID cm, McdCullingTable *table, int cullingIndex,
                                             int cullingID) {
    McdProxy *p = proxyOf(cm, "McdSpaceSetModelCullingParameters");
    if (!p || !checkInside(s, "McdSpaceSetModelCullingParameters"))
        return;
    if (p->model->space != s)
        MeWarning(1, "McdSpaceSetModelCullingParameters: the model is in another space");
    else
        setCulling(p, table, cullingIndex, cullingID, "McdSpaceSetModelCullingParameters");
}

/* ---- lists of pairs for programs ------------------------------------------------------------- */

void MEAPI McdSpacePairIteratorBegin(McdSpaceID s, McdSpacePairIterator *iter) {
    if (!iter) {
        MeWarning(1, "McdSpacePairIteratorBegin: no iterator");
        return;
    }
    memset(iter, 0, sizeof *iter);
    if (mcd_spaceIsReady(s, "McdSpacePairIteratorBegin"))
        iter->step = s->step;
}

/* Copies `count` pairs of a list, from *from on, to array[at]; advances *from. */
static void copyPairs(McdModelPairContainer *c, int at, const McdPairList *list, int *from, int count) {
    for (int i = 0; i < count; i++)
        c->array[at + i] = &list->entry[*from + i].record->pair;
    *from += count;
}

/* Fills the container: goodbye and hello pairs at the front, staying pairs behind them. If not all fit, the front gets
 * half of the places, or more if there are fewer staying pairs than that. */
static int fillContainer(const McdSpace *s, McdSpacePairIterator *it, McdModelPairContainer *c, MeBool withStaying) {
    const int goodbye = s->goodbye.count - it->goodbye, hello = s->hello.count - it->hello;
    const int staying = withStaying ? s->staying.count - it->staying : 0;
    const int border = MeMIN(goodbye + hello, MeMAX((c->size + 1) / 2, c->size - staying));
    c->goodbyeEnd = MeMIN(goodbye, border);
    c->helloEnd = c->stayingFirst = border;
    c->helloFirst = border - MeMIN(hello, border - c->goodbyeEnd);
    c->stayingEnd = border + MeMIN(staying, c->size - border);
    copyPairs(c, 0, &s->goodbye, &it->goodbye, c->goodbyeEnd);
    copyPairs(c, c->helloFirst, &s->hello, &it->hello, border - c->helloFirst);
    copyPairs(c, border, &s->staying, &it->staying, c->stayingEnd - border);
    MEASSERT(c->goodbyeEnd <= c->helloFirst && c->helloFirst <= c->helloEnd && c->stayingFirst <= c->stayingEnd &&
             c->stayingEnd <= c->size);
    MEASSERT(it->goodbye <= s->goodbye.count && it->hello <= s->hello.count && it->staying <= s->staying.count);
    return it->goodbye < s->goodbye.count || it->hello < s->hello.count ||
           (withStaying && it->staying < s->staying.count);
}

static int getPairs(McdSpaceID s, McdSpacePairIterator *it, McdModelPairContainer *c, MeBool withStaying,
                    const char *function) {
    if (c && c->array && c->size > 0)
        McdModelPairContainerReset(c);
    if (!mcd_spaceIsReady(s, function))
        return 0;
    if (!it || !c || !c->array || c->size < 1) {
        MeWarning(1, "%s: no iterator, or no container", function);
        return 0;
    }
    if (it->step != s->step) {
        MeWarning(1, "%s: the iterator is of another step: see McdSpacePairIteratorBegin", function);
        return 0;
    }
    mcd_pairsRemoveErased(s);
    return fillContainer(s, it, c, withStaying);
}

int MEAPI(McdSpaceGetPairs)(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c) {
    return getPairs(s, iter, c, METRUE, "McdSpaceGetPairs");
}

int MEAPI(McdSpaceGetTransitions)(McdSpaceID s, McdSpacePairIterator *iter, McdModelPairContainer *c) {
    return getPairs(s, iter, c, MEFALSE, "McdSpaceGetTransitions");
}

/* Gets pairs with the space's own iterator, which restarts after the last pair. */
static int getNextPairs(McdSpaceID s, McdModelPairContainer *c, MeBool withStaying, const char *function) {
    if (!mcd_spaceIsReady(s, function))
        return 0;
    const int isMore = getPairs(s, &s->own, c, withStaying, function);
    if (!isMore)
        McdSpacePairIteratorBegin(s, &s->own);
    return isMore;
}

int MEAPI McdSpaceGetNextPairs(McdSpaceID s, McdModelPairContainer *c) {
    return getNextPairs(s, c, METRUE, "McdSpaceGetPairs");
}

int MEAPI McdSpaceGetNextTransitions(McdSpaceID s, McdModelPairContainer *c) {
    return getNextPairs(s, c, MEFALSE, "McdSpaceGetTransitions");
}

/* ---- queries ----------------------------------------------------------------------------------------------------- */

/* Whether queries skip a model: it is being removed or destroyed, or is a sensor and queries ignore sensors. */
static MeBool isSkipped(const McdSpace *s, const McdModelRecord *m) {
    return m->isGone || (m->isSensor && !s->queriesHitSensors);
}

MeBool mcd_passesFilter(const McdSpace *s, McdModelID cm, McdLineSegIntersectEnableCallback filter, void *filterData,
                        const char *function) {
    if (!filter || isSkipped(s, mcd_record(cm)))
        return !isSkipped(s, mcd_record(cm));
    const MeProgramCall before = MeProgramEnter(function);
    const MeBool passes = filter(cm, filterData) != 0;
    MeProgramLeave(&before);
    return passes && !mcd_record(cm)->isGone;
}

void mcd_spaceOverlap(const McdSpace *s, const double min[3], const double max[3], McdTreeVisit visit, void *context) {
    McdTreeBox box;
    mcd_treeBox(min, max, &box);
    for (int i = 0; i < s->unboundedCount; i++) {
        MEASSERT(s->proxy[s->unbounded[i]].isUnbounded);
        if (!visit(context, s->unbounded[i]))
            return;
    }
    mcd_treeQuery(s->tree, &box, visit, context);
}

void mcd_spaceCast(const McdSpace *s, const double from[3], const double by[3], const double half[3], double fraction,
                   McdTreeCastVisit visit, void *context) {
    for (int i = 0; i < s->unboundedCount; i++)
        if (mcd_treeCastBox(&s->proxy[s->unbounded[i]].fat, from, by, half, fraction))
            fraction = visit(context, s->unbounded[i], fraction);
    mcd_treeCast(s->tree, from, by, half, fraction, visit, context);
}

void MEAPI McdSpaceSetQuerySensors(McdSpaceID s, MeBool on) {
    if (mcd_spaceCheck(s, "McdSpaceSetQuerySensors"))
        s->queriesHitSensors = on != 0;
}

MeBool MEAPI McdSpaceGetQuerySensors(McdSpaceID s) {
    return mcd_spaceCheck(s, "McdSpaceGetQuerySensors") && s->queriesHitSensors;
}

typedef struct Segment {
    const McdSpace *space;
    MeReal *from, *to;
    double length;
    McdLineSegIntersectEnableCallback filter;
    void *filterData;
    McdLineSegIntersectResult *list;
    int count, max;
    const char *function;
} Segment;

static void addHit(Segment *q, const McdLineSegIntersectResult *hit) {
    if (q->count == q->max && !mcd_isHitNearer(hit, &q->list[q->max - 1]))
        return;
    int at = q->count < q->max ? q->count++ : q->max - 1;
    for (; at > 0 && mcd_isHitNearer(hit, &q->list[at - 1]); at--)
        q->list[at] = q->list[at - 1];
    q->list[at] = *hit;
    MEASSERT(q->count <= q->max && (at + 1 >= q->count || !mcd_isHitNearer(&q->list[at + 1], hit)));
}

/* The fraction of the segment that must still be searched: if the list is full, up to its last hit, plus a margin
 * for rounding. */
static double searchFraction(const Segment *q) {
    if (q->count < q->max || q->length == 0)
        return 1;
    return fmin(1, (double)q->list[q->max - 1].distance / q->length * (1 + 16 * (double)ME_EPSILON) +
                       16 * (double)ME_EPSILON);
}

static double intersectModel(void *context, int proxy, double fraction) {
    Segment *q = context;
    const McdModelID cm = modelAt(q->space, proxy);
    McdLineSegIntersectResult hit;
    if (!mcd_passesFilter(q->space, cm, q->filter, q->filterData, q->function) ||
        !mcd_lineSegIntersect(cm, q->from, q->to, &hit))
        return fraction;
    hit.model = cm;
    addHit(q, &hit);
    return searchFraction(q);
}

static MeBool checkSegment(McdSpaceID s, const MeReal *from, const MeReal *to, const char *function) {
    if (!mcd_spaceIsReady(s, function))
        return MEFALSE;
    if (from && to && mcd_areInRange(from, 3) && mcd_areInRange(to, 3))
        return METRUE;
    MeWarning(1, "%s: an end of the segment is null, not finite, or beyond %g", function, (double)FLT_MAX);
    return MEFALSE;
}

static int castSegment(Segment *q) {
    const double still[3] = {0, 0, 0};
    double from[3], by[3];
    mcd_fromReal(from, q->from);
    mcd_fromReal(by, q->to);
    mcd_sub(by, by, from);
    q->length = mcd_length(by);
    MeStageBegin(&q->space->frame->stage, MCD_GUARD_SHAPES);
    mcd_spaceCast(q->space, from, by, still, 1, intersectModel, q);
    MeStageEnd(&q->space->frame->stage, MCD_GUARD_SHAPES);
    return q->count;
}

int mcd_segmentFirstHit(McdSpaceID s, MeReal *from, MeReal *to, McdLineSegIntersectEnableCallback filter,
                        void *filterData, McdLineSegIntersectResult *result, const char *function) {
    Segment q = {s, from, to, 0, filter, filterData, result, 0, 1, function};
    if (!checkSegment(s, from, to, function))
        return 0;
    if (!result) {
        MeWarning(1, "%s: no place for the result", function);
        return 0;
    }
    return castSegment(&q);
}

int MEAPI McdSpaceGetLineSegFirstIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                              McdLineSegIntersectResult *outResult) {
    return mcd_segmentFirstHit(space, inOrig, inDest, 0, 0, outResult, "McdSpaceGetLineSegFirstIntersection");
}

int MEAPI McdSpaceGetLineSegFirstEnabledIntersection(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                                     McdLineSegIntersectEnableCallback filterCB, void *filterData,
                                                     McdLineSegIntersectResult *outResult) {
    return mcd_segmentFirstHit(space, inOrig, inDest, filterCB, filterData, outResult,
                               "McdSpaceGetLineSegFirstEnabledIntersection");
}

int MEAPI McdSpaceGetLineSegIntersections(McdSpaceID space, MeReal *inOrig, MeReal *inDest,
                                          McdLineSegIntersectResult *outList, int inMaxListSize) {
    Segment q = {space, inOrig, inDest, 0, 0, 0, outList, 0, inMaxListSize, "McdSpaceGetLineSegIntersections"};
    if (!checkSegment(space, inOrig, inDest, "McdSpaceGetLineSegIntersections"))
        return 0;
    if (!outList || inMaxListSize < 1) {
        MeWarning(1, "McdSpaceGetLineSegIntersections: no place for results");
        return 0;
    }
    return castSegment(&q);
}
