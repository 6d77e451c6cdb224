/* The table of constraint types, and the world as a body. */
#include "bcl_i.h"

const MdtKeaTransformation MdtBclWorldPose = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
const MdtKeaVelocity MdtBclWorldVelocity = {{0, 0, 0}, {0, 0, 0}};
const MdtKeaInverseMassMatrix MdtBclWorldInvMass = {0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};

const MdtBclType *MEAPI MdtBclTypeOf(MdtBclJointType type) {
    static const MdtBclType *const table[] = {
        [MdtBclBSJOINT] = &bcl_bsJoint,     [MdtBclHINGE] = &bcl_hinge,
        [MdtBclPRISMATIC] = &bcl_prismatic, [MdtBclCARWHEEL] = &bcl_carWheel,
        [MdtBclCONTACT] = &bcl_contact,     [MdtBclCONTACTGROUP] = &bcl_contactGroup,
        [MdtBclFIXEDPATH] = &bcl_fixedPath, [MdtBclRPROJOINT] = &bcl_rproJoint,
        [MdtBclUNIVERSAL] = &bcl_universal, [MdtBclSKELETAL] = &bcl_skeletal,
        [MdtBclLINEAR1] = &bcl_linear1,     [MdtBclLINEAR2] = &bcl_linear2,
        [MdtBclANGULAR3] = &bcl_angular3,   [MdtBclSPRING6] = &bcl_spring6,
        [MdtBclSPRING] = &bcl_spring,       [MdtBclCONELIMIT] = &bcl_coneLimit,
        [MdtBclUSER] = &bcl_user,           [MdtBclFPFOJOINT] = &bcl_fpfoJoint,
        [MdtBclGEAR] = &bcl_gear,           [MdtBclPULLEY] = &bcl_pulley,
        [MdtBclMIMIC] = &bcl_mimic,         [MdtBclGROUNDWHEEL] = &bcl_groundWheel,
    };
    const int count = (int)(sizeof table / sizeof *table);
    return (int)type >= 0 && (int)type < count ? table[type] : NULL;
}
