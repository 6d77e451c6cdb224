/* Stages of a world: calls that the program makes from its callbacks, and that are deferred until the stage is done
 * (mdt_record_i.h, MeInternal.h).
 *
 *     stage                                         level               deferred
 *     pairs of models are handled (Mst)             MDT_GUARD_BODIES    destroying bodies
 *     MdtWorldForAllConstraints and similar         .. _CONSTRAINTS     and destroying, attaching, sorting constraints
 *     partitions are found and stepped; handlers    .. _GRAPH           and enabling, disabling
 *     a partition is solved                         .. _STATES          refused: moving bodies, and similar changes
 *     callbacks for broken joints                   MDT_GUARD_WORLD     nothing
 *
 * A condemned object lives until the stage ends: it can be read and changed, but not destroyed again, and its
 * Mdt...IsValid returns false. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "record/mdt_point_i.h"

MeStage *MEAPI MdtWorldGetStage(const MdtWorldID w) {
    MEASSERT(w);
    return &w->stage;
}

MeWhen mdt_deferIfGuarded(MdtWorldID w, int level, const char *caller, const MeLater *later) {
    const MeWhen when = MeStageWhen(&w->stage, level, caller);
    return when == MeWhenStageEnds && !MeStageDefer(&w->stage, level, later, caller) ? MeWhenNever : when;
}

MeBool mdt_mayChangeState(const MdtBody *b, const char *caller) {
    if (b->partition < 0 || !MeStageIsActive(&b->world->stage, MDT_GUARD_STATES))
        return METRUE;
    MeProgramRefuse(caller, "a partition is being solved");
    return MEFALSE;
}

/* ---- objects of deferred calls ---- */

MdtBodyID mdt_deferredBody(const MeLater *later) {
    MdtBodyID b = later->object;
    return MeHandleIsLive(b, MDT_BODY) && b->link.serial == later->serial ? b : NULL;
}

MdtConstraintID mdt_deferredConstraint(const MeLater *later) {
    MdtConstraintID c = later->object;
    const MeBool isLive = MeHandleIsLive(c, MDT_JOINT) || MeHandleIsLive(c, MDT_MANIFOLD);
    return isLive && c->link.serial == later->serial ? c : NULL;
}

/* ---- bodies ---- */

static void MEAPI destroyBody(const MeLater *later);

/* The stage that guards the body from being destroyed: its world's, or that of its models; null if there is none. */
static MeStage *guardingStage(MdtBodyID b) {
    MeStage *own = &b->world->stage, *user = mdt_userOf(b) ? mdt_userOf(b)->guardOf(b) : NULL;
    return MeStageIsActive(own, MDT_GUARD_BODIES) ? own : user;
}

static MeBool deferDestroy(MeStage *stage, MdtBodyID b, const char *caller) {
    const MeLater later = {.carryOut = destroyBody, .object = b, .serial = b->link.serial};
    return MeStageDefer(stage, MDT_GUARD_BODIES, &later, caller);
}

static void MEAPI destroyBody(const MeLater *later) {
    MdtBodyID b = mdt_deferredBody(later);
    MeStage *stage = b ? guardingStage(b) : NULL;
    if (b && !(stage && deferDestroy(stage, b, "MdtBodyDestroy")))
        mdt_bodyTerm(b);
}

void mdt_bodyDestroy(MdtBodyID b, const char *caller) {
    MeStage *stage = guardingStage(b);
    if (!MeProgramMayChange(caller))
        return;
    if (!stage) {
        mdt_bodyTerm(b);
        return;
    }
    if (!deferDestroy(stage, b, caller))
        return;
    b->record.flags |= MDT_CONDEMNED;
    if (mdt_userOf(b))
        mdt_userOf(b)->condemn(b);
}
