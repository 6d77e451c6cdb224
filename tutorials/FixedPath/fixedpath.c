/* FixedPath: a crane whose trolley follows a path (Dynamics guide, chapter 3, "MdtFixedPath").
 *
 * A fixed-path joint is a ball and socket whose place the program moves. There is no body for the trolley: the rod
 * hangs from a point of the world, and before every step the program says where that point is now and how fast it
 * moves. With the velocity the rod's top is on the path exactly. Without it (key 3) the joint only notices that it
 * has been left behind and mends a part of that, gamma, in every step: then it follows at a distance of
 * velocity * step / gamma.
 *
 * On the circle the load starts with the motion that it can keep: the rod's angle stays the same all the time. On the
 * figure of eight (key 4) it swings as any crane's load does.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define MAX_PATH 240 /* pieces of the line that the load leaves behind */

static const MeReal step = (MeReal)(1.0 / 60); /* s */
static const MeReal length = 3;                /* m, from the trolley to the load's centre */
static const MeReal height = 5;                /* m, of the trolley's hook above the ground */
static const MeReal loadSize = (MeReal)0.8;    /* m */
static const MeReal mass = 500;                /* kg */
static const MeReal gravity = (MeReal)9.8;     /* m/s^2 */

static MdtWorldID world;
static MdtBodyID load;
static MdtFixedPathID joint;

static MeReal omega = 1;  /* rad/s, of the path */
static MeReal radius = 2; /* m */
static MeReal phase;      /* rad */
static int isEight, hasNoVelocity;

static RRender *rc;
static MeMatrix4 trolleyTM, bridgeTM;
static MeVector3 pathEnd;
static int pathLength;

/* Where the path is at an angle, and how fast it moves on. */
static void pathAt(MeReal a, MeVector3 p, MeVector3 v) {
    const MeReal s = MeSin(a), c = MeCos(a), r = radius;
    if (isEight) {
        MeVector3Set(p, r * s, height, r * s * c);
        MeVector3Set(v, r * omega * c, 0, r * omega * (c * c - s * s));
    } else {
        MeVector3Set(p, r * c, height, -r * s);
        MeVector3Set(v, -r * omega * s, 0, -r * omega * c);
    }
}

/* The angle at which the load keeps going round with the trolley: gravity and the centripetal acceleration agree with
 * the direction of the rod, tan a = omega^2 (radius + length sin a) / g. Below the pendulum's own frequency it is
 * outward. */
static MeReal steadyAngle(void) {
    MeReal a = 0;
    for (int i = 0; i < 200; i++)
        a = MeAtan(omega * omega * (radius + length * MeSin(a)) / gravity);
    return a;
}

static void forgetPath(void) {
    RLineRemoveAll(rc);
    MdtBodyGetPosition(load, pathEnd);
    pathLength = 0;
    for (int i = 0; i < 96; i++) {
        MeVector3 p, v;
        AcmeVector3 from, to;
        for (int k = 0; k < 2; k++) {
            pathAt(2 * ME_PI * (MeReal)(i + k) / 96, p, v);
            for (int j = 0; j < 3; j++)
                (k ? to : from)[j] = (float)p[j];
        }
        RLineAdd(rc, from, to, RPalette[1][0], RPalette[1][1], RPalette[1][2]);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    const MeReal a = isEight ? 0 : steadyAngle(), out = length * MeSin(a);
    MeVector3 p, v;
    phase = 0;
    pathAt(0, p, v);
    MdtBodySetPosition(load, p[0] + out, p[1] - length * MeCos(a), p[2]);
    MdtBodySetQuaternion(load, MeCos(a / 2), 0, 0, MeSin(a / 2));
    MdtBodySetLinearVelocity(load, 0, 0, isEight ? 0 : -omega * (radius + out));
    MdtBodySetAngularVelocity(load, 0, isEight ? 0 : omega, 0);
    MdtBodyEnable(load);
    forgetPath();
}

static void MEAPI toggleVelocity(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    hasNoVelocity = !hasNoVelocity;
}

static void MEAPI otherPath(RRender *context, void *userdata) {
    isEight = !isEight;
    omega = isEight ? (MeReal)0.6 : 1; /* z goes twice as fast, which is near the pendulum's own frequency at 0.9 */
    Reset(context, userdata);
}

/* Before the step: where the path is now, and how fast it moves on. A step goes straight on, so it is given the
 * velocity that leads to the next point. */
static void movePath(void) {
    MeVector3 now, next, v;
    pathAt(phase, now, v);
    phase += omega * step;
    pathAt(phase, next, v);
    MdtFixedPathSetPosition(joint, 1, now[0], now[1], now[2]);
    if (hasNoVelocity)
        MdtFixedPathSetVelocity(joint, 1, 0, 0, 0);
    else
        MdtFixedPathSetVelocity(joint, 1, (next[0] - now[0]) / step, 0, (next[2] - now[2]) / step);
    MeMatrix4TMSetPosition(trolleyTM, next[0], height + (MeReal)0.25, next[2]);
    MeMatrix4TMSetPosition(bridgeTM, 0, height + (MeReal)0.5, next[2]);
}

/* Draws the way of the last step. */
static void drawPath(void) {
    const MeReal *now = MdtBodyGetTransformPtr(load)[3];
    const AcmeVector3 from = {(float)pathEnd[0], (float)pathEnd[1], (float)pathEnd[2]};
    const AcmeVector3 to = {(float)now[0], (float)now[1], (float)now[2]};
    if (pathLength++ < MAX_PATH)
        RLineAdd(rc, from, to, RPalette[0][0], RPalette[0][1], RPalette[0][2]);
    MdtBodyGetPosition(load, pathEnd);
}

static void showFigures(void) {
    char text[200];
    const MeVector3 topInRod = {0, length, 0};
    MeVector3 top, path, v, f;
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(load);
    MeMatrix4TMTransform(top, tm, topInRod);
    pathAt(phase, path, v);
    MdtFixedPathGetForce(joint, 0, f);
    snprintf(text, sizeof text,
             "path: %.1f rad/s, %.2f m, velocity %s    rod's angle %.2f deg    its top is off the path by %.1f mm    "
             "force %.0f N",
             (double)omega, (double)radius, hasNoVelocity ? "not given" : "given",
             atan2(sqrt((double)tm[1][0] * tm[1][0] + (double)tm[1][2] * tm[1][2]), (double)tm[1][1]) * 180 /
                 (double)ME_PI,
             (double)MeVector3Distance(top, path) * 1000, (double)MeVector3Magnitude(f));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    movePath();
    MdtWorldStep(world, step);
    drawPath();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(1, 1, 1, mass);
    MdtWorldSetGravity(world, 0, -gravity, 0);
    MdtWorldSetAutoDisable(world, 0); /* the path moves on by itself */
    load = MdtBodyCreate(world);
    MdtBodySetMass(load, mass);
    MdtMakeInertiaTensorBox(mass, loadSize, loadSize, loadSize, inertia);
    MdtBodySetInertiaTensor(load, inertia);
    joint = MdtFixedPathCreate(world);
    MdtFixedPathSetBodies(joint, load, 0);
    MdtFixedPathSetPosition(joint, 0, 0, length, 0); /* the rod's top, in the frame of the load */
    MdtFixedPathEnable(joint);
}

static void boxAt(float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float *color, MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, lx, ly, lz, color, tm), offset);
}

/* Two rails on four posts; a bridge that rolls on them; a trolley that rolls on the bridge. */
static void createCrane(void) {
    const float grey[4] = {.45f, .47f, .50f, 1};
    const float top = (float)height + .5f;
    MeMatrix4TMMakeIdentity(bridgeTM);
    MeMatrix4TMMakeIdentity(trolleyTM);
    for (int i = 0; i < 4; i++)
        boxAt(.2f, top - .4f, .2f, i % 2 ? 4 : -4, (height + (MeReal)0.1) / 2, i < 2 ? (MeReal)3.5 : (MeReal)-3.5, grey,
              0);
    boxAt(.25f, .3f, 7.25f, -4, height + (MeReal)0.25, 0, grey, 0);
    boxAt(.25f, .3f, 7.25f, 4, height + (MeReal)0.25, 0, grey, 0);
    boxAt(8.2f, .18f, .18f, 0, 0, (MeReal)0.22, RPalette[4], bridgeTM);
    boxAt(8.2f, .18f, .18f, 0, 0, (MeReal)-0.22, RPalette[4], bridgeTM);
    boxAt(.5f, .3f, .7f, 0, 0, 0, RPalette[2], trolleyTM);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, dark[4] = {.30f, .31f, .33f, 1};
    const AcmeVector3 lookAt = {0, 2.7f, 0};
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(load);
    const float a = (float)loadSize;
    RGraphicBoxCreate(rc, a, a, a, RPalette[0], tm);
    boxAt(a * 1.02f, a * .15f, a * 1.02f, 0, 0, 0, RPalette[5], tm);
    boxAt(.06f, (float)length, .06f, 0, length / 2, 0, dark, tm);
    createCrane();
    RGraphicGroundPlaneCreate(rc, 80, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 16.5f, .22f, .27f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A load hangs from a trolley that follows a path.",
        "$ACTION2 - start again",
        "$ACTION3 - give the path's velocity, or not",
        "$ACTION4 - circle or figure of eight",
    };
    static const RParameter parameters[] = {
        {"speed on the path", "rad/s", &omega, (MeReal)0.1, (MeReal)1.3, (MeReal)0.1, .less = "Down", .more = "Up",
         .changed = Reset},
        {"radius of the path", "m", &radius, (MeReal)0.5, 3, (MeReal)0.25, .less = "Left", .more = "Right",
         .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: FixedPath");
    RRenderSetAppName(rc, "FixedPath");
    RRenderCreateUserHelp(rc, help, 4);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleVelocity, 0);
    RRenderSetActionNCallBack(rc, 4, otherPath, 0);
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
