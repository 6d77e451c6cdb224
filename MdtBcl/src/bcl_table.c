/* The table of constraint types, and the world as a body. */
#include "bcl_i.h"

const MdtKeaTransformation MdtBclWorldPose = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
const MdtKeaVelocity MdtBclWorldVelocity = {{0, 0, 0}, {0, 0, 0}};
const MdtKeaInverseMassMatrix MdtBclWorldInvMass = {0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};

const MdtBclType *MEAPI MdtBclTypeOf(MdtBclJointType type) {
    static const MdtBclType *const table[] = {
        [MdtBclBSJOINT] = &bcl_bsJoint,
        [MdtBclHINGE] = &bcl_hinge,
        [MdtBclCONTACT] = &bcl_contact,
    };
    const int count = (int)(sizeof table / sizeof *table);
    return (int)type >= 0 && (int)type < count ? table[type] : NULL;
}
