/* Controls of a demonstration program: what is selected, framed and thrown. check_controls.py has them in a window. */
#include "RPanel.h"
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

static void middle(RMouseButtonEvent event) {
    MeAppMousePickCB(rc, WIDTH / 2, HEIGHT / 2, 0, kRLeftButton, event, app);
}

TEST(a_click_selects) {
    const McdModelID box = make_box(0, 0, 0);
    MeAppCreateControls(app);
    ck_assert_ptr_null(MeAppGetSelected(app));
    run(1);
    middle(kRNewlyPressed);
    middle(kRNewlyReleased);
    ck_assert_ptr_eq(MeAppGetSelected(app), box);
    ck_assert_ptr_null(app->pick.model);
    McdModelDynamicsSetPosition(box, 5, 0, 0);
    run(1);
    middle(kRNewlyPressed); /* The background: the selection stays. */
    ck_assert_ptr_null(app->pick.model);
    ck_assert_ptr_eq(MeAppGetSelected(app), box);
    MstModelAndBodyDestroy(box);
    ck_assert_ptr_null(MeAppGetSelected(app));
}

TEST(the_selected_model_is_framed) {
    const McdModelID box = make_box(3, 2, 1);
    make_box(-9, 0, 0);
    AcmeVector3 at;
    MeAppCreateControls(app);
    run(1);
    app->selected = box;
    MeAppFrameSelected(app);
    RCameraGetLookAt(rc, at);
    assert_near(at[0], 3, 1e-5);
    assert_near(at[1], 2, 1e-5);
    assert_near(at[2], 1, 1e-5);
    /* The sphere round a cube of side 1: its diameter is a third of the height that is seen. */
    const double seen = 2 * (double)RCameraGetDistance(rc) * tan((double)rc->m_CameraFov / 2);
    assert_near(seen, 3 * sqrt(3), 1e-4);
    app->selected = 0;
    MeAppFrameSelected(app); /* Both, from -9.5 to 3.5. */
    RCameraGetLookAt(rc, at);
    assert_near(at[0], -3, 1e-5);
    assert_near(at[1], 1, 1e-5);
}

TEST(a_ball_is_thrown_along_the_line_of_sight) {
    const McdModelID box = make_box(0, 0, 0);
    MeVector3 v;
    ck_assert_ptr_null(MeAppThrowBall(app));
    MeAppCreateControls(app);
    const McdModelID ball = MeAppThrowBall(app);
    ck_assert_ptr_nonnull(ball);
    assert_near(MdtBodyGetMass(McdModelGetBody(ball)), 1000 * 4. / 3 * 3.14159265358979 / 64, TOL(1e-5, 1e-9));
    McdModelDynamicsGetLinearVelocity(ball, v);
    assert_near(v[2], -20, 1e-4);
    run(40);
    McdModelDynamicsGetLinearVelocity(box, v);
    assert_below(v[2], -1); /* It was hit. */
}

TEST(after_eight_balls_the_first_is_thrown_again) {
    McdModelID first = 0, ball = 0;
    MeAppCreateControls(app);
    for (int i = 0; i < 9; i++) {
        ball = MeAppThrowBall(app);
        first = i ? first : ball;
        run(5);
    }
    ck_assert_ptr_eq(ball, first);
    ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 8);
    MstModelAndBodyDestroy(first); /* The program may take one away. */
    for (int i = 0; i < 8; i++)
        ck_assert_ptr_nonnull(MeAppThrowBall(app));
    ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 8);
}

/* Controls that nobody uses change no bit of the motion, and switch no report on. */
TEST(controls_change_nothing_by_themselves) {
    MeVector3 p[2];
    for (int with = 0; with < 2; with++) {
        tear_down();
        set_up();
        const McdModelID a = make_box(0, 0, 0);
        make_box(0.2, 3, 0.1);
        MdtWorldSetGravity(u->world, 0, -10, 0);
        if (with)
            MeAppCreateControls(app);
        run(60);
        ck_assert(!MdtWorldReportIsEnabled(u->world));
        McdModelDynamicsGetPosition(a, p[with]);
    }
    ck_assert_int_eq(memcmp(p[0], p[1], sizeof p[0]), 0);
}

/* What the context keeps of the helpers goes with them: the context may live on. */
TEST(controls_end_before_the_context) {
    MeAppCreateControls(app);
    MeAppSetLayers(app, MstDebugAll);
    MeAppDestroy(app);
    RPanelShow(rc, "Report", 1);
    assert_warned("no panel Report");
    app = MeAppCreateFromUniverse(u, rc);
}

TEST(bad_input) {
    MeAppSetLayers(app, MstDebugShapes);
    assert_warned("MeAppCreateControls");
    MeAppSetStepPtr(app, NULL);
    assert_warned("MeAppSetStepPtr: there are no controls");
    assert_refused(MeAppSetStepPtr, NULL, NULL);
    MeAppCreateControls(app);
    MeAppSetLayers(app, 1u << 20);
    assert_warned("MstDebugLayer");
    assert_refused(MeAppCreateControls, NULL);
    assert_none(MeAppGetSelected, NULL);
    assert_refused(MeAppFrameSelected, NULL);
    assert_none(MeAppThrowBall, NULL);
}
