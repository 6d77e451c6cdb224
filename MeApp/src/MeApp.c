/* A demonstration program's helpers: their creation and end, a step of them, and the lines that they draw. */
#include "MeInternal.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstUniverse.h"
#include "me_app_i.h"
#include <string.h>

MeBool meapp_check(const MeApp *app, const char *function) {
    if (!app)
        MeWarning(1, "%s: app is null", function);
    return app != 0;
}

/* ---- lines ------------------------------------------------------------------------------------------------------- */

RNativeLine *meapp_lineCreate(RRender *rc, const float color[4]) {
    static const AcmeReal zero[3] = {0, 0, 0};
    RNativeLine *line = RNLineCreate(rc, zero, zero, color, 0);
    if (line)
        RNLineRemoveFromList(rc, line);
    return line;
}

void meapp_lineShow(RRender *rc, RNativeLine *line, const MeVector3 start, const MeVector3 end) {
    const AcmeReal a[3] = {(AcmeReal)start[0], (AcmeReal)start[1], (AcmeReal)start[2]};
    const AcmeReal b[3] = {(AcmeReal)end[0], (AcmeReal)end[1], (AcmeReal)end[2]};
    RNLineMoveEnds(line, a, b);
    if (!line->m_pRender)
        RNLineAddToList(rc, line);
}

void meapp_lineHide(RNativeLine *line) {
    if (line->m_pRender)
        RNLineRemoveFromList(line->m_pRender, line);
}

/* ---- creation and end -------------------------------------------------------------------------------------------- */

static void *newZeroed(size_t size) {
    void *p = MeMemoryAPI.create(size);
    if (p)
        memset(p, 0, size);
    else
        MeFatalError(1, "MeAppCreate: no memory");
    return p;
}

/* The parts that the helpers own. */
static MeBool createMembers(MeApp *app) {
    static const float steel[4] = {.15f, .17f, .20f, 1};
    app->contacts = newZeroed(sizeof *app->contacts);
    app->pick.line = meapp_lineCreate(app->rc, steel);
    if (app->contacts)
        app->contacts->length = (MeReal)0.3 * app->lengthScale;
    return app->contacts && app->pick.line;
}

static MeApp *create(MdtWorldID world, McdSpaceID space, RRender *rc, MeReal lengthScale) {
    if (!world || !space || !rc) {
        MeWarning(1, "MeAppCreate: %s is null", !world ? "world" : !space ? "space" : "rc");
        return 0;
    }
    MeApp *app = newZeroed(sizeof *app);
    if (!app)
        return 0;
    app->world = world;
    app->space = space;
    app->rc = rc;
    app->lengthScale = lengthScale;
    if (createMembers(app))
        return app;
    MeAppDestroy(app);
    return 0;
}

MeApp *MEAPI MeAppCreate(const MdtWorldID world, const McdSpaceID space, RRender *rc) {
    return create(world, space, rc, 1);
}

MeApp *MEAPI MeAppCreateFromUniverse(const MstUniverseID u, RRender *rc) {
    MeApp *app;
    ME_UNDER_OWN_NAME({
        const MdtWorldID world = MstUniverseGetWorld(u);
        app = world ? create(world, u->space, rc, u->sizes.lengthScale) : 0;
    });
    if (app)
        app->universe = u;
    return app;
}

void MEAPI MeAppDestroy(MeApp *const app) {
    if (!app)
        return;
    if (app->pick.line)
        RNLineDestroy(app->pick.line);
    if (app->contacts) {
        meapp_contactsFree(app->contacts);
        MeMemoryAPI.destroy(app->contacts);
    }
    meapp_controlsFree(app);
    meapp_shownFree(app);
    MeMemoryAPI.destroy(app);
}

MstUniverseID MEAPI MeAppGetMstUniverse(MeApp *app) {
    return meapp_check(app, "MeAppGetMstUniverse") ? app->universe : 0;
}

void MEAPI MeAppStep(MeApp *app) {
    if (!meapp_check(app, "MeAppStep"))
        return;
    MeAppUpdateMouseSpring(app);
    MeAppDrawContacts(app);
    meapp_followStep(app);
    if (app->controls)
        meapp_sampleReport(app);
}
