/* Gyroscope: what rotating bodies do by themselves (Dynamics guide, chapter 2, "Defining a Body": the inertia tensor).
 *
 * Left: a wheel on an axle that is held by a ball-and-socket joint at one end only. It does not fall while it spins; it
 * goes round, at the rate m g l / (I w), with m g l the torque of its weight and I w its angular momentum. Right: a box
 * that floats and spins about its middle axis, the one with neither the most nor the least moment of inertia. Every so
 * often it turns over, and back. Nothing pushes it; its energy and its angular momentum stay what they are.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

static const MeReal step = (MeReal)(1.0 / 60); /* s */

/* The wheel, with its axle of no mass along the body's z-axis. */
static const MeReal wheelMass = 2;                                        /* kg */
static const MeReal wheelRadius = (MeReal)0.8, wheelWidth = (MeReal)0.16; /* m */
static const MeReal arm = (MeReal)0.9;                                    /* m, from the joint to the wheel's centre */
static const MeReal pivot[3] = {(MeReal)-2.2, 2, 0};                      /* m */

static const MeReal boxSize[3] = {(MeReal)0.35, (MeReal)1.1, (MeReal)1.9}; /* m */
static const MeReal boxSpin = 5;                                           /* rad/s, about its middle axis, y */

static MdtWorldID world;
static MdtBodyID wheel, box;
static MdtBSJointID joint;
static MeReal spin = 30; /* rad/s, of the wheel */

static double angle, lastHeading; /* how far the axle has gone round, rad */
static double start;              /* J, the box's energy at first */
static int steps, flips;
static MeBool isOver;

static RRender *rc;

/* Solid cylinder about z: m r²/2 about its axis, m (3 r² + w²)/12 across. */
static double aboutAxis(void) {
    return 0.5 * (double)wheelMass * (double)wheelRadius * (double)wheelRadius;
}

static double across(void) {
    return (double)wheelMass *
           (3 * (double)wheelRadius * (double)wheelRadius + (double)wheelWidth * (double)wheelWidth) / 12;
}

/* The textbook's rate of a fast top. */
static double expectedRate(void) {
    return (double)wheelMass * 9.8 * (double)arm / (aboutAxis() * (double)spin);
}

static double headingOf(const MdtBodyID body) {
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    return atan2((double)tm[2][0], (double)tm[2][2]); /* of the body's z-axis, seen from above */
}

/* A top that is let go nods. One that is given the rate of its precession goes round evenly. */
static void placeWheel(void) {
    const MeReal rate = (MeReal)expectedRate();
    MdtBodySetPosition(wheel, pivot[0], pivot[1], pivot[2] + arm);
    MdtBodySetQuaternion(wheel, 1, 0, 0, 0);
    MdtBodySetAngularVelocity(wheel, 0, rate, spin);
    MdtBodySetLinearVelocity(wheel, rate * arm, 0, 0);
    MdtBodyEnable(wheel);
}

static void placeBox(void) {
    MdtBodySetPosition(box, (MeReal)2.2, (MeReal)1.9, 0);
    MdtBodySetQuaternion(box, MeSqrt((MeReal)0.5), MeSqrt((MeReal)0.5), 0, 0);
    MdtBodySetLinearVelocity(box, 0, 0, 0);
    MdtBodySetAngularVelocity(box, (MeReal)0.01, 0, boxSpin); /* y of the box is z of the world; a hint of x */
    MdtBodyEnable(box);
    start = (double)MdtBodyGetKineticEnergy(box);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeWheel();
    placeBox();
    angle = 0;
    lastHeading = headingOf(wheel);
    steps = flips = 0;
    isOver = 0;
}

/* Counts on from the last heading, the short way round. */
static void followWheel(void) {
    const double heading = headingOf(wheel);
    angle += remainder(heading - lastHeading, 2 * 3.14159265358979);
    lastHeading = heading;
}

/* The box is over when its y-axis points the other way than at first. */
static void followBox(void) {
    const MeReal y = MdtBodyGetTransformPtr(box)[1][2];
    if (isOver ? y > (MeReal)0.5 : y < (MeReal)-0.5) {
        isOver = !isOver;
        flips++;
    }
}

static void showFigures(void) {
    char text[200];
    const double rate = angle / (steps * (double)step);
    snprintf(text, sizeof text,
             "wheel: spin %.0f rad/s    goes round at %.4f rad/s, the textbook says %.4f        box: turned over %d "
             "times    "
             "energy changed by %.1e of it",
             (double)spin, rate, expectedRate(), flips, (double)MdtBodyGetKineticEnergy(box) / start - 1);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtBodyAddForce(wheel, 0, (MeReal)-9.8 * wheelMass,
                    0); /* its weight; the world has no gravity, so the box floats */
    MdtWorldStep(world, step);
    steps++;
    followWheel();
    followBox();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createWheel(void) {
    const MeReal a = (MeReal)across(), c = (MeReal)aboutAxis();
    const MeMatrix3 inertia = {{a, 0, 0}, {0, a, 0}, {0, 0, c}};
    wheel = MdtBodyCreate(world);
    MdtBodySetMass(wheel, wheelMass);
    MdtBodySetInertiaTensor(wheel, inertia);
    placeWheel();
    joint = MdtBSJointCreate(world);
    MdtBSJointSetBodies(joint, wheel, 0);
    MdtBSJointSetPosition(joint, pivot[0], pivot[1], pivot[2]);
    MdtBSJointEnable(joint);
}

static void createBox(void) {
    MeMatrix3 inertia;
    box = MdtBodyCreate(world);
    MdtMakeInertiaTensorBox(1, boxSize[0], boxSize[1], boxSize[2], inertia);
    MdtBodySetInertiaTensor(box, inertia);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1};
    const AcmeVector3 lookAt = {-.1f, 1.7f, 0};
    static MeMatrix4 postTM;
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(wheel);
    RGraphic *axle = RGraphicCylinderCreate(rc, .05f, (float)arm, grey, tm);
    const MeVector3 back = {0, 0, -arm / 2};
    RGraphicTranslateVertices(rc, axle, back);
    RGraphicTorusCreate(rc, (float)wheelRadius * .8f, (float)wheelRadius, RPalette[0], tm);
    RGraphicBoxCreate(rc, 1.7f * (float)wheelRadius, .1f, .06f, RPalette[4], tm);
    RGraphicBoxCreate(rc, .1f, 1.7f * (float)wheelRadius, .06f, RPalette[0], tm);
    MeMatrix4TMMakeIdentity(postTM);
    MeMatrix4TMSetPosition(postTM, pivot[0], pivot[1] / 2, pivot[2]);
    RGraphicBoxCreate(rc, .12f, (float)pivot[1], .12f, grey, postTM);

    tm = MdtBodyGetTransformPtr(box);
    RGraphicBoxCreate(rc, (float)boxSize[0], (float)boxSize[1], (float)boxSize[2], RPalette[1], tm);
    RGraphic *cap = RGraphicBoxCreate(rc, (float)boxSize[0] * .6f, .05f, (float)boxSize[2] * .6f, RPalette[3], tm);
    const MeVector3 up = {0, boxSize[1] / 2, 0};
    RGraphicTranslateVertices(rc, cap, up);

    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 7, .3f, .18f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A spinning wheel that does not fall, and a box that turns over.",
        "$ACTION2 - start again",
    };
    static const RParameter parameters[] = {
        {"the wheel's spin", "rad/s", &spin, 10, 100, 10, .less = "Down", .more = "Up", .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Gyroscope");
    RRenderSetAppName(rc, "Gyroscope");
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
    world = MdtWorldCreate(2, 1);
    createWheel();
    createBox();
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
