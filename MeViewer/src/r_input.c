/* Keys and the mouse: from events to callbacks, the camera and the viewer's own switches. */
#include "r_i.h"
#include "RMenu.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const AcmeReal tapAngle = 0.05f, holdAngle = 0.02f; /* Radians per key press, per frame. */
static const AcmeReal tapZoom = 0.9f, holdZoom = 0.98f;

/* ---- Names ---- */

static const struct {
    const char *name;
    int key;
} keyNames[] = {{"Space", ' '},
                {"Enter", RKEY_ENTER},
                {"Escape", RKEY_ESCAPE},
                {"Up", RKEY_UP},
                {"Down", RKEY_DOWN},
                {"Left", RKEY_LEFT},
                {"Right", RKEY_RIGHT},
                {"PageUp", RKEY_PAGE_UP},
                {"PageDown", RKEY_PAGE_DOWN},
                {"Home", RKEY_HOME},
                /* Other words for the same. */
                {"Return", RKEY_ENTER},
                {"Esc", RKEY_ESCAPE},
                {"PgUp", RKEY_PAGE_UP},
                {"PgDn", RKEY_PAGE_DOWN}};
enum { KEY_NAMES = sizeof keyNames / sizeof keyNames[0] };

int r_keyByName(const char *name, size_t length) {
    char text[16];
    if (length == 1)
        return tolower((unsigned char)*name);
    if (length == 0 || length >= sizeof text)
        return RKEY_NONE;
    snprintf(text, sizeof text, "%.*s", (int)length, name);
    for (int i = 0; i < KEY_NAMES; i++)
        if (strcasecmp(text, keyNames[i].name) == 0)
            return keyNames[i].key;
    const int number = tolower((unsigned char)text[0]) == 'f' ? atoi(text + 1) : 0;
    return number >= 1 && number <= 12 ? RKEY_F1 + number - 1 : RKEY_NONE;
}

void r_keyName(int key, char *name, size_t size) {
    for (int i = 0; i < KEY_NAMES; i++) {
        if (keyNames[i].key == key) {
            snprintf(name, size, "%s", keyNames[i].name);
            return;
        }
    }
    if (key >= RKEY_F1 && key <= RKEY_F12)
        snprintf(name, size, "F%d", key - RKEY_F1 + 1);
    else if (key > ' ' && key < 127)
        snprintf(name, size, "%c", toupper(key));
    else
        snprintf(name, size, "(no key)");
}

/* ---- Events and the script ---- */

void r_inputInit(RInput *input) {
    static const int keys[NUM_ACTION_CALLBACKS] = {RKEY_NONE, ' ', RKEY_ENTER, '3', '4', '5'};
    memcpy(input->actionKey, keys, sizeof keys);
}

void r_inputFree(RInput *input) {
    r_free(input->extraKeys.items);
    r_free(input->events.items);
    r_free(input->script.items);
}

void r_post(RRender *rc, REvent event) {
    RInput *in = &rc->m_pViewer->input;
    if (r_grow(in->events, 1))
        in->events.items[in->events.count++] = event;
}

/* Takes "Ctrl+" or "Shift+" off the front of a key's name. */
static bool skipPrefix(const char **name, const char *end, const char *prefix) {
    const size_t length = strlen(prefix);
    if ((size_t)(end - *name) <= length || strncasecmp(*name, prefix, length) != 0)
        return false;
    *name += length;
    return true;
}

/* "FRAME" or "FIRST-LAST"; false for what is neither. */
static bool scriptFrames(RScriptedKey *k, const char *text, const char *end) {
    enum { MAX = 1000000000 };
    char *rest;
    const long first = strtol(text, &rest, 10);
    const long last = rest < end && *rest == '-' ? strtol(rest + 1, &rest, 10) : first;
    if (rest != end || first < 1 || last < first || last >= MAX)
        return false;
    k->frame = (int)first;
    k->last = (int)last;
    return true;
}

/* One "NAME@FRAME". */
static bool scriptKey(RRender *rc, const char *text, const char *end) {
    RInput *in = &rc->m_pViewer->input;
    const char *at = memchr(text, '@', (size_t)(end - text)), *name = text;
    RScriptedKey k = {0};
    if (at == text) /* The key @ itself. */
        at = memchr(text + 1, '@', (size_t)(end - text - 1));
    if (at) {
        if (skipPrefix(&name, at, "Ctrl+"))
            k.modifiers = RCONTROL;
        else if (skipPrefix(&name, at, "Shift+"))
            k.modifiers = RSHIFT;
        if (scriptFrames(&k, at + 1, end))
            k.key = r_keyByName(name, (size_t)(at - name));
    }
    const bool understood = k.key != RKEY_NONE;
    if (!understood)
        MeWarning(1, "-key %.*s: write NAME@FRAME or NAME@FIRST-LAST, as in F1@30 or Up@10-70", (int)(end - text),
                  text);
    else if (r_grow(in->script, 1))
        in->script.items[in->script.count++] = k;
    return understood;
}

bool r_inputScript(RRender *rc, const char *script) {
    bool understood = true;
    while (*script) {
        const char *end = script + strcspn(script, ",");
        if (!scriptKey(rc, script, end))
            understood = false;
        script = *end ? end + 1 : end;
    }
    return understood;
}

/* ---- Callbacks ---- */

void r_press(RRender *rc, const RCallBackDataButton *b) {
    if (b->m_Func)
        b->m_Func(rc, b->m_pUserData);
    else if (b->m_FuncNoData)
        b->m_FuncNoData(rc);
    r_afterCallBack(rc);
}

const RCallBackDataButton *r_actionOfKey(const RRender *rc, int key) {
    for (int i = 0; i < NUM_ACTION_CALLBACKS; i++) {
        const RCallBackDataButton *b = &rc->m_CallBacks.m_Action[i];
        if (rc->m_pViewer->input.actionKey[i] == key && (b->m_Func || b->m_FuncNoData))
            return b;
    }
    return NULL;
}

static const RCallBackDataButton *extraOfKey(const RRender *rc, int key) {
    const RInput *in = &rc->m_pViewer->input;
    for (size_t i = 0; i < in->extraKeys.count; i++)
        if (in->extraKeys.items[i].key == key)
            return &in->extraKeys.items[i].button;
    return NULL;
}

static int buttonOf(int key) {
    switch (key) {
    case RKEY_UP:
        return kRButtonUp;
    case RKEY_DOWN:
        return kRButtonDown;
    case RKEY_LEFT:
        return kRButtonLeft;
    case RKEY_RIGHT:
        return kRButtonRight;
    case 'w':
        return kRButtonUp2;
    case 's':
        return kRButtonDown2;
    case 'a':
        return kRButtonLeft2;
    case 'd':
        return kRButtonRight2;
    default:
        return kRButtons;
    }
}

bool r_keyIsFree(const RRender *rc, int key) {
    return !r_actionOfKey(rc, key) && !r_parameterOfKey(rc, key, NULL) && buttonOf(key) == kRButtons;
}

static void callMouse(RRender *rc, const REvent *e, RMouseButtonEvent event) {
    const RCallBackDataMouse *m = &rc->m_CallBacks.m_Mouse;
    if (m->m_Func)
        m->m_Func(rc, e->x, e->y, e->modifiers, kRLeftButton, event, m->m_pUserData);
    r_afterCallBack(rc);
}

/* ---- Keys ---- */

static bool isArrow(int key) {
    return key >= RKEY_UP && key <= RKEY_RIGHT;
}

static void orbitKey(RRender *rc, int key, AcmeReal angle) {
    if (key == RKEY_LEFT || key == RKEY_RIGHT)
        r_cameraOrbit(rc, key == RKEY_LEFT ? -angle : angle, 0);
    else
        r_cameraOrbit(rc, 0, key == RKEY_UP ? angle : -angle);
}

static void menuKey(RRender *rc, int key) {
    if (key == RKEY_UP)
        RMenuPreviousEntry(rc);
    else if (key == RKEY_DOWN)
        RMenuNextEntry(rc);
    else if (key == RKEY_RIGHT)
        RMenuExecute1Entry(rc);
    else
        RMenuExecute2Entry(rc);
    r_afterCallBack(rc);
}

/* F9: goes back to the menu before; else shows the default menu and the panels, or hides both. */
static void toggleMenu(RRender *rc) {
    const RMenu *shown = rc->m_pCurrentMenu;
    if (shown && shown->m_pParent) {
        RMenuDisplay(shown->m_pParent);
        return;
    }
    if (!shown || rc->m_pViewer->panelsShown)
        r_panelsToggle(rc);
    if (rc->m_pViewer->panelsShown)
        RRenderDisplayDefaultMenu(rc);
    else
        RRenderHideCurrentMenu(rc);
}

static void viewerKey(RRender *rc, int key) {
    struct RViewer *v = rc->m_pViewer;
    switch (key) {
    case RKEY_F1:
        RRenderToggleUserHelp(rc);
        break;
    case RKEY_F2:
        v->loop.pictureRequested = true;
        break;
    case RKEY_F3:
        r_barToggle(rc);
        break;
    case RKEY_F4:
        v->wireframe = !v->wireframe;
        break;
    case RKEY_F5:
        v->shadows = !v->shadows;
        break;
    case RKEY_F9:
        toggleMenu(rc);
        break;
    case RKEY_HOME:
        r_cameraHome(rc);
        break;
    case 'p':
        RRenderSetPause(rc, !rc->m_bPause);
        break;
    case 'o':
    case '.':
        RRenderSetPause(rc, 1);
        v->loop.step = true;
        break;
    case 'q':
        RRenderQuit(rc);
        break;
    default:
        break;
    }
}

/* What keys do again and again while they are held: the camera smoothly, parameters and the direction buttons now and
 * then. */
static void holdKey(RRender *rc, int key) {
    enum { CAMERA_DELAY = 12, BUTTON_DELAY = 24, BUTTON_PERIOD = 4 };
    const RInput *in = &rc->m_pViewer->input;
    const int frames = in->heldFor[key], button = buttonOf(key);
    if ((key == RKEY_PAGE_UP || key == RKEY_PAGE_DOWN) && frames > CAMERA_DELAY)
        r_cameraDolly(rc, key == RKEY_PAGE_UP ? holdZoom : 1 / holdZoom);
    else if (isArrow(key) && in->heldControl[key] && frames > CAMERA_DELAY)
        orbitKey(rc, key, holdAngle);
    else if (!in->heldControl[key] && frames > BUTTON_DELAY && frames % BUTTON_PERIOD == 0 && !rc->m_pCurrentMenu &&
             !r_actionOfKey(rc, key) && !r_parameterKey(rc, key) && button != kRButtons)
        r_press(rc, &rc->m_CallBacks.m_Button[button]);
}

static void keyDown(RRender *rc, int key, int modifiers) {
    RInput *in = &rc->m_pViewer->input;
    const bool control = (modifiers & RCONTROL) != 0;
    if (key <= RKEY_NONE || key >= RKEY_COUNT || in->heldFor[key])
        return;
    MEASSERT(!in->dragButton || (in->dragButton >= kRLeftButton && in->dragButton <= kRRightButton));
    in->heldFor[key] = 1;
    in->heldControl[key] = control;
    if (key == RKEY_ESCAPE)
        RRenderQuit(rc);
    else if (isArrow(key) && control)
        orbitKey(rc, key, tapAngle);
    else if (control && key < RKEY_F1)
        return;                      /* Ctrl and a letter means nothing here. */
    else if (r_actionOfKey(rc, key)) /* Before the viewer's own keys: the program's win. */
        r_press(rc, r_actionOfKey(rc, key));
    else if (isArrow(key) && rc->m_pCurrentMenu)
        menuKey(rc, key);
    else if (r_parameterKey(rc, key))
        return;
    else if (key == RKEY_PAGE_UP || key == RKEY_PAGE_DOWN)
        r_cameraDolly(rc, key == RKEY_PAGE_UP ? tapZoom : 1 / tapZoom);
    else if (buttonOf(key) != kRButtons)
        r_press(rc, &rc->m_CallBacks.m_Button[buttonOf(key)]);
    else if (extraOfKey(rc, key))
        r_press(rc, extraOfKey(rc, key));
    else
        viewerKey(rc, key);
}

/* ---- The mouse ---- */

static void mouseDown(RRender *rc, const REvent *e) {
    RInput *in = &rc->m_pViewer->input;
    const bool left = e->which == kRLeftButton;
    in->lastX = e->x;
    in->lastY = e->y;
    if (left && rc->m_CallBacks.m_Mouse.m_Func && !(e->modifiers & (RCONTROL | RSHIFT))) {
        in->mouseToProgram = true;
        in->mouseLeft = false;
        callMouse(rc, e, kRNewlyPressed);
        if (!in->mouseLeft)
            return;
        in->mouseToProgram = false;
    }
    in->dragButton = e->which;
    in->dragPans = !left || (e->modifiers & RSHIFT);
}

static void mouseMove(RRender *rc, const REvent *e) {
    RInput *in = &rc->m_pViewer->input;
    const AcmeReal dx = (AcmeReal)(e->x - in->lastX), dy = (AcmeReal)(e->y - in->lastY);
    const AcmeReal angle = 5.0f / (AcmeReal)rc->m_pViewer->height; /* Per pixel. */
    in->lastX = e->x;
    in->lastY = e->y;
    if (in->mouseToProgram) {
        callMouse(rc, e, kRStillPressed);
    } else if (in->dragPans) {
        r_cameraPan(rc, -dx, dy);
    } else if (in->dragButton == kRLeftButton) {
        r_cameraOrbit(rc, -dx * angle, dy * angle);
    }
}

static void mouseUp(RRender *rc, const REvent *e) {
    RInput *in = &rc->m_pViewer->input;
    if (in->mouseToProgram && e->which == kRLeftButton) {
        in->mouseToProgram = false;
        callMouse(rc, e, kRNewlyReleased);
    }
    if (e->which == in->dragButton) {
        in->dragButton = 0;
        in->dragPans = false;
    }
}

/* ---- A frame's input ---- */

static void resize(RRender *rc, int width, int height) {
    rc->m_pViewer->width = width > 1 ? width : 1;
    rc->m_pViewer->height = height > 1 ? height : 1;
}

static void handle(RRender *rc, const REvent *e) {
    if (r_panelsHandle(rc, e))
        return;
    switch (e->kind) {
    case rKeyDown:
        keyDown(rc, e->key, e->modifiers);
        break;
    case rKeyUp:
        if (e->key > RKEY_NONE && e->key < RKEY_COUNT)
            rc->m_pViewer->input.heldFor[e->key] = 0;
        break;
    case rMouseDown:
        mouseDown(rc, e);
        break;
    case rMouseMove:
        mouseMove(rc, e);
        break;
    case rMouseUp:
        mouseUp(rc, e);
        break;
    case rWheel:
        r_cameraDollyAt(rc, powf(tapZoom, (AcmeReal)e->which), e->x, e->y);
        break;
    case rResize:
        resize(rc, e->x, e->y);
        break;
    case rClose:
        RRenderQuit(rc);
        break;
    }
}

/* Keys come up before they go down, so that one may be pressed in each of several frames, or several times in one. */
static void postScript(RRender *rc) {
    const RInput *in = &rc->m_pViewer->input;
    const int frame = rc->m_pViewer->loop.frames;
    for (size_t i = 0; i < in->script.count; i++)
        if (in->script.items[i].last + 1 == frame)
            r_post(rc, (REvent){.kind = rKeyUp, .key = in->script.items[i].key});
    for (size_t i = 0; i < in->script.count; i++) {
        const RScriptedKey *k = &in->script.items[i];
        if (k->frame != frame)
            continue;
        r_post(rc, (REvent){.kind = rKeyUp, .key = k->key});
        r_post(rc, (REvent){.kind = rKeyDown, .key = k->key, .modifiers = k->modifiers});
    }
}

void r_inputFrame(RRender *rc) {
    RInput *in = &rc->m_pViewer->input;
    for (int key = 0; key < RKEY_COUNT; key++) {
        if (!in->heldFor[key])
            continue;
        in->heldFor[key]++;
        holdKey(rc, key);
    }
    r_menuAct(rc);
    postScript(rc);
    rc->m_pViewer->backend->poll(rc);
    for (size_t i = 0; i < in->events.count; i++) {
        const REvent event = in->events.items[i]; /* A callback may post more. */
        handle(rc, &event);
    }
    in->events.count = 0;
}
