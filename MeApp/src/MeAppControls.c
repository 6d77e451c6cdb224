/* What the user of a demonstration program may expect: keys that frame a model and throw a ball. */
#include "McdFrame.h"
#include "McdModel.h"
#include "McdSpace.h"
#include "McdSphere.h"
#include "MdtBody.h"
#include "MeMath.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstModelDynamics.h"
#include "MstUtils.h"
#include "RMark.h"
#include "RPanel.h"
#include "me_app_i.h"
#include <string.h>

/* ---- framing ----------------------------------------------------------------------------------------------------- */

/* The sphere round all models with bodies: round the middle of their boxes. */
static MeBool sphereRoundAll(const MeApp *app, MeVector3 centre, MeReal *radius) {
    McdSpaceModelIterator it;
    McdModelID m;
    MeVector3 low = {0, 0, 0}, high = {0, 0, 0};
    MeBool isAny = MEFALSE;
    McdSpaceModelIteratorBegin(app->space, &it);
    while (McdSpaceGetModel(app->space, &it, &m)) {
        MeVector3 a, b;
        if (!McdModelGetBody(m))
            continue;
        McdModelGetAABB(m, a, b);
        for (int i = 0; i < 3; i++) {
            low[i] = isAny ? MeMIN(low[i], a[i]) : a[i];
            high[i] = isAny ? MeMAX(high[i], b[i]) : b[i];
        }
        isAny = METRUE;
    }
    MeVector3Add(centre, low, high);
    MeVector3Scale(centre, (MeReal)0.5);
    *radius = MeVector3Distance(low, high) / 2;
    return isAny;
}

void MEAPI MeAppFrameSelected(MeApp *app) {
    MeVector3 centre;
    MeReal radius;
    if (!meapp_check(app, "MeAppFrameSelected"))
        return;
    const McdModelID selected = MeAppGetSelected(app);
    if (selected)
        McdModelGetBSphere(selected, centre, &radius);
    else if (!sphereRoundAll(app, centre, &radius))
        return;
    if (!(radius > 0) || !MeRealIsValid(radius))
        return;
    const AcmeVector3 at = {(AcmeReal)centre[0], (AcmeReal)centre[1], (AcmeReal)centre[2]};
    RCameraSetLookAt(app->rc, at);
    /* The sphere's diameter is a third of the height that is seen at its distance. */
    RCameraSetOffset(app->rc, 3 * radius / MeTan((MeReal)app->rc->m_CameraFov / 2));
}

/* ---- throwing ---------------------------------------------------------------------------------------------------- */

static MeBool isStillThere(const MeAppControls *c, int i) {
    const McdModelID m = c->balls[i];
    return m && McdModelIsValid(m) && McdModelGetSerial(m) == c->ballSerials[i] && McdModelGetBody(m);
}

static McdModelID createBall(MeApp *app) {
    static const float color[4] = {.95f, .83f, .42f, 1};
    const MeReal r = (MeReal)0.25 * app->lengthScale, density = 1000 * app->universe->sizes.massScale;
    const MeReal perVolume = density / (app->lengthScale * app->lengthScale * app->lengthScale);
    const McdGeometryID sphere = McdSphereCreate(app->universe->frame, r);
    const McdModelID ball = sphere ? MstModelAndBodyCreate(app->universe, sphere, perVolume) : 0;
    if (!ball)
        return 0;
    McdModelSetSwept(ball, METRUE);
    MeAppShowModel(app, ball, color);
    return ball;
}

McdModelID MEAPI MeAppThrowBall(MeApp *app) {
    AcmeVector3 eye, look;
    if (!meapp_check(app, "MeAppThrowBall") || !app->universe || !app->controls)
        return 0;
    MeAppControls *c = app->controls;
    const int i = c->thrown % MEAPP_BALLS;
    if (!isStillThere(c, i))
        c->balls[i] = createBall(app);
    if (!c->balls[i])
        return 0;
    c->ballSerials[i] = McdModelGetSerial(c->balls[i]);
    c->thrown++;
    RCameraGetPosition(app->rc, eye);
    RCameraGetLookDir(app->rc, look);
    const MeReal speed = 20 * app->lengthScale;
    McdModelDynamicsSetPosition(c->balls[i], (MeReal)eye[0], (MeReal)eye[1], (MeReal)eye[2]);
    McdModelDynamicsSetLinearVelocity(c->balls[i], speed * (MeReal)look[0], speed * (MeReal)look[1],
                                      speed * (MeReal)look[2]);
    McdModelDynamicsSetAngularVelocity(c->balls[i], 0, 0, 0);
    McdModelDynamicsEnable(c->balls[i]);
    return c->balls[i];
}

/* ---- all of it --------------------------------------------------------------------------------------------------- */

static void MEAPI onFrame(RRender *rc, void *userdata) {
    (void)rc;
    MeAppFrameSelected(userdata);
}

static void MEAPI onThrow(RRender *rc, void *userdata) {
    (void)rc;
    MeAppThrowBall(userdata);
}

void MEAPI MeAppCreateControls(MeApp *app) {
    if (!meapp_check(app, "MeAppCreateControls") || app->controls)
        return;
    app->controls = MeMemoryAPI.create(sizeof *app->controls);
    if (!app->controls) {
        MeFatalError(1, "MeAppCreateControls: no memory");
        return;
    }
    memset(app->controls, 0, sizeof *app->controls);
    app->controls->partition = -1;
    RRenderSetMouseCallBackWithText(app->rc, MeAppMousePickCB, app, "pull what the mouse points at; click: what it is");
    RRenderSetKeyCallBack(app->rc, 'f', onFrame, app, "look at what was clicked");
    if (app->universe)
        RRenderSetKeyCallBack(app->rc, ' ', onThrow, app, "throw a ball");
    meapp_createPanels(app);
}

void meapp_controlsFree(MeApp *app) {
    static const char *const titles[] = {"Simulation", "Inspector", "Layers", "Report"};
    if (!app->controls)
        return;
    for (int i = 0; i < 4; i++)
        RPanelDestroy(app->rc, titles[i]);
    RRenderSetMarkCallBack(app->rc, 0, 0);
    RRenderSetKeyCallBack(app->rc, 'f', 0, 0, 0);
    RRenderSetKeyCallBack(app->rc, ' ', 0, 0, 0);
    MeMemoryAPI.destroy(app->controls);
    app->controls = 0;
}

void MEAPI MeAppSetStepPtr(MeApp *app, MeReal *step) {
    if (!meapp_check(app, "MeAppSetStepPtr"))
        return;
    if (app->controls)
        app->controls->step = step;
    else
        MeWarning(1, "MeAppSetStepPtr: there are no controls (MeAppCreateControls)");
}
