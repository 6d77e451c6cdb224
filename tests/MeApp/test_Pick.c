/* The mouse: what is under it, and how it pulls. */
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

/* The pixel at which a point is seen. */
static void pixel_of(double x, double y, double z, int *px, int *py) {
    const MeVector3 p = {x, y, z};
    MeVector3 c;
    RRenderUpdateProjectionMatrices(rc);
    const MeVector4 *P = (const MeVector4 *)rc->m_ProjectionMatrix;
    MeMatrix4TMTransform(c, (const MeVector4 *)rc->m_CameraMatrix, p);
    const double w = P[2][3] * c[2] + P[3][3];
    *px = (int)lround(WIDTH / 2. * (1 + (P[0][0] * c[0]) / w));
    *py = (int)lround(HEIGHT / 2. * (1 - (P[1][1] * c[1]) / w));
}

static void mouse(RMouseButtonEvent event, double x, double y, double z) {
    int px, py;
    pixel_of(x, y, z, &px, &py);
    MeAppMousePickCB(rc, px, py, 0, kRLeftButton, event, app);
}

static void place_of(McdModelID m, double p[3]) {
    MeVector3 v;
    McdModelDynamicsGetPosition(m, v);
    for (int i = 0; i < 3; i++)
        p[i] = v[i];
}

static void assert_at(McdModelID m, double x, double y, double z, double tolerance) {
    double p[3];
    place_of(m, p);
    assert_near(p[0], x, tolerance);
    assert_near(p[1], y, tolerance);
    assert_near(p[2], z, tolerance);
}

/* A pixel of the picture is this large, 10 m away. */
static const double pixel = 10 * .73 / HEIGHT;

TEST(a_pixel_is_a_direction_and_a_point) {
    const double views[][3] = {{0, 0, 0}, {.7, .3, 0}, {-2, 1.2, 0}, {.7, .3, 1}};
    for (int i = 0; i < 4; i++) {
        MeVector3 d, p;
        AcmeVector3 eye, look;
        int x, y;
        RCameraSetView(rc, 10, (float)views[i][0], (float)views[i][1]);
        if (views[i][2] > 0)
            RCameraSetOrthographicView(rc, 8, 20);
        RCameraGetPosition(rc, eye);
        RCameraGetLookDir(rc, look);
        MeAppFindClickPos(app, 250, 420, p);
        pixel_of(p[0], p[1], p[2], &x, &y);
        ck_assert_int_eq(x, 250);
        ck_assert_int_eq(y, 420);
        MeAppFindClickDir(app, 250, 420, d);
        assert_near(MeVector3Magnitude(d), 1, 1e-6);
        MeAppFindClickDir(app, WIDTH / 2, HEIGHT / 2, d);
        for (int k = 0; k < 3; k++)
            assert_near(d[k], look[k], 1e-5);
        /* Along the direction from the eye lies the point. */
        MeAppFindClickDir(app, 250, 420, d);
        for (int k = 0; k < 3 && views[i][2] == 0; k++) {
            const MeReal away = MeVector3Distance(p, (MeVector3){eye[0], eye[1], eye[2]});
            assert_near(eye[k] + away * d[k], p[k], 1e-4);
        }
    }
}

TEST(the_nearest_model_is_picked_where_it_is_seen) {
    const McdModelID far = make_box(0, 0, -3), near = make_box(.4, 0, 2);
    MeVector3 d, p;
    int x, y;
    MstUniverseStep(u, 1. / 60);
    pixel_of(.2, .1, 2.5, &x, &y);
    ck_assert_ptr_eq(MeAppPickMcdModel(app, x, y, d, p, 0), near);
    assert_near(p[0], .2, pixel);
    assert_near(p[1], .1, pixel);
    assert_near(p[2], 2.5, 1e-4);
    pixel_of(-.45, 0, -2.5, &x, &y);
    ck_assert_ptr_eq(MeAppPickMcdModel(app, x, y, d, p, 0), far);
    ck_assert_ptr_null(MeAppPickMcdModel(app, 5, 5, d, p, 0));
    RCameraSetOrthographicView(rc, 8, 20);
    pixel_of(.6, .1, 2.5, &x, &y);
    ck_assert_ptr_eq(MeAppPickMcdModel(app, x, y, d, p, 1), near);
    assert_near(p[0], .6, .02);
    assert_near(d[2], -1, 1e-6);
    ck_assert_ptr_eq(MeAppPickMcdModel(app, x, y, d, p, 0), near);
}

TEST(what_is_held_follows_the_mouse_until_it_is_released) {
    const McdModelID far = make_box(0, 0, -3), near = make_box(0, 0, 2);
    run(1);
    mouse(kRNewlyPressed, 0, 0, 2.5);
    ck_assert_ptr_eq(app->pick.model, near);
    run(60);
    assert_at(near, 0, 0, 2, .01); /* held, but not moved */
    for (int i = 1; i <= 30; i++) {
        mouse(kRStillPressed, i / 20., i / 30., 2.5);
        run(1);
    }
    ck_assert_int_eq(lines_drawn(), 1);
    run(180);
    MeVector3 held;
    MeMatrix4TMTransform(held, (const MeVector4 *)McdModelGetTransformPtr(near), app->pick.relative);
    assert_near(held[0], 1.5, 2 * pixel);
    assert_near(held[1], 1, 2 * pixel);
    assert_near(held[2], 2.5, .01);
    assert_at(far, 0, 0, -3, 0);
    mouse(kRNewlyReleased, 1.5, 1, 2.5);
    ck_assert_ptr_null(app->pick.model);
    ck_assert_int_eq(lines_drawn(), 0);
    double before[3];
    place_of(near, before);
    mouse(kRStillPressed, -2, 0, 2.5);
    run(60);
    assert_at(near, before[0], before[1], before[2], .1); /* it may drift, but does not follow */
}

/* Held by a corner, a rod, heavy or light: the held point comes to the target and the body to rest. */
TEST(every_body_comes_to_rest_at_the_mouse) {
    const double sizes[][3] = {{1, 1, 1}, {.1, 4, .1}, {4, .05, 4}, {.06, .06, .06}};
    for (int i = 0; i < 8; i++) {
        const double *s = sizes[i / 2];
        McdGeometryID g = McdBoxCreate(u->frame, s[0], s[1], s[2]);
        McdModelID m = MstModelAndBodyCreate(u, g, i % 2 ? 1000 : .01);
        MdtWorldSetGravity(u->world, 0, -9.81, 0);
        MstUniverseStep(u, 1. / 60);
        McdModelDynamicsSetPosition(m, 0, 0, 0);
        McdSpaceUpdateAll(u->space);
        mouse(kRNewlyPressed, .3 * s[0], .3 * s[1], .5 * s[2]);
        ck_assert_ptr_eq(app->pick.model, m);
        mouse(kRStillPressed, 1, 1.5, .5 * s[2]);
        run(1800);
        MeVector3 held;
        MeMatrix4TMTransform(held, (const MeVector4 *)McdModelGetTransformPtr(m), app->pick.relative);
        assert_near(held[0], 1, 2 * pixel);
        assert_near(held[1], 1.5 - 9.81 / 225, 2 * pixel); /* it hangs by its weight lower */
        const double mass = MdtBodyGetMass(McdModelGetBody(m));
        ck_assert(MdtBodyGetKineticEnergy(McdModelGetBody(m)) < 5e-9 * mass); /* .1 mm/s */
        mouse(kRNewlyReleased, 1, 1, .5);
        MstModelAndBodyDestroy(m);
    }
}

TEST(a_far_target_pulls_no_harder_than_a_near_one) {
    const McdModelID m = make_box(0, 0, 0);
    RCameraSetView(rc, 200, 0, 0);
    run(1);
    mouse(kRNewlyPressed, 0, 0, .5);
    mouse(kRStillPressed, 50, 0, .5);
    for (int i = 0; i < 200; i++) {
        MeVector3 v;
        run(1);
        McdModelDynamicsGetLinearVelocity(m, v);
        ck_assert(MeVector3Magnitude(v) < 31);
    }
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    assert_near(p[0], 50, 1);
}

TEST(who_sleeps_wakes_when_picked) {
    const McdModelID m = make_box(0, 0, 0);
    run(1);
    MdtBodyDisable(McdModelGetBody(m));
    run(2);
    mouse(kRNewlyPressed, 0, 0, .5);
    mouse(kRStillPressed, 1, 0, .5);
    ck_assert(MdtBodyIsEnabled(McdModelGetBody(m)));
    run(120);
    double p[3];
    place_of(m, p);
    ck_assert(p[0] > .5);
}

TEST(the_void_and_fixed_models_are_not_held) {
    static MeMatrix4 tm;
    const McdModelID behind = make_box(0, 0, -2);
    MeMatrix4TMMakeIdentity(tm);
    const McdModelID wall = MstFixedModelCreate(u, McdBoxCreate(u->frame, 1, 1, 1), tm);
    run(1);
    mouse(kRNewlyPressed, 3, 2, 0);
    ck_assert_ptr_null(app->pick.model);
    mouse(kRStillPressed, 0, 0, .5);
    mouse(kRNewlyReleased, 0, 0, .5);
    mouse(kRNewlyPressed, 0, 0, .5);
    ck_assert_ptr_null(app->pick.model);
    mouse(kRStillPressed, 1, 0, .5);
    run(30);
    ck_assert_int_eq(lines_drawn(), 0);
    assert_at(behind, 0, 0, -2, 0);
    ck_assert(McdModelIsValid(wall) && tm[3][0] == 0);
}

TEST(only_the_left_button_picks) {
    int x, y;
    make_box(0, 0, 0);
    run(1);
    pixel_of(0, 0, .5, &x, &y);
    MeAppMousePickCB(rc, x, y, 0, kRRightButton, kRNewlyPressed, app);
    ck_assert_ptr_null(app->pick.model);
    mouse(kRNewlyPressed, 0, 0, .5);
    MeAppMousePickCB(rc, x, y, 0, kRRightButton, kRNewlyReleased, app);
    ck_assert_ptr_nonnull(app->pick.model);
}

TEST(what_is_destroyed_while_held_is_let_go) {
    McdModelID m = make_box(0, 0, 0);
    run(1);
    mouse(kRNewlyPressed, 0, 0, .5);
    run(5);
    MstModelAndBodyDestroy(m);
    run(5);
    ck_assert_ptr_null(app->pick.model);
    ck_assert_int_eq(lines_drawn(), 0);
    /* Another one in its place, and one that has lost its body, or its space. */
    m = make_box(0, 0, 0);
    run(1);
    mouse(kRNewlyPressed, 0, 0, .5);
    run(2);
    McdSpaceRemoveModel(m);
    run(2);
    ck_assert_ptr_null(app->pick.model);
    mouse(kRNewlyReleased, 0, 0, .5);
}

TEST(a_moving_camera_takes_along_what_is_held) {
    const McdModelID m = make_box(0, 0, 0);
    const AcmeVector3 at = {2, 1, 0};
    run(1);
    mouse(kRNewlyPressed, 0, 0, .5);
    run(10);
    RCameraSetLookAt(rc, at);
    run(240);
    MeVector3 held;
    MeMatrix4TMTransform(held, (const MeVector4 *)McdModelGetTransformPtr(m), app->pick.relative);
    assert_near(held[0], 2, .02);
    assert_near(held[1], 1, .02);
    assert_near(held[2], .5, .02);
}

TEST(bad_input_is_named) {
    MeVector3 v = {0, 0, 0};
    ck_assert_ptr_null(MeAppCreate(NULL, u->space, rc));
    assert_warned("MeAppCreate: world");
    ck_assert_ptr_null(MeAppCreateFromUniverse(u, NULL));
    assert_warned("rc");
    ck_assert_ptr_null(MeAppCreateFromUniverse(NULL, rc));
    assert_warned("MeAppCreateFromUniverse: null is no universe");
    MeAppDestroy(NULL);
    assert_silent();
    assert_refused(MeAppStep, NULL);
    assert_refused(MeAppUpdateMouseSpring, NULL);
    assert_refused(MeAppMousePickCB, rc, 0, 0, 0, kRLeftButton, kRNewlyPressed, NULL);
    assert_refused(MeAppFindClickDir, NULL, 0, 0, v);
    assert_refused(MeAppFindClickPos, NULL, 0, 0, v);
    assert_none(MeAppPickMcdModel, NULL, 0, 0, v, v, 0);
    assert_none(MeAppGetMstUniverse, NULL);
}

TEST(the_universe_is_remembered) {
    MeApp *parts = MeAppCreate(u->world, u->space, rc);
    ck_assert_ptr_eq(MeAppGetMstUniverse(app), u);
    ck_assert_ptr_null(MeAppGetMstUniverse(parts));
    MeAppDestroy(parts);
}
