/* Limits: six weights fall on six stops (Dynamics guide, chapter 3, "Joint Limit" and "The Single Joint Limit").
 *
 * Each weight slides on a rod, a prismatic joint, whose limit has a lower stop. From left to right:
 *   - hard stops, of infinite stiffness, with the restitution 0, 0.5 and 1: the speed after the impact is so many times
 *     the speed before, so the weight comes back to 0, a quarter, and all of its height;
 *   - soft stops, springs that begin where the stop is: a strong one without damping, the same one with damping, and a
 *     weak one with damping. They only push: a weight that comes up leaves them.
 * The bright rings show how high the first rebound went. Try: key 3 lowers the limits' stiffness threshold. A stop
 * whose stiffness is above it counts as hard, and then its restitution is used in place of its damping.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define WEIGHTS 6
#define HARD    3  /* the first three */
#define RINGS   10 /* turns of a coil */

#define STEPS 4 /* for each picture: an impact is met within a step, up to velocity * step before the stop */

static const MeReal step = (MeReal)(1.0 / 60 / STEPS);           /* s */
static const MeReal stopHeight = (MeReal)1.2;                    /* m, above the ground */
static const MeReal size = (MeReal)0.7;                          /* m, of a weight; it weighs 1 kg */
static const MeReal spacing = (MeReal)1.5;                       /* m */
static const MeReal damping[WEIGHTS - HARD] = {0, 4, 4};         /* N s/m, of the soft stops */
static const MeReal share[WEIGHTS - HARD] = {1, 1, (MeReal)0.4}; /* of the stiffness */
static const MeReal threshold = 100;                             /* N/m, when it is low */

static MdtWorldID world;
static MdtBodyID weight[WEIGHTS];
static MdtPrismaticID slider[WEIGHTS];

static MeReal restitution[HARD] = {0, (MeReal)0.5, 1};
static MeReal stiffness = 200; /* N/m, of the strong springs */
static MeReal drop = 2;        /* m */
static int hasLowThreshold;

static RRender *rc;
static MeMatrix4 ringTM[WEIGHTS][RINGS], peakTM[WEIGHTS];
static MeReal deepest[WEIGHTS], peak[WEIGHTS]; /* m, above the stop, since the weight was let go */
static MeReal before[WEIGHTS];                 /* m/s, the speed in the last step */
static int rebounds[WEIGHTS]; /* how often it turned upward, and down again: 2 ends the first rebound */

static MdtLimitID limitOf(int i) {
    return MdtPrismaticGetLimit(slider[i]);
}

static MeReal placeX(int i) {
    return spacing * ((MeReal)i - (MeReal)2.5) + (i < HARD ? (MeReal)-0.25 : (MeReal)0.25);
}

/* Above the stop; 0: the weight's bottom is at it. */
static MeReal heightOf(int i) {
    return MdtBodyGetTransformPtr(weight[i])[3][1] - size / 2 - stopHeight;
}

static void applySettings(void) {
    for (int i = 0; i < WEIGHTS; i++) {
        MdtSingleLimitID stop = MdtLimitGetLowerLimit(limitOf(i));
        MdtSingleLimitSetStop(stop, 0);
        MdtSingleLimitSetStiffness(stop, i < HARD ? MEINFINITY : share[i - HARD] * stiffness);
        MdtSingleLimitSetDamping(stop, i < HARD ? 0 : damping[i - HARD]);
        MdtSingleLimitSetRestitution(stop,
                                     i < HARD ? restitution[i] : (MeReal)0.7); /* used only if it counts as hard */
        MdtLimitSetStiffnessThreshold(limitOf(i), hasLowThreshold ? threshold : MEINFINITY);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    applySettings();
    for (int i = 0; i < WEIGHTS; i++) {
        MdtBodySetPosition(weight[i], placeX(i), stopHeight + drop + size / 2, 0);
        MdtBodySetLinearVelocity(weight[i], 0, 0, 0);
        MdtBodyEnable(weight[i]);
        MdtLimitResetState(limitOf(i));
        deepest[i] = peak[i] = before[i] = 0;
        rebounds[i] = 0;
    }
}

static void MEAPI toggleThreshold(RRender *context, void *userdata) {
    hasLowThreshold = !hasLowThreshold;
    Reset(context, userdata);
}

/* How deep a weight went, and how high between the first time that it turned upward and the next time that it turned
 * down. */
static void measure(int i) {
    const MeReal y = heightOf(i), v = MdtLimitGetVelocity(limitOf(i));
    deepest[i] = MeMIN(deepest[i], y);
    if (rebounds[i] < 2 && v * before[i] < 0)
        rebounds[i]++;
    if (rebounds[i] == 1)
        peak[i] = MeMAX(peak[i], y);
    if (v != 0)
        before[i] = v;
    MeMatrix4TMSetPosition(peakTM[i], placeX(i), stopHeight + peak[i] + size / 2, 0);
}

/* The springs reach up to the stop, or to the weight that presses them. */
static void drawSprings(void) {
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, ME_PI / 2);
    for (int i = HARD; i < WEIGHTS; i++) {
        const MeReal top = stopHeight + MeMIN(heightOf(i), 0);
        for (int k = 0; k < RINGS; k++)
            MeMatrix4TMMakeFromRotationAndPosition(ringTM[i][k], R, placeX(i), top * ((MeReal)k + (MeReal)0.5) / RINGS,
                                                   0);
    }
}

static void showFigures(void) {
    char text[220];
    int n = snprintf(text, sizeof text, "first rebounds (m):");
    for (int i = 0; i < WEIGHTS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %.3f", (double)peak[i]);
    n += snprintf(text + n, sizeof text - (size_t)n, "    springs pressed by (m):");
    for (int i = HARD; i < WEIGHTS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %.3f", fabs((double)deepest[i]));
    snprintf(text + n, sizeof text - (size_t)n, "    stiffness %.0f N/m, threshold %s", (double)stiffness,
             hasLowThreshold ? "100" : "none");
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int k = 0; k < STEPS; k++) {
        MdtWorldStep(world, step);
        for (int i = 0; i < WEIGHTS; i++)
            measure(i);
    }
    drawSprings();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(WEIGHTS, WEIGHTS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* a weight is slow where it turns back */
    MdtMakeInertiaTensorBox(1, size, size, size, inertia);
    for (int i = 0; i < WEIGHTS; i++) {
        weight[i] = MdtBodyCreate(world);
        MdtBodySetInertiaTensor(weight[i], inertia);
        MdtBodySetPosition(weight[i], placeX(i), stopHeight + size / 2, 0); /* at the stop, where its way is zero */
        slider[i] = MdtPrismaticCreate(world);
        MdtPrismaticSetBodies(slider[i], weight[i], 0);
        MdtPrismaticSetAxis(slider[i], 0, 1, 0);
        MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limitOf(i)), 100); /* out of the way */
        MdtLimitActivateLimits(limitOf(i), 1);
        MdtPrismaticEnable(slider[i]);
    }
}

static void boxAt(float lx, float ly, float lz, MeReal x, MeReal y, const float *color) {
    const MeVector3 offset = {x, y, 0};
    RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, lx, ly, lz, color, 0), offset);
}

/* A weight on its rod, its stop, and the ring that shows the rebound. */
static void createPlace(int i) {
    static const int colorOf[WEIGHTS] = {0, 0, 0, 2, 2, 2};
    const float grey[4] = {.45f, .47f, .50f, 1}, w = (float)size;
    const MeReal x = placeX(i);
    RGraphicBoxCreate(rc, w, w, w, RPalette[colorOf[i]], MdtBodyGetTransformPtr(weight[i]));
    boxAt(.1f, 5.2f, .1f, x, (MeReal)2.6, grey);
    MeMatrix4TMFromEulerAnglesAndPosition(peakTM[i], ME_PI / 2, 0, 0, x, 0, 0);
    RGraphicTorusCreate(rc, .51f, .56f, RPalette[4], peakTM[i]);
    if (i < HARD)
        boxAt(w * 1.1f, (float)stopHeight, w * 1.1f, x, stopHeight / 2, grey);
    for (int k = 0; i >= HARD && k < RINGS; k++)
        RGraphicTorusCreate(rc, i == WEIGHTS - 1 ? .26f : .22f, .33f, RPalette[1], ringTM[i][k]);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1};
    const AcmeVector3 lookAt = {0, 2.1f, 0};
    for (int i = 0; i < WEIGHTS; i++)
        createPlace(i);
    boxAt(2 * (float)placeX(WEIGHTS - 1) + 1, .15f, .3f, 0, (MeReal)5.2, grey);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 14, .3f, .15f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Weights fall on hard stops and on soft ones.",
        "$ACTION2 - start again",
        "$ACTION3 - a low stiffness threshold, or none at all",
    };
    static const RParameter parameters[] = {
        {"height of the drop", "m", &drop, (MeReal)0.5, 3, (MeReal)0.5, .less = "Down", .more = "Up", .changed = Reset},
        {"stiffness of the springs", "N/m", &stiffness, 50, 1000, 50, .less = "Left", .more = "Right",
         .changed = Reset},
        {"the second stop's restitution", 0, &restitution[1], 0, 1, (MeReal)0.1, .less = "a", .more = "d",
         .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Limits");
    RRenderSetAppName(rc, "Limits");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 3);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleThreshold, 0);
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
