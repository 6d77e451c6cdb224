/** @file McdPlaneIntersect.h
 *  Planes and convex geometries of any type; cross-sections.
 */
#ifndef MCDPLANEINTERSECT_H
#define MCDPLANEINTERSECT_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** @name Contacts with a plane
 *  As Mcd...PlaneIntersect, for whatever convex type it is: sphere, box, cylinder, sphyl, cone, convex mesh. No
 *  interaction needs to be registered. Any other pair gets a warning, and 0.
 *  @{ */
/** Contacts of a pair one of which is a plane; 1 if they touch. */
MEPUBLIC int MEAPI McdPlaneIntersect(McdModelPair *p, McdIntersectResult *result);
/** The same of two models, the plane first; the result has no pair. */
MEPUBLIC int MEAPI McdPlaneIntersectTest(McdModelID modplane, McdModelID mod, McdIntersectResult *result);
/** @} */

/** @name Cross-sections
 *  Where the plane of the points x with normal . x = dist (world frame; normal of length 1) cuts an instance: a convex
 *  polygon, its corners in the world, counter-clockwise as seen from where the normal points to. outVert has place for
 *  maxVert (3 or more); numVert gets how many there are, 0 where the plane does not cut it, or only touches a corner or
 *  an edge. If there are more than maxVert, evenly chosen ones. Bad arguments and instances of other types get a
 *  warning and 0 corners.
 *  @{ */
/** Of a box, up to 6 corners. */
MEPUBLIC void MEAPI McdBoxGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                   int *numVert, MeVector3 *outVert);
/** Of a cylinder, which counts as a prism with 32 sides, or maxVert - 2 if that is less. */
MEPUBLIC void MEAPI McdCylinderGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                        int *numVert, MeVector3 *outVert);
/** Of a convex mesh, without its fatness: up to as many corners as it has faces. */
MEPUBLIC void MEAPI McdConvexMeshGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                          int *numVert, MeVector3 *outVert);
/** Of an instance of any of these types. */
MEPUBLIC void MEAPI McdGeometryInstanceGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist,
                                                int maxVert, int *numVert, MeVector3 *outVert);
/** @} */

ME_END_C

#endif
