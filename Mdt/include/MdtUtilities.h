/** @file MdtUtilities.h
 *  Inertia tensors, conversion between frames, and a position controller for limits.
 */
#ifndef MDTUTILITIES_H
#define MDTUTILITIES_H

#include "MdtTypes.h"

ME_BEGIN_C

/** @name Inertia tensors of solid bodies, kg m², about the centre, in the axes of the shape
 *  A mass or a size that is not positive and finite gets a warning and the unit matrix.
 *  @{ */
/** 0.4 mass radius², mass in kg, radius in m, times the unit matrix. */
MEPUBLIC void MEAPI MdtMakeInertiaTensorSphere(const MeReal mass, const MeReal radius, MeMatrix3 i);
/** lx, ly, lz: the whole lengths of the edges. */
MEPUBLIC void MEAPI MdtMakeInertiaTensorBox(const MeReal mass, const MeReal lx, const MeReal ly, const MeReal lz,
                                            MeMatrix3 i);
/** @} */

/** @name Conversion between frames
 *  A null body is the world. The result t may be the argument f.
 *  @{ */
/** Converts a point from the frame of one body to that of another. */
MEPUBLIC void MEAPI MdtConvertPositionVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body,
                                             MeVector3 t);
/** Converts a direction. */
MEPUBLIC void MEAPI MdtConvertVector(const MdtBodyID from_body, const MeVector3 f, const MdtBodyID to_body,
                                     MeVector3 t);
/** @} */

/**
 * Position controller: called before every step, it drives a limit's motor towards a position. The desired velocity is
 * proportional to the distance within @a gap [m, > 0] of the goal, and @a maxSpeed [m/s, >= 0] beyond; the force is at
 * most @a maxForce [N].
 */
MEPUBLIC void MEAPI MdtLimitController(const MdtLimitID limit, const MeReal desiredPosition, const MeReal gap,
                                       const MeReal maxSpeed, const MeReal maxForce);

ME_END_C

#endif
