/* All tutorials in one window: a panel with categories in the order of learning, search, next, previous and restart.
 *
 *     browser [NAME] [-tour] [options of the viewer]
 *
 * With -tour, a tutorial that ends (-frames) is followed by the next one, up to the last.
 *
 * Each tutorial is a program of its own. The browser loads it as a module, calls its main, and lets it go again; what
 * it has handed to atexit runs then. Three things are another's here, by the linker's --wrap: exit() of a tutorial
 * comes back to the browser; its context gets the browser's panel; and the window stays open between two tutorials.
 * The tutorials themselves do not know of it.
 */
#define _GNU_SOURCE /* strcasestr, program_invocation_name */
#include "MeCommandLine.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "RPanel.h"
#include <GL/freeglut.h>
#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct Tutorial {
    const char *name, *text, *head; /* the first sentence; all of the source's first comment */
} Tutorial;
static const Tutorial tutorial[] = {
#include "browser_names.h"
};
enum { COUNT = sizeof tutorial / sizeof tutorial[0], NONE = -1 };

/* In the order of learning. */
static const struct {
    const char *title, *names;
} category[] = {
    {"First steps", "Drop Bounce Stack Hinge Collide Rays"},
    {"Joints", "Prismatic Limits Spring Universal Angular3 Linear FixedPath ConeLimit RPRO Chain CarWheel"},
    {"How it is solved", "Gyroscope AutoDisable Partitions MatrixCap SortKeys FarWorld"},
    {"Surfaces", "Friction Slip Slide Materials Conveyor Marbles"},
    {"Piles", "Pyramid Dominoes CardHouse Arch Jenga Cradle Bowling Hulls Compounds Mesh Tumbler"},
    {"Machines and figures",
     "Bridge Lift Gears Character WreckingBall Chair Ragdolls Car Vehicle Motorcycle Quadbike Bullets "
     "Explosions"},
};
enum { CATEGORIES = sizeof category / sizeof category[0] };

static int order[COUNT]; /* of tutorials, as the categories have them */
static int here, next = NONE;
static MeBool isTour;
static char search[32];
static int programArgc;
static const char **programArgv;

/* ---- names ------------------------------------------------------------------------------------------------------- */

static int find(const char *name, size_t length) {
    for (int i = 0; i < COUNT; i++)
        if (strlen(tutorial[i].name) == length && strncasecmp(tutorial[i].name, name, length) == 0)
            return i;
    return NONE;
}

/* Every tutorial is in one category, once. */
static MeBool makeOrder(void) {
    int n = 0;
    for (int c = 0; c < CATEGORIES; c++)
        for (const char *at = category[c].names; *at; at += strspn(at, " ")) {
            const size_t length = strcspn(at, " ");
            const int which = find(at, length);
            for (int i = 0; i < n; i++)
                if (order[i] == which)
                    return MEFALSE;
            if (which == NONE || n == COUNT)
                return MEFALSE;
            order[n++] = which;
            at += length;
        }
    return n == COUNT;
}

static int placeOf(int which) {
    int place = 0;
    while (order[place] != which)
        place++;
    return place;
}

/* ---- a tutorial's program ---------------------------------------------------------------------------------------- */

static jmp_buf ended;
static MeBool isRunning;
static int exitCode;

void __real_exit(int code) __attribute__((noreturn));
MEPUBLIC void __wrap_exit(int code) __attribute__((noreturn));

/* The main loop ends a program by exit(): a tutorial's comes back here. */
void __wrap_exit(int code) {
    exitCode = code;
    if (isRunning)
        longjmp(ended, 1);
    __real_exit(code);
}

static void callMain(void *module) {
    int (*entry)(int, const char **);
    void *address = dlsym(module, "main");
    memcpy(&entry, &address, sizeof entry); /* ISO C converts no object pointers to functions */
    isRunning = METRUE;
    if (!setjmp(ended))
        exitCode = entry(programArgc, programArgv);
    isRunning = MEFALSE;
}

/* Beside the browser, in parts/. */
static MeBool runTutorial(int which) {
    char path[1024], name[64];
    const char *slash = strrchr(program_invocation_name, '/');
    size_t i = 0;
    for (; tutorial[which].name[i] && i < sizeof name - 1; i++)
        name[i] = (char)tolower((unsigned char)tutorial[which].name[i]);
    name[i] = 0;
    snprintf(path, sizeof path, "%.*sparts/%s.so", slash ? (int)(slash - program_invocation_name) + 1 : 0,
             program_invocation_name, name);
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module) {
        MeWarning(1, "browser: %s", dlerror());
        exitCode = 1;
        return MEFALSE;
    }
    MeInfo(0, "browser: %s", tutorial[which].name);
    fflush(stdout); /* where it is no terminal, too */
    callMain(module);
    dlclose(module); /* calls what it has handed to atexit: its context ends here */
    return METRUE;
}

/* ---- the window -------------------------------------------------------------------------------------------------- */

static int window;

int __real_glutCreateWindow(const char *title);
void __real_glutDestroyWindow(int which);
int __wrap_glutCreateWindow(const char *title);
void __wrap_glutDestroyWindow(int which);

int __wrap_glutCreateWindow(const char *title) {
    if (!window)
        return window = __real_glutCreateWindow(title);
    glutSetWindow(window);
    glutSetWindowTitle(title);
    return window;
}

/* Kept for the next tutorial. */
void __wrap_glutDestroyWindow(int which) {
    (void)which;
}

/* ---- the panel: what may be chosen, and a picture and a sentence of what the pointer is on ---------------------- */

static void choose(RRender *rc, int which) {
    next = which;
    RRenderQuit(rc);
}

/* Does a word of the text begin with these letters? */
static MeBool hasWord(const char *text, const char *letters) {
    const char *at = text;
    while ((at = strcasestr(at, letters)) != NULL && at > text && isalnum((unsigned char)at[-1]))
        at++;
    return at != NULL;
}

/* Each word of the search is in the name, or begins a word of what is said of it. */
static MeBool matches(const Tutorial *t) {
    char words[sizeof search];
    MeBool isFound = METRUE;
    snprintf(words, sizeof words, "%s", search);
    for (const char *word = strtok(words, " "); word && isFound; word = strtok(0, " "))
        isFound = strcasestr(t->name, word) || hasWord(t->head, word);
    return isFound;
}

/* Is the pointer on it? */
static MeBool showLine(RRender *rc, int which) {
    if (RPanelLine(tutorial[which].name, which == here))
        choose(rc, which);
    return RPanelIsPointedAt();
}

/* Returns the tutorial that the pointer is on, or the one that runs. */
static int showList(RRender *rc) {
    enum { LINES = 12 };
    int place = 0, pointed = here, found = 0;
    RPanelListBegin("tutorials", LINES);
    for (int c = 0; c < CATEGORIES; c++) {
        MeBool isTitled = MEFALSE;
        for (const char *at = category[c].names; *at; place++) {
            if (matches(&tutorial[order[place]])) {
                if (!isTitled)
                    RPanelHeading(category[c].title);
                isTitled = METRUE;
                found++;
                if (showLine(rc, order[place]))
                    pointed = order[place];
            }
            at += strcspn(at, " ");
            at += strspn(at, " ");
        }
    }
    if (!found)
        RPanelText("Nothing is found.");
    RPanelListEnd();
    return pointed;
}

static void MEAPI show(RRender *rc, void *userdata) {
    const int place = placeOf(here);
    char text[160];
    (void)userdata;
    if (RPanelButton("< previous"))
        choose(rc, order[(place + COUNT - 1) % COUNT]);
    RPanelSameLine();
    if (RPanelButton("restart"))
        choose(rc, here);
    RPanelSameLine();
    if (RPanelButton("next >"))
        choose(rc, order[(place + 1) % COUNT]);
    RPanelEdit("search", search, sizeof search);
    const int pointed = showList(rc);
    snprintf(text, sizeof text, "%s, %d of %d", tutorial[pointed].name, placeOf(pointed) + 1, COUNT);
    RPanelHeading(text);
    RPanelPicture(RRenderTextureCreate(rc, tutorial[pointed].name), 16, 10);
    RPanelWrapped(tutorial[pointed].text);
}

static void MEAPI toNext(RRender *rc, void *userdata) {
    (void)userdata;
    choose(rc, order[(placeOf(here) + 1) % COUNT]);
}

static void MEAPI toPrevious(RRender *rc, void *userdata) {
    (void)userdata;
    choose(rc, order[(placeOf(here) + COUNT - 1) % COUNT]);
}

RRender *MEAPI __real_RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overriding, MeBool eat);
MEPUBLIC RRender *MEAPI __wrap_RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overriding,
                                                    MeBool eat);

/* A tutorial's context, its own or that of MeAppStart, in a window that is as large as the user has made it. */
RRender *MEAPI __wrap_RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overriding,
                                           MeBool eat) {
    char size[32];
    const char *words[] = {"browser", "-size", size};
    MeCommandLineOptions *ours = 0;
    if (window) {
        glutSetWindow(window);
        snprintf(size, sizeof size, "%dx%d", glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT));
        ours = MeCommandLineOptionsCreate(3, words);
    }
    RRender *rc = __real_RRenderContextCreate(options, ours ? ours : overriding, eat);
    MeCommandLineOptionsDestroy(ours);
    if (!rc)
        return 0;
    RPanelCreate(rc, "Tutorials", show, 0);
    RPanelShow(rc, "Tutorials", METRUE);
    RRenderSetKeyCallBack(rc, ']', toNext, 0, "next tutorial");
    RRenderSetKeyCallBack(rc, '[', toPrevious, 0, "previous tutorial");
    return rc;
}

/* ---- start ------------------------------------------------------------------------------------------------------- */

static void takeArgument(int which) {
    for (int i = which; i + 1 < programArgc; i++)
        programArgv[i] = programArgv[i + 1];
    programArgc--;
}

/* A name as the first argument, and -tour, are the browser's; the rest goes to every tutorial. */
static int firstOf(void) {
    int which = order[0];
    for (int i = 1; i < programArgc; i++)
        if (strcmp(programArgv[i], "-tour") == 0) {
            isTour = METRUE;
            takeArgument(i);
            break;
        }
    if (programArgc > 1 && programArgv[1][0] != '-') {
        which = find(programArgv[1], strlen(programArgv[1]));
        takeArgument(1);
    }
    return which;
}

int MEAPI_CDECL main(int argc, const char **argv) {
    programArgc = argc;
    programArgv = argv;
    if (!makeOrder()) {
        MeWarning(1, "browser: the categories do not have every tutorial once");
        return 1;
    }
    here = firstOf();
    if (here == NONE) {
        MeWarning(1, "browser: there is no tutorial of this name");
        return 2;
    }
    setenv("KARMA_TEXTURES", KARMA_PICTURES, 0);
    do {
        next = NONE;
        if (!runTutorial(here))
            break;
        if (isTour && next == NONE && placeOf(here) + 1 < COUNT)
            next = order[placeOf(here) + 1];
        here = next == NONE ? here : next;
    } while (next != NONE);
    return exitCode;
}
