/* Registering the primitives, and convex meshes with them, serves triangle lists too: each shape rests on one. */
#include "Mst.h"

static MeVector3 corner[4] = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};

static int MEAPI ground(McdModelPair *p, McdUserTriangle *t, MeVector3 pos, MeReal radius, int max) {
    static const int index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    (void)p, (void)pos, (void)radius, (void)max;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            t[i].vertices[k] = &corner[index[i][k]];
        t[i].normal = 0;
        t[i].flags = kMcdTriangleStandard;
    }
    return 2;
}

int main(void) {
    static const MeVector3 tip[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    McdFrameworkID f = McdInit(McdPrimitivesGetTypeCount(), 20, 20, 1);
    McdPrimitivesRegisterTypes(f);
    McdPrimitivesRegisterInteractions(f);
    McdConvexMeshRegisterType(f);
    McdConvexMeshPrimitivesRegisterInteractions(f);
    MeVector3 low = {-9, -9, -1}, high = {9, 9, 1};
    McdModelID surface = McdModelCreate((McdGeometryID)McdTriangleListCreate(f, low, high, 10, ground));
    McdGeometryID shape[5] = {(McdGeometryID)McdSphereCreate(f, 1), (McdGeometryID)McdBoxCreate(f, 2, 2, 2),
                              (McdGeometryID)McdCylinderCreate(f, 1, 2), (McdGeometryID)McdSphylCreate(f, 0.5, 1),
                              (McdGeometryID)McdConvexMeshCreateHull(f, tip, 6, 0)};
    MeMatrix4 tm[2];
    for (int i = 0; i < 2; i++)
        MeMatrix4TMMakeIdentity(tm[i]);
    MeMatrix4TMSetPosition(tm[1], 1, 2, 0.99);
    McdModelSetTransformPtr(surface, tm[0]);
    McdModelUpdate(surface);
    int touching = 0;
    for (int i = 0; i < 5; i++) {
        McdContact contacts[8];
        McdIntersectResult result;
        result.contacts = contacts;
        result.contactMaxCount = 8;
        McdModelID m = McdModelCreate(shape[i]);
        McdModelSetTransformPtr(m, tm[1]);
        McdModelUpdate(m);
        McdModelPairID p = McdModelPairCreate(m, surface);
        McdHello(p);
        touching += McdIntersect(p, &result) && result.touch;
        McdGoodbye(p);
        McdModelPairDestroy(p);
        McdModelDestroy(m);
    }
    McdFrameworkDestroyAllModelsAndGeometries(f);
    McdTerm(f);
    return touching != 5;
}
