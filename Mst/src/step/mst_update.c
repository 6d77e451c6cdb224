/* Update: persisting contacts and the records of their pairs. It follows collide in the same thread, which has the
 * pairs of a run in its cache.
 *
 * Writes the pair's own group and touch alone, and that the certificates of rest of its bodies have ended. Where
 * contacts come or go, where the program is called, or what pairs share is to be written, commit does it all.
 */
#include "McdModelPair.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "step/mst_step_i.h"

/* ---- what is remembered ------------------------------------------------------------------------------------------ */

static void noteMoves(const McdModelPair *p) {
    MstTouch *t = p->touch;
    t->moves[0] = mst_movesOf(p->model1);
    t->moves[1] = mst_movesOf(p->model2);
}

void mst_rememberTest(const MstFinding *f, int numContacts, unsigned long version) {
    const McdModelPair *p = f->pair;
    MstTouch *t = p->touch;
    const MeBool isWhole = p->responseData && numContacts == f->count;
    noteMoves(p);
    t->carried = 0;
    t->version = version;
    t->found = isWhole && !mst_hasCallback(f->materials) && !f->isFast ? f->count : MST_UNKNOWN;
}

/* ---- may it be done here? ---------------------------------------------------------------------------------------- */

/* Later parts are left to commit: their touches may be listed already. */
static MeBool mayUpdate(const MstBridgeRecord *b, const MstRun *run, const MstFinding *f) {
    const McdModelPair *p = f->pair;
    const MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    if (b->substep > 0 || p->phase == kMcdFFStateInactive || !t || mst_touchIsListed(&b->events, t) || f->isFast ||
        !mst_areMaterialsSeen(b) || mst_isPushed(p))
        return MEFALSE;
    if (f->outcome != MST_TESTED)
        return t->version == mst_versionSeen(f->materials) && MdtContactGroupIsEnabled(group);
    if (!f->isKnown)
        return MEFALSE;
    if (f->count == 0)
        return !group || (MdtContactGroupGetCount(group) == 0 && !MdtContactGroupIsEnabled(group));
    return group && MdtContactGroupIsEnabled(group) && MdtContactGroupGoesOn(group, &run->found[f->first], f->count);
}

/* ---- the update -------------------------------------------------------------------------------------------------- */

void mst_carry(const MstFinding *f) {
    MstTouch *t = f->pair->touch;
    t->separation = MdtContactGroupCarry(f->pair->responseData, f->hasMoved);
    t->carried++;
    noteMoves(f->pair);
}

static void renew(const MstBridgeRecord *b, const MstRun *run, const MstFinding *f) {
    int numContacts = 0;
    if (f->count > 0)
        numContacts = MdtContactGroupRenew(f->pair->responseData, &run->found[f->first], f->count, b->ahead, run->made);
    mst_touchUpdate(b, f->pair, numContacts, f->count, f->separation);
    mst_rememberTest(f, numContacts, mst_versionSeen(f->materials));
}

void mst_updatePair(const MstBridgeRecord *b, const MstRun *run, MstFinding *f) {
    const McdModelPair *p = f->pair;
    if (f->outcome == MST_TESTED && f->count == 0 && !p->touch && !p->responseData && !f->isFast)
        f->outcome = MST_NOTHING; /* it had no contacts before, either */
    if ((f->outcome != MST_KEPT && f->outcome != MST_CARRIED && f->outcome != MST_TESTED) || !mayUpdate(b, run, f))
        return;
    if (f->outcome == MST_CARRIED)
        mst_carry(f);
    if (f->outcome == MST_TESTED)
        renew(b, run, f);
    else
        mst_touchUpdateAgain(b, p);
    f->updated = p->touch;
    f->isUndecided = f->updated->isUndecided;
}
