/* A ball falls on a plane: world, space and bridge put together by hand, without a framework. */
#include "Mst.h"

int main(void) {
    McdInit(McdPrimitivesGetTypeCount(), 10);
    McdPrimitivesRegisterTypes();
    McdPrimitivesRegisterInteractions();
    MdtWorldID world = MdtWorldCreate(10, 50);
    McdSpaceID space = McdSpaceAxisSortCreate(McdAllAxes, 10, 20, 1);
    MstBridgeID bridge = MstBridgeCreate(3);
    MstSetWorldHandlers(world);
    MdtWorldSetGravity(world, 0, 0, -9.81);

    MeMatrix4 floorTM;
    MeMatrix4TMMakeIdentity(floorTM);
    McdModelID floor_ = McdModelCreate((McdGeometryID)McdPlaneCreate());
    McdModelSetTransformPtr(floor_, floorTM);
    McdSpaceInsertModel(space, floor_);
    McdSpaceUpdateModel(floor_);
    McdSpaceFreezeModel(floor_);

    MdtBodyID body = MdtBodyCreate(world);
    McdModelID ball = McdModelCreate((McdGeometryID)McdSphereCreate(0.5));
    McdModelSetBody(ball, body);
    MdtBodySetPosition(body, 0, 0, 1);
    MdtBodyEnable(body);
    McdSpaceInsertModel(space, ball);

    for (int i = 0; i < 180; i++) {
        McdSpaceUpdateAll(space);
        MstBridgeUpdateContacts(bridge, space, world);
        MdtWorldStep(world, 1. / 60);
    }
    MeVector3 p;
    MdtBodyGetPosition(body, p);
    const int rests = p[2] > 0.49 && p[2] < 0.51;
    MstBridgeDestroy(bridge);
    McdSpaceRemoveModel(ball);
    McdSpaceRemoveModel(floor_);
    McdSpaceDestroy(space);
    McdModelSetBody(ball, 0);
    McdGeometryID shapes[2] = {McdModelGetGeometry(ball), McdModelGetGeometry(floor_)};
    McdModelDestroy(ball);
    McdModelDestroy(floor_);
    McdGeometryDestroy(shapes[0]);
    McdGeometryDestroy(shapes[1]);
    McdTerm();
    MdtWorldDestroy(world);
    return !rests;
}
