/* A program that passes no options on: where it draws and for how long, $KARMA_VIEWER says. */
#include "MeViewer.h"
#include <stdlib.h>

static void MEAPI tick(RRender *rc, void *data) {
    (void)data;
    if (rc->m_RenderType != kRNull && rc->m_RenderType != kROSMesa)
        _Exit(1);
}

int main(void) {
    RRender *rc = RRenderContextCreate(0, 0, 0);
    if (!rc || rc->m_Options.m_nFrames < 1)
        return 1;
    RRun(rc, tick, 0);
    return 1;
}
