/* Functions of the program: which one runs, of this thread, and what it may not do (MeInternal.h). */
#include "MeInternal.h"
#include "MeMessage.h"
#include "MeMessage_i.h"

static _Thread_local struct {
    const char *setBy; /* null: none runs */
    MeBool isQuiet;
} running;

static MeProgramCall enter(const char *setBy, MeBool isQuiet) {
    MeProgramCall before = {.setBy = running.setBy, .isQuiet = running.isQuiet};
    me_namesCopy(&before);
    running.setBy = setBy;
    running.isQuiet = isQuiet;
    return before;
}

/* What a quiet function has the library call is in the middle of the same thing. */
MeProgramCall MEAPI MeProgramEnter(const char *setBy) {
    return enter(setBy, running.isQuiet);
}

MeProgramCall MEAPI MeProgramEnterQuiet(const char *setBy) {
    return enter(setBy, METRUE);
}

void MEAPI MeProgramLeave(const MeProgramCall *before) {
    running.setBy = before->setBy;
    running.isQuiet = before->isQuiet;
    me_namesGive(before);
}

void MEAPI MeProgramRefuse(const char *function, const char *otherwise) {
    if (running.setBy)
        MeWarning(1, "%s: not from the function of %s; nothing is changed", function, running.setBy);
    else
        MeWarning(1, "%s: %s; nothing is changed", function, otherwise);
}

MeBool MEAPI MeProgramMayChange(const char *function) {
    if (running.isQuiet)
        MeProgramRefuse(function, "not now");
    return !running.isQuiet;
}
