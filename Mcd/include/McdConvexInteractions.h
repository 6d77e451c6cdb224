/** @file McdConvexInteractions.h
 *  Contacts between convex geometries, and between these and planes.
 *
 *  Each pair of types has three functions:
 *  - McdXYRegisterInteraction registers the interaction of X and Y (and of Y and X) with a framework. Returns 1; 0,
 *    with a warning, if the argument is not a framework. Both types should be registered.
 *  - McdXYIntersect finds the contacts of one pair, whose first model is an X and whose second is a Y: at most 4,
 *    well spread over the common part of both surfaces, with the normal along which the first model leaves the
 *    second by the shortest displacement. Returns 1 if there are any. For other types, or a transform that is not
 *    finite: a warning, and 0.
 *  - McdXYSafeTime finds how long the models of the pair may move, see McdSafeTime.
 *  McdIntersect and McdSafeTime call the registered functions; these can also be called directly, for models that
 *  are up to date (McdInteractions.h).
 *
 *  Where shapes touch in a single point, or are concentric, so that no direction is the shortest, the normal is a
 *  fixed direction of the shapes: never zero.
 */
#ifndef MCDCONVEXINTERACTIONS_H
#define MCDCONVEXINTERACTIONS_H

#include "McdCTypes.h"

ME_BEGIN_C

/** Declares the three functions of a pair of types. */
#define MCD_DECLARE_INTERACTION(pair)                                                                                  \
    MEPUBLIC MeBool MEAPI Mcd##pair##RegisterInteraction(McdFramework *frame);                                         \
    MEPUBLIC int MEAPI Mcd##pair##Intersect(McdModelPair *p, McdIntersectResult *result);                              \
    MEPUBLIC int MEAPI Mcd##pair##SafeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result)

/** @name Sphere, box, cylinder, sphyl
 *  @{ */
MCD_DECLARE_INTERACTION(SphereSphere);
MCD_DECLARE_INTERACTION(BoxSphere);
MCD_DECLARE_INTERACTION(BoxBox);
MCD_DECLARE_INTERACTION(BoxCylinder);
MCD_DECLARE_INTERACTION(CylinderSphere);
MCD_DECLARE_INTERACTION(CylinderCylinder);
MCD_DECLARE_INTERACTION(SphylSphere);
MCD_DECLARE_INTERACTION(SphylBox);
MCD_DECLARE_INTERACTION(SphylCylinder);
MCD_DECLARE_INTERACTION(SphylSphyl);
/** @} */
/** @name Cone
 *  @{ */
MCD_DECLARE_INTERACTION(ConeSphere);
MCD_DECLARE_INTERACTION(ConeBox);
MCD_DECLARE_INTERACTION(ConeCylinder);
MCD_DECLARE_INTERACTION(ConeSphyl);
MCD_DECLARE_INTERACTION(ConeCone);
MCD_DECLARE_INTERACTION(ConeConvexMesh);
/** @} */
/** @name Convex mesh
 *  @{ */
MCD_DECLARE_INTERACTION(SphereConvexMesh);
MCD_DECLARE_INTERACTION(BoxConvexMesh);
MCD_DECLARE_INTERACTION(CylinderConvexMesh);
MCD_DECLARE_INTERACTION(SphylConvexMesh);
MCD_DECLARE_INTERACTION(ConvexMeshConvexMesh);
/** @} */
/** @name With a plane, whose inside is below it
 *  @{ */
MCD_DECLARE_INTERACTION(SpherePlane);
MCD_DECLARE_INTERACTION(BoxPlane);
MCD_DECLARE_INTERACTION(CylinderPlane);
MCD_DECLARE_INTERACTION(SphylPlane);
MCD_DECLARE_INTERACTION(ConePlane);
MCD_DECLARE_INTERACTION(ConvexMeshPlane);
MCD_DECLARE_INTERACTION(PlaneConvexMesh);
/** @} */

/** @name Several pairs of types
 *  @{ */
/** Registers a convex mesh with sphere, box, cylinder, sphyl, plane, triangle list and convex mesh. Returns 1; 0,
 *  with a warning, if @a frame is not a framework. */
MEPUBLIC MeBool MEAPI McdConvexMeshPrimitivesRegisterInteractions(McdFramework *frame);
/** Registers a convex mesh with sphere and box only. Returns as McdConvexMeshPrimitivesRegisterInteractions. */
MEPUBLIC MeBool MEAPI McdConvexMeshRegisterBoxAndSphereFns(McdFramework *frame);
/** Registers a cone with sphere, box, cylinder, sphyl, plane and cone. Returns as
 *  McdConvexMeshPrimitivesRegisterInteractions. */
MEPUBLIC MeBool MEAPI McdConePrimitivesRegisterInteractions(McdFramework *frame);
/** @} */

ME_END_C

#endif
