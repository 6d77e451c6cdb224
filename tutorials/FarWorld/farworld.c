/* FarWorld: the same thing near the origin and far from it, and the origin moved (MstUniverseShiftOrigin).
 *
 * Four turntables carry crates. One is at the origin, the others are 100, 1000 and 10 000 km away; they are drawn side
 * by side. Bodies move in double precision, but collision sees their shapes where single precision can tell them: on a
 * grid of 4 mm, 3 cm and half a metre. Crates at 100 km shake by a millimetre a second, those at 1000 km by
 * centimetres, and those at 10 000 km sink through their table.
 *
 * Press 3 to move the origin to the next table: nothing else moves, that table is quiet now, and the others are far. A
 * game does so whenever its player is some kilometres from the origin. The status line tells how many crates are on
 * each table, and how fast they slide over it. Built in double precision all tables are alike: there the grid is finer
 * than 1e-8 m.
 */
#include "RMark.h"
#include "play.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const MeReal turning = (MeReal)0.7; /* rad/s */

enum { PLACES = 4, CRATES = 9, BODIES = CRATES + 1 };

static const double along[PLACES] = {0, 57736, 577352, 5773504}; /* m, along x, y and z each; whole ones can be told */
static MdtBodyID body[PLACES][BODIES];                           /* crates, and the table */
static MeMatrix4 shown[PLACES][BODIES];                          /* as they are drawn: side by side */
static int nearest;                                              /* the place at which the origin is */

static double far(int place) {
    return along[place] - along[nearest];
}

/* from the origin */
static double kilometres(int place) {
    return fabs(far(place)) * sqrt(3) / 1000;
}

static void put(int place, int i, double x, double y, double z) {
    const MdtBodyID b = body[place][i];
    MdtBodySetPosition(b, (MeReal)(far(place) + x), (MeReal)(far(place) + y), (MeReal)(far(place) + z));
    MdtBodySetQuaternion(b, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, i == CRATES ? turning : 0, 0);
    MdtBodyEnable(b);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int p = 0; p < PLACES; p++) {
        put(p, CRATES, 0, .1, 0);
        for (int i = 0; i < CRATES; i++)
            if (i < 5)
                put(p, i, 0, .45 + .5 * i, 0);
            else
                put(p, i, 1.2 * cos(1.57 * i), .45, 1.2 * sin(1.57 * i));
    }
}

/* Moves the origin to the next table, in one call. */
static void MEAPI moveOrigin(RRender *context, void *userdata) {
    MeVector3 shift = {0, 0, 0};
    (void)context, (void)userdata;
    nearest = (nearest + 1) % PLACES;
    shift[0] = shift[1] = shift[2] = (MeReal)-far((nearest + PLACES - 1) % PLACES);
    MstUniverseShiftOrigin(playUniverse, shift);
}

/* Draws a place as if it were near, beside the others. Returns how many crates are on the table. */
static int show(int place) {
    int on = 0;
    for (int i = 0; i < BODIES; i++) {
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body[place][i]);
        memcpy(shown[place][i], tm, sizeof(MeMatrix4));
        shown[place][i][3][0] = (MeReal)((double)tm[3][0] - far(place) + 5 * (place - 1.5));
        shown[place][i][3][1] = (MeReal)((double)tm[3][1] - far(place));
        shown[place][i][3][2] = (MeReal)((double)tm[3][2] - far(place));
        on += i < CRATES && (double)tm[3][1] - far(place) > .4;
    }
    return on;
}

/* m/s: how fast the crates on the table slide over it, or over each other. */
static double slipOf(int place) {
    double sum = 0;
    for (int i = 0; i < CRATES; i++) {
        MeVector3 v;
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body[place][i]);
        MdtBodyGetLinearVelocity(body[place][i], v);
        const double x = (double)tm[3][0] - far(place), z = (double)tm[3][2] - far(place);
        const double dx = (double)v[0] - (double)turning * z, dz = (double)v[2] + (double)turning * x;
        if ((double)tm[3][1] - far(place) > .4)
            sum = fmax(sum, sqrt(dx * dx + (double)(v[1] * v[1]) + dz * dz));
    }
    return sum;
}

static void MEAPI Tick(RRender *context) {
    char text[240], *at = text;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int p = 0; p < PLACES; p++)
        at += sprintf(at, "%.0f km: %d of %d, %.2f mm/s%s", kilometres(p), show(p), CRATES, 1000 * slipOf(p),
                      p < PLACES - 1 ? "    " : "");
    RRenderSetStatusText(playRc, text);
}

static void MEAPI label(RRender *context, void *userdata) {
    static const float ink[4] = {.15f, .16f, .18f, 1};
    (void)userdata;
    for (int p = 0; p < PLACES; p++) {
        char text[40];
        const MeVector3 at = {(MeReal)(5 * (p - 1.5) - .5), (MeReal)3.3, 0};
        snprintf(text, sizeof text, "%.0f km", kilometres(p));
        RMarkText(context, at, text, ink);
    }
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"The same, near the origin and far from it.", "$ACTION2 - once more",
                                       "$ACTION3 - move the origin to the next table"};
    static const float steel[4] = {.55f, .60f, .68f, 1};
    if (!playStart(argc, argv, "FarWorld", PLACES * BODIES))
        return 1;
    const McdGeometryID crate = McdBoxCreate(playUniverse->frame, (MeReal)0.5, (MeReal)0.5, (MeReal)0.5);
    const McdGeometryID table = McdBoxCreate(playUniverse->frame, 4, (MeReal)0.2, 4);
    playFloor();
    for (int p = 0; p < PLACES; p++)
        for (int i = 0; i < BODIES; i++) {
            const MeBool isTable = i == CRATES;
            body[p][i] = McdModelGetBody(MstModelAndBodyCreate(playUniverse, isTable ? table : crate, 300));
            MdtBodySetKinematic(body[p][i], isTable);
            const float size = isTable ? 4 : .5f;
            RGraphicBoxCreate(playRc, size, isTable ? .2f : .5f, size, isTable ? steel : RPalette[i % 6], shown[p][i]);
        }
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, moveOrigin, 0);
    RRenderSetMarkCallBack(playRc, label, 0);
    playCamera(.4f, .6f, 0, 18, .1f, .32f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
