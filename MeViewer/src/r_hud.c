/* Everything that is laid over the picture, in its order: the 2D list, then what the viewer itself has to say. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

const float r_white[4] = {0.96f, 0.97f, 0.98f, 1};
const float r_dimmed[4] = {0.66f, 0.70f, 0.75f, 1};
const float r_accent[4] = {0.55f, 0.78f, 0.98f, 1};
const float r_panel[4] = {0.09f, 0.11f, 0.14f, 0.86f};

float r_uiScale(const RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    const float fit = fminf((float)v->width / 960, (float)v->height / 600) / v->scale;
    /* Large windows have larger text, but not in proportion; small ones text that can still be read. */
    return v->scale * fmaxf(powf(fit, 0.85f), 0.75f);
}

static float opaque(float alpha) {
    return alpha == 0 ? 1 : alpha;
}

static void drawText2D(const RRender *rc, const RGraphic *rg) {
    const struct RViewer *v = rc->m_pViewer;
    const float size = 16 * r_uiScale(rc);
    float color[4];
    memcpy(color, rg->m_pObject->m_ColorDiffuse, sizeof color);
    color[3] = opaque(color[3]);
    const float x = (0.5f + 0.5f * rg->m_pPart->x) * (float)r_sceneWidth(rc);
    const float y = (0.5f - 0.5f * rg->m_pPart->y) * (float)v->height;
    r_uiText(roundf(x), roundf(y + 0.93f * size), size, 0, rTextOutlined, color, rg->m_pPart->text);
}

static void drawTriangles2D(RRender *rc, RGraphic *rg) {
    const struct RViewer *v = rc->m_pViewer;
    const RObjectHeader *o = rg->m_pObject;
    const float width = (float)r_sceneWidth(rc);
    float m[16];
    if (!r_graphicTransform(rg, m))
        return;
    float color[4];
    memcpy(color, o->m_ColorDiffuse, sizeof color);
    color[3] = opaque(color[3]);
    const int n = o->m_nNumVertices < rg->m_nMaxNumVertices ? o->m_nNumVertices : rg->m_nMaxNumVertices;
    for (int i = 0; i + 2 < n; i += 3) {
        RCorner t[3];
        for (int k = 0; k < 3; k++) {
            const RObjectVertex *p = &rg->m_pVertices[i + k];
            const float x = p->m_X * m[0] + p->m_Y * m[4] + p->m_Z * m[8] + m[12];
            const float y = p->m_X * m[1] + p->m_Y * m[5] + p->m_Z * m[9] + m[13];
            t[k] = (RCorner){(0.5f + 0.5f * x) * width, (0.5f - 0.5f * y) * (float)v->height, p->m_U, p->m_V};
        }
        r_uiTriangle(t, o->m_nTextureID, color);
    }
}

static void draw2DList(RRender *rc) {
    const RGraphic *ticks = rc->m_pPerformanceBar ? rc->m_pPerformanceBar->m_pTicks : NULL;
    for (RGraphic *rg = rc->m_p2DGraphics; rg; rg = rg->m_pNext) {
        if (rg->m_pPart->kind == rText)
            drawText2D(rc, rg);
        else if (rg != ticks)
            drawTriangles2D(rc, rg);
    }
}

static void drawBar(RRender *rc) {
    r_barDraw(rc);
    if (rc->m_pPerformanceBar->m_pTicks)
        drawTriangles2D(rc, rc->m_pPerformanceBar->m_pTicks);
}

/* ---- Labels: small text on small panels ---- */

/* Where the line that begins here has to end; null if all of it fits. Groups of words are two spaces apart: a line ends
 * between two of them, or at a space if one group alone is too long. */
static char *endOfLine(char *begin, float size, float max) {
    char *group = NULL, *space = NULL;
    for (char *at = begin;; at++) {
        const char kept = *at;
        if (kept && kept != ' ' && kept != '\n')
            continue;
        *at = '\0';
        const bool fits = r_uiTextSize(begin, size, 0, NULL) <= max;
        *at = kept;
        if (!fits && space)
            return group ? group : space;
        if (!kept || kept == '\n')
            return kept ? at : NULL;
        space = at;
        if (at[1] == ' ')
            group = at;
        at += strspn(at, " ") - 1;
    }
}

static void breakLines(char *text, float size, float max) {
    for (char *end; (end = endOfLine(text, size, max)) != NULL; text = end + 1) {
        char *next = end + (*end == '\n') + strspn(end, " ");
        *end = '\n';
        memmove(end + 1, next, strlen(next) + 1);
    }
}

typedef struct {
    float left, top, right;
} Label;

static float labelSize(const RRender *rc) {
    return 13 * r_uiScale(rc);
}

/* Its left or right edge is at x. */
static Label labelOf(const RRender *rc, float size, float x, float bottom, bool right, const char *text) {
    const float scale = r_uiScale(rc), pad = 6 * scale;
    float height;
    const float width = r_uiTextSize(text, size, 0, &height) + 2 * pad;
    height += pad;
    const float left = roundf(right ? x - width : x), top = roundf(bottom - height);
    r_uiBox(left, top, roundf(width), roundf(height), 4 * scale, r_panel);
    r_uiText(left + pad, roundf(top + 0.5f * pad + 0.95f * size), size, 0, rTextPlain, r_white, text);
    return (Label){left, top, left + width};
}

static Label label(const RRender *rc, float x, float bottom, bool right, const char *text) {
    return labelOf(rc, labelSize(rc), x, bottom, right, text);
}

/* If the scene is too narrow, in smaller letters; if that is not enough, in several lines. */
static Label labelStatus(const RRender *rc, float left, float bottom, float width) {
    const float room = width - 12 * r_uiScale(rc), small = 11.5f * r_uiScale(rc);
    const bool isLong = r_uiTextSize(rc->m_pViewer->status, labelSize(rc), 0, NULL) > room;
    const bool fitsSmall = r_uiTextSize(rc->m_pViewer->status, small, 0, NULL) <= room;
    const float size = isLong && fitsSmall ? small : labelSize(rc);
    char text[1024];
    snprintf(text, sizeof text, "%s", rc->m_pViewer->status);
    breakLines(text, size, room);
    return labelOf(rc, size, left, bottom, false, text);
}

/* At the right, beside what is there, or above it where there is no room. Returns the bottom of what comes above. */
static float labelBeside(const RRender *rc, Label there, float right, float bottom, const char *text) {
    const float gap = 4 * r_uiScale(rc), width = r_uiTextSize(text, labelSize(rc), 0, NULL) + 3 * gap;
    if (right - width < there.right + gap)
        bottom = fminf(bottom, there.top - gap);
    return label(rc, right, bottom, true, text).top - gap;
}

static const char *hint(const RRender *rc) {
    enum { HINT_FRAMES = 240 };
    if (!rc->m_pViewer->backend->window)
        return NULL;
    if (rc->m_pViewer->loop.frames < HINT_FRAMES)
        return "F1 help, F9 panels";
    return rc->m_bPause ? "paused: P continues, O one step" : NULL;
}

static void drawLabels(const RRender *rc) {
    const double SLOW = 0.95; /* else it would say x1.0 */
    const struct RViewer *v = rc->m_pViewer;
    const float margin = 10 * r_uiScale(rc), right = (float)r_sceneWidth(rc) - margin;
    float bottom = (float)v->height - margin;
    char text[32];
    const Label status =
        v->status ? labelStatus(rc, margin, bottom, right - margin) : (Label){.top = bottom, .right = -margin};
    if (hint(rc))
        bottom = labelBeside(rc, status, right, bottom, hint(rc));
    snprintf(text, sizeof text, "x%.1f", v->loop.clock.pace);
    if (r_isByClock(rc) && !rc->m_bPause && v->loop.clock.pace < SLOW) /* slower than the clock */
        labelBeside(rc, status, right, bottom, text);
    snprintf(text, sizeof text, "%.1f fps", (double)v->fps);
    if (v->fps >= 0)
        label(rc, right, margin + 24 * r_uiScale(rc), true, text);
}

/* A sign that nothing moves: two bars, in the middle of the picture's upper edge. */
static void drawPauseSign(const RRender *rc) {
    static const float faint[4] = {0.09f, 0.11f, 0.14f, 0.55f};
    const float scale = r_uiScale(rc), width = 9 * scale, height = 30 * scale;
    const float x = (float)r_sceneWidth(rc) / 2, y = 16 * scale;
    r_uiBox(x - 2 * width, y - 8 * scale, 4 * width, height + 16 * scale, 8 * scale, faint);
    r_uiBox(x - 1.25f * width, y, width, height, 2 * scale, r_white);
    r_uiBox(x + 0.25f * width, y, width, height, 2 * scale, r_white);
}

void r_overlayFree(ROverlay *overlay) {
    r_free(overlay->vertices.items);
    r_free(overlay->indices.items);
    r_free(overlay->runs.items);
}

static bool drawAll(RRender *rc, ROverlay *overlay) {
    r_panelsBegin(rc);
    r_marksDraw(rc);
    draw2DList(rc);
    if (r_barIsShown(rc))
        drawBar(rc);
    if (!rc->m_bShowHelp)
        drawLabels(rc);
    if (rc->m_bPause && !rc->m_bShowHelp)
        drawPauseSign(rc);
    r_menuDraw(rc);
    r_panelsDraw(rc);
    if (rc->m_bShowHelp)
        r_helpDraw(rc, &rc->m_pViewer->helpLayout);
    return r_panelsEnd(rc, overlay);
}

/* Off-screen there may be one picture only: a list that opens in it has to be measured before. */
void r_hudDraw(RRender *rc, ROverlay *overlay) {
    enum { TRIES = 3 };
    rc->m_pViewer->overlaying = true;
    for (int i = 0; i < TRIES && !drawAll(rc, overlay);)
        i++;
    rc->m_pViewer->overlaying = false;
}
