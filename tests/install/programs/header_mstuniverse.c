/* MstUniverse.h alone brings dynamics, collision and what joins them. */
#include "MstUniverse.h"

int main(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MstUniverseID universe = MstUniverseCreate(&sizes);
    McdFrameworkID frame = MstUniverseGetFramework(universe);
    McdModelID model = MstModelAndBodyCreate(universe, (McdGeometryID)McdSphereCreate(frame, 1), 1);
    MdtBodyID body = McdModelGetBody(model);
    MstBridgeID bridge = MstUniverseGetBridge(universe);
    const int ok = MdtBodyGetMass(body) > 0 && MstBridgeGetContactParams(bridge, 0, 0) != 0;
    MeMemoryAPI.destroy(MeMemoryAPI.create(8));
    MstUniverseDestroy(universe);
    return !ok;
}
