/** @file MdtLinear1.h The Linear1 joint: a point of the first body stays in a plane of the second (Dynamics guide ch.
 *  3, "MdtLinear1"). It removes one degree of freedom. The plane goes through the joint's position, and the joint's
 *  axis is its normal. To hold a point of a body in a plane of the world, make the body the first.
 */
#ifndef MDTLINEAR1_H
#define MDTLINEAR1_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Linear1 joint, disabled, unattached, at the bodies' centres of mass, the plane's normal the second body's
 *  x-axis. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtLinear1ID MEAPI MdtLinear1Create(const MdtWorldID w);
/** Sets position and axis to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtLinear1Reset(const MdtLinear1ID j);
/** The Linear1 joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtLinear1QuaConstraint(const MdtLinear1ID j);
/** The constraint as a Linear1 joint; null when it is none. */
MEPUBLIC MdtLinear1ID MEAPI MdtConstraintDCastLinear1(const MdtConstraintID c);

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(Linear1)
MDT_JOINT_POSITION(Linear1)
MDT_JOINT_AXIS(Linear1)

ME_END_C

#endif
