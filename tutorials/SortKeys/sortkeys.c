/* SortKeys: the same simulation twice, bit for bit (Dynamics guide, chapter 4, "Sort Keys - Deterministic Simulation").
 *
 * Numbers are rounded, so the order of a sum matters, and a chaotic scene shows it: two chains of rods start the same,
 * but the joints of the second one are taken away and made anew in another order, as it happens when a game restarts a
 * level. Constraints are solved in the order of their sort keys, then of their creation. With a key for each joint both
 * chains do the same to the last bit, for ever. Without keys they are apart by a rounding error at first, and soon by
 * metres, as the third chain shows, which is made like the second and never has keys.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RODS = 6, KEYLESS = 2, COPIES };

static const MeReal step = (MeReal)(1.0 / 60);                                                  /* s */
static const MeReal size[3] = {(MeReal)0.7, (MeReal)0.12, (MeReal)0.12};                        /* m */
static const MeReal hookAt[COPIES][3] = {{(MeReal)-4.6, 5, 0}, {0, 5, 0}, {(MeReal)4.6, 5, 0}}; /* m */

static MdtWorldID world[COPIES]; /* worlds have nothing to do with each other */
static MdtBodyID rod[COPIES][RODS];
static MdtBSJointID joint[COPIES][RODS];

static int usesKeys = 1;
static int steps, sameUntil; /* the last step at which the two were the same */

static RRender *rc;
static MeMatrix4 shownTM[COPIES][RODS]; /* where the rods are drawn */

static void placeRods(int c) {
    for (int i = 0; i < RODS; i++) {
        MdtBodySetPosition(rod[c][i], ((MeReal)i + (MeReal)0.5) * size[0], 0, 0); /* from the hook */
        MdtBodySetQuaternion(rod[c][i], 1, 0, 0, 0);
        MdtBodySetLinearVelocity(rod[c][i], 0, 0, 0);
        MdtBodySetAngularVelocity(rod[c][i], 0, (MeReal)0.4, 0);
        MdtBodyEnable(rod[c][i]);
    }
}

static void createJoint(int c, int i) {
    if (joint[c][i])
        MdtBSJointDestroy(joint[c][i]);
    joint[c][i] = MdtBSJointCreate(world[c]);
    MdtBSJointSetBodies(joint[c][i], rod[c][i], i > 0 ? rod[c][i - 1] : 0);
    MdtBSJointSetPosition(joint[c][i], (MeReal)i * size[0], 0, 0);
    MdtBSJointSetSortKey(joint[c][i], usesKeys && c != KEYLESS ? i : 0);
    MdtBSJointEnable(joint[c][i]);
}

/* The joints of all copies but the first are made from the last to the first. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int c = 0; c < COPIES; c++) {
        placeRods(c);
        for (int i = 0; i < RODS; i++)
            createJoint(c, c == 0 ? i : RODS - 1 - i);
    }
    steps = sameUntil = 0;
}

static void MEAPI toggleKeys(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    usesKeys = !usesKeys;
    Reset(rc, 0);
}

static int areSame(void) {
    for (int i = 0; i < RODS; i++)
        if (memcmp(MdtBodyGetTransformPtr(rod[0][i]), MdtBodyGetTransformPtr(rod[1][i]), sizeof(MeMatrix4)) != 0)
            return 0;
    return 1;
}

/* m, of the ends of a copy and the first one. */
static double distanceTo(int copy) {
    MeVector3 p[2];
    double square = 0;
    MdtBodyGetPosition(rod[0][RODS - 1], p[0]);
    MdtBodyGetPosition(rod[copy][RODS - 1], p[1]);
    for (int i = 0; i < 3; i++)
        square += pow((double)p[0][i] - (double)p[1][i], 2);
    return sqrt(square);
}

static void showFigures(void) {
    char text[200];
    snprintf(
        text, sizeof text,
        "sort keys %s    step %d    %s    the ends are %.2e m apart    the same for %d steps    red, without keys: "
        "%.2e m apart",
        usesKeys ? "on" : "off", steps, areSame() ? "same bits" : "different", distanceTo(1), sameUntil,
        distanceTo(KEYLESS));
    RRenderSetStatusText(rc, text);
}

/* All worlds have their hook at the origin, since numbers round differently elsewhere; the pictures are moved apart.
 * */
static void showRods(void) {
    for (int c = 0; c < COPIES; c++) {
        for (int i = 0; i < RODS; i++) {
            MdtBodyGetTransform(rod[c][i], shownTM[c][i]);
            for (int k = 0; k < 3; k++)
                shownTM[c][i][3][k] += hookAt[c][k];
        }
    }
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    for (int c = 0; c < COPIES; c++)
        MdtWorldStep(world[c], step);
    steps++;
    if (areSame())
        sameUntil = steps;
    showRods();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    for (int c = 0; c < COPIES; c++)
        MdtWorldDestroy(world[c]);
}

static void createDynamics(int c) {
    MeMatrix3 inertia;
    world[c] = MdtWorldCreate(RODS, RODS);
    MdtWorldSetGravity(world[c], 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world[c], 0);
    MdtMakeInertiaTensorBox(1, size[0], size[1], size[2], inertia);
    for (int i = 0; i < RODS; i++) {
        rod[c][i] = MdtBodyCreate(world[c]);
        MdtBodySetInertiaTensor(rod[c][i], inertia);
        MdtBodySetSortKey(rod[c][i], i);
    }
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1};
    const AcmeVector3 lookAt = {.6f, 3.9f, 0};
    static MeMatrix4 hookTM[COPIES];
    for (int c = 0; c < COPIES; c++) {
        MeMatrix4TMMakeIdentity(hookTM[c]);
        MeMatrix4TMSetPosition(hookTM[c], hookAt[c][0], hookAt[c][1], hookAt[c][2]);
        RGraphicBoxCreate(rc, .3f, .3f, .3f, grey, hookTM[c]);
        for (int i = 0; i < RODS; i++)
            RGraphicBoxCreate(rc, (float)size[0] * .94f, (float)size[1], (float)size[2],
                              c == KEYLESS ? RPalette[3] : RPalette[c], shownTM[c][i]);
    }
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 13, .15f, .1f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Two chains, made in different order, do the same to the last bit; the red one has no keys.",
        "$ACTION2 - start again",
        "$ACTION3 - sort keys on or off",
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: SortKeys");
    RRenderSetAppName(rc, "SortKeys");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleKeys, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    for (int c = 0; c < COPIES; c++)
        createDynamics(c);
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
