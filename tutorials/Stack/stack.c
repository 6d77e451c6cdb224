/* Stack: a tower of boxes (User Guide, chapter 5, "The Bridge").
 *
 * Collision finds where boxes touch, the bridge makes contacts of that, dynamics holds them. The tower stands, goes to
 * sleep, and costs nothing then; a ball wakes what it hits. Watch the number of bodies that are awake. After two
 * seconds the ball is thrown; a tower that is built again stands until you throw it. The ground is soft for the ball:
 * by its rolling friction it comes to rest.
 */
#include "play.h"
#include <stdio.h>

enum { BOXES = 20 };

static McdModelID box[BOXES], ball;
static int untilThrow; /* frames, until the ball is thrown by itself; 0: it is not */

/* Not quite straight, as a child builds. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    untilThrow = 0;
    for (int i = 0; i < BOXES; i++)
        playPlace(box[i], (MeReal)(0.03 * (i % 3 - 1)), (MeReal)(0.5 + 1.005 * i), (MeReal)(0.03 * (i % 2)), 1,
                  (MeReal)(0.05 * (i % 5 - 2)));
    playPlace(ball, -8, (MeReal)0.8, 0, 0, 0);
}

static void MEAPI throwBall(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    untilThrow = 0;
    playPlace(ball, -8, 6, 0, 0, 0);
    MdtBodySetLinearVelocity(McdModelGetBody(ball), 16, 2, 0);
}

static double topOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[1] + .5;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    if (untilThrow > 0 && --untilThrow == 0)
        throwBall(context, 0);
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text, "top at %.4f m    awake %d of %d    contacts and groups %d    motion %.3f J",
             topOf(box[BOXES - 1]), playAwake(), BOXES + 1, MdtWorldGetTotalConstraints(playUniverse->world),
             playEnergy());
    RRenderSetStatusText(playRc, text);
}

/* A material of its own for the ball, with the friction of all others. Without rolling friction it would roll on for
 * ever; by 3 cm it loses 5/7 * 9.81 * .03 / .8 = .26 m/s in a second. Without spinning friction it would then turn on
 * the spot. */
static void softenGround(void) {
    const MstMaterialID iron = MstBridgeGetNewMaterial(playUniverse->bridge);
    const MdtContactParamsID p = playContact(0, iron);
    McdModelSetMaterial(ball, (int)iron);
    MdtContactParamsSetSurface(p, (MeReal)0.5, 0);
    MdtContactParamsSetRollingFriction(p, (MeReal)0.03);
    MdtContactParamsSetSpinningFriction(p, (MeReal)0.01);
}

static void createModels(void) {
    McdFrameworkID frame = playUniverse->frame;
    static const float iron[4] = {.30f, .32f, .36f, 1};
    const McdGeometryID cube = McdBoxCreate(frame, 1, 1, 1);
    playFloor();
    for (int i = 0; i < BOXES; i++)
        box[i] = playModel(cube, 1, 0, 0, 0, RPalette[i % 6]);
    ball = playModel(McdSphereCreate(frame, (MeReal)0.8), 5, 0, 0, 0, iron);
    softenGround();
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Twenty boxes, and a ball that is thrown after two seconds.",
        "$ACTION2 - build the tower again",
        "$ACTION3 - throw the ball",
    };
    if (!playStart(argc, argv, "Stack", BOXES + 1))
        return 1;
    createModels();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, throwBall, 0);
    playCamera(0, 9, 0, 36, .5f, .2f);
    Reset(playRc, 0);
    untilThrow = 120;
    playRun(Tick);
    return 0;
}
