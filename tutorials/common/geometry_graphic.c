#include "geometry_graphic.h"
#include "RGeometryUtils.h"

/* ---- triangles ------------------------------------------------------------------------------------------------ */

static void setCorner(RObjectVertex *v, const MeVector3 at, const MeVector3 normal) {
    RSetVertex(v, at, normal, 0, 0);
}

/* One triangle, its normal by the right-hand rule. */
static void setTriangle(RObjectVertex v[3], const MeReal *a, const MeReal *b, const MeReal *c) {
    MeVector3 ab, ac, normal;
    MeVector3Subtract(ab, b, a);
    MeVector3Subtract(ac, c, a);
    MeVector3Cross(normal, ab, ac);
    MeVector3Normalize(normal);
    setCorner(&v[0], a, normal);
    setCorner(&v[1], b, normal);
    setCorner(&v[2], c, normal);
}

/* An empty graphic for so many triangles, of a colour, in the viewer's list. */
static RGraphic *emptyGraphic(RRender *rc, int triangles, const float color[4], MeMatrix4Ptr tm) {
    RGraphic *graphic = RGraphicCreateEmpty(3 * triangles);
    if (!graphic)
        return 0;
    graphic->m_pObject->m_nNumVertices = 3 * triangles;
    RGraphicSetColor(graphic, color);
    RGraphicSetTransformPtr(graphic, tm);
    RGraphicAddToList(rc, graphic, 0);
    return graphic;
}

RGraphic *triangleGraphic(RRender *rc, MeVector3 (*corners)[3], int count, const float color[4], MeMatrix4Ptr tm) {
    RGraphic *graphic = emptyGraphic(rc, 2 * count, color, tm);
    for (int i = 0; graphic && i < count; i++) {
        setTriangle(&graphic->m_pVertices[6 * i], corners[i][0], corners[i][1], corners[i][2]);
        setTriangle(&graphic->m_pVertices[6 * i + 3], corners[i][0], corners[i][2], corners[i][1]);
    }
    return graphic;
}

/* ---- shapes --------------------------------------------------------------------------------------------------- */

static RGraphic *meshGraphic(RRender *rc, McdConvexMeshID mesh, const float color[4], MeMatrix4Ptr tm) {
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
    return graphic;
}

static RGraphic *boxGraphic(RRender *rc, McdBoxID box, const float color[4], MeMatrix4Ptr tm) {
    MeReal x, y, z;
    McdBoxGetDimensions(box, &x, &y, &z);
    return RGraphicBoxCreate(rc, (float)x, (float)y, (float)z, color, tm);
}

static RGraphic *coneGraphic(RRender *rc, McdConeID cone, const float color[4], MeMatrix4Ptr tm) {
    return RGraphicConeCreate(rc, (float)McdConeGetLowerRadius(cone), (float)McdConeGetUpperHeight(cone),
                              (float)McdConeGetLowerHeight(cone), color, tm);
}

/* Its parts, made one by one and then joined. */
static RGraphic *aggregateGraphic(RRender *rc, McdAggregateID aggregate, const float color[4], MeMatrix4Ptr tm) {
    RGraphic *whole = 0;
    for (int i = 0; i < McdAggregateGetElementCount(aggregate); i++) {
        MeMatrix4Ptr place = McdAggregateGetElementTransformPtr(aggregate, i);
        RGraphic *part = geometryGraphic(rc, McdAggregateGetElementGeometry(aggregate, i), color, tm);
        if (!part)
            continue;
        RGraphic *start = whole ? whole : emptyGraphic(rc, 0, color, tm);
        whole = RGraphicCombine(rc, start, part, place);
        RGraphicDelete(rc, start, 0);
        RGraphicDelete(rc, part, 0);
    }
    return whole;
}

RGraphic *geometryGraphic(RRender *rc, McdGeometryID g, const float color[4], MeMatrix4Ptr tm) {
    switch (McdGeometryGetType(g)) {
    case kMcdGeometryTypeSphere:
        return RGraphicSphereCreate(rc, (float)McdSphereGetRadius(g), color, tm);
    case kMcdGeometryTypeBox:
        return boxGraphic(rc, g, color, tm);
    case kMcdGeometryTypePlane:
        return RGraphicSquareCreate(rc, 40, color, tm);
    case kMcdGeometryTypeCylinder:
        return RGraphicCylinderCreate(rc, (float)McdCylinderGetRadius(g), (float)McdCylinderGetHeight(g), color, tm);
    case kMcdGeometryTypeSphyl:
        return RGraphicSphylCreate(rc, (float)McdSphylGetRadius(g), (float)McdSphylGetHeight(g), color, tm);
    case kMcdGeometryTypeCone:
        return coneGraphic(rc, g, color, tm);
    case kMcdGeometryTypeConvexMesh:
        return meshGraphic(rc, g, color, tm);
    case kMcdGeometryTypeAggregate:
        return aggregateGraphic(rc, g, color, tm);
    default:
        return 0;
    }
}
