/* Slip: a surface on which a push gives a speed, not an acceleration (Dynamics guide, chapter 3, "Slip: An Alternate
 * Way to Model Friction").
 *
 * A contact with slip lets its bodies move against each other at a speed of slip times the force that it passes. It is
 * made for tyres, which drift sideways the harder they are pushed. Here both boxes are pushed with the same force: the
 * blue one stands on slip and has its speed almost at once, within slip times mass seconds; the orange one stands on
 * ice, without any friction, and gains speed for as long as it is pushed. Let go, and the blue one stops.
 */
#include "box_on_plane.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { SLIPPERY, ICY, BOXES };

static const MeReal step = (MeReal)(1.0 / 60);                 /* s */
static const MeReal size[3] = {(MeReal)1.2, (MeReal)0.6, 1};   /* m */
static const MeReal mass = (MeReal)0.2;                        /* kg */
static const MeReal lane[BOXES] = {(MeReal)1.2, (MeReal)-1.2}; /* m, z */
static const MeReal begin = -8, end = 8;                       /* m, x */
static const Plane floorPlane = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};

static MdtWorldID world;
static BoxOnPlane box[BOXES];
static MeReal force = 1; /* N, along x */
static MeReal slip = 1;  /* m/s per N, of the whole box */
static int isPushed = 1;

static RRender *rc;

static void placeBox(int i) {
    MdtBodySetPosition(box[i].body, begin, size[1] / 2, lane[i]);
    MdtBodySetQuaternion(box[i].body, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(box[i].body, 0, 0, 0);
    MdtBodySetAngularVelocity(box[i].body, 0, 0, 0);
    MdtBodyEnable(box[i].body);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++)
        placeBox(i);
}

/* The box stands on four contacts, which share its push: each of them has to give way four times as easily. */
static void MEAPI applySlip(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtContactParamsSetSlip(&box[SLIPPERY].params, 4 * slip);
}

static void MEAPI toggle(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isPushed = !isPushed;
}

/* At the height of the floor, so that the box does not tip. Enabled, since a push does not wake a body that rests. */
static void push(int i) {
    MeVector3 p;
    MdtBodyEnable(box[i].body);
    MdtBodyGetPosition(box[i].body, p);
    if (isPushed)
        MdtBodyAddForceAtPosition(box[i].body, force, 0, 0, p[0], 0, p[2]);
}

static void bringBack(int i) {
    MeVector3 p;
    MdtBodyGetPosition(box[i].body, p);
    if (p[0] > end)
        placeBox(i);
}

static double speedOf(int i) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(box[i].body, v);
    return v[0];
}

/* What the surface does to the box, along x. */
static double dragOf(int i) {
    MeVector3 f;
    MdtContactGroupGetForce(box[i].group, 0, f);
    return f[0];
}

static void showFigures(void) {
    char text[160];
    snprintf(text, sizeof text,
             "force %.2f N    slip %.2f m/s per N    blue: %.4f m/s, the surface drags with %.4f N    orange, on ice: "
             "%.3f m/s",
             isPushed ? (double)force : 0, (double)slip, speedOf(SLIPPERY), -dragOf(SLIPPERY), speedOf(ICY));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int i = 0; i < BOXES; i++) {
        push(i);
        boxTouchPlane(&box[i], &floorPlane);
    }
    MdtWorldStep(world, step);
    showFigures();
    for (int i = 0; i < BOXES; i++)
        bringBack(i);
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    world = MdtWorldCreate(BOXES, BOXES * 9); /* a group and up to eight contacts for each box */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    for (int i = 0; i < BOXES; i++)
        boxCreate(&box[i], world, size, mass);
    MdtContactParamsSetType(&box[SLIPPERY].params,
                            MdtContactTypeFriction2D); /* of unlimited strength, but for the slip */
    applySlip(0, 0);
}

/* What each box is, above it. */
static void MEAPI nameBoxes(RRender *context, void *userdata) {
    static const float dark[4] = {.10f, .12f, .15f, 1};
    static const char *const names[BOXES] = {"slip", "ice"};
    (void)userdata;
    for (int i = 0; i < BOXES; i++) {
        MeVector3 above;
        MeVector3Copy(above, MdtBodyGetTransformPtr(box[i].body)[3]);
        above[1] += (MeReal)0.8 * size[1];
        RMarkText(context, above, names[i], dark);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, wet[4] = {.60f, .72f, .80f, 1}, ice[4] = {.88f, .92f, .95f, 1};
    const AcmeVector3 lookAt = {.5f, .3f, 0};
    static MeMatrix4 stripTM[BOXES];
    for (int i = 0; i < BOXES; i++) {
        MeMatrix4TMMakeIdentity(stripTM[i]);
        MeMatrix4TMSetPosition(stripTM[i], 0, (MeReal)-0.04, lane[i]);
        RGraphicBoxCreate(rc, (float)(end - begin) + 3, .1f, 1.8f, i == SLIPPERY ? wet : ice, stripTM[i]);
        RGraphicBoxCreate(rc, (float)size[0], (float)size[1], (float)size[2], RPalette[i],
                          MdtBodyGetTransformPtr(box[i].body));
    }
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 18, .3f, .3f);
    RRenderSetMarkCallBack(rc, nameBoxes, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "Two boxes are pushed: over a slippery surface, and over ice.",
        "$ACTION2 - start again",
        "$ACTION3 - push, let go",
    };
    static const RParameter parameters[] = {
        {"the force", "N", &force, 0, 3, (MeReal)0.25, .less = "Down", .more = "Up"},
        {"the slip", "m/s per N", &slip, 0, 2, (MeReal)0.25, .less = "Left", .more = "Right", .changed = applySlip},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Slip");
    RRenderSetAppName(rc, "Slip");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggle, 0);
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
