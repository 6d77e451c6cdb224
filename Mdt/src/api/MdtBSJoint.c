/* API of the ball-and-socket joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(BSJoint, MdtBclBSJOINT)
MDT_JOINT_TURN_MOTOR(BSJoint, MdtBclBSJOINT, servo)
