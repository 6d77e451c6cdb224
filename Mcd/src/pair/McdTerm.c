/* Destroys a framework and everything in it. */
#include "McdInternal.h"
#include "pair/mcd_pair_i.h"
#include "surface/mcd_scratch_i.h"

struct McdTermActionLink {
    McdTermAction action;
    McdTermActionLink *next; /* registered before this one */
};

/* Destroys geometries without references repeatedly: an aggregate goes before its parts, whichever is older. */
static void destroyGeometries(McdFramework *frame) {
    while (frame->lastGeometry) {
        const int before = frame->geometryCount;
        for (McdGeometry *g = frame->lastGeometry, *previous; g; g = previous) {
            previous = g->previous;
            if (g->referenceCount == 0)
                mcd_geometryDestroy(g);
        }
        if (frame->geometryCount == before) /* the program has set reference counts without references */
            frame->lastGeometry->referenceCount = 0;
    }
}

/* Destroys all models and geometries. Functions of the program called meanwhile cannot create new ones. */
static void destroyAll(McdFramework *frame) {
    frame->isEmptied = METRUE;
    MeStageBegin(&frame->stage, MCD_GUARD_MODELS);
    while (frame->lastModel)
        mcd_modelDestroy(frame->lastModel);
    destroyGeometries(frame);
    MeStageEnd(&frame->stage, MCD_GUARD_MODELS);
    frame->isEmptied = MEFALSE;
}

void MEAPI McdFrameworkDestroyAllModelsAndGeometries(McdFrameworkID frame) {
    const char *const function = "McdFrameworkDestroyAllModelsAndGeometries";
    if (mcd_frameCheck(frame, function) && MeStageIsFree(&frame->stage, function))
        destroyAll(frame);
}

static void runTermActions(McdFramework *frame) {
    MeStageBegin(&frame->stage, MCD_GUARD_FRAME);
    const MeProgramCall before = MeProgramEnter("McdFrameworkRegisterTermAction");
    while (frame->termActions) {
        McdTermActionLink *link = frame->termActions;
        frame->termActions = link->next;
        link->action(frame);
        MeMemoryGive(link);
    }
    MeProgramLeave(&before);
    MeStageEnd(&frame->stage, MCD_GUARD_FRAME);
}

void MEAPI McdTerm(McdFrameworkID frame) {
    if (!frame)
        mcd_warnGone(frame, "collision framework", "McdTerm");
    if (!mcd_mayDestroy(frame, MCD_FRAMEWORK, "collision framework", "McdTerm") ||
        !MeStageIsFree(&frame->stage, "McdTerm"))
        return;
    if (frame->spaceCount) {
        MeWarning(1, "McdTerm: %d spaces are left; destroy them first. Nothing was destroyed", frame->spaceCount);
        return;
    }
    runTermActions(frame);
    if (frame->modelCount || frame->geometryCount)
        MeWarning(2, "McdTerm: %d models and %d geometries were left", frame->modelCount, frame->geometryCount);
    destroyAll(frame);
    MEASSERT(!frame->modelCount && !frame->instanceCount && !frame->geometryCount);
    frame->magic = 0;
    MeHandleLeave(&frame->handle);
    mcd_countFrames(-1);
    mcd_scratchFreeAll(frame);
    mcd_frameFree(frame);
}

void MEAPI McdFrameworkRegisterTermAction(McdFrameworkID frame, McdTermAction action) {
    if (!mcd_frameCheck(frame, "McdFrameworkRegisterTermAction") || !action)
        return;
    McdTermActionLink *link = MeMemoryTake(1, sizeof *link, "McdFrameworkRegisterTermAction", "an action");
    if (!link)
        return;
    link->action = action;
    link->next = frame->termActions;
    frame->termActions = link;
}
