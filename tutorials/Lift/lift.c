/* Lift: bodies that the program moves, and what they carry (MdtBodySetKinematic, MdtBodyMoveTo).
 *
 * A lift, a ferry, two doors and a carousel go where the program says: in each step it says where they are to be at the
 * step's end. Nothing that they meet can move them; they push what is in their way, and friction carries what stands on
 * them, until it would have to be larger than the weight allows: boxes far out on the carousel slide off where w² r is
 * more than mu g.
 *
 * Watch the status line: by how much the boxes on the lift are above it while it starts and stops, and how many boxes
 * are left on the carousel.
 */
#include "RParameter.h"
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { LIFT, FERRY, DOOR, DOOR2, CAROUSEL, MOVERS, LOADS = 16 };

static MdtBodyID mover[MOVERS];
static McdModelID load[LOADS];
static double now, angle;                            /* s; rad, of the carousel */
static MeReal turning = (MeReal)1.2;                 /* rad/s */
static const double radius[4] = {.6, 1.2, 1.8, 2.4}; /* m, of the boxes' places on the carousel */

static void create(int which, McdGeometryID g, const float color[4]) {
    mover[which] = McdModelGetBody(playModel(g, 1000, 0, 0, 0, color));
    MdtBodySetKinematic(mover[which], METRUE);
}

/* To a place, turned about y, at the end of the next step. */
static void moveTo(int which, double x, double y, double z, double turn) {
    const MeVector3 position = {(MeReal)x, (MeReal)y, (MeReal)z};
    const MeVector4 quaternion = {(MeReal)cos(turn / 2), 0, (MeReal)sin(turn / 2), 0};
    MdtBodyMoveTo(mover[which], position, quaternion);
}

/* The movers stand where their way begins. */
static void placeAll(void) {
    static const MeReal start[MOVERS][3] = {
        {-5, .1f, -2}, {-5, .1f, 3}, {-.75f, .75f, -3}, {.75f, .75f, -3}, {4.5f, .1f, 0}};
    for (int i = 0; i < MOVERS; i++) {
        MdtBodySetPosition(mover[i], start[i][0], start[i][1], start[i][2]);
        MdtBodySetQuaternion(mover[i], 1, 0, 0, 0);
    }
}

/* From 0 to 1 and back in `period` seconds, with rests; it starts and stops gently. */
static double toAndFro(double period) {
    const double phase = 2 * fmod(now, period) / period, way = phase < 1 ? phase : 2 - phase;
    const double share = fmin(fmax(1.5 * way - .25, 0), 1);
    return share * share * (3 - 2 * share);
}

static void moveAll(void) {
    moveTo(LIFT, -5, .1 + 3 * toAndFro(8), -2, 0);
    moveTo(FERRY, -5 + 6 * toAndFro(12), .1, 3, .8 * toAndFro(12));
    moveTo(DOOR, -.75 - .9 * toAndFro(6), .75, -3, 0);
    moveTo(DOOR2, .75 + .9 * toAndFro(6), .75, -3, 0);
    moveTo(CAROUSEL, 4.5, .1, 0, angle);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    now = angle = 0;
    placeAll();
    for (int i = 0; i < 4; i++) {
        playPlace(load[i], (MeReal)(-5.4 + .8 * (i % 2)), (MeReal)(.4 + .41 * (i / 2)), -2, 1, (MeReal)(.3 * i));
        playPlace(load[4 + i], (MeReal)(-5.6 + .4 * i), (MeReal).4, 3, 1, 0);
        playPlace(load[8 + i], (MeReal)(4.5 + radius[i]), (MeReal).4, 0, 1, 0);
        playPlace(load[12 + i], (MeReal)(-.9 + .6 * i), (MeReal).2, (MeReal)(-3.1 + .1 * (i % 2)), 1, 0);
    }
}

static double heightAboveLift(void) {
    double highest = -1;
    for (int i = 0; i < 2; i++)
        highest =
            fmax(highest, (double)(McdModelGetTransformPtr(load[i])[3][1] - MdtBodyGetTransformPtr(mover[LIFT])[3][1]));
    return highest - .3;
}

static int countOnCarousel(void) {
    int on = 0;
    for (int i = 8; i < 12; i++)
        on += McdModelGetTransformPtr(load[i])[3][1] > (MeReal).35;
    return on;
}

static void MEAPI Tick(RRender *context) {
    char text[120];
    (void)context;
    now += (double)playFrame;
    angle += (double)(turning * playFrame);
    moveAll();
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text, "above the lift %.5f m    on the carousel %d of 4, w = %.2f rad/s", heightAboveLift(),
             countOnCarousel(), (double)turning);
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"Bodies that the program moves, and boxes on them.", "$ACTION2 - once more"};
    static const RParameter parameters[] = {
        {"speed of the carousel", "rad/s", &turning, 0, 3, (MeReal)0.05, .less = "Down", .more = "Up"},
    };
    static const float steel[4] = {.55f, .60f, .68f, 1};
    if (!playStart(argc, argv, "Lift", LOADS + MOVERS))
        return 1;
    McdFrameworkID frame = playUniverse->frame;
    playFloor();
    create(LIFT, McdBoxCreate(frame, 2, (MeReal)0.2, 2), steel);
    create(FERRY, McdBoxCreate(frame, 2, (MeReal)0.2, 2), steel);
    create(DOOR, McdBoxCreate(frame, (MeReal)0.2, (MeReal)1.5, 1), steel);
    create(DOOR2, McdBoxCreate(frame, (MeReal)0.2, (MeReal)1.5, 1), steel);
    create(CAROUSEL, McdBoxCreate(frame, 6, (MeReal)0.2, 6), steel);
    for (int i = 0; i < LOADS; i++)
        load[i] = playModel(McdBoxCreate(frame, (MeReal)0.4, (MeReal)0.4, (MeReal)0.4), 300, 0, 0, 0, RPalette[i / 4]);
    playHelp(help, 2);
    RRenderCreateParameters(playRc, parameters, 1);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    playCamera(.8f, .8f, 0, 14, .4f, .5f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
