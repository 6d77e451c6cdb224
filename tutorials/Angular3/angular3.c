/* Angular3: four hopping tops, three of them kept upright (Dynamics guide, chapter 3, "MdtAngular3").
 *
 * An angular joint keeps the orientation of a body, here against the world, and leaves it free to move. It has no
 * position. From left to right:
 *   - no joint: what is struck off its middle tumbles;
 *   - rigid: it does not turn at all;
 *   - springy, with a finite stiffness and damping: it rocks and comes back;
 *   - with the rotation about its axis enabled: it spins, and stays upright.
 * All four are the same otherwise, hop on their round feet, whose contacts the program makes as Bounce does, and get
 * the same blows: key 3 strikes them off their middle, key 4 throws them up again.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { FREE, RIGID, SPRINGY, SPINNING, KINDS };
enum { FOOT, HEAD };

static const MeReal step = (MeReal)(1.0 / 60); /* s */
static const MeReal radius = (MeReal)0.5;      /* m, of the round foot, in whose middle the centre of mass is */
static const MeReal inertia = (MeReal)0.2;     /* kg m^2, about every axis; the mass is 1 kg */
static const MeReal headRadius = (MeReal)0.2, headHeight = (MeReal)1.25; /* m; it is above that middle */
static const MeReal spacing = (MeReal)2.3;                               /* m */
static const MeReal restitution = (MeReal)0.85;

static MdtWorldID world;
static MdtBodyID top[KINDS];
static MdtAngular3ID joint[KINDS];     /* 0 for the free one */
static MdtContactID contact[KINDS][2]; /* of the last step, at foot and head */

static MeReal stiffness = 20;        /* N m/rad */
static MeReal damping = (MeReal)0.2; /* N m s/rad */

static RRender *rc;

static MeReal placeX(int i) {
    return spacing * ((MeReal)i - (MeReal)1.5);
}

/* A blow to the rim, towards the viewer's left and downward: an impulse of rotation, in N m s. */
static void MEAPI strike(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < KINDS; i++) {
        MeVector3 w;
        MdtBodyGetAngularVelocity(top[i], w);
        MdtBodySetAngularVelocity(top[i], w[0], w[1] + 5, w[2] + 7);
        MdtBodyEnable(top[i]);
    }
}

static void MEAPI throwUp(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < KINDS; i++) {
        MeVector3 v;
        MdtBodyGetLinearVelocity(top[i], v);
        MdtBodySetLinearVelocity(top[i], v[0], 6, v[2]);
        MdtBodyEnable(top[i]);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    for (int i = 0; i < KINDS; i++) {
        MdtBodySetPosition(top[i], placeX(i), radius, 0);
        MdtBodySetQuaternion(top[i], 1, 0, 0, 0);
        MdtBodySetLinearVelocity(top[i], 0, 0, 0);
        MdtBodySetAngularVelocity(top[i], 0, 0, 0);
    }
    throwUp(context, userdata);
    strike(context, userdata);
}

static void MEAPI applySettings(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtAngular3SetStiffness(joint[SPRINGY], stiffness);
    MdtAngular3SetDamping(joint[SPRINGY], damping);
}

/* The balls at the foot and at the head may touch the ground with their lowest points. There is no friction, and a
 * force at the foot goes through the centre of mass: the ground does not turn a top that stands. */
static void renewContact(int i, int end) {
    const MeVector3 middle = {0, end == FOOT ? 0 : headHeight, 0};
    const MeReal r = end == FOOT ? radius : headRadius;
    MeVector3 at;
    MeMatrix4TMTransform(at, MdtBodyGetTransformPtr(top[i]), middle);
    MdtContactID *c = &contact[i][end];
    if (*c) {
        MdtContactDisable(*c);
        MdtContactDestroy(*c);
        *c = 0;
    }
    if (at[1] > r)
        return;
    *c = MdtContactCreate(world, top[i], 0);
    MdtContactSetPosition(*c, at[0], at[1] - r, at[2]);
    MdtContactSetNormal(*c, 0, 1, 0);
    MdtContactSetPenetration(*c, r - at[1]);
    MdtContactParamsSetRestitution(MdtContactGetParams(*c), restitution);
    MdtContactEnable(*c);
}

/* How far a top leans, in degrees. */
static double leanOf(int i) {
    const MeReal *y = MdtBodyGetTransformPtr(top[i])[1];
    return atan2(sqrt((double)y[0] * y[0] + (double)y[2] * y[2]), (double)y[1]) * 180 / (double)ME_PI;
}

static void showFigures(void) {
    static const char *const name[KINDS] = {"free", "rigid", "springy", "spinning"};
    char text[220];
    int n = snprintf(text, sizeof text,
                     "height %.2f m    leans (deg):", (double)(MdtBodyGetTransformPtr(top[0])[3][1] - radius));
    MeVector3 w;
    for (int i = 0; i < KINDS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %s %.2f ", name[i], leanOf(i));
    MdtBodyGetAngularVelocity(top[SPINNING], w);
    snprintf(text + n, sizeof text - (size_t)n, "  spin %.2f rad/s    stiffness %.0f    damping %.1f", (double)w[1],
             (double)stiffness, (double)damping);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int i = 0; i < 2 * KINDS; i++)
        renewContact(i / 2, i % 2);
    MdtWorldStep(world, step);
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

/* The orientation that a joint keeps is the one that the body has when it is attached. */
static void createJoint(int i) {
    joint[i] = MdtAngular3Create(world);
    MdtAngular3SetBodies(joint[i], top[i], 0);
    MdtAngular3SetAxis(joint[i], 0, 1, 0);
    MdtAngular3EnableRotation(joint[i], i == SPINNING);
    MdtAngular3Enable(joint[i]);
}

static void createDynamics(void) {
    world = MdtWorldCreate(KINDS, 3 * KINDS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* slow rocking goes on */
    for (int i = 0; i < KINDS; i++) {
        top[i] = MdtBodyCreate(world);
        MdtBodySetSphericalInertiaTensor(top[i], inertia);
        if (i != FREE)
            createJoint(i);
    }
    applySettings(0, 0);
}

/* A ball for a foot, a body that narrows towards the top, a head, and two arms, so that one sees it turn. */
static void createTopGraphics(int i, const float *color) {
    static MeMatrix4 upright;
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(top[i]);
    const MeVector3 head = {0, headHeight, 0}, shoulders = {0, (MeReal)0.75, 0};
    RGraphic *foot = RGraphicSphereCreate(rc, (float)radius, color, tm);
    RGraphic *body = RGraphicFrustumCreate(rc, (float)radius * .92f, .12f, .2f, 1.15f, 48, color, 0);
    MeMatrix4TMFromEulerAnglesAndPosition(upright, -ME_PI / 2, 0, 0, 0, 0, 0);
    RGraphicSetTransformPtr(RGraphicCombine(rc, foot, body, upright), tm);
    RGraphicDelete(rc, foot, 0);
    RGraphicDelete(rc, body, 0);
    RGraphicTranslateVertices(rc, RGraphicSphereCreate(rc, (float)headRadius, RPalette[4], tm), head);
    RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, 1.1f, .12f, .12f, RPalette[7], tm), shoulders);
}

static void createGraphics(void) {
    static const int colorOf[KINDS] = {3, 0, 2, 1};
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, 1.5f, 0};
    for (int i = 0; i < KINDS; i++)
        createTopGraphics(i, RPalette[colorOf[i]]);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 9.6f, .25f, .16f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Four hopping tops, three of them kept upright.",
        "$ACTION2 - start again",
        "$ACTION3 - strike them off their middle",
        "$ACTION4 - throw them up",
    };
    static const RParameter parameters[] = {
        {"stiffness of the springy one", "N m/rad", &stiffness, 5, 80, 5, .less = "Down", .more = "Up",
         .changed = applySettings},
        {"its damping", "N m s/rad", &damping, 0, 2, (MeReal)0.1, .less = "Left", .more = "Right",
         .changed = applySettings},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Angular3");
    RRenderSetAppName(rc, "Angular3");
    RRenderCreateUserHelp(rc, help, 4);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, strike, 0);
    RRenderSetActionNCallBack(rc, 4, throwUp, 0);
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
