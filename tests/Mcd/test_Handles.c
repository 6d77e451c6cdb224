/* Objects that have gone, that belong to another framework, or that go in an order that nobody planned. */
#include "shapes.h"

static McdFrameworkID frame;

static void setUp(void) {
    frame = McdInit(0, 20, 20, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
}

static void tearDown(void) {
    McdTerm(frame);
    assert_silent();
}

/* ---- in any order ------------------------------------------------------------------------------------------------ */

static McdGeometryID oneOf(int kind) {
    static const MeReal flat[4] = {0, 0, 0, 0};
    MeVector3 low = {-1, -1, -1}, high = {1, 1, 1};
    switch (kind) {
    case SOLIDS:
        return McdPlaneCreate(frame);
    case SOLIDS + 1:
        return McdNullCreate(frame);
    case SOLIDS + 2:
        return McdTriangleListCreate(frame, low, high, 4, 0);
    case SOLIDS + 3:
        return McdRGHeightFieldCreate(frame, flat, 2, 2, 1, 1, 0, 0);
    case SOLIDS + 4:
        return McdAggregateCreate(frame, 2);
    default:
        return solid(frame, kind, 1);
    }
}

enum { ALL = SOLIDS + 5 };
static void(MEAPI *const destroyOf[ALL])(McdGeometryID) = {
    McdSphereDestroy, McdBoxDestroy,          McdCylinderDestroy,      McdSphylDestroy,      McdConeDestroy,
    McdConeDestroy,   McdConeDestroy,         McdConvexMeshDestroy,    McdConvexMeshDestroy, McdPlaneDestroy,
    McdNullDestroy,   McdTriangleListDestroy, McdRGHeightFieldDestroy, McdAggregateDestroy};

/* Destroyed twice, it would be freed twice. */
TEST(geometries_may_go_after_their_framework) {
    McdGeometryID g[ALL];
    setUp();
    for (int kind = 0; kind < ALL; kind++)
        g[kind] = oneOf(kind);
    const McdModelID m = McdModelCreate(g[0]);
    caught.warnings = 0;
    McdTerm(frame);
    assert_warned("1 models and 14 geometries were left");
    for (int kind = 0; kind < ALL; kind++) {
        destroyOf[kind](g[kind]);
        McdGeometryDestroy(g[kind]);
        ck_assert(!McdGeometryIsValid(g[kind]));
    }
    McdModelDestroy(m);
    McdTerm(frame);
}

/* A type's own Destroy is McdGeometryDestroy: the framework knows of it. */
TEST(a_types_destroy_takes_a_geometry_out_of_its_framework) {
    setUp();
    for (int kind = 0; kind < ALL; kind++) {
        const McdGeometryID g = oneOf(kind);
        ck_assert_int_eq(McdFrameworkGetGeometryCount(frame), 1);
        destroyOf[kind](g);
        ck_assert_int_eq(McdFrameworkGetGeometryCount(frame), 0);
    }
    const McdGeometryID ball = oneOf(BALL);
    const McdModelID m = McdModelCreate(ball);
    assert_silent();
    McdBoxDestroy(ball);
    assert_warned("McdBoxDestroy: the geometry is a Sphere");
    McdSphereDestroy(ball);
    assert_warned("still use");
    McdModelDestroy(m);
    McdSphereDestroy(ball);
    tearDown();
}

static MeMatrix4 identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

TEST(a_model_is_taken_out_of_its_space_when_it_is_destroyed) {
    McdModelPairContainer *pairs = McdModelPairContainerCreate(10);
    setUp();
    const McdSpaceID s = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    const McdGeometryID ball = oneOf(BALL);
    McdModelID m[3];
    for (int i = 0; i < 3; i++) {
        m[i] = McdModelCreate(ball);
        McdModelSetTransformPtr(m[i], identity);
        McdSpaceInsertModel(s, m[i]);
    }
    McdSpaceUpdateAll(s);
    ck_assert_int_eq(McdSpaceGetPairs(s, pairs), 0);
    ck_assert_int_eq(McdModelPairContainerGetHelloCount(pairs), 3);
    McdHelloEach(pairs);
    McdModelDestroy(m[1]);
    ck_assert(!McdModelIsValid(m[1]));
    ck_assert_int_eq(McdSpaceGetModelCount(s), 2);
    for (int i = 0; i < 3; i++)
        if (pairs->array[pairs->helloFirst + i]->model1 == m[1] || pairs->array[pairs->helloFirst + i]->model2 == m[1])
            ck_assert_int_eq(pairs->array[pairs->helloFirst + i]->phase, kMcdFFStateInactive);
    McdSpaceUpdateAll(s);
    McdSpaceGetPairs(s, pairs);
    ck_assert_int_eq(McdModelPairContainerGetGoodbyeCount(pairs), 0);
    ck_assert_int_eq(McdModelPairContainerGetStayingCount(pairs), 1);
    McdModelDestroy(m[0]);
    McdModelDestroy(m[2]);
    McdSpaceDestroy(s);
    McdGeometryDestroy(ball);
    tearDown();
    McdModelPairContainerDestroy(pairs);
}

TEST(a_pair_of_a_model_with_itself_is_disabled_in_silence) {
    setUp();
    const McdSpaceID s = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    const McdGeometryID ball = oneOf(BALL);
    const McdModelID m = McdModelCreate(ball);
    McdSpaceInsertModel(s, m);
    ck_assert(McdSpaceDisablePair(m, m));
    McdModelDestroy(m);
    McdSpaceDestroy(s);
    McdGeometryDestroy(ball);
    tearDown();
}

/* ---- of another framework ---------------------------------------------------------------------------------------- */

TEST(geometries_and_models_of_another_framework_are_refused) {
    setUp();
    const McdFrameworkID other = McdInit(0, 5, 5, 1);
    McdAllRegisterTypes(other);
    const McdGeometryID mine = oneOf(BALL), strange = McdSphereCreate(other, 1);
    const McdGeometryID whole = McdAggregateCreate(frame, 2);
    const McdModelID m = McdModelCreate(mine), strangeModel = McdModelCreate(strange);
    const McdSpaceID s = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    McdModelSetGeometry(m, strange);
    assert_warned("McdModelSetGeometry: the Sphere belongs to another framework");
    McdGeometryInstanceSetGeometry(McdModelGetGeometryInstance(m), strange);
    assert_warned("McdGeometryInstanceSetGeometry: the Sphere belongs to another framework");
    ck_assert_ptr_eq(McdModelGetGeometry(m), mine);
    ck_assert_int_eq(McdGeometryGetReferenceCount(strange), 1);
    ck_assert_int_eq(McdAggregateAddElement(whole, strange, 0), -1);
    assert_warned("McdAggregateAddElement: the Sphere belongs to another framework");
    ck_assert(!McdSpaceInsertModel(s, strangeModel));
    assert_warned("another framework");
    McdModelDestroy(strangeModel);
    McdGeometryDestroy(strange);
    McdTerm(other);
    ck_assert_int_eq(McdModelGetGeometryType(m), kMcdGeometryTypeSphere);
    McdModelDestroy(m);
    McdSpaceDestroy(s);
    McdGeometryDestroy(whole);
    McdGeometryDestroy(mine);
    tearDown();
}

/* ---- relative transforms ----------------------------------------------------------------------------------------- */

static int blocks;

static void *MEAPI countedCreate(size_t bytes) {
    blocks++;
    return malloc(bytes);
}

static void MEAPI countedDestroy(void *const block) {
    ck_assert(block != NULL);
    blocks--;
    free(block);
}

/* It left the product behind, and its end destroyed a null. */
TEST(resetting_the_instance_of_a_model_with_its_own_relative_transform) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    MeMatrix4 relative;
    memcpy(relative, identity, sizeof relative);
    setUp();
    const McdGeometryID ball = oneOf(BALL);
    const McdModelID m = McdModelCreate(ball);
    MeMemoryAPI.create = countedCreate;
    MeMemoryAPI.destroy = countedDestroy;
    for (int bySetting = 0; bySetting < 2; bySetting++) {
        McdModelSetTransformPtr(m, identity);
        McdModelSetRelativeTransform(m, relative);
        ck_assert_int_eq(blocks, 2);
        if (bySetting)
            McdGeometryInstanceSetTransformPtr(McdModelGetGeometryInstance(m), identity);
        else
            McdGeometryInstanceReset(McdModelGetGeometryInstance(m));
        ck_assert_int_eq(blocks, 0);
        ck_assert_ptr_null(McdModelGetRelativeTransform(m));
    }
    McdModelSetRelativeTransform(m, relative);
    McdModelDestroy(m);
    ck_assert_int_eq(blocks, 0);
    MeMemoryAPI = before;
    McdGeometryDestroy(ball);
    tearDown();
}

/* ---- what has gone ----------------------------------------------------------------------------------------------- */

#if KARMA_CHECK
/* Each call gives one warning that names it, and a neutral result. */
#define GONE(call, name)                                                                                               \
    do {                                                                                                               \
        call;                                                                                                          \
        ck_assert_int_eq(caught.warnings, 1);                                                                          \
        assert_warned(name ": 0x");                                                                                    \
    } while (0)

TEST(what_has_been_destroyed_gets_a_warning_and_is_not_read) {
    MeVector3 v;
    McdModelID list[2];
    setUp();
    const McdGeometryID ball = oneOf(BALL), whole = McdAggregateCreate(frame, 1);
    McdAggregateAddElement(whole, ball, 0);
    const McdModelID m = McdModelCreate(whole);
    const McdGeometryInstanceID own = McdModelGetGeometryInstance(m), child = McdGeometryInstanceGetChild(own, 0);
    const McdSpaceID s = McdSpaceAxisSortCreate(frame, McdAllAxes, 10, 10);
    ck_assert_ptr_nonnull(child);
    McdSpaceDestroy(s);
    GONE(ck_assert_int_eq(McdSpaceGetModelCount(s), 0), "McdSpaceGetModelCount");
    GONE(McdSpaceUpdateAll(s), "McdSpaceUpdateAll");
    GONE(ck_assert_int_eq(McdSpaceOverlapModel(s, m, 0, 0, list, 2), 0), "McdSpaceOverlapModel");
    GONE(McdSpaceDestroy(s), "McdSpaceDestroy");
    McdModelDestroy(m);
    GONE(ck_assert_ptr_null(McdModelGetGeometry(m)), "McdModelGetGeometry");
    GONE(McdModelUpdate(m), "McdModelUpdate");
    GONE(McdModelDestroy(m), "McdModelDestroy");
    GONE(ck_assert_ptr_null(McdGeometryInstanceGetGeometry(own)), "McdGeometryInstanceGetGeometry");
    GONE(McdGeometryInstanceGetAABB(child, v, v), "McdGeometryInstanceGetAABB");
    McdGeometryDestroy(whole);
    GONE(ck_assert_int_eq(McdAggregateGetElementCount(whole), 0), "McdAggregateGetElementCount");
    McdGeometryDestroy(ball);
    GONE(ck_assert(McdSphereGetRadius(ball) == 0), "McdSphereGetRadius");
    GONE(ck_assert_ptr_null(McdModelCreate(ball)), "McdModelCreate");
    GONE(McdGeometryDestroy(ball), "McdGeometryDestroy");
    McdTerm(frame);
    GONE(ck_assert_int_eq(McdFrameworkGetModelCount(frame), 0), "McdFrameworkGetModelCount");
    GONE(ck_assert_ptr_null(McdSphereCreate(frame, 1)), "McdSphereCreate");
    GONE(ck_assert_ptr_null(McdModelGetGeometry(m)), "McdModelGetGeometry");
    GONE(ck_assert_ptr_null(McdGeometryInstanceGetModel(child)), "McdGeometryInstanceGetModel");
}
#endif

/* ---- what registering brings ------------------------------------------------------------------------------------- */

TEST(primitives_and_meshes_register_the_triangle_list) {
    static const int solids[] = {kMcdGeometryTypeSphere, kMcdGeometryTypeBox, kMcdGeometryTypeCylinder,
                                 kMcdGeometryTypeSphyl, kMcdGeometryTypeConvexMesh};
    frame = McdInit((int)McdPrimitivesGetTypeCount(), 20, 20, 1);
    McdPrimitivesRegisterTypes(frame);
    McdPrimitivesRegisterInteractions(frame);
    for (int i = 0; i < 4; i++)
        ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, solids[i], kMcdGeometryTypeTriangleList));
    McdConvexMeshPrimitivesRegisterInteractions(frame);
    ck_assert_ptr_nonnull(McdFrameworkGetInteractions(frame, solids[4], kMcdGeometryTypeTriangleList));
    const McdGeometryID list = oneOf(SOLIDS + 2);
    ck_assert_ptr_nonnull(list);
    McdGeometryDestroy(list);
    tearDown();
}

/* The guide's stool: four legs of one matrix. */
TEST(an_aggregate_copies_the_transforms_of_its_parts) {
    MeMatrix4 place;
    MeVector3 low, high;
    setUp();
    const McdGeometryID leg = McdBoxCreate(frame, .1, .1, 1), stool = McdAggregateCreate(frame, 4);
    for (int i = 0; i < 4; i++) {
        memcpy(place, identity, sizeof place);
        place[3][0] = i & 1 ? (MeReal).5 : (MeReal)-.5;
        place[3][1] = i & 2 ? (MeReal).5 : (MeReal)-.5;
        McdAggregateAddElement(stool, leg, place);
    }
    memset(place, 0x7f, sizeof place);
    McdGeometryGetAABB(stool, (const MeVector4 *)identity, low, high);
    assert_vec3_near(low, -.55, -.55, -.5, 1e-6);
    assert_vec3_near(high, .55, .55, .5, 1e-6);
    McdAggregateGetElementTransformPtr(stool, 3)[3][2] = 1;
    McdGeometryGetAABB(stool, (const MeVector4 *)identity, low, high);
    assert_near(high[2], 1.5, 1e-6);
    McdGeometryDestroy(stool);
    McdGeometryDestroy(leg);
    tearDown();
}
