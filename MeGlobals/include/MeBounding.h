/** @file MeBounding.h
 *  A sphere around points.
 */
#ifndef MEBOUNDING_H
#define MEBOUNDING_H

#include "MePrecision.h"

ME_BEGIN_C

/** The smallest sphere around points: its centre and its radius, which rounding makes no smaller. Warns of null
 *  pointers, of fewer than 1 point, and of coordinates that are not finite; then the centre is (0, 0, 0), the radius
 *  0. */
MEPUBLIC void MEAPI MeBoundingSphereCalc(MeVector3 *points, int numPoints, MeVector3 centre, MeReal *radius);

ME_END_C

#endif
