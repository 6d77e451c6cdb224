/* API of the hinge. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Hinge, MdtBclHINGE)
MDT_JOINT_LIMIT(Hinge, MdtBclHINGE, limit)
