/* Terrain: a height field of a function, its model, and how it looks. */
#include "MeAppTerrain.h"
#include "McdRGHeightField.h"
#include "MeMath.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstUtils.h"
#include "RGeometryUtils.h"
#include "me_app_i.h"

/* Both layouts are kept: heights as the height field reads them, corners as graphics and triangle lists do. */
struct MeAppTerrain {
    int points; /* along each side */
    MeReal cell;
    MeReal *heights;   /* [j points + i] */
    MeVector3 *corner; /* the same points in the world */
    MeMatrix4 tm;      /* from the field, whose z is up, to the world */
};

/* ---- life -------------------------------------------------------------------------------------------------------- */

static MeBool areGood(const char *function, int points, MeReal cell, MeAppHeightCB height) {
    enum { MAX = 4097 };
    if (height && points >= 2 && points <= MAX && cell > 0 && MeRealIsValid(cell))
        return METRUE;
    MeWarning(1, "%s: %s", function,
              !height                      ? "height is null"
              : points < 2 || points > MAX ? "points must be 2 to 4097"
                                           : "cell must be above 0");
    return MEFALSE;
}

/* The middle point, or the one after the middle, is at the origin. */
static MeReal placeOf(const MeAppTerrain *t, int i) {
    return (MeReal)(i - t->points / 2) * t->cell;
}

static MeBool isZUp(const MeAppTerrain *t) {
    return t->tm[2][2] == 1;
}

static void toWorld(const MeAppTerrain *t, MeReal x, MeReal y, MeReal z, MeVector3 world) {
    const MeVector3 inField = {x, y, z};
    MeMatrix4TMRotate(world, t->tm, inField);
}

static void setHeights(MeAppTerrain *t, MeAppHeightCB height, void *userdata) {
    for (int j = 0; j < t->points; j++) {
        for (int i = 0; i < t->points; i++) {
            const int at = j * t->points + i;
            const MeReal x = placeOf(t, i), y = placeOf(t, j);
            t->heights[at] = height(x, isZUp(t) ? y : -y, userdata);
            toWorld(t, x, y, t->heights[at], t->corner[at]);
        }
    }
}

static MeAppTerrain *create(const char *function, int points, MeReal cell, MeAppHeightCB height, void *userdata,
                            MeBool zUp) {
    if (!areGood(function, points, cell, height))
        return 0;
    const size_t count = (size_t)points * (size_t)points;
    MeAppTerrain *t = MeMemoryAPI.create(sizeof *t);
    if (t)
        *t = (MeAppTerrain){.points = points,
                            .cell = cell,
                            .heights = MeMemoryAPI.create(count * sizeof(MeReal)),
                            .corner = MeMemoryAPI.create(count * sizeof(MeVector3))};
    if (!t || !t->heights || !t->corner) {
        MeFatalError(1, "%s: no memory", function);
        MeAppTerrainDestroy(t);
        return 0;
    }
    MeMatrix4TMMakeIdentity(t->tm);
    if (!zUp) { /* The field's z becomes the world's y, its y the world's -z. */
        MeVector3Set(t->tm[1], 0, 0, -1);
        MeVector3Set(t->tm[2], 0, 1, 0);
    }
    setHeights(t, height, userdata);
    return t;
}

MeAppTerrain *MEAPI MeAppTerrainCreate(int points, MeReal cell, MeAppHeightCB height, void *userdata) {
    return create("MeAppTerrainCreate", points, cell, height, userdata, MEFALSE);
}

MeAppTerrain *MEAPI MeAppTerrainCreateZUp(int points, MeReal cell, MeAppHeightCB height, void *userdata) {
    return create("MeAppTerrainCreateZUp", points, cell, height, userdata, METRUE);
}

void MEAPI MeAppTerrainDestroy(MeAppTerrain *t) {
    if (!t)
        return;
    if (t->heights)
        MeMemoryAPI.destroy(t->heights);
    if (t->corner)
        MeMemoryAPI.destroy(t->corner);
    MeMemoryAPI.destroy(t);
}

static MeBool check(const MeAppTerrain *t, const char *function) {
    if (!t)
        MeWarning(1, "%s: the terrain is null", function);
    return t != 0;
}

/* ---- what it is made of ------------------------------------------------------------------------------------------ */

int MEAPI MeAppTerrainGetPoints(const MeAppTerrain *t) {
    return check(t, "MeAppTerrainGetPoints") ? t->points : 0;
}

MeReal MEAPI MeAppTerrainGetCell(const MeAppTerrain *t) {
    return check(t, "MeAppTerrainGetCell") ? t->cell : 0;
}

MeVector3 *MEAPI MeAppTerrainGetCorner(MeAppTerrain *t, int i, int j, int triangle, int corner) {
    static const int offset[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    if (!check(t, "MeAppTerrainGetCorner"))
        return 0;
    const int last = t->points - 2;
    if (i < 0 || i > last || j < 0 || j > last || (triangle | 1) != 1 || corner < 0 || corner > 2) {
        MeWarning(1, "MeAppTerrainGetCorner: there is no corner %d of triangle %d of cell (%d, %d)", corner, triangle,
                  i, j);
        return 0;
    }
    return &t->corner[(j + offset[triangle][corner][1]) * t->points + i + offset[triangle][corner][0]];
}

McdModelID MEAPI MeAppTerrainCreateModel(MeAppTerrain *t, MstUniverseID u) {
    const McdFrameworkID frame = check(t, "MeAppTerrainCreateModel") ? MstUniverseGetFramework(u) : 0;
    if (!frame)
        return 0;
    const McdGeometryID field =
        McdRGHeightFieldCreate(frame, t->heights, t->points, t->points, t->cell, t->cell, placeOf(t, 0), placeOf(t, 0));
    return field ? MstFixedModelCreate(u, field, t->tm) : 0;
}

/* ---- looks ------------------------------------------------------------------------------------------------------- */

static MeReal heightOf(const MeAppTerrain *t, int i, int j) {
    const int last = t->points - 1;
    return t->heights[MeCLAMP(j, 0, last) * t->points + MeCLAMP(i, 0, last)];
}

/* Of the smooth surface through the points. */
static void normalAt(const MeAppTerrain *t, int i, int j, MeVector3 normal) {
    toWorld(t, heightOf(t, i - 1, j) - heightOf(t, i + 1, j), heightOf(t, i, j - 1) - heightOf(t, i, j + 1),
            2 * t->cell, normal);
    MeVector3Normalize(normal);
}

/* One square of the texture, which has eight, is 2 m wide. */
static void setVertex(MeAppTerrain *t, RObjectVertex *v, int i, int j, int triangle, int corner) {
    MeReal *p = *MeAppTerrainGetCorner(t, i, j, triangle, corner);
    MeVector3 normal;
    const int at = (int)((MeVector3 *)p - t->corner);
    normalAt(t, at % t->points, at / t->points, normal);
    RSetVertex(v, p, normal, placeOf(t, at % t->points) / 16, -placeOf(t, at / t->points) / 16);
}

static MeBool isLevel(const MeAppTerrain *t, int i, int j) {
    return heightOf(t, i, j) == 0 && heightOf(t, i + 1, j) == 0 && heightOf(t, i, j + 1) == 0 &&
           heightOf(t, i + 1, j + 1) == 0;
}

static int countCells(const MeAppTerrain *t, MeBool level) {
    int count = 0;
    for (int j = 0; j + 1 < t->points; j++)
        for (int i = 0; i + 1 < t->points; i++)
            count += isLevel(t, i, j) == level;
    return count;
}

/* The cells at height 0, or those that are not. */
static void graphicOf(MeAppTerrain *t, RRender *rc, MeBool level, const float color[4]) {
    const int cells = countCells(t, level);
    RGraphic *g = cells > 0 ? RGraphicCreateEmpty(6 * cells) : 0;
    if (!g)
        return;
    RObjectVertex *next = g->m_pVertices;
    for (int j = 0; j + 1 < t->points; j++)
        for (int i = 0; i + 1 < t->points; i++)
            for (int k = 0; k < 6 && isLevel(t, i, j) == level; k++)
                setVertex(t, next++, i, j, k / 3, k % 3);
    RGraphicSetColor(g, color);
    RGraphicSetTexture(rc, g, "checkerboard");
    RGraphicAddToList(rc, g, 0);
}

void MEAPI MeAppTerrainShow(MeAppTerrain *t, RRender *rc) {
    static const float sand[4] = {.86f, .82f, .70f, 1}, grass[4] = {.58f, .72f, .48f, 1};
    if (!check(t, "MeAppTerrainShow") || !meapp_canDraw("MeAppTerrainShow", rc, sand))
        return;
    graphicOf(t, rc, METRUE, sand);
    graphicOf(t, rc, MEFALSE, grass);
}
