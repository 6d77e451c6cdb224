/** @file MstUtils.h
 *  Models with and without bodies, and the parts that the bridge is made of (User Guide ch. 5, "Fitting Out the
 *  Universe").
 */
#ifndef MSTUTILS_H
#define MSTUTILS_H

#include "MstTypes.h"

ME_BEGIN_C

/** @name Models
 *  @{ */
/**
 * Creates a model of a geometry with an enabled body at the origin, its mass and inertia those of the geometry at a
 * density (kg/m³, > 0), and puts the model into the universe's space. Null, with a warning, if something has no room.
 */
MEPUBLIC McdModelID MEAPI MstModelAndBodyCreate(const MstUniverseID u, const McdGeometryID g, const MeReal density);
/** Takes such a model out of its space and destroys it, its body and its contacts. The geometry stays. */
MEPUBLIC void MEAPI MstModelAndBodyDestroy(const McdModelID m);
/** Creates a model that does not move, at a transform that is kept by pointer, in the universe's space, and freezes
 *  it. A transform that is more than a rotation and a position, a scale or a mirror image, gets a warning. */
MEPUBLIC McdModelID MEAPI MstFixedModelCreate(const MstUniverseID u, const McdGeometryID g,
                                              MeMatrix4Ptr transformation);
/** Takes such a model out of its space and destroys it and its contacts. The geometry stays. */
MEPUBLIC void MEAPI MstFixedModelDestroy(const McdModelID m);
/**
 * Sets a body's mass and inertia from the model's geometry and a density (kg/m³, > 0). The centre of mass stays where
 * it is, at first the geometry's origin (User Guide ch. 4): a geometry whose own centre of mass is elsewhere wants
 * MdtBodySetCenterOfMassRelativePosition as well. A geometry without mass properties changes nothing, with a warning.
 */
MEPUBLIC void MEAPI MstAutoSetMassProperties(const MdtBodyID body, const McdModelID model, const MeReal density);
/** The same for the model's own body, whose mass stays: only the inertia is set. */
MEPUBLIC void MEAPI MstAutoSetInertialTensor(const McdModelID model);
/** @} */

/** @name Parts of the bridge
 *  @{ */
/**
 * McdHello for the hello pairs of a container; for the goodbye pairs, destroys their contacts and calls McdGoodbye. The
 * guide's sample passes the container alone.
 */
MEPUBLIC void MEAPI MstHandleTransitions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                         const MstBridgeID b);
/** What the form with one argument stands for. */
MEPUBLIC void MEAPI MstHandleTransitionsOf(McdModelPairContainer *pairs);
#ifdef __cplusplus
ME_END_C
inline void MstHandleTransitions(McdModelPairContainer *pairs) {
    MstHandleTransitionsOf(pairs);
}
ME_BEGIN_C
#else
#define MST_FIFTH(a, b, c, d, e, ...)         e
#define MstHandleTransitionsWith1(p)          MstHandleTransitionsOf(p)
#define MstHandleTransitionsWith4(p, s, w, b) (MstHandleTransitions)((p), (s), (w), (b))
#define MstHandleTransitions(...)                                                                                      \
    MST_FIFTH(__VA_ARGS__, MstHandleTransitionsWith4, MstHandleTransitions_takes_1_or_4_arguments,                     \
              MstHandleTransitions_takes_1_or_4_arguments, MstHandleTransitionsWith1, 0)                               \
    (__VA_ARGS__)
#endif
/** Makes the contacts of the hello and staying pairs of a container, but where both models are frozen. */
MEPUBLIC void MEAPI MstHandleCollisions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                        const MstBridgeID b);
/** Has the models of the world's bodies frozen while their bodies are disabled. MstUniverseCreate does so. */
MEPUBLIC void MEAPI MstSetWorldHandlers(const MdtWorldID world);
/** @} */

ME_END_C

#endif
