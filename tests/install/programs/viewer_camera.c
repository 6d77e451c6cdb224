/* A program that only zooms and turns relative to the view that it finds. */
#include "MeViewer.h"
#include <stdlib.h>

static int near(AcmeReal a, double b) {
    return fabs((double)a - b) < 1e-5;
}

static void MEAPI tick(RRender *rc) {
    AcmeVector3 eye, at;
    RCameraGetPosition(rc, eye);
    RCameraGetLookAt(rc, at);
    if (sizeof at != 3 * sizeof(AcmeReal) || !near(at[0], 0) || !near(at[1], 0) || !near(at[2], 1))
        _Exit(1);
    if (!near(eye[0], 5 * sin(.5)) || !near(eye[1], 0) || !near(eye[2], 1 + 5 * cos(.5)))
        _Exit(1);
}

int main(int argc, const char *argv[]) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    const float red[4] = {1, 0, 0, 0};
    MeCommandLineOptionsDestroy(options);
    if (RCameraGetDistance(rc) != 15 || RCameraGetRotation(rc) != 0 || RCameraGetElevation(rc) != 0)
        return 1;
    RCameraZoom(rc, -10);
    RCameraRotateAngle(rc, .5f);
    RGraphicSphereCreate(rc, 1, red, 0);
    RRun(rc, tick);
    return 1;
}
