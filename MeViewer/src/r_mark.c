/* Marks: places of the world to pixels, and what is drawn there over the picture. */
#include "r_i.h"
#include "RMark.h"

#include <string.h>

void MEAPI RRenderSetMarkCallBack(RRender *rc, RMarkCallBack func, void *userdata) {
    if (!r_isContext(rc, __func__))
        return;
    rc->m_pViewer->markFunc = func;
    rc->m_pViewer->markData = userdata;
}

void r_marksDraw(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!v->markFunc)
        return;
    v->marking = true;
    v->markFunc(rc, v->markData);
    v->marking = false;
}

/* In the camera's frame: x right, y up, z towards the viewer. */
static bool toCamera(const RRender *rc, const MeVector3 p, float out[3]) {
    for (int j = 0; j < 3; j++) {
        MeReal sum = rc->m_CameraMatrix[3][j];
        for (int i = 0; i < 3; i++)
            sum += p[i] * rc->m_CameraMatrix[i][j];
        out[j] = (float)sum;
    }
    return isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]);
}

/* Up to where the camera sees: a little in front of its eye. */
static float nearest(const RRender *rc) {
    return rc->m_pViewer->camera.orthographic ? INFINITY : -0.01f * rc->m_CameraDist;
}

static void toPixel(const RRender *rc, const float c[3], float pixel[2]) {
    const MeVector4 *P = (const MeVector4 *)rc->m_ProjectionMatrix;
    const float w = c[2] * (float)P[2][3] + (float)P[3][3];
    pixel[0] = (0.5f + 0.5f * c[0] * (float)P[0][0] / w) * (float)r_sceneWidth(rc);
    pixel[1] = (0.5f - 0.5f * c[1] * (float)P[1][1] / w) * (float)rc->m_pViewer->height;
}

static bool canMark(const RRender *rc, const char *function, const void *place, const float color[4]) {
    if (!r_isContext(rc, function) || !r_isPointer(place, function, "a place") ||
        !r_isFinite(color, 4, function, "color"))
        return false;
    if (!rc->m_pViewer->marking)
        MeWarning(1, "%s: it may only be called by the function of RRenderSetMarkCallBack", function);
    return rc->m_pViewer->marking;
}

/* Moves an end that is too near along the line. */
static void clip(float near, float c[3], const float other[3]) {
    const float t = (near - other[2]) / (c[2] - other[2]);
    for (int i = 0; i < 3; i++)
        c[i] = other[i] + t * (c[i] - other[i]);
}

void MEAPI RMarkLine(RRender *rc, const MeVector3 a, const MeVector3 b, const float color[4], AcmeReal width) {
    float from[3], to[3], start[2], end[2];
    if (!canMark(rc, __func__, a, color) || !r_isPointer(b, __func__, "b") || !r_isSize(width, __func__, "width") ||
        !toCamera(rc, a, from) || !toCamera(rc, b, to))
        return;
    const float near = nearest(rc);
    if (from[2] > near && to[2] > near)
        return;
    if (from[2] > near)
        clip(near, from, to);
    else if (to[2] > near)
        clip(near, to, from);
    toPixel(rc, from, start);
    toPixel(rc, to, end);
    r_uiLine(start, end, color, width * r_uiScale(rc));
}

/* The pixel of a place that the camera sees. */
static bool seenAt(const RRender *rc, const MeVector3 p, float pixel[2]) {
    float c[3];
    if (!toCamera(rc, p, c) || c[2] > nearest(rc))
        return false;
    toPixel(rc, c, pixel);
    return true;
}

void MEAPI RMarkPoint(RRender *rc, const MeVector3 p, const float color[4], AcmeReal width) {
    float pixel[2];
    if (!canMark(rc, __func__, p, color) || !r_isSize(width, __func__, "width") || !seenAt(rc, p, pixel))
        return;
    const float size = width * r_uiScale(rc);
    r_uiBox(pixel[0] - size / 2, pixel[1] - size / 2, size, size, size / 2, color);
}

void MEAPI RMarkTriangle(RRender *rc, const MeVector3 a, const MeVector3 b, const MeVector3 c, const float color[4]) {
    const MeReal *const places[3] = {a, b, c};
    RCorner corners[3] = {{0}};
    for (int i = 0; i < 3; i++) {
        float pixel[2];
        if (!canMark(rc, __func__, places[i], color) || !seenAt(rc, places[i], pixel))
            return;
        corners[i].x = pixel[0];
        corners[i].y = pixel[1];
    }
    r_uiTriangle(corners, -1, color);
}

void MEAPI RMarkText(RRender *rc, const MeVector3 p, const char *text, const float color[4]) {
    float pixel[2];
    if (!canMark(rc, __func__, p, color) || !r_isPointer(text, __func__, "text") || !seenAt(rc, p, pixel))
        return;
    const float size = 11.5f * r_uiScale(rc);
    r_uiText(roundf(pixel[0] + 0.4f * size), roundf(pixel[1] - 0.3f * size), size, 0, rTextOutlined, color, text);
}
