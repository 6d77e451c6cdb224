/* Models with bodies: who belongs to whom, through every kind of parting. */
#include "Mst.h"
#include "karma_test.h"

static MdtWorldID world;
static McdFrameworkID frame;
static McdModelID model;
static MdtBodyID body;

static void setUp(void) {
    world = MdtWorldCreate(2, 4);
    frame = McdInit(0, 4, 0, 1);
    McdAllRegisterTypes(frame);
    model = McdModelCreate(McdSphereCreate(frame, 1));
    body = MdtBodyCreate(world);
}

static void tearDown(void) {
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
    MdtWorldDestroy(world);
}
TEST_FIXTURE(setUp, tearDown)

TEST(a_model_follows_its_body) {
    MeVector3 low, high;
    ck_assert_ptr_null(McdModelGetBody(model));
    McdModelSetBody(model, body);
    ck_assert_ptr_eq(McdModelGetBody(model), body);
    ck_assert_ptr_eq(McdModelGetTransformPtr(model), MdtBodyGetTransformPtr(body));
    ck_assert_ptr_eq(McdModelGetLinearVelocityPtr(model), MdtBodyGetLinearVelocityPtr(body));
    McdModelDynamicsSetPosition(model, 3, 4, 5);
    McdModelUpdate(model);
    McdModelGetAABB(model, low, high);
    assert_vec3_near(low, 2, 3, 4, TOL(1e-5, 7e-14));
    McdModelDynamicsSetLinearVelocity(model, 1, 2, 3);
    assert_vec3_near(McdModelGetLinearVelocityPtr(model), 1, 2, 3, TOL(1e-7, 3e-14));
}

TEST(a_transform_set_afterwards_counts) {
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    McdModelSetBody(model, body);
    McdModelSetTransformPtr(model, tm);
    ck_assert_ptr_eq(McdModelGetTransformPtr(model), tm);
    McdModelSetBody(model, 0);
    ck_assert_ptr_eq(McdModelGetTransformPtr(model), tm);
}

TEST(parted_models_have_neither_body_nor_transform) {
    McdModelSetBody(model, body);
    McdModelSetBody(model, 0);
    ck_assert(!McdModelGetBody(model) && !McdModelGetTransformPtr(model) && !McdModelGetLinearVelocityPtr(model));
    ck_assert_ptr_null(MdtBodyGetModel(body));
}

/* Three models of one body, parted and destroyed in every order: the body always knows the rest. */
TEST(a_body_may_have_several_models) {
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int k = 0; k < 12; k++) {
        McdModelID m[3];
        for (int i = 0; i < 3; i++) {
            m[i] = McdModelCreate(McdModelGetGeometry(model));
            McdModelSetBody(m[i], body);
        }
        for (int i = 0; i < 3; i++) {
            if (k < 6)
                McdModelDestroy(m[order[k][i]]);
            else
                McdModelSetBody(m[order[k - 6][i]], 0);
            int count = 0;
            for (McdModelID left = MdtBodyGetModel(body); left; left = left->mOfBody)
                count += left->mBody == body;
            ck_assert_int_eq(count, 2 - i);
        }
        for (int i = 0; i < 3 && k >= 6; i++)
            McdModelDestroy(m[i]);
    }
}

TEST(a_reset_puts_the_body_at_the_origin) {
    MeVector3 p, v;
    MeVector4 q;
    McdModelSetBody(model, body);
    McdModelDynamicsSetPosition(model, 1, 2, 3);
    McdModelDynamicsSetQuaternion(model, 0, 1, 0, 0);
    McdModelDynamicsSetLinearVelocity(model, 1, 1, 1);
    McdModelDynamicsSetAngularVelocity(model, 1, 1, 1);
    McdModelDynamicsReset(model);
    McdModelDynamicsGetPosition(model, p);
    McdModelDynamicsGetQuaternion(model, q);
    assert_vec3_near(p, 0, 0, 0, 0);
    assert_near(q[0], 1, TOL(1e-7, 9e-15));
    McdModelDynamicsGetLinearVelocity(model, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    McdModelDynamicsGetAngularVelocity(model, v);
    assert_vec3_near(v, 0, 0, 0, 1e-12);
}
