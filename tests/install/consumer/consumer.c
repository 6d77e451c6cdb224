/* Drops a ball for a second, as a program outside Karma's tree would; with CONSUMER_VIEWER in the viewer. */
#include "Mdt.h"
#include "MeVersion.h"
#include <stdio.h>
#include <stdlib.h>

static MdtWorldID world;
static MdtBodyID ball;

#ifdef CONSUMER_VIEWER
#include "MeViewer.h"

static void MEAPI tick(RRender *rc, void *userdata) {
    (void)rc;
    (void)userdata;
    MdtWorldStep(world, (MeReal)(1.0 / 60));
}
#endif

static void MEAPI_CDECL check(void) {
    MeVector3 p;
    MdtBodyGetPosition(ball, p);
    MdtWorldDestroy(world);
    printf("%s: the ball fell to %g\n", MeToolkitVersionString(), (double)p[1]);
    if (!(p[1] < -4.9 && p[1] > -5.1))
        _Exit(1);
}

int main(void) {
    world = MdtWorldCreate(1, 0);
    ball = MdtBodyCreate(world);
    MdtBodyEnable(ball);
    MdtWorldSetGravity(world, 0, (MeReal)-9.81, 0);
#ifdef CONSUMER_VIEWER
    const char *arguments[] = {"consumer", "-null", "-frames", "60"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(4, arguments);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    atexit(check);
    RRun(rc, tick, 0);
#else
    for (int i = 0; i < 60; i++)
        MdtWorldStep(world, (MeReal)(1.0 / 60));
    check();
#endif
    return 0;
}
