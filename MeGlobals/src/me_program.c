/* Callbacks: which function of the program runs on this thread, and which calls it must not make (MeInternal.h). */
#include "MeInternal.h"
#include "MeMessage.h"
#include "MeMessage_i.h"

static _Thread_local struct {
    const char *setBy; /* null: no callback runs */
    MeBool isQuiet;
} runningFunction;

static MeProgramCall enterCallback(const char *setBy, MeBool isQuiet) {
    MeProgramCall before = {.setBy = runningFunction.setBy, .isQuiet = runningFunction.isQuiet};
    me_namesSave(&before);
    runningFunction.setBy = setBy;
    runningFunction.isQuiet = isQuiet;
    return before;
}

/* A callback within a quiet one is quiet, too. */
MeProgramCall MEAPI MeProgramEnter(const char *setBy) {
    return enterCallback(setBy, runningFunction.isQuiet);
}

MeProgramCall MEAPI MeProgramEnterQuiet(const char *setBy) {
    return enterCallback(setBy, METRUE);
}

void MEAPI MeProgramLeave(const MeProgramCall *before) {
    runningFunction.setBy = before->setBy;
    runningFunction.isQuiet = before->isQuiet;
    me_namesRestore(before);
}

void MEAPI MeProgramRefuse(const char *function, const char *otherwise) {
    if (runningFunction.setBy)
        MeWarning(1, "%s: not from the function of %s; nothing is changed", function, runningFunction.setBy);
    else
        MeWarning(1, "%s: %s; nothing is changed", function, otherwise);
}

MeBool MEAPI MeProgramMayChange(const char *function) {
    if (runningFunction.isQuiet)
        MeProgramRefuse(function, "not now");
    return !runningFunction.isQuiet;
}
