/* The functions that make graphics of simple shapes and put them into a list. */
#include "r_i.h"
#include "RGeometryUtils.h"

#include <string.h>

enum { SIDES = 48, TUBE_RINGS = 32 };

RGraphic *MEAPI RGraphicBoxCreate(RRender *rc, AcmeReal width, AcmeReal height, AcmeReal depth, const float color[4],
                                  MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(width, __func__, "width") || !r_isSize(height, __func__, "height") ||
        !r_isSize(depth, __func__, "depth"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateBoxVertexCount(), rMesh);
    if (rg)
        RCalculateBoxGeometry(rg, width, height, depth);
    r_graphicIsShape(rg, (RShape){.kind = rShapeBox, .scale = {width, height, depth}});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicConeCreate(RRender *rc, AcmeReal radius, AcmeReal upper_height, AcmeReal lower_height,
                                   const float color[4], MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(radius, __func__, "radius") ||
        !r_isSize(upper_height + lower_height, __func__, "upper_height + lower_height"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateConeVertexCount(SIDES), rMesh);
    if (rg)
        RCalculateConeGeometry(rg, radius, -lower_height, upper_height, SIDES);
    r_graphicIsShape(
        rg,
        (RShape){.kind = rShapeCone, .scale = {radius, radius, upper_height + lower_height}, .shift = -lower_height});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicCylinderCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                       MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(radius, __func__, "radius") || !r_isSize(height, __func__, "height"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateFrustumVertexCount(SIDES), rMesh);
    if (rg)
        RCalculateFrustumGeometry(rg, radius, radius, -height / 2, height / 2, SIDES);
    r_graphicIsShape(rg, (RShape){.kind = rShapeCylinder, .scale = {radius, radius, height}});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicFrustumCreate(RRender *rc, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                      AcmeReal top, int sides, const float color[4], MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(bottomRadius + topRadius, __func__, "bottomRadius + topRadius") ||
        !r_isSize(top - bottom, __func__, "top - bottom"))
        return NULL;
    if (bottomRadius < 0 || topRadius < 0) {
        MeWarning(1, "%s: a radius is negative", __func__);
        return NULL;
    }
    const int vertices = RCalculateFrustumVertexCount(sides);
    RGraphic *rg = vertices ? r_graphicCreate(__func__, vertices, rMesh) : NULL;
    if (rg)
        RCalculateFrustumGeometry(rg, bottomRadius, topRadius, bottom, top, sides);
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicSphereCreate(RRender *rc, AcmeReal radius, const float color[4], MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(radius, __func__, "radius"))
        return NULL;
    const int sides = rc->m_pViewer->sphereSides, rings = sides / 2;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateSphereVertexCount(sides, rings), rMesh);
    if (rg)
        RCalculateSphereGeometry(rg, radius, sides, rings);
    r_graphicIsShape(rg, (RShape){.kind = rShapeSphere, .scale = {radius, radius, radius}});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicSphylCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                    MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(radius, __func__, "radius") || !r_isSize(height, __func__, "height"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateSphylVertexCount(SIDES, SIDES / 2), rMesh);
    if (rg)
        RCalculateSphylGeometry(rg, radius, height, SIDES, SIDES / 2);
    r_graphicIsShape(rg, (RShape){.kind = rShapeSphyl, .scale = {radius, radius, radius}, .ratio = height / radius});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicTorusCreate(RRender *rc, AcmeReal innerRadius, AcmeReal outerRadius, const float color[4],
                                    MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isSize(innerRadius, __func__, "innerRadius") ||
        !r_isSize(outerRadius - innerRadius, __func__, "outerRadius - innerRadius"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, RCalculateTorusVertexCount(SIDES, TUBE_RINGS), rMesh);
    if (rg)
        RCalculateTorusGeometry(rg, outerRadius, innerRadius, SIDES, TUBE_RINGS);
    r_graphicIsShape(rg, (RShape){.kind = rShapeTorus,
                                  .scale = {outerRadius, outerRadius, outerRadius},
                                  .ratio = innerRadius / outerRadius});
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicSquareCreate(RRender *rc, AcmeReal side, const float color[4], MeMatrix4Ptr matrix) {
    static const AcmeReal corners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    if (!r_isContext(rc, __func__) || !r_isSize(side, __func__, "side"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, 6, rMesh);
    for (int i = 0; rg && i < 6; i++)
        rg->m_pVertices[i] = (RObjectVertex){corners[i][0] * side / 2,    corners[i][1] * side / 2,   0, 0, 0, 1,
                                             0.5f + 0.5f * corners[i][0], 0.5f - 0.5f * corners[i][1]};
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

/* One cell of the ground: two triangles, with the whole texture. */
static void groundCell(RObjectVertex *to, AcmeReal x, AcmeReal y, AcmeReal z, AcmeReal cell) {
    static const AcmeReal corners[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
    for (int i = 0; i < 6; i++)
        to[i] = (RObjectVertex){
            x + corners[i][0] * cell, y, z + corners[i][1] * cell, 0, 1, 0, corners[i][0], corners[i][1]};
}

RGraphic *MEAPI RGraphicGroundPlaneCreate(RRender *rc, AcmeReal side_length, int triangles_per_side,
                                          const float color[4], AcmeReal y_position) {
    if (!r_isContext(rc, __func__) || !r_isSize(side_length, __func__, "side_length") ||
        !r_isNumber(y_position, __func__, "y_position"))
        return NULL;
    const int n = triangles_per_side;
    if (n < 1 || n > 512) {
        MeWarning(1, "%s: triangles_per_side is %d: it must be 1 to 512", __func__, n);
        return NULL;
    }
    RGraphic *rg = r_graphicCreate(__func__, 6 * n * n, rGround);
    if (!rg)
        return NULL;
    const AcmeReal cell = side_length / (AcmeReal)n, corner = -side_length / 2;
    for (int i = 0; i < n * n; i++)
        groundCell(rg->m_pVertices + 6 * i, corner + cell * (AcmeReal)(i % n), y_position,
                   corner + cell * (AcmeReal)(i / n), cell);
    rg->m_pPart->side = side_length;
    return r_graphicFinish(__func__, rc, rg, color, NULL, false);
}

RGraphic *MEAPI RGraphic2DRectangleCreate(RRender *rc, AcmeReal orig_x, AcmeReal orig_y, AcmeReal width,
                                          AcmeReal height, const float color[4]) {
    static const AcmeReal corners[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
    if (!r_isContext(rc, __func__) || !r_isNumber(orig_x, __func__, "orig_x") ||
        !r_isNumber(orig_y, __func__, "orig_y") || !r_isSize(width, __func__, "width") ||
        !r_isSize(height, __func__, "height"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, 6, rMesh);
    for (int i = 0; rg && i < 6; i++)
        rg->m_pVertices[i] = (RObjectVertex){
            orig_x + corners[i][0] * width, orig_y - corners[i][1] * height, 0, 0, 0, 1, corners[i][0], corners[i][1]};
    return r_graphicFinish(__func__, rc, rg, color, NULL, true);
}

void MEAPI RRenderSkydomeCreate(RRender *const rc, const char *name, int tileU, int tileV) {
    static const float white[4] = {1, 1, 1, 1};
    enum { RINGS = 16 };
    if (!r_isContext(rc, __func__))
        return;
    if (name && (tileU < 1 || tileV < 1 || tileU > 1024 || tileV > 1024)) {
        MeWarning(1, "%s: the tiles are %d and %d: they must be 1 to 1024", __func__, tileU, tileV);
        return;
    }
    struct RViewer *v = rc->m_pViewer;
    if (v->sky)
        RGraphicDestroy(v->sky);
    v->sky = name ? r_graphicCreate(__func__, RCalculateDomeVertexCount(SIDES, RINGS), rSky) : NULL;
    if (!v->sky)
        return;
    RCalculateDomeGeometry(v->sky, 1, SIDES, RINGS, tileU, tileV);
    RGraphicSetColor(v->sky, white);
    RGraphicSetTexture(rc, v->sky, name);
}
