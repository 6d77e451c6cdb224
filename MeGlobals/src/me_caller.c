/* Who is named in messages of memory and limits, and what such a message says. */
#include "MeInternal.h"
#include "MeMessage.h"

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

void MEAPI MeLimitRename(MeLimit *limit, const char *name) {
    limit->name = name;
    limit->isSaidOnce = METRUE;
}

void MEAPI MeLimitWarn(MeLimit *limit, const char *function, const char *what) {
    if (!limit->isSaidOnce || !limit->wasSaid)
        MeWarning(1, "%s: no room for %s: raise %s, which is %d", MeCallerName(function), what, limit->name,
                  limit->most);
    limit->wasSaid = METRUE;
}
