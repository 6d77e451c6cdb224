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
    check("wireframe (F4)", &v->wireframe);
    check("shadows (F5)", &v->shadows);
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

/* Where the next panel that is new is put: below the one before, or in the next column. */
typedef struct {
    float x, y, right;
} Place;

/* One panel: its size is known after its first picture, so that it is put in two. False if the user has closed it. */
static bool drawPanel(RRender *rc, Place *place, const char *title, int *seen, RPanelCallBack func, void *userdata) {
    enum { FINDS_ITS_SIZE = 2 };
    const float scale = r_uiScale(rc), gap = 10 * scale;
    bool shown = true;
    float right, bottom;
    if (r_uiPanel(title, place->x, place->y, *seen < FINDS_ITS_SIZE, &shown))
        func(rc, userdata);
    r_uiPanelEnd(&right, &bottom);
    if (bottom > (float)rc->m_pViewer->height && place->y > 40 * scale && *seen < FINDS_ITS_SIZE) {
        place->x = place->right + gap;
        place->y = 30 * scale;
        r_uiPanelMove(title, place->x, place->y, &right, &bottom);
        rc->m_pViewer->panelMoved = true;
    }
    *seen += *seen < FINDS_ITS_SIZE;
    place->y = bottom + gap;
    place->right = fmaxf(place->right, right);
    return shown;
}

static void MEAPI drawOwn(RRender *rc, void *userdata) {
    (void)userdata;
    showViewer(rc);
}

/* The viewer's own stands at the right edge, the others at the left one, below the place of the bar. */
void r_panelsDraw(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (rc->m_bShowHelp)
        return;
    const float scale = r_uiScale(rc);
    Place own = {.x = (float)v->width - 300 * scale, .y = 30 * scale}, place = {.x = 10 * scale, .y = 60 * scale};
    if (v->panelsShown)
        v->panelsShown = drawPanel(rc, &own, "Viewer", &v->ownPanelSeen, drawOwn, NULL);
    for (size_t i = 0; i < v->panelList.count; i++) { /* A panel may create or destroy others. */
        RPanel p = v->panelList.items[i];
        if (!p.pinned && !(p.shown && v->panelsShown))
            continue;
        const bool shown = drawPanel(rc, &place, p.title, &p.seen, p.func, p.userdata);
        if (i >= v->panelList.count || v->panelList.items[i].title != p.title)
            continue; /* It has been destroyed. */
        v->panelList.items[i].seen = p.seen;
        if (!shown)
            v->panelList.items[i].shown = v->panelList.items[i].pinned = false;
    }
}
