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
/* The same as mst_touchNoteTested and mst_touchNoteUnchanged for an existing touch that is not listed yet, without
 * appending it to lists: may run in any thread. */
void mst_touchUpdateTested(const MstBridgeRecord *b, const McdModelPair *p, int numContacts, int found,
                           MeReal separation);
void mst_touchUpdateUnchanged(const MstBridgeRecord *b, const McdModelPair *p);
/* Updates the touch of a pair that was tested, and whose group now has numContacts contacts; `separation` is the least
 * one of the `found` contacts. */
void mst_touchNoteTested(MstBridgeRecord *b, McdModelPair *p, int numContacts, int found, MeReal separation);
/* Updates the touch of a pair whose contacts remain as they are. */
void mst_touchNoteUnchanged(MstBridgeRecord *b, McdModelPair *p);
/* Updates the touch of a pair with a sensor from its collision contacts. */
void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Updates the touch's separation, place and approach speed from the contacts of a group. */
void mst_touchNoteGroup(MstTouch *t, MdtContactGroupID group);
/* Removes a touch from the lists of this step. */
void mst_touchUnlist(MstTouch *t);
/* Returns a touch without a pair to the free list. */
void mst_touchFree(MstTouch *t);
/* For assertions: touches and pairs refer to each other, and the lists have exactly the touches marked as listed. */
MeBool mst_touchesAreConsistent(const MstEvents *e);
/* Frees the memory of all touches, and clears the pairs' pointers to them. */
void mst_freeTouches(MstEvents *e);
/* s, the lag of the pair's bodies behind their world; bodies joined by a pair have the same lag. */
MeReal mst_pairLag(const McdModelPair *p);
/* m/s: the closing speed of the models at a point; the normal is the direction in which the first model is pushed. */
MeReal mst_approachSpeedAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal);
/* Contact normal in the direction in which the first model is pushed, whichever body is first in its group. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal);

/* ---- events (MstEvents.c) ---------------------------------------------------------------------------------------- */

/* Begins a step: settles the touches of the last one, by the workers, if its list of events was never made. */
void mst_eventsBegin(MstBridgeRecord *b, MeTeam *team);
/* Adds the contact impulses of the sub-step just done to the listed touches. */
void mst_eventsGather(MstBridgeRecord *b);
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
