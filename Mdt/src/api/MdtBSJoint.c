/* The ball-and-socket joint's part of the API. */
#include "mdt_i.h"

MDT_JOINT_BASICS(BSJoint, MdtBclBSJOINT)
