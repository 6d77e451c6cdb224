/* Panels of a demonstration program: settings of the simulation, and the report of its steps over time. */
#include "McdGeometry.h"
#include "McdModel.h"
#include "McdSpace.h"
#include "MdtBody.h"
#include "MdtContactParams.h"
#include "MdtReport.h"
#include "MdtWorld.h"
#include "MeMath.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstBridge.h"
#include "MstDebugDraw.h"
#include "MstModelDynamics.h"
#include "RPanel.h"
#include "me_app_i.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void meapp_say(const char *format, ...) {
    char text[160];
    va_list ap;
    va_start(ap, format);
    vsnprintf(text, sizeof text, format, ap);
    va_end(ap);
    RPanelText(text);
}

/* ---- Simulation -------------------------------------------------------------------------------------------------- */

/* Its strength; the direction stays, and is down where there was none. What sleeps wakes: it would not fall. */
static void showGravity(MeApp *app) {
    MeReal *direction = app->controls->gravity;
    MeVector3 g;
    AcmeVector3 up;
    MdtWorldGetGravity(app->world, g);
    RCameraGetUpAxis(app->rc, up);
    MeReal strength = MeVector3Magnitude(g);
    if (strength > 0)
        for (int i = 0; i < 3; i++)
            direction[i] = g[i] / strength;
    else if (MeVector3MagnitudeSqr(direction) == 0)
        MeVector3Set(direction, -(MeReal)up[0], -(MeReal)up[1], -(MeReal)up[2]);
    if (!RPanelSlider("gravity", &strength, 0, 30 * app->lengthScale, "m/s\xc2\xb2"))
        return;
    MdtWorldSetGravity(app->world, direction[0] * strength, direction[1] * strength, direction[2] * strength);
    for (MdtBodyID b = MdtBodyGetFirst(app->world); b; b = MdtBodyGetNext(b))
        MdtBodyEnable(b);
}

static void showSolver(MdtWorldID w) {
    static const char *const names[] = {"auto", "exact", "fast"};
    int solver = (int)MdtWorldGetSolver(w), parts = MdtWorldGetSubSteps(w);
    MeReal budget = MdtWorldGetWorkBudget(w);
    if (RPanelWhole("sub-steps", &parts, 1, 16))
        MdtWorldSetSubSteps(w, parts);
    if (RPanelChoice("solver", &solver, names, 3))
        MdtWorldSetSolver(w, (MdtSolver)solver);
    if (RPanelSlider("work budget", &budget, 0, 400, "million"))
        MdtWorldSetWorkBudget(w, budget);
}

static void showSleep(MdtWorldID w) {
    MeBool sleeps = MdtWorldGetAutoDisable(w);
    if (RPanelCheck("sleep", &sleeps))
        MdtWorldSetAutoDisable(w, sleeps);
    RPanelSameLine();
    if (RPanelButton("wake all"))
        for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b))
            MdtBodyEnable(b);
    RPanelSameLine();
    meapp_say("%d of %d awake", MdtWorldGetEnabledBodies(w), MdtWorldGetTotalBodies(w));
}

int meapp_lastMaterial(McdSpaceID space) {
    McdSpaceModelIterator it;
    McdModelID m;
    unsigned int last = 0;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &m))
        last = MeMAX(last, McdModelGetMaterial(m));
    return (int)last;
}

/* Contacts without friction get the friction cone with it, others keep their model. */
void meapp_setFriction(MdtContactParamsID p, MeReal friction) {
    if (MdtContactParamsGetType(p) == MdtContactTypeFrictionZero)
        MdtContactParamsSetSurface(p, friction, MdtContactParamsGetRestitution(p));
    else
        MdtContactParamsSetFrictionCoeffecient(p, friction);
}

static void showMaterials(MeApp *app) {
    int *pair = app->controls->material;
    const int last = meapp_lastMaterial(app->space);
    if (last > 0) {
        RPanelWhole("material", &pair[0], 0, last);
        RPanelWhole("on material", &pair[1], 0, last);
    }
    const MdtContactParamsID p =
        MstBridgeGetContactParams(app->universe->bridge, (MstMaterialID)pair[0], (MstMaterialID)pair[1]);
    MeReal friction = MdtContactParamsGetPrimaryFrictionCoeffecient(p);
    MeReal restitution = MdtContactParamsGetRestitution(p);
    if (RPanelSlider("friction", &friction, 0, 2, NULL))
        meapp_setFriction(p, friction);
    if (RPanelSlider("restitution", &restitution, 0, 1, NULL))
        MdtContactParamsSetRestitution(p, restitution);
}

/* A step's length as a rate, and the threads: of programs that have told of their step, so that a setting of them has
 * an effect. The ticks follow, so that time goes on as fast as before. */
static void showRate(MeApp *app) {
    MeReal *step = app->controls->step;
    if (!step || !(*step > 0))
        return;
    int rate = (int)(1 / *step + (MeReal)0.5);
    if (RPanelWhole("steps/s (Hz)", &rate, 15, 480)) {
        *step = 1 / (MeReal)rate;
        RRenderSetTickRate(app->rc, (AcmeReal)rate);
    }
}

/* A pool of the program's own is not touched. */
static void showWorkerCount(MeApp *app) {
    const int ours = app->pool ? MeTaskPoolGetWorkers(app->pool) : 1;
    int count = ours;
    if (!app->ownsUniverse || MdtWorldGetWorkerCount(app->world) != ours)
        return;
    if (RPanelWhole("workers", &count, 1, MEAPP_WORKERS))
        meapp_setWorkers(app, count);
}

static void sweepAll(McdSpaceID space, MeBool swept) {
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &m))
        if (McdModelGetBody(m))
            McdModelSetSwept(m, swept);
}

static void showSwept(McdSpaceID space) {
    McdSpaceModelIterator it;
    McdModelID m;
    int swept = 0, all = 0;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &m)) {
        all += McdModelGetBody(m) != 0;
        swept += McdModelGetBody(m) && McdModelIsSwept(m);
    }
    if (RPanelButton("sweep all"))
        sweepAll(space, METRUE);
    RPanelSameLine();
    if (RPanelButton("none"))
        sweepAll(space, MEFALSE);
    RPanelSameLine();
    meapp_say("%d of %d swept", swept, all);
}

static void MEAPI showSimulation(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    (void)rc;
    showGravity(app);
    showRate(app);
    showSolver(app->world);
    showWorkerCount(app);
    showSleep(app->world);
    showSwept(app->space);
    if (app->universe && RPanelSection("Materials"))
        showMaterials(app);
}

/* ---- Report ------------------------------------------------------------------------------------------------------ */

static const struct {
    const char *name, *unit;
} plots[MEAPP_PLOTS] = {{"rows made", "ms"},   {"solved", "ms"},         {"moved", "ms"},
                        {"rows", NULL},        {"factorizations", NULL}, {"residual", "m/s"},
                        {"penetration", "mm"}, {"kinetic energy", "J"},  {"potential energy", "J"}};

static void append(MeAppControls *c, const MdtReport *r) {
    const double now[MEAPP_PLOTS] = {1e3 * (double)r->time[MdtReportStageRows],
                                     1e3 * (double)r->time[MdtReportStageSolve],
                                     1e3 * (double)r->time[MdtReportStageIntegrate],
                                     r->rows,
                                     r->factorizations,
                                     (double)r->residualVelocity,
                                     1e3 * (double)r->penetration,
                                     (double)r->kineticEnergy,
                                     (double)r->potentialEnergy};
    for (int i = 0; i < MEAPP_PLOTS; i++) {
        memmove(c->history[i], c->history[i] + 1, (MEAPP_HISTORY - 1) * sizeof c->history[i][0]);
        c->history[i][MEAPP_HISTORY - 1] = (float)now[i];
    }
}

/* The time that each worker was busy in the step before, in a mean that forgets within some 30 steps. */
static void sampleWorkers(MeApp *app) {
    const double share = 1. / 30;
    for (int i = 0; i < MeMIN(MdtWorldGetWorkerCount(app->world), MEAPP_WORKERS); i++) {
        const double now = (double)MdtWorldGetWorkerTime(app->world, i), before = app->controls->worker[i].before;
        if (before > 0)
            app->controls->worker[i].mean += share * (MeMAX(now - before, 0) - app->controls->worker[i].mean);
        app->controls->worker[i].before = now;
    }
}

static void showWorkers(const MeApp *app) {
    const int count = MdtWorldGetWorkerCount(app->world);
    for (int i = 0; count > 1 && i < MeMIN(count, MEAPP_WORKERS); i++)
        meapp_say("worker %d busy for %.2f ms a step", i, 1e3 * app->controls->worker[i].mean);
}

void meapp_sampleReport(MeApp *app) {
    MeAppControls *c = app->controls;
    MdtReport report;
    const MeBool isSelected = c->figuresSeen > 0 || (c->layers & MstDebugSolver),
                 isOn = MdtWorldReportIsEnabled(app->world);
    if (isSelected && !isOn) {
        MdtWorldEnableReport(app->world);
        c->reportIsOurs = METRUE;
    } else if (!isSelected && c->reportIsOurs) {
        MdtWorldDisableReport(app->world);
        c->reportIsOurs = MEFALSE;
    }
    if (!isSelected) {
        memset(c->worker, 0, sizeof c->worker);
        return;
    }
    c->figuresSeen -= c->figuresSeen > 0;
    sampleWorkers(app);
    const MeBool isOne = c->partition >= 0 && c->partition < MdtWorldGetReportCount(app->world);
    if (isOne ? MdtWorldGetPartitionReport(app->world, c->partition, &report) : MdtWorldGetReport(app->world, &report))
        append(c, &report);
}

static const char *pathName(MdtReportWay way) {
    static const char *const names[] = {"free",  "at rest, not solved",   "the last answer kept", "fast",
                                        "exact", "exact, time of impact", "exact, sub-steps",     "budget used up"};
    return names[way];
}

static void showPath(const MeApp *app) {
    MdtReport r;
    const int partition = app->controls->partition;
    const MeBool isOne = partition >= 0 && partition < MdtWorldGetReportCount(app->world);
    if (!(isOne ? MdtWorldGetPartitionReport(app->world, partition, &r) : MdtWorldGetReport(app->world, &r)))
        return;
    meapp_say("%d bodies, %d constraints", r.bodies, r.constraints);
    meapp_say("solver: %s", pathName(r.way));
    meapp_say("joint error %.2g mm", 1e3 * (double)r.jointGap);
}

static void MEAPI showReport(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    MeAppControls *c = app->controls;
    enum { LINGERS = 10 }; /* Steps, until the report is off when nobody looks. */
    (void)rc;
    c->figuresSeen = LINGERS;
    RPanelWhole("partition", &c->partition, -1, MeMAX(MdtWorldGetReportCount(app->world) - 1, 0));
    if (c->partition < 0)
        RPanelText("(-1: all partitions)");
    showPath(app);
    showWorkers(app);
    for (int i = 0; i < MEAPP_PLOTS; i++)
        RPanelPlot(plots[i].name, c->history[i], MEAPP_HISTORY, 0, plots[i].unit);
}

void meapp_createPanels(MeApp *app) {
    RPanelCreate(app->rc, "Simulation", showSimulation, app);
    RPanelCreate(app->rc, "Inspector", meapp_showInspector, app);
    meapp_createLayers(app);
    RPanelCreate(app->rc, "Report", showReport, app);
    RPanelShow(app->rc, "Report", MEFALSE);
}
