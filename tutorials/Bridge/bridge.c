/* Bridge: planks on ropes hang between two banks, and boxes fall on them (User Guide, chapter 5).
 *
 * Neighbouring planks have a hinge along their edges: the bridge bends, but it does not twist. Two ropes at each end
 * tie it to posts: a rope is a spring joint whose upper stop is hard and whose lower one does nothing (tutorial
 * Spring), so it pulls and cannot push, and the bridge may swing. It gives under each box that lands. Hinges and ropes
 * have no friction, so that it would swing for minutes: the planks are damped, and it hangs still in the end. Watch how
 * far the hinges open, how much longer the ropes get, and how low the bridge hangs.
 *
 * Planks that are hinged nearly touch; McdSpaceDisablePair keeps them from colliding.
 */
#include "play.h"
#include <stdio.h>

enum { PLANKS = 14, BOXES = 8, ROPES = 4 };

static const MeReal pitch = (MeReal)0.9;                                      /* m, from hinge to hinge */
static const MeReal plankSize[3] = {(MeReal)0.84, (MeReal)0.14, (MeReal)2.4}; /* m */
static const MeReal bankHeight = 4;                                           /* m */
static const MeReal endAngle = (MeReal)0.5;                                   /* rad, of the slope at the banks */

static McdModelID plank[PLANKS], box[BOXES];
static const MeReal ropeLength = (MeReal)0.6, ropeAside = (MeReal)1.1; /* m; from the middle of the bridge */
static MeVector3 start[PLANKS + 1]; /* where the planks' edges are, at first; hinges at all but the outer ones */
static MeVector3 post[ROPES];       /* where the ropes are tied to */
static RNativeLine *rope[ROPES];
static MeReal widest, longest; /* m: that a hinge was open, that a rope was longer */

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

static void createHinge(const MeVector3 at, McdModelID a, McdModelID b) {
    const MdtHingeID hinge = MdtHingeCreate(playUniverse->world);
    MdtHingeSetBodies(hinge, McdModelGetBody(a), McdModelGetBody(b));
    MdtHingeSetPosition(hinge, at[0], at[1], at[2]);
    MdtHingeSetAxis(hinge, 0, 0, 1);
    MdtHingeEnable(hinge);
    McdSpaceDisablePair(a, b);
}

/* ---- the ropes -------------------------------------------------------------------------------------------------- */

/* Ropes 0 and 1 are at the left end, 2 and 3 at the right one. */
static McdModelID endOf(int i) {
    return plank[i < 2 ? 0 : PLANKS - 1];
}

/* The corner of the outer plank that a rope holds. */
static void cornerOf(int i, MeVector3 p) {
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(endOf(i));
    const MeReal along = (i < 2 ? -pitch : pitch) / 2, aside = i & 1 ? ropeAside : -ropeAside;
    for (int k = 0; k < 3; k++)
        p[k] = tm[3][k] + along * tm[0][k] + aside * tm[2][k];
}

/* It cannot get longer; shorter than it is, it is slack. */
static void createRope(int i) {
    const MdtSpringID joint = MdtSpringCreate(playUniverse->world);
    const MdtSingleLimitID slack = MdtLimitGetLowerLimit(MdtSpringGetLimit(joint));
    const MdtSingleLimitID taut = MdtLimitGetUpperLimit(MdtSpringGetLimit(joint));
    MeVector3 corner;
    cornerOf(i, corner);
    MdtSpringSetBodies(joint, McdModelGetBody(endOf(i)), 0);
    MdtSpringSetPosition(joint, 0, corner[0], corner[1], corner[2]);
    MdtSpringSetPosition(joint, 1, post[i][0], post[i][1], post[i][2]);
    MdtSpringSetNaturalLength(joint, ropeLength);
    MdtSingleLimitSetStiffness(slack, 0);
    MdtSingleLimitSetDamping(slack, 0);
    MdtSingleLimitSetStiffness(taut, MEINFINITY);
    MdtSingleLimitSetRestitution(taut, 0);
    MdtSpringEnable(joint);
}

/* Tied to posts that stand in the line of the outer planks. */
static void createRopes(void) {
    static MeMatrix4 postTM[ROPES];
    static const float wood[4] = {.45f, .32f, .20f, 1}, hemp[4] = {.35f, .25f, .12f, 1};
    static const AcmeVector3 zero = {0, 0, 0};
    const McdGeometryID g = McdCylinderCreate(playUniverse->frame, (MeReal)0.12, (MeReal)0.9);
    MeMatrix3 upright;
    MeMatrix3MakeRotationX(upright, -ME_PI / 2);
    for (int i = 0; i < ROPES; i++) {
        cornerOf(i, post[i]);
        post[i][0] += (i < 2 ? -1 : 1) * ropeLength * MeCos(slopeOf(0));
        post[i][1] -= ropeLength * MeSin(slopeOf(0));
        MeMatrix4TMMakeFromRotationAndPosition(postTM[i], upright, post[i][0], post[i][1] - (MeReal)0.2, post[i][2]);
        playFixed(g, postTM[i], wood);
        createRope(i);
        rope[i] = RNLineCreate(playRc, zero, zero, hemp, 0);
    }
}

static void drawRopes(void) {
    for (int i = 0; i < ROPES; i++) {
        MeVector3 corner, way;
        cornerOf(i, corner);
        MeVector3Subtract(way, corner, post[i]);
        longest = MeMAX(longest, MeVector3Magnitude(way) - ropeLength);
        const AcmeVector3 ends[2] = {{(AcmeReal)post[i][0], (AcmeReal)post[i][1], (AcmeReal)post[i][2]},
                                     {(AcmeReal)corner[0], (AcmeReal)corner[1], (AcmeReal)corner[2]}};
        RNLineMoveEnds(rope[i], ends[0], ends[1]);
    }
}

/* ---- the bridge and its banks ----------------------------------------------------------------------------------- */

static void createBridge(void) {
    static const float wood[2][4] = {{.72f, .52f, .33f, 1}, {.63f, .44f, .27f, 1}};
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, plankSize[0], plankSize[1], plankSize[2]);
    layOut();
    for (int i = 0; i < PLANKS; i++) {
        plank[i] = playModel(g, 500, 0, 0, 0, wood[i & 1]);
        McdModelDynamicsSetDamping(plank[i], (MeReal)0.5, (MeReal)0.5); /* 1/s: hinges and ropes rub */
    }
    placePlanks();
    for (int i = 1; i < PLANKS; i++)
        createHinge(start[i], plank[i], plank[i - 1]);
    createRopes();
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

/* Of the hinge on the left of a plank. */
static MeReal openingOf(int i) {
    MeVector3 left, right;
    edgeOf(plank[i - 1], 1, left);
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
    widest = longest = 0;
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 1; i < PLANKS; i++)
        widest = MeMAX(widest, openingOf(i));
    drawRopes();
    snprintf(
        text, sizeof text,
        "boxes carried %d of %d    lowest plank at %.3f m    hinges open at most %.3f mm    ropes longer by %.3f mm    "
        "awake %d    motion %.3f J",
        countCarried(), BOXES, lowest(), 1000 * (double)widest, 1000 * (double)longest, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A bridge of planks on ropes, and boxes that fall on it.",
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
