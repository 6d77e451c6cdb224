/* Five kinds of messages, each with a limit, a handler and a show function. */
#include "MeMessage_i.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int MeInfoLevel = 1, MeDebugLevel = -1, MeLogLevel = 1, MeWarningLevel = 5, MeFatalErrorLevel = 5;

MeHandler MeInfoHandler = MeHandlerInfo, MeDebugHandler = MeHandlerDebug, MeLogHandler = MeHandlerLog,
          MeWarningHandler = MeHandlerWarning, MeFatalErrorHandler = MeHandlerFatalError;
MeShow MeInfoShow = MeShowStdout, MeDebugShow = MeShowStderr, MeLogShow = MeShowStderr, MeWarningShow = MeShowStderr,
       MeFatalErrorShow = MeShowStderr;

/* ---- sending ---- */

void MEAPI_CDECL MeInfo(const int level, const char *const format, ...) {
    if (level > MeInfoLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageHold(MeInfo, level, format, ap))
        MeInfoHandler(level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeDebug(const int level, const char *const format, ...) {
    if (level > MeDebugLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageHold(MeDebug, level, format, ap))
        MeDebugHandler(level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeLog(const int level, const char *const format, ...) {
    if (level > MeLogLevel)
        return;
    va_list ap;
    va_start(ap, format);
    if (!me_messageHold(MeLog, level, format, ap))
        MeLogHandler(level, format, ap);
    va_end(ap);
}

void MEAPI_CDECL MeWarning(const int level, const char *const format, ...) {
    char renamed[MeMAXMESSAGE];
    if (level > MeWarningLevel || me_messageIsRepeated())
        return;
    va_list ap;
    va_start(ap, format);
    const char *text = me_messageRename(format, &ap, renamed);
    if (!me_messageHold(MeWarning, level, text, ap))
        MeWarningHandler(level, text, ap);
    va_end(ap);
}

void MEAPI_CDECL MeFatalError(const int level, const char *const format, ...) {
    char renamed[MeMAXMESSAGE];
    if (level > MeFatalErrorLevel)
        return;
    va_list ap;
    va_start(ap, format);
    MeFatalErrorHandler(level, me_messageRename(format, &ap, renamed), ap);
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

/* Formats into at most MeMAXMESSAGE bytes, without the newline that programs may end their messages with. */
static void formatAndShow(MeShow show, int level, const char *prefix, const char *format, va_list ap) {
    char text[MeMAXMESSAGE];
    const size_t used = strlen(prefix);
    memcpy(text, prefix, used + 1);
    vsnprintf(text + used, sizeof text - used, format, ap);
    const size_t length = strlen(text);
    if (length > used && text[length - 1] == '\n')
        text[length - 1] = 0;
    show(level, text);
}

void MEAPI MeHandlerInfo(const int level, const char *const format, va_list ap) {
    formatAndShow(MeInfoShow, level, "", format, ap);
}

void MEAPI MeHandlerDebug(const int level, const char *const format, va_list ap) {
    formatAndShow(MeDebugShow, level, "Karma debug: ", format, ap);
}

void MEAPI MeHandlerLog(const int level, const char *const format, va_list ap) {
    formatAndShow(MeLogShow, level, "", format, ap);
}

void MEAPI MeHandlerWarning(const int level, const char *const format, va_list ap) {
    formatAndShow(MeWarningShow, level, "Karma warning: ", format, ap);
}

void MEAPI MeHandlerFatalError(const int level, const char *const format, va_list ap) {
    formatAndShow(MeFatalErrorShow, level, "Karma fatal error: ", format, ap);
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
