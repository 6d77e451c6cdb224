/* A stool of four legs, whose places are in one local array that is used again and again: it stands. */
#include "Mst.h"

int main(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MstUniverseID u = MstUniverseCreate(&sizes);
    McdFrameworkID f = MstUniverseGetFramework(u);
    MdtWorldSetGravity(MstUniverseGetWorld(u), 0, 0, -9.8);
    McdAggregateID stool = McdAggregateCreate(f, 4);
    McdGeometryID leg = (McdGeometryID)McdBoxCreate(f, 0.1, 0.1, 1);
    int same = 0;
    {
        MeMatrix4 place;
        for (int i = 0; i < 4; i++) {
            MeMatrix4TMMakeIdentity(place);
            MeMatrix4TMSetPosition(place, i & 1 ? (MeReal)0.5 : (MeReal)-0.5, i & 2 ? (MeReal)0.5 : (MeReal)-0.5, 0);
            McdAggregateAddElement(stool, leg, place);
        }
        memset(place, 0x7f, sizeof place);
        same = McdAggregateGetElementTransformPtr(stool, 0) == (MeMatrix4Ptr)place;
    }
    MeMatrix4 floorTM;
    MeMatrix4TMMakeIdentity(floorTM);
    MstFixedModelCreate(u, (McdGeometryID)McdPlaneCreate(f), floorTM);
    McdModelID m = MstModelAndBodyCreate(u, (McdGeometryID)stool, 1);
    McdModelDynamicsSetPosition(m, 0, 0, 1);
    for (int i = 0; i < 120; i++)
        MstUniverseStep(u, 1. / 60);
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    const MeReal first = McdAggregateGetElementTransformPtr(stool, 0)[3][0];
    MstUniverseDestroy(u);
    return same || first != (MeReal)-0.5 || !(p[2] > 0.49 && p[2] < 0.51);
}
