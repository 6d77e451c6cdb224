/* Collide: any geometry against any other, and what the collision library says of them (User Guide, chapter 4, "Testing
 * Collision Directly").
 *
 * The blue model is driven by keys; the orange one stands still. No dynamics: the models go through each other.
 *   white crosses     contacts, each with its normal as a line: the way in which the blue model would be pushed
 *   green line        the nearest points of both, while they are apart; where they overlap, the shortest way out
 *   red, orange blue  the models, orange while they do not touch and red while they do
 * Until you press a key the blue model goes to and fro by itself, and every two seconds one of the two is another one.
 * Key 5 moves the blue model out, along the normal and by the depth that the library reports: then they only just
 * touch.
 */
#include "RGeometry.h"
#include "Mcd.h"
#include "MeViewer.h"
#include "RMark.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CONTACTS = 20, MAX_PARTS = 16, GRID = 9, TRIANGLES = 2 * (GRID - 1) * (GRID - 1) };

/* The kinds of geometries, the ones that can be driven first. */
enum {
    BALL,
    BOX,
    CYLINDER,
    SPHYL,
    CONE,
    HULL,
    STOOL,
    DRIVEN_KINDS,
    PLANE = DRIVEN_KINDS,
    LIST,
    FIELD,
    KINDS,
    NONE = -1
};

static const char *const name[KINDS] = {"ball", "box",   "cylinder", "sphyl",         "cone",
                                        "hull", "stool", "plane",    "triangle list", "height field"};
static const MeReal stride = (MeReal)0.02;  /* m, for one press of a key */
static const MeReal turning = (MeReal)0.03; /* rad */

static McdFrameworkID frame;
static McdGeometryID geometry[KINDS], seat, leg;
static McdModelID driven, fixed;
static McdModelPairID pair;
static int drivenKind, fixedKind;
static int shown; /* frames, while the shapes move and change by themselves; NONE: a key was pressed */
static MeMatrix4 drivenTM, fixedTM;
static MeMatrix4 part[5]; /* of the stool */

static MeVector3 corner[TRIANGLES][3];
static MeReal height[GRID * GRID]; /* of the field */

static McdContact contact[MAX_CONTACTS];
static McdIntersectResult touch;
static McdDistanceResult gap;
static MeBool hasGap;

static RRender *rc;
static RGraphic *drivenGraphic, *fixedGraphic;
static const float drivenColor[4] = {.10f, .32f, .80f, .65f};

/* ---- geometries ------------------------------------------------------------------------------------------------- */

static MeReal groundAt(int x, int z) {
    return (MeReal)0.5 * MeSin((MeReal)0.9 * (MeReal)x) * MeCos((MeReal)0.8 * (MeReal)z) - (MeReal)0.5;
}

/* The triangles of a hilly square of 8 m. */
static void makeTriangles(void) {
    int n = 0;
    for (int x = 0; x + 1 < GRID; x++) {
        for (int z = 0; z + 1 < GRID; z++) {
            const int way[2][3][2] = {{{0, 0}, {0, 1}, {1, 1}}, {{0, 0}, {1, 1}, {1, 0}}};
            for (int t = 0; t < 2; t++, n++)
                for (int k = 0; k < 3; k++) {
                    const int i = x + way[t][k][0], j = z + way[t][k][1];
                    MeVector3Set(corner[n][k], (MeReal)(i - GRID / 2), groundAt(i, j), (MeReal)(j - GRID / 2));
                }
        }
    }
}

/* Hands over the triangles near a place: those whose boxes, seen from above, come near. */
static int MEAPI getTriangles(McdModelPair *p, McdUserTriangle *triangle, MeVector3 position, MeReal radius, int max) {
    int count = 0;
    (void)p;
    for (int i = 0; i < TRIANGLES && count < max; i++) {
        MeBool isNear = METRUE;
        for (int k = 0; k < 3; k += 2) {
            const MeReal low = MeMIN3(corner[i][0][k], corner[i][1][k], corner[i][2][k]);
            const MeReal high = MeMAX3(corner[i][0][k], corner[i][1][k], corner[i][2][k]);
            isNear = isNear && low <= position[k] + radius && high >= position[k] - radius;
        }
        if (!isNear)
            continue;
        for (int k = 0; k < 3; k++)
            triangle[count].vertices[k] = &corner[i][k];
        triangle[count].normal = 0;
        triangle[count].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
        triangle[count++].triangleData.ptr = 0;
    }
    return count;
}

static McdGeometryID makeHull(void) {
    MeVector3 point[24];
    for (int i = 0; i < 24; i++) { /* on an ellipsoid, along a spiral */
        const MeReal z = 1 - (2 * (MeReal)i + 1) / 24, r = MeSqrt(1 - z * z), angle = (MeReal)2.4 * (MeReal)i;
        MeVector3Set(point[i], (MeReal)0.8 * r * MeCos(angle), (MeReal)0.6 * z, (MeReal)0.6 * r * MeSin(angle));
    }
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)point, 24, 0);
}

static McdGeometryID makeStool(void) {
    const McdAggregateID stool = McdAggregateCreate(frame, 5);
    seat = McdBoxCreate(frame, (MeReal)1.4, (MeReal)1.4, (MeReal)0.2);
    leg = McdCylinderCreate(frame, (MeReal)0.1, (MeReal)0.9);
    MeMatrix4TMMakeIdentity(part[0]);
    MeMatrix4TMSetPosition(part[0], 0, 0, (MeReal)0.4);
    McdAggregateAddElement(stool, seat, part[0]);
    for (int i = 1; i < 5; i++) {
        MeMatrix4TMMakeIdentity(part[i]);
        MeMatrix4TMSetPosition(part[i], i & 1 ? (MeReal)0.55 : (MeReal)-0.55, i & 2 ? (MeReal)0.55 : (MeReal)-0.55,
                               (MeReal)-0.15);
        McdAggregateAddElement(stool, leg, part[i]);
    }
    return stool;
}

static McdGeometryID makeList(void) {
    MeVector3 low = {-4, -2, -4}, high = {4, 1, 4};
    makeTriangles();
    return McdTriangleListCreate(frame, low, high, TRIANGLES + 1, getTriangles);
}

/* The same hills, as heights along z. */
static McdGeometryID makeField(void) {
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++)
            height[j * GRID + i] = groundAt(i, GRID - 1 - j);
    return McdRGHeightFieldCreate(frame, height, GRID, GRID, 1, 1, -(GRID / 2), -(GRID / 2));
}

static void createGeometries(void) {
    frame = McdInit(0, 2, MAX_PARTS, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    geometry[BALL] = McdSphereCreate(frame, (MeReal)0.7);
    geometry[BOX] = McdBoxCreate(frame, (MeReal)1.6, 1, (MeReal)1.2);
    geometry[CYLINDER] = McdCylinderCreate(frame, (MeReal)0.6, (MeReal)1.4);
    geometry[SPHYL] = McdSphylCreate(frame, (MeReal)0.4, (MeReal)1.2);
    geometry[CONE] = McdConeCreate(frame, (MeReal)1.4, (MeReal)0.8);
    geometry[HULL] = makeHull();
    geometry[STOOL] = makeStool();
    geometry[PLANE] = McdPlaneCreate(frame);
    geometry[LIST] = makeList();
    geometry[FIELD] = makeField();
}

/* ---- models ----------------------------------------------------------------------------------------------------- */

static void drop(RGraphic **graphic) {
    if (*graphic)
        RGraphicDelete(rc, *graphic, 0);
    *graphic = 0;
}

static void makePair(void) {
    if (pair)
        McdModelPairDestroy(pair);
    pair = McdModelPairCreate(driven, fixed);
    McdHello(pair);
}

static McdModelID makeModel(McdModelID old, int kind, MeMatrix4Ptr tm) {
    if (old && pair) {
        McdGoodbye(pair);
        McdModelPairDestroy(pair);
        pair = 0;
    }
    McdModelDestroy(old);
    const McdModelID made = McdModelCreate(geometry[kind]);
    McdModelSetTransformPtr(made, tm);
    McdModelSetContactTolerance(made, (MeReal)0.01);
    McdModelUpdate(made);
    return made;
}

/* How high the fixed model is, where the driven one starts. */
static MeReal top(void) {
    MeVector3 low, high;
    if (fixedKind == PLANE)
        return 0;
    if (fixedKind == LIST || fixedKind == FIELD)
        return groundAt(GRID / 2, GRID / 2);
    McdGeometryGetAABB(geometry[fixedKind], (const MeVector4 *)fixedTM, low, high);
    return high[1];
}

/* Upright, and 5 cm deep in a fixed model that is flat on top. */
static void standDriven(void) {
    MeMatrix3 R;
    MeVector3 low, high;
    MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(drivenTM, R, (MeReal)0.3, 0, (MeReal)0.2);
    McdGeometryGetAABB(geometry[drivenKind], (const MeVector4 *)drivenTM, low, high);
    drivenTM[3][1] = top() - low[1] - (MeReal)0.05;
}

/* Geometries about z stand up; a list is given upright, and so is everything that looks the same either way. */
static void standFixed(void) {
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, fixedKind == LIST || fixedKind == BOX ? 0 : -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(fixedTM, R, 0, 0, 0);
}

static void chooseDriven(int kind) {
    drivenKind = kind;
    standDriven();
    driven = makeModel(driven, kind, drivenTM);
    drop(&drivenGraphic);
    drivenGraphic = RGraphicCreateFromModel(rc, driven, drivenColor);
}

static void chooseFixed(int kind) {
    static const float orange[4] = {.95f, .50f, .10f, .75f}, sand[4] = {.85f, .75f, .55f, 1};
    fixedKind = kind;
    standFixed();
    fixed = makeModel(fixed, kind, fixedTM);
    drop(&fixedGraphic);
    if (kind == LIST || kind == FIELD) { /* the same hills */
        static MeMatrix4 upright;
        MeMatrix4TMMakeIdentity(upright);
        fixedGraphic = RGraphicTrianglesCreate(rc, corner, TRIANGLES, sand, upright);
    } else {
        fixedGraphic = RGraphicCreateFromModel(rc, fixed, kind == PLANE ? sand : orange);
    }
}

/* ---- keys ------------------------------------------------------------------------------------------------------- */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    standDriven();
}

static void MEAPI nextDriven(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    chooseDriven((drivenKind + 1) % DRIVEN_KINDS);
    makePair();
}

static void MEAPI nextFixed(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    chooseFixed((fixedKind + 1) % KINDS);
    standDriven();
    makePair();
}

/* By the deepest contact. */
static void MEAPI pushOut(RRender *context, void *userdata) {
    const McdContact *deepest = 0;
    (void)context, (void)userdata;
    shown = NONE;
    for (int i = 0; i < touch.contactCount; i++)
        if (!deepest || contact[i].separation < deepest->separation)
            deepest = &contact[i];
    for (int k = 0; deepest && k < 3; k++)
        drivenTM[3][k] -= deepest->separation * deepest->normal[k];
}

static void shift(int axis, MeReal by) {
    shown = NONE;
    drivenTM[3][axis] += by;
}

/* About an axis of the world. */
static void spin(int axis, MeReal by) {
    MeVector3 angle = {0, 0, 0}, still = {0, 0, 0};
    MeMatrix4 before;
    angle[axis] = by;
    memcpy(before, drivenTM, sizeof before);
    MeMatrix4TMUpdateFromVelocities(drivenTM, 0, 1, still, angle, (const MeVector4 *)before);
}

static void turn(int axis, MeReal by) {
    shown = NONE;
    spin(axis, by);
}

/* A second after the start: the blue shape comes and goes, and turns a little, and every two seconds one of the two is
 * another one. */
static void showItself(void) {
    enum { FIRST = 60, EACH = 120 };
    const int since = shown - FIRST;
    if (shown == NONE || ++shown <= FIRST)
        return;
    if (since > 0 && since % EACH == 0) {
        if (since / EACH % 2)
            chooseFixed((fixedKind + 1) % KINDS);
        else
            chooseDriven((drivenKind + 1) % DRIVEN_KINDS);
        makePair();
    }
    const MeReal phase = 2 * ME_PI * (MeReal)(since % EACH) / EACH;
    standDriven();
    spin(2, (MeReal)0.4 * MeSin(phase));
    drivenTM[3][1] += (MeReal)0.15 * MeSin(phase);
}

static void MEAPI left(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shift(0, -stride);
}

static void MEAPI right(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shift(0, stride);
}

static void MEAPI up(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shift(1, stride);
}

static void MEAPI down(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shift(1, -stride);
}

static void MEAPI rollForward(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    turn(0, -turning);
}

static void MEAPI rollBack(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    turn(0, turning);
}

static void MEAPI rollLeft(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    turn(2, turning);
}

static void MEAPI rollRight(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    turn(2, -turning);
}

/* ---- what the library says --------------------------------------------------------------------------------------- */

static void collide(void) {
    McdModelUpdate(driven);
    McdModelUpdate(fixed);
    touch.contacts = contact;
    touch.contactMaxCount = MAX_CONTACTS;
    touch.contactCount = 0;
    if (McdNearby(pair))
        McdIntersect(pair, &touch);
    hasGap = McdDistance(pair, &gap);
}

static void line(const MeVector3 a, const MeVector3 b, float red, float green, float blue) {
    const float color[4] = {red, green, blue, 1};
    RMarkLine(rc, a, b, color, 3);
}

/* A cross at the contact and a line along its normal. */
static void drawContact(const McdContact *c) {
    MeVector3 a, b;
    for (int axis = 0; axis < 3; axis++) {
        MeVector3Copy(a, c->position);
        MeVector3Copy(b, c->position);
        a[axis] -= (MeReal)0.06;
        b[axis] += (MeReal)0.06;
        line(a, b, 1, 1, 1);
    }
    MeVector3MultiplyScalar(b, c->normal, (MeReal)0.6);
    MeVector3Add(b, b, c->position);
    line(c->position, b, 1, .9f, .2f);
}

/* Over the picture, so that no shape hides them. */
static void MEAPI drawMarks(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < touch.contactCount; i++)
        drawContact(&contact[i]);
    if (hasGap)
        line(gap.position1, gap.position2, .1f, .75f, .2f);
}

static void showTouch(void) {
    static const float touching[4] = {.85f, .12f, .10f, .65f};
    RGraphicSetColor(drivenGraphic, touch.contactCount ? touching : drivenColor);
}

static double deepestSeparation(void) {
    double deepest = 0;
    for (int i = 0; i < touch.contactCount; i++)
        deepest = i == 0 || (double)contact[i].separation < deepest ? (double)contact[i].separation : deepest;
    return deepest;
}

static void showFigures(void) {
    char text[400], contacts[200] = "no contact", distance[40] = "";
    if (touch.contactCount)
        snprintf(contacts, sizeof contacts, "contacts %d    deepest %.4f m    normal (%.3f %.3f %.3f)",
                 touch.contactCount, deepestSeparation(), (double)touch.normal[0], (double)touch.normal[1],
                 (double)touch.normal[2]);
    if (hasGap)
        snprintf(distance, sizeof distance, "    distance %.4f m", (double)gap.distance);
    snprintf(text, sizeof text, "%s against %s    %s%s", name[drivenKind], name[fixedKind], contacts, distance);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    showItself();
    collide();
    showTouch();
    showFigures();
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    McdGoodbye(pair);
    McdModelPairDestroy(pair);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

static void createGraphics(void) {
    static const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, .5f, 0};
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, -1.6f);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 6.2f, .5f, .35f);
    RRenderSetMarkCallBack(rc, drawMarks, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "Any shape against any other: contacts, normals, depths, nearest points.",
        "$ACTION2 - back to the start",
        "$ACTION3, $ACTION4 - next blue shape, next orange shape",
        "$ACTION5 - push the blue shape out, by what the library says",
        "$LEFT, $RIGHT, $UP, $DOWN - move the blue shape",
        "$LEFT2, $RIGHT2, $UP2, $DOWN2 - turn it",
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Collide");
    RRenderSetAppName(rc, "Collide");
    RRenderCreateUserHelp(rc, help, 6);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, nextDriven, 0);
    RRenderSetActionNCallBack(rc, 4, nextFixed, 0);
    RRenderSetActionNCallBack(rc, 5, pushOut, 0);
    RRenderSetLeftCallBack(rc, left, 0);
    RRenderSetRightCallBack(rc, right, 0);
    RRenderSetUpCallBack(rc, up, 0);
    RRenderSetDownCallBack(rc, down, 0);
    RRenderSetUp2CallBack(rc, rollForward, 0);
    RRenderSetDown2CallBack(rc, rollBack, 0);
    RRenderSetLeft2CallBack(rc, rollLeft, 0);
    RRenderSetRight2CallBack(rc, rollRight, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createGeometries();
    chooseFixed(BOX);
    chooseDriven(BOX);
    makePair();
    createGraphics();
    createControls();

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
