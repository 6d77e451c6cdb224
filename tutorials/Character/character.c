/* Character: a capsule that is moved, not simulated (MstMover.h).
 *
 * It climbs stairs, walks along a ledge and down a ramp, rides a lift and pushes boxes, round and round, until an arrow
 * key takes over. A mover gets the velocity that its character wants, in each step, and says where it came to be:
 * gravity and jumps are the program's.
 */
#include "play.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STAIRS = 8, BOXES = 6, POINTS = 7, FIXED = STAIRS + 2 };

static MstMoverID mover;
static MstMoverResult at;
static MdtBodyID lift;
static McdModelID box[BOXES];
static MeMatrix4 fixedTM[FIXED];
static MeMatrix4 capsuleTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}; /* z, its axis, is up */
static MeReal jump;                                                                     /* m/s, in the next step */
static MeBool isSteered;
static int next;
static double now;                                                                                      /* s */
static const MeReal course[POINTS][2] = {{-4, 0}, {3, 0}, {3, 4}, {-5, 4}, {-7, 4}, {-7, 0}, {-6, -3}}; /* x, z */

static void addBlock(int i, MeReal lx, MeReal ly, MeReal lz, MeReal x, MeReal y, MeReal z, MeReal slope) {
    MeMatrix4TMMakeIdentity(fixedTM[i]);
    fixedTM[i][0][0] = fixedTM[i][1][1] = MeCos(slope);
    fixedTM[i][0][1] = MeSin(slope);
    fixedTM[i][1][0] = -MeSin(slope);
    MeMatrix4TMSetPosition(fixedTM[i], x, y, z);
    playFixed(McdBoxCreate(playUniverse->frame, lx, ly, lz), fixedTM[i], RPalette[3 + i % 2]);
}

static void addLevel(void) {
    for (int i = 0; i < STAIRS; i++) /* up to 1.6 m */
        addBlock(i, (MeReal)0.4, (MeReal)(0.2 * (i + 1)), 2, (MeReal)(-2 + 0.4 * i), (MeReal)(0.1 * (i + 1)), 0, 0);
    addBlock(STAIRS, 3, (MeReal)1.6, 6, (MeReal)2.7, (MeReal)0.8, 2, 0);
    addBlock(STAIRS + 1, (MeReal)4.4, (MeReal)0.2, 2, (MeReal)-0.86, (MeReal)0.7, 4, (MeReal)0.375); /* down again */
    lift = McdModelGetBody(
        playModel(McdBoxCreate(playUniverse->frame, 2, (MeReal)0.2, 2), 1000, -7, (MeReal)0.1, 4, RPalette[1]));
    MdtBodySetKinematic(lift, METRUE);
    for (int i = 0; i < BOXES; i++)
        box[i] = playModel(McdBoxCreate(playUniverse->frame, (MeReal)0.5, (MeReal)0.5, (MeReal)0.5), 200, 0, 0, 0,
                           RPalette[i % 3]);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    const MeVector3 start = {-6, (MeReal)0.1, -3};
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++)
        playPlace(box[i], (MeReal)(-6.4 + 0.52 * (i % 3)), (MeReal)(0.25 + 0.51 * (i / 3)), (MeReal)-1.5, 1, 0);
    MstMoverSetPosition(mover, start);
    memset(&at, 0, sizeof at);
    next = 0;
    isSteered = MEFALSE;
}

static void MEAPI Jump(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    jump = at.flags & kMstMoverOnGround ? 5 : 0;
}

/* Towards the next point of the course, or where the arrow keys say. */
static void heading(MeVector3 way) {
    const int x = MeAppGetKeyAxis(playApp, "Left", "Right"), z = MeAppGetKeyAxis(playApp, "Up", "Down");
    isSteered = isSteered || x || z;
    MeVector3Set(way, (MeReal)x, 0, (MeReal)z);
    if (!isSteered)
        MeVector3Set(way, course[next][0] - at.position[0], 0, course[next][1] - at.position[2]);
    if (!isSteered && MeVector3Magnitude(way) < (MeReal)0.3)
        next = (next + 1) % POINTS;
}

static void walk(void) {
    MeVector3 velocity;
    heading(velocity);
    const MeReal length = MeVector3Magnitude(velocity), fall = (MeReal)9.81 * playFrame;
    MeVector3Scale(velocity, length > 0 ? 2 / length : 0);
    velocity[1] = at.flags & kMstMoverOnGround ? jump : at.velocity[1] - fall;
    jump = 0;
    MstMoverMove(mover, velocity, playFrame, &at);
    MeVector3Copy(capsuleTM[3], at.position);
    capsuleTM[3][1] += MstMoverGetHeight(mover) / 2;
}

static void MEAPI Tick(RRender *context) {
    char text[120];
    (void)context;
    now += (double)playFrame;
    const MeVector3 place = {-7, (MeReal)(0.6 - 0.5 * cos(now)), 4};
    const MeVector4 upright = {1, 0, 0, 0};
    MdtBodyMoveTo(lift, place, upright);
    MstUniverseStep(playUniverse, playFrame);
    walk();
    snprintf(text, sizeof text, "at %.2f %.2f %.2f m   %s   ground moves at %.2f m/s", (double)at.position[0],
             (double)at.position[1], (double)at.position[2], at.flags & kMstMoverOnGround ? "on ground" : "in the air",
             (double)at.groundVelocity[1]);
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"$LEFT, $RIGHT, $UP, $DOWN - walk", "$ACTION2 - once more", "$ACTION3 - jump"};
    MstMoverParams params;
    if (!playStart(argc, argv, "Character", BOXES + 1))
        return 1;
    playFloor();
    addLevel();
    MstMoverSetDefaults(&params, playUniverse);
    mover = MstMoverCreate(playUniverse, &params, capsuleTM[3]);
    RGraphicSphylCreate(playRc, (AcmeReal)params.radius, (AcmeReal)(params.height - 2 * params.radius), RPalette[0],
                        capsuleTM);
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, Jump, 0);
    playCamera(-2, 1, 1, 14, .4f, .5f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
