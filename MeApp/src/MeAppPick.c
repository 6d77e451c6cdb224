/* The mouse: which model is under it, and the spring by which it pulls a body. */
#include "McdInteractions.h"
#include "McdModel.h"
#include "McdSpace.h"
#include "MdtBody.h"
#include "MeMath.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "MstModelDynamics.h"
#include "me_app_i.h"

/* ---- what is at a pixel ------------------------------------------------------------------------------------------ */

static MeBool isOrthographic(const RRender *rc) {
    return rc->m_ProjectionMatrix[2][3] == 0;
}

/* From the camera's frame to the world's: p = c R^T + eye. */
static void toWorld(const RRender *rc, const MeVector3 c, MeVector3 p) {
    MeMatrix4TMInverseTransform(p, (const MeVector4 *)rc->m_CameraMatrix, c);
}

/* z in the camera's frame of what is drawn at a depth, -1 (nearest) to 1 (farthest). */
static MeReal zAtDepth(const RRender *rc, MeReal depth) {
    const MeVector4 *P = (const MeVector4 *)rc->m_ProjectionMatrix;
    return (depth * P[3][3] - P[3][2]) / (P[2][2] - depth * P[2][3]);
}

/* The point of a pixel in the plane of this z, camera's frame; `orth`: as if it were seen from as far as the look-at
 * point. */
static void pointAtZ(const MeApp *app, int x, int y, MeReal z, MeBool orth, MeVector3 p) {
    RRender *rc = app->rc;
    const MeVector4 *P = (const MeVector4 *)rc->m_ProjectionMatrix;
    const MeReal away = orth ? (MeReal)rc->m_CameraDist : -z;
    const MeReal w = P[3][3] - P[2][3] * away; /* 1 without perspective */
    AcmeReal u = 0, v = 0;
    MeVector3 c;
    RCalculatePortalCoordinates(rc, 2, 2, x, y, &u, &v);
    MeVector3Set(c, (MeReal)u * w / P[0][0], (MeReal)v * w / P[1][1], z);
    toWorld(rc, c, p);
}

/* What is drawn at a pixel lies between these points. */
static void rayAt(const MeApp *app, int x, int y, MeBool orth, MeVector3 start, MeVector3 end) {
    RRenderUpdateProjectionMatrices(app->rc);
    pointAtZ(app, x, y, zAtDepth(app->rc, -1), orth, start);
    pointAtZ(app, x, y, zAtDepth(app->rc, 1), orth, end);
}

static void direction(const MeVector3 start, const MeVector3 end, MeVector3 dir) {
    MeVector3Subtract(dir, end, start);
    MeVector3Normalize(dir);
}

static MeBool isPlace(const MeReal *result, const char *function) {
    if (!result)
        MeWarning(1, "%s: a result is null: it must be a vector to write to", function);
    return result != 0;
}

void MEAPI MeAppFindClickDir(const MeApp *const app, int x, int y, MeVector3 normClickDir) {
    MeVector3 start, end;
    if (!meapp_check(app, "MeAppFindClickDir") || !isPlace(normClickDir, "MeAppFindClickDir"))
        return;
    rayAt(app, x, y, MEFALSE, start, end);
    direction(start, end, normClickDir);
}

/* The point of a pixel as far from the camera, along the line of sight, as another point. */
static void pointAsDeepAs(const MeApp *app, int x, int y, const MeVector3 other, MeVector3 p) {
    MeVector3 inCamera;
    RRenderUpdateProjectionMatrices(app->rc);
    MeMatrix4TMTransform(inCamera, (const MeVector4 *)app->rc->m_CameraMatrix, other);
    pointAtZ(app, x, y, inCamera[2], MEFALSE, p);
}

void MEAPI MeAppFindClickPos(const MeApp *const app, int x, int y, MeVector3 clickPos) {
    if (!meapp_check(app, "MeAppFindClickPos") || !isPlace(clickPos, "MeAppFindClickPos"))
        return;
    RRenderUpdateProjectionMatrices(app->rc);
    pointAtZ(app, x, y, -(MeReal)app->rc->m_CameraDist, MEFALSE, clickPos);
}

/* Model by model, and not by McdSpaceGetLineSegFirstIntersection: between steps the space is inside a change block, and
 * ending that here would hide its new pairs from the bridge. */
static MeBool firstHit(McdSpaceID space, MeVector3 start, MeVector3 end, McdLineSegIntersectResult *first) {
    McdSpaceModelIterator it;
    McdLineSegIntersectResult hit;
    McdModelID m;
    first->model = 0;
    McdSpaceModelIteratorBegin(space, &it);
    while (McdSpaceGetModel(space, &it, &m))
        if (McdLineSegIntersect(m, start, end, &hit) && (!first->model || hit.distance < first->distance)) {
            *first = hit;
            first->model = m;
        }
    return first->model != 0;
}

McdModelID MEAPI MeAppPickMcdModel(const MeApp *const app, int x, int y, MeVector3 normClickDir, MeVector3 pos,
                                   MeBool orth) {
    McdLineSegIntersectResult hit;
    MeVector3 start, end;
    if (!meapp_check(app, "MeAppPickMcdModel") || !isPlace(normClickDir, "MeAppPickMcdModel") ||
        !isPlace(pos, "MeAppPickMcdModel"))
        return 0;
    rayAt(app, x, y, orth, start, end);
    direction(start, end, normClickDir);
    if (!firstHit(app->space, start, end, &hit))
        return 0;
    MeVector3Copy(pos, hit.position);
    return hit.model;
}

/* ---- what is held ------------------------------------------------------------------------------------------------ */

static void grabbedPoint(const MeAppMousePickInfo *pick, MeVector3 p) {
    MeMatrix4TMTransform(p, (const MeVector4 *)MdtBodyGetTransformPtr(pick->body), pick->relative);
}

static void grab(MeApp *app, McdModelID model, const MeVector3 pos) {
    MeAppMousePickInfo *pick = &app->pick;
    MEASSERT(!pick->model && !pick->body && McdModelGetBody(model));
    pick->model = model;
    pick->body = McdModelGetBody(model);
    MeMatrix4TMInverseTransform(pick->relative, (const MeVector4 *)MdtBodyGetTransformPtr(pick->body), pos);
    MeVector3Copy(pick->target, pos);
    MdtBodyEnable(pick->body);
}

static void release(MeApp *app) {
    app->pick.model = 0;
    app->pick.body = 0;
    meapp_lineHide(app->pick.line);
}

static void press(MeApp *app) {
    MeVector3 dir, pos;
    release(app);
    const McdModelID model = MeAppPickMcdModel(app, app->pick.x, app->pick.y, dir, pos, isOrthographic(app->rc));
    if (model && McdModelGetBody(model)) {
        grab(app, model, pos);
        app->selected = model;
    } else if (app->controls) {
        RRenderLeaveMouse(app->rc);
    }
}

/* A model that was destroyed is no handle any more: it is looked for. */
McdModelID MEAPI MeAppGetSelected(const MeApp *app) {
    McdSpaceModelIterator it;
    McdModelID m;
    if (!meapp_check(app, "MeAppGetSelected") || !app->selected)
        return 0;
    McdSpaceModelIteratorBegin(app->space, &it);
    while (McdSpaceGetModel(app->space, &it, &m))
        if (m == app->selected)
            return m;
    return 0;
}

void MEAPI MeAppMousePickCB(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                            void *userdata) {
    MeApp *app = userdata;
    (void)rc, (void)modifiers;
    if (!meapp_check(app, "MeAppMousePickCB") || which != kRLeftButton)
        return;
    app->pick.x = x;
    app->pick.y = y;
    if (event == kRNewlyPressed)
        press(app);
    else if (event == kRNewlyReleased)
        release(app);
}

/* The program may have destroyed what is held, without our being told. */
static MeBool isStillThere(const MeApp *app) {
    const MeAppMousePickInfo *pick = &app->pick;
    MdtBodyID b = MdtBodyGetFirst(app->world);
    while (b && b != pick->body)
        b = MdtBodyGetNext(b);
    return b && McdModelIsValid(pick->model) && McdModelGetBody(pick->model) == b &&
           McdModelGetSpace(pick->model) == app->space;
}

/* ---- the spring -------------------------------------------------------------------------------------------------- */

/* One frame of 1/60 s is what the force is made for; shorter steps are damped a little more than critically. */
#define STEP      ((MeReal)(1. / 60))
#define FREQUENCY ((MeReal)15) /* rad/s */
#define SPIN_RATE ((MeReal)5)  /* 1/s, of rotation */

/* The inverse inertia tensor, in the frame of the centre of mass. */
static void inverseInertia(MdtBodyID b, MeMatrix3 inverse) {
    MdtBodyGetInertiaTensor(b, inverse);
    MeMatrix3SymmetricInvert(inverse);
}

/* A matrix of the centre of mass's frame times a vector of the world's. */
static void multiplyInWorld(MeVector3 out, MdtBodyID b, MeMatrix3 m, const MeVector3 v) {
    const MeVector4 *tm = (const MeVector4 *)MdtBodyGetCenterOfMassTransformPtr(b);
    MeVector3 local, product;
    MeMatrix4TMInverseRotate(local, tm, v);
    MeMatrix3MultiplyVector(product, (const MeVector3 *)m, local);
    MeMatrix4TMRotate(out, tm, product);
}

/* Row i: the acceleration that a force of 1 N along axis i has, of the point r from the centre of mass. */
static void mobility(MdtBodyID b, const MeVector3 r, MeMatrix3 A) {
    MeMatrix3 inverse;
    inverseInertia(b, inverse);
    for (int i = 0; i < 3; i++) {
        MeVector3 force = {0, 0, 0}, torque, spin;
        force[i] = 1;
        MeVector3Cross(torque, r, force);
        multiplyInWorld(spin, b, inverse, torque);
        MeVector3Cross(A[i], spin, r);
        A[i][i] += 1 / MdtBodyGetMass(b);
    }
}

/* f = -k (x + h v') - c v' with v' = v + h (A f + g), the velocity after the step: this never overshoots, wherever on
 * the body it pulls. So (1 + (h h k + h c) A) f = -k x - (h k + c) (v + h g). */
static void springForce(MdtBodyID b, const MeVector3 at, const MeVector3 stretch, MeVector3 force) {
    const MeReal m = MdtBodyGetMass(b), k = m * FREQUENCY * FREQUENCY, c = 2 * m * FREQUENCY;
    MeMatrix3 A;
    MeVector3 centre, r, v, g, momentum, point;
    MdtWorldGetGravity(MdtBodyGetWorld(b), g);
    MdtBodyGetCenterOfMassPosition(b, centre);
    MeVector3Subtract(r, at, centre);
    MeVector3Copy(point, at);
    MdtBodyGetVelocityAtPoint(b, point, v);
    for (int i = 0; i < 3; i++)
        momentum[i] = -k * stretch[i] - (STEP * k + c) * (v[i] + STEP * g[i]);
    mobility(b, r, A);
    MeMatrix3Scale(A, STEP * STEP * k + STEP * c);
    for (int i = 0; i < 3; i++)
        A[i][i] += 1;
    MeMatrix3Invert(A); /* positive definite */
    MeMatrix3MultiplyVector(force, (const MeVector3 *)A, momentum);
}

static void slowRotation(MdtBodyID b) {
    MeMatrix3 inertia;
    MeVector3 w, t;
    MdtBodyGetInertiaTensor(b, inertia);
    MdtBodyGetAngularVelocity(b, w);
    multiplyInWorld(t, b, inertia, w);
    MdtBodyAddTorque(b, -SPIN_RATE * t[0], -SPIN_RATE * t[1], -SPIN_RATE * t[2]);
}

/* From steel to red: how much of the greatest length the spring has. */
static void colorLine(const MeApp *app, MeReal part) {
    const float t = part < 1 ? (float)part : 1;
    const AcmeReal color[4] = {.15f + .75f * t, .17f * (1 - t) + .1f * t, .20f * (1 - t) + .1f * t, 1};
    RNLineSetColor(app->pick.line, color);
}

static void pull(MeApp *app, const MeVector3 at) {
    const MdtBodyID b = app->pick.body;
    const MeReal longest = 4 * app->lengthScale;
    MeVector3 stretch, f;
    MeVector3Subtract(stretch, at, app->pick.target);
    const MeReal length = MeVector3Magnitude(stretch);
    if (length > longest)
        MeVector3Scale(stretch, longest / length);
    springForce(b, at, stretch, f);
    MdtBodyAddForceAtPosition(b, f[0], f[1], f[2], at[0], at[1], at[2]);
    app->pick.force = MeVector3Magnitude(f);
    colorLine(app, length / longest);
    slowRotation(b);
}

void MEAPI MeAppUpdateMouseSpring(MeApp *app) {
    MeVector3 at, target;
    if (!meapp_check(app, "MeAppUpdateMouseSpring") || !app->pick.model)
        return;
    if (!isStillThere(app)) {
        release(app);
        return;
    }
    pointAsDeepAs(app, app->pick.x, app->pick.y, app->pick.target, target);
    MeVector3Copy(app->pick.target, target);
    grabbedPoint(&app->pick, at);
    MEASSERT(MeRealIsValid(MeVector3MagnitudeSqr(at)) && MeRealIsValid(MeVector3MagnitudeSqr(target)));
    MdtBodyEnable(app->pick.body);
    pull(app, at);
    meapp_lineShow(app->rc, app->pick.line, at, target);
}
