/* API of the cone limit. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(ConeLimit, MdtBclCONELIMIT)

MDT_JOINT_DATA(ConeLimit, MdtBclCONELIMIT, MdtBclCone, cone)
MDT_JOINT_PROPERTY(ConeLimit, ConeHalfAngle, mdt_setAngle, "the half angle", limit.limit[1].stop)
MDT_JOINT_PROPERTY(ConeLimit, Stiffness, mdt_setNonNegative, "the stiffness", stiffness)
MDT_JOINT_PROPERTY(ConeLimit, Damping, mdt_setNonNegative, "the damping", damping)
