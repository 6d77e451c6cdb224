/* Pictures of a run: their names, and when they are written. */
#define _POSIX_C_SOURCE 200809L /* access */
#include "r_i.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 320 };

/* In full quality, though the window may have less. */
static void drawForFile(RRender *rc) {
    RLoop *loop = &rc->m_pViewer->loop;
    const int level = r_qualityLevel(rc);
    loop->saving = true;
    if (r_qualityLevel(rc) != level && !loop->quit) /* After that there may be no window any more. */
        loop->isDrawn = false;
    r_drawNow(rc);
    loop->saving = false;
}

static bool save(RRender *rc, const char *path) {
    RPicture picture;
    if (!rc->m_pViewer->backend->draws) {
        MeWarning(1, "no picture %s: nothing is drawn with -null", path);
        return false;
    }
    drawForFile(rc);
    if (!r_drawRead(rc, &picture)) {
        MeWarning(1, "no picture %s: nothing has been drawn, or the window is closed", path);
        return false;
    }
    const bool done = r_writePng(path, &picture);
    r_free(picture.rgba);
    return done;
}

static void printMessage(const RRender *rc, const char *what) {
    MeInfo(0, "wrote %s (%dx%d)", what, rc->m_pViewer->width, rc->m_pViewer->height);
    fflush(stdout); /* Somebody may be waiting for it at the other end of a pipe. */
}

/* The program's name as part of a file's name. */
static void baseName(const RRender *rc, char *out, size_t size) {
    snprintf(out, size, "%s", rc->m_AppName[0] ? rc->m_AppName : r_programName());
    for (char *c = out; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("-_.", *c))
            *c = '-';
}

/* FILE.png becomes FILE-0001.png. */
static void numbered(const char *file, int number, char *out) {
    const char *dot = strrchr(file, '.'), *slash = strrchr(file, '/');
    const int stem = (int)(dot && (!slash || dot > slash) ? dot - file : (long)strlen(file));
    snprintf(out, PATH_SIZE, "%.*s-%04d%s", stem, file, number, stem < (int)strlen(file) ? dot : ".png");
}

/* F2: the next number that is free in the working directory. */
static void writeRequested(RRender *rc) {
    char base[64], file[80], path[PATH_SIZE];
    baseName(rc, base, sizeof base);
    snprintf(file, sizeof file, "%s.png", base);
    for (int i = 1; i < 10000; i++) {
        numbered(file, i, path);
        if (access(path, F_OK) != 0)
            break;
    }
    if (save(rc, path))
        printMessage(rc, path);
}

void r_pictureFrame(RRender *rc) {
    RLoop *loop = &rc->m_pViewer->loop;
    const RRenderOptions *o = &rc->m_Options;
    char path[PATH_SIZE];
    r_filmFrame(rc);
    if (loop->pictureRequested) {
        loop->pictureRequested = false;
        writeRequested(rc);
    }
    if (o->m_nEvery && o->m_Screenshot[0] && loop->frames % o->m_nEvery == 0) {
        numbered(o->m_Screenshot, loop->pictures + 1, path);
        loop->pictures += save(rc, path);
    }
}

void r_pictureEnd(RRender *rc) {
    const RRenderOptions *o = &rc->m_Options;
    const bool series = o->m_nEvery && o->m_Screenshot[0];
    char path[PATH_SIZE], text[PATH_SIZE + 64];
    r_filmEnd(rc);
    if (series) {
        numbered(o->m_Screenshot, rc->m_pViewer->loop.pictures, path);
        snprintf(text, sizeof text, "%d pictures, the last one %s", rc->m_pViewer->loop.pictures, path);
        if (rc->m_pViewer->loop.pictures > 0)
            printMessage(rc, text);
        return;
    }
    if (o->m_Screenshot[0]) {
        snprintf(path, sizeof path, "%s", o->m_Screenshot);
    } else if (rc->m_pViewer->backend->type == kROSMesa && !o->m_Film[0]) {
        baseName(rc, path, sizeof path - 4);
        strcat(path, ".png");
    } else {
        return;
    }
    if (save(rc, path))
        printMessage(rc, path);
}
