/* Stages of a world: what the program calls from its callbacks, and may not happen before they are done
 * (mdt_record_i.h, MeInternal.h).
 *
 *     stage                                         level               what waits
 *     pairs of models are handled (Mst)             MDT_GUARD_BODIES    destroying bodies
 *     MdtWorldForAllConstraints and its like        .. _CONSTRAINTS     and constraints; attaching, sorting them anew
 *     partitions are found and stepped; handlers    .. _GRAPH           and enabling, disabling
 *     a partition is solved                         .. _STATES          what is refused: placing bodies, and the like
 *     joints that broke are told                    MDT_GUARD_WORLD     nothing
 *
 * What is condemned lives until then: it can be asked and changed, but not destroyed again, and its Mdt...IsValid says
 * no. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "record/mdt_point_i.h"

MeStage *MEAPI MdtWorldGetStage(const MdtWorldID w) {
    MEASSERT(w);
    return &w->stage;
}

MeWhen mdt_when(MdtWorldID w, int level, const char *caller, const MeLater *later) {
    const MeWhen when = MeStageWhen(&w->stage, level, caller);
    return when == MeWhenStageEnds && !MeStageDefer(&w->stage, level, later, caller) ? MeWhenNever : when;
}

MeBool mdt_mayChangeState(const MdtBody *b, const char *caller) {
    if (b->partition < 0 || !MeStageIsActive(&b->world->stage, MDT_GUARD_STATES))
        return METRUE;
    MeProgramRefuse(caller, "a partition is being solved");
    return MEFALSE;
}

/* ---- what was meant ---- */

MdtBodyID mdt_laterBody(const MeLater *later) {
    MdtBodyID b = later->object;
    return MeHandleIsLive(b, MDT_BODY) && b->link.serial == later->serial ? b : NULL;
}

MdtConstraintID mdt_laterConstraint(const MeLater *later) {
    MdtConstraintID c = later->object;
    const MeBool isLive = MeHandleIsLive(c, MDT_JOINT) || MeHandleIsLive(c, MDT_MANIFOLD);
    return isLive && c->link.serial == later->serial ? c : NULL;
}

/* ---- bodies ---- */

static void MEAPI destroyBody(const MeLater *later);

/* The stage that keeps the body from going: its world's, or that of its models. */
static MeStage *holderOf(MdtBodyID b) {
    MeStage *own = &b->world->stage, *user = b->user ? b->user->guardOf(b) : NULL;
    return MeStageIsActive(own, MDT_GUARD_BODIES) ? own : user;
}

static MeBool deferDestroy(MeStage *stage, MdtBodyID b, const char *caller) {
    const MeLater later = {.carryOut = destroyBody, .object = b, .serial = b->link.serial};
    return MeStageDefer(stage, MDT_GUARD_BODIES, &later, caller);
}

static void MEAPI destroyBody(const MeLater *later) {
    MdtBodyID b = mdt_laterBody(later);
    MeStage *stage = b ? holderOf(b) : NULL;
    if (b && !(stage && deferDestroy(stage, b, "MdtBodyDestroy")))
        mdt_bodyTerm(b);
}

void mdt_bodyDestroy(MdtBodyID b, const char *caller) {
    MeStage *stage = holderOf(b);
    if (!MeProgramMayChange(caller))
        return;
    if (!stage) {
        mdt_bodyTerm(b);
        return;
    }
    if (!deferDestroy(stage, b, caller))
        return;
    b->record.flags |= MDT_CONDEMNED;
    if (b->user)
        b->user->condemn(b);
}
