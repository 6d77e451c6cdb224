/* may print: a geometry, a model and a body that are destroyed after their framework and world are no harm. */
#include "Mst.h"

int main(void) {
    McdFrameworkID f = McdInit(McdPrimitivesGetTypeCount(), 20, 20, 1);
    McdPrimitivesRegisterTypes(f);
    McdPrimitivesRegisterInteractions(f);
    McdGeometryID box = (McdGeometryID)McdBoxCreate(f, 1, 1, 1);
    McdModelID model = McdModelCreate(box);
    MdtWorldID world = MdtWorldCreate(2, 2);
    MdtBodyID body = MdtBodyCreate(world);
    McdTerm(f);
    McdModelDestroy(model);
    McdBoxDestroy(box);
    MdtWorldDestroy(world);
    MdtBodyDestroy(body);
    return 0;
}
