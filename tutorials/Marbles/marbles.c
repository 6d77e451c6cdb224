/* Marbles: balls in a bowl of triangles (User Guide, chapter 4, "Triangle List").
 *
 * A triangle list has no triangles of its own: whenever a model comes near, the library asks the program for those
 * about it, by a callback, and takes them where the program keeps them. So a program may keep its terrain in any form
 * that it likes, and even make it on the way. This bowl is kept in rings, and the callback looks only at the rings near
 * a marble.
 *
 * Two materials: marbles roll on the bowl by friction, but glass on glass has none (chapter 5, "Materials").
 *
 * Triangles have edges, but marbles do not feel them: in a hollow only the faces push. Watch how smoothly they roll,
 * and the status line, which says how deep the worst one is in the bowl.
 */
#include "RGeometry.h"
#include "play.h"
#include <stdio.h>

enum { MARBLES = 60, RINGS = 14, SECTORS = 48, TRIANGLES = 2 * RINGS * SECTORS, MAX_AT_ONCE = 200 };

static const MeReal ringWidth = (MeReal)0.4; /* m */
static const MeReal radius = (MeReal)0.3;    /* m, of a marble */
static const MeReal bottom = (MeReal)0.5;    /* m, the bowl above the floor */
static const MeReal steepness = (MeReal)0.1; /* 1/m: the bowl's surface is bottom + steepness r² */

static MeVector3 triangle[TRIANGLES][3];
static McdModelID marble[MARBLES];
static MeMatrix4 bowlTM;

/* ---- the bowl ------------------------------------------------------------------------------------------------- */

static void bowlPoint(MeVector3 p, int ring, int sector) {
    const MeReal r = ringWidth * (MeReal)ring, angle = 2 * ME_PI * (MeReal)(sector % SECTORS) / SECTORS;
    MeVector3Set(p, r * MeCos(angle), bottom + steepness * r * r, r * MeSin(angle));
}

/* Two triangles for each sector of each ring, their fronts upward; the innermost ring's first ones have no area. */
static void makeBowl(void) {
    for (int i = 0; i < RINGS; i++) {
        for (int k = 0; k < SECTORS; k++) {
            MeVector3 *t = triangle[2 * (i * SECTORS + k)], *next = t + 3;
            bowlPoint(t[0], i, k), bowlPoint(t[1], i, k + 1), bowlPoint(t[2], i + 1, k);
            bowlPoint(next[0], i, k + 1), bowlPoint(next[1], i + 1, k + 1), bowlPoint(next[2], i + 1, k);
        }
    }
}

static MeBool isNear(MeVector3 *corner, const MeReal *p, MeReal r) {
    for (int k = 0; k < 3; k++)
        if (MeMIN3(corner[0][k], corner[1][k], corner[2][k]) > p[k] + r ||
            MeMAX3(corner[0][k], corner[1][k], corner[2][k]) < p[k] - r)
            return MEFALSE;
    return METRUE;
}

static void handOver(McdUserTriangle *t, MeVector3 *corner) {
    for (int k = 0; k < 3; k++)
        t->vertices[k] = &corner[k];
    t->normal = 0;
    t->flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
    t->triangleData.ptr = 0;
}

/* The callback: the triangles near a place. */
static int MEAPI getTriangles(McdModelPair *pair, McdUserTriangle *t, MeVector3 p, MeReal r, int max) {
    const MeReal distance = MeSqrt(p[0] * p[0] + p[2] * p[2]);
    const int first = (int)((distance - r) / ringWidth) - 1, last = (int)((distance + r) / ringWidth) + 1;
    int count = 0;
    (void)pair;
    for (int i = MeMAX(first, 0) * 2 * SECTORS; i < MeMIN(last + 1, RINGS) * 2 * SECTORS && count < max; i++)
        if (isNear(triangle[i], p, r))
            handOver(&t[count++], triangle[i]);
    return count;
}

static void createBowl(void) {
    static const float clay[4] = {.86f, .74f, .58f, 1};
    const MeReal r = ringWidth * RINGS;
    MeVector3 low = {-r, bottom, -r}, high = {r, bottom + steepness * r * r, r};
    makeBowl();
    MeMatrix4TMMakeIdentity(bowlTM);
    playFixed(McdTriangleListCreate(playUniverse->frame, low, high, MAX_AT_ONCE, getTriangles), bowlTM, 0);
    RGraphicTrianglesCreate(playRc, triangle, TRIANGLES, clay, bowlTM);
}

/* ---- marbles -------------------------------------------------------------------------------------------------- */

static void createMarbles(void) {
    const McdGeometryID ball = McdSphereCreate(playUniverse->frame, radius);
    const MstMaterialID glass = MstBridgeGetNewMaterial(playUniverse->bridge);
    const MdtContactParamsID onBowl = playContact(glass, MstBridgeGetDefaultMaterial());
    MdtContactParamsSetSurface(onBowl, (MeReal)0.5, 0);
    MdtContactParamsSetType(playContact(glass, glass), MdtContactTypeFrictionZero);
    for (int i = 0; i < MARBLES; i++) {
        marble[i] = playModel(ball, 10, 0, 0, 0, RPalette[i % 6]);
        McdModelSetMaterial(marble[i], (int)glass);
        McdModelDynamicsSetDamping(marble[i], (MeReal)0.3, (MeReal)0.3); /* rolling has its resistance */
    }
}

/* In a loose column over one side of the bowl. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < MARBLES; i++)
        playPlace(marble[i], (MeReal)(-2.4 + 0.7 * (i % 3) + 0.05 * (i % 4)), (MeReal)(3.5 + 0.35 * (i / 3)),
                  (MeReal)(0.75 * (i / 3 % 3 - 1)), 0, 0);
}

/* A blow from below. */
static void MEAPI blow(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < MARBLES; i++) {
        MdtBodyEnable(McdModelGetBody(marble[i]));
        McdModelDynamicsSetLinearVelocity(marble[i], 0, (MeReal)(3 + 0.1 * (i % 20)), 0);
    }
}

/* How far the marble's surface is from the bowl's, along the bowl's normal: negative inside. */
static MeReal clearance(const MeVector3 p) {
    const MeReal r = MeSqrt(p[0] * p[0] + p[2] * p[2]), slope = 2 * steepness * r;
    return (p[1] - bottom - steepness * r * r) / MeSqrt(1 + slope * slope) - radius;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    int inBowl = 0;
    MeReal deepest = 0;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i < MARBLES; i++) {
        MeVector3 p;
        McdModelDynamicsGetPosition(marble[i], p);
        if (p[1] < bottom || p[0] * p[0] + p[2] * p[2] > ringWidth * ringWidth * RINGS * RINGS)
            continue;
        inBowl++;
        deepest = MeMIN(deepest, clearance(p));
    }
    snprintf(text, sizeof text,
             "in the bowl %d of %d    deepest %.4f m    awake %d    contacts and groups %d    motion %.3f J", inBowl,
             MARBLES, 0 - (double)deepest, playAwake(), MdtWorldGetTotalConstraints(playUniverse->world), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Sixty marbles in a bowl of triangles.",
        "$ACTION2 - pour them again",
        "$ACTION3 - a blow from below",
    };
    if (!playStart(argc, argv, "Marbles", MARBLES))
        return 1;
    playFloor();
    createBowl();
    createMarbles();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, blow, 0);
    playCamera(0, 2.5f, 0, 18, .5f, .5f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
