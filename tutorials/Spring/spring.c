/* Spring: a spring, a rod, a string and an elastic, side by side (Dynamics guide, chapter 3, "MdtSpring").
 *
 * All four are one joint, MdtSpring: it has a say in the distance between two points, here a hook on the beam and a
 * ball, and in nothing else. What becomes of it is decided by the two stops of its limit, which both lie at the
 * natural length:
 *
 *               shorter than that           longer than that
 *     spring    pushes (soft)               pulls (soft)
 *     rod       impossible (hard)           impossible (hard)
 *     string    nothing (stiffness 0)       impossible (hard)
 *     elastic   nothing (stiffness 0)       pulls (soft); or, after key 4, it cannot be compressed (lower stop hard)
 *
 * The balls start alike, above the beam, as far from their hooks as the natural length. The lines show where they went:
 * the rod's ball swings round in a circle, the string's falls freely until the string is taut. A rope without mass is
 * such a string.
 * Try: key 3 hangs them up; the arrow keys make the spring and the elastic stiffer, and damp them.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { SPRING, ROD, STRING, ELASTIC, KINDS };

#define RINGS    18  /* turns of the spring's coil */
#define PIECES   16  /* of a line that sags */
#define MAX_PATH 270 /* pieces of the lines that show where the balls have been */

static const MeReal step = (MeReal)(1.0 / 60); /* s */
static const MeReal length = 2;                /* m, of all four, without load */
static const MeReal height = 5;                /* m, of the hooks above the ground */
static const MeReal spacing = (MeReal)3.2;     /* m, from hook to hook */
static const MeReal ballRadius = (MeReal)0.35; /* m; the balls weigh 1 kg */
static const MeReal startAngle = 2;            /* rad, from hanging straight down */
static const int colorOf[KINDS] = {0, 2, 1, 3};

static MdtWorldID world;
static MdtBodyID ball[KINDS];
static MdtSpringID joint[KINDS];

static MeReal stiffness = 20;        /* N/m */
static MeReal damping = (MeReal)0.2; /* N s/m */
static int isStiffWhenShort;         /* the elastic cannot be compressed */
static MeReal startedAt = 2;         /* rad, where the balls were let go */

static RRender *rc;
static MeMatrix4 ringTM[RINGS], rodTM;
static RNativeLine *line[2][PIECES]; /* of the string and of the elastic */
static MeVector3 pathEnd[KINDS];
static int pathLength;

static MeReal hookX(int kind) {
    return spacing * ((MeReal)kind - (MeReal)1.5);
}

/* A stop says what happens on its side of the natural length. */
static void setStop(MdtSingleLimitID stop, MeReal k, MeReal c) {
    MdtSingleLimitSetStiffness(stop, k);
    MdtSingleLimitSetDamping(stop, c);
    MdtSingleLimitSetRestitution(stop,
                                 0); /* a string that becomes taut takes the ball's speed, and does not throw it back */
}

static void setStops(int kind, MeReal kShorter, MeReal kLonger) {
    MdtLimitID limit = MdtSpringGetLimit(joint[kind]);
    setStop(MdtLimitGetLowerLimit(limit), kShorter, kShorter > 0 ? damping : 0);
    setStop(MdtLimitGetUpperLimit(limit), kLonger, damping);
}

/* The four kinds. MEINFINITY makes a stop hard; with stiffness and damping 0 it does nothing. */
static void MEAPI applySettings(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    setStops(SPRING, stiffness, stiffness);
    setStops(ROD, MEINFINITY, MEINFINITY);
    setStops(STRING, 0, MEINFINITY);
    setStops(ELASTIC, isStiffWhenShort ? MEINFINITY : 0, stiffness);
}

/* All balls as far from their hooks as the natural length, at an angle from hanging down, at rest. */
static void placeBalls(MeReal angle) {
    startedAt = angle;
    pathLength = 0;
    RLineRemoveAll(rc);
    for (int i = 0; i < KINDS; i++) {
        MdtBodySetPosition(ball[i], hookX(i), height - length * MeCos(angle), -length * MeSin(angle));
        MdtBodySetLinearVelocity(ball[i], 0, 0, 0);
        MdtBodySetAngularVelocity(ball[i], 0, 0, 0);
        MdtBodyEnable(ball[i]);
        MdtBodyGetPosition(ball[i], pathEnd[i]);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeBalls(startedAt);
}

static void MEAPI otherStart(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeBalls(startedAt > 0 ? 0 : startAngle);
}

static void MEAPI toggleElastic(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isStiffWhenShort = !isStiffWhenShort;
    applySettings(0, 0);
}

/* Draws the way of the last step. */
static void drawPaths(void) {
    if (pathLength++ == MAX_PATH)
        return;
    for (int i = 0; i < KINDS; i++) {
        const float *c = RPalette[colorOf[i]];
        const MeReal *end = pathEnd[i], *now = MdtBodyGetTransformPtr(ball[i])[3];
        const AcmeVector3 from = {(float)end[0], (float)end[1], (float)end[2]};
        const AcmeVector3 to = {(float)now[0], (float)now[1], (float)now[2]};
        if (pathLength <= MAX_PATH)
            RLineAdd(rc, from, to, c[0], c[1], c[2]);
        MdtBodyGetPosition(ball[i], pathEnd[i]);
    }
}

/* From the hook to the ball: the place of the hook, and the rotation that takes the z axis there. */
static MeReal along(int kind, MeVector3 hook, MeMatrix3 R) {
    const MeVector3 z = {0, 0, 1};
    MeVector3 d, ballAt;
    MeVector4 q;
    MdtSpringGetPosition(joint[kind], hook, 1);
    MdtBodyGetPosition(ball[kind], ballAt);
    MeVector3Subtract(d, ballAt, hook);
    MeQuaternionForRotation(q, z, d);
    MeQuaternionToR(R, q);
    return MeVector3Magnitude(d);
}

/* The coil's rings share the length; the rod follows the ball. */
static void drawSpringAndRod(void) {
    MeVector3 hook, at, ballAt;
    MeMatrix3 R;
    along(SPRING, hook, R);
    MdtBodyGetPosition(ball[SPRING], ballAt);
    for (int i = 0; i < RINGS; i++) {
        MeVector3Lerp(at, hook, ballAt, ((MeReal)i + (MeReal)0.5) / RINGS);
        MeMatrix4TMMakeFromRotationAndPosition(ringTM[i], R, at[0], at[1], at[2]);
    }
    along(ROD, hook, R);
    MdtBodyGetPosition(ball[ROD], ballAt);
    MeVector3Lerp(at, hook, ballAt, (MeReal)0.5);
    MeMatrix4TMMakeFromRotationAndPosition(rodTM, R, at[0], at[1], at[2]);
}

/* A string that is not taut hangs in a curve. A parabola over the distance d whose sag is s is about d + 8 s^2 / (3 d)
 * long. It sags downward, but at right angles to the way from end to end. */
static void drawSagging(int kind) {
    MeVector3 hook, ballAt, way, sag = {0, -1, (MeReal)0.2};
    MeMatrix3 R;
    AcmeReal point[2][3];
    const MeReal d = along(kind, hook, R), slack = MeMAX(length - d, 0);
    MdtBodyGetPosition(ball[kind], ballAt);
    MeVector3Subtract(way, ballAt, hook);
    MeVector3MakeOrthogonal(sag, way);
    MeVector3Normalize(sag);
    for (int i = 0; i <= PIECES; i++) {
        const MeReal t = (MeReal)i / PIECES, depth = 4 * t * (1 - t) * MeSqrt(slack * d * 3 / 8);
        for (int k = 0; k < 3; k++) {
            point[0][k] = point[1][k];
            point[1][k] = (AcmeReal)(hook[k] + t * way[k] + depth * sag[k]);
        }
        if (i > 0)
            RNLineMoveEnds(line[kind - STRING][i - 1], point[0], point[1]);
    }
}

static void showFigures(void) {
    static const char *const name[KINDS] = {"spring", "rod", "string", "elastic"};
    char text[200];
    int n = 0;
    MeVector3 f;
    for (int i = 0; i < KINDS; i++) {
        MdtSpringGetForce(joint[i], 0, f);
        n += snprintf(text + n, sizeof text - (size_t)n, "%s %.3f m, %.1f N    ", name[i],
                      (double)MdtLimitGetPosition(MdtSpringGetLimit(joint[i])), (double)MeVector3Magnitude(f));
    }
    snprintf(text + n, sizeof text - (size_t)n, "stiffness %.0f N/m    damping %.1f N s/m", (double)stiffness,
             (double)damping);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtWorldStep(world, step);
    drawPaths();
    drawSpringAndRod();
    drawSagging(STRING);
    drawSagging(ELASTIC);
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(KINDS, KINDS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* or a ball that swings slowly enough would be put to rest */
    MdtMakeInertiaTensorSphere(1, ballRadius, inertia);
    for (int i = 0; i < KINDS; i++) {
        ball[i] = MdtBodyCreate(world);
        MdtBodySetInertiaTensor(ball[i], inertia);
        MdtBodySetPosition(ball[i], hookX(i), height - length, 0);
        joint[i] = MdtSpringCreate(world);
        MdtSpringSetBodies(joint[i], ball[i], 0);               /* at the ball's centre, */
        MdtSpringSetPosition(joint[i], 1, hookX(i), height, 0); /* and at a point of the world */
        MdtSpringSetNaturalLength(joint[i], length);
        MdtSpringEnable(joint[i]);
    }
}

/* A beam on two posts, and a knob for each hook. */
static void createStand(void) {
    static MeMatrix4 beamTM, postTM[2], hookTM[KINDS];
    const float grey[4] = {.45f, .47f, .50f, 1};
    const float reach = (float)spacing * 2.1f;
    MeMatrix4TMMakeIdentity(beamTM);
    MeMatrix4TMSetPosition(beamTM, 0, height + (MeReal)0.1, 0);
    RGraphicBoxCreate(rc, 2 * reach + .2f, .2f, .2f, grey, beamTM);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(postTM[i]);
        MeMatrix4TMSetPosition(postTM[i], i == 0 ? -reach : reach, height / 2, 0);
        RGraphicBoxCreate(rc, .2f, (float)height, .2f, grey, postTM[i]);
    }
    for (int i = 0; i < KINDS; i++) {
        MeMatrix4TMMakeIdentity(hookTM[i]);
        MeMatrix4TMSetPosition(hookTM[i], hookX(i), height, 0);
        RGraphicSphereCreate(rc, .16f, grey, hookTM[i]);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, zero[3] = {0, 0, 0};
    const AcmeVector3 lookAt = {0, 3.2f, 0};
    for (int i = 0; i < KINDS; i++)
        RGraphicSphereCreate(rc, (float)ballRadius, RPalette[colorOf[i]], MdtBodyGetTransformPtr(ball[i]));
    for (int i = 0; i < RINGS; i++)
        RGraphicTorusCreate(rc, .14f, .22f, RPalette[colorOf[SPRING]], ringTM[i]);
    RGraphicCylinderCreate(rc, .05f, (float)length, RPalette[colorOf[ROD]], rodTM);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < PIECES; k++)
            line[i][k] = RNLineCreate(rc, zero, zero, RPalette[colorOf[STRING + i]], 0);
    createStand();
    RGraphicGroundPlaneCreate(rc, 80, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 16.5f, .55f, .15f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A spring, a rod, a string and an elastic.",
        "$ACTION2 - start again",
        "$ACTION3 - let go above or below",
        "$ACTION4 - can the elastic be compressed?",
    };
    static const RParameter parameters[] = {
        {"stiffness", "N/m", &stiffness, 5, 100, 5, .less = "Down", .more = "Up", .changed = applySettings},
        {"damping", "N s/m", &damping, 0, 5, (MeReal)0.1, .less = "Left", .more = "Right", .changed = applySettings},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Spring");
    RRenderSetAppName(rc, "Spring");
    RRenderCreateUserHelp(rc, help, 4);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, otherStart, 0);
    RRenderSetActionNCallBack(rc, 4, toggleElastic, 0);
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
