/* AutoDisable: bodies that have come to rest cost nothing (Dynamics guide, chapter 4, "Enabling/Disabling Bodies").
 *
 * A partition whose bodies have been slower than the thresholds, and less accelerated, is disabled: it is not simulated
 * until something wakes it. Here boxes are dropped onto the floor. They turn grey as they come to rest, and get their
 * colour back when they are kicked, or when the threshold is so low that they are never slow enough.
 */
#include "box_on_plane.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { ROWS = 4, COLUMNS = 6, BOXES = ROWS * COLUMNS };

static const MeReal step = (MeReal)(1.0 / 60);                         /* s */
static const MeReal size[3] = {(MeReal)0.8, (MeReal)0.5, (MeReal)0.6}; /* m */
static const Plane floorPlane = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};
static MeReal threshold = (MeReal)0.02; /* m²/s², the guide's default */

static MdtWorldID world;
static BoxOnPlane box[BOXES];
static int next; /* to be kicked */

static RRender *rc;
static RGraphic *boxG[BOXES];

/* Above its place, turned a little, each one differently. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++) {
        const MeReal turn = (MeReal)(0.1 * (i * 7 % 5 - 2)), x = (MeReal)(i % COLUMNS), z = (MeReal)(i / COLUMNS);
        MdtBodySetPosition(box[i].body, (x - (MeReal)2.5) * (MeReal)1.5, (MeReal)0.6 + (MeReal)0.35 * (x + z),
                           (z - (MeReal)1.5) * (MeReal)1.5);
        MdtBodySetQuaternion(box[i].body, 1, turn, turn / 2, turn / 3);
        MdtBodySetLinearVelocity(box[i].body, 0, 0, 0);
        MdtBodySetAngularVelocity(box[i].body, 0, 0, 0);
        MdtBodyEnable(box[i].body);
    }
    next = 0;
}

/* An impulse wakes a body that would move for it. */
static void MEAPI kick(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodyAddImpulse(box[next].body, 0, 3, 0);
    next = (next + 1) % BOXES;
}

/* The thresholds are squares: 0.02 m²/s² is 14 cm/s. */
static void MEAPI applyThreshold(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtWorldSetAutoDisableVelocityThreshold(world, threshold);
    for (int i = 0; i < BOXES; i++) /* nothing is slower than 0 */
        MdtBodyEnable(box[i].body);
}

static void showBoxes(void) {
    for (int i = 0; i < BOXES; i++)
        RGraphicSetColor(boxG[i], RPalette[MdtBodyIsEnabled(box[i].body) ? i % 7 : 7]);
}

static void showFigures(void) {
    char text[120];
    snprintf(text, sizeof text, "enabled %d of %d bodies    velocity threshold %.3f m²/s²",
             MdtWorldGetEnabledBodies(world), BOXES, (double)MdtWorldGetAutoDisableVelocityThreshold(world));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int i = 0; i < BOXES; i++)
        if (MdtBodyIsEnabled(box[i].body)) /* a box at rest has still the contacts of its last step */
            boxTouchPlane(&box[i], &floorPlane);
    MdtWorldStep(world, step);
    showBoxes();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    world = MdtWorldCreate(BOXES, BOXES * 9); /* a group and up to eight contacts for each box */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    for (int i = 0; i < BOXES; i++) {
        boxCreate(&box[i], world, size, 1);
        MdtContactParamsSetSurface(&box[i].params, (MeReal)0.6, 0);
    }
}

static void MEAPI nameColors(RRender *context, void *userdata) {
    static const float dark[4] = {.10f, .12f, .15f, 1};
    static const MeVector3 place[2] = {{(MeReal)-5.5, 1, -3}, {(MeReal)-5.5, (MeReal)0.5, -3}};
    (void)userdata;
    RMarkPoint(context, place[0], RPalette[7], 12);
    RMarkText(context, place[0], "  at rest, disabled", dark);
    RMarkPoint(context, place[1], RPalette[1], 12);
    RMarkText(context, place[1], "  coloured: enabled", dark);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, .6f, 0};
    for (int i = 0; i < BOXES; i++)
        boxG[i] = RGraphicBoxCreate(rc, (float)size[0], (float)size[1], (float)size[2], RPalette[i % 7],
                                    MdtBodyGetTransformPtr(box[i].body));
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 10.5f, .4f, .36f);
    RRenderSetMarkCallBack(rc, nameColors, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "Boxes that have come to rest turn grey and cost nothing.",
        "$ACTION2 - start again",
        "$ACTION3 - kick the next one",
    };
    static const RParameter parameters[] = {
        {"threshold of the velocity", "m²/s²", &threshold, 0, (MeReal)0.06, (MeReal)0.02, .less = "Down", .more = "Up",
         .changed = applyThreshold},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: AutoDisable");
    RRenderSetAppName(rc, "AutoDisable");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, kick, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createDynamics();
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
