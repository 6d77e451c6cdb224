/* Contacts as lines: as many as there are, where they are. */
#include "app_test.h"

TEST_FIXTURE(set_up, tear_down)

static float yellow[4] = {1, .8f, 0, 1};
static MeMatrix4 floorTM;

/* Two boxes on the plane z = 0: four contacts each. */
static void make_scene(void) {
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MeMatrix4TMMakeIdentity(floorTM);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    make_box(-1, 0, .5);
    make_box(1, 0, .5);
    run(10);
}

static int contacts_of_the_world(void) {
    int n = 0;
    for (MdtConstraintID c = MdtConstraintGetFirst(u->world); c; c = MdtConstraintGetNext(c))
        n += MdtConstraintDCastContactGroup(c) ? MdtContactGroupGetCount(MdtConstraintDCastContactGroup(c)) : 0;
    return n;
}

TEST(every_contact_is_a_line) {
    make_scene();
    MeAppDrawContacts(app);
    ck_assert_int_eq(lines_drawn(), 0);
    MeAppDrawContactsInit(app, yellow, 100);
    ck_assert_int_eq(lines_drawn(), 0);
    MeAppDrawContacts(app);
    ck_assert_int_eq(contacts_of_the_world(), 8);
    ck_assert_int_eq(lines_drawn(), 8);
    ck_assert_int_eq(app->contacts->count, 8);
    run(10);
    ck_assert_int_eq(lines_drawn(), 8);
}

TEST(a_line_goes_along_the_normal_through_the_contact) {
    make_scene();
    MeAppDrawContactsInit(app, yellow, 100);
    MeAppSetContactDrawLength(app, 2);
    MeAppDrawContacts(app);
    for (RNativeLine *l = rc->m_pNativeLines; l; l = l->m_pNext) {
        const AcmeReal *a = l->m_Vectors.m_Start, *b = l->m_Vectors.m_End;
        assert_near(fabs((double)(a[0] + b[0]) / 2), 1, .51);
        assert_near(a[0], b[0], 1e-5);
        assert_near(a[1], b[1], 1e-5);
        assert_near(fabs(a[2] - b[2]), 2, 1e-5);
        assert_near((a[2] + b[2]) / 2, 0, .01);
        assert_near(l->m_Color[1], .8, 1e-6);
    }
}

TEST(no_more_lines_than_there_is_room_for) {
    make_scene();
    MeAppDrawContactsInit(app, yellow, 5);
    MeAppDrawContacts(app);
    ck_assert_int_eq(lines_drawn(), 5);
    MeAppDrawContactsInit(app, yellow, 100);
    ck_assert_int_eq(lines_drawn(), 0);
    MeAppDrawContacts(app);
    ck_assert_int_eq(lines_drawn(), 8);
}

TEST(lines_go_with_their_contacts_and_by_the_switch) {
    make_scene();
    MeAppDrawContactsInit(app, yellow, 100);
    run(1);
    ck_assert_int_eq(lines_drawn(), 8);
    MeAppToggleDrawContacts(app, 0);
    ck_assert_int_eq(lines_drawn(), 0);
    run(1);
    ck_assert_int_eq(lines_drawn(), 0);
    MeAppToggleDrawContacts(app, 1);
    run(1);
    ck_assert_int_eq(lines_drawn(), 8);
    for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b)) {
        MdtBodyEnable(b);
        MdtBodySetPosition(b, 0, 0, b == MdtBodyGetFirst(u->world) ? 5 : 9);
    }
    run(3);
    ck_assert_int_eq(lines_drawn(), 0);
}

TEST(bad_input_is_named) {
    float broken[4] = {0, NAN, 0, 1};
    MeAppDrawContactsInit(app, NULL, 3);
    assert_warned("color");
    MeAppDrawContactsInit(app, broken, 3);
    assert_warned("color");
    MeAppDrawContactsInit(app, yellow, 0);
    assert_warned("max");
    MeAppSetContactDrawLength(app, 0);
    assert_warned("length");
    MeAppSetContactDrawLength(app, NAN);
    assert_warned("length");
    assert_refused(MeAppDrawContactsInit, NULL, yellow, 3);
    assert_refused(MeAppDrawContacts, NULL);
    assert_refused(MeAppToggleDrawContacts, NULL, 1);
    assert_refused(MeAppSetContactDrawLength, NULL, 1);
}
