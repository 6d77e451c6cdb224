/* What the tests of MeApp share: a universe, a context that draws nowhere, and a mouse. z is up in the picture's
 * middle. */
#ifndef APP_TEST_H
#define APP_TEST_H

#include "MeApp.h"
#include "karma_test.h"

enum { WIDTH = 800, HEIGHT = 600 };

static MstUniverseID u;
static RRender *rc;
static MeApp *app;

/* The camera looks along -z from (0, 0, 10) at the origin; there is no gravity. */
static inline void set_up(void) {
    const char *argv[] = {"test", "-null", "-size", "800x600"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(4, argv);
    rc = RRenderContextCreate(options, NULL, 0);
    MeCommandLineOptionsDestroy(options);
    ck_assert_ptr_nonnull(rc);
    RCameraSetLookAt(rc, (const AcmeVector3){0, 0, 0});
    RCameraSetView(rc, 10, 0, 0);
    u = MstUniverseCreate(NULL);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    app = MeAppCreateFromUniverse(u, rc);
    ck_assert_ptr_nonnull(app);
}

static inline void tear_down(void) {
    MeAppDestroy(app);
    RRenderContextDestroy(rc);
    MstUniverseDestroy(u);
}

/* A cube of side 1 and 2 kg. */
static inline McdModelID make_box(double x, double y, double z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 2);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static inline void run(int frames) {
    for (int i = 0; i < frames; i++) {
        MeAppStep(app);
        MstUniverseStep(u, 1. / 60);
    }
}

static inline int lines_drawn(void) {
    int n = 0;
    for (RNativeLine *l = rc->m_pNativeLines; l; l = l->m_pNext)
        n++;
    return n;
}

#endif
