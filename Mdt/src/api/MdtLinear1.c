/* The Linear1 joint's part of the API. */
#include "mdt_i.h"

MDT_JOINT_BASICS(Linear1, MdtBclLINEAR1)
