/* What programs read of contacts, pairs, requests, triangle lists and contact parameters. */
#include "Mst.h"

static MeVector3 corner[6] = {{-9, -9, 0}, {0, -9, 0}, {0, 9, 0}, {0, -9, 0}, {9, -9, 0}, {9, 9, 0}};
static MeVector3 up = {0, 0, 1};
static const char *const names[2] = {"left", "right"};

static int MEAPI triangles(McdModelPair *pair, McdUserTriangle *out, MeVector3 pos, MeReal radius, int max) {
    (void)pos, (void)radius;
    McdTriangleList *list = (McdTriangleList *)McdModelGetGeometry(pair->model2);
    if (list->userData != (void *)names || list->list != out || max < 2)
        return 0;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            out[i].vertices[k] = &corner[3 * i + k];
        out[i].normal = &up;
        out[i].flags = kMcdTriangleStandard;
        out[i].triangleData.ptr = (void *)names[i];
    }
    return 2;
}

static int wrong;

static void MEAPI look(McdModel *model, McdIntersectResult *result) {
    (void)model;
    for (int i = 0; i < result->contactCount; i++) {
        McdContact *c = &result->contacts[i];
        const int onFirst =
            McdGeometryGetType(McdModelGetGeometry(result->pair->model1)) == kMcdGeometryTypeTriangleList;
        McdElementData here = onFirst ? c->element1 : c->element2;
        wrong |= here.ptr != (void *)names[c->position[0] > 0] || c->dims != 0;
        wrong |= (onFirst ? c->element2 : c->element1).ptr != 0 || result->pair->m_cachedData != 0;
    }
    wrong |= result->contactCount == 0;
}

int main(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    MstUniverseID u = MstUniverseCreate(&sizes);
    McdFrameworkID f = MstUniverseGetFramework(u);
    MeVector3 low = {-9, -9, -1}, high = {9, 9, 1};
    McdTriangleListID list = McdTriangleListCreate(f, low, high, 10, triangles);
    ((McdTriangleList *)list)->userData = (void *)names;
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    MstFixedModelCreate(u, (McdGeometryID)list, tm);
    MstModelAndBodyCreate(u, (McdGeometryID)McdSphereCreate(f, 1), 1);

    /* where both triangles are all there is, well inside of one of them */
    for (int side = -1; side <= 1; side += 2) {
        McdModelID ball = MstModelAndBodyCreate(u, (McdGeometryID)McdSphereCreate(f, 1), 1);
        McdModelDynamicsSetPosition(ball, side * 3, -8, 0.99);
        McdModelSetIntersectCallback(ball, look);
    }
    MstUniverseStep(u, 1. / 60);

    McdRequest request = *McdFrameworkGetDefaultRequestPtr(f);
    request.faceNormalsFirst = 1;
    MdtBclContactParams p;
    MdtContactParamsReset(&p);
    MdtContactParamsSetPrimaryFrictionCoeffecient(&p, 0.25);
    p.frictioncoeff2 = (MeReal)0.5;
    wrong |= p.frictioncoeff1 != (MeReal)0.25 || MdtContactParamsGetSecondaryFrictionCoeffecient(&p) != (MeReal)0.5;
    wrong |= sizeof(MeVector3) != 3 * sizeof(MeReal) || request.contactMaxCount < 1;
    MstUniverseDestroy(u);
    return wrong;
}
