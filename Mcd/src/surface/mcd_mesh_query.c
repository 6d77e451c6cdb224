/* The triangles of a surface near a box or its path, and the distance of a convex shape from any part of a model: for
 * queries, which treat each triangle as a convex shape of its own. */
#include "convex/mcd_kind_i.h"
#include "surface/mcd_scratch_i.h"
#include "convex/mcd_vector_i.h"
#include <string.h>

void mcd_meshBounds(McdGeometryInstance *ins, const double origin[3], double low[3], double high[3]) {
    MeVector3 min, max;
    McdGeometryGetAABB(ins->geometry, mcd_const(mcd_instanceTM(ins)), min, max);
    for (int i = 0; i < 3; i++) {
        const double rounding = 16 * (double)ME_EPSILON * (fabs((double)min[i]) + fabs((double)max[i]));
        low[i] = (double)min[i] - origin[i] - rounding;
        high[i] = (double)max[i] - origin[i] + rounding;
        MEASSERT(!(low[i] > high[i]));
    }
}

static MeBool doBoxesOverlap(const double low1[3], const double high1[3], const double low2[3], const double high2[3]) {
    for (int i = 0; i < 3; i++)
        if (low1[i] > high2[i] || low2[i] > high1[i])
            return MEFALSE;
    return METRUE;
}

/* Sets the mesh's frame, and the box in that frame that contains the given box. */
static void setMeshFrame(McdMeshQuery *q, const McdGeometryInstance *ins, const double low[3], const double high[3]) {
    const MeMatrix4Ptr tm = mcd_instanceTM((McdGeometryInstance *)ins);
    double middle[3], sum = 0;
    for (int i = 0; i < 3; i++)
        q->place[i] = (double)tm[3][i] - q->origin[i];
    for (int i = 0; i < 3; i++)
        middle[i] = (low[i] + high[i]) / 2 - q->place[i];
    for (int i = 0; i < 3; i++) {
        double half = 0;
        for (int k = 0; k < 3; k++) {
            q->axis[i][k] = (double)tm[i][k];
            half += fabs(q->axis[i][k]) * (high[k] - low[k]) / 2;
        }
        q->ball[i] = mcd_dot(q->axis[i], middle);
        half += 4 * (double)ME_EPSILON * (half + mcd_length(middle)); /* rounding of the axes */
        q->low[i] = q->ball[i] - half;
        q->high[i] = q->ball[i] + half;
        sum += half * half;
    }
    q->ballRadius = sqrt(sum);
}

/* The triangles near a box, in a scratch. */
typedef struct NearBox {
    McdMeshQuery q;
    McdFramework *frame;
} NearBox;

/* False, after a fatal error: there is no memory. asker: mcd_meshForEachNear. */
static MeBool beginNear(NearBox *n, McdGeometryInstance *ins, McdModelID asker, const double origin[3],
                        const double low[3], const double high[3]) {
    McdStandIn standIn;
    McdModelPair pair;
    McdMeshQuery *q = &n->q;
    n->frame = ins->geometry->frame;
    memset(q, 0, sizeof *q);
    memset(&pair, 0, sizeof pair);
    q->scratch = mcd_scratchAcquire(n->frame, "McdDistance");
    if (!q->scratch)
        return MEFALSE;
    pair.model2 = mcd_standInBegin(&standIn, ins); /* the pair for a triangle list's callback */
    pair.model1 = asker ? asker : pair.model2;
    q->pair = &pair;
    q->mesh = &q->scratch->mesh;
    mcd_copy(q->origin, origin);
    setMeshFrame(q, ins, low, high);
    q->mesh->count = q->mesh->skipped = q->mesh->vertexCount = 0;
    mcd_kindOf(ins->geometry)->gather(q);
    mcd_standInEnd(pair.model2, ins);
    q->pair = 0;
    return METRUE;
}

static void endNear(NearBox *n) {
    mcd_scratchRelease(n->frame, n->q.scratch);
}

void mcd_meshForEachNear(McdGeometryInstance *ins, McdModelID asker, const double origin[3], const double low[3],
                         const double high[3], McdMeshVisit visit, void *context) {
    double boundsLow[3], boundsHigh[3];
    NearBox n;
    mcd_meshBounds(ins, origin, boundsLow, boundsHigh);
    if (!doBoxesOverlap(low, high, boundsLow, boundsHigh) || !beginNear(&n, ins, asker, origin, low, high))
        return;
    MeBool goesOn = METRUE;
    for (int i = 0; i < n.q.mesh->count && goesOn; i++) {
        McdShape shape;
        mcd_triangleShape(mcd_constRows(n.q.mesh->triangle[i].corner), &shape);
        goesOn = visit(context, &n.q.mesh->triangle[i], &shape);
    }
    endNear(&n);
}

/* Sets the interval of the motion in which the box overlaps the mesh's; false if there is none. */
static MeBool clipToMesh(McdGeometryInstance *ins, const double origin[3], const McdMeshPath *path, double *enter,
                         double *leave) {
    double low[3], high[3];
    mcd_meshBounds(ins, origin, low, high);
    *enter = 0;
    *leave = path->last;
    for (int i = 0; i < 3; i++) {
        const double from = low[i] - path->high[i], to = high[i] - path->low[i];
        if (path->by[i] == 0 && (from > 0 || to < 0))
            return MEFALSE;
        if (path->by[i] == 0)
            continue;
        *enter = fmax(*enter, fmin(from / path->by[i], to / path->by[i]));
        *leave = fmin(*leave, fmax(from / path->by[i], to / path->by[i]));
    }
    return *enter <= *leave;
}

/* Visits the triangles near the piece of a path. False, after a fatal error: there is no memory. */
static MeBool visitPiece(McdGeometryInstance *ins, McdModelID asker, const double origin[3], const McdMeshPath *path,
                         McdMeshPathVisit visit, void *context) {
    double low[3], high[3];
    NearBox near;
    for (int i = 0; i < 3; i++) {
        const double from = path->from * path->by[i], to = path->to * path->by[i];
        low[i] = path->low[i] + MeMIN(from, to);
        high[i] = path->high[i] + MeMAX(from, to);
    }
    if (!beginNear(&near, ins, asker, origin, low, high))
        return MEFALSE;
    visit(context, near.q.mesh->triangle, near.q.mesh->count);
    endNear(&near);
    return METRUE;
}

void mcd_meshForEachAlong(McdGeometryInstance *ins, McdModelID asker, const double origin[3], McdMeshPath *path,
                          McdMeshPathVisit visit, void *context) {
    enum { MAX_PIECES = 64 };
    double enter = 0, leave = path->last, size[3];
    mcd_sub(size, path->high, path->low);
    const double longest = MeMAX3(size[0], size[1], size[2]), length = mcd_length(path->by);
    const MeBool isShort = path->mayPass && length * leave < 2 * longest && !mcd_kindOf(ins->geometry)->callsProgram;
    if (!isShort && !clipToMesh(ins, origin, path, &enter, &leave))
        return;
    const int pieces = mcd_floorBetween(length * (leave - enter) / longest, 1, MAX_PIECES);
    for (int n = 0; n < pieces; n++) {
        path->from = enter + (leave - enter) * n / pieces;
        path->to = enter + (leave - enter) * (n + 1) / pieces;
        if (path->from > path->last || !visitPiece(ins, asker, origin, path, visit, context))
            return;
    }
}

/* ---- distances --------------------------------------------------------------------------------------------------- */

typedef struct Nearest {
    const McdShape *shape;
    double low[3], high[3]; /* the shape's box */
    McdGap gap;
} Nearest;

/* The distance between the triangle's box and the shape's box; 0 if they overlap. */
static double gapOfBoxes(const Nearest *n, const McdMeshTriangle *t) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double gap = fmax(0, fmax(mcd_triangleLow(t, i) - n->high[i], n->low[i] - mcd_triangleHigh(t, i)));
        sum += gap * gap;
    }
    return sqrt(sum);
}

static MeBool visitNearest(void *context, const McdMeshTriangle *t, const McdShape *triangle) {
    Nearest *n = context;
    McdGap here;
    if (gapOfBoxes(n, t) > fmax(n->gap.distance, 0))
        return METRUE;
    here.distance = mcd_convexDistance(n->shape, triangle, here.onShape, here.onOther, here.normal);
    if (here.distance < n->gap.distance)
        n->gap = here;
    return METRUE;
}

/* Enlarges the searched box until no nearer point can be outside of it. */
static void searchNearest(Nearest *n, McdGeometryInstance *ins, McdModelID asker, const double origin[3], double max) {
    double boundsLow[3], boundsHigh[3], low[3], high[3];
    double reach = isfinite(max) ? max : n->shape->extent;
    mcd_meshBounds(ins, origin, boundsLow, boundsHigh);
    for (;;) {
        MeBool isAll = METRUE;
        for (int i = 0; i < 3; i++) {
            low[i] = n->low[i] - reach;
            high[i] = n->high[i] + reach;
            isAll = isAll && low[i] <= boundsLow[i] && high[i] >= boundsHigh[i];
        }
        n->gap.distance = INFINITY;
        mcd_meshForEachNear(ins, asker, origin, low, high, visitNearest, n);
        if (n->gap.distance <= reach || reach >= max || isAll)
            return;
        reach = fmin(max, isfinite(n->gap.distance) ? n->gap.distance * 1.0001 : 4 * reach);
    }
}

static void measureSurface(const McdShape *shape, McdGeometryInstance *ins, McdModelID asker, const double origin[3],
                           double reach, McdGap *gap) {
    Nearest n = {.shape = shape};
    mcd_shapeBounds(shape, n.low, n.high);
    searchNearest(&n, ins, asker, origin, reach);
    *gap = n.gap;
    if (!(gap->distance <= reach))
        gap->distance = INFINITY;
    MEASSERT(gap->distance == INFINITY || isfinite(mcd_dot(gap->normal, gap->normal)));
}

MeBool mcd_measureGap(const McdShape *shape, McdGeometryInstance *ins, McdModelID asker, const double origin[3],
                      double reach, McdGap *gap) {
    McdShape other;
    if (!mcd_instanceIsPlaced(ins))
        return MEFALSE;
    if (mcd_isSurface(ins))
        measureSurface(shape, ins, asker, origin, reach, gap);
    else if (mcd_isHalfSpace(ins))
        gap->distance =
            mcd_planeDistance(shape, mcd_const(mcd_instanceTM(ins)), origin, gap->onShape, gap->onOther, gap->normal);
    else if (mcd_shapeOf(ins, origin, &other))
        gap->distance = mcd_convexDistance(shape, &other, gap->onShape, gap->onOther, gap->normal);
    else
        return MEFALSE;
    return METRUE;
}
