/* The panel of the model that was clicked last: what it is and does, and settings of it. */
#include "McdGeometry.h"
#include "McdModel.h"
#include "MdtBody.h"
#include "MdtContactParams.h"
#include "MeMath.h"
#include "MeViewer.h"
#include "MstBridge.h"
#include "MstModelDynamics.h"
#include "RPanel.h"
#include "me_app_i.h"

/* ---- What it does ------------------------------------------------------------------------------------------------ */

static void sayVector(const char *name, const MeVector3 v, const char *unit) {
    meapp_say("%s\n   %.3f  %.3f  %.3f %s", name, (double)v[0], (double)v[1], (double)v[2], unit);
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
    MdtBodyGetAngularVelocity(b, v);
    sayVector("angular velocity", v, "rad/s");
    meapp_say("kinetic energy  %.4g J", (double)MdtBodyGetKineticEnergy(b));
    if (MdtBodyGetPartition(b) >= 0)
        meapp_say("partition %d, of %d bodies", MdtBodyGetPartition(b), MdtBodyGetPartitionSize(b));
    meapp_say("%d constraints, %d contacts", countConstraints(b, MEFALSE), countConstraints(b, METRUE));
}

/* ---- Settings ---------------------------------------------------------------------------------------------------- */

/* The inertia is scaled with it: as of a body of the same shape and another density. */
static void setMass(MdtBodyID b, MeReal mass) {
    MeMatrix3 inertia;
    MdtBodyGetInertiaTensor(b, inertia);
    MeMatrix3Scale(inertia, mass / MdtBodyGetMass(b));
    MdtBodySetMass(b, mass);
    MdtBodySetInertiaTensor(b, (const MeVector3 *)inertia);
    MdtBodyEnable(b);
}

/* From a hundredth to a hundred times the mass that it had when it was clicked. */
static void showMass(MeAppControls *c, McdModelID m, MdtBodyID b) {
    MeReal mass = MdtBodyGetMass(b);
    if (McdModelGetSerial(m) != c->inspected) {
        c->inspected = McdModelGetSerial(m);
        c->massBefore = mass;
    }
    if (RPanelScale("mass", &mass, c->massBefore / 100, c->massBefore * 100, "kg"))
        setMass(b, mass);
}

static void showVelocity(const MeApp *app, MdtBodyID b) {
    static const char *const names[3] = {"velocity x", "velocity y", "velocity z"};
    const MeReal max = 20 * app->lengthScale;
    MeVector3 v;
    for (int i = 0; i < 3; i++) {
        MdtBodyGetLinearVelocity(b, v);
        if (!RPanelSlider(names[i], &v[i], -max, max, "m/s"))
            continue;
        MdtBodyEnable(b);
        MdtBodySetLinearVelocity(b, v[0], v[1], v[2]);
    }
    if (!RPanelButton("stop"))
        return;
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
}

/* Friction belongs to pairs of materials, so that it changes for all models of the two. */
static void showFriction(MeApp *app, McdModelID m) {
    int *other = &app->controls->inspectedOther;
    const int own = (int)McdModelGetMaterial(m), last = meapp_lastMaterial(app->space);
    if (last > 0)
        RPanelWhole("on material", other, 0, last);
    const MdtContactParamsID p =
        MstBridgeGetContactParams(app->universe->bridge, (MstMaterialID)own, (MstMaterialID)*other);
    MeReal friction = MdtContactParamsGetPrimaryFrictionCoeffecient(p);
    if (RPanelSlider("friction", &friction, 0, 2, 0))
        meapp_setFriction(p, friction);
    meapp_say("(of all pairs of materials %d and %d)", own, *other);
}

static void showSettings(MeApp *app, McdModelID m, MdtBodyID b) {
    const MeBool isAwake = MdtBodyIsEnabled(b);
    MeBool isSwept = McdModelIsSwept(m);
    showMass(app->controls, m, b);
    showVelocity(app, b);
    RPanelSameLine();
    if (RPanelButton(isAwake ? "sleep" : "wake"))
        (isAwake ? MdtBodyDisable : MdtBodyEnable)(b);
    RPanelSameLine();
    if (RPanelButton("focus (F)"))
        MeAppFrameSelected(app);
    if (RPanelCheck("swept (continuous)", &isSwept))
        McdModelSetSwept(m, isSwept);
    if (app->universe)
        showFriction(app, m);
}

/* ---- The panel --------------------------------------------------------------------------------------------------- */

void MEAPI meapp_showInspector(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    const MdtBodyID b = meapp_selectedBody(app);
    const McdModelID m = b ? app->selected : 0;
    (void)rc;
    if (!b) {
        RPanelText("Click something that moves.");
        return;
    }
    app->controls->selectionSeen = MEAPP_SEEN;
    meapp_say("%s, material %u, %s", McdGeometryGetTypeName(McdModelGetGeometry(m)), McdModelGetMaterial(m),
              MdtBodyIsEnabled(b) ? "awake" : "asleep");
    showSettings(app, m, b);
    showMotion(b);
    if (app->pick.model == m)
        meapp_say("the mouse pulls with %.4g N", (double)app->pick.force);
}
