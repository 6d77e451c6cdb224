/* Height fields: triangles over a regular grid. */
#include "McdRGHeightField.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"
#include "convex/mcd_vector_i.h"
#include <math.h>

static McdRGHeightField *fieldOf(McdGeometryID g, const char *function) {
    return mcd_geometryIs(g, kMcdGeometryTypeRGHeightField, function) ? (McdRGHeightField *)g : 0;
}

/* ---- creation -------------------------------------------------------------------------------- */

static void findExtremes(McdRGHeightField *f) {
    MeBool any = MEFALSE;
    f->low = f->high = 0;
    for (int i = 0; i < f->xCount * f->yCount; i++) {
        const MeReal z = f->height[i];
        if (!MeRealIsValid(z))
            continue;
        f->low = any ? MeMIN(f->low, z) : z;
        f->high = any ? MeMAX(f->high, z) : z;
        any = METRUE;
    }
    MEASSERT(f->low <= f->high);
}

static MeBool isGridValid(int xCount, int yCount, MeReal xStep, MeReal yStep, MeReal x0, MeReal y0) {
    const MeReal reach[4] = {xStep * (MeReal)xCount, yStep * (MeReal)yCount, x0, y0};
    return xCount >= 2 && yCount >= 2 && xCount <= 1000000000 / yCount && xStep > 0 && yStep > 0 &&
           mcd_areInRange(reach, 4);
}

McdRGHeightFieldID MEAPI McdRGHeightFieldCreate(McdFramework *frame, const MeReal *heights, int xCount, int yCount,
                                                MeReal xStep, MeReal yStep, MeReal x0, MeReal y0) {
    if (!heights || !isGridValid(xCount, yCount, xStep, yStep, x0, y0)) {
        MeWarning(1, "McdRGHeightFieldCreate: heights at %p, %d x %d points (> 1), steps %g, %g (> 0), from (%g, %g)",
                  (const void *)heights, xCount, yCount, (double)xStep, (double)yStep, (double)x0, (double)y0);
        return 0;
    }
    McdRGHeightField *f = mcd_geometryCreate(frame, kMcdGeometryTypeRGHeightField, sizeof *f, "McdRGHeightFieldCreate");
    if (!f)
        return 0;
    f->height = heights;
    f->xCount = xCount;
    f->yCount = yCount;
    f->xStep = xStep;
    f->yStep = yStep;
    f->x0 = x0;
    f->y0 = y0;
    findExtremes(f);
    return &f->head;
}

/* ---- accessors ------------------------------------------------------------------------------- */

const MeReal *MEAPI McdRGHeightFieldGetHeights(McdRGHeightFieldID g) {
    const McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldGetHeights");
    return f ? f->height : 0;
}

void MEAPI McdRGHeightFieldSetHeights(McdRGHeightFieldID g, const MeReal *heights) {
    McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldSetHeights");
    if (!f)
        return;
    if (!heights) {
        MeWarning(1, "McdRGHeightFieldSetHeights: heights is null");
        return;
    }
    f->height = heights;
    McdGeometryUpdate(g);
}

void MEAPI McdRGHeightFieldUpdateHeights(McdRGHeightFieldID g) {
    if (fieldOf(g, "McdRGHeightFieldUpdateHeights"))
        McdGeometryUpdate(g);
}

void MEAPI McdRGHeightFieldGetCounts(McdRGHeightFieldID g, int *xCount, int *yCount) {
    if (!mcd_areGiven(__func__, xCount, yCount, yCount))
        return;
    const McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldGetCounts");
    *xCount = f ? f->xCount : 0;
    *yCount = f ? f->yCount : 0;
}

void MEAPI McdRGHeightFieldGetSteps(McdRGHeightFieldID g, MeReal *xStep, MeReal *yStep) {
    if (!mcd_areGiven(__func__, xStep, yStep, yStep))
        return;
    const McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldGetSteps");
    *xStep = f ? f->xStep : 0;
    *yStep = f ? f->yStep : 0;
}

void MEAPI McdRGHeightFieldGetOrigin(McdRGHeightFieldID g, MeReal *x0, MeReal *y0) {
    if (!mcd_areGiven(__func__, x0, y0, y0))
        return;
    const McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldGetOrigin");
    *x0 = f ? f->x0 : 0;
    *y0 = f ? f->y0 : 0;
}

/* ---- cells ------------------------------------------------------------------------------------------------------- */

static void pointOf(const McdRGHeightField *f, int i, int j, double point[3]) {
    point[0] = (double)f->x0 + i * (double)f->xStep;
    point[1] = (double)f->y0 + j * (double)f->yStep;
    point[2] = (double)f->height[(size_t)j * (size_t)f->xCount + (size_t)i];
}

/* The corners of a cell's triangle, counter-clockwise from above. half 0 is on the side of (i + 1, j), half 1 on
 * that of (i, j + 1). */
static void triangleOf(const McdRGHeightField *f, int i, int j, int half, double corner[3][3]) {
    MEASSERT(i >= 0 && j >= 0 && i < f->xCount - 1 && j < f->yCount - 1);
    pointOf(f, i, j, corner[0]);
    pointOf(f, i + 1, j + half, corner[1]);
    pointOf(f, i + 1 - half, j + 1, corner[2]);
}

static McdElementData elementOf(const McdRGHeightField *f, int i, int j, int half) {
    McdElementData element = {0};
    element.tag = 2 * (j * (f->xCount - 1) + i) + half;
    return element;
}

/* The index of the cell that contains a coordinate, clamped to the grid. */
static int cellAt(double x, double x0, double step, int points) {
    return mcd_floorBetween((x - x0) / step, 0, points - 2);
}

MeBool MEAPI McdRGHeightFieldGetHeightAt(McdRGHeightFieldID g, MeReal x, MeReal y, MeReal *height, MeVector3 normal) {
    const McdRGHeightField *f = fieldOf(g, "McdRGHeightFieldGetHeightAt");
    if (!f || !MeRealIsValid(x) || !MeRealIsValid(y))
        return MEFALSE;
    const double u = ((double)x - (double)f->x0) / (double)f->xStep, v = ((double)y - (double)f->y0) / (double)f->yStep;
    if (u < 0 || v < 0 || u > f->xCount - 1 || v > f->yCount - 1)
        return MEFALSE;
    const int i = cellAt(u, 0, 1, f->xCount), j = cellAt(v, 0, 1, f->yCount);
    double corner[3][3], n[3];
    triangleOf(f, i, j, v - j > u - i, corner);
    if (!mcd_triangleNormal(mcd_constRows(corner), 0, n))
        return MEFALSE;
    *height = (MeReal)(corner[0][2] - (n[0] * ((double)x - corner[0][0]) + n[1] * ((double)y - corner[0][1])) / n[2]);
    if (normal)
        mcd_toReal(normal, n);
    return METRUE;
}

/* ---- the type's functions ---------------------------------------------------------------------------------------- */

static void boxOf(const McdRGHeightField *f, MeVector3 min, MeVector3 max) {
    MeVector3Set(min, f->x0, f->y0, f->low);
    MeVector3Set(max, f->x0 + (MeReal)(f->xCount - 1) * f->xStep, f->y0 + (MeReal)(f->yCount - 1) * f->yStep, f->high);
}

static void support(const McdGeometry *g, const double direction[3], double point[3]) {
    MeVector3 min, max;
    boxOf((const McdRGHeightField *)g, min, max);
    mcd_boxSupport(min, max, direction, point);
}

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    MeVector3 min, max;
    boxOf((const McdRGHeightField *)g, min, max);
    return mcd_boxBSphere(min, max, center);
}

/* Draws the line between two grid points that have heights. */
static void drawEdge(const McdRGHeightField *f, const MeMatrix4 tm, int i, int j, int i2, int j2,
                     const MeReal colour[3]) {
    double from[3], to[3];
    pointOf(f, i, j, from);
    pointOf(f, i2, j2, to);
    if (isfinite(from[2]) && isfinite(to[2]))
        mcd_drawLine(tm, colour, from, to);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const McdRGHeightField *f = (const McdRGHeightField *)g;
    for (int j = 0; j < f->yCount; j++)
        for (int i = 0; i < f->xCount; i++) {
            if (i + 1 < f->xCount)
                drawEdge(f, tm, i, j, i + 1, j, colour);
            if (j + 1 < f->yCount)
                drawEdge(f, tm, i, j, i, j + 1, colour);
        }
}

/* ---- interactions ------------------------------------------------------------------------------------------------ */

/* Adds both triangles of a cell. Corners are numbered within the part of the grid that begins at (i0, j0) and is
 * `width` points wide. */
static void addCell(McdMeshQuery *q, const McdRGHeightField *f, int i, int j, int i0, int j0, int width) {
    for (int half = 0; half < 2; half++) {
        const int at = (j - j0) * width + i - i0, vertex[3] = {at, at + 1 + half * width, at + 1 - half + width};
        double corner[3][3];
        triangleOf(f, i, j, half, corner);
        if (isfinite(corner[0][2] + corner[1][2] + corner[2][2]))
            mcd_meshAdd(q, mcd_constRows(corner), 0, kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges, vertex,
                        elementOf(f, i, j, half));
    }
}

/* A range of cells, both ends included. */
typedef struct Cells {
    int i0, i1, j0, j1;
} Cells;

/* The cells that the query's box overlaps or touches at corners: the triangles of the latter are needed as
 * neighbours. */
static Cells cellsNear(const McdMeshQuery *q, const McdRGHeightField *f) {
    const double x0 = (double)f->x0, y0 = (double)f->y0, dx = (double)f->xStep, dy = (double)f->yStep;
    return (Cells){.i0 = cellAt(q->low[0] - 1e-6 * dx, x0, dx, f->xCount),
                   .i1 = cellAt(q->high[0] + 1e-6 * dx, x0, dx, f->xCount),
                   .j0 = cellAt(q->low[1] - 1e-6 * dy, y0, dy, f->yCount),
                   .j1 = cellAt(q->high[1] + 1e-6 * dy, y0, dy, f->yCount)};
}

static void gather(McdMeshQuery *q) {
    const McdRGHeightField *f = (const McdRGHeightField *)mcd_record(q->pair->model2)->instance.geometry;
    const Cells near = cellsNear(q, f);
    const int width = near.i1 - near.i0 + 2, vertexCount = width * (near.j1 - near.j0 + 2);
    if (!mcd_meshReserve(q->mesh, (vertexCount + 2) / 3)) /* room for 3 corners per triangle */
        return;
    q->mesh->vertexCount = vertexCount;
    for (int j = near.j0; j <= near.j1; j++)
        for (int i = near.i0; i <= near.i1; i++)
            addCell(q, f, i, j, near.i0, near.j0, width);
}

static void update(McdGeometry *g) {
    McdRGHeightField *f = (McdRGHeightField *)g;
    f->version++;
    findExtremes(f);
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(RGHeightField, mcd_geometryFree), .size = sizeof(McdRGHeightField),
                             .gather = gather, .update = update, .isStatic = METRUE};
MCD_DEFINE_GEOMETRY_TYPE(RGHeightField, mcd_addNoMass)

MCD_MESH_INTERACTIONS(RGHeightField)

/* ---- line segments ----------------------------------------------------------------------------------------------- */

/* Intersects the segment with both triangles of a cell: *fraction, normal and *element become those of a
 * hit that is nearer. */
static void intersectCell(const McdRGHeightField *f, int i, int j, const double from[3], const double to[3],
                          double *fraction, double normal[3], McdElementData *element) {
    for (int half = 0; half < 2; half++) {
        double corner[3][3], own[3], here, hit[3];
        triangleOf(f, i, j, half, corner);
        if (!mcd_triangleNormal(mcd_constRows(corner), 0, own) ||
            !mcd_segmentTriangle(mcd_constRows(corner), own, MEFALSE, from, to, &here, hit) || here >= *fraction)
            continue;
        *fraction = here;
        *element = elementOf(f, i, j, half);
        mcd_copy(normal, hit);
    }
}

/* Clips the segment to the grid's rectangle: the interval [*enter, *leave] within 0 .. 1; false if there is none. */
static MeBool clipToGrid(const McdRGHeightField *f, const double from[3], const double to[3], double *enter,
                         double *leave) {
    const double low[2] = {(double)f->x0, (double)f->y0};
    const double high[2] = {low[0] + (f->xCount - 1) * (double)f->xStep, low[1] + (f->yCount - 1) * (double)f->yStep};
    *enter = 0;
    *leave = 1;
    for (int k = 0; k < 2; k++) {
        const double along = to[k] - from[k];
        if (along == 0) {
            if (from[k] < low[k] || from[k] > high[k])
                return MEFALSE;
            continue;
        }
        const double a = (low[k] - from[k]) / along, b = (high[k] - from[k]) / along;
        *enter = fmax(*enter, fmin(a, b));
        *leave = fmin(*leave, fmax(a, b));
    }
    return *enter <= *leave;
}

/* The fraction of the segment at which it leaves cell c along one axis. */
static double exitFraction(double x, double along, double x0, double step, int c) {
    return along == 0 ? INFINITY : (x0 + (c + (along > 0)) * step - x) / along;
}

/* Traverses the cells along the segment, testing the neighbouring cells as well: rounding must not let a segment
 * along a grid line slip between two cells. */
static MeBool traverseCells(const McdRGHeightField *f, const double from[3], const double to[3], double *fraction,
                            double normal[3], McdElementData *element) {
    const double origin[2] = {(double)f->x0, (double)f->y0}, step[2] = {(double)f->xStep, (double)f->yStep};
    const int points[2] = {f->xCount, f->yCount};
    double enter, leave;
    int cell[2];
    *fraction = INFINITY;
    if (!clipToGrid(f, from, to, &enter, &leave))
        return MEFALSE;
    for (int k = 0; k < 2; k++)
        cell[k] = cellAt(from[k] + enter * (to[k] - from[k]), origin[k], step[k], points[k]);
    for (;;) {
        for (int beside = 0; beside < 9; beside++) {
            const int i = cell[0] + beside % 3 - 1, j = cell[1] + beside / 3 - 1;
            if (i >= 0 && j >= 0 && i <= points[0] - 2 && j <= points[1] - 2)
                intersectCell(f, i, j, from, to, fraction, normal, element);
        }
        MEASSERT(*fraction == INFINITY || (*fraction >= 0 && *fraction <= 1));
        if (*fraction < INFINITY)
            return METRUE;
        double next[2];
        for (int k = 0; k < 2; k++)
            next[k] = exitFraction(from[k], to[k] - from[k], origin[k], step[k], cell[k]);
        const int k = next[1] < next[0];
        cell[k] += to[k] > from[k] ? 1 : -1;
        if (next[k] > leave || cell[k] < 0 || cell[k] > points[k] - 2)
            return MEFALSE;
    }
}

static int MEAPI intersectSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,
                                  McdLineSegIntersectResult *outOverlap) {
    const McdGeometryInstance *ins = &mcd_record(cm)->instance;
    double from[3], to[3], fraction, normal[3];
    return mcd_toLocal(mcd_const(ins->tm), inOrig, from) && mcd_toLocal(mcd_const(ins->tm), inDest, to) &&
           traverseCells((const McdRGHeightField *)ins->geometry, from, to, &fraction, normal, &outOverlap->element) &&
           mcd_writeSegmentHit(mcd_const(ins->tm), inOrig, inDest, fraction, normal, outOverlap);
}

void MEAPI McdRGHeightFieldLineSegmentRegisterInteraction(McdFramework *frame) {
    ME_UNDER_OWN_NAME(McdFrameworkSetLineSegInteraction(frame, kMcdGeometryTypeRGHeightField, intersectSegment));
}
