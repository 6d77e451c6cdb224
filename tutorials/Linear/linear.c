/* Linear: beads in a plane and on a rail (Dynamics guide, chapter 3, "MdtLinear1" and "MdtLinear2").
 *
 * Linear1 keeps a point of a body in a plane: it takes one degree of freedom. Three beads are thrown in a tilted pane
 * of glass. Across the slope nothing acts on them, down the slope a part of gravity, g sin(tilt): they fly in
 * parabolas, as if gravity had become weaker. Linear2 keeps a point on a line. The bead on the rail beside the pane
 * is thrown up the slope as fast as the middle one of the three, apart from its motion across: the two stay at one
 * height.
 *
 * What the joints bear is the other part of gravity, g cos(tilt), at right angles to the slope. Try: key 3 makes a wind
 * blow against the pane, which changes the joints' force and nothing else.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { IN_PLANE = 3, BEADS }; /* three beads in the pane, and the last one on the rail */

static const MeReal step = (MeReal)(1.0 / 60);           /* s */
static const MeReal width = 6, slope = (MeReal)3.4;      /* m, of the pane */
static const MeReal radius = (MeReal)0.17;               /* m; the beads weigh 1 kg */
static const MeReal low = (MeReal)0.4;                   /* m, of the pane's lower edge above the ground */
static const MeReal railX = (MeReal)3.7;                 /* m; the pane reaches from -3 to 3 */
static const MeReal elevation[BEADS] = {40, 53, 66, 53}; /* degrees, of the throws in the pane */
static const MeReal wind = 20;                           /* N */
static const int colorOf[BEADS] = {2, 1, 3, 1};

static MdtWorldID world;
static MdtBodyID bead[BEADS];
static MdtLinear1ID plane[IN_PLANE];
static MdtLinear2ID rail;

static MeReal tilt = 30; /* degrees, from the horizontal */
static MeReal speed = 5; /* m/s, of the throws */
static int isWindy;

static RRender *rc;
static MeMatrix4 paneTM, railTM, postTM[4];
static MeVector3 pathEnd[BEADS];
static int flights[BEADS];

static MeReal radians(MeReal degrees) {
    return degrees * ME_PI / 180;
}

/* A point of the pane, so far across (from its middle) and up the slope (from where the beads are thrown). */
static void paneAt(MeReal across, MeReal up, MeVector3 p) {
    const MeReal a = radians(tilt), y = up + (MeReal)0.2;
    MeVector3Set(p, across, low + y * MeSin(a), (slope / 2 - y) * MeCos(a));
}

/* At right angles to the pane, upward. */
static void normalOf(MeVector3 n) {
    const MeReal a = radians(tilt);
    MeVector3Set(n, 0, MeCos(a), MeSin(a));
}

/* How far up the slope a bead is. */
static MeReal upSlope(int i) {
    const MeReal a = radians(tilt), *at = MdtBodyGetTransformPtr(bead[i])[3];
    MeVector3 start;
    paneAt(0, 0, start);
    return (at[1] - start[1]) * MeSin(a) - (at[2] - start[2]) * MeCos(a);
}

static void throwBead(int i) {
    const MeReal e = radians(elevation[i]), a = radians(tilt), up = speed * MeSin(e);
    MeVector3 p;
    paneAt(i < IN_PLANE ? (MeReal)0.4 - width / 2 : railX, 0, p);
    MdtBodySetPosition(bead[i], p[0], p[1], p[2]);
    MdtBodySetLinearVelocity(bead[i], i < IN_PLANE ? speed * MeCos(e) : 0, up * MeSin(a), -up * MeCos(a));
    MdtBodySetAngularVelocity(bead[i], 0, 0, 0);
    MdtBodyEnable(bead[i]);
    MdtBodyGetPosition(bead[i], pathEnd[i]);
    flights[i]++;
}

/* The plane goes through the joint's position, and its axis is the normal; the line has a direction. */
static void setJoints(void) {
    MeVector3 n, p, top;
    normalOf(n);
    for (int i = 0; i < IN_PLANE; i++) {
        paneAt(0, 0, p);
        MdtLinear1Disable(plane[i]);
        MdtLinear1SetBodies(plane[i], bead[i], 0);
        MdtConstraintBodySetPosition(MdtLinear1QuaConstraint(plane[i]), 1, p[0], p[1], p[2]);
        MdtLinear1SetAxis(plane[i], n[0], n[1], n[2]);
        MdtLinear1Enable(plane[i]);
    }
    paneAt(railX, 0, p);
    paneAt(railX, 1, top);
    MdtLinear2Disable(rail);
    MdtLinear2SetBodies(rail, bead[IN_PLANE], 0);
    MdtConstraintBodySetPosition(MdtLinear2QuaConstraint(rail), 1, p[0], p[1], p[2]);
    MdtLinear2SetDirection(rail, 0, top[1] - p[1], top[2] - p[2]);
    MdtLinear2Enable(rail);
}

/* The graphics that lie in the slope, and posts from the ground to its corners. A transform may stretch a graphic. */
static void placeGraphics(void) {
    const MeReal x[4] = {-width / 2, width / 2, railX, railX};
    MeMatrix3 R;
    MeVector3 p;
    MeMatrix3MakeRotationX(R, radians(tilt) - ME_PI / 2);
    paneAt(0, slope / 2 - (MeReal)0.2, p);
    MeMatrix4TMMakeFromRotationAndPosition(paneTM, R, p[0], p[1], p[2]);
    MeMatrix4TMMakeFromRotationAndPosition(railTM, R, railX, p[1], p[2]);
    for (int i = 0; i < 4; i++) {
        paneAt(x[i], i == 3 ? (MeReal)-0.2 : slope - (MeReal)0.2, p);
        MeMatrix4TMMakeIdentity(postTM[i]);
        postTM[i][1][1] = p[1];
        MeMatrix4TMSetPosition(postTM[i], p[0], p[1] / 2, p[2]);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    RLineRemoveAll(rc);
    for (int i = 0; i < BEADS; i++) {
        flights[i] = 0;
        throwBead(i);
    }
    setJoints();
    placeGraphics();
}

static void MEAPI toggleWind(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isWindy = !isWindy;
}

/* The wind blows against the pane, and forces have to be added anew before every step. */
static void blow(void) {
    MeVector3 n;
    normalOf(n);
    for (int i = 0; i < BEADS; i++)
        if (isWindy)
            MdtBodyAddForce(bead[i], -wind * n[0], -wind * n[1], -wind * n[2]);
}

/* Draws the way of the last step, and throws a bead again that has come back. */
static void followBead(int i) {
    const float *c = RPalette[colorOf[i]];
    const MeReal *now = MdtBodyGetTransformPtr(bead[i])[3], above = (MeReal)0.03; /* m, of the glass */
    MeVector3 n;
    AcmeVector3 from, to;
    normalOf(n);
    for (int k = 0; k < 3; k++) {
        from[k] = (float)(pathEnd[i][k] + above * n[k]);
        to[k] = (float)(now[k] + above * n[k]);
    }
    if (flights[i] == 1 && i < IN_PLANE)
        RLineAdd(rc, from, to, c[0], c[1], c[2]);
    MdtBodyGetPosition(bead[i], pathEnd[i]);
    if (upSlope(i) < 0)
        throwBead(i);
}

/* How far a bead is from the plane through all the beads' starts, in mm. */
static double offPlane(int i) {
    MeVector3 n, start, d;
    normalOf(n);
    paneAt(0, 0, start);
    MeVector3Subtract(d, MdtBodyGetTransformPtr(bead[i])[3], start);
    return fabs((double)MeVector3Dot(d, n)) * 1000;
}

static void showFigures(void) {
    char text[220];
    MeVector3 f, g;
    MdtLinear1GetForce(plane[1], 0, f);
    MdtLinear2GetForce(rail, 0, g);
    const MeReal *middle = MdtBodyGetTransformPtr(bead[1])[3], *onRail = MdtBodyGetTransformPtr(bead[IN_PLANE])[3];
    snprintf(text, sizeof text,
             "tilt %.0f deg    middle bead: across %.3f m, up %.3f m, off the pane %.1f mm, force %.1f N    "
             "on the rail: rises %.3f m, off %.1f mm, bears %.1f N",
             (double)tilt, (double)(middle[0] + width / 2 - (MeReal)0.4), (double)upSlope(1), offPlane(1),
             (double)MeVector3Magnitude(f), (double)upSlope(IN_PLANE),
             hypot(offPlane(IN_PLANE), ((double)onRail[0] - (double)railX) * 1000), (double)MeVector3Magnitude(g));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    blow();
    MdtWorldStep(world, step);
    showFigures();
    for (int i = 0; i < BEADS; i++)
        followBead(i);
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(BEADS, BEADS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* a bead may be slow where it turns back */
    MdtMakeInertiaTensorSphere(1, radius, inertia);
    for (int i = 0; i < BEADS; i++) {
        bead[i] = MdtBodyCreate(world);
        MdtBodySetInertiaTensor(bead[i], inertia);
    }
    for (int i = 0; i < IN_PLANE; i++)
        plane[i] = MdtLinear1Create(world);
    rail = MdtLinear2Create(world);
}

static void boxAt(float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float *color, MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, lx, ly, lz, color, tm), offset);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1};
    const float glass[4] = {RPalette[5][0], RPalette[5][1], RPalette[5][2], .2f};
    const float w = (float)width, h = (float)slope;
    const AcmeVector3 lookAt = {.4f, .8f, 0};
    for (int i = 0; i < BEADS; i++)
        RGraphicSphereCreate(rc, (float)radius, RPalette[colorOf[i]], MdtBodyGetTransformPtr(bead[i]));
    boxAt(w, h, .03f, 0, 0, 0, glass, paneTM);
    for (int i = -1; i <= 1; i += 2) {
        boxAt(w + .1f, .1f, .1f, 0, (MeReal)i * slope / 2, 0, grey, paneTM);
        boxAt(.1f, h, .1f, (MeReal)i * width / 2, 0, 0, grey, paneTM);
    }
    boxAt(.08f, h, .08f, 0, 0, 0, grey, railTM);
    for (int i = 0; i < 4; i++)
        boxAt(.1f, 1, .1f, 0, 0, 0, grey, postTM[i]);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 11.5f, .3f, .38f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Beads in a tilted pane, and one on a rail.",
        "$ACTION2 - start again",
        "$ACTION3 - wind on or off",
    };
    static const RParameter parameters[] = {
        {"the slope", "degrees", &tilt, 10, 80, 5, .less = "Down", .more = "Up", .changed = Reset},
        {"speed of the throws", "m/s", &speed, 1, 7, (MeReal)0.5, .less = "Left", .more = "Right", .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Linear");
    RRenderSetAppName(rc, "Linear");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleWind, 0);
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
