/* The Linear1 joint's part of the API. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Linear1, MdtBclLINEAR1)
