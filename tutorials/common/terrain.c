#include "terrain.h"
#include "RGeometryUtils.h"

enum { MIDDLE = TERRAIN_POINTS / 2, CELLS = (TERRAIN_POINTS - 1) * (TERRAIN_POINTS - 1) };

MeVector3 terrainPoint[TERRAIN_POINTS][TERRAIN_POINTS];

static MeReal cellSide;
static MeReal heights[TERRAIN_POINTS * TERRAIN_POINTS];

/* ---- shape ---------------------------------------------------------------------------------------------------- */

/* From 0 to 1 while x does, level at both ends. */
static MeReal smooth(MeReal x) {
    const MeReal t = MeCLAMP(x, 0, 1);
    return t * t * (3 - 2 * t);
}

static MeReal heightAt(MeReal x, MeReal z, MeReal level, MeReal hills) {
    const MeReal half = MIDDLE * cellSide, fromMiddle = MeSqrt(x * x + z * z);
    const MeReal out = smooth((fromMiddle - level) / 12);
    const MeReal wave = MeSin((MeReal)0.17 * x + 1) * MeCos((MeReal)0.14 * z) + MeSin((MeReal)0.09 * (x + z));
    const MeReal rim = smooth((MeMAX(MeFabs(x), MeFabs(z)) / half - (MeReal)0.85) / (MeReal)0.15);
    return out * hills * ((MeReal)0.5 + (MeReal)0.25 * wave) + 3 * hills * rim;
}

void terrainMake(MeReal cell, MeReal level, MeReal hills) {
    cellSide = cell;
    for (int j = 0; j < TERRAIN_POINTS; j++) {
        for (int i = 0; i < TERRAIN_POINTS; i++) {
            const MeReal x = (MeReal)(i - MIDDLE) * cell, z = (MeReal)(MIDDLE - j) * cell;
            heights[j * TERRAIN_POINTS + i] = heightAt(x, z, level, hills);
            MeVector3Set(terrainPoint[j][i], x, heights[j * TERRAIN_POINTS + i], z);
        }
    }
}

MeReal terrainCell(void) {
    return cellSide;
}

MeVector3 *terrainCorner(int i, int j, int triangle, int corner) {
    static const int way[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    return &terrainPoint[j + way[triangle][corner][1]][i + way[triangle][corner][0]];
}

McdGeometryID terrainHeightField(McdFrameworkID frame, MeMatrix4 tm) {
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(tm, R, 0, 0, 0);
    return McdRGHeightFieldCreate(frame, heights, TERRAIN_POINTS, TERRAIN_POINTS, cellSide, cellSide,
                                  -MIDDLE * cellSide, -MIDDLE * cellSide);
}

/* ---- looks ---------------------------------------------------------------------------------------------------- */

static MeReal heightOf(int i, int j) {
    return terrainPoint[MeCLAMP(j, 0, TERRAIN_POINTS - 1)][MeCLAMP(i, 0, TERRAIN_POINTS - 1)][1];
}

/* Of the smooth surface through the points. */
static void normalAt(int i, int j, MeVector3 normal) {
    MeVector3Set(normal, heightOf(i - 1, j) - heightOf(i + 1, j), 2 * cellSide,
                 heightOf(i, j + 1) - heightOf(i, j - 1));
    MeVector3Normalize(normal);
}

/* One square of the texture, which has eight, is 2 m wide. */
static void setVertex(RObjectVertex *v, int i, int j, int triangle, int corner) {
    MeReal *p = *terrainCorner(i, j, triangle, corner);
    MeVector3 normal;
    const int at = (int)((MeVector3 *)p - &terrainPoint[0][0]);
    normalAt(at % TERRAIN_POINTS, at / TERRAIN_POINTS, normal);
    RSetVertex(v, p, normal, p[0] / 16, p[2] / 16);
}

static MeBool isLevel(int i, int j) {
    return heightOf(i, j) == 0 && heightOf(i + 1, j) == 0 && heightOf(i, j + 1) == 0 && heightOf(i + 1, j + 1) == 0;
}

/* The cells that are level, or those that are not. */
static void graphicOf(RRender *rc, MeBool level, const float color[4]) {
    RGraphic *g = RGraphicCreateEmpty(6 * CELLS);
    RObjectVertex *next = g->m_pVertices;
    for (int j = 0; j + 1 < TERRAIN_POINTS; j++)
        for (int i = 0; i + 1 < TERRAIN_POINTS; i++)
            for (int k = 0; k < 6 && isLevel(i, j) == level; k++)
                setVertex(next++, i, j, k / 3, k % 3);
    g->m_pObject->m_nNumVertices = (int)(next - g->m_pVertices);
    RGraphicSetColor(g, color);
    RGraphicSetTexture(rc, g, "checkerboard");
    RGraphicAddToList(rc, g, 0);
}

void terrainGraphic(RRender *rc) {
    static const float sand[4] = {.86f, .82f, .70f, 1}, grass[4] = {.58f, .72f, .48f, 1};
    graphicOf(rc, METRUE, sand);
    graphicOf(rc, MEFALSE, grass);
}
