/** @file McdPlaneIntersect.h
 *  Planes and convex geometries of any type: contacts and cross-sections.
 */
#ifndef MCDPLANEINTERSECT_H
#define MCDPLANEINTERSECT_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** @name Contacts with a plane
 *  As Mcd...PlaneIntersect, for any convex type: sphere, box, cylinder, sphyl, cone, convex mesh. No interaction
 *  needs to be registered. Other pairs get a warning, and 0.
 *  @{ */
/** Finds the contacts of a pair with one plane; 1 if they touch. */
MEPUBLIC int MEAPI McdPlaneIntersect(McdModelPair *p, McdIntersectResult *result);
/** Finds the contacts of two models, the plane first; the result has no pair. */
MEPUBLIC int MEAPI McdPlaneIntersectTest(McdModelID modplane, McdModelID mod, McdIntersectResult *result);
/** @} */

/** @name Cross-sections
 *  The intersection of an instance with the plane of the points x with normal . x = dist (world frame; normal of
 *  length 1): a convex polygon, with corners in the world, counter-clockwise seen from the side to which the normal
 *  points. outVert has room for maxVert corners (3 or more). numVert gets their number: 0 if the plane does not cut
 *  the instance, or touches only a corner or an edge. If there are more than maxVert, evenly chosen ones are
 *  written. Bad arguments and instances of other types get a warning and 0 corners.
 *  @{ */
/** For a box: up to 6 corners. */
MEPUBLIC void MEAPI McdBoxGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                   int *numVert, MeVector3 *outVert);
/** For a cylinder, approximated by a prism with 32 sides, or maxVert - 2 if that is less. */
MEPUBLIC void MEAPI McdCylinderGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                        int *numVert, MeVector3 *outVert);
/** For a convex mesh, without its fatness: up to as many corners as it has faces. */
MEPUBLIC void MEAPI McdConvexMeshGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                          int *numVert, MeVector3 *outVert);
/** For an instance of any of these types. */
MEPUBLIC void MEAPI McdGeometryInstanceGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist,
                                                int maxVert, int *numVert, MeVector3 *outVert);
/** @} */

ME_END_C

#endif
