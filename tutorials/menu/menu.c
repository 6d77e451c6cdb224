/* The menu of all tutorials: pages of pictures; the one that is chosen is written into a file, for tools/run to start
 * it.
 *
 *     menu [-choice FILE] [-at NAME] [options of the viewer]
 *
 * Without -choice nothing is written; -at says which tutorial is marked first. Pictures are textures, which the viewer
 * looks for in $KARMA_TEXTURES; a tutorial without one has a plain field. The names are given by CMake.
 */
#include "MeMessage.h"
#include "MeViewer.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 4, ROWS = 3, PER_PAGE = COLUMNS * ROWS };

static const char *const name[] = {KARMA_TUTORIAL_NAMES};
enum { NAMES = sizeof name / sizeof name[0], PAGES = (NAMES + PER_PAGE - 1) / PER_PAGE, GRAPHICS = 2 * PER_PAGE };

/* Of the window, which is 2 wide and 2 high: a picture, the way to the next one, the first one's upper left corner. */
static const float width = .42f, height = .47f, stepX = .48f, stepY = .585f, left = -.93f, top = .86f;

static RRender *rc;
static RGraphic *onPage[GRAPHICS], *frame;
static int marked;
static const char *choiceFile;

/* ---- what is shown ---------------------------------------------------------------------------------------------- */

static float xOf(int place) {
    return left + stepX * (float)(place % COLUMNS);
}

static float yOf(int place) {
    return top - stepY * (float)(place / COLUMNS);
}

static MeBool hasPicture(const char *tutorial) {
    const char *directory = getenv("KARMA_TEXTURES");
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.png", directory ? directory : ".", tutorial);
    FILE *file = fopen(path, "rb");
    if (file)
        fclose(file);
    return file != 0;
}

static void removePage(void) {
    for (int i = 0; i < GRAPHICS; i++) {
        if (onPage[i])
            RGraphicDelete(rc, onPage[i], 1);
        onPage[i] = 0;
    }
}

static void showPicture(int place, const char *tutorial) {
    static const float asItIs[4] = {1, 1, 1, 1}, plain[4] = {.45f, .48f, .52f, 1}, text[4] = {.13f, .15f, .18f, 1};
    const MeBool isThere = hasPicture(tutorial);
    RGraphic *picture = RGraphic2DRectangleCreate(rc, xOf(place), yOf(place), width, height, isThere ? asItIs : plain);
    if (isThere)
        RGraphicSetTexture(rc, picture, tutorial);
    onPage[2 * place] = picture;
    onPage[2 * place + 1] = RGraphicTextCreate(rc, tutorial, xOf(place), yOf(place) - height - .01f, text);
}

/* A field behind the picture, a little larger. */
static void showFrame(int place) {
    static const float accent[4] = {.90f, .45f, .05f, 1};
    if (frame)
        RGraphicDelete(rc, frame, 1);
    frame = RGraphic2DRectangleCreate(rc, xOf(place) - .012f, yOf(place) + .02f, width + .024f, height + .04f, accent);
}

/* In this order: what comes later is drawn over what was there. */
static void show(void) {
    const int page = marked / PER_PAGE;
    char text[120];
    removePage();
    showFrame(marked % PER_PAGE);
    for (int i = 0; i < PER_PAGE && page * PER_PAGE + i < NAMES; i++)
        showPicture(i, name[page * PER_PAGE + i]);
    snprintf(text, sizeof text, "%s    %d of %d    page %d of %d    Enter starts it", name[marked], marked + 1,
             (int)NAMES, page + 1, (int)PAGES);
    RRenderSetStatusText(rc, text);
}

/* ---- what the user does ----------------------------------------------------------------------------------------- */

static void mark(int which) {
    marked = MeCLAMP(which, 0, NAMES - 1);
    show();
}

static void MEAPI toLeft(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    mark(marked - 1);
}

static void MEAPI toRight(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    mark(marked + 1);
}

static void MEAPI up(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    mark(marked >= COLUMNS ? marked - COLUMNS : marked);
}

static void MEAPI down(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    mark(marked + COLUMNS);
}

static void MEAPI nextPage(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    mark((marked / PER_PAGE + 1) % PAGES * PER_PAGE);
}

static void MEAPI choose(RRender *context, void *userdata) {
    FILE *file = choiceFile ? fopen(choiceFile, "w") : 0;
    (void)context, (void)userdata;
    if (file) {
        fprintf(file, "%s\n", name[marked]);
        if (fclose(file) != 0)
            file = 0;
    }
    if (choiceFile && !file)
        MeWarning(1, "the choice cannot be written into %s", choiceFile);
    RRenderQuit(rc);
}

/* The place of the page at a pixel, or -1. */
static int placeAt(int x, int y) {
    const int page = marked / PER_PAGE;
    float px, py;
    RCalculatePortalCoordinates(rc, 2, 2, x, y, &px, &py);
    for (int i = 0; i < PER_PAGE && page * PER_PAGE + i < NAMES; i++)
        if (px >= xOf(i) && px <= xOf(i) + width && py <= yOf(i) && py >= yOf(i) - height)
            return i;
    return -1;
}

static void MEAPI click(RRender *context, int x, int y, int modifiers, RMouseButtonWhich which, RMouseButtonEvent event,
                        void *userdata) {
    const int place = placeAt(x, y);
    (void)context, (void)modifiers, (void)userdata;
    if (which != kRLeftButton || event != kRNewlyReleased || place < 0)
        return;
    mark(marked / PER_PAGE * PER_PAGE + place);
    choose(rc, 0);
}

/* ---- start ------------------------------------------------------------------------------------------------------ */

static void MEAPI tick(RRender *context) {
    (void)context;
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
}

static int find(const char *tutorial) {
    for (int i = 0; tutorial && i < NAMES; i++)
        if (strcmp(name[i], tutorial) == 0)
            return i;
    return 0;
}

static void createControls(void) {
    static const char *const help[] = {
        "All tutorials of Karma.",
        "$UP, $DOWN, $LEFT, $RIGHT - go to a tutorial",
        "$ACTION1 - the next page",
        "$ACTION2 or a click - start it; the menu comes back when it ends",
    };
    static const float title[4] = {.13f, .15f, .18f, 1};
    RRenderSetWindowTitle(rc, "Karma tutorials");
    RRenderSetAppName(rc, "menu");
    RRenderCreateUserHelp(rc, help, 4);
    RGraphicTextCreate(rc, "Karma tutorials    arrow keys and Enter, or a click; F1 help", left, .96f, title);
    RRenderSetLeftCallBack(rc, toLeft, 0);
    RRenderSetRightCallBack(rc, toRight, 0);
    RRenderSetUpCallBack(rc, up, 0);
    RRenderSetDownCallBack(rc, down, 0);
    RRenderSetActionNCallBack(rc, 1, nextPage, 0);
    RRenderSetActionNCallBack(rc, 2, choose, 0);
    RRenderSetMouseCallBack(rc, click, 0);
}

/* The texts of our own options belong to them, so that they live as long as the program. */
int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    choiceFile =
        MeCommandLineOptionsCheckFor(options, "-choice", 0) ? MeCommandLineOptionsGetString(options, "-choice", 1) : 0;
    marked =
        find(MeCommandLineOptionsCheckFor(options, "-at", 0) ? MeCommandLineOptionsGetString(options, "-at", 1) : 0);
    rc = RRenderContextCreate(options, 0, 1);
    if (!rc)
        return 1;
    atexit(cleanup);
    createControls();
    show();
    RRun(rc, tick); /* does not return */
    return 0;
}
