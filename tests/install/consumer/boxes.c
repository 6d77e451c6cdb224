/* Written from the User Guide, "Making a Model with a Box Geometry" and what follows it: two boxes and a pyramid fall
 * on a floor and come to rest there. Exit code 0 if they do. */
#include "Mst.h"
#include <math.h>
#include <stdio.h>

/* The height at which a model lies. */
static double heightOf(McdModelID model) {
    MeVector3 position;
    McdModelDynamicsGetPosition(model, position);
    return (double)position[1];
}

int main(void) {
    /* Default universe sizes. */
    MstUniverseSizes sizes = MstUniverseDefaultSizes;

    /* Create the universe and get the framework ID. */
    MstUniverseID universe = MstUniverseCreate(&sizes);
    McdFrameworkID framework = MstUniverseGetFramework(universe);
    MdtWorldSetGravity(MstUniverseGetWorld(universe), 0, -10, 0);

    /* Create geometry for a box with size dimensions 2x1x3. */
    McdGeometryID boxGeom = McdBoxCreate(framework, 2, 1, 3);
    /* Create a model using the box geometry. The density of the box is 1. */
    McdModelID boxModel = MstModelAndBodyCreate(universe, boxGeom, 1);
    /* Create another model using the box geometry. */
    McdModelID boxModel2 = MstModelAndBodyCreate(universe, boxGeom, 1);

    /* These are the five points of the pyramid. */
    MeVector3 pyramidPoints[] = {{0, 2, 0}, {-3, -1, -3}, {3, -1, -3}, {-3, -1, 3}, {3, -1, 3}};
    /* Create a pyramid geometry. */
    McdGeometryID pyramidGeom = McdConvexMeshCreateHull(framework, pyramidPoints, 5, 0);
    /* Create a model using the pyramid geometry. */
    McdModelID pyramidModel = MstModelAndBodyCreate(universe, pyramidGeom, 1);

    /* A floor, y = 0: a plane's own normal is z. */
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    MstFixedModelCreate(universe, McdPlaneCreate(framework), floorTM);

    McdModelDynamicsSetPosition(boxModel, 0, 1, 0);
    McdModelDynamicsSetPosition(boxModel2, 0, 2.5, 0);
    McdModelDynamicsSetPosition(pyramidModel, 10, 2, 0);

    for (int i = 0; i < 300; i++)
        MstUniverseStep(universe, 1.0 / 60);

    printf("boxes at %g and %g, pyramid at %g\n", heightOf(boxModel), heightOf(boxModel2), heightOf(pyramidModel));
    const int isRight = fabs(heightOf(boxModel) - 0.5) < 1e-3 && fabs(heightOf(boxModel2) - 1.5) < 1e-3 &&
                        fabs(heightOf(pyramidModel) - 1) < 1e-3;
    MstUniverseDestroy(universe);
    return isRight ? 0 : 1;
}
