/* Five kinds of messages, each with a limit, a handler and a show function. */
#include "MeMessage_i.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int MeInfoLevel = 1, MeDebugLevel = -1, MeLogLevel = 1, MeWarningLevel = 5, MeFatalErrorLevel = 5;

MeHandler MeInfoHandler = MeHandlerInfo, MeDebugHandler = MeHandlerDebug, MeLogHandler = MeHandlerLog,
          MeWarningHandler = MeHandlerWarning, MeFatalErrorHandler = MeHandlerFatalError;
MeShow MeInfoShow = MeShowStdout, MeDebugShow = MeShowStderr, MeLogShow = MeShowStderr, MeWarningShow = MeShowStderr,
       MeFatalErrorShow = MeShowStderr;

/* ---- the program's functions ---- */

/* Calls of handlers and show functions may send messages themselves. To end the recursion, messages of the kind that is
 * being handled go to the standard handler, and texts of the kind that is being shown to stderr. */
typedef enum Kind { INFO, DEBUG, LOG, WARNING, FATAL_ERROR } Kind;
static _Thread_local unsigned int handling, showing; /* a bit for each kind */

static void callHandler(Kind kind, MeHandler handler, MeHandler standard, int level, const char *format, va_list ap) {
    static const char *const setBy[] = {"MeSetInfoHandler", "MeSetDebugHandler", "MeSetLogHandler",
                                        "MeSetWarningHandler", "MeSetFatalErrorHandler"};
    const unsigned int before = handling;
    const MeProgramCall call = MeProgramEnterQuiet(setBy[kind]);
    handling |= 1u << kind;
    (before & 1u << kind ? standard : handler)(level, format, ap);
    handling = before;
    MeProgramLeave(&call);
}

static void showText(Kind kind, MeShow show, int level, const char *text) {
    static const char *const setBy[] = {"MeSetInfoShow", "MeSetDebugShow", "MeSetLogShow", "MeSetWarningShow",
                                        "MeSetFatalErrorShow"};
    const unsigned int before = showing;
    const MeProgramCall call = MeProgramEnterQuiet(setBy[kind]);
    showing |= 1u << kind;
    (before & 1u << kind ? MeShowStderr : show)(level, text);
    showing = before;
    MeProgramLeave(&call);
}

/* ---- sending ---- */

void MEAPI_CDECL MeInfo(const int level, const char *const format, ...) {
    if (level > MeInfoLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageBuffer(MeInfo, level, format, ap))
        callHandler(INFO, MeInfoHandler, MeHandlerInfo, level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeDebug(const int level, const char *const format, ...) {
    if (level > MeDebugLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageBuffer(MeDebug, level, format, ap))
        callHandler(DEBUG, MeDebugHandler, MeHandlerDebug, level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeLog(const int level, const char *const format, ...) {
    if (level > MeLogLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageBuffer(MeLog, level, format, ap))
        callHandler(LOG, MeLogHandler, MeHandlerLog, level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeWarning(const int level, const char *const format, ...) {
    char renamed[MeMAXMESSAGE];
    if (level > MeWarningLevel || me_messageIsSuppressed())
        return;
    va_list ap;
    va_start(ap, format);
    const char *text = me_messageRename(format, &ap, renamed);
    if (!me_messageBuffer(MeWarning, level, text, ap))
        callHandler(WARNING, MeWarningHandler, MeHandlerWarning, level, text, ap);
    va_end(ap);
}

void MEAPI_CDECL MeFatalError(const int level, const char *const format, ...) {
    char renamed[MeMAXMESSAGE];
    if (level > MeFatalErrorLevel)
        return;
    va_list ap;
    va_start(ap, format);
    const char *text = me_messageRename(format, &ap, renamed);
    callHandler(FATAL_ERROR, MeFatalErrorHandler, MeHandlerFatalError, level, text, ap);
    va_end(ap);
}

/* ---- replacing ---- */

static MeHandler replaceHandler(MeHandler *inUse, MeHandler n, MeHandler standard) {
    const MeHandler old = *inUse;
    *inUse = n ? n : standard;
    return old;
}

static MeShow replaceShow(MeShow *inUse, MeShow n, MeShow standard) {
    const MeShow old = *inUse;
    *inUse = n ? n : standard;
    return old;
}

MeHandler MEAPI MeSetInfoHandler(MeHandler n) {
    return replaceHandler(&MeInfoHandler, n, MeHandlerInfo);
}

MeHandler MEAPI MeSetDebugHandler(MeHandler n) {
    return replaceHandler(&MeDebugHandler, n, MeHandlerDebug);
}

MeHandler MEAPI MeSetLogHandler(MeHandler n) {
    return replaceHandler(&MeLogHandler, n, MeHandlerLog);
}

MeHandler MEAPI MeSetWarningHandler(MeHandler n) {
    return replaceHandler(&MeWarningHandler, n, MeHandlerWarning);
}

MeHandler MEAPI MeSetFatalErrorHandler(MeHandler n) {
    return replaceHandler(&MeFatalErrorHandler, n, MeHandlerFatalError);
}

MeShow MEAPI MeSetInfoShow(MeShow n) {
    return replaceShow(&MeInfoShow, n, MeShowStdout);
}

MeShow MEAPI MeSetDebugShow(MeShow n) {
    return replaceShow(&MeDebugShow, n, MeShowStderr);
}

MeShow MEAPI MeSetLogShow(MeShow n) {
    return replaceShow(&MeLogShow, n, MeShowStderr);
}

MeShow MEAPI MeSetWarningShow(MeShow n) {
    return replaceShow(&MeWarningShow, n, MeShowStderr);
}

MeShow MEAPI MeSetFatalErrorShow(MeShow n) {
    return replaceShow(&MeFatalErrorShow, n, MeShowStderr);
}

/* ---- the default handlers ---- */

/* Formats a message after a prefix, without a final newline. */
static void formatText(char text[MeMAXMESSAGE], const char *prefix, const char *format, va_list ap) {
    const size_t used = strlen(prefix);
    memcpy(text, prefix, used + 1);
    vsnprintf(text + used, MeMAXMESSAGE - used, format, ap);
    const size_t length = strlen(text);
    if (length > used && text[length - 1] == '\n')
        text[length - 1] = 0;
}

static void formatAndShow(Kind kind, MeShow show, int level, const char *prefix, const char *format, va_list ap) {
    char text[MeMAXMESSAGE];
    formatText(text, prefix, format, ap);
    showText(kind, show, level, text);
}

void MEAPI MeHandlerInfo(const int level, const char *const format, va_list ap) {
    formatAndShow(INFO, MeInfoShow, level, "", format, ap);
}

void MEAPI MeHandlerDebug(const int level, const char *const format, va_list ap) {
    formatAndShow(DEBUG, MeDebugShow, level, "Karma debug: ", format, ap);
}

void MEAPI MeHandlerLog(const int level, const char *const format, va_list ap) {
    formatAndShow(LOG, MeLogShow, level, "", format, ap);
}

/* The most recent different warnings, with the number of times that each was shown. */
enum { RECENT_TEXTS = 64 };
static struct {
    MeU64 text; /* FNV-1a hash of the text; 0: none */
    int times;
} recentTexts[RECENT_TEXTS];
static unsigned int nextRecentText;
static atomic_flag recentTextsLock = ATOMIC_FLAG_INIT;

static MeU64 hashText(const char *text) {
    MeU64 hash = 0xcbf29ce484222325u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash ? hash : 1;
}

/* Counts a text; returns how often it was shown before, if it is among the recent ones. */
static int countRecentText(const char *text) {
    const MeU64 hash = hashText(text);
    unsigned int i = 0;
    while (atomic_flag_test_and_set(&recentTextsLock)) {
    }
    while (i < RECENT_TEXTS && recentTexts[i].text != hash)
        i++;
    if (i == RECENT_TEXTS) {
        i = nextRecentText++ % RECENT_TEXTS;
        recentTexts[i].text = hash;
        recentTexts[i].times = 0;
    }
    const int before = recentTexts[i].times;
    recentTexts[i].times += before < 2;
    atomic_flag_clear(&recentTextsLock);
    return before;
}

/* Shows each text only twice, as a problem usually occurs in every step. */
void MEAPI MeHandlerWarning(const int level, const char *const format, va_list ap) {
    static const char again[] = " (again: not shown any more)";
    char text[MeMAXMESSAGE];
    formatText(text, "Karma warning: ", format, ap);
    const int before = countRecentText(text);
    if (before == 1)
        strncat(text, again, sizeof text - strlen(text) - 1);
    if (before < 2)
        showText(WARNING, MeWarningShow, level, text);
}

void MEAPI MeHandlerFatalError(const int level, const char *const format, va_list ap) {
    formatAndShow(FATAL_ERROR, MeFatalErrorShow, level, "Karma fatal error: ", format, ap);
    abort();
}

/* ---- show functions ---- */

void MEAPI MeShowStdout(const int level, const char *const string) {
    (void)level;
    fprintf(stdout, "%s\n", string);
}

void MEAPI MeShowStderr(const int level, const char *const string) {
    (void)level;
    fprintf(stderr, "%s\n", string);
}

void MEAPI MeShowDialog(const int level, const char *const string) {
    MeShowStderr(level, string);
}

void MEAPI MeShowCrtErr(const int level, const char *const string) {
    MeShowStderr(level, string);
}

void MEAPI MeShowCrtWarn(const int level, const char *const string) {
    MeShowStderr(level, string);
}

char *MEAPI MeShortenPath(char *path) {
    if (path == NULL)
        return NULL;
    char *name = path;
    for (char *c = path; *c; c++) {
        if (*c == '/' || *c == '\\')
            name = c + 1;
    }
    return name;
}
