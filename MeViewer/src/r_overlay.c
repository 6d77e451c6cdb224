/* What is laid over the picture, as triangles in pixels; r_draw_overlay.c hands them to OpenGL. */
#include "r_i.h"

#include <string.h>

#include "r_font_i.h"
#include "r_text_i.h"

const float r_white[4] = {0.96f, 0.97f, 0.98f, 1};
const float r_dimmed[4] = {0.66f, 0.70f, 0.75f, 1};
const float r_accent[4] = {0.55f, 0.78f, 0.98f, 1};
const float r_panel[4] = {0.09f, 0.11f, 0.14f, 0.86f};

void r_overlayClear(ROverlay *overlay) {
    overlay->vertices.count = overlay->runs.count = 0;
}

void r_overlayFree(ROverlay *overlay) {
    r_free(overlay->vertices.items);
    r_free(overlay->runs.items);
}

/* Room for n more vertices with a texture; null when there is no memory. */
static ROverlayVertex *extend(ROverlay *o, size_t n, int texture) {
    const bool fresh = o->runs.count == 0 || o->runs.items[o->runs.count - 1].texture != texture;
    if (!r_grow(o->vertices, n) || (fresh && !r_grow(o->runs, 1)))
        return NULL;
    if (fresh)
        o->runs.items[o->runs.count++] = (ROverlayRun){o->vertices.count, 0, texture};
    o->runs.items[o->runs.count - 1].count += n;
    ROverlayVertex *first = o->vertices.items + o->vertices.count;
    o->vertices.count += n;
    return first;
}

/* A rectangle from its upper left corner to its lower right one. */
static void quad(ROverlay *o, const ROverlayVertex *from, const ROverlayVertex *to) {
    ROverlayVertex *v = extend(o, 6, -1);
    if (!v)
        return;
    for (int i = 0; i < 6; i++) {
        const bool right = i == 1 || i == 2 || i == 4, low = i == 2 || i == 4 || i == 5;
        v[i] = *from;
        if (right) {
            v[i].x = to->x;
            v[i].u = to->u;
        }
        if (low) {
            v[i].y = to->y;
            v[i].v = to->v;
        }
    }
}

void r_overlayBox(ROverlay *overlay, float x, float y, float width, float height, float radius, const float color[4]) {
    const float a = width / 2, b = height / 2;
    ROverlayVertex from = {.x = x - 1, .y = y - 1, .u = -a - 1, .v = -b - 1, .a = a, .b = b, .fill = rFillRounded};
    ROverlayVertex to = {.x = x + width + 1, .y = y + height + 1, .u = a + 1, .v = b + 1};
    from.radius = fminf(radius, fminf(a, b));
    memcpy(from.color, color, sizeof from.color);
    quad(overlay, &from, &to);
}

float r_overlayText(ROverlay *overlay, float x, float y, float size, RTextStyle style, const float color[4],
                    const char *text) {
    const float start = x;
    /* The outline is dark round light text and light round dark text. */
    const float light = 0.3f * color[0] + 0.6f * color[1] + 0.1f * color[2];
    const float outline = style == rTextPlain ? 0 : light > 0.45f ? 0.09f : -0.09f;
    while (*text) {
        const uint32_t code = r_nextCharacter(&text);
        if (code == '\n') {
            x = start;
            y += 1.3f * size;
            continue;
        }
        const RGlyph *g = r_glyph(code);
        ROverlayVertex from = {.x = x + g->left * size, .y = y + g->top * size, .u = g->u0, .v = g->v0};
        const ROverlayVertex to = {.x = x + g->right * size, .y = y + g->bottom * size, .u = g->u1, .v = g->v1};
        from.a = size;
        from.b = outline;
        from.fill = rFillText;
        memcpy(from.color, color, sizeof from.color);
        if (g->u1 > g->u0)
            quad(overlay, &from, &to);
        x += g->advance * size;
    }
    return x;
}

void r_overlayTriangle(ROverlay *overlay, const ROverlayVertex vertices[3], int texture) {
    ROverlayVertex *v = extend(overlay, 3, texture);
    if (v)
        memcpy(v, vertices, 3 * sizeof *v);
}

float r_uiScale(const RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    const float fit = fminf((float)v->width / 960, (float)v->height / 600);
    /* Large windows have larger text, but not in proportion; small ones text that can still be read. */
    return fmaxf(powf(fit, 0.85f), 0.75f);
}
