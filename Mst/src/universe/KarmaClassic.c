/* The process' framework, for programs written for Karma 1.0 and 1.1, which had no frameworks. */
#include "KarmaClassic.h"

static McdFrameworkID classicFrame;

McdFrameworkID MEAPI MstClassicInit(int geoTypeMaxCount, int modelCount) {
    if (classicFrame)
        MeWarning(1,
                  "McdInit: it was called before, and McdTerm() was not: there is one framework for all calls without "
                  "one");
    else
        classicFrame = (McdInit)(geoTypeMaxCount, modelCount, modelCount, 1);
    return classicFrame;
}

void MEAPI MstClassicPrimitivesRegisterTypes(McdFrameworkID frame) {
    (McdPrimitivesRegisterTypes)(frame);
    if (frame && frame == classicFrame)
        (McdConeRegisterType)(frame);
}

MeBool MEAPI MstClassicPrimitivesRegisterInteractions(McdFrameworkID frame) {
    const MeBool answer = (McdPrimitivesRegisterInteractions)(frame);
    if (frame && frame == classicFrame)
        (McdConePrimitivesRegisterInteractions)(frame);
    return answer;
}

void MEAPI MstClassicTerm(McdFrameworkID frame) {
    if (frame && frame == classicFrame)
        classicFrame = 0;
    (McdTerm)(frame);
}

McdFrameworkID MEAPI MstClassicFramework(void) {
    return classicFrame;
}

McdSpaceID MEAPI MstClassicSpaceAxisSortCreate(int axes, int objectCount, int pairCount, int last) {
    (void)last;
    return (McdSpaceAxisSortCreate)(classicFrame, axes, objectCount, pairCount);
}
