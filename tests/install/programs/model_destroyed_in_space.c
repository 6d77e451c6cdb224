/* A model that is destroyed while it is in its space is taken out of it: what lay on it falls. */
#include "Mst.h"

int main(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MstUniverseID u = MstUniverseCreate(&sizes);
    McdFrameworkID f = MstUniverseGetFramework(u);
    MeMatrix4 floorTM;
    MeMatrix4TMMakeIdentity(floorTM);
    MdtWorldSetGravity(MstUniverseGetWorld(u), 0, 0, -9.8);
    McdModelID floor_ = MstFixedModelCreate(u, (McdGeometryID)McdPlaneCreate(f), floorTM);
    McdModelID ball = MstModelAndBodyCreate(u, (McdGeometryID)McdSphereCreate(f, 0.5), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, 2);
    for (int i = 0; i < 10; i++)
        MstUniverseStep(u, 1. / 60);
    McdModelDestroy(floor_);
    for (int i = 0; i < 110; i++)
        MstUniverseStep(u, 1. / 60);
    MeVector3 p;
    McdModelDynamicsGetPosition(ball, p);
    MstUniverseDestroy(u);
    return !(p[2] < -10);
}
