/* C only: NULL as the pointer that C has, and a conditional callback. */
#include "MeViewer.h"
#include <stdlib.h>

static int ticks;

static void MEAPI tick(RRender *rc, void *data) {
    (void)rc;
    ticks += data == &ticks;
}

static void check(void) {
    if (ticks < 60)
        _Exit(1);
}

int main(int argc, const char *argv[]) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    RRenderSetUpCallBack(rc, argc > 50 ? tick : NULL, NULL);
    RRenderSetMouseCallBack(rc, ((void *)0));
    atexit(check);
    RRun(rc, rc ? tick : 0, &ticks);
    return 1;
}
