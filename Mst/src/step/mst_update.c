/* Update: writes persisting contacts and the touches of their pairs. Runs right after collide in the same thread, while
 * the run's pairs are in the cache.
 *
 * Writes only the pair's own group and touch, and ends certificates of rest of its bodies. Commit does all of it where
 * contacts are created or destroyed, where the program is called, or where shared data are written.
 */
#include "McdModelPair.h"
#include "MdtContactGroup.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "step/mst_step_i.h"

/* ---- what is remembered ------------------------------------------------------------------------------------------ */

static void recordMoveCounts(const McdModelPair *p) {
    MstTouch *t = p->touch;
    t->moves[0] = mst_moveCountOf(p->model1);
    t->moves[1] = mst_moveCountOf(p->model2);
}

void mst_recordTest(const MstFinding *f, int numContacts, unsigned long version) {
    const McdModelPair *p = f->pair;
    MstTouch *t = p->touch;
    const MeBool isWhole = p->responseData && numContacts == f->count;
    recordMoveCounts(p);
    t->carried = 0;
    t->version = version;
    t->found = isWhole && !mst_hasCallback(f->materials) && !f->isFast ? f->count : MST_UNKNOWN;
}

/* ---- may it be done here? ---------------------------------------------------------------------------------------- */

/* Whether the pair may be updated outside of commit. Never in sub-steps after the first: the touch may be listed
 * already. */
static MeBool mayUpdatePair(const MstBridgeRecord *b, const MstRun *run, const MstFinding *f) {
    const McdModelPair *p = f->pair;
    const MstTouch *t = p->touch;
    const MdtContactGroupID group = p->responseData;
    if (b->substep > 0 || p->phase == kMcdFFStateInactive || !t || mst_touchIsListed(&b->events, t) || f->isFast ||
        !mst_areVersionsCurrent(b))
        return MEFALSE;
    if (f->outcome != MST_TESTED)
        return t->version == mst_currentVersion(f->materials) && MdtContactGroupIsEnabled(group);
    if (!f->hasInteraction)
        return MEFALSE;
    if (f->count == 0)
        return !group || (MdtContactGroupGetCount(group) == 0 && !MdtContactGroupIsEnabled(group));
    return group && MdtContactGroupIsEnabled(group) && MdtContactGroupGoesOn(group, &run->found[f->first], f->count);
}

/* ---- the update -------------------------------------------------------------------------------------------------- */

void mst_carryContacts(const MstFinding *f) {
    MstTouch *t = f->pair->touch;
    t->separation = MdtContactGroupCarry(f->pair->responseData, f->hasMoved);
    MEASSERT(t->carried < MST_CARRIES);
    t->carried++;
    recordMoveCounts(f->pair);
}

static void renewPair(const MstBridgeRecord *b, const MstRun *run, const MstFinding *f) {
    int numContacts = 0;
    if (f->count > 0)
        numContacts = MdtContactGroupRenew(f->pair->responseData, &run->found[f->first], f->count, b->ahead, run->made);
    MEASSERT(numContacts == f->count);
    mst_touchUpdateTested(b, f->pair, numContacts, f->count, f->separation);
    mst_recordTest(f, numContacts, mst_currentVersion(f->materials));
}

void mst_updatePair(const MstBridgeRecord *b, const MstRun *run, MstFinding *f) {
    const McdModelPair *p = f->pair;
    if (f->outcome == MST_TESTED && f->count == 0 && !p->touch && !p->responseData && !f->isFast)
        f->outcome = MST_NOTHING; /* no contacts before and now */
    if ((f->outcome != MST_KEPT && f->outcome != MST_CARRIED && f->outcome != MST_TESTED) || !mayUpdatePair(b, run, f))
        return;
    if (f->outcome == MST_CARRIED)
        mst_carryContacts(f);
    if (f->outcome == MST_TESTED)
        renewPair(b, run, f);
    else
        mst_touchUpdateUnchanged(b, p);
    f->updated = p->touch;
    f->isUndecided = f->updated->isUndecided;
}
