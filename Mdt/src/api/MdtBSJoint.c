/* API of the ball-and-socket joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(BSJoint, MdtBclBSJOINT)
