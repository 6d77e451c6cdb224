/* Queries of a space besides line segments: overlaps, closest model, shape casts. */
#include "McdQuery.h"
#include "McdInternal.h"
#include "McdGeometry.h"
#include "convex/mcd_cast_i.h"
#include "convex/mcd_kind_i.h"
#include "pair/mcd_pair_i.h"
#include "space/mcd_space_i.h"
#include "convex/mcd_vector_i.h"
#include <string.h>

/* ---- common to all queries --------------------------------------------------------------------------------------- */

typedef struct Query {
    const McdSpace *space;
    McdLineSegIntersectEnableCallback filter;
    void *filterData;
    McdModelID self; /* excluded from the results; null: none */
    const char *function;
    double origin[3];
    McdShape shape; /* the querying shape, relative to the origin */
    double min[3], max[3];
    double reach;     /* m: triangles farther away are ignored */
    McdModelID *list; /* results of overlap queries */
    int count, listSize;
} Query;

/* The gap of one part of a model from the querying shape. */
typedef struct ChildGap {
    McdGeometryInstance *child;
    McdGap gap;
    McdElementData element; /* of a surface: the triangle */
    MeBool isPatch;         /* McdMeshTriangle.isPatch */
} ChildGap;

static Query makeQuery(const McdSpace *space, McdLineSegIntersectEnableCallback filter, void *filterData,
                       const char *function) {
    return (Query){.space = space, .filter = filter, .filterData = filterData, .function = function};
}

static McdModelID modelOf(const Query *q, int proxy) {
    return &q->space->proxy[proxy].model->model;
}

static MeBool passesFilter(const Query *q, McdModelID cm) {
    return cm != q->self && mcd_passesFilter(q->space, cm, q->filter, q->filterData, q->function);
}

/* Sets the querying shape's box: of a shape that the program knows alone, by its function. */
static void setQueryBox(Query *q, McdGeometryID g, const MeMatrix4 tm) {
    if (q->shape.kind->isSampled) {
        MeVector3 low, high;
        McdGeometryGetAABB(g, tm, low, high);
        mcd_fromReal(q->min, low);
        mcd_fromReal(q->max, high);
        return;
    }
    mcd_shapeBounds(&q->shape, q->min, q->max);
    for (int i = 0; i < 3; i++) {
        const double slack = 4 * DBL_EPSILON * (fabs(q->origin[i]) + q->shape.extent);
        q->min[i] += q->origin[i] - slack;
        q->max[i] += q->origin[i] + slack;
    }
}

/* Sets the querying shape to a geometry at a transform; false, with a warning, if it is not convex or the transform
 * not valid. */
static MeBool setQueryShape(Query *q, McdGeometryID g, const MeMatrix4 tm) {
    if (!mcd_geometryType(g, q->function))
        return MEFALSE;
    if (tm)
        mcd_fromReal(q->origin, tm[3]);
    if (tm && mcd_shapeAt(g, tm, q->origin, &q->shape)) {
        setQueryBox(q, g, tm);
        return METRUE;
    }
    if (mcd_isValidTransform(tm))
        MeWarning(1, "%s: the geometry is not convex: %s", q->function, McdGeometryGetTypeName(g));
    else
        MeWarning(1, "%s: the transform is null, not finite, flat, or beyond %g", q->function, (double)FLT_MAX);
    return MEFALSE;
}

/* Iterate over the parts of a model: the leaves of its tree of instances. */
static McdGeometryInstance *firstLeaf(McdGeometryInstance *ins) {
    while (ins->firstChild)
        ins = ins->firstChild;
    return ins;
}

static McdGeometryInstance *nextLeaf(McdGeometryInstance *ins) {
    while (ins && !ins->nextSibling)
        ins = ins->parent;
    return ins && ins->parent ? firstLeaf(ins->nextSibling) : 0;
}

/* Finds the nearest part of a model; false if none supports the query or is within reach. */
static MeBool nearestChild(const Query *q, McdModelID cm, ChildGap *nearest) {
    McdGap gap;
    nearest->gap.distance = INFINITY;
    if (!mcd_modelIsPlaced(mcd_record(cm)))
        return MEFALSE;
    mcd_modelPlaceChildren(mcd_record(cm));
    for (McdGeometryInstance *child = firstLeaf(&mcd_record(cm)->instance); child; child = nextLeaf(child))
        if (mcd_measureGap(&q->shape, child, q->self, q->origin, q->reach, &gap) &&
            gap.distance < nearest->gap.distance)
            *nearest = (ChildGap){.child = child, .gap = gap};
    return nearest->gap.distance < INFINITY;
}

/* ---- searches: models are guarded while filters and callbacks run ----------------------------------------------- */

static void visitOverlapping(const Query *q, const double min[3], const double max[3], McdTreeVisit visit,
                             void *context) {
    MeStageBegin(&q->space->frame->stage, MCD_GUARD_SHAPES);
    mcd_spaceOverlap(q->space, min, max, visit, context);
    MeStageEnd(&q->space->frame->stage, MCD_GUARD_SHAPES);
}

static void toWorld(const Query *q, const double point[3], MeVector3 out) {
    for (int i = 0; i < 3; i++)
        out[i] = mcd_clampReal(point[i] + q->origin[i]);
}

/* ---- filters ----------------------------------------------------------------------------------------------------- */

int MEAPI McdQueryByFilter(McdModelID cm, void *queryFilter) {
    const McdQueryFilter *q = queryFilter;
    const McdModelRecord *m = mcd_modelCheck(cm, "McdQueryByFilter");
    if (m && !q)
        MeWarning(1, "McdQueryByFilter: the filter is null: pass it as the query's filterData");
    if (!m || !q)
        return 0;
    const McdFilter filter = {.category = q->category, .mask = q->mask, .group = q->group};
    return !mcd_areFiltered(&m->filter, &filter);
}

int MEAPI McdQueryByPairs(McdModelID cm, void *model) {
    int isFound = 0;
    if (cm && cm == model)
        return 0;
    ME_UNDER_OWN_NAME(isFound = McdSpacePairIsEnabled(cm, model));
    return isFound;
}

/* ---- overlaps ---------------------------------------------------------------------------------------------------- */

/* Inserts a model into the sorted list, unless it is there already; drops the last one if the list is full. */
static void addToList(Query *q, McdModelID cm) {
    int at = 0;
    while (at < q->count && mcd_modelPrecedes(mcd_record(q->list[at]), mcd_record(cm)))
        at++;
    if (at == q->listSize || (at < q->count && q->list[at] == cm))
        return;
    if (q->count < q->listSize)
        q->count++;
    MEASSERT(at < q->count && q->count <= q->listSize);
    memmove(q->list + at + 1, q->list + at, (size_t)(q->count - at - 1) * sizeof *q->list);
    q->list[at] = cm;
    MEASSERT(at + 1 == q->count || mcd_modelPrecedes(mcd_record(cm), mcd_record(q->list[at + 1])));
}

/* Has the query write its results to the list; false, with a warning, if it cannot run. */
static MeBool setResultList(Query *q, McdSpaceID s, McdModelID *list, int size) {
    q->list = list;
    q->listSize = size;
    if (!mcd_spaceIsReady(s, q->function))
        return MEFALSE;
    if (list && size > 0)
        return METRUE;
    MeWarning(1, "%s: no place for results", q->function);
    return MEFALSE;
}

static MeBool visitBox(void *context, int proxy) {
    Query *q = context;
    const McdProxy *p = &q->space->proxy[proxy];
    for (int i = 0; i < 3; i++)
        if ((double)p->min[i] > q->max[i] || (double)p->max[i] < q->min[i])
            return METRUE;
    if (passesFilter(q, modelOf(q, proxy)))
        addToList(q, modelOf(q, proxy));
    return METRUE;
}

int MEAPI McdSpaceOverlapBox(McdSpaceID space, const MeVector3 minCorner, const MeVector3 maxCorner,
                             McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                             int listSize) {
    Query q = makeQuery(space, filter, filterData, __func__);
    if (!setResultList(&q, space, list, listSize))
        return 0;
    if (!minCorner || !maxCorner || !mcd_areInRange(minCorner, 3) || !mcd_areInRange(maxCorner, 3)) {
        MeWarning(1, "McdSpaceOverlapBox: a corner is null, not finite, or beyond %g", (double)FLT_MAX);
        return 0;
    }
    mcd_fromReal(q.min, minCorner);
    mcd_fromReal(q.max, maxCorner);
    visitOverlapping(&q, q.min, q.max, visitBox, &q);
    return q.count;
}

static MeBool visitOverlap(void *context, int proxy) {
    Query *q = context;
    ChildGap nearest;
    const McdModelID cm = modelOf(q, proxy);
    if (passesFilter(q, cm) && nearestChild(q, cm, &nearest) && nearest.gap.distance <= 0)
        addToList(q, cm);
    return METRUE;
}

int MEAPI McdSpaceOverlapGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm,
                                  McdLineSegIntersectEnableCallback filter, void *filterData, McdModelID *list,
                                  int listSize) {
    Query q = makeQuery(space, filter, filterData, __func__);
    if (!setResultList(&q, space, list, listSize) || !setQueryShape(&q, g, tm))
        return 0;
    visitOverlapping(&q, q.min, q.max, visitOverlap, &q);
    return q.count;
}

int MEAPI McdSpaceOverlapModel(McdSpaceID space, McdModelID cm, McdLineSegIntersectEnableCallback filter,
                               void *filterData, McdModelID *list, int listSize) {
    Query q = makeQuery(space, filter, filterData, __func__);
    McdModelRecord *m = mcd_modelCheck(cm, "McdSpaceOverlapModel");
    q.self = cm;
    if (!m || !setResultList(&q, space, list, listSize))
        return 0;
    McdFramework *frame = m->frame;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    mcd_modelPlaceChildren(m);
    for (McdGeometryInstance *child = firstLeaf(&m->instance); child; child = nextLeaf(child)) {
        if (!setQueryShape(&q, child->geometry, mcd_const(mcd_instanceTM(child))))
            break;
        visitOverlapping(&q, q.min, q.max, visitOverlap, &q);
    }
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    return q.count;
}

/* ---- closest model --------------------------------------------------------------------------- */

typedef struct Closest {
    Query q;
    McdModelID model;
    ChildGap nearest;
} Closest;

static MeBool visitClosest(void *context, int proxy) {
    Closest *c = context;
    ChildGap here;
    const McdModelID cm = modelOf(&c->q, proxy);
    if (!passesFilter(&c->q, cm) || !nearestChild(&c->q, cm, &here))
        return METRUE;
    const double best = c->nearest.gap.distance;
    if (!c->model || here.gap.distance < best ||
        (here.gap.distance == best && mcd_modelPrecedes(mcd_record(cm), mcd_record(c->model)))) {
        c->model = cm;
        c->nearest = here;
    }
    return METRUE;
}

/* Enlarges the searched box until no closer point can be outside of it. */
static void searchClosest(Closest *c, double maxReach) {
    double reach = fmin(c->q.shape.extent, maxReach);
    for (;;) {
        double min[3], max[3];
        for (int i = 0; i < 3; i++) {
            min[i] = c->q.min[i] - reach;
            max[i] = c->q.max[i] + reach;
        }
        c->model = 0;
        c->q.reach = reach;
        visitOverlapping(&c->q, min, max, visitClosest, c);
        if ((c->model && c->nearest.gap.distance <= reach) || reach >= fmin(maxReach, MCD_TREE_REACH))
            return;
        reach = fmin(maxReach, c->model ? c->nearest.gap.distance * 1.0001 : 4 * reach);
    }
}

static void writeClosest(const Closest *c, McdClosestResult *result) {
    MEASSERT(c->nearest.child->model == c->model);
    result->model = c->model;
    result->instance = c->nearest.child;
    result->distance = mcd_clampReal(c->nearest.gap.distance);
    toWorld(&c->q, c->nearest.gap.onShape, result->position1);
    toWorld(&c->q, c->nearest.gap.onOther, result->position2);
    mcd_toReal(result->normal, c->nearest.gap.normal);
}

int MEAPI McdSpaceGetClosest(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm, MeReal maxDistance,
                             McdLineSegIntersectEnableCallback filter, void *filterData, McdClosestResult *result) {
    Closest c = {.q = makeQuery(space, filter, filterData, __func__)};
    if (!mcd_spaceIsReady(space, "McdSpaceGetClosest") || !setQueryShape(&c.q, g, tm))
        return 0;
    if (!(maxDistance >= 0) || !result) {
        MeWarning(1, "McdSpaceGetClosest: maxDistance is %g: it must be >= 0; or there is no result",
                  (double)maxDistance);
        return 0;
    }
    MeStageBegin(&space->frame->stage, MCD_GUARD_MODELS);
    searchClosest(&c, (double)maxDistance);
    const MeBool isFound = c.model && c.nearest.gap.distance <= (double)maxDistance;
    if (isFound)
        writeClosest(&c, result);
    MeStageEnd(&space->frame->stage, MCD_GUARD_MODELS);
    return isFound;
}

/* ---- casts ------------------------------------------------------------------------------------------------------- */

typedef struct Cast {
    Query q;
    double middle[3], half[3]; /* of the shape's box at the start */
    double by[3], fraction;
    McdModelID model;
    ChildGap hit;
} Cast;

/* m: the gap that counts as touching. */
static double touchingGap(const Cast *c) {
    return (sizeof(MeReal) == sizeof(double) ? 1e-7 : 1e-6) * c->q.shape.extent;
}

/* Conservative advancement: an open gap has a separating plane, so the shapes cannot touch before the motion has
 * closed the gap along that plane's normal. other: the part's shape, or one of its triangles; null: the part is a
 * plane. *fraction: from where they may touch, then where they do. Returns false if they do not up to the fraction
 * c->fraction. */
static MeBool advanceToTouch(const Cast *c, const McdShape *other, ChildGap *hit, double *fraction) {
    enum { MAX_ADVANCES = 100 };
    const double enough = touchingGap(c), *origin = c->q.origin;
    McdShape moved = c->q.shape;
    McdGap *gap = &hit->gap;
    double t = *fraction;
    for (int i = 0; i < MAX_ADVANCES; i++) {
        mcd_mad(moved.place, c->q.shape.place, t, c->by);
        gap->distance = other ? mcd_convexDistance(&moved, other, gap->onShape, gap->onOther, gap->normal)
                              : mcd_planeDistance(&moved, mcd_const(mcd_instanceTM(hit->child)), origin, gap->onShape,
                                                  gap->onOther, gap->normal);
        const double closing = -mcd_dot(gap->normal, c->by);
        if (gap->distance < -enough || (gap->distance <= enough && closing > 0))
            break;
        if (closing <= 0 || t + gap->distance / closing > c->fraction)
            return MEFALSE;
        t += gap->distance / closing;
    }
    MEASSERT(t >= 0 && t <= c->fraction);
    *fraction = t;
    return METRUE;
}

static void keepFirstHit(Cast *c, McdModelID cm, const ChildGap *hit, double t) {
    MEASSERT(t >= 0 && t <= c->fraction);
    const MeBool isFirst =
        !c->model || t < c->fraction || (cm != c->model && mcd_modelPrecedes(mcd_record(cm), mcd_record(c->model)));
    if (!isFirst)
        return;
    c->model = cm;
    c->hit = *hit;
    c->fraction = t;
}

static void castOntoShape(Cast *c, McdModelID cm, McdGeometryInstance *child, const McdShape *other) {
    ChildGap hit = {.child = child};
    double t = 0;
    if (advanceToTouch(c, other, &hit, &t))
        keepFirstHit(c, cm, &hit, t);
}

/* ---- casts onto triangles */

typedef struct MeshCast {
    Cast *cast;
    McdMeshPath *path;
    McdModelID model;
    McdGeometryInstance *child;
    MeBool servesBorder; /* mcd_castServesBorder */
} MeshCast;

static MeBool isFromBehind(const Cast *c, const McdMeshTriangle *t) {
    return !(t->flags & kMcdTriangleTwoSided) && mcd_dot(t->normal, c->by) > 0;
}

static McdTriangleCast triangleCast(const Cast *c, const McdMeshTriangle *t) {
    return (McdTriangleCast){&c->q.shape, t->corner, t->normal, c->by, c->fraction};
}

/* Where the point that first reaches the triangle's plane does so within the triangle, that is the hit. Sets the
 * triangle's reach; INFINITY: it is this hit, or none. */
static void castOntoFace(const MeshCast *m, McdMeshTriangle *t) {
    const McdTriangleCast cast = triangleCast(m->cast, t);
    double point[3], normal[3];
    t->reach = mcd_castToPlane(&cast, point, normal);
    if (!(t->reach > 0 && t->reach <= m->cast->fraction) || !mcd_castIsOver(&cast, point))
        return;
    if (!isFromBehind(m->cast, t)) {
        ChildGap hit = {.child = m->child, .element = t->element, .isPatch = t->isPatch};
        mcd_copy(hit.gap.onShape, point);
        mcd_copy(hit.gap.onOther, point);
        mcd_copy(hit.gap.normal, normal);
        keepFirstHit(m->cast, m->model, &hit, t->reach);
        m->path->last = m->cast->fraction;
    }
    t->reach = INFINITY;
}

/* Whether the box around the shape touches that around the triangle on its way to the first hit. */
static MeBool doBoxesTouch(const McdMeshPath *path, const McdMeshTriangle *t) {
    double enter = 0, leave = path->last;
    for (int i = 0; i < 3; i++) {
        const double from = mcd_triangleLow(t, i) - path->high[i], to = mcd_triangleHigh(t, i) - path->low[i];
        if (path->by[i] == 0 && (from > 0 || to < 0))
            return MEFALSE;
        if (path->by[i] == 0)
            continue;
        const double one = from / path->by[i], two = to / path->by[i];
        enter = MeMAX(enter, MeMIN(one, two));
        leave = MeMIN(leave, MeMAX(one, two));
    }
    return enter <= leave;
}

/* Whether a triangle is behind the plane of the first hit so far, which the shape does not cross before that. Not of
 * the hit of another model: of hits at one fraction the models' order decides. */
static MeBool isBehindHit(const MeshCast *m, const McdMeshTriangle *t) {
    const Cast *c = m->cast;
    const double slack = touchingGap(c) / 100; /* m: neighbours have corners in the plane, up to rounding */
    MeBool isBehind = c->model == m->model;
    for (int i = 0; i < 3 && isBehind; i++)
        isBehind = mcd_heightOver(t->corner[i], c->hit.gap.onOther, c->hit.gap.normal) <= slack;
    return isBehind;
}

/* A fraction before which a triangle that is no hit of castOntoFace is not touched; INFINITY: it is none at all. */
static double boundOf(const MeshCast *m, const McdMeshTriangle *t) {
    double point[3], normal[3], bound = t->reach;
    if (bound > m->cast->fraction || isBehindHit(m, t) || !doBoxesTouch(m->path, t))
        return INFINITY;
    if (!(bound > 0 && m->servesBorder)) {
        const McdTriangleCast cast = triangleCast(m->cast, t);
        bound = mcd_castBound(&cast, mcd_castToPlane(&cast, point, normal), point);
    }
    return bound > 0 && isFromBehind(m->cast, t) ? INFINITY : bound;
}

/* Finds where the shape touches a triangle that is no hit of castOntoFace, from a fraction on before which it does not;
 * false: it does not. */
static MeBool findTouch(const MeshCast *m, const McdMeshTriangle *t, ChildGap *hit, double *fraction) {
    McdShape shape;
    if (*fraction > 0 && m->servesBorder) {
        const McdTriangleCast cast = triangleCast(m->cast, t);
        *fraction = mcd_castToBorder(&cast, hit->gap.onShape, hit->gap.normal);
        mcd_copy(hit->gap.onOther, hit->gap.onShape);
        return *fraction <= m->cast->fraction;
    }
    mcd_triangleShape(t->corner, &shape);
    return advanceToTouch(m->cast, &shape, hit, fraction);
}

/* The hits of all other triangles. */
static void castOntoTriangle(const MeshCast *m, const McdMeshTriangle *t) {
    Cast *c = m->cast;
    double fraction = boundOf(m, t);
    if (fraction > c->fraction)
        return;
    ChildGap hit = {.child = m->child, .element = t->element, .isPatch = t->isPatch};
    if (!findTouch(m, t, &hit, &fraction))
        return;
    if (!isFromBehind(c, t) || (fraction == 0 && hit.gap.distance < -touchingGap(c)))
        keepFirstHit(c, m->model, &hit, fraction);
    m->path->last = c->fraction;
}

static void castOntoTriangles(void *context, McdMeshTriangle t[], int count) {
    const MeshCast *m = context;
    for (int i = 0; i < count; i++)
        castOntoFace(m, &t[i]);
    for (int i = 0; i < count; i++)
        castOntoTriangle(m, &t[i]);
}

static void castMesh(Cast *c, McdModelID cm, McdGeometryInstance *child) {
    McdMeshPath path = {.last = c->fraction, .mayPass = METRUE};
    MeshCast m = {c, &path, cm, child, mcd_castServesBorder(&c->q.shape)};
    for (int i = 0; i < 3; i++) {
        path.low[i] = c->q.min[i] - c->q.origin[i] - touchingGap(c);
        path.high[i] = c->q.max[i] - c->q.origin[i] + touchingGap(c);
        path.by[i] = c->by[i];
    }
    mcd_meshForEachAlong(child, c->q.self, c->q.origin, &path, castOntoTriangles, &m);
}

/* ---- casts onto models */

static void castOntoChild(Cast *c, McdModelID cm, McdGeometryInstance *child) {
    McdShape other;
    if (mcd_isSurface(child))
        castMesh(c, cm, child);
    else if (mcd_isHalfSpace(child))
        castOntoShape(c, cm, child, 0);
    else if (mcd_shapeOf(child, c->q.origin, &other))
        castOntoShape(c, cm, child, &other);
}

/* Casts several shapes onto a model. */
static void castOntoModel(Cast *const c[], int count, McdModelID cm) {
    if (count == 0 || !mcd_modelIsPlaced(mcd_record(cm)))
        return;
    mcd_modelPlaceChildren(mcd_record(cm));
    for (McdGeometryInstance *child = firstLeaf(&mcd_record(cm)->instance); child; child = nextLeaf(child)) {
        if (!mcd_instanceIsPlaced(child))
            continue;
        for (int i = 0; i < count; i++)
            castOntoChild(c[i], cm, child);
    }
}

static double visitCast(void *context, int proxy, double last) {
    Cast *c = context;
    const McdModelID cm = modelOf(&c->q, proxy);
    if (!passesFilter(&c->q, cm))
        return last;
    castOntoModel(&c, 1, cm);
    return c->fraction;
}

static MeBool checkCast(McdSpaceID s, const MeReal *by, const McdCastResult *result, const char *function) {
    if (!mcd_spaceIsReady(s, function))
        return MEFALSE;
    if (by && mcd_areInRange(by, 3) && result)
        return METRUE;
    MeWarning(1, "%s: the displacement is null, not finite, or beyond %g, or there is no result", function,
              (double)FLT_MAX);
    return MEFALSE;
}

/* The element that is hit. Where one triangle stands for a flat patch, it is the one at the contact. */
static McdElementData elementOf(const Cast *c) {
    const McdGeometry *g = c->hit.child->geometry;
    double slack[3], place[3], offset[3];
    if (!c->hit.isPatch)
        return c->hit.element;
    const MeVector4 *tm = mcd_const(mcd_instanceTM(c->hit.child));
    for (int i = 0; i < 3; i++)
        offset[i] = c->q.origin[i] + c->hit.gap.onOther[i] - (double)tm[3][i];
    for (int i = 0; i < 3; i++) {
        place[i] = offset[0] * (double)tm[i][0] + offset[1] * (double)tm[i][1] + offset[2] * (double)tm[i][2];
        slack[i] = touchingGap(c);
    }
    return mcd_kindOf(g)->elementAt(g, place, slack, c->hit.element);
}

static void writeCast(const Cast *c, McdCastResult *result) {
    MEASSERT(c->hit.child->model == c->model && c->fraction >= 0 && c->fraction <= 1);
    result->model = c->model;
    result->instance = c->hit.child;
    result->element = elementOf(c);
    result->hasElement = mcd_isSurface(c->hit.child);
    result->material = mcd_elementMaterial(c->hit.child, result->element);
    result->fraction = (MeReal)c->fraction;
    toWorld(&c->q, c->hit.gap.onOther, result->position);
    mcd_toReal(result->normal, c->hit.gap.normal);
}

/* False, with a warning that names the query's function: the shape cannot be cast. */
static MeBool beginCast(Cast *c, McdGeometryID g, const MeMatrix4 tm, const MeVector3 by) {
    c->fraction = 1;
    if (!setQueryShape(&c->q, g, tm))
        return MEFALSE;
    mcd_fromReal(c->by, by);
    for (int i = 0; i < 3; i++) {
        c->middle[i] = (c->q.min[i] + c->q.max[i]) / 2;
        c->half[i] = (c->q.max[i] - c->q.min[i]) / 2 * (1 + 8 * (double)ME_EPSILON);
    }
    return METRUE;
}

/* Casts onto each model on the way, nearer ones first. */
static void castOntoAll(Cast *c) {
    mcd_spaceCast(c->q.space, c->middle, c->by, c->half, 1, visitCast, c);
}

int MEAPI McdSpaceCastGeometry(McdSpaceID space, McdGeometryID g, const MeMatrix4 tm, const MeVector3 displacement,
                               McdLineSegIntersectEnableCallback filter, void *filterData, McdCastResult *result) {
    Cast c = {.q = makeQuery(space, filter, filterData, __func__)};
    if (!checkCast(space, displacement, result, "McdSpaceCastGeometry") || !beginCast(&c, g, tm, displacement))
        return 0;
    MeStageBegin(&space->frame->stage, MCD_GUARD_SHAPES);
    castOntoAll(&c);
    if (c.model)
        writeCast(&c, result);
    MeStageEnd(&space->frame->stage, MCD_GUARD_SHAPES);
    return c.model != 0;
}

static void writeRay(const McdLineSegIntersectResult *hit, MeReal length, McdCastResult *result) {
    result->model = hit->model;
    result->instance = hit->instance;
    result->element = hit->element;
    result->hasElement = mcd_isSurface(hit->instance);
    result->material = mcd_elementMaterial(hit->instance, hit->element);
    result->fraction = length > 0 ? MeMIN(hit->distance / length, 1) : 0;
    MeVector3Copy(result->position, hit->position);
    MeVector3Copy(result->normal, hit->normal);
}

int MEAPI McdSpaceCastRay(McdSpaceID space, const MeVector3 from, const MeVector3 displacement,
                          McdLineSegIntersectEnableCallback filter, void *filterData, McdCastResult *result) {
    McdLineSegIntersectResult hit;
    MeVector3 start, end;
    if (!checkCast(space, displacement, result, "McdSpaceCastRay"))
        return 0;
    if (!from || !mcd_areInRange(from, 3)) {
        MeWarning(1, "McdSpaceCastRay: the start is null, not finite, or beyond %g", (double)FLT_MAX);
        return 0;
    }
    MeVector3Copy(start, from);
    MeVector3Add(end, start, displacement);
    MeStageBegin(&space->frame->stage, MCD_GUARD_MODELS);
    const MeBool isHit = mcd_segmentFirstHit(space, start, end, filter, filterData, &hit, "McdSpaceCastRay") != 0;
    if (isHit)
        writeRay(&hit, MeVector3Magnitude(displacement), result);
    MeStageEnd(&space->frame->stage, MCD_GUARD_MODELS);
    return isHit;
}

/* ---- rays and shapes side by side ------------------------------------------------------------------------------- */

enum { NEAR_MODELS = 16 }; /* if more models than these are near, each ray or shape searches the space */

/* The models near several casts, which pass the filter. */
typedef struct NearCasts {
    Query q;
    int proxy[NEAR_MODELS], count;
    MeBool isFull;
} NearCasts;

static MeBool visitNearCasts(void *context, int proxy) {
    NearCasts *n = context;
    if (!passesFilter(&n->q, modelOf(&n->q, proxy)))
        return METRUE;
    n->isFull = n->count == NEAR_MODELS;
    if (!n->isFull)
        n->proxy[n->count++] = proxy;
    return !n->isFull;
}

static NearCasts makeNear(McdSpaceID space, McdLineSegIntersectEnableCallback filter, void *filterData,
                          const char *function) {
    NearCasts n = {.q = makeQuery(space, filter, filterData, function)};
    for (int i = 0; i < 3; i++) {
        n.q.min[i] = INFINITY;
        n.q.max[i] = -INFINITY;
    }
    return n;
}

/* Extends the box in which models are near by that from middle - half to middle + half as it moves. */
static void addPath(NearCasts *n, const double middle[3], const double half[3], const double by[3]) {
    for (int i = 0; i < 3; i++) {
        n->q.min[i] = fmin(n->q.min[i], middle[i] - half[i] + fmin(by[i], 0));
        n->q.max[i] = fmax(n->q.max[i], middle[i] + half[i] + fmax(by[i], 0));
    }
}

static void findNear(NearCasts *n) {
    visitOverlapping(&n->q, n->q.min, n->q.max, visitNearCasts, n);
}

/* ---- rays */

/* Up to MCD_SEGMENTS of the rays, and the first hit of each; of a ray without one, `model` is null. */
typedef struct RayGroup {
    McdSegment segment[MCD_SEGMENTS];
    double from[MCD_SEGMENTS][3], by[MCD_SEGMENTS][3];
    McdLineSegIntersectResult first[MCD_SEGMENTS];
    int count;
} RayGroup;

static void beginGroup(RayGroup *g, const McdRay rays[], int count) {
    g->count = MeMIN(count, (int)MCD_SEGMENTS);
    for (int i = 0; i < g->count; i++) {
        McdSegment *s = &g->segment[i];
        MeVector3Copy(s->from, rays[i].from);
        MeVector3Add(s->to, s->from, rays[i].by);
        mcd_fromReal(g->from[i], s->from);
        mcd_fromReal(g->by[i], s->to);
        mcd_sub(g->by[i], g->by[i], g->from[i]);
        g->first[i].model = 0;
    }
}

static void castRaysOntoModel(const NearCasts *n, RayGroup *g, int proxy) {
    static const double still[3] = {0, 0, 0};
    const McdModelID cm = modelOf(&n->q, proxy);
    McdSegment segment[MCD_SEGMENTS];
    McdLineSegIntersectResult hit[MCD_SEGMENTS];
    int number[MCD_SEGMENTS], count = 0;
    for (int i = 0; i < g->count && !mcd_record(cm)->isGone; i++)
        if (mcd_treeCastBox(&n->q.space->proxy[proxy].fat, g->from[i], g->by[i], still, 1)) {
            segment[count] = g->segment[i];
            number[count++] = i;
        }
    const MeU32 hits = mcd_lineSegsIntersect(cm, segment, count, hit);
    for (int k = 0; k < count; k++) {
        McdLineSegIntersectResult *first = &g->first[number[k]];
        if (hits >> k & 1 && (!first->model || mcd_isHitNearer(&hit[k], first)))
            *first = hit[k];
    }
}

/* Casts rays onto these models, with the answers of McdSpaceCastRay. */
static void castRaysOntoList(const NearCasts *n, const McdRay rays[], int count, McdCastResult results[]) {
    for (int from = 0; from < count; from += MCD_SEGMENTS) {
        RayGroup g;
        beginGroup(&g, rays + from, count - from);
        for (int i = 0; i < n->count; i++)
            castRaysOntoModel(n, &g, n->proxy[i]);
        for (int i = 0; i < g.count; i++)
            if (g.first[i].model)
                writeRay(&g.first[i], MeVector3Magnitude(rays[from + i].by), &results[from + i]);
    }
}

static MeBool areRays(const McdRay rays[], int count) {
    for (int i = 0; i < count; i++)
        if (!mcd_areInRange(rays[i].from, 3) || !mcd_areInRange(rays[i].by, 3))
            return MEFALSE;
    return METRUE;
}

void MEAPI McdSpaceCastRays(McdSpaceID space, const McdRay rays[], int count, McdLineSegIntersectEnableCallback filter,
                            void *filterData, McdCastResult results[]) {
    static const double point[3] = {0, 0, 0};
    NearCasts n = makeNear(space, filter, filterData, "McdSpaceCastRay");
    for (int i = 0; i < count; i++)
        results[i].model = 0;
    if (!mcd_spaceIsReady(space, n.q.function) || !areRays(rays, count))
        return;
    MeStageBegin(&space->frame->stage, MCD_GUARD_MODELS);
    for (int i = 0; i < count; i++) {
        double from[3], by[3];
        mcd_fromReal(from, rays[i].from);
        mcd_fromReal(by, rays[i].by);
        addPath(&n, from, point, by);
    }
    findNear(&n);
    if (!n.isFull)
        castRaysOntoList(&n, rays, count, results);
    for (int i = 0; i < count && n.isFull; i++)
        McdSpaceCastRay(space, rays[i].from, rays[i].by, filter, filterData, &results[i]);
    MeStageEnd(&space->frame->stage, MCD_GUARD_MODELS);
}

/* ---- shapes */

/* Up to MCD_SEGMENTS shapes, and the numbers of their results. */
typedef struct CastGroup {
    Cast cast[MCD_SEGMENTS];
    int number[MCD_SEGMENTS], count;
} CastGroup;

/* Begins the next shapes that can be cast, from `from` on. Returns where the following ones begin. */
static int beginCasts(CastGroup *g, const NearCasts *n, const McdShapeCast casts[], int from, int count) {
    int i = from;
    for (g->count = 0; i < count && g->count < MCD_SEGMENTS; i++) {
        Cast *c = &g->cast[g->count];
        *c = (Cast){.q = makeQuery(n->q.space, n->q.filter, n->q.filterData, n->q.function)};
        g->number[g->count] = i;
        g->count += mcd_areInRange(casts[i].by, 3) && beginCast(c, casts[i].geometry, casts[i].tm, casts[i].by);
    }
    return i;
}

static void castGroupOntoModel(CastGroup *g, const NearCasts *n, int proxy) {
    const McdModelID cm = modelOf(&n->q, proxy);
    Cast *cast[MCD_SEGMENTS];
    int count = 0;
    for (int i = 0; i < g->count && !mcd_record(cm)->isGone; i++) {
        Cast *c = &g->cast[i];
        if (mcd_treeCastBox(&n->q.space->proxy[proxy].fat, c->middle, c->by, c->half, c->fraction))
            cast[count++] = c;
    }
    castOntoModel(cast, count, cm);
}

static void castGroup(CastGroup *g, NearCasts *n, McdCastResult results[]) {
    n->count = 0;
    for (int i = 0; i < g->count; i++)
        addPath(n, g->cast[i].middle, g->cast[i].half, g->cast[i].by);
    findNear(n);
    for (int i = 0; i < n->count && !n->isFull; i++)
        castGroupOntoModel(g, n, n->proxy[i]);
    for (int i = 0; i < g->count; i++) {
        if (n->isFull)
            castOntoAll(&g->cast[i]);
        if (g->cast[i].model)
            writeCast(&g->cast[i], &results[g->number[i]]);
    }
}

void MEAPI McdSpaceCastGeometries(McdSpaceID space, const McdShapeCast casts[], int count,
                                  McdLineSegIntersectEnableCallback filter, void *filterData, McdCastResult results[]) {
    for (int i = 0; i < count; i++)
        results[i].model = 0;
    if (!mcd_spaceIsReady(space, "McdSpaceCastGeometry"))
        return;
    MeStageBegin(&space->frame->stage, MCD_GUARD_SHAPES);
    for (int i = 0; i < count;) {
        CastGroup g;
        NearCasts n = makeNear(space, filter, filterData, "McdSpaceCastGeometry");
        i = beginCasts(&g, &n, casts, i, count);
        castGroup(&g, &n, results);
    }
    MeStageEnd(&space->frame->stage, MCD_GUARD_SHAPES);
}
