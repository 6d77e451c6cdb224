/* API of the prismatic joint. */
#include "api/mdt_api_i.h"

MDT_JOINT_BASICS(Prismatic, MdtBclPRISMATIC)
MDT_JOINT_LIMIT(Prismatic, MdtBclPRISMATIC, limit)
