/* The calls of 1.0 and those with a framework, in one program: each does its own. */
#include "Mst.h"

int main(void) {
    McdFrameworkID mine = McdInit(McdPrimitivesGetTypeCount(), 10, 0, 1);
    McdInit(McdPrimitivesGetTypeCount(), 20);
    McdPrimitivesRegisterTypes(mine);
    McdPrimitivesRegisterTypes();
    McdBoxID hers = McdBoxCreate(1, 1, 1), his = McdBoxCreate(mine, 1, 1, 1);
    McdSphereCreate(mine, 1);
    const int separate = McdFrameworkGetGeometryCount(mine) == 2 && hers && his;

    McdSpaceID first = McdSpaceAxisSortCreate(mine, McdAllAxes, 10, 10);
    McdSpaceID second = McdSpaceAxisSortCreate(McdXAxis | McdYAxis, 20, 100, 1);
    McdSpaceID third = McdSpaceAxisSortCreate(mine, McdAllAxes, 10, 10, 1);
    MstBridgeID bridge = MstBridgeCreate(4), another = MstBridgeCreate(mine, 4);
    const int made = first && second && third && bridge && another;
    MstBridgeDestroy(another);
    MstBridgeDestroy(bridge);
    McdSpaceDestroy(third);
    McdSpaceDestroy(second);
    McdSpaceDestroy(first);
    McdFrameworkDestroyAllModelsAndGeometries(mine);
    McdGeometryDestroy((McdGeometryID)hers);
    McdTerm();
    McdTerm(mine);
    return !separate || !made;
}
