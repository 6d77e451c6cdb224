/** @file MstEvents.h
 *  Events: who began to touch whom, how hard, who still does, who no longer does; what overlaps a sensor; which joints
 *  broke. Beyond Karma; they belong to the bridge (User Guide ch. 5).
 *
 *  Touch. Two models touch in a step when a contact of theirs carried a force or overlapped; they touch on until no
 *  contact does and their gap is larger than their contact tolerances, so that resting contacts do not blink. Contacts
 *  that a callback took away do not count. A touch is one begin, a persist in every later step that the models touch,
 *  and one end. Where both models are frozen, as those of sleeping bodies are, the pair is silent: no event, and the
 *  touch goes on.
 *
 *  Sensors (McdModelSetSensor) touch what they overlap as a step begins, with or without a body, also models that are
 *  frozen or asleep; they wake nothing, and sensors do not see each other. Two models that are both frozen are silent
 *  here too, so a sensor that is to find what sleeps already is left unfrozen: McdModelCreate and McdSpaceInsertModel,
 *  not MstFixedModelCreate.
 *
 *  What goes. When a model leaves the space, is destroyed or filtered (McdModelSetFilter), or moves away while its body
 *  sleeps, its touches end with an event in the next step's list. Models that were destroyed are null in the list. A
 *  joint that was destroyed has no event any more, or a null in it.
 *
 *  Order. First the touches that ended between the steps, in the order in which they did; then pairs as the space hands
 *  them over, goodbyes, hellos, staying ones, each by sort keys, then creation; then broken joints, by sort keys, then
 *  creation. Callbacks of touches are called in that order when the list is complete; they may create and destroy what
 *  they like, but not step or end the universe (docs/simulation.md, "Callbacks"). Joints have a callback of the world's
 *  (MdtWorldSetBreakCB), at the end of its step.
 */
#ifndef MSTEVENTS_H
#define MSTEVENTS_H

#include "MstTypes.h"

ME_BEGIN_C

/**
 * The events of the step just done: the bridge's, valid until the next step. After destroying something ask again: what
 * is gone is null then.
 * @param count how many there are; 0, and a null result, for what is no bridge.
 */
MEPUBLIC const MstEvent *MEAPI MstBridgeGetEvents(const MstBridgeID b, int *count);
/** The same, of a universe's bridge. */
MEPUBLIC const MstEvent *MEAPI MstUniverseGetEvents(const MstUniverseID u, int *count);
/** Who is called for the events of touches of a pair of materials (docs/simulation.md, "Callbacks"); null: nobody, the
 *  default. */
MEPUBLIC void MEAPI MstBridgeSetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                        const MstTouchCBPtr cb);
MEPUBLIC MstTouchCBPtr MEAPI MstBridgeGetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2);
/**
 * Makes the list after a step of the world, and calls the callbacks: for programs that do by hand what
 * MstUniverseStep does; after MdtWorldStep. Without it there are no events.
 */
MEPUBLIC void MEAPI MstBridgeUpdateEvents(const MstBridgeID b, const MdtWorldID w);

ME_END_C

#endif
