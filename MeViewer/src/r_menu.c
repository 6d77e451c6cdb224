/* Menus: their entries, the one that is shown, and how it looks. */
#include "r_i.h"
#include "RMenu.h"

#include <stdio.h>

/* All live menus, of all contexts: a menu that a program destroys after its context is not there any more. */
static RMenu *menus;

static bool isLiveMenu(const RMenu *rm) {
    for (const RMenu *m = menus; m; m = m->m_pNext)
        if (m == rm)
            return true;
    return false;
}

static bool isMenu(const RMenu *rm, const char *function) {
    if (!r_isPointer(rm, function, "the menu"))
        return false;
    if (isLiveMenu(rm))
        return true;
    MeWarning(1, "%s: the menu has been destroyed, or is none", function);
    return false;
}

RMenu *MEAPI RMenuCreate(RRender *rc, const char *name) {
    if (!r_isContext(rc, __func__) || !r_isPointer(name, __func__, "name"))
        return NULL;
    RMenu *rm = r_alloc(sizeof *rm);
    if (!rm)
        return NULL;
    rm->m_pRender = rc;
    rm->m_Name = r_copyText(name);
    rm->m_pNext = menus;
    menus = rm;
    return rm;
}

static void executeSubmenu(RMenuBaseEntry *entry);

/* Nothing may lead to a menu that goes away. */
static void forget(RRender *rc, const RMenu *rm) {
    if (rc->m_pCurrentMenu == rm)
        rc->m_pCurrentMenu = NULL;
    if (rc->m_pDefaultMenu == rm)
        rc->m_pDefaultMenu = NULL;
    if (rc->m_pViewer->clicked && rc->m_pViewer->clicked->m_pMenu == rm)
        rc->m_pViewer->clicked = NULL;
    for (RMenu *other = menus; other; other = other->m_pNext) {
        if (other->m_pParent == rm)
            other->m_pParent = NULL;
        for (RMenuBaseEntry *e = other->m_pFirst; e; e = e->m_pNext)
            if (e->m_Execute1 == executeSubmenu && ((RMenuSubmenuEntry *)e)->m_pSubmenu == rm)
                ((RMenuSubmenuEntry *)e)->m_pSubmenu = NULL;
    }
}

static void freeMenu(RMenu *rm) {
    while (rm->m_pFirst) {
        RMenuBaseEntry *e = rm->m_pFirst;
        rm->m_pFirst = e->m_pNext;
        r_free(e->m_Name);
        r_free(e);
    }
    r_free(rm->m_Name);
    r_free(rm);
}

void MEAPI RMenuDestroy(RMenu *rm) {
    /* Programs destroy menus after the context that has taken them along: that deserves no word. */
    if (!r_isPointer(rm, __func__, "the menu") || !isLiveMenu(rm))
        return;
    MEASSERT(r_isLive(rm->m_pRender));
    RRender *rc = rm->m_pRender;
    RMenu **link = &menus;
    while (*link != rm)
        link = &(*link)->m_pNext;
    *link = rm->m_pNext;
    forget(rc, rm);
    freeMenu(rm);
}

void r_menusFree(RRender *rc) {
    RMenu **link = &menus;
    while (*link) {
        RMenu *rm = *link;
        if (rm->m_pRender == rc) {
            *link = rm->m_pNext;
            freeMenu(rm);
        } else {
            link = &rm->m_pNext;
        }
    }
}

void MEAPI RMenuDisplay(RMenu *rm) {
    if (isMenu(rm, __func__))
        rm->m_pRender->m_pCurrentMenu = rm;
}

void MEAPI RRenderSetDefaultMenu(RRender *rc, RMenu *menu) {
    if (r_isContext(rc, __func__) && (!menu || isMenu(menu, __func__)))
        rc->m_pDefaultMenu = menu;
}

void MEAPI RRenderDisplayDefaultMenu(RRender *rc) {
    if (r_isContext(rc, __func__) && rc->m_pDefaultMenu)
        rc->m_pCurrentMenu = rc->m_pDefaultMenu;
}

void MEAPI RRenderHideCurrentMenu(RRender *rc) {
    if (r_isContext(rc, __func__))
        rc->m_pCurrentMenu = NULL;
}

RMenu *MEAPI RRenderGetCurrentMenu(RRender *rc) {
    return r_isContext(rc, __func__) ? rc->m_pCurrentMenu : NULL;
}

/* ---- What entries do ---- */

static void executeToggle(RMenuBaseEntry *entry) {
    RMenuToggleEntry *e = (RMenuToggleEntry *)entry;
    e->m_Value = !e->m_Value;
    if (e->m_Func)
        e->m_Func(e->m_Value);
}

static void changeValue(RMenuValueEntry *e, MeReal by) {
    MeReal value = e->m_Value + by;
    value = value < e->m_Low ? e->m_Low : value > e->m_High ? e->m_High : value;
    if (value == e->m_Value)
        return;
    e->m_Value = value;
    if (e->m_Func)
        e->m_Func(value);
}

static void increase(RMenuBaseEntry *entry) {
    changeValue((RMenuValueEntry *)entry, ((RMenuValueEntry *)entry)->m_Increment);
}

static void decrease(RMenuBaseEntry *entry) {
    changeValue((RMenuValueEntry *)entry, -((RMenuValueEntry *)entry)->m_Increment);
}

static void executeSubmenu(RMenuBaseEntry *entry) {
    RMenu *submenu = ((RMenuSubmenuEntry *)entry)->m_pSubmenu;
    if (!submenu)
        return;
    submenu->m_pParent = entry->m_pMenu;
    RMenuDisplay(submenu);
}

static void goBack(RMenuBaseEntry *entry) {
    if (entry->m_pMenu->m_pParent)
        RMenuDisplay(entry->m_pMenu->m_pParent);
}

/* The highlighted entry of the menu that is shown, or null. */
static RMenuBaseEntry *current(RRender *rc, const char *function) {
    return r_isContext(rc, function) && rc->m_pCurrentMenu ? rc->m_pCurrentMenu->m_pCurrent : NULL;
}

void MEAPI RMenuExecute1Entry(RRender *rc) {
    RMenuBaseEntry *e = current(rc, __func__);
    if (e)
        e->m_Execute1(e);
}

void MEAPI RMenuExecute2Entry(RRender *rc) {
    RMenuBaseEntry *e = current(rc, __func__);
    if (e)
        e->m_Execute2(e);
}

void MEAPI RMenuNextEntry(RRender *rc) {
    RMenuBaseEntry *e = current(rc, __func__);
    if (e)
        e->m_pMenu->m_pCurrent = e->m_pNext ? e->m_pNext : e->m_pMenu->m_pFirst;
}

void MEAPI RMenuPreviousEntry(RRender *rc) {
    RMenuBaseEntry *e = current(rc, __func__);
    if (e)
        e->m_pMenu->m_pCurrent = e->m_pPrev ? e->m_pPrev : e->m_pMenu->m_pLast;
}

/* ---- How entries look ---- */

static const float fontSize = 15, rowSize = 24, valueColumn = 180;

static void drawEntry(RMenuBaseEntry *entry, MeReal x, MeReal y, const char *value) {
    RRender *rc = entry->m_pMenu->m_pRender;
    const float scale = r_uiScale(rc), size = fontSize * scale;
    const float *color = entry == entry->m_pMenu->m_pCurrent ? r_accent : r_white;
    r_uiText((float)x, (float)y, size, 0, rTextPlain, color, entry->m_Name);
    const float right = (float)x + fmaxf(valueColumn * scale, r_uiTextSize(entry->m_Name, size, 0, NULL) + 2 * size);
    r_uiText(right, (float)y, size, 0, rTextPlain, color, value);
}

static void displayToggle(RMenuBaseEntry *entry, MeReal x, MeReal y) {
    drawEntry(entry, x, y, ((RMenuToggleEntry *)entry)->m_Value ? "on" : "off");
}

static void displayValue(RMenuBaseEntry *entry, MeReal x, MeReal y) {
    char text[48];
    snprintf(text, sizeof text, "%.5g", (double)((RMenuValueEntry *)entry)->m_Value);
    drawEntry(entry, x, y, text);
}

static void displaySubmenu(RMenuBaseEntry *entry, MeReal x, MeReal y) {
    drawEntry(entry, x, y, "\xe2\x86\x92"); /* An arrow to the right. */
}

/* The mouse on an entry: on its left half what Left does, else what Right does; in the next frame, outside of the
 * drawing. */
static void readMouse(RRender *rc, RMenuBaseEntry *e, float x, float y, float width, float height) {
    char name[32];
    snprintf(name, sizeof name, "%p", (void *)e);
    if (!r_uiClicked(name, x, y, width, height))
        return;
    rc->m_pViewer->clicked = e;
    rc->m_pViewer->clickedLess = e->m_Execute1 == increase && r_uiMouseX() < x + width / 2;
}

void r_menuAct(RRender *rc) {
    RMenuBaseEntry *e = rc->m_pViewer->clicked;
    rc->m_pViewer->clicked = NULL;
    if (!e)
        return;
    e->m_pMenu->m_pCurrent = e;
    (rc->m_pViewer->clickedLess ? e->m_Execute2 : e->m_Execute1)(e);
    r_afterCallBack(rc);
}

static float entryWidth(const RMenuBaseEntry *e, float size, float scale) {
    return fmaxf(valueColumn * scale, r_uiTextSize(e->m_Name, size, 0, NULL) + 2 * size) + 5 * size;
}

void r_menuDraw(RRender *rc) {
    static const char *const keys = "\xe2\x86\x91\xe2\x86\x93 choose   \xe2\x86\x90\xe2\x86\x92 change   F9 close";
    const RMenu *rm = rc->m_pCurrentMenu;
    if (!rm || rc->m_bShowHelp)
        return;
    const float scale = r_uiScale(rc), size = fontSize * scale, row = rowSize * scale, pad = 14 * scale;
    float width = fmaxf(r_uiTextSize(rm->m_Name, size, 0, NULL), r_uiTextSize(keys, 0.8f * size, 0, NULL));
    int rows = 2;
    for (const RMenuBaseEntry *e = rm->m_pFirst; e; e = e->m_pNext, rows++)
        width = fmaxf(width, entryWidth(e, size, scale));
    const float left = roundf(0.04f * (float)rc->m_pViewer->width), top = roundf(0.12f * (float)rc->m_pViewer->height);
    r_uiFixedWindow("menu", left, top, width + 2 * pad, (float)rows * row + 2 * pad);
    float y = top + pad + 0.7f * row;
    r_uiText(left + pad, roundf(y), size, 0, rTextPlain, r_dimmed, rm->m_Name);
    for (RMenuBaseEntry *e = rm->m_pFirst; e; e = e->m_pNext) {
        y += row;
        e->m_Display(e, (MeReal)(left + pad), (MeReal)roundf(y));
        readMouse(rc, e, left, y - 0.7f * row, width + 2 * pad, row);
    }
    r_uiText(left + pad, roundf(y + 1.1f * row), 0.8f * size, 0, rTextPlain, r_dimmed, keys);
    r_uiWindowEnd();
}

/* ---- Adding entries ---- */

static void *addEntry(const char *function, RMenu *rm, const char *name, size_t bytes, RMenuBaseEntry kind) {
    if (!isMenu(rm, function) || !r_isPointer(name, function, "name"))
        return NULL;
    RMenuBaseEntry *e = r_alloc(bytes);
    if (!e)
        return NULL;
    *e = kind;
    e->m_pMenu = rm;
    e->m_Name = r_copyText(name);
    e->m_pPrev = rm->m_pLast;
    *(rm->m_pLast ? &rm->m_pLast->m_pNext : &rm->m_pFirst) = e;
    rm->m_pLast = e;
    if (!rm->m_pCurrent)
        rm->m_pCurrent = e;
    return e;
}

void MEAPI RMenuAddToggleEntry(RMenu *rm, const char *name, RMenuToggleCallback func, MeBool defaultValue) {
    const RMenuBaseEntry kind = {.m_Execute1 = executeToggle, .m_Execute2 = executeToggle, .m_Display = displayToggle};
    RMenuToggleEntry *e = addEntry(__func__, rm, name, sizeof *e, kind);
    if (!e)
        return;
    e->m_Func = func;
    e->m_Value = defaultValue != 0;
}

void MEAPI RMenuAddValueEntry(RMenu *rm, const char *name, RMenuValueCallback func, MeReal hi, MeReal lo,
                              MeReal increment, MeReal defaultValue) {
    const RMenuBaseEntry kind = {.m_Execute1 = increase, .m_Execute2 = decrease, .m_Display = displayValue};
    if (!isfinite(hi) || !isfinite(lo) || !isfinite(increment) || !isfinite(defaultValue)) {
        MeWarning(1, "%s: a number is not finite", __func__);
        return;
    }
    RMenuValueEntry *e = addEntry(__func__, rm, name, sizeof *e, kind);
    if (!e)
        return;
    if (lo > hi) {
        MeWarning(1, "%s: lo is %g and hi is %g: they are exchanged", __func__, (double)lo, (double)hi);
        const MeReal swap = lo;
        lo = hi;
        hi = swap;
    }
    if (defaultValue < lo || defaultValue > hi) {
        MeWarning(1, "%s: the default %g is not between %g and %g", __func__, (double)defaultValue, (double)lo,
                  (double)hi);
        defaultValue = defaultValue < lo ? lo : hi;
    }
    e->m_Func = func;
    e->m_Low = lo;
    e->m_High = hi;
    e->m_Increment = increment;
    e->m_Value = defaultValue;
}

void MEAPI RMenuAddSubmenuEntry(RMenu *rm, const char *name, RMenu *submenu) {
    const RMenuBaseEntry kind = {.m_Execute1 = executeSubmenu, .m_Execute2 = goBack, .m_Display = displaySubmenu};
    if (!isMenu(submenu, __func__))
        return;
    RMenuSubmenuEntry *e = addEntry(__func__, rm, name, sizeof *e, kind);
    if (e)
        e->m_pSubmenu = submenu;
}
