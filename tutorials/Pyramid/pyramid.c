/* Pyramid: fifty-five boxes in ten rows, and what the solver says of every step (User Guide, chapter 5, "The Bridge";
 * MdtReport.h).
 *
 * Every box stands on two others, so that there are many ways to share the weight and the solver has to choose one. The
 * status line tells how many equations a step had (rows), how many iterations it took, by how much the answer is off
 * (residual, the largest speed that a contact should have prevented), and how deep the deepest contact is. Watch the
 * rows vanish when the pyramid has come to rest, and come back with the weight that is put on top after two seconds, or
 * by key 3.
 */
#include "play.h"
#include <stdio.h>

enum { ROWS = 10, BOXES = ROWS * (ROWS + 1) / 2 };

static const double width = 1, height = .6; /* m, of a box */

static McdModelID box[BOXES], block;
static int untilLoad; /* frames, until the block is put on top by itself; 0: it is not */

/* The lowest row first, a quarter of a box free between neighbours. */
static void MEAPI Reset(RRender *context, void *userdata) {
    int n = 0;
    (void)context, (void)userdata;
    untilLoad = 0;
    for (int row = 0; row < ROWS; row++)
        for (int i = 0; i < ROWS - row; i++, n++)
            playPlace(box[n], (MeReal)(1.25 * width * (i - (ROWS - row - 1) / 2.)), (MeReal)((row + .5) * height), 0, 0,
                      0);
    playPlace(block, -5, (MeReal)0.4, 5, 0, 0);
}

/* As heavy as all the boxes together: just above the top, to come down gently. */
static void MEAPI load(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    untilLoad = 0;
    playPlace(block, 0, (MeReal)(ROWS * height + .41), 0, 0, 0);
}

/* Whether bodies at rest are put to sleep: without, the report has something to tell for as long as one looks. */
static void MEAPI toggleSleep(RRender *context, void *userdata) {
    const MdtWorldID w = playUniverse->world;
    (void)context, (void)userdata;
    untilLoad = 0;
    MdtWorldSetAutoDisable(w, !MdtWorldGetAutoDisable(w));
    for (int i = 0; i < BOXES; i++)
        McdModelDynamicsEnable(box[i]);
}

static double top(void) {
    MeVector3 p;
    McdModelDynamicsGetPosition(box[BOXES - 1], p);
    return (double)p[1] + height / 2;
}

static void showReport(void) {
    MdtReport report;
    char text[240];
    MdtWorldGetReport(playUniverse->world, &report);
    snprintf(text, sizeof text,
             "top at %.4f m    awake %d of %d    rows %d    iterations %d    residual %.1e m/s    deepest %.4f mm",
             top(), playAwake(), BOXES + 1, report.rows, report.iterations, (double)report.residualVelocity,
             1000 * (double)report.penetration);
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    if (untilLoad > 0 && --untilLoad == 0)
        load(context, 0);
    MstUniverseStep(playUniverse, playFrame);
    showReport();
}

static void createModels(void) {
    static const float iron[4] = {.30f, .32f, .36f, 1};
    const McdFrameworkID frame = playUniverse->frame;
    const McdGeometryID brick = McdBoxCreate(frame, (MeReal)width, (MeReal)height, 1);
    int n = 0;
    playFloor();
    for (int row = 0; row < ROWS; row++)
        for (int i = 0; i < ROWS - row; i++, n++)
            box[n] = playModel(brick, 1, 0, 0, 0, RPalette[(row + i) % 6]);
    block = playModel(McdBoxCreate(frame, (MeReal)0.8, (MeReal)0.8, (MeReal)0.8), 64, 0, 0, 0, iron);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A pyramid, on which a block is put after two seconds, and the solver's report of every step.",
        "$ACTION2 - build it again",
        "$ACTION3 - put a heavy block on top",
        "$ACTION4 - sleep or stay awake",
    };
    if (!playStart(argc, argv, "Pyramid", BOXES + 1))
        return 1;
    createModels();
    MdtWorldEnableReport(playUniverse->world);
    playHelp(help, 4);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, load, 0);
    RRenderSetActionNCallBack(playRc, 4, toggleSleep, 0);
    playCamera(0, 2.6f, 0, 18, .35f, .22f);
    Reset(playRc, 0);
    untilLoad = 120;
    playRun(Tick);
    return 0;
}
