/* Friction: one incline, three models of friction (Dynamics guide, chapter 3, "Simulating Friction").
 *
 *   - box model, blue: the force along each direction of the surface has a fixed bound, whatever presses the box down.
 *     It is made to fit a slope of 25 degrees, and is too weak or too strong on any other.
 *   - normal force, orange: the bound is the coefficient times the force that presses the box down: Coulomb's law,
 *     for each of the two directions by itself. Slantwise it holds more: up to 1.41 times as much.
 *   - cone, green: the same for both directions together. It is as strong whichever way the box is pulled.
 * The boxes lie askew to the contacts' directions, as it mostly happens. The coefficient is 0.4663, the tangent of 25
 * degrees, so the green box slides as soon as the slope is steeper than that. The slope is 24 degrees first, then 30,
 * then 36, and so on, until you set it.
 */
#include "box_on_plane.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { BOX, NORMAL_FORCE, CONE, MODELS, NONE = -1 };

static const MeReal step = (MeReal)(1.0 / 60);     /* s */
static const MeReal size[3] = {1, (MeReal)0.5, 1}; /* m */
static MeReal coefficient = (MeReal)0.46630766;    /* tan of 25 degrees */
static const MeReal length = 12;                   /* m, of the slope */

static MdtWorldID world;
static BoxOnPlane box[MODELS];
static Plane slope;
static MeReal degrees = 24;
static int shown; /* frames, while the slope changes by itself; NONE: a key was pressed */

static RRender *rc;
static MeMatrix4 slopeTM;

static MeReal radians(void) {
    return degrees * ME_PI / 180;
}

/* Down along x. The contacts' primary direction lies 45 degrees off the way down. */
static void setSlope(void) {
    const MeReal s = MeSin(radians()), c = MeCos(radians()), slant = MeSqrt((MeReal)0.5);
    const Plane made = {{0, length / 2 * s, 0}, {s, c, 0}, {slant * c, -slant * s, slant}};
    MeMatrix3 R;
    slope = made;
    MeMatrix3MakeRotationZ(R, -radians());
    MeMatrix4TMMakeFromRotationAndPosition(slopeTM, R, -s * (MeReal)0.1, length / 2 * s - c * (MeReal)0.1, 0);
}

/* Near the upper end, resting on the slope. */
static void placeBox(int i) {
    const MeReal s = MeSin(radians()), c = MeCos(radians()), up = length / 2 - 1, half = size[1] / 2;
    MdtBodySetPosition(box[i].body, -up * c + half * s, (length / 2 + up) * s + half * c,
                       (MeReal)1.6 * (MeReal)(i - 1));
    MdtBodySetQuaternion(box[i].body, MeCos(radians() / 2), 0, 0, -MeSin(radians() / 2));
    MdtBodySetLinearVelocity(box[i].body, 0, 0, 0);
    MdtBodySetAngularVelocity(box[i].body, 0, 0, 0);
    MdtBodyEnable(box[i].body);
}

static void begin(MeReal slopeDegrees) {
    degrees = slopeDegrees;
    setSlope();
    for (int i = 0; i < MODELS; i++)
        placeBox(i);
}

/* The box model wants forces: what a quarter of the weight gives on a slope of 25 degrees, for each of four contacts,
 * and of that the part for each of two directions at 45 degrees. */
static void setCoefficient(void) {
    for (int i = 0; i < MODELS; i++)
        MdtContactParamsSetFrictionCoeffecient(&box[i].params, coefficient);
    MdtContactParamsSetFriction(&box[BOX].params,
                                coefficient * (MeReal)9.8 / 4 * MeCos(25 * ME_PI / 180) * MeSqrt((MeReal)0.5));
}

/* Also called when the user has changed a number. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    setCoefficient();
    begin(degrees);
}

/* All hold at 24 degrees, and the normal force alone at 30, for as long as it takes to see that. */
static void tiltByItself(void) {
    enum { HOLDS = 75, SLIDES = 210, ALL = HOLDS + 2 * SLIDES };
    if (shown == NONE)
        return;
    if (shown % ALL == 0)
        begin(24);
    else if (shown % ALL == HOLDS)
        begin(30);
    else if (shown % ALL == HOLDS + SLIDES)
        begin(36);
    shown++;
}

/* How fast it slides down. */
static double speedOf(int i) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(box[i].body, v);
    return (double)v[0] * cos((double)radians()) - (double)v[1] * sin((double)radians());
}

static void showFigures(void) {
    char text[160];
    snprintf(
        text, sizeof text,
        "slope %.0f deg    box model %.3f m/s    normal force %.3f m/s    cone %.3f m/s    friction coefficient %.4f",
        (double)degrees, speedOf(BOX), speedOf(NORMAL_FORCE), speedOf(CONE), (double)coefficient);
    RRenderSetStatusText(rc, text);
}

/* At the lower end of the slope. */
static void bringBack(int i) {
    if (MdtBodyGetTransformPtr(box[i].body)[3][0] > (length / 2 - 1) * MeCos(radians()))
        placeBox(i);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    tiltByItself();
    for (int i = 0; i < MODELS; i++)
        boxTouchPlane(&box[i], &slope);
    MdtWorldStep(world, step);
    showFigures();
    for (int i = 0; i < MODELS; i++)
        bringBack(i);
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    world = MdtWorldCreate(MODELS, MODELS * 9); /* a group and up to eight contacts for each box */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* or a box that starts to slide slowly would be taken to rest */
    for (int i = 0; i < MODELS; i++) {
        static const MdtFrictionModel model[MODELS] = {MdtFrictionModelBox, MdtFrictionModelNormalForce,
                                                       MdtFrictionModelCone};
        MdtContactParamsID p = &box[i].params;
        boxCreate(&box[i], world, size, 1);
        MdtContactParamsSetType(p, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(p, model[i]);
    }
    setCoefficient();
}

/* What each box is, above it. */
static void MEAPI nameBoxes(RRender *context, void *userdata) {
    static const float dark[4] = {.10f, .12f, .15f, 1};
    static const char *const names[MODELS] = {"box", "normal force", "cone"};
    (void)userdata;
    for (int i = 0; i < MODELS; i++) {
        MeVector3 above;
        MeVector3Copy(above, MdtBodyGetTransformPtr(box[i].body)[3]);
        above[1] += (MeReal)0.8 * size[1];
        RMarkText(context, above, names[i], dark);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, wood[4] = {.80f, .74f, .64f, 1};
    const AcmeVector3 lookAt = {0, 2.4f, 0};
    RGraphicBoxCreate(rc, (float)length, .2f, 5.4f, wood, slopeTM);
    for (int i = 0; i < MODELS; i++)
        RGraphicBoxCreate(rc, (float)size[0], (float)size[1], (float)size[2], RPalette[i],
                          MdtBodyGetTransformPtr(box[i].body));
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, -.3f);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 14.5f, .35f, .35f);
    RRenderSetMarkCallBack(rc, nameBoxes, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "Three models of friction on one slope.",
        "$ACTION2 - start again",
    };
    static const RParameter parameters[] = {
        {"the slope", "degrees", &degrees, 5, 45, 1, .less = "Down", .more = "Up", .changed = Reset},
        {"friction coefficient", 0, &coefficient, 0, 1, (MeReal)0.01, .less = "Left", .more = "Right",
         .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Friction");
    RRenderSetAppName(rc, "Friction");
    RRenderCreateUserHelp(rc, help, 2);
    RRenderCreateParameters(rc, parameters, 2);
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
    shown = 0;

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
