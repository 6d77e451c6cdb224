/* Rays: what a line of sight meets (User Guide, chapter 4, "Querying Line Segment Intersections").
 *
 * A lamp in the middle of a room of models sends rays all round. Each ends where it enters the first model; a short
 * line shows the surface's normal there. One more ray, red, goes round like a radar's and is asked for everything on
 * its way: every model that it enters gets a cross.
 *   key 3   glass: the filter callback lets rays through the transparent models
 *   key 4   the rays as thick as a ball: a shape is cast instead
 */
#include "RGeometry.h"
#include "Mcd.h"
#include "MeViewer.h"
#include <stdio.h>
#include <stdlib.h>

enum { RAYS = 90, MODELS = 9, MAX_HITS = 16 };

static const MeReal range = 9;                /* m */
static const MeReal thickness = (MeReal)0.15; /* m, radius of a thick ray */
static const MeReal stride = (MeReal)0.05;    /* m */
static const MeReal turning = (MeReal)0.01;   /* rad for each frame */

static McdFrameworkID frame;
static McdSpaceID space;
static McdModelID model[MODELS];
static MeMatrix4 tm[MODELS];
static McdGeometryID ball; /* what thick rays are made of */
static MeVector3 lamp, lampAtFirst = {0, (MeReal)0.6, 0};
static MeReal radar;
static MeBool seesThroughGlass, isThick;
static int hits, radarHits;
static MeReal nearest;

static RRender *rc;
static MeMatrix4 lampTM;

/* ---- the room --------------------------------------------------------------------------------------------------- */

static const struct {
    int type;
    MeReal size[3]; /* as the type's create function wants them */
    MeReal x, z, turn;
    MeBool isGlass;
} room[MODELS] = {
    {kMcdGeometryTypeBox, {1, 2, 1}, 3, 1, (MeReal)0.4, MEFALSE},
    {kMcdGeometryTypeBox, {4, 2, (MeReal)0.2}, 0, -4, 0, MEFALSE},
    {kMcdGeometryTypeSphere, {1, 0, 0}, -3, (MeReal)-0.9, 0, MEFALSE},
    {kMcdGeometryTypeSphyl, {(MeReal)0.5, 1, 0}, -2, 3, 0, MEFALSE},
    {kMcdGeometryTypeCylinder, {(MeReal)0.6, 2, 0}, 2, (MeReal)-2.4, 0, MEFALSE},
    {kMcdGeometryTypeCone, {2, (MeReal)0.9, 0}, 1, 4, 0, MEFALSE},
    {kMcdGeometryTypeBox, {(MeReal)0.1, 2, 3}, (MeReal)1.8, (MeReal)0.8, (MeReal)0.4, METRUE},
    {kMcdGeometryTypeBox, {3, 2, (MeReal)0.1}, (MeReal)-1.2, (MeReal)1.8, (MeReal)-0.3, METRUE},
    {kMcdGeometryTypeSphere, {(MeReal)0.5, 0, 0}, (MeReal)5, -2, 0, MEFALSE},
};

static McdGeometryID makeGeometry(int i) {
    const MeReal *s = room[i].size;
    switch (room[i].type) {
    case kMcdGeometryTypeSphere:
        return McdSphereCreate(frame, s[0]);
    case kMcdGeometryTypeBox:
        return McdBoxCreate(frame, s[0], s[1], s[2]);
    case kMcdGeometryTypeCylinder:
        return McdCylinderCreate(frame, s[0], s[1]);
    case kMcdGeometryTypeSphyl:
        return McdSphylCreate(frame, s[0], s[1]);
    default:
        return McdConeCreate(frame, s[0], s[1]);
    }
}

/* Boxes turned about the vertical; what is round about z stands up. */
static void place(int i) {
    MeMatrix3 R;
    if (room[i].type == kMcdGeometryTypeBox)
        MeMatrix3MakeRotationY(R, room[i].turn);
    else
        MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(tm[i], R, room[i].x, (MeReal)0.6, room[i].z);
}

/* Nothing moves: the models are updated once, and frozen. */
static void createRoom(void) {
    frame = McdInit(0, MODELS, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, MODELS, MODELS * MODELS);
    ball = McdSphereCreate(frame, thickness);
    for (int i = 0; i < MODELS; i++) {
        place(i);
        model[i] = McdModelCreate(makeGeometry(i));
        McdModelSetTransformPtr(model[i], tm[i]);
        McdModelSetUserData(model[i], room[i].isGlass ? model : 0);
        McdSpaceInsertModel(space, model[i]);
        McdSpaceUpdateModel(model[i]);
        McdSpaceFreezeModel(model[i]);
    }
    McdSpaceBuild(space);
    McdSpaceEndChanges(space);
}

/* ---- rays ------------------------------------------------------------------------------------------------------- */

/* The filter: 0 for the models that the ray does not see. */
static int MEAPI isSeen(McdModelID cm, void *filterData) {
    (void)filterData;
    return !seesThroughGlass || !McdModelGetUserData(cm);
}

static void line(const MeReal *a, const MeReal *b, float red, float green, float blue) {
    const AcmeVector3 from = {(float)a[0], (float)a[1], (float)a[2]}, to = {(float)b[0], (float)b[1], (float)b[2]};
    RLineAdd(rc, from, to, red, green, blue);
}

static void drawNormal(const MeReal *at, const MeReal *normal) {
    MeVector3 end;
    MeVector3MultiplyScalar(end, normal, (MeReal)0.3);
    MeVector3Add(end, end, at);
    line(at, end, .2f, .9f, .3f);
}

static void drawCross(const MeReal *at) {
    for (int axis = 0; axis < 3; axis++) {
        MeVector3 a, b;
        MeVector3Copy(a, at);
        MeVector3Copy(b, at);
        a[axis] -= (MeReal)0.15;
        b[axis] += (MeReal)0.15;
        line(a, b, 1, 1, 1);
    }
}

static void aim(MeReal angle, MeVector3 end) {
    MeVector3Set(end, lamp[0] + range * MeCos(angle), lamp[1], lamp[2] + range * MeSin(angle));
}

/* A ray: the first model on the segment. Returns whether there is one. */
static MeBool castRay(MeVector3 end, MeReal *distance, MeVector3 normal) {
    McdLineSegIntersectResult hit;
    if (!McdSpaceGetLineSegFirstEnabledIntersection(space, lamp, end, isSeen, 0, &hit))
        return MEFALSE;
    MeVector3Copy(end, hit.position);
    MeVector3Copy(normal, hit.normal);
    *distance = hit.distance;
    return METRUE;
}

/* A ball sent the same way. Ends where its middle is when it touches. */
static MeBool castBall(MeVector3 end, MeReal *distance, MeVector3 normal) {
    MeMatrix4 start;
    MeVector3 way;
    McdCastResult hit;
    MeMatrix4TMMakeIdentity(start);
    MeMatrix4TMSetPosition(start, lamp[0], lamp[1], lamp[2]);
    MeVector3Subtract(way, end, lamp);
    if (!McdSpaceCastGeometry(space, ball, start, way, isSeen, 0, &hit))
        return MEFALSE;
    *distance = hit.fraction * range;
    for (int i = 0; i < 3; i++)
        end[i] = lamp[i] + hit.fraction * way[i];
    MeVector3Copy(normal, hit.normal);
    return METRUE;
}

static void castAround(void) {
    hits = 0;
    nearest = range;
    for (int i = 0; i < RAYS; i++) {
        MeVector3 end, normal;
        MeReal distance;
        aim(2 * ME_PI * (MeReal)i / RAYS, end);
        const MeBool isHit = isThick ? castBall(end, &distance, normal) : castRay(end, &distance, normal);
        line(lamp, end, .95f, .85f, .35f);
        if (!isHit)
            continue;
        hits++;
        nearest = MeMIN(nearest, distance);
        drawNormal(end, normal);
    }
}

/* All models on the way. */
static void castRadar(void) {
    McdLineSegIntersectResult all[MAX_HITS];
    MeVector3 end;
    aim(radar, end);
    line(lamp, end, 1, .2f, .2f);
    radarHits = McdSpaceGetLineSegIntersections(space, lamp, end, all, MAX_HITS);
    for (int i = 0; i < radarHits; i++)
        drawCross(all[i].position);
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MeVector3Copy(lamp, lampAtFirst);
    radar = 0;
}

static void MEAPI toggleGlass(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    seesThroughGlass = !seesThroughGlass;
}

static void MEAPI toggleThickness(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isThick = !isThick;
}

static void MEAPI left(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    lamp[0] -= stride;
}

static void MEAPI right(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    lamp[0] += stride;
}

static void MEAPI up(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    lamp[2] -= stride;
}

static void MEAPI down(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    lamp[2] += stride;
}

static void showFigures(void) {
    char text[160];
    snprintf(text, sizeof text, "%s rays %d    hits %d    nearest %.4f m    on the red one %d    glass %s",
             isThick ? "thick" : "thin", RAYS, hits, (double)nearest, radarHits,
             seesThroughGlass ? "is not seen" : "is seen");
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    RLineRemoveAll(rc);
    castAround();
    castRadar();
    showFigures();
    radar += turning;
    MeMatrix4TMSetPosition(lampTM, lamp[0], lamp[1], lamp[2]);
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    McdSpaceDestroy(space);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

static void createGraphics(void) {
    static const float stone[4] = {.62f, .64f, .70f, 1}, glass[4] = {.45f, .75f, .85f, .35f};
    static const float white[4] = {1, .95f, .7f, 1}, ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {.5f, 0, .4f};
    for (int i = 0; i < MODELS; i++)
        RGraphicCreateFromModel(rc, model[i], room[i].isGlass ? glass : stone);
    MeMatrix4TMMakeIdentity(lampTM);
    RGraphicSphereCreate(rc, .12f, white, lampTM);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, -.4f);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 17, .3f, .9f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Rays from a lamp: the first model on each, and all on the red one.",
        "$ACTION2 - back to the start",
        "$ACTION3 - rays go through glass, or not",
        "$ACTION4 - thin rays, or balls that are cast",
        "$LEFT, $RIGHT, $UP, $DOWN - move the lamp",
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Rays");
    RRenderSetAppName(rc, "Rays");
    RRenderCreateUserHelp(rc, help, 5);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleGlass, 0);
    RRenderSetActionNCallBack(rc, 4, toggleThickness, 0);
    RRenderSetLeftCallBack(rc, left, 0);
    RRenderSetRightCallBack(rc, right, 0);
    RRenderSetUpCallBack(rc, up, 0);
    RRenderSetDownCallBack(rc, down, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createRoom();
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
