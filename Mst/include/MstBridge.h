/** @file MstBridge.h
 *  The bridge: turns collisions of models into contacts of their bodies.
 *
 *  A table of material pairs has the contact parameters and the callbacks of each pair. Two touching models have a
 *  contact group, which joins their bodies until the models are no longer near each other. Contacts are updated in
 *  every step; a contact between the same features persists as the same object, with its force as warm start.
 */
#ifndef MSTBRIDGE_H
#define MSTBRIDGE_H

#include "MdtContactParams.h"
#include "MstTypes.h"

ME_BEGIN_C

/** Creates a bridge for at most maxMaterials materials, the default one included: 1 or more, or MeNoLimit; 0 counts as
 *  1 and warns. Null if there is no memory. */
MEPUBLIC MstBridgeID MEAPI MstBridgeCreate(McdFrameworkID frame, const unsigned int maxMaterials);
/** Destroys a bridge; its contact groups remain in their world. Null does nothing. */
MEPUBLIC void MEAPI MstBridgeDestroy(const MstBridgeID b);

/** @name Materials
 *  All pairs are unordered: (m1, m2) is (m2, m1). An unknown material gets a warning and counts as the default one.
 *  @{ */
/** The material that every model has at first. */
#define MstBridgeGetDefaultMaterial() ((MstMaterialID)0)
/** Creates a material. Beyond the limit: the default material, with a warning that names the limit to raise.
 *  Pointers to parameters of other materials stay valid. */
MEPUBLIC MstMaterialID MEAPI MstBridgeGetNewMaterial(const MstBridgeID b);
/** The parameters of contacts of the pair from now on. Owned by the bridge. */
MEPUBLIC MdtContactParamsID MEAPI MstBridgeGetContactParams(const MstBridgeID b, const MstMaterialID m1,
                                                            const MstMaterialID m2);
/** The callbacks of a pair of materials, on the thread that steps; null: none. This one gets what collision has found,
 *  before contacts of dynamics are made of it, and may change or remove some (MstTypes.h). Models and bodies that they
 *  destroy are removed once all pairs are handled (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI MstBridgeSetIntersectCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                            const MstIntersectCBPtr cb);
/** Null by default. */
MEPUBLIC MstIntersectCBPtr MEAPI MstBridgeGetIntersectCB(const MstBridgeID b, const MstMaterialID m1,
                                                         const MstMaterialID m2);
/** Called for each contact that dynamics is to get: it may set the contact's parameters and direction; false deletes
 *  it. */
MEPUBLIC void MEAPI MstBridgeSetPerContactCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                             const MstPerContactCBPtr cb);
/** Null by default. */
MEPUBLIC MstPerContactCBPtr MEAPI MstBridgeGetPerContactCB(const MstBridgeID b, const MstMaterialID m1,
                                                           const MstMaterialID m2);
/** Called once for all contacts of a pair of models, after the callback for each; false deletes all. */
MEPUBLIC void MEAPI MstBridgeSetPerPairCB(const MstBridgeID b, const MstMaterialID m1, const MstMaterialID m2,
                                          const MstPerPairCBPtr cb);
/** Null by default. */
MEPUBLIC MstPerPairCBPtr MEAPI MstBridgeGetPerPairCB(const MstBridgeID b, const MstMaterialID m1,
                                                     const MstMaterialID m2);
/** @} */

/** @name Each step
 *  Both end the space's change block and begin the next one.
 *  @{ */
/** Updates the contacts of all pairs of the space: transitions first, then collisions. The space must be of the
 *  bridge's framework, and no other bridge may have collided its pairs; otherwise there is a warning, and nothing is
 *  done. A pair of convex geometries, planes or aggregates of these that has not moved, to the last bit, keeps its
 *  contacts, including positions and normals that the program has written; their parameters follow the materials. */
MEPUBLIC void MEAPI MstBridgeUpdateContacts(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w);
/** Handles hello and goodbye pairs only, after models were inserted into the space or removed. */
MEPUBLIC void MEAPI MstBridgeUpdateTransitions(const MstBridgeID b, const McdSpaceID s, const MdtWorldID w);
/** @} */

/** @name Pairs that hardly move
 *  @{ */
#define MST_CONTACT_REUSE 1e-3 /**< default of MstBridgeSetContactReuse */
/**
 * A pair of convex models, planes or aggregates of these is not tested again while it has hardly moved. Hardly: no
 * point of the smaller model has moved relative to the other one by more than @a part of its size (its bounding
 * radius), 0..1, or a quarter of the sum of the two contact tolerances. Instead, its contacts are moved with the
 * bodies; they differ from tested ones by at most that displacement. Tested in every step all the same: pairs with a
 * callback, sensors, swept models, round surfaces, child shapes with materials of their own, and pairs in partitions
 * of up to 32 bodies. 0: every pair that has moved at all is tested. Beyond Karma.
 */
MEPUBLIC void MEAPI MstBridgeSetContactReuse(const MstBridgeID b, const MeReal part);
/** MST_CONTACT_REUSE by default; 0, with a warning, for a bad handle. */
MEPUBLIC MeReal MEAPI MstBridgeGetContactReuse(const MstBridgeID b);
/** @} */

/** @name Buffers
 *  @{ */
/** The largest number of collision contacts of a pair: 1 or more; default 40. */
MEPUBLIC void MEAPI MstBridgeSetContactBufferSize(const MstBridgeID b, const unsigned int s);
/** The number of pairs that are handled at once: 8 or more; default: all. */
MEPUBLIC void MEAPI MstBridgeSetModelPairBufferSize(const MstBridgeID b, const unsigned int s);
/** @} */

ME_END_C

#endif
