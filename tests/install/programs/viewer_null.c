/* Callbacks that are unset by 0 and by NULL, with and without user data. */
#include "MeViewer.h"
#include <stdlib.h>

static int ticks;

static void MEAPI tick(RRender *rc) {
    (void)rc;
    ticks++;
}

static void MEAPI pressed(RRender *rc, void *data) {
    (void)rc, (void)data;
    _Exit(1);
}

static void check(void) {
    if (ticks < 60)
        _Exit(1);
}

int main(int argc, const char *argv[]) {
    const char *keys[] = {"", "-key", "Up@2,Enter@3,W@4"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv), *own = MeCommandLineOptionsCreate(3, keys);
    RRender *rc = RRenderContextCreate(options, own, 1);
    MeCommandLineOptionsDestroy(options);
    MeCommandLineOptionsDestroy(own);
    RRenderSetUpCallBack(rc, pressed);
    RRenderSetUpCallBack(rc, 0);
    RRenderSetUp2CallBack(rc, pressed, &ticks);
    RRenderSetUp2CallBack(rc, NULL, NULL);
    RRenderSetActionNCallBack(rc, 2, pressed, 0);
    RRenderSetActionNCallBack(rc, 2, NULL);
    RRenderSetMouseCallBack(rc, 0, 0);
    RRenderSetMouseCallBack(rc, NULL);
    RRenderSetJoystickCallBack(rc, 0);
    atexit(check);
    RRun(rc, tick);
    return 1;
}
