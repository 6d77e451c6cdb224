/* Inside Mst: touches, the bridge's records of pairs, and events. */
#ifndef MST_TOUCH_I_H
#define MST_TOUCH_I_H

#include "bridge/mst_bridge_i.h"

/* ---- touches (mst_touch.c) --------------------------------------------------------------------------------------- */

/* Whether the touch is in the list of this step. */
static inline MeBool mst_touchIsListed(const MstEvents *e, const MstTouch *t) {
    return t->listedIn == e->list;
}
/* Whether the pair touched at the end of the last finished step. Computed from two flags, so that no pass over all
 * touches is needed when a step begins. */
static inline MeBool mst_touchIsTouching(const MstEvents *e, const MstTouch *t) {
    return mst_touchIsListed(e, t) ? t->wasTouching : t->isTouching;
}
/* Whether the pair touches, by the contacts and the impulse known so far. */
MeBool mst_touchEvaluate(const MstTouch *t);
/* Appends a touch that was updated for this step to the lists. */
void mst_touchList(MstEvents *e, MstTouch *t, MeBool isUndecided);
/* In any thread: the same as mst_touchCommitTested and mst_touchCommitUnchanged, for an existing touch that is not
 * listed yet, but without appending it to lists. */
void mst_touchUpdateTested(const MstBridgeRecord *b, const McdModelPair *p, int numContacts, int found,
                           MeReal separation);
void mst_touchUpdateUnchanged(const MstBridgeRecord *b, const McdModelPair *p);
/* Updates and lists the touch of a pair that was tested. numContacts: of its group now; found: contacts that the test
 * found, with the smallest `separation`, m. */
void mst_touchCommitTested(MstBridgeRecord *b, McdModelPair *p, int numContacts, int found, MeReal separation);
/* Updates and lists the touch of a pair whose contacts are unchanged. */
void mst_touchCommitUnchanged(MstBridgeRecord *b, McdModelPair *p);
/* Updates and lists the touch of a pair with a sensor, from its collision contacts. */
void mst_touchCommitSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Adds the contacts of a group to the touch: its separation, position, normal and approach speed. */
void mst_touchAddContacts(MstTouch *t, MdtContactGroupID group);
/* Removes a touch from the lists of this step. */
void mst_touchUnlist(MstTouch *t);
/* Returns a touch without a pair to the free list. */
void mst_touchFree(MstTouch *t);
/* For assertions: whether touches and pairs refer to each other, and exactly the touches marked as listed are in lists.
 */
MeBool mst_touchesAreConsistent(const MstEvents *e);
/* Frees the memory of all touches, and clears the pairs' pointers to them. */
void mst_freeTouches(MstEvents *e);
/* s, the lag of the pair's bodies behind their world; bodies joined by a pair have the same lag. */
MeReal mst_pairLag(const McdModelPair *p);
/* m/s: the closing speed of the models at a point, once their gap there has closed. The first model is pushed along the
 * normal. */
MeReal mst_approachSpeedAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal, MeReal gap);
/* Contact normal in the direction in which the first model is pushed, whichever body is first in its group. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal);

/* ---- events (MstEvents.c) ---------------------------------------------------------------------------------------- */

/* Begins a step. If the list of events of the last one was never made, the workers settle which of its pairs touch. */
void mst_eventsBegin(MstBridgeRecord *b, MeTeam *team);
/* Adds the contact impulses of the sub-step just done to the listed touches. */
void mst_eventsAddImpulses(MstBridgeRecord *b);
/* Ends and frees the touch of a pair that is removed. */
void MEAPI mst_touchForget(McdModelPair *p);
void mst_eventsTerm(MstBridgeRecord *b);
/* MstBridgeUpdateEvents without its checks. */
void mst_updateEvents(MstBridgeRecord *b, MdtWorldID w);
/* mst_destroyGroup: destroys the contacts of a pair; mst_pairForget: its touch as well, when the space releases the
 * pair. */
void mst_destroyGroup(McdModelPair *p);
void MEAPI mst_pairForget(McdModelPair *p);

#endif
