/* The backend of -gl: a window of freeglut's.
 *
 * freeglut ends the program when something goes wrong, for instance when the display cannot be opened. It lets one set
 * a function to be called first; ours jumps back to where the window was wanted. After that freeglut is left alone.
 * Its callbacks only post events: the program's functions, which may call exit(), run outside of freeglut. */
#include "r_i.h"

#include <GL/freeglut.h>
#include <X11/Xlib.h>
#include <ctype.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* freeglut's callbacks know no context, and there is one window at most. */
static RRender *owner;
static int window;
static bool closed;

static jmp_buf beforeError;
static char errorText[160];

static void onError(const char *format, va_list ap) {
    vsnprintf(errorText, sizeof errorText, format, ap);
    longjmp(beforeError, 1);
}

static void onWarning(const char *format, va_list ap) {
    char text[160];
    vsnprintf(text, sizeof text, format, ap);
    MeDebug(1, "freeglut: %s", text);
}

/* ---- Events ---- */

static int modifiers(void) {
    const int m = glutGetModifiers();
    return (m & GLUT_ACTIVE_CTRL ? RCONTROL : 0) | (m & GLUT_ACTIVE_SHIFT ? RSHIFT : 0) |
           (m & GLUT_ACTIVE_ALT ? RALT : 0);
}

/* With Ctrl, letters arrive as control characters. */
static int plainKey(unsigned char c, int mods) {
    if ((mods & RCONTROL) && c >= 1 && c <= 26 && c != RKEY_ENTER)
        return c + 'a' - 1;
    return tolower(c);
}

static int specialKey(int key) {
    static const struct {
        int glut, ours;
    } keys[] = {{GLUT_KEY_UP, RKEY_UP},       {GLUT_KEY_DOWN, RKEY_DOWN},       {GLUT_KEY_LEFT, RKEY_LEFT},
                {GLUT_KEY_RIGHT, RKEY_RIGHT}, {GLUT_KEY_PAGE_UP, RKEY_PAGE_UP}, {GLUT_KEY_PAGE_DOWN, RKEY_PAGE_DOWN},
                {GLUT_KEY_HOME, RKEY_HOME}};
    if (key >= GLUT_KEY_F1 && key <= GLUT_KEY_F12)
        return RKEY_F1 + key - GLUT_KEY_F1;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].glut == key)
            return keys[i].ours;
    return RKEY_NONE;
}

static void onKey(unsigned char key, int x, int y) {
    const int mods = modifiers();
    r_post(owner, (REvent){.kind = rKeyDown, .key = plainKey(key, mods), .modifiers = mods, .x = x, .y = y});
}

static void onKeyUp(unsigned char key, int x, int y) {
    r_post(owner, (REvent){.kind = rKeyUp, .key = plainKey(key, modifiers()), .x = x, .y = y});
}

static void onSpecial(int key, int x, int y) {
    r_post(owner, (REvent){.kind = rKeyDown, .key = specialKey(key), .modifiers = modifiers(), .x = x, .y = y});
}

static void onSpecialUp(int key, int x, int y) {
    r_post(owner, (REvent){.kind = rKeyUp, .key = specialKey(key), .x = x, .y = y});
}

static void onMouse(int button, int state, int x, int y) {
    static const int which[3] = {kRLeftButton, kRMiddleButton, kRRightButton};
    if (button < GLUT_LEFT_BUTTON || button > GLUT_RIGHT_BUTTON)
        return;
    const REventKind kind = state == GLUT_DOWN ? rMouseDown : rMouseUp;
    r_post(owner, (REvent){.kind = kind, .which = which[button], .modifiers = modifiers(), .x = x, .y = y});
}

static void onWheel(int wheel, int direction, int x, int y) {
    (void)wheel;
    r_post(owner, (REvent){.kind = rWheel, .which = direction, .x = x, .y = y});
}

/* glutGetModifiers may not be asked here; freeglut allows it, though. */
static void onMotion(int x, int y) {
    r_post(owner, (REvent){.kind = rMouseMove, .modifiers = modifiers(), .x = x, .y = y});
}

static void onReshape(int width, int height) {
    r_post(owner, (REvent){.kind = rResize, .x = width, .y = height});
}

/* Also called when it is we who close it: then there is no owner any more. */
static void onClose(void) {
    closed = true;
    if (owner)
        r_post(owner, (REvent){.kind = rClose});
}

/* The main loop draws; freeglut only wants to be given a function. */
static void onDisplay(void) {}

/* ---- The display's density ---- */

/* What the user has set for text, else what the screen says of its size; 0 if neither is known. */
static float dotsPerInch(void) {
    Display *display = XOpenDisplay(NULL);
    if (!display)
        return 0;
    const char *set = XGetDefault(display, "Xft", "dpi");
    const float wish = set ? strtof(set, NULL) : 0;
    const int millimetres = XDisplayWidthMM(display, DefaultScreen(display));
    const float measured =
        millimetres > 0 ? 25.4f * (float)XDisplayWidth(display, DefaultScreen(display)) / (float)millimetres : 0;
    XCloseDisplay(display);
    return wish > 0 ? wish : measured;
}

/* In quarters, as desktops have it. 96 dots per inch is a usual display; none is taken for coarser, and few screens
 * that claim more than four times that say the truth. */
static float displayScale(void) {
    const float quarters = roundf(4 * dotsPerInch() / 96);
    return quarters < 4 || quarters > 16 ? 1 : quarters / 4;
}

/* ---- The backend ---- */

static void openWindow(RRender *rc) {
    char name[] = "karma", *arguments[] = {name, NULL};
    int n = 1;
    glutInitErrorFunc(onError);
    glutInitWarningFunc(onWarning);
    if (!glutGet(GLUT_INIT_STATE))
        glutInit(&n, arguments);
    if (rc->m_Options.m_Scale == 0)
        r_setScale(rc, displayScale());
    glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_CONTINUE_EXECUTION);
    glutInitContextVersion(3, 3);
    glutInitContextProfile(GLUT_CORE_PROFILE); /* Some drivers have 3.3 only so. */
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE);
    glutInitWindowSize(rc->m_pViewer->width, rc->m_pViewer->height);
    window = glutCreateWindow(rc->m_pViewer->title ? rc->m_pViewer->title : rc->m_AppName);
    glutDisplayFunc(onDisplay);
    glutReshapeFunc(onReshape);
    glutCloseFunc(onClose);
    glutKeyboardFunc(onKey);
    glutKeyboardUpFunc(onKeyUp);
    glutSpecialFunc(onSpecial);
    glutSpecialUpFunc(onSpecialUp);
    glutMouseFunc(onMouse);
    glutMouseWheelFunc(onWheel);
    glutMotionFunc(onMotion);
    glutPassiveMotionFunc(onMotion);
    glutIgnoreKeyRepeat(1);
    glutInitErrorFunc(NULL); /* From here on there is nowhere to jump to. */
}

static bool start(RRender *rc, char *reason, size_t size) {
    static bool failed;
    if (owner || failed) {
        snprintf(reason, size, "%s", failed ? errorText : "there is a window already, and there can be only one");
        return false;
    }
    owner = rc;
    closed = false;
    if (setjmp(beforeError)) {
        failed = true;
        owner = NULL;
        snprintf(reason, size, "%s", errorText);
        return false;
    }
    openWindow(rc);
    return true;
}

static void stop(RRender *rc) {
    (void)rc;
    owner = NULL;
    if (!closed)
        glutDestroyWindow(window); /* freeglut and its connection to the display stay, for another window. */
}

static void poll(RRender *rc) {
    (void)rc;
    if (!closed)
        glutMainLoopEvent();
}

static void present(RRender *rc) {
    (void)rc;
    glutSwapBuffers();
}

static void title(RRender *rc, const char *text) {
    (void)rc;
    if (!closed)
        glutSetWindowTitle(text);
}

static RProc proc(const char *name) {
    return (RProc)glutGetProcAddress(name);
}

static bool makeCurrent(const RRender *rc) {
    (void)rc;
    if (!closed)
        glutSetWindow(window);
    return !closed;
}

const RBackend r_backendGlut = {"-gl", kROpenGL, true, true, start, stop, poll, present, title, proc, makeCurrent};
