/* Dominoes: five hundred along a spiral; the first is pushed (User Guide, chapter 5, "The Bridge").
 *
 * A domino that stands alone is a partition of its own, and asleep. The one that falls wakes the next; those that lean
 * on each other are solved together, and sleep again when they have come to rest. Watch the number of bodies that are
 * awake: the step costs what moves, not what there is.
 */
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { DOMINOES = 500 };

static const double thickness = .08, height = .4, width = .24; /* m */
static const double spacing = .2, pitch = .5, start = .8; /* m: along the spiral, between turns, its inner radius */
static const int pause = 60;                              /* frames, until the first is pushed */

static McdModelID domino[DOMINOES];
static int frames;

/* Along an Archimedean spiral from the inside out, each looking along it. */
static void MEAPI Reset(RRender *context, void *userdata) {
    const double slope = pitch / (2 * 3.14159265358979);
    double angle = 0;
    (void)context, (void)userdata;
    for (int i = 0; i < DOMINOES; i++) {
        const double r = start + slope * angle;
        playPlace(domino[i], (MeReal)(r * cos(angle)), (MeReal)(height / 2), (MeReal)(-r * sin(angle)), 1,
                  (MeReal)(angle + 1.5707963267949 - atan(slope / r)));
        angle += spacing / sqrt(r * r + slope * slope);
    }
    frames = 0;
}

/* At its top, forward: along its own x axis. */
static void push(McdModelID m) {
    const MdtBodyID b = McdModelGetBody(m);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(b);
    const MeReal impulse = (MeReal)0.5 * MdtBodyGetMass(b);
    MdtBodyEnable(b);
    MdtBodyAddImpulseAtPosition(b, impulse * tm[0][0], 0, impulse * tm[0][2], tm[3][0], (MeReal)height, tm[3][2]);
}

static void MEAPI pushFirst(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    push(domino[0]);
}

/* Turned by more than 30 degrees from the upright. */
static int fallen(void) {
    int count = 0;
    for (int i = 0; i < DOMINOES; i++)
        count += McdModelGetTransformPtr(domino[i])[1][1] < (MeReal)0.866;
    return count;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    if (++frames == pause)
        push(domino[0]);
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text, "fallen %d of %d    awake %d    motion %.3f J    after %.1f s", fallen(), DOMINOES,
             playAwake(), playEnergy(), frames / 60.);
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Five hundred dominoes; the first is pushed after a second.",
        "$ACTION2 - set them up again",
        "$ACTION3 - push the first once more",
    };
    if (!playStart(argc, argv, "Dominoes", DOMINOES))
        return 1;
    const McdGeometryID tile = McdBoxCreate(playUniverse->frame, (MeReal)thickness, (MeReal)height, (MeReal)width);
    playFloor();
    for (int i = 0; i < DOMINOES; i++)
        domino[i] = playModel(tile, 600, 0, 0, 0, RPalette[i / 10 % 6]);
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, pushFirst, 0);
    playCamera(0, 0, .3f, 13, .4f, .75f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
