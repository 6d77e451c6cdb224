/* Lines: native ones, those of RLineAdd, and lines as graphics. All end as segments in world coordinates. */
#include "r_i.h"

#include <string.h>

RGraphic *MEAPI RGraphicLineCreate(RRender *rc, const AcmeReal origin[3], const AcmeReal end[3], const float color[4],
                                   MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, __func__) || !r_isFinite(origin, 3, __func__, "origin") ||
        !r_isFinite(end, 3, __func__, "end"))
        return NULL;
    RGraphic *rg = r_graphicCreate(__func__, 3, rLine); /* A triangle without area: both ends, the second twice. */
    if (rg)
        RGraphicLineMoveEnds(rg, origin, end);
    return r_graphicFinish(__func__, rc, rg, color, matrix, false);
}

int MEAPI RGraphicLineMoveEnds(RGraphic *lineG, const AcmeReal *origin, const AcmeReal *end) {
    if (!r_isGraphic(lineG, __func__) || !r_isFinite(origin, 3, __func__, "origin") ||
        !r_isFinite(end, 3, __func__, "end"))
        return 1;
    if (lineG->m_pPart->kind != rLine) {
        MeWarning(1, "%s: the graphic is not a line", __func__);
        return 1;
    }
    for (int i = 0; i < 3; i++) {
        const AcmeReal *p = i ? end : origin;
        lineG->m_pVertices[i] = (RObjectVertex){p[0], p[1], p[2], 0, 1, 0, 0, 0};
    }
    return 0;
}

RNativeLine *MEAPI RNLineCreate(RRender *const rc, const AcmeReal start[3], const AcmeReal end[3],
                                const AcmeReal color[4], const MeVector4 *const matrix) {
    if (!r_isContext(rc, __func__) || !r_isFinite(start, 3, __func__, "start") ||
        !r_isFinite(end, 3, __func__, "end") || !r_isFinite(color, 4, __func__, "color"))
        return NULL;
    RNativeLine *line = r_alloc(sizeof *line);
    if (!line)
        return NULL;
    RNLineMoveEnds(line, start, end);
    RNLineSetColor(line, color);
    line->m_pLWMatrix = matrix;
    RNLineAddToList(rc, line);
    return line;
}

void MEAPI RNLineMoveEnds(RNativeLine *const line, const AcmeReal start[3], const AcmeReal end[3]) {
    if (!r_isPointer(line, __func__, "line") || !r_isFinite(start, 3, __func__, "start") ||
        !r_isFinite(end, 3, __func__, "end"))
        return;
    memcpy(line->m_Vectors.m_Start, start, sizeof line->m_Vectors.m_Start);
    memcpy(line->m_Vectors.m_End, end, sizeof line->m_Vectors.m_End);
}

void MEAPI RNLineSetColor(RNativeLine *line, const AcmeReal color[4]) {
    if (r_isPointer(line, __func__, "line") && r_isFinite(color, 4, __func__, "color"))
        memcpy(line->m_Color, color, sizeof line->m_Color);
}

void MEAPI RNLineAddToList(RRender *rc, RNativeLine *line) {
    if (!r_isContext(rc, __func__) || !r_isPointer(line, __func__, "line"))
        return;
    if (line->m_pRender) {
        MeWarning(1, "%s: the line is in a list already", __func__);
        return;
    }
    RNativeLine **last = &rc->m_pViewer->lastLine;
    *(*last ? &(*last)->m_pNext : &rc->m_pNativeLines) = line;
    *last = line;
    line->m_pNext = NULL;
    line->m_pRender = rc;
}

static void unlinkLine(RNativeLine *line) {
    RRender *rc = line->m_pRender;
    RNativeLine *before = NULL;
    MEASSERT(r_isLive(rc));
    for (RNativeLine *l = rc->m_pNativeLines; l != line; l = l->m_pNext) {
        MEASSERT(l); /* A line that names the context is in its list. */
        before = l;
    }
    *(before ? &before->m_pNext : &rc->m_pNativeLines) = line->m_pNext;
    if (!line->m_pNext)
        rc->m_pViewer->lastLine = before;
    line->m_pNext = NULL;
    line->m_pRender = NULL;
}

static bool isInList(const RRender *rc, const RNativeLine *line, const char *function) {
    if (!r_isContext(rc, function) || !r_isPointer(line, function, "line"))
        return false;
    if (line->m_pRender != rc)
        MeWarning(1, "%s: the line is not in the context's list", function);
    return line->m_pRender == rc;
}

void MEAPI RNLineRemoveFromList(RRender *rc, RNativeLine *line) {
    if (isInList(rc, line, __func__))
        unlinkLine(line);
}

void MEAPI RNLineDestroy(RNativeLine *line) {
    if (!r_isPointer(line, __func__, "line"))
        return;
    if (line->m_pRender)
        unlinkLine(line);
    r_free(line);
}

void MEAPI RNLineDelete(RRender *rc, RNativeLine *line) {
    if (isInList(rc, line, __func__))
        RNLineDestroy(line);
}

void MEAPI RLineAdd(RRender *const rc, const AcmeVector3 start, const AcmeVector3 end, const AcmeReal r,
                    const AcmeReal g, const AcmeReal b) {
    const AcmeReal color[4] = {r, g, b, 1};
    if (!r_isContext(rc, __func__) || !r_isFinite(start, 3, __func__, "start") ||
        !r_isFinite(end, 3, __func__, "end") || !r_isFinite(color, 3, __func__, "color") ||
        !r_grow(rc->m_pViewer->lines, 1))
        return;
    RLineSegment *s = &rc->m_pViewer->lines.items[rc->m_pViewer->lines.count++];
    memcpy(s->a, start, sizeof s->a);
    memcpy(s->b, end, sizeof s->b);
    memcpy(s->color, color, sizeof s->color);
}

void MEAPI RLineRemoveAll(RRender *rc) {
    if (r_isContext(rc, __func__))
        rc->m_pViewer->lines.count = 0;
}

void r_debugLine(RRender *rc, const MeVector3 start, const MeVector3 end, MeReal r, MeReal g, MeReal b) {
    struct RViewer *v = rc->m_pViewer;
    RLineSegment s = {.color = {(float)r, (float)g, (float)b, 1}};
    bool finite = true;
    for (int i = 0; i < 3; i++) {
        s.a[i] = (float)start[i];
        s.b[i] = (float)end[i];
        finite &= isfinite(s.a[i]) && isfinite(s.b[i]) && isfinite(s.color[i]);
    }
    if (finite && v->loop.frames > 0 && r_grow(v->debugLines, 1))
        v->debugLines.items[v->debugLines.count++] = s;
}

void r_debugLinesForget(RRender *rc) {
    rc->m_pViewer->debugLines.count = 0;
}

void r_linesFree(RRender *rc) {
    while (rc->m_pNativeLines)
        RNLineDestroy(rc->m_pNativeLines);
    r_free(rc->m_pViewer->lines.items);
    r_free(rc->m_pViewer->debugLines.items);
}

static bool addSegment(RLineSegments *out, const float m[16], const float a[3], const float b[3],
                       const float color[4]) {
    if (!r_grow(*out, 1))
        return false;
    RLineSegment *s = &out->items[out->count++];
    for (int k = 0; k < 3; k++) {
        s->a[k] = a[0] * m[k] + a[1] * m[4 + k] + a[2] * m[8 + k] + m[12 + k];
        s->b[k] = b[0] * m[k] + b[1] * m[4 + k] + b[2] * m[8 + k] + m[12 + k];
    }
    memcpy(s->color, color, sizeof s->color);
    return true;
}

static void collectGraphics(RRender *rc, RLineSegments *out) {
    float m[16];
    for (RGraphic *rg = rc->m_p3DGraphics; rg; rg = rg->m_pNext) {
        if (rg->m_pPart->kind != rLine || !r_graphicTransform(rg, m))
            continue;
        const RObjectVertex *v = rg->m_pVertices;
        const float a[3] = {v[0].m_X, v[0].m_Y, v[0].m_Z}, b[3] = {v[1].m_X, v[1].m_Y, v[1].m_Z};
        addSegment(out, m, a, b, rg->m_pObject->m_ColorDiffuse);
    }
}

static void addSegments(RLineSegments *out, const RLineSegment *segments, size_t count) {
    if (!count || !r_grow(*out, count))
        return;
    memcpy(out->items + out->count, segments, count * sizeof *segments);
    out->count += count;
}

void r_linesCollect(RRender *rc, RLineSegments *out) {
    float m[16];
    const struct RViewer *v = rc->m_pViewer;
    for (const RNativeLine *l = rc->m_pNativeLines; l; l = l->m_pNext)
        if (r_matrixFloats(l->m_pLWMatrix, m))
            addSegment(out, m, l->m_Vectors.m_Start, l->m_Vectors.m_End, l->m_Color);
    collectGraphics(rc, out);
    addSegments(out, v->lines.items, v->lines.count);
    addSegments(out, v->debugLines.items, v->debugLines.count);
}
