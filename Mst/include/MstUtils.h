/** @file MstUtils.h
 *  Models with and without bodies, and the parts of the bridge.
 */
#ifndef MSTUTILS_H
#define MSTUTILS_H

#include "MstTypes.h"

ME_BEGIN_C

/** @name Models
 *  @{ */
/**
 * Creates a model of a geometry with an enabled body at the origin, and inserts the model into the universe's space.
 * Mass and inertia follow from the geometry and a density (kg/m³, > 0). Null, with a warning, if there is no room.
 */
MEPUBLIC McdModelID MEAPI MstModelAndBodyCreate(const MstUniverseID u, const McdGeometryID g, const MeReal density);
/** MstModelAndBodyCreate with the centre of mass, and the axes of inertia, where the geometry has them: also exact for
 *  compounds and meshes whose centre of mass is not at their origin. The model's and the body's frame is the
 *  geometry's. Beyond Karma. */
MEPUBLIC McdModelID MEAPI MstModelAndBodyCreateWithCenter(const MstUniverseID u, const McdGeometryID g,
                                                          const MeReal density);
/** Removes such a model from its space and destroys it, its body and its contacts. The geometry remains. */
MEPUBLIC void MEAPI MstModelAndBodyDestroy(const McdModelID m);
/** Creates and freezes a model that does not move, in the universe's space. The transform is kept by pointer; if it is
 *  more than a rotation and a translation (a scale or a mirror image), there is a warning. If the program writes to it
 *  after McdSpaceUnfreezeModel, the model moves there in the next step, as a kinematic body does (MdtBodyMoveTo); if it
 *  is farther than its bounding sphere's radius, it is there at once. */
MEPUBLIC McdModelID MEAPI MstFixedModelCreate(const MstUniverseID u, const McdGeometryID g,
                                              MeMatrix4Ptr transformation);
/**
 * MstFixedModelCreate at a pose that is copied: the model owns its transform (McdModelGetTransformPtr), which lives as
 * long as the model. A number that is not finite, and a quaternion of 0, get a warning, and null. Beyond Karma.
 * @param position    m, of the geometry's origin
 * @param quaternion  w x y z, geometry to world; normalized here. Null: the world's axes
 */
MEPUBLIC McdModelID MEAPI MstFixedModelCreateAt(const MstUniverseID u, const McdGeometryID g, const MeVector3 position,
                                                const MeVector4 quaternion);
/** Removes such a model from its space and destroys it and its contacts. The geometry remains. */
MEPUBLIC void MEAPI MstFixedModelDestroy(const McdModelID m);
/**
 * Sets a body's mass and inertia from the model's geometry and a density (kg/m³, > 0). The centre of mass is unchanged,
 * by default the geometry's origin (User Guide ch. 4): if the geometry's centre of mass is elsewhere, also call
 * MdtBodySetCenterOfMassRelativePosition. A geometry without mass properties changes nothing, with a warning.
 */
MEPUBLIC void MEAPI MstAutoSetMassProperties(const MdtBodyID body, const McdModelID model, const MeReal density);
/** MstAutoSetMassProperties, and the centre of mass with the axes of inertia (MdtBodySetCenterOfMassRelativeTransform),
 *  for a body whose frame is the model's. Beyond Karma. */
MEPUBLIC void MEAPI MstAutoSetMassAndCenter(const MdtBodyID body, const McdModelID model, const MeReal density);
/** Sets the inertia of the model's own body from the geometry; the mass is unchanged. */
MEPUBLIC void MEAPI MstAutoSetInertialTensor(const McdModelID model);
/** @} */

/** @name Parts of the bridge
 *  @{ */
/**
 * McdHello for the hello pairs of a container; for the goodbye pairs, destroys their contacts and calls McdGoodbye. The
 * sample of the guide passes the container alone.
 */
MEPUBLIC void MEAPI MstHandleTransitions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                         const MstBridgeID b);
/** MstHandleTransitions with one argument. */
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
/** Updates the contacts of the hello and staying pairs of a container, except pairs of two frozen models. */
MEPUBLIC void MEAPI MstHandleCollisions(McdModelPairContainer *pairs, const McdSpaceID s, const MdtWorldID w,
                                        const MstBridgeID b);
/** From now on, models of the world's bodies are frozen while their bodies are disabled. Called by
 * MstUniverseCreate. */
MEPUBLIC void MEAPI MstSetWorldHandlers(const MdtWorldID world);
/** @} */

ME_END_C

#endif
