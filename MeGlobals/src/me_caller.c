/* Names in messages: MeMessagesAs for all kinds, MeCallerSet for memory and limits; and warnings about limits. */
#include "MeInternal.h"
#include "MeMessage_i.h"
#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* The name of MeMessagesAs, with which messages begin; null: that of the function that sends them. */
static _Thread_local struct {
    const char *name;
    MeBool hasSpoken;
} speaker;

const char *MEAPI MeMessagesAs(const char *function) {
    const char *const before = speaker.name;
    if (function == NULL || before == NULL) {
        speaker.name = function;
        speaker.hasSpoken = MEFALSE;
    }
    return before;
}

/* The rest of a format after the name at its beginning, "%s: ..." or "Name: ...", from the colon on. Skips the argument
 * of %s. Null if there is no name. */
static const char *skipName(const char *format, va_list *ap) {
    const char *c = format;
    if (strncmp(format, "%s:", 3) == 0) {
        (void)va_arg(*ap, const char *);
        return format + 2;
    }
    while (isalnum((unsigned char)*c) || *c == '_')
        c++;
    return c > format && *c == ':' ? c : NULL;
}

const char *me_messageRename(const char *format, va_list *ap, char renamed[MeMAXMESSAGE]) {
    if (!speaker.name)
        return format;
    speaker.hasSpoken = METRUE;
    const char *rest = skipName(format, ap);
    if (!rest)
        return format;
    snprintf(renamed, MeMAXMESSAGE, "%s%s", speaker.name, rest);
    return renamed;
}

MeBool me_messageIsSuppressed(void) {
    return speaker.name && speaker.hasSpoken;
}

static _Thread_local const char *caller;

const char *MEAPI MeCallerSet(const char *function) {
    const char *const before = caller;
    if (function == NULL || before == NULL)
        caller = function;
    return before;
}

const char *MEAPI MeCallerName(const char *function) {
    return caller != NULL ? caller : function;
}

void me_namesSave(MeProgramCall *call) {
    call->caller = caller;
    call->speaker = speaker.name;
    call->hasSpoken = speaker.hasSpoken;
    caller = speaker.name = NULL;
    speaker.hasSpoken = MEFALSE;
}

void me_namesRestore(const MeProgramCall *call) {
    caller = call->caller;
    speaker.name = call->speaker;
    speaker.hasSpoken = call->hasSpoken;
}

MeBool me_isGiven(const void *p, const char *what, const char *function) {
    if (!p)
        MeWarning(1, "%s: the %s is null", function, what);
    return p != NULL;
}

void MEAPI MeLimitRename(MeLimit *limit, const char *name) {
    limit->name = name;
    limit->warnsOnce = METRUE;
}

void MEAPI MeLimitWarn(MeLimit *limit, const char *function, const char *what) {
    if (!limit->warnsOnce || !limit->hasWarnedOnce)
        MeWarning(1, "%s: no room for %s: raise %s, which is %d", MeCallerName(function), what, limit->name,
                  limit->max);
    limit->hasWarnedOnce = METRUE;
}
