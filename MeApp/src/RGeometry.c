/* Graphics of collision geometries. */
#include "RGeometry.h"
#include "Mcd.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "RGeometryUtils.h"
#include "me_app_i.h"
#include <limits.h>

/* ---- triangles ------------------------------------------------------------------------------------------------- */

/* One triangle, its normal by the right-hand rule. Without area, it has none. */
static void setTriangle(RObjectVertex v[3], const MeReal *a, const MeReal *b, const MeReal *c) {
    MeVector3 ab, ac, normal;
    MeVector3Subtract(ab, b, a);
    MeVector3Subtract(ac, c, a);
    MeVector3Cross(normal, ab, ac);
    MeVector3Normalize(normal);
    RSetVertex(&v[0], a, normal, 0, 0);
    RSetVertex(&v[1], b, normal, 0, 0);
    RSetVertex(&v[2], c, normal, 0, 0);
}

static RGraphic *emptyGraphic(RRender *rc, int triangles, const float color[4], MeMatrix4Ptr tm) {
    RGraphic *graphic = RGraphicCreateEmpty(3 * triangles);
    if (!graphic)
        return 0;
    RGraphicSetColor(graphic, color);
    RGraphicSetTransformPtr(graphic, tm);
    RGraphicAddToList(rc, graphic, 0);
    return graphic;
}

RGraphic *MEAPI RGraphicTrianglesCreate(RRender *rc, MeVector3 (*corners)[3], int count, const float color[4],
                                        MeMatrix4Ptr tm) {
    if (!meapp_canDraw("RGraphicTrianglesCreate", rc, color))
        return 0;
    if (!corners || count < 1 || count > INT_MAX / 6) {
        MeWarning(1, "RGraphicTrianglesCreate: corners is null, or count is %d: it must be 1 to %d", count,
                  INT_MAX / 6);
        return 0;
    }
    RGraphic *graphic = emptyGraphic(rc, 2 * count, color, tm);
    for (int i = 0; graphic && i < count; i++) {
        setTriangle(&graphic->m_pVertices[6 * i], corners[i][0], corners[i][1], corners[i][2]);
        setTriangle(&graphic->m_pVertices[6 * i + 3], corners[i][0], corners[i][2], corners[i][1]);
    }
    return graphic;
}

/* ---- geometries of triangles ------------------------------------------------------------------------------------- */

static RGraphic *convexGraphic(RRender *rc, McdConvexMeshID mesh, const float color[4], MeMatrix4Ptr tm) {
    int triangles = 0;
    for (int i = 0; i < McdConvexMeshGetPolygonCount(mesh); i++)
        triangles += McdConvexMeshGetPolygonVertexCount(mesh, i) - 2;
    RGraphic *graphic = emptyGraphic(rc, triangles, color, tm);
    RObjectVertex *next = graphic ? graphic->m_pVertices : 0;
    for (int i = 0; graphic && i < McdConvexMeshGetPolygonCount(mesh); i++) {
        for (int k = 1; k + 1 < McdConvexMeshGetPolygonVertexCount(mesh, i); k++, next += 3) {
            MeVector3 a, b, c;
            McdConvexMeshGetPolygonVertex(mesh, i, 0, a);
            McdConvexMeshGetPolygonVertex(mesh, i, k, b);
            McdConvexMeshGetPolygonVertex(mesh, i, k + 1, c);
            setTriangle(next, a, b, c);
        }
    }
    MEASSERT(!graphic || next == graphic->m_pVertices + graphic->m_pObject->m_nNumVertices);
    return graphic;
}

RGraphic *MEAPI RGraphicConvexCreate(RRender *const rc, const McdConvexMeshID conv, const float color[4],
                                     const MeMatrix4Ptr matrix) {
    if (!meapp_canDraw("RGraphicConvexCreate", rc, color))
        return 0;
    if (conv && McdGeometryGetType(conv) == kMcdGeometryTypeConvexMesh)
        return convexGraphic(rc, conv, color, matrix);
    MeWarning(1, "RGraphicConvexCreate: conv is not a convex mesh");
    return 0;
}

static void fieldPoint(McdRGHeightFieldID g, int i, int j, MeVector3 p) {
    MeReal x0, y0, xStep, yStep;
    int xCount, yCount;
    McdRGHeightFieldGetOrigin(g, &x0, &y0);
    McdRGHeightFieldGetSteps(g, &xStep, &yStep);
    McdRGHeightFieldGetCounts(g, &xCount, &yCount);
    MeVector3Set(p, x0 + (MeReal)i * xStep, y0 + (MeReal)j * yStep, McdRGHeightFieldGetHeights(g)[j * xCount + i]);
}

/* One of the two triangles of a cell; false for a hole. */
static MeBool fieldTriangle(McdRGHeightFieldID g, int i, int j, int second, MeVector3 corner[3]) {
    fieldPoint(g, i, j, corner[0]);
    fieldPoint(g, i + 1, second ? j + 1 : j, corner[1]);
    fieldPoint(g, second ? i : i + 1, j + 1, corner[2]);
    return MeRealIsValid(corner[0][2]) && MeRealIsValid(corner[1][2]) && MeRealIsValid(corner[2][2]);
}

static RGraphic *fieldGraphic(RRender *rc, McdRGHeightFieldID g, const float color[4], MeMatrix4Ptr tm) {
    int xCount, yCount, used = 0;
    McdRGHeightFieldGetCounts(g, &xCount, &yCount);
    RGraphic *graphic = emptyGraphic(rc, 2 * (xCount - 1) * (yCount - 1), color, tm);
    for (int j = 0; graphic && j + 1 < yCount; j++)
        for (int i = 0; i + 1 < xCount; i++)
            for (int second = 0; second < 2; second++) {
                MeVector3 corner[3];
                if (!fieldTriangle(g, i, j, second, corner))
                    continue;
                setTriangle(&graphic->m_pVertices[3 * used], corner[0], corner[1], corner[2]);
                used++;
            }
    if (graphic)
        graphic->m_pObject->m_nNumVertices = 3 * used;
    return graphic;
}

/* Two-sided meshes have each triangle twice. */
static RGraphic *meshGraphic(RRender *rc, McdMeshID mesh, const float color[4], MeMatrix4Ptr tm) {
    const int count = McdMeshGetTriangleCount(mesh), sides = McdMeshGetFlags(mesh) & kMcdMeshTwoSided ? 2 : 1;
    MeVector3 corner[3];
    int used = 0;
    RGraphic *graphic = count <= INT_MAX / 6 ? emptyGraphic(rc, sides * count, color, tm) : 0;
    for (int i = 0; graphic && i < count; i++)
        for (int side = 0; McdMeshGetTriangle(mesh, i, corner) && side < sides; side++, used++)
            setTriangle(&graphic->m_pVertices[3 * used], corner[0], corner[1 + side], corner[2 - side]);
    if (graphic)
        graphic->m_pObject->m_nNumVertices = 3 * used;
    return graphic;
}

/* ---- other geometries -------------------------------------------------------------------------------------------- */

static RGraphic *boxGraphic(RRender *rc, McdBoxID box, const float color[4], MeMatrix4Ptr tm) {
    MeReal x, y, z;
    McdBoxGetDimensions(box, &x, &y, &z);
    return RGraphicBoxCreate(rc, (float)x, (float)y, (float)z, color, tm);
}

static RGraphic *coneGraphic(RRender *rc, McdConeID cone, const float color[4], MeMatrix4Ptr tm) {
    return RGraphicConeCreate(rc, (float)McdConeGetLowerRadius(cone), (float)McdConeGetUpperHeight(cone),
                              (float)McdConeGetLowerHeight(cone), color, tm);
}

/* The box of a triangle list; a flat one is as thick as a line. */
static RGraphic *listGraphic(RRender *rc, McdTriangleListID list, const float color[4], MeMatrix4Ptr tm) {
    MeVector3 low, high, middle;
    float side[3];
    McdTriangleListGetBoundingBox(list, low, high);
    for (int i = 0; i < 3; i++) {
        side[i] = (float)(high[i] - low[i]);
        middle[i] = (low[i] + high[i]) / 2;
    }
    const float thin = 1e-4f * (side[0] + side[1] + side[2]);
    RGraphic *graphic = RGraphicBoxCreate(rc, side[0] > thin ? side[0] : thin, side[1] > thin ? side[1] : thin,
                                          side[2] > thin ? side[2] : thin, color, tm);
    if (!graphic)
        return 0;
    RGraphicTranslateVertices(rc, graphic, middle);
    RGraphicSetWireframe(graphic, 1);
    return graphic;
}

/* A vertex of a program's convex shape: its support point in the direction (x, y, z), which is the normal there. */
static void setSupportVertex(RObjectVertex *v, McdGeometryID g, int x, int y, int z) {
    MeVector3 direction = {(MeReal)x, (MeReal)y, (MeReal)z}, point;
    MeMatrix4 own;
    MeMatrix4TMMakeIdentity(own);
    MeVector3Normalize(direction);
    McdGeometryMaximumPoint(g, (const MeVector4 *)own, direction, point);
    RSetVertex(v, point, direction, 0, 0);
}

/* A triangle of support points in directions given as steps along the axes of an octant. */
static void setSupportTriangle(RObjectVertex v[3], McdGeometryID g, const int sign[3], int (*at)[3]) {
    const int isMirrored = sign[0] * sign[1] * sign[2] < 0;
    for (int k = 0; k < 3; k++) {
        const int *from = at[isMirrored ? 2 - k : k];
        setSupportVertex(&v[k], g, sign[0] * from[0], sign[1] * from[1], sign[2] * from[2]);
    }
}

/* A program's convex shape (McdConvexType.h): the edges of an octahedron of directions are divided in STEPS pieces. */
static RGraphic *supportGraphic(RRender *rc, McdGeometryID g, const float color[4], MeMatrix4Ptr tm) {
    enum { STEPS = 16 };
    RGraphic *graphic = emptyGraphic(rc, 8 * STEPS * STEPS, color, tm);
    RObjectVertex *next = graphic ? graphic->m_pVertices : 0;
    for (int octant = 0; graphic && octant < 8; octant++) {
        const int sign[3] = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        for (int i = 0; i < STEPS; i++)
            for (int j = 0; j < STEPS - i; j++) {
                const int k = STEPS - i - j;
                int low[3][3] = {{i, j, k}, {i + 1, j, k - 1}, {i, j + 1, k - 1}};
                int high[3][3] = {{i + 1, j, k - 1}, {i + 1, j + 1, k - 2}, {i, j + 1, k - 1}};
                setSupportTriangle(next, g, sign, low);
                next += 3;
                if (k < 2)
                    continue;
                setSupportTriangle(next, g, sign, high);
                next += 3;
            }
    }
    MEASSERT(!graphic || next == graphic->m_pVertices + graphic->m_pObject->m_nNumVertices);
    return graphic;
}

static RGraphic *geometryGraphic(RRender *rc, McdGeometryID g, const float color[4], MeMatrix4Ptr tm);

/* The parts, made one by one and then joined. */
static RGraphic *aggregateGraphic(RRender *rc, McdAggregateID aggregate, const float color[4], MeMatrix4Ptr tm) {
    RGraphic *whole = 0;
    for (int i = 0; i < McdAggregateGetElementCount(aggregate); i++) {
        MeMatrix4Ptr place = McdAggregateGetElementTransformPtr(aggregate, i);
        RGraphic *part = geometryGraphic(rc, McdAggregateGetElementGeometry(aggregate, i), color, tm);
        if (!part)
            continue;
        RGraphic *start = whole ? whole : emptyGraphic(rc, 0, color, tm);
        whole = start ? RGraphicCombine(rc, start, part, place) : 0;
        if (start)
            RGraphicDelete(rc, start, 0);
        RGraphicDelete(rc, part, 0);
    }
    return whole;
}

/* Arguments are good. Null for types that have no shape of their own. */
static RGraphic *geometryGraphic(RRender *rc, McdGeometryID g, const float color[4], MeMatrix4Ptr tm) {
    enum { PLANE_SIDE = 40 };
    switch (McdGeometryGetType(g)) {
    case kMcdGeometryTypeSphere:
        return RGraphicSphereCreate(rc, (float)McdSphereGetRadius(g), color, tm);
    case kMcdGeometryTypeBox:
        return boxGraphic(rc, g, color, tm);
    case kMcdGeometryTypePlane:
        return RGraphicSquareCreate(rc, PLANE_SIDE, color, tm);
    case kMcdGeometryTypeCylinder:
        return RGraphicCylinderCreate(rc, (float)McdCylinderGetRadius(g), (float)McdCylinderGetHeight(g), color, tm);
    case kMcdGeometryTypeSphyl:
        return RGraphicSphylCreate(rc, (float)McdSphylGetRadius(g), (float)McdSphylGetHeight(g), color, tm);
    case kMcdGeometryTypeCone:
        return coneGraphic(rc, g, color, tm);
    case kMcdGeometryTypeConvexMesh:
        return convexGraphic(rc, g, color, tm);
    case kMcdGeometryTypeTriangleList:
        return listGraphic(rc, g, color, tm);
    case kMcdGeometryTypeRGHeightField:
        return fieldGraphic(rc, g, color, tm);
    case kMcdGeometryTypeMesh:
        return meshGraphic(rc, g, color, tm);
    case kMcdGeometryTypeAggregate:
        return aggregateGraphic(rc, g, color, tm);
    default:
        return McdFrameworkTypeIsConvex(McdGeometryGetFramework(g), McdGeometryGetType(g))
                   ? supportGraphic(rc, g, color, tm)
                   : 0;
    }
}

/* ---- the interface ----------------------------------------------------------------------------------------------
 * */

MeBool meapp_canDraw(const char *function, const RRender *rc, const float color[4]) {
    MeBool isColor = color != 0;
    for (int i = 0; isColor && i < 4; i++)
        isColor = MeRealIsValid((MeReal)color[i]);
    if (!rc || !isColor)
        MeWarning(1, "%s: %s", function, rc ? "color is null or not finite" : "rc is null");
    return rc && isColor;
}

RGraphic *MEAPI RGraphicCreateFromGeometry(RRender *rc, McdGeometryID geom, const float color[4]) {
    if (!meapp_canDraw("RGraphicCreateFromGeometry", rc, color))
        return 0;
    if (geom)
        return geometryGraphic(rc, geom, color, 0);
    MeWarning(1, "RGraphicCreateFromGeometry: geom is null");
    return 0;
}

RGraphic *MEAPI RGraphicCreateFromModel(RRender *rc, McdModelID m, const float color[4]) {
    if (!meapp_canDraw("RGraphicCreateFromModel", rc, color))
        return 0;
    if (m && McdModelIsValid(m))
        return geometryGraphic(rc, McdModelGetGeometry(m), color, McdModelGetTransformPtr(m));
    MeWarning(1, "RGraphicCreateFromModel: m is null, or has been destroyed");
    return 0;
}

RGraphic *MEAPI RGraphicAggregateCreate(RRender *rc, McdAggregateID g, const float color[4], MeMatrix4Ptr tm) {
    if (!meapp_canDraw("RGraphicAggregateCreate", rc, color))
        return 0;
    if (g && McdGeometryGetType(g) == kMcdGeometryTypeAggregate)
        return aggregateGraphic(rc, g, color, tm);
    MeWarning(1, "RGraphicAggregateCreate: g is not an aggregate");
    return 0;
}
