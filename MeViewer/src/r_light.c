/* The lights: their defaults, their switches, and which of their changes are in force. */
#include "r_i.h"

static void setColor(AcmeReal rgb[3], AcmeReal r, AcmeReal g, AcmeReal b) {
    rgb[0] = r;
    rgb[1] = g;
    rgb[2] = b;
}

/* A warm key light from the upper left, in front; a weak bluish fill light from the right. */
void r_lightsInit(RRender *rc) {
    RDirectLight *key = &rc->m_DirectLight1, *fill = &rc->m_DirectLight2;
    rc->m_bUseAmbientLight = 1;
    setColor(rc->m_rgbAmbientLightColor, 0.42f, 0.42f, 0.42f);
    rc->m_rgbAmbientLightColor[3] = 1;

    key->m_bUseLight = 1;
    setColor(key->m_Direction, 0.45f, -1, -0.55f);
    setColor(key->m_rgbDiffuse, 0.78f, 0.75f, 0.70f);
    setColor(key->m_rgbSpecular, 0.8f, 0.8f, 0.8f);

    fill->m_bUseLight = 1;
    setColor(fill->m_Direction, -1, -0.35f, -0.25f);
    setColor(fill->m_rgbDiffuse, 0.10f, 0.11f, 0.13f);

    setColor(rc->m_PointLight.m_Position, 0, 10, 0);
    setColor(rc->m_PointLight.m_rgbDiffuse, 1, 1, 1);
    setColor(rc->m_PointLight.m_rgbSpecular, 0.5f, 0.5f, 0.5f);
    rc->m_PointLight.m_AttenuationConstant = 1;

    rc->m_bForceDirectLight1Update = rc->m_bForceDirectLight2Update = rc->m_bForcePointLightUpdate = 1;
}

static void vectorsOf(RRender *rc, AcmeReal *vectors[3]) {
    vectors[0] = rc->m_DirectLight1.m_Direction;
    vectors[1] = rc->m_DirectLight2.m_Direction;
    vectors[2] = rc->m_PointLight.m_Position;
}

void r_lightsToUpright(RRender *rc, AcmeReal upright[3][3]) {
    AcmeReal *world[3];
    vectorsOf(rc, world);
    for (int i = 0; i < 3; i++)
        r_toUpright(rc, world[i], upright[i]);
}

void r_lightsFromUpright(RRender *rc, AcmeReal upright[3][3]) {
    AcmeReal *world[3];
    vectorsOf(rc, world);
    for (int i = 0; i < 3; i++)
        r_fromUpright(rc, upright[i], world[i]);
    rc->m_bForceDirectLight1Update = rc->m_bForceDirectLight2Update = rc->m_bForcePointLightUpdate = 1;
}

/* Before the main loop everything is taken over as it is; in it, what is flagged. */
void r_lightsUpdate(RRender *rc) {
    RLights *in = &rc->m_pViewer->lights;
    const bool all = rc->m_pViewer->loop.frames == 0;
    if (all || rc->m_bForceDirectLight1Update)
        in->key = rc->m_DirectLight1;
    if (all || rc->m_bForceDirectLight2Update)
        in->fill = rc->m_DirectLight2;
    if (all || rc->m_bForcePointLightUpdate)
        in->point = rc->m_PointLight;
    rc->m_bForceDirectLight1Update = rc->m_bForceDirectLight2Update = rc->m_bForcePointLightUpdate = 0;
}

static void switchLight(RRender *rc, const char *function, RRenderLight light, int on) {
    if (!r_isContext(rc, function))
        return;
    switch (light) {
    case kRAmbient:
        rc->m_bUseAmbientLight = on;
        break;
    case kRDirect1:
        rc->m_DirectLight1.m_bUseLight = on;
        rc->m_bForceDirectLight1Update = 1;
        break;
    case kRDirect2:
        rc->m_DirectLight2.m_bUseLight = on;
        rc->m_bForceDirectLight2Update = 1;
        break;
    case kRPoint:
        rc->m_PointLight.m_bUseLight = on;
        rc->m_bForcePointLightUpdate = 1;
        break;
    default:
        MeWarning(1, "%s: %d is not a light", function, (int)light);
        break;
    }
}

void MEAPI RLightSwitchOn(RRender *rc, RRenderLight light) {
    switchLight(rc, __func__, light, 1);
}

void MEAPI RLightSwitchOff(RRender *rc, RRenderLight light) {
    switchLight(rc, __func__, light, 0);
}
