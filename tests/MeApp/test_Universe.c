/* A universe on the screen: graphics of all models come and go with them, and one call starts all that a program needs.
 */
#include "RGeometry.h"
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

static const float red[4] = {.8f, .1f, .1f, 1}, blue[4] = {.1f, .2f, .8f, 1};
static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, -3, 1}};

static int graphics_drawn(void) {
    int n = 0;
    for (RGraphic *g = rc->m_p3DGraphics; g; g = g->m_pNext)
        n++;
    return n;
}

/* The last of the list. */
static RGraphic *newest(void) {
    RGraphic *g = rc->m_p3DGraphics;
    while (g && g->m_pNext)
        g = g->m_pNext;
    return g;
}

TEST(each_model_has_one_graphic) {
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    make_box(1, 2, 3);
    ck_assert_int_eq(MeAppShowUniverse(app), 2);
    ck_assert_int_eq(graphics_drawn(), 2);
    make_box(4, 5, 6);
    ck_assert_int_eq(MeAppShowUniverse(app), 3);
    ck_assert_int_eq(MeAppShowUniverse(app), 3);
    ck_assert_int_eq(graphics_drawn(), 3);
}

TEST(of_a_sensor_the_edges_are_drawn) {
    McdModelID solid = make_box(1, 2, 3), sensor = make_box(4, 5, 6);
    McdModelSetSensor(sensor, METRUE);
    MeAppShowUniverse(app);
    ck_assert(RGraphicIsWireframe(MeAppShowModel(app, sensor, RPalette[0])));
    ck_assert(!RGraphicIsWireframe(MeAppShowModel(app, solid, RPalette[0])));
}

TEST(graphics_follow_their_models) {
    McdModelID m = make_box(1, 2, 3);
    MeAppShowUniverse(app);
    RRenderUpdateGraphicMatrices(rc);
    assert_vec3_near(rc->m_p3DGraphics->m_pObject->m_Matrix[3], 1, 2, 3, 0);
    static MeMatrix4 other = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {7, 8, 9, 1}};
    McdModelSetTransformPtr(m, other);
    MeAppShowUniverse(app);
    RRenderUpdateGraphicMatrices(rc);
    assert_vec3_near(rc->m_p3DGraphics->m_pObject->m_Matrix[3], 7, 8, 9, 0);
    McdModelSetBody(m, McdModelGetBody(m));
}

TEST(graphics_go_with_their_models) {
    McdModelID m[200];
    for (int i = 0; i < 60; i++)
        m[i] = make_box(i, 0, 0);
    ck_assert_int_eq(MeAppShowUniverse(app), 60);
    RGraphic *kept = MeAppShowModel(app, m[1], red);
    for (int i = 0; i < 60; i += 2)
        MstModelAndBodyDestroy(m[i]);
    for (int i = 0; i < 20; i++) /* They may come to be in the memory of those that went. */
        make_box(i, 1, 0);
    ck_assert_int_eq(MeAppShowUniverse(app), 50);
    ck_assert_int_eq(graphics_drawn(), 50);
    ck_assert_ptr_eq(MeAppShowModel(app, m[1], red), kept);
    McdSpaceRemoveModel(m[1]);
    ck_assert_int_eq(MeAppShowUniverse(app), 49);
    ck_assert_int_eq(graphics_drawn(), 49);
    McdSpaceInsertModel(u->space, m[1]); /* Older than most that are shown. */
    ck_assert_int_eq(MeAppShowUniverse(app), 50);
    ck_assert_int_eq(graphics_drawn(), 50);
}

TEST(a_model_has_the_colour_that_it_was_given) {
    float color[4];
    McdModelID m = make_box(0, 0, 0);
    RGraphic *g = MeAppShowModel(app, m, red);
    ck_assert_ptr_nonnull(g);
    MeAppShowUniverse(app);
    RGraphicGetColor(g, color);
    assert_near(color[0], red[0], 0);
    ck_assert_ptr_eq(MeAppShowModel(app, m, blue), g);
    RGraphicGetColor(g, color);
    assert_near(color[2], blue[2], 0);
    ck_assert_int_eq(graphics_drawn(), 1);
}

TEST(colours_are_in_turn_and_fixed_models_grey) {
    float first[4], second[4], fixed[4];
    make_box(0, 0, 0);
    MeAppShowUniverse(app);
    RGraphicGetColor(newest(), first);
    make_box(2, 0, 0);
    MeAppShowUniverse(app);
    RGraphicGetColor(newest(), second);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    MeAppShowUniverse(app);
    RGraphicGetColor(newest(), fixed);
    for (int i = 0; i < 3; i++) {
        assert_near(first[i], RPalette[0][i], 0);
        assert_near(second[i], RPalette[1][i], 0);
    }
    ck_assert_msg(fabsf(fixed[0] - fixed[2]) < .1f, "not grey");
}

TEST(ending_the_helpers_removes_their_graphics) {
    make_box(0, 0, 0);
    MeAppShowUniverse(app);
    MeAppDestroy(app);
    ck_assert_int_eq(graphics_drawn(), 0);
    app = MeAppCreateFromUniverse(u, rc);
}

TEST(bad_arguments_get_a_warning) {
    McdModelID m = make_box(0, 0, 0);
    assert_none(MeAppShowUniverse, 0);
    assert_none(MeAppShowModel, 0, m, red);
    assert_none(MeAppShowModel, app, 0, red);
    assert_none(MeAppShowModel, app, m, 0);
    assert_refused(MeAppRun, 0, 1, 0, 0);
    assert_refused(MeAppRun, app, 0, 0, 0);
    assert_none(MeAppStart, 0, 0, "name", 0);
    ck_assert_int_eq(graphics_drawn(), 0);
}
