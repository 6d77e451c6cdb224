/* Particle systems: a triangle at each of the program's positions, turned towards the camera in every frame. */
#include "r_i.h"

#include <limits.h>

static bool isParticleSystem(const RParticleSystem *ps, const char *function) {
    return r_isPointer(ps, function, "ps");
}

static RParticleSystem *create(const char *function, int numParticles, MeVector3 *positions, const float color[4],
                               AcmeReal size) {
    if (!r_isPointer(positions, function, "positions") || !r_isFinite(color, 4, function, "color") ||
        !r_isSize(size, function, "the size"))
        return NULL;
    if (numParticles < 1 || numParticles > INT_MAX / 3) {
        MeWarning(1, "%s: numParticles is %d: it must be 1 to %d", function, numParticles, INT_MAX / 3);
        return NULL;
    }
    RParticleSystem *ps = r_alloc(sizeof *ps);
    RGraphic *graphic = r_graphicCreate(function, 3 * numParticles, rMesh);
    if (!ps || !graphic) {
        r_free(ps);
        if (graphic)
            RGraphicDestroy(graphic);
        return NULL;
    }
    RGraphicSetColor(graphic, color);
    *ps = (RParticleSystem){
        .m_nParticles = numParticles, .m_Positions = positions, .m_Size = size, .m_pGraphic = graphic};
    return ps;
}

RParticleSystem *MEAPI RParticleSystemNew(int numParticles, MeVector3 *positions, int tex_id, const float color[4],
                                          AcmeReal size) {
    RParticleSystem *ps = create(__func__, numParticles, positions, color, size);
    if (ps)
        ps->m_pGraphic->m_pObject->m_nTextureID = tex_id;
    return ps;
}

RParticleSystem *MEAPI RParticleSystemCreate(RRender *rc, int numParticles, MeVector3 *positions,
                                             const char *tex_filename, const float color[4], AcmeReal tri_size) {
    if (!r_isContext(rc, __func__))
        return NULL;
    RParticleSystem *ps = create(__func__, numParticles, positions, color, tri_size);
    if (!ps)
        return NULL;
    RGraphicSetTexture(rc, ps->m_pGraphic, tex_filename);
    RParticleSystemAddToList(rc, ps);
    return ps;
}

void MEAPI RParticleSystemAddToList(RRender *rc, RParticleSystem *ps) {
    if (!r_isContext(rc, __func__) || !isParticleSystem(ps, __func__))
        return;
    if (ps->m_pRender) {
        MeWarning(1, "%s: the particle system is in a list already", __func__);
        return;
    }
    RGraphicAddToList(rc, ps->m_pGraphic, 0);
    ps->m_pRender = rc;
    ps->m_pNext = rc->m_pParticleSystems;
    rc->m_pParticleSystems = ps;
}

static void unlinkSystem(RParticleSystem *ps) {
    RParticleSystem **link = &ps->m_pRender->m_pParticleSystems;
    while (*link && *link != ps)
        link = &(*link)->m_pNext;
    MEASSERT(*link == ps);
    *link = ps->m_pNext;
    RGraphicRemoveFromList(ps->m_pRender, ps->m_pGraphic, 0);
    ps->m_pNext = NULL;
    ps->m_pRender = NULL;
}

void MEAPI RParticleSystemRemoveFromList(RRender *rc, RParticleSystem *ps) {
    if (!r_isContext(rc, __func__) || !isParticleSystem(ps, __func__))
        return;
    if (ps->m_pRender == rc)
        unlinkSystem(ps);
    else
        MeWarning(1, "%s: the particle system is not in the context's list", __func__);
}

void MEAPI RParticleSystemDestroy(RParticleSystem *ps) {
    if (!isParticleSystem(ps, __func__))
        return;
    if (ps->m_pRender)
        unlinkSystem(ps);
    RGraphicDestroy(ps->m_pGraphic);
    r_free(ps);
}

void r_particlesFree(RRender *rc) {
    while (rc->m_pParticleSystems)
        RParticleSystemDestroy(rc->m_pParticleSystems);
}

/* ---- What is drawn ---- */

/* An equilateral triangle of side 1 round its middle, and its texture coordinates. */
static const AcmeReal corner[3][4] = {
    {-0.5f, -0.28867513f, 0, 1}, {0.5f, -0.28867513f, 1, 1}, {0, 0.57735027f, 0.5f, 0}};

/* The triangles of particles that are not finite have no area. */
static void faceCamera(const RRender *rc, RParticleSystem *ps) {
    const MeVector4 *camera = (const MeVector4 *)rc->m_CameraMatrix; /* Columns: right, up, back. */
    RObjectVertex *v = ps->m_pGraphic->m_pVertices;
    for (int n = 0; n < ps->m_nParticles; n++) {
        const MeReal *p = ps->m_Positions[n];
        const bool finite = isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        for (int k = 0; k < 3; k++, v++) {
            AcmeReal at[3] = {0, 0, 0};
            for (int i = 0; finite && i < 3; i++)
                at[i] = (AcmeReal)p[i] +
                        ps->m_Size * (corner[k][0] * (AcmeReal)camera[i][0] + corner[k][1] * (AcmeReal)camera[i][1]);
            *v = (RObjectVertex){at[0],
                                 at[1],
                                 at[2],
                                 (AcmeReal)camera[0][2],
                                 (AcmeReal)camera[1][2],
                                 (AcmeReal)camera[2][2],
                                 corner[k][2],
                                 corner[k][3]};
        }
    }
}

void r_particlesUpdate(RRender *rc) {
    for (RParticleSystem *ps = rc->m_pParticleSystems; ps; ps = ps->m_pNext)
        faceCamera(rc, ps);
}
