/* What is drawn in a frame: from the lists to items in drawing order, and the items to OpenGL. */
#include "r_draw_i.h"

#include <stdlib.h>
#include <string.h>

static void linearColor(const float from[4], float to[4]) {
    for (int k = 0; k < 3; k++)
        to[k] = r_toLinear(fmaxf(from[k], 0));
}

static void warnOnce(RGraphic *rg, const char *what) {
    if (!rg->m_pPart->warned)
        MeWarning(1, "MeViewer: %s: it is not drawn", what);
    rg->m_pPart->warned = true;
}

static bool vertexCountIsGood(RGraphic *rg) {
    const int n = rg->m_pObject->m_nNumVertices;
    if (n >= 0 && n <= rg->m_nMaxNumVertices && n % 3 == 0)
        return true;
    warnOnce(rg, "a graphic's number of vertices is not a multiple of 3 that it has room for");
    return false;
}

/* ---- Items ---- */

static void setInstance(RInstance *out, const RGraphic *rg, const float m[16]) {
    const RObjectHeader *o = rg->m_pObject;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out->row[i][j] = m[4 * j + i];
    linearColor(o->m_ColorDiffuse, out->diffuse);
    linearColor(o->m_ColorAmbient, out->ambient);
    linearColor(o->m_ColorEmissive, out->emissive);
    linearColor(o->m_ColorSpecular, out->specular);
    const float alpha = o->m_ColorDiffuse[3];
    out->diffuse[3] = alpha > 0 && alpha < 1 ? alpha : 1;
    out->ambient[3] = 1;
    out->emissive[3] = 0; /* 1: not lit; below 0.5: a mark (markKind). */
    out->specular[3] = o->m_SpecularPower;
}

/* Marks by which a round shape is seen to turn: a tenth for each kind of pattern, see markOf in r_shaders.c. */
static float markKind(const RGraphic *rg) {
    const RShapeKind kind = rg->m_pPart->shape.kind;
    if (kind == rShapeOther || kind == rShapeBox)
        return 0;
    return kind == rShapeSphere ? 0.1f : 0.2f;
}

/* Equal neighbours are told apart by their tone: up to 8 % of light more or less, as far from those before as can be
 * (the golden ratio's multiples). A difference of 8 % is just seen where two areas meet, and is no other colour. */
static void setTone(RInstance *out, const RGraphic *rg) {
    const float turns = 0.6180340f * (float)(rg->m_pPart->number % 4096);
    const float factor = 1 + 0.08f * (2 * (turns - floorf(turns)) - 1);
    for (int k = 0; k < 3; k++) {
        out->diffuse[k] *= factor;
        out->ambient[k] *= factor;
    }
}

const char *const r_groundNames[R_GROUNDS] = {"grid", "checker", "plain", "earth"};

int MEAPI RRenderGetGroundLook(RRender *rc) {
    if (!r_isContext(rc, __func__))
        return -1;
    return rc->m_Options.m_Ground >= 0 ? rc->m_Options.m_Ground : rc->m_pViewer->ground;
}

void MEAPI RRenderSetGroundLook(RRender *rc, int look) {
    if (!r_isContext(rc, __func__))
        return;
    if (look < -1 || look >= R_GROUNDS)
        MeWarning(1, "%s: look is %d: it must be an RGroundLook, or -1", __func__, look);
    else
        rc->m_pViewer->ground = look;
}

/* The ground's pattern goes where other graphics have their highlights. */
static void setGroundInstance(RRender *rc, RInstance *out, const RGraphic *rg) {
    const float side = rg->m_pPart->side;
    const int texture = rg->m_pObject->m_nTextureID;
    const struct RViewer *v = rc->m_pViewer;
    const int look = RRenderGetGroundLook(rc);
    const bool named = texture >= 0 && texture < v->textures.count;
    float cell = 1;
    if (side < 4 || side > 1000) /* For very small and very large worlds. */
        cell = powf(10, roundf(log10f(side / 40)));
    out->specular[0] = side / 2;
    out->specular[1] = cell;
    out->specular[2] = kRGroundGrid;
    if (look >= 0)
        out->specular[2] = (float)look;
    else if (named && strcmp(v->textures.names[texture], "checkerboard") == 0)
        out->specular[2] = kRGroundChecker;
}

static void setPlace(RItem *item, const RMesh *mesh, const float m[16]) {
    float scale = 0;
    for (int i = 0; i < 3; i++) {
        item->centre[i] = mesh->centre[0] * m[i] + mesh->centre[1] * m[4 + i] + mesh->centre[2] * m[8 + i] + m[12 + i];
        const float axis = m[4 * i] * m[4 * i] + m[4 * i + 1] * m[4 * i + 1] + m[4 * i + 2] * m[4 * i + 2];
        scale = fmaxf(scale, axis);
    }
    item->radius = mesh->radius * sqrtf(scale);
}

static RClass classOf(const RGraphic *rg, const RInstance *instance) {
    if (rg->m_pPart->kind == rGround)
        return rFloor;
    return instance->diffuse[3] < 1 ? rBlended : rOpaque;
}

static void addItem(RRender *rc, RScene *scene, const RGraphic *rg, const RMesh *mesh, const float m[16]) {
    if (!r_grow(scene->items, 1))
        return;
    RItem *item = &scene->items.items[scene->items.count];
    *item = (RItem){.mesh = mesh, .texture = rg->m_pObject->m_nTextureID, .order = scene->items.count};
    setInstance(&item->instance, rg, m);
    setPlace(item, mesh, m);
    item->class = classOf(rg, &item->instance);
    if (item->class != rFloor) {
        setTone(&item->instance, rg);
        item->instance.emissive[3] = markKind(rg);
    }
    if (item->class == rFloor) {
        setGroundInstance(rc, &item->instance, rg);
        if (item->instance.specular[2] > 0 || RRenderGetGroundLook(rc) >= 0) /* Its own shader draws it. */
            item->texture = -1;
        if (!scene->hasGround)
            scene->groundHeight = item->centre[1];
        scene->hasGround = true;
    }
    float distance = 0;
    for (int k = 0; k < 3; k++)
        distance += (item->centre[k] - scene->eye[k]) * (item->centre[k] - scene->eye[k]);
    item->depth = sqrtf(distance);
    scene->items.count++;
}

static void addEdges(RScene *scene, const RGraphic *rg, RMesh *mesh, const float m[16]) {
    if (!r_meshEdges(mesh, rg) || !r_grow(scene->lines, mesh->edgeCount))
        return;
    for (size_t i = 0; i < mesh->edgeCount; i++) {
        const REdge *e = &mesh->edges[i];
        RLineSegment *s = &scene->lines.items[scene->lines.count++];
        for (int k = 0; k < 3; k++) {
            s->a[k] = e->a[0] * m[k] + e->a[1] * m[4 + k] + e->a[2] * m[8 + k] + m[12 + k];
            s->b[k] = e->b[0] * m[k] + e->b[1] * m[4 + k] + e->b[2] * m[8 + k] + m[12 + k];
        }
        memcpy(s->color, rg->m_pObject->m_ColorDiffuse, sizeof s->color);
    }
}

/* How large a unit is on the screen, at most, where the transform's origin is. */
static float pixelsPerUnit(const RRender *rc, const RScene *s, const float m[16]) {
    const struct RViewer *v = rc->m_pViewer;
    float scale = 0, away = 0;
    for (int i = 0; i < 3; i++) {
        scale = fmaxf(scale, m[4 * i] * m[4 * i] + m[4 * i + 1] * m[4 * i + 1] + m[4 * i + 2] * m[4 * i + 2]);
        away += (m[12 + i] - s->eye[i]) * (m[12 + i] - s->eye[i]);
    }
    const float seen =
        v->camera.orthographic ? v->camera.orthoHeight : 2 * tanf(rc->m_CameraFov / 2) * fmaxf(sqrtf(away), NEARZ);
    return sqrtf(scale) * (float)v->height / seen;
}

/* From a graphic's own frame to the upright one. The ground's own frame is upright already. */
static void transformToUpright(const RRender *rc, bool isGround, float m[16]) {
    float axes[3][3];
    for (int i = 0; i < 3; i++)
        memcpy(axes[i], m + 4 * i, sizeof axes[i]);
    for (int i = 0; i < 3; i++) {
        float axis[3];
        memcpy(axis, axes[i], sizeof axis);
        for (int k = 0; isGround && k < 3; k++)
            axis[k] = rc->m_pViewer->camera.upright[i][0] * axes[0][k] +
                      rc->m_pViewer->camera.upright[i][1] * axes[1][k] +
                      rc->m_pViewer->camera.upright[i][2] * axes[2][k];
        r_toUpright(rc, axis, m + 4 * i);
    }
    const float origin[3] = {m[12], m[13], m[14]};
    r_toUpright(rc, origin, m + 12);
}

static void gatherGraphic(RRender *rc, RDraw *d, RGraphic *rg) {
    const bool ground = rg->m_pPart->kind == rGround;
    const bool wire =
        !ground && (rg->m_pObject->m_bIsWireFrame || rc->m_pViewer->wireframe || rc->m_Quality == kRQualityWireframe);
    float m[16];
    if ((rg->m_pPart->kind != rMesh && !ground) || !vertexCountIsGood(rg) || rg->m_pObject->m_nNumVertices == 0 ||
        !r_graphicTransform(rg, m))
        return;
    transformToUpright(rc, ground, m);
    RMesh *mesh = NULL;
    if (!wire && rc->m_Quality != kRQualityFlat)
        mesh = r_detailMesh(d, rg, pixelsPerUnit(rc, &d->scene, m));
    if (mesh)
        r_detailTransform(&rg->m_pPart->shape, m);
    else
        mesh = r_meshOf(d, rg);
    if (!mesh)
        return;
    if (!mesh->finite)
        warnOnce(rg, "a graphic has a vertex that is not finite");
    else if (wire)
        addEdges(&d->scene, rg, mesh, m);
    else
        addItem(rc, &d->scene, rg, mesh, m);
}

/* ---- Order and measures ---- */

/* Opaque ones by mesh and texture, see-through ones from far to near; then as they come in the list. */
static int compareItems(const void *a, const void *b) {
    const RItem *p = a, *q = b;
    if (p->class != q->class)
        return p->class < q->class ? -1 : 1;
    if (p->class == rBlended && p->depth != q->depth)
        return p->depth > q->depth ? -1 : 1;
    if (p->class == rOpaque && p->mesh->number != q->mesh->number)
        return p->mesh->number < q->mesh->number ? -1 : 1;
    if (p->class == rOpaque && p->texture != q->texture)
        return p->texture < q->texture ? -1 : 1;
    return p->order < q->order ? -1 : 1;
}

bool r_castsShadow(const RItem *item) {
    return item->class == rOpaque || (item->class == rBlended && item->instance.diffuse[3] > 0.5f);
}

static void measure(RScene *scene) {
    float size = 0;
    scene->casters = 0;
    scene->farthest = 0;
    for (size_t i = 0; i < scene->items.count; i++) {
        const RItem *item = &scene->items.items[i];
        scene->farthest = fmaxf(scene->farthest, item->depth + item->radius);
        if (!r_castsShadow(item))
            continue;
        for (int k = 0; k < 3; k++) {
            const float low = item->centre[k] - item->radius, high = item->centre[k] + item->radius;
            scene->casterLow[k] = scene->casters ? fminf(scene->casterLow[k], low) : low;
            scene->casterHigh[k] = scene->casters ? fmaxf(scene->casterHigh[k], high) : high;
        }
        size += item->radius;
        scene->casters++;
    }
    scene->casterSize = scene->casters ? size / (float)scene->casters : 1;
}

static void uploadInstances(RDraw *d) {
    RScene *s = &d->scene;
    s->instances.count = 0;
    if (!r_grow(s->instances, s->items.count))
        return;
    for (size_t i = 0; i < s->items.count; i++)
        s->instances.items[i] = s->items.items[i].instance;
    s->instances.count = s->items.count;
    d->gl.BindBuffer(GL_ARRAY_BUFFER, d->instanceBuffer);
    d->gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(s->instances.count * sizeof(RInstance)), s->instances.items,
                     GL_STREAM_DRAW);
}

static void gatherLines(RRender *rc, RScene *s) {
    const size_t first = s->lines.count;
    r_linesCollect(rc, &s->lines);
    for (size_t i = first; i < s->lines.count; i++) {
        const RLineSegment world = s->lines.items[i];
        r_toUpright(rc, world.a, s->lines.items[i].a);
        r_toUpright(rc, world.b, s->lines.items[i].b);
    }
}

void r_sceneGather(RRender *rc, RDraw *d) {
    RScene *s = &d->scene;
    s->items.count = s->lines.count = 0;
    s->hasGround = false;
    r_toUpright(rc, rc->m_CameraPos, s->eye);
    r_toUpright(rc, rc->m_CameraLookAt, s->lookAt);
    r_particlesUpdate(rc);
    for (RGraphic *rg = rc->m_p3DGraphics; rg; rg = rg->m_pNext)
        gatherGraphic(rc, d, rg);
    gatherLines(rc, s);
    if (s->items.count)
        qsort(s->items.items, s->items.count, sizeof *s->items.items, compareItems);
    measure(s);
    uploadInstances(d);
    rc->m_pViewer->camera.farthest = s->farthest;
}

void r_sceneFree(RScene *scene) {
    r_free(scene->items.items);
    r_free(scene->instances.items);
    r_free(scene->lines.items);
}

/* ---- To OpenGL ---- */

/* The bound vertex array takes its instances from the buffer's `first` on. */
static void pointToInstances(const RDraw *d, size_t first) {
    d->gl.BindBuffer(GL_ARRAY_BUFFER, d->instanceBuffer);
    for (GLuint i = 0; i < 7; i++)
        d->gl.VertexAttribPointer(3 + i, 4, GL_FLOAT, GL_FALSE, sizeof(RInstance),
                                  (const void *)(first * sizeof(RInstance) + i * 4 * sizeof(float)));
}

static void drawRun(const RDraw *d, const RMesh *mesh, size_t first, size_t count) {
    d->gl.BindVertexArray(mesh->array);
    pointToInstances(d, first);
    d->gl.DrawElementsInstanced(GL_TRIANGLES, mesh->indexCount, GL_UNSIGNED_INT, NULL, (GLsizei)count);
}

/* How many items from i on can be drawn at once. */
static size_t runLength(const RScene *s, size_t i, bool byTexture) {
    const RItem *first = &s->items.items[i];
    size_t n = 1;
    while (i + n < s->items.count) {
        const RItem *item = &s->items.items[i + n];
        if (item->class != first->class || item->mesh != first->mesh ||
            (byTexture && item->texture != first->texture) || r_castsShadow(item) != r_castsShadow(first))
            break;
        n++;
    }
    return n;
}

static void bindTexture(RRender *rc, RDraw *d, GLuint program, int id) {
    const GLuint texture = id >= 0 ? r_textureObject(rc, d, id) : 0;
    d->gl.ActiveTexture(GL_TEXTURE0);
    d->gl.BindTexture(GL_TEXTURE_2D, texture);
    d->gl.Uniform1f(d->gl.GetUniformLocation(program, "uTextured"), texture ? 1 : 0);
}

static void cull(const RGL *gl, bool on, GLenum face) {
    if (on) {
        gl->Enable(GL_CULL_FACE);
        gl->CullFace(face);
    } else {
        gl->Disable(GL_CULL_FACE);
    }
}

void r_drawItems(RRender *rc, RDraw *d, RClass class) {
    const RGL *gl = &d->gl;
    const RScene *s = &d->scene;
    const bool extra = r_needsExtra(rc);
    const GLuint program = d->programs[class == rFloor ? (extra ? rProgramGroundExtra : rProgramGround)
                                                       : (extra ? rProgramSolidExtra : rProgramSolid)];
    gl->UseProgram(program);
    for (size_t i = 0, n; i < s->items.count; i += n) {
        const RItem *item = &s->items.items[i];
        n = runLength(s, i, true);
        if (item->class != class)
            continue;
        bindTexture(rc, d, program, item->texture);
        if (class == rBlended) { /* One by one, and the inside first. */
            n = 1;
            cull(gl, true, GL_FRONT);
            drawRun(d, item->mesh, i, 1);
            cull(gl, true, GL_BACK);
        } else {
            cull(gl, item->mesh->closed, GL_BACK);
        }
        drawRun(d, item->mesh, i, n);
    }
    gl->Disable(GL_CULL_FACE);
}

void r_drawCasters(RDraw *d) {
    const RScene *s = &d->scene;
    for (size_t i = 0, n; i < s->items.count; i += n) {
        const RItem *item = &s->items.items[i];
        n = runLength(s, i, false);
        if (r_castsShadow(item))
            drawRun(d, item->mesh, i, n);
    }
    d->gl.BindVertexArray(0);
}

void r_drawSky(RRender *rc, RDraw *d) {
    const RGL *gl = &d->gl;
    const RScene *s = &d->scene;
    RGraphic *sky = rc->m_pViewer->sky;
    RMesh *mesh = sky ? r_meshOf(d, sky) : NULL;
    if (!mesh)
        return;
    const float r = 1000; /* Any size: it is drawn before everything else and hides nothing. */
    const float m[16] = {r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0, s->eye[0], s->eye[1], s->eye[2], 1};
    RInstance instance;
    setInstance(&instance, sky, m);
    instance.emissive[3] = 1;
    gl->UseProgram(d->programs[rProgramSolid]);
    bindTexture(rc, d, d->programs[rProgramSolid], sky->m_pObject->m_nTextureID);
    gl->BindBuffer(GL_ARRAY_BUFFER, d->skyBuffer);
    gl->BufferData(GL_ARRAY_BUFFER, sizeof instance, &instance, GL_STREAM_DRAW);
    gl->BindVertexArray(mesh->array);
    for (GLuint i = 0; i < 7; i++)
        gl->VertexAttribPointer(3 + i, 4, GL_FLOAT, GL_FALSE, sizeof instance, (const void *)(i * 4 * sizeof(float)));
    gl->Disable(GL_DEPTH_TEST);
    gl->Enable(GL_DEPTH_CLAMP);
    gl->DrawElementsInstanced(GL_TRIANGLES, mesh->indexCount, GL_UNSIGNED_INT, NULL, 1);
    gl->Disable(GL_DEPTH_CLAMP);
    gl->Enable(GL_DEPTH_TEST);
}
