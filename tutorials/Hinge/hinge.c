/* Hinge: a door-like plate on a hinge, with a motor and stops (Dynamics guide, chapter 3, "How to Use
 * Joints").
 *
 * A joint is made once: create it, attach its bodies (here the plate and the world, 0), say where it is and
 * along which axis, enable it. The plate then swings like a pendulum. Through the hinge's limit one adds
 *   - a motor, which drives the angle at a speed, with at most so much torque: perhaps too weak for the plate;
 *   - stops at two angles, hard ones that throw the plate back, or soft ones, which are damped springs.
 * Try: motor on (3), stops on (4), soft stops (5), and the arrow keys for the motor's speed and torque.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

static const MeReal step = (MeReal)(1.0 / 60);               /* s */
static const MeReal size[3] = {2, 3, (MeReal)0.3};           /* m, the plate: width, length, thickness */
static const MeReal mass = 1;                                /* kg */
static const MeReal height = 4;                              /* m, of the hinge above the ground */
static const MeReal stopAt[2] = {(MeReal)-0.9, (MeReal)1.4}; /* rad, measured from the plate hanging down */
static const MeReal startAngle = (MeReal)0.8;                /* rad */

static MdtWorldID world;
static MdtBodyID body;
static MdtHingeID hinge;
static MdtLimitID limit;

static MeReal speed = 3;   /* rad/s, what the motor aims at */
static MeReal torque = 20; /* N m, the most that it gives */
static int isSoft;         /* the stops are springs */

static RRender *rc;
static RGraphic *stopG[2];
static MeMatrix4 stopTM[2];

/* The plate at an angle from hanging down, at rest. Its angle is measured from where it stood when the
 * hinge's axis was set, so the limit has to be told that it was put elsewhere. */
static void placePlate(MeReal angle) {
    const MeReal arm = size[1] / 2;
    MdtBodySetPosition(body, 0, height - arm * MeCos(angle), -arm * MeSin(angle));
    MdtBodySetQuaternion(body, MeCos(angle / 2), MeSin(angle / 2), 0, 0);
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodyEnable(body);
    MdtLimitResetState(limit);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placePlate(startAngle);
}

/* The motor's and the stops' properties as the variables above have them. The motor's switch is left as it
 * was. */
static void MEAPI applySettings(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    const MeBool isMotorized = MdtLimitIsMotorized(limit);
    MdtLimitSetLimitedForceMotor(limit, speed, torque);
    MdtLimitActivateMotor(limit, isMotorized);
    for (int i = 0; i < 2; i++) {
        MdtSingleLimitID stop = i == 0 ? MdtLimitGetLowerLimit(limit) : MdtLimitGetUpperLimit(limit);
        MdtSingleLimitSetStop(stop, stopAt[i]);
        MdtSingleLimitSetRestitution(stop, (MeReal)0.4);            /* of a hard stop */
        MdtSingleLimitSetStiffness(stop, isSoft ? 60 : MEINFINITY); /* N m/rad */
        MdtSingleLimitSetDamping(stop, isSoft ? 2 : 0);             /* N m s/rad */
    }
    MdtBodyEnable(body); /* changing a limit wakes no body that has come to rest */
}

/* The stops are drawn solid while they act. */
static void showStops(void) {
    for (int i = 0; i < 2; i++) {
        const float *c = RPalette[isSoft ? 2 : 1];
        const float color[4] = {c[0], c[1], c[2], MdtLimitIsActive(limit) ? 1 : .25f};
        RGraphicSetColor(stopG[i], color);
    }
}

static void MEAPI toggleMotor(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtLimitActivateMotor(limit, !MdtLimitIsMotorized(limit));
    applySettings(0, 0);
}

static void MEAPI toggleStops(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtLimitActivateLimits(limit, !MdtLimitIsActive(limit));
    applySettings(0, 0);
    showStops();
}

static void MEAPI toggleSoft(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isSoft = !isSoft;
    applySettings(0, 0);
    showStops();
}

static void showFigures(void) {
    char text[160];
    MeVector3 f, t;
    MdtHingeGetForce(hinge, 0, f);
    MdtHingeGetTorque(hinge, 0, t);
    snprintf(text, sizeof text,
             "angle %.1f deg    rate %.2f rad/s    motor %s (%.1f rad/s, at most %.0f N m)    stops %s    "
             "force on the hinge %.1f N",
             (double)MdtLimitGetPosition(limit) * 180 / (double)ME_PI, (double)MdtLimitGetVelocity(limit),
             MdtLimitIsMotorized(limit) ? "on" : "off", (double)speed, (double)torque,
             !MdtLimitIsActive(limit) ? "off"
             : isSoft                 ? "soft"
                                      : "hard",
             sqrt((double)f[0] * f[0] + (double)f[1] * f[1] + (double)f[2] * f[2]));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtWorldStep(world, step);
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(1, 1);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    body = MdtBodyCreate(world);
    MdtBodySetMass(body, mass);
    MdtMakeInertiaTensorBox(mass, size[0], size[1], size[2], inertia);
    MdtBodySetInertiaTensor(body, inertia);

    hinge = MdtHingeCreate(world);
    limit = MdtHingeGetLimit(hinge);
    placePlate(0); /* place the bodies before the joint: here the angle is zero */
    MdtHingeSetBodies(hinge, body, 0);
    MdtHingeSetPosition(hinge, 0, height, 0);
    MdtHingeSetAxis(hinge, 1, 0, 0);
    MdtHingeEnable(hinge);
    MdtLimitCalculatePosition(limit, 1); /* so that the angle can be shown though neither motor nor stops are on */
}

/* The stops: bars across the plate's way, where it can go no further. The plate is as thick as it is, so a
 * bar lies that much beyond the angle of its stop. */
static void createStops(void) {
    const MeReal reach = size[1] * (MeReal)0.8;
    for (int i = 0; i < 2; i++) {
        const MeReal side = i == 0 ? -1 : 1, angle = stopAt[i] + side * MeAtan2(size[2] * (MeReal)0.83, reach);
        MeMatrix3 R;
        MeMatrix3MakeRotationX(R, angle);
        MeMatrix4TMMakeFromRotationAndPosition(stopTM[i], R, 0, height - reach * MeCos(angle), -reach * MeSin(angle));
        stopG[i] = RGraphicBoxCreate(rc, (float)size[0] * 1.3f, .2f, .2f, RPalette[1], stopTM[i]);
    }
    showStops();
}

/* The bars are seen faintly while the stops are off. */
static void MEAPI nameStops(RRender *context, void *userdata) {
    static const float dark[4] = {.10f, .12f, .15f, 1};
    static const char *const names[3] = {"stop (off)", "hard stop", "soft stop"};
    (void)userdata;
    for (int i = 0; i < 2; i++) {
        MeVector3 place;
        MeVector3Copy(place, stopTM[i][3]);
        place[0] += size[0] * (MeReal)0.65;
        RMarkText(context, place, names[MdtLimitIsActive(limit) ? 1 + isSoft : 0], dark);
    }
}

/* Two posts and an axle that carry the plate. */
static void createStand(void) {
    const float grey[4] = {.45f, .47f, .50f, 1};
    static MeMatrix4 axleTM, postTM[2];
    const float reach = (float)size[0] * .75f;
    MeMatrix3 R;
    MeMatrix3MakeRotationY(R, ME_PI / 2); /* a cylinder stands along z; the axle lies along x */
    MeMatrix4TMMakeFromRotationAndPosition(axleTM, R, 0, height, 0);
    RGraphicCylinderCreate(rc, .12f, 2 * reach, grey, axleTM);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(postTM[i]);
        MeMatrix4TMSetPosition(postTM[i], i == 0 ? -reach : reach, height / 2, 0);
        RGraphicBoxCreate(rc, .2f, (float)height, .2f, grey, postTM[i]);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, 2.6f, 0};
    RGraphicBoxCreate(rc, (float)size[0], (float)size[1], (float)size[2], RPalette[0], MdtBodyGetTransformPtr(body));
    createStops();
    createStand();
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 9.5f, 1.05f, .2f);
    RRenderSetMarkCallBack(rc, nameStops, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "A plate on a hinge with a motor and stops.",
        "$ACTION2 - start again",
        "$ACTION3 - motor on or off",
        "$ACTION4 - stops on or off",
        "$ACTION5 - hard or soft stops",
    };
    static const RParameter parameters[] = {
        {"the motor's speed", "rad/s", &speed, -10, 10, (MeReal)0.5, .less = "Down", .more = "Up",
         .changed = applySettings},
        {"the motor's torque", "N m", &torque, 0, 100, 1, .less = "Left", .more = "Right", .changed = applySettings},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Hinge");
    RRenderSetAppName(rc, "Hinge");
    RRenderCreateUserHelp(rc, help, 5);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleMotor, 0);
    RRenderSetActionNCallBack(rc, 4, toggleStops, 0);
    RRenderSetActionNCallBack(rc, 5, toggleSoft, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createDynamics();
    applySettings(0, 0);
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
