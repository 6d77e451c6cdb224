/** @file MstBridge.h
 *  The bridge: models that touch become contacts of their bodies (User Guide ch. 5, "Building a Bridge").
 *
 *  A material table says for each pair of materials what contacts are like, and who wants to see them. Where models
 *  touch, a contact group joins their bodies until the models are no longer near each other; its contacts are made anew
 *  every step, but one that touches with the same features as before stays the same object, with the force that it had.
 */
#ifndef MSTBRIDGE_H
#define MSTBRIDGE_H

#include "MdtContactParams.h"
#include "MstTypes.h"

ME_BEGIN_C

/** Creates a bridge for at most maxMaterials materials (1 or more, or MeNoLimit; 0 counts as 1 and warns), the default
 *  one included. Null if there is no memory. */
MEPUBLIC MstBridgeID MEAPI MstBridgeCreate(McdFrameworkID frame, const unsigned int maxMaterials);
/** Destroys a bridge; contact groups stay the world's. Null does nothing. */
MEPUBLIC void MEAPI MstBridgeDestroy(const MstBridgeID b);

/** @name Materials
 *  All pairs are unordered: (m1, m2) is (m2, m1). An unknown material gets a warning and counts as the default one.
 *  @{ */
/** The material that every model has at first. */
#define MstBridgeGetDefaultMaterial() ((MstMaterialID)0)
/** A new material; the default one, with a warning that names what to raise, if there is no more room. Parameters of
 *  other materials stay where they are. */
MEPUBLIC MstMaterialID MEAPI MstBridgeGetNewMaterial(const MstBridgeID b);
/** The parameters that contacts of the pair get from now on. They belong to the bridge. */
MEPUBLIC MdtContactParamsID MEAPI MstBridgeGetContactParams(const MstBridgeID b, const MstMaterialID m1,
                                                            const MstMaterialID m2);
/** The callbacks of a pair of materials; null: none. While pairs are handled models and bodies that they destroy wait
 *  (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MstBridgeSetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                            const MstIntersectCBPtr cb);
MEPUBLIC MstIntersectCBPtr MEAPI MstBridgeGetIntersectCB(const MstBridgeID b, const MstMaterialID m1,
                                                         const MstMaterialID m2);
MEPUBLIC void MEAPI MstBridgeSetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                             const MstPerContactCBPtr cb);
MEPUBLIC MstPerContactCBPtr MEAPI MstBridgeGetPerContactCB(const MstBridgeID b, const MstMaterialID m1,
                                                           const MstMaterialID m2);
MEPUBLIC void MEAPI MstBridgeSetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                          const MstPerPairCBPtr cb);
MEPUBLIC MstPerPairCBPtr MEAPI MstBridgeGetPerPairCB(const MstBridgeID b, const MstMaterialID m1,
                                                     const MstMaterialID m2);
/** @} */

/** @name Each step
 *  Both end the space's change block and begin the next one.
 *  @{ */
/** A space of the bridge's framework, whose pairs no other bridge has collided; else a warning, and nothing is done.
 *  Makes the contacts of all pairs of the space: transitions, then collisions, until all pairs are done. A pair of
 *  convex geometries, planes or aggregates of these that stands still to the last bit keeps its contacts as they are,
 *  with what a program has written to their places and normals meanwhile; their parameters follow the materials. */
MEPUBLIC void MEAPI MstBridgeUpdateContacts(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w);
/** Handles hello and goodbye pairs only: after models were put into the space or taken out. */
MEPUBLIC void MEAPI MstBridgeUpdateTransitions(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w);
/** @} */

/** @name Pairs that hardly move
 *  @{ */
#define MST_CONTACT_REUSE 1e-3 /**< default of MstBridgeSetContactReuse */
/**
 * A pair of convex models, planes or aggregates of these is not tested again while no point of the smaller one has
 * moved against the other by more than @a part of its size (the radius of its sphere), 0..1, or a quarter of the two
 * contact tolerances: its contacts are carried along with the bodies. What a test would have found differs by at most
 * that. Pairs with a callback, sensors, swept models, round surfaces and parts with materials of their own are tested
 * in every step, and so are those in partitions of up to 32 bodies. 0: all are that have moved at all, so that
 * contacts are those of a test to the last bit. Beyond Karma.
 */
MEPUBLIC void MEAPI MstBridgeSetContactReuse(const MstBridgeID b, const MeReal part);
MEPUBLIC MeReal MEAPI MstBridgeGetContactReuse(const MstBridgeID b);
/** @} */

/** @name Buffers
 *  @{ */
/** How many collision contacts a pair may have: 1 or more; default 40. */
MEPUBLIC void MEAPI MstBridgeSetContactBufferSize(const MstBridgeID b, const unsigned int s);
/** How many pairs are handled at once: 8 or more; default: all. */
MEPUBLIC void MEAPI MstBridgeSetModelPairBufferSize(const MstBridgeID b, const unsigned int s);
/** @} */

ME_END_C

#endif
