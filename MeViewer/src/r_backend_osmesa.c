/* The backend of -osmesa: Mesa's software renderer, without a window.
 *
 * libOSMesa is loaded when it is needed, and privately. It has functions of the same names as libGL; were both linked,
 * the order of the libraries would decide which ones freeglut gets. And a program that opens a window, or draws
 * nothing, need not wait for LLVM. */
#include "r_i.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    OSMesaContext context;
    uint32_t buffer[16 * 16]; /* Mesa wants one; the picture is in a framebuffer object. */
} State;

static struct {
    void *library;
    OSMesaContext (*create)(const int *attributes, OSMesaContext share);
    GLboolean (*makeCurrent)(OSMesaContext context, void *buffer, GLenum type, GLsizei width, GLsizei height);
    OSMESAproc (*getProc)(const char *name);
    OSMesaContext (*getCurrent)(void);
    void (*destroy)(OSMesaContext context);
} mesa;

/* A function's address as a function pointer, which ISO C does not convert to. */
static bool find(const char *name, void *function, size_t size) {
    void *address = dlsym(mesa.library, name);
    memcpy(function, &address, size);
    return address != NULL;
}

/* Stays loaded: it does not bear being unloaded. */
static bool load(char *reason, size_t size) {
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !mesa.library; i++)
        mesa.library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (!mesa.library) {
        snprintf(reason, size, "the library OSMesa cannot be loaded (%s)", dlerror());
        return false;
    }
    if (find("OSMesaCreateContextAttribs", &mesa.create, sizeof mesa.create) &&
        find("OSMesaMakeCurrent", &mesa.makeCurrent, sizeof mesa.makeCurrent) &&
        find("OSMesaGetProcAddress", &mesa.getProc, sizeof mesa.getProc) &&
        find("OSMesaGetCurrentContext", &mesa.getCurrent, sizeof mesa.getCurrent) &&
        find("OSMesaDestroyContext", &mesa.destroy, sizeof mesa.destroy))
        return true;
    snprintf(reason, size, "the library OSMesa is too old");
    return false;
}

static void stop(RRender *rc) {
    State *s = rc->m_pViewer->backendState;
    mesa.destroy(s->context);
    r_free(s);
    rc->m_pViewer->backendState = NULL;
}

static bool start(RRender *rc, char *reason, size_t size) {
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    if (!load(reason, size))
        return false;
    State *s = r_alloc(sizeof *s);
    if (!s) {
        snprintf(reason, size, "there is no memory");
        return false;
    }
    rc->m_pViewer->backendState = s;
    s->context = mesa.create(attributes, NULL);
    if (s->context && mesa.makeCurrent(s->context, s->buffer, GL_UNSIGNED_BYTE, 16, 16))
        return true;
    snprintf(reason, size, "OSMesa cannot make a context of OpenGL 3.3");
    if (s->context)
        stop(rc);
    else
        r_free(s);
    rc->m_pViewer->backendState = NULL;
    return false;
}

static void nothing(RRender *rc) {
    (void)rc;
}

static void title(RRender *rc, const char *text) {
    (void)rc;
    (void)text;
}

static RProc proc(const char *name) {
    return (RProc)mesa.getProc(name);
}

static bool makeCurrent(const RRender *rc) {
    State *s = rc->m_pViewer->backendState;
    return mesa.getCurrent() == s->context || mesa.makeCurrent(s->context, s->buffer, GL_UNSIGNED_BYTE, 16, 16);
}

const RBackend r_backendOsmesa = {"-osmesa", kROSMesa, true,  false, start,      stop,
                                  nothing,   nothing,  title, proc,  makeCurrent};
