/* The camera: a look-at point, a distance and two angles about the up axis; or a matrix of the program's own. */
#include "r_i.h"

#include <string.h>

static const AcmeReal pi = 3.14159265f;
static const AcmeReal nearest = 0.01f;

void r_toUpright(const RRender *rc, const AcmeReal world[3], AcmeReal upright[3]) {
    AcmeReal(*m)[3] = rc->m_pViewer->camera.upright;
    for (int i = 0; i < 3; i++)
        upright[i] = m[i][0] * world[0] + m[i][1] * world[1] + m[i][2] * world[2];
}

void r_fromUpright(const RRender *rc, const AcmeReal upright[3], AcmeReal world[3]) {
    AcmeReal(*m)[3] = rc->m_pViewer->camera.upright;
    for (int i = 0; i < 3; i++)
        world[i] = m[0][i] * upright[0] + m[1][i] * upright[1] + m[2][i] * upright[2];
}

/* The shortest turn that takes the unit vector a to y; for an a below the xz plane, the shortest that takes -a to y and
 * half a turn about x after it, so that no denominator comes near 0. */
static void setUpright(RCamera *c, const AcmeReal a[3]) {
    const AcmeReal side = a[1] < 0 ? -1.f : 1.f, x = side * a[0], y = side * a[1], z = side * a[2];
    const AcmeReal mixed = -x * z / (1 + y);
    const AcmeReal rows[3][3] = {
        {1 - x * x / (1 + y), -x, mixed}, {a[0], a[1], a[2]}, {side * mixed, -side * z, side * (1 - z * z / (1 + y))}};
    memcpy(c->upright, rows, sizeof rows);
}

/* The camera's axes: right, up, and back (towards the viewer). They stay orthonormal at the poles. */
static void axes(const RRender *rc, AcmeReal right[3], AcmeReal up[3], AcmeReal back[3]) {
    if (rc->m_pViewer->camera.ownMatrix) {
        for (int i = 0; i < 3; i++) {
            right[i] = (AcmeReal)rc->m_CameraMatrix[i][0];
            up[i] = (AcmeReal)rc->m_CameraMatrix[i][1];
            back[i] = (AcmeReal)rc->m_CameraMatrix[i][2];
        }
        return;
    }
    const AcmeReal st = sinf(rc->m_CameraAngle), ct = cosf(rc->m_CameraAngle);
    const AcmeReal sp = sinf(rc->m_CameraElevation), cp = cosf(rc->m_CameraElevation);
    const AcmeReal r[3] = {ct, 0, -st}, u[3] = {-sp * st, cp, -sp * ct}, b[3] = {cp * st, sp, cp * ct};
    r_fromUpright(rc, r, right);
    r_fromUpright(rc, u, up);
    r_fromUpright(rc, b, back);
}

static AcmeReal clamp(AcmeReal x, AcmeReal lo, AcmeReal hi) {
    return x < lo ? lo : x > hi ? hi : x;
}

/* Position and matrix from look-at point, distance and angles. */
static void update(RRender *rc) {
    AcmeReal right[3], up[3], back[3];
    rc->m_pViewer->camera.ownMatrix = false;
    rc->m_pViewer->camera.isSet = true;
    rc->m_CameraDist = rc->m_CameraDist >= nearest ? rc->m_CameraDist : nearest;
    rc->m_CameraAngle = remainderf(rc->m_CameraAngle, 2 * pi);
    rc->m_CameraElevation = clamp(rc->m_CameraElevation, -pi / 2, pi / 2);
    axes(rc, right, up, back);
    memset(rc->m_CameraMatrix, 0, sizeof rc->m_CameraMatrix);
    rc->m_CameraMatrix[3][3] = 1;
    for (int i = 0; i < 3; i++) {
        rc->m_CameraPos[i] = rc->m_CameraLookAt[i] + rc->m_CameraDist * back[i];
        rc->m_CameraMatrix[i][0] = right[i];
        rc->m_CameraMatrix[i][1] = up[i];
        rc->m_CameraMatrix[i][2] = back[i];
    }
    for (int j = 0; j < 3; j++) {
        MeReal sum = 0;
        for (int i = 0; i < 3; i++)
            sum -= (MeReal)rc->m_CameraPos[i] * rc->m_CameraMatrix[i][j];
        rc->m_CameraMatrix[3][j] = sum;
    }
}

/* Members that the program wrote may be anything; what is drawn with may not. */
static bool membersAreFinite(const RRender *rc, const char *function) {
    return r_isFinite(rc->m_CameraLookAt, 3, function, "m_CameraLookAt") &&
           r_isNumber(rc->m_CameraDist, function, "m_CameraDist") &&
           r_isNumber(rc->m_CameraAngle, function, "m_CameraAngle") &&
           r_isNumber(rc->m_CameraElevation, function, "m_CameraElevation");
}

void MEAPI RCameraUpdate(RRender *rc) {
    if (r_isContext(rc, __func__) && membersAreFinite(rc, __func__))
        update(rc);
}

void r_cameraInit(RRender *rc) {
    static const AcmeReal y[3] = {0, 1, 0};
    setUpright(&rc->m_pViewer->camera, y);
    rc->m_CameraLookAt[2] = 1; /* As in 1.2: programs zoom and turn relative to this view. */
    rc->m_CameraDist = 15;
    rc->m_CameraFov = 0.7f;
    update(rc);
    rc->m_pViewer->camera.isSet = false;
}

void r_cameraApplyOption(RRender *rc) {
    if (rc->m_Options.m_bCamera)
        RCameraSetView(rc, rc->m_Options.m_Camera[0], rc->m_Options.m_Camera[1], rc->m_Options.m_Camera[2]);
}

bool r_cameraAddToBox(const RRender *rc, RGraphic *rg, AcmeReal box[2][3]) {
    const bool isGround = rg->m_pPart->kind == rGround;
    float m[16];
    if ((rg->m_pPart->kind != rMesh && !isGround) || !r_graphicTransform(rg, m))
        return false;
    for (int i = 0; i < rg->m_pObject->m_nNumVertices && i < rg->m_nMaxNumVertices; i++) {
        const RObjectVertex *v = &rg->m_pVertices[i];
        AcmeReal p[3], world[3];
        for (int k = 0; k < 3; k++)
            world[k] = v->m_X * m[k] + v->m_Y * m[4 + k] + v->m_Z * m[8 + k] + m[12 + k];
        memcpy(p, world, sizeof p);
        if (!isGround) /* The ground's own frame is upright already. */
            r_toUpright(rc, world, p);
        for (int k = isGround; k < (isGround ? 2 : 3); k++) {
            box[0][k] = fminf(box[0][k], p[k]); /* not NaN, if p is */
            box[1][k] = fmaxf(box[1][k], p[k]);
        }
    }
    return !isGround && rg->m_pObject->m_nNumVertices > 0;
}

void r_cameraSeeScene(RRender *rc) {
    const RCamera *c = &rc->m_pViewer->camera;
    AcmeReal box[2][3] = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}, middle[3], radius = 0;
    bool hasModel = false;
    if (c->isSet || c->orthographic || c->ownMatrix)
        return;
    for (RGraphic *rg = rc->m_p3DGraphics; rg; rg = rg->m_pNext)
        hasModel |= r_cameraAddToBox(rc, rg, box);
    for (int k = 0; k < 3; k++) {
        middle[k] = (box[0][k] + box[1][k]) / 2;
        radius = hypotf(radius, box[1][k] - middle[k]);
    }
    if (!hasModel || !isfinite(radius))
        return;
    r_fromUpright(rc, middle, rc->m_CameraLookAt);
    rc->m_CameraDist = fmaxf(rc->m_CameraDist, radius / sinf(rc->m_CameraFov / 2));
    rc->m_CameraElevation = 0.2f;
    update(rc);
}

void r_cameraKeepHome(RRender *rc) {
    RCamera *c = &rc->m_pViewer->camera;
    memcpy(c->home, rc->m_CameraLookAt, sizeof rc->m_CameraLookAt);
    c->home[3] = rc->m_CameraDist;
    c->home[4] = rc->m_CameraAngle;
    c->home[5] = rc->m_CameraElevation;
    c->hasHome = true;
}

void r_cameraHome(RRender *rc) {
    const RCamera *c = &rc->m_pViewer->camera;
    if (!c->hasHome)
        return;
    memcpy(rc->m_CameraLookAt, c->home, sizeof rc->m_CameraLookAt);
    rc->m_CameraDist = c->home[3];
    rc->m_CameraAngle = c->home[4];
    rc->m_CameraElevation = c->home[5];
    update(rc);
}

void MEAPI RCameraSetUp(RRender *rc, AcmeReal x, AcmeReal y, AcmeReal z) {
    AcmeReal up[3] = {x, y, z}, lights[3][3];
    if (!r_isContext(rc, __func__) || !r_isFinite(up, 3, __func__, "the axis"))
        return;
    const AcmeReal max = fmaxf(fmaxf(fabsf(x), fabsf(y)), fabsf(z)); /* Squares would over- or underflow. */
    if (max == 0) {
        MeWarning(1, "%s: the axis is 0: it must have a length", __func__);
        return;
    }
    const AcmeReal length = hypotf(hypotf(x / max, y / max), z / max);
    for (int i = 0; i < 3; i++)
        up[i] = up[i] / max / length;
    r_lightsToUpright(rc, lights);
    setUpright(&rc->m_pViewer->camera, up);
    r_lightsFromUpright(rc, lights);
    const bool isSet = rc->m_pViewer->camera.isSet;
    update(rc);
    rc->m_pViewer->camera.isSet = isSet;
}

void MEAPI RCameraGetUpAxis(RRender *rc, AcmeVector3 axis) {
    if (r_isContext(rc, __func__) && r_isPointer(axis, __func__, "axis"))
        memcpy(axis, rc->m_pViewer->camera.upright[1], 3 * sizeof *axis);
}

/* The angles of a direction; theta stays as it is for one along the up axis, phi for one without length. */
static void anglesOf(const RRender *rc, const AcmeReal direction[3], AcmeReal *theta, AcmeReal *phi) {
    AcmeReal d[3];
    r_toUpright(rc, direction, d);
    const AcmeReal level = hypotf(d[0], d[2]);
    if (level > 0)
        *theta = atan2f(d[0], d[2]);
    if (level > 0 || d[1] != 0)
        *phi = atan2f(d[1], level);
}

void MEAPI RCameraFindAngles(RRender *rc, const AcmeVector3 direction, AcmeReal *theta, AcmeReal *phi) {
    if (r_isContext(rc, __func__) && r_isFinite(direction, 3, __func__, "direction") &&
        r_isPointer(theta, __func__, "theta") && r_isPointer(phi, __func__, "phi"))
        anglesOf(rc, direction, theta, phi);
}

void MEAPI RCameraSetLookAt(RRender *rc, const AcmeVector3 lookAt) {
    if (!r_isContext(rc, __func__) || !r_isFinite(lookAt, 3, __func__, "lookAt"))
        return;
    memcpy(rc->m_CameraLookAt, lookAt, sizeof rc->m_CameraLookAt);
    update(rc);
}

void MEAPI RCameraGetLookAt(RRender *rc, AcmeVector3 camlookat) {
    if (r_isContext(rc, __func__) && r_isPointer(camlookat, __func__, "camlookat"))
        memcpy(camlookat, rc->m_CameraLookAt, sizeof rc->m_CameraLookAt);
}

void MEAPI RCameraSetView(RRender *rc, AcmeReal dist, AcmeReal angle, AcmeReal elevation) {
    if (!r_isContext(rc, __func__) || !r_isNumber(dist, __func__, "dist") || !r_isNumber(angle, __func__, "angle") ||
        !r_isNumber(elevation, __func__, "elevation"))
        return;
    rc->m_CameraDist = dist;
    rc->m_CameraAngle = angle;
    rc->m_CameraElevation = elevation;
    update(rc);
}

void MEAPI RCameraSetLookAtAndPosition(RRender *rc, const MeVector3 lookAt, const MeVector3 position) {
    if (!r_isContext(rc, __func__) || !r_isPointer(lookAt, __func__, "lookAt") ||
        !r_isPointer(position, __func__, "position"))
        return;
    AcmeReal d[3], at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = (AcmeReal)lookAt[i];
        d[i] = (AcmeReal)(position[i] - lookAt[i]);
    }
    if (!r_isFinite(at, 3, __func__, "lookAt") || !r_isFinite(d, 3, __func__, "position"))
        return;
    memcpy(rc->m_CameraLookAt, at, sizeof at);
    rc->m_CameraDist = hypotf(hypotf(d[0], d[2]), d[1]);
    anglesOf(rc, d, &rc->m_CameraAngle, &rc->m_CameraElevation);
    update(rc);
}

void MEAPI RCameraGetPosition(RRender *rc, AcmeVector3 pos) {
    if (r_isContext(rc, __func__) && r_isPointer(pos, __func__, "pos"))
        memcpy(pos, rc->m_CameraPos, sizeof rc->m_CameraPos);
}

void MEAPI RCameraGetLookDir(RRender *rc, AcmeVector3 dir) {
    if (!r_isContext(rc, __func__) || !r_isPointer(dir, __func__, "dir"))
        return;
    AcmeReal right[3], up[3], back[3];
    axes(rc, right, up, back);
    for (int i = 0; i < 3; i++)
        dir[i] = -back[i];
}

void MEAPI RCameraGetUp(RRender *rc, AcmeVector3 up) {
    AcmeReal right[3], back[3];
    if (r_isContext(rc, __func__) && r_isPointer(up, __func__, "up"))
        axes(rc, right, up, back);
}

AcmeReal MEAPI RCameraGetDistance(RRender *rc) {
    return r_isContext(rc, __func__) ? rc->m_CameraDist : 0;
}

AcmeReal MEAPI RCameraGetRotation(RRender *rc) {
    return r_isContext(rc, __func__) ? rc->m_CameraAngle : 0;
}

AcmeReal MEAPI RCameraGetElevation(RRender *rc) {
    return r_isContext(rc, __func__) ? rc->m_CameraElevation : 0;
}

/* Changes one of the polar coordinates. */
static void set(RRender *rc, const char *function, const char *argument, AcmeReal *member, AcmeReal value) {
    if (!r_isNumber(value, function, argument))
        return;
    *member = value;
    update(rc);
}

void MEAPI RCameraSetRotation(RRender *rc, const MeReal rotation) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "rotation", &rc->m_CameraAngle, (AcmeReal)rotation);
}

void MEAPI RCameraSetElevation(RRender *rc, const MeReal elevation) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "elevation", &rc->m_CameraElevation, (AcmeReal)elevation);
}

void MEAPI RCameraSetOffset(RRender *rc, const MeReal offset) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "offset", &rc->m_CameraDist, (AcmeReal)offset);
}

void MEAPI RCameraZoom(RRender *rc, AcmeReal dist) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "dist", &rc->m_CameraDist, rc->m_CameraDist + dist);
}

void MEAPI RCameraRotateAngle(RRender *rc, AcmeReal d_theta) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "d_theta", &rc->m_CameraAngle, rc->m_CameraAngle + d_theta);
}

void MEAPI RCameraRotateElevation(RRender *rc, AcmeReal d_phi) {
    if (r_isContext(rc, __func__))
        set(rc, __func__, "d_phi", &rc->m_CameraElevation, rc->m_CameraElevation + d_phi);
}

/* Moves the look-at point along the camera's axes. */
static void pan(RRender *rc, AcmeReal x, AcmeReal y, AcmeReal z) {
    AcmeReal right[3], up[3], back[3];
    rc->m_pViewer->camera.ownMatrix = false;
    rc->m_pViewer->camera.isSet = true;
    axes(rc, right, up, back);
    for (int i = 0; i < 3; i++)
        rc->m_CameraLookAt[i] += x * right[i] + y * up[i] + z * back[i];
    update(rc);
}

void MEAPI RCameraPanX(RRender *rc, AcmeReal dist) {
    if (r_isContext(rc, __func__) && r_isNumber(dist, __func__, "dist"))
        pan(rc, dist, 0, 0);
}

void MEAPI RCameraPanY(RRender *rc, AcmeReal dist) {
    if (r_isContext(rc, __func__) && r_isNumber(dist, __func__, "dist"))
        pan(rc, 0, dist, 0);
}

void MEAPI RCameraPanZ(RRender *rc, AcmeReal dist) {
    if (r_isContext(rc, __func__) && r_isNumber(dist, __func__, "dist"))
        pan(rc, 0, 0, dist);
}

void MEAPI RCameraSetFov(RRender *rc, AcmeReal fov) {
    if (!r_isContext(rc, __func__))
        return;
    if (!(fov > 0 && fov < pi)) {
        MeWarning(1, "%s: fov is %g: it must be between 0 and pi radians", __func__, (double)fov);
        return;
    }
    rc->m_CameraFov = fov;
    rc->m_pViewer->camera.orthographic = false;
}

static bool orthographic(RRender *rc, const char *function, AcmeReal zoomFactor, AcmeReal viewDepth) {
    if (!r_isContext(rc, function) || !r_isSize(zoomFactor, function, "zoomFactor") ||
        !r_isSize(viewDepth, function, "viewDepth"))
        return false;
    rc->m_pViewer->camera.orthographic = true;
    rc->m_pViewer->camera.orthoHeight = zoomFactor;
    rc->m_pViewer->camera.orthoDepth = viewDepth;
    return true;
}

void MEAPI RCameraSetOrthographicView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    orthographic(rc, __func__, zoomFactor, viewDepth);
}

static void sideView(RRender *rc, const char *function, AcmeReal zoomFactor, AcmeReal viewDepth, AcmeReal theta,
                     AcmeReal phi) {
    if (orthographic(rc, function, zoomFactor, viewDepth))
        RCameraSetView(rc, rc->m_CameraDist, theta, phi);
}

void MEAPI RCameraSetFrontView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, 0, 0);
}

void MEAPI RCameraSetBackView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, pi, 0);
}

void MEAPI RCameraSetLeftView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, -pi / 2, 0);
}

void MEAPI RCameraSetRightView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, pi / 2, 0);
}

void MEAPI RCameraSetTopView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, 0, pi / 2);
}

void MEAPI RCameraSetBottomView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth) {
    sideView(rc, __func__, zoomFactor, viewDepth, 0, -pi / 2);
}

void MEAPI RCameraSetMatrix(RRender *rc, MeMatrix4Ptr m) {
    float check[16];
    if (!r_isContext(rc, __func__) || !r_isPointer(m, __func__, "m"))
        return;
    if (!r_matrixFloats((const MeVector4 *)m, check)) {
        MeWarning(1, "%s: m is not finite", __func__);
        return;
    }
    memcpy(rc->m_CameraMatrix, m, sizeof rc->m_CameraMatrix);
    rc->m_pViewer->camera.ownMatrix = true;
    /* The eye is where the matrix takes nothing: -R^T t. */
    for (int i = 0; i < 3; i++) {
        MeReal sum = 0;
        for (int j = 0; j < 3; j++)
            sum -= m[i][j] * m[3][j];
        rc->m_CameraPos[i] = (AcmeReal)sum;
    }
}

static void orthographicMatrix(RRender *rc, MeReal aspect, MeMatrix4Ptr m) {
    const RCamera *c = &rc->m_pViewer->camera;
    const MeReal nearZ = (MeReal)(rc->m_CameraDist - c->orthoDepth), farZ = (MeReal)(rc->m_CameraDist + c->orthoDepth);
    m[0][0] = 2 / ((MeReal)c->orthoHeight * aspect);
    m[1][1] = 2 / (MeReal)c->orthoHeight;
    m[2][2] = -2 / (farZ - nearZ);
    m[3][2] = -(farZ + nearZ) / (farZ - nearZ);
    m[3][3] = 1;
}

static void perspectiveMatrix(RRender *rc, MeReal aspect, MeMatrix4Ptr m) {
    const MeReal farZ = (MeReal)fmaxf(FARZ, rc->m_pViewer->camera.farthest);
    /* Close up, the near plane comes closer; and no closer than 24 bits of depth can bear. */
    MeReal nearZ = (MeReal)fminf(NEARZ, 0.05f * rc->m_CameraDist);
    if (nearZ < farZ * (MeReal)1e-5)
        nearZ = farZ * (MeReal)1e-5;
    const MeReal f = 1 / MeTan((MeReal)rc->m_CameraFov / 2);
    m[0][0] = f / aspect;
    m[1][1] = f;
    m[2][2] = (farZ + nearZ) / (nearZ - farZ);
    m[2][3] = -1;
    m[3][2] = 2 * farZ * nearZ / (nearZ - farZ);
}

void MEAPI RRenderUpdateProjectionMatrices(RRender *rc) {
    if (!r_isContext(rc, __func__))
        return;
    const struct RViewer *v = rc->m_pViewer;
    const MeReal aspect = (MeReal)r_sceneWidth(rc) / (MeReal)v->height;
    memset(rc->m_ProjectionMatrix, 0, sizeof rc->m_ProjectionMatrix);
    if (v->camera.orthographic)
        orthographicMatrix(rc, aspect, rc->m_ProjectionMatrix);
    else
        perspectiveMatrix(rc, aspect, rc->m_ProjectionMatrix);
}

void MEAPI RCalculatePortalCoordinates(RRender *rc, AcmeReal width, AcmeReal height, int x, int y, AcmeReal *portalx,
                                       AcmeReal *portaly) {
    if (!r_isContext(rc, __func__) || !r_isSize(width, __func__, "width") || !r_isSize(height, __func__, "height") ||
        !r_isPointer(portalx, __func__, "portalx") || !r_isPointer(portaly, __func__, "portaly"))
        return;
    *portalx = width * ((AcmeReal)x / (AcmeReal)r_sceneWidth(rc) - 0.5f);
    *portaly = height * (0.5f - (AcmeReal)y / (AcmeReal)rc->m_pViewer->height);
}
