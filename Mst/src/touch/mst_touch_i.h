/* Inside Mst: touches, the bridge's records of pairs, and events. */
#ifndef MST_TOUCH_I_H
#define MST_TOUCH_I_H

#include "bridge/mst_bridge_i.h"

/* ---- touches (mst_touch.c) --------------------------------------------------------------------------------------- */

/* Was it looked at in this step? */
static inline MeBool mst_touchIsListed(const MstEvents *e, const MstTouch *t) {
    return t->listedIn == e->list;
}
/* Does it touch, as of the last step that is done? Nothing is written to all touches when a step begins. */
static inline MeBool mst_touchIsTouching(const MstEvents *e, const MstTouch *t) {
    return mst_touchIsListed(e, t) ? t->wasTouching : t->isTouching;
}
/* From what is known of a touch, whether it touches. */
MeBool mst_touchTouches(const MstTouch *t);
/* The touch, about which something was noted, is one of this step's. */
void mst_touchList(MstEvents *e, MstTouch *t, MeBool isUndecided);
/* As mst_touchNote and mst_touchNoteAgain, for a pair that has a touch that is not listed yet. */
void mst_touchUpdate(const MstBridgeRecord *b, const McdModelPair *p, int numContacts, int found, MeReal separation);
void mst_touchUpdateAgain(const MstBridgeRecord *b, const McdModelPair *p);
/* A pair was tested, and its group holds so many contacts now; the least separation of those found. */
void mst_touchNote(MstBridgeRecord *b, McdModelPair *p, int numContacts, int found, MeReal separation);
/* The pair is unchanged since its touch was last noted. */
void mst_touchNoteAgain(MstBridgeRecord *b, McdModelPair *p);
void mst_touchNoteSensor(MstBridgeRecord *b, McdModelPair *p, const McdIntersectResult *result);
/* Notes the contacts of a group. */
void mst_touchNoteGroup(MstTouch *t, MdtContactGroupID group);
/* The touch is no longer among those of this step; it is free. */
void mst_touchUnlist(MstTouch *t);
void mst_touchGive(MstTouch *t);
/* Check: do touches and pairs refer to each other, and does the list hold exactly those marked as listed? */
MeBool mst_touchesAreConsistent(const MstEvents *e);
/* Returns their memory. Pairs know of none any more. */
void mst_touchesTerm(MstEvents *e);
/* s, by which the pair's bodies are behind their world: those that are tied move together. */
MeReal mst_lagOfPair(const McdModelPair *p);
/* m/s: the approach speed of the models at a point, along the normal, which pushes the first one. */
MeReal mst_approachAt(const McdModelPair *p, MeVector3 point, const MeVector3 normal);
/* A contact's normal as it pushes the first model, whichever body its group has first. */
void mst_normalOf(const McdModelPair *p, MdtContactID c, MeVector3 normal);

/* ---- events (MstEvents.c) ---------------------------------------------------------------------------------------- */

/* A step begins: the workers mark the touches of the last one as such. */
void mst_eventsBegin(MstBridgeRecord *b, MeTeam *team);
/* Adds what contacts did in the part of the step just done. */
void mst_eventsGather(MstBridgeRecord *b);
/* Ends the touch of a pair that goes. */
void MEAPI mst_touchForget(McdModelPair *p);
void mst_eventsTerm(MstBridgeRecord *b);
/* MstBridgeUpdateEvents, by who holds the bridge. */
void mst_updateEvents(MstBridgeRecord *b, MdtWorldID w);
/* Destroys the contacts of a pair; the same as the space releases it. */
void mst_groupDestroy(McdModelPair *p);
void MEAPI mst_pairForget(McdModelPair *p);

#endif
