/* The helpers of demonstration programs: members that programs read, graphics of models, drawn contacts. */
#include "MeApp.h"
#include <stdlib.h>
#include "MeDebugDraw.h"
#include "RConvex.h"
#include "RGeometry.h"

static MeApp *app;
static RRender *rc;
static MstUniverseID universe;
static int ticks, lines;

static void MEAPI count(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b) {
    (void)start, (void)end, (void)r, (void)g, (void)b;
    lines++;
}

static void cleanup(void) {
    MeAppDestroy(app);
    RRenderContextDestroy(rc);
    MstUniverseDestroy(universe);
    if (ticks < 60 || lines < 4)
        _Exit(1);
}

static void MEAPI tick(RRender *r, MeApp *a) {
    (void)r;
    if (a->mouseInfo.dragBody || a->drawContacts != (ticks < 30))
        _Exit(1);
    if (++ticks == 30)
        MeAppToggleDrawContacts(a, !a->drawContacts);
    MeAppStep(a);
    MstUniverseStep(universe, 1. / 60);
}

int main(int argc, const char *argv[]) {
    static MeMatrix4 ground;
    float red[4] = {1, 0, 0, 1}, grey[4] = {.5f, .5f, .5f, 1};
    MeMatrix3 R;
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    universe = MstUniverseCreate(&sizes);
    McdFrameworkID frame = MstUniverseGetFramework(universe);
    MdtWorldSetGravity(MstUniverseGetWorld(universe), 0, -10, 0);
    MdtWorldSetDebugDrawing(MstUniverseGetWorld(universe), MdtDebugDrawContacts);
    MeDebugDrawAPI.line = count;
    MeMatrix3MakeRotationX(R, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(ground, R, 0, 0, 0);
    McdModelID floor = MstFixedModelCreate(universe, (McdGeometryID)McdPlaneCreate(frame), ground);
    McdModelID box = MstModelAndBodyCreate(universe, (McdGeometryID)McdBoxCreate(frame, 1, 1, 1), 1);
    McdModelDynamicsSetPosition(box, 0, .5, 0);
    app = MeAppCreateFromUniverse(universe, rc);
    MeAppDrawContactsInit(app, red, 100);
    RRenderSetMouseCallBack(rc, MeAppMousePickCB, app);
    RGraphic *moving = RGraphicCreateFromModel(rc, box, red);
    if (!moving || moving->m_pLWMatrix != McdModelGetTransformPtr(box) || !RGraphicCreateFromModel(rc, floor, grey) ||
        !RGraphicCreateFromGeometry(rc, McdModelGetGeometry(box), grey))
        return 1;
    McdDebugDrawModelAABB(box);
    atexit(cleanup);
    RRun(rc, tick, app);
    return 1;
}
