/* Contexts: their life, their defaults, and what is said about them as a whole. */
#define _GNU_SOURCE /* program_invocation_short_name */
#include "r_i.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "MeDebugDraw.h"
#include "MeVersion.h"

/* Okabe and Ito's colours, muted so that none of them shouts. */
const float RPalette[8][4] = {
    {0.20f, 0.47f, 0.71f, 1}, /* blue */
    {0.90f, 0.58f, 0.20f, 1}, /* orange */
    {0.22f, 0.62f, 0.51f, 1}, /* green */
    {0.79f, 0.37f, 0.29f, 1}, /* vermilion */
    {0.95f, 0.83f, 0.42f, 1}, /* yellow */
    {0.51f, 0.73f, 0.88f, 1}, /* sky */
    {0.72f, 0.51f, 0.65f, 1}, /* mauve */
    {0.55f, 0.57f, 0.60f, 1}, /* grey */
};

/* All live contexts; MeWarning is listened to while there is one. */
static RRender *contexts;
static MeHandler handlerBefore;
static int warnings;
static MeDebugLineFuncPtr debugLineBefore; /* Of MeDebugDrawAPI; called as well. */

static void countWarning(const int level, const char *const format, va_list ap) {
    warnings++;
    if (handlerBefore)
        handlerBefore(level, format, ap);
}

int r_warnings(void) {
    return warnings;
}

const char *r_programName(void) {
    return program_invocation_short_name;
}

bool r_isLive(const RRender *rc) {
    for (const RRender *c = contexts; c; c = c->m_pViewer->next)
        if (c == rc)
            return true;
    return false;
}

bool r_isContext(const RRender *rc, const char *function) {
    if (rc && r_isLive(rc))
        return true;
    MeWarning(1, rc ? "%s: the context has been destroyed, or is none" : "%s: the context is null", function);
    return false;
}

/* The youngest context shows what Karma draws of itself. */
static void MEAPI drawDebugLine(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b) {
    if (debugLineBefore)
        debugLineBefore(start, end, r, g, b);
    if (contexts)
        r_debugLine(contexts, start, end, r, g, b);
}

static void addContext(RRender *rc) {
    MEASSERT(!r_isLive(rc));
    if (!contexts) {
        debugLineBefore = MeDebugDrawAPI.line;
        MeDebugDrawAPI.line = drawDebugLine;
        warnings = 0;
        handlerBefore = MeSetWarningHandler(countWarning);
    }
    rc->m_pViewer->next = contexts;
    contexts = rc;
}

static void removeContext(RRender *rc) {
    RRender **link = &contexts;
    while (*link != rc)
        link = &(*link)->m_pViewer->next;
    *link = rc->m_pViewer->next;
    if (!contexts && MeDebugDrawAPI.line == drawDebugLine)
        MeDebugDrawAPI.line = debugLineBefore;
    /* Somebody may have put a handler of their own in front of ours: then that one stays. */
    if (!contexts && MeWarningHandler == countWarning)
        MeSetWarningHandler(handlerBefore);
}

static void setDefaults(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    snprintf(rc->m_AppName, sizeof rc->m_AppName, "%s", r_programName());
    rc->m_Quality = kRQualitySmooth;
    rc->m_nCapabilities = RMOUSE | RTEXT | RLINES | RAMBIENT | RDIFFUSE | REMISSIVE | RSPECULAR | RWIREFRAME |
                          RFLATSHADED | RSMOOTH | RTEXTURES | MENUS | ASSIGNABLEBUTTONS;
    v->fps = -1;
    v->tickRate = 60;
    v->pictureQuality = R_QUALITY_AUTO;
    r_qualityRestart(&v->quality);
    v->ground = -1;
    v->sphereSides = 48;
    v->shadows = true;
    r_cameraInit(rc);
    r_lightsInit(rc);
    r_inputInit(&v->input);
}

static RRender *allocate(void) {
    RRender *rc = r_alloc(sizeof *rc);
    struct RViewer *v = r_alloc(sizeof *v);
    if (!rc || !v) {
        r_free(rc);
        r_free(v);
        return NULL;
    }
    rc->m_pViewer = v;
    return rc;
}

void r_setScale(RRender *rc, float scale) {
    struct RViewer *v = rc->m_pViewer;
    const float by = rc->m_Options.m_bSize ? 1 : scale;
    v->scale = scale;
    v->width = (int)lroundf(by * (float)rc->m_Options.m_nWidth);
    v->height = (int)lroundf(by * (float)rc->m_Options.m_nHeight);
}

RRender *MEAPI RRenderContextCreate2(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions, int eat,
                                     void *pWnd, RCreateCallback cb) {
    if (pWnd) {
        MeWarning(1, "%s: pWnd must be null: the viewer draws into a window of its own", __func__);
        return NULL;
    }
    RRender *rc = allocate();
    if (!rc)
        return NULL;
    addContext(rc);
    setDefaults(rc);
    struct RViewer *v = rc->m_pViewer;
    v->isMistaken = !r_optionsRead(&rc->m_Options, options, overrideoptions, eat != 0);
    r_setScale(rc, rc->m_Options.m_Scale > 0 ? rc->m_Options.m_Scale : 1);
    rc->m_bPause = rc->m_Options.m_bPaused;
    if (!r_inputScript(rc, rc->m_Options.m_Keys))
        v->isMistaken = true;
    if (cb)
        cb(rc);
    if (!RInit(rc)) {
        RRenderContextDestroy(rc);
        return NULL;
    }
    return rc;
}

RRender *MEAPI RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions, MeBool eat) {
    return RRenderContextCreate2(options, overrideoptions, eat, NULL, NULL);
}

/* Starts one backend and, if it draws, the drawing on it. */
static bool start(RRender *rc, const RBackend *backend, char *reason, size_t size) {
    struct RViewer *v = rc->m_pViewer;
    if (!backend->start(rc, reason, size))
        return false;
    v->backend = backend;
    if (backend->draws && !(r_panelsStart(rc) && r_drawStart(rc, reason, size))) {
        r_panelsFree(rc);
        backend->stop(rc);
        v->backend = NULL;
        return false;
    }
    rc->m_RenderType = rc->m_Options.m_Type == kRBenchmark ? kRBenchmark : backend->type;
    return true;
}

/* Nobody chose: a window if there can be one, else a buffer. */
static bool startDefault(RRender *rc, char *reason, size_t size) {
    const char *display = getenv("DISPLAY");
    if (display && *display) {
        if (start(rc, &r_backendGlut, reason, size))
            return true;
        MeInfo(1, "MeViewer: no window (%s): drawing off-screen", reason);
    }
    return start(rc, &r_backendOsmesa, reason, size);
}

int MEAPI RInit(RRender *rc) {
    if (!r_isContext(rc, __func__))
        return 0;
    if (rc->m_pViewer->backend) {
        MeWarning(1, "%s: the context has been started already", __func__);
        return 0;
    }
    char reason[256] = "";
    bool started = false;
    const char *advice = "try -osmesa (off-screen) or -null";
    switch (rc->m_Options.m_Type) {
    case kROpenGL:
        started = start(rc, &r_backendGlut, reason, sizeof reason);
        break;
    case kROSMesa:
        started = start(rc, &r_backendOsmesa, reason, sizeof reason);
        advice = "try -gl (a window) or -null, or install the package libosmesa6";
        break;
    case kRNull:
    case kRBenchmark:
        started = start(rc, &r_backendNull, reason, sizeof reason);
        break;
    default:
        started = startDefault(rc, reason, sizeof reason);
        advice = "try -null, or install the package libosmesa6";
        break;
    }
    if (!started)
        MeWarning(1, "MeViewer: cannot draw: %s; %s", reason, advice);
    return started;
}

static void freeState(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    r_barFree(rc);
    r_particlesFree(rc); /* Before the graphics, which are theirs. */
    r_graphicFreeAll(rc);
    MEASSERT(!rc->m_p3DGraphics && !rc->m_p2DGraphics && !v->last3D && !v->last2D);
    r_linesFree(rc);
    r_menusFree(rc);
    r_helpFree(&v->help);
    r_parametersFree(&v->parameters);
    r_filmEnd(rc);
    r_panelsFree(rc);
    r_panelListFree(&v->panelList);
    r_overlayFree(&v->overlay);
    r_texturesFree(&v->textures);
    r_inputFree(&v->input);
    r_free(v->title);
    r_free(v->status);
}

int MEAPI RRenderContextDestroy(RRender *rc) {
    if (!r_isContext(rc, __func__))
        return 1;
    struct RViewer *v = rc->m_pViewer;
    if (v->overlaying) {
        MeWarning(1, "%s: not by the function of a panel or of marks: RRenderQuit ends the program", __func__);
        return 1;
    }
    if (v->backend) {
        if (v->backend->draws)
            r_drawStop(rc);
        v->backend->stop(rc);
    }
    freeState(rc);
    removeContext(rc);
    r_free(v);
    r_free(rc);
    return 0;
}

void MEAPI RRenderQuit(RRender *rc) {
    if (r_isContext(rc, __func__))
        rc->m_pViewer->loop.quit = true;
}

static void replaceText(char **where, const char *text) {
    r_free(*where);
    *where = text && *text ? r_copyText(text) : NULL;
}

void MEAPI RRenderSetWindowTitle(RRender *rc, const char *title) {
    if (!r_isContext(rc, __func__) || !r_isPointer(title, __func__, "title"))
        return;
    replaceText(&rc->m_pViewer->title, title);
    if (rc->m_pViewer->backend)
        rc->m_pViewer->backend->title(rc, title);
}

void MEAPI RRenderSetAppName(RRender *rc, const char *appname) {
    if (r_isContext(rc, __func__) && r_isPointer(appname, __func__, "appname"))
        snprintf(rc->m_AppName, sizeof rc->m_AppName, "%s", appname);
}

void MEAPI RRenderSetBackgroundColor(RRender *rc, const float color[4]) {
    if (!r_isContext(rc, __func__) || !r_isFinite(color, 3, __func__, "color"))
        return;
    memcpy(rc->m_pViewer->background, color, sizeof rc->m_pViewer->background);
    rc->m_pViewer->hasBackground = true;
}

void MEAPI RRenderSetTickRate(RRender *rc, AcmeReal ticksPerSecond) {
    if (!r_isContext(rc, __func__))
        return;
    if (!(ticksPerSecond > 0 && ticksPerSecond <= 1e6f))
        MeWarning(1, "RRenderSetTickRate: %g ticks a second: it must be above 0, and a million at most",
                  (double)ticksPerSecond);
    else
        rc->m_pViewer->tickRate = ticksPerSecond;
}

void MEAPI RRenderSetPause(RRender *rc, int p) {
    if (r_isContext(rc, __func__))
        rc->m_bPause = p != 0;
}

void MEAPI RRenderSetStatusText(RRender *rc, const char *text) {
    if (r_isContext(rc, __func__))
        replaceText(&rc->m_pViewer->status, text);
}

void MEAPI RRenderDisplayFps(RRender *rc, AcmeReal fps) {
    if (r_isContext(rc, __func__) && r_isNumber(fps, __func__, "fps"))
        rc->m_pViewer->fps = fps;
}

void MEAPI RRenderSetSphereResolution(RRender *r, int res) {
    if (!r_isContext(r, __func__))
        return;
    if (res < 8 || res > 256)
        MeWarning(1, "%s: res is %d: it must be 8 to 256", __func__, res);
    else
        r->m_pViewer->sphereSides = res;
}

int MEAPI RRenderGetSphereResolution(RRender *r) {
    return r_isContext(r, __func__) ? r->m_pViewer->sphereSides : 0;
}

void MEAPI RDisplayBanner(void) {
    MeInfo(0, "%s viewer", MeToolkitVersionString());
}
