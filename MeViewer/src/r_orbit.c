/* The camera in the user's hand: it turns, shifts and comes nearer, and stays above the ground. */
#include "r_i.h"

/* ---- The ground ---- */

static AcmeReal heightOf(const RRender *rc, const AcmeReal place[3]) {
    AcmeReal upright[3];
    r_toUpright(rc, place, upright);
    return upright[1];
}

/* The highest ground that is not above both eye and look-at point; without one, the lowest point of all graphics.
 * -INFINITY if there are none. */
static AcmeReal groundHeight(const RRender *rc) {
    const AcmeReal highest = fmaxf(heightOf(rc, rc->m_CameraLookAt), heightOf(rc, rc->m_CameraPos));
    AcmeReal ground = -INFINITY, lowest = INFINITY;
    for (RGraphic *rg = rc->m_p3DGraphics; rg; rg = rg->m_pNext) {
        AcmeReal box[2][3] = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        const bool isModel = r_cameraAddToBox(rc, rg, box);
        if (isModel)
            lowest = fminf(lowest, box[0][1]);
        else if (box[1][1] <= highest)
            ground = fmaxf(ground, box[1][1]);
    }
    return ground > -INFINITY || lowest == INFINITY ? ground : lowest;
}

/* How low a motion may bring the eye: to a little above the ground, or no lower than it was. -INFINITY: anywhere. */
static AcmeReal lowestEye(const RRender *rc) {
    if (rc->m_pViewer->camera.goesBelow)
        return -INFINITY;
    return fminf(groundHeight(rc) + 0.02f * rc->m_CameraDist, heightOf(rc, rc->m_CameraPos));
}

static AcmeReal liftNeeded(const RRender *rc, AcmeReal lowest) {
    return fmaxf(lowest - heightOf(rc, rc->m_CameraPos), 0);
}

static void lift(RRender *rc, AcmeReal by) {
    const AcmeReal *up = rc->m_pViewer->camera.upright[1];
    AcmeReal at[3];
    for (int i = 0; i < 3; i++)
        at[i] = rc->m_CameraLookAt[i] + by * up[i];
    RCameraSetLookAt(rc, at);
}

/* ---- Motions ---- */

void r_cameraOrbit(RRender *rc, AcmeReal theta, AcmeReal phi) {
    const AcmeReal lowest = lowestEye(rc);
    RCameraRotateAngle(rc, theta);
    RCameraRotateElevation(rc, phi);
    const AcmeReal needed = liftNeeded(rc, lowest);
    if (needed > 0)
        RCameraSetElevation(rc, (MeReal)asinf(fminf(sinf(rc->m_CameraElevation) + needed / rc->m_CameraDist, 1)));
}

/* Height of what is seen at the look-at point's distance. */
static AcmeReal visibleHeight(const RRender *rc) {
    const RCamera *c = &rc->m_pViewer->camera;
    return c->orthographic ? c->orthoHeight : 2 * rc->m_CameraDist * tanf(rc->m_CameraFov / 2);
}

static void pan(RRender *rc, AcmeReal right, AcmeReal up) {
    const AcmeReal perPixel = visibleHeight(rc) / (AcmeReal)rc->m_pViewer->height;
    RCameraPanX(rc, right * perPixel);
    RCameraPanY(rc, up * perPixel);
}

static void dolly(RRender *rc, AcmeReal factor) {
    if (rc->m_pViewer->camera.orthographic)
        rc->m_pViewer->camera.orthoHeight *= factor;
    else
        RCameraSetOffset(rc, (MeReal)(rc->m_CameraDist * factor));
}

void r_cameraPan(RRender *rc, AcmeReal right, AcmeReal up) {
    const AcmeReal lowest = lowestEye(rc);
    pan(rc, right, up);
    lift(rc, liftNeeded(rc, lowest));
}

void r_cameraDolly(RRender *rc, AcmeReal factor) {
    const AcmeReal lowest = lowestEye(rc);
    dolly(rc, factor);
    lift(rc, liftNeeded(rc, lowest));
}

/* The point under the pointer, in the plane through the look-at point that faces the camera, stays under it. */
void r_cameraDollyAt(RRender *rc, AcmeReal factor, int x, int y) {
    const AcmeReal lowest = lowestEye(rc);
    const AcmeReal right = (AcmeReal)x - (AcmeReal)r_sceneWidth(rc) / 2;
    const AcmeReal up = (AcmeReal)rc->m_pViewer->height / 2 - (AcmeReal)y;
    pan(rc, (1 - factor) * right, (1 - factor) * up);
    dolly(rc, factor);
    lift(rc, liftNeeded(rc, lowest));
}
