/* Graphics as objects: their memory, the two lists, and changes to them. r_create.c makes the shapes. */
#include "r_i.h"

#include <limits.h>
#include <stdint.h>
#include <string.h>

static void setIdentity(MeMatrix4 m) {
    memset(m, 0, sizeof(MeMatrix4));
    for (int i = 0; i < 4; i++)
        m[i][i] = 1;
}

RGraphic *r_graphicCreate(const char *function, int numVertices, RKind kind) {
    if (numVertices < 0 || numVertices % 3 != 0) {
        MeWarning(1, "%s: %d vertices: their number must be a multiple of 3", function, numVertices);
        return NULL;
    }
    RGraphic *rg = r_alloc(sizeof *rg);
    struct RGraphicPart *part = r_alloc(sizeof *part);
    RObjectHeader *object = r_alloc(sizeof *object + (size_t)numVertices * sizeof(RObjectVertex));
    if (!rg || !part || !object) {
        r_free(rg);
        r_free(part);
        r_free(object);
        return NULL;
    }
    setIdentity(object->m_Matrix);
    object->m_nNumVertices = numVertices;
    object->m_nTextureID = -1;
    object->m_SpecularPower = 20;
    for (int i = 0; i < 4; i++)
        object->m_ColorAmbient[i] = object->m_ColorDiffuse[i] = 1;
    part->kind = kind;
    rg->m_pObject = object;
    rg->m_pVertices = (RObjectVertex *)(object + 1);
    rg->m_nMaxNumVertices = numVertices;
    rg->m_pPart = part;
    return rg;
}

RGraphic *MEAPI RGraphicCreateEmpty(int numVertices) {
    return r_graphicCreate(__func__, numVertices, rMesh);
}

static void unlinkGraphic(RGraphic *rg) {
    RRender *rc = rg->m_pPart->owner;
    RGraphic **first = rg->m_pPart->is2D ? &rc->m_p2DGraphics : &rc->m_p3DGraphics;
    RGraphic **last = rg->m_pPart->is2D ? &rc->m_pViewer->last2D : &rc->m_pViewer->last3D;
    MEASSERT(rg->m_pPrev ? rg->m_pPrev->m_pNext == rg : *first == rg);
    MEASSERT(rg->m_pNext ? rg->m_pNext->m_pPrev == rg : *last == rg);
    *(rg->m_pPrev ? &rg->m_pPrev->m_pNext : first) = rg->m_pNext;
    *(rg->m_pNext ? &rg->m_pNext->m_pPrev : last) = rg->m_pPrev;
    rg->m_pNext = rg->m_pPrev = NULL;
    rg->m_pPart->owner = NULL;
}

void MEAPI RGraphicAddToList(RRender *rc, RGraphic *rg, int is2D) {
    if (!r_isContext(rc, __func__) || !r_isGraphic(rg, __func__))
        return;
    if (rg->m_pPart->owner) {
        MeWarning(1, "%s: the graphic is in a list already", __func__);
        return;
    }
    RGraphic **first = is2D ? &rc->m_p2DGraphics : &rc->m_p3DGraphics;
    RGraphic **last = is2D ? &rc->m_pViewer->last2D : &rc->m_pViewer->last3D;
    MEASSERT((*first == NULL) == (*last == NULL) && (!*last || !(*last)->m_pNext));
    rg->m_pPrev = *last;
    rg->m_pNext = NULL;
    *(*last ? &(*last)->m_pNext : first) = rg;
    *last = rg;
    rg->m_pPart->owner = rc;
    if (!rg->m_pPart->number)
        rg->m_pPart->number = ++rc->m_pViewer->graphicsListed;
    rg->m_pPart->is2D = is2D != 0;
}

static bool isInList(const RRender *rc, const RGraphic *rg, int is2D, const char *function) {
    if (rg->m_pPart->owner == rc && rg->m_pPart->is2D == (is2D != 0))
        return true;
    MeWarning(1, "%s: the graphic is not in the context's %s list", function, is2D ? "2D" : "3D");
    return false;
}

void MEAPI RGraphicRemoveFromList(RRender *rc, RGraphic *rg, int is2D) {
    if (r_isContext(rc, __func__) && r_isGraphic(rg, __func__) && isInList(rc, rg, is2D, __func__))
        unlinkGraphic(rg);
}

void MEAPI RGraphicDestroy(RGraphic *rg) {
    if (!r_isGraphic(rg, __func__))
        return;
    if (rg->m_pPart->owner) {
        const RPerformanceBar *bar = rg->m_pPart->owner->m_pPerformanceBar;
        if (bar && bar->m_pTicks == rg)
            rg->m_pPart->owner->m_pPerformanceBar->m_pTicks = NULL;
        unlinkGraphic(rg);
    }
    r_free(rg->m_pPart->text);
    r_free(rg->m_pPart);
    r_free(rg->m_pObject);
    r_free(rg);
}

void MEAPI RGraphicDelete(RRender *rc, RGraphic *rg, int is2D) {
    if (r_isContext(rc, __func__) && r_isGraphic(rg, __func__) && isInList(rc, rg, is2D, __func__))
        RGraphicDestroy(rg);
}

void r_graphicFreeAll(RRender *rc) {
    while (rc->m_p3DGraphics)
        RGraphicDestroy(rc->m_p3DGraphics);
    while (rc->m_p2DGraphics)
        RGraphicDestroy(rc->m_p2DGraphics);
    if (rc->m_pViewer->sky)
        RGraphicDestroy(rc->m_pViewer->sky);
    rc->m_pViewer->sky = NULL;
}

void r_graphicIsShape(RGraphic *rg, RShape shape) {
    if (!rg)
        return;
    rg->m_pPart->shape = shape;
    r_hashVertices(rg->m_pVertices, rg->m_pObject->m_nNumVertices, rg->m_pPart->shape.hash);
}

RGraphic *r_graphicFinish(const char *function, RRender *rc, RGraphic *rg, const float color[4], MeMatrix4Ptr matrix,
                          bool is2D) {
    if (!rg)
        return NULL;
    if (!r_isFinite(color, 4, function, "color")) {
        RGraphicDestroy(rg);
        return NULL;
    }
    RGraphicSetColor(rg, color);
    rg->m_pLWMatrix = matrix;
    RGraphicAddToList(rc, rg, is2D);
    return rg;
}

bool r_matrixFloats(const MeVector4 *matrix, float out[16]) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (!matrix) {
        memcpy(out, identity, sizeof identity);
        return true;
    }
    for (int i = 0; i < 16; i++) {
        out[i] = (float)matrix[i / 4][i % 4];
        if (!isfinite(out[i]))
            return false;
    }
    return true;
}

bool r_graphicTransform(RGraphic *rg, float out[16]) {
    if (r_matrixFloats((const MeVector4 *)rg->m_pLWMatrix, out)) {
        if (rg->m_pLWMatrix)
            memcpy(rg->m_pObject->m_Matrix, rg->m_pLWMatrix, sizeof(MeMatrix4));
        else
            setIdentity(rg->m_pObject->m_Matrix);
        return true;
    }
    if (!rg->m_pPart->warned)
        MeWarning(1, "MeViewer: a graphic's transform is not finite: it is not drawn");
    rg->m_pPart->warned = true;
    return false;
}

void MEAPI RGraphicCalcOGLDisplayList(RGraphic *rg) {
    (void)r_isGraphic(rg, __func__);
}

void MEAPI RRenderUpdateGraphicMatrices(RRender *rc) {
    float unused[16];
    if (!r_isContext(rc, __func__))
        return;
    for (RGraphic *rg = rc->m_p3DGraphics; rg; rg = rg->m_pNext)
        (void)r_graphicTransform(rg, unused);
}

void MEAPI RGraphicSetTransformPtr(RGraphic *g, MeMatrix4Ptr matrix) {
    if (r_isGraphic(g, __func__))
        g->m_pLWMatrix = matrix;
}

void MEAPI RGraphicSetColor(RGraphic *g, const float color[4]) {
    if (!r_isGraphic(g, __func__) || !r_isFinite(color, 4, __func__, "color"))
        return;
    RObjectHeader *o = g->m_pObject;
    memcpy(o->m_ColorAmbient, color, sizeof o->m_ColorAmbient);
    memcpy(o->m_ColorDiffuse, color, sizeof o->m_ColorDiffuse);
    memset(o->m_ColorEmissive, 0, sizeof o->m_ColorEmissive);
    memset(o->m_ColorSpecular, 0, sizeof o->m_ColorSpecular);
}

void MEAPI RGraphicGetColor(RGraphic *g, float color[4]) {
    if (r_isGraphic(g, __func__) && r_isPointer(color, __func__, "color"))
        memcpy(color, g->m_pObject->m_ColorAmbient, sizeof g->m_pObject->m_ColorAmbient);
}

void MEAPI RGraphicSetWireframe(RGraphic *g, MeBool b) {
    if (r_isGraphic(g, __func__))
        g->m_pObject->m_bIsWireFrame = b != 0;
}

MeBool MEAPI RGraphicIsWireframe(RGraphic *g) {
    return r_isGraphic(g, __func__) && g->m_pObject->m_bIsWireFrame;
}

static void scaleVertex(RObjectVertex *v, const AcmeReal scale[3]) {
    v->m_X *= scale[0];
    v->m_Y *= scale[1];
    v->m_Z *= scale[2];
    v->m_NX /= scale[0];
    v->m_NY /= scale[1];
    v->m_NZ /= scale[2];
    const AcmeReal length = sqrtf(v->m_NX * v->m_NX + v->m_NY * v->m_NY + v->m_NZ * v->m_NZ);
    if (length > 0) {
        v->m_NX /= length;
        v->m_NY /= length;
        v->m_NZ /= length;
    }
}

void MEAPI RGraphicScale(RGraphic *rg, AcmeReal xScale, AcmeReal yScale, AcmeReal zScale) {
    const AcmeReal scale[3] = {xScale, yScale, zScale};
    if (!r_isGraphic(rg, __func__) || !r_isFinite(scale, 3, __func__, "scale"))
        return;
    if (xScale == 0 || yScale == 0 || zScale == 0) {
        MeWarning(1, "%s: a scale is 0", __func__);
        return;
    }
    for (int i = 0; i < rg->m_pObject->m_nNumVertices; i++)
        scaleVertex(&rg->m_pVertices[i], scale);
}

static void translate(RGraphic *rg, const AcmeReal offset[3]) {
    for (int i = 0; i < rg->m_pObject->m_nNumVertices; i++) {
        rg->m_pVertices[i].m_X += offset[0];
        rg->m_pVertices[i].m_Y += offset[1];
        rg->m_pVertices[i].m_Z += offset[2];
    }
}

void MEAPI RGraphicTranslateVertices(RRender *rc, RGraphic *rg, const MeVector3 offset) {
    if (!r_isContext(rc, __func__) || !r_isGraphic(rg, __func__) || !r_isPointer(offset, __func__, "offset"))
        return;
    const AcmeReal by[3] = {(AcmeReal)offset[0], (AcmeReal)offset[1], (AcmeReal)offset[2]};
    if (r_isFinite(by, 3, __func__, "offset"))
        translate(rg, by);
}

/* The box round a graphic's vertices; false if it has none. */
static bool bounds(const RGraphic *rg, AcmeReal low[3], AcmeReal high[3]) {
    for (int i = 0; i < rg->m_pObject->m_nNumVertices; i++) {
        const AcmeReal p[3] = {rg->m_pVertices[i].m_X, rg->m_pVertices[i].m_Y, rg->m_pVertices[i].m_Z};
        for (int k = 0; k < 3; k++) {
            low[k] = i == 0 || p[k] < low[k] ? p[k] : low[k];
            high[k] = i == 0 || p[k] > high[k] ? p[k] : high[k];
        }
    }
    return rg->m_pObject->m_nNumVertices > 0;
}

void MEAPI RGraphicNormalize(RGraphic *rg, int bKeepAspectRatio) {
    AcmeReal low[3], high[3], middle[3], scale[3], largest = 0;
    if (!r_isGraphic(rg, __func__) || !bounds(rg, low, high))
        return;
    for (int k = 0; k < 3; k++) {
        middle[k] = -0.5f * (low[k] + high[k]);
        largest = fmaxf(largest, high[k] - low[k]);
    }
    if (!isfinite(largest) || largest <= 0) {
        MeWarning(1, "%s: the vertices are in one place, or not finite", __func__);
        return;
    }
    for (int k = 0; k < 3; k++) {
        const AcmeReal size = bKeepAspectRatio || high[k] <= low[k] ? largest : high[k] - low[k];
        scale[k] = 1 / size;
    }
    translate(rg, middle);
    RGraphicScale(rg, scale[0], scale[1], scale[2]);
}

/* Whether all strips are what they say, and how many vertices their triangles have. */
static bool measureStrips(const int *stripSize, const int *stripStart, int numStrips, int64_t *vertices) {
    *vertices = 0;
    for (int i = 0; i < numStrips; i++) {
        if (stripSize[i] < 0 || stripStart[i] < 0)
            return false;
        if (stripSize[i] > 2)
            *vertices += 3 * ((int64_t)stripSize[i] - 2);
    }
    return true;
}

void MEAPI RConvertTriStripToTriList(RGraphic *rg, RObjectVertex *strips, int *stripSize, int *stripStart,
                                     int numStrips) {
    if (!r_isGraphic(rg, __func__) || !r_isPointer(strips, __func__, "strips") ||
        !r_isPointer(stripSize, __func__, "stripSize") || !r_isPointer(stripStart, __func__, "stripStart"))
        return;
    int64_t vertices;
    if (!measureStrips(stripSize, stripStart, numStrips, &vertices)) {
        MeWarning(1, "%s: a strip's size or start is negative", __func__);
        return;
    }
    if (vertices > rg->m_nMaxNumVertices) {
        MeWarning(1, "%s: the graphic has room for %d vertices, the strips need %lld", __func__, rg->m_nMaxNumVertices,
                  (long long)vertices);
        return;
    }
    RObjectVertex *to = rg->m_pVertices;
    for (int i = 0; i < numStrips; i++) {
        const RObjectVertex *from = strips + stripStart[i];
        for (int j = 0; j + 2 < stripSize[i]; j++, to += 3) {
            /* Every other triangle of a strip runs the other way round. */
            to[0] = from[j + j % 2];
            to[1] = from[j + 1 - j % 2];
            to[2] = from[j + 2];
        }
    }
    rg->m_pObject->m_nNumVertices = (int)vertices;
}

static void moveVertex(RObjectVertex *v, const float m[16]) {
    const float p[3] = {v->m_X, v->m_Y, v->m_Z}, n[3] = {v->m_NX, v->m_NY, v->m_NZ};
    float to[6];
    for (int k = 0; k < 3; k++) {
        to[k] = p[0] * m[k] + p[1] * m[4 + k] + p[2] * m[8 + k] + m[12 + k];
        to[3 + k] = n[0] * m[k] + n[1] * m[4 + k] + n[2] * m[8 + k];
    }
    v->m_X = to[0];
    v->m_Y = to[1];
    v->m_Z = to[2];
    v->m_NX = to[3];
    v->m_NY = to[4];
    v->m_NZ = to[5];
}

RGraphic *MEAPI RGraphicCombine(RRender *rc, RGraphic *a, RGraphic *b, MeMatrix4Ptr transform) {
    float m[16];
    if (!r_isContext(rc, __func__) || !r_isGraphic(a, __func__) || !r_isGraphic(b, __func__))
        return NULL;
    if (!r_matrixFloats((const MeVector4 *)transform, m)) {
        MeWarning(1, "%s: transform is not finite", __func__);
        return NULL;
    }
    const int na = a->m_pObject->m_nNumVertices, nb = b->m_pObject->m_nNumVertices;
    if (na > INT_MAX - nb) {
        MeWarning(1, "%s: together the graphics have too many vertices", __func__);
        return NULL;
    }
    RGraphic *rg = r_graphicCreate(__func__, na + nb, rMesh);
    if (!rg)
        return NULL;
    *rg->m_pObject = *a->m_pObject;
    rg->m_pObject->m_nNumVertices = na + nb;
    memcpy(rg->m_pVertices, a->m_pVertices, (size_t)na * sizeof(RObjectVertex));
    memcpy(rg->m_pVertices + na, b->m_pVertices, (size_t)nb * sizeof(RObjectVertex));
    for (int i = na; i < na + nb; i++)
        moveVertex(&rg->m_pVertices[i], m);
    rg->m_pLWMatrix = a->m_pLWMatrix;
    RGraphicAddToList(rc, rg, 0);
    return rg;
}
