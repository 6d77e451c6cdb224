/* What programs do that deserves no word: menus destroyed late, actions on the viewer's letters, a bar without a
 * window. */
#include "MeViewer.h"
#include <stdlib.h>

static RRender *rc;
static RMenu *menu, *submenu;
static int pressed;

static void MEAPI onAction(RRender *r, void *data) {
    (void)r, (void)data;
    pressed++;
}

static void MEAPI tick(RRender *r, void *data) {
    (void)data;
    if (r->m_bPause || r->m_PerformanceBar != r->m_pPerformanceBar || !r->m_PerformanceBar)
        _Exit(1);
}

static void cleanup(void) {
    RRenderContextDestroy(rc);
    RMenuDestroy(submenu);
    RMenuDestroy(menu);
    if (pressed != 4)
        _Exit(1);
}

int main(int argc, const char *argv[]) {
    const char *keys[] = {"", "-key", "p@2,q@3,w@4,o@5"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv), *own = MeCommandLineOptionsCreate(3, keys);
    rc = RRenderContextCreate(options, own, 1);
    MeCommandLineOptionsDestroy(options);
    MeCommandLineOptionsDestroy(own);
    menu = RMenuCreate(rc, "menu");
    submenu = RMenuCreate(rc, "more");
    RMenuAddSubmenuEntry(menu, "more", submenu);
    RRenderSetActionNKey(rc, 2, 'P');
    RRenderSetActionNKey(rc, 3, 'q');
    RRenderSetActionNKey(rc, 4, 'w');
    RRenderSetActionNKey(rc, 5, 'o');
    RRenderSetActionNCallBack(rc, 2, onAction, 0);
    RRenderSetActionNCallBack(rc, 3, onAction, 0);
    RRenderSetActionNCallBack(rc, 4, onAction, 0);
    RRenderSetActionNCallBack(rc, 5, onAction, 0);
    RPerformanceBarCreate(rc);
    atexit(cleanup);
    RRun(rc, tick, 0);
    return 1;
}
