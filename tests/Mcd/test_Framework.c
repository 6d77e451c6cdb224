/* The framework: types and interactions of a program's own, pools, references, defaults, the end. */
#include "blob.h"
#include "karma_test.h"

static McdFrameworkID frame;
static MeMatrix4 place[4];

static void setUp(void) {
    frame = McdInit(2, 3, 0, 2);
    blobRegister(frame, BLOB);
    blobRegister(frame, OTHER_BLOB);
    for (int i = 0; i < 4; i++)
        MeMatrix4TMMakeIdentity(place[i]);
}

static void tearDown(void) {
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}
TEST_FIXTURE(setUp, tearDown)

static McdModelID modelAt(McdGeometryID g, int i, MeReal x) {
    McdModelID m = McdModelCreate(g);
    MeMatrix4TMSetPosition(place[i], x, 0, 0);
    McdModelSetTransformPtr(m, place[i]);
    McdModelUpdate(m);
    return m;
}

static void setInteraction(int type1, int type2) {
    McdInteractions interactions = {0, 0, blobIntersect, 0};
    McdFrameworkSetInteractions(frame, type1, type2, &interactions);
}

/* ---- life ------------------------------------------------------------------------------------------------------ */

TEST(sizes_out_of_range_get_a_warning) {
    ck_assert_ptr_null(McdInit(-1, 1, 0, 1));
    assert_warned("geoTypeMaxCount");
    ck_assert_ptr_null(McdInit(0, 0, 0, 1));
    assert_warned("modelCount");
    ck_assert_ptr_null(McdInit(0, 1, -1, 1));
    assert_warned("instanceCount");
    ck_assert_ptr_null(McdInit(0, 1, 0, 0));
    assert_warned("lengthScale");
    ck_assert_ptr_null(McdInit(0, 1, 0, NAN));
    assert_warned("lengthScale");
    assert_refused(McdTerm, 0);
}

TEST(three_arguments_mean_a_length_scale_of_one) {
    McdFrameworkID old = McdInit(0, 1, 0);
    ck_assert(McdFrameworkGetLengthScale(old) == 1);
    ck_assert(McdFrameworkGetLengthScale(frame) == 2);
    McdTerm(old);
}

static int actions[3], actionCount;

static void MEAPI firstAction(McdFrameworkID f) {
    (void)f;
    actions[actionCount++] = 1;
}

static void MEAPI secondAction(McdFrameworkID f) {
    (void)f;
    actions[actionCount++] = 2;
}

TEST(the_end_runs_term_actions_and_says_what_was_left) {
    int destroyed = 0;
    McdFrameworkID f = McdInit(1, 2, 0, 1);
    blobRegister(f, BLOB);
    McdModelCreate(blobCreate(f, BLOB, 1, &destroyed));
    McdFrameworkRegisterTermAction(f, firstAction);
    McdFrameworkRegisterTermAction(f, secondAction);
    actionCount = 0;
    McdTerm(f);
    assert_warned("1 models and 1 geometries");
    ck_assert(actionCount == 2 && actions[0] == 2 && actions[1] == 1);
    ck_assert_int_eq(destroyed, 1);
}

TEST(all_models_and_geometries_are_destroyed_at_once) {
    int destroyed = 0;
    McdGeometryID g = blobCreate(frame, BLOB, 1, &destroyed);
    McdModelCreate(g);
    McdModelCreate(g);
    blobCreate(frame, BLOB, 1, &destroyed);
    ck_assert(McdFrameworkGetModelCount(frame) == 2 && McdFrameworkGetGeometryCount(frame) == 2);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    ck_assert(McdFrameworkGetModelCount(frame) == 0 && McdFrameworkGetGeometryCount(frame) == 0);
    ck_assert_int_eq(destroyed, 2);
}

/* ---- types ----------------------------------------------------------------------------------------------------- */

TEST(types_are_registered_once) {
    static char other[] = "other";
    ck_assert_int_eq(McdFrameworkGetRegisteredTypeCount(frame), 2);
    ck_assert(McdFrameworkTypeIsRegistered(frame, BLOB) && !McdFrameworkTypeIsRegistered(frame, kMcdGeometryTypeBox));
    McdFrameworkRegisterGeometryType(frame, BLOB, other, 0, 0, 0, 0, 0, 0);
    ck_assert_str_eq(McdFrameworkGetTypeName(frame, BLOB), "blob");
    ck_assert_str_eq(McdFrameworkGetTypeName(frame, kMcdGeometryTypeBox), "(not registered)");
    ck_assert(!McdFrameworkTypeIsValid(frame, -1) && !McdFrameworkTypeIsValid(frame, BLOB + 2));
    McdFrameworkRegisterGeometryType(frame, BLOB + 2, other, 0, 0, 0, 0, 0, 0);
    assert_warned("geoTypeMaxCount");
}

TEST(a_geometry_of_a_type_that_is_not_registered_is_none) {
    Blob blob;
    memset(&blob, 0, sizeof blob);
    McdGeometryInit(&blob.head, frame, kMcdGeometryTypeCone);
    assert_warned("not registered");
    ck_assert(!McdGeometryIsValid(&blob.head));
    ck_assert_ptr_null(McdModelCreate(&blob.head));
    assert_warned("no geometry");
}

/* ---- references ------------------------------------------------------------------------------------------------ */

TEST(a_geometry_in_use_stays) {
    int destroyed = 0;
    McdGeometryID g = blobCreate(frame, BLOB, 1, &destroyed);
    McdModelID a = McdModelCreate(g), b = McdModelCreate(g);
    ck_assert_int_eq(McdGeometryGetReferenceCount(g), 2);
    McdGeometryDestroy(g);
    assert_warned("2 models or aggregates");
    McdModelDestroy(a);
    McdGeometryDestroy(g);
    assert_warned("1 models or aggregates");
    McdModelDestroy(b);
    McdGeometryDestroy(g);
    ck_assert_int_eq(destroyed, 1);
}

TEST(the_pool_of_models_has_an_end_and_is_reused) {
    McdGeometryID g = blobCreate(frame, BLOB, 1, 0);
    McdModelID m[3];
    for (int i = 0; i < 3; i++)
        m[i] = McdModelCreate(g);
    ck_assert_ptr_null(McdModelCreate(g));
    assert_warned("modelCount");
    McdModelDestroy(m[1]);
    McdModelGetMaterial(m[1]);
    assert_warned("no model"); /* a stale handle */
    ck_assert_ptr_nonnull(McdModelCreate(g));
}

/* ---- interactions ----------------------------------------------------------------------------------------------- */

static McdContact contacts[4];

static McdIntersectResult emptyResult(void) {
    McdIntersectResult result;
    memset(&result, 0, sizeof result);
    result.contacts = contacts;
    result.contactMaxCount = 4;
    return result;
}

TEST(a_pair_is_tested_by_the_interaction_of_its_types) {
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 2, 0), 1, 2.5);
    McdModelPairID p = McdModelPairCreate(a, b);
    McdIntersectResult result = emptyResult();
    setInteraction(BLOB, BLOB);
    McdHello(p);
    ck_assert(McdIntersect(p, &result));
    ck_assert(result.contactCount == 1 && result.touch == 1 && result.pair == p);
    assert_near(contacts[0].separation, -.5, TOL(3e-7, 5e-16));
    assert_vec3_near(contacts[0].normal, -1, 0, 0, TOL(5e-7, 9e-16));
    assert_vec3_near(contacts[0].position, .75, 0, 0, TOL(5e-7, 9e-16));
    MeMatrix4TMSetPosition(place[1], 3.5, 0, 0);
    ck_assert(McdIntersect(p, &result));
    ck_assert(result.contactCount == 0 && result.touch == 0);
    McdGoodbye(p);
    McdModelPairDestroy(p);
}

/* Registered for (BLOB, OTHER_BLOB) and asked for (OTHER_BLOB, BLOB). */
TEST(a_pair_in_the_other_order_is_turned_and_turned_back) {
    McdModelID a = modelAt(blobCreate(frame, OTHER_BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 1);
    McdModelPairID p = McdModelPairCreate(a, b);
    McdIntersectResult result = emptyResult();
    setInteraction(BLOB, OTHER_BLOB);
    ck_assert(McdIntersect(p, &result) && result.touch);
    assert_vec3_near(contacts[0].normal, -1, 0, 0, TOL(5e-7, 9e-16)); /* pushes a, the first */
    assert_vec3_near(result.normal, -1, 0, 0, TOL(5e-7, 9e-16));
    ck_assert_ptr_eq(contacts[0].instance1, McdModelGetGeometryInstance(a));
    ck_assert(contacts[0].element1.tag == 2 && contacts[0].element2.tag == 1);
    ck_assert(result.pair == p && p->model1 == a);
    McdModelPairDestroy(p);
}

TEST(a_pair_without_an_interaction_never_touches_and_is_told_once) {
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 1);
    McdModelPairID p = McdModelPairCreate(a, b);
    McdIntersectResult result = emptyResult();
    McdHello(p);
    assert_warned("blob");
    McdHello(p);
    ck_assert_int_eq(McdFrameworkGetInteractionsWarned(frame, BLOB, BLOB), 2);
    ck_assert(!McdIntersect(p, &result) && result.contactCount == 0);
    McdModelPairDestroy(p);
}

TEST(the_request_limits_contacts) {
    McdRequest none = {0, MEFALSE}, one = {1, MEFALSE};
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 1);
    McdModelPairID p = McdModelPairCreate(a, b);
    ck_assert_int_eq(McdModelPairGetRequestPtr(p)->contactMaxCount, 20);
    McdFrameworkSetDefaultRequestPtr(frame, &one);
    ck_assert_ptr_eq(McdModelPairGetRequestPtr(p), &one);
    McdModelPairSetRequestPtr(p, &none);
    ck_assert_ptr_eq(McdModelPairGetRequestPtr(p), &none);
    McdFrameworkSetDefaultRequestPtr(frame, 0);
    McdModelPairSetRequestPtr(p, 0);
    ck_assert_int_eq(McdModelPairGetRequestPtr(p)->contactMaxCount, 20);
    McdModelPairDestroy(p);
}

static int called;

static void MEAPI noteContacts(McdModel *m, McdIntersectResult *result) {
    (void)m;
    called++;
    result->contactCount = 0; /* it may change them */
}

TEST(a_models_callback_sees_its_contacts) {
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 1);
    McdModelPairID p = McdModelPairCreate(a, b);
    McdIntersectResult result = emptyResult();
    setInteraction(BLOB, BLOB);
    called = 0;
    McdModelSetIntersectCallback(b, noteContacts);
    McdIntersect(p, &result);
    ck_assert(called == 1 && result.contactCount == 0);
    McdModelPairDestroy(p);
}

TEST(models_are_intersected_where_they_will_be) {
    MeVector3 velocity = {2, 0, 0};
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 4);
    McdModelPairID p = McdModelPairCreate(a, b);
    McdIntersectResult result = emptyResult();
    setInteraction(BLOB, BLOB);
    McdModelSetLinearVelocityPtr(a, velocity);
    ck_assert(McdIntersectAt(p, &result, 0.5) && !result.touch);
    ck_assert(McdIntersect(p, &result, 1.5) && result.touch); /* the guide's form */
    assert_near(contacts[0].separation, -1, TOL(5e-7, 9e-16));
    ck_assert(place[0][3][0] == 0 && McdModelGetTransformPtr(a) == place[0]);
    McdModelPairDestroy(p);
}

TEST(bad_pairs_and_results_are_refused) {
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 1);
    McdModelPair p = {.model1 = a, .model2 = b, .phase = kMcdFFStateInactive};
    McdIntersectResult result = emptyResult(), placeless = {0};
    setInteraction(BLOB, BLOB);
    ck_assert_ptr_null(McdModelPairCreate(a, a));
    assert_warned("two models");
    ck_assert_ptr_null(McdModelPairCreate(a, 0));
    assert_warned("no model");
    ck_assert(!McdIntersect(0, &result));
    assert_warned("no pair");
    ck_assert(!McdIntersect(&p, &placeless));
    assert_warned("no place for contacts");
    place[0][3][1] = (MeReal)NAN;
    ck_assert(McdIntersect(&p, &result) && !result.touch && result.contactCount == 0);
    assert_warned("not finite");
    McdModelSetTransformPtr(a, 0);
    ck_assert(McdIntersect(&p, &result) && !result.touch);
    assert_warned("no transform");
}

/* ---- defaults --------------------------------------------------------------------------------------------------- */

TEST(the_contact_tolerance_grows_the_boxes) {
    McdModelID a = modelAt(blobCreate(frame, BLOB, 1, 0), 0, 0), b;
    assert_near(McdFrameworkGetDefaultContactTolerance(frame), .02, TOL(1e-9, 2e-17));
    assert_near(McdModelGetContactTolerance(a), .02, TOL(1e-9, 2e-17));
    McdFrameworkSetDefaultContactTolerance(frame, 0.5);
    b = modelAt(blobCreate(frame, BLOB, 1, 0), 1, 2.51);
    McdModelPairID p = McdModelPairCreate(a, b);
    ck_assert(McdNearby(p));
    McdModelSetContactTolerance(b, 0.45);
    ck_assert(!McdNearby(p));
    McdModelSetContactTolerance(b, -1);
    assert_warned("tolerance");
    McdFrameworkSetDefaultContactTolerance(frame, NAN);
    assert_warned("tolerance");
    assert_near(McdModelGetContactTolerance(b), .45, TOL(3e-7, 4e-16));
    McdModelPairDestroy(p);
}
