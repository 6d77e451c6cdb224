/* A small program like those of the guides, for the tests that run the viewer as a whole: a sphere that falls on the
 * ground. It says on stdout what happens. `-warn` gives a warning, `-exit N` leaves from tick N, `-destroy N` destroys
 * the context in tick N. */
#include <stdio.h>
#include <stdlib.h>

#include "MeViewer.h"
#include "RPanel.h"
#include "leaks.h"

static RRender *rc;
static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 3, 0, 1}};
static int ticks, exitAt, destroyAt;

static void say(const char *what, int number) {
    printf("%s %d\n", what, number);
    fflush(stdout);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context;
    (void)userdata;
    tm[3][1] = 3;
    say("reset at", ticks);
}

static void MEAPI onMouse(RRender *context, int x, int y, int modifiers, RMouseButtonWhich which,
                          RMouseButtonEvent event, void *userdata) {
    (void)context;
    (void)modifiers;
    (void)userdata;
    (void)x;
    (void)which;
    if (event != kRStillPressed)
        say(event == kRNewlyPressed ? "pressed at" : "released at", y);
}

static void MEAPI showPanel(RRender *context, void *userdata) {
    static int frames;
    (void)context;
    (void)userdata;
    if (RPanelButton("a button"))
        say("panel button", ticks);
    if (++frames == 3)
        say("panel seen", ticks);
}

static void MEAPI Tick(RRender *context) {
    tm[3][1] = tm[3][1] > 1 ? tm[3][1] - (MeReal)0.05 : 1;
    if (++ticks == 3)
        say("tick", ticks);
    if (exitAt && ticks == exitAt)
        exit(7);
    if (destroyAt && ticks == destroyAt) {
        say("destroyed", RRenderContextDestroy(context));
        rc = NULL;
    }
}

static void MEAPI_CDECL cleanup(void) {
    if (rc)
        say("cleanup", RRenderContextDestroy(rc));
    CHECK_LEAKS();
}

int MEAPI_CDECL main(int argc, const char **argv) {
    char *help[] = {"$ACTION2 - start again", "$MOUSE - nothing much"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    const MeBool warn = MeCommandLineOptionsCheckFor(options, "-warn", 1);
    exitAt = MeCommandLineOptionsGetNumeric(options, "-exit", 1);
    destroyAt = MeCommandLineOptionsGetNumeric(options, "-destroy", 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    RRenderSetWindowTitle(rc, "Karma viewer test");
    RRenderCreateUserHelp(rc, help, 2);
    RRenderSetActionNCallBack(rc, 2, Reset);
    RRenderSetMouseCallBack(rc, onMouse);
    RPanelCreate(rc, "Test panel", showPanel, 0);
    RPerformanceBarCreate(rc);
    RGraphicSphereCreate(rc, 1, RPalette[1], tm);
    RGraphicGroundPlaneCreate(rc, 24, 2, RPalette[7], 0);
    if (warn)
        MeWarning(1, "a warning, as asked for");
    atexit(cleanup);
    RRun(rc, Tick);
    return 3; /* Not reached. */
}
