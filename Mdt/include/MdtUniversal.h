/** @file MdtUniversal.h The universal joint: two bodies share a point, and an axis of one stays at right angles to an
 *  axis of the other (Dynamics guide ch. 3, "MdtUniversal"). It removes four degrees of freedom: the bodies bend both
 *  ways, but do not twist.
 *
 *  Bent by 90 degrees it carries no torque from one body to the other; coming there gets a warning, and a cone limit
 *  keeps it away. The bend is counted from how the bodies stand when the axes are set. By default the axes are x in
 *  body 0 and y in body 1.
 */
#ifndef MDTUNIVERSAL_H
#define MDTUNIVERSAL_H

#include "MdtConstraint.h"

ME_BEGIN_C

/** Creates a universal joint, disabled, unattached, at the bodies' centres of mass, its axes x in the first and y in
 *  the second. The world owns it. Returns null, with a warning that names MdtWorldCreate's maxConstraints, when the
 *  world is full. */
MEPUBLIC MdtUniversalID MEAPI MdtUniversalCreate(const MdtWorldID w);
/** Sets position and axes to the defaults of a new joint. Bodies and state stay. */
MEPUBLIC void MEAPI MdtUniversalReset(const MdtUniversalID j);
/** The universal joint as a constraint. Null for null. */
MEPUBLIC MdtConstraintID MEAPI MdtUniversalQuaConstraint(const MdtUniversalID j);
/** The constraint as a universal joint; null when it is none. */
MEPUBLIC MdtUniversalID MEAPI MdtConstraintDCastUniversal(const MdtConstraintID c);
/** The joint's axis in the body of index 0 or 1, world frame. Bad input as in MdtConstraint.h. */
MEPUBLIC void MEAPI MdtUniversalSetAxis(const MdtUniversalID j, const unsigned int bodyindex, const MeReal Ax,
                                        const MeReal Ay, const MeReal Az);
/** Where that axis is now, world frame. */
MEPUBLIC void MEAPI MdtUniversalGetAxis(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 axis);

/* What every constraint has, under this joint's name: see the end of MdtConstraint.h. */
MDT_JOINT_COMMON(Universal)
MDT_JOINT_POSITION(Universal)
/** Both axes at once: the primary one is that of body 0, the second one that of body 1 (User Guide app. D). */
MDT_JOINT_AXES(Universal)
static inline void MdtUniversalGetAxes(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 primary,
                                       MeVector3 ortho) {
    MdtConstraintBodyGetAxes(MdtUniversalQuaConstraint(j), bodyindex, primary, ortho);
}

ME_END_C

#endif
