/* Arch: stones that hold each other, without glue (User Guide, chapter 4, convex meshes; chapter 5, "The Bridge").
 *
 * Fifteen equal wedges, each a convex mesh, make a half circle. Every stone is held by the thrust of its neighbours and
 * by friction. That there is a line of thrust within the stones is a matter of thickness: at least .107 of the radius
 * (Heyman 1969); here it is .18. Watch how little the crown sinks, with and without a weight on it: it comes by itself
 * after two seconds, and after five the keystone goes. An arch that is built again waits for you to do that.
 */
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { STONES = 15, KEYSTONE = STONES / 2, NONE = -1 };

static const double inner = 3, outer = 3.6, depth = 1.4; /* m */
static const double pi = 3.14159265358979;

static McdModelID stone[STONES], weight;
static int shown;     /* frames of what happens by itself; NONE: a key was pressed, and nothing does */
static double radius; /* m, from the middle of the arch to the middle of a stone's mass */

/* The middle of mass of a trapezium, from the two sides that are parallel. */
static double middle(double y1, double side1, double y2, double side2) {
    return y1 + (y2 - y1) * (side1 + 2 * side2) / (3 * (side1 + side2));
}

/* The stone at the crown, about the middle of its mass. */
static McdGeometryID createWedge(void) {
    const double half = pi / STONES / 2, r[2] = {inner, outer};
    MeVector3 corner[8];
    radius = middle(inner * cos(half), inner * sin(half), outer * cos(half), outer * sin(half));
    for (int i = 0; i < 8; i++)
        MeVector3Set(corner[i], (MeReal)((i & 1 ? 1 : -1) * r[i >> 2] * sin(half)),
                     (MeReal)(r[i >> 2] * cos(half) - radius), (MeReal)((i & 2 ? .5 : -.5) * depth));
    return McdConvexMeshCreateHull(playUniverse->frame, (const MeVector3 *)corner, 8, 0);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    for (int i = 0; i < STONES; i++) {
        const double angle = pi * (i + .5) / STONES;
        playPlace(stone[i], (MeReal)(radius * cos(angle)), (MeReal)(radius * sin(angle)), 0, 2,
                  (MeReal)(angle - pi / 2));
    }
    playPlace(weight, 6, (MeReal)0.5, 1, 0, 0);
}

/* A block as heavy as three stones comes down on the crown. */
static void putWeight(void) {
    playPlace(weight, 0, (MeReal)(outer + .505), 0, 0, 0);
}

static void takeStone(void) {
    playPlace(stone[KEYSTONE], 0, (MeReal)0.5, 4, 0, 0);
    for (int i = 0; i < STONES; i++) /* what leaned on it is to notice */
        McdModelDynamicsEnable(stone[i]);
}

static void MEAPI load(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    putWeight();
}

static void MEAPI takeKeystone(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    takeStone();
}

static void showItself(void) {
    if (shown == NONE)
        return;
    shown++;
    if (shown == 120)
        putWeight();
    else if (shown == 300)
        takeStone();
}

/* m, by which the lower of the keystone's neighbours is lower than it was built. */
static double sunk(void) {
    const double built = radius * cos(pi / STONES);
    double low = built;
    for (int i = KEYSTONE - 1; i <= KEYSTONE + 1; i += 2) {
        MeVector3 p;
        McdModelDynamicsGetPosition(stone[i], p);
        low = fmin(low, (double)p[1]);
    }
    return built - low;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    showItself();
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text, "sunk by %.4f mm    awake %d of %d    motion %.1e J", 1000 * sunk(), playAwake(),
             STONES + 1, playEnergy());
    RRenderSetStatusText(playRc, text);
}

static void createModels(void) {
    static const float sand[2][4] = {{.80f, .70f, .52f, 1}, {.72f, .62f, .46f, 1}}, key[4] = {.80f, .42f, .30f, 1};
    static const float iron[4] = {.30f, .32f, .36f, 1};
    const McdGeometryID wedge = createWedge();
    playFloor();
    for (int i = 0; i < STONES; i++)
        stone[i] = playModel(wedge, 2400, 0, 0, 0, i == KEYSTONE ? key : sand[i % 2]);
    weight = playModel(McdBoxCreate(playUniverse->frame, 1, 1, 1), 4000, 0, 0, 0, iron);
    MdtContactParamsSetFrictionCoeffecient(playContact(0, 0), (MeReal)0.7);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "An arch of stones without glue; a weight comes after two seconds, the keystone goes after five.",
        "$ACTION2 - build it again",
        "$ACTION3 - put a weight on the crown",
        "$ACTION4 - take the keystone away",
    };
    if (!playStart(argc, argv, "Arch", STONES + 1))
        return 1;
    createModels();
    playHelp(help, 4);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, load, 0);
    RRenderSetActionNCallBack(playRc, 4, takeKeystone, 0);
    playCamera(.6f, 1.6f, 0, 12.5f, .45f, .2f);
    Reset(playRc, 0);
    shown = 0;
    playRun(Tick);
    return 0;
}
