/* Chain: links that hang on ball-and-socket joints, with a weight at the end (Dynamics guide, chapter 3,
 * "Ball-and-socket Joint").
 *
 * A joint between two bodies is like one between a body and the world: it holds a point of the one on a point of the
 * other. A heavy weight on a light chain is hard for most engines: the joints come apart. Kea solves for all joints at
 * once, so the chain holds whatever hangs on it; the status line shows by how much the worst joint is open. Each link's
 * colour says how hard its joint is pulled.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define LINKS 12

static const MeReal step = (MeReal)(1.0 / 60);                           /* s */
static const MeReal size[3] = {(MeReal)0.18, (MeReal)0.5, (MeReal)0.18}; /* m, a link; it hangs along y */
static const MeReal linkMass = 1;                                        /* kg */
static const MeReal height = 8;                                          /* m, of the hook */

static MdtWorldID world;
static MdtBodyID link[LINKS], ball;
static MdtBSJointID joint[LINKS + 1]; /* the last one holds the ball */

static MeReal ballMass = 100;           /* kg */
static MeReal startAngle = (MeReal)0.6; /* rad, from hanging down */

static RRender *rc;
static RGraphic *linkG[LINKS], *ballG;

static MeReal ballRadius(void) {
    return (MeReal)(0.5 * cbrt((double)ballMass / 1000)); /* all of one material */
}

/* A body on the line that hangs from the hook at the start angle, a way down it. */
static void placeBody(MdtBodyID body, MeReal down) {
    MdtBodySetPosition(body, down * MeSin(startAngle), height - down * MeCos(startAngle), 0);
    MdtBodySetQuaternion(body, MeCos(startAngle / 2), 0, 0, MeSin(startAngle / 2));
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodyEnable(body);
}

static void setBallMass(void) {
    const MeReal r = ballRadius();
    MeMatrix3 inertia;
    MdtBodySetMass(ball, ballMass);
    MdtMakeInertiaTensorSphere(ballMass, r, inertia);
    MdtBodySetInertiaTensor(ball, inertia);
}

/* Called when the user presses Enter, and at the start. The ball hangs by its top, which depends on its size, so the
 * last joint is attached anew; a joint has to be disabled while that is done. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    const MeReal end = LINKS * size[1];
    setBallMass();
    for (int i = 0; i < LINKS; i++)
        placeBody(link[i], ((MeReal)i + (MeReal)0.5) * size[1]);
    placeBody(ball, end + ballRadius());
    MdtBSJointDisable(joint[LINKS]);
    MdtBSJointSetPosition(joint[LINKS], end * MeSin(startAngle), height - end * MeCos(startAngle), 0);
    MdtBSJointEnable(joint[LINKS]);
    RGraphicDelete(rc, ballG, 0);
    ballG = RGraphicSphereCreate(rc, (float)ballRadius(), RPalette[0], MdtBodyGetTransformPtr(ball));
}

/* A kick across the way that it swings, of one metre per second. */
static void MEAPI kick(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodyAddImpulse(ball, 0, 0, ballMass);
}

/* How far a joint's two points are from each other, as a part of a link. */
static double gapOf(MdtBSJointID j) {
    MeVector3 on[2];
    double square = 0;
    for (unsigned int k = 0; k < 2; k++)
        MdtConstraintBodyGetPosition(MdtBSJointQuaConstraint(j), k, on[k]);
    for (int i = 0; i < 3; i++)
        square += pow((double)on[0][i] - (double)on[1][i], 2);
    return sqrt(square) / (double)size[1];
}

static double pullOf(MdtBSJointID j) {
    MeVector3 f;
    MdtBSJointGetForce(j, 0, f);
    return sqrt((double)f[0] * f[0] + (double)f[1] * f[1] + (double)f[2] * f[2]);
}

/* From green, without load, over yellow to red at one and a half times the weight. */
static void showPulls(void) {
    for (int i = 0; i < LINKS; i++) {
        const double share = pullOf(joint[i]) / (1.5 * 9.8 * (double)(ballMass + LINKS * linkMass));
        const float hue = (float)(120 * (1 - (share > 1 ? 1 : share)));
        float color[4];
        MeHSVtoRGB(hue, .55f, .8f, color);
        color[3] = 1;
        RGraphicSetColor(linkG[i], color);
    }
}

static void showFigures(void) {
    char text[160];
    double worst = 0;
    for (int i = 0; i <= LINKS; i++)
        worst = fmax(worst, gapOf(joint[i]));
    snprintf(text, sizeof text,
             "weight %.0f kg on links of %.0f kg    force on the hook %.0f N    widest gap %.1e of a link",
             (double)ballMass, (double)linkMass, pullOf(joint[0]), worst);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtWorldStep(world, step);
    showPulls();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static MdtBodyID createLink(void) {
    MeMatrix3 inertia;
    MdtBodyID body = MdtBodyCreate(world);
    MdtBodySetMass(body, linkMass);
    MdtMakeInertiaTensorBox(linkMass, size[0], size[1], size[2], inertia);
    MdtBodySetInertiaTensor(body, inertia);
    return body;
}

/* From the hook down: each joint holds the body below it to the one above, the first one to the world. */
static void createDynamics(void) {
    world = MdtWorldCreate(LINKS + 1, LINKS + 1);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    /* A world that a program makes itself has the guide's epsilon, 1e-4, with which joints open by 1.4 mm a tonne
     * (epsilon F h² / gamma). These are rigid. */
    MdtWorldSetEpsilon(world, 0);
    for (int i = 0; i < LINKS; i++) {
        link[i] = createLink();
        placeBody(link[i], ((MeReal)i + (MeReal)0.5) * size[1]);
    }
    ball = MdtBodyCreate(world);
    placeBody(ball, LINKS * size[1] + ballRadius());
    for (int i = 0; i <= LINKS; i++) {
        const MeReal down = (MeReal)i * size[1];
        joint[i] = MdtBSJointCreate(world);
        MdtBSJointSetBodies(joint[i], i < LINKS ? link[i] : ball, i > 0 ? link[i - 1] : 0);
        MdtBSJointSetPosition(joint[i], down * MeSin(startAngle), height - down * MeCos(startAngle), 0);
        MdtBSJointEnable(joint[i]);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1};
    const AcmeVector3 lookAt = {0, 4.6f, 0};
    static MeMatrix4 hookTM;
    MeMatrix4TMMakeIdentity(hookTM);
    MeMatrix4TMSetPosition(hookTM, 0, height + (MeReal)0.15, 0);
    RGraphicBoxCreate(rc, 1, .3f, 1, grey, hookTM);
    for (int i = 0; i < LINKS; i++) /* a little short, so that one sees the joints */
        linkG[i] = RGraphicBoxCreate(rc, (float)size[0], (float)size[1] * .94f, (float)size[2], RPalette[2],
                                     MdtBodyGetTransformPtr(link[i]));
    ballG = RGraphicSphereCreate(rc, (float)ballRadius(), RPalette[0], MdtBodyGetTransformPtr(ball));
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 12.5f, .35f, .12f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A chain with a weight at its end.",
        "Green links pull little, red ones much.",
        "$ACTION2 - start again",
        "$ACTION3 - kick it sideways",
    };
    static const RParameter parameters[] = {
        {"the weight", "kg", &ballMass, 1, 1000, 10, .isFactor = METRUE, .less = "Down", .more = "Up",
         .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Chain");
    RRenderSetAppName(rc, "Chain");
    RRenderCreateUserHelp(rc, help, 4);
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
