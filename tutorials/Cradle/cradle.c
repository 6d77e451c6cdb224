/* Cradle: Newton's cradle (User Guide, chapter 5, "The Bridge"; Dynamics guide, chapter 3, "MdtSpring").
 *
 * Five steel balls hang in a row, each on two threads: the joint MdtSpring with two hard stops, a rod. Steel rebounds
 * fully: the restitution of contacts is 1. So a blow keeps momentum and energy, and both together say that as many
 * balls fly off as came in.
 *
 * They say so of blows that come one after the other. Balls that touch, and are tied to something, get theirs at once,
 * which the two laws alone leave open; and Karma wants a step in between to tell a blow from a push. So the balls hang
 * a little apart, and a frame is many short steps, each a MstUniverseStep with collision and all.
 *
 * Watch the status line: how many balls come from the left and how many leave to the right, the momentum, which turns
 * with the swing, and the energy, which stays.
 */
#include "play.h"
#include <stdio.h>

enum { BALLS = 5, THREADS = 2 * BALLS };

static const int steps = 32;                  /* of a frame: a ball moves by less than half a gap in one */
static const MeReal gap = (MeReal)0.006;      /* m, between balls */
static const MeReal radius = (MeReal)0.5;     /* m */
static const MeReal density = 100;            /* kg/m³ */
static const MeReal height = 5, low = 1;      /* m above the floor: of the beams, of balls at rest */
static const MeReal halfWidth = 1;            /* m, from the balls to the beams, in z */
static const MeReal startAngle = (MeReal)0.7; /* rad */

static McdModelID ball[BALLS];
static MdtSpringID thread[THREADS];
static int released = 1;
static int rightmost; /* balls that were out on the right at a time, since the start */
static double energyAtStart;

/* ---- the cradle -------------------------------------------------------------------------------------------------- */

static MeReal restX(int i) {
    return (2 * radius + gap) * ((MeReal)i - (MeReal)(BALLS - 1) / 2);
}

/* At an angle of the swing: left is negative. */
static void placeBall(int i, MeReal angle) {
    const MeReal length = height - low;
    playPlace(ball[i], restX(i) + length * MeSin(angle), height - length * MeCos(angle), 0, 0, 0);
}

/* From a ball's middle to a beam, as long as it is now. */
static MdtSpringID createThread(int i, MeReal z) {
    const MdtSpringID s = MdtSpringCreate(playUniverse->world);
    MdtSpringSetBodies(s, McdModelGetBody(ball[i]), 0);
    MdtSpringSetPosition(s, 0, restX(i), low, 0);
    MdtSpringSetPosition(s, 1, restX(i), height, z);
    MdtSpringSetNaturalLength(s, MeSqrt((height - low) * (height - low) + z * z));
    MdtSpringSetStiffness(s, MEINFINITY);
    MdtSpringEnable(s);
    return s;
}

/* Nothing is put to rest: balls that were hit sway a little, slower than the thresholds, and a stop takes energy. */
static void createBalls(void) {
    static const float steel[4] = {.70f, .74f, .80f, 1};
    const McdGeometryID g = McdSphereCreate(playUniverse->frame, radius);
    const MdtContactParamsID p = playContact(0, 0);
    MdtWorldSetAutoDisable(playUniverse->world, MEFALSE);
    MdtContactParamsSetRestitution(p, 1);
    MdtContactParamsSetType(p, MdtContactTypeFrictionZero);
    for (int i = 0; i < BALLS; i++) {
        ball[i] = playModel(g, density, 0, 0, 0, steel);
        placeBall(i, 0);
        thread[2 * i] = createThread(i, -halfWidth);
        thread[2 * i + 1] = createThread(i, halfWidth);
    }
}

/* A bar for the eye, along an axis. */
static void createBar(MeReal x, MeReal y, MeReal z, MeReal length, int axis) {
    static MeMatrix4 tm[8];
    static int used;
    static const float wood[4] = {.45f, .30f, .20f, 1};
    const float thick = .16f;
    float size[3] = {thick, thick, thick};
    size[axis] = (float)length;
    MeMatrix4TMMakeIdentity(tm[used]);
    MeMatrix4TMSetPosition(tm[used], x, y, z);
    RGraphicBoxCreate(playRc, size[0], size[1], size[2], wood, tm[used++]);
}

static void createFrame(void) {
    const MeReal half = restX(BALLS - 1) + 1;
    for (int side = -1; side <= 1; side += 2) {
        const MeReal z = (MeReal)side * halfWidth, x = (MeReal)side * half;
        createBar(0, height, z, 2 * half, 0);
        createBar(x, height / 2, -halfWidth, height, 1);
        createBar(x, height / 2, halfWidth, height, 1);
        createBar(x, height, 0, 2 * halfWidth, 2);
    }
}

/* ---- figures ----------------------------------------------------------------------------------------------------- */

static double energy(void) {
    double sum = playEnergy();
    for (int i = 0; i < BALLS; i++)
        sum += (double)MdtBodyGetMass(McdModelGetBody(ball[i])) * 9.81 *
               (double)(McdModelGetTransformPtr(ball[i])[3][1] - low);
    return sum;
}

static double momentum(void) {
    double sum = 0;
    for (int i = 0; i < BALLS; i++) {
        MeVector3 v;
        McdModelDynamicsGetLinearVelocity(ball[i], v);
        sum += (double)MdtBodyGetMass(McdModelGetBody(ball[i])) * (double)v[0];
    }
    return sum;
}

/* How many are out by more than half the angle that the swing began with, on one side. */
static int countOut(int side) {
    int out = 0;
    for (int i = 0; i < BALLS; i++)
        out +=
            (MeReal)side * (McdModelGetTransformPtr(ball[i])[3][0] - restX(i)) > (height - low) * MeSin(startAngle / 2);
    return out;
}

static void drawThreads(void) {
    RLineRemoveAll(playRc);
    for (int i = 0; i < THREADS; i++) {
        MeVector3 a, b;
        MdtSpringGetPosition(thread[i], a, 0);
        MdtSpringGetPosition(thread[i], b, 1);
        const AcmeVector3 from = {(float)a[0], (float)a[1], (float)a[2]}, to = {(float)b[0], (float)b[1], (float)b[2]};
        RLineAdd(playRc, from, to, .25f, .25f, .28f);
    }
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BALLS; i++)
        placeBall(i, i < released ? -startAngle : 0);
    rightmost = 0;
    energyAtStart = energy();
}

static void MEAPI releaseMore(RRender *context, void *userdata) {
    released = released % (BALLS - 1) + 1;
    Reset(context, userdata);
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    (void)context;
    for (int k = 0; k < steps; k++)
        MstUniverseStep(playUniverse, playFrame / (MeReal)steps);
    drawThreads();
    rightmost = MeMAX(rightmost, countOut(1));
    snprintf(text, sizeof text,
             "released %d    out on the left %d, on the right %d    most on the right %d    momentum %.2f kg m/s    "
             "energy %.2f J, %+.3f %%",
             released, countOut(-1), countOut(1), rightmost, momentum(), energy(),
             100 * (energy() / energyAtStart - 1));
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Newton's cradle: as many balls leave as come in.",
        "$ACTION2 - once more",
        "$ACTION3 - release one ball more (after four, one)",
    };
    if (!playStart(argc, argv, "Cradle", BALLS))
        return 1;
    playFloor();
    createBalls();
    createFrame();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, releaseMore, 0);
    playCamera(-.2f, 2.2f, 0, 16, .4f, .15f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
