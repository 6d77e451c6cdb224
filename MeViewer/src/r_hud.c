/* Everything that is laid over the picture, in its order: the 2D list, then what the viewer itself has to say. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

static float opaque(float alpha) {
    return alpha == 0 ? 1 : alpha;
}

static void drawText2D(const RRender *rc, ROverlay *overlay, const RGraphic *rg) {
    const struct RViewer *v = rc->m_pViewer;
    const float size = 16 * r_uiScale(rc);
    float color[4];
    memcpy(color, rg->m_pObject->m_ColorDiffuse, sizeof color);
    color[3] = opaque(color[3]);
    const float x = (0.5f + 0.5f * rg->m_pPart->x) * (float)v->width;
    const float y = (0.5f - 0.5f * rg->m_pPart->y) * (float)v->height;
    r_overlayText(overlay, roundf(x), roundf(y + 0.93f * size), size, rTextOutlined, color, rg->m_pPart->text);
}

static void drawTriangles2D(RRender *rc, ROverlay *overlay, RGraphic *rg) {
    const struct RViewer *v = rc->m_pViewer;
    const RObjectHeader *o = rg->m_pObject;
    const int texture = o->m_nTextureID;
    float m[16];
    if (!r_graphicTransform(rg, m))
        return;
    const int n = o->m_nNumVertices < rg->m_nMaxNumVertices ? o->m_nNumVertices : rg->m_nMaxNumVertices;
    for (int i = 0; i + 2 < n; i += 3) {
        ROverlayVertex t[3];
        for (int k = 0; k < 3; k++) {
            const RObjectVertex *p = &rg->m_pVertices[i + k];
            const float x = p->m_X * m[0] + p->m_Y * m[4] + p->m_Z * m[8] + m[12];
            const float y = p->m_X * m[1] + p->m_Y * m[5] + p->m_Z * m[9] + m[13];
            t[k] = (ROverlayVertex){.x = (0.5f + 0.5f * x) * (float)v->width,
                                    .y = (0.5f - 0.5f * y) * (float)v->height,
                                    .u = p->m_U,
                                    .v = p->m_V,
                                    .fill = texture >= 0 ? rFillTexture : rFillPlain};
            memcpy(t[k].color, o->m_ColorDiffuse, sizeof t[k].color);
            t[k].color[3] = opaque(t[k].color[3]);
        }
        r_overlayTriangle(overlay, t, texture);
    }
}

static void draw2DList(RRender *rc, ROverlay *overlay) {
    const RGraphic *ticks = rc->m_pPerformanceBar ? rc->m_pPerformanceBar->m_pTicks : NULL;
    for (RGraphic *rg = rc->m_p2DGraphics; rg; rg = rg->m_pNext) {
        if (rg->m_pPart->kind == rText)
            drawText2D(rc, overlay, rg);
        else if (rg != ticks)
            drawTriangles2D(rc, overlay, rg);
    }
}

static void drawBar(RRender *rc, ROverlay *overlay) {
    r_barDraw(rc, overlay);
    if (rc->m_pPerformanceBar->m_pTicks)
        drawTriangles2D(rc, overlay, rc->m_pPerformanceBar->m_pTicks);
}

/* Small text on a small panel, with its left or right edge at x. */
static void label(RRender *rc, ROverlay *overlay, float x, float bottom, bool right, const char *text) {
    const float scale = r_uiScale(rc), size = 13 * scale, pad = 6 * scale;
    const float width = r_textWidth(text, size) + 2 * pad, height = 1.2f * size + pad;
    const float left = roundf(right ? x - width : x), top = roundf(bottom - height);
    r_overlayBox(overlay, left, top, roundf(width), roundf(height), 4 * scale, r_panel);
    r_overlayText(overlay, left + pad, roundf(top + 0.5f * pad + 0.95f * size), size, rTextPlain, r_white, text);
}

static void drawLabels(RRender *rc, ROverlay *overlay) {
    enum { HINT_FRAMES = 240 };
    const struct RViewer *v = rc->m_pViewer;
    const float margin = 10 * r_uiScale(rc), right = (float)v->width - margin, bottom = (float)v->height - margin;
    if (v->status)
        label(rc, overlay, margin, bottom, false, v->status);
    if (v->backend->window && v->loop.frames < HINT_FRAMES)
        label(rc, overlay, right, bottom, true, "F1 help");
    else if (v->backend->window && rc->m_bPause && !rc->m_bShowHelp)
        label(rc, overlay, right, bottom, true, "paused: P continues, O one step");
    if (v->fps >= 0) {
        char text[32];
        snprintf(text, sizeof text, "%.1f fps", (double)v->fps);
        label(rc, overlay, right, margin + 24 * r_uiScale(rc), true, text);
    }
}

void r_hudDraw(RRender *rc, ROverlay *overlay) {
    draw2DList(rc, overlay);
    if (r_barIsShown(rc))
        drawBar(rc, overlay);
    if (!rc->m_bShowHelp)
        drawLabels(rc, overlay);
    r_menuDraw(rc, overlay);
    if (rc->m_bShowHelp)
        r_helpDraw(rc, overlay, &rc->m_pViewer->helpLayout);
}
