/** @file McdConvexInteractions.h
 *  Contacts between convex geometries, and between them and planes (User Guide ch. 4, "Geometrical Types and Their
 *  Interactions").
 *
 *  Each pair of types has three functions:
 *  - McdXYRegisterInteraction has pairs of an X and a Y (and of a Y and an X) of a framework interact. Returns 1; 0,
 *    with a warning, if the framework is none. Both types should be registered.
 *  - McdXYIntersect finds the contacts of one pair, whose first model is an X and whose second is a Y: at most 4, well
 *    spread over what the two surfaces have in common, with the normal that pushes the first model out by the shortest
 *    way. Returns 1 if there are any. Other types, or a transform that is not finite, get a warning and 0.
 *  - McdXYSafeTime finds how long the pair may move, see McdSafeTime.
 *  McdIntersect and McdSafeTime call what is registered; the functions can also be called alone, with models that are
 *  up to date (McdInteractions.h).
 *
 *  Where two shapes touch in one point only, or are concentric, and no way out is shorter than another, the normal is a
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
/** @name With a plane, below which all is inside
 *  @{ */
MCD_DECLARE_INTERACTION(SpherePlane);
MCD_DECLARE_INTERACTION(BoxPlane);
MCD_DECLARE_INTERACTION(CylinderPlane);
MCD_DECLARE_INTERACTION(SphylPlane);
MCD_DECLARE_INTERACTION(ConePlane);
MCD_DECLARE_INTERACTION(ConvexMeshPlane);
MCD_DECLARE_INTERACTION(PlaneConvexMesh);
/** @} */

/** @name Many at once
 *  @{ */
/** A convex mesh with sphere, box, cylinder, sphyl, plane and another. Returns 1, or 0 if the framework is none. */
MEPUBLIC MeBool MEAPI McdConvexMeshPrimitivesRegisterInteractions(McdFramework *frame);
/** A convex mesh with sphere and box only. */
MEPUBLIC MeBool MEAPI McdConvexMeshRegisterBoxAndSphereFns(McdFramework *frame);
/** A cone with sphere, box, cylinder, sphyl, plane and another. */
MEPUBLIC MeBool MEAPI McdConePrimitivesRegisterInteractions(McdFramework *frame);
/** @} */

ME_END_C

#endif
