/* The main loop: input, tick, draw; at a steady pace in a window, as fast as possible without one. */
#define _POSIX_C_SOURCE 200809L /* clock_nanosleep, isatty */
#include "r_i.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "MeProfile.h"

int64_t r_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* A program may destroy the context in a function that the main loop has called: then there is nothing to go on with.
 * */
void r_afterCallBack(const RRender *rc) {
    if (!r_isLive(rc))
        exit(EXIT_SUCCESS);
}

/* Runs that are counted, drawn into files, or not seen have a tick in each frame, whatever the clock says. */
bool r_isByClock(const RRender *rc) {
    const RRenderOptions *o = &rc->m_Options;
    return rc->m_pViewer->backend->window && o->m_nFrames == 0 && o->m_nEvery == 0 && !o->m_Film[0] && !o->m_Keys[0];
}

static void callTick(RRender *rc, const RTick *tick) {
    struct RViewer *v = rc->m_pViewer;
    r_debugLinesForget(rc);
    if (tick->func)
        tick->func(rc, tick->userdata);
    else
        tick->funcNoData(rc);
    r_afterCallBack(rc);
    v->loop.ticks++;
}

static void tickOnce(RRender *rc, const RTick *tick) {
    RLoop *loop = &rc->m_pViewer->loop;
    const bool run = (!rc->m_bPause && r_tickIsDue(rc)) || loop->step;
    loop->step = false;
    if (run && tick)
        callTick(rc, tick);
}

static void tickByClock(RRender *rc, const RTick *tick) {
    struct RViewer *v = rc->m_pViewer;
    const double rate = rc->m_Options.m_nRate > 0 ? rc->m_Options.m_nRate : (double)v->tickRate;
    const int slow = v->slow > 1 ? v->slow : 1;
    r_clockFrame(&v->loop.clock, r_now());
    while (!rc->m_bPause && !v->loop.quit && r_clockCountTicks(&v->loop.clock, r_now(), rate / slow))
        callTick(rc, tick);
}

static void callTicks(RRender *rc, const RTick *tick) {
    RLoop *loop = &rc->m_pViewer->loop;
    if (tick && r_isByClock(rc) && !rc->m_bPause) {
        loop->step = false;
        tickByClock(rc, tick);
        return;
    }
    tickOnce(rc, tick);
    r_clockRestart(&loop->clock, r_now());
}

/* Nobody sees the frames of an off-screen buffer but those that a picture is made of; a profile wants them all. */
static bool isSeen(const struct RViewer *v) {
    return v->backend->type != kROSMesa || v->profiling;
}

void r_drawNow(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!v->backend->draws || v->loop.isDrawn)
        return;
    v->loop.isDrawn = true;
    if (v->profiling)
        MeProfileStartSection("Render", 0);
    r_drawFrame(rc);
    v->backend->present(rc);
    if (v->profiling)
        MeProfileEndSection("Render");
}

/* The first picture has shaders compiled: its time says nothing, and is not owed to the simulation. */
static void drawTimed(RRender *rc, int64_t frameBegin) {
    struct RViewer *v = rc->m_pViewer;
    const int64_t begin = r_now();
    r_drawNow(rc);
    const int64_t end = r_now();
    if (v->loop.frames > 1)
        r_qualityFrame(&v->quality, end - frameBegin, end - begin);
    else
        r_clockRestart(&v->loop.clock, end);
}

void r_frame(RRender *rc, const RTick *tick) {
    struct RViewer *v = rc->m_pViewer;
    const int64_t begin = r_now();
    const bool profiling = v->profiling; /* A callback may start it in the middle of a frame. */
    v->loop.frames++;
    MEASSERT(r_isLive(rc) && v->backend && (v->loop.ticks < v->loop.frames || r_isByClock(rc)));
    if (profiling)
        MeProfileStartFrame();
    r_inputFrame(rc);
    if (!v->loop.quit) { /* After that there may be no window any more. */
        callTicks(rc, tick);
        v->loop.isDrawn = false;
        if (isSeen(v))
            drawTimed(rc, begin);
        else
            RRenderUpdateProjectionMatrices(rc);
        r_pictureFrame(rc);
    }
    if (profiling) {
        MeProfileEndFrame();
        r_barFrame(rc);
    }
}

/* A window's frames begin 1/60 s after each other, counted from the first: a late one does not delay the others. */
static void pace(RLoop *loop) {
    enum { PERIOD = 16666667, TOO_LATE = 100000000 };
    const int64_t now = r_now();
    loop->deadline += PERIOD;
    if (now > loop->deadline + TOO_LATE)
        loop->deadline = now;
    const struct timespec until = {(time_t)(loop->deadline / 1000000000), (long)(loop->deadline % 1000000000)};
    while (now < loop->deadline && clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) != 0)
        continue;
}

static void showProgress(RRender *rc) {
    RLoop *loop = &rc->m_pViewer->loop;
    const int64_t now = r_now();
    if (now - loop->progress < 2000000000 || !isatty(STDERR_FILENO))
        return;
    loop->progress = now;
    loop->progressShown = true;
    if (rc->m_Options.m_nFrames)
        fprintf(stderr, "\rframe %d of %d", loop->frames, rc->m_Options.m_nFrames);
    else
        fprintf(stderr, "\rframe %d", loop->frames);
}

bool r_loopEnded(const RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    /* In a window somebody can end the pause. Without one the frames go on being counted. */
    const int done = v->backend->window ? v->loop.ticks : v->loop.frames;
    return v->loop.quit || (rc->m_Options.m_nFrames > 0 && done >= rc->m_Options.m_nFrames);
}

/* MeAppStart takes the option for itself. */
static void refuseAdvise(const RRender *rc) {
    if (!(rc->m_Options.m_Advise[0] > 0))
        return;
    MeWarning(1, "-advise: this program has no universe of MeAppStart, on which settings could be tried");
    exit(2);
}

static void begin(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    const bool offscreen = v->backend->type == kROSMesa;
    if (offscreen && rc->m_Options.m_nFrames == 0)
        rc->m_Options.m_nFrames = 60;
    if (!v->backend->window || rc->m_Options.m_nFrames) { /* Nobody is there to close the help. */
        rc->m_bShowHelp = 0;
        rc->m_bPause = rc->m_Options.m_bPaused;
    }
    r_cameraApplyOption(rc);
    r_cameraSeeScene(rc);
    r_cameraKeepHome(rc);
    if (rc->m_Options.m_bProfile)
        r_profileStart(rc);
    r_barStart(rc); /* It may have been created before the context was started. */
    v->loop.deadline = v->loop.progress = r_now();
    r_clockRestart(&v->loop.clock, v->loop.deadline);
}

/* Without a window the line of the status is printed. */
static void printStatus(const RRender *rc) {
    if (!rc->m_pViewer->backend->window && rc->m_pViewer->status)
        MeInfo(0, "%s", rc->m_pViewer->status);
}

static bool isStatusDue(const RRender *rc) {
    const int every = rc->m_Options.m_nEvery;
    return every > 0 && rc->m_pViewer->loop.frames % every == 0 && !r_loopEnded(rc); /* it ends with the status */
}

static int exitCode(const RRender *rc) {
    const bool isChecked = !rc->m_pViewer->backend->window || !rc->m_pViewer->loop.quit;
    return isChecked && r_warnings() ? 2 : EXIT_SUCCESS;
}

static void run(RRender *rc, const RTick *tick) {
    RLoop *loop = &rc->m_pViewer->loop;
    refuseAdvise(rc);
    begin(rc);
    while (!r_loopEnded(rc)) {
        r_frame(rc, tick);
        if (isStatusDue(rc))
            printStatus(rc);
        if (rc->m_pViewer->backend->window)
            pace(loop);
        else
            showProgress(rc);
    }
    if (loop->progressShown)
        fputc('\n', stderr);
    r_pictureEnd(rc);
    printStatus(rc);
    if (rc->m_Options.m_bProfile)
        MeProfileOutputResults();
    exit(exitCode(rc));
}

static bool canRun(const RRender *rc, const char *function, bool hasFunction) {
    if (!r_isContext(rc, function))
        return false;
    if (!hasFunction)
        MeWarning(1, "RRun: the tick function is null");
    else if (!rc->m_pViewer->backend)
        MeWarning(1, "RRun: the context has not been started (RInit)");
    return hasFunction && rc->m_pViewer->backend;
}

void MEAPI RRunWithData(RRender *rc, RMainLoopCallBack func, void *userdata) {
    if (canRun(rc, "RRun", func != NULL))
        run(rc, &(RTick){.func = func, .userdata = userdata});
}

void MEAPI RRunWithoutData(RRender *rc, RMainLoopCallBackNoData func, void *unused) {
    (void)unused;
    if (canRun(rc, "RRun", func != NULL))
        run(rc, &(RTick){.funcNoData = func});
}
