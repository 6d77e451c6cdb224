/* Stages: deferred calls of the program while records are in use (MeInternal.h). */
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"

/* Maximum nesting of deferred calls that callbacks of deferred calls make. */
enum { MAX_ROUNDS = 16 };

typedef struct MeDeferredCall {
    struct MeDeferredCall *next;
    int level, round;
    MeLater later;
} MeDeferredCall;

/* The highest level of an active stage; -1: none is active. */
static int activeLevel(const MeStage *stage) {
    int level = ME_STAGE_LEVELS - 1;
    while (level >= 0 && __atomic_load_n(&stage->active[level], __ATOMIC_RELAXED) == 0)
        level--;
    return level;
}

MeBool MEAPI MeStageIsActive(const MeStage *stage, int level) {
    return activeLevel(stage) >= level;
}

/* ---- deferred calls ---- */

/* Removes and returns the first deferred call that no active stage prevents; null: none. */
static MeDeferredCall *popExecutable(MeStage *stage) {
    const int level = activeLevel(stage);
    MeDeferredCall *before = NULL, *w = stage->first;
    while (w && w->level <= level) {
        before = w;
        w = w->next;
    }
    if (!w)
        return NULL;
    *(before ? &before->next : &stage->first) = w->next;
    if (stage->last == w)
        stage->last = before;
    return w;
}

static void executeDeferred(MeStage *stage) {
    stage->isExecuting = METRUE;
    for (MeDeferredCall *w = popExecutable(stage); w; w = popExecutable(stage)) {
        stage->round = w->round;
        w->later.carryOut(&w->later);
        MeMemoryGive(w);
    }
    stage->round = 0;
    stage->isExecuting = MEFALSE;
}

MeBool MEAPI MeStageDefer(MeStage *stage, int level, const MeLater *later, const char *function) {
    MEASSERT(level > 0 && level < ME_STAGE_LEVELS);
    if (stage->round == MAX_ROUNDS) {
        MeWarning(1,
                  "%s: what was called from functions of the program, and carried out later, has called them again %d "
                  "times; nothing is changed",
                  function, MAX_ROUNDS);
        return MEFALSE;
    }
    MeDeferredCall *w = MeMemoryTake(1, sizeof *w, function, "what has to wait");
    if (!w)
        return MEFALSE;
    *w = (MeDeferredCall){.level = level, .round = stage->round + 1, .later = *later};
    *(stage->last ? &stage->last->next : &stage->first) = w;
    stage->last = w;
    return METRUE;
}

/* ---- the owner ---- */

void MEAPI MeStageBegin(MeStage *stage, int level) {
    MEASSERT(level >= 0 && level < ME_STAGE_LEVELS);
    __atomic_fetch_add(&stage->active[level], 1, __ATOMIC_RELAXED);
}

void MEAPI MeStageEnd(MeStage *stage, int level) {
    const int before = __atomic_fetch_sub(&stage->active[level], 1, __ATOMIC_RELAXED);
    MEASSERT(before > 0);
    (void)before;
    if (stage->first && !stage->isExecuting)
        executeDeferred(stage);
}

MeWhen MEAPI MeStageWhen(const MeStage *stage, int level, const char *function) {
    if (!MeProgramMayChange(function))
        return MeWhenNever;
    return MeStageIsActive(stage, level) ? MeWhenStageEnds : MeWhenNow;
}

MeBool MEAPI MeStageIsFree(const MeStage *stage, const char *function) {
    if (!MeProgramMayChange(function))
        return MEFALSE;
    if (activeLevel(stage) < 0 && !stage->isExecuting)
        return METRUE;
    MeProgramRefuse(function, "it is in use");
    return MEFALSE;
}
