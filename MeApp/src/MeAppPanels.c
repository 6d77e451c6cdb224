/* Panels of a demonstration program: settings of the simulation, the report of its steps over time, and what the model
 * that was clicked last is and does, and layers that explain the picture. */
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
#include "RMark.h"
#include "RPanel.h"
#include "me_app_i.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(const char *format, ...) {
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
    say("%d of %d bodies awake", MdtWorldGetEnabledBodies(w), MdtWorldGetTotalBodies(w));
}

static int lastMaterial(McdSpaceID space) {
    McdSpaceModelIterator it;
    McdModelID m;
    unsigned int last = 0;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &m))
        last = MeMAX(last, McdModelGetMaterial(m));
    return (int)last;
}

/* Contacts without friction get the friction cone with it, others keep their model. */
static void setFriction(MdtContactParamsID p, MeReal friction) {
    if (MdtContactParamsGetType(p) == MdtContactTypeFrictionZero)
        MdtContactParamsSetSurface(p, friction, MdtContactParamsGetRestitution(p));
    else
        MdtContactParamsSetFrictionCoeffecient(p, friction);
}

static void showMaterials(MeApp *app) {
    int *pair = app->controls->material;
    const int last = lastMaterial(app->space);
    if (last > 0) {
        RPanelWhole("material", &pair[0], 0, last);
        RPanelWhole("on material", &pair[1], 0, last);
    }
    const MdtContactParamsID p =
        MstBridgeGetContactParams(app->universe->bridge, (MstMaterialID)pair[0], (MstMaterialID)pair[1]);
    MeReal friction = MdtContactParamsGetPrimaryFrictionCoeffecient(p);
    MeReal restitution = MdtContactParamsGetRestitution(p);
    if (RPanelSlider("friction", &friction, 0, 2, NULL))
        setFriction(p, friction);
    if (RPanelSlider("restitution", &restitution, 0, 1, NULL))
        MdtContactParamsSetRestitution(p, restitution);
}

static void MEAPI showSimulation(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    (void)rc;
    showGravity(app);
    showSolver(app->world);
    showSleep(app->world);
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
        say("worker %d busy for %.2f ms a step", i, 1e3 * app->controls->worker[i].mean);
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
    say("%d bodies, %d constraints", r.bodies, r.constraints);
    say("solver: %s", pathName(r.way));
    say("joint error %.2g mm", 1e3 * (double)r.jointGap);
}

static void MEAPI showReport(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    MeAppControls *c = app->controls;
    enum { LINGERS = 10 }; /* Steps, until the report is off when nobody looks. */
    (void)rc;
    c->figuresSeen = LINGERS;
    RPanelWhole("partition", &c->partition, -1, MeMAX(MdtWorldGetReportCount(app->world) - 1, 0));
    RPanelText(c->partition < 0 ? "-1: all of them" : "");
    showPath(app);
    showWorkers(app);
    for (int i = 0; i < MEAPP_PLOTS; i++)
        RPanelPlot(plots[i].name, c->history[i], MEAPP_HISTORY, 0, plots[i].unit);
}

/* ---- Inspector --------------------------------------------------------------------------------------------------- */

static void sayVector(const char *name, const MeVector3 v, const char *unit) {
    say("%s  %.3f  %.3f  %.3f %s", name, (double)v[0], (double)v[1], (double)v[2], unit);
}

static int countConstraints(MdtBodyID b, MeBool contacts) {
    int n = 0;
    if (contacts)
        for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c))
            n++;
    else
        for (MdtConstraintID c = MdtBodyGetFirstConstraint(b); c; c = MdtBodyGetNextConstraint(b, c))
            n++;
    return n;
}

static void showMotion(MdtBodyID b) {
    MeVector3 v;
    MdtBodyGetCenterOfMassPosition(b, v);
    sayVector("centre of mass", v, "m");
    MdtBodyGetLinearVelocity(b, v);
    sayVector("velocity", v, "m/s");
    MdtBodyGetAngularVelocity(b, v);
    sayVector("angular velocity", v, "rad/s");
    say("mass  %.4g kg    energy of motion  %.4g J", (double)MdtBodyGetMass(b), (double)MdtBodyGetKineticEnergy(b));
    say("%s    partition %d of %d bodies", MdtBodyIsEnabled(b) ? "awake" : "asleep", MdtBodyGetPartition(b),
        MdtBodyGetPartitionSize(b));
    say("%d constraints, %d contacts", countConstraints(b, MEFALSE), countConstraints(b, METRUE));
}

static void MEAPI showInspector(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    const McdModelID m = MeAppGetSelected(app);
    const MdtBodyID b = m ? McdModelGetBody(m) : 0;
    (void)rc;
    if (!b) {
        RPanelText("Click something that moves.");
        return;
    }
    say("%s, material %u", McdGeometryGetTypeName(McdModelGetGeometry(m)), McdModelGetMaterial(m));
    showMotion(b);
    if (app->pick.model == m)
        say("the mouse pulls with %.4g N", (double)app->pick.force);
    if (RPanelButton("look at it (F)"))
        MeAppFrameSelected(app);
    RPanelSameLine();
    if (RPanelButton(MdtBodyIsEnabled(b) ? "put to sleep" : "wake"))
        (MdtBodyIsEnabled(b) ? MdtBodyDisable : MdtBodyEnable)(b);
}

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

static void MEAPI markLine(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]) {
    RMarkLine(((MeApp *)userdata)->rc, a, b, color, 1.5f);
}

static void MEAPI markPoint(void *userdata, const MeVector3 p, const float color[4]) {
    RMarkPoint(((MeApp *)userdata)->rc, p, color, 6);
}

static void MEAPI markTriangle(void *userdata, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                               const float color[4]) {
    RMarkTriangle(((MeApp *)userdata)->rc, a, b, c, color);
}

static void MEAPI markText(void *userdata, const MeVector3 p, const char *text, const float color[4]) {
    RMarkText(((MeApp *)userdata)->rc, p, text, color);
}

static void MEAPI drawLayers(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    const MstDebugDraw table = {markLine, markPoint, markTriangle, markText, app};
    (void)rc;
    if (app->controls->layers)
        MstDebugDrawParts(app->world, app->space, app->lengthScale, app->controls->layers, &table);
}

static const char *const layerNames[] = {"shapes",
                                         "boxes along the axes",
                                         "contacts and normals",
                                         "contact forces",
                                         "joints and axes",
                                         "limits and angles",
                                         "centres of mass",
                                         "velocities",
                                         "partitions by colour",
                                         "sleep by colour",
                                         "solver taken by colour",
                                         "names"};
enum { LAYERS = sizeof layerNames / sizeof layerNames[0] };

static void MEAPI showLayers(RRender *rc, void *userdata) {
    MeAppControls *c = ((MeApp *)userdata)->controls;
    (void)rc;
    for (int i = 0; i < LAYERS; i++) {
        MeBool on = (c->layers >> i & 1u) != 0;
        if (RPanelCheck(layerNames[i], &on))
            c->layers ^= 1u << i;
    }
}

void MEAPI MeAppSetLayers(MeApp *app, unsigned int layers) {
    if (!meapp_check(app, "MeAppSetLayers"))
        return;
    if (!app->controls)
        MeWarning(1, "MeAppSetLayers: there are no controls (MeAppCreateControls)");
    else if (layers & ~(unsigned int)MstDebugAll)
        MeWarning(1, "MeAppSetLayers: layers is %u: it must be a sum of MstDebugLayer", layers);
    else
        app->controls->layers = layers;
}

void meapp_createPanels(MeApp *app) {
    RRenderSetMarkCallBack(app->rc, drawLayers, app);
    RPanelCreate(app->rc, "Simulation", showSimulation, app);
    RPanelCreate(app->rc, "Inspector", showInspector, app);
    RPanelCreate(app->rc, "Layers", showLayers, app);
    RPanelShow(app->rc, "Layers", MEFALSE);
    RPanelCreate(app->rc, "Report", showReport, app);
    RPanelShow(app->rc, "Report", MEFALSE);
}
