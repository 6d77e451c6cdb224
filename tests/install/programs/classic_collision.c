/* Collision without a framework, as in Karma 1.0: every call that there was. */
#include "Mcd.h"

int main(void) {
    McdInit(McdPrimitivesGetTypeCount(), 20);
    McdPrimitivesRegisterTypes();
    McdAggregateRegisterType();
    McdPrimitivesRegisterInteractions();

    McdGeometryID g[] = {(McdGeometryID)McdPlaneCreate(),      (McdGeometryID)McdSphereCreate(1),
                         (McdGeometryID)McdBoxCreate(1, 2, 3), (McdGeometryID)McdCylinderCreate(1, 2),
                         (McdGeometryID)McdSphylCreate(1, 2),  (McdGeometryID)McdConeCreate(2, 1),
                         (McdGeometryID)McdAggregateCreate(2)};
    for (int i = 0; i < 7; i++)
        if (!g[i])
            return 1;
    MeReal x, y, z;
    McdBoxGetDimensions((McdBoxID)g[2], &x, &y, &z);
    if (x != 1 || y != 2 || z != 3 || McdConeGetLength((McdConeID)g[5]) != 2 ||
        McdConeGetLowerRadius((McdConeID)g[5]) != 1)
        return 2;
    if (McdGetDefaultRequestPtr()->contactMaxCount < 1)
        return 3;

    McdSpaceID space = McdSpaceAxisSortCreate(McdAllAxes, 20, 100, 1);
    MeMatrix4 floorTM, ballTM;
    MeMatrix4TMMakeIdentity(floorTM);
    MeMatrix4TMMakeIdentity(ballTM);
    MeMatrix4TMSetPosition(ballTM, 0, 0, 0.5);
    McdModelID floor_ = McdModelCreate(g[0]), ball = McdModelCreate(g[1]);
    McdModelSetTransformPtr(floor_, floorTM);
    McdModelSetTransformPtr(ball, ballTM);
    McdSpaceInsertModel(space, floor_);
    McdSpaceInsertModel(space, ball);
    McdSpaceUpdateAll(space);
    McdSpaceEndChanges(space);
    McdModelPairContainer *pairs = McdModelPairContainerCreate(4);
    McdSpacePairIterator iterator;
    McdSpacePairIteratorBegin(space, &iterator);
    McdSpaceGetPairs(space, &iterator, pairs);
    const int near = pairs->helloEnd - pairs->helloFirst;
    McdModelPairContainerDestroy(pairs);
    McdSpaceBeginChanges(space);
    McdSpaceRemoveModel(ball);
    McdSpaceRemoveModel(floor_);
    McdSpaceDestroy(space);
    McdModelDestroy(ball);
    McdModelDestroy(floor_);
    for (int i = 0; i < 7; i++)
        McdGeometryDestroy(g[i]);
    McdTerm();
    return near != 1;
}
