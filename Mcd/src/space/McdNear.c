/* What is near a capsule that the program moves: gathered once, then measured as often as the capsule's way needs. */
#include "McdInternal.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"
#include "space/mcd_space_i.h"
#include "surface/mcd_scratch_i.h"
#include <stdlib.h>
#include <string.h>

typedef struct NearChild {
    McdModelID model;
    McdGeometryInstance *instance;
    McdShape shape; /* kind null: a half-space */
    MeBool isTriangle, isTwoSided;
    double normal[3];       /* of a triangle, on its front */
    double low[3], high[3]; /* its box; of a half-space: not set */
} NearChild;

struct McdNear {
    McdScratch *scratch; /* owns this record and both arrays */
    const McdSpace *space;
    const McdKind *capsule;
    McdLineSegIntersectEnableCallback filter;
    void *filterData;
    double origin[3], low[3], high[3];
    McdModelID *model; /* those whose boxes overlap, in order */
    int modelCount, modelRoom;
    NearChild *child;
    int count, room;
};

/* ---- gathering --------------------------------------------------------------------------------------------------- */

static int compareModels(const void *a, const void *b) {
    const McdModelRecord *m1 = mcd_record(*(const McdModelID *)a), *m2 = mcd_record(*(const McdModelID *)b);
    return mcd_modelPrecedes(m1, m2) ? -1 : mcd_modelPrecedes(m2, m1);
}

static MeBool visitModel(void *context, int proxy) {
    McdNear *n = context;
    const McdModelID cm = &n->space->proxy[proxy].model->model;
    if (!mcd_passesFilter(n->space, cm, n->filter, n->filterData, "MstMoverMove") || !mcd_modelIsPlaced(mcd_record(cm)))
        return METRUE;
    if (n->modelCount == n->modelRoom) {
        const int room = MeMAX(16, 2 * n->modelRoom);
        if (!MeMemoryGrow(&n->model, (size_t)n->modelCount, (size_t)room, sizeof *n->model, "MstMoverMove", "models"))
            return MEFALSE;
        n->modelRoom = room;
        n->scratch->nearModel = n->model;
    }
    mcd_modelPlaceChildren(mcd_record(cm));
    n->model[n->modelCount++] = cm;
    return METRUE;
}

/* A new part; null, after a fatal error, if there is no memory. */
static NearChild *addChild(McdNear *n, McdModelID cm, McdGeometryInstance *ins) {
    if (n->count == n->room) {
        const int room = MeMAX(32, 2 * n->room);
        if (!MeMemoryGrow(&n->child, (size_t)n->count, (size_t)room, sizeof *n->child, "MstMoverMove", "parts"))
            return 0;
        n->room = room;
        n->scratch->nearChild = n->child;
    }
    NearChild *p = &n->child[n->count++];
    p->model = cm;
    p->instance = ins;
    p->isTriangle = p->isTwoSided = MEFALSE;
    return p;
}

static MeBool isWithin(const McdNear *n, const double low[3], const double high[3]) {
    for (int i = 0; i < 3; i++)
        if (low[i] > n->high[i] || high[i] < n->low[i])
            return MEFALSE;
    return METRUE;
}

typedef struct Gathering {
    McdNear *near;
    McdModelID model;
    McdGeometryInstance *instance;
} Gathering;

static MeBool visitTriangle(void *context, const McdMeshTriangle *t, const McdShape *triangle) {
    const Gathering *g = context;
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = mcd_triangleLow(t, i);
        high[i] = mcd_triangleHigh(t, i);
    }
    if (!isWithin(g->near, low, high))
        return METRUE;
    NearChild *p = addChild(g->near, g->model, g->instance);
    if (!p)
        return MEFALSE;
    p->shape = *triangle;
    p->isTriangle = METRUE;
    p->isTwoSided = (t->flags & kMcdTriangleTwoSided) != 0;
    mcd_copy(p->normal, t->normal);
    mcd_copy(p->low, low);
    mcd_copy(p->high, high);
    return METRUE;
}

static void addLeaf(McdNear *n, McdModelID cm, McdGeometryInstance *ins) {
    McdShape shape;
    double low[3], high[3];
    if (!mcd_instanceIsPlaced(ins))
        return;
    if (mcd_isSurface(ins)) {
        Gathering g = {n, cm, ins};
        mcd_meshForEachNear(ins, 0, n->origin, n->low, n->high, visitTriangle, &g);
        return;
    }
    if (mcd_isHalfSpace(ins)) {
        NearChild *p = addChild(n, cm, ins);
        if (p)
            p->shape.kind = 0;
        return;
    }
    if (!mcd_shapeOf(ins, n->origin, &shape))
        return;
    mcd_shapeBounds(&shape, low, high);
    if (!isWithin(n, low, high))
        return;
    NearChild *p = addChild(n, cm, ins);
    if (p) {
        p->shape = shape;
        mcd_copy(p->low, low);
        mcd_copy(p->high, high);
    }
}

static void addInstance(McdNear *n, McdModelID cm, McdGeometryInstance *ins) {
    if (!ins->firstChild)
        addLeaf(n, cm, ins);
    for (McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        addInstance(n, cm, child);
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

McdNear *MEAPI McdNearBegin(McdSpaceID s, const double origin[3], const double low[3], const double high[3],
                            McdLineSegIntersectEnableCallback filter, void *filterData) {
    double worldLow[3], worldHigh[3];
    const McdKind *capsule = mcd_spaceCheck(s, "MstMoverMove") ? s->frame->types[kMcdGeometryTypeSphyl].kind : 0;
    if (!capsule)
        return 0;
    McdScratch *scratch = mcd_scratchAcquire(s->frame, "MstMoverMove");
    if (!scratch)
        return 0;
    McdNear *n = scratch->near ? scratch->near : MeMemoryTakeZeroed(1, sizeof *n, "MstMoverMove", "a query");
    if (!n) {
        mcd_scratchRelease(s->frame, scratch);
        return 0;
    }
    scratch->near = n;
    n->scratch = scratch;
    n->space = s;
    n->capsule = capsule;
    n->filter = filter;
    n->filterData = filterData;
    n->count = n->modelCount = 0;
    mcd_copy(n->origin, origin);
    mcd_copy(n->low, low);
    mcd_copy(n->high, high);
    for (int i = 0; i < 3; i++) {
        worldLow[i] = low[i] + origin[i];
        worldHigh[i] = high[i] + origin[i];
    }
    MeStageBegin(&s->frame->stage, MCD_GUARD_SHAPES);
    mcd_spaceOverlap(s, worldLow, worldHigh, visitModel, n);
    qsort(n->model, (size_t)n->modelCount, sizeof *n->model, compareModels);
    for (int i = 0; i < n->modelCount; i++)
        addInstance(n, n->model[i], &mcd_record(n->model[i])->instance);
    MeStageEnd(&s->frame->stage, MCD_GUARD_SHAPES);
    return n;
}

void MEAPI McdNearEnd(McdNear *n) {
    mcd_scratchRelease(n->space->frame, n->scratch);
}

int MEAPI McdNearGetCount(const McdNear *n) {
    return n->count;
}

McdModelID MEAPI McdNearGetModel(const McdNear *n, int i) {
    return n->child[i].model;
}

McdGeometryInstanceID MEAPI McdNearGetInstance(const McdNear *n, int i) {
    return n->child[i].instance;
}

/* ---- gaps -------------------------------------------------------------------------------------------------------- */

static void capsuleShape(const McdNear *n, const McdCapsule *c, McdShape *shape) {
    memset(shape, 0, sizeof *shape);
    double along[3];
    mcd_sub(along, c->end[1], c->end[0]);
    const double length = mcd_length(along);
    for (int i = 0; i < 3; i++) {
        shape->place[i] = (c->end[0][i] + c->end[1][i]) / 2;
        shape->axis[2][i] = length > 0 ? along[i] / length : i == 2;
    }
    mcd_basis(shape->axis[2], shape->axis[0], shape->axis[1]);
    shape->kind = n->capsule;
    shape->low = length / 2;
    shape->rounding = c->radius;
    shape->extent = shape->low + shape->rounding;
}

static MeBool isBoxWithin(const NearChild *p, const McdCapsule *c, double reach) {
    const double max = c->radius + reach;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double low = MeMIN(c->end[0][i], c->end[1][i]), high = MeMAX(c->end[0][i], c->end[1][i]);
        const double below = p->low[i] - high, above = low - p->high[i], gap = MeMAX(below, above);
        sum += gap > 0 ? gap * gap : 0;
    }
    return sum <= max * max;
}

/* Measures the height of the lower end above a plane. */
static void measurePlane(const double normal[3], const double base[3], const McdCapsule *c, McdNearGap *gap) {
    const double h0 = mcd_heightOver(c->end[0], base, normal), h1 = mcd_heightOver(c->end[1], base, normal);
    mcd_copy(gap->normal, normal);
    gap->distance = fmin(h0, h1) - c->radius;
    mcd_mad(gap->position, c->end[h1 < h0], -fmin(h0, h1), normal);
}

static void measureHalfSpace(const McdNear *n, const NearChild *p, const McdCapsule *c, McdNearGap *gap) {
    const MeMatrix4Ptr tm = mcd_instanceTM(p->instance);
    double normal[3], base[3];
    mcd_fromReal(normal, tm[2]);
    for (int i = 0; i < 3; i++)
        base[i] = (double)tm[3][i] - n->origin[i];
    measurePlane(normal, base, c, gap);
}

/* ---- gaps of triangles ---- */

/* The nearest points of a segment and a triangle so far. */
typedef struct Nearest {
    double squared, onSegment[3], onTriangle[3];
} Nearest;

static void tryPair(Nearest *n, const double onSegment[3], const double onTriangle[3]) {
    const double squared = mcd_distanceSquared(onSegment, onTriangle);
    if (squared >= n->squared)
        return;
    n->squared = squared;
    mcd_copy(n->onSegment, onSegment);
    mcd_copy(n->onTriangle, onTriangle);
}

/* The nearest points of the segments a + s u and b + t w, s and t in 0 .. 1. */
static void trySegments(Nearest *n, const double a[3], const double u[3], const double b[3], const double w[3]) {
    double from[3], onA[3], onB[3];
    mcd_sub(from, a, b);
    const double uu = mcd_dot(u, u), ww = mcd_dot(w, w), uw = mcd_dot(u, w), uf = mcd_dot(u, from),
                 wf = mcd_dot(w, from);
    const double det = uu * ww - uw * uw;
    double s = det > 1e-12 * uu * ww ? MeCLAMP((uw * wf - uf * ww) / det, 0, 1) : 0;
    double t = ww > 0 ? (wf + s * uw) / ww : 0;
    if (t < 0 || t > 1) {
        t = t < 0 ? 0 : 1;
        s = uu > 0 ? MeCLAMP((t * uw - uf) / uu, 0, 1) : 0;
    }
    mcd_mad(onA, a, s, u);
    mcd_mad(onB, b, t, w);
    tryPair(n, onA, onB);
}

/* Whether a point projects into a triangle with the unit normal `normal`. */
static MeBool isOver(const double corner[3][3], const double normal[3], const double point[3]) {
    for (int i = 0; i < 3; i++) {
        double edge[3], to[3], across[3];
        mcd_sub(edge, corner[(i + 1) % 3], corner[i]);
        mcd_sub(to, point, corner[i]);
        mcd_cross(across, edge, to);
        if (mcd_dot(across, normal) < 0)
            return MEFALSE;
    }
    return METRUE;
}

/* The gap of a capsule from the edges of a triangle. */
static void measureEdges(const NearChild *p, const McdCapsule *c, McdNearGap *gap) {
    const double(*corner)[3] = p->shape.corner;
    Nearest n = {.squared = INFINITY};
    double along[3];
    mcd_sub(along, c->end[1], c->end[0]);
    for (int i = 0; i < 3; i++) {
        double edge[3];
        mcd_sub(edge, corner[(i + 1) % 3], corner[i]);
        trySegments(&n, c->end[0], along, corner[i], edge);
    }
    const double distance = sqrt(n.squared);
    mcd_sub(gap->normal, n.onSegment, n.onTriangle);
    if (distance > 0)
        mcd_scale(gap->normal, gap->normal, 1 / distance);
    else
        mcd_copy(gap->normal, p->normal);
    mcd_copy(gap->position, n.onTriangle);
    gap->distance = distance - c->radius;
}

static MeBool measureTriangle(const NearChild *p, const McdCapsule *c, double reach, McdNearGap *gap) {
    double height[2], crossing[3];
    for (int i = 0; i < 2; i++)
        height[i] = mcd_heightOver(c->end[i], p->shape.corner[0], p->shape.axis[2]);
    const double sign = mcd_dot(p->normal, p->shape.axis[2]) < 0 ? -1 : 1, max = c->radius + reach;
    const double low = MeMIN(height[0], height[1]), high = MeMAX(height[0], height[1]);
    if (low > max || high < -max || (!p->isTwoSided && (sign > 0 ? high : -low) < 0))
        return MEFALSE;
    if (low < 0 && high > 0) {
        for (int i = 0; i < 3; i++)
            crossing[i] = (c->end[0][i] * height[1] - c->end[1][i] * height[0]) / (height[1] - height[0]);
        if (isOver(p->shape.corner, p->shape.axis[2], crossing)) { /* out through the front, or the nearer side */
            double out[3];
            mcd_scale(out, p->shape.axis[2], p->isTwoSided && -low > high ? -1 : p->isTwoSided ? 1 : sign);
            measurePlane(out, p->shape.corner[0], c, gap);
            return METRUE;
        }
    }
    /* If both ends are on one side, the lower one is nearest if it is over the triangle; else an edge is. */
    const int nearer = fabs(height[1]) < fabs(height[0]);
    if (low * high >= 0 && isOver(p->shape.corner, p->shape.axis[2], c->end[nearer])) {
        mcd_scale(gap->normal, p->shape.axis[2], high > 0 ? 1 : low < 0 ? -1 : sign);
        mcd_mad(gap->position, c->end[nearer], -height[nearer], p->shape.axis[2]);
        gap->distance = fabs(height[nearer]) - c->radius;
        return gap->distance <= reach;
    }
    measureEdges(p, c, gap);
    return gap->distance <= reach && (p->isTwoSided || mcd_dot(gap->normal, p->normal) > -1e-6);
}

MeBool MEAPI McdNearMeasure(const McdNear *n, int i, const McdCapsule *c, double reach, McdNearGap *gap) {
    const NearChild *p = &n->child[i];
    McdShape shape;
    double onCapsule[3];
    if (!p->shape.kind) {
        measureHalfSpace(n, p, c, gap);
        return gap->distance <= reach;
    }
    if (!isBoxWithin(p, c, reach))
        return MEFALSE;
    if (p->isTriangle)
        return measureTriangle(p, c, reach, gap);
    capsuleShape(n, c, &shape);
    gap->distance = mcd_convexDistance(&shape, &p->shape, onCapsule, gap->position, gap->normal);
    return gap->distance <= reach;
}
