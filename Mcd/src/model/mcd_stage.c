/* Stages of a framework: calls that the program makes from its callbacks, and that are deferred or refused until the
 * stage ends (mcd_frame_i.h, MeInternal.h).
 *
 *     MCD_GUARD_MODELS while pairs are processed, models are updated, a block ends, or a query or a test runs.
 *         Deferred: destroying models and geometries, removing models, beginning and ending change blocks.
 *     MCD_GUARD_SHAPES, within that, while a function of a geometry type, an interaction, a triangle list's callback
 *         or a query's filter runs. Refused: placing models and changing their geometries.
 *     MCD_GUARD_FRAME while a universe is stepped or a framework is destroyed.
 *         Refused: destroying the framework or its spaces.
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

McdModelRecord *mcd_deferredModel(const MeLater *later) {
    McdModelRecord *m = later->object;
    return MeHandleIsLive(m, MCD_MODEL) && m->serial == later->serial ? m : 0;
}

MeBool mcd_mayChangeShapes(const McdFramework *frame, const char *function) {
    if (!MeStageIsActive(&frame->stage, MCD_GUARD_SHAPES))
        return METRUE;
    MeProgramRefuse(function, "models are being tested");
    return MEFALSE;
}

MeBool MEAPI McdModelMayBePlaced(McdModelID cm, const char *function) {
    return mcd_mayChangeShapes(mcd_record(cm)->frame, function);
}

/* ---- functions of geometry types --------------------------------------------------------------------------------- */

McdTypeCall mcd_typeEnterProgram(McdFramework *frame) {
    MeStageBegin(&frame->stage, MCD_GUARD_SHAPES);
    return (McdTypeCall){.frame = frame, .before = MeProgramEnter("McdFrameworkRegisterGeometryType")};
}

void mcd_typeLeaveProgram(const McdTypeCall *call) {
    MeProgramLeave(&call->before);
    MeStageEnd(&call->frame->stage, MCD_GUARD_SHAPES);
}
