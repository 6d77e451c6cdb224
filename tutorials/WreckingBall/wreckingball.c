/* WreckingBall: a heavy ball on a light chain swings into a wall (User Guide, chapter 5, "The Bridge").
 *
 * Joints and contacts in one: the links hang on ball-and-socket joints, the bricks stand on each other by contacts, and
 * in the moment in which the ball hits, all of it is one system that Kea solves at once. The ball weighs some hundred
 * times what a link weighs; the status line shows how far the worst joint opens, above all in the blow.
 *
 * Links that are joined overlap at their ends. They are not to collide: McdSpaceDisablePair says so.
 */
#include "play.h"
#include <stdio.h>

enum { LINKS = 12, COLUMNS = 5, ROWS = 6, BRICKS = COLUMNS * ROWS };

static const MeReal linkLength = (MeReal)0.5, linkRadius = (MeReal)0.09; /* m */
static const MeReal ballRadius = (MeReal)0.8;                            /* m */
static const MeReal height = 9;                                          /* m, of the hook */
static const MeReal startAngle = (MeReal)-1.25;                          /* rad, from hanging down */
static const MeReal aside = (MeReal)0.2; /* of a brick, by rows; from .245 on those at the ends tip over */
static const MeReal brickSize[3] = {(MeReal)0.7, (MeReal)0.7, (MeReal)1.4};

static McdModelID link[LINKS], ball, brick[BRICKS];
static MdtBSJointID joint[LINKS + 1];
static MeReal widest; /* m, that a joint was open since the start */

/* ---- the crane ------------------------------------------------------------------------------------------------ */

/* A body on the line that hangs from the hook at the start angle, its z axis along the line. */
static void placeOnLine(McdModelID m, MeReal down) {
    const MdtBodyID body = McdModelGetBody(m);
    const MeVector3 z = {0, 0, 1}, along = {MeSin(startAngle), -MeCos(startAngle), 0};
    MeVector4 q;
    MeQuaternionForRotation(q, z, along);
    playPlace(m, down * along[0], height + down * along[1], 0, 0, 0);
    MdtBodySetQuaternion(body, q[0], q[1], q[2], q[3]);
}

static void placeChain(void) {
    for (int i = 0; i < LINKS; i++)
        placeOnLine(link[i], ((MeReal)i + (MeReal)0.5) * linkLength);
    placeOnLine(ball, LINKS * linkLength + ballRadius);
}

static void join(int i, McdModelID above, McdModelID below) {
    const MeReal down = (MeReal)i * linkLength;
    joint[i] = MdtBSJointCreate(playUniverse->world);
    MdtBSJointSetBodies(joint[i], McdModelGetBody(below), above ? McdModelGetBody(above) : 0);
    MdtBSJointSetPosition(joint[i], down * MeSin(startAngle), height - down * MeCos(startAngle), 0);
    MdtBSJointEnable(joint[i]);
    if (above)
        McdSpaceDisablePair(above, below);
}

static void createCrane(void) {
    static const float steel[4] = {.45f, .48f, .52f, 1}, iron[4] = {.26f, .28f, .32f, 1};
    static MeMatrix4 hookTM;
    const McdGeometryID sphyl = McdSphylCreate(playUniverse->frame, linkRadius, linkLength - 2 * linkRadius);
    for (int i = 0; i < LINKS; i++)
        link[i] = playModel(sphyl, 1000, 0, 0, 0, steel);
    ball = playModel(McdSphereCreate(playUniverse->frame, ballRadius), 2000, 0, 0, 0, iron);
    placeChain();
    for (int i = 0; i <= LINKS; i++)
        join(i, i > 0 ? link[i - 1] : 0, i < LINKS ? link[i] : ball);
    MeMatrix4TMMakeIdentity(hookTM);
    MeMatrix4TMSetPosition(hookTM, 0, height + (MeReal)0.2, 0);
    RGraphicBoxCreate(playRc, .5f, .4f, .5f, RPalette[4], hookTM);
}

/* Where a body's axis is, so far along it. */
static void pointOn(McdModelID m, MeReal along, MeVector3 p) {
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    for (int k = 0; k < 3; k++)
        p[k] = tm[3][k] + along * tm[2][k];
}

static MeReal openingOf(int i) {
    MeVector3 above = {0, height, 0}, below;
    if (i > 0)
        pointOn(link[i - 1], linkLength / 2, above);
    if (i < LINKS)
        pointOn(link[i], -linkLength / 2, below);
    else
        pointOn(ball, -ballRadius, below);
    MeVector3Subtract(below, below, above);
    return MeVector3Magnitude(below);
}

/* ---- the wall ------------------------------------------------------------------------------------------------- */

/* Across the ball's way, every second row shifted. */
static void placeWall(void) {
    for (int i = 0; i < BRICKS; i++) {
        const int column = i % COLUMNS, row = i / COLUMNS;
        const MeReal z = ((MeReal)column - (MeReal)(COLUMNS - 1) / 2 + (row & 1 ? aside : -aside));
        playPlace(brick[i], (MeReal)0.8, ((MeReal)row + (MeReal)0.5) * brickSize[1], z * (brickSize[2] + (MeReal)0.02),
                  0, 0);
    }
}

static void createWall(void) {
    const McdGeometryID box = McdBoxCreate(playUniverse->frame, brickSize[0], brickSize[1], brickSize[2]);
    for (int i = 0; i < BRICKS; i++)
        brick[i] = playModel(box, 200, 0, 0, 0, RPalette[(i / COLUMNS + i % COLUMNS) % 2 ? 1 : 3]);
    placeWall();
}

static int countStanding(void) {
    int standing = 0;
    for (int i = 0; i < BRICKS; i++) {
        MeVector3 p;
        McdModelDynamicsGetPosition(brick[i], p);
        standing += p[1] > ((MeReal)(i / COLUMNS) + (MeReal)0.4) * brickSize[1];
    }
    return standing;
}

/* ---- the program ---------------------------------------------------------------------------------------------- */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    placeChain();
    placeWall();
    widest = 0;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i <= LINKS; i++)
        widest = MeMAX(widest, openingOf(i));
    snprintf(text, sizeof text,
             "ball %.0f kg, link %.1f kg    bricks standing %d of %d    joints open at most %.3f mm    awake %d",
             (double)MdtBodyGetMass(McdModelGetBody(ball)), (double)MdtBodyGetMass(McdModelGetBody(link[0])),
             countStanding(), BRICKS, 1000 * (double)widest, playAwake());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A ball on a chain, and a wall in its way.",
        "$ACTION2 - once more",
    };
    if (!playStart(argc, argv, "WreckingBall", LINKS + 1 + BRICKS))
        return 1;
    /* Some 5 ms of a step at most, where the exact blow takes 50; the joints of the chain stay closed with that. */
    MdtWorldSetWorkBudget(playUniverse->world, 24);
    playFloor();
    createCrane();
    createWall();
    playHelp(help, 2);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    playCamera(-1, 4.2f, 0, 21, .6f, .2f);
    playRun(Tick);
    return 0;
}
