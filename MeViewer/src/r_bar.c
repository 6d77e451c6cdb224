/* The performance bar: what it measures and how it looks. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

#include "MeProfile.h"

/* Its place in the window, in 2D coordinates; the budget of a frame is as long as the whole bar. */
static const AcmeReal barLeft = -0.975f, barWidth = 0.5f, barTop = 0.965f, barHeight = 0.018f;
static const AcmeReal budget = 1.0f / 60;

static const float collisionColor[4] = {0.90f, 0.58f, 0.20f, 1}, dynamicsColor[4] = {0.36f, 0.64f, 0.90f, 1},
                   renderColor[4] = {0.30f, 0.72f, 0.58f, 1}, groundColor[4] = {0.09f, 0.11f, 0.14f, 0.55f};

/* Whether the program has started the profile itself. There is no function to ask, so a section is tried. */
static bool profileRuns(void) {
    MeProfileStartFrame();
    MeProfileStartSection("Render", 0);
    MeProfileEndSection("Render");
    MeProfileEndFrame();
    return MeProfileGetSectionTime("Render") > 0;
}

void r_profileStart(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (v->profiling)
        return;
    v->profiling = true;
    v->profileIsOurs = !profileRuns();
    if (v->profileIsOurs)
        MeProfileStartTiming((MeProfileTimerMode){kMeProfileCounterModeFlops}, kMeProfileLogTotals);
}

/* Somebody looks at the bar, or asked for it: only then are frames timed, and all of them drawn. */
static bool canBeSeen(const RRender *rc) {
    const RBackend *backend = rc->m_pViewer->backend;
    return backend && (backend->window || rc->m_Options.m_bBar);
}

void r_barStart(RRender *rc) {
    if (rc->m_pPerformanceBar && canBeSeen(rc))
        r_profileStart(rc);
}

RPerformanceBar *MEAPI RPerformanceBarCreate(RRender *rc) {
    if (!r_isContext(rc, __func__))
        return NULL;
    if (rc->m_pPerformanceBar)
        return rc->m_pPerformanceBar;
    RPerformanceBar *bar = r_alloc(sizeof *bar);
    if (!bar)
        return NULL;
    bar->m_bVisible = 1;
    rc->m_pPerformanceBar = bar;
    r_barStart(rc);
    return bar;
}

void r_barFree(RRender *rc) {
    r_free(rc->m_pPerformanceBar);
    rc->m_pPerformanceBar = NULL;
    if (rc->m_pViewer->profileIsOurs)
        MeProfileStopTiming();
    rc->m_pViewer->profiling = false;
}

void MEAPI RPerformanceBarUpdate(RRender *rc, AcmeReal coltime, AcmeReal dyntime, AcmeReal rentime, AcmeReal idletime) {
    const AcmeReal times[4] = {coltime, dyntime, rentime, idletime};
    if (!r_isContext(rc, __func__) || !r_isFinite(times, 4, __func__, "the times"))
        return;
    RPerformanceBar *bar = rc->m_pPerformanceBar;
    if (!bar) {
        MeWarning(1, "%s: there is no performance bar (RPerformanceBarCreate)", __func__);
        return;
    }
    bar->m_Collision = coltime;
    bar->m_Dynamics = dyntime;
    bar->m_Render = rentime;
    bar->m_Idle = idletime;
    rc->m_pViewer->bar.given = true;
}

/* The figures are averages over a quarter of a second, or nobody could read them; two frames if one takes longer. */
void r_barFrame(RRender *rc) {
    enum { PERIOD = 250000000 };
    RBarState *s = &rc->m_pViewer->bar;
    RPerformanceBar *bar = rc->m_pPerformanceBar;
    const int64_t now = r_now();
    if (s->frames == 0)
        s->begin = now;
    s->collision += (double)MeProfileGetSectionTime("Collision");
    s->dynamics += (double)MeProfileGetSectionTime("Dynamics");
    s->render += (double)MeProfileGetSectionTime("Render");
    if (++s->frames < 2 || now - s->begin < PERIOD)
        return;
    const double n = s->frames, period = (double)(now - s->begin) * 1e-9 / (n - 1);
    s->fps = period > 0 ? 1 / period : 0;
    if (bar && !s->given) {
        bar->m_Collision = (AcmeReal)(s->collision / n);
        bar->m_Dynamics = (AcmeReal)(s->dynamics / n);
        bar->m_Render = (AcmeReal)(s->render / n);
        bar->m_Idle = (AcmeReal)fmax(0, period - (s->collision + s->dynamics + s->render) / n);
    }
    *s = (RBarState){.fps = s->fps};
}

RGraphic *MEAPI RPerformanceBarCreateTicks(RRender *rc) {
    static const float white[4] = {0.96f, 0.97f, 0.98f, 0.8f};
    enum { TICKS = 5 };
    if (!r_isContext(rc, __func__))
        return NULL;
    RPerformanceBar *bar = rc->m_pPerformanceBar;
    if (!bar || bar->m_pTicks) {
        if (!bar)
            MeWarning(1, "%s: there is no performance bar (RPerformanceBarCreate)", __func__);
        return bar ? bar->m_pTicks : NULL;
    }
    RGraphic *rg = r_graphicCreate(__func__, 6 * TICKS, rMesh);
    for (int i = 0; rg && i < 6 * TICKS; i++) {
        static const AcmeReal corners[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
        const AcmeReal x = barLeft + barWidth * (AcmeReal)(i / 6) / (TICKS - 1) + 0.002f * corners[i % 6][0];
        rg->m_pVertices[i] =
            (RObjectVertex){x, barTop - barHeight * (0.6f + 0.8f * corners[i % 6][1]), 0, 0, 0, 1, 0, 0};
    }
    bar->m_pTicks = r_graphicFinish(__func__, rc, rg, white, NULL, true);
    return bar->m_pTicks;
}

/* A length of the bar for some seconds; what is more than twice the budget is cut. Returns where it ends. */
static float drawPart(float x, float y, float height, float perSecond, AcmeReal seconds, float max,
                      const float color[4]) {
    const float end = fminf(x + fmaxf(0, seconds) * perSecond, max);
    if (end > x)
        r_uiBox(x, y, end - x, height, 0, color);
    return end;
}

static float drawLegend(float x, float y, float size, const float color[4], const char *name, double value,
                        const char *unit) {
    char text[64];
    snprintf(text, sizeof text, "%s %.*f%s", name, value < 10 ? 2 : 1, value, unit);
    r_uiBox(x, y - 0.65f * size, 0.6f * size, 0.6f * size, 0.15f * size, color);
    r_uiText(x + 0.9f * size, y, size, 0, rTextPlain, r_white, text);
    snprintf(text, sizeof text, "%s 000.0%s", name, unit); /* Columns that do not dance with the figures. */
    return x + 1.9f * size + r_uiTextSize(text, size, 0, NULL);
}

void r_barToggle(RRender *rc) {
    if (rc->m_pPerformanceBar)
        rc->m_pPerformanceBar->m_bVisible = !rc->m_pPerformanceBar->m_bVisible;
    else
        RPerformanceBarCreate(rc);
}

bool r_barIsShown(const RRender *rc) {
    return rc->m_pPerformanceBar && rc->m_pPerformanceBar->m_bVisible && canBeSeen(rc);
}

void r_barDraw(RRender *rc) {
    const RPerformanceBar *bar = rc->m_pPerformanceBar;
    const struct RViewer *v = rc->m_pViewer;
    const float w = (float)r_sceneWidth(rc), h = (float)v->height, scale = r_uiScale(rc);
    const float size = fminf(11.5f * scale, 0.94f * w / 42);
    const float left = (0.5f + 0.5f * barLeft) * w, top = (0.5f - 0.5f * barTop) * h;
    const float width = 0.5f * barWidth * w, height = fmaxf(0.5f * barHeight * h, 3);
    const float pad = 6 * scale, perSecond = width / budget, max = left + 1.6f * width;
    const float panelWidth = fmaxf(1.6f * width, 41 * size);
    r_uiBox(left - pad, top - pad, panelWidth + 2 * pad, height + 1.9f * size + 2 * pad, 5 * scale, r_panel);
    r_uiBox(left, top, width, height, 0, groundColor);
    float x = drawPart(left, top, height, perSecond, bar->m_Collision, max, collisionColor);
    x = drawPart(x, top, height, perSecond, bar->m_Dynamics, max, dynamicsColor);
    drawPart(x, top, height, perSecond, bar->m_Render, max, renderColor);
    r_uiBox(left + width - scale, top - 0.4f * pad, 2 * scale, height + 0.8f * pad, 0, r_white);
    const float y = roundf(top + height + 1.6f * size);
    x = drawLegend(left, y, size, collisionColor, "collision", 1e3 * (double)bar->m_Collision, " ms");
    x = drawLegend(x, y, size, dynamicsColor, "dynamics", 1e3 * (double)bar->m_Dynamics, " ms");
    x = drawLegend(x, y, size, renderColor, "render", 1e3 * (double)bar->m_Render, " ms");
    drawLegend(x, y, size, r_white, "fps", v->bar.fps, "");
}
