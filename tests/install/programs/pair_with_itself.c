/* A pair of a model with itself is disabled and enabled in silence. */
#include "Mst.h"

int main(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MstUniverseID u = MstUniverseCreate(&sizes);
    McdModelID ball = MstModelAndBodyCreate(u, (McdGeometryID)McdSphereCreate(MstUniverseGetFramework(u), 0.5), 1);
    McdSpaceDisablePair(ball, ball);
    MstUniverseStep(u, 1. / 60);
    MstUniverseDestroy(u);
    return 0;
}
