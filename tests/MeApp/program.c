/* A box on a floor and a door, with all controls of a demonstration program, for the test of them in a window. It says
 * on stdout what has changed since the tick before. `-layers` draws all layers. */
#include "MeApp.h"
#include "leaks.h"
#include "me_app_i.h"
#include <stdio.h>
#include <stdlib.h>

static RRender *rc;
static MstUniverseID u;
static MeApp *app;
static McdModelID box;
static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

static void sayIfNew(const char *what, double now, double *before) {
    if (now == *before)
        return;
    printf("%s %.3f\n", what, now);
    fflush(stdout);
    *before = now;
}

static void MEAPI tick(RRender *context) {
    static double frame, selected, bodies, gravity, distance, angle, held, substeps, solver, budget, sleeps, friction,
        restitution, report, mass, velocity, swept, forceLength, selectedOnly;
    const MdtBodyID boxBody = McdModelGetBody(box);
    const MdtContactParamsID params = MstBridgeGetContactParams(u->bridge, 0, 0);
    MeVector3 g;
    MdtWorldGetGravity(u->world, g);
    sayIfNew("frame", frame + 1, &frame);
    sayIfNew("selected", MeAppGetSelected(app) != 0, &selected);
    sayIfNew("held", app->pick.model != 0, &held);
    sayIfNew("bodies", MdtWorldGetTotalBodies(u->world), &bodies);
    sayIfNew("gravity", g[1], &gravity);
    sayIfNew("substeps", MdtWorldGetSubSteps(u->world), &substeps);
    sayIfNew("solver", MdtWorldGetSolver(u->world), &solver);
    sayIfNew("budget", MdtWorldGetWorkBudget(u->world), &budget);
    sayIfNew("sleeps", MdtWorldGetAutoDisable(u->world), &sleeps);
    sayIfNew("friction", MdtContactParamsGetPrimaryFrictionCoeffecient(params), &friction);
    sayIfNew("restitution", MdtContactParamsGetRestitution(params), &restitution);
    sayIfNew("report", MdtWorldReportIsEnabled(u->world), &report);
    sayIfNew("mass", MdtBodyGetMass(boxBody), &mass);
    MdtBodyGetLinearVelocity(boxBody, g);
    sayIfNew("velocity", (int)g[0], &velocity);
    sayIfNew("swept", McdModelIsSwept(box), &swept);
    sayIfNew("forceLength", app->controls->forceLength * 1e6, &forceLength);
    sayIfNew("selectedOnly", app->controls->selectedOnly, &selectedOnly);
    sayIfNew("distance", RCameraGetDistance(context), &distance);
    sayIfNew("angle", RCameraGetRotation(context), &angle);
    MeAppStep(app);
    MstUniverseStep(u, 1. / 60);
}

static void MEAPI_CDECL cleanup(void) {
    MeAppDestroy(app);
    RRenderContextDestroy(rc);
    MstUniverseDestroy(u);
    puts("cleanup");
    CHECK_LEAKS();
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    const MeBool all = MeCommandLineOptionsCheckFor(options, "-layers", 1);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    app = MeAppCreateFromUniverse(u, rc);
    if (!app)
        return 1;
    atexit(cleanup);
    MeAppCreateControls(app);
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    box = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 2, 2, 2), 1000);
    McdModelDynamicsSetPosition(box, 0, 1, 0);
    MdtHingeID hinge = MdtHingeCreate(u->world);
    McdModelID door = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 0.1), 1000);
    McdModelDynamicsSetPosition(door, 2.5, 2, 0);
    MdtHingeSetBodies(hinge, McdModelGetBody(door), 0);
    MdtHingeSetPosition(hinge, 2, 2, 0);
    MdtHingeSetAxis(hinge, 0, 1, 0);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(MdtHingeGetLimit(hinge)), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(MdtHingeGetLimit(hinge)), 1);
    MdtLimitActivateLimits(MdtHingeGetLimit(hinge), METRUE);
    MdtHingeEnable(hinge);
    RGraphicBoxCreate(rc, 1, 1, 0.1f, RPalette[0], McdModelGetTransformPtr(door));
    RGraphicGroundPlaneCreate(rc, 24, 2, RPalette[7], 0);
    RGraphicBoxCreate(rc, 2, 2, 2, RPalette[1], McdModelGetTransformPtr(box));
    RCameraSetLookAt(rc, (const AcmeVector3){0, 1, 0});
    RCameraSetView(rc, 12, 0, 0.2f);
    if (all)
        MeAppSetLayers(app, MstDebugAll);
    RRenderSetWindowTitle(rc, "Karma controls test");
    RRun(rc, tick);
    return 3; /* Not reached. */
}
