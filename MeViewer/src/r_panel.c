/* Panels: the program's, and the viewer's own, which says what is shown. */
#include "r_i.h"
#include "RPanel.h"

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

void MEAPI RPanelShow(RRender *rc, const char *title, MeBool shown) {
    if (!r_isContext(rc, __func__) || !r_isPointer(title, __func__, "title"))
        return;
    RPanel *p = find(&rc->m_pViewer->panelList, title);
    if (!p) {
        MeWarning(1, "%s: there is no panel %s", __func__, title);
        return;
    }
    p->shown = shown != 0;
    if (shown)
        rc->m_pViewer->panelsShown = true;
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
        rc->m_pViewer->loop.pictureAsked = true;
}

static void check(const char *label, bool *value) {
    MeBool on = *value;
    if (RPanelCheck(label, &on))
        *value = on != 0;
}

static void showViewer(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    showRun(rc);
    MeBool bar = r_barIsShown(rc);
    if (RPanelCheck("performance bar (F3)", &bar))
        r_barToggle(rc);
    check("wireframe (F4)", &v->wireframe);
    check("shadows (F5)", &v->shadows);
    if (v->panelList.count)
        RPanelHeading("Panels");
    for (size_t i = 0; i < v->panelList.count; i++)
        check(v->panelList.items[i].title, &v->panelList.items[i].shown);
}

/* Panels stand in a column at the right edge at first; a menu is at the left one. */
void r_panelsDraw(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!v->panelsShown || rc->m_bShowHelp)
        return;
    const float scale = r_uiScale(rc), x = (float)v->width - 300 * scale, step = 30 * scale;
    if (r_uiPanel("Viewer", x, step, &v->panelsShown))
        showViewer(rc);
    r_uiPanelEnd();
    for (size_t i = 0; i < v->panelList.count; i++) { /* A panel may create others: no pointer is kept. */
        const RPanel p = v->panelList.items[i];
        bool shown = p.shown;
        if (!shown)
            continue;
        if (r_uiPanel(p.title, 10 * scale, step * (float)(i + 2), &shown))
            p.func(rc, p.userdata);
        r_uiPanelEnd();
        if (!shown)
            v->panelList.items[i].shown = false;
    }
}
