/* Mesh: things fall over a knotted tube, a mesh of triangles (McdMesh.h).
 *
 * A mesh has its triangles in the library: vertices, and three numbers of vertices for each triangle. A tree of boxes
 * finds those near a body, of millions as fast as of these few thousand. The knot is a tube about a curve that winds
 * twice about the ring's axis and three times about the ring. It is fixed; a mesh may also be moved, by its transform.
 * Each triangle may have a material: along the tube ice and rubber take turns. The status line
 * says how deep the worst thing is in the tube, by the distance of its centre from the curve.
 */
#include "RGeometry.h"
#include "play.h"
#include <stdio.h>

enum {
    ALONG = 240,
    AROUND = 16,
    VERTICES = ALONG * AROUND,
    TRIANGLES = 2 * VERTICES,
    STRIPE = 960,
    BALLS = 60,
    MARKS = 8 * ALONG
};

static const MeReal tube = (MeReal)0.45, ball = (MeReal)0.2; /* m, radii */

static MeVector3 vertex[VERTICES], corner[TRIANGLES][3], mark[MARKS]; /* marks: points of the curve */
static int index[TRIANGLES][3];
static MeU32 material[TRIANGLES];
static MeMatrix4 knotTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
static McdModelID thing[BALLS];

static void curvePoint(MeReal angle, MeVector3 p) {
    const MeReal away = 3 + MeCos(3 * angle);
    MeVector3Set(p, away * MeCos(2 * angle), 2 + MeSin(3 * angle), away * MeSin(2 * angle));
}

/* A ring of the tube: a circle across the curve. */
static void makeRing(int i) {
    const MeReal angle = 2 * ME_PI * (MeReal)i / ALONG;
    MeVector3 p, along, side, up = {0, 1, 0};
    curvePoint(angle, p);
    curvePoint(angle + (MeReal)0.001, along);
    MeVector3Subtract(along, along, p);
    MeVector3Normalize(along);
    MeVector3Cross(side, along, up);
    MeVector3Normalize(side);
    MeVector3Cross(up, side, along);
    for (int k = 0; k < AROUND; k++) {
        const MeReal turn = 2 * ME_PI * (MeReal)k / AROUND, c = tube * MeCos(turn), s = tube * MeSin(turn);
        for (int j = 0; j < 3; j++)
            vertex[i * AROUND + k][j] = p[j] + c * side[j] + s * up[j];
    }
}

/* Two triangles between two rings, counter-clockwise from outside; with the first of a ring, the ring. */
static void makeQuad(int i) {
    const int ring = i / AROUND * AROUND, k = i % AROUND, next = (ring + AROUND) % VERTICES, beside = (k + 1) % AROUND;
    const int of[6] = {ring + k, next + k, next + beside, ring + k, next + beside, ring + beside};
    if (k == 0)
        makeRing(i / AROUND);
    for (int n = 0; n < 6; n++)
        index[2 * i + n / 3][n % 3] = of[n];
}

static void createKnot(MstMaterialID ice, MstMaterialID rubber) {
    for (int i = 0; i < VERTICES; i++)
        makeQuad(i);
    for (int i = 0; i < MARKS; i++)
        curvePoint(2 * ME_PI * (MeReal)i / MARKS, mark[i]);
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        MeVector3Copy(corner[i / 3][i % 3], vertex[index[i / 3][i % 3]]);
        material[i / 3] = i / 3 / STRIPE % 2 ? rubber : ice;
    }
    playFixed(McdMeshCreate(playUniverse->frame, (const MeVector3 *)vertex, VERTICES, index[0], TRIANGLES, material),
              knotTM, 0);
    for (int i = 0; i < TRIANGLES; i += STRIPE)
        RGraphicTrianglesCreate(playRc, &corner[i], STRIPE, RPalette[i / STRIPE % 2 ? 0 : 2], knotTM);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BALLS; i++) {
        const MeReal angle = (MeReal)(0.7 * i), away = (MeReal)(1.6 + 0.5 * (i % 6));
        playPlace(thing[i], away * MeCos(angle), (MeReal)(4.2 + 0.12 * i), away * MeSin(angle), 0, 0);
    }
}

/* m: how far a ball's surface is from the tube's, by the nearest of many points of the curve. */
static MeReal clearance(McdModelID m) {
    MeVector3 p, c;
    MeReal min = 100;
    McdModelDynamicsGetPosition(m, p);
    for (int i = 0; i < MARKS; i++) {
        MeVector3Subtract(c, mark[i], p);
        min = MeMIN(min, MeVector3Magnitude(c));
    }
    return min - tube - ball;
}

static void MEAPI Tick(RRender *context) {
    char text[120];
    MeReal deepest = 0;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i < BALLS; i++)
        deepest = MeMIN(deepest, clearance(thing[i]));
    snprintf(text, sizeof text, "%d triangles    deepest %.4f m    awake %d    motion %.3f J", TRIANGLES,
             0 - (double)deepest, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"A knotted tube of triangles, of ice and of rubber.", "$ACTION2 - once more"};
    if (!playStart(argc, argv, "Mesh", BALLS))
        return 1;
    const MstBridgeID bridge = playUniverse->bridge;
    const MstMaterialID ice = MstBridgeGetNewMaterial(bridge), rubber = MstBridgeGetNewMaterial(bridge);
    MdtContactParamsSetSurface(playContact(ice, MstBridgeGetDefaultMaterial()), 0, 0);
    MdtContactParamsSetSurface(playContact(rubber, MstBridgeGetDefaultMaterial()), 1, (MeReal)0.5);
    playFloor();
    createKnot(ice, rubber);
    for (int i = 0; i < BALLS; i++) {
        thing[i] = playModel(McdSphereCreate(playUniverse->frame, ball), 1000, 0, 0, 0, RPalette[i % 6]);
        McdModelDynamicsSetDamping(thing[i], (MeReal)0.3, (MeReal)0.3); /* rolling has its resistance */
    }
    playHelp(help, 2);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    playCamera(0, 2, 0, 16, .5f, .5f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
