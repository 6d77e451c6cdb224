/* A universe on the screen: a context and a universe in one call, graphics of all models, and the main loop. */
#include "McdModel.h"
#include "McdSpace.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstAdvise.h"
#include "MstModelDynamics.h"
#include "MstUniverse.h"
#include "RGeometry.h"
#include "me_app_i.h"
#include <stdlib.h>
#include <string.h>

/* ---- graphics of models ------------------------------------------------------------------------------------------ */

typedef struct {
    MeU64 serial;      /* A model's: never used again, so a new model in an old one's memory is another. */
    RGraphic *graphic; /* Null: the geometry has no shape of its own. */
    MeBool isInSpace;  /* As the space was walked last. */
} ShownModel;

/* In the order of serials, so that a model's is found by bisection. */
struct MeAppShown {
    ShownModel *items;
    int count, capacity;
    int colors; /* How many of the palette have been handed out. */
};

/* The first that has this serial or a larger one. */
static int indexOf(const struct MeAppShown *shown, MeU64 serial) {
    int low = 0, high = shown->count;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (shown->items[middle].serial < serial)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static ShownModel *shownOf(const MeApp *app, McdModelID m) {
    const struct MeAppShown *shown = app->shown;
    const MeU64 serial = McdModelGetSerial(m);
    const int i = shown ? indexOf(shown, serial) : 0;
    return shown && i < shown->count && shown->items[i].serial == serial ? &shown->items[i] : 0;
}

static MeBool createShown(MeApp *app) {
    if (!app->shown && (app->shown = MeMemoryAPI.create(sizeof *app->shown)) != 0)
        memset(app->shown, 0, sizeof *app->shown);
    return app->shown != 0;
}

static MeBool makeRoom(MeApp *app) {
    struct MeAppShown *shown = createShown(app) ? app->shown : 0;
    if (shown && shown->count < shown->capacity)
        return METRUE;
    const int capacity = shown ? 2 * shown->capacity + 64 : 0;
    ShownModel *items = shown ? MeMemoryAPI.create((size_t)capacity * sizeof *items) : 0;
    if (!items) {
        MeFatalError(1, "MeAppShowModel: no memory");
        return MEFALSE;
    }
    if (shown->items) {
        memcpy(items, shown->items, (size_t)shown->count * sizeof *items);
        MeMemoryAPI.destroy(shown->items);
    }
    shown->items = items;
    shown->capacity = capacity;
    return METRUE;
}

/* Of a model that has none yet, without a graphic. */
static ShownModel *insertShown(MeApp *app, McdModelID m) {
    if (!makeRoom(app))
        return 0;
    struct MeAppShown *shown = app->shown;
    const int i = indexOf(shown, McdModelGetSerial(m));
    memmove(&shown->items[i + 1], &shown->items[i], (size_t)(shown->count - i) * sizeof *shown->items);
    shown->items[i] = (ShownModel){McdModelGetSerial(m), 0, METRUE};
    shown->count++;
    return &shown->items[i];
}

static ShownModel *addShown(MeApp *app, McdModelID m, const float color[4]) {
    ShownModel *shown = insertShown(app, m);
    if (shown)
        shown->graphic = RGraphicCreateFromModel(app->rc, m, color);
    if (shown && shown->graphic && McdModelIsSensor(m)) /* what goes through it is to be seen */
        RGraphicSetWireframe(shown->graphic, METRUE);
    return shown;
}

/* Fixed models are grey, the others go round the palette but for its grey, which is the last one. */
static const float *nextColor(MeApp *app, McdModelID m) {
    static const float grey[4] = {.82f, .83f, .80f, 1};
    if (!McdModelGetBody(m) || !createShown(app))
        return grey;
    return RPalette[app->shown->colors++ % 7];
}

RGraphic *MEAPI MeAppShowModel(MeApp *app, McdModelID m, const float color[4]) {
    if (!meapp_check(app, "MeAppShowModel") || !meapp_canDraw("MeAppShowModel", app->rc, color))
        return 0;
    if (!m || !McdModelIsValid(m)) {
        MeWarning(1, "MeAppShowModel: m is null, or has been destroyed");
        return 0;
    }
    ShownModel *shown = shownOf(app, m);
    if (!shown)
        shown = addShown(app, m, color);
    else if (shown->graphic)
        RGraphicSetColor(shown->graphic, color);
    return shown ? shown->graphic : 0;
}

static void removeGraphic(const MeApp *app, const ShownModel *shown) {
    if (shown->graphic)
        RGraphicDelete(app->rc, shown->graphic, 0);
}

RGraphic *MEAPI MeAppShowModelAs(MeApp *app, McdModelID m, RGraphic *rg) {
    if (!meapp_check(app, "MeAppShowModelAs"))
        return 0;
    if (!m || !McdModelIsValid(m) || !rg) {
        MeWarning(1, "MeAppShowModelAs: %s", rg ? "m is null, or has been destroyed" : "rg is null");
        return 0;
    }
    ShownModel *shown = shownOf(app, m);
    if (!shown)
        shown = insertShown(app, m);
    if (!shown)
        return 0;
    if (shown->graphic != rg)
        removeGraphic(app, shown);
    shown->graphic = rg;
    RGraphicSetTransformPtr(rg, McdModelGetTransformPtr(m));
    return rg;
}

/* Notes the models of the space and gives new ones a graphic. Each graphic follows its model's present transform. */
static void showModelsOfSpace(MeApp *app) {
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(app->space, &it);
    while (McdSpaceGetModel(app->space, &it, &m)) {
        ShownModel *shown = shownOf(app, m);
        if (!shown)
            shown = addShown(app, m, nextColor(app, m));
        if (!shown)
            return;
        shown->isInSpace = METRUE;
        if (shown->graphic)
            RGraphicSetTransformPtr(shown->graphic, McdModelGetTransformPtr(m));
    }
}

int MEAPI MeAppShowUniverse(MeApp *app) {
    if (!meapp_check(app, "MeAppShowUniverse"))
        return 0;
    for (int i = 0; app->shown && i < app->shown->count; i++)
        app->shown->items[i].isInSpace = MEFALSE;
    showModelsOfSpace(app);
    int kept = 0;
    for (int i = 0; app->shown && i < app->shown->count; i++) {
        if (app->shown->items[i].isInSpace)
            app->shown->items[kept++] = app->shown->items[i];
        else
            removeGraphic(app, &app->shown->items[i]);
    }
    if (app->shown)
        app->shown->count = kept;
    return kept;
}

void meapp_shownFree(MeApp *app) {
    if (!app->shown)
        return;
    for (int i = 0; i < app->shown->count; i++)
        removeGraphic(app, &app->shown->items[i]);
    if (app->shown->items)
        MeMemoryAPI.destroy(app->shown->items);
    MeMemoryAPI.destroy(app->shown);
    app->shown = 0;
}

/* ---- start and end ----------------------------------------------------------------------------------------------- */

static RRender *createContext(int argc, const char **argv, const char *name) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 0;
    RRenderSetWindowTitle(rc, name);
    RRenderSetAppName(rc, name);
    return rc;
}

/* From above and from the side, at the origin. */
static void placeCamera(RRender *rc, MeReal lengthScale) {
    const AcmeVector3 origin = {0, 0, 0};
    RCameraSetUp(rc, 0, 0, 1);
    RCameraSetLookAt(rc, origin);
    RCameraSetView(rc, 12 * (AcmeReal)lengthScale, .5f, .3f);
}

/* Without memory for them the calling thread steps alone, after a warning. */
void meapp_setWorkers(MeApp *app, int workers) {
    const MeTaskPoolID before = app->pool;
    app->pool = workers > 1 ? MeTaskPoolCreate(workers) : 0;
    MdtWorldSetTaskPool(MstUniverseGetWorld(app->universe), app->pool);
    if (before)
        MeTaskPoolDestroy(before);
}

static void MEAPI printAdviceAndEnd(const MstAdvice *advice, void *userdata) {
    (void)userdata;
    MstAdvicePrint(advice);
    exit(advice->count > 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* -advise */
static void requestAdvice(MeApp *app) {
    AcmeReal *request = app->rc->m_Options.m_Advise;
    MstAdviceParams params;
    if (!(request[0] > 0))
        return;
    MstAdviceParamsReset(&params);
    params.seconds = (MeReal)request[0];
    params.after = (MeReal)request[1];
    MstAdvise(app->universe, &params, printAdviceAndEnd, 0);
    request[0] = 0;
}

MeApp *MEAPI MeAppStart(int argc, const char **argv, const char *name, const MstUniverseSizes *sizes) {
    if (!argv || !name) {
        MeWarning(1, "MeAppStart: %s is null", argv ? "name" : "argv");
        return 0;
    }
    RRender *rc = createContext(argc, argv, name);
    const MstUniverseID u = rc ? MstUniverseCreate(sizes ? sizes : &MstUniverseGrowingSizes) : 0;
    MeApp *app = u ? MeAppCreateFromUniverse(u, rc) : 0;
    if (app) {
        placeCamera(rc, app->lengthScale);
        MeAppCreateControls(app);
        app->ownsUniverse = METRUE;
        if (rc->m_Options.m_nWorkers > 1)
            meapp_setWorkers(app, rc->m_Options.m_nWorkers);
        requestAdvice(app);
        return app;
    }
    if (rc)
        RRenderContextDestroy(rc);
    MstUniverseDestroy(u);
    return 0;
}

void MEAPI MeAppEnd(MeApp *app) {
    if (!app)
        return;
    RRender *rc = app->rc;
    const MstUniverseID u = app->universe;
    const MeTaskPoolID pool = app->pool;
    MeAppDestroy(app);
    RRenderContextDestroy(rc);
    MstUniverseDestroy(u);
    MeTaskPoolDestroy(pool);
}

/* ---- main loop --------------------------------------------------------------------------------------------------- */

/* What exit() has to end, since RRun does not return. */
static struct {
    MeApp *app;
    MeReal step;
    MeAppStepCB beforeStep;
    void *userdata;
} running;

static void MEAPI_CDECL endRunning(void) {
    MeAppEnd(running.app);
    running.app = 0;
}

static void MEAPI tick(RRender *rc) {
    MeApp *app = running.app;
    (void)rc;
    MeAppStep(app);
    if (running.beforeStep)
        running.beforeStep(app, running.userdata);
    MstUniverseStep(app->universe, running.step);
    MeAppShowUniverse(app);
}

void MEAPI MeAppRun(MeApp *app, MeReal step, MeAppStepCB beforeStep, void *userdata) {
    if (!meapp_check(app, "MeAppRun"))
        return;
    if (!app->universe || running.app || !(step > 0) || !MeRealIsValid(step)) {
        MeWarning(1, "MeAppRun: %s",
                  !app->universe ? "app has no universe"
                  : running.app  ? "it is running"
                                 : "step is not above 0");
        return;
    }
    running.app = app;
    running.step = step;
    if (app->controls)
        app->controls->step = &running.step;
    running.beforeStep = beforeStep;
    running.userdata = userdata;
    atexit(endRunning);
    MeAppShowUniverse(app); /* for a start in pause */
    RRenderSetTickRate(app->rc, (AcmeReal)(1 / step));
    RRun(app->rc, tick);
}
