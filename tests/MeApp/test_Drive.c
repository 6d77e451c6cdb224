/* The camera that follows a body, and terrain. Keys as an axis are tested by what drives: the tutorials Car and
 * Quadbike, and docs/howto.md. */
#include "MeAppTerrain.h"
#include "RKey.h"
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

TEST(the_camera_is_behind_the_body_and_comes_after_it) {
    const McdModelID box = make_box(1, 2, 3);
    AcmeVector3 at, from;
    MeAppFollow(app, McdModelGetBody(box), 5, 0);
    RCameraGetLookAt(rc, at);
    RCameraGetPosition(rc, from);
    assert_vec3_near(at, 1, 2, 3, 1e-6);
    assert_vec3_near(from, 1 - 5, 2, 3, 1e-5); /* The body looks along x. */
    McdModelDynamicsSetPosition(box, 5, 2, 3);
    MeAppStep(app);
    RCameraGetLookAt(rc, at);
    assert_vec3_near(at, 2, 2, 3, 1e-6); /* A quarter of the way. */
    for (int i = 0; i < 100; i++)
        MeAppStep(app);
    RCameraGetLookAt(rc, at);
    assert_vec3_near(at, 5, 2, 3, 1e-5);
}

TEST(the_camera_turns_as_the_body_turns) {
    const McdModelID box = make_box(0, 0, 0);
    AcmeVector3 from;
    const MeReal half = ME_PI / 4;
    MeAppFollow(app, McdModelGetBody(box), 5, 0);
    McdModelDynamicsSetQuaternion(box, MeCos(half), 0, MeSin(half), 0); /* x looks along -z. */
    for (int i = 0; i < 300; i++)
        MeAppStep(app);
    RCameraGetPosition(rc, from);
    assert_vec3_near(from, 0, 0, 5, 1e-4);
}

/* The same with z up: behind is still behind, and a body that turns about z is followed. */
TEST(the_camera_follows_about_the_up_axis) {
    const McdModelID box = make_box(0, 0, 0);
    AcmeVector3 from;
    const MeReal half = ME_PI / 4;
    RCameraSetUp(rc, 0, 0, 1);
    MeAppFollow(app, McdModelGetBody(box), 5, (AcmeReal)(ME_PI / 6));
    RCameraGetPosition(rc, from);
    assert_vec3_near(from, -5 * cos(acos(-1) / 6), 0, 2.5, 1e-5);
    McdModelDynamicsSetQuaternion(box, MeCos(half), 0, 0, MeSin(half)); /* x looks along y. */
    for (int i = 0; i < 300; i++)
        MeAppStep(app);
    RCameraGetPosition(rc, from);
    assert_vec3_near(from, 0, -5 * cos(acos(-1) / 6), 2.5, 1e-4);
}

TEST(following_ends_with_the_body) {
    const McdModelID box = make_box(0, 0, 0);
    AcmeVector3 at;
    MeAppFollow(app, McdModelGetBody(box), 5, 0);
    MstModelAndBodyDestroy(box);
    MeAppStep(app);
    ck_assert_ptr_null(app->follow.body);
    const McdModelID other = make_box(0, 0, 0);
    MeAppFollow(app, McdModelGetBody(other), 5, 0);
    MeAppFollow(app, 0, 5, 0);
    McdModelDynamicsSetPosition(other, 9, 9, 9);
    MeAppStep(app);
    RCameraGetLookAt(rc, at);
    assert_vec3_near(at, 0, 0, 0, 0);
}

static MeReal MEAPI slope(MeReal x, MeReal z, void *userdata) {
    return *(MeReal *)userdata + (MeReal)0.25 * x - (MeReal)0.5 * z;
}

static int graphics_drawn(void) {
    int n = 0;
    for (RGraphic *g = rc->m_p3DGraphics; g; g = g->m_pNext)
        n++;
    return n;
}

/* A ball that falls along y onto the plane y = 2 + x / 4 - z / 2 lies on it. */
TEST(the_model_is_where_the_function_is) {
    MeReal level = 2;
    MeAppTerrain *t = MeAppTerrainCreate(9, 2, slope, &level);
    const McdModelID ground = MeAppTerrainCreateModel(t, u);
    McdLineSegIntersectResult hit;
    for (int i = -3; i <= 3; i++) {
        MeVector3 from = {(MeReal)i, 20, (MeReal)(2 - i)}, to = {(MeReal)i, -20, (MeReal)(2 - i)};
        ck_assert(McdLineSegIntersect(ground, from, to, &hit));
        assert_near(hit.position[1], 2 + .25 * i - .5 * (2 - i), TOL(1e-5, 1e-12));
    }
    MstUniverseDestroy(u);
    MeAppTerrainDestroy(t);
    u = MstUniverseCreate(NULL);
    MeAppDestroy(app);
    app = MeAppCreateFromUniverse(u, rc);
}

TEST(corners_are_in_the_world) {
    MeReal level = 0;
    MeAppTerrain *t = MeAppTerrainCreate(5, 3, slope, &level);
    ck_assert_int_eq(MeAppTerrainGetPoints(t), 5);
    assert_near(MeAppTerrainGetCell(t), 3, 0);
    for (int k = 0; k < 2; k++) {
        MeVector3 *a = MeAppTerrainGetCorner(t, 1, 3, k, 0), *b = MeAppTerrainGetCorner(t, 1, 3, k, 1),
                  *c = MeAppTerrainGetCorner(t, 1, 3, k, 2), ab, ac, up;
        MeVector3Subtract(ab, *b, *a);
        MeVector3Subtract(ac, *c, *a);
        MeVector3Cross(up, ab, ac);
        assert_below(0, up[1]); /* Counter-clockwise as seen from above. */
        assert_vec3_near(*a, -3, .25 * -3 - .5 * -3, -3, 1e-6);
    }
    assert_none(MeAppTerrainGetCorner, t, 4, 0, 0, 0);
    assert_none(MeAppTerrainGetCorner, t, 0, 0, 2, 0);
    MeAppTerrainDestroy(t);
}

/* With z up the plane is z = 2 + x / 4 - y / 2, the model's and the picture's. */
TEST(z_may_be_up) {
    MeReal level = 2;
    MeAppTerrain *t = MeAppTerrainCreateZUp(9, 2, slope, &level);
    const McdModelID ground = MeAppTerrainCreateModel(t, u);
    McdLineSegIntersectResult hit;
    const MeVector3 from = {1, 3, 20}, to = {1, 3, -20};
    ck_assert(McdLineSegIntersect(ground, (MeReal *)from, (MeReal *)to, &hit));
    assert_near(hit.position[2], 2 + .25 * 1 - .5 * 3, TOL(1e-5, 1e-12));
    MeVector3 *corner = MeAppTerrainGetCorner(t, 1, 3, 0, 0);
    assert_vec3_near(*corner, -6, -2, 2 + .25 * -6 - .5 * -2, 1e-6);
    MeAppTerrainShow(t, rc);
    const RObjectVertex *v = rc->m_p3DGraphics->m_pVertices;
    assert_near(v->m_Z, 2 + .25 * v->m_X - .5 * v->m_Y, 1e-5);
    const double length = sqrt(1 + .25 * .25 + .5 * .5);
    assert_near(v[6 * 9].m_NX * length, -.25, 1e-5);
    assert_near(v[6 * 9].m_NY * length, .5, 1e-5);
    assert_near(v[6 * 9].m_NZ * length, 1, 1e-5);
    MstUniverseDestroy(u);
    MeAppTerrainDestroy(t);
    u = MstUniverseCreate(NULL);
    MeAppDestroy(app);
    app = MeAppCreateFromUniverse(u, rc);
}

/* All cells are drawn, whatever of them is level. */
TEST(it_is_drawn_whole) {
    MeReal level = 1;
    MeAppTerrain *t = MeAppTerrainCreate(5, 3, slope, &level);
    MeAppTerrainShow(t, rc);
    ck_assert_int_eq(graphics_drawn(), 1);
    ck_assert_int_eq(rc->m_p3DGraphics->m_pObject->m_nNumVertices, 6 * 16);
    MeAppTerrainDestroy(t);
}

TEST(bad_arguments_get_a_warning) {
    MeReal level = 0;
    assert_none(MeAppTerrainCreate, 1, 1, slope, &level);
    assert_none(MeAppTerrainCreate, 9, 0, slope, &level);
    assert_none(MeAppTerrainCreate, 9, 1, 0, 0);
    assert_refused(MeAppTerrainShow, 0, rc);
    assert_none(MeAppTerrainCreateModel, 0, u);
    assert_none(MeAppGetKeyAxis, 0, "Left", "Right");
    ck_assert_int_eq(MeAppGetKeyAxis(app, "Left", "Rigth"), 0);
    assert_warned("MeAppGetKeyAxis: Rigth");
    assert_refused(MeAppFollow, 0, 0, 1, 0);
}
