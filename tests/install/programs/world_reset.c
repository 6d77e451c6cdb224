/* A game's level is left and begun anew in the same world. */
#include "Mdt.h"

int main(void) {
    MdtWorldID world = MdtWorldCreate(3, 3);
    for (int level = 0; level < 3; level++) {
        MdtBodyID first = 0;
        for (int i = 0; i < 3; i++) {
            MdtBodyID b = MdtBodyCreate(world);
            MdtBodyEnable(b);
            if (i == 0)
                first = b;
        }
        MdtBSJointID joint = MdtBSJointCreate(world);
        MdtBSJointSetBodies(joint, first, 0);
        MdtBSJointEnable(joint);
        MdtWorldStep(world, 1. / 60);
        MdtWorldReset(world);
        if (MdtWorldGetTotalBodies(world))
            return 1;
    }
    MdtWorldReCreate(world);
    MdtWorldDestroy(world);
    return 0;
}
