/* Bridge: planks joined by hinges hang between two banks, and boxes fall on them (User Guide, chapter 5).
 *
 * A hinge between the banks and the outer planks, and one between any two that are neighbours, along the planks' edges:
 * the bridge bends, but it does not twist. It gives under each box that lands, and hangs still in the end. Watch how far
 * the hinges open, and how low the bridge hangs.
 *
 * Planks that are hinged nearly touch; McdSpaceDisablePair keeps them from colliding.
 */
#include "play.h"
#include <stdio.h>

enum { PLANKS = 14, BOXES = 8 };

static const MeReal pitch = (MeReal)0.9;                                      /* m, from hinge to hinge */
static const MeReal plankSize[3] = {(MeReal)0.84, (MeReal)0.14, (MeReal)2.4}; /* m */
static const MeReal bankHeight = 4;                                           /* m */
static const MeReal endAngle = (MeReal)0.5;                                   /* rad, of the slope at the banks */

static McdModelID plank[PLANKS], box[BOXES];
static MdtHingeID hinge[PLANKS + 1];
static MeVector3 start[PLANKS + 1]; /* where the hinges are, at first */
static MeReal widest;               /* m, that a hinge was open */

/* ---- the bridge ------------------------------------------------------------------------------------------------- */

/* The slope at which a plank starts: together they hang in a round. */
static MeReal slopeOf(int i) {
    return endAngle * (2 * ((MeReal)i + (MeReal)0.5) / PLANKS - 1);
}

/* From the left bank on; the middle is at x = 0. */
static void layOut(void) {
    MeReal span = 0;
    for (int i = 0; i < PLANKS; i++)
        span += pitch * MeCos(slopeOf(i));
    MeVector3Set(start[0], -span / 2, bankHeight, 0);
    for (int i = 0; i < PLANKS; i++)
        MeVector3Set(start[i + 1], start[i][0] + pitch * MeCos(slopeOf(i)), start[i][1] + pitch * MeSin(slopeOf(i)), 0);
}

static void placePlanks(void) {
    for (int i = 0; i < PLANKS; i++)
        playPlace(plank[i], (start[i][0] + start[i + 1][0]) / 2, (start[i][1] + start[i + 1][1]) / 2, 0, 2, slopeOf(i));
}

/* Number i has plank i on its right; the outer ones have a bank, which is the world, on one side. */
static void createHinge(int i, McdModelID a, McdModelID b) {
    hinge[i] = MdtHingeCreate(playUniverse->world);
    MdtHingeSetBodies(hinge[i], McdModelGetBody(a), b ? McdModelGetBody(b) : 0);
    MdtHingeSetPosition(hinge[i], start[i][0], start[i][1], start[i][2]);
    MdtHingeSetAxis(hinge[i], 0, 0, 1);
    MdtHingeEnable(hinge[i]);
    if (b)
        McdSpaceDisablePair(a, b);
}

static void createBridge(void) {
    static const float wood[2][4] = {{.72f, .52f, .33f, 1}, {.63f, .44f, .27f, 1}};
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, plankSize[0], plankSize[1], plankSize[2]);
    layOut();
    for (int i = 0; i < PLANKS; i++)
        plank[i] = playModel(g, 500, 0, 0, 0, wood[i & 1]);
    placePlanks();
    createHinge(0, plank[0], 0);
    for (int i = 1; i < PLANKS; i++)
        createHinge(i, plank[i], plank[i - 1]);
    createHinge(PLANKS, plank[PLANKS - 1], 0);
}

static void createBanks(void) {
    static MeMatrix4 bankTM[2];
    static const float grass[4] = {.50f, .62f, .42f, 1};
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, 4, bankHeight, 5);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(bankTM[i]);
        MeMatrix4TMSetPosition(bankTM[i], (i ? 1 : -1) * (start[PLANKS][0] + (MeReal)2.05), bankHeight / 2, 0);
        const McdModelID bank = playFixed(g, bankTM[i], grass);
        McdSpaceDisablePair(bank, plank[i ? PLANKS - 1 : 0]);
    }
}

/* Where a plank's edge is: -1 its left one, 1 its right one. */
static void edgeOf(McdModelID m, MeReal side, MeVector3 p) {
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    for (int k = 0; k < 3; k++)
        p[k] = tm[3][k] + side * pitch / 2 * tm[0][k];
}

static MeReal openingOf(int i) {
    MeVector3 left, right;
    MeVector3Copy(left, start[i]);
    MeVector3Copy(right, start[i]);
    if (i > 0)
        edgeOf(plank[i - 1], 1, left);
    if (i < PLANKS)
        edgeOf(plank[i], -1, right);
    MeVector3Subtract(left, left, right);
    return MeVector3Magnitude(left);
}

static double lowest(void) {
    MeReal low = bankHeight;
    for (int i = 0; i < PLANKS; i++)
        low = MeMIN(low, McdModelGetTransformPtr(plank[i])[3][1]);
    return (double)low;
}

/* ---- boxes ------------------------------------------------------------------------------------------------------ */

static void placeBoxes(void) {
    for (int i = 0; i < BOXES; i++)
        playPlace(box[i], (MeReal)(0.9 * (i * 3 % BOXES - 3.5)), (MeReal)(5 + 1.3 * i), (MeReal)(0.3 * (i % 3 - 1)),
                  i % 3, (MeReal)(0.2 * (i % 4)));
}

static void createBoxes(void) {
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, (MeReal)0.8, (MeReal)0.8, (MeReal)0.8);
    for (int i = 0; i < BOXES; i++)
        box[i] = playModel(g, 400, 0, 0, 0, RPalette[i % 4]);
    placeBoxes();
}

static int countCarried(void) {
    int carried = 0;
    for (int i = 0; i < BOXES; i++) {
        const MeReal *p = McdModelGetTransformPtr(box[i])[3];
        carried += p[1] > (MeReal)lowest() && MeFabs(p[2]) < plankSize[2] / 2;
    }
    return carried;
}

/* ---- the program ------------------------------------------------------------------------------------------------ */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placePlanks();
    placeBoxes();
    widest = 0;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i <= PLANKS; i++)
        widest = MeMAX(widest, openingOf(i));
    snprintf(
        text, sizeof text,
        "boxes carried %d of %d    lowest plank at %.3f m    hinges open at most %.3f mm    awake %d    motion %.3f J",
        countCarried(), BOXES, lowest(), 1000 * (double)widest, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A bridge of planks, and boxes that fall on it.",
        "$ACTION2 - once more",
    };
    if (!playStart(argc, argv, "Bridge", PLANKS + BOXES))
        return 1;
    playFloor();
    createBridge();
    createBanks();
    createBoxes();
    playHelp(help, 2);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    playCamera(0, 3.4f, 0, 23, .45f, .25f);
    playRun(Tick);
    return 0;
}
