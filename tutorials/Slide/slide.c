/* Slide: a conveyor belt (Dynamics guide, chapter 3, "Slip: An Alternate Way to Model Friction").
 *
 * The belt does not move at all. Its contacts are told that their surface has a speed along their primary direction:
 * the slide. Friction then pulls each box to that speed. How hard it pulls is up to the friction: the three boxes have
 * coefficients of 0.1, 0.3 and 0.9, and take their time accordingly. The yellow stripe goes with the belt from where
 * the boxes began: a box stays behind it by what it has lost until it moved along, v² / (2 friction g).
 */
#include "box_on_plane.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { BOXES = 3 };

static const MeReal step = (MeReal)(1.0 / 60);               /* s */
static const MeReal size[3] = {1, (MeReal)0.7, (MeReal)0.8}; /* m */
static const MeReal friction[BOXES] = {(MeReal)0.1, (MeReal)0.3, (MeReal)0.9};
static const MeReal beltLength = 18; /* m */
static const Plane belt = {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}};

static MdtWorldID world;
static BoxOnPlane box[BOXES];
static MeReal speed = 2; /* m/s, of the belt along x */

static RRender *rc;
static MeMatrix4 slatTM[18];
static MeReal beltMoved; /* m */
static MeMatrix4 stripeTM;
static MeReal stripeAt; /* m, of the stripe along the belt */

static MeReal laneOf(int i) {
    return (MeReal)1.3 * (MeReal)(i - 1);
}

static void placeBox(int i) {
    MdtBodySetPosition(box[i].body, -beltLength / 2 + 1, 1 + size[1] / 2, laneOf(i));
    MdtBodySetQuaternion(box[i].body, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(box[i].body, 0, 0, 0);
    MdtBodySetAngularVelocity(box[i].body, 0, 0, 0);
    MdtBodyEnable(box[i].body);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++)
        placeBox(i);
    stripeAt = 1 - beltLength / 2;
}

static void MEAPI applySpeed(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++) {
        /* The surface moves against the box, so the box is to move along with it: the slide is its speed. */
        MdtContactParamsSetPrimarySlide(&box[i].params, speed);
        MdtBodyEnable(box[i].body); /* a box at rest on a belt that stands still may have been disabled */
    }
}

/* A box that has left the belt starts again at its beginning. */
static void bringBack(int i) {
    MeVector3 p;
    MdtBodyGetPosition(box[i].body, p);
    if (MeFabs(p[0]) > beltLength / 2)
        placeBox(i);
}

/* The slats show how the belt would move if it did. */
static void moveSlats(void) {
    beltMoved += speed * step;
    stripeAt = MeCLAMP(stripeAt + speed * step, -beltLength / 2, beltLength / 2);
    MeMatrix4TMMakeIdentity(stripeTM);
    MeMatrix4TMSetPosition(stripeTM, stripeAt, 1, 0);
    for (int i = 0; i < 18; i++) {
        const MeReal x = (MeReal)fmod((double)((MeReal)i + beltMoved) + 1800, 18) - beltLength / 2;
        MeMatrix4TMMakeIdentity(slatTM[i]);
        MeMatrix4TMSetPosition(slatTM[i], x, (MeReal)0.995, 0);
    }
}

static double speedOf(int i) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(box[i].body, v);
    return v[0];
}

static void showFigures(void) {
    char text[160];
    snprintf(text, sizeof text,
             "belt %.2f m/s    boxes: blue %.3f m/s (friction 0.1)    orange %.3f m/s (0.3)    green %.3f m/s (0.9)",
             (double)speed, speedOf(0), speedOf(1), speedOf(2));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int i = 0; i < BOXES; i++)
        boxTouchPlane(&box[i], &belt);
    MdtWorldStep(world, step);
    for (int i = 0; i < BOXES; i++)
        bringBack(i);
    moveSlats();
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
        MdtContactParamsSetSurface(&box[i].params, friction[i], 0);
    }
    applySpeed(0, 0);
}

/* What each box is, beside it. */
static void MEAPI nameBoxes(RRender *context, void *userdata) {
    static const float white[4] = {1, 1, 1, 1};
    static const char *const names[BOXES] = {"friction 0.1", "friction 0.3", "friction 0.9"};
    (void)userdata;
    for (int i = 0; i < BOXES; i++) {
        MeVector3 beside;
        MeVector3Copy(beside, MdtBodyGetTransformPtr(box[i].body)[3]);
        beside[0] += (MeReal)0.6 * size[0]; /* beside it, over the dark belt */
        RMarkText(context, beside, names[i], white);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1}, dark[4] = {.30f, .31f, .33f, 1};
    const float yellow[4] = {.95f, .80f, .20f, 1};
    const AcmeVector3 lookAt = {.6f, 0, 0};
    static MeMatrix4 beltTM, rollerTM[2];
    MeMatrix3 R;
    MeMatrix4TMMakeIdentity(beltTM);
    MeMatrix4TMSetPosition(beltTM, 0, (MeReal)0.9, 0);
    RGraphicBoxCreate(rc, (float)beltLength, .18f, 4.2f, dark, beltTM);
    for (int i = 0; i < 18; i++)
        RGraphicBoxCreate(rc, .08f, .02f, 4.2f, grey, slatTM[i]);
    RGraphicBoxCreate(rc, .12f, .03f, 4.2f, yellow, stripeTM);
    MeMatrix3MakeRotationX(R, 0);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeFromRotationAndPosition(rollerTM[i], R, i == 0 ? -beltLength / 2 : beltLength / 2, (MeReal)0.8,
                                               0);
        RGraphicCylinderCreate(rc, .28f, 4.2f, grey, rollerTM[i]);
    }
    for (int i = 0; i < BOXES; i++)
        RGraphicBoxCreate(rc, (float)size[0], (float)size[1], (float)size[2], RPalette[i],
                          MdtBodyGetTransformPtr(box[i].body));
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 18.5f, .3f, .68f);
    RRenderSetMarkCallBack(rc, nameBoxes, 0);
    moveSlats();
}

static void createControls(void) {
    static const char *const help[] = {
        "A conveyor belt takes boxes along; the stripe goes with it.",
        "$ACTION2 - start again",
    };
    static const RParameter parameters[] = {
        {"the belt's speed", "m/s", &speed, -4, 4, (MeReal)0.5, .less = "Down", .more = "Up", .changed = applySpeed},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Slide");
    RRenderSetAppName(rc, "Slide");
    RRenderCreateUserHelp(rc, help, 2);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
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
