/* Bullets: fast balls against a thin wall (McdModel.h, McdModelSetSwept; docs/simulation.md, "Continuous motion").
 *
 * A ball at 100 m/s moves 1.7 m in a step of 1/60 s. Before the step it is on this side of a wall that is two
 * centimetres thick, after it on the other, and at no time have the two touched. Swept models are moved continuously:
 * up to what they meet, and on from there. Watch the tracers end at the wall; then press 3, which takes the switch off,
 * and watch the balls turn red.
 */
#include "play.h"
#include <stdio.h>

enum { BALLS = 48, EVERY = 8, TRACERS = 24, TRACER_FRAMES = 40 };

static const double radius = .09, muzzle = -7; /* m */
static const float free_[4] = {.95f, .75f, .20f, 1}, held[4] = {.20f, .60f, .35f, 1},
                   through[4] = {.85f, .15f, .12f, 1};

/* Where a ball flew in one step. */
typedef struct Tracer {
    AcmeVector3 from, to;
    int age; /* frames */
    MeBool isThrough;
} Tracer;

static McdModelID ball[BALLS];
static MeBool isFlying[BALLS];
static MeMatrix4 wallTM, gunTM;
static Tracer tracer[TRACERS];
static int frame, shots, stopped, tunnels, nextTracer;
static double fastest;
static MeBool isContinuous = METRUE;

static void positionOf(McdModelID m, AcmeVector3 at) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    for (int i = 0; i < 3; i++)
        at[i] = (AcmeReal)p[i];
}

/* Balls lie in store behind the gun. */
static void store(int i) {
    playPlace(ball[i], (MeReal)(-9.5 - .2 * (i / 12)), (MeReal)radius, (MeReal)(.2 * (i % 12 - 5.5)), 0, 0);
    isFlying[i] = MEFALSE;
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BALLS; i++) {
        store(i);
        playColor(ball[i], free_);
    }
    for (int i = 0; i < TRACERS; i++)
        tracer[i].age = TRACER_FRAMES;
    frame = shots = stopped = tunnels = 0;
    fastest = 0;
}

static void MEAPI toggleContinuous(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isContinuous = !isContinuous;
    for (int i = 0; i < BALLS; i++)
        McdModelSetSwept(ball[i], isContinuous);
    Reset(playRc, 0);
}

/* From 60 to 600 m/s, straight at the wall; the gun is moved about, so that what falls is not in the way. */
static void shoot(void) {
    const int i = shots % BALLS;
    const double speed = 60 + 540 * (shots * 7 % 19) / 18.;
    const MeReal y = (MeReal)(1.1 + 1.3 * (shots * 5 % 13) / 12.), z = (MeReal)(.45 * (shots * 3 % 8 - 3.5));
    MeVector3Set(gunTM[3], (MeReal)(muzzle - .8), y, z);
    playPlace(ball[i], (MeReal)muzzle, y, z, 0, 0);
    McdModelDynamicsSetLinearVelocity(ball[i], (MeReal)speed, 0, 0);
    playColor(ball[i], free_);
    isFlying[i] = METRUE;
    shots++;
    fastest = MeMAX(fastest, speed);
}

/* A ball is through where it is behind the wall, and stopped where it no longer flies at it. */
static void judge(int i, const AcmeVector3 from) {
    Tracer *t = &tracer[nextTracer];
    MeVector3 v;
    McdModelDynamicsGetLinearVelocity(ball[i], v);
    for (int k = 0; k < 3; k++)
        t->from[k] = from[k];
    positionOf(ball[i], t->to);
    t->age = 0;
    t->isThrough = t->to[0] > 0;
    nextTracer = (nextTracer + 1) % TRACERS;
    if (t->isThrough || v[0] < 10) {
        isFlying[i] = MEFALSE;
        playColor(ball[i], t->isThrough ? through : held);
        tunnels += t->isThrough;
        stopped += !t->isThrough;
    }
}

/* What went through is far away soon. */
static void bringBack(void) {
    AcmeVector3 at;
    for (int i = 0; i < BALLS; i++) {
        positionOf(ball[i], at);
        if (at[0] > 12)
            store(i);
    }
}

static void drawTracers(void) {
    RLineRemoveAll(playRc);
    for (int i = 0; i < TRACERS; i++) {
        const Tracer *t = &tracer[i];
        const AcmeReal fade = 1 - (AcmeReal)t->age / TRACER_FRAMES;
        if (tracer[i].age++ >= TRACER_FRAMES)
            continue;
        if (t->isThrough)
            RLineAdd(playRc, t->from, t->to, 1 - .15f * (1 - fade), .75f * (1 - fade), .7f * (1 - fade));
        else
            RLineAdd(playRc, t->from, t->to, .7f * (1 - fade), .75f - .1f * fade, .75f * (1 - fade));
    }
}

static void showFigures(void) {
    char text[200];
    snprintf(text, sizeof text,
             "continuous %d    shots %d    stopped %d    tunnels %d    fastest %.0f m/s    awake %d    motion %.3f J",
             isContinuous, shots, stopped, tunnels, fastest, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    AcmeVector3 before[BALLS];
    (void)context;
    if (frame++ % EVERY == 0)
        shoot();
    for (int i = 0; i < BALLS; i++)
        positionOf(ball[i], before[i]);
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i < BALLS; i++)
        if (isFlying[i])
            judge(i, before[i]);
    bringBack();
    drawTracers();
    showFigures();
}

static void createModels(void) {
    static const float glass[4] = {.55f, .72f, .85f, 1}, iron[4] = {.30f, .32f, .36f, 1};
    const McdFrameworkID f = playUniverse->frame;
    const McdGeometryID sphere = McdSphereCreate(f, (MeReal)radius);
    playFloor();
    MeMatrix4TMMakeIdentity(wallTM);
    wallTM[3][1] = (MeReal)1.4;
    playFixed(McdBoxCreate(f, (MeReal)0.02, (MeReal)2.8, 4), wallTM, glass);
    MeMatrix4TMMakeIdentity(gunTM);
    MeVector3Set(gunTM[3], (MeReal)(muzzle - .8), (MeReal)1.4, 0);
    RGraphicBoxCreate(playRc, 1.3f, .4f, .4f, iron, gunTM);
    for (int i = 0; i < BALLS; i++) {
        ball[i] = playModel(sphere, 500, 0, 0, 0, free_);
        McdModelSetSwept(ball[i], METRUE);
    }
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Balls at 60 to 600 m/s, and a wall of two centimetres.",
        "$ACTION2 - begin again",
        "$ACTION3 - continuous motion on or off",
    };
    if (!playStart(argc, argv, "Bullets", BALLS))
        return 1;
    createModels();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, toggleContinuous, 0);
    playCamera(-2.2f, 1.1f, 0, 11, .45f, .25f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
