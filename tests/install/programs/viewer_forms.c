/* C only: declarations without parameters, which C++ has not. Every form of a callback, each called. */
#include "MeViewer.h"
#include <stdlib.h>

typedef struct MyApp {
    int ticks;
} MyApp;

static int calls;

static void MEAPI withApp(RRender *rc, MyApp *app) {
    (void)rc;
    app->ticks++;
}

static void MEAPI withInt(RRender *rc, int *data) {
    (void)rc;
    ++*data;
}

static void MEAPI nothing() {
    calls++;
}

static int MEAPI result(RRender *rc) {
    return rc ? ++calls : 0;
}

static void MEAPI mouse(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                        MyApp *app) {
    (void)rc, (void)x, (void)y, (void)modifiers, (void)which, (void)event;
    app->ticks++;
}

static MyApp app;
static int number;
static RRender *rc;

static void check(void) {
    RRenderContextDestroy(rc);
    if (app.ticks < 60 || number != 1 || calls != 2)
        _Exit(1);
}

int main(int argc, const char *argv[]) {
    MeCommandLineOptions *key =
        MeCommandLineOptionsCreate(3, (const char *[]){"", "-key", "Up@2,Down@3,Enter@4,Left@5"});
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, key, 1);
    MeCommandLineOptionsDestroy(options);
    MeCommandLineOptionsDestroy(key);
    if (!rc)
        return 1;
    RRenderSetUpCallBack(rc, withInt, &number);
    RRenderSetDownCallBack(rc, nothing);
    RRenderSetActionNCallBack(rc, 2, result, 0);
    RRenderSetLeftCallBack(rc, nothing, 0);
    RRenderSetLeftCallBack(rc, 0, 0);
    RRenderSetMouseCallBack(rc, mouse, &app);
    atexit(check);
    RRun(rc, withApp, &app);
    return 1;
}
