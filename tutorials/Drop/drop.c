/* Drop: a ball falls freely (Dynamics guide, chapter 2, "The Mdt Library: Getting Started").
 *
 * The smallest complete program: a world, a body, gravity, and a picture of it. What you see is a strobe
 * photograph. The ball leaves a pale image of itself every 0.18 seconds, and the images lie further and
 * further apart: the distance fallen grows with the square of the time.
 *
 * A body has mass and motion, but no shape. The sphere exists only in the viewer; for dynamics the ball is a
 * point with a moment of inertia, and nothing would stop it at the ground. Bounce shows how to make a floor.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include <stdio.h>
#include <stdlib.h>

#define RADIUS 1.0f /* m */
#define START  18   /* m, the height from which the ball falls */
#define STROBE 6    /* steps from one image to the next */
#define IMAGES 11   /* enough until the ball is at the ground */

/* The length of a step, in seconds: how far each call of Tick moves the world on. */
static const MeReal step = (MeReal)0.03;

/* Everything that dynamics knows. */
static MdtWorldID world;
static MdtBodyID body;

/* Everything that the viewer knows. */
static RRender *rc;
static RGraphic *sphereG;
static RGraphic *imageG[IMAGES];
static MeMatrix4 imageTM[IMAGES]; /* where the images are */

static int steps;  /* since the ball was let go */
static int images; /* shown so far */

static void hideImages(void) {
    while (images > 0)
        RGraphicRemoveFromList(rc, imageG[--images], 0);
}

/* Called when the user presses Enter, and at the start: puts the body where it begins. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodySetPosition(body, 0, START, 0);
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodySetQuaternion(body, 1, 0, 0, 0);
    MdtBodyEnable(body);
    steps = 0;
    hideImages();
}

/* Leaves an image of the ball where it is now. */
static void strobe(void) {
    if (images == IMAGES)
        return;
    MdtBodyGetTransform(body, imageTM[images]);
    RGraphicAddToList(rc, imageG[images++], 0);
}

static void showFigures(void) {
    char text[100];
    MeVector3 position, velocity;
    MdtBodyGetPosition(body, position);
    MdtBodyGetLinearVelocity(body, velocity);
    snprintf(text, sizeof text, "t = %.2f s    height %.2f m    speed %.2f m/s", steps * (double)step,
             (double)position[1], -(double)velocity[1]);
    RRenderSetStatusText(rc, text);
}

/* The viewer calls this before each picture: move the world on by one step. The sphere follows by itself,
 * since it was given a pointer to the body's transform. */
static void MEAPI Tick(RRender *context) {
    (void)context;
    if (steps % STROBE == 0)
        strobe();
    MdtWorldStep(world, step);
    steps++;
    showFigures();
    if (MdtBodyGetTransformPtr(body)[3][1] < RADIUS) /* at the ground, y = 0 */
        Reset(rc, 0);
}

/* The viewer ends the program by itself, so what has to be cleaned up is given to atexit. */
static void MEAPI_CDECL cleanup(void) {
    for (int i = 0; i < IMAGES; i++)
        RGraphicDestroy(imageG[i]); /* those in no list are ours */
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world); /* with all that is in it */
}

static void createDynamics(void) {
    world = MdtWorldCreate(1, 0); /* room for one body and no constraints */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    body = MdtBodyCreate(world); /* 1 kg; a new body is disabled until MdtBodyEnable */
}

/* A ruler beside the ball: a mark every metre, a longer one every fifth. */
static void createRuler(void) {
    const float grey[4] = {.35f, .37f, .40f, 1};
    const float x = -2.5f;
    const float top[3] = {x, START, 0}, bottom[3] = {x, 0, 0};
    RGraphicLineCreate(rc, top, bottom, grey, 0);
    for (int y = 0; y <= START; y++) {
        const float from[3] = {x, (float)y, 0}, to[3] = {x + (y % 5 == 0 ? 1.2f : .6f), (float)y, 0};
        RGraphicLineCreate(rc, from, to, grey, 0);
    }
}

static void createGraphics(void) {
    const float *blue = RPalette[0];
    const float pale[4] = {blue[0], blue[1], blue[2], .3f}, ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, 8.8f, 0};
    sphereG = RGraphicSphereCreate(rc, RADIUS, blue, MdtBodyGetTransformPtr(body));
    for (int i = 0; i < IMAGES; i++) {
        imageG[i] = RGraphicSphereCreate(rc, RADIUS, pale, imageTM[i]);
        RGraphicRemoveFromList(rc, imageG[i], 0);
    }
    createRuler();
    RGraphicGroundPlaneCreate(rc, 100, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 31, .35f, .14f);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    const char *help[] = {
        "A ball falls freely.",
        "It leaves an image of itself every 0.18 s.",
        "$ACTION2 - start again",
    };
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    RRenderSetWindowTitle(rc, "Karma tutorial: Drop");
    RRenderSetAppName(rc, "Drop");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);

    createDynamics();
    createGraphics();
    Reset(rc, 0);

    atexit(cleanup);
    RRenderSetTickRate(rc, (AcmeReal)(1 / step));
    RRun(rc, Tick); /* does not return */
    return 0;
}
