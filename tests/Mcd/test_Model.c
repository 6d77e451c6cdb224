/* Models: places, relative places, paths, what is kept and what is reset. */
#include "frame.h"
#include "blob.h"

static McdFrameworkID frame;
static McdGeometryID blob;
static McdModelID model;
static MeMatrix4 place;

static void setUp(void) {
    frame = frame_make(1, 4, 0, 1);
    blobRegister(frame, BLOB);
    blob = blobCreate(frame, BLOB, 1, 0);
    model = McdModelCreate(blob);
    MeMatrix4TMMakeIdentity(place);
}

TEST_FIXTURE(setUp, NULL)

static void assertBox(double x0, double x1, double y0, double y1) {
    MeVector3 low, high;
    McdModelGetAABB(model, low, high);
    assert_near(low[0], x0, TOL(1e-5, 2e-14));
    assert_near(high[0], x1, TOL(1e-5, 2e-14));
    assert_near(low[1], y0, TOL(1e-6, 2e-15));
    assert_near(high[1], y1, TOL(2e-6, 3e-15));
}

TEST(a_new_model_has_nothing_but_its_geometry) {
    ck_assert_ptr_eq(McdModelGetGeometry(model), blob);
    ck_assert_int_eq(McdModelGetGeometryType(model), BLOB);
    ck_assert_ptr_null(McdModelGetTransformPtr(model));
    ck_assert_ptr_null(McdModelGetSpace(model));
    ck_assert_ptr_null(McdModelGetBodyData(model));
    ck_assert_ptr_null(McdModelGetUserData(model));
    ck_assert_ptr_null(McdModelGetLinearVelocityPtr(model));
    ck_assert_ptr_null(McdModelGetRelativeTransform(model));
    ck_assert_uint_eq(McdModelGetMaterial(model), 0);
    ck_assert_int_eq(McdModelGetSortKey(model), 0);
    ck_assert(!McdModelIsSwept(model));
}

TEST(the_box_follows_the_transform_at_updates) {
    MeMatrix4TMSetPosition(place, 3, 0, 0);
    McdModelSetTransformPtr(model, place);
    McdModelUpdate(model);
    assertBox(2, 4, -1, 1);
    MeMatrix4TMSetPosition(place, 5, 0, 0);
    assertBox(2, 4, -1, 1);
    McdModelUpdate(model);
    assertBox(4, 6, -1, 1);
}

TEST(a_model_without_a_transform_cannot_be_updated) {
    McdModelUpdate(model);
    assert_warned("no transform");
}

static void MEAPI moveOn(McdModel *m) {
    McdModelGetTransformPtr(m)[3][0] += 1;
}

TEST(the_update_callback_comes_first) {
    McdModelSetTransformPtr(model, place);
    McdModelSetUpdateCallback(model, moveOn);
    McdModelUpdate(model);
    assertBox(0, 2, -1, 1);
    ck_assert(McdModelGetUpdateCallback(model) == moveOn);
}

/* relTM: 2 along x; refTM: a quarter turn about z, at (10, 0, 0). So the model is at (10, 2, 0). */
TEST(relative_transforms_are_multiplied) {
    MeMatrix4 relative, reference, product;
    MeMatrix4Ptr got[2];
    MeMatrix3 R;
    MeMatrix3MakeRotationZ(R, ME_PI / 2);
    MeMatrix4TMMakeIdentity(relative);
    MeMatrix4TMSetPosition(relative, 2, 0, 0);
    MeMatrix4TMMakeFromRotationAndPosition(reference, R, 10, 0, 0);
    McdModelSetRelativeTransformPtrs(model, relative, reference, product, MEFALSE);
    McdModelUpdate(model);
    assert_vec3_near(McdModelGetTransformPtr(model)[3], 10, 2, 0, TOL(5e-6, 9e-15));
    ck_assert_ptr_eq(McdModelGetTransformPtr(model), product);
    McdModelGetRelativeTransformPtrs(model, &got[0], &got[1]);
    ck_assert(got[0] == relative && got[1] == reference);
    MeMatrix4TMSetPosition(reference, 20, 0, 0);
    McdModelUpdate(model);
    assertBox(19, 21, 1, 3);
}

TEST(a_relative_transform_is_copied) {
    MeMatrix4 relative;
    MeMatrix4TMMakeIdentity(relative);
    McdModelSetRelativeTransform(model, relative);
    assert_warned("set a transform first");
    McdModelSetTransformPtr(model, place);
    MeMatrix4TMSetPosition(relative, 2, 0, 0);
    McdModelSetRelativeTransform(model, relative);
    relative[3][0] = 7;
    MeMatrix4TMSetPosition(place, 1, 0, 0);
    McdModelUpdate(model);
    assertBox(2, 4, -1, 1);
    McdModelSetRelativeTransform(model, 0);
    ck_assert_ptr_eq(McdModelGetTransformPtr(model), place);
    McdModelUpdate(model);
    assertBox(0, 2, -1, 1);
}

TEST(a_path_covers_the_whole_motion) {
    MeVector3 velocity = {4, -2, 0};
    McdModelSetTransformPtr(model, place);
    McdModelSetLinearVelocityPtr(model, velocity);
    McdModelUpdatePath(model, 0.5);
    assertBox(-1, 3, -2, 1);
    ck_assert(place[3][0] == 0);
}

TEST(a_reset_model_keeps_its_geometry) {
    int data;
    McdModelSetTransformPtr(model, place);
    McdModelSetMaterial(model, 3);
    McdModelSetUserData(model, &data);
    McdModelSetBodyData(model, &data);
    McdModelSetSwept(model, METRUE);
    McdModelSetSortKey(model, 5);
    ck_assert(model->mBody == &data && McdModelGetUserData(model) == &data && McdModelGetMaterial(model) == 3);
    ck_assert(McdModelGetSortKey(model) == 5 && McdModelIsSwept(model));
    McdModelReset(model);
    ck_assert_ptr_eq(McdModelGetGeometry(model), blob);
    ck_assert(!McdModelGetTransformPtr(model) && !McdModelGetBodyData(model) && !McdModelGetUserData(model));
    ck_assert(McdModelGetMaterial(model) == 0 && McdModelGetSortKey(model) == 0 && !McdModelIsSwept(model));
}

TEST(a_model_can_have_another_geometry) {
    McdGeometryID larger = blobCreate(frame, BLOB, 2, 0);
    McdModelSetTransformPtr(model, place);
    McdModelSetGeometry(model, larger);
    McdModelUpdate(model);
    assertBox(-2, 2, -2, 2);
    ck_assert(McdGeometryGetReferenceCount(blob) == 0 && McdGeometryGetReferenceCount(larger) == 1);
    McdGeometryInstanceSetGeometry(McdModelGetGeometryInstance(model), blob);
    ck_assert(McdGeometryGetReferenceCount(blob) == 1 && McdGeometryGetReferenceCount(larger) == 0);
}

TEST(misuse_gets_a_warning_and_changes_nothing) {
    McdModelSetMaterial(model, -1);
    assert_warned("material");
    McdModelSetSortKey(model, -1);
    assert_warned("key");
    ck_assert(McdModelGetMaterial(model) == 0 && McdModelGetSortKey(model) == 0);
    ck_assert_ptr_null(McdModelCreate(0));
    assert_warned("no geometry");
    McdModelDestroy(0);
    assert_silent();
    McdModelUpdate(0);
    assert_warned("no model");
    ck_assert_ptr_null(McdGeometryInstanceGetChild(0, 0));
    assert_warned("no instance");
    ck_assert_ptr_null(McdGeometryInstanceGetChild(McdModelGetGeometryInstance(model), 0));
}
