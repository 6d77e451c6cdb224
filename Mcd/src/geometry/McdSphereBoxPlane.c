/* Registers sphere, box and plane. In a file of its own, so that programs which use only these link no other types. */
#include "McdPrimitives.h"
#include "McdConvexInteractions.h"
#include "pair/mcd_pair_i.h"

void MEAPI McdSphereBoxPlaneRegisterTypes(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdSphereBoxPlaneRegisterTypes"))
        return;
    McdSphereRegisterType(frame);
    McdBoxRegisterType(frame);
    McdPlaneRegisterType(frame);
}

void MEAPI McdSphereBoxPlaneRegisterInteractions(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdSphereBoxPlaneRegisterInteractions"))
        return;
    McdSphereSphereRegisterInteraction(frame);
    McdBoxSphereRegisterInteraction(frame);
    McdBoxBoxRegisterInteraction(frame);
    McdSpherePlaneRegisterInteraction(frame);
    McdBoxPlaneRegisterInteraction(frame);
    McdSphereLineSegmentRegisterInteraction(frame);
    McdBoxLineSegmentRegisterInteraction(frame);
    McdPlaneLineSegmentRegisterInteraction(frame);
}
