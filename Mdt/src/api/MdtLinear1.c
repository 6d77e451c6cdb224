/* API of the Linear1 joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Linear1, MdtBclLINEAR1)
