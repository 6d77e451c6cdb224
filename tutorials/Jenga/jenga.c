/* Jenga: eighteen layers of three planks; pull one out (User Guide, chapter 5, "The Bridge").
 *
 * Pull with the mouse, or let the keys do it: a spring draws a plank out along its length, its other end moving away at
 * a steady pace. Friction of all that lies on the plank holds it back and tugs at its neighbours, yet the tower stands
 * as long as its centre of mass is above what is left. Key 3 draws the middle plank of a layer, slowly: two sides are
 * left, it stands. Key 4 draws a side plank of the same layer, faster: where the middle one is still there, the tower
 * stands, too; where it is gone, one plank at the side has to carry all, and the tower falls.
 *
 * After a second the middle plank is drawn by itself, and when it is out, the one beside it: until you press a key.
 * Watch the pull in the status line: nothing moves until it is greater than the friction can be.
 */
#include "play.h"
#include <stdio.h>

enum { LAYERS = 18, PLANKS = 3 * LAYERS, DRAWN_LAYER = 9, NONE = -1 };

static const double length = .75, width = .25, height = .15; /* m: ten times those of the game */
static const double gap = .003;                              /* m, between neighbours */
static const double density = 600;                           /* kg/m³ */
/* Wood gives way, .14 mm for a tonne. What rigid planks share of a load is undetermined: without this the middle one
 * may come to bear all of it, and to take the tower along. */
static const double compliance = 1e-5; /* 1/kg */

static McdModelID plank[PLANKS];
static int drawn;                           /* the plank that a key draws, or NONE */
static MeVector3 start;                     /* where it was */
static MeVector3 way;                       /* of length 1: along the plank */
static MeReal farEnd;                       /* m, from the start: the spring's far end */
static MeReal pace;                         /* m/s, of the far end */
static MeReal pull;                         /* N */
static enum { MIDDLE, SIDE, NOTHING } next; /* what is drawn by itself, until a key is pressed */
static int wait;                            /* frames until then, where no plank is being drawn */

/* ---- motion ----------------------------------------------------------------------------------------------------- */

/* Planks of even layers lie along x, those of odd ones along z. */
static void placePlank(int i) {
    const int layer = i / 3;
    const MeReal aside = (MeReal)((i % 3 - 1) * (width + gap)), y = (MeReal)((layer + .5) * height);
    if (layer % 2)
        playPlace(plank[i], aside, y, 0, 1, ME_PI / 2);
    else
        playPlace(plank[i], 0, y, aside, 1, 0);
}

/* From now on keys draw. What is drawn by itself moves by the fast solver, in a thirtieth of the time; keys get the
 * exact one, with which the pull is right to a percent. */
static void takeOver(void) {
    next = NOTHING;
    MdtWorldSetSolver(playUniverse->world, MdtSolverAuto);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < PLANKS; i++)
        placePlank(i);
    drawn = NONE;
    takeOver();
}

static void beginToDraw(int i, MeReal speed) {
    MeMatrix4Ptr tm = McdModelGetTransformPtr(plank[i]);
    drawn = i;
    MeVector3Copy(start, tm[3]);
    MeVector3Copy(way, tm[0]);
    farEnd = 0;
    pace = speed;
}

static void beginMiddle(void) {
    beginToDraw(3 * DRAWN_LAYER + 1, (MeReal)0.1);
}

/* Fast: where the middle plank is gone, this one bears half of what lies above, and drags it along with the friction
 * that the other side holds it with. Drawn at .6 m/s, the tower above came along by .3 m, and might stand on it. */
static void beginSide(void) {
    beginToDraw(3 * DRAWN_LAYER, 2);
}

static void MEAPI drawMiddle(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    takeOver();
    beginMiddle();
}

static void MEAPI drawSide(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    takeOver();
    beginSide();
}

/* First the middle plank, a second after the start; two seconds after that one is out, the one beside it. */
static void drawByItself(void) {
    if (next == NOTHING || drawn != NONE || --wait > 0)
        return;
    if (next == MIDDLE)
        beginMiddle();
    else
        beginSide();
    next++;
    wait = 120;
}

/* m, from where the plank was */
static MeReal wayOut(void) {
    MeVector3 d;
    MeVector3Subtract(d, McdModelGetTransformPtr(plank[drawn])[3], start);
    return MeVector3Dot(d, way);
}

/* The spring and its damper act along the plank, until it is out. */
static void draw(void) {
    const MdtBodyID b = McdModelGetBody(plank[drawn]);
    const MeReal stiffness = 20000, damping = 800; /* N/m, N s/m */
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    farEnd += pace * playFrame;
    pull = MeMAX(0, stiffness * (farEnd - wayOut()) + damping * (pace - MeVector3Dot(v, way)));
    if (!MdtBodyIsEnabled(b))
        MdtBodyEnable(b);
    MdtBodyAddForce(b, pull * way[0], pull * way[1], pull * way[2]);
    if (wayOut() > (MeReal)(1.2 * length))
        drawn = NONE;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    pull = 0;
    drawByItself();
    if (drawn != NONE)
        draw();
    MstUniverseStep(playUniverse, playFrame);
    const MeReal *top = McdModelGetTransformPtr(plank[PLANKS - 2])[3];
    snprintf(text, sizeof text,
             "top at %.4f m    off the middle by %.4f m    pull %.0f N    awake %d of %d    motion %.3f J",
             (double)top[1] + height / 2, (double)MeSqrt(top[0] * top[0] + top[2] * top[2]), (double)pull, playAwake(),
             PLANKS, playEnergy());
    RRenderSetStatusText(playRc, text);
}

/* ---- what there is ---------------------------------------------------------------------------------------------- */

static void createTower(void) {
    static const float wood[3][4] = {{.87f, .72f, .50f, 1}, {.80f, .62f, .40f, 1}, {.91f, .79f, .60f, 1}};
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, (MeReal)length, (MeReal)height, (MeReal)width);
    for (int i = 0; i < PLANKS; i++)
        plank[i] = playModel(g, (MeReal)density, 0, 0, 0, wood[(i + i / 3) % 3]);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Eighteen layers of three planks: pull one out, gently.",
        "$ACTION2 - build the tower again",
        "$ACTION3 - draw a middle plank: it stands",
        "$ACTION4 - draw a plank beside it: then it falls",
    };
    if (!playStart(argc, argv, "Jenga", PLANKS))
        return 1;
    playFloor();
    createTower();
    playHelp(help, 4);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, drawMiddle, 0);
    RRenderSetActionNCallBack(playRc, 4, drawSide, 0);
    playCamera(0, 1.25f, 0, 5.6f, -2.5f, .2f);
    Reset(playRc, 0);
    next = MIDDLE;
    wait = 60;
    MdtWorldSetEpsilon(playUniverse->world, (MeReal)compliance);
    MdtWorldSetSolver(playUniverse->world, MdtSolverFast);
    playRun(Tick);
    return 0;
}
