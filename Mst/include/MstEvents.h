/** @file MstEvents.h
 *  Events of a step: touches that begin, persist or end, with their impulses; overlaps with sensors; joints that
 *  broke. Beyond Karma; events belong to the bridge.
 *
 *  Touch. Two models begin to touch in a step in which one of their contacts carries a force or overlaps. They continue
 *  to touch until no contact does either and their gap exceeds the sum of their contact tolerances; this hysteresis
 *  keeps resting contacts from flickering. Contacts that a callback has removed do not count. A touch gives one begin
 *  event, a persist event in every later step in which the models touch, and one end event. While both models are
 *  frozen, as those of sleeping bodies are, the pair has no events, and the touch continues.
 *
 *  Sensors (McdModelSetSensor) touch the models that they overlap at the beginning of a step, with or without a body,
 *  also frozen and sleeping ones. They wake nothing, and do not detect each other. Pairs of two frozen models have no
 *  events here either, so a sensor that is to detect sleeping models must not be frozen: use McdModelCreate and
 *  McdSpaceInsertModel, not MstFixedModelCreate.
 *
 *  Removal. When a model leaves the space, is destroyed or filtered (McdModelSetFilter), or moves away while its body
 *  sleeps, its touches end with an event in the list of the next step. Destroyed models are null in the list. The event
 *  of a destroyed joint is missing, or has a null joint.
 *
 *  Order. First touches that ended between the steps, in the order in which they ended; then pairs in the order of the
 *  space: goodbye, hello, staying pairs, each by sort keys, then creation; then broken joints, by sort keys, then
 *  creation. Touch callbacks are called in that order when the list is complete; they may create and destroy anything,
 *  but not step or destroy the universe (docs/simulation.md, "Callbacks"). Broken joints have a callback of the world
 *  (MdtWorldSetBreakCB), called at the end of its step.
 */
#ifndef MSTEVENTS_H
#define MSTEVENTS_H

#include "MstTypes.h"

ME_BEGIN_C

/**
 * The events of the last step. Owned by the bridge, valid until the next step. Call it again after destroying a model
 * or a joint: destroyed ones are null then.
 * @param count the number of events; 0, with a null result, if @a b is not a bridge.
 */
MEPUBLIC const MstEvent *MEAPI MstBridgeGetEvents(const MstBridgeID b, int *count);
/** The events of a universe's bridge: MstBridgeGetEvents. */
MEPUBLIC const MstEvent *MEAPI MstUniverseGetEvents(const MstUniverseID u, int *count);
/** The callback for touch events of a pair of materials (docs/simulation.md, "Callbacks"); null, the default: none. */
MEPUBLIC void MEAPI MstBridgeSetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                        const MstTouchCBPtr cb);
/** Null by default. */
MEPUBLIC MstTouchCBPtr MEAPI MstBridgeGetTouchCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2);
/**
 * Makes the list of events after MdtWorldStep and calls the callbacks: for programs that make the parts of
 * MstUniverseStep themselves. Without this call there are no events.
 */
MEPUBLIC void MEAPI MstBridgeUpdateEvents(const MstBridgeID b, const MdtWorldID w);

/** @name What a sensor finds
 *  @{ */
/** Kinds of models that a sensor may find, to be summed. */
enum {
    MstSensesFixed = 1,   /**< models without a body */
    MstSensesMoved = 2,   /**< kinematic bodies, and fixed models that the program moves */
    MstSensesDynamic = 4, /**< bodies that forces move, also sleeping ones */
    MstSensesAll = 7      /**< the default */
};
/** Sets what a sensor finds: a sum of kinds. Categories and masks (McdModelSetFilter) count besides. Touches with what
 *  it no longer finds end in the next step. A bit of no kind gets a warning, and nothing changes. Of a model that is no
 *  sensor it counts once it is one. */
MEPUBLIC void MEAPI MstSensorSetMask(const McdModelID sensor, const MeU32 mask);
/** What the sensor finds; 0, with a warning, if it is no model. */
MEPUBLIC MeU32 MEAPI MstSensorGetMask(const McdModelID sensor);
/** @} */

ME_END_C

#endif
