/* Bounce: a ball is thrown onto a surface and rebounds, lower each time (Dynamics guide, chapter 3, "How to
 * Use Contacts").
 *
 * Dynamics does not know shapes, so somebody has to say where bodies touch. For a ball and a plane that takes
 * one subtraction, and this program does it by itself. Before every step the contact of the last step is
 * thrown away, and when the ball has gone into the plane a new one is made: where it is, which way it pushes,
 * how deep the ball is in, and what the surfaces are like. The depth tells when the ball met the plane, and how
 * fast, so that it rises to restitution squared times the height of before. Friction turns the ball: after some
 * bounces it rolls.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define MAX_PATH 900 /* pieces of the line that shows where the ball has been */

static const MeReal step = (MeReal)(1.0 / 60); /* s */
static const MeReal ballRadius = (MeReal)0.6;  /* m */
static const MeReal friction = (MeReal)5.0;    /* N, the most that the surface can drag */

static MdtWorldID world;
static MdtBodyID body;
static MdtContactID contact; /* of the last step; 0: the ball was in the air */

static RRender *rc;
static MeReal restitution = (MeReal)0.6; /* rebound speed over impact speed */
static MeVector3 pathEnd;
static int pathLength;

static void forgetPath(void) {
    RLineRemoveAll(rc);
    MdtBodyGetPosition(body, pathEnd);
    pathLength = 0;
}

/* Called when the user presses Enter, and at the start. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodySetPosition(body, -6, 5, 0);
    MdtBodySetQuaternion(body, MeSqrt((MeReal)0.5), 0, MeSqrt((MeReal)0.5), 0); /* the band upright */
    MdtBodySetLinearVelocity(body, (MeReal)1.8, 0, 0);
    MdtBodySetAngularVelocity(body, 0, 0, 0);
    MdtBodyEnable(body); /* it may have come to rest and been disabled */
    forgetPath();
}

/* An old contact tells of the past: away with it. */
static void destroyContact(void) {
    if (!contact)
        return;
    MdtContactDisable(contact);
    MdtContactDestroy(contact);
    contact = 0;
}

/* Does the ball reach into the plane y = 0? Then a contact between the ball and the world (0) keeps it out.
 */
static void createContact(void) {
    MeVector3 pos;
    MdtBodyGetPosition(body, pos);
    const MeReal penetration = 0 - (pos[1] - ballRadius);
    if (penetration <= 0)
        return;
    contact = MdtContactCreate(world);
    MdtContactSetBodies(contact, body, 0);
    MdtContactSetPosition(contact, pos[0], pos[1] - ballRadius, pos[2]);
    MdtContactSetNormal(contact, 0, 1, 0); /* the ball is pushed up */
    MdtContactSetPenetration(contact, penetration);
    MdtContactSetRadius(contact, 0, ballRadius); /* round: the ball rolls */

    MdtContactParamsID params = MdtContactGetParams(contact);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetFriction(params, friction);
    MdtContactParamsSetRestitution(params, restitution);
    MdtContactEnable(contact); /* or the solver would not look at it */
}

/* Draws the way of the last step. */
static void drawPath(void) {
    MeVector3 pos;
    MdtBodyGetPosition(body, pos);
    const AcmeVector3 from = {(float)pathEnd[0], (float)pathEnd[1], (float)pathEnd[2]};
    const AcmeVector3 to = {(float)pos[0], (float)pos[1], (float)pos[2]};
    if (pathLength++ < MAX_PATH)
        RLineAdd(rc, from, to, RPalette[1][0], RPalette[1][1], RPalette[1][2]);
    for (int i = 0; i < 3; i++)
        pathEnd[i] = pos[i];
}

static void showFigures(void) {
    char text[120];
    MeVector3 pos, v, w;
    MdtBodyGetPosition(body, pos);
    MdtBodyGetLinearVelocity(body, v);
    MdtBodyGetAngularVelocity(body, w);
    snprintf(text, sizeof text, "restitution %.2f    height %+.2f m    speed %.2f m/s    spin %.2f rad/s",
             (double)restitution, (double)(pos[1] - ballRadius), sqrt((double)v[0] * v[0] + (double)v[1] * v[1]),
             -(double)w[2]);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    destroyContact();
    createContact();
    MdtWorldStep(world, step);
    drawPath();
    showFigures();
    if (MdtBodyGetTransformPtr(body)[3][0] > 9) /* out of the picture: throw again */
        Reset(rc, 0);
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(1, 1); /* one body, one contact */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    body = MdtBodyCreate(world);
    MdtMakeInertiaTensorSphere(1, ballRadius, inertia);
    MdtBodySetInertiaTensor(body, inertia);
}

/* A ball with a band round it, so that one sees it turn. */
static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {.5f, 1.9f, 0};
    const float r = (float)ballRadius;
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    RGraphicSphereCreate(rc, r, RPalette[0], tm);
    RGraphicTorusCreate(rc, r * .92f, r * 1.04f, RPalette[4], tm);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 11, .2f, .18f);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    const char *help[] = {
        "A ball rebounds, lower each time.",
        "The line shows where it has been.",
        "$ACTION2 - throw it again",
    };
    static const RParameter parameters[] = {
        {"restitution", 0, &restitution, 0, 1, (MeReal)0.05, .less = "Down", .more = "Up"},
    };
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    RRenderSetWindowTitle(rc, "Karma tutorial: Bounce");
    RRenderSetAppName(rc, "Bounce");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);

    createDynamics();
    createGraphics();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
