/* Stages of a framework: calls that the program makes from its callbacks, and that are deferred or refused until the
 * stage ends (mcd_frame_i.h, MeInternal.h).
 *
 *     stage                                                     level             deferred, or refused
 *     pairs are processed; boxes are updated; a block ends; a   MCD_GUARD_MODELS  deferred: destroying models and
 *     model is updated; a query, a test                                           geometries, removing models,
 *     beginning
 *                                                                                 and ending change blocks
 *     within it: a function of a geometry type, an interaction, MCD_GUARD_SHAPES  refused: placing models, and
 *     changing
 *     a triangle list's callback, a query's filter                                their geometries
 *     a universe is stepped; a framework is destroyed           MCD_GUARD_FRAME   refused: destroying framework or
 *     spaces
 *
 * A model that will be destroyed gets no more pairs and contacts (isGone). Until the stage ends it stays usable,
 * except that McdModelIsValid returns false.
 */
#include "McdInternal.h"
#include "model/mcd_result_i.h"

MeBool MEAPI McdFrameworkIsValid(McdFrameworkID frame) {
    return frame && MeHandleIsLive(frame, MCD_FRAMEWORK);
}

MeBool MEAPI McdSpaceIsValid(McdSpaceID s) {
    return s && MeHandleIsLive(s, MCD_SPACE);
}

MeStage *MEAPI McdFrameworkGetStage(McdFrameworkID frame) {
    MEASSERT(frame);
    return &frame->stage;
}

MeStage *MEAPI McdModelGetGuardStage(McdModelID cm) {
    MeStage *stage = &mcd_record(cm)->frame->stage;
    return MeStageIsActive(stage, MCD_GUARD_MODELS) ? stage : 0;
}

MeWhen mcd_deferWhileGuarded(McdFramework *frame, const MeLater *later, const char *function) {
    const MeWhen when = MeStageWhen(&frame->stage, MCD_GUARD_MODELS, function);
    return when == MeWhenStageEnds && !MeStageDefer(&frame->stage, MCD_GUARD_MODELS, later, function) ? MeWhenNever
                                                                                                      : when;
}

McdModelRecord *mcd_laterModel(const MeLater *later) {
    McdModelRecord *m = later->object;
    return MeHandleIsLive(m, MCD_MODEL) && m->serial == later->serial ? m : 0;
}

MeBool mcd_mayPlace(const McdFramework *frame, const char *function) {
    if (!MeStageIsActive(&frame->stage, MCD_GUARD_SHAPES))
        return METRUE;
    MeProgramRefuse(function, "models are being tested");
    return MEFALSE;
}

MeBool MEAPI McdModelMayBePlaced(McdModelID cm, const char *function) {
    return mcd_mayPlace(mcd_record(cm)->frame, function);
}

/* ---- functions of geometry types --------------------------------------------------------------------------------- */

McdTypeCall mcd_typeEnterOwn(McdFramework *frame) {
    MeStageBegin(&frame->stage, MCD_GUARD_SHAPES);
    return (McdTypeCall){.frame = frame, .before = MeProgramEnter("McdFrameworkRegisterGeometryType")};
}

void mcd_typeLeaveOwn(const McdTypeCall *call) {
    MeProgramLeave(&call->before);
    MeStageEnd(&call->frame->stage, MCD_GUARD_SHAPES);
}
