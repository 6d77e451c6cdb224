/* The key light's shadow map, and the map of how much sky the ground sees. */
#include "r_draw_i.h"

#include <string.h>

/* A box that is looked through along one axis, as a matrix to clip coordinates. */
typedef struct {
    float x[3], y[3], z[3];             /* Its axes; z towards the viewer. */
    float centre[3], half, front, back; /* Half its side; how far it reaches along z and against it. */
} Box;

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void boxMatrix(const Box *box, float m[16]) {
    const float depth = box->front + box->back;
    memset(m, 0, 16 * sizeof *m);
    for (int k = 0; k < 3; k++) {
        m[4 * k] = box->x[k] / box->half;
        m[4 * k + 1] = box->y[k] / box->half;
        m[4 * k + 2] = -2 * box->z[k] / depth;
    }
    m[12] = -dot(box->x, box->centre) / box->half;
    m[13] = -dot(box->y, box->centre) / box->half;
    m[14] = (2 * dot(box->z, box->centre) + box->front - box->back) / depth;
    m[15] = 1;
}

/* From -1..1 to 0..1. */
static void toTexture(const float m[16], float out[16]) {
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++)
            out[4 * i + k] = 0.5f * m[4 * i + k] + 0.5f * m[4 * i + 3];
        out[4 * i + 3] = m[4 * i + 3];
    }
}

/* Sizes change in steps, so that shadows do not crawl while things move. */
static float step(float size) {
    return exp2f(ceilf(4 * log2f(fmaxf(size, 1e-6f))) / 4);
}

/* How much of the world the camera makes something of. */
static float seenRadius(const RRender *rc) {
    const RCamera *c = &rc->m_pViewer->camera;
    return c->orthographic ? 1.5f * c->orthoHeight : 1.8f * rc->m_CameraDist;
}

/* Round the casters, but no larger than what is seen. */
static void regionOf(const RRender *rc, const RScene *s, float centre[3], float *radius) {
    float square = 0;
    for (int k = 0; k < 3; k++) {
        centre[k] = 0.5f * (s->casterLow[k] + s->casterHigh[k]);
        square += (s->casterHigh[k] - centre[k]) * (s->casterHigh[k] - centre[k]);
    }
    *radius = step(sqrtf(square));
    if (*radius > seenRadius(rc)) {
        *radius = step(seenRadius(rc));
        memcpy(centre, s->lookAt, 3 * sizeof *centre);
    }
}

static void lightAxes(const float toLight[4], Box *box) {
    memcpy(box->z, toLight, sizeof box->z);
    const float side[3] = {box->z[1], -box->z[0], 0}; /* Perpendicular to it, unless it is along z. */
    const float length = sqrtf(dot(side, side));
    for (int k = 0; k < 3; k++)
        box->x[k] = length > 1e-3f ? side[k] / length : k == 0;
    box->y[0] = box->z[1] * box->x[2] - box->z[2] * box->x[1];
    box->y[1] = box->z[2] * box->x[0] - box->z[0] * box->x[2];
    box->y[2] = box->z[0] * box->x[1] - box->z[1] * box->x[0];
}

/* Moves the centre to whole texels, for the same reason as in step(). */
static void snap(Box *box, float texel) {
    const float dx = remainderf(dot(box->x, box->centre), texel), dy = remainderf(dot(box->y, box->centre), texel);
    for (int k = 0; k < 3; k++)
        box->centre[k] -= dx * box->x[k] + dy * box->y[k];
}

/* A range along each axis of a box. */
typedef struct {
    float low[3], high[3];
} Range;

static void extend(Range *range, const Box *box, const float p[3], float radius) {
    const float *const axes[3] = {box->x, box->y, box->z};
    for (int k = 0; k < 3; k++) {
        const float at = dot(axes[k], p);
        range->low[k] = fminf(range->low[k], at - radius);
        range->high[k] = fmaxf(range->high[k], at + radius);
    }
}

static const Range nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static Range rangeOfCasters(const RScene *s, const Box *box) {
    Range range = nothing;
    for (size_t i = 0; i < s->items.count; i++)
        if (r_castsShadow(&s->items.items[i]))
            extend(&range, box, s->items.items[i].centre, s->items.items[i].radius);
    return range;
}

/* What the camera sees: a pyramid as deep as something can be made out, or a ball without perspective. */
static Range rangeSeen(const RRender *rc, const RDraw *d, const Box *box) {
    const RFrameBlock *b = &d->block;
    Range range = nothing;
    if (b->eye[3] < 0.5f) {
        extend(&range, box, d->scene.lookAt, seenRadius(rc));
        return range;
    }
    const float depth = fminf(d->scene.farthest, rc->m_CameraDist + seenRadius(rc));
    extend(&range, box, d->scene.eye, 0);
    for (int corner = 0; corner < 4; corner++) {
        float p[3];
        for (int k = 0; k < 3; k++)
            p[k] = d->scene.eye[k] + depth * (-b->back[k] + (corner & 1 ? 1.f : -1.f) * b->right[k] +
                                              (corner & 2 ? 1.f : -1.f) * b->up[k]);
        extend(&range, box, p, 0);
    }
    return range;
}

/* A shadow lies where its caster does, seen from the light: so the map has to hold no more than both ranges share. */
static void fitShadow(const RRender *rc, RDraw *d) {
    RFrameBlock *b = &d->block;
    const int size = r_qualityLevels[d->level].shadowSize;
    Box box;
    lightAxes(b->keyDirection, &box);
    const Range casters = rangeOfCasters(&d->scene, &box), seen = rangeSeen(rc, d, &box);
    /* The shadow's edge is as soft as some of the map's texels, so the map must not be too fine for the picture. */
    float middle[3], radius = step(0.4f * seenRadius(rc));
    for (int k = 0; k < 3; k++) {
        float low = casters.low[k], high = casters.high[k];
        if (k < 2 && fmaxf(low, seen.low[k]) < fminf(high, seen.high[k])) {
            low = fmaxf(low, seen.low[k]);
            high = fminf(high, seen.high[k]);
        }
        middle[k] = (low + high) / 2;
        if (k < 2)
            radius = fmaxf(radius, step((high - low) / 2));
    }
    for (int k = 0; k < 3; k++)
        box.centre[k] = middle[0] * box.x[k] + middle[1] * box.y[k] + middle[2] * box.z[k];
    box.half = radius;
    box.front = box.back = step((casters.high[2] - casters.low[2]) / 2);
    const float texel = 2 * radius / (float)size;
    snap(&box, texel);
    if (d->scene.hasGround && box.z[1] > 0.05f) { /* Down to where the shadow falls. */
        const float down = (box.centre[1] - d->scene.groundHeight + radius * sqrtf(1 - box.z[1] * box.z[1])) / box.z[1];
        box.back = fminf(fmaxf(box.back, down), 50 * fmaxf(radius, box.back));
    }
    boxMatrix(&box, d->shadowMatrix);
    toTexture(d->shadowMatrix, b->shadow);
    const float perLength = 0.5f / radius, depthPerLength = 1 / (box.front + box.back);
    b->shadowSettings[0] = 1 / (float)size;
    b->shadowSettings[1] = 1.2f * texel;
    b->shadowSettings[2] = 1;
    b->shadowSettings[3] = (depthPerLength / perLength) * (depthPerLength / perLength);
}

/* From below, so that the undersides are seen, whose height counts. */
static void fitOcclusion(RDraw *d, const float centre[3], float radius) {
    const float side = 2.6f * radius, height = 3 * radius;
    Box box = {.x = {1, 0, 0}, .y = {0, 0, 1}, .z = {0, -1, 0}, .half = side / 2, .front = 0, .back = height};
    box.centre[0] = centre[0];
    box.centre[1] = d->scene.groundHeight;
    box.centre[2] = centre[2];
    snap(&box, side / (float)r_qualityLevels[d->level].belowSize);
    boxMatrix(&box, d->belowMatrix);
    d->belowSize[0] = side;
    d->belowSize[1] = height;
    d->block.occlusion[0] = box.centre[0] - side / 2;
    d->block.occlusion[1] = box.centre[2] - side / 2;
    d->block.occlusion[2] = 1 / side;
    d->block.occlusion[3] = 0.85f;
}

void r_shadowFit(RRender *rc, RDraw *d) {
    float centre[3], radius;
    if (!rc->m_pViewer->shadows || d->scene.casters == 0 || rc->m_Quality == kRFilled)
        return;
    regionOf(rc, &d->scene, centre, &radius);
    if (d->scene.hasGround)
        fitOcclusion(d, centre, radius);
    if (rc->m_pViewer->lights.key.m_bUseLight)
        fitShadow(rc, d);
}

static void drawDepth(RDraw *d, const RTarget *target, GLsizei size, const float matrix[16]) {
    const RGL *gl = &d->gl;
    const GLuint program = d->programs[rProgramDepth];
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->frame);
    gl->Viewport(0, 0, size, size);
    gl->DepthMask(GL_TRUE);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->Enable(GL_DEPTH_CLAMP); /* What is in front of the box counts as on its front. */
    gl->UseProgram(program);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "uMatrix"), 1, GL_FALSE, matrix);
    r_drawCasters(d);
    gl->Disable(GL_DEPTH_CLAMP);
}

static void drawOcclusion(RDraw *d) {
    const RGL *gl = &d->gl;
    const GLuint program = d->programs[rProgramOcclusion];
    gl->BindFramebuffer(GL_FRAMEBUFFER, d->occlusion.frame);
    gl->Disable(GL_DEPTH_TEST);
    gl->UseProgram(program);
    gl->Uniform2f(gl->GetUniformLocation(program, "uSize"), d->belowSize[0], d->belowSize[1]);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, d->below.depth);
    gl->BindVertexArray(d->emptyArray);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void r_shadowDraw(RDraw *d) {
    const RGL *gl = &d->gl;
    if (d->block.shadowSettings[2] > 0) {
        gl->Enable(GL_POLYGON_OFFSET_FILL);
        gl->PolygonOffset(1, 2);
        drawDepth(d, &d->shadow, r_qualityLevels[d->level].shadowSize, d->shadowMatrix);
        gl->Disable(GL_POLYGON_OFFSET_FILL);
    }
    if (d->block.occlusion[3] > 0) {
        drawDepth(d, &d->below, r_qualityLevels[d->level].belowSize, d->belowMatrix);
        drawOcclusion(d);
    }
}
