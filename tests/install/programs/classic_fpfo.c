/* A joint of fixed orientation is placed on each of its bodies, by the index of the body. */
#include "Mdt.h"

int main(void) {
    MdtWorldID world = MdtWorldCreate(2, 1);
    MdtBodyID a = MdtBodyCreate(world), b = MdtBodyCreate(world);
    MdtBodySetPosition(b, 2, 0, 0);
    MdtFPFOJointID joint = MdtFPFOJointCreate(world);
    MdtFPFOJointSetBodies(joint, a, b);
    MdtFPFOJointSetPosition(joint, 0, 1, 0, 0);
    MdtFPFOJointSetPosition(joint, 1, 1, 0, 0);
    MeVector3 onA, onB;
    MdtFPFOJointGetPosition(joint, 0, onA);
    MdtFPFOJointGetPosition(joint, 1, onB);
    MdtFPFOJointSetPosition(joint, 2, 0, 0);
    MeVector3 then;
    MdtFPFOJointGetPosition(joint, 0, then);
    MdtWorldDestroy(world);
    return onA[0] != 1 || onB[0] != 1 || then[0] != 2;
}
