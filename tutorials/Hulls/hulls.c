/* Hulls: dice, gems and pebbles made from clouds of points (User Guide, chapter 4, "Making a Model with a Convex Mesh
 * Geometry").
 *
 * McdConvexMeshCreateHull takes any points and keeps those that are outermost; the clouds here have points inside as
 * well. The origin of a mesh is wherever its points have it, while a body turns about its centre of mass, so each cloud
 * is moved until both are one. Forty-eight pieces fall into a tray, on each other, come to rest and fall asleep.
 *
 * Watch the number of bodies that are awake, and press 3. The status line tells how many faces the hulls have, the dice
 * first, and how far the lowest corner of all is below the floor of the tray.
 */
#include "play.h"
#include <stdio.h>

enum { TETRAHEDRON, CUBE, OCTAHEDRON, DODECAHEDRON, ICOSAHEDRON, GEM, PEBBLE, CRYSTAL, KINDS };
enum { EACH = 6, PIECES = KINDS * EACH, MAX_POINTS = 80, INNER = 20, WALLS = 4 };

typedef struct Cloud {
    MeVector3 point[MAX_POINTS];
    int count;
} Cloud;

static const MeReal size = (MeReal)0.5; /* m, from the middle to the corners of dice */
static const MeReal tray = 3;           /* m, half of its side */

static McdGeometryID hull[KINDS];
static McdModelID piece[PIECES];
static MeMatrix4 wallTM[WALLS];

/* ---- clouds of points ------------------------------------------------------------------------------------------- */

/* A number between -1 and 1, the same ones in every run. */
static MeReal chance(void) {
    static unsigned int state = 1;
    state = state * 1664525u + 1013904223u;
    return (MeReal)(state >> 8) / (1 << 23) - 1;
}

/* A point in the direction (x, y, z), so far from the middle. */
static void addPoint(Cloud *c, MeReal x, MeReal y, MeReal z, MeReal distance) {
    const MeReal scale = distance / MeSqrt(x * x + y * y + z * z);
    MeVector3Set(c->point[c->count++], scale * x, scale * y, scale * z);
}

/* The points (0, ±y, ±z) and those that come of them by taking the axes in turn: 12, or 6 where y is 0. */
static void addInTurn(Cloud *c, MeReal y, MeReal z) {
    for (int axis = 0; axis < 3; axis++) {
        for (int signs = 0; signs < 4; signs++) {
            MeReal p[3] = {0, 0, 0};
            p[(axis + 1) % 3] = signs & 1 ? y : -y;
            p[(axis + 2) % 3] = signs & 2 ? z : -z;
            addPoint(c, p[0], p[1], p[2], size);
        }
    }
}

/* The corners of a cube: all, or every second one. */
static void addCorners(Cloud *c, MeBool all) {
    for (int i = 0; i < 8; i++) {
        const int x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1, z = i & 4 ? 1 : -1;
        if (all || x * y * z > 0)
            addPoint(c, (MeReal)x, (MeReal)y, (MeReal)z, size);
    }
}

/* A ring of points about z: a regular polygon. */
static void addRing(Cloud *c, int sides, MeReal radius, MeReal z, MeReal turned) {
    for (int i = 0; i < sides; i++) {
        const MeReal a = 2 * ME_PI * ((MeReal)i + turned) / (MeReal)sides;
        MeVector3Set(c->point[c->count++], radius * MeCos(a), radius * MeSin(a), z);
    }
}

/* Points on an ellipsoid, pairs on opposite sides. */
static void addPebble(Cloud *c) {
    for (int i = 0; i < 25; i++) {
        const MeReal x = chance(), y = chance(), z = chance(), r = MeSqrt(x * x + y * y + z * z);
        for (int side = -1; side <= 1; side += 2)
            MeVector3Set(c->point[c->count++], (MeReal)(0.5 * side) * x / r, (MeReal)(0.42 * side) * y / r,
                         (MeReal)(0.3 * side) * z / r);
    }
}

/* Means of two points that are there, drawn to the middle: they lie inside and change nothing. */
static void addInner(Cloud *c) {
    const int outer = c->count;
    for (int i = 0; i < INNER; i++, c->count++)
        MeVector3Lerp(c->point[c->count], c->point[i % outer], c->point[(7 * i + 3) % outer], (MeReal)0.5);
    for (int i = outer; i < c->count; i++)
        MeVector3Scale(c->point[i], (MeReal)0.7);
}

static void makeCloud(Cloud *c, int kind) {
    const MeReal golden = (1 + MeSqrt(5)) / 2;
    c->count = 0;
    if (kind == TETRAHEDRON || kind == CUBE || kind == DODECAHEDRON)
        addCorners(c, kind != TETRAHEDRON);
    if (kind == OCTAHEDRON)
        addInTurn(c, 0, 1);
    if (kind == DODECAHEDRON)
        addInTurn(c, 1 / golden, golden);
    if (kind == ICOSAHEDRON)
        addInTurn(c, 1, golden);
    if (kind == GEM) { /* a table, a girdle, a point */
        addRing(c, 8, (MeReal)0.3, (MeReal)0.2, (MeReal)0.5);
        addRing(c, 8, (MeReal)0.5, 0, 0);
        addRing(c, 1, 0, (MeReal)-0.45, 0);
    }
    if (kind == PEBBLE)
        addPebble(c);
    if (kind == CRYSTAL) { /* a prism with two tips of different heights */
        addRing(c, 6, (MeReal)0.28, (MeReal)-0.35, 0);
        addRing(c, 6, (MeReal)0.28, (MeReal)0.25, 0);
        addRing(c, 1, 0, (MeReal)-0.45, 0);
        addRing(c, 1, 0, (MeReal)0.6, 0);
    }
    addInner(c);
}

/* Moves the points until the centre of mass of their hull is the origin. */
static void center(Cloud *c) {
    const McdGeometryID first = McdConvexMeshCreateHull(playUniverse->frame, c->point, c->count, 0);
    MeMatrix4 tm;
    MeMatrix3 moments;
    MeReal volume;
    McdGeometryGetMassProperties(first, tm, moments, &volume);
    for (int i = 0; i < c->count; i++)
        MeVector3Subtract(c->point[i], c->point[i], tm[3]);
    McdGeometryDestroy(first);
}

/* ---- motion ----------------------------------------------------------------------------------------------------- */

/* In layers of 4 by 4 above the tray, each turned another way. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < PIECES; i++) {
        const int layer = i / 16, x = i % 4, z = i / 4 % 4;
        playPlace(piece[i], (MeReal)(1.25 * (x - 1.5) + 0.1 * layer), (MeReal)(1.2 + 1.3 * layer),
                  (MeReal)(1.25 * (z - 1.5) - 0.1 * layer), i % 3, (MeReal)i);
    }
}

/* Has everything jump. */
static void MEAPI toss(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < PIECES; i++) {
        const MdtBodyID b = McdModelGetBody(piece[i]);
        MdtBodyEnable(b);
        MdtBodySetLinearVelocity(b, chance(), 5 + chance(), chance());
        MdtBodySetAngularVelocity(b, 6 * chance(), 6 * chance(), 6 * chance());
    }
}

/* ---- status ----------------------------------------------------------------------------------------------------- */

static MeReal lowestCorner(McdModelID m) {
    const McdGeometryID g = McdModelGetGeometry(m);
    MeReal lowest = MEINFINITY;
    for (int face = 0; face < McdConvexMeshGetPolygonCount(g); face++) {
        for (int k = 0; k < McdConvexMeshGetPolygonVertexCount(g, face); k++) {
            MeVector3 p;
            MeMatrix4TMTransform(p, McdModelGetTransformPtr(m), McdConvexMeshGetPolygonVertexPtr(g, face, k));
            lowest = MeMIN(lowest, p[1]);
        }
    }
    return lowest;
}

static int inTray(void) {
    int count = 0;
    for (int i = 0; i < PIECES; i++) {
        const MeReal *p = McdModelGetTransformPtr(piece[i])[3];
        count += MeFabs(p[0]) < tray && MeFabs(p[2]) < tray;
    }
    return count;
}

static void showFigures(void) {
    char text[240];
    MeReal lowest = MEINFINITY;
    int n = snprintf(text, sizeof text, "faces");
    for (int i = 0; i < KINDS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %d", McdConvexMeshGetPolygonCount(hull[i]));
    for (int i = 0; i < PIECES; i++)
        lowest = MeMIN(lowest, lowestCorner(piece[i]));
    snprintf(text + n, sizeof text - (size_t)n,
             "    awake %d of %d    motion %.3f J    in the tray %d    deepest %.4f mm", playAwake(), PIECES,
             playEnergy(), inTray(), 1000 * (double)-lowest);
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    showFigures();
}

/* ---- what there is ---------------------------------------------------------------------------------------------- */

static void createTray(void) {
    static const float wood[4] = {.62f, .48f, .33f, 1};
    const MeReal high = (MeReal)0.6, thick = (MeReal)0.3;
    for (int i = 0; i < WALLS; i++) {
        const MeReal side = i % 2 ? 1 : -1, away = side * (tray + thick / 2);
        const MeBool alongX = i < 2;
        const MeReal length = 2 * tray + (alongX ? 2 * thick : 0);
        MeMatrix4TMMakeIdentity(wallTM[i]);
        MeVector3Set(wallTM[i][3], alongX ? 0 : away, high / 2, alongX ? away : 0);
        playFixed(McdBoxCreate(playUniverse->frame, alongX ? length : thick, high, alongX ? thick : length), wallTM[i],
                  wood);
    }
}

static void createPieces(void) {
    static Cloud cloud;
    for (int kind = 0; kind < KINDS; kind++) {
        makeCloud(&cloud, kind);
        center(&cloud);
        hull[kind] = McdConvexMeshCreateHull(playUniverse->frame, cloud.point, cloud.count, 0);
    }
    for (int i = 0; i < PIECES; i++)
        piece[i] = playModel(hull[(i + i / KINDS) % KINDS], 1000, 0, 0, 0, RPalette[(i + i / KINDS) % KINDS]);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Dice, gems and pebbles: hulls of clouds of points.",
        "$ACTION2 - drop them again",
        "$ACTION3 - toss them up",
    };
    if (!playStart(argc, argv, "Hulls", PIECES))
        return 1;
    /* A heap that comes to rest by itself: exact answers would cost twenty times as much. */
    MdtWorldSetSolver(playUniverse->world, MdtSolverFast);
    playFloor();
    createTray();
    createPieces();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, toss, 0);
    playCamera(0, .6f, 0, 11, .5f, .5f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
