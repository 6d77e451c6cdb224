/* Registers all geometry types and interactions. */
#include "McdAll.h"
#include "Mcd.h"
#include "pair/mcd_pair_i.h"

void MEAPI McdAllRegisterTypes(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdAllRegisterTypes"))
        return;
    McdNullRegisterType(frame);
    McdPrimitivesRegisterTypes(frame);
    McdConeRegisterType(frame);
    McdConvexMeshRegisterType(frame);
    McdTriangleListRegisterType(frame);
    McdRGHeightFieldRegisterType(frame);
    McdMeshRegisterType(frame);
    McdAggregateRegisterType(frame);
}

static void registerTerrain(McdFramework *frame) {
    McdSphereTriangleListRegisterInteraction(frame);
    McdBoxTriangleListRegisterInteraction(frame);
    McdCylinderTriangleListRegisterInteraction(frame);
    McdSphylTriangleListRegisterInteraction(frame);
    McdConvexMeshTriangleListRegisterInteraction(frame);
    McdConeTriangleListRegisterInteraction(frame);
    McdSphereRGHeightFieldRegisterInteraction(frame);
    McdBoxRGHeightFieldRegisterInteraction(frame);
    McdCylinderRGHeightFieldRegisterInteraction(frame);
    McdSphylRGHeightFieldRegisterInteraction(frame);
    McdConvexMeshRGHeightFieldRegisterInteraction(frame);
    McdConeRGHeightFieldRegisterInteraction(frame);
    McdRGHeightFieldLineSegmentRegisterInteraction(frame);
    McdMeshRegisterInteractions(frame);
    McdMeshLineSegmentRegisterInteraction(frame);
}

MeBool MEAPI McdAllRegisterInteractions(McdFramework *frame) {
    if (!mcd_frameCheck(frame, "McdAllRegisterInteractions"))
        return MEFALSE;
    McdPrimitivesRegisterInteractions(frame);
    McdConePrimitivesRegisterInteractions(frame);
    McdConvexMeshPrimitivesRegisterInteractions(frame);
    McdConeConvexMeshRegisterInteraction(frame);
    McdConeLineSegmentRegisterInteraction(frame);
    McdConvexMeshLineSegmentRegisterInteraction(frame);
    registerTerrain(frame);
    McdAggregateRegisterInteractions(frame); /* last: with all types registered before */
    return METRUE;
}
