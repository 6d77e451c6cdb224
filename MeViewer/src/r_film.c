/* A film of a run: its pictures into ffmpeg, which makes a file of them that plays as fast as the simulation ran. */
#define _POSIX_C_SOURCE 200809L /* popen, access */
#include "r_i.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* A tick is a sixtieth of a second; of every two one is taken, of a GIF, whose times are whole hundredths, of every
 * three. */
enum { TICKS_PER_SECOND = 60 };

static bool isGif(const char *file) {
    const size_t length = strlen(file);
    return length > 4 && strcmp(file + length - 4, ".gif") == 0;
}

static int ticksPerPicture(const char *file) {
    return isGif(file) ? 3 : 2;
}

/* As the shell looks for it, in each directory of PATH. */
bool r_filmHasMaker(void) {
    char file[1024];
    const char *place = getenv("PATH") ? getenv("PATH") : "/usr/local/bin:/usr/bin:/bin";
    for (size_t length; *place; place += length + (place[length] == ':')) {
        length = strcspn(place, ":");
        snprintf(file, sizeof file, "%.*s/ffmpeg", length ? (int)length : 1, length ? place : ".");
        if (access(file, X_OK) == 0)
            return true;
    }
    return false;
}

/* For the shell: in single quotes, with those in it made safe. */
static void quoted(const char *text, char *out, size_t size) {
    size_t n = 0;
    for (out[n++] = '\''; *text && n + 6 < size; text++) {
        if (*text == '\'')
            n += (size_t)snprintf(out + n, size - n, "'\\''");
        else
            out[n++] = *text;
    }
    snprintf(out + n, size - n, "'");
}

static bool start(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    char command[2048], file[1024];
    quoted(rc->m_Options.m_Film, file, sizeof file);
    /* A GIF has a palette of its own; films of other kinds have an even size, and colours that all players know. */
    snprintf(command, sizeof command,
             "ffmpeg -y -loglevel error -f rawvideo -pixel_format rgba -video_size %dx%d -framerate %d -i - %s %s",
             v->width, v->height, TICKS_PER_SECOND / ticksPerPicture(rc->m_Options.m_Film),
             isGif(rc->m_Options.m_Film) ? "-vf 'split[a][b];[a]palettegen[p];[b][p]paletteuse'"
                                         : "-vf 'crop=trunc(iw/2)*2:trunc(ih/2)*2' -pix_fmt yuv420p",
             file);
    fflush(NULL);
    v->film.pipe = popen(command, "w");
    v->film.width = v->width;
    v->film.height = v->height;
    return v->film.pipe != NULL;
}

static bool writePicture(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    RPicture picture;
    r_drawNow(rc);
    if (!r_drawRead(rc, &picture))
        return false;
    const bool fits = picture.width == v->film.width && picture.height == v->film.height;
    const size_t bytes = 4 * (size_t)picture.width * (size_t)picture.height;
    const bool done = fits && fwrite(picture.rgba, 1, bytes, v->film.pipe) == bytes;
    if (!fits)
        MeWarning(1, "-film: the window has another size than when the film began, which ends here");
    r_free(picture.rgba);
    return done;
}

/* ffmpeg may have ended: that is told by what is written, and must not end this program. */
void r_filmFrame(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!rc->m_Options.m_Film[0] || v->film.ended || v->loop.ticks == v->film.lastTick ||
        v->loop.ticks % ticksPerPicture(rc->m_Options.m_Film) != 0)
        return;
    if (!v->backend->draws) {
        MeWarning(1, "-film %s: nothing is drawn with -null", rc->m_Options.m_Film);
        v->film.ended = true;
        return;
    }
    v->film.lastTick = v->loop.ticks;
    void (*const before)(int) = signal(SIGPIPE, SIG_IGN);
    if ((!v->film.pipe && !start(rc)) || !writePicture(rc))
        v->film.ended = true;
    else
        v->film.pictures++;
    signal(SIGPIPE, before);
}

void r_filmEnd(RRender *rc) {
    struct RViewer *v = rc->m_pViewer;
    if (!v->film.pipe)
        return;
    void (*const before)(int) = signal(SIGPIPE, SIG_IGN);
    const int status = pclose(v->film.pipe);
    signal(SIGPIPE, before);
    v->film.pipe = NULL;
    v->film.ended = true;
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        MeWarning(1, "-film %s: ffmpeg could not make the film", rc->m_Options.m_Film);
    else
        MeInfo(0, "wrote %s (%dx%d, %d pictures)", rc->m_Options.m_Film, v->film.width, v->film.height,
               v->film.pictures);
}
