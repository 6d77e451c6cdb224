/* ConeLimit: pendulums that stay in cones (Dynamics guide, chapter 3, "MdtConeLimit").
 *
 * A ball-and-socket joint lets a pendulum swing any way. A cone limit beside it, between the same two bodies, keeps the
 * angle between an axis of each below a half angle: here the pendulum's rod, and an axis of the world. That makes
 * shoulders, necks and tow bars. At the cone's side the pendulum glides along it, as there is no friction.
 *
 * Try: Right tilts the cones, and the pendulums rest against their sides; key 3 makes the sides soft, key 4 pushes.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define PENDULUMS 3

static const MeReal step = (MeReal)(1.0 / 60);    /* s */
static const MeReal length = (MeReal)1.8;         /* m, from the pivot to the ball's centre */
static const MeReal ballRadius = (MeReal)0.25;    /* m; the balls weigh 1 kg */
static const MeReal height = (MeReal)3.2;         /* m, of the pivots above the ground */
static const MeReal spacing = 3;                  /* m */
static const MeReal stiffness = 100, damping = 4; /* N m/rad and N m s/rad, of soft cones */

static MdtWorldID world;
static MdtBodyID ball[PENDULUMS];
static MdtBSJointID pivot[PENDULUMS];
static MdtConeLimitID cone[PENDULUMS];

static const MeReal width[PENDULUMS] = {15, 30, 50}; /* degrees, half angles of the cones, */
static MeReal wider;                                 /* and by how much they are wider */
static MeReal tilt;                                  /* degrees, of the cones' axes from the vertical */
static int isSoft;
static MeReal max[PENDULUMS]; /* rad, the greatest angles since Reset */

static RRender *rc;
static RGraphic *coneG[PENDULUMS];
static MeMatrix4 coneTM[PENDULUMS];

static MeReal radians(MeReal degrees) {
    return degrees * ME_PI / 180;
}

static MeReal halfAngle(int i) {
    return MeCLAMP(width[i] + wider, 10, 80);
}

static MeReal pivotX(int i) {
    return spacing * (MeReal)(i - 1);
}

/* The cones' axis: downward, tilted towards the viewer. */
static void axisOf(MeVector3 axis) {
    MeVector3Set(axis, 0, -MeCos(radians(tilt)), MeSin(radians(tilt)));
}

/* A ball at an angle from its cone's axis, away from it sideways; its y axis points to the pivot. */
static void placeBall(int i, MeReal angle) {
    const MeReal down = radians(tilt);
    const MeVector3 up = {MeSin(angle), MeCos(angle) * MeCos(down), -MeCos(angle) * MeSin(down)}, y = {0, 1, 0};
    MeVector4 q;
    MeQuaternionForRotation(q, y, up);
    MdtBodySetPosition(ball[i], pivotX(i) - length * up[0], height - length * up[1], -length * up[2]);
    MdtBodySetQuaternion(ball[i], q[0], q[1], q[2], q[3]);
    MdtBodySetLinearVelocity(ball[i], 0, 0, 0);
    MdtBodySetAngularVelocity(ball[i], 0, 0, 0);
    MdtBodyResetImpulses(ball[i]);
    MdtBodyEnable(ball[i]);
}

/* A sideways blow at the ball, as an impulse in N s. */
static void MEAPI push(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < PENDULUMS; i++)
        MdtBodyAddImpulse(ball[i], (MeReal)2.6, 0, (MeReal)2.8);
}

/* The cone as it is drawn: its apex at the pivot, its side as long as the pendulum. */
static void drawCone(int i) {
    const float *c = RPalette[5], color[4] = {c[0], c[1], c[2], .28f};
    const MeReal half = radians(halfAngle(i));
    const MeVector3 z = {0, 0, 1};
    MeVector3 axis, back;
    MeVector4 q;
    axisOf(axis);
    MeVector3Copy(back, axis);
    MeVector3Scale(back, -1);
    MeQuaternionForRotation(q, z, back);
    MeQuaternionToTM(coneTM[i], q);
    MeMatrix4TMSetPosition(coneTM[i], pivotX(i), height, 0);
    if (coneG[i])
        RGraphicDelete(rc, coneG[i], 0);
    coneG[i] =
        RGraphicConeCreate(rc, (float)(length * MeSin(half)), 0, (float)(length * MeCos(half)), color, coneTM[i]);
}

/* One axis in the pendulum, along its rod, and one in the world. */
static void applySettings(void) {
    MeVector3 axis;
    axisOf(axis);
    for (int i = 0; i < PENDULUMS; i++) {
        MeVector3 y;
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(ball[i]);
        MeVector3Copy(y, tm[1]);
        MdtConeLimitBodySetAxes(cone[i], 0, -y[0], -y[1], -y[2], tm[0][0], tm[0][1], tm[0][2]);
        MdtConeLimitBodySetAxes(cone[i], 1, axis[0], axis[1], axis[2], 1, 0, 0);
        MdtConeLimitSetConeHalfAngle(cone[i], radians(halfAngle(i)));
        MdtConeLimitSetStiffness(cone[i], isSoft ? stiffness : MEINFINITY);
        MdtConeLimitSetDamping(cone[i], isSoft ? damping : MEINFINITY);
        drawCone(i);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    for (int i = 0; i < PENDULUMS; i++) {
        placeBall(i, radians(halfAngle(i)) * (MeReal)0.7);
        max[i] = 0;
    }
    applySettings();
    push(context, userdata);
}

static void MEAPI toggleSoft(RRender *context, void *userdata) {
    isSoft = !isSoft;
    Reset(context, userdata);
}

static MeReal angleOf(int i) {
    MeVector3 axis, across;
    const MeReal *y = MdtBodyGetTransformPtr(ball[i])[1];
    axisOf(axis);
    MeVector3Cross(across, axis, y);
    return MeAtan2(MeVector3Magnitude(across), -MeVector3Dot(axis, y));
}

static void showFigures(void) {
    char text[200];
    int n =
        snprintf(text, sizeof text, "tilt %.0f deg, sides %s    angles (deg):", (double)tilt, isSoft ? "soft" : "hard");
    for (int i = 0; i < PENDULUMS; i++) {
        max[i] = MeMAX(max[i], angleOf(i));
        n += snprintf(text + n, sizeof text - (size_t)n, "    %.2f of %.0f, most %.2f",
                      (double)angleOf(i) * 180 / (double)ME_PI, (double)halfAngle(i),
                      (double)max[i] * 180 / (double)ME_PI);
    }
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
    world = MdtWorldCreate(PENDULUMS, 2 * PENDULUMS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* a pendulum that swings slowly goes on swinging */
    MdtMakeInertiaTensorSphere(1, ballRadius, inertia);
    for (int i = 0; i < PENDULUMS; i++) {
        ball[i] = MdtBodyCreate(world);
        MdtBodySetInertiaTensor(ball[i], inertia);
        MdtBodySetLinearVelocityDamping(ball[i], (MeReal)0.1);
        placeBall(i, 0);
        pivot[i] = MdtBSJointCreate(world);
        MdtBSJointSetBodies(pivot[i], ball[i], 0);
        MdtBSJointSetPosition(pivot[i], pivotX(i), height, 0);
        MdtBSJointEnable(pivot[i]);
        cone[i] = MdtConeLimitCreate(world);
        MdtConeLimitSetBodies(cone[i], ball[i], 0);
        MdtConeLimitEnable(cone[i]);
    }
}

static void createStand(void) {
    static MeMatrix4 beamTM, postTM[2], rodTM[PENDULUMS];
    const float grey[4] = {.45f, .47f, .50f, 1};
    const MeReal reach = spacing * (MeReal)1.75;
    MeMatrix4TMMakeIdentity(beamTM);
    MeMatrix4TMSetPosition(beamTM, 0, height + (MeReal)0.4, 0);
    RGraphicBoxCreate(rc, 2 * (float)reach + .2f, .2f, .2f, grey, beamTM);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(postTM[i]);
        MeMatrix4TMSetPosition(postTM[i], i == 0 ? -reach : reach, (height + (MeReal)0.4) / 2, 0);
        RGraphicBoxCreate(rc, .2f, (float)height + .4f, .2f, grey, postTM[i]);
    }
    for (int i = 0; i < PENDULUMS; i++) {
        MeMatrix4TMMakeIdentity(rodTM[i]);
        MeMatrix4TMSetPosition(rodTM[i], pivotX(i), height + (MeReal)0.2, 0);
        RGraphicBoxCreate(rc, .1f, .4f, .1f, grey, rodTM[i]);
    }
}

static void createGraphics(void) {
    static const int colorOf[PENDULUMS] = {2, 1, 0};
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {.5f, 1.75f, 0};
    for (int i = 0; i < PENDULUMS; i++) {
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(ball[i]);
        const MeVector3 middle = {0, length / 2, 0};
        const float *c = RPalette[colorOf[i]];
        RGraphicSphereCreate(rc, (float)ballRadius, c, tm);
        RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, .07f, (float)length, .07f, c, tm), middle);
    }
    createStand();
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 14.5f, .3f, .16f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Pendulums that stay in cones.",
        "$ACTION2 - start again",
        "$ACTION3 - hard or soft sides",
        "$ACTION4 - push the balls",
    };
    static const RParameter parameters[] = {
        {"cones wider by", "degrees", &wider, -20, 40, 5, .less = "Down", .more = "Up", .changed = Reset},
        {"their tilt", "degrees", &tilt, 0, 60, 10, .less = "Left", .more = "Right", .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: ConeLimit");
    RRenderSetAppName(rc, "ConeLimit");
    RRenderCreateUserHelp(rc, help, 4);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleSoft, 0);
    RRenderSetActionNCallBack(rc, 4, push, 0);
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
