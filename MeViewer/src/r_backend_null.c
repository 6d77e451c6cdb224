/* The backend of -null and -bench: nothing is drawn. */
#include "r_i.h"

static bool start(RRender *rc, char *reason, size_t size) {
    (void)rc;
    (void)reason;
    (void)size;
    return true;
}

static void nothing(RRender *rc) {
    (void)rc;
}

static void title(RRender *rc, const char *text) {
    (void)rc;
    (void)text;
}

static RProc proc(const char *name) {
    (void)name;
    return NULL;
}

static bool makeCurrent(const RRender *rc) {
    (void)rc;
    return false;
}

const RBackend r_backendNull = {"-null", kRNull,  false, false, start,      nothing,
                                nothing, nothing, title, proc,  makeCurrent};
