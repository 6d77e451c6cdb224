/* Panels: the program's, and the viewer's own, which says what is shown. */
#include "r_i.h"
#include "RPanel.h"

#include <stdio.h>
#include <string.h>

static RPanel *find(RPanelList *list, const char *title) {
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->items[i].title, title) == 0)
            return &list->items[i];
    return NULL;
}

void MEAPI RPanelCreate(RRender *rc, const char *title, RPanelCallBack func, void *userdata) {
    if (!r_isContext(rc, __func__) || !r_isPointer(title, __func__, "title"))
        return;
    if (!func) {
        MeWarning(1, "%s: func is null", __func__);
        return;
    }
    RPanelList *list = &rc->m_pViewer->panelList;
    RPanel *p = find(list, title);
    if (!p) {
        char *copy = r_grow(*list, 1) ? r_copyText(title) : NULL;
        if (!copy)
            return;
        p = &list->items[list->count++];
        *p = (RPanel){.title = copy, .shown = true};
    }
    p->func = func;
    p->userdata = userdata;
}

void MEAPI RPanelDestroy(RRender *rc, const char *title) {
    if (!r_isContext(rc, __func__) || !r_isPointer(title, __func__, "title"))
        return;
    RPanelList *list = &rc->m_pViewer->panelList;
    RPanel *p = find(list, title);
    if (!p)
        return;
    r_free(p->title);
    const size_t after = list->count - (size_t)(p - list->items) - 1;
    memmove(p, p + 1, after * sizeof *p);
    list->count--;
}

void MEAPI RPanelShow(RRender *rc, const char *title, MeBool shown) {
    if (!r_isContext(rc, __func__) || !r_isPointer(title, __func__, "title"))
        return;
    RPanel *p = find(&rc->m_pViewer->panelList, title);
    if (!p) {
        MeWarning(1, "%s: there is no panel %s", __func__, title);
        return;
    }
    p->shown = p->pinned = shown != 0;
}

/* F9: shows all; then hides them, those that RPanelShow has shown too. */
void r_panelsToggle(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    v->panelsShown = !v->panelsShown;
    for (size_t i = 0; !v->panelsShown && i < v->panelList.count; i++)
        v->panelList.items[i].pinned = false;
}

void r_panelListFree(RPanelList *list) {
    for (size_t i = 0; i < list->count; i++)
        r_free(list->items[i].title);
    r_free(list->items);
    *list = (RPanelList){0};
}

/* ---- The viewer's own ---- */

static void showRun(RRender *rc) {
    if (RPanelButton(rc->m_bPause ? "Play (P)" : "Pause (P)"))
        RRenderSetPause(rc, !rc->m_bPause);
    RPanelSameLine();
    if (RPanelButton("Step (O)")) {
        RRenderSetPause(rc, 1);
        rc->m_pViewer->loop.step = true;
    }
    RPanelSameLine();
    if (RPanelButton("Picture (F2)"))
        rc->m_pViewer->loop.pictureRequested = true;
}

bool r_tickIsDue(const RRender *rc) {
    const int slow = rc->m_pViewer->slow;
    return slow < 2 || rc->m_pViewer->loop.frames % slow == 0;
}

/* Slow motion, and the steps that there are in a second of the clock. */
static void showPace(RRender *rc) {
    static const char *const names[] = {"1x", "1/2x", "1/4x", "1/8x", "1/16x"};
    enum { SPEEDS = sizeof names / sizeof names[0] };
    struct RViewer *v = rc->m_pViewer;
    int which = 0;
    while (which < SPEEDS - 1 && 1 << which < v->slow)
        which++;
    if (RPanelChoice("speed", &which, names, SPEEDS))
        v->slow = 1 << which;
    const int64_t elapsed = r_now() - v->rateBegin;
    if (elapsed > 500000000) {
        v->rate = v->rateBegin ? (float)(v->loop.ticks - v->rateTicks) * 1e9f / (float)elapsed : 0;
        v->rateTicks = v->loop.ticks;
        v->rateBegin += elapsed;
    }
    char text[48];
    snprintf(text, sizeof text, "tick %d, %.0f a second", v->loop.ticks, (double)v->rate);
    RPanelText(text);
}

static void check(const char *label, bool *value) {
    MeBool on = *value;
    if (RPanelCheck(label, &on))
        *value = on != 0;
}

/* The keys that a line of the help names before its text, as buttons that press them; then the text. */
static void showLine(RRender *rc, const char *line) {
    const char *end = strstr(line, " - ");
    int keys = 0;
    for (const char *at = line; end && at < end; at++) {
        const size_t length = *at == '$' ? strspn(at + 1, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") : 0;
        char name[24], label[64], keyName[32];
        if (length == 0 || length + 2 > sizeof name)
            continue;
        snprintf(name, sizeof name, "%.*s", (int)length + 1, at);
        RParseText(rc, name, keyName, sizeof keyName);
        const int key = r_keyByName(keyName, strlen(keyName));
        if (key == RKEY_NONE)
            continue; /* The mouse, or no variable. */
        snprintf(label, sizeof label, "%s##%p", keyName, (const void *)at);
        if (RPanelButton(label)) {
            r_post(rc, (REvent){.kind = rKeyDown, .key = key});
            r_post(rc, (REvent){.kind = rKeyUp, .key = key});
        }
        RPanelSameLine();
        keys++;
    }
    if (keys)
        RPanelText(end + 3);
}

static void showQuality(RRender *rc) {
    static const char *const names[] = {"auto", "fastest", "fast", "no antialiasing", "full"};
    if (rc->m_Options.m_bQuality) /* It wins. */
        return;
    int which = r_pictureQuality(rc) - R_QUALITY_AUTO;
    if (RPanelChoice("picture", &which, names, sizeof names / sizeof names[0]))
        RRenderSetPictureQuality(rc, which + R_QUALITY_AUTO);
}

static void showGround(RRender *rc) {
    static const char *const names[] = {"default", "grid", "checker", "plain", "earth"};
    if (rc->m_Options.m_Ground >= 0) /* It wins. */
        return;
    int which = RRenderGetGroundLook(rc) + 1;
    if (RPanelChoice("ground", &which, names, sizeof names / sizeof names[0]))
        RRenderSetGroundLook(rc, which - 1);
}

static void showViewer(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    showRun(rc);
    showPace(rc);
    MeBool bar = r_barIsShown(rc);
    if (RPanelCheck("performance bar (F3)", &bar))
        r_barToggle(rc);
    check("shadows (F5)", &v->shadows);
    RPanelSameLine();
    check("wireframe (F4)", &v->wireframe);
    check("camera goes below the ground", &v->camera.goesBelow);
    showQuality(rc);
    showGround(rc);
    if (v->help.lines.count && RPanelSection("This program's keys"))
        for (size_t i = 0; i < v->help.lines.count; i++)
            showLine(rc, v->help.lines.items[i]);
    if (v->panelList.count)
        RPanelHeading("Panels");
    for (size_t i = 0; i < v->panelList.count; i++)
        check(v->panelList.items[i].title, &v->panelList.items[i].shown);
}

/* ---- The dock: a column at the right edge of the window ---- */

static bool isVisible(const RRender *rc, const RPanel *p) {
    return p->pinned || (p->shown && rc->m_pViewer->panelsShown);
}

static bool hasVisible(const RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    bool has = v->panelsShown;
    for (size_t i = 0; i < v->panelList.count; i++)
        has |= isVisible(rc, &v->panelList.items[i]);
    return has && v->panels && !rc->m_bShowHelp;
}

int r_sceneWidth(const RRender *rc) {
    const int width = rc->m_pViewer->width, dock = (int)lroundf(288 * r_uiScale(rc));
    return hasVisible(rc) ? width - (dock < width / 2 ? dock : width / 2) : width;
}

/* What is opened while others are there may be below them. */
static bool isNew(const struct RViewer *v, int drawnIn) {
    return drawnIn < v->loop.frames - 1 && v->dockDrawnIn >= v->loop.frames - 1;
}

static bool drawPanel(RRender *rc, const char *title, bool isNewlyShown, RPanelCallBack func, void *userdata) {
    bool shown = true;
    if (r_uiPanel(title, isNewlyShown, &shown))
        func(rc, userdata);
    r_uiPanelEnd();
    return shown;
}

static void MEAPI drawOwn(RRender *rc, void *userdata) {
    (void)userdata;
    showViewer(rc);
}

/* The item of the list is copied: a panel may create or destroy others. */
static void drawListed(RRender *rc, size_t i) {
    RPanelList *list = &rc->m_pViewer->panelList;
    const RPanel p = list->items[i];
    const bool shown = drawPanel(rc, p.title, isNew(rc->m_pViewer, p.drawnIn), p.func, p.userdata);
    if (i >= list->count || list->items[i].title != p.title)
        return;
    list->items[i].drawnIn = rc->m_pViewer->loop.frames;
    if (!shown)
        list->items[i].shown = list->items[i].pinned = false;
}

void r_panelsDraw(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!hasVisible(rc))
        return;
    const float left = (float)r_sceneWidth(rc);
    r_uiDock(left, 0, (float)v->width - left, (float)v->height);
    if (v->panelsShown)
        v->panelsShown = drawPanel(rc, "Viewer", false, drawOwn, NULL);
    for (size_t i = 0; i < v->panelList.count; i++)
        if (isVisible(rc, &v->panelList.items[i]))
            drawListed(rc, i);
    r_uiDockEnd();
    v->dockDrawnIn = v->loop.frames;
}
