/* Layers that explain the picture, the forces' scale, and the outline of what is selected. */
#include "McdModel.h"
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MeMath.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstDebugDraw.h"
#include "RMark.h"
#include "RPanel.h"
#include "me_app_i.h"
#include <math.h>

/* ---- How long the arrows of forces are --------------------------------------------------------------------------- */

static MeReal forceOf(MdtContactID c) {
    MeVector3 f;
    const MdtConstraintID constraint = MdtContactQuaConstraint(c);
    MdtConstraintGetForce(constraint, MdtConstraintGetBody(constraint, 0) ? 0 : 1, f);
    return MeVector3Magnitude(f);
}

/* Of a group's contacts, or of the contact itself, if it is in none. */
static MeReal maxForceOf(MdtConstraintID constraint) {
    const MdtContactGroupID group = MdtConstraintDCastContactGroup(constraint);
    const MdtContactID single = group ? 0 : MdtConstraintDCastContact(constraint);
    MeReal max = single && !MdtContactGetContactGroup(single) ? forceOf(single) : 0;
    for (MdtContactID c = group ? MdtContactGroupGetFirstContact(group) : 0; c;
         c = MdtContactGroupGetNextContact(group, c))
        max = MeMAX(max, forceOf(c));
    return max;
}

/* 1, 2, 5, 10 ...: number 0, 1, 2, 3 ... */
static double lengthOf(int number) {
    static const double steps[] = {1, 2, 5};
    const int decade = (number >= 0 ? number : number - 2) / 3;
    return steps[number - 3 * decade] * pow(10, decade);
}

/* The last one that is not above a length, but for rounding. */
static int numberOf(MeReal length) {
    int number = 3 * (int)floor(log10((double)length)) + 3;
    while (lengthOf(number) > 1.0001 * (double)length)
        number--;
    return number;
}

/* The largest force of this moment is drawn at most one length scale long. */
static void fitForces(MeApp *app) {
    MeReal max = 0;
    for (MdtConstraintID c = MdtConstraintGetFirst(app->world); c; c = MdtConstraintGetNext(c))
        max = MeMAX(max, maxForceOf(c));
    if (max > 0)
        app->controls->forceLength = (MeReal)lengthOf(numberOf(app->lengthScale / max));
}

/* ---- What is drawn ----------------------------------------------------------------------------------------------- */

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

/* The outline of what is selected. */
static void MEAPI markOutline(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]) {
    static const float accent[4] = {1, .72f, .20f, 1};
    (void)color;
    RMarkLine(((MeApp *)userdata)->rc, a, b, accent, 2.5f);
}

MdtBodyID meapp_selectedBody(const MeApp *app) {
    const McdModelID m = MeAppGetSelected(app);
    return m ? McdModelGetBody(m) : 0;
}

static void drawSelected(MeApp *app, MdtBodyID selected) {
    const MstDebugDraw table = {.line = markOutline, .userdata = app, .only = selected};
    MstDebugDrawParts(app->world, app->space, app->lengthScale, MstDebugShapes, &table);
}

static void MEAPI drawLayers(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    MeAppControls *c = app->controls;
    const MdtBodyID selected = meapp_selectedBody(app);
    if ((c->layers & MstDebugForces) && !(c->forceLength > 0))
        fitForces(app);
    const MstDebugDraw table = {.line = markLine,
                                .point = markPoint,
                                .triangle = markTriangle,
                                .text = markText,
                                .userdata = app,
                                .forceLength = c->forceLength,
                                .only = c->selectedOnly ? selected : 0};
    (void)rc;
    if (c->layers)
        MstDebugDrawParts(app->world, app->space, app->lengthScale, c->layers, &table);
    if (selected && c->selectionSeen > 0)
        drawSelected(app, selected);
    c->selectionSeen -= c->selectionSeen > 0;
}

/* ---- The panel --------------------------------------------------------------------------------------------------- */

static const char *const layerNames[] = {"shapes",
                                         "bounding boxes (AABBs)",
                                         "contacts and normals",
                                         "contact forces",
                                         "joints and axes",
                                         "limits and angles",
                                         "centres of mass",
                                         "velocities",
                                         "partitions by colour",
                                         "sleep by colour",
                                         "solver by colour",
                                         "names"};
enum { LAYERS = sizeof layerNames / sizeof layerNames[0] };

static void showForceLength(MeApp *app) {
    MeAppControls *c = app->controls;
    if (!(c->forceLength > 0))
        return;
    meapp_say("1 m of an arrow is %.7g N", 1 / (double)c->forceLength);
    if (RPanelButton("longer"))
        c->forceLength = (MeReal)lengthOf(numberOf(c->forceLength) + 1);
    RPanelSameLine();
    if (RPanelButton("shorter"))
        c->forceLength = (MeReal)lengthOf(numberOf(c->forceLength) - 1);
    RPanelSameLine();
    if (RPanelButton("fit"))
        fitForces(app);
}

static void MEAPI showLayers(RRender *rc, void *userdata) {
    MeApp *app = userdata;
    MeAppControls *c = app->controls;
    (void)rc;
    if (RPanelCheck("selected only", &c->selectedOnly) && c->selectedOnly && !meapp_selectedBody(app))
        c->selectedOnly = MEFALSE;
    if (!meapp_selectedBody(app))
        RPanelText("(click something that moves)");
    if (c->selectedOnly)
        c->selectionSeen = MEAPP_SEEN;
    for (int i = 0; i < LAYERS; i++) {
        MeBool on = (c->layers >> i & 1u) != 0;
        if (RPanelCheck(layerNames[i], &on))
            c->layers ^= 1u << i;
        if (1u << i == MstDebugForces && on)
            showForceLength(app);
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

void meapp_createLayers(MeApp *app) {
    RRenderSetMarkCallBack(app->rc, drawLayers, app);
    RPanelCreate(app->rc, "Layers", showLayers, app);
    RPanelShow(app->rc, "Layers", MEFALSE);
}
