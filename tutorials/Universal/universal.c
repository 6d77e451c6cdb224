/* Universal: a bent drive shaft (Dynamics guide, chapter 3, "MdtUniversal").
 *
 * Three shafts: a motor turns the first, universal joints carry the rotation round two bends to the last. A universal
 * joint ties a point of two bodies together and keeps an axis of the one at right angles to an axis of the other: the
 * two bars of its cross. With a bend b its far side does not turn evenly. Twice in every turn its speed goes from cos b
 * to 1 / cos b times that of the near side, which the chart in the background shows.
 *
 * The second joint, with its bars the right way round, takes the ripple out again: the last shaft turns like the first.
 * Try: key 3 turns the second joint's bars by 90 degrees, and it adds its own ripple to that of the first.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { FIRST, MIDDLE, LAST, SHAFTS };

#define FORK_PARTS 4

static const MeReal step = (MeReal)(1.0 / 60);            /* s */
static const MeReal length[SHAFTS] = {2, (MeReal)2.4, 2}; /* m */
static const MeReal height = (MeReal)1.9;                 /* m, of the middle of it all above the ground */
static const MeReal discRadius = (MeReal)0.55;            /* m, of the flywheels on the first and last shaft */
static const int colorOf[SHAFTS] = {0, 1, 2};

static MdtWorldID world;
static MdtBodyID shaft[SHAFTS];
static MdtHingeID bearing[2]; /* of the first and the last shaft; the middle one needs none */
static MdtUniversalID cross[2];

static MeReal bend = 40; /* degrees */
static MeReal speed = 3; /* rad/s, of the motor */
static int isTurned;     /* the bars of the second joint, by 90 degrees */

static RRender *rc;
static RGraphic *post[2];
static RGraphic *fork[2][2][FORK_PARTS]; /* of the second joint: both ways round, on both sides */
static MeMatrix4 postTM[2];
static MeReal min[SHAFTS], max[SHAFTS]; /* the speeds of the last two shafts over that of the first, since Reset */
static int steps;
static MeReal chartAt[SHAFTS];      /* what was drawn last */
static MeReal turned, turnedBefore; /* rad, of the first shaft, 0 to 2 pi */

/* The middle shaft's ends, and where the others begin. */
static void jointAt(int i, MeReal angle, MeVector3 p) {
    const MeReal half = (i == 0 ? -length[MIDDLE] : length[MIDDLE]) / 2;
    MeVector3Set(p, half * MeCos(angle), height + half * MeSin(angle), 0);
}

static void place(int i, MeReal x, MeReal y, MeReal angle) {
    MdtBodySetPosition(shaft[i], x, y, 0);
    MdtBodySetQuaternion(shaft[i], MeCos(angle / 2), 0, 0, MeSin(angle / 2));
    MdtBodySetLinearVelocity(shaft[i], 0, 0, 0);
    MdtBodySetAngularVelocity(shaft[i], 0, 0, 0);
    MdtBodyEnable(shaft[i]);
}

static void placeShafts(MeReal angle) {
    MeVector3 p[2];
    jointAt(0, angle, p[0]);
    jointAt(1, angle, p[1]);
    place(FIRST, p[0][0] - length[FIRST] / 2, p[0][1], 0);
    place(MIDDLE, 0, height, angle);
    place(LAST, p[1][0] + length[LAST] / 2, p[1][1], 0);
}

/* Universal joints are set while the shafts are in line: so they know what being bent is. An axis for each body, at
 * right angles to the other and to the shafts. When the middle shaft's two bars are parallel, the ripples cancel. */
static void setCrosses(void) {
    placeShafts(0);
    for (int i = 0; i < 2; i++) {
        MeVector3 p;
        jointAt(i, 0, p);
        MdtUniversalDisable(cross[i]);
        MdtUniversalSetBodies(cross[i], shaft[FIRST + i], shaft[MIDDLE + i]);
        MdtUniversalSetPosition(cross[i], p[0], p[1], 0);
        if (i == 0 || isTurned)
            MdtUniversalSetAxes(cross[i], 0, 0, 1, 0, 1, 0);
        else
            MdtUniversalSetAxes(cross[i], 0, 1, 0, 0, 0, 1);
        MdtUniversalEnable(cross[i]);
    }
}

/* The bearings in which the first and the last shaft turn. */
static void setBearings(void) {
    placeShafts(bend * ME_PI / 180);
    for (int i = 0; i < 2; i++) {
        MeVector3 p;
        jointAt(i, bend * ME_PI / 180, p);
        MdtHingeDisable(bearing[i]);
        MdtHingeSetBodies(bearing[i], shaft[i == 0 ? FIRST : LAST], 0);
        MdtHingeSetPosition(bearing[i], p[0] + (i == 0 ? -1 : 1), p[1], 0);
        MdtHingeSetAxis(bearing[i], 1, 0, 0);
        MdtHingeEnable(bearing[i]);
    }
}

static void MEAPI setMotor(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(bearing[0]), speed, 200);
}

/* Pillars of the height that the bend asks for. */
static void createPosts(void) {
    const float grey[4] = {.45f, .47f, .50f, 1};
    for (int i = 0; i < 2; i++) {
        MeVector3 p;
        if (post[i])
            RGraphicDelete(rc, post[i], 0);
        MdtHingeGetPosition(bearing[i], p);
        MeMatrix4TMMakeIdentity(postTM[i]);
        MeMatrix4TMSetPosition(postTM[i], p[0], p[1] / 2 + (MeReal)0.1, 0);
        post[i] = RGraphicBoxCreate(rc, .3f, (float)p[1] + .2f, .4f, grey, postTM[i]);
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    setCrosses();
    setBearings();
    setMotor(context, userdata);
    createPosts();
    RLineRemoveAll(rc);
    turned = turnedBefore = 0;
    steps = 0;
    for (int i = 0; i < SHAFTS; i++)
        chartAt[i] = min[i] = max[i] = 1;
}

/* The forks of the second joint exist both ways round; what is in the list is drawn. */
static void showForks(void) {
    for (int k = 0; k < 2 * FORK_PARTS; k++) {
        RGraphicRemoveFromList(rc, fork[!isTurned][k / FORK_PARTS][k % FORK_PARTS], 0);
        RGraphicAddToList(rc, fork[isTurned][k / FORK_PARTS][k % FORK_PARTS], 0);
    }
}

static void MEAPI turnBars(RRender *context, void *userdata) {
    isTurned = !isTurned;
    showForks();
    Reset(context, userdata);
}

/* How fast a shaft turns about its own x axis. */
static MeReal rate(int i) {
    MeVector3 w;
    MdtBodyGetAngularVelocity(shaft[i], w);
    return MeVector3Dot(w, MdtBodyGetTransformPtr(shaft[i])[0]);
}

/* One turn of the first shaft is the width of the chart. */
static void chartPoint(MeReal angle, MeReal ratio, AcmeVector3 p) {
    p[0] = (float)(6 * (angle / (2 * ME_PI) - (MeReal)0.5));
    p[1] = (float)(4 + (ratio - 1));
    p[2] = -1.5f;
}

static void drawChart(int i, MeReal ratio) {
    AcmeVector3 from, to;
    const float *c = RPalette[colorOf[i]];
    chartPoint(turnedBefore, chartAt[i], from);
    chartPoint(turned, ratio, to);
    if (turned > turnedBefore && steps > 30) /* not across the whole chart, and not from a place without a figure */
        RLineAdd(rc, from, to, c[0], c[1], c[2]);
}

/* The speeds compared to the first shaft's, when the motor has brought it to its speed; a chart of one turn. */
static void measure(void) {
    const MeReal first = rate(FIRST), angle = MdtLimitGetPosition(MdtHingeGetLimit(bearing[0]));
    turnedBefore = turned;
    turned = angle - 2 * ME_PI * (MeReal)floor((double)(angle / (2 * ME_PI)));
    if (++steps < 30 || MeFabs(first) < (MeReal)0.1)
        return;
    const MeReal onChart = MeFabs(first) * step * (MeReal)(steps - 30); /* rad */
    for (int i = FIRST; i < SHAFTS; i++) {
        const MeReal ratio = rate(i) / first;
        if (onChart < 2 * ME_PI)
            drawChart(i, ratio);
        chartAt[i] = ratio;
        min[i] = MeMIN(min[i], ratio);
        max[i] = MeMAX(max[i], ratio);
    }
}

static void showFigures(void) {
    char text[200];
    snprintf(text, sizeof text,
             "bend %.0f deg    first %.2f rad/s    middle: slowest %.3f, fastest %.3f times that    "
             "last: slowest %.3f, fastest %.3f",
             (double)bend, (double)rate(FIRST), (double)min[MIDDLE], (double)max[MIDDLE], (double)min[LAST],
             (double)max[LAST]);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtWorldStep(world, step);
    measure();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    for (int k = 0; k < 4 * FORK_PARTS; k++) /* those in no list are ours */
        RGraphicDestroy(fork[k / FORK_PARTS / 2][k / FORK_PARTS % 2][k % FORK_PARTS]);
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(SHAFTS, 4);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* the motor goes on */
    for (int i = 0; i < SHAFTS; i++) {
        const MeReal thick = i == MIDDLE ? (MeReal)0.2 : discRadius;
        shaft[i] = MdtBodyCreate(world);
        MdtMakeInertiaTensorBox(1, length[i], thick, thick, inertia);
        MdtBodySetInertiaTensor(shaft[i], inertia);
    }
    for (int i = 0; i < 2; i++) {
        bearing[i] = MdtHingeCreate(world);
        cross[i] = MdtUniversalCreate(world);
    }
}

static RGraphic *boxAt(float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float *color,
                       MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphic *g = RGraphicBoxCreate(rc, lx, ly, lz, color, tm);
    RGraphicTranslateVertices(rc, g, offset);
    return g;
}

/* A cylinder along x. The shapes of the viewer lie along z, so it is combined with its turned self. */
static void rodAt(float radius, float lx, MeReal x, const float *color, MeMatrix4Ptr tm) {
    MeMatrix4 turn;
    RGraphic *nothing = RGraphicCreateEmpty(3), *rod = RGraphicCylinderCreate(rc, radius, lx, color, 0);
    MeMatrix4TMFromEulerAnglesAndPosition(turn, 0, ME_PI / 2, 0, x, 0, 0);
    RGraphic *turnedRod = RGraphicCombine(rc, nothing, rod, turn);
    RGraphicSetColor(turnedRod, color);
    RGraphicSetTransformPtr(turnedRod, tm);
    RGraphicDestroy(nothing);
    RGraphicDelete(rc, rod, 0);
}

/* A fork: a yoke with two prongs, which hold a bar of the cross, along y or along z, at the end of a shaft. */
static void createFork(int i, MeReal end, int isUpright, RGraphic *part[FORK_PARTS]) {
    const float *c = RPalette[colorOf[i]], dark[4] = {.30f, .31f, .33f, 1};
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(shaft[i]);
    const MeReal toEnd = end > 0 ? 1 : -1, y = isUpright ? (MeReal)0.2 : 0, z = isUpright ? 0 : (MeReal)0.2;
    const MeReal x = end - toEnd * (MeReal)0.05, back = end - toEnd * (MeReal)0.22;
    const float prong[2] = {.18f, .07f}, yoke[2] = {.26f, .47f}, bar[2] = {.07f, .46f};
    part[0] = boxAt(.4f, prong[isUpright], prong[!isUpright], x, y, z, c, tm);
    part[1] = boxAt(.4f, prong[isUpright], prong[!isUpright], x, -y, -z, c, tm);
    part[2] = boxAt(.08f, yoke[isUpright], yoke[!isUpright], back, 0, 0, c, tm);
    part[3] = boxAt(.07f, bar[isUpright], bar[!isUpright], end, 0, 0, dark, tm);
}

static void createShaftGraphics(void) {
    for (int i = 0; i < SHAFTS; i++) {
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(shaft[i]);
        const float *c = RPalette[colorOf[i]];
        const MeReal out = i == FIRST ? -length[i] / 2 : length[i] / 2;
        if (i == MIDDLE) {
            rodAt(.09f, (float)length[i] - .44f, 0, c, tm);
            continue;
        }
        rodAt(.09f, (float)length[i] - .22f, out > 0 ? (MeReal)0.11 : (MeReal)-0.11, c, tm);
        rodAt((float)discRadius, .14f, out, c, tm);
        boxAt(.17f, (float)discRadius * .9f, .1f, out, discRadius * (MeReal)0.45, 0, RPalette[4], tm); /* a hand */
    }
}

static void nameOnChart(MeReal angle, MeReal ratio, const char *text, const float color[4]) {
    AcmeVector3 p;
    chartPoint(angle, ratio, p);
    const MeVector3 place = {(MeReal)p[0], (MeReal)p[1], (MeReal)p[2]};
    RMarkText(rc, place, text, color);
}

static void MEAPI nameChart(RRender *context, void *userdata) {
    static const char *const ticks[] = {"0.5", "1", "1.5", "2"};
    static const float dark[4] = {.10f, .12f, .15f, 1};
    (void)context, (void)userdata;
    for (int i = 0; i < 4; i++)
        nameOnChart((MeReal)-0.5, (MeReal)(0.5 * (i + 1)) - (MeReal)0.08, ticks[i], dark);
    nameOnChart(0, (MeReal)2.25, "speed of the shafts over that of the first, in one turn of it", dark);
    nameOnChart((MeReal)6.3, (MeReal)1.35, "middle (orange)", dark);
    nameOnChart((MeReal)6.3, (MeReal)0.92, "last (green)", dark);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.55f, .57f, .60f, 1};
    const AcmeVector3 lookAt = {0, 2.3f, 0};
    RGraphic *firstFork[2][FORK_PARTS];
    AcmeVector3 from, to;
    createShaftGraphics();
    createFork(FIRST, length[FIRST] / 2, 0, firstFork[0]);
    createFork(MIDDLE, -length[MIDDLE] / 2, 1, firstFork[1]);
    for (int i = 0; i < 2; i++) {
        createFork(MIDDLE, length[MIDDLE] / 2, !i, fork[i][0]);
        createFork(LAST, -length[LAST] / 2, i, fork[i][1]);
    }
    for (int k = 0; k < 2 * FORK_PARTS; k++)
        RGraphicRemoveFromList(rc, fork[1][k / FORK_PARTS][k % FORK_PARTS], 0);
    chartPoint(0, (MeReal)0.4, from);
    chartPoint(0, 2, to);
    RGraphicLineCreate(rc, from, to, grey, 0);
    for (int i = 0; i <= 3; i++) {
        chartPoint(0, (MeReal)(0.5 * (i + 1)), from);
        chartPoint(2 * ME_PI, (MeReal)(0.5 * (i + 1)), to);
        RGraphicLineCreate(rc, from, to, grey, 0);
    }
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 8.6f, .3f, .12f);
    RRenderSetMarkCallBack(rc, nameChart, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "Universal joints carry a rotation round two bends.",
        "$ACTION2 - start again",
        "$ACTION3 - turn the second joint's bars",
    };
    static const RParameter parameters[] = {
        {"the motor's speed", "rad/s", &speed, -10, 10, (MeReal)0.5, .less = "Down", .more = "Up", .changed = setMotor},
        {"the bend", "degrees", &bend, 0, 60, 5, .less = "Left", .more = "Right", .changed = Reset},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Universal");
    RRenderSetAppName(rc, "Universal");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 2);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, turnBars, 0);
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
