/* The ball-and-socket joint's part of the API. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(BSJoint, MdtBclBSJOINT)
