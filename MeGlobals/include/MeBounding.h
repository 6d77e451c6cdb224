/** @file MeBounding.h
 *  Bounding sphere of points.
 */
#ifndef MEBOUNDING_H
#define MEBOUNDING_H

#include "MePrecision.h"

ME_BEGIN_C

/** Computes the smallest sphere that contains all points; the radius is rounded up. Warns of null pointers, fewer than
 *  1 point, and coordinates that are not finite; then the centre is (0, 0, 0) and the radius 0. */
MEPUBLIC void MEAPI MeBoundingSphereCalc(MeVector3 *points, int numPoints, MeVector3 centre, MeReal *radius);

ME_END_C

#endif
