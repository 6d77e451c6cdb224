/* What the command line and $KARMA_VIEWER say: where to draw, how long, and what to keep of it. */
#define _POSIX_C_SOURCE 200809L /* S_ISDIR */
#include "r_i.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* All sets of options, asked as one; an earlier set wins. */
enum { OVERRIDING, PROGRAM, ENVIRONMENT, SETS };
typedef struct {
    MeCommandLineOptions *sets[SETS];
    bool eat[SETS];
    bool *mistaken; /* Set where a value cannot be used, which has been told then. */
} Source;

/* The words of $KARMA_VIEWER, as if they stood on the command line; null if there are none. */
static MeCommandLineOptions *environmentOptions(void) {
    enum { WORDS = 64 };
    const char *argv[WORDS] = {"KARMA_VIEWER"}, *value = getenv("KARMA_VIEWER");
    char *text = value ? r_copyText(value) : NULL;
    int argc = 1;
    for (char *at = text; at && *at;) {
        if (isspace((unsigned char)*at)) {
            *at++ = 0;
            continue;
        }
        if (argc == WORDS) {
            MeWarning(1, "KARMA_VIEWER: only its first %d words are read: write fewer", WORDS - 1);
            break;
        }
        argv[argc++] = at;
        while (*at && !isspace((unsigned char)*at))
            at++;
    }
    MeCommandLineOptions *options = argc > 1 ? MeCommandLineOptionsCreate(argc, argv) : NULL;
    r_free(text);
    return options;
}

/* Nobody else reads these options: what is left of them is a mistake. */
static void finishEnvironment(const Source *s) {
    if (r_refuseOthers(s->sets[ENVIRONMENT]))
        *s->mistaken = true;
    MeCommandLineOptionsDestroy(s->sets[ENVIRONMENT]);
}

/* A value that cannot be used: the option counts as not given. */
static void mistake(const Source *s, const char *name, const char *value, const char *instead) {
    MeWarning(1, "%s %s: write %s", name, value, instead);
    *s->mistaken = true;
}

static bool has(const Source *s, const char *name) {
    bool found = false;
    for (int i = 0; i < SETS; i++)
        if (MeCommandLineOptionsCheckFor(s->sets[i], name, s->eat[i]))
            found = true;
    return found;
}

/* The text after an option; false if it is not there, or too long. MeGlobals warns when the text alone is missing. */
static bool getText(const Source *s, const char *name, char *out, size_t size) {
    bool found = false;
    for (int i = 0; i < SETS; i++) {
        const bool given = MeCommandLineOptionsGetPos(s->sets[i], name) > 0;
        const char *text = MeCommandLineOptionsGetString(s->sets[i], name, s->eat[i]);
        if (given && !text)
            *s->mistaken = true;
        if (text && !found) {
            found = snprintf(out, size, "%s", text) < (int)size;
            if (!found) {
                *out = 0;
                mistake(s, name, text, "a shorter value");
            }
        }
    }
    return found;
}

static int getCount(const Source *s, const char *name) {
    char text[64], *end;
    if (!getText(s, name, text, sizeof text))
        return 0;
    const long value = strtol(text, &end, 10);
    if (end != text && !*end && value > 0 && value < 1000000000)
        return (int)value;
    mistake(s, name, text, "a whole number above 0, as in 60");
    return 0;
}

static void getSize(const Source *s, RRenderOptions *out) {
    char text[64], rest;
    int width, height;
    if (!getText(s, "-size", text, sizeof text))
        return;
    if (sscanf(text, "%dx%d%c", &width, &height, &rest) == 2 && width >= 16 && height >= 16 && width <= 16384 &&
        height <= 16384) {
        out->m_bSize = 1;
        out->m_nWidth = width;
        out->m_nHeight = height;
        return;
    }
    mistake(s, "-size", text, "WIDTHxHEIGHT, each 16 to 16384, as in 960x600");
}

/* The same at another density of pixels: text, lines, and the window, if its size is not given. */
static void getScale(const Source *s, RRenderOptions *out) {
    char text[64], rest;
    float scale;
    if (!getText(s, "-scale", text, sizeof text))
        return;
    if (sscanf(text, "%f%c", &scale, &rest) == 1 && scale >= .5f && scale <= 4)
        out->m_Scale = scale;
    else
        mistake(s, "-scale", text, "a number from 0.5 to 4, as in 2");
}

static void getCamera(const Source *s, RRenderOptions *out) {
    char text[128], rest;
    float view[3];
    if (!getText(s, "-camera", text, sizeof text))
        return;
    if (sscanf(text, "%f,%f,%f%c", &view[0], &view[1], &view[2], &rest) == 3 && isfinite(view[0]) &&
        isfinite(view[1]) && isfinite(view[2]) && view[0] > 0) {
        memcpy(out->m_Camera, view, sizeof view);
        out->m_bCamera = 1;
        return;
    }
    mistake(s, "-camera", text, "DISTANCE,THETA,PHI, as in 20,0.5,0.3");
}

static void getAdvise(const Source *s, RRenderOptions *out) {
    char text[64], rest;
    float at[2] = {0, 0};
    if (!getText(s, "-advise", text, sizeof text))
        return;
    const int count = sscanf(text, "%f@%f%c", &at[0], &at[1], &rest);
    if ((count == 2 || (count == 1 && !strchr(text, '@') && sscanf(text, "%f%c", &at[0], &rest) == 1)) &&
        isfinite(at[0]) && isfinite(at[1]) && at[0] > 0 && at[1] >= 0) {
        memcpy(out->m_Advise, at, sizeof at);
        return;
    }
    mistake(s, "-advise", text, "SECONDS or SECONDS@START, as in 3 or 3@2");
}

static void getQuality(const Source *s, RRenderOptions *out) {
    char text[64];
    if (!getText(s, "-quality", text, sizeof text))
        return;
    const bool isAuto = strcmp(text, "auto") == 0;
    out->m_bQuality = isAuto || (text[0] >= '0' && text[0] <= '0' + R_QUALITY_FULL && !text[1]);
    out->m_nQuality = isAuto ? R_QUALITY_AUTO : text[0] - '0';
    if (!out->m_bQuality)
        mistake(s, "-quality", text, "auto, or 0 (fastest) to 3 (best)");
}

static void getGround(const Source *s, RRenderOptions *out) {
    char text[64];
    out->m_Ground = -1;
    if (!getText(s, "-ground", text, sizeof text))
        return;
    for (int i = 0; i < R_GROUNDS; i++)
        if (strcmp(text, r_groundNames[i]) == 0)
            out->m_Ground = i;
    if (out->m_Ground < 0)
        mistake(s, "-ground", text, "grid, checker, plain or earth");
}

/* A file to be written: where its directory is missing, the run would be for nothing. */
static void getFile(const Source *s, const char *name, char *out, size_t size) {
    char directory[512];
    struct stat status;
    if (!getText(s, name, out, size))
        return;
    const char *slash = strrchr(out, '/');
    snprintf(directory, sizeof directory, "%.*s", slash == out ? 1 : slash ? (int)(slash - out) : 0, out);
    if (!slash || (stat(directory, &status) == 0 && S_ISDIR(status.st_mode)))
        return;
    MeWarning(1, "%s %s: there is no directory %s: make it first, or write another", name, out, directory);
    *s->mistaken = true;
    *out = 0;
}

/* Where there is nothing that makes a film, the run would be for nothing, too. */
static void getFilm(const Source *s, RRenderOptions *out) {
    getFile(s, "-film", out->m_Film, sizeof out->m_Film);
    if (!out->m_Film[0] || r_filmHasMaker())
        return;
    MeWarning(1, "-film %s: ffmpeg is not installed: on Debian `apt-get install ffmpeg` does that", out->m_Film);
    *s->mistaken = true;
    out->m_Film[0] = 0;
}

static const struct {
    const char *option;
    RRenderType type;
} places[] = {{"-gl", kROpenGL}, {"-osmesa", kROSMesa}, {"-null", kRNull}, {"-bench", kRBenchmark}, {"-d3d", kROpenGL}};
enum { PLACES = sizeof places / sizeof places[0] };

/* Of the places that one set names, the first. */
static int firstPlace(MeCommandLineOptions *options) {
    int best = -1, bestPosition = 0;
    for (int i = 0; i < PLACES; i++) {
        const int position = MeCommandLineOptionsGetPos(options, places[i].option);
        if (position > 0 && (best < 0 || position < bestPosition)) {
            best = i;
            bestPosition = position;
        }
    }
    return best;
}

static RRenderType getPlace(const Source *s) {
    int place = -1;
    for (int i = 0; i < SETS && place < 0; i++)
        place = firstPlace(s->sets[i]);
    for (int i = 0; i < PLACES; i++)
        (void)has(s, places[i].option); /* Eats it. */
    if (place < 0)
        return kRDefault;
    if (strcmp(places[place].option, "-d3d") == 0)
        MeWarning(1, "-d3d: there is no Direct3D on this platform; using -gl");
    return places[place].type;
}

/* Several messages: one holds MeMAXMESSAGE bytes. */
void MEAPI RDisplayCommandLineHelp(void) {
    MeInfo(0, "Where to draw (without a choice: a window if there can be one, else off-screen):\n"
              "  -gl                  a window\n"
              "  -osmesa              an off-screen buffer; 60 frames, and a picture NAME.png, unless told otherwise\n"
              "  -null, -bench        nowhere, as fast as possible\n"
              "  -size WxH            pixels, at first 960x600\n"
              "  -scale S             text and lines S times as large; at first as the display's density asks for\n"
              "  -ground NAME         grid, checker, plain or earth, instead of the program's\n"
              "  -camera D,THETA,PHI  distance and angles (radians), instead of the program's\n"
              "  -quality auto|0..3   of a window's picture, 3 is best; at first auto: so that 30 frames/s hold");
    MeInfo(0, "How long:\n"
              "  -frames N            stop after N frames; the exit code is then 2 if there were warnings, else 0\n"
              "  -paused              begin paused\n"
              "  -key NAME@FRAME,...  press keys: F1@30,Enter@60,Ctrl+Left@61,a@70; hold: Up@10-70\n"
              "  -rate N              ticks in a second of the clock, at first 60; in a window without -frames\n"
              "  -workers N           simulate on N threads, with the same result; programs of MeAppStart\n"
              "  -advise S[@START]    try settings on S seconds of the scene, print what they gain and lose, and end;\n"
              "                       begin after START seconds; draws nowhere; programs of MeAppStart");
    MeInfo(0, "What to keep:\n"
              "  -screenshot FILE     a PNG picture of the last frame\n"
              "  -every N             with -screenshot: every N frames one, FILE-0001.png and so on; without a window\n"
              "                       the figures are printed every N frames, too\n"
              "  -film FILE           a film by ffmpeg, .mp4 or .gif, that plays as fast as the simulation ran\n"
              "  -bar                 show the performance bar off-screen too\n"
              "  -profile             print how long everything took\n"
              "  -help, --help, -h    this text\n"
              "The environment variable KARMA_VIEWER may hold options too; those on the command line win.");
}

static bool wantsHelp(const Source *s) {
    const bool one = has(s, "-help"), other = has(s, "--help"), letter = has(s, "-h");
    return one || other || letter;
}

bool r_optionsRead(RRenderOptions *out, MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions,
                   bool eat) {
    bool mistaken = false;
    const Source source = {{overrideoptions, options, environmentOptions()}, {eat, eat, true}, &mistaken}, *s = &source;
    if (wantsHelp(s)) {
        RDisplayCommandLineHelp();
        exit(EXIT_SUCCESS);
    }
    out->m_Type = getPlace(s);
    getAdvise(s, out);
    if (out->m_Advise[0] > 0)
        out->m_Type = kRNull; /* copies of the process would draw into the same window */
    out->m_nWidth = 960;
    out->m_nHeight = 600;
    getSize(s, out);
    getScale(s, out);
    getGround(s, out);
    getCamera(s, out);
    out->m_nFrames = getCount(s, "-frames");
    out->m_nWorkers = getCount(s, "-workers");
    out->m_nRate = getCount(s, "-rate");
    out->m_nEvery = getCount(s, "-every");
    getQuality(s, out);
    out->m_bPaused = has(s, "-paused");
    out->m_bBar = has(s, "-bar");
    out->m_bProfile = has(s, "-profile");
    getFile(s, "-screenshot", out->m_Screenshot, sizeof out->m_Screenshot);
    getFilm(s, out);
    (void)getText(s, "-key", out->m_Keys, sizeof out->m_Keys);
    finishEnvironment(s);
    return !mistaken;
}
