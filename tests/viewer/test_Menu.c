/* Menus: values, their bounds, callbacks, and menus that lead to others. */
#include "RMenu.h"
#include "viewer_test.h"

static RRender *rc;
static int toggles;
static MeBool lastToggle;
static int values;
static MeReal lastValue;

static void MEAPI onToggle(MeBool on) {
    toggles++;
    lastToggle = on;
}

static void MEAPI onValue(MeReal value) {
    values++;
    lastValue = value;
}

static void setup(void) {
    toggles = values = 0;
    rc = make_context("-null");
}

static void teardown(void) {
    assert_silent();
    RRenderContextDestroy(rc);
}
TEST_FIXTURE(setup, teardown)

TEST(toggling) {
    RMenu *m = RMenuCreate(rc, "menu");
    RMenuAddToggleEntry(m, "toggle", onToggle, 1);
    RMenuExecute1Entry(rc); /* No menu is shown: nothing happens. */
    ck_assert_int_eq(toggles, 0);
    RMenuDisplay(m);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), m);
    RMenuExecute1Entry(rc);
    ck_assert_int_eq(lastToggle, 0);
    RMenuExecute2Entry(rc);
    ck_assert_int_eq(lastToggle, 1);
    ck_assert_int_eq(toggles, 2);
    RRenderHideCurrentMenu(rc);
    ck_assert_ptr_null(RRenderGetCurrentMenu(rc));
}

TEST(values_stay_between_their_bounds) {
    RMenu *m = RMenuCreate(rc, "menu");
    RMenuAddValueEntry(m, "value", onValue, 10, 0, 4, 5);
    RMenuDisplay(m);
    RMenuExecute1Entry(rc);
    assert_near(lastValue, 9, 0);
    RMenuExecute1Entry(rc);
    assert_near(lastValue, 10, 0);
    RMenuExecute1Entry(rc); /* At the end: not changed, not called. */
    ck_assert_int_eq(values, 2);
    for (int i = 0; i < 5; i++)
        RMenuExecute2Entry(rc);
    assert_near(lastValue, 0, 0);
    ck_assert_int_eq(values, 5);
}

TEST(choosing_goes_round) {
    RMenu *m = RMenuCreate(rc, "menu");
    RMenuDisplay(m);
    RMenuNextEntry(rc); /* An empty menu bears everything. */
    RMenuExecute1Entry(rc);
    RMenuAddToggleEntry(m, "first", NULL, 0);
    RMenuAddToggleEntry(m, "second", NULL, 0);
    RMenuAddValueEntry(m, "third", NULL, 1, 0, 1, 0);
    ck_assert_str_eq(m->m_pCurrent->m_Name, "first");
    RMenuNextEntry(rc);
    ck_assert_str_eq(m->m_pCurrent->m_Name, "second");
    RMenuExecute1Entry(rc); /* Without a callback. */
    RMenuNextEntry(rc);
    RMenuExecute1Entry(rc);
    RMenuNextEntry(rc);
    ck_assert_str_eq(m->m_pCurrent->m_Name, "first");
    RMenuPreviousEntry(rc);
    ck_assert_str_eq(m->m_pCurrent->m_Name, "third");
}

TEST(submenus) {
    RMenu *outer = RMenuCreate(rc, "outer"), *inner = RMenuCreate(rc, "inner");
    RMenuAddSubmenuEntry(outer, "more", inner);
    RMenuAddSubmenuEntry(inner, "back to the top", outer);
    RRenderDisplayDefaultMenu(rc); /* There is none yet. */
    ck_assert_ptr_null(RRenderGetCurrentMenu(rc));
    RRenderSetDefaultMenu(rc, outer);
    RRenderDisplayDefaultMenu(rc);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), outer);
    RMenuExecute1Entry(rc);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), inner);
    RMenuExecute2Entry(rc);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), outer);
    RMenuDestroy(inner); /* The entry stays and does nothing. */
    RMenuExecute1Entry(rc);
    ck_assert_ptr_eq(RRenderGetCurrentMenu(rc), outer);
    RMenuDestroy(outer);
    ck_assert_ptr_null(RRenderGetCurrentMenu(rc));
    ck_assert_ptr_null(rc->m_pDefaultMenu);
}

TEST(bad_input) {
    RMenu *m = RMenuCreate(rc, "menu");
    assert_none(RMenuCreate, NULL, "menu");
    ck_assert_ptr_null(RMenuCreate(rc, NULL));
    assert_warned("name");
    RMenuAddValueEntry(m, "value", onValue, 0, 10, 1, 5);
    assert_warned("exchanged");
    RMenuAddValueEntry(m, "value", onValue, 1, 0, 1, 5);
    assert_warned("default");
    RMenuAddValueEntry(m, "value", onValue, 1, 0, NAN, 0);
    assert_warned("finite");
    RMenuAddToggleEntry(m, NULL, onToggle, 0);
    assert_warned("name");
    assert_refused(RMenuAddSubmenuEntry, m, "more", NULL);
    assert_refused(RMenuDisplay, NULL);
    RMenuDisplay(m);
    RMenuExecute1Entry(rc);
    assert_near(lastValue, 6, 0); /* The exchanged one: 0 to 10. */
    RMenuNextEntry(rc);
    RMenuExecute2Entry(rc);
    assert_near(lastValue, 0, 0); /* The second one: its default became 1. */
    RMenuDestroy(m);
    RMenuDisplay(m);
    assert_warned("destroyed");
    RMenuDestroy(m); /* It is gone, as it should be. */
    assert_silent();
    assert_refused(RMenuDestroy, NULL);
}

/* Old programs destroy their menus after the context. */
TEST(menus_may_be_destroyed_late) {
    RRender *own = make_context("-null");
    RMenu *m = RMenuCreate(own, "menu");
    RRenderContextDestroy(own);
    RMenuDestroy(m);
}
