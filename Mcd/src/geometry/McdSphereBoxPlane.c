/* Sphere, box and plane at once: a file of its own, so that a program that uses no more links no more. */
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
