/* Registers sphere, box, plane, cylinder, sphyl and triangle list. */
#include "McdPrimitives.h"
#include "McdConvexInteractions.h"
#include "McdTriangleList.h"
#include "pair/mcd_pair_i.h"

unsigned int MEAPI McdPrimitivesGetTypeCount(void) {
    return 6;
}

void MEAPI McdPrimitivesRegisterTypes(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdPrimitivesRegisterTypes"))
        return;
    McdSphereRegisterType(frame);
    McdBoxRegisterType(frame);
    McdPlaneRegisterType(frame);
    McdCylinderRegisterType(frame);
    McdSphylRegisterType(frame);
    McdTriangleListRegisterType(frame);
}

MeBool MEAPI McdPrimitivesRegisterInteractions(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdPrimitivesRegisterInteractions"))
        return MEFALSE;
    McdSphereSphereRegisterInteraction(frame);
    McdBoxSphereRegisterInteraction(frame);
    McdBoxBoxRegisterInteraction(frame);
    McdBoxCylinderRegisterInteraction(frame);
    McdCylinderSphereRegisterInteraction(frame);
    McdCylinderCylinderRegisterInteraction(frame);
    McdSphylSphereRegisterInteraction(frame);
    McdSphylBoxRegisterInteraction(frame);
    McdSphylCylinderRegisterInteraction(frame);
    McdSphylSphylRegisterInteraction(frame);
    McdSpherePlaneRegisterInteraction(frame);
    McdBoxPlaneRegisterInteraction(frame);
    McdCylinderPlaneRegisterInteraction(frame);
    McdSphylPlaneRegisterInteraction(frame);
    McdSphereTriangleListRegisterInteraction(frame);
    McdBoxTriangleListRegisterInteraction(frame);
    McdCylinderTriangleListRegisterInteraction(frame);
    McdSphylTriangleListRegisterInteraction(frame);
    McdSphereLineSegmentRegisterInteraction(frame);
    McdBoxLineSegmentRegisterInteraction(frame);
    McdPlaneLineSegmentRegisterInteraction(frame);
    McdCylinderLineSegmentRegisterInteraction(frame);
    McdSphylLineSegmentRegisterInteraction(frame);
    return METRUE;
}
