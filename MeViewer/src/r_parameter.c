/* Parameters: numbers of the program that keys and sliders change, from one table. */
#include "RParameter.h"
#include "RPanel.h"
#include "r_i.h"

#include <stdio.h>
#include <string.h>

/* ---- The table ---- */

static int keyOf(const char *name) {
    return name ? r_keyByName(name, strlen(name)) : RKEY_NONE;
}

/* Null if it can be used. */
static const char *mistakeOf(const RRender *rc, const RParameter *p) {
    if (!p->name || !p->value)
        return "its name or value is null";
    if (!isfinite(p->low) || !isfinite(p->high) || p->low >= p->high)
        return "low has to be below high";
    if (!isfinite(p->step) || p->step <= (p->isFactor ? 1 : 0) || (p->isFactor && p->low <= 0))
        return "step has to be above 0; for a factor above 1, with low above 0";
    for (size_t i = 0; i < rc->m_pViewer->parameters.count; i++)
        if (strcmp(rc->m_pViewer->parameters.items[i].name, p->name) == 0)
            return "another parameter has its name";
    const char *const names[] = {p->less, p->more};
    for (int i = 0; i < 2; i++) {
        const int key = keyOf(names[i]);
        if (names[i] && key == RKEY_NONE)
            return "there is no such key (RKey.h)";
        if (key != RKEY_NONE && r_parameterOfKey(rc, key, NULL))
            return "another parameter has its key";
    }
    return NULL;
}

static void add(RRender *rc, const RParameter *p) {
    RParameters *list = &rc->m_pViewer->parameters;
    char *name = r_copyText(p->name), *unit = r_copyText(p->unit ? p->unit : "");
    if (!name || !unit || !r_grow(*list, 1)) {
        r_free(name);
        r_free(unit);
        return;
    }
    RParameterKept *kept = &list->items[list->count++];
    *kept = (RParameterKept){.name = name,
                             .unit = unit,
                             .value = p->value,
                             .first = *p->value,
                             .low = p->low,
                             .high = p->high,
                             .step = p->step,
                             .isFactor = p->isFactor != 0,
                             .key = {keyOf(p->less), keyOf(p->more)},
                             .changed = {.m_Func = p->changed, .m_pUserData = p->userdata}};
}

void r_parametersFree(RParameters *list) {
    for (size_t i = 0; i < list->count; i++) {
        r_free(list->items[i].name);
        r_free(list->items[i].unit);
    }
    r_free(list->items);
    *list = (RParameters){0};
}

/* ---- Changes ---- */

static void set(RRender *rc, const RParameterKept *p, MeReal value) {
    *p->value = value < p->low ? p->low : value > p->high ? p->high : value;
    r_press(rc, &p->changed);
}

static MeReal nearestStep(const RParameterKept *p, MeReal value) {
    if (p->isFactor)
        return p->low * (MeReal)pow((double)p->step, round(log((double)(value / p->low)) / log((double)p->step)));
    return p->low + p->step * (MeReal)round((double)((value - p->low) / p->step));
}

const RParameterKept *r_parameterOfKey(const RRender *rc, int key, bool *isMore) {
    const RParameters *list = &rc->m_pViewer->parameters;
    for (size_t i = 0; i < list->count; i++)
        for (int k = 0; k < 2; k++)
            if (list->items[i].key[k] == key) {
                if (isMore)
                    *isMore = k == 1;
                return &list->items[i];
            }
    return NULL;
}

bool r_parameterKey(RRender *rc, int key) {
    bool isMore;
    const RParameterKept *p = r_parameterOfKey(rc, key, &isMore);
    if (!p)
        return false;
    const MeReal now = *p->value;
    if (p->isFactor)
        set(rc, p, isMore ? now * p->step : now / p->step);
    else
        set(rc, p, isMore ? now + p->step : now - p->step);
    return true;
}

/* ---- What is seen ---- */

void r_parameterText(const RParameterKept *p, char *text, size_t size) {
    snprintf(text, size, *p->unit ? "%s (%s)" : "%s", p->name, p->unit);
}

void r_parameterKeys(const RParameterKept *p, char *text, size_t size) {
    char names[2][24] = {"", ""};
    for (int k = 0; k < 2; k++)
        if (p->key[k] != RKEY_NONE)
            r_keyName(p->key[k], names[k], sizeof names[k]);
    snprintf(text, size, "%s%s%s", names[0], *names[0] && *names[1] ? ", " : "", names[1]);
}

static void showSlider(RRender *rc, const RParameterKept *p) {
    char keys[64], label[160];
    MeReal value = *p->value;
    r_parameterKeys(p, keys, sizeof keys);
    snprintf(label, sizeof label, *keys ? "%s  (%s)" : "%s", p->name, keys);
    if (!r_uiSlider(label, &value, p->low, p->high, p->unit, p->isFactor))
        return;
    value = nearestStep(p, value);
    if (value != *p->value)
        set(rc, p, value);
}

/* A callback may create parameters, which moves the list: each is used as a copy. */
static void MEAPI showParameters(RRender *rc, void *userdata) {
    const RParameters *list = &rc->m_pViewer->parameters;
    (void)userdata;
    for (size_t i = 0; i < list->count; i++) {
        const RParameterKept p = list->items[i];
        showSlider(rc, &p);
    }
    if (!RPanelButton("reset"))
        return;
    for (size_t i = 0; i < list->count; i++) {
        const RParameterKept p = list->items[i];
        if (*p.value != p.first)
            set(rc, &p, p.first);
    }
}

void MEAPI RRenderCreateParameters(RRender *rc, const RParameter parameters[], int count) {
    if (!r_isContext(rc, "RRenderCreateParameters") ||
        !r_isPointer(parameters, "RRenderCreateParameters", "parameters"))
        return;
    for (int i = 0; i < count; i++) {
        const char *mistake = mistakeOf(rc, &parameters[i]);
        if (mistake)
            MeWarning(1, "RRenderCreateParameters: parameter %d, %s, is left out: %s", i,
                      parameters[i].name ? parameters[i].name : "without a name", mistake);
        else
            add(rc, &parameters[i]);
    }
    if (rc->m_pViewer->parameters.count)
        RPanelCreate(rc, "Parameters", showParameters, NULL);
}
