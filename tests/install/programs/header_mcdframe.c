/* McdFrame.h alone brings memory, all primitives, spaces and interactions. */
#include "McdFrame.h"

int main(void) {
    McdFrameworkID frame = McdInit(McdPrimitivesGetTypeCount(), 10, 0, 1);
    McdPrimitivesRegisterTypes(frame);
    McdPrimitivesRegisterInteractions(frame);
    McdSpaceID space = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    McdModelID model = McdModelCreate((McdGeometryID)McdBoxCreate(frame, 1, 1, 1));
    McdSpaceInsertModel(space, model);
    MeMemoryAPI.destroy(MeMemoryAPI.create(8));
    McdSpaceDestroy(space);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
    return 0;
}
