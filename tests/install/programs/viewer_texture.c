/* may print: a texture that is not there is one message, and the exit status is 0. */
#include "MeViewer.h"

static void MEAPI tick(RRender *rc) {
    (void)rc;
}

int main(int argc, const char *argv[]) {
    const float white[4] = {1, 1, 1, 1};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    RGraphicSetTexture(rc, RGraphicGroundPlaneCreate(rc, 24, 2, white, 0), "no_such_texture");
    RRun(rc, tick);
    return 1;
}
