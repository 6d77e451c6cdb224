/** @file MdtLinear2.h The Linear2 joint: a point of the first body stays on a line of the second (Dynamics guide ch. 3,
 *  "MdtLinear2"). It removes two degrees of freedom. The line goes through the joint's position. To hold a point of a
 *  body on a line of the world, make the body the first.
 */
#ifndef MDTLINEAR2_H
#define MDTLINEAR2_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a Linear2 joint, disabled, unattached, at the bodies' centres of mass, the line along the second body's
 *  x-axis. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the world
 *  is full. */
MEPUBLIC MdtLinear2ID MEAPI MdtLinear2Create(const MdtWorldID w);
/** Sets position and direction to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtLinear2Reset(const MdtLinear2ID j);
/** The Linear2 joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtLinear2QuaConstraint(const MdtLinear2ID j);
/** The constraint as a Linear2 joint; null when it is none. */
MEPUBLIC MdtLinear2ID MEAPI MdtConstraintDCastLinear2(const MdtConstraintID c);
/** The direction of the line, world frame. Bad input as in MdtConstraintSetAxis. */
MEPUBLIC void MEAPI MdtLinear2SetDirection(const MdtLinear2ID j, const MeReal x, const MeReal y, const MeReal z);
MEPUBLIC void MEAPI MdtLinear2GetDirection(const MdtLinear2ID j, MeVector3 direction);

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(Linear2)
MDT_JOINT_POSITION(Linear2)

ME_END_C

#endif
