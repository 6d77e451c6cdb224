/* The numbers that all shaders share in a frame: camera, lights, background. All is in the upright frame. */
#include "r_draw_i.h"

#include <string.h>

float r_toLinear(float screen) {
    return screen <= 0.04045f ? screen / 12.92f : powf((screen + 0.055f) / 1.055f, 2.4f);
}

static void multiply(const MeMatrix4 a, const MeMatrix4 b, float out[16]) {
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            MeReal sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[i][k] * b[k][j];
            out[4 * i + j] = (float)sum;
        }
    }
}

static void set3(float to[4], const float from[3], float factor) {
    for (int k = 0; k < 3; k++)
        to[k] = from[k] * factor;
}

/* RRender::m_CameraMatrix for what is in the upright frame. */
static void uprightToCamera(const RRender *rc, MeMatrix4 out) {
    memcpy(out, rc->m_CameraMatrix, sizeof(MeMatrix4));
    for (int i = 0; i < 3; i++) {
        const AcmeReal *axis = rc->m_pViewer->camera.upright[i];
        for (int j = 0; j < 3; j++)
            out[i][j] = (MeReal)axis[0] * rc->m_CameraMatrix[0][j] + (MeReal)axis[1] * rc->m_CameraMatrix[1][j] +
                        (MeReal)axis[2] * rc->m_CameraMatrix[2][j];
    }
}

static void fillCamera(const RRender *rc, RFrameBlock *b) {
    const RCamera *c = &rc->m_pViewer->camera;
    const float width = (float)r_sceneWidth(rc), height = (float)rc->m_pViewer->height;
    const float slope = c->orthographic ? 0 : tanf(rc->m_CameraFov / 2);
    MeMatrix4 camera;
    uprightToCamera(rc, camera);
    multiply((const MeVector4 *)camera, rc->m_ProjectionMatrix, b->viewProjection);
    r_toUpright(rc, rc->m_CameraPos, b->eye);
    for (int k = 0; k < 3; k++) {
        b->right[k] = (float)camera[k][0] * slope * width / height;
        b->up[k] = (float)camera[k][1] * slope;
        b->back[k] = (float)camera[k][2];
    }
    b->eye[3] = c->orthographic ? 0 : 1;
    b->viewport[0] = width;
    b->viewport[1] = height;
    b->viewport[2] = 1.7f * fmaxf(r_uiScale(rc), 1);
    b->viewport[3] = (float)rc->m_pViewer->width;
}

/* The direction to the light, of length 1; straight up for a direction without length. */
static void toLight(const RRender *rc, const RDirectLight *light, float out[4]) {
    float d[3];
    r_toUpright(rc, light->m_Direction, d);
    const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const float up[3] = {0, 1, 0};
    set3(out, length > 0 && isfinite(length) ? d : up, length > 0 && isfinite(length) ? -1 / length : 1);
}

static void fillLights(const RRender *rc, RFrameBlock *b) {
    const RLights *l = &rc->m_pViewer->lights;
    const float ambient = rc->m_bUseAmbientLight ? 1 : 0, key = l->key.m_bUseLight ? 1 : 0,
                fill = l->fill.m_bUseLight ? 1 : 0, point = l->point.m_bUseLight ? 1 : 0;
    /* The sky is bluish, and what the ground sends back is warm and weaker. */
    static const float skyTint[3] = {0.97f, 1.0f, 1.05f}, bounceTint[3] = {0.46f, 0.43f, 0.40f};
    for (int k = 0; k < 3; k++) {
        const float all = ambient * rc->m_rgbAmbientLightColor[k] + key * l->key.m_rgbAmbient[k] +
                          fill * l->fill.m_rgbAmbient[k] + point * l->point.m_rgbAmbient[k];
        b->sky[k] = all * skyTint[k];
        b->bounce[k] = all * bounceTint[k];
    }
    toLight(rc, &l->key, b->keyDirection);
    toLight(rc, &l->fill, b->fillDirection);
    set3(b->keyColor, l->key.m_rgbDiffuse, key);
    set3(b->keySpecular, l->key.m_rgbSpecular, key);
    set3(b->fillColor, l->fill.m_rgbDiffuse, fill);
    set3(b->fillSpecular, l->fill.m_rgbSpecular, fill);
    r_toUpright(rc, l->point.m_Position, b->pointPosition);
    set3(b->pointColor, l->point.m_rgbDiffuse, point);
    set3(b->pointSpecular, l->point.m_rgbSpecular, point);
    b->pointAttenuation[0] = l->point.m_AttenuationConstant;
    b->pointAttenuation[1] = l->point.m_AttenuationLinear;
    b->pointAttenuation[2] = l->point.m_AttenuationQuadratic;
}

static void fillBackground(const RRender *rc, RFrameBlock *b) {
    static const float horizon[3] = {0.918f, 0.933f, 0.949f}, zenith[3] = {0.51f, 0.63f, 0.77f};
    const struct RViewer *v = rc->m_pViewer;
    for (int k = 0; k < 3; k++) {
        b->horizon[k] = r_toLinear(v->hasBackground ? fmaxf(v->background[k], 0) : horizon[k]);
        b->zenith[k] = v->hasBackground ? 0.7f * b->horizon[k] : r_toLinear(zenith[k]);
    }
}

static void fillGround(const RRender *rc, const RScene *scene, RFrameBlock *b) {
    const RCamera *c = &rc->m_pViewer->camera;
    const float distance = c->orthographic ? c->orthoHeight : rc->m_CameraDist;
    b->ground[0] = scene->groundHeight;
    b->ground[1] = scene->hasGround ? 1 : 0;
    b->ground[2] = fmaxf(scene->casterSize, 1e-6f);
    b->fade[0] = scene->lookAt[0];
    b->fade[1] = scene->lookAt[2];
    b->fade[2] = 3 * distance;
    b->fade[3] = 9 * distance;
}

bool r_needsExtra(const RRender *rc) {
    const RLights *l = &rc->m_pViewer->lights;
    const float *s = l->fill.m_rgbSpecular;
    return l->point.m_bUseLight || (l->fill.m_bUseLight && s[0] + s[1] + s[2] > 0);
}

void r_blockFill(RRender *rc, RDraw *d) {
    RFrameBlock *b = &d->block;
    memset(b, 0, sizeof *b);
    fillCamera(rc, b);
    fillLights(rc, b);
    fillBackground(rc, b);
    fillGround(rc, &d->scene, b);
    b->quality[0] = rc->m_Quality == kRFilled ? 0 : 1;
    b->quality[1] = rc->m_Quality == kRQualityFlat ? 1 : 0;
}
